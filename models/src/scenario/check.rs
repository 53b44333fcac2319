//! Raw values → SI, with range checks that say what was probably meant.

use super::formulas::formulas;
use super::raw::{Body, Raw, RawActuator, RawZone};
use super::strips::{check_space, check_turns, more_strips, round_the_body};
use super::supply::line;
use super::{ActuatorChoice, BASES, EffectChoice, Scenario, Wall, Zone, order};
use crate::actuators::{self, ACTUATORS, ActuatorShape, BIAS, Family};
use crate::catalogue::Catalogue;
use crate::effects::Effect;
use crate::error::ScenarioError;
use crate::formula::Formula;
use crate::term::CHANNELS;
use spelling::units::Range;
use std::sync::Arc;
use toml::Spanned;

pub(super) type Checked<T> = Result<T, ScenarioError>;

const LENGTH: Range = Range::LENGTH;
const POSITION: Range = Range { name: "position", low: 0.0, too_small: "positions count from the base", ..LENGTH };
const PRESSURE: Range = Range::ACTUATOR_PRESSURE;
const MOST_PRESSURE: Range = Range { low: 0.001, too_small: "the inverse looks up to it", ..PRESSURE };
const STIFFNESS: Range = Range {
    name: "bending stiffness",
    unit: "N m²",
    too_small: "a stiffness is not negative",
    ..Range::plain(0.0, 1e3, "write N·m²; 1 N·m² is 1e6 N·mm²")
};
const HINGE: Range = Range {
    name: "hinge curvature",
    unit: "1/m",
    too_small: "it must be positive; 0.05 is the usual value",
    ..Range::plain(1e-6, 10.0, "write 1/m; 0.05 is the usual value")
};
const SHARE: Range = Range {
    name: "hinge moment share",
    ..Range::plain(0.0, 2.0, "1 is the collapse moment πp_bR³, 0.5 the first wrinkle")
};
const WALL: Range = Range {
    name: "wall stiffness",
    unit: "N/m",
    too_small: "this looks like N/mm: write N/m, for example 40000 for 200 MPa x 0.2 mm",
    ..Range::plain(100.0, 1e8, "write N/m, for example 40000 for 200 MPa x 0.2 mm")
};
const SHEAR: Range = Range { name: "wall shear stiffness", low: 0.0, too_small: "a stiffness is not negative", ..WALL };
const GAIN: Range = Range { name: "volume gain", ..Range::plain(0.05, 20.0, "1 is the plain pouch") };
const BIAS_ANGLE: Range = Range {
    name: "bias angle",
    unit: "deg",
    si: std::f64::consts::PI / 180.0,
    too_small: "write degrees from the axis; a bias cut has 45",
    ..Range::plain(15.0, 75.0, "write degrees from the axis; a muscle with yarns beyond 54.7 lengthens")
};

pub(super) fn scenario(raw: &Raw, text: &str) -> Checked<Scenario> {
    let body = raw.body.get_ref();
    let length_m = si(&body.length_mm, &LENGTH)?;
    let radius_m = radius(&body.radius_mm)?;
    let actuator = raw.actuator.as_ref().map_or(Ok(ActuatorChoice::NONE), |a| actuator(a, radius_m, length_m))?;
    let more_strips = more_strips(raw, &actuator, radius_m, length_m)?;
    let zones = raw.zone.iter().map(|z| zone(z, length_m, &actuator)).collect::<Checked<Vec<_>>>()?;
    let formulas = formulas(raw, text)?;
    let p_max = raw.actuator.as_ref().and_then(|a| a.get_ref().max_pressure_kpa.as_ref());
    let scenario = Scenario {
        name: raw.name.clone(),
        radius_m,
        length_m,
        p_body_pa: si(&body.pressure_kpa, &Range::BODY_PRESSURE)?,
        bending_stiffness: optional(&body.bending_stiffness_nm2, &STIFFNESS)?.unwrap_or(0.0),
        hinge_curvature: optional(&body.hinge_curvature_per_m, &HINGE)?.unwrap_or(0.05),
        hinge_share: optional(&body.hinge_moment_share, &SHARE)?.unwrap_or(1.0),
        wall: wall(body)?,
        // A beam has no actuator's side opposite which a generator stays taut: its axis keeps its length.
        centre_line_m: optional(&body.centre_line_mm, &POSITION)?.or((!actuator.exists()).then_some(0.0)),
        gravity_direction: gravity(body)?,
        actuator,
        more_strips,
        zones,
        markers_m: stations(&raw.markers.s_mm, length_m)?,
        pressures_pa: raw.predict.pressures_kpa.iter().map(|p| si(p, &PRESSURE)).collect::<Checked<Vec<_>>>()?,
        segments: segments(raw)?,
        p_max_pa: p_max.map(|p| si(p, &MOST_PRESSURE)).transpose()?.unwrap_or(100e3),
        line: raw.supply.as_ref().map(line).transpose()?,
        effects: effects_of(raw, &actuator, &formulas)?,
        formulas,
    };
    check_space(&scenario, raw)?;
    match (scenario.can_be_built(), &raw.actuator) {
        (Err(fault), Some(actuator)) => refuse(
            format!("robot: {fault}"),
            "change the sizes of the body, the actuator or its zones",
            actuator.span(),
        ),
        _ => Ok(scenario),
    }
}

