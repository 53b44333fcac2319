//! `ibr breakdown`: over which pressures and pouches the reduced model parts from the finite elements.

use super::engines::robots;
use super::inputs::quantity;
use super::simulate::{Keeper, Named, keys_of, rounded, sizes};
use super::tables::table;
use super::{Context, Outcome};
use crate::cli::Breakdown;
use crate::failure::{Failure, INTERRUPTED};
use crate::output::{check_folder, write_files};
use compare::study::engines::{FeRun, Pair, SHAPE, engines, pairs, runs_json, stored, varied};
use ibr::pages::{Files, parting_plot};
use models::Scenario;
use models::actuators::Family;
use models::scenario::quantity::Quantity;
use serde_json::{Value, json};

/// One run at one pressure.
struct Cell<'a> {
    run: &'a FeRun,
    /// The scenario without its effects.
    bare: Pair,
    /// The scenario as it is.
    own: Pair,
}

pub fn run(args: &Breakdown, context: &mut Context) -> Result<Outcome, Failure> {
    check_folder(&args.out)?;
    let (mut runs, mut stopped): (Vec<FeRun>, Vec<Failure>) = (Vec::new(), Vec::new());
    if args.stored {
        runs.extend(stored()?.into_iter().filter(|run| run.seed == 1));
    } else {
        let cases = cases(args)?;
        let keeper = Keeper { folder: args.runs.clone(), threads: args.threads as usize };
        let found = match keeper.run_all(&cases, context)? {
            Ok(found) => found,
            Err(done) => return Ok(interrupted(done, cases.len())),
        };
        for run in found {
            match run {
                Ok(run) => runs.push(run),
                Err(error) => stopped.push(error),
            }
        }
    }
    if runs.is_empty() && !stopped.is_empty() {
        return Err(stopped.remove(0));
    }
    let scenarios: Vec<Scenario> = robots(&args.scenarios)?.0.into_iter().map(|r| r.1).collect();
    let mut rows = Vec::new();
    for run in &runs {
        let Some(scenario) = scenarios.iter().find(|s| s.name == run.scenario) else { continue };
        let scenario = varied(scenario, run);
        let bare = pairs(&scenario.bare(), run)?;
        rows.extend(pairs(&scenario, run)?.into_iter().zip(bare).map(|(own, bare)| Cell { run, bare, own }));
    }
    let mut files = Files::default();
    for (k, map) in engines(&scenarios, &runs)?.maps.iter().enumerate() {
        files.plot(&format!("breakdown_{}_{k}", map.actuator), &parting_plot(map)?);
    }
    files.text("breakdown.csv", csv(&rows));
    files.text("runs.json", runs_json(&runs));
    write_files(&args.out, &files, &[], context)?;
    let mut outcome = Outcome::new(text(&rows), as_json(&rows));
    outcome.notes.extend(stopped.iter().map(|error| format!("left out of the map: {}", error.render().trim())));
    outcome.notes.push(format!("maps and tables: {}", args.out.display()));
    Ok(outcome)
}

/// Every robot at every body pressure, and with every pouch length at its own.
fn cases(args: &Breakdown) -> Result<Vec<(Named, String)>, Failure> {
    let body = list("--body-pressure", &args.body_pressure, Quantity::Pressure, 1e-3)?;
    let pouch = list("--pouch", &args.pouch, Quantity::Length, 1e3)?;
    let pressures = list("--pressure", &args.pressure, Quantity::Pressure, 1e-3)?;
    let meshes = args.mesh.as_deref().map(sizes).transpose()?.unwrap_or_default();
    if meshes.len() > 1 {
        return Err(Failure::usage("--mesh takes one size here", "write for example --mesh 8mm/4mm"));
    }
    let mut cases = Vec::new();
    for (named, scenario) in robots(&args.scenarios)?.0 {
        let own = rounded(scenario.p_body_pa * 1e-3);
        let bodies = body.iter().copied().filter(|p| *p != own);
        let mut wanted: Vec<(f64, Option<f64>)> =
            std::iter::once((own, None)).chain(bodies.map(|p| (p, None))).collect();
        // An actuator of one piece has no pouches to divide.
        if scenario.actuator.kind.family == Family::Pouch {
            let other = |mm: &&f64| (**mm * 1e-3 - scenario.actuator.shape.length_m).abs() > 1e-9;
            wanted.extend(pouch.iter().filter(other).map(|mm| (own, Some(*mm))));
        }
        for (body_kpa, pouch_mm) in wanted {
            let above: Vec<f64> = pressures.iter().copied().filter(|p| *p >= body_kpa).collect();
            let text = changed(&named, &scenario, body_kpa, pouch_mm)?;
            let mut changes = vec![("pressures_kpa".to_string(), format!("{above:?}"))];
            changes.extend(meshes.iter().flat_map(keys_of));
            let case = text.with(&changes)?;
            cases.push((case, scenario.name.clone()));
        }
    }
    Ok(cases)
}

/// A list of quantities with units, in `1/factor` SI.
pub fn list(option: &str, text: &str, kind: Quantity, factor: f64) -> Result<Vec<f64>, Failure> {
    let one = |t: &str| Ok(rounded(quantity(option, t, kind)? * factor));
    text.split(',').filter(|t| !t.trim().is_empty()).map(one).collect()
}

