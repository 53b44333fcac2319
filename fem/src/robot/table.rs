//! The table `[fem]` of a robot's scenario, and single settings of it typed elsewhere.
//!
//! ```toml
//! [fem]
//! pressures_kpa = [10, 20, 30]
//! mesh_mm = 4
//! bond = 0.5
//! ```
//!
//! `model` is read first, every other key overrides it. All keys: [`KEYS`] and `docs/scenario.md`.

use std::collections::BTreeMap;

use models::{CHANNELS, Scenario};
use serde::Deserialize;
use toml::{Spanned, Value};

use super::keys::{KEYS, OTHERS};
use super::loading::highest_pa;
use super::loads::{self, PRESSURES, numbers, triple};
use super::{Preset, RobotRun, RobotSettings};
use crate::case::range::named;
use crate::case::range::{
    Checked, FreeTable, LENGTH, POSITION, PRESSURE, Range, choice, find, number, plain, plain_number, refuse, switch,
    text, unknown_name,
};
use crate::problem::{Obstacle, ObstacleShape};
use crate::{FemError, Result};

const MESHES: &str = "write the element sizes of body and actuator of every run: [[8, 4], [8, 3]]";
const ELEMENT: Range = Range { si: 1e-3, ..plain(0.5, 50.0, MESHES) };

/// Shortest time at each pressure over the actuator's ramp, unless `hold_s` is given.
const HOLD: f64 = 0.03;

#[derive(Deserialize)]
struct File {
    fem: Option<Spanned<FreeTable>>,
}

impl RobotRun {
    /// Reads `[fem]` of a scenario's text; `scenario` is its parsed form.
    ///
    /// # Errors
    /// [`FemError::Case`] with its place in `[fem]`: an unknown key, a number out of bounds, a pressure below the body's.
    pub fn parse(text: &str, scenario: &Scenario) -> Result<RobotRun> {
        let file: File = toml::from_str(text)
            .map_err(|error| FemError::Case { message: format!("{}\n", error.message()), span: error.span() })?;
        let empty = FreeTable::new();
        let table = file.fem.as_ref().map_or(&empty, |table| table.get_ref());
        let model = find(table, "model").map_or(Ok(Preset::default()), |value| word("model", value, &Preset::ALL))?;
        let mut run = RobotRun {
            model,
            set: table.keys().map(|key| key.get_ref().clone()).filter(|key| key != "model").collect(),
            settings: model.settings(),
            separate: model == Preset::Paper,
            pressures_pa: usual_pressures(scenario),
            ..RobotRun::default()
        };
        // What others override or need comes first, whatever their order.
        let first = |name: &str| name == "mesh_mm" || name == "obstacle_mm";
        let (before, after): (Vec<_>, Vec<_>) = table.iter().partition(|(key, _)| first(key.get_ref()));
        before.into_iter().chain(after).try_for_each(|(key, value)| read(&mut run, key, value))?;
        if run.settings.hold_s > 0.0 && run.set.iter().all(|key| key != "hold_s") {
            run.settings.hold_s = run.settings.hold_s.max(HOLD * run.settings.actuator_ramp_s);
        }
        run.settings.actuator_pa = run.pressures_pa.iter().map(highest_pa).fold(0.0, f64::max);
        above_body(&run, scenario, table)?;
        loads::check(&run, table)?;
        Ok(run)
    }
}

fn usual_pressures(scenario: &Scenario) -> Vec<[f64; CHANNELS]> {
    let above: Vec<f64> = scenario.pressures_pa.iter().copied().filter(|p| *p >= scenario.p_body_pa).collect();
    let usual = match above[..] {
        [] => vec![RobotSettings::default().actuator_pa],
        _ => above,
    };
    usual.into_iter().map(|pa| [pa; CHANNELS]).collect()
}

fn read(run: &mut RobotRun, key: &Spanned<String>, value: &Spanned<Value>) -> Checked<()> {
    let name = key.get_ref().as_str();
    if let Some(known) = named(KEYS, name) {
        return known.read(&mut run.settings, value);
    }
    match name {
        "model" => {}
        "separate" => run.separate = switch(name, value, "as the model has it")?,
        "base" => run.settings.encastre = word(name, value, &[("pinned", false), ("encastre", true)])?,
        "pressures_kpa" => run.pressures_pa = pressures(value)?,
        "meshes_mm" => run.meshes_m = meshes(value)?,
        "contact" => run.settings.contact = Some(switch(name, value, "where the pattern folds")?),
        "taped" => run.settings.taped_at_seams = word(name, value, &[("face", false), ("seams", true)])?,
        "selective_mass" => run.settings.selective_mass = switch(name, value, "short waves are heavy then")?,
        "tip_force_n" | "gravity_m_s2" => loads::read(run, name, value)?,
        "obstacle_mm" => {
            let [x, y, radius] = triple(name, value, &POSITION)?;
            number("its radius", radius * 1e3, value.span(), &LENGTH)?;
            let shape = ObstacleShape::Cylinder { point: [x, y, 0.0], axis: [0.0, 0.0, 1.0], radius_m: radius };
            run.obstacle = Some(Obstacle { shape, friction: 0.0, motion: None });
        }
        "obstacle_moves_mm" | "obstacle_friction" if run.obstacle.is_none() => {
            let message = format!("{name} without an obstacle");
            return refuse(message, "add obstacle_mm = [x, y, radius]", key.span());
        }
        "obstacle_moves_mm" => loads::read(run, name, value)?,
        "obstacle_friction" => {
            let friction = number(name, plain_number(name, value)?, value.span(), &plain(0.0, 2.0, "Coulomb"))?;
            for obstacle in run.obstacle.iter_mut() {
                obstacle.friction = friction;
            }
        }
        _ => {
            let known: Vec<&str> = OTHERS.into_iter().chain(KEYS.iter().map(|k| k.name)).collect();
            return Err(unknown_name("key", key, &known));
        }
    }
    Ok(())
}

