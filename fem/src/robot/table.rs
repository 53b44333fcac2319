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

use super::loading::highest_pa;
use super::loads::{self, Load};
use super::{Preset, RobotRun, RobotSettings};
use crate::FemError;
use crate::case::key::{Key, key, named};
use crate::case::range::{
    Checked, Free, LENGTH, POSITION, PRESSURE, Range, find, number, plain, plain_number, refuse, switch, unknown_name,
};
use crate::problem::{Obstacle, ObstacleShape};

/// All numbers of the table.
#[rustfmt::skip]
pub const KEYS: &[Key<RobotSettings>] = &[
    key("mesh_mm", 1e-3, [0.5, 50.0], "element size of body and actuator",
        |s| Some(s.body_size_m), |s, v| { s.body_size_m = v; s.actuator_size_m = v; }),
    key("body_mesh_mm", 1e-3, [0.5, 50.0], "element size of the body", |s| Some(s.body_size_m), |s, v| s.body_size_m = v),
    key("actuator_mesh_mm", 1e-3, [0.5, 50.0], "element size of the actuator and the strip under it",
        |s| Some(s.actuator_size_m), |s, v| s.actuator_size_m = v),
    key("ring_spacing", 1.0, [0.1, 10.0], "distance of the rings at the actuator over its element size",
        |s| s.ring_spacing, |s, v| s.ring_spacing = Some(v)),
    key("seam_row_mm", 1e-3, [0.1, 100.0], "length of the rows beside welds, from which rows grow to the distance of the rings",
        |s| s.seam_row_m, |s, v| s.seam_row_m = Some(v)),
    key("layer_gap_mm", 1e-3, [1e-4, 1.0], "distance between layers at the start",
        |s| Some(s.layer_gap_m), |s, v| s.layer_gap_m = v),
    key("weld_mm", 1e-3, [0.0, 100.0], "width of the welds across the robot; 0: a line", |s| Some(s.weld_m), |s, v| s.weld_m = v),
    key("bending_factor", 1.0, [0.0, 10.0], "bending stiffness of one sheet over that of a solid plate",
        |s| Some(s.bending_factor), |s, v| s.bending_factor = v),
    key("bending_share", 1.0, [1e-3, 1.0], "share of all bending stiffness that is kept, for a study of what carries a difference",
        |s| Some(s.bending_share), |s, v| s.bending_share = v),
    key("wrinkle_length", 1.0, [1e-3, 1e3], "length of wrinkles over that of the geometry; their load is inverse to it",
        |s| s.wrinkle_length, |s, v| s.wrinkle_length = Some(v)),
    key("bond", 1.0, [0.0, 1.0], "how far taped and glued plies bend as one", |s| Some(s.bond), |s, v| s.bond = v),
    key("tape_mm", 1e-3, [1e-3, 5.0], "thickness of the transfer tape", |s| Some(s.tape_m), |s, v| s.tape_m = v),
    key("tape_e_mpa", 1e6, [1e-3, 1e4], "Young's modulus of its adhesive", |s| Some(s.tape_e_pa), |s, v| s.tape_e_pa = v),
    key("tape_margin_mm", 1e-3, [0.0, 100.0], "width of the taped sheet beyond the welds along its sides",
        |s| Some(s.tape_margin_m), |s, v| s.tape_margin_m = v),
    key("glue_mm", 1e-3, [1e-3, 5.0], "thickness of the glue film", |s| Some(s.glue_m), |s, v| s.glue_m = v),
    key("glue_e_mpa", 1e6, [1e-3, 1e4], "Young's modulus of the glue", |s| Some(s.glue_e_pa), |s, v| s.glue_e_pa = v),
    key("nu12", 1.0, [0.0, 0.9], "contraction along fill per stretch along warp of an anisotropic fabric",
        |s| s.nu12, |s, v| s.nu12 = Some(v)),
    key("sheet_mm", 1e-3, [1e-3, 5.0], "thickness of the actuator's sheet", |s| s.sheet_m, |s, v| s.sheet_m = Some(v)),
    key("sheet_e_mpa", 1e6, [0.1, 1e5], "Young's modulus of the actuator's sheet", |s| s.sheet_e_pa, |s, v| s.sheet_e_pa = Some(v)),
    key("body_sheet_mm", 1e-3, [1e-3, 5.0], "thickness of the body's sheet", |s| s.body_sheet_m, |s, v| s.body_sheet_m = Some(v)),
    key("body_sheet_e_mpa", 1e6, [0.1, 1e5], "Young's modulus of the body's sheet",
        |s| s.body_sheet_e_pa, |s, v| s.body_sheet_e_pa = Some(v)),
    key("weld_strength_n_per_m", 1.0, [1.0, 1e6], "force per length that a weld carries",
        |s| s.weld_strength_n_per_m, |s, v| s.weld_strength_n_per_m = Some(v)),
    key("density_kg_m3", 1.0, [50.0, 2e4], "mass per volume of fabrics, tape and glue",
        |s| Some(s.density_kg_m3), |s, v| s.density_kg_m3 = v),
    key("body_ramp_s", 1.0, [1e-4, 1e3], "duration of the body's ramp", |s| Some(s.body_ramp_s), |s, v| s.body_ramp_s = v),
    key("actuator_ramp_s", 1.0, [1e-4, 1e3], "duration of the actuator's ramp to its highest pressure, holds left out",
        |s| Some(s.actuator_ramp_s), |s, v| s.actuator_ramp_s = v),
    key("ramp_floor_kpa", 1e3, [1e-3, 1e6], "pressure from which the actuator's grows by equal shares in equal times",
        |s| s.ramp_floor_pa, |s, v| s.ramp_floor_pa = Some(v)),
    key("hold_s", 1.0, [0.0, 1e3], "time at each pressure before the robot is watched", |s| Some(s.hold_s), |s, v| s.hold_s = v),
    key("rest_s", 1.0, [0.0, 1e3], "longest time that a hold then waits until the tip is at rest; six times the ramp unless written",
        |s| s.rest_s, |s, v| s.rest_s = Some(v)),
    key("mass_factor", 1.0, [1.0, 1e4], "square of the step over the time of sound through the smallest element",
        |s| s.mass_factor, |s, v| s.mass_factor = Some(v)),
    key("mass_passes", 1.0, [2.0, 6.0], "passes of the selective masses, 2, 4 or 6: more allow longer steps and make longer waves heavy",
        |s| s.mass_passes.map(|n| n as f64), |s, v| s.mass_passes = Some(v as usize)),
    key("creep", 1.0, [1e-6, 1.0], "movement of the tip that a hold does not wait for, over its displacement",
        |s| Some(s.creep), |s, v| s.creep = v),
    key("cfl", 1.0, [1e-3, 1.0], "share of the stable step that is used", |s| Some(s.cfl), |s, v| s.cfl = v),
    key("viscosity", 1.0, [0.0, 10.0], "in-plane viscosity as a share of critical damping of the highest mode",
        |s| Some(s.viscosity), |s, v| s.viscosity = v),
    key("mass_damping_1_s", 1.0, [0.0, 1e5], "mass damping; 1.4 times the tip's lowest frequency unless written",
        |s| s.mass_damping_1_s, |s, v| s.mass_damping_1_s = Some(v)),
    key("hourglass", 1.0, [0.0, 1.0], "hourglass coefficient", |s| Some(s.hourglass), |s, v| s.hourglass = v),
    key("guard_hourglass", 1.0, [0.0, 1.0], "share of the stored energy that hourglass control may hold at the end",
        |s| Some(s.guard_hourglass), |s, v| s.guard_hourglass = v),
    key("imperfection", 1.0, [0.0, 0.2], "random offset of the nodes over the element size",
        |s| Some(s.imperfection), |s, v| s.imperfection = v),
    key("waviness_mm", 1e-3, [0.0, 1.0], "departure of the sewn shape from the pattern, root mean square along each axis",
        |s| Some(s.waviness_m), |s, v| s.waviness_m = v),
    key("seed", 1.0, [0.0, 4e15], "seed of imperfection and waviness_mm", |s| Some(s.seed as f64), |s, v| s.seed = v as u64),
];

