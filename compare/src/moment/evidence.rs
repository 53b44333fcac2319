//! One evidence rule for every kind of hypothesis: how likely the measured numbers are under it, whatever its parameters.
//!
//! ```text
//! −2 ln Z = min over x of [ zᵀ Σ⁻¹ z + |x|² ] + ln |Σ| + ln |I + Jᵀ Σ⁻¹ J|        z = measured − predicted(x)
//! ```
//!
//! | symbol | meaning |
//! |---|---|
//! | x | parameters in units of their priors: x = (ln(value/centre))/sd for a size, x = (value − centre)/sd else |
//! | Σ | covariance of the measured numbers, and of what the hypothesis leaves open: the form of its law |
//! | J | derivative of the prediction by x |
//!
//! Laplace's rule with normal priors: a parameter that the data hold far better than its prior pays the logarithm of that ratio.

use nalgebra::{Cholesky, DMatrix, DVector, Dyn};

/// Prior of one parameter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Prior {
    /// Its middle.
    pub centre: f64,
    /// Its standard deviation: of the logarithm of a size, else of the value.
    pub sd: f64,
    /// It is a size: of one sign, and as likely three times larger as three times smaller.
    pub is_size: bool,
    /// Bounds of the value.
    pub bounds: [f64; 2],
}

impl Prior {
    /// Value of a coordinate.
    pub fn value(&self, x: f64) -> f64 {
        let value = if self.is_size { self.centre * (self.sd * x).exp() } else { self.centre + self.sd * x };
        value.clamp(self.bounds[0], self.bounds[1])
    }

    /// Coordinate of a value; of a size within a thousandth and a thousand times the centre.
    pub fn coordinate(&self, value: f64) -> f64 {
        match self.is_size {
            true => (value / self.centre).clamp(1e-3, 1e3).ln() / self.sd,
            false => (value - self.centre) / self.sd,
        }
    }
}

/// A weighed hypothesis.
#[derive(Debug, Clone, PartialEq)]
pub struct Weighed {
    /// −2 ln Z, up to a constant of the data.
    pub minus_two_ln: f64,
    /// Values of its parameters.
    pub values: Vec<f64>,
    /// zᵀ Σ⁻¹ z there.
    pub misfit: f64,
}

/// Numbers that a hypothesis predicts at parameter values; `None` where nothing balances.
pub type Predict<'a> = dyn Fn(&[f64]) -> Option<DVector<f64>> + 'a;
/// Covariance of the measured numbers under a hypothesis at parameter values.
pub type Covariance<'a> = dyn Fn(&[f64]) -> Option<DMatrix<f64>> + 'a;

/// Step of the derivatives, in standard deviations of the prior.
const STEP: f64 = 1e-4;
/// Gauss–Newton rounds with one covariance, and times that it is taken anew.
const ROUNDS: usize = 4;
const RENEWED: usize = 2;
/// Halvings of a step.
const HALVINGS: usize = 6;
/// A round that lowers the sum by less is the last.
const ENOUGH: f64 = 1e-3;

/// Weighs a hypothesis, from values to start at.
pub fn weigh(
    measured: &DVector<f64>,
    priors: &[Prior],
    start: &[f64],
    predict: &Predict,
    covariance: &Covariance,
) -> Option<Weighed> {
    let values = |x: &[f64]| -> Vec<f64> { priors.iter().zip(x).map(|(p, x)| p.value(*x)).collect() };
    let mut x: Vec<f64> = priors.iter().zip(start).map(|(p, v)| p.coordinate(*v)).collect();
    let mut told = None;
    for _ in 0..RENEWED {
        let root = covariance(&values(&x))?.cholesky()?;
        let residual = |x: &[f64]| Some(whitened(&root, &(predict(&values(x))? - measured)));
        let (at, information, misfit) = settle(x, &residual)?;
        let ln_det = 2.0 * root.l_dirty().diagonal().iter().map(|d| d.ln()).sum::<f64>();
        let odd: f64 = at.iter().map(|x| x * x).sum();
        let minus_two_ln = misfit + odd + ln_det + information;
        told = Some(Weighed { minus_two_ln, values: values(&at), misfit });
        x = at;
        if priors.is_empty() {
            break;
        }
    }
    told
}

