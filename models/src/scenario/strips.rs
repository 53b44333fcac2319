//! The strips of actuators: `[actuator]`, and each `[[strip]]` round the body.

use super::built::is_off;
use super::choice::ActuatorChoice;
use super::given::{Checked, Given, fault};
use super::raw::{Entries, RawScenario};
use super::stated::Scenario;
use crate::actuators::{self, ACTUATORS, Actuator, ActuatorShape, BIAS, Family};
use crate::effects::IN_SPACE;
use std::f64::consts::TAU;
use toml::Spanned;

pub(super) fn actuator(given: &Given, radius_m: f64, length_m: f64) -> Checked<ActuatorChoice> {
    let name: String = given.needed("kind", given.read("kind")?)?;
    let Some(kind) = actuators::by_name(&name) else {
        let known: Vec<&str> = ACTUATORS.iter().map(|a| a.name).collect();
        return fault(format!("unknown actuator \"{name}\""))
            .help(spelling::known(&name, &known))
            .at(given.span_of("kind"));
    };
    of_family(given, kind)?;
    let choice = ActuatorChoice {
        kind,
        shape: ActuatorShape {
            length_m: given.need("length_mm")?,
            width_m: given.need("width_mm")?,
            fold_m: given.number("fold_mm")?.unwrap_or(0.0),
            volume_gain: given.number("volume_gain")?.unwrap_or(1.0),
            bias_rad: given.number("bias_deg")?.unwrap_or(BIAS),
        },
        count: given.needed("count", given.whole("count")?)?,
        start_m: given.number("start_mm")?.unwrap_or(0.0),
        arm_m: given.number("arm_mm")?,
        channel: given.whole("channel")?.unwrap_or(0),
        azimuth_rad: given.number("azimuth_deg")?.unwrap_or(0.0),
        turns: given.number("turns")?.unwrap_or(0.0),
    };
    check_turns(given, &choice, radius_m)?;
    let end_m = choice.start_m + choice.covered_m(radius_m);
    if is_off(end_m, length_m) {
        let [unit, start, end, length] = [choice.shape.length_m, choice.start_m, end_m, length_m].map(|m| m * 1e3);
        return fault(format!(
            "{} units of {unit} mm from {start} mm end at {end:.1} mm, beyond the body's {length:.1} mm",
            choice.count
        ))
        .help("lower count, length_mm or start_mm, or raise body.length_mm")
        .at(given.span_of("count"));
    }
    Ok(choice)
}

/// Refuses a key that moves nothing of such an actuator.
fn of_family(given: &Given, kind: &Actuator) -> Checked<()> {
    let (key, meaning) = match kind.family {
        Family::Pouch => ("bias_deg", "the angle of a muscle's yarns"),
        Family::Mckibben => ("fold_mm", "the depth of a pouch's folds"),
    };
    match given.has_any(&[key]) {
        true => fault(format!("{key} is {meaning}; a {} has none", kind.name))
            .help("leave the line out")
            .at(given.span_of(key)),
        false => Ok(()),
    }
}

/// Refuses a helix that its strip is too short for.
fn check_turns(given: &Given, choice: &ActuatorChoice, radius_m: f64) -> Checked<()> {
    // Beyond 60° the strip goes round the body rather than along it.
    if choice.turns == 0.0 || choice.cos_slant(radius_m) >= 0.5 {
        return Ok(());
    }
    let (strip, round) = (choice.strip_m() * 1e3, TAU * radius_m * choice.turns.abs() * 1e3);
    fault(format!(
        "{} turns take {round:.1} mm round the body, of a strip of {strip:.1} mm: it would lie more than 60° off the axis",
        choice.turns
    )).help("write fewer turns, or more or longer units").at(given.span_of("turns"))
}

/// `[[strip]]`: missing keys come from `[actuator]`.
pub(super) fn more_strips(
    tables: &[Spanned<Entries>],
    model: Option<&Given>,
    first: &ActuatorChoice,
    radius_m: f64,
    length_m: f64,
) -> Checked<Vec<ActuatorChoice>> {
    let mut strips: Vec<ActuatorChoice> = Vec::new();
    for table in tables {
        let Some(model) = model else {
            return fault("a strip of an actuator that is not there").help("add [actuator]").at(table.span());
        };
        let own = Given::new("strip", table)?;
        own.need("azimuth_deg")?;
        let next = actuator(&own.or(model), radius_m, length_m)?;
        if let Some(other) = std::iter::once(first).chain(&strips).find(|other| overlap(other, &next, radius_m)) {
            let (a, b) = (other.azimuth_rad.to_degrees(), next.azimuth_rad.to_degrees());
            return fault(format!("the strips from azimuth {a:.0} and {b:.0} degrees lie on each other")).help("move azimuth_deg or start_mm, or make them narrower: width_mm over the radius is the angle they take").at(table.span());
        }
        strips.push(next);
    }
    Ok(strips)
}

/// Whether two strips lie on each other somewhere: closer round the body than half of both widths.
fn overlap(a: &ActuatorChoice, b: &ActuatorChoice, radius_m: f64) -> bool {
    let end = |strip: &ActuatorChoice| strip.start_m + strip.covered_m(radius_m);
    let (from, to) = (a.start_m.max(b.start_m), end(a).min(end(b)));
    if from >= to - 1e-9 {
        return false;
    }
    let width = |strip: &ActuatorChoice| strip.shape.width_m / strip.cos_slant(radius_m) / radius_m;
    let least = 0.5 * (width(a) + width(b)) * (1.0 - 1e-9);
    let apart = |s: f64| b.azimuth_at(radius_m, s) - a.azimuth_at(radius_m, s);
    // The difference is straight in s: somewhere within `least` of a whole turn?
    let (low, high) = (apart(from).min(apart(to)), apart(from).max(apart(to)));
    let whole = ((low - least) / TAU).floor() + 1.0;
    whole * TAU < high + least
}

/// Refuses a force across the plane in which a robot bends.
fn no_z(scenario: &Scenario, raw: &RawScenario) -> Checked<()> {
    let name = raw.effects.keys().find(|name| name.get_ref() == "tip_load");
    match (scenario.idle_force_n(), name) {
        (Some(force), Some(name)) => fault(format!(
            "cannot push the tip along z: force_z_n is {force}, and this robot bends in the x–y plane alone"
        ))
        .help("remove force_z_n, or give the robot a [[strip]]")
        .at(name.span()),
        _ => Ok(()),
    }
}

/// Refuses keys and effects that do not cover strips round the body.
pub(super) fn check_space(scenario: &Scenario, raw: &RawScenario, body: &Given) -> Checked<()> {
    if !scenario.is_spatial() {
        return no_z(scenario, raw);
    }
    if let Some(name) = raw.effects.keys().find(|name| !IN_SPACE.contains(&name.get_ref().as_str())) {
        return fault(format!("the effect {} is not built for strips round the body", name.get_ref()))
            .help(format!("strips round the body take {}", IN_SPACE.join(", ")))
            .at(name.span());
    }
    for key in ["wall_stiffness_n_per_m", "wall_shear_n_per_m", "hinge_moment_share"] {
        if body.has_any(&[key]) {
            return fault(format!("{key} is not built for strips round the body"))
                .help("leave it out: the wall is then inextensible")
                .at(body.span_of(key));
        }
    }
    match raw.zone.first() {
        Some(zone) => fault("zones are not built for strips round the body")
            .help("give strips start_mm and count instead")
            .at(zone.span()),
        None => Ok(()),
    }
}