/// Keys that a study of the numerics varies: settings of the computation, on which no tip should depend, and the length of wrinkles.
#[rustfmt::skip]
pub const NUMERICAL: [&str; 16] = [
    "ring_spacing", "seam_row_mm", "layer_gap_mm", "wrinkle_length", "body_ramp_s", "actuator_ramp_s", "ramp_floor_kpa", "hold_s",
    "rest_s", "creep", "mass_factor", "cfl", "viscosity", "mass_damping_1_s", "hourglass", "imperfection",
];

/// Keys that are no single number.
pub const OTHERS: [&str; 13] = [
    "model",
    "taped",
    "pressures_kpa",
    "separate",
    "meshes_mm",
    "base",
    "contact",
    "selective_mass",
    "tip_force_n",
    "gravity_m_s2",
    "obstacle_mm",
    "obstacle_friction",
    "obstacle_moves_mm",
];

/// How `meshes_mm` is written.
const MESHES: &str = "write the element sizes of body and actuator of every run: [[8, 4], [8, 3]]";
const ELEMENT: Range = Range { si: 1e-3, ..plain(0.5, 50.0, MESHES) };

/// Shortest time at each pressure over the actuator's ramp, unless `hold_s` is given.
const HOLD: f64 = 0.03;

#[derive(Deserialize)]
struct File {
    fem: Option<Spanned<Free>>,
}

