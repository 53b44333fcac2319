//! `ibr simulate ROBOT --uncertain`: a hypercube over everything that nobody measured.

use super::batch::{interrupted, one};
use super::input::Named;
use super::plan::Variation;
use super::robot;
use super::single::Manner;
use super::summary::Summary;
use crate::commands::tables::table;
use crate::commands::together::{shared, together};
use crate::commands::{Context, Outcome};
use crate::failure::Failure;
use compare::study::uncertain::{Member, MemberState, Uncertain, Varied, Weight};
use fem::robot::RobotRun;
use serde_json::json;

/// Runs what is missing and tells quantiles and weights.
pub fn run(
    base: &Named,
    cases: &[Variation],
    (numbers, cube, variant): (&[Varied], &[Vec<f64>], &[String]),
    manner: &Manner,
    context: &mut Context,
) -> Result<Outcome, Failure> {
    let loaded: Vec<Named> = cases.iter().map(|case| base.with(&case.changes)).collect::<Result<_, _>>()?;
    let (workers, threads) = shared(manner.threads, cases.len());
    let each = Manner { threads, frames: false, ..manner.clone() };
    let found = together(cases.len(), workers, context, &|job, inner: &mut Context| {
        let what = format!("{} of {}", job + 1, cases.len());
        match one(&loaded[job], &cases[job].label, &each, &what, inner) {
            Ok(done) => Ok(done.map(|finished| Ok(finished.summary))),
            // A robot that cannot be run says so in its row; the others go on.
            Err(Failure::Stopped { error, .. }) => Ok(Some(Err(error.to_string()))),
            Err(other) => Err(other),
        }
    })?;
    let summaries = match found {
        Ok(found) => found,
        Err(done) => return Ok(interrupted(done, cases.len(), &manner.folder)),
    };
    let (scenario, robot_run) = base.robot_run()?;
    let members = summaries.into_iter().zip(cube).map(|(summary, shares)| member(summary, shares)).collect();
    let all = Uncertain {
        engine: fem::ENGINE,
        actuator: scenario.actuator.kind.name.into(),
        scenario: scenario.name.clone(),
        variant: variant.join(" "),
        mesh_mm: mesh_mm(&robot_run),
        body_kpa: robot::rounded(scenario.p_body_pa * 1e-3),
        stations_mm: scenario.markers_m.iter().map(|s| robot::rounded(s * 1e3)).collect(),
        numbers: numbers.to_vec(),
        members,
    };
    outcome(&all, manner)
}

fn mesh_mm(run: &RobotRun) -> [f64; 2] {
    [run.settings.body_size_m, run.settings.actuator_size_m].map(|m| robot::rounded(m * 1e3))
}

fn member(summary: Result<Summary, String>, shares: &[f64]) -> Member {
    // Five digits, as a camera will never see them.
    let short = |m: f64| format!("{:.4e}", m * 1e3).parse().unwrap_or(f64::NAN);
    let state = |r: &fem::robot::Reading| MemberState {
        actuator_kpa: robot::rounded(r.actuator_pa * 1e-3),
        // The last station is the tip.
        moved_mm: r.moved_m.iter().rev().skip(1).rev().map(|d| [short(d[0]), short(d[1])]).collect(),
    };
    let rounded = shares.iter().map(|s| format!("{s:.5}").parse().unwrap_or(*s)).collect();
    match summary {
        Ok(summary) => {
            let readings = summary.robot.iter().flat_map(|robot| &robot.readings);
            let states = readings.filter(|r| r.actuator_pa > 0.0).map(state).collect();
            Member { shares: rounded, states, stopped: None }
        }
        Err(reason) => Member { shares: rounded, states: Vec::new(), stopped: Some(reason) },
    }
}

fn outcome(all: &Uncertain, manner: &Manner) -> Result<Outcome, Failure> {
    let measured = measured(all);
    let text = text(all, &measured);
    let top = all.pressures_kpa().into_iter().fold(0.0, f64::max);
    let mut notes = Vec::new();
    let mut files = vec![("uncertain.json", all.record().into_bytes())];
    if let Ok(drawn) = ibr::pages::marker_intervals(all, &measured) {
        files.push(("markers.png", drawn.png));
    }
    if let Ok(drawn) = ibr::pages::what_to_measure(all, top) {
        files.push(("tornado.png", drawn.png));
    }
    for (name, bytes) in files {
        let path = manner.folder.join(name);
        data::write_atomically(&path, &bytes)?;
        notes.push(format!("written: {}", path.display()));
    }
    let weights = all.weights(top);
    let json = json!({
        "schema": "ibr.uncertain", "version": 1, "robots": all.members.len(), "numbers": all.numbers,
        "pressures": all.pressures_kpa().iter().map(|kpa| json!({
            "actuator_kpa": kpa,
            "markers_mm": (0..all.stations_mm.len())
                .map(|m| [0, 1].map(|axis| all.quantiles_mm(*kpa, m, axis))).collect::<Vec<_>>(),
        })).collect::<Vec<_>>(),
        "weights": weights.as_ref().map(|w| &w.0), "rest": weights.as_ref().map(|w| w.1),
    });
    Ok(Outcome { notes, ..Outcome::new(text, json) })
}