pub(super) fn refuse<T>(message: String, help: impl Into<String>, span: std::ops::Range<usize>) -> Checked<T> {
    Err(ScenarioError { message, help: Some(help.into()), span: Some((span.start, span.end)) })
}

pub(super) fn si(value: &Spanned<f64>, range: &Range) -> Checked<f64> {
    range.si(range.name, *value.get_ref()).or_else(|(message, help)| refuse(message, help, value.span()))
}

/// A unit after its number; nothing where there is none.
pub(super) fn unit(name: &str) -> String {
    if name == "-" { String::new() } else { format!(" {name}") }
}

pub(super) fn optional(value: &Option<Spanned<f64>>, range: &Range) -> Checked<Option<f64>> {
    value.as_ref().map(|v| si(v, range)).transpose()
}

fn radius(value: &Spanned<f64>) -> Checked<f64> {
    si(value, &Range { name: "radius", high: 1000.0, ..LENGTH })
}

fn wall(body: &Body) -> Checked<Wall> {
    let stiffness_n_per_m = optional(&body.wall_stiffness_n_per_m, &WALL)?;
    let shear_n_per_m = optional(&body.wall_shear_n_per_m, &SHEAR)?;
    if let (Some(wall), Some(hinge)) = (&body.wall_stiffness_n_per_m, &body.hinge_curvature_per_m) {
        let message = format!("hinge_curvature_per_m beside a wall of {} N/m says the same twice", wall.get_ref());
        return refuse(message, "remove it: a wall has its own, pressure_kpa over E t", hinge.span());
    }
    let is_known = stiffness_n_per_m.or(shear_n_per_m).is_some();
    let basis = match &body.wall_basis {
        Some(word) if !is_known => {
            return refuse("wall_basis without a wall".into(), "add wall_stiffness_n_per_m, or remove it", word.span());
        }
        Some(word) => basis_of(word)?,
        None if is_known => "assumed".into(),
        None => String::new(),
    };
    Ok(Wall { stiffness_n_per_m, shear_n_per_m, basis })
}

fn gravity(body: &Body) -> Checked<[f64; 2]> {
    let Some(direction) = &body.gravity else { return Ok([0.0, -1.0]) };
    let [x, y] = **direction.get_ref();
    // Written so that NaN is refused as well.
    if (x.hypot(y) - 1.0).abs() <= 1e-3 {
        return Ok([x, y]);
    }
    let message = format!("gravity must be a unit vector in the x–y plane, not [{x}, {y}]");
    refuse(message, "[0, -1] points against the bend, [1, 0] along the robot", direction.span())
}

