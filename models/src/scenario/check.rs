//! Raw values → SI: the tables together, with errors that name the probable slip.

use super::built::is_off;
use super::choice::ActuatorChoice;
use super::formulas::formulas;
use super::given::{Checked, Given, fault, si, unit};
use super::growth::growth;
use super::keys::{REMARKS, SEGMENTS};
use super::raw::{Entries, RawScenario};
use super::stated::{BASES, EffectChoice, Scenario, Wall, Zone, order};
use super::strips::{actuator, check_space, more_strips};
use crate::catalogue::Catalogue;
use crate::effects::Effect;
use crate::formula::Formula;
use crate::line::{Line, REFERENCE_PA};
use spelling::units::Range;
use std::sync::Arc;
use toml::Spanned;

pub(super) fn scenario(raw: &RawScenario, text: &str) -> Checked<Scenario> {
    let body = Given::new("body", &raw.body)?;
    let (length_m, radius_m) = (body.need("length_mm")?, body.need("radius_mm")?);
    let first = raw.actuator.as_ref().map(|table| Given::new("actuator", table)).transpose()?;
    let choice = first.as_ref().map_or(Ok(ActuatorChoice::NONE), |a| actuator(a, radius_m, length_m))?;
    let more_strips = more_strips(&raw.strip, first.as_ref(), &choice, radius_m, length_m)?;
    let zones = raw.zone.iter().map(|table| zone(table, length_m, &choice)).collect::<Checked<Vec<_>>>()?;
    let formulas = formulas(raw, text)?;
    let is_spatial = !more_strips.is_empty() || !choice.is_planar();
    let scenario = Scenario {
        name: raw.name.clone(),
        radius_m,
        length_m,
        p_body_pa: body.need("pressure_kpa")?,
        bending_stiffness: body.number("bending_stiffness_nm2")?.unwrap_or(0.0),
        hinge_curvature: body.number("hinge_curvature_per_m")?.unwrap_or(0.05),
        hinge_share: body.number("hinge_moment_share")?.unwrap_or(1.0),
        wall: wall(&body)?,
        // A beam has no actuator's side opposite which a generator stays taut: its axis keeps its length.
        centre_line_m: body.number("centre_line_mm")?.or((!choice.exists()).then_some(0.0)),
        gravity_direction: gravity(&body, is_spatial)?,
        actuator: choice,
        more_strips,
        zones,
        markers_m: stations(&raw.markers.s_mm, length_m)?,
        pressures_pa: raw
            .predict
            .pressures_kpa
            .iter()
            .map(|p| si(p, &Range::ACTUATOR_PRESSURE))
            .collect::<Checked<_>>()?,
        segments: segments(raw)?,
        p_max_pa: first.as_ref().map_or(Ok(None), |a| a.number("max_pressure_kpa"))?.unwrap_or(100e3),
        line: raw.supply.as_ref().map(line).transpose()?,
        growth: raw.growth.as_ref().map(growth).transpose()?,
        effects: effects_of(raw, &choice, &formulas)?.into_iter().collect(),
        formulas,
    };
    check_space(&scenario, raw, &body)?;
    match (scenario.can_be_built(), &raw.actuator) {
        (Err(wrong), Some(actuator)) => fault(format!("robot: {wrong}"))
            .help("change the sizes of the body, the actuator or its zones")
            .at(actuator.span()),
        _ => Ok(scenario),
    }
}

fn wall(body: &Given) -> Checked<Wall> {
    let stiffness_n_per_m = body.number("wall_stiffness_n_per_m")?;
    let shear_n_per_m = body.number("wall_shear_n_per_m")?;
    if let (Some(wall), true) = (stiffness_n_per_m, body.has_any(&["hinge_curvature_per_m"])) {
        return fault(format!("hinge_curvature_per_m repeats a wall of {wall} N/m"))
            .help("remove it: a wall has its own, pressure_kpa over E t")
            .at(body.span_of("hinge_curvature_per_m"));
    }
    let is_known = stiffness_n_per_m.or(shear_n_per_m).is_some();
    let basis = match body.raw("wall_basis") {
        Some(word) if !is_known => {
            return fault("wall_basis without a wall").help("add wall_stiffness_n_per_m, or remove it").at(word.span());
        }
        Some(word) => basis_of(word)?,
        None if is_known => "assumed".into(),
        None => String::new(),
    };
    Ok(Wall { stiffness_n_per_m, shear_n_per_m, basis })
}

