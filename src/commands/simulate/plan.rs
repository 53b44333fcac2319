//! What the options of `ibr simulate` ask for: one run, or several that differ in one thing each.

use crate::cli::SimulateArgs;
use crate::commands::fem_inputs::sizes;
use crate::commands::inputs::plain;
use crate::failure::Failure;
use fem::robot::{KEYS, OTHERS};
use fem::session::{Cube, Source, Variation, cube, mesh_keys, pressures_in_toml, product, rounded};
use models::scenario::quantity::parse_pressures;
use std::path::{Path, PathBuf};

const PRESSURES: &str = "write for example --pressure 10kPa,20kPa, or with supply channels 20kPa/10kPa";

/// What is to be run.
pub enum RunPlan {
    /// One run.
    Single(Source),
    /// Runs that differ in seed, mesh or pressure from the scenario with the common options.
    Table(Source, Vec<Variation>),
    /// A hypercube over what nobody measured.
    Uncertain(Cube),
}

impl RunPlan {
    /// The folder of a case if none is named.
    pub fn folder(&self, case: &str) -> PathBuf {
        let stem = Path::new(case).file_stem().unwrap_or_default().to_string_lossy();
        let kind = match self {
            RunPlan::Uncertain(_) => "uncertain",
            RunPlan::Table(..) => "batch",
            RunPlan::Single(_) => "simulate",
        };
        PathBuf::from(format!("ibr-report/{kind}-{}", plain(&stem)))
    }
}

/// Reads the options.
pub fn plan(args: &SimulateArgs, source: Source) -> Result<RunPlan, Failure> {
    if !source.is_robot() {
        return match robot_option(args) {
            None => Ok(RunPlan::Single(source)),
            Some(option) => {
                let message = format!("{option} is for robots; {} is a finite element case", args.case);
                Err(Failure::usage(message, "change the case file, or name a robot's scenario such as epam"))
            }
        };
    }
    let mut common = args.set.iter().map(|text| setting(text)).collect::<Result<Vec<_>, _>>()?;
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
        let known: Vec<&str> = args.set.iter().filter_map(|text| text.split('=').next()).map(str::trim).collect();
        return Ok(RunPlan::Uncertain(cube(base, &known, robots as usize)?));
    }
    let (_, run) = base.robot_run()?;
    let of_run = || run.meshes_m.iter().map(|sizes| sizes.map(|m| rounded(m * 1e3))).collect();
    let meshes = typed.unwrap_or_else(of_run);
    let separate = args.separate || (run.separate && run.pressures_pa.len() > 1);
    if meshes.len() < 2 && !separate && args.seeds.is_none() {
        return Ok(RunPlan::Single(base));
    }
    Ok(RunPlan::Table(base, product(&run, args.seeds, separate, &meshes)))
}

/// An option that only robots have.
fn robot_option(args: &SimulateArgs) -> Option<&'static str> {
    let given = [
        ("--pressure", args.pressure.is_some()),
        ("--separate", args.separate),
        ("--seeds", args.seeds.is_some()),
        ("--mesh", args.mesh.is_some()),
        ("--set", !args.set.is_empty()),
        ("--uncertain", args.uncertain.is_some()),
    ];
    given.iter().find(|(_, given)| *given).map(|(option, _)| *option)
}

fn setting(text: &str) -> Result<(String, String), Failure> {
    let names = || OTHERS.into_iter().chain(KEYS.iter().map(|k| k.name)).collect::<Vec<_>>().join(", ");
    let help = || format!("for example --set hourglass=0.02; keys: {}", names());
    let Some((key, value)) = text.split_once('=') else {
        return Err(Failure::usage(format!("--set {text}: there is no ="), help()));
    };
    let (key, value) = (key.trim(), value.trim());
    match KEYS.iter().any(|k| k.name == key) || OTHERS.contains(&key) {
        true if ["model", "base", "taped"].contains(&key) => {
            Ok((key.into(), format!("\"{}\"", value.trim_matches('"'))))
        }
        true => Ok((key.into(), value.into())),
        false => Err(Failure::usage(format!("--set: unknown key `{key}`"), help())),
    }
}
