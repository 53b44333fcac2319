//! Bench tests in `ibr compare`: a beam, a muscle.

use super::inputs::{self, with_effect};
use super::tables::table;
use super::{Context, Outcome};
use crate::cli::Compare;
use crate::failure::Failure;
use compare::bench::{Held, HeldRow, held};
use compare::study::Knob;
use models::Scenario;
use serde_json::{Value, json};

/// The comparison, if the data are a table of bench tests.
pub fn run(args: &Compare, context: &mut Context) -> Result<Option<Outcome>, Failure> {
    let Some((data_spec, scenario_spec)) = args.inputs.split_last().filter(|(_, before)| before.len() < 2) else {
        return Ok(None);
    };
    let Some(bench) = data::bench::bench(data_spec)? else { return Ok(None) };
    if let Some(option) = marker_option(args) {
        let message = format!("{option} is about marker data, {data_spec} is a table of bench tests");
        return Err(Failure::usage(message, format!("leave {option} out")));
    }
    (context.progress)("comparing", None);
    let mut scenario = match (scenario_spec, &bench.scenario) {
        ([spec], _) => Some(inputs::scenario(spec)?.scenario),
        (_, Some(text)) => Some(own(data_spec, text)?),
        _ => None,
    };
    for text in &args.effect {
        let Some(before) = &scenario else {
            return Err(Failure::usage("--effect without a scenario", "name a scenario before the table"));
        };
        scenario = Some(with_effect(before, text)?.0);
    }
    let held = held(&bench, scenario.as_ref(), args.calibrate.is_some())?;
    let answer = json!({"schema": "ibr.compare.bench", "version": 1, "data": data_spec, "kind": bench.kind.name,
        "provenance": bench.provenance.word(), "held": as_json(&held)});
    Ok(Some(Outcome::new(text(&held), answer)))
}

/// The scenario that lies beside the data.
pub fn own(data_spec: &str, text: &str) -> Result<Scenario, Failure> {
    let file = format!("{data_spec}/scenario.toml");
    Scenario::parse(text).map_err(|error| Failure::Scenario { file, text: text.to_string(), error })
}

fn marker_option(args: &Compare) -> Option<&'static str> {
    let given = [
        ("--sigma", args.sigma.is_some()),
        ("--max-error", args.max_error.is_some()),
        ("--out", args.out.is_some()),
        ("--calibrate=body-pressure", args.calibrate == Some(Knob::BodyPressure)),
    ];
    given.into_iter().find(|(_, given)| *given).map(|(name, _)| name)
}

/// Refuses a table of bench tests where markers are needed.
pub fn needs_markers(data_spec: &str) -> Result<(), Failure> {
    match data::bench::bench(data_spec)? {
        None => Ok(()),
        Some(bench) => {
            let message = format!("{data_spec} is a {} table, not markers of a robot", bench.kind.name);
            Err(Failure::usage(message, format!("`ibr compare {data_spec}` holds it against its model")))
        }
    }
}

/// A table, and how far the model is off where it was not fitted.
pub fn text(held: &Held) -> String {
    let percent = |r: &HeldRow| r.off().map_or("–".into(), |o| format!("{:+.1}", 100.0 * o));
    let row = |r: &HeldRow| {
        let model = r.model.map_or("–".into(), |m| format!("{m:.2}"));
        vec![r.at.clone(), format!("{:.2}", r.measured), model, percent(r), r.verdict()]
    };
    let quantity = &held.quantity;
    let head = [quantity.as_str(), "measured", "model", "off %", "verdict"];
    format!(
        "{} ({})\n{}{}",
        held.title,
        held.known.word(),
        table(&head, 1, held.rows.iter().map(row).collect()),
        closing(held)
    )
}

/// Rms and notes.
pub fn closing(held: &Held) -> String {
    let mut out = String::new();
    if let Some(rms) = held.rms() {
        let fitted = held.rows.iter().filter(|r| r.fitted).count();
        let least = held
            .rows
            .iter()
            .filter(|r| !r.fitted)
            .filter_map(HeldRow::off)
            .fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], o| [a.min(o), b.max(o)]);
        out.push_str(&format!(
            "rms off {:.1} % ({:+.1} to {:+.1} %) of {} rows that nothing was fitted to; {fitted} fitted\n",
            100.0 * rms,
            100.0 * least[0],
            100.0 * least[1],
            held.rows.len() - fitted
        ));
    }
    held.notes.iter().for_each(|n| out.push_str(&format!("note: {n}\n")));
    out
}

/// For JSON.
pub fn as_json(held: &Held) -> Value {
    let row = |r: &HeldRow| {
        json!({"at": r.at, "measured": r.measured, "model": r.model, "off": r.off(), "interval_half": r.half,
            "fitted": r.fitted, "verdict": r.verdict()})
    };
    json!({
        "title": held.title, "quantity": held.quantity, "how_known": held.known.word(), "rms_off": held.rms(),
        "rows": held.rows.iter().map(row).collect::<Vec<_>>(), "notes": held.notes,
    })
}
