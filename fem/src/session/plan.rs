//! Runs of one robot that differ in mesh, seed, pressure, or in unmeasured numbers.

use super::{RunSource, rounded};
use crate::case::range::{DeclaredKey, named};
use crate::robot::{ASSUMED, Assumed, KEYS, NUMERICAL, RobotRun, RobotSettings, hypercube};
use crate::{FemError, Result};
use models::{CHANNELS, Scenario};

/// Label of a robot of which nothing is varied.
pub const AS_IT_IS: &str = "as-it-is";

/// Keys of `[fem]` and their values as in TOML.
pub type Changes = Vec<(String, String)>;

/// One run of several, by what differs from the common scenario.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Variation {
    /// Name of the folder in which the run is kept.
    pub label: String,
    /// Keys of `[fem]` that differ from the scenario with the common options.
    pub changes: Changes,
    /// Group of runs that differ in seed or in single pressures only.
    pub group: String,
}

/// Element sizes of body and actuator \[mm\] as keys of `[fem]`.
pub fn mesh_keys([body_mm, actuator_mm]: &[f64; 2]) -> [(String, String); 2] {
    [("body_mesh_mm".into(), body_mm.to_string()), ("actuator_mesh_mm".into(), actuator_mm.to_string())]
}

/// An entry of `pressures_kpa` for pressures of the channels \[Pa\].
///
/// ```
/// assert_eq!(fem::session::pressures_in_toml(&[20e3; models::CHANNELS]), "20");
/// ```
pub fn pressures_in_toml(channels_pa: &[f64; CHANNELS]) -> String {
    let kpa = channels_pa.map(|pa| rounded(pa * 1e-3));
    if kpa.iter().all(|p| *p == kpa[0]) { kpa[0].to_string() } else { format!("{kpa:?}") }
}

impl RunSource {
    /// A robot of one mesh, so that a run's own `case.toml` is that run and no study of several.
    pub(super) fn of_one_mesh(self) -> Result<RunSource> {
        let (_, run) = self.robot_run()?;
        let sizes_mm = [run.settings.body_size_m, run.settings.actuator_size_m].map(|m| rounded(m * 1e3));
        if run.meshes_m.is_empty() { Ok(self) } else { self.with(&mesh_keys(&sizes_mm)) }
    }
}

/// Every mesh \[mm\] with every seed at every pressure of `run`, if these are `separate` runs.
pub fn product(run: &RobotRun, seeds: Option<u64>, separate: bool, meshes: &[[f64; 2]]) -> Vec<Variation> {
    let mut cases = vec![Variation::default()];
    if meshes.len() > 1 {
        let label = |[body, actuator]: &[f64; 2]| match body == actuator {
            true => format!("mesh-{actuator}mm"),
            false => format!("mesh-{body}-{actuator}mm"),
        };
        let of = |mm: &[f64; 2]| (label(mm), mesh_keys(mm).to_vec(), true);
        cases = extended(&cases, &meshes.iter().map(of).collect::<Vec<_>>());
    }
    if let Some(count) = seeds {
        let of = |seed: u64| {
            let keys = vec![("seed".into(), seed.to_string())];
            (format!("seed-{seed}"), keys, false)
        };
        cases = extended(&cases, &(1..=count).map(of).collect::<Vec<_>>());
    }
    if separate {
        let of = |pa: &[f64; CHANNELS]| {
            let entry = pressures_in_toml(pa);
            let label = entry.trim_matches(['[', ']']).replace(", ", "-");
            let keys = vec![("pressures_kpa".into(), format!("[{entry}]"))];
            (format!("{label}kPa"), keys, false)
        };
        cases = extended(&cases, &run.pressures_pa.iter().map(of).collect::<Vec<_>>());
    }
    cases
}

/// The robot as it is, then with each of [`NUMERICAL`] a third and three times as large, and on elements of half the size. A setting
/// that the program chooses is varied from that value, or left out where there is none.
///
/// # Errors
/// A robot that cannot be built.
pub fn numerics(scenario: &Scenario, run: &RobotRun) -> Result<Vec<Variation>> {
    let mut all = vec![Variation { label: AS_IT_IS.into(), ..Variation::default() }];
    let mut add = |label: String, changes: Changes| all.push(Variation { label, changes, ..Variation::default() });
    let problem = run.problem(scenario)?;
    let (settings, chosen, touches) = (&run.settings, &problem.settings, problem.contact.is_some());
    let number = |si: f64, key: &DeclaredKey<RobotSettings>| format!("{:.4e}", si / key.si);
    for key in KEYS.iter().filter(|key| NUMERICAL.contains(&key.name)) {
        let own = (key.get)(settings).or(match key.name {
            "mass_factor" => Some(settings.mass_factor_for(touches)),
            "mass_damping_1_s" => Some(chosen.mass_damping_1_s),
            "rest_s" => Some(settings.longest_rest_s()),
            _ => None,
        });
        let Some(own) = own.filter(|own| *own != 0.0) else { continue };
        for (label, factor) in [("third", 1.0 / 3.0), ("triple", 3.0)] {
            let [low, high] = key.bounds;
            let value = (own * factor).clamp(low * key.si, high * key.si);
            if (value / own - 1.0).abs() > 0.2 {
                let changes = vec![(key.name.into(), number(value, key))];
                add(format!("{}-{label}", key.name), changes);
            }
        }
    }
    let half = [settings.body_size_m, settings.actuator_size_m].map(|m| rounded(0.5e3 * m));
    add("mesh-half".into(), mesh_keys(&half).to_vec());
    Ok(all)
}

