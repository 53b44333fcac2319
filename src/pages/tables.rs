//! Results → CSV.

use super::figures::measured;
use ::compare::metrics::HoldMetrics;
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

/// Every marker at every hold of every model, one row each: where it was measured (mean of runs and samples) and predicted, along z where
/// the table has it, and the pressure of every supply channel. Cells that too few runs saw are left out; NaN where a number does not exist.
pub fn residuals(study: &Comparison) -> Table {
    let Comparison { dataset, variants, .. } = study;
    let cells = (0..dataset.holds.len()).flat_map(|h| (0..dataset.markers.len()).map(move |m| (h, m)));
    let cells = cells.filter(|(h, m)| dataset.is_seen(*h, *m));
    let places: Vec<(usize, usize, [f64; 3])> =
        cells.map(|(h, m)| (h, m, measured(dataset, h, m).0.map(|v| v * 1e3))).collect();
    let rows: Vec<(&Variant, &(usize, usize, [f64; 3]))> =
        variants.iter().flat_map(|v| places.iter().map(move |place| (v, place))).collect();
    let cell = |v: &'_ Variant, h: usize, m: usize| v.evaluation.residual_map.cells[m][h].clone();
    let (mut columns, holds) = (Vec::new(), &dataset.holds);
    let texts = |of: &dyn Fn(&Variant, usize, usize) -> String| {
        Column::Str(rows.iter().map(|(v, (h, m, _))| of(v, *h, *m)).collect())
    };
    columns.push(("model".to_string(), texts(&|v, _, _| v.label.clone())));
    columns.push(("phase".to_string(), texts(&|_, h, _| holds[h].phase.word().into())));
    columns.push(("marker".to_string(), texts(&|_, _, m| dataset.markers[m].name.clone())));
    let mut numbers = |name: String, of: &dyn Fn(&Variant, usize, usize, &[f64; 3]) -> f64| {
        columns.push((name, Column::F64(rows.iter().map(|(v, (h, m, at))| of(v, *h, *m, at)).collect())));
    };
    let kpa = |pa: f64| 1e-3 * pa;
    numbers("p_act_kpa".into(), &|_, h, _, _| kpa(holds[h].p_act_pa));
    for channel in 0..dataset.more_channels() {
        numbers(format!("p_act_{}_kpa", channel + 1), &|_, h, _, _| kpa(holds[h].more_act_pa[channel]));
    }
    numbers("p_body_kpa".into(), &|_, h, _, _| kpa(holds[h].p_body_pa));
    numbers("s_mm".into(), &|_, _, m, _| dataset.markers[m].station_m.map_or(f64::NAN, |s| s * 1e3));
    let axes = ["x", "y", "z"].iter().enumerate().take(dataset.axes);
    for (axis, name) in axes.clone() {
        numbers(format!("{name}_mm"), &|_, _, _, at| at[axis]);
    }
    for (axis, name) in axes {
        numbers(format!("predicted_{name}_mm"), &|v, h, m, at| at[axis] + cell(v, h, m).axes()[axis].mm);
    }
    numbers("error_mm".into(), &|v, h, m, _| cell(v, h, m).norm_mm);
    numbers("error_in_noise".into(), &|v, h, m, _| cell(v, h, m).norm_in_noise.unwrap_or(f64::NAN));
    Table { columns }
}
