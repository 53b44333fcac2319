//! Chambers, supports, rigid bodies, forces, gravity, obstacles and contact of a case.

use super::range::{
    ATMOSPHERE, Checked, GAP, GAUGE, LENGTH, POSITION, Range, TIME, Text, TimeRows, amplitude, amplitudes, at_once,
    choice, direction, optional, plain, refuse, si, unknown_name, vector,
};
use super::raw::{RawCase, RawChamber, RawForce, RawObstacle, RawSupport};
use crate::mesh::Mesh;
use crate::problem::{
    Amplitude, Chamber, Contact, Gas, Gravity, NodalForce, Obstacle, ObstacleShape, Pressure, Rigid, Support,
};
use std::collections::BTreeSet;
use toml::Spanned;

type TextSpan = std::ops::Range<usize>;
/// Pressure over time of the paper's body: up within 0.1 s, then held.
const BODY: [f64; 2] = [0.0, 0.1];
/// Pressure over time of the paper's actuators: up from 0.1 s to 1.1 s.
const ACTUATOR: [f64; 2] = [0.1, 1.1];
const FACTOR: Range = plain(-1e3, 1e3, "a multiplier over time: 0 is off, 1 is all");
const FORCE: Range = plain(-1e5, 1e5, "write newtons: the sum over the set, [x, y, z]");
const ACCELERATION: Range = plain(-1e4, 1e4, "write m/s², for example [0, 0, -9.81]");
/// One litre per minute in m³/s.
const L_MIN: f64 = 1e-3 / 60.0;
const FLOW: Range = Range {
    si: L_MIN,
    unit: "L/min",
    ..plain(0.0, 1e4, "write litres per minute at the pressure and temperature of the room")
};
const LEAK: Range = Range { si: L_MIN * 1e-3, unit: "L/min per kPa", ..plain(0.0, 1e3, FLOW.too_large) };
const DEAD: Range = Range {
    si: 1e-6,
    unit: "cm³",
    ..plain(0.0, 1e6, "write cubic centimetres: a hose of 4 mm bore has 12.6 cm³ per metre")
};
const EXPONENT: Range = plain(1.0, 1.67, "1 is isothermal (slow), 1.4 adiabatic air (fast)");
const FRICTION: Range = plain(0.0, 2.0, "a Coulomb coefficient: 0 slides freely, 0.3 is usual for fabric");

/// Every chamber of the mesh, with its pressure.
pub(super) fn chambers(raw: &RawCase, mesh: &Mesh) -> Checked<Vec<Chamber>> {
    let known: BTreeSet<&str> = mesh.parts.iter().flat_map(|p| [&p.front, &p.back]).flatten().map(|c| &**c).collect();
    let list: Vec<&str> = known.iter().copied().collect();
    if let Some(name) = known.iter().find(|c| !raw.chamber.keys().any(|k| k.get_ref() == **c)) {
        let message = format!("the mesh has a chamber `{name}` without a pressure");
        let help = format!("add [chamber.{name}] with pressure_kPa = 0 or more");
        return refuse(message, help, raw.mesh.span());
    }
    let build = |(name, table): (&Text, &Spanned<RawChamber>)| {
        if !known.contains(name.get_ref().as_str()) {
            return Err(unknown_name("chamber", name, &list));
        }
        let open_axis = open_axis(table.get_ref())?;
        Ok(Chamber { name: name.get_ref().clone(), pressure: pressure(table)?, open_axis })
    };
    raw.chamber.iter().map(build).collect()
}

/// Axes along which a chamber is open.
pub(super) fn open_axis(raw: &RawChamber) -> Checked<Option<[bool; 3]>> {
    raw.open_axis.as_ref().map(|text| axes("open_axis", text)).transpose()
}

