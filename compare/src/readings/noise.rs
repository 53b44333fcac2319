//! The noise of a mean over runs, with the run as the unit.
//!
//! Samples and markers of one run share that run's errors: its pressure was a little off, the camera or the base was
//! set up a little differently. They are not independent repeats. The model of one run r is
//!
//! y_r = μ + U c_r + e_r,  e ~ N(0, σ² I),  c_r ~ N(0, diag v),  U = \[∂f/∂ln p, δx, δy, δφ·(−y, x)\]
//!
//! and, where markers have z, δz and the rotations about x and y too.
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | σ | camera noise of one coordinate | m |
//! | U | the nuisance directions: four in the plane, seven in space, one row per value | m per unit of c |
//! | v | run-to-run variances of pressure (relative), alignment x, y and rotation | 1, m², m², rad² |
//! | R, S, n | runs, sessions, values per run | |
//!
//! with ∂f/∂ln p of the model or of the data's own pressures (`data_slope`), whichever leaves the smaller σ: the model's is
//! wrong where the model is, and a wrong one makes scatter of one kind look like another,
//!
//! so that the mean has the covariance Σ_mean = σ²/R · I + U diag(v/R) Uᵀ. With the four coefficients fitted to the
//! deviations from the session mean, σ² is the remaining scatter with (R − S)(n − 4) degrees of freedom (n − 7 in space) and
//! v̂_j = mean over sessions of Σ_r c_rj²/(R_s − 1) − σ² (UᵀU)⁻¹_jj, never below zero, shifts pooled, and rotations too. In tests v̂ is
//! widened by (t_.9975/z_.9975)² because few runs estimate it badly, and is never below the sensor specification.
//! A full 4×4 sample covariance is rank deficient for 3 to 5 runs and raises false alarms; hence the diagonal.
//!
//! Single holds scatter, too (`readings/hold_scatter.rs`): with n holds, Σ_mean has Σ_k v_k/R Z_k Z_kᵀ more, and σ² is larger where the
//! samples of a hold do not scatter as its repeats do.
//!
//! With several sessions the mean cannot be better than the scatter between the session means b: v/R is replaced by
//! b Σ_s (R_s/R)² where that is larger.
//!
//! Validity: normal errors, σ the same at every pressure ([`NoiseModel::uneven_holds`] reports when it is not), scatter
//! small enough to be linear in U; the regulators of several supply channels err together. One run gives no noise at all: the status
//! reports it and no p-value is ever formed.

use crate::data_slope::data_slope;
use crate::directions::{DirectionFit, DirectionRow, ROTATIONS, SHIFTS, directions_of};
use crate::error::CompareError;
use crate::fit::numbers::{largest, least};
use crate::fit::whiten::Whitener;
use crate::hold_scatter::{HoldNoise, hold_scatter};
use crate::layout::{Layout, Weights, apply, single};
use crate::policy;
use crate::run_scatter::{between_sessions, pooled, rotations, session_groups, within_sessions};
use crate::stats::{f_tail, t_inflation};
use data::Dataset;
use serde::Serialize;

/// Smallest camera noise used \[m\]: identical runs would otherwise divide by zero; no camera resolves a micrometre
/// here.
pub const SMALLEST_SIGMA_M: f64 = 1e-6;

/// Unit of whitened residuals \[m\] where the noise is unknown: they then order models, nothing more.
pub const NOMINAL_SIGMA_M: f64 = 1e-3;

/// Where the noise level comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum NoiseStatus {
    /// Estimated from two or more runs.
    Measured,
    /// One run; σ was given by the user, run-to-run scatter is taken from the sensor specification.
    Supplied,
    /// One run and no σ: no noise floor, no ceiling, no significance.
    Unknown,
}