fn gravity(body: &Given, is_spatial: bool) -> Checked<[f64; 3]> {
    let Some(given) = body.read::<Vec<f64>>("gravity")? else { return Ok([0.0, -1.0, 0.0]) };
    let direction = match given[..] {
        [x, y] => [x, y, 0.0],
        [x, y, z] if is_spatial => [x, y, z],
        _ => [f64::NAN; 3],
    };
    // Written so that NaN is refused as well.
    if (direction.iter().map(|g| g * g).sum::<f64>().sqrt() - 1.0).abs() <= 1e-3 {
        return Ok(direction);
    }
    let room = if is_spatial { "[x, y] or [x, y, z]" } else { "in the x–y plane" };
    fault(format!("gravity must be a unit vector {room}, not {given:?}"))
        .help("[0, -1] points against the bend, [1, 0] along the robot")
        .at(body.span_of("gravity"))
}

fn zone(table: &Spanned<Entries>, length_m: f64, actuator: &ActuatorChoice) -> Checked<Zone> {
    let zone = Given::new("zone", table)?;
    let passive = zone.read("passive")?;
    let of_actuator = zone.has_any(&["length_mm", "width_mm", "fold_mm", "arm_mm", "channel"]);
    if !actuator.exists() && (of_actuator || passive == Some(false)) {
        return fault("a zone of an actuator that is not there").help("add [actuator]").at(zone.span);
    }
    let (from_m, to_m) = (zone.need("from_mm")?, zone.need("to_mm")?);
    if from_m >= to_m || is_off(to_m, length_m) {
        return fault(format!("a zone from {} to {} mm is not on the body", from_m * 1e3, to_m * 1e3))
            .help(format!("0 ≤ from_mm < to_mm ≤ {}", length_m * 1e3))
            .at(zone.span_of("to_mm"));
    }
    Ok(Zone {
        from_m,
        to_m,
        radius_m: zone.number("radius_mm")?,
        bending_stiffness: zone.number("bending_stiffness_nm2")?,
        passive,
        unit_length_m: zone.number("length_mm")?,
        width_m: zone.number("width_mm")?,
        fold_m: zone.number("fold_mm")?,
        arm_m: zone.number("arm_mm")?,
        channel: zone.whole("channel")?,
    })
}

fn stations(raw: &[Spanned<f64>], length_m: f64) -> Checked<Vec<f64>> {
    let mut stations: Vec<f64> = Vec::with_capacity(raw.len());
    for value in raw {
        let s = si(value, &Range::STATION)?;
        if is_off(s, length_m) {
            return fault(format!("marker at {} mm is off the body of {} mm", value.get_ref(), length_m * 1e3))
                .help("stations are measured along the undeformed body from its base")
                .at(value.span());
        }
        if stations.last().is_some_and(|last| *last >= s) {
            return fault("marker stations must rise").help("sort them from base to tip").at(value.span());
        }
        stations.push(s);
    }
    if let (Some(last), Some(value)) = (stations.last(), raw.last())
        && are_too_low(*last, length_m)
    {
        return fault("marker stations are all below 2 mm").help(Range::LENGTH.too_small).at(value.span());
    }
    Ok(stations)
}

/// Whether a body of this length has its last marker so near the base that the unit is probably wrong.
pub(super) fn are_too_low(last_m: f64, length_m: f64) -> bool {
    last_m < 0.002 && length_m > 0.05
}

fn segments(raw: &RawScenario) -> Checked<usize> {
    let Some(value) = &raw.predict.segments else { return Ok(12) };
    si(&Spanned::new(value.span(), *value.get_ref() as f64), &SEGMENTS).map(|count| count as usize)
}

/// Whether a value with this basis may lie beyond the usual bounds.
pub(super) fn is_known(basis: &str) -> bool {
    ["measured", "published", "calibrated"].contains(&basis)
}