fn pressure(table: &Spanned<RawChamber>) -> Checked<Pressure> {
    let raw = table.get_ref();
    let filling = filling(table)?;
    let atmosphere_pa = optional("atmosphere_kPa", &raw.atmosphere_kpa, &ATMOSPHERE)?.unwrap_or(101_325.0);
    if let Some(low) = lowest(&filling).filter(|low| *low < -atmosphere_pa) {
        let message = format!("cannot fill to {} kPa: a vacuum is {} kPa", low * 1e-3, -atmosphere_pa * 1e-3);
        let help = "write gauge pressures, from minus atmosphere_kPa on";
        return refuse(message, help, table.span());
    }
    let Some(at) = &raw.sealed_at_s else {
        // The room's pressure also bounds a vacuum.
        let atmosphere = span(&raw.atmosphere_kpa).filter(|_| lowest(&filling) >= Some(0.0));
        let keys: [(&str, Option<TextSpan>); 7] = [
            ("atmosphere_kPa", atmosphere),
            ("dead_volume_cm3", span(&raw.dead_volume_cm3)),
            ("polytropic_exponent", span(&raw.polytropic_exponent)),
            ("leak_l_min_kPa", span(&raw.leak_l_min_kpa)),
            ("inflow_l_min", span(&raw.inflow_l_min)),
            ("inflow_smooth_s_l_min", span(&raw.inflow_smooth_s_l_min)),
            ("inflow_linear_s_l_min", span(&raw.inflow_linear_s_l_min)),
        ];
        return match keys.into_iter().find_map(|(key, span)| Some((key, span?))) {
            Some((key, span)) => refuse(
                format!("{key} is used by a sealed chamber only"),
                "add sealed_at_s, the time from which the gas decides the pressure (0 from the start), or remove it",
                span,
            ),
            None => Ok(Pressure::Set(filling)),
        };
    };
    let usual = Gas::default();
    Ok(Pressure::Sealed {
        filling,
        sealed_at_s: si("sealed_at_s", at, &TIME)?,
        gas: Gas {
            atmosphere_pa,
            dead_m3: optional("dead_volume_cm3", &raw.dead_volume_cm3, &DEAD)?.unwrap_or(usual.dead_m3),
            exponent: optional("polytropic_exponent", &raw.polytropic_exponent, &EXPONENT)?.unwrap_or(usual.exponent),
            leak_m3_s_pa: optional("leak_l_min_kPa", &raw.leak_l_min_kpa, &LEAK)?.unwrap_or(usual.leak_m3_s_pa),
            inflow_m3_s: inflow(raw)?.unwrap_or(usual.inflow_m3_s),
        },
    })
}

fn span<T>(value: &Option<Spanned<T>>) -> Option<TextSpan> {
    value.as_ref().map(Spanned::span)
}

/// Flow over time, as a constant or a curve.
fn inflow(raw: &RawChamber) -> Checked<Option<Amplitude>> {
    let curve = amplitude(&raw.inflow_smooth_s_l_min, &raw.inflow_linear_s_l_min, &FLOW)?;
    match (&raw.inflow_l_min, curve) {
        (Some(constant), Some(_)) => at_once("a constant inflow and a curve", constant.span()),
        (Some(constant), None) => Ok(Some(Amplitude::Constant(si("inflow_l_min", constant, &FLOW)?))),
        (None, curve) => Ok(curve),
    }
}

/// Least value that a supply ever sets \[Pa\].
pub(super) fn lowest(filling: &Amplitude) -> Option<f64> {
    match filling {
        Amplitude::Constant(value) => Some(*value),
        curve => curve.points().iter().map(|p| p.1).min_by(f64::total_cmp),
    }
}

fn filling(table: &Spanned<RawChamber>) -> Checked<Amplitude> {
    let raw = table.get_ref();
    let given = amplitude(&raw.smooth_s_kpa, &raw.linear_s_kpa, &GAUGE)?;
    let constant = optional("pressure_kPa", &raw.pressure_kpa, &GAUGE)?;
    let help = "write pressure_kPa = 5, or smooth_s_kPa = [[0, 0], [0.05, 5]]";
    match (constant, given, &raw.preset) {
        (Some(pa), None, None) => Ok(Amplitude::Constant(pa)),
        (Some(pa), None, Some(preset)) => {
            let [from, to] = choice("preset", preset, &[("body", BODY), ("actuator", ACTUATOR)])?;
            Ok(Amplitude::Smooth(vec![(from, 0.0), (to, pa)]))
        }
        (None, Some(curve), None) => Ok(curve),
        (None, _, Some(preset)) => {
            let message = "a preset needs the pressure it leads to";
            let help = "add pressure_kPa = 2, and no curve";
            refuse(message, help, preset.span())
        }
        (Some(_), Some(_), _) => refuse("a constant pressure and a curve at once", help, table.span()),
        (None, None, None) => refuse("a chamber without a pressure", help, table.span()),
    }
}