/// The noise of the mean over runs of one dataset. SI units; [`crate::noise_summary::NoiseSummary`] converts for
/// printing.
#[derive(Debug, Clone, Serialize)]
pub struct NoiseModel {
    /// Where the noise level comes from.
    pub status: NoiseStatus,
    /// Number of runs R that the mean is taken over.
    pub runs: usize,
    /// Number of sessions S, between which the robot was mounted again.
    pub sessions: usize,
    /// Camera noise σ of one coordinate of one sample \[m\]; `None` if unknown.
    pub sigma_m: Option<f64>,
    /// Degrees of freedom of σ²: (R − S)(n − directions); 0 if σ was not measured.
    pub pure_error_dof: usize,
    /// Run-to-run standard deviations of \[relative pressure, x \[m\], y \[m\], rotation about z \[rad\], z \[m\], rotations about x and
    /// y \[rad\]\] as estimated; `None`
    /// where the data cannot show it (one run, or a direction that vanishes or repeats another).
    pub run_sd: [Option<f64>; 7],
    /// Variances of the coefficients of the mean, best estimate: for noise floors and ceilings.
    pub mean_variance: DirectionRow,
    /// The same, widened for few runs and floored at the sensor specification: for tests.
    pub test_variance: DirectionRow,
    /// Camera noise of each hold on its own \[m\]; empty if not measured. Widely different values mean that σ is not
    /// one number: near a buckling pressure the robot itself scatters.
    pub hold_sigma_m: Vec<f64>,
    /// The runs repeat to within a micrometre: copies of one run, or data without noise.
    pub runs_identical: bool,
    /// U, one row per value in run layout.
    #[serde(skip)]
    pub directions: Vec<DirectionRow>,
    /// Scatter of single holds of one run.
    #[serde(skip)]
    pub per_hold: HoldNoise,
    /// What one standard deviation of each error of the gauge does to the mean \[m\], in run layout; empty unless the
    /// actuator's pressure was read there ([`NoiseModel::at_readings`]).
    #[serde(skip)]
    pub gauge_errors: Vec<Vec<f64>>,
    #[serde(skip)]
    whitener: Whitener,
}

impl NoiseModel {
    /// Estimate the noise of a dataset.
    ///
    /// `dprediction_dlnp` is the model's ∂f/∂ln p \[m\] in run layout (zeros if not available: the data's own is left then, where
    /// several pressures show it). `sessions` holds one label per run, or nothing. `sigma_m` is used only for a single run.
    ///
    /// # Errors
    /// Empty or non-finite data, wrong lengths, sessions without repeats, a σ that is not positive.
    pub fn estimate(
        dataset: &Dataset,
        dprediction_dlnp: &[f64],
        sessions: &[usize],
        sigma_m: Option<f64>,
    ) -> Result<NoiseModel, CompareError> {
        let layout = Layout::of(dataset)?;
        layout.check("the derivative with respect to ln p", dprediction_dlnp)?;
        let groups = session_groups(sessions, dataset.runs.len())?;
        let directions = directions_of(dataset, dprediction_dlnp);
        match (dataset.runs.len(), sigma_m) {
            (1, None) => Self::without_scatter(NoiseStatus::Unknown, None, directions),
            (1, Some(sigma)) if sigma.is_finite() && sigma > 0.0 => {
                Self::without_scatter(NoiseStatus::Supplied, Some(sigma), directions)
            }
            (1, Some(value)) => {
                Err(CompareError::bad_option("sigma_m", value, "the camera noise must be a positive length in metres"))
            }
            _ => {
                let modelled = Self::measured(dataset, &groups, directions)?;
                let Some(slope) = data_slope(dataset) else { return Ok(modelled) };
                let read = Self::measured(dataset, &groups, directions_of(dataset, &slope))?;
                Ok(if read.sigma_m < modelled.sigma_m { read } else { modelled })
            }
        }
    }