/// The scenario with another body pressure and as many pouches of another length as fit into the length of its own.
pub fn changed(named: &Named, scenario: &Scenario, body_kpa: f64, pouch_mm: Option<f64>) -> Result<Named, Failure> {
    let unreadable = |_| Failure::usage(format!("{} cannot be changed", named.spec), "check the file with ibr predict");
    let mut all: toml::Table = named.text.parse().map_err(unreadable)?;
    let mut set = |table: &str, key: &str, value: toml::Value| {
        if let Some(table) = all.get_mut(table).and_then(toml::Value::as_table_mut) {
            table.insert(key.into(), value);
        }
    };
    set("body", "pressure_kpa", body_kpa.into());
    if let Some(mm) = pouch_mm {
        let whole = scenario.actuator.count as f64 * scenario.actuator.shape.length_m * 1e3;
        let count = (whole / mm + 1e-6).floor();
        if count < 1.0 {
            let message = format!("--pouch {mm}mm is longer than the actuator of {}, {whole:.0} mm", named.spec);
            return Err(Failure::usage(message, "write shorter pouches, for example --pouch 45mm,90mm"));
        }
        set("actuator", "length_mm", mm.into());
        set("actuator", "count", (count as i64).into());
    }
    Ok(named.with_text(all.to_string()))
}

fn interrupted(done: usize, all: usize) -> Outcome {
    let note = format!("interrupted; {done} of {all} runs are complete and kept, the same command goes on");
    Outcome { notes: vec![note], code: INTERRUPTED, ..Outcome::default() }
}

fn percent(pair: &Pair) -> String {
    pair.difference().map_or("–".into(), |d| format!("{:+.0}", 100.0 * d))
}

fn text(rows: &[Cell]) -> String {
    let head = [
        "robot",
        "mesh mm",
        "body kPa",
        "pouch mm",
        "actuator kPa",
        "FE tip mm",
        "bare tip mm",
        "difference %",
        "reduced tip mm",
        "difference %",
        "carried by",
    ];
    let row = |Cell { run, bare, own: p }: &Cell| {
        vec![
            run.actuator.clone(),
            run.mesh_mm[1].to_string(),
            run.body_kpa.to_string(),
            run.pouch_mm.to_string(),
            format!("{:.0}", p.actuator_kpa),
            format!("{:.1}", p.fe_mm[1]),
            format!("{:.1}", bare.reduced_mm[1]),
            percent(bare),
            format!("{:.1}", p.reduced_mm[1]),
            percent(p),
            p.carrier().unwrap_or("–").into(),
        ]
    };
    let shapes = shapes(rows);
    table(&head, 1, rows.iter().map(row).collect()) + &shapes
}

/// Arm, width, height and volumes of both, where a run kept them.
fn shapes(rows: &[Cell]) -> String {
    let row = |cell: &Cell| {
        let [own, fe] = cell.own.shape?;
        let Cell { run, own: p, .. } = cell;
        let place =
            [&run.actuator, &run.body_kpa.to_string(), &run.pouch_mm.to_string(), &format!("{:.0}", p.actuator_kpa)];
        let both = own.iter().zip(fe).map(|(own, fe)| format!("{own:.1} / {fe:.1} ({:+.1})", 100.0 * (own / fe - 1.0)));
        Some(place.into_iter().cloned().chain(both).collect::<Vec<_>>())
    };
    let found: Vec<_> = rows.iter().filter_map(row).collect();
    if found.is_empty() {
        return String::new();
    }
    let of = |name: &str, unit: &str| format!("{name} {unit}");
    let names = SHAPE.iter().enumerate().map(|(k, name)| of(name, if k < 3 { "mm" } else { "cm³" }));
    let head: Vec<String> =
        ["robot", "body kPa", "pouch mm", "actuator kPa"].map(String::from).into_iter().chain(names).collect();
    let head: Vec<&str> = head.iter().map(String::as_str).collect();
    format!(
        "\nInflated pouches and body: reduced model / finite elements (difference in %)\n{}",
        table(&head, 1, found)
    )
}

fn csv(rows: &[Cell]) -> String {
    let mut out = String::from(
        "robot,mesh_mm,p_body_kpa,pouch_mm,p_act_kpa,reduced_tip_mm,fe_tip_mm,difference_pct,carried_by,bare_tip_mm\n",
    );
    for Cell { run, bare, own: p } in rows {
        let difference = p.difference().map_or(String::new(), |d| (100.0 * d).to_string());
        out.push_str(&format!(
            "{},{},{},{},{},{},{},{difference},{},{}\n",
            run.actuator,
            run.mesh_mm[1],
            run.body_kpa,
            run.pouch_mm,
            p.actuator_kpa,
            p.reduced_mm[1],
            p.fe_mm[1],
            p.carrier().unwrap_or_default(),
            bare.reduced_mm[1]
        ));
    }
    out
}

fn as_json(rows: &[Cell]) -> Value {
    let row = |Cell { run, bare, own: p }: &Cell| {
        json!({
            "robot": run.actuator, "mesh_mm": run.mesh_mm[1], "body_kpa": run.body_kpa, "pouch_mm": run.pouch_mm,
            "actuator_kpa": p.actuator_kpa, "reduced_tip_mm": p.reduced_mm[1], "fe_tip_mm": p.fe_mm[1],
            "difference": p.difference(), "carried_by": p.carrier(), "excess_mj": p.excess_mj,
            "bare_tip_mm": bare.reduced_mm[1], "bare_difference": bare.difference(),
            "shape": p.shape.map(|[reduced, fe]| json!({"names": SHAPE, "reduced": reduced, "fe": fe})),
        })
    };
    json!({"schema": "ibr.breakdown", "version": 1, "cells": rows.iter().map(row).collect::<Vec<_>>()})
}
