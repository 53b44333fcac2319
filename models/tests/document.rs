//! `docs/effects.md` is the catalogue, written out. After a change: `WRITE=1 cargo test --test document`.

#![allow(clippy::unwrap_used, reason = "tests: a panic is the failure to report")]

use models::Scenario;
use models::actuators::Family;
use models::effects::{EFFECTS, Effect, Fitted, Group, Needs, Parameter};
use models::scenario::{KEYS, key};
use std::fmt::Write;
use std::path::Path;

const HEAD: &str = "# Effects

An effect is one physical mechanism that can be added to a model. This page is generated from the catalogue.
`ibr list effects` prints the same, and for each effect what it does to data, how to check it, and its source.
Write `[effects.NAME]` into a scenario to switch one on ([scenario.md](scenario.md#effectsname)).

The first number of a parameter is its typical size, the two others bound a fit. A parameter that is left out has its
neutral value, at which the effect vanishes; it is 0 unless told. *From design*: never fitted, it follows from how the
robot is made. *Shapes the law*: at its neutral value the law has its usual form; a fit finds another one only where data ask
for it. *History*: a state depends on those before it. [theory.md](theory.md) derives the mechanics of pouches and muscles.
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
        write!(text, "\n## {title}\n\n| effect | what it does | parameters |\n|---|---|---|\n").unwrap();
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
        "| `{}` | {}{family}{history} `{formula}` Valid: {}. | {} |\n",
        effect.name,
        effect.sentence,
        effect.validity.replace('|', "\\|"),
        parameters.join("; ")
    )
}

fn parameter(p: &Parameter) -> String {
    let unit = if p.unit == "-" { String::new() } else { format!(" {}", p.unit) };
    let neutral = if p.neutral == 0.0 { String::new() } else { format!(", neutral {}", short(p.neutral)) };
    let fitted = match p.fitted {
        Fitted::Always => "",
        Fitted::Shape => ", shapes the law",
        Fitted::WithKeptBending => ", fitted with B kept only",
        Fitted::WithBodyPressures => ", fitted at several body pressures only",
        Fitted::FromDesign => ", from design",
    };
    format!("`{}` {}{unit} ({} to {}){neutral}{fitted}", p.key, short(p.typical), p.lower, p.upper)
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
    let told = std::fs::read_to_string(&path).unwrap_or_default();
    assert!(told == document(), "docs/effects.md is not the catalogue: WRITE=1 cargo test --test document");
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