    /// The noise of a mean over `runs` runs of which nothing is estimated: σ \[m\], and the run-to-run standard deviations of
    /// pressure, x, y and rotation.
    #[cfg(test)]
    pub(crate) fn known(
        dataset: &Dataset,
        dprediction_dlnp: &[f64],
        runs: usize,
        sigma_m: f64,
        [pressure, x, y, turn]: [f64; 4],
    ) -> Result<NoiseModel, CompareError> {
        Layout::of(dataset)?.check("the derivative with respect to ln p", dprediction_dlnp)?;
        let directions = directions_of(dataset, dprediction_dlnp);
        let run_sd = [pressure, x, y, turn, y, turn, turn];
        let variance = run_sd.map(|sd| sd * sd / runs.max(1) as f64);
        let whitener = Whitener::new(&directions, sigma_m / (runs.max(1) as f64).sqrt(), &variance)?;
        let plain = Self::without_scatter(NoiseStatus::Supplied, Some(sigma_m), directions)?;
        let run_sd = run_sd.map(Some);
        Ok(NoiseModel { runs, run_sd, mean_variance: variance, test_variance: variance, whitener, ..plain })
    }

    /// The same where predictions are made at what a gauge at the actuator read: scatter of the pressure between runs is in
    /// the readings, and the errors of the gauge take its place.
    ///
    /// # Errors
    /// If the eigenproblem does not converge.
    pub fn at_readings(mut self, gauge_errors: Vec<Vec<f64>>) -> Result<NoiseModel, CompareError> {
        self.gauge_errors = gauge_errors;
        self.per_hold.drop_pressure();
        (self.mean_variance[0], self.test_variance[0]) = (0.0, 0.0);
        self.whitener = self.whitener_of(&single(0..self.directions.len()))?;
        Ok(self)
    }

    /// The same with a larger variance of single values, `factor` times the old one, for the fit of a model that misses the data.
    pub fn wider(&self, factor: f64) -> NoiseModel {
        NoiseModel { whitener: self.whitener.wider(factor), ..self.clone() }
    }

    /// Whitens sums of values, in tests; of every sum the squares of its weights have the same total, and no value is in two.
    ///
    /// # Errors
    /// If the eigenproblem does not converge.
    pub fn whitener_of(&self, sums: &[Weights]) -> Result<Whitener, CompareError> {
        let direction = |w: &Weights| -> DirectionRow {
            std::array::from_fn(|j| w.iter().map(|(i, share)| share * self.directions[*i][j]).sum())
        };
        let along = |column: &Vec<f64>| sums.iter().map(|w| apply(w, column)).collect();
        let rows: Vec<DirectionRow> = sums.iter().map(direction).collect();
        let mut columns: Vec<Vec<f64>> = self.gauge_errors.iter().map(along).collect();
        for (column, sd) in self.per_hold.of_mean(self.runs) {
            columns.push(sums.iter().map(|w| sd * column.along(w.iter().copied())).collect());
        }
        let squares = sums.first().map_or(1.0, |w| w.iter().map(|(_, share)| share * share).sum::<f64>());
        Whitener::with_columns(&rows, self.unit_m() * squares.sqrt(), &self.test_variance, &columns)
    }

    /// False for a single run without a given σ.
    pub fn is_known(&self) -> bool {
        self.sigma_m.is_some()
    }

    /// True if p-values may be formed: measured from at least [`crate::policy::FEWEST_RUNS`] runs that are not copies of each other.
    pub fn gives_p_values(&self) -> bool {
        self.status == NoiseStatus::Measured && self.runs >= policy::FEWEST_RUNS && !self.runs_identical
    }

    /// Residuals \[m\] in run layout in units of the noise of the mean: unit variance and uncorrelated if the model is
    /// right. Where the noise is unknown the unit is [`NOMINAL_SIGMA_M`]; use the result for ranking only.
    pub fn whiten(&self, residual_m: &[f64]) -> Vec<f64> {
        self.whitener.whiten(residual_m)
    }

    /// Whitened residuals of some of the values, with their own covariance; `range` indexes the run layout.
    ///
    /// # Errors
    /// If the eigenproblem does not converge.
    pub fn whiten_range(&self, residual_m: &[f64], range: std::ops::Range<usize>) -> Result<Vec<f64>, CompareError> {
        Ok(self.whitener_of(&single(range.clone()))?.whiten(&residual_m[range]))
    }

