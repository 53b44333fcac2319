//! Does the shape depend on the two pressures only through their ratio P/p?
//!
//! In the ideal model (no elastic or frictional resistance) the balance cos θ/θ = p π R³/(P L₀ W (R + d)) contains
//! actuator and body pressure only as P/p, so holds with the same ratio have the same shape. A difference that survives
//! at the same ratio is an effect with its own stiffness or pressure scale (fabric stretch, bending stiffness,
//! friction, tail tension, a regulator offset); collapse speaks for geometry alone.

use crate::error::CompareError;
use crate::fit::numbers::sort_by;
use crate::fit::whiten::Whitener;
use crate::layout::{Layout, Weights, apply};
use crate::noise::NoiseModel;
use crate::policy;
use crate::stats::{f_tail, holm, reported_p};
use crate::wording::{list, short};
use data::{Dataset, Hold, Phase};
use serde::Serialize;

/// Whether shapes at the same ratio of pressures agree.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum ScalingVerdict {
    /// Shapes at the same ratio agree to within noise.
    Collapses,
    /// Shapes at the same ratio differ.
    DoesNotCollapse,
    /// Matching holds exist but the noise is unknown or rests on fewer than 3 runs.
    Undecided,
    /// No two holds have the same ratio at different body pressures.
    CannotBeChecked,
}

/// Two holds at the same ratio and different body pressures.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ScalingPair {
    /// Index of the hold with the lower body pressure.
    pub low_hold: usize,
    /// Index of the hold with the higher body pressure.
    pub high_hold: usize,
    /// Ratio P/p, mean of the two.
    pub ratio: f64,
    /// Body pressures, low and high \[kPa\].
    pub p_body_kpa: [f64; 2],
    /// Largest difference of a marker position, high minus low body pressure, length \[mm\].
    pub largest_mm: f64,
    /// Root-mean-square difference of one coordinate \[mm\].
    pub rms_mm: f64,
    /// Outermost marker that both saw: y at the high body pressure minus y at the low one \[mm\].
    pub tip_mm: f64,
    /// χ²/dof of the difference; `None` if the noise is unknown.
    pub reduced_chi2: Option<f64>,
    /// p of the difference, Holm-corrected over pairs, never below 1e-6; 3 runs or more.
    pub p_corrected: Option<f64>,
}

/// The result of the scaling-law check.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ScalingCheck {
    /// Whether shapes depend on the pressures through their ratio alone.
    pub verdict: ScalingVerdict,
    /// In words, with what to measure if it cannot be checked.
    pub sentence: String,
    /// Pairs of holds at the same ratio that were compared.
    pub pairs: Vec<ScalingPair>,
}

/// Check measurements; `alpha` is the family-wise level, 0.01 if in doubt.
///
/// A ratio mismatch inside the tolerance and the run-to-run pressure scatter both count as noise along ∂f/∂ln p.
///
/// # Errors
/// Empty data, or a covariance that cannot be decomposed.
pub(crate) fn scaling_of_data(dataset: &Dataset, noise: &NoiseModel, alpha: f64) -> Result<ScalingCheck, CompareError> {
    let layout = Layout::of(dataset)?;
    let mean = dataset.mean_over_runs();
    let mut pairs = matching_pairs(dataset, &layout, &mean);
    if pairs.is_empty() {
        return Ok(cannot_be_checked(&dataset.holds));
    }
    let mut raw = Vec::new();
    for pair in &mut pairs {
        let chi2 = chi_square(dataset, &layout, noise, &mean, pair)?;
        let dof = layout.axes * seen_in_both(dataset, [pair.low_hold, pair.high_hold]).count();
        pair.reduced_chi2 = noise.is_known().then_some(chi2 / dof as f64);
        raw.push(f_tail(chi2 / dof as f64, dof, noise.pure_error_dof));
    }
    if noise.gives_p_values() {
        pairs.iter_mut().zip(holm(&raw)).for_each(|(pair, p)| pair.p_corrected = Some(reported_p(p)));
    }
    let differing = pairs.iter().filter(|p| p.p_corrected.is_some_and(|p| p < alpha)).count();
    let verdict = match (noise.gives_p_values(), differing) {
        (false, _) => ScalingVerdict::Undecided,
        (true, 0) => ScalingVerdict::Collapses,
        (true, _) => ScalingVerdict::DoesNotCollapse,
    };
    let sentence = data_sentence(verdict, &pairs, differing);
    Ok(ScalingCheck { verdict, sentence, pairs })
}

