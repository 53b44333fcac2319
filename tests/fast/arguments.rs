//! Wrong options: exit code 2, and what to type.

use crate::refused::{refuse, with_report};

fn wrong(args: &[&str], words: &[&str]) {
    refuse(&with_report(), args, 2, words);
}

#[test]
fn pressures_need_a_number_and_a_known_unit() {
    let predict = |pressure: &str, words: &[&str]| wrong(&["predict", "epam", "--pressure", pressure], words);
    predict("10", &["--pressure", "`10` has no unit", "for example 30"]);
    predict("10torr", &["`10torr` has an unknown unit"]);
    predict("10mm", &["`10mm` has an unknown unit"]);
    predict("10kPa,,20kPa", &["`` is not a quantity"]);
    predict("", &["`` is not a quantity"]);
    predict("１０kPa", &["`１０kPa` is not a quantity"]);
    predict("nankPa", &["not a quantity"]);
    predict("-5kPa", &["`-5kPa`", "actuator pressure must be from 0 to 1000 kPa, not -5"]);
    predict("1e9kPa", &["actuator pressure must be from 0 to 1000 kPa, not 1000000000"]);
    predict("1kPa/1kPa/1kPa/1kPa/1kPa", &["names 5 channels; there are 4"]);
    wrong(&["predict", "epam", "--body-pressure", "-1kPa"], &["body pressure must be from 0.5 to 100 kPa, not -1"]);
}

#[test]
fn effects_need_a_known_name_a_known_parameter_and_a_value_in_bounds() {
    let effect = |text: &str, words: &[&str]| wrong(&["predict", "epam", "--effect", text], words);
    effect("junk", &["unknown effect `junk`", "known: chord_arm"]);
    effect("frction", &["unknown effect `frction`", "did you mean friction?"]);
    effect("end_constraint:bta=1", &["no parameter `bta`", "did you mean beta?"]);
    effect("gravité", &["unknown effect `gravité`"]);
    effect("", &["unknown effect ``"]);
    effect("end_constraint:alpha=1", &["end_constraint has no parameter `alpha`", "for example end_constraint:beta="]);
    effect("end_constraint:beta", &["beta = `` is not a number", "for example end_constraint:beta="]);
    effect("end_constraint:beta=x", &["beta = `x` is not a number"]);
    effect("end_constraint:beta=7", &["beta = 7 is outside its physical bounds 0 to 1"]);
    effect("end_constraint:beta=nan", &["outside its physical bounds"]);
    effect("shear_stiffness", &["shear_stiffness does not exist for the actuator epam", "ibr list effects"]);
}

#[test]
fn targets_of_the_inverse_need_a_name_and_a_unit() {
    let inverse = |target: &str, words: &[&str]| wrong(&["predict", "epam", "--inverse", target], words);
    inverse("height=100mm", &["not understood", "write tip=100mm (height) or angle=60deg"]);
    inverse("tip=100", &["`100` has no unit"]);
    inverse("angle=10mm", &["unknown unit", "deg"]);
    inverse("tip=nan", &["not a quantity"]);
    wrong(&["predict", "epam", "--inverse", "tip=1mm", "--pressure", "1kPa"], &["cannot be used with"]);
}

#[test]
fn thresholds_and_noise_are_lengths_above_zero() {
    let compare = |more: &[&str], words: &[&str]| {
        wrong(&[&["compare", "epam", "synthetic-epam", "--out", "report"], more].concat(), words);
    };
    compare(&["--max-error", "5"], &["`5` has no unit"]);
    compare(&["--max-error", "-5mm"], &["--max-error -5mm is not above zero", "write for example"]);
    compare(&["--sigma", "0mm"], &["--sigma 0mm is not above zero"]);
    compare(&["--effect", "junk"], &["unknown effect `junk`"]);
}

#[test]
fn unknown_commands_robots_and_lists_name_the_known_ones() {
    wrong(&["frob"], &["unrecognized subcommand 'frob'"]);
    wrong(&[], &["Usage: ibr", "compare"]);
    wrong(&["predict"], &["<SCENARIO>"]);
    wrong(&["new", "epm"], &["no shipped scenario `epm`", "did you mean epam?"]);
    wrong(&["add", "epam", "end_constrain"], &["did you mean end_constraint?"]);
    refuse(&with_report(), &["predict", "epm"], 3, &["cannot read epm", "did you mean epam?"]);
    wrong(&["new", "nosuch"], &["no shipped scenario `nosuch`", "spam, cpam, epam, fpam, spam-textbook"]);
    wrong(&["list", "nosuch"], &["possible values: robots, actuators, effects, datasets, cases"]);
    wrong(&["completions", "klingon"], &["possible values: bash"]);
}

#[test]
fn a_scenario_without_pressures_asks_for_them() {
    let folder = with_report();
    let text = models::shipped("epam").unwrap();
    folder.write("quiet.toml", text.replace("pressures_kpa = [10, 20, 30]", "pressures_kpa = []"));
    refuse(&folder, &["predict", "quiet.toml"], 2, &["no pressure given", "add --pressure 10kPa,20kPa"]);
}