pub(super) fn actuator(raw: &Spanned<RawActuator>, radius_m: f64, length_m: f64) -> Checked<ActuatorChoice> {
    let a = raw.get_ref();
    let Some(kind) = actuators::by_name(a.kind.get_ref()) else {
        let known: Vec<&str> = ACTUATORS.iter().map(|a| a.name).collect();
        let message = format!("unknown actuator \"{}\"", a.kind.get_ref());
        return refuse(message, spelling::known(a.kind.get_ref(), &known), a.kind.span());
    };
    let shape = ActuatorShape {
        length_m: si(&a.length_mm, &LENGTH)?,
        width_m: si(&a.width_mm, &LENGTH)?,
        fold_m: optional(&a.fold_mm, &POSITION)?.unwrap_or(0.0),
        volume_gain: optional(&a.volume_gain, &GAIN)?.unwrap_or(1.0),
        bias_rad: bias(a, kind)?,
    };
    let count = *a.count.get_ref();
    if !(1..=10_000).contains(&count) {
        return refuse(format!("count must be from 1 to 10000, not {count}"), "units in series", a.count.span());
    }
    let start_m = optional(&a.start_mm, &POSITION)?.unwrap_or(0.0);
    let (arm_m, channel) = (optional(&a.arm_mm, &LENGTH)?, channel(&a.channel)?.unwrap_or(0));
    let (azimuth_rad, turns) = round_the_body(a)?;
    let count_of = count as usize;
    let choice = ActuatorChoice { kind, shape, count: count_of, start_m, arm_m, channel, azimuth_rad, turns };
    let end_m = start_m + choice.covered_m(radius_m);
    check_turns(a, &choice, radius_m)?;
    if end_m > length_m * (1.0 + 1e-9) {
        let message = format!(
            "{count} units of {} mm from {} mm end at {:.1} mm, beyond the body's {:.1} mm",
            a.length_mm.get_ref(),
            start_m * 1e3,
            end_m * 1e3,
            length_m * 1e3
        );
        return refuse(message, "lower count, length_mm or start_mm, or raise body.length_mm", a.count.span());
    }
    Ok(choice)
}

fn bias(a: &RawActuator, kind: &actuators::Actuator) -> Checked<f64> {
    match &a.bias_deg {
        Some(angle) if kind.family == Family::Pouch => {
            let message = format!("bias_deg is the angle of a muscle's yarns; a {} has none", kind.name);
            refuse(message, "leave the line out", angle.span())
        }
        angle => Ok(optional(angle, &BIAS_ANGLE)?.unwrap_or(BIAS)),
    }
}

fn channel(value: &Option<Spanned<i64>>) -> Checked<Option<usize>> {
    let Some(value) = value else { return Ok(None) };
    match usize::try_from(*value.get_ref()) {
        Ok(channel) if channel < CHANNELS => Ok(Some(channel)),
        _ => refuse(format!("channel must be 0 to {}", CHANNELS - 1), "number of the supply line", value.span()),
    }
}

fn zone(raw: &Spanned<RawZone>, length_m: f64, actuator: &ActuatorChoice) -> Checked<Zone> {
    let z = raw.get_ref();
    let sizes = [&z.length_mm, &z.width_mm, &z.fold_mm, &z.arm_mm].into_iter().any(Option::is_some);
    if !actuator.exists() && (sizes || z.channel.is_some() || z.passive == Some(false)) {
        return refuse("a zone of an actuator that is not there".into(), "add [actuator]", raw.span());
    }
    let (from_m, to_m) = (si(&z.from_mm, &POSITION)?, si(&z.to_mm, &POSITION)?);
    if from_m >= to_m || to_m > length_m * (1.0 + 1e-9) {
        let message = format!("a zone from {} to {} mm is not on the body", from_m * 1e3, to_m * 1e3);
        return refuse(message, format!("0 ≤ from_mm < to_mm ≤ {}", length_m * 1e3), z.to_mm.span());
    }
    Ok(Zone {
        from_m,
        to_m,
        radius_m: z.radius_mm.as_ref().map(radius).transpose()?,
        bending_stiffness: optional(&z.bending_stiffness_nm2, &STIFFNESS)?,
        passive: z.passive,
        unit_length_m: optional(&z.length_mm, &LENGTH)?,
        width_m: optional(&z.width_mm, &LENGTH)?,
        fold_m: optional(&z.fold_mm, &POSITION)?,
        arm_m: optional(&z.arm_mm, &LENGTH)?,
        channel: channel(&z.channel)?,
    })
}

fn stations(raw: &[Spanned<f64>], length_m: f64) -> Checked<Vec<f64>> {
    let mut stations: Vec<f64> = Vec::with_capacity(raw.len());
    for value in raw {
        let s = si(value, &Range::STATION)?;
        if s > length_m * (1.0 + 1e-9) {
            let message = format!("marker at {} mm is off the body of {} mm", value.get_ref(), length_m * 1e3);
            return refuse(message, "stations are measured along the undeformed body from its base", value.span());
        }
        if stations.last().is_some_and(|last| *last >= s) {
            return refuse("marker stations must rise".into(), "sort them from base to tip", value.span());
        }
        stations.push(s);
    }
    if let (Some(last), Some(value)) = (stations.last(), raw.last())
        && *last < 0.002
        && length_m > 0.05
    {
        return refuse("marker stations are all below 2 mm".into(), LENGTH.too_small, value.span());
    }
    Ok(stations)
}

