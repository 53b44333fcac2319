//! Numerical settings and outputs of a case.

use super::load::{part_names, set_name};
use super::range::{
    Checked, FreeTable, POSITION, Range, at_once, choice, direction, find, number, plain, refuse, si, switch, text,
    unknown_name,
};
use super::range::{DeclaredKey, key, named};
use super::raw::RawOutput;
use crate::mesh::Mesh;
use crate::output::picture::Viewpoint;
use crate::policy;
use crate::problem::{MassScaling, Settings};
use toml::{Spanned, Value};

/// Numbers of `[settings]`, each with bounds and meaning.
#[rustfmt::skip]
pub(super) const NUMBERS: &[DeclaredKey<Settings>] = &[
    key("end_s", 1.0, [1e-6, 1000.0], "a run needs some time, in seconds; 1.1 is the paper's", |s| Some(s.end_s), |s, v| s.end_s = v),
    key("cfl", 1.0, [0.01, 1.0], "0.9 is usual, 0.7 where fabric strains exceed 10 %", |s| Some(s.cfl), |s, v| s.cfl = v),
    key("dt_s", 1.0, [1e-10, 0.01], "leave it out: the program finds the stable step, usually some microseconds",
        |s| s.dt_s, |s, v| s.dt_s = Some(v)),
    key("target_step_s", 1.0, [1e-10, 0.01], "the step for which masses are raised, usually some microseconds",
        |s| match s.mass_scaling { MassScaling::TargetStep(dt) => Some(dt), _ => None },
        |s, v| s.mass_scaling = MassScaling::TargetStep(v)),
    key("mass_passes", 1.0, [2.0, 6.0], "passes of the selective masses: 2, 4 or 6",
        |s| Some(s.mass_passes as f64), |s, v| s.mass_passes = v as usize),
    key("mass_damping_1_s", 1.0, [0.0, 1e5], "1/s; 5 for a robot, 100 for an airbag that shall come to rest quickly",
        |s| Some(s.mass_damping_1_s), |s, v| s.mass_damping_1_s = v),
    key("viscosity", 1.0, [0.0, 1.0], "a share of critical damping; 0.06 is usual", |s| Some(s.viscosity), |s, v| s.viscosity = v),
    key("hourglass", 1.0, [0.0, 1.0], "0.01 is usual; 0.05 and more lock", |s| Some(s.hourglass), |s, v| s.hourglass = v),
    key("output_every_s", 1.0, [1e-7, 1000.0], "time between two outputs in seconds, of many steps",
        |s| Some(s.output_every_s), |s, v| s.output_every_s = v),
    key("imperfection", 1.0, [0.0, 0.2], "a share of the element size; 0.001 is usual, 0 is a perfect start",
        |s| Some(s.imperfection), |s, v| s.imperfection = v),
    key("seed", 1.0, [0.0, 4e15], "a whole number from 0 on", |s| Some(s.seed as f64), |s, v| s.seed = v as u64),
    key("guard_residual", 1.0, [1e-6, 1.0], "energy missing from the balance over the work done; 0.02 is usual",
        |s| Some(s.guards.residual), |s, v| s.guards.residual = v),
    key("guard_speed_m_s", 1.0, [0.0, 1e5], "m/s; 0 is the speed of sound in the stiffest fabric",
        |s| Some(s.guards.speed_m_s), |s, v| s.guards.speed_m_s = v),
    key("guard_sides", 1.0, [0.0, 1.0], "share of the nodes in contact that may change side of a layer; 0.05 is usual",
        |s| Some(s.guards.sides), |s, v| s.guards.sides = v),
    key("guard_hourglass", 1.0, [0.0, 1.0], "share of the stored energy that hourglass control may hold; 0.15 is usual",
        |s| Some(s.guards.hourglass), |s, v| s.guards.hourglass = v),
];
/// Keys that are no single number.
pub(super) const OTHERS: [&str; 4] = ["preset", "mass_scaling", "selective_mass", "guard_inverted"];
const FACTOR: Range = plain(1.0, 1e6, "1 is the true mass; 10 makes the step 3.2 times longer");

/// The paper's run: true masses, 1.1 s; its damping is not printed, 5 1/s is assumed.
fn paper() -> Settings {
    Settings { end_s: 1.1, mass_damping_1_s: 5.0, ..Settings::default() }
}

/// The paper's loading with masses times 10: 3.2 times fewer steps, still more than the 60 000 below which inertia shows.
fn quasi_static() -> Settings {
    Settings { mass_scaling: MassScaling::Fixed(10.0), ..paper() }
}

