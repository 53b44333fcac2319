//! Buckling while a robot bends: jumps of the kinetic energy of its walls with a drop of stored energy.
//!
//! [`Watch`] samples the energies every few dozen steps; [`snaps`] finds the jumps in the samples. What counts is the motion of
//! the walls against the section they are in, v − v̄ with the mean v̄ over a stretch of the robot: a fold moves so, the swing of
//! the whole robot does not. A snap is a peak of
//!
//! ```text
//! K_w = K Σ|v − v̄|² / Σ|v|²           released = max (U(t₁) − U(t₂)),   valley before ≤ t₁ < t₂ ≤ valley after
//! ```
//!
//! well above the valleys on both sides, between which the stored energy U falls. Its place is the place of the nodes with
//! the largest |v − v̄| at the peak. **Validity**: nodes of about equal mass; snaps closer together than their ringing are one.

use crate::policy;
use crate::vec3::{V3, share};
use crate::{Mesh, Simulation};

/// Stretches along the robot whose mean velocity is subtracted \[m\].
const STRETCH_M: f64 = 0.01;
/// Share of the fastest nodes whose mean is the place.
const FASTEST: f64 = 0.005;
/// Kinetic energy of the walls over stored energy below which nothing is looked for.
const QUIET: f64 = 2e-3;
/// Energies at one moment \[s, J\], and where the fastest nodes are along the straight robot \[m\] (NaN: not looked for).
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Sample {
    /// Simulated time of the sample \[s\].
    pub time_s: f64,
    /// Kinetic energy of the whole robot \[J\].
    pub kinetic_j: f64,
    /// Kinetic energy of the walls against their sections \[J\].
    pub walls_j: f64,
    /// Energy stored in all terms of the ledger \[J\].
    pub stored_j: f64,
    /// Place along the straight robot \[m\].
    pub place_m: f64,
}

/// One buckling event: when, where and how much energy it releases.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Snap {
    /// When the kinetic energy of the walls peaks \[s\].
    pub time_s: f64,
    /// Place along the straight robot \[m\].
    pub place_m: f64,
    /// Drop of stored energy over the event \[J\].
    pub released_j: f64,
    /// Kinetic energy of the walls at the peak \[J\].
    pub kinetic_j: f64,
}

#[derive(Debug, Clone)]
pub(crate) struct Watch {
    stretch: Vec<u32>,
    x_m: Vec<f64>,
    pub samples: Vec<Sample>,
}

impl Watch {
    pub(crate) fn new(mesh: &Mesh) -> Watch {
        let x_m: Vec<f64> = (0..mesh.points.len()).map(|node| mesh.start_of(node)[0]).collect();
        let low = x_m.iter().copied().fold(f64::INFINITY, f64::min);
        let stretch = x_m.iter().map(|x| ((x - low) / STRETCH_M) as u32).collect();
        Watch { stretch, x_m, samples: Vec::new() }
    }

    /// Takes a sample; to be called in step with the run.
    pub(crate) fn sample(&mut self, run: &Simulation) {
        let ledger = run.ledger();
        let stored_j = ledger.stored_j(|_| true);
        let squares = self.against_stretch(&run.velocities());
        let all: f64 = squares.iter().map(|s| s[1]).sum();
        let own: f64 = squares.iter().map(|s| s[0]).sum();
        let walls_j = share(ledger.kinetic_j * own, all);
        let place_m = if walls_j > QUIET * stored_j { self.place(&squares) } else { f64::NAN };
        let (time_s, kinetic_j) = (run.time_s(), ledger.kinetic_j);
        self.samples.push(Sample { time_s, kinetic_j, walls_j, stored_j, place_m });
    }

    /// |v − v̄|² and |v|² of every node.
    fn against_stretch(&self, velocities: &[V3]) -> Vec<[f64; 2]> {
        let stretches = self.stretch.iter().max().map_or(0, |most| *most as usize + 1);
        let mut means = vec![[0.0; 4]; stretches];
        for (v, stretch) in velocities.iter().zip(&self.stretch) {
            let mean = &mut means[*stretch as usize];
            (0..3).for_each(|k| mean[k] += v[k]);
            mean[3] += 1.0;
        }
        let squares = |(v, stretch): (&[f64; 3], &u32)| {
            let mean = means[*stretch as usize];
            let own = (0..3).map(|k| (v[k] - mean[k] / mean[3]).powi(2)).sum::<f64>();
            [own, v.iter().map(|v| v * v).sum::<f64>()]
        };
        velocities.iter().zip(&self.stretch).map(squares).collect()
    }

