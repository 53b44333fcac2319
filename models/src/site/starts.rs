//! Where to start the balance of an actuator whose effects its closed-form guess does not know: a table made at set-up.
//!
//! ```text
//! v = √((M_b − M_load)/P)      θ(v) and the imbalance's slope over P: cubics through four neighbours of equal distance in v
//! ```
//!
//! M_b is the body's moment at a typical bend. A start decides speed, never the result. Exact but for the interpolation at the
//! scenario's body pressure; at others the folds of a pouch shift it a little, and the yarns of a muscle more.

use crate::root::Start;

pub(super) struct Starts {
    first: f64,
    per_step: f64,
    /// Coordinate at each node, and its slope over the pressure.
    nodes: Vec<[f64; 2]>,
}

/// So many starts are within some 1e-6 of the root; each costs a microsecond at set-up.
const NODES: usize = 41;

impl Starts {
    /// From `solved`, coordinate and slope at an actuator pressure, between two pressures at a resisting moment; `None` if a
    /// place in between has none.
    pub(super) fn new(
        moment: f64,
        [low_pa, high_pa]: [f64; 2],
        mut solved: impl FnMut(f64) -> Option<[f64; 2]>,
    ) -> Option<Starts> {
        let (first, last) = ((moment / high_pa).sqrt(), (moment / low_pa).sqrt());
        let step = (last - first) / (NODES - 1) as f64;
        let node = |i: usize| {
            let pressure_pa = moment / (first + step * i as f64).powi(2);
            solved(pressure_pa).map(|[coordinate, slope]| [coordinate, slope / pressure_pa])
        };
        let nodes = (0..NODES).map(node).collect::<Option<Vec<_>>>()?;
        (step > 0.0).then(|| Starts { first, per_step: 1.0 / step, nodes })
    }

    /// The start at this resisting moment and pressure; `None` outside the table.
    #[inline]
    pub(super) fn at(&self, moment: f64, pressure_pa: f64) -> Option<Start> {
        let place = ((moment / pressure_pa).sqrt() - self.first) * self.per_step;
        // Also refuses a NaN.
        if !(-0.5..=(NODES - 1) as f64 + 0.5).contains(&place) {
            return None;
        }
        let from = (place as usize).clamp(1, NODES - 3) - 1;
        let t = place - from as f64;
        let (a, b, c, d) = (t, t - 1.0, t - 2.0, t - 3.0);
        let weights = [-b * c * d / 6.0, a * c * d / 2.0, -a * b * d / 2.0, a * b * c / 6.0];
        let near = self.nodes[from..from + 4].iter().zip(weights);
        let [x, slope] = near.fold([0.0; 2], |[x, s], (node, w)| [x + w * node[0], s + w * node[1]]);
        Some(Start::guess(x, slope * pressure_pa))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_smooth_answer_is_met_between_the_nodes() {
        let answer = |p: f64| [1.2 - 0.9 * (3.0 / p).sqrt() + 0.2 * 3.0 / p, -2.0 * p];
        let starts = Starts::new(3.0, [5.0, 100.0], |p| Some(answer(p))).unwrap();
        for p in [5.0, 5.3, 17.0, 60.0, 99.0] {
            let start = starts.at(3.0, p).unwrap();
            let [x, slope] = answer(p);
            assert!((start.x - x).abs() < 1e-12 && (start.slope / slope - 1.0).abs() < 1e-12, "{p}: {start:?}");
        }
        assert!(starts.at(3.0, 2.0).is_none() && starts.at(-1.0, 10.0).is_none() && starts.at(3.0, 0.0).is_none());
        assert!(Starts::new(3.0, [5.0, 100.0], |p| (p > 6.0).then(|| answer(p))).is_none());
    }
}
