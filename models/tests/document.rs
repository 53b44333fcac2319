//! `docs/effects.md` is the catalogue, written out. After a change: `WRITE=1 cargo test --test document`.

#![allow(clippy::unwrap_used, reason = "tests: a panic is the failure to report")]

use models::actuators::Family;
use models::effects::{EFFECTS, Effect, Fitted, Group, Needs, Parameter};
use models::scenario::{KEYS, key};
use models::{HOLD_S, Loads, Model, Scenario, Step};
use std::fmt::Write;
use std::path::Path;

const HEAD: &str = "# Effects

An effect is one physical mechanism that can be added to a model. This page is generated from the catalogue.
`ibr list effects` prints also what each does to data, where it is valid, how to check it, and its source.
Write `[effects.NAME]` into a scenario to switch one on ([scenario.md](scenario.md#effectsname)).

The first number of a parameter is its typical size, the two others bound a fit. A parameter that is left out has its
neutral value, at which the effect vanishes; it is 0 unless stated. *From design*: never fitted, it follows from how the
robot is made. *Shapes the law*: at its neutral value the law has its usual form; a fit finds another one only where data ask
for it. *History*: a state depends on those before it. [theory.md](theory.md) derives the mechanics of pouches and muscles.

The last column is the height of the outermost marker, as the camera sees it, without → with the effect. A robot that has
the effect as shipped keeps its values; otherwise the effect is added with its typical ones.
";

const GROUPS: &[(Group, &str)] = &[
    (Group::Actuator, "Actuator"),
    (Group::Body, "Body"),
    (Group::Load, "Loads"),
    (Group::Supply, "Supply"),
    (Group::Measurement, "Camera, markers and mount"),
];

fn document() -> String {
    let mut text = HEAD.to_string();
    for (group, title) in GROUPS {
        write!(text, "\n## {title}\n\n| effect | what it does | parameters | on a robot |\n|---|---|---|---|\n")
            .unwrap();
        EFFECTS.iter().filter(|e| e.group == *group).for_each(|e| text.push_str(&row(e)));
    }
    text
}

fn row(effect: &Effect) -> String {
    let family = match effect.needs {
        Needs::Family(Family::Pouch) => " Pouches only.",
        Needs::Family(Family::Mckibben) => " fPAM only.",
        Needs::Actuator | Needs::Body => "",
    };
    let history = if effect.history { " History." } else { "" };
    let parameters: Vec<_> = effect.parameters.iter().map(parameter).collect();
    let formula = effect.formula.replace('|', "\\|");
    format!(
        "| `{}` | {}{family}{history} `{formula}` | {} | {} |\n",
        effect.name,
        effect.sentence,
        parameters.join("; "),
        shown(effect)
    )
}

/// Protocols as times \[s\] and actuator pressures \[kPa\]; the last state is read.
const HELD: &[[f64; 2]] = &[[HOLD_S, 30.0]];
const LOW: &[[f64; 2]] = &[[HOLD_S, 4.0]];
const LONG: &[[f64; 2]] = &[[60.0, 30.0]];
const LOWERED: &[[f64; 2]] = &[[5.0, 30.0], [10.0, 15.0]];
const JUST_LOWERED: &[[f64; 2]] = &[[5.0, 30.0], [5.25, 15.0]];
/// Bending stiffness of a wall, for effects that need one \[N·m²\].
const WALL_NM2: f64 = 1.0;
/// Robots of [`shown`], the first that has the effect or that it fits.
const ROBOTS: [&str; 4] = ["epam", "fpam", "cpam", "spam"];
/// Effects whose robot or protocol is another one: where they are meant.
const MEANT: &[(&str, &str, &[[f64; 2]])] = &[
    ("end_constraint", "epam-textbook", HELD),
    ("arm_growth", "spam", HELD),
    ("gussets", "cpam", HELD),
    ("roofed_welds", "epam", LOW),
    ("stuck_face", "spam", HELD),
    ("shear_lock", "fpam-textbook", HELD),
    ("self_contact", "cpam-textbook", HELD),
    ("gauge_drift", "epam", LONG),
    ("seam_stiffness", "epam-textbook", HELD),
    ("plastic_set", "epam", LOWERED),
    ("friction", "epam", LOWERED),
    ("regulator_hysteresis", "epam", LOWERED),
    ("clock_lag", "epam", JUST_LOWERED),
];

/// What an effect does to a shipped robot.
fn shown(effect: &Effect) -> String {
    let robot = |name: &str| Scenario::parse(models::shipped(name).unwrap()).unwrap();
    let without = |robot: &Scenario| {
        let effects = robot.effects.iter().filter(|own| own.name != effect.name).cloned().collect();
        Scenario { effects, ..robot.clone() }
    };
    let values =
        |robot: &Scenario| robot.effects.iter().find(|own| own.name == effect.name).map(|own| own.values.clone());
    let height_mm = |robot: &Scenario, path: &[[f64; 2]]| {
        let model = Model::new(robot);
        let mut at = model.prediction();
        let step = |[t_s, kpa]: &[f64; 2]| Step { t_s: *t_s, loads: Loads::uniform(robot.p_body_pa, 1e3 * kpa) };
        model.follow(&path.iter().map(step).collect::<Vec<_>>(), &mut at, &mut |_, _| ()).unwrap();
        1e3 * at.markers.last().unwrap()[1]
    };
    let meant = MEANT.iter().find(|(name, ..)| *name == effect.name);
    let fits = |name: &&str| effect.applies_to(robot(name).actuator.kind.family);
    let own = |name: &&str| values(&robot(name)).is_some_and(|own| own != effect.neutral());
    let listed = ROBOTS.into_iter().find(own).or(ROBOTS.into_iter().find(fits)).unwrap();
    let (name, path) = meant.map_or((listed, HELD), |(_, name, path)| (*name, *path));
    let kind = robot(name).actuator.kind.name;
    let (base, bent) = match effect.validity.contains("needs B > 0") {
        true => (without(&robot(name)).with_bending(WALL_NM2), ", B = 1 N m²"),
        false => (without(&robot(name)), ""),
    };
    let with = base.with_effect(effect.name, &values(&robot(name)).unwrap_or_else(|| effect.typical_for(kind)));
    let state = match path {
        [[HOLD_S, kpa]] => format!("{kpa} kPa"),
        [[t_s, kpa]] => format!("{kpa} kPa for {t_s} s"),
        [[from_s, high], [t_s, kpa]] => format!("{kpa} kPa, {} s after {high}", t_s - from_s),
        _ => unreachable!("protocols have one or two steps"),
    };
    let [before, after] = [&base, &with].map(|robot| format!("{:.1}", height_mm(robot, path)));
    assert_ne!(before, after, "{} does nothing to {name}: name another robot in MEANT", effect.name);
    format!("{name}{bent}, {state}: {before} → {after} mm")
}

fn parameter(p: &Parameter) -> String {
    let unit = if p.unit == "-" { String::new() } else { format!(" {}", p.unit) };
    let neutral = if p.neutral == 0.0 { String::new() } else { format!(", neutral {}", short(p.neutral)) };
    let fitted = match p.fitted {
        Fitted::Always => "",
        Fitted::Shape => ", shapes the law",
        Fitted::WithKeptBending => ", fitted with B kept only",
        Fitted::WithBodyPressures => ", fitted at several body pressures only",
        Fitted::BetweenHolds => ", tried between holds",
        Fitted::BetweenSamples => ", tried between samples",
        Fitted::FromDesign => ", from design",
    };
    format!("`{}` {}{unit} ({}…{}){neutral}{fitted}", p.key, short(p.typical), p.lower, p.upper)
}

/// Without the digits of π that nobody reads.
fn short(value: f64) -> f64 {
    (value * 1e6).round() / 1e6
}

#[test]
fn the_page_of_effects_is_the_catalogue() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/effects.md");
    if std::env::var_os("WRITE").is_some() {
        std::fs::write(&path, document()).unwrap();
    }
    let written = std::fs::read_to_string(&path).unwrap_or_default();
    assert!(written == document(), "docs/effects.md is not the catalogue: WRITE=1 cargo test --test document");
}

/// A bound as the document writes it.
fn bound(value: f64) -> String {
    let size = value.abs();
    let digits = match size {
        _ if size >= 1e6 || size > 0.0 && size < 1e-3 => format!("{size:e}"),
        _ if size >= 1e4 => format!("{} {:03}", (size / 1e3).floor(), size % 1e3),
        _ => size.to_string(),
    };
    if value < 0.0 { format!("−{digits}") } else { digits }
}

#[test]
fn the_page_of_scenarios_has_every_key_and_its_bounds() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/scenario.md");
    let page = std::fs::read_to_string(path).unwrap();
    for key in KEYS {
        let names = [format!("`{}`", key.name), format!("`{}.{}`", key.tables[0], key.name)];
        let rows: Vec<&str> =
            page.lines().filter(|line| line.starts_with("| ") && names.iter().any(|n| line.contains(n))).collect();
        assert!(!rows.is_empty(), "{} is not in docs/scenario.md", key.place());
        let Some(range) = key.range else { continue };
        let bounds = format!("{} – {}", bound(range.low), bound(range.high));
        let has = |row: &&str| row.contains(&bounds) || row.contains("as there") || row.contains("body length");
        assert!(rows.iter().any(has), "docs/scenario.md has other bounds of {} than {bounds}: {rows:?}", key.place());
    }
}