    /// Standard deviation \[unit of the functional\] of wᵀȳ for tests; `None` if unknown.
    pub fn test_sd(&self, weights: &[(usize, f64)]) -> Option<f64> {
        let held = self.per_hold.variance_of_mean(weights, &self.per_hold.test_variance, self.runs);
        self.functional_variance(weights, &self.test_variance).map(|v| (v + held).sqrt())
    }

    /// Best estimate of the variance of wᵀȳ; `None` if unknown.
    pub fn variance(&self, weights: &[(usize, f64)]) -> Option<f64> {
        let held = self.per_hold.variance_of_mean(weights, &self.per_hold.variance(), self.runs);
        self.functional_variance(weights, &self.mean_variance).map(|v| v + held)
    }

    /// Mean of the diagonal of Σ_mean \[m²\] over some values in run layout, best estimate; `None` if unknown.
    pub fn mean_square(&self, range: std::ops::Range<usize>) -> Option<f64> {
        let rows = &self.directions[range.clone()];
        let shared: f64 = rows.iter().map(|u| quadratic(u, &self.mean_variance)).sum();
        let read: f64 = self.gauge_errors.iter().flat_map(|c| &c[range.clone()]).map(|e| e * e).sum();
        let held = self.per_hold.square_of_mean(&range, self.runs);
        Some(self.sigma_m?.powi(2) / self.runs as f64 + (shared + read + held) / self.seen(range).max(1) as f64)
    }

    /// Values that enough runs saw: an alignment error moves each of them, so that its row of U is not zero.
    pub fn seen(&self, range: std::ops::Range<usize>) -> usize {
        self.directions[range].iter().filter(|u| **u != DirectionRow::default()).count()
    }

    /// Values of a whole run that enough runs saw.
    pub fn all_seen(&self) -> usize {
        self.seen(0..self.directions.len())
    }

    /// The noisiest and the quietest hold, if their scatter differs by more than chance (F test, p < 0.01 after
    /// correction for all pairs) and by more than half: significance is then overstated at the noisiest hold.
    pub fn uneven_holds(&self) -> Option<(usize, usize)> {
        let sigma = |h: &usize| self.hold_sigma_m[*h];
        let holds = self.hold_sigma_m.len();
        let (noisiest, quietest) = (largest(0..holds, sigma)?, least(0..holds, sigma)?);
        let quotient = sigma(&noisiest) / sigma(&quietest).max(SMALLEST_SIGMA_M);
        let dof = self.pure_error_dof / holds;
        let p = (holds * (holds - 1)) as f64 * f_tail(quotient * quotient, dof, dof);
        policy::is_uneven(p, quotient).then_some((noisiest, quietest))
    }

    /// Standard deviation of the independent part of one value of the mean, σ/√R \[m\].
    pub fn unit_m(&self) -> f64 {
        self.sigma_m.unwrap_or(NOMINAL_SIGMA_M) / (self.runs as f64).sqrt()
    }

    fn functional_variance(&self, weights: &[(usize, f64)], variances: &DirectionRow) -> Option<f64> {
        let mut projected = DirectionRow::default();
        for &(i, w) in weights {
            for (p, u) in projected.iter_mut().zip(&self.directions[i]) {
                *p += w * u;
            }
        }
        let squares: f64 = weights.iter().map(|(_, w)| w * w).sum();
        let read: f64 = self.gauge_errors.iter().map(|column| apply(weights, column).powi(2)).sum();
        Some(self.sigma_m?.powi(2) / self.runs as f64 * squares + quadratic(&projected, variances) + read)
    }

