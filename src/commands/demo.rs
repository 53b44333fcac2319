//! `ibr demo`

use super::tables::{number, table};
use super::told::held;
use super::{Context, Outcome};
use crate::failure::Failure;
use crate::output::{check_folder, machine, program, today, write_files};
use compare::known::Known;
use compare::study::demo::{Demo, demo};
use compare::study::published::PublishedLadder;
use fem::session::{FeRun, Settings, Source, heights_mm, simulate};
use ibr::pages::{Imprint, demo_page};
use serde_json::{Value, json};
use std::ops::ControlFlow;
use std::path::Path;

pub fn run(folder: &Path, context: &mut Context) -> Result<Outcome, Failure> {
    check_folder(folder)?;
    let computed = demo(&mut |what| (context.progress)(what, Some(0.1)))?;
    let small = small_run(context)?;
    let imprint = Imprint { program: program(), date: today(), machine: machine() };
    let mut files = demo_page(&computed, &imprint, &mut |what| (context.progress)(what, Some(0.5)))?;
    let picture = small.files.iter().find(|(name, _)| name == "side.png");
    files.files.splice(0..0, picture.map(|(_, png)| ("small_run.png".to_string(), png.clone())));
    write_files(folder, &files, &[], context)?;
    let mut outcome = Outcome::new(text(&computed) + &small_text(&small), to_json(&computed, &small));
    outcome.notes.push(format!("report: {}", folder.join("report.html").display()));
    Ok(outcome)
}

/// The run that is made here and now: a little coarse and fast, to be quick.
const SMALL: [(&str, &str); 4] = [
    ("actuator_mesh_mm", "4"),
    ("body_ramp_s", "0.02"),
    ("actuator_ramp_s", "0.18"),
    ("pressures_kpa", "[10, 20, 30]"),
];

fn small_run(context: &mut Context) -> Result<FeRun, Failure> {
    let changes = SMALL.map(|(key, value)| (key.to_string(), value.to_string()));
    let robot = Source::new("epam", models::shipped("epam").unwrap_or_default()).with(&changes)?;
    Ok(simulate(&robot, &Settings::default(), &mut |_, share| {
        (context.progress)("a small finite element run", share);
        ControlFlow::Continue(())
    })?)
}

fn small_text(small: &FeRun) -> String {
    let tips = small.readings().iter().filter(|r| r.actuator_pa > 0.0);
    let tips: Vec<String> =
        tips.map(|r| format!("{:.1} mm at {:.0} kPa", heights_mm(r)[1], r.actuator_pa * 1e-3)).collect();
    format!(
        "\nA finite element run of the ePAM made just now, {} elements, 4 mm at the actuator, {:.1} CPU s: tip {}; {} buckling \
         events, energy balance missing {:.3} %\n",
        small.summary.elements,
        small.cost.cpu_s,
        tips.join(", "),
        snaps(small),
        100.0 * small.summary.residual_share
    )
}

fn snaps(small: &FeRun) -> usize {
    small.summary.robot.as_ref().map_or(0, |robot| robot.snaps.len())
}

/// Published displacement against every rung.
pub fn published_text(ladders: &[PublishedLadder]) -> String {
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

fn text(demo: &Demo) -> String {
    let mut out = String::from("Measured things first\n");
    demo.measured.iter().for_each(|h| {
        out.push('\n');
        out.push_str(&if h.rows.len() > 8 { format!("{}\n{}", h.title, held::closing(h)) } else { held::text(h) });
    });
    out.push_str("\nDisplacement at 30 kPa against the published measurement (du Pasquier et al. 2023)\n");
    out.push_str(&published_text(&demo.ladders));
    out.push_str("\nSynthetic marker sets: error beyond noise as effects are added\n");
    let head = ["data", "model", "how known", "paper acc. %", "beyond noise mm", "χ²/dof", "largest tip error mm"];
    let mut rows = Vec::new();
    for study in &demo.studies {
        for v in &study.variants {
            let all = &v.evaluation.metrics.overall;
            rows.push(vec![
                study.dataset.name.clone(),
                v.label.clone(),
                v.known.word().into(),
                number(all.paper_accuracy.map(|a| 100.0 * a), 1),
                number(all.systematic_mm, 2),
                number(all.reduced_chi2, 1),
                format!("{:+.1}", all.largest_tip_error_mm),
            ]);
        }
    }
    out.push_str(&table(&head, 3, rows));
    let d = &demo.diagnosed.diagnosis;
    out.push_str(&format!("\nWhat is missing in {} on {}:\n", d.scenario, d.dataset));
    d.summary.iter().for_each(|s| out.push_str(&format!("  - {s}\n")));
    out.push_str("\nWhere the bare models fail:\n");
    for study in &demo.studies {
        if let Some(statement) = study.variants[0].evaluation.where_it_fails.first() {
            out.push_str(&format!("  - {}: {}\n", study.dataset.name, statement.sentence));
        }
    }
    out
}

fn to_json(demo: &Demo, small: &FeRun) -> Value {
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
        "small_run": {
            "elements": small.summary.elements, "cpu_s": small.cost.cpu_s, "residual_share": small.summary.residual_share,
            "buckling_events": snaps(small), "readings": small.readings(),
        },
    })
}