/// The paper's displacement of this kind of robot at the outermost marker: pressure \[kPa\], station and height \[mm\].
fn measured(all: &Uncertain) -> Vec<(f64, [f64; 2])> {
    let Ok(paper) = data::published() else { return Vec::new() };
    let own = paper.actuators.iter().filter(|a| a.kind == all.actuator);
    let at = all.stations_mm.last().copied().unwrap_or(f64::NAN);
    own.map(|a| (a.d_max_pressure_pa * 1e-3, [at, a.d_max_m * 1e3])).collect()
}

fn text(all: &Uncertain, measured: &[(f64, [f64; 2])]) -> String {
    let stopped: Vec<&Member> = all.members.iter().filter(|m| m.stopped.is_some()).collect();
    let mut out = format!(
        "{}: {} robots whose assumed numbers fill their intervals{}\n\nHeight of the markers [mm]: median (10 % to 90 %)\n",
        all.scenario,
        all.members.len(),
        if stopped.is_empty() { String::new() } else { format!(", {} of which stopped", stopped.len()) }
    );
    let mut head = vec!["actuator kPa".to_string()];
    head.extend(all.stations_mm.iter().map(|s| format!("s = {s}")));
    head.push("measured".into());
    let rows =
        all.pressures_kpa().into_iter().map(|kpa| {
            let cell = |m: usize| {
                let quantiles = all.quantiles_mm(kpa, m, 1);
                quantiles.map_or("–".into(), |[low, middle, high]| format!("{middle:.1} ({low:.1} to {high:.1})"))
            };
            let mut row = vec![format!("{kpa}")];
            row.extend((0..all.stations_mm.len()).map(cell));
            let point = measured.iter().find(|(at, _)| (at - kpa).abs() < 0.05);
            let inside = |y: f64| all.tip_mm(kpa).is_some_and(|[low, _, high]| (low..=high).contains(&y));
            row.push(point.map_or("–".into(), |(_, [_, y])| {
                format!("{y:.1}, {}", if inside(*y) { "inside" } else { "outside" })
            }));
            row
        });
    out.push_str(&table(&head.iter().map(String::as_str).collect::<Vec<_>>(), 0, rows.collect()));
    let top = all.pressures_kpa().into_iter().fold(0.0, f64::max);
    if let Some((weights, rest)) = all.weights(top) {
        out.push_str(&format!("\nWhat to measure first: outermost marker at {top} kPa\n"));
        let row = |w: &Weight| {
            let number = &all.numbers[w.number];
            vec![
                number.name.clone(),
                format!("{} to {}", number.interval[0], number.interval[1]),
                format!("{:+.1}", w.swing_mm),
                format!("{:.0}", 100.0 * w.share),
                number.reason.clone(),
            ]
        };
        let head = ["assumed", "interval", "10 % to 90 % of it: mm", "of the variance %", "why this interval"];
        out.push_str(&table(&head, 2, weights.iter().map(row).collect()));
        out.push_str(&calibrated(all, measured, &weights));
        out.push_str(&format!("{:.0} % of the variance is not of a straight law\n", 100.0 * rest));
    }
    for member in stopped {
        out.push_str(&format!("stopped: {}\n", member.stopped.as_deref().unwrap_or_default()));
    }
    out
}

/// What one number would have to be for the measured displacement, all others in the middle of their intervals.
fn calibrated(all: &Uncertain, measured: &[(f64, [f64; 2])], weights: &[Weight]) -> String {
    let Some((kpa, [_, y])) = measured.last() else { return String::new() };
    let mut out = format!(
        "\nCalibration, no prediction: what one number would have to be for the measured {y:.1} mm at {kpa} kPa, by a straight law\n"
    );
    let rows = weights.iter().map(|w| {
        let number = &all.numbers[w.number];
        let wanted = all.share_for(*kpa, w.number, *y).filter(|share| (0.0..=1.0).contains(share));
        let place =
            wanted.map_or("none in its interval".into(), |share| format!("{:.0} % of its interval", 100.0 * share));
        vec![number.name.clone(), place]
    });
    out.push_str(&table(&["assumed", "wanted"], 2, rows.collect()));
    out
}
