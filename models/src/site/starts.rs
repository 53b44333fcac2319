//! Where to start the balance of an actuator whose effects its closed-form guess does not know: a table made at set-up.
//!
//! ```text
//! v = √((M_b − M_load)/P)      θ(v) and the imbalance's slope over P: cubics through four neighbours of equal distance in v
//! ```
//!
//! M_b is the body's moment at a typical bend. A start decides speed, never the result. Exact but for the interpolation at the
//! scenario's body pressure; at others the folds of a pouch shift it a little, and the yarns of a muscle more.

use crate::root::Start;
use std::sync::OnceLock;

/// Starts at equal distances of v. A node does not depend on the others, so it may be solved when it is first used.
pub(super) struct Starts {
    moment: f64,
    first: f64,
    step: f64,
    /// Coordinate, and slope per pascal; `None` inside where nothing balances.
    nodes: Vec<OnceLock<Option<[f64; 2]>>>,
}

/// So many starts are within some 1e-6 of the root; each costs a microsecond.
const NODES: usize = 41;

impl Starts {
    /// Between two pressures at a resisting moment; `None` without room between them.
    pub(super) fn new(moment: f64, [low_pa, high_pa]: [f64; 2]) -> Option<Starts> {
        let (first, last) = ((moment / high_pa).sqrt(), (moment / low_pa).sqrt());
        let step = (last - first) / (NODES - 1) as f64;
        (step > 0.0).then(|| Starts { moment, first, step, nodes: vec![OnceLock::new(); NODES] })
    }

    /// Solves all nodes now; `solved` gives coordinate and slope at an actuator pressure.
    pub(super) fn fill(&self, solved: impl Fn(f64) -> Option<[f64; 2]>) {
        (0..NODES).for_each(|i| _ = self.node(i, &solved));
    }

    #[inline]
    fn node(&self, i: usize, solved: &impl Fn(f64) -> Option<[f64; 2]>) -> Option<[f64; 2]> {
        *self.nodes[i].get_or_init(|| {
            let pressure_pa = self.moment / (self.first + self.step * i as f64).powi(2);
            solved(pressure_pa).map(|[coordinate, slope]| [coordinate, slope / pressure_pa])
        })
    }

    /// The start at this resisting moment and pressure; `None` outside the table, and where a node has none.
    #[inline]
    pub(super) fn at(&self, moment: f64, pressure_pa: f64, solved: impl Fn(f64) -> Option<[f64; 2]>) -> Option<Start> {
        let place = ((moment / pressure_pa).sqrt() - self.first) / self.step;
        // Also refuses a NaN.
        if !(-0.5..=(NODES - 1) as f64 + 0.5).contains(&place) {
            return None;
        }
        let from = (place as usize).clamp(1, NODES - 3) - 1;
        let t = place - from as f64;
        let (a, b, c, d) = (t, t - 1.0, t - 2.0, t - 3.0);
        let weights = [-b * c * d / 6.0, a * c * d / 2.0, -a * b * d / 2.0, a * b * c / 6.0];
        let (mut x, mut slope) = (0.0, 0.0);
        for (k, weight) in weights.into_iter().enumerate() {
            let [coordinate, per_pa] = self.node(from + k, &solved)?;
            x += weight * coordinate;
            slope += weight * per_pa;
        }
        Some(Start { x, f: None, slope: slope * pressure_pa })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_smooth_answer_is_met_between_the_nodes() {
        let answer = |p: f64| [1.2 - 0.9 * (3.0 / p).sqrt() + 0.2 * 3.0 / p, -2.0 * p];
        let starts = Starts::new(3.0, [5.0, 100.0]).unwrap();
        let solved = |p: f64| Some(answer(p));
        for p in [5.0, 5.3, 17.0, 60.0, 99.0] {
            let start = starts.at(3.0, p, solved).unwrap();
            let [x, slope] = answer(p);
            assert!((start.x - x).abs() < 1e-12 && (start.slope / slope - 1.0).abs() < 1e-12, "{p}: {start:?}");
        }
        let outside = [(3.0, 2.0), (-1.0, 10.0), (3.0, 0.0)];
        assert!(outside.iter().all(|(moment, p)| starts.at(*moment, *p, solved).is_none()));
        let solved = |p: f64| (p > 6.0).then(|| answer(p));
        let starts = Starts::new(3.0, [5.0, 100.0]).unwrap();
        assert!(starts.at(3.0, 5.1, solved).is_none() && starts.at(3.0, 60.0, solved).is_some());
        assert!(Starts::new(3.0, [100.0, 5.0]).is_none());
    }

    #[test]
    fn a_start_is_the_same_whether_its_nodes_were_solved_before() {
        let solved = |p: f64| Some([1.0 / p, -p]);
        let [early, late] = [0, 1].map(|_| Starts::new(3.0, [5.0, 100.0]).unwrap());
        early.fill(solved);
        for p in [5.0, 17.3, 99.0] {
            assert_eq!(early.at(3.0, p, |_| None), late.at(3.0, p, solved), "{p}");
        }
    }
}
