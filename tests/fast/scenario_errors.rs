//! Scenarios that are wrong: file, line and column, what was expected, what to type; an earlier report stays.

use crate::refused::{refuse, with_report};

/// Writes a scenario, and has it refused by every command that reads one.
fn refused(bytes: impl AsRef<[u8]>, words: &[&str]) {
    let folder = with_report();
    folder.write("bad.toml", bytes);
    let commands: [&[&str]; 3] = [
        &["predict", "bad.toml", "--out", "report"],
        &["compare", "bad.toml", "synthetic-epam", "--out", "report"],
        &["data", "generate", "bad.toml", "--out", "new"],
    ];
    for args in commands {
        refuse(&folder, args, 3, &[&["bad.toml"], words].concat());
    }
}

/// The shipped ePAM with one piece of text replaced, which must be there.
fn epam_with(old: &str, new: &str) -> String {
    let text = models::shipped("epam-textbook").unwrap();
    assert_eq!(text.matches(old).count(), 1, "{old}");
    text.replace(old, new)
}

#[test]
fn an_unknown_key_is_shown_with_the_known_ones() {
    let text = epam_with("width_mm = 60", "widht_mm = 60");
    refused(text, &["unknown field `widht_mm`", "`width_mm`", "bad.toml:15:1", "every key carries its unit"]);
    let text = epam_with("[predict]", "[perdict]");
    refused(text, &["unknown field `perdict`", "`predict`", "bad.toml:22:2"]);
}

#[test]
fn a_word_of_basis_that_means_nothing_is_refused() {
    let text = |basis: &str| {
        format!(
            "{}\n[effects.gravity]\nweight_n_per_m = 11\nbasis = {basis}\n",
            models::shipped("epam-textbook").unwrap()
        )
    };
    refused(
        text("\"mesured\""),
        &[
            "basis \"mesured\"",
            "did you mean measured?",
            "assumed, calibrated, measured, predicted, published",
            "bad.toml:27:9",
        ],
    );
    refused(text("1"), &["basis must be a word", "bad.toml:27:9"]);
}

#[test]
fn a_terminal_is_not_told_what_to_do_by_a_name() {
    let folder = with_report();
    folder.write("bad\u{1b}[2J.toml", epam_with("radius_mm = 40", "radius_mm = \"\u{1b}[31m\u{9b}0c\""));
    refuse(&folder, &["predict", "bad\u{1b}[2J.toml"], 3, &["bad?[2J.toml", "?[31m??0c"]);
    folder.write("my.toml", epam_with("name = \"", "name = \"\\u001b]0;title\\u0007"));
    let ran = folder.run(&["predict", "my.toml"]);
    assert!(ran.code == 0 && ran.stdout.contains("?]0;title?"), "{}{}", ran.stdout, ran.stderr);
    assert!(!ran.stdout.contains(['\u{1b}', '\u{7}']));
}

#[test]
fn a_wrong_type_is_shown_with_the_wanted_one() {
    let number = "write a plain number without quotation marks";
    refused(epam_with("radius_mm = 40", "radius_mm = \"40\""), &["string \"40\"", "bad.toml:7:13", number]);
    refused(epam_with("radius_mm = 40", "radius_mm = [40]"), &["sequence", "bad.toml:7:13", number]);
    refused(epam_with("count = 6", "count = 6.5"), &["`6.5`", "bad.toml:16:9", "write a whole number"]);
    refused(
        epam_with("radius_mm = 40", "radius_mm = 40 mm"),
        &["string values must be quoted", "bad.toml:7:13", "ibr new epam"],
    );
}

#[test]
fn a_length_below_zero_or_not_a_number_is_refused() {
    let text = epam_with("length_mm = 360", "length_mm = -360");
    refused(text, &["length must be from 1 to 100000 mm, not -360", "bad.toml:8:13", "a negative value means nothing"]);
    refused(epam_with("radius_mm = 40", "radius_mm = nan"), &["radius must be", "not NaN", "bad.toml:7:13"]);
    refused(epam_with("radius_mm = 40", "radius_mm = inf"), &["radius must be", "not inf", "bad.toml:7:13"]);
}

