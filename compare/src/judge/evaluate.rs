//! One call: everything the report states about a prediction and a dataset.

use crate::beside_mean::BesideMean;
use crate::error::CompareError;
use crate::metrics::{Metrics, metrics};
use crate::noise::NoiseModel;
use crate::noise_summary::NoiseSummary;
use crate::policy;
use crate::residuals::{ResidualMap, residual_map};
use crate::scaling::{ScalingCheck, scaling_of_data};
use crate::where_it_fails::{Statement, where_it_fails};
use data::Dataset;
use serde::Serialize;

/// Settings of [`evaluate`]; `Default` is what the command line uses.
#[derive(Debug, Clone, PartialEq)]
pub struct EvaluateOptions {
    /// One label per run if the robot was set up again between some runs; empty: all runs are one session.
    pub sessions: Vec<usize>,
    /// Camera noise of one coordinate \[m\], used only if there is a single run.
    pub sigma_m: Option<f64>,
    /// Parameters of the model that were fitted to these data.
    pub fitted_parameters: usize,
    /// Differences up to this are not called failures \[m\]; `None`: the larger of 0.15 mm and 0.5 % of d_max.
    pub tolerance_m: Option<f64>,
    /// Significance level over all statements together.
    pub alpha: f64,
    /// Bootstrap resamples of the accuracy; 0 for no interval.
    pub bootstrap_samples: usize,
    /// Seed of the bootstrap over runs.
    pub seed: u64,
}

impl Default for EvaluateOptions {
    fn default() -> Self {
        EvaluateOptions {
            sessions: Vec::new(),
            sigma_m: None,
            fitted_parameters: 0,
            tolerance_m: None,
            alpha: 0.01,
            bootstrap_samples: 1000,
            seed: 1,
        }
    }
}

/// The result of holding one prediction against one dataset; serialises without NaN or infinity.
#[derive(Debug, Clone, Serialize)]
pub struct Evaluation {
    /// Name of the dataset that the model is compared with.
    pub dataset: String,
    /// Actuator kind of the dataset, such as `epam`.
    pub actuator: String,
    /// The noise of the mean, in words and printed units.
    pub noise: NoiseSummary,
    /// Accuracy and its companions, per hold and overall.
    pub metrics: Metrics,
    /// Residuals marker × hold in millimetres and in units of noise.
    pub residual_map: ResidualMap,
    /// Where the model fails, in plain language; never empty.
    pub where_it_fails: Vec<Statement>,
    /// Whether the measured shapes depend on the pressures only through P/p.
    pub scaling: ScalingCheck,
    /// The noise model itself (SI), for further analysis.
    #[serde(skip)]
    pub noise_model: NoiseModel,
}

/// Hold a prediction against a dataset.
///
/// `prediction_m` is f \[m\] and `dprediction_dlnp` its derivative with respect to the logarithm of the actuator
/// pressure \[m\], both laid out like [`Dataset::run`]. If the derivative is not available pass zeros: the data's own is
/// left then, and run-to-run pressure scatter counts as camera noise where they do not show it.
///
/// # Errors
/// Empty data, arrays of the wrong length or not finite, impossible options.
pub fn evaluate(
    dataset: &Dataset,
    prediction_m: &[f64],
    dprediction_dlnp: &[f64],
    options: &EvaluateOptions,
) -> Result<Evaluation, CompareError> {
    check_level(options.alpha, options.tolerance_m)?;
    let noise = NoiseModel::estimate(dataset, dprediction_dlnp, &options.sessions, options.sigma_m)?;
    let c = BesideMean::new(dataset, &noise, prediction_m)?;
    let alpha = options.alpha;
    let metrics = metrics(&c, options.fitted_parameters, (options.bootstrap_samples, options.seed))?;
    let residual_map = residual_map(&c);
    let tolerance_m = options.tolerance_m.unwrap_or_else(|| policy::tolerance_m(c.d_max_m));
    let p_value = metrics.overall.p_value;
    let where_it_fails = where_it_fails(&c, &residual_map, p_value, alpha, tolerance_m);
    Ok(Evaluation {
        dataset: dataset.name.clone(),
        actuator: dataset.actuator.clone(),
        noise: NoiseSummary::of(&noise, &dataset.holds),
        metrics,
        residual_map,
        where_it_fails,
        scaling: scaling_of_data(dataset, &noise, alpha)?,
        noise_model: noise,
    })
}

pub(crate) fn check_level(alpha: f64, tolerance_m: Option<f64>) -> Result<(), CompareError> {
    let tolerance = tolerance_m.unwrap_or(0.0);
    if !(alpha > 0.0 && alpha < 1.0) {
        return Err(CompareError::bad_option("alpha", alpha, "the significance level is between 0 and 1"));
    }
    if !(tolerance >= 0.0 && tolerance.is_finite()) {
        return Err(CompareError::bad_option("tolerance_m", tolerance, "a length in metres, not negative"));
    }
    Ok(())
}
