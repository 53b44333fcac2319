//! Bench tests in `ibr compare`: a beam, a muscle.

use super::inputs;
use crate::cli::CompareArgs;
use crate::prelude::*;
use crate::shown::held::{BenchAnswer, HeldTable, text};
use compare::bench::held;
use compare::study::Knob;
use compare::typed_effect::with_effect;

/// The comparison, if the data are a table of bench tests.
pub(super) fn run(args: &CompareArgs, context: &mut Context) -> Result<Option<Outcome>> {
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
    inputs::each_once("--effect", inputs::effect_names(&args.effect))?;
    for text in &args.effect {
        let Some(before) = &scenario else {
            return Err(Failure::usage("--effect without a scenario", "name a scenario before the table"));
        };
        scenario = Some(with_effect(before, text)?.0);
    }
    let held = held(&bench, scenario.as_ref(), args.calibrate.is_some())?;
    let (kind, provenance) = (bench.kind.name, bench.provenance);
    let answer = BenchAnswer { data: data_spec, kind, provenance, held: HeldTable::of(&held) };
    Ok(Some(Outcome::answer(text(&held), "ibr.compare.bench", &answer)))
}

/// The scenario that lies beside the data.
pub(super) fn own(data_spec: &str, text: &str) -> Result<Scenario> {
    Ok(ScenarioFile::parse(&format!("{data_spec}/scenario.toml"), text)?.scenario)
}

fn marker_option(args: &CompareArgs) -> Option<&'static str> {
    let given = [
        ("--sigma", args.noise.sigma.is_some()),
        ("--max-error", args.max_error.is_some()),
        ("--out", args.out.is_some()),
        ("--calibrate=body-pressure", args.calibrate == Some(Knob::BodyPressure)),
    ];
    given.into_iter().find(|(_, given)| *given).map(|(name, _)| name)
}

/// Refuses a table of bench tests where markers are needed.
pub(super) fn needs_markers(data_spec: &str) -> Result<()> {
    match data::bench::bench(data_spec)? {
        None => Ok(()),
        Some(bench) => {
            let message = format!("{data_spec} is a {} table, not markers of a robot", bench.kind.name);
            Err(Failure::usage(message, format!("`ibr compare {data_spec}` holds it against its model")))
        }
    }
}
