//! Printed numbers of made-up robots.

mod one_robot;
mod other_robots;
mod reference;
mod robots;

use compare::diagnosis::{Diagnosis, Options, PRESSURES_ARE_RIGHT, Ranked};
use compare::{Evidence, diagnose};
use data::{About, Dataset};
use models::Scenario;

/// A diagnosis that tries these effects alone.
fn only(tried: &[&str]) -> Options {
    let others = models::effects::EFFECTS.iter().map(|e| e.name).filter(|name| !tried.contains(name));
    Options {
        not: others.chain([PRESSURES_ARE_RIGHT]).map(String::from).collect(),
        tolerance_m: Some(0.0),
        pairs: false,
        next_experiment: false,
        missing_moment: false,
        ..Options::default()
    }
}

fn diagnosed(base: &Scenario, data: &[(&Dataset, Option<&About>)], options: &Options) -> Diagnosis {
    let evidence: Vec<Evidence> = data.iter().map(|(d, about)| Evidence::of((*d).clone(), about.cloned())).collect();
    diagnose(base, &evidence, options, &mut |_, _| ()).unwrap()
}

fn ranked<'d>(d: &'d Diagnosis, name: &str) -> &'d Ranked {
    d.ranked.iter().find(|r| r.effect == name).unwrap()
}

/// Asserts that a printed number is the one derived here, to a share of it.
fn same(what: &str, printed: f64, derived: f64, share: f64) {
    assert!((printed - derived).abs() <= share * derived.abs(), "{what}: {printed} is printed and {derived} derived");
}

/// Asserts that both ends of an interval are those derived here, to a share of its width.
fn same_interval(what: &str, printed: [f64; 2], derived: [f64; 2], share: f64) {
    let away = (0..2).map(|end| (printed[end] - derived[end]).abs()).fold(0.0, f64::max);
    assert!(away <= share * (derived[1] - derived[0]), "{what}: {printed:?} is printed and {derived:?} derived");
}
