//! Results → tables of a report, and CSV.

use compare::bench::{Held, HeldRow};
use compare::known::Known;
use compare::metrics::HoldMetrics;
use compare::study::Timing;
use compare::study::Variant;
use compare::study::published::PublishedLadder;
use report::page::{Align, Block, Column, Section, Table};

/// A number with `digits` decimals, or a dash where there is none.
pub(super) fn number(value: Option<f64>, digits: usize) -> String {
    value.map_or_else(|| "–".into(), |v| format!("{v:.digits$}"))
}

pub(super) fn column(heading: &str, unit: &str) -> Column {
    Column { heading: heading.into(), unit: unit.into(), align: Align::Right }
}

pub(super) fn words(heading: &str) -> Column {
    Column { heading: heading.into(), unit: String::new(), align: Align::Left }
}

/// `10 kPa load`; the body pressure is named if the data have several.
fn hold_name(hold: &HoldMetrics, several_bodies: bool) -> String {
    let again = if hold.occurrence > 0 { format!(" ({})", hold.occurrence + 1) } else { String::new() };
    let body = if several_bodies { format!(", body {:.0} kPa", hold.p_body_kpa) } else { String::new() };
    format!("{:.0} kPa {}{again}{body}", hold.p_act_kpa, hold.phase)
}

/// Real things beside their models: every row.
pub(super) fn measured(all: &[Held]) -> Section {
    let cells = |r: &HeldRow| {
        let off = r.off().map_or("–".into(), |o| format!("{:+.1}", 100.0 * o));
        vec![r.at.clone(), number(Some(r.measured), 2), number(r.model, 2), off, r.verdict()]
    };
    let table = |h: &Held| {
        let columns =
            vec![words(&h.quantity), column("measured", ""), column("model", ""), column("off", "%"), words("verdict")];
        let rows = h.rows.iter().map(cells).collect();
        Block::Table(Table { caption: h.title.clone(), columns, rows, how_column: None })
    };
    let notes = |h: &Held| h.notes.iter().map(|n| Block::Paragraph(n.clone())).collect::<Vec<_>>();
    let blocks = all.iter().flat_map(|h| [vec![table(h)], notes(h)].concat()).collect();
    Section { id: "measured".into(), heading: "Measured things first".into(), blocks }
}

/// The paper's accuracy per hold, and its companions.
pub(super) fn accuracy(variant: &Variant) -> Block {
    let holds = &variant.evaluation.metrics.holds;
    let several = holds.iter().any(|h| h.p_body_kpa != holds[0].p_body_kpa);
    let rows = holds.iter().map(|h| {
        vec![
            hold_name(h, several),
            number(h.paper_accuracy.map(|a| 100.0 * a), 1),
            number(h.noise_ceiling.map(|a| 100.0 * a), 1),
            number(h.rms_relative_pct, 1),
            number(Some(h.rmse_mm), 2),
            number(h.noise_floor_mm, 2),
            number(h.systematic_mm, 2),
            format!("{:+.2}", h.tip_error_mm),
            number(h.reduced_chi2, 1),
        ]
    });
    Block::Table(Table {
        caption: format!("{}: the paper's accuracy and, beside it, what it hides", variant.label),
        columns: vec![
            words("hold"),
            column("paper accuracy", "%"),
            column("noise ceiling", "%"),
            column("rms relative", "%"),
            column("RMSE", "mm"),
            column("noise floor", "mm"),
            column("beyond noise", "mm"),
            column("tip error", "mm"),
            column("χ²/dof", ""),
        ],
        rows: rows.collect(),
        how_column: None,
    })
}

/// All variants of a model on the same data.
pub(super) fn variants(variants: &[Variant]) -> Block {
    let rows = variants.iter().map(|v| {
        let all = &v.evaluation.metrics.overall;
        vec![
            v.label.clone(),
            v.known.word().to_string(),
            number(all.paper_accuracy.map(|a| 100.0 * a), 1),
            number(all.systematic_mm, 2),
            number(Some(all.rmse_mm), 2),
            format!("{:+.1}", all.largest_tip_error_mm),
            number(all.reduced_chi2, 1),
        ]
    });
    Block::Table(Table {
        caption: "Every model on these data. χ² counts run-to-run pressure scatter as noise only where the model reacts to pressure, so it and the error in mm can move apart".into(),
        columns: vec![
            words("model"),
            words("how known"),
            column("paper accuracy", "%"),
            column("beyond noise", "mm"),
            column("RMSE", "mm"),
            column("largest tip error", "mm"),
            column("χ²/dof", ""),
        ],
        rows: rows.collect(),
        how_column: Some(1),
    })
}

/// Every rung against the published displacement.
pub(super) fn published(ladders: &[PublishedLadder]) -> Block {
    let mut rows = Vec::new();
    for ladder in ladders {
        let measured = ladder.published.d_max_m * 1e3;
        let name = format!("{} ({measured:.1})", ladder.published.printed_name);
        for rung in &ladder.rungs {
            let range = rung.range_m.map_or("–".into(), |r| format!("{:.1}–{:.1}", r[0] * 1e3, r[1] * 1e3));
            rows.push(vec![
                name.clone(),
                rung.label.clone(),
                rung.known.word().into(),
                format!("{:.1}", rung.y_m * 1e3),
                range,
                format!("{:+.1}", rung.y_m * 1e3 - measured),
            ]);
        }
    }
    Block::Table(Table {
        caption: "Displacement at 30 kPa actuator and 2 kPa body pressure; measured: du Pasquier et al. 2023".into(),
        columns: vec![
            words("actuator (measured)"),
            words("model"),
            words("addition is"),
            column("model", "mm"),
            column("range", "mm"),
            column("difference", "mm"),
        ],
        rows,
        how_column: Some(2),
    })
}

/// Where the value of every addition comes from, once each.
pub(super) fn origins<'a>(additions: impl Iterator<Item = (&'a str, Known, &'a str)>) -> Block {
    let mut lines: Vec<String> = Vec::new();
    for (label, known, why) in additions {
        let line = format!("**{label}** ({}): {why}", known.word());
        if !lines.contains(&line) {
            lines.push(line);
        }
    }
    Block::List(lines)
}

/// Time and error of every model.
pub(super) fn timings(timings: &[Timing]) -> Block {
    let rows = timings.iter().map(|t| {
        vec![
            t.actuator.clone(),
            t.model.clone(),
            t.known.clone(),
            if t.prediction_us < 1e3 {
                format!("{:.2} µs", t.prediction_us)
            } else {
                format!("{:.1} s", t.prediction_us * 1e-6)
            },
            format!("{:+.1}", t.error_mm),
            format!("{:.1}", t.error_pct.abs()),
        ]
    });
    Block::Table(Table {
        caption: "Reduced model: one prediction, equilibrium and six markers, one core. Finite elements (FE): one run, processor time".into(),
        columns: vec![
            words("actuator"),
            words("model"),
            words("how known"),
            column("time", ""),
            column("error", "mm"),
            column("error", "%"),
        ],
        rows: rows.collect(),
        how_column: Some(2),
    })
}

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
