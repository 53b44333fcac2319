//! The nuisance directions of a run and the fit of a run's deviation to them.

use crate::fit::least_squares::dot;
use data::Dataset;

/// Part of a unit direction that must be new for it to count as separate from those before it; below this its coefficient
/// would be a thousand times noisier than the others.
const SMALLEST_NEW_PART: f64 = 1e-3;

/// What one value of U is moved by: pressure, shifts along x and y, rotation about z; in space also the shift along z and the
/// rotations about x and y, which are 0 in the plane.
pub(crate) type DirectionRow = [f64; 7];

/// The rows of [`DirectionRow`] that are shifts, and those that are rotations.
pub(crate) const SHIFTS: [usize; 3] = [1, 2, 4];
pub(crate) const ROTATIONS: [usize; 3] = [3, 5, 6];

/// Order in which directions claim their part; the pressure comes last because the others exist without a model.
const PRIORITY: [usize; 7] = [1, 2, 4, 3, 5, 6, 0];

/// U of a dataset, with zeros where too few runs saw a marker: with the residual zero there too, such values are as if they were not.
pub(crate) fn directions_of(dataset: &Dataset, dprediction_dlnp: &[f64]) -> Vec<DirectionRow> {
    let mut rows = nuisance_directions(&dataset.mean_over_runs(), dprediction_dlnp, dataset.axes);
    dataset.unseen_values().for_each(|i| rows[i] = DirectionRow::default());
    rows
}

/// U: one row \[∂f/∂ln p, shifts, rotations about the base\] per value in run layout, from the mean over runs \[m\].
pub(crate) fn nuisance_directions(mean_m: &[f64], dprediction_dlnp: &[f64], axes: usize) -> Vec<DirectionRow> {
    let mut rows = Vec::with_capacity(mean_m.len());
    for (place, dp) in mean_m.chunks_exact(axes).zip(dprediction_dlnp.chunks_exact(axes)) {
        let [x, y, z] = std::array::from_fn(|axis| place.get(axis).copied().unwrap_or(0.0));
        rows.push([dp[0], 1.0, 0.0, -y, 0.0, 0.0, z]);
        rows.push([dp[1], 0.0, 1.0, x, 0.0, -z, 0.0]);
        rows.extend(dp.get(2).map(|dp| [*dp, 0.0, 0.0, 0.0, 1.0, y, -x]));
    }
    rows
}

/// Least squares on those directions that the data can separate: U = Q T with orthonormal Q.
pub(crate) struct DirectionFit {
    columns: Vec<usize>,
    basis: Vec<Vec<f64>>,
    inverse: Vec<DirectionRow>,
}

impl DirectionFit {
    /// Orthogonalise (Gram–Schmidt, twice); drop directions that vanish or repeat others, and all of them if there
    /// are not more values than directions.
    pub(crate) fn new(directions: &[DirectionRow]) -> DirectionFit {
        let mut fit = DirectionFit { columns: Vec::new(), basis: Vec::new(), inverse: Vec::new() };
        for j in PRIORITY {
            fit.add(j, directions.iter().map(|row| row[j]).collect());
        }
        if directions.len() <= fit.columns.len() {
            fit = DirectionFit { columns: Vec::new(), basis: Vec::new(), inverse: Vec::new() };
        }
        fit
    }

    pub(crate) fn count(&self) -> usize {
        self.columns.len()
    }

    pub(crate) fn kept(&self, j: usize) -> bool {
        self.columns.contains(&j)
    }

    /// Coefficients of the directions (0 for dropped ones) and what remains.
    pub(crate) fn solve(&self, deviation: &[f64]) -> (DirectionRow, Vec<f64>) {
        let mut rest = deviation.to_vec();
        let mut coefficients = DirectionRow::default();
        for (q, inverse) in self.basis.iter().zip(&self.inverse) {
            let along = dot(q, &rest);
            rest.iter_mut().zip(q).for_each(|(r, q)| *r -= along * q);
            coefficients.iter_mut().zip(inverse).for_each(|(c, t)| *c += along * t);
        }
        (coefficients, rest)
    }

    /// Observed coefficient variances minus the part the camera noise explains, σ² (UᵀU)⁻¹_jj, not below zero.
    pub(crate) fn noise_free(&self, observed: DirectionRow, sigma2: f64) -> DirectionRow {
        std::array::from_fn(|j| {
            let camera: f64 = self.inverse.iter().map(|t| t[j] * t[j]).sum();
            (observed[j] - sigma2 * camera).max(0.0)
        })
    }

    /// Append direction `j`: q = (u − Σ t_i q_i)/‖·‖, and the column of T⁻¹ that belongs to q.
    fn add(&mut self, j: usize, mut column: Vec<f64>) {
        let length = dot(&column, &column).sqrt();
        if length == 0.0 {
            return;
        }
        let mut inverse = DirectionRow::default();
        inverse[j] = 1.0;
        for _ in 0..2 {
            for (q, known) in self.basis.iter().zip(&self.inverse) {
                let along = dot(q, &column);
                column.iter_mut().zip(q).for_each(|(u, q)| *u -= along * q);
                inverse.iter_mut().zip(known).for_each(|(t, k)| *t -= along * k);
            }
        }
        let new_part = dot(&column, &column).sqrt();
        if new_part <= SMALLEST_NEW_PART * length {
            return;
        }
        self.basis.push(column.iter().map(|u| u / new_part).collect());
        self.inverse.push(inverse.map(|t| t / new_part));
        self.columns.push(j);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn arc(values: usize) -> (Vec<f64>, Vec<f64>) {
        let xy: Vec<f64> = (0..values / 2).flat_map(|i| [0.03 * i as f64, 0.5 * (0.03 * i as f64).powi(2)]).collect();
        let dp = xy.chunks(2).flat_map(|p| [-0.02 * p[1], 0.3 * p[1] * (1.0 + p[0])]).collect();
        (xy, dp)
    }

    #[test]
    fn coefficients_of_a_known_combination_come_back() {
        let (xy, dp) = arc(24);
        let rows = nuisance_directions(&xy, &dp, 2);
        let truth = [0.02, 5e-4, -3e-4, 1e-3, 0.0, 0.0, 0.0];
        let deviation: Vec<f64> = rows.iter().map(|u| u.iter().zip(truth).map(|(u, c)| u * c).sum()).collect();
        let (found, rest) = DirectionFit::new(&rows).solve(&deviation);
        for (f, t) in found.iter().zip(truth) {
            assert!((f - t).abs() <= 1e-9 * t.abs(), "{f} {t}");
        }
        assert!(rest.iter().all(|r| r.abs() < 1e-15));
    }

    #[test]
    fn a_zero_pressure_direction_and_a_single_point_are_dropped() {
        let (xy, _) = arc(24);
        let fit = DirectionFit::new(&nuisance_directions(&xy, &[0.0; 24], 2));
        assert!(!fit.kept(0) && fit.count() == 3);
        let repeated: Vec<f64> = [0.3, 0.1].repeat(5);
        let fit = DirectionFit::new(&nuisance_directions(&repeated, &[0.0; 10], 2));
        assert_eq!(fit.count(), 2, "one point seen five times shows two directions only");
        assert_eq!(DirectionFit::new(&nuisance_directions(&[0.3, 0.1], &[0.0; 2], 2)).count(), 0);
    }
}