fn effects_of(raw: &RawScenario, actuator: &ActuatorChoice, formulas: &[Arc<Formula>]) -> Checked<Vec<EffectChoice>> {
    let (mut chosen, catalogue) = (Vec::new(), Catalogue::new(formulas));
    for (name, table) in &raw.effects {
        let Some(effect) = catalogue.by_name(name.get_ref()) else {
            let known: Vec<&str> = catalogue.effects().map(|e| e.name).collect();
            return fault(format!("unknown effect \"{}\"", name.get_ref()))
                .help(spelling::known(name.get_ref(), &known))
                .at(name.span());
        };
        if !actuator.takes(&effect) {
            return fault(format!("{} does not exist for actuator {}", effect.name, actuator.kind.name))
                .help(format!("remove [effects.{}]", effect.name))
                .at(name.span());
        }
        let mut values = effect.neutral();
        let remark = |word: &str| table.iter().find(|(key, _)| key.get_ref() == word).map(|(_, value)| value);
        let basis = remark("basis").map(basis_of).transpose()?.unwrap_or_default();
        let interval = remark("interval").and_then(|value| value.get_ref().as_str()).unwrap_or_default().to_string();
        let is_known = is_known(&basis);
        for (key, value) in table {
            match (key.get_ref().as_str(), effect.parameters.iter().position(|p| p.key == key.get_ref())) {
                (_, Some(i)) => values[i] = parameter(&effect, i, value, is_known)?,
                (word, None) if REMARKS.contains(&word) => {}
                (word, None) => {
                    let keys: Vec<&str> = effect.parameters.iter().map(|p| p.key).collect();
                    let meant = spelling::meant(word, keys.iter().copied());
                    return fault(format!("{} has no parameter \"{word}\"", effect.name))
                        .help(format!("{meant}its parameters: {}", keys.join(", ")))
                        .at(key.span());
                }
            }
        }
        chosen.push(EffectChoice { name: effect.name.to_string(), values, basis, interval });
    }
    chosen.sort_by_key(|e| order(&e.name, formulas));
    Ok(chosen)
}

fn basis_of(value: &Spanned<toml::Value>) -> Checked<String> {
    match value.get_ref().as_str() {
        Some(word) if BASES.contains(&word) => Ok(word.to_string()),
        Some(word) => fault(format!("basis \"{word}\" is none of the words that say how a value is known"))
            .help(spelling::known(word, BASES))
            .at(value.span()),
        None => fault("basis must be a word").help(format!("write one of {}", BASES.join(", "))).at(value.span()),
    }
}

fn parameter(effect: &Effect, index: usize, value: &Spanned<toml::Value>, is_known: bool) -> Checked<f64> {
    let p = &effect.parameters[index];
    let number = match value.get_ref() {
        toml::Value::Float(v) => *v,
        toml::Value::Integer(v) => *v as f64,
        other => {
            return fault(format!("{} must be a number, not {}", p.key, other.type_str()))
                .help(format!("for example {} = {}", p.key, p.typical))
                .at(value.span());
        }
    };
    let help = format!("{}; typical {}{}", p.meaning, p.typical, unit(p.unit));
    if !p.is_possible(number) {
        return fault(format!("{} = {number} is outside its physical bounds {}", p.key, p.possible_words()))
            .help(help)
            .at(value.span());
    }
    if !is_known && !p.is_usual(number) {
        return fault(format!("{} = {number} is outside its usual bounds {}", p.key, p.usual_words()))
            .help(format!("{help}; if that was found on the robot, say so: basis = \"measured\""))
            .at(value.span());
    }
    Ok(number * p.si)
}

/// `[supply]`: time constant of the valve and flow of its line; conductance and volume belong together.
fn line(table: &Spanned<Entries>) -> Checked<Line> {
    let supply = Given::new("supply", table)?;
    let [valve, conductance, ratio, volume] =
        ["valve_time_s", "conductance_l_per_s_bar", "critical_ratio", "volume_ml"].map(|key| supply.number(key));
    let (valve, ratio) = (valve?, ratio?);
    let flow_per_s = match (conductance?, volume?) {
        (Some(conductance), Some(volume)) => REFERENCE_PA * conductance / volume,
        (None, None) if ratio.is_none() && valve.is_some() => f64::INFINITY,
        _ => {
            return fault("[supply] is not complete")
                .help("give valve_time_s, or conductance_l_per_s_bar with volume_ml, or all three")
                .at(supply.span);
        }
    };
    Ok(Line { valve_time_s: valve.unwrap_or(0.0), flow_per_s, critical_ratio: ratio.unwrap_or(USUAL_RATIO) })
}

/// b where the data sheet has none: between a tube and a sharp orifice.
const USUAL_RATIO: f64 = 0.3;