    fn without_scatter(
        status: NoiseStatus,
        sigma_m: Option<f64>,
        directions: Vec<DirectionRow>,
    ) -> Result<NoiseModel, CompareError> {
        let specification = policy::SENSOR_SD.map(|sd| sd * sd);
        let sigma_m = sigma_m.map(|s| s.max(SMALLEST_SIGMA_M));
        let whitener = Whitener::new(&directions, sigma_m.unwrap_or(NOMINAL_SIGMA_M), &specification)?;
        Ok(NoiseModel {
            status,
            runs: 1,
            sessions: 1,
            sigma_m,
            pure_error_dof: 0,
            run_sd: [None; 7],
            mean_variance: specification,
            test_variance: specification,
            hold_sigma_m: Vec::new(),
            runs_identical: false,
            directions,
            per_hold: HoldNoise::default(),
            gauge_errors: Vec::new(),
            whitener,
        })
    }

    fn measured(
        dataset: &Dataset,
        groups: &[Vec<usize>],
        directions: Vec<DirectionRow>,
    ) -> Result<NoiseModel, CompareError> {
        let fit = DirectionFit::new(&directions);
        let within = within_sessions(dataset, groups, &fit);
        let sigma2 = within.sigma2.max(SMALLEST_SIGMA_M.powi(2));
        let per_hold = hold_scatter(dataset, groups, &directions, sigma2, within.dof);
        let (sigma2, sigma_dof) = per_hold.of_samples(dataset.samples_per_hold).unwrap_or((sigma2, within.dof));
        let (runs, axes) = (dataset.runs.len(), dataset.axes);
        let run_variance = pooled(fit.noise_free(within.coefficient_variance, sigma2), axes);
        let between = pooled(between_sessions(dataset, groups, &fit, sigma2), axes);
        let dof = runs - groups.len();
        let mut mean_variance = DirectionRow::default();
        let mut test_variance = DirectionRow::default();
        for j in 0..mean_variance.len() {
            let estimates = match j {
                j if SHIFTS.contains(&j) => axes * dof,
                j if ROTATIONS.contains(&j) => rotations(axes).len() * dof,
                _ => dof,
            };
            let widened = (run_variance[j] * t_inflation(estimates)).max(policy::SENSOR_SD[j].powi(2));
            mean_variance[j] = (run_variance[j] / runs as f64).max(between[j]);
            test_variance[j] = (widened / runs as f64).max(between[j]);
        }
        let unit_m = (sigma2 / runs as f64).sqrt();
        let held = per_hold.of_mean(runs).map(|(column, sd)| column.spread(directions.len(), sd));
        let held: Vec<Vec<f64>> = held.collect();
        let whitener = Whitener::with_columns(&directions, unit_m, &test_variance, &held)?;
        Ok(NoiseModel {
            status: NoiseStatus::Measured,
            runs,
            sessions: groups.len(),
            sigma_m: Some(sigma2.sqrt()),
            pure_error_dof: sigma_dof,
            run_sd: std::array::from_fn(|j| fit.kept(j).then(|| run_variance[j].sqrt())),
            mean_variance,
            test_variance,
            hold_sigma_m: within.hold_sigma2.iter().map(|s| s.sqrt()).collect(),
            runs_identical: within.sigma2 < SMALLEST_SIGMA_M.powi(2),
            directions,
            per_hold,
            gauge_errors: Vec::new(),
            whitener,
        })
    }
}

fn quadratic(vector: &DirectionRow, variances: &DirectionRow) -> f64 {
    vector.iter().zip(variances).map(|(u, v)| u * u * v).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tests::synthetic::{CAMERA, SyntheticRobot};

    /// What one run cannot show is as the sensors are specified: 0.3 % of the pressure, 0.1 mm, 0.5 mrad.
    #[test]
    fn one_run_scatters_as_its_sensors_are_specified() {
        let robot = SyntheticRobot::paper();
        let noise = NoiseModel::estimate(&robot.measured(1, CAMERA, 1), &robot.slope(), &[], Some(1e-3)).unwrap();
        for (variance, sd) in noise.test_variance.iter().zip([0.003, 1e-4, 1e-4, 5e-4, 1e-4, 5e-4, 5e-4]) {
            assert!((variance.sqrt() / sd - 1.0).abs() < 1e-12, "{:?}", noise.test_variance);
        }
    }
}