/// Pairs of holds that show one marker at least.
fn matching_pairs(dataset: &Dataset, layout: &Layout, mean: &[f64]) -> Vec<ScalingPair> {
    let holds = &dataset.holds;
    let unloading = |h: &Hold| h.phase == Phase::Unload;
    let means = layout.hold_means(mean);
    let mut pairs = Vec::new();
    for (i, a) in holds.iter().enumerate() {
        for (j, b) in holds.iter().enumerate().skip(i + 1) {
            let comparable = is_usable(a) && is_usable(b) && unloading(a) == unloading(b);
            let apart = comparable && policy::bodies_differ(a.p_body_pa, b.p_body_pa);
            if apart && policy::is_same_ratio(ratio(a), ratio(b)) && same_shares(a, b) {
                let ends = if a.p_body_pa < b.p_body_pa { [i, j] } else { [j, i] };
                pairs.extend(pair(dataset, layout, &means, ends));
            }
        }
    }
    pairs
}

fn pair(dataset: &Dataset, layout: &Layout, means: &[f64], ends: [usize; 2]) -> Option<ScalingPair> {
    let [low_hold, high_hold] = ends;
    let [low, high] = ends.map(|hold| &dataset.holds[hold]);
    let at = |hold: usize, marker: usize| (hold * layout.markers + marker) * layout.axes;
    let of = |marker: usize| -> [f64; 3] {
        let [high, low] = [high_hold, low_hold].map(|hold| at(hold, marker));
        std::array::from_fn(|k| if k < layout.axes { means[high + k] - means[low + k] } else { 0.0 })
    };
    let differences: Vec<[f64; 3]> = seen_in_both(dataset, ends).map(of).collect();
    let squares: f64 = differences.iter().flatten().map(|d| d * d).sum();
    Some(ScalingPair {
        low_hold,
        high_hold,
        ratio: 0.5 * (ratio(low) + ratio(high)),
        p_body_kpa: [1e-3 * low.p_body_pa, 1e-3 * high.p_body_pa],
        largest_mm: 1e3 * differences.iter().fold(0.0, |l: f64, [x, y, z]| l.max(x.hypot(*y).hypot(*z))),
        rms_mm: 1e3 * (squares / (layout.axes * differences.len()) as f64).sqrt(),
        tip_mm: 1e3 * differences.last()?[1],
        reduced_chi2: None,
        p_corrected: None,
    })
}

fn seen_in_both(dataset: &Dataset, holds: [usize; 2]) -> impl Iterator<Item = usize> + '_ {
    (0..dataset.markers.len()).filter(move |marker| holds.iter().all(|hold| dataset.is_seen(*hold, *marker)))
}

/// χ² of the shape difference: covariance (2σ²/samples I + ΔU diag(v) ΔUᵀ) of the mean, plus the ratio mismatch as a
/// variance along ∂f/∂ln p of the low hold.
fn chi_square(
    dataset: &Dataset,
    layout: &Layout,
    noise: &NoiseModel,
    mean: &[f64],
    pair: &ScalingPair,
) -> Result<f64, CompareError> {
    let mut difference = Vec::new();
    let mut rows = Vec::new();
    for marker in seen_in_both(dataset, [pair.low_hold, pair.high_hold]) {
        for axis in 0..layout.axes {
            let mut weights: Weights = layout.mean_weights(pair.high_hold, marker, axis);
            let low = layout.mean_weights(pair.low_hold, marker, axis);
            let slope: f64 = low.iter().map(|&(i, w)| w * noise.directions[i][0]).sum();
            weights.extend(low.iter().map(|&(i, w)| (i, -w)));
            let along = |k: usize| weights.iter().map(|&(i, w)| w * noise.directions[i][k]).sum::<f64>();
            difference.push(apply(&weights, mean));
            // Alignment cancels in a difference of holds; its column carries the ratio mismatch instead.
            rows.push([along(0), slope, 0.0, along(3), 0.0, along(5), along(6)]);
        }
    }
    let [pressure, _, _, rotation, _, about_x, about_y] = noise.test_variance;
    // Two holds are two settings of the regulator: each adds its own error, whatever the run-to-run scatter.
    let regulator = 2.0 * policy::SENSOR_SD[0].powi(2) / noise.runs as f64;
    let [low, high] = [pair.low_hold, pair.high_hold].map(|hold| ratio(&dataset.holds[hold]));
    let mismatch = (high / low).ln().powi(2) + regulator;
    let variances = [pressure, mismatch, 0.0, rotation, 0.0, about_x, about_y];
    let unit_m = (2.0 / layout.samples as f64).sqrt() * noise.unit_m();
    let white = Whitener::new(&rows, unit_m, &variances)?.whiten(&difference);
    Ok(white.iter().map(|w| w * w).sum())
}

