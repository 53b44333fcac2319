//! Where in its range each key is, case by case.

use crate::policy::MOST_SOBOL;
use compare::study::generate::Scatter;
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

/// Points of the unit cube, one row a case.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Points {
    axes: usize,
    all: Vec<f64>,
}

impl Points {
    /// `cases` points over so many axes; `Err` says why not.
    pub(crate) fn new(method: Method, cases: usize, axes: usize, seed: u32) -> Result<Points, String> {
        match method {
            Method::LatinHypercube => Ok(latin(cases, axes, seed)),
            Method::Sobol if cases > MOST_SOBOL => {
                Err(format!("{cases} cases are more than the Sobol sequence has here, {MOST_SOBOL}"))
            }
            Method::Sobol => {
                let at = |i: usize, axis: usize| f64::from(sobol_burley::sample(i as u32, axis as u32, seed));
                let all = (0..cases).flat_map(|i| (0..axes).map(move |axis| at(i, axis))).collect();
                Ok(Points { axes, all })
            }
        }
    }

    /// The point of a case, each coordinate from 0 to below 1.
    pub(crate) fn of(&self, case: usize) -> &[f64] {
        &self.all[case * self.axes..(case + 1) * self.axes]
    }
}

fn latin(cases: usize, axes: usize, seed: u32) -> Points {
    let mut random = Scatter::new(u64::from(seed));
    Points { axes, all: fem::robot::latin(cases, axes, || random.uniform()) }
}