/// What a scenario says about its finite element run.
///
/// # Errors
/// [`FemError::Case`] with its place: an unknown key, a number out of bounds, a pressure below the body's.
pub(super) fn parse(text: &str, scenario: &Scenario) -> Result<RobotRun, FemError> {
    let file: File = toml::from_str(text)
        .map_err(|error| FemError::Case { message: format!("{}\n", error.message()), span: error.span() })?;
    let empty = Free::new();
    let table = file.fem.as_ref().map_or(&empty, |table| table.get_ref());
    let model = model(table)?;
    let mut run = RobotRun {
        model,
        set: table.keys().map(|key| key.get_ref().clone()).filter(|key| key != "model").collect(),
        settings: model.settings(),
        separate: model.separate(),
        pressures_pa: usual_pressures(scenario),
        tip_force_n: Load::default(),
        gravity_m_s2: Load::default(),
        obstacle: None,
        obstacle_moves_m: Vec::new(),
        start: None,
        meshes_m: Vec::new(),
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

fn usual_pressures(scenario: &Scenario) -> Vec<[f64; CHANNELS]> {
    let above: Vec<f64> = scenario.pressures_pa.iter().copied().filter(|p| *p >= scenario.p_body_pa).collect();
    let usual = if above.is_empty() { vec![RobotSettings::default().actuator_pa] } else { above };
    usual.into_iter().map(|pa| [pa; CHANNELS]).collect()
}

fn model(table: &Free) -> Checked<Preset> {
    let Some(value) = find(table, "model") else { return Ok(Preset::default()) };
    let known = || format!("known: {}", Preset::ALL.map(Preset::name).join(", "));
    let unknown = || refuse(format!("unknown model {}", value.get_ref()), known(), value.span());
    value.get_ref().as_str().and_then(Preset::named).map_or_else(unknown, Ok)
}

fn read(run: &mut RobotRun, key: &Spanned<String>, value: &Spanned<Value>) -> Checked<()> {
    let name = key.get_ref().as_str();
    if let Some(known) = named(KEYS, name) {
        return known.read(&mut run.settings, value);
    }
    match name {
        "model" => {}
        "separate" => run.separate = switch(name, value, "as the model has it")?,
        "base" => run.settings.encastre = encastre(value)?,
        "pressures_kpa" => run.pressures_pa = pressures(value)?,
        "meshes_mm" => run.meshes_m = meshes(value)?,
        "contact" => run.settings.contact = Some(switch(name, value, "where the pattern folds")?),
        "taped" => run.settings.taped_at_seams = at_seams(value)?,
        "selective_mass" => run.settings.selective_mass = switch(name, value, "short waves are heavy then")?,
        "tip_force_n" | "gravity_m_s2" => loads::read(run, name, value)?,
        "obstacle_mm" => {
            let [x, y, radius] = triple(name, value, &POSITION)?;
            number("its radius", radius * 1e3, value.span(), &LENGTH)?;
            let shape = ObstacleShape::Cylinder { point: [x, y, 0.0], axis: [0.0, 0.0, 1.0], radius_m: radius };
            run.obstacle = Some(Obstacle { shape, friction: 0.0, motion: None });
        }
        "obstacle_moves_mm" if run.obstacle.is_some() => loads::read(run, name, value)?,
        "obstacle_moves_mm" => {
            return refuse("there is no obstacle to move", "add obstacle_mm = [x, y, radius]", key.span());
        }
        "obstacle_friction" => {
            let friction = number(name, plain_number(name, value)?, value.span(), &plain(0.0, 2.0, "Coulomb"))?;
            match &mut run.obstacle {
                Some(obstacle) => obstacle.friction = friction,
                None => {
                    return refuse("there is no obstacle to rub on", "add obstacle_mm = [x, y, radius]", key.span());
                }
            }
        }
        _ => {
            let known: Vec<&str> = OTHERS.into_iter().chain(KEYS.iter().map(|k| k.name)).collect();
            return Err(unknown_name("key", key, &known));
        }
    }
    Ok(())
}

fn encastre(value: &Spanned<Value>) -> Checked<bool> {
    match value.get_ref().as_str() {
        Some("pinned") => Ok(false),
        Some("encastre") => Ok(true),
        _ => refuse(format!("base cannot be {}", value.get_ref()), "write \"pinned\" or \"encastre\"", value.span()),
    }
}

fn at_seams(value: &Spanned<Value>) -> Checked<bool> {
    match value.get_ref().as_str() {
        Some("seams") => Ok(true),
        Some("face") => Ok(false),
        _ => refuse(format!("unknown place of the tape {}", value.get_ref()), "known: face, seams", value.span()),
    }
}

fn numbers(name: &str, value: &Spanned<Value>, range: &Range) -> Checked<Vec<f64>> {
    let Some(list) = value.get_ref().as_array() else {
        return refuse(format!("{name} must be a list"), "write numbers in brackets: [10, 20, 30]", value.span());
    };
    let one =
        |v: &Value| number(name, plain_number(name, &Spanned::new(value.span(), v.clone()))?, value.span(), range);
    list.iter().map(one).collect()
}

pub(super) fn triple(name: &str, value: &Spanned<Value>, range: &Range) -> Checked<[f64; 3]> {
    let found = numbers(name, value, range)?;
    found.try_into().or_else(|_| refuse(format!("{name} needs three numbers"), range.too_large, value.span()))
}

/// Each a number for all channels, or a list with one for each.
fn pressures(value: &Spanned<Value>) -> Checked<Vec<[f64; CHANNELS]>> {
    const HOW: &str = "write for example [10, 20, 30], or with channels [[20, 10], [30, 15]]";
    let Some(list) = value.get_ref().as_array() else {
        return refuse("pressures_kpa must be a list", HOW, value.span());
    };
    let one = |entry: &Value| {
        let channels = entry.as_array().cloned().unwrap_or_else(|| vec![entry.clone(); CHANNELS]);
        let mut found = numbers("pressures_kpa", &Spanned::new(value.span(), Value::Array(channels)), &PRESSURE)?;
        if found.is_empty() || found.len() > CHANNELS {
            let message = format!("pressures_kpa has {} channels; there are 1 to {CHANNELS}", found.len());
            return refuse(message, HOW, value.span());
        }
        found.resize(CHANNELS, 0.0);
        Ok(std::array::from_fn(|channel| found[channel]))
    };
    let found: Vec<[f64; CHANNELS]> = list.iter().map(one).collect::<Checked<_>>()?;
    if found.is_empty() {
        return refuse("pressures_kpa names no pressure", HOW, value.span());
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
fn above_body(run: &RobotRun, scenario: &Scenario, table: &Free) -> Checked<()> {
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

/// The scenario's text with keys of `[fem]` set to other values, which are written as in TOML; `None` if the table cannot be
/// told from the text around it.
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
