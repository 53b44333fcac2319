//! Descriptions: read, refused, written and read again.

use crate::{About, Direct, Provenance, about_toml, parse_about};

const FULL: &str = r#"title = "ePAM, five runs"
provenance = "measured"
source = "our laboratory"
licence = "CC-BY-4.0"
actuator = "ePAM"
notes = "a \"note\"\nof two lines"
[geometry]
body_radius_mm = 40
body_length_mm = 360.5
pouch_length_mm = 60
pouches = 6
fold_mm = 24
[markers]
names = ["1", "2"]
s_mm = [60, 360]
[gravity]
direction = [0, -1]
[direct]
pressure = true
[bending]
stiffness_nm2 = 1.35
sd_nm2 = 0.15
[measured.gravity]
weight_n_per_m = [1.5, 0.1]
[measured.shear_lock]
lock_rad = [0.3, 0.02]
stiffness_n_per_m = [500, 50]
[[run]]
id = "1"
tip_force_n = [0, 0.3]
session = "monday"
[[run]]
id = "2"
"#;

fn line_of(measured: &crate::MeasuredValue) -> usize {
    measured.place.strip_prefix("about.toml:").unwrap().parse().unwrap()
}

fn parsed(text: &str) -> About {
    parse_about("about.toml", text).unwrap()
}

#[test]
fn a_full_description_is_read_in_si_units() {
    let about = parsed(FULL);
    let geometry = about.geometry.as_ref().unwrap();
    assert_eq!((about.provenance, about.actuator.as_deref()), (Provenance::Measured, Some("epam")));
    assert_eq!((geometry.body_radius_m, geometry.body_length_m, geometry.pouches), (0.04, 0.3605, Some(6)));
    assert_eq!((geometry.fold_m, geometry.arm_m), (Some(0.024), None));
    assert_eq!(about.markers[1].station_m, 0.36);
    assert_eq!(about.gravity_direction, Some([0.0, -1.0]));
    assert_eq!((about.tip_force_n("1"), about.tip_force_n("2")), ([0.0, 0.3], [0.0, 0.0]));
    assert_eq!(about.direct, Direct { pressure: true, frame: false });
    assert_eq!(about.bending_nm2, Some([1.35, 0.15]));
    assert_eq!(about.runs[0].session.as_deref(), Some("monday"));
    let measured: Vec<_> = about.measured.iter().map(|m| (m.effect.as_str(), m.key.as_str(), m.value, m.sd)).collect();
    assert!(about.measured.iter().all(|m| FULL.lines().nth(line_of(m) - 1).unwrap().starts_with(&m.key)));
    let lock = [("shear_lock", "lock_rad", 0.3, 0.02), ("shear_lock", "stiffness_n_per_m", 500.0, 50.0)];
    assert_eq!(measured, [&[("gravity", "weight_n_per_m", 1.5, 0.1)], &lock[..]].concat());
}

#[test]
fn a_description_written_reads_back_the_same() {
    let about = parsed(FULL);
    assert_eq!(parsed(&about_toml(&about)), about);
    let bare = parsed("title='t'\nprovenance='synthetic'\nsource='s'\nlicence='l'");
    assert_eq!(parsed(&about_toml(&bare)), bare);
}

#[test]
fn each_wrong_value_is_shown_at_its_place() {
    let cases = [
        ("body_length_mm = 360.5", "body_lenght_mm = 360.5", "unknown field `body_lenght_mm`"),
        ("title = \"ePAM, five runs\"\n", "", "missing field `title`"),
        ("title = \"ePAM, five runs\"", "title = \" \"", "title: is empty"),
        ("\"measured\"", "\"guessed\"", "unknown variant `guessed`"),
        ("body_radius_mm = 40", "body_radius_mm = \"40\"", "invalid type: string \"40\""),
        ("body_radius_mm = 40", "body_radius_mm = -40", "body_radius_mm: must be a positive length"),
        ("body_radius_mm = 40", "body_radius_mm = 0.04", "body_radius_mm: looks like metres"),
        ("fold_mm = 24", "fold_mm = nan", "fold_mm: must be a positive length"),
        ("s_mm = [60, 360]", "s_mm = [60]", "s_mm: has 1 values, names has 2"),
        ("s_mm = [60, 360]", "s_mm = [0.06, 0.36]", "s_mm: looks like metres"),
        ("s_mm = [60, 360]", "s_mm = [-60, 360]", "s_mm: station must be from 0.001 to 100000 mm, not -60"),
        ("[\"1\", \"2\"]", "[\"1\", \"1\"]", "names: marker 1 is there twice"),
        ("[0, -1]", "[0, -9.81]", "direction: must be a unit vector"),
        ("[0, -1]", "[0, nan]", "direction: must be a unit vector"),
        ("stiffness_nm2 = 1.35", "stiffness_nm2 = -1.35", "stiffness_nm2: must not be negative"),
        ("sd_nm2 = 0.15", "sd_nm2 = 0", "sd_nm2: must be above a thousandth"),
        ("sd_nm2 = 0.15\n", "", "missing field `sd_nm2`"),
        ("[1.5, 0.1]", "[1.5, 0]", "weight_n_per_m: needs a finite value and a standard deviation"),
        ("[1.5, 0.1]", "[nan, 0.1]", "weight_n_per_m: needs a finite value"),
        ("[1.5, 0.1]", "1.5", "expected an array of length 2"),
        ("[1.5, 0.1]", "[1.5, 0.1, 99]", "invalid length 3, expected an array of length 2"),
        ("[0, -1]", "[0, -1, 0]", "invalid length 3, expected an array of length 2"),
        ("[0, 0.3]", "[0, 0.3, 5]", "invalid length 3, expected an array of length 2"),
        ("[0, 0.3]", "[0, inf]", "tip_force_n: must be two finite numbers"),
        ("[0, 0.3]", "[0, -1001]", "tip_force_n: must be two finite numbers up to 1000 N"),
        ("id = \"2\"", "id = \"1\"", "id: this run is there twice"),
    ];
    for (good, bad, expected) in cases {
        assert!(FULL.contains(good), "{good}");
        let error = parse_about("about.toml", &FULL.replace(good, bad)).unwrap_err();
        assert!(error.message().contains(expected), "{error}");
        assert!(!error.help().is_empty() && error.location().line > 0 || expected.contains("title`"), "{error}");
    }
}

#[test]
fn the_caret_points_at_the_wrong_value() {
    let error = parse_about("about.toml", &FULL.replace("body_radius_mm = 40", "body_radius_mm = -40")).unwrap_err();
    assert_eq!((error.location().line, error.source_line()), (8, Some("body_radius_mm = -40")));
    assert_eq!((error.caret(), error.location().cell.as_deref()), (Some((17, 20)), Some("-40")));
}

#[test]
fn text_that_is_no_toml_is_an_error_and_not_a_panic() {
    for text in ["", "title", "title = ", "[", "\u{feff}title = 'é", "a = 1\n=", "title = \"\\u{0}\""] {
        assert!(parse_about("about.toml", text).is_err(), "{text}");
    }
}