#[test]
fn metres_and_pascals_are_recognised() {
    let metres = "this looks like metres: write millimetres";
    refused(epam_with("length_mm = 360", "length_mm = 0.36"), &["not 0.36", "bad.toml:8:13", metres]);
    refused(epam_with("radius_mm = 40", "radius_mm = 0.04"), &["not 0.04", "bad.toml:7:13", metres]);
    refused(epam_with("length_mm = 60", "length_mm = 0.06"), &["not 0.06", "bad.toml:14:13", metres]);
    refused(epam_with("[30, 90, 150, 210, 270, 330]", "[0.03, 0.33]"), &["below 2 mm", "bad.toml:20", metres]);
    let pascals = "this looks like pascals: write kilopascals";
    refused(epam_with("pressure_kpa = 2 ", "pressure_kpa = 2000 "), &["not 2000", "bad.toml:9:16", pascals]);
    refused(epam_with("[10, 20, 30]", "[10000, 20000]"), &["not 10000", "bad.toml:23:18", pascals]);
}

#[test]
fn parts_that_do_not_fit_on_the_body_are_refused() {
    refused(
        epam_with("count = 6", "count = 7"),
        &["420.0 mm, beyond the body's 360.0 mm", "bad.toml:16:9", "lower count"],
    );
    refused(epam_with("330]", "400]"), &["marker at 400 mm is off the body of 360 mm", "bad.toml:20"]);
    refused(epam_with("330]", "200]"), &["marker stations must rise", "sort them from base to tip"]);
    let zone = |text: &str| format!("{}\n[[zone]]\n{text}\n", models::shipped("epam-textbook").unwrap());
    refused(zone("from_mm = 100\nto_mm = 50"), &["a zone from 100 to 50 mm is not on the body", "to_mm ≤ 360"]);
    refused(zone("from_mm = 0\nto_mm = 50\nchannel = 9"), &["channel must be from 0 to 3"]);
}

#[test]
fn unknown_actuators_and_effects_are_answered_with_the_list() {
    refused(
        epam_with("\"epam\"", "\"epma\""),
        &["unknown actuator \"epma\"", "did you mean epam? known: spam, cpam, epam, fpam", "bad.toml:13:8"],
    );
    let effect = |text: &str| format!("{}\n{text}\n", models::shipped("epam-textbook").unwrap());
    refused(effect("[effects.gravty]\na = 1"), &["unknown effect \"gravty\"", "did you mean gravity?", "bad.toml:25"]);
    refused(
        effect("[effects.end_constraint]\nbta = 1"),
        &["no parameter \"bta\"", "did you mean beta? its parameters: beta", "bad.toml:26"],
    );
    refused(effect("[effects.end_constraint]\nbeta = 5"), &["outside its physical bounds 0 to 1", "bad.toml:26:8"]);
    refused(
        effect("[effects.gravity]\nweight_n_per_m = 11"),
        &["outside its usual bounds 0 to 8 N/m", "basis = \"measured\"", "bad.toml:26"],
    );
    refused(
        effect("[effects.gravity]\nweight_n_per_m = -1\nbasis = \"measured\""),
        &["outside its physical bounds 0 N/m and above", "bad.toml:26"],
    );
    refused(
        effect("[effects.shear_stiffness]"),
        &["does not exist for actuator epam", "remove [effects.shear_stiffness]"],
    );
}

#[test]
fn a_missing_key_or_broken_toml_has_its_place() {
    refused(epam_with("radius_mm = 40", "# no radius"), &["missing field `radius_mm`", "bad.toml:6:1", "ibr new epam"]);
    refused(epam_with("[actuator]", "[actuator"), &["unclosed table", "bad.toml:12:10", "ibr new epam"]);
    refused(epam_with("count = 6", "count = 6\ncount = 7"), &["duplicate key", "bad.toml:17:1"]);
}

#[test]
fn files_that_are_no_scenario_are_refused() {
    let start = "`ibr new epam > my.toml` makes a start";
    refused("", &["cannot read", "the file is empty", start]);
    refused("\n\n", &["the file is empty", start]);
    refused("# nothing\n", &["missing field `body`", "ibr new epam"]);
    refused(b"\xff\xfe\x00[body]", &["not a text in UTF-8", start]);
    refused((0..=255).cycle().take(5000).collect::<Vec<u8>>(), &["not a text in UTF-8"]);
    let folder = with_report();
    refuse(
        &folder,
        &["predict", "nothing.toml"],
        3,
        &["cannot read nothing.toml: no robot and no file has this name", start],
    );
    refuse(&folder, &["predict", "report"], 3, &["cannot read report: Is a directory", start]);
    refuse(&folder, &["predict", "epma"], 3, &["cannot read epma", "shipped robot: spam, cpam, epam, fpam"]);
}
