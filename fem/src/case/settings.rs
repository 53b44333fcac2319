//! Numerical settings and outputs of a case.

use super::Outputs;
use super::load::{part_names, set_name};
use super::range::{Checked, POSITION, Range, TIME, choice, direction, optional, plain, refuse, si};
use super::raw::{RawOutput, RawSettings};
use crate::mesh::Mesh;
use crate::output::picture::Viewpoint;
use crate::policy;
use crate::problem::{Guards, MassScaling, Settings};
use toml::Value;

const END: Range = Range { low: 1e-6, too_small: "a run needs some time; 1.1 is the paper's", ..TIME };
const STEP: Range = Range {
    low: 1e-10,
    high: 0.01,
    too_small: "leave it out: the stable step is found by itself",
    too_large: "leave it out: the stable step is found by itself, usually some microseconds",
    ..TIME
};
const EVERY: Range = Range { low: 1e-7, too_small: "this is below a time step", ..TIME };
const CFL: Range = plain(0.01, 1.0, "0.9 is usual, 0.7 where fabric strains exceed 10 %");
const FACTOR: Range = plain(1.0, 1e6, "1 is the true mass; 10 makes the step 3.2 times longer");
const DAMPING: Range = plain(0.0, 1e5, "1/s; 5 for a robot, 100 for an airbag that shall come to rest quickly");
const VISCOSITY: Range = plain(0.0, 1.0, "a share of critical damping; 0.06 is usual");
const HOURGLASS: Range = plain(0.0, 1.0, "0.01 is usual; 0.05 and more lock");
const IMPERFECTION: Range = plain(0.0, 0.2, "a share of the element size; 0.001 is usual, 0 is a perfect start");
const CONTROL: Range = plain(0.0, 1.0, "share of the stored energy that hourglass control may hold; 0.15 is usual");
const SIDES: Range = plain(0.0, 1.0, "share of the nodes in contact that may change side of a layer; 0.05 is usual");
const RESIDUAL: Range = plain(1e-6, 1.0, "energy missing from the balance over the work done; 0.02 is usual");
const SPEED: Range = plain(0.0, 1e5, "m/s; 0 is the speed of sound in the stiffest fabric");

/// The paper's run: true masses, 1.1 s; its damping is not printed, 5 1/s is assumed.
fn paper() -> Settings {
    Settings { end_s: 1.1, mass_damping_1_s: 5.0, ..Settings::default() }
}

/// The paper's loading with masses times 10: 3.2 times fewer steps, still more than the 60 000 below which inertia shows.
fn quasi_static() -> Settings {
    Settings { mass_scaling: MassScaling::Fixed(10.0), ..paper() }
}

/// Settings of a run; what is not given comes from the preset, or from [`Settings::default`].
pub(super) fn settings(raw: &RawSettings) -> Checked<Settings> {
    type Preset = fn() -> Settings;
    let presets: [(&str, Preset); 2] = [("paper", paper), ("quasi-static", quasi_static)];
    let mut settings = match &raw.preset {
        Some(name) => choice("preset", name, &presets)?(),
        None => Settings::default(),
    };
    let set = |place: &mut f64, value: Option<f64>| *place = value.unwrap_or(*place);
    set(&mut settings.end_s, optional("end_s", &raw.end_s, &END)?);
    set(&mut settings.cfl, optional("cfl", &raw.cfl, &CFL)?);
    set(&mut settings.mass_damping_1_s, optional("mass_damping_1_s", &raw.mass_damping_1_s, &DAMPING)?);
    set(&mut settings.viscosity, optional("viscosity", &raw.viscosity, &VISCOSITY)?);
    set(&mut settings.hourglass, optional("hourglass", &raw.hourglass, &HOURGLASS)?);
    set(&mut settings.output_every_s, optional("output_every_s", &raw.output_every_s, &EVERY)?);
    set(&mut settings.imperfection, optional("imperfection", &raw.imperfection, &IMPERFECTION)?);
    settings.dt_s = optional("dt_s", &raw.dt_s, &STEP)?;
    settings.mass_scaling = mass_scaling(raw)?.unwrap_or(settings.mass_scaling);
    settings.selective_mass = raw.selective_mass.unwrap_or(settings.selective_mass);
    settings.mass_passes = passes(raw)?.unwrap_or(settings.mass_passes);
    settings.seed = seed(raw)?.unwrap_or(settings.seed);
    settings.guards = guards(raw)?;
    not_too_many(raw, &settings)?;
    Ok(settings)
}

fn mass_scaling(raw: &RawSettings) -> Checked<Option<MassScaling>> {
    let step = optional("target_step_s", &raw.target_step_s, &STEP)?;
    let Some(value) = &raw.mass_scaling else { return Ok(step.map(MassScaling::TargetStep)) };
    if step.is_some() {
        return refuse("mass_scaling and target_step_s at once", "keep one of the two", value.span());
    }
    let factor = match value.get_ref() {
        Value::String(word) if word == "none" => return Ok(Some(MassScaling::None)),
        Value::Integer(factor) => *factor as f64,
        Value::Float(factor) => *factor,
        other => {
            let message = format!("mass_scaling = {other} is not understood");
            let help = "write \"none\" or a factor such as 10; for a wanted step write target_step_s = 4e-6 instead";
            return refuse(message, help, value.span());
        }
    };
    super::range::number("mass_scaling", factor, value.span(), &FACTOR).map(|f| Some(MassScaling::Fixed(f)))
}

fn seed(raw: &RawSettings) -> Checked<Option<u64>> {
    let Some(seed) = &raw.seed else { return Ok(None) };
    match u64::try_from(*seed.get_ref()) {
        Ok(value) => Ok(Some(value)),
        Err(_) => refuse("seed is below zero", "write a whole number from 0 on", seed.span()),
    }
}

fn passes(raw: &RawSettings) -> Checked<Option<usize>> {
    let Some(passes) = &raw.mass_passes else { return Ok(None) };
    match passes.get_ref() {
        2 | 4 | 6 => Ok(Some(*passes.get_ref() as usize)),
        other => refuse(format!("mass_passes cannot be {other}"), "write 2, 4 or 6", passes.span()),
    }
}

fn guards(raw: &RawSettings) -> Checked<Guards> {
    let usual = Guards::default();
    Ok(Guards {
        residual: optional("guard_residual", &raw.guard_residual, &RESIDUAL)?.unwrap_or(usual.residual),
        speed_m_s: optional("guard_speed_m_s", &raw.guard_speed_m_s, &SPEED)?.unwrap_or(usual.speed_m_s),
        inverted: raw.guard_inverted.unwrap_or(usual.inverted),
        sides: optional("guard_sides", &raw.guard_sides, &SIDES)?.unwrap_or(usual.sides),
        hourglass: optional("guard_hourglass", &raw.guard_hourglass, &CONTROL)?.unwrap_or(usual.hourglass),
    })
}

fn not_too_many(raw: &RawSettings, settings: &Settings) -> Checked<()> {
    let outputs = settings.end_s / settings.output_every_s;
    match &raw.output_every_s {
        Some(every) if outputs > policy::MOST_OUTPUTS => {
            let message = format!("output_every_s = {} means {outputs:.0} outputs", every.get_ref());
            let help = format!("write at least {:e}", settings.end_s / policy::MOST_OUTPUTS);
            refuse(message, help, every.span())
        }
        _ => Ok(()),
    }
}

/// What a run writes besides the energy ledger.
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