fn data_sentence(verdict: ScalingVerdict, pairs: &[ScalingPair], differing: usize) -> String {
    let worst = pairs.iter().fold(0.0, |l: f64, p| l.max(p.largest_mm));
    let at = format!("P/p = {}", list(pairs.iter().map(|p| short(p.ratio))));
    match verdict {
        ScalingVerdict::Collapses => format!(
            "Shapes at the same P/p collapse to within noise ({at}; largest difference {worst:.1} mm): these data \
             need no effect with its own pressure or stiffness scale."
        ),
        ScalingVerdict::DoesNotCollapse => format!(
            "Shapes at the same P/p do not collapse: {differing} of {} pairs differ by more than noise ({at}; up to \
             {worst:.1} mm). Something has its own pressure or stiffness scale.",
            pairs.len()
        ),
        _ => format!(
            "Shapes at the same P/p differ by up to {worst:.1} mm ({at}); with fewer than 3 separate runs it cannot be \
             said whether that is noise."
        ),
    }
}

/// What to measure: the same ratios at twice the body pressure, or at half of it.
fn cannot_be_checked(holds: &[Hold]) -> ScalingCheck {
    let start = "The P/p scaling law cannot be checked with these data: no two holds have the same P/p at different \
    body pressures";
    let pressurised = holds.iter().filter(|hold| is_usable(hold));
    let reference = pressurised.clone().map(|h| h.p_body_pa).next();
    let sentence = match reference {
        None => format!("{start}; record holds with both pressures above zero."),
        Some(body) => {
            let same_body =
                pressurised.filter(|h| h.phase != Phase::Unload && !policy::bodies_differ(h.p_body_pa, body));
            let mut actuator: Vec<&Hold> = same_body.collect();
            sort_by(&mut actuator, |hold| hold.sum_act_pa());
            let scaled = |by: f64| {
                let word =
                    |hold: &&Hold| hold.channels_pa().map(|p| short(by * (1e-3 * p))).collect::<Vec<_>>().join("/");
                let mut words: Vec<String> = actuator.iter().map(word).collect();
                words.dedup();
                list(&words)
            };
            let kpa = 1e-3 * body;
            format!(
                "{start}; add holds at {} kPa body pressure with {} kPa, or at {} kPa with {} kPa.",
                short(2.0 * kpa),
                scaled(2.0),
                short(0.5 * kpa),
                scaled(0.5)
            )
        }
    };
    ScalingCheck { verdict: ScalingVerdict::CannotBeChecked, sentence, pairs: Vec::new() }
}

/// Whether both pressures are above zero.
fn is_usable(hold: &Hold) -> bool {
    hold.sum_act_pa() > policy::ZERO_PRESSURE_PA && hold.p_body_pa > policy::ZERO_PRESSURE_PA
}

fn ratio(hold: &Hold) -> f64 {
    hold.sum_act_pa() / hold.p_body_pa
}

fn same_shares(a: &Hold, b: &Hold) -> bool {
    let share = |hold: &Hold, p: f64| p / hold.sum_act_pa();
    a.channels_pa().zip(b.channels_pa()).all(|(p, q)| policy::is_same_ratio(1.0 + share(a, p), 1.0 + share(b, q)))
}