/// Settings of a run; missing keys come from the preset, or from [`Settings::default`].
pub(super) fn settings(table: &FreeTable) -> Checked<Settings> {
    type Preset = fn() -> Settings;
    let presets: [(&str, Preset); 2] = [("paper", paper), ("quasi-static", quasi_static)];
    let mut settings = match find(table, "preset") {
        Some(name) => choice("preset", &text("preset", name)?, &presets)?(),
        None => Settings::default(),
    };
    for (key, value) in table {
        match key.get_ref().as_str() {
            "preset" => {}
            "mass_scaling" if find(table, "target_step_s").is_some() => {
                return at_once("mass_scaling and target_step_s", value.span());
            }
            "mass_scaling" => settings.mass_scaling = mass_scaling(value)?,
            name @ "selective_mass" => settings.selective_mass = switch(name, value, "all waves keep their mass")?,
            name @ "guard_inverted" => settings.guards.inverted = switch(name, value, "such an element stops a run")?,
            name => match named(NUMBERS, name) {
                Some(number) => number.read(&mut settings, value)?,
                None => {
                    let known: Vec<&str> = OTHERS.into_iter().chain(NUMBERS.iter().map(|k| k.name)).collect();
                    return Err(unknown_name("key", key, &known));
                }
            },
        }
    }
    let outputs = settings.end_s / settings.output_every_s;
    match find(table, "output_every_s") {
        Some(every) if outputs > policy::MOST_OUTPUTS => {
            let message = format!("output_every_s = {} means {outputs:.0} outputs", every.get_ref());
            let help = format!("write at least {:e}", settings.end_s / policy::MOST_OUTPUTS);
            refuse(message, help, every.span())
        }
        _ => Ok(settings),
    }
}

fn mass_scaling(value: &Spanned<Value>) -> Checked<MassScaling> {
    let factor = match value.get_ref() {
        Value::String(word) if word == "none" => return Ok(MassScaling::None),
        Value::Integer(factor) => *factor as f64,
        Value::Float(factor) => *factor,
        other => {
            let message = format!("mass_scaling = {other} is not understood");
            let help = "write \"none\" or a factor such as 10; for a target step write target_step_s = 4e-6 instead";
            return refuse(message, help, value.span());
        }
    };
    number("mass_scaling", factor, value.span(), &FACTOR).map(MassScaling::Fixed)
}

/// What a run writes besides the energy ledger.
#[derive(Debug, Clone, PartialEq)]
pub struct Outputs {
    /// Node sets whose mean displacement is recorded.
    pub probes: Vec<String>,
    /// Stations of the centre line \[m\], along the axis through the reference shape; empty: no centre line.
    pub stations_m: Vec<f64>,
    /// Parts whose sections make the centre line; empty: all.
    pub station_parts: Vec<String>,
    /// Direction of the axis along which stations count.
    pub station_axis: [f64; 3],
    /// Write the deformed mesh at every output.
    pub frames: bool,
    /// Whether a picture of the end state is drawn.
    pub pictures: bool,
    /// Direction from which the picture is drawn.
    pub view: Viewpoint,
}

pub(super) fn outputs(raw: &RawOutput, mesh: &Mesh) -> Checked<Outputs> {
    let axis = raw.station_axis.as_ref().map(|axis| direction("station_axis", axis)).transpose()?;
    Ok(Outputs {
        probes: raw.probes.iter().map(|name| set_name(name, mesh)).collect::<Checked<_>>()?,
        stations_m: raw.stations_mm.iter().map(|s| si("stations_mm", s, &POSITION)).collect::<Checked<_>>()?,
        station_parts: part_names(&raw.station_parts, mesh)?,
        station_axis: axis.unwrap_or([1.0, 0.0, 0.0]),
        frames: raw.frames.unwrap_or(true),
        pictures: raw.pictures.unwrap_or(true),
        view: view(raw)?,
    })
}

fn view(raw: &RawOutput) -> Checked<Viewpoint> {
    let known = [
        ("isometric", Viewpoint::Isometric),
        ("isometric-z-up", Viewpoint::IsometricZUp),
        ("side", Viewpoint::Side),
        ("top", Viewpoint::Top),
        ("end", Viewpoint::End),
    ];
    raw.view.as_ref().map_or(Ok(Viewpoint::Isometric), |name| choice("view", name, &known))
}
