//! How well a prediction meets the measurements: the paper's accuracy and, always with it, its honest companions.
//!
//! The accuracy of Du Pasquier et al. 2023, a = 1 − mean over markers of ((y_FEA − y_EXP)/y_FEA)², has the **model** in
//! the denominator. It is undefined where the model does not move, rewards over-prediction (twice the truth scores
//! 0.75, half of it 0), ignores x, and hides errors by squaring: 94.3 % is a relative error of 23.9 %. It is therefore
//! printed exactly, and never alone.

use crate::accuracy::{Band, accuracy_band, paper_accuracy, relative_pct};
use crate::beside_mean::BesideMean;
use crate::error::CompareError;
use crate::fit::numbers::mean;
use crate::policy;
use crate::residuals::{HoldLabel, label};
use crate::stats::{f_tail, reported_p};
use serde::Serialize;

/// How model and measurement are paired in the accuracy; the paper leaves it open.
pub const PAIRING: &str = "same marker label, y from the base line (not from the first hold), mean over the samples of \
                           a hold, mean over runs, model in the denominator";

/// Metrics of one hold. Printed units; `None` where a number does not exist or the noise is unknown.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct HoldMetrics {
    /// Its pressures, and how it was reached.
    #[serde(flatten)]
    pub label: HoldLabel,
    /// The paper's accuracy a; `None` if the model's |y| is below 1e-9 m at a marker, and of
    /// markers with z.
    pub paper_accuracy: Option<f64>,
    /// Expected a of a perfect model at this noise, 1 − mean(var(ȳ_j)/y_j²).
    pub noise_ceiling: Option<f64>,
    /// 95 % bootstrap-over-runs interval of a; 3 runs or more.
    pub accuracy_interval: Option<[f64; 2]>,
    /// Root-mean-square relative error √(1 − a) \[%\].
    pub rms_relative_pct: Option<f64>,
    /// a over the markers with a measured |y| > max(5 mm, 5σ/√R).
    pub accuracy_far_markers: Option<f64>,
    /// How many markers `accuracy_far_markers` leaves out.
    pub markers_left_out: usize,
    /// Root-mean-square error of one coordinate over samples and markers \[mm\].
    pub rmse_mm: f64,
    /// Root-mean-square noise of one coordinate of the mean, run-level part included \[mm\].
    pub noise_floor_mm: Option<f64>,
    /// Error beyond noise, √max(0, mean (f − ȳ)² − noise variance of the mean) \[mm\].
    pub systematic_mm: Option<f64>,
    /// RMSE relative to the largest measured deflection of all holds \[%\].
    pub nrmse_pct: Option<f64>,
    /// y of the model minus y measured at the outermost marker that was seen \[mm\].
    pub tip_error_mm: f64,
    /// The same error for x, along the straight robot \[mm\].
    pub tip_error_x_mm: f64,
    /// The same for z, where the markers have it \[mm\].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tip_error_z_mm: Option<f64>,
    /// Length of the error vector of the outermost marker, in the plane with the sign of its y component \[mm\].
    pub tip_distance_mm: f64,
    /// χ²/dof of the whitened residuals of this hold.
    pub reduced_chi2: Option<f64>,
    /// Probability of a larger χ² if the model is right; 3 runs or more.
    pub p_value: Option<f64>,
}

/// Metrics over all holds together, in printed units.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct OverallMetrics {
    /// Mean of the paper's accuracy over the loading holds under pressure where it is defined.
    pub paper_accuracy: Option<f64>,
    /// How many holds that mean has.
    pub holds_in_accuracy: usize,
    /// Mean of the noise ceiling over the same holds.
    pub noise_ceiling: Option<f64>,
    /// 95 % bootstrap-over-runs interval of that accuracy; 3 runs or more.
    pub accuracy_interval: Option<[f64; 2]>,
    /// √(1 − a) of that accuracy \[%\].
    pub rms_relative_pct: Option<f64>,
    /// Root-mean-square error of one coordinate over everything, unloading included \[mm\].
    pub rmse_mm: f64,
    /// Root-mean-square noise of one coordinate of the mean \[mm\].
    pub noise_floor_mm: Option<f64>,
    /// Error beyond noise, √max(0, mean (f − ȳ)² − noise variance of the mean) \[mm\].
    pub systematic_mm: Option<f64>,
    /// Largest measured distance of a marker from the straight body, d_max \[mm\].
    pub d_max_mm: f64,
    /// RMSE over the largest measured distance d_max \[%\].
    pub nrmse_pct: Option<f64>,
    /// The tip error (y) that is largest in size, with its sign; in space the largest distance \[mm\].
    pub largest_tip_error_mm: f64,
    /// χ²/dof of all whitened residuals; `None` if the noise is unknown.
    pub reduced_chi2: Option<f64>,
    /// Its degrees of freedom: values minus fitted parameters.
    pub dof: usize,
    /// Probability of a larger χ² if the model is right; 3 runs or more. Never below 1e-6.
    pub p_value: Option<f64>,
}