/// The minimum of |r(x)|² + |x|², ln |I + JᵀJ| there, and |r|².
fn settle(mut x: Vec<f64>, residual: &dyn Fn(&[f64]) -> Option<DVector<f64>>) -> Option<(Vec<f64>, f64, f64)> {
    let count = x.len();
    let mut here = residual(&x)?;
    let total = |r: &DVector<f64>, x: &[f64]| r.norm_squared() + x.iter().map(|x| x * x).sum::<f64>();
    for round in 0..=ROUNDS {
        let mut jacobian = DMatrix::zeros(here.len(), count);
        for k in 0..count {
            let mut there = x.clone();
            there[k] += STEP;
            jacobian.set_column(k, &((residual(&there)? - &here) / STEP));
        }
        let normal = (jacobian.tr_mul(&jacobian) + DMatrix::identity(count, count)).cholesky()?;
        let ln_det = 2.0 * normal.l_dirty().diagonal().iter().map(|d| d.ln()).sum::<f64>();
        let step = normal.solve(&(jacobian.tr_mul(&here) + DVector::from_column_slice(&x)));
        let before = total(&here, &x);
        let moved = (0..HALVINGS).find_map(|halving| {
            let share = 0.5_f64.powi(halving as i32);
            let next: Vec<f64> = x.iter().zip(step.iter()).map(|(x, d)| x - share * d).collect();
            let its = residual(&next)?;
            (total(&its, &next) < before).then_some((next, its))
        });
        match moved {
            Some((next, its)) if round < ROUNDS && before - total(&its, &next) > ENOUGH => (x, here) = (next, its),
            _ => return Some((x, ln_det, here.norm_squared())),
        }
    }
    None
}

fn whitened(root: &Cholesky<f64, Dyn>, z: &DVector<f64>) -> DVector<f64> {
    root.l_dirty().solve_lower_triangular(z).unwrap_or_else(|| z.clone())
}

/// Shares of hypotheses from −2 ln Z and their prior weights.
pub fn shares(weighed: &[(f64, f64)]) -> Vec<f64> {
    let least = weighed.iter().map(|(m, _)| *m).fold(f64::INFINITY, f64::min);
    let raw: Vec<f64> = weighed.iter().map(|(m, weight)| weight * (-0.5 * (m - least)).exp()).collect();
    let sum: f64 = raw.iter().sum();
    raw.iter().map(|w| w / sum).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn identity(n: usize) -> DMatrix<f64> {
        DMatrix::identity(n, n)
    }

    /// A line through noise with a normal prior: Z is known in closed form.
    #[test]
    fn of_a_line_with_a_normal_prior_the_evidence_is_exact() {
        let t: Vec<f64> = (1..=6).map(f64::from).collect();
        let y = DVector::from_iterator(6, t.iter().map(|t| 0.3 * t + 0.1 * (5.0 * t).sin()));
        let prior = Prior { centre: 0.2, sd: 0.5, is_size: false, bounds: [f64::NEG_INFINITY, f64::INFINITY] };
        let line = DVector::from_vec(t);
        let told = weigh(&y, &[prior], &[0.0], &|v| Some(v[0] * &line), &|_| Some(identity(6) * 0.04)).unwrap();
        let all = identity(6) * 0.04 + &line * line.transpose() * 0.25;
        let away = &y - 0.2 * &line;
        let exact = away.dot(&all.clone().cholesky().unwrap().solve(&away)) + all.determinant().ln();
        assert!((told.minus_two_ln - exact).abs() < 1e-6, "{} {exact}", told.minus_two_ln);
    }

    #[test]
    fn a_size_that_is_not_needed_costs_and_one_that_is_pays() {
        let prior = Prior { centre: 1.0, sd: 3.0_f64.ln(), is_size: true, bounds: [0.0, 1e3] };
        let line = DVector::from_element(8, 1.0);
        let weight = |truth: f64| {
            let y = truth * &line;
            let cov = |_: &[f64]| Some(identity(8) * 0.01);
            let none = weigh(&y, &[], &[], &|_| Some(DVector::zeros(8)), &cov).unwrap().minus_two_ln;
            none - weigh(&y, &[prior], &[1.0], &|v| Some(v[0] * &line), &cov).unwrap().minus_two_ln
        };
        assert!(weight(0.0) < -2.0 && weight(1.0) > 100.0, "{} {}", weight(0.0), weight(1.0));
    }
}