    /// Place of the nodes that move fastest against their stretch.
    fn place(&self, squares: &[[f64; 2]]) -> f64 {
        let mut order: Vec<(f64, usize)> = squares.iter().enumerate().map(|(node, s)| (s[0], node)).collect();
        let count = ((FASTEST * order.len() as f64) as usize).clamp(1, order.len());
        order.select_nth_unstable_by(count - 1, |a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
        // The median of the places: two folds at once give one of them, not the middle.
        let mut places: Vec<f64> = order[..count].iter().map(|(_, node)| self.x_m[*node]).collect();
        places.sort_by(f64::total_cmp);
        places[places.len() / 2]
    }
}

/// Finds the snaps after `from_s` \[s\].
pub fn snaps(samples: &[Sample], from_s: f64) -> Vec<Snap> {
    let first = samples.partition_point(|s| s.time_s < from_s);
    let samples = &samples[first..];
    let most = samples.iter().map(|s| s.stored_j).fold(0.0, f64::max);
    let mut found = Vec::new();
    for [before, peak, after] in peaks(samples) {
        let mut highest = f64::NEG_INFINITY;
        let mut released_j = 0.0_f64;
        for sample in &samples[before..=after] {
            highest = highest.max(sample.stored_j);
            released_j = released_j.max(highest - sample.stored_j);
        }
        let at = samples[peak];
        if policy::is_a_drop(released_j, most) && at.place_m.is_finite() {
            found.push(Snap { time_s: at.time_s, place_m: at.place_m, released_j, kinetic_j: at.walls_j });
        }
    }
    found
}

/// Valley, peak, valley of the walls' kinetic energy, each valley below a share of the peaks next to it.
fn peaks(samples: &[Sample]) -> Vec<[usize; 3]> {
    let k = |i: usize| samples[i].walls_j;
    let mut turns: Vec<usize> = Vec::new();
    let (mut low, mut high, mut rising) = (0, 0, true);
    for i in 0..samples.len() {
        if rising {
            high = if k(i) > k(high) { i } else { high };
            if policy::is_valley(k(i), k(high)) {
                turns.extend([low, high]);
                (low, rising) = (i, false);
            }
        } else {
            low = if k(i) < k(low) { i } else { low };
            if policy::is_valley(k(low), k(i)) {
                (high, rising) = (i, true);
            }
        }
    }
    turns.push(low);
    turns
        .chunks(2)
        .zip(turns.chunks(2).skip(1))
        .filter(|(a, _)| a.len() == 2)
        .map(|(a, b)| [a[0], a[1], b[0]])
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn run(of: impl Fn(f64) -> (f64, f64)) -> Vec<Sample> {
        let sample = |i: usize| {
            let time_s = i as f64 * 1e-3;
            let (kinetic_j, stored_j) = of(time_s);
            Sample { time_s, kinetic_j: 2.0 * kinetic_j, walls_j: kinetic_j, stored_j, place_m: time_s }
        };
        (0..300).map(sample).collect()
    }

    fn bump(t: f64, at: f64) -> f64 {
        (-((t - at) / 0.005).powi(2)).exp()
    }

    #[test]
    fn jumps_of_kinetic_energy_are_snaps_only_where_stored_energy_falls() {
        // Two jumps at .1 and .2 s; the stored energy falls by .05 J at the first only.
        let samples =
            run(|t| (1e-4 + 0.02 * (bump(t, 0.1) + bump(t, 0.2)), 1.0 + t - 0.05 * (500.0 * (t - 0.1)).tanh()));
        let found = snaps(&samples, 0.0);
        assert_eq!(found.len(), 1, "{found:?}");
        assert!((found[0].time_s - 0.1).abs() < 1.5e-3 && (found[0].released_j - 0.1).abs() < 0.02, "{found:?}");
        assert_eq!(found[0].place_m, found[0].time_s);
        assert!(snaps(&samples, 0.15).is_empty());
    }

    #[test]
    fn a_quiet_run_has_no_snaps() {
        assert!(snaps(&run(|t| (1e-4 * (1.0 + 0.1 * (900.0 * t).sin()), t)), 0.0).is_empty());
        assert!(snaps(&[], 0.0).is_empty());
    }
}