fn word<T: Copy>(name: &str, value: &Spanned<Value>, known: &[(&str, T)]) -> Checked<T> {
    choice(name, &text(name, value)?, known)
}

/// Each a number for all channels, or a list with one for each.
fn pressures(value: &Spanned<Value>) -> Checked<Vec<[f64; CHANNELS]>> {
    let Some(list) = value.get_ref().as_array() else {
        return refuse("pressures_kpa must be a list", PRESSURES, value.span());
    };
    let one = |entry: &Value| {
        let channels = entry.as_array().cloned().unwrap_or_else(|| vec![entry.clone(); CHANNELS]);
        let mut found = numbers("pressures_kpa", &Spanned::new(value.span(), Value::Array(channels)), &PRESSURE)?;
        if found.is_empty() || found.len() > CHANNELS {
            let message = format!("pressures_kpa has {} channels; there are 1 to {CHANNELS}", found.len());
            return refuse(message, PRESSURES, value.span());
        }
        found.resize(CHANNELS, 0.0);
        Ok(std::array::from_fn(|channel| found[channel]))
    };
    let found: Vec<[f64; CHANNELS]> = list.iter().map(one).collect::<Checked<_>>()?;
    if found.is_empty() {
        return refuse("pressures_kpa names no pressure", PRESSURES, value.span());
    }
    Ok(found)
}

fn meshes(value: &Spanned<Value>) -> Checked<Vec<[f64; 2]>> {
    let told = || refuse("meshes_mm needs two meshes or more", MESHES, value.span());
    let Some(list) = value.get_ref().as_array().filter(|list| list.len() > 1) else { return told() };
    let one = |pair: &Value| {
        let sizes = numbers("meshes_mm", &Spanned::new(value.span(), pair.clone()), &ELEMENT)?;
        sizes.try_into().or_else(|_| refuse("a mesh of meshes_mm needs two sizes", MESHES, value.span()))
    };
    let found: Vec<[f64; 2]> = list.iter().map(one).collect::<Checked<_>>()?;
    match (1..found.len()).find(|i| found[..*i].contains(&found[*i])) {
        Some(i) => refuse(format!("meshes_mm has {:?} twice", found[i].map(|m| m * 1e3)), MESHES, value.span()),
        None => Ok(found),
    }
}

/// Every strip is flat without pressure or above the body's, and one of them is above.
fn above_body(run: &RobotRun, scenario: &Scenario, table: &FreeTable) -> Checked<()> {
    let body_pa = scenario.p_body_pa;
    let low = |channels: &[f64; CHANNELS]| {
        let of_strips = || scenario.strips().map(|strip| channels[strip.channel]);
        let highest = of_strips().fold(0.0, f64::max);
        of_strips().chain([highest]).find(|p| *p < body_pa && (*p > 0.0 || highest == 0.0))
    };
    let Some(low) = run.pressures_pa.iter().find_map(low) else { return Ok(()) };
    let [low, body] = [low, body_pa].map(|p| p * 1e-3);
    let span = find(table, "pressures_kpa").map(Spanned::span);
    let message = format!("an actuator at {low} kPa in a body at {body} kPa stays flat\nraise the actuator pressure");
    Err(FemError::Case { message, span })
}

/// The scenario's text with keys of `[fem]` set to other values, which are written as in TOML; `None` if the table
/// cannot be separated from the text around it.
///
/// ```
/// let text = fem::robot::with_fem("name = \"a\"\n[fem]\nbond = 1 # glued\nhourglass = 0.01\n[body]\n", &[("bond", "0.5")]);
/// assert_eq!(text.unwrap(), "name = \"a\"\n[body]\n\n[fem]\nbond = 0.5\nhourglass = 0.01\n");
/// ```
pub fn with_fem(text: &str, changes: &[(&str, &str)]) -> Option<String> {
    if changes.is_empty() {
        return Some(text.to_string());
    }
    let before: toml::Table = text.parse().ok()?;
    let own = before.get("fem").and_then(Value::as_table).cloned().unwrap_or_default();
    let mut all: BTreeMap<String, String> = own.iter().map(|(key, value)| (key.clone(), value.to_string())).collect();
    for (key, value) in changes {
        if *key == "mesh_mm" {
            all.remove("body_mesh_mm");
            all.remove("actuator_mesh_mm");
        }
        // One mesh in place of a study of several.
        if ["mesh_mm", "body_mesh_mm", "actuator_mesh_mm"].contains(key) {
            all.remove("meshes_mm");
        }
        all.insert(key.to_string(), value.to_string());
    }
    let mut inside = false;
    let mut out = String::new();
    for line in text.lines() {
        let head = line.split('#').next().unwrap_or_default().trim();
        inside = if head.starts_with('[') { head == "[fem]" } else { inside };
        if !inside {
            out.push_str(line);
            out.push('\n');
        }
    }
    let rest: toml::Table = out.parse().ok()?;
    let same = before.iter().filter(|(key, _)| *key != "fem").eq(rest.iter());
    out.push_str("\n[fem]\n");
    all.iter().for_each(|(key, value)| out.push_str(&format!("{key} = {value}\n")));
    same.then_some(out)
}