/// What happens in a vacuum without contact.
pub(super) fn vacuum(raw: &RawCase, chambers: &[Chamber]) -> Option<String> {
    let below = |chamber: &&Chamber| lowest(chamber.pressure.filling()) < Some(0.0);
    let chamber = chambers.iter().find(below).filter(|_| raw.contact.is_none())?;
    Some(format!(
        "chamber `{}` goes below the pressure of the room, and without [contact] its walls pass through each other where they meet",
        chamber.name
    ))
}

/// Supports; an encastre one gets its own node set in the mesh.
pub(super) fn supports(raw: &RawCase, mesh: &mut Mesh) -> Checked<Vec<Support>> {
    raw.support.iter().map(|s| support(s, mesh)).collect()
}

fn support(table: &Spanned<RawSupport>, mesh: &mut Mesh) -> Checked<Support> {
    let raw = table.get_ref();
    let mut set = set_name(&raw.set, mesh)?;
    let axes = match &raw.axes {
        Some(text) => axes("axes", text)?,
        None => [true; 3],
    };
    if raw.encastre == Some(true) {
        if axes != [true; 3] {
            let message = "an encastre edge holds all three axes";
            let help = "remove axes or encastre";
            return refuse(message, help, table.span());
        }
        set = encastre(mesh, &set);
    }
    Ok(Support { set, axes, motion: motion(&raw.smooth_s_mm, &raw.linear_s_mm)? })
}

/// Some of the letters x, y and z.
fn axes(key: &str, text: &Text) -> Checked<[bool; 3]> {
    let held = ['x', 'y', 'z'].map(|axis| text.get_ref().contains(axis));
    let letters = text.get_ref().chars().count();
    if letters == 0 || letters != held.iter().filter(|h| **h).count() {
        let message = format!("{key} = \"{}\" is not understood", text.get_ref());
        let help = "write some of x, y and z, each once, for example \"xyz\" or \"z\"";
        return refuse(message, help, text.span());
    }
    Ok(held)
}

/// Adds the set of an edge that cannot turn, and names it.
pub(crate) fn encastre(mesh: &mut Mesh, set: &str) -> String {
    let wider = with_next_row(mesh, &mesh.sets[set]);
    let name = format!("{set} and the row next to it");
    mesh.sets.insert(name.clone(), wider);
    name
}

/// The nodes, and all that share an element with them: shells have no rotations, so two rows make a clamped edge.
fn with_next_row(mesh: &Mesh, nodes: &[u32]) -> Vec<u32> {
    let seed: BTreeSet<u32> = nodes.iter().copied().collect();
    let mut wider = seed.clone();
    for element in mesh.faces().filter(|nodes| nodes.iter().any(|n| seed.contains(n))) {
        wider.extend(element);
    }
    wider.into_iter().collect()
}

/// Rows of time and displacement along x, y, z, as smooth steps or straight lines.
fn motion(smooth: &TimeRows<4>, linear: &TimeRows<4>) -> Checked<Option<[Amplitude; 3]>> {
    Ok(amplitudes(smooth, linear, &POSITION)?.and_then(|axes| axes.try_into().ok()))
}

/// A node set of the mesh, by name.
pub(super) fn set_name(name: &Text, mesh: &Mesh) -> Checked<String> {
    let known: Vec<&str> = mesh.sets.keys().map(String::as_str).collect();
    match mesh.sets.get(name.get_ref()) {
        None => Err(unknown_name("node set", name, &known)),
        Some(nodes) if nodes.is_empty() => {
            let message = format!("the node set `{}` is empty", name.get_ref());
            let help = "choose another set";
            refuse(message, help, name.span())
        }
        Some(_) => Ok(name.get_ref().clone()),
    }
}