/// Metrics of one comparison, per hold and over all.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Metrics {
    /// One entry per hold, in protocol order.
    pub holds: Vec<HoldMetrics>,
    /// Metrics over all holds and markers together.
    pub overall: OverallMetrics,
    /// Label of the marker furthest from the base.
    pub tip_marker: String,
    /// How model and measurement are paired.
    pub pairing: &'static str,
}

/// Compute every metric of a comparison. Parameters of the model `fitted` to these data cost degrees of freedom of the overall χ²;
/// the bootstrap has a number of resamples, 0 for no interval, and a seed: same seed, same interval.
///
/// # Errors
/// Only if the noise covariance of a hold cannot be decomposed.
pub fn metrics(c: &BesideMean, fitted: usize, bootstrap: (usize, u64)) -> Result<Metrics, CompareError> {
    let band = accuracy_band(c, bootstrap);
    let holds = (0..c.layout.holds).map(|h| hold_metrics(c, h, &band)).collect::<Result<Vec<_>, _>>()?;
    let overall = overall_metrics(c, &holds, &band, fitted);
    Ok(Metrics { holds, overall, tip_marker: c.dataset.markers[c.tip].name.clone(), pairing: PAIRING })
}

fn hold_metrics(c: &BesideMean, hold: usize, band: &Band) -> Result<HoldMetrics, CompareError> {
    let (model, measured) = c.deflections(hold);
    let accuracy = paper_accuracy(&model, &measured);
    let (far_model, far_measured) = far_markers(c, &model, &measured);
    let range = c.layout.hold_range(hold);
    let size = Size::of(c, range.clone());
    let [tip_x, tip_y, tip_z] = c.error(hold, c.tips[hold]);
    let values = c.noise.seen(range.clone());
    let fit = Goodness::of(c, &c.noise.whiten_range(&c.residual_m, range)?, values, 0);
    Ok(HoldMetrics {
        label: label(&c.dataset.holds[hold]),
        paper_accuracy: accuracy,
        noise_ceiling: noise_ceiling(c, hold, &model),
        accuracy_interval: band.holds[hold],
        rms_relative_pct: accuracy.map(relative_pct),
        accuracy_far_markers: paper_accuracy(&far_model, &far_measured),
        markers_left_out: model.len() - far_model.len(),
        rmse_mm: size.rmse_mm,
        noise_floor_mm: size.noise_floor_mm,
        systematic_mm: size.systematic_mm,
        nrmse_pct: size.nrmse_pct,
        tip_error_mm: 1e3 * tip_y,
        tip_error_x_mm: 1e3 * tip_x,
        tip_error_z_mm: c.is_spatial().then_some(1e3 * tip_z),
        tip_distance_mm: match c.is_spatial() {
            true => 1e3 * tip_x.hypot(tip_y).hypot(tip_z),
            false => 1e3 * tip_x.hypot(tip_y).copysign(tip_y),
        },
        reduced_chi2: fit.reduced_chi2,
        p_value: fit.p_value,
    })
}

