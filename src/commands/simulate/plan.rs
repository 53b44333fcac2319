//! What the options of `ibr simulate` ask for: one run, or several that differ in one thing each.

use super::input::Named;
use super::robot::rounded;
use crate::cli::Simulate;
use crate::commands::inputs::quantity;
use crate::failure::Failure;
use compare::study::uncertain::Varied;
use fem::robot::{ASSUMED, Assumed, KEYS, Key, OTHERS, RobotRun, RobotSettings, hypercube};
use models::scenario::quantity::Quantity;

/// One run of several.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Variation {
    /// Name of its folder.
    pub label: String,
    /// Keys of `[fem]` that differ from the scenario with the common options.
    pub changes: Vec<(String, String)>,
    /// Group of runs that differ in seed or in single pressures only.
    pub group: String,
}

/// What is to be run.
pub enum Plan {
    /// One run.
    Single(Named),
    /// Several, and what the table of their results is about.
    Several {
        /// The scenario with the common options.
        base: Named,
        /// The runs.
        cases: Vec<Variation>,
        /// What they are about.
        about: About,
    },
}

/// What several runs are about.
pub enum About {
    /// Seeds, meshes, single pressures.
    Table,
    /// A hypercube over these numbers, a row of shares for every run; what was set beside it, as typed.
    Uncertain(Vec<Varied>, Vec<Vec<f64>>, Vec<String>),
}

/// Reads the options.
pub fn plan(args: &Simulate, named: Named) -> Result<Plan, Failure> {
    if !named.is_robot() {
        return match robot_option(args) {
            None => Ok(Plan::Single(named)),
            Some(option) => {
                let message = format!("{option} is for robots; {} is a finite element case", args.case);
                Err(Failure::usage(message, "change the case file, or name a robot's scenario such as epam"))
            }
        };
    }
    let mut common = Vec::new();
    for text in &args.set {
        common.push(setting(text)?);
    }
    let pressures_kpa = args.pressure.as_deref().map(pressures).transpose()?;
    if let Some(list) = &pressures_kpa {
        common.push(("pressures_kpa".to_string(), format!("{list:?}")));
    }
    let typed = args.mesh.as_deref().map(sizes).transpose()?;
    if let Some([one]) = typed.as_deref() {
        common.extend(keys_of(one));
    }
    let base = named.with(&common)?;
    if let Some(robots) = args.uncertain {
        return uncertain(base, &args.set, robots as usize);
    }
    let (_, run) = base.robot_run()?;
    let of_run = || run.meshes_m.iter().map(|sizes| sizes.map(|m| rounded(m * 1e3))).collect();
    let meshes = typed.unwrap_or_else(of_run);
    let separate = args.separate || (run.separate && run.pressures_pa.len() > 1);
    if meshes.len() < 2 && !separate && args.seeds.is_none() {
        return Ok(Plan::Single(base));
    }
    let cases = product(&run, args.seeds, separate, &meshes);
    Ok(Plan::Several { base, cases, about: About::Table })
}

/// An option that only robots have.
fn robot_option(args: &Simulate) -> Option<&'static str> {
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

fn names() -> String {
    OTHERS.into_iter().chain(KEYS.iter().map(|k| k.name)).collect::<Vec<_>>().join(", ")
}

/// Pressures as typed \[kPa\].
pub fn pressures(text: &str) -> Result<Vec<f64>, Failure> {
    let one = |p: &str| Ok(rounded(quantity("--pressure", p, Quantity::Pressure)? / 1e3));
    text.split(',').map(one).collect()
}

/// Element sizes of body and actuator \[mm\], from `3mm` for both or `8mm/3mm`; several with commas between.
pub fn sizes(text: &str) -> Result<Vec<[f64; 2]>, Failure> {
    let one = |size: &str| match rounded(quantity("--mesh", size, Quantity::Length)? * 1e3) {
        mm if (0.5..=50.0).contains(&mm) => Ok(mm),
        mm => Err(Failure::usage(format!("--mesh {mm}mm is out of range"), "write 0.5mm to 50mm, for example 8mm/3mm")),
    };
    let pair = |text: &str| {
        let (body, actuator) = text.split_once('/').unwrap_or((text, text));
        Ok([one(body)?, one(actuator)?])
    };
    text.split(',').map(pair).collect()
}

/// What [`sizes`] mean in `[fem]`.
pub fn keys_of([body_mm, actuator_mm]: &[f64; 2]) -> [(String, String); 2] {
    [("body_mesh_mm".into(), body_mm.to_string()), ("actuator_mesh_mm".into(), actuator_mm.to_string())]
}