pub(super) fn part_names(names: &[Text], mesh: &Mesh) -> Checked<Vec<String>> {
    let known: Vec<&str> = mesh.part_names();
    match names.iter().find(|name| !known.contains(&name.get_ref().as_str())) {
        Some(name) => Err(unknown_name("part", name, &known)),
        None => Ok(names.iter().map(|name| name.get_ref().clone()).collect()),
    }
}

pub(super) fn rigid(raw: &RawCase, mesh: &Mesh) -> Checked<Vec<Rigid>> {
    raw.rigid.iter().map(|r| Ok(Rigid { set: set_name(&r.set, mesh)? })).collect()
}

pub(super) fn forces(raw: &RawCase, mesh: &Mesh) -> Checked<Vec<NodalForce>> {
    let force = |f: &RawForce| {
        Ok(NodalForce {
            set: set_name(&f.set, mesh)?,
            total_n: vector("total_n", &f.total_n, &FORCE)?,
            amplitude: amplitude(&f.smooth_s, &f.linear_s, &FACTOR)?.unwrap_or(Amplitude::Constant(1.0)),
        })
    };
    raw.force.iter().map(force).collect()
}

pub(super) fn gravity(raw: &RawCase) -> Checked<Option<Gravity>> {
    let Some(g) = &raw.gravity else { return Ok(None) };
    Ok(Some(Gravity {
        g_m_s2: vector("g_m_s2", &g.g_m_s2, &ACCELERATION)?,
        amplitude: amplitude(&g.smooth_s, &g.linear_s, &FACTOR)?.unwrap_or(Amplitude::Constant(1.0)),
    }))
}

pub(super) fn obstacles(raw: &RawCase) -> Checked<Vec<Obstacle>> {
    raw.obstacle.iter().map(obstacle).collect()
}

fn obstacle(table: &Spanned<RawObstacle>) -> Checked<Obstacle> {
    let raw = table.get_ref();
    let round = choice("shape", &raw.shape, &[("plane", false), ("cylinder", true)])?;
    let point = vector("point_mm", &raw.point_mm, &POSITION)?;
    let shape = match (round, &raw.normal, &raw.axis, &raw.radius_mm) {
        (false, Some(normal), None, None) => ObstacleShape::Plane { point, normal: direction("normal", normal)? },
        (false, ..) => return refuse("a plane has point_mm and normal", "normal = [0, 0, 1]", table.span()),
        (true, None, Some(axis), Some(radius)) => ObstacleShape::Cylinder {
            point,
            axis: direction("axis", axis)?,
            radius_m: si("radius_mm", radius, &LENGTH)?,
        },
        (true, ..) => {
            let message = "a cylinder has point_mm, axis and radius_mm";
            let help = "axis = [0, 1, 0]";
            return refuse(message, help, table.span());
        }
    };
    let friction = optional("friction", &raw.friction, &FRICTION)?.unwrap_or(0.0);
    Ok(Obstacle { shape, friction, motion: motion(&raw.smooth_s_mm, &raw.linear_s_mm)? })
}

pub(super) fn contact(raw: &RawCase, mesh: &Mesh) -> Checked<Option<Contact>> {
    let (Some(c), usual) = (&raw.contact, Contact::default()) else { return Ok(None) };
    Ok(Some(Contact {
        friction: optional("friction", &c.friction, &FRICTION)?.unwrap_or(usual.friction),
        gap_m: optional("gap_mm", &c.gap_mm, &GAP)?.unwrap_or(usual.gap_m),
        thickness_m: optional("thickness_mm", &c.thickness_mm, &GAP)?.unwrap_or(usual.thickness_m),
        parts: part_names(&c.parts, mesh)?,
        edges: c.edges.unwrap_or(usual.edges),
    }))
}
