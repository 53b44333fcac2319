//! Strips round the body: `azimuth_deg` and `turns` of `[actuator]`, and `[[strip]]`.

use super::check::{Checked, actuator, optional, refuse};
use super::raw::{Raw, RawActuator, RawStrip};
use super::{ActuatorChoice, Scenario};
use crate::space::IN_SPACE;
use spelling::units::Range;
use std::f64::consts::{PI, TAU};
use toml::Spanned;

const AZIMUTH: Range = Range {
    name: "azimuth",
    unit: "deg",
    si: PI / 180.0,
    ..Range::plain(-360.0, 360.0, "write degrees from y towards z: 90 is z")
};
const TURNS: Range =
    Range { name: "turns", ..Range::plain(-20.0, 20.0, "write turns round the body from start to end") };

/// Azimuth \[rad\] and turns.
pub(super) fn round_the_body(a: &RawActuator) -> Checked<(f64, f64)> {
    Ok((optional(&a.azimuth_deg, &AZIMUTH)?.unwrap_or(0.0), optional(&a.turns, &TURNS)?.unwrap_or(0.0)))
}

/// Refuses a helix that its strip is too short for.
pub(super) fn check_turns(a: &RawActuator, choice: &ActuatorChoice, radius_m: f64) -> Checked<()> {
    let (Some(turns), round_m) = (&a.turns, TAU * radius_m * choice.turns.abs()) else { return Ok(()) };
    // Beyond 60° the strip goes round the body rather than along it.
    if choice.turns == 0.0 || choice.cos_slant(radius_m) >= 0.5 {
        return Ok(());
    }
    let (strip, round) = (choice.strip_m() * 1e3, round_m * 1e3);
    let message = format!(
        "{} turns take {round:.1} mm round the body, of a strip of {strip:.1} mm: it would lie more than 60° off the axis",
        turns.get_ref()
    );
    refuse(message, "write fewer turns, or more or longer units", turns.span())
}

/// `[[strip]]`: keys left out are those of `[actuator]`.
pub(super) fn more_strips(
    raw: &Raw,
    first: &ActuatorChoice,
    radius_m: f64,
    length_m: f64,
) -> Checked<Vec<ActuatorChoice>> {
    let Some(model) = raw.actuator.as_ref() else {
        return match raw.strip.first() {
            Some(strip) => refuse("a strip of an actuator that is not there".into(), "add [actuator]", strip.span()),
            None => Ok(Vec::new()),
        };
    };
    let mut strips: Vec<ActuatorChoice> = Vec::new();
    for strip in &raw.strip {
        let merged = Spanned::new(strip.span(), merged(model.get_ref(), strip.get_ref()));
        let next = actuator(&merged, radius_m, length_m)?;
        if let Some(other) = std::iter::once(first).chain(&strips).find(|other| overlap(other, &next, radius_m)) {
            let (a, b) = (other.azimuth_rad.to_degrees(), next.azimuth_rad.to_degrees());
            let message = format!("the strips from azimuth {a:.0} and {b:.0} degrees lie on each other");
            let help =
                "move azimuth_deg or start_mm, or make them narrower: width_mm over the radius is the angle they take";
            return refuse(message, help, strip.span());
        }
        strips.push(next);
    }
    Ok(strips)
}

fn merged(model: &RawActuator, strip: &RawStrip) -> RawActuator {
    let own = strip;
    RawActuator {
        length_mm: own.length_mm.clone().unwrap_or_else(|| model.length_mm.clone()),
        width_mm: own.width_mm.clone().unwrap_or_else(|| model.width_mm.clone()),
        count: own.count.clone().unwrap_or_else(|| model.count.clone()),
        start_mm: own.start_mm.clone().or_else(|| model.start_mm.clone()),
        arm_mm: own.arm_mm.clone().or_else(|| model.arm_mm.clone()),
        fold_mm: own.fold_mm.clone().or_else(|| model.fold_mm.clone()),
        volume_gain: own.volume_gain.clone().or_else(|| model.volume_gain.clone()),
        channel: own.channel.clone().or_else(|| model.channel.clone()),
        azimuth_deg: Some(own.azimuth_deg.clone()),
        turns: own.turns.clone().or_else(|| model.turns.clone()),
        ..model.clone()
    }
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

/// Refuses what is not built for strips round the body.
pub(super) fn check_space(scenario: &Scenario, raw: &Raw) -> Checked<()> {
    if !scenario.is_spatial() {
        return Ok(());
    }
    let only = format!("strips round the body take {}", IN_SPACE.join(", "));
    for name in raw.effects.keys() {
        if !IN_SPACE.contains(&name.get_ref().as_str()) {
            let message = format!("the effect {} is not built for strips round the body", name.get_ref());
            return refuse(message, only, name.span());
        }
    }
    let body = raw.body.get_ref();
    let walls = [
        ("wall_stiffness_n_per_m", &body.wall_stiffness_n_per_m),
        ("wall_shear_n_per_m", &body.wall_shear_n_per_m),
        ("hinge_moment_share", &body.hinge_moment_share),
    ];
    for (key, value) in walls {
        if let Some(value) = value {
            let message = format!("{key} is not built for strips round the body");
            return refuse(message, "leave it out: the wall is then inextensible", value.span());
        }
    }
    match raw.zone.first() {
        Some(zone) => {
            let message = "zones are not built for strips round the body".into();
            refuse(message, "give strips start_mm and count instead", zone.span())
        }
        None => Ok(()),
    }
}