/// Every mesh with every seed at every single pressure.
fn product(run: &RobotRun, seeds: Option<u64>, separate: bool, meshes: &[[f64; 2]]) -> Vec<Variation> {
    let mut cases = vec![Variation::default()];
    if meshes.len() > 1 {
        let label = |[body, actuator]: &[f64; 2]| match body == actuator {
            true => format!("mesh-{actuator}mm"),
            false => format!("mesh-{body}-{actuator}mm"),
        };
        let of = |mm: &[f64; 2]| (label(mm), keys_of(mm).to_vec(), true);
        cases = extended(&cases, &meshes.iter().map(of).collect::<Vec<_>>());
    }
    if let Some(count) = seeds {
        let of = |seed: u64| (format!("seed-{seed}"), vec![("seed".into(), seed.to_string())], false);
        cases = extended(&cases, &(1..=count).map(of).collect::<Vec<_>>());
    }
    if separate {
        let of = |pa: &f64| {
            let kpa = rounded(pa * 1e-3);
            (format!("{kpa}kPa"), vec![("pressures_kpa".into(), format!("[{kpa}]"))], false)
        };
        cases = extended(&cases, &run.pressures_pa.iter().map(of).collect::<Vec<_>>());
    }
    cases
}

/// Label, keys of `[fem]`, and whether means are taken apart for it.
type Step = (String, Vec<(String, String)>, bool);

fn extended(cases: &[Variation], steps: &[Step]) -> Vec<Variation> {
    let joined = |a: &str, b: &str| if a.is_empty() { b.to_string() } else { format!("{a}-{b}") };
    let with = |case: &Variation, (label, keys, grouping): &Step| Variation {
        label: joined(&case.label, label),
        changes: case.changes.iter().chain(keys).cloned().collect(),
        group: if *grouping { joined(&case.group, label) } else { case.group.clone() },
    };
    cases.iter().flat_map(|case| steps.iter().map(|step| with(case, step)).collect::<Vec<_>>()).collect()
}

/// One mesh, so that a run's own case.toml is that run and no study.
fn one_mesh(base: Named) -> Result<Named, Failure> {
    let (_, run) = base.robot_run()?;
    match run.meshes_m.is_empty() {
        true => Ok(base),
        false => {
            base.with(&keys_of(&[run.settings.body_size_m, run.settings.actuator_size_m].map(|m| rounded(m * 1e3))))
        }
    }
}

/// Seed of the hypercube: the robots of a scenario are the same ones on every machine.
const CUBE: u64 = 1;

/// Robots that fill the intervals of all assumed numbers that this one feels and nobody set.
fn uncertain(base: Named, set: &[String], robots: usize) -> Result<Plan, Failure> {
    let base = one_mesh(base)?;
    let known = |key: &Key| set.iter().any(|text| text.split('=').next().is_some_and(|name| name.trim() == key.name));
    let mut numbers = Vec::new();
    for unknown in ASSUMED {
        let Some(key) = key_of(unknown).filter(|key| !known(key)) else { continue };
        let print = |si: f64| {
            let changed = base.with(&[(key.name.to_string(), rounded(si / key.si).to_string())])?;
            Ok::<u64, Failure>(changed.load()?.case.problem.fingerprint())
        };
        if print(unknown.interval[0])? != print(unknown.interval[1])? {
            numbers.push((unknown, key));
        }
    }
    let cube = hypercube(robots, numbers.len(), CUBE);
    let mut cases = Vec::with_capacity(robots);
    for (index, shares) in cube.iter().enumerate() {
        let value = |((unknown, key), share): (&(&Assumed, &Key), &f64)| {
            (key.name.to_string(), format!("{:.4e}", unknown.at(*share) / key.si))
        };
        let mut changes: Vec<(String, String)> = numbers.iter().zip(shares).map(value).collect();
        changes.push(("seed".into(), (index + 1).to_string()));
        cases.push(Variation { label: format!("robot-{}", index + 1), changes, group: String::new() });
    }
    let varied = |(unknown, key): &(&Assumed, &Key)| Varied {
        name: key.name.into(),
        interval: unknown.interval.map(|si| rounded(si / key.si)),
        tenths: [0.1, 0.9].map(|share| format!("{:.2e}", unknown.at(share) / key.si).parse().unwrap_or(f64::NAN)),
        meaning: key.meaning.into(),
        reason: unknown.reason.into(),
    };
    Ok(Plan::Several { base, cases, about: About::Uncertain(numbers.iter().map(varied).collect(), cube, set.to_vec()) })
}

/// The key that writes what an assumed number writes.
pub fn key_of(unknown: &Assumed) -> Option<&'static Key> {
    let after = |set: fn(&mut RobotSettings, f64), value: f64| {
        let mut changed = RobotSettings::default();
        set(&mut changed, value);
        changed
    };
    // One end may be the default of several keys.
    let fits = |key: &&Key| unknown.interval.iter().all(|v| after(key.set, *v) == after(unknown.set, *v));
    KEYS.iter().find(fits)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_assumed_number_has_a_key_of_its_own() {
        let keys: Vec<&str> = ASSUMED.iter().filter_map(|unknown| Some(key_of(unknown)?.name)).collect();
        assert_eq!(keys.len(), ASSUMED.len(), "{keys:?}");
        assert!(keys.iter().enumerate().all(|(i, key)| !keys[..i].contains(key)), "{keys:?}");
    }
}
