//! Made-up robots × printed numbers: each number is derived a second time, by dense matrices or in closed form.
//!
//! The table lists mutants, one-line changes of `diagnosis`, `moment`, `extension` and `ladder`, that a test here notices.
//!
//! | mutant | killed by |
//! |---|---|
//! | 1 pressures left out stay in the fit | `errors_at_what_was_left_out…` |
//! | 2 the noise of the mean is subtracted at a run left out, not the noise of a run | `errors_at_what_was_left_out…` |
//! | 3 the scatter that a fit took over is not subtracted | `errors_at_what_was_left_out…` |
//! | 4 the B of another body pressure is written | `an_extension_writes…` |
//! | 5 a second, contradicting test counts | `separate_tests_count…` |
//! | 6 the price of a parameter has the wrong sign | `the_order_counts…` |
//! | 7 the prior of an effect's size is dropped | `the_order_counts…` |
//! | 8 degrees of freedom are off by the number of parameters | `chances_count…` |
//! | 9 intervals ignore what the other numbers may be | `intervals_count…` |
//! | 10 two intervals of one number | `intervals_count…` |
//! | 11 a change of the moment contains the drift before it | `missing_moments_are…` |
//! | 12 an extension writes the value of another candidate | `an_extension_writes…` |
//! | 13 a climb ends one effect early | `a_climb_adds…` |
//! | 14 a gauge is ignored | `positions_are_predicted…` |
//! | 15 `[direct]` of `about.toml` is ignored | `what_was_measured_directly…` |
//! | 16 `[bending]` of `about.toml` is ignored | `separate_tests_count…` |
//! | 17 bands of curves have the inverse of the covariance | `curves_of_the_missing_moment…` |
//! | an extension reports the B of another candidate; the nearest body pressure is the farthest; B without the effect is the given one | `an_extension_writes…` |
//! | errors contain the noise of the mean | `values_gains_and_errors…` |
//! | p of one test in place of all; the worst of the set decides; hold means or marker means with other degrees of freedom | `chances_count…` |
//! | missing moments are relative to the fitted B | `missing_moments_are…` |
//! | a band is moved along the curve the wrong way, or is twice as wide | `curves_of_the_missing_moment…` |
//! | the second effect of a pair gets the value of the first | `two_effects_have…` |
//! | the smallest size ignores how many effects were tried | `the_smallest_size…` |
//! | a hypothesis without an effect that a test found pays nothing; p is not corrected for several data; further data leave the fit without a pressure; the errors in them are errors in the first | `separate_tests_count…` |
//! | a learned law has the errors of the base; the table of an extension has the given B | `a_learned_law…` |
//! | the scatter of a moment is the one of its bend; a hold has the sum of its samples | `missing_moments_are…` |
//! | a row of the table has the error of another | `a_table_of_errors…` |
//! | intervals from the variance that tests use | `intervals_count…` |
//! | a price that ignores the allowance | `the_order_counts…` |
//!
//! Not noticed: the covariance of a shape is not widened where the shape itself misses the markers.

#![allow(clippy::unwrap_used, reason = "tests: a panic is the failure to report")]

mod held;
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
