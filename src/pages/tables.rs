//! Results → CSV.

use ::compare::metrics::HoldMetrics;
use ::compare::study::Variant;

/// Metrics of every hold of every model, one row each; empty cells where a number does not exist.
pub(super) fn holds(variants: &[Variant]) -> data::Table {
    let rows: Vec<(&Variant, &HoldMetrics)> =
        variants.iter().flat_map(|v| v.evaluation.metrics.holds.iter().map(move |h| (v, h))).collect();
    let text = |name: &str, value: fn(&Variant, &HoldMetrics) -> String| {
        (name.to_string(), data::Column::Str(rows.iter().map(|(v, h)| value(v, h)).collect()))
    };
    let numbers = |name: &str, value: fn(&HoldMetrics) -> Option<f64>| {
        (name.to_string(), data::Column::F64(rows.iter().map(|(_, h)| value(h).unwrap_or(f64::NAN)).collect()))
    };
    data::Table {
        columns: vec![
            text("model", |v, _| v.label.clone()),
            text("how_known", |v, _| v.known.word().to_string()),
            numbers("p_act_kpa", |h| Some(h.p_act_kpa)),
            numbers("p_body_kpa", |h| Some(h.p_body_kpa)),
            text("phase", |_, h| h.phase.to_string()),
            numbers("paper_accuracy", |h| h.paper_accuracy),
            numbers("noise_ceiling", |h| h.noise_ceiling),
            numbers("rms_relative_pct", |h| h.rms_relative_pct),
            numbers("rmse_mm", |h| Some(h.rmse_mm)),
            numbers("noise_floor_mm", |h| h.noise_floor_mm),
            numbers("systematic_mm", |h| h.systematic_mm),
            numbers("tip_error_mm", |h| Some(h.tip_error_mm)),
            numbers("reduced_chi2", |h| h.reduced_chi2),
        ],
    }
}
