//! Whitening of residuals whose covariance is s² I + U diag(v) Uᵀ with a few directions U.
//!
//! With U diag(√v) = Q T and T Tᵀ = E diag(w) Eᵀ, r_w = (r + B((1 + w/s²)^−½ − 1)Bᵀ r)/s, B = Q E, has covariance I.

use crate::directions::DirectionRow;
use crate::error::CompareError;
use crate::fit::least_squares::dot;
use nalgebra::{DMatrix, SymmetricEigen};

/// Rounds of the eigenvalue iteration over the directions; a handful suffice.
const EIGEN_ROUNDS: usize = 500;

pub(crate) const MISFIT_ROUNDS: usize = 3;

/// Eigenvalues and basis that whiten a residual, computed once for many residuals.
#[derive(Debug, Clone)]
pub struct Whitener {
    unit_m: f64,
    /// Eigenvalues w of T Tᵀ, one per column of the basis \[m²\].
    spread_m2: Vec<f64>,
    basis: Vec<Vec<f64>>,
}

impl Whitener {
    /// `directions` are the rows of U, `unit_m` is s \[m\] (positive), `variances` is v.
    pub fn new(directions: &[DirectionRow], unit_m: f64, variances: &DirectionRow) -> Result<Whitener, CompareError> {
        Self::with_columns(directions, unit_m, variances, &[])
    }

    /// The same with further columns of U, each times the square root of its variance.
    pub fn with_columns(
        directions: &[DirectionRow],
        unit_m: f64,
        variances: &DirectionRow,
        columns: &[Vec<f64>],
    ) -> Result<Whitener, CompareError> {
        // In the plane the others are zero.
        let shared = if directions.iter().all(|row| row[4..] == [0.0; 3]) { 4 } else { 7 };
        let scaled = DMatrix::from_fn(directions.len(), shared + columns.len(), |i, j| match j.checked_sub(shared) {
            None => directions[i][j] * variances[j].sqrt(),
            Some(further) => columns[further][i],
        });
        let qr = scaled.qr();
        let t = qr.r();
        let eigen = SymmetricEigen::try_new(&t * t.transpose(), f64::EPSILON, EIGEN_ROUNDS)
            .ok_or(CompareError::Decomposition)?;
        let basis = qr.q() * &eigen.eigenvectors;
        Ok(Whitener {
            unit_m,
            spread_m2: eigen.eigenvalues.iter().map(|w| w.max(0.0)).collect(),
            basis: basis.column_iter().map(|c| c.iter().copied().collect()).collect(),
        })
    }

    /// The same with a larger s², `factor` times the old one.
    pub fn wider(&self, factor: f64) -> Whitener {
        Whitener { unit_m: self.unit_m * factor.sqrt(), ..self.clone() }
    }

    /// Standard deviation s of the uncorrelated part \[m\].
    pub fn unit_m(&self) -> f64 {
        self.unit_m
    }

    /// The residuals \[m\] in units of their standard deviation, uncorrelated.
    pub fn whiten(&self, residual_m: &[f64]) -> Vec<f64> {
        let mut white = residual_m.to_vec();
        for (b, w) in self.basis.iter().zip(&self.spread_m2) {
            let shrink = (1.0 + w / (self.unit_m * self.unit_m)).powf(-0.5) - 1.0;
            let along = shrink * dot(b, residual_m);
            white.iter_mut().zip(b).for_each(|(w, b)| *w += along * b);
        }
        white.iter_mut().for_each(|w| *w /= self.unit_m);
        white
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// W Σ Wᵀ = I, column by column, for W taken from the whitener.
    fn largest_departure_from_identity(rows: &[DirectionRow], s: f64, v: &DirectionRow) -> f64 {
        let n = rows.len();
        let whitener = Whitener::new(rows, s, v).unwrap();
        let unit = |i: usize| (0..n).map(|k| f64::from(u8::from(k == i))).collect::<Vec<f64>>();
        let w = DMatrix::from_columns(&(0..n).map(|i| whitener.whiten(&unit(i)).into()).collect::<Vec<_>>());
        let u = DMatrix::from_fn(n, 7, |i, j| rows[i][j]);
        let sigma = DMatrix::identity(n, n) * (s * s) + &u * DMatrix::from_diagonal(&v.to_vec().into()) * u.transpose();
        (&w * sigma * w.transpose() - DMatrix::identity(n, n)).amax()
    }

    #[test]
    fn the_whitened_covariance_is_the_identity() {
        let rows: Vec<DirectionRow> = (0..12)
            .map(|i| {
                let x = 0.03 * f64::from(i);
                [x * x, f64::from(u8::from(i % 2 == 0)), f64::from(u8::from(i % 2 == 1)), x, 0.0, 0.0, 0.0]
            })
            .collect();
        assert!(
            largest_departure_from_identity(&rows, 1e-3, &[4e-4, 2.5e-7, 2.5e-7, 1e-6, 2.5e-7, 1e-6, 1e-6]) < 1e-10
        );
        let in_space: Vec<DirectionRow> =
            rows.iter().map(|[p, x, y, ..]| [*p, *x, *y, 0.3, p - y, 0.1 * x, p + 0.2]).collect();
        assert!(
            largest_departure_from_identity(&in_space, 1e-3, &[4e-4, 2.5e-7, 2.5e-7, 1e-6, 2.5e-7, 1e-6, 1e-6]) < 1e-10
        );
        assert!(largest_departure_from_identity(&rows, 1e-3, &DirectionRow::default()) < 1e-12);
        assert!(
            largest_departure_from_identity(&rows[..3], 1e-3, &[4e-4, 2.5e-7, 2.5e-7, 1e-6, 2.5e-7, 1e-6, 1e-6])
                < 1e-10
        );
    }
}