fn overall_metrics(c: &BesideMean, holds: &[HoldMetrics], band: &Band, fitted: usize) -> OverallMetrics {
    let counted = || (0..holds.len()).filter(|&h| c.is_pressurised_loading(h)).map(|h| &holds[h]);
    let accuracies: Vec<f64> = counted().filter_map(|h| h.paper_accuracy).collect();
    let ceilings: Vec<f64> = counted().filter_map(|h| h.noise_ceiling).collect();
    let accuracy = mean_of(&accuracies);
    let size = Size::of(c, 0..c.residual_m.len());
    let values = c.noise.seen(0..c.residual_m.len());
    let fit = Goodness::of(c, &c.noise.whiten(&c.residual_m), values, fitted);
    let tips = holds.iter().map(|h| if c.is_spatial() { h.tip_distance_mm } else { h.tip_error_mm });
    OverallMetrics {
        paper_accuracy: accuracy,
        holds_in_accuracy: accuracies.len(),
        noise_ceiling: mean_of(&ceilings),
        accuracy_interval: band.overall,
        rms_relative_pct: accuracy.map(relative_pct),
        rmse_mm: size.rmse_mm,
        noise_floor_mm: size.noise_floor_mm,
        systematic_mm: size.systematic_mm,
        d_max_mm: 1e3 * c.d_max_m,
        nrmse_pct: size.nrmse_pct,
        largest_tip_error_mm: tips.fold(0.0, |worst: f64, e| if e.abs() > worst.abs() { e } else { worst }),
        reduced_chi2: fit.reduced_chi2,
        dof: fit.dof,
        p_value: fit.p_value,
    }
}

/// Expected accuracy of a perfect model: E a = 1 − mean(var(ȳ_j)/y_j²), with the noise of the hold mean of marker j.
fn noise_ceiling(c: &BesideMean, hold: usize, model_y: &[f64]) -> Option<f64> {
    let exact = paper_accuracy(model_y, model_y)?;
    let mut loss = 0.0;
    for (marker, y) in c.seen(hold).zip(model_y) {
        loss += c.noise.variance(&c.layout.mean_weights(hold, marker, 1))? / (y * y);
    }
    Some(exact - loss / model_y.len() as f64)
}

/// The markers that have measurably moved; chosen by the measurement, so every model is judged on the same ones.
fn far_markers(c: &BesideMean, model: &[f64], measured: &[f64]) -> (Vec<f64>, Vec<f64>) {
    let sd = c.noise.sigma_m.map_or(0.0, |s| s / (c.noise.runs as f64).sqrt());
    model.iter().zip(measured).filter(|(_, y)| policy::has_moved(**y, sd)).unzip()
}

struct Size {
    rmse_mm: f64,
    noise_floor_mm: Option<f64>,
    systematic_mm: Option<f64>,
    nrmse_pct: Option<f64>,
}

impl Size {
    fn of(c: &BesideMean, range: std::ops::Range<usize>) -> Size {
        let residual = &c.residual_m[range.clone()];
        let square = residual.iter().map(|r| r * r).sum::<f64>() / c.noise.seen(range.clone()).max(1) as f64;
        let noise = c.noise.mean_square(range);
        Size {
            rmse_mm: 1e3 * square.sqrt(),
            noise_floor_mm: noise.map(|v| 1e3 * v.sqrt()),
            systematic_mm: noise.map(|v| 1e3 * (square - v).max(0.0).sqrt()),
            nrmse_pct: (c.d_max_m > 1e-9).then(|| 100.0 * square.sqrt() / c.d_max_m),
        }
    }
}

/// Goodness of fit of whitened residuals: χ²/dof against F(dof, pure-error dof), because σ is itself estimated.
struct Goodness {
    reduced_chi2: Option<f64>,
    dof: usize,
    p_value: Option<f64>,
}

impl Goodness {
    fn of(c: &BesideMean, white: &[f64], values: usize, fitted: usize) -> Goodness {
        let dof = values.saturating_sub(fitted);
        let reduced = white.iter().map(|w| w * w).sum::<f64>() / dof.max(1) as f64;
        let reduced_chi2 = (dof > 0 && c.noise.is_known()).then_some(reduced);
        let tested = reduced_chi2.filter(|_| c.noise.gives_p_values());
        Goodness { reduced_chi2, dof, p_value: tested.map(|f| reported_p(f_tail(f, dof, c.noise.pure_error_dof))) }
    }
}

fn mean_of(values: &[f64]) -> Option<f64> {
    (!values.is_empty()).then(|| mean(values.iter().copied()))
}
