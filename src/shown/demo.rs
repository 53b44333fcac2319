//! The demonstration.

use super::held;
use crate::tables::{number, table};
use compare::bench::Held;
use compare::demo::{Demo, Told};
use compare::study::published::PublishedLadder;
use compare::study::{Comparison, Variant};
use models::Known;
use serde_json::{Value, json};

/// Published displacement against every rung.
fn published_text(ladders: &[PublishedLadder]) -> String {
    let head = ["actuator", "model", "how known", "model mm", "range mm", "measured mm", "difference mm"];
    let mut rows = Vec::new();
    for ladder in ladders {
        let measured = ladder.published.d_max_m * 1e3;
        for rung in &ladder.rungs {
            rows.push(vec![
                ladder.published.printed_name.clone(),
                rung.label.clone(),
                rung.known.word().into(),
                format!("{:.1}", rung.y_m * 1e3),
                rung.range_m.map_or("–".into(), |r| format!("{:.1}–{:.1}", r[0] * 1e3, r[1] * 1e3)),
                format!("{measured:.1}"),
                format!("{:+.1}", rung.y_m * 1e3 - measured),
            ]);
        }
    }
    table(&head, 3, rows)
}

/// What has just been computed, for readers.
pub fn text(told: Told) -> String {
    match told {
        Told::Measured(all) => {
            let short =
                |h: &Held| if h.rows.len() > 8 { format!("{}\n{}", h.title, held::closing(h)) } else { held::text(h) };
            format!("Measured things first\n{}", all.iter().map(|h| format!("\n{}", short(h))).collect::<String>())
        }
        Told::Published(ladders) => {
            let title = "Displacement at 30 kPa against the published measurement (du Pasquier et al. 2023)";
            format!("\n{title}\n{}", published_text(ladders))
        }
        Told::Sets(found) => sets_text(found),
        Told::Missing(d) => {
            let story: String = d.summary.iter().map(|s| format!("  - {s}\n")).collect();
            format!("\nWhat is missing in {} on {}:\n{story}", d.scenario, d.dataset)
        }
    }
}

fn sets_text(found: &[Comparison]) -> String {
    let head = ["data", "model", "how known", "paper acc. %", "beyond noise mm", "χ²/dof", "largest tip error mm"];
    let row = |c: &Comparison, v: &Variant| {
        let all = &v.evaluation.metrics.overall;
        let numbers = [
            number(all.paper_accuracy.map(|a| 100.0 * a), 1),
            number(all.systematic_mm, 2),
            number(all.reduced_chi2, 1),
            format!("{:+.1}", all.largest_tip_error_mm),
        ];
        [vec![c.dataset.name.clone(), v.label.clone(), v.known.word().into()], numbers.to_vec()].concat()
    };
    let rows = found.iter().flat_map(|c| c.variants.iter().map(move |v| row(c, v)));
    let fails = found.iter().filter_map(|c| Some((c, c.variants[0].evaluation.where_it_fails.first()?)));
    format!(
        "\nSynthetic marker sets: error beyond noise as effects are added\n{}\nWhere the bare models fail:\n{}",
        table(&head, 3, rows.collect()),
        fails.map(|(c, s)| format!("  - {}: {}\n", c.dataset.name, s.sentence)).collect::<String>()
    )
}

/// `ibr.demo`
pub fn to_json(demo: &Demo, small_run: Value) -> Value {
    let ladder = |l: &PublishedLadder| {
        let rungs: Vec<Value> = l
            .rungs
            .iter()
            .map(|r| {
                let range = r.range_m.map(|range| range.map(|v| v * 1e3));
                json!({"model": r.label, "how_known": r.known.word(), "y_mm": r.y_m * 1e3, "range_mm": range, "why": r.why})
            })
            .collect();
        json!({
            "actuator": l.published.kind, "measured_mm": l.published.d_max_m * 1e3, "measured_is": Known::Published.word(),
            "rungs": rungs, "calibrated_bending_nm2": l.calibrated_bending,
        })
    };
    let studies: Vec<Value> = demo
        .studies
        .iter()
        .map(|s| {
            let models: Vec<Value> = s
                .variants
                .iter()
                .map(
                    |v| json!({"model": v.label, "how_known": v.known.word(), "overall": v.evaluation.metrics.overall}),
                )
                .collect();
            json!({"data": s.dataset.name, "models": models, "where_it_fails": s.variants[0].evaluation.where_it_fails})
        })
        .collect();
    json!({
        "schema": "ibr.demo", "version": 1,
        "measured": demo.measured.iter().map(held::as_json).collect::<Vec<_>>(),
        "published": demo.ladders.iter().map(ladder).collect::<Vec<_>>(),
        "marker_sets": studies, "diagnosis": demo.diagnosed.diagnosis, "timings": demo.timings,
        "small_run": small_run,
    })
}
