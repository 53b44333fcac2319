use super::figures::measured;
use ::compare::metrics::HoldMetrics;
use ::compare::residuals::ResidualCell;
use ::compare::study::{Comparison, Variant};
use data::{Column, Hold, Marker, Table};

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
            numbers("p_act_kpa", |h| Some(h.label.p_act_kpa)),
            numbers("p_body_kpa", |h| Some(h.label.p_body_kpa)),
            text("phase", |_, h| h.label.phase.to_string()),
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

struct ResidualRow<'a> {
    variant: &'a Variant,
    hold: &'a Hold,
    marker: &'a Marker,
    cell: ResidualCell,
    /// Mean of runs and samples \[mm\].
    measured_mm: [f64; 3],
}

/// Every marker at every hold of every model, one row each: where it was measured (mean of runs and samples) and predicted, along z where
/// the table has it, and the pressure of every supply channel. Cells that too few runs saw are left out; NaN where a number does not exist.
pub fn residuals(study: &Comparison) -> Table {
    let dataset = &study.dataset;
    let mut rows = Vec::new();
    for variant in &study.variants {
        for (h, hold) in dataset.holds.iter().enumerate() {
            for (m, marker) in dataset.markers.iter().enumerate().filter(|(m, _)| dataset.is_seen(h, *m)) {
                let cell = variant.evaluation.residual_map.cells[m][h];
                let measured_mm = measured(dataset, h, m).0.map(|v| v * 1e3);
                rows.push(ResidualRow { variant, hold, marker, cell, measured_mm });
            }
        }
    }
    let text = |name: &str, of: &dyn Fn(&ResidualRow) -> String| {
        (name.to_string(), Column::Str(rows.iter().map(of).collect()))
    };
    let numbers =
        |name: &str, of: &dyn Fn(&ResidualRow) -> f64| (name.to_string(), Column::F64(rows.iter().map(of).collect()));
    let mut columns = vec![
        text("model", &|row| row.variant.label.clone()),
        text("phase", &|row| row.hold.phase.word().into()),
        text("marker", &|row| row.marker.name.clone()),
        numbers("p_act_kpa", &|row| 1e-3 * row.hold.p_act_pa),
    ];
    columns
        .extend((0..dataset.more_channels()).map(|channel| {
            numbers(&format!("p_act_{}_kpa", channel + 1), &|row| 1e-3 * row.hold.more_act_pa[channel])
        }));
    columns.push(numbers("p_body_kpa", &|row| 1e-3 * row.hold.p_body_pa));
    columns.push(numbers("s_mm", &|row| row.marker.station_m.map_or(f64::NAN, |s| s * 1e3)));
    let axes = ["x", "y", "z"].into_iter().enumerate().take(dataset.axes);
    columns.extend(axes.clone().map(|(axis, name)| numbers(&format!("{name}_mm"), &|row| row.measured_mm[axis])));
    let predicted = |row: &ResidualRow, axis: usize| row.measured_mm[axis] + row.cell.axes()[axis].mm;
    columns.extend(axes.map(|(axis, name)| numbers(&format!("predicted_{name}_mm"), &|row| predicted(row, axis))));
    columns.push(numbers("error_mm", &|row| row.cell.norm_mm));
    columns.push(numbers("error_in_noise", &|row| row.cell.norm_in_noise.unwrap_or(f64::NAN)));
    Table { columns }
}
