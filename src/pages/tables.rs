//! Results → CSV.

use super::figures::measured;
use ::compare::metrics::HoldMetrics;
use ::compare::residuals::ResidualCell;
use ::compare::study::{Comparison, Variant};
use data::{Column, Table};

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

/// Every marker at every hold of every model, one row each: where it was measured (mean of runs and samples) and predicted. Cells
/// that too few runs saw are left out; NaN where a number does not exist.
pub fn residuals(study: &Comparison) -> Table {
    let dataset = &study.dataset;
    let mut texts = vec![Vec::new(); 3];
    let mut numbers = vec![Vec::new(); 9];
    for variant in &study.variants {
        let map = &variant.evaluation.residual_map;
        for (h, hold) in map.holds.iter().enumerate() {
            for (m, marker) in dataset.markers.iter().enumerate().filter(|(m, _)| map.cells[*m][h].seen) {
                let ResidualCell { x, y, norm_mm, norm_in_noise, .. } = map.cells[m][h];
                let [mx, my] = measured(dataset, h, m).0.map(|v| v * 1e3);
                let station = marker.station_m.map_or(f64::NAN, |s| s * 1e3);
                let in_noise = norm_in_noise.unwrap_or(f64::NAN);
                let row = [hold.p_act_kpa, hold.p_body_kpa, station, mx, my, mx + x.mm, my + y.mm, norm_mm, in_noise];
                let words = [&variant.label, hold.phase, &marker.name];
                texts.iter_mut().zip(words).for_each(|(column, word)| column.push(word.to_string()));
                numbers.iter_mut().zip(row).for_each(|(column, value)| column.push(value));
            }
        }
    }
    let names = ["model", "phase", "marker"].into_iter().zip(texts.into_iter().map(Column::Str));
    let more = ["p_act_kpa", "p_body_kpa", "s_mm", "x_mm", "y_mm", "predicted_x_mm", "predicted_y_mm"];
    let more = more.into_iter().chain(["error_mm", "error_in_noise"]).zip(numbers.into_iter().map(Column::F64));
    Table { columns: names.chain(more).map(|(name, column)| (name.to_string(), column)).collect() }
}