/// Label, keys of `[fem]`, and whether means are taken apart for it.
type Way = (String, Changes, bool);

fn extended(cases: &[Variation], ways: &[Way]) -> Vec<Variation> {
    let joined = |a: &str, b: &str| if a.is_empty() { b.to_string() } else { format!("{a}-{b}") };
    let with = |case: &Variation, (label, keys, grouping): &Way| Variation {
        label: joined(&case.label, label),
        changes: case.changes.iter().chain(keys).cloned().collect(),
        group: if *grouping { joined(&case.group, label) } else { case.group.clone() },
    };
    cases.iter().flat_map(|case| ways.iter().map(|way| with(case, way)).collect::<Vec<_>>()).collect()
}

/// Seed of the hypercube: the robots of a scenario are the same ones on every machine.
const CUBE: u64 = 1;

/// An unmeasured number that changes a robot, and the key that writes it.
pub type Felt = (&'static Assumed, &'static DeclaredKey<RobotSettings>);

/// Robots that fill the intervals of assumed numbers as a Latin hypercube.
#[derive(Debug, Clone)]
pub struct Cube {
    /// Scenario with the element sizes of one mesh.
    pub base: RunSource,
    /// Assumed numbers that change this robot, with their keys.
    pub numbers: Vec<Felt>,
    /// A row for every robot: the position of each number in its interval, 0 to 1.
    pub shares: Vec<Vec<f64>>,
    /// One run per row of `shares`.
    pub robots: Vec<Variation>,
}

/// So many robots over all assumed numbers that this one feels, but for the keys that are known.
///
/// # Errors
/// A scenario that is refused with one of the numbers at an end of its interval.
pub fn cube(base: RunSource, known: &[&str], robots: usize) -> Result<Cube> {
    let base = base.of_one_mesh()?;
    let numbers = felt(&base, known)?;
    let shares = hypercube(robots, numbers.len(), CUBE);
    let robots = shares.iter().enumerate().map(|(index, shares)| robot(index + 1, &numbers, shares)).collect();
    Ok(Cube { base, numbers, shares, robots })
}

/// All assumed numbers that a robot of one mesh feels, but for the keys that are known.
///
/// # Errors
/// As [`cube`].
pub fn felt(base: &RunSource, known: &[&str]) -> Result<Vec<Felt>> {
    let mut numbers = Vec::new();
    for unknown in ASSUMED {
        let Some(key) = named(KEYS, unknown.key).filter(|key| !known.contains(&key.name)) else { continue };
        let print = |si: f64| {
            let changed = base.with(&[(key.name.to_string(), rounded(si / key.si).to_string())])?;
            Ok::<u64, FemError>(changed.load()?.case.problem.fingerprint())
        };
        if print(unknown.interval[0])? != print(unknown.interval[1])? {
            numbers.push((unknown, key));
        }
    }
    Ok(numbers)
}

fn robot(number: usize, numbers: &[Felt], shares: &[f64]) -> Variation {
    let value = |((unknown, key), share): (&Felt, &f64)| {
        let value = unknown.at(*share) / key.si;
        (key.name.to_string(), format!("{value:.4e}"))
    };
    let mut changes: Changes = numbers.iter().zip(shares).map(value).collect();
    changes.push(("seed".into(), number.to_string()));
    Variation { label: format!("robot-{number}"), changes, group: String::new() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_assumed_number_has_a_key_of_its_own() {
        let keys: Vec<&str> = ASSUMED.iter().filter_map(|unknown| Some(named(KEYS, unknown.key)?.name)).collect();
        assert_eq!(keys.len(), ASSUMED.len(), "{keys:?}");
        assert!(keys.iter().enumerate().all(|(i, key)| !keys[..i].contains(key)), "{keys:?}");
    }

    /// The mass factor and the damping that the program chooses; contact of the cPAM asks for less mass.
    #[test]
    fn numerical_settings_are_a_third_and_three_times_what_the_robot_has() {
        for (robot, mass_factor) in [("epam", 3.6), ("cpam", 2.4)] {
            let (scenario, run) = RunSource::new(robot, models::shipped(robot).unwrap()).robot_run().unwrap();
            let all = numerics(&scenario, &run).unwrap();
            let written = |label: &str| -> f64 {
                let found = all.iter().find(|v| v.label == label).unwrap_or_else(|| panic!("{label}"));
                found.changes[0].1.parse().unwrap()
            };
            let damping_1_s = run.problem(&scenario).unwrap().settings.mass_damping_1_s;
            for (key, own) in [("mass_factor", mass_factor), ("mass_damping_1_s", damping_1_s), ("rest_s", 0.72)] {
                // A factor below 1 is out of bounds.
                let third = if key == "mass_factor" { f64::max(own / 3.0, 1.0) } else { own / 3.0 };
                assert!((written(&format!("{key}-third")) / third - 1.0).abs() < 1e-3, "{robot} {key}");
                assert!((written(&format!("{key}-triple")) / (3.0 * own) - 1.0).abs() < 1e-3, "{robot} {key}");
            }
            assert!(all[0].label == AS_IT_IS && all[0].changes.is_empty());
        }
    }
}
