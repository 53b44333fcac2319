//! What the options of `ibr simulate` ask for: one run, or several that differ in one thing each.

use crate::cli::SimulateArgs;
use crate::commands::fem_inputs::sizes;
use crate::commands::inputs::{self, plain};
use crate::prelude::*;
use fem::robot::{KEYS, OTHERS};
use fem::session::{Cube, RunSource, Variation, cube, mesh_keys, numerics, pressures_in_toml, product, rounded};
use models::scenario::quantity::parse_pressures;

const PRESSURES: &str = "write for example --pressure 10kPa,20kPa, or with supply channels 20kPa/10kPa";

pub(super) enum RunPlan {
    Single(RunSource),
    /// Runs that differ in seed, mesh or pressure from the scenario with the common options.
    Table(RunSource, Vec<Variation>),
    /// A hypercube over the unmeasured numbers.
    Uncertain(Cube),
}

impl RunPlan {
    pub(super) fn folder(&self, args: &SimulateArgs) -> PathBuf {
        let stem = Path::new(&args.case).file_stem().unwrap_or_default().to_string_lossy();
        let kind = match self {
            RunPlan::Uncertain(_) => "uncertain",
            RunPlan::Table(..) if args.numerics => "numerics",
            RunPlan::Table(..) => "batch",
            RunPlan::Single(_) => "simulate",
        };
        let on = if args.from.is_some() { "-on" } else { "" };
        PathBuf::from(format!("ibr-report/{kind}-{}{on}", plain(&stem)))
    }
}

pub(super) fn plan(args: &SimulateArgs, source: RunSource) -> Result<RunPlan> {
    if !source.is_robot() {
        return match robot_option(args) {
            None => Ok(RunPlan::Single(source)),
            Some(option) => {
                let message = format!("{option} is for robots; {} is a finite element case", args.case);
                Err(Failure::usage(message, "change the case file, or name a robot's scenario such as epam"))
            }
        };
    }
    let set = args.changes.set.iter().map(|text| setting(text)).collect::<Result<Vec<_>, _>>()?;
    inputs::each_once("--set", set.iter().map(|(key, _)| key.as_str()))?;
    // A key with a table before it is one of the scenario, as in a sweep.
    let (of_robot, mut common): (Vec<_>, Vec<_>) = set.into_iter().partition(|(key, _)| key.contains('.'));
    let source = if of_robot.is_empty() { source } else { changed(source, &of_robot)? };
    if let Some(text) = args.pressure.as_deref() {
        let list = parse_pressures(text).map_err(|m| Failure::usage(format!("--pressure: {m}"), PRESSURES))?;
        let entries: Vec<String> = list.iter().map(pressures_in_toml).collect();
        common.push(("pressures_kpa".to_string(), format!("[{}]", entries.join(", "))));
    }
    let typed = args.mesh.as_deref().map(sizes).transpose()?;
    if let Some([one]) = typed.as_deref() {
        common.extend(mesh_keys(one));
    }
    let base = source.with(&common)?;
    if let Some(robots) = args.uncertain {
        let known: Vec<&str> =
            args.changes.set.iter().filter_map(|text| text.split('=').next()).map(str::trim).collect();
        return Ok(RunPlan::Uncertain(cube(base, &known, robots as usize)?));
    }
    let (scenario, run) = base.robot_run()?;
    if args.numerics {
        let all = numerics(&scenario, &run)?;
        return Ok(RunPlan::Table(base, all));
    }
    let of_run = || run.meshes_m.iter().map(|sizes| sizes.map(|m| rounded(m * 1e3))).collect();
    let meshes = typed.unwrap_or_else(of_run);
    let separate = run.separate && run.pressures_pa.len() > 1;
    if meshes.len() < 2 && !separate && args.seeds.is_none() {
        return Ok(RunPlan::Single(base));
    }
    Ok(RunPlan::Table(base, product(&run, args.seeds, separate, &meshes)))
}

fn robot_option(args: &SimulateArgs) -> Option<&'static str> {
    let given = [
        ("--pressure", args.pressure.is_some()),
        ("--seeds", args.seeds.is_some()),
        ("--mesh", args.mesh.is_some()),
        ("--set", !args.changes.set.is_empty()),
        ("--uncertain", args.uncertain.is_some()),
        ("--numerics", args.numerics),
    ];
    given.iter().find(|(_, given)| *given).map(|(option, _)| *option)
}

fn changed(source: RunSource, changes: &[(String, String)]) -> Result<RunSource> {
    let file = ScenarioFile::parse(&source.name, &source.text)?.with_in_space(changes)?;
    Ok(RunSource { text: file.text, ..source })
}

fn setting(text: &str) -> Result<(String, String)> {
    let names = || OTHERS.into_iter().chain(KEYS.iter().map(|k| k.name)).collect::<Vec<_>>().join(", ");
    let help = || format!("for example --set hourglass=0.02 or body.radius_mm=45; keys of [fem]: {}", names());
    let (key, value) = inputs::setting(text, &help())?;
    if key.contains('.') {
        return Ok((key.into(), value.into()));
    }
    match KEYS.iter().any(|k| k.name == key) || OTHERS.contains(&key) {
        true if ["model", "base", "taped"].contains(&key) => {
            Ok((key.into(), format!("\"{}\"", value.trim_matches('"'))))
        }
        true => Ok((key.into(), value.into())),
        false => Err(Failure::usage(format!("--set: unknown key `{key}`"), help())),
    }
}
