//! `docs/effects.md` is the catalogue, written out. After a change: `WRITE=1 cargo test --test document`.

#![allow(clippy::unwrap_used, reason = "tests: a panic is the failure to report")]

use models::actuators::Family;
use models::effects::{EFFECTS, Effect, Fitted, Group, Needs, Parameter};
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