#[test]
fn a_key_is_read_where_its_table_says_and_its_value_comes_back() {
    let text = models::shipped("fpam-textbook").unwrap();
    for key in KEYS.iter().filter(|key| matches!(key.tables[0], "body" | "actuator" | "predict")) {
        let (Ok(scenario), Some(range)) = (Scenario::parse(text), key.range) else { continue };
        let Some(value) = key.value(&scenario) else { continue };
        assert!((range.low..=range.high).contains(&value), "{}: {value}", key.place());
        let beyond = format!("{} = {}\n", key.name, range.high.mul_add(2.0, 1.0));
        let table = format!("[{}]\n", key.tables[0]);
        let written = |line: &&str| !line.trim_start().starts_with(&format!("{} =", key.name));
        let own = text.replacen(&table, &format!("{table}#\n"), 1);
        let (head, tail) = own.split_once(&format!("{table}#\n")).unwrap();
        let end = tail.find("\n[").unwrap_or(tail.len());
        let kept: Vec<&str> = tail[..end].lines().filter(written).collect();
        let changed = format!("{head}{table}{beyond}{}{}", kept.join("\n"), &tail[end..]);
        assert!(Scenario::parse(&changed).is_err(), "{} takes {beyond}", key.place());
    }
    assert!(key("body", "width_mm").is_none() && key("zone", "width_mm").is_some());
}