fn segments(raw: &Raw) -> Checked<usize> {
    let Some(value) = &raw.predict.segments else { return Ok(12) };
    match *value.get_ref() {
        n @ 1..=2000 => Ok(n as usize),
        n => refuse(format!("segments must be from 1 to 2000, not {n}"), "12 is the usual value", value.span()),
    }
}

/// Words that may stand beside the parameters of an effect: how they are known.
const REMARKS: &[&str] = &["basis", "interval", "data", "date", "note"];
/// Those with which a value may lie beyond the usual bounds.
const KNOWN: &[&str] = &["measured", "published", "calibrated"];

fn effects_of(raw: &Raw, actuator: &ActuatorChoice, formulas: &[Arc<Formula>]) -> Checked<Vec<EffectChoice>> {
    let (mut chosen, catalogue) = (Vec::new(), Catalogue::new(formulas));
    for (name, table) in &raw.effects {
        let Some(effect) = catalogue.by_name(name.get_ref()) else {
            let known: Vec<&str> = catalogue.effects().map(|e| e.name).collect();
            let help = spelling::known(name.get_ref(), &known);
            return refuse(format!("unknown effect \"{}\"", name.get_ref()), help, name.span());
        };
        if !actuator.takes(&effect) {
            let message = format!("{} does not exist for actuator {}", effect.name, actuator.kind.name);
            return refuse(message, format!("remove [effects.{}]", effect.name), name.span());
        }
        let mut values = effect.neutral();
        let basis = table.iter().find(|(key, _)| key.get_ref() == "basis").map(|(_, value)| basis_of(value));
        let basis = basis.transpose()?.unwrap_or_default();
        let is_known = KNOWN.contains(&basis.as_str());
        for (key, value) in table {
            match (key.get_ref().as_str(), effect.parameters.iter().position(|p| p.key == key.get_ref())) {
                (_, Some(i)) => values[i] = parameter(&effect, i, value, is_known)?,
                (word, None) if REMARKS.contains(&word) => {}
                (word, None) => {
                    let keys: Vec<&str> = effect.parameters.iter().map(|p| p.key).collect();
                    let message = format!("{} has no parameter \"{word}\"", effect.name);
                    let meant = spelling::meant(word, keys.iter().copied());
                    return refuse(message, format!("{meant}its parameters: {}", keys.join(", ")), key.span());
                }
            }
        }
        chosen.push(EffectChoice { name: effect.name.to_string(), values, basis });
    }
    chosen.sort_by_key(|e| order(&e.name, formulas));
    Ok(chosen)
}

fn basis_of(value: &Spanned<toml::Value>) -> Checked<String> {
    match value.get_ref().as_str() {
        Some(word) if BASES.contains(&word) => Ok(word.to_string()),
        Some(word) => {
            let message = format!("basis \"{word}\" is none of the words that say how a value is known");
            refuse(message, spelling::known(word, BASES), value.span())
        }
        None => refuse("basis must be a word".into(), format!("write one of {}", BASES.join(", ")), value.span()),
    }
}

fn parameter(effect: &Effect, index: usize, value: &Spanned<toml::Value>, is_known: bool) -> Checked<f64> {
    let p = &effect.parameters[index];
    let number = match value.get_ref() {
        toml::Value::Float(v) => *v,
        toml::Value::Integer(v) => *v as f64,
        other => {
            let message = format!("{} must be a number, not {}", p.key, other.type_str());
            return refuse(message, format!("for example {} = {}", p.key, p.typical), value.span());
        }
    };
    let help = format!("{}; typical {}{}", p.meaning, p.typical, unit(p.unit));
    if !p.is_possible(number) {
        let message = format!("{} = {number} is outside its physical bounds {}", p.key, p.possible_words());
        return refuse(message, help, value.span());
    }
    if !is_known && !p.is_usual(number) {
        let message = format!("{} = {number} is outside its usual bounds {}", p.key, p.usual_words());
        let help = format!("{help}; if that was found on the robot, say so: basis = \"measured\"");
        return refuse(message, help, value.span());
    }
    Ok(number * p.si)
}
