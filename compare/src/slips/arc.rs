//! The plainest inflated robot: bent by the same curvature everywhere, of whatever size.
//!
//! ```text
//! ψ = κ s      (x, y) = (1 − |κ| R) s · ( sinψ/ψ , (1 − cosψ)/ψ )
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | s | station on the undeformed body | m |
//! | κ | heading change per length of the taut generator, free in every hold | 1/m |
//! | R | radius of the body | m |
//!
//! No stiffness, no actuator, no pressure: it is what every robot of this length looks like to a millimetre or a few, and what
//! one with two labels exchanged does not by the distance of the two.

use crate::fit::numbers::least;
use data::Dataset;

/// Steps of the search for κ between its bounds, before it is refined.
const STEPS: usize = 24;
/// Halvings of the interval around the best step: to 1e-6 of it.
const REFINED: usize = 28;
/// Largest |κ| R: the near side of the body has no length left at 1.
const MOST_SHORTENED: f64 = 0.9;
const GOLDEN: f64 = 0.618_033_988_749_894_9;

#[derive(Debug, Clone, Copy)]
pub(super) struct MarkedBody<'a> {
    pub stations_m: &'a [f64],
    /// Radius R of the body \[m\].
    pub radius_m: f64,
}

/// A uniformly bent body laid through some markers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Laid {
    /// Curvature κ, positive towards +y \[1/m\].
    pub curvature: f64,
    /// Sum of squares of the distances of the markers from their places on it \[m²\].
    pub squares: f64,
}

impl MarkedBody<'_> {
    /// The bend that leaves least, starting at the base or, `loose`, anywhere but heading along x.
    pub(super) fn lay(&self, points: &[[f64; 2]], loose: bool) -> Laid {
        let most = (MOST_SHORTENED / self.radius_m).min(1.5 * std::f64::consts::PI / self.longest_m().max(1e-9));
        let left = |curvature: f64| self.squares(points, curvature, loose);
        let step = 2.0 * most / STEPS as f64;
        let at = |i: usize| i as f64 * step - most;
        let best = least((0..=STEPS).map(|i| (at(i), left(at(i)))), |(_, squares)| *squares).map_or(0.0, |(k, _)| k);
        let (mut low, mut high) = ((best - step).max(-most), (best + step).min(most));
        for _ in 0..REFINED {
            let (a, b) = (high - GOLDEN * (high - low), low + GOLDEN * (high - low));
            if left(a) < left(b) { high = b } else { low = a }
        }
        let curvature = 0.5 * (low + high);
        Laid { curvature, squares: left(curvature) }
    }

    pub(super) fn longest_m(&self) -> f64 {
        self.stations_m.iter().fold(0.0, |longest: f64, s| longest.max(*s))
    }

    /// Where a marker that was lost would be, next to those that were seen.
    pub(super) fn beside(&self, dataset: &Dataset, hold: usize, points: &[[f64; 2]], lost: usize) -> [f64; 2] {
        let seen: Vec<usize> = (0..points.len()).filter(|marker| dataset.is_seen(hold, *marker)).collect();
        let stations_m: Vec<f64> = seen.iter().map(|marker| self.stations_m[*marker]).collect();
        let of_seen: Vec<[f64; 2]> = seen.iter().map(|marker| points[*marker]).collect();
        let body = MarkedBody { stations_m: &stations_m, ..*self };
        let curvature = body.lay(&of_seen, true).curvature;
        let (_, [x, y]) = body.apart(&of_seen, curvature);
        let own = self.place(self.stations_m[lost], curvature);
        [own[0] + x, own[1] + y]
    }

    /// How far every marker is from its place on the body laid through all of them, wherever that starts \[m\].
    pub(super) fn off(&self, points: &[[f64; 2]]) -> Vec<f64> {
        let (apart, [x, y]) = self.apart(points, self.lay(points, true).curvature);
        apart.iter().map(|d| (d[0] - x).hypot(d[1] - y)).collect()
    }

    /// Markers less their places on a bent body that starts at the origin, and the mean of that.
    fn apart(&self, points: &[[f64; 2]], curvature: f64) -> (Vec<[f64; 2]>, [f64; 2]) {
        let each = |(point, s): (&[f64; 2], &f64)| {
            let place = self.place(*s, curvature);
            [point[0] - place[0], point[1] - place[1]]
        };
        let apart: Vec<[f64; 2]> = points.iter().zip(self.stations_m).map(each).collect();
        let mean = [0, 1].map(|axis| apart.iter().map(|d| d[axis]).sum::<f64>() / points.len().max(1) as f64);
        (apart, mean)
    }

    fn squares(&self, points: &[[f64; 2]], curvature: f64, loose: bool) -> f64 {
        let (mut squares, mut sum) = (0.0, [0.0; 2]);
        for (point, s) in points.iter().zip(self.stations_m) {
            let place = self.place(*s, curvature);
            for axis in 0..2 {
                let off = point[axis] - place[axis];
                squares += off * off;
                sum[axis] += off;
            }
        }
        let taken = (sum[0] * sum[0] + sum[1] * sum[1]) / points.len() as f64;
        if loose { (squares - taken).max(0.0) } else { squares }
    }

    /// Where it has the marker at a station \[m\].
    pub(super) fn place(&self, s: f64, curvature: f64) -> [f64; 2] {
        let (psi, length) = (curvature * s, (1.0 - curvature.abs() * self.radius_m) * s);
        if psi.abs() < 1e-6 {
            return [length, 0.5 * length * psi];
        }
        [length * psi.sin() / psi, length * (1.0 - psi.cos()) / psi]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_bent_body_is_found_by_its_markers_wherever_it_begins() {
        let stations_m = [0.03, 0.09, 0.15, 0.21, 0.27, 0.33];
        let body = MarkedBody { stations_m: &stations_m, radius_m: 0.04 };
        for curvature in [-1.0, 0.0, 0.02, 2.0, 6.0] {
            let points: Vec<[f64; 2]> = stations_m.iter().map(|s| body.place(*s, curvature)).collect();
            let elsewhere: Vec<[f64; 2]> = points.iter().map(|[x, y]| [x + 0.4, y - 0.2]).collect();
            for (points, loose) in [(&points, false), (&elsewhere, true)] {
                let laid = body.lay(points, loose);
                assert!((laid.curvature - curvature).abs() < 1e-4, "{curvature} {loose}: {laid:?}");
                assert!(laid.squares < 1e-9, "{curvature} {loose}: {laid:?}");
            }
        }
    }
}
