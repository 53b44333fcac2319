//! Where in its range each key is, case by case.

use compare::study::generate::NormalNumbers;
use serde::Deserialize;

#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
pub(crate) enum Method {
    /// Every n-th of each range is met once (McKay, Beckman and Conover 1979).
    #[serde(rename = "latin hypercube")]
    LatinHypercube,
    /// Owen-scrambled Sobol points: even in every corner (Burley 2020).
    #[serde(rename = "sobol")]
    Sobol,
}

#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Points {
    axes: usize,
    all: Vec<f64>,
}

impl Points {
    pub(crate) fn new(method: Method, cases: usize, axes: usize, seed: u32) -> Points {
        match method {
            Method::LatinHypercube => latin(cases, axes, seed),
            Method::Sobol => {
                let all = (0..cases).flat_map(|i| (0..axes).map(move |axis| sobol(i, axis, seed))).collect();
                Points { axes, all }
            }
        }
    }

    /// The point of a case, each coordinate from 0 to below 1.
    pub(crate) fn of(&self, case: usize) -> &[f64] {
        &self.all[case * self.axes..(case + 1) * self.axes]
    }
}

/// The sequence has 2¹⁶ points in so many axes; further points and axes repeat the net with another scrambling.
fn sobol(case: usize, axis: usize, seed: u32) -> f64 {
    const NET: usize = 1 << 16;
    const AXES: usize = sobol_burley::NUM_DIMENSIONS as usize;
    let net = (case / NET + ((axis / AXES) << 16)) as u32;
    let scrambling = seed ^ net.wrapping_mul(0x9e37_79b9);
    f64::from(sobol_burley::sample((case % NET) as u32, (axis % AXES) as u32, scrambling))
}

fn latin(cases: usize, axes: usize, seed: u32) -> Points {
    let mut random = NormalNumbers::new(u64::from(seed));
    Points { axes, all: fem::robot::latin(cases, axes, || random.uniform()) }
}
