//! What a user can type wrong, and what the scenario says then.

use super::*;
use crate::effects::EFFECTS;

fn broken(from: &str, to: &str) -> ScenarioError {
    let text = shipped("epam-textbook").unwrap();
    assert!(text.contains(from), "{from}");
    Scenario::parse(&text.replace(from, to)).unwrap_err()
}

#[test]
fn every_actuator_has_a_shipped_scenario_and_all_parse() {
    for actuator in crate::actuators::ACTUATORS {
        let name = actuator.name;
        assert!(
            shipped(name).is_some(),
            "the actuator {name} has no scenario: write models/scenarios/{name}.toml and name it in SHIPPED, models/src/scenario/mod.rs"
        );
    }
    for (name, text) in SHIPPED {
        let scenario = Scenario::parse(text).unwrap_or_else(|e| panic!("{name}: {e}"));
        assert_eq!(scenario.actuator.kind.name, *name);
        assert_eq!(scenario.markers_m.len(), 6);
    }
}

#[test]
fn each_slip_is_refused_with_its_place_and_a_hint() {
    let cases = [
        ("radius_mm = 40 ", "radius_mm = 0.04 ", "radius must be", "metres"),
        ("radius_mm = 40 ", "radius_mm = -40 ", "radius must be", "negative"),
        ("radius_mm = 40 ", "radius_mm = \"40\" ", "invalid type", ""),
        ("radius_mm = 40 ", "radius_m = 40 ", "unknown field `radius_m`", "unit"),
        ("pressure_kpa = 2 ", "pressure_kpa = 2000 ", "pressure must be", "pascals"),
        ("pressure_kpa = 2 ", "pressure_kpa = 0.29 ", "pressure must be", "psi"),
        ("pressure_kpa = 2 ", "pressure_kpa = nan ", "pressure must be", ""),
        ("kind = \"epam\"", "kind = \"epm\"", "unknown actuator", "epam"),
        ("count = 6 ", "count = 7 ", "beyond the body", "count"),
        ("count = 6 ", "count = 0 ", "count must be", ""),
        ("330]", "390]", "off the body", "base"),
        ("330]", "200]", "must rise", "sort"),
        ("[10, 20, 30]", "[10, 20, 30000]", "pressure must be", "pascals"),
        ("[predict]", "[effects.end_constrain]\nbeta = 1\n[predict]", "unknown effect", "end_constraint"),
        ("[predict]", "[effects.end_constraint]\nbta = 1\n[predict]", "no parameter", "beta"),
        ("[predict]", "[effects.end_constraint]\nbeta = 1.5\n[predict]", "bounds", "typical"),
        ("[predict]", "[effects.end_constraint]\nbeta = \"x\"\n[predict]", "must be a number", "beta ="),
        ("[predict]", "[effects.shear_stiffness]\nshear_n_per_m = 50\n[predict]", "does not exist", "remove"),
    ];
    for (from, to, message, help) in cases {
        let error = broken(from, to);
        assert!(error.message.contains(message), "{to}: {error:?}");
        assert!(error.help.clone().unwrap_or_default().contains(help), "{to}: {error:?}");
        assert!(error.span.is_some(), "{to}: {error:?}");
    }
}

#[test]
#[should_panic(expected = "no effect `end_constrain`")]
fn a_misspelt_effect_in_code_is_not_ignored() {
    let _ = Scenario::parse(shipped("epam-textbook").unwrap()).unwrap().with_effect("end_constrain", &[0.4]);
}

#[test]
fn an_empty_or_cut_text_is_an_error_not_a_panic() {
    let text = shipped("fpam").unwrap();
    for end in 0..text.len() {
        if text.is_char_boundary(end) {
            let _ = Scenario::parse(&text[..end]);
        }
    }
    assert!(Scenario::parse("").unwrap_err().message.contains("missing field"));
}

#[test]
fn zones_cut_the_body_and_override_what_they_name() {
    let text = format!(
        "{}\n[[zone]]\nfrom_mm = 60\nto_mm = 120\npassive = true\n[[zone]]\nfrom_mm = 240\nto_mm = 360\nradius_mm = 30\nchannel = 2\n",
        shipped("epam-textbook").unwrap()
    );
    let spans = Scenario::parse(&text).unwrap().spans();
    let starts: Vec<f64> = spans.iter().map(|s| (s.start_m * 1e3).round()).collect();
    assert_eq!(starts, [0.0, 60.0, 120.0, 240.0]);
    assert!(spans[1].actuator.is_none() && spans[2].actuator.is_some());
    assert_eq!((spans[3].radius_m, spans[3].arm_m, spans[3].channel), (0.03, 0.06, 2));
}

#[test]
fn the_base_law_is_set_from_the_scenario() {
    let text = |more: &str| shipped("epam-textbook").unwrap().replace("[actuator]", &format!("{more}\n[actuator]"));
    let y = |more: &str| {
        let model = crate::Model::new(&Scenario::parse(&text(more)).unwrap());
        let mut state = model.prediction();
        model.predict(&crate::Loads::uniform(2e3, 10e3), &mut state).unwrap();
        (state.tip.y_m, state.tip.angle_rad, state.tip.x_m)
    };
    let base = y("");
    assert_eq!(y("hinge_moment_share = 1.0\ncentre_line_mm = 40"), base);
    let (soft, long) = (y("hinge_moment_share = 0.5"), y("centre_line_mm = 0"));
    // Half the moment is twice the pressure ratio; without shortening the same angle reaches further.
    let model = crate::Model::new(&Scenario::parse(&text("")).unwrap());
    let mut state = model.prediction();
    model.predict(&crate::Loads::uniform(2e3, 20e3), &mut state).unwrap();
    assert!((soft.1 - state.tip.angle_rad).abs() < 1e-12, "{} {}", soft.1, state.tip.angle_rad);
    assert!(long.1 == base.1 && long.0 > base.0 && long.2 > base.2);
    assert!(Scenario::parse(&text("hinge_moment_share = 3")).unwrap_err().help.unwrap().contains("collapse"));
}

const OWN: &str = r#"
[[formula]]
name = "cubic_spring"
moment = "-k*theta^3"
[formula.parameters.k]
unit = "N m"
typical = 0.5
bounds = [0, 20]
"#;

#[test]
fn a_formula_of_the_scenario_joins_the_catalogue_and_can_be_switched_on() {
    let text =
        shipped("epam-textbook").unwrap().to_string() + OWN + "[effects.cubic_spring]\nk = 2\nbasis = \"assumed\"\n";
    let scenario = Scenario::parse(&text).unwrap();
    assert_eq!(scenario.formulas.len(), 1);
    let chosen = scenario.effects.iter().find(|e| e.name == "cubic_spring").unwrap();
    assert_eq!((chosen.values.as_slice(), chosen.basis.as_str()), (&[2.0][..], "assumed"));
    assert_eq!(scenario.bare().catalogue().effects().count(), EFFECTS.len() + 1);
}

#[test]
fn a_slip_in_a_formula_is_shown_under_its_character() {
    for (from, to, message, at) in [
        ("theta^3", "theta^", "ends too early", "\""),
        ("theta^3", "phi^3", "`phi` is not known", "phi"),
        ("theta^3", "(theta", "not closed", "("),
        ("-k*theta^3", "-k*kappa", "comes out in N, not in N m", "-k*kappa"),
        ("N m\"", "N furlong\"", "furlong", "\"N furlong\""),
        ("[0, 20]", "[20, 0]", "must rise", "[20, 0]"),
        ("[0, 20]", "[0, 0.1]", "outside its bounds", "0.5"),
        ("[0, 20]", "[0.1, 20]", "neutral = 0", "k"),
        ("cubic_spring", "friction", "already", "\"friction\""),
        ("cubic_spring", "cubic spring", "cannot name", "\"cubic spring\""),
        (".k]", ".kappa]", "cannot name", "kappa"),
        ("typical = 0.5", "typicl = 0.5", "unknown field", "typicl"),
        ("typical = 0.5", "typical = 0", "typical = 0 of k is its neutral value", "0"),
        ("typical = 0.5", "typical = 0.5\nneutral = 0.5", "typical = 0.5 of k is its neutral value", "0.5"),
    ] {
        let text = shipped("epam-textbook").unwrap().to_string() + &OWN.replace(from, to);
        let error = Scenario::parse(&text).unwrap_err();
        let (start, end) = error.span.unwrap_or_else(|| panic!("{to}: {error:?}"));
        assert!(error.message.contains(message), "{to}: {error:?}");
        assert_eq!(&text[start..end], at, "{to}: {error:?}");
    }
    let twice = shipped("epam-textbook").unwrap().to_string() + OWN + OWN;
    assert!(Scenario::parse(&twice).unwrap_err().message.contains("two formulas"));
}

#[test]
fn a_value_beyond_the_usual_bounds_is_taken_if_it_was_found_on_the_robot() {
    let with = |basis: &str| {
        let text = shipped("epam-textbook").unwrap();
        Scenario::parse(&format!("{text}\n[effects.gravity]\nbasis = \"{basis}\"\nweight_n_per_m = 11\n"))
    };
    for basis in ["measured", "published", "calibrated"] {
        assert_eq!(with(basis).unwrap().effects.last().unwrap().values, [11.0]);
    }
    assert!(with("assumed").unwrap_err().to_string().contains("usual bounds 0 to 8 N/m"));
}

#[test]
fn geometry_that_cannot_be_built_is_refused_in_the_words_of_the_pattern() {
    let cases = [
        ("width_mm = 60 ", "width_mm = 130 ", "a pouch of 130 mm is wider than half of the body, 125.664 mm"),
        ("width_mm = 60 ", "width_mm = 60\narm_mm = 1 ", "an arm of 1 mm from the far side of the body ends inside it"),
    ];
    for (from, to, words) in cases {
        let error = broken(from, to);
        assert!(error.message.contains(words) && error.span.is_some(), "{error:?}");
    }
}

#[test]
fn a_wall_is_told_once_and_with_how_it_is_known() {
    let with = |keys: &str| {
        Scenario::parse(&shipped("epam-textbook").unwrap().replace("[actuator]", &format!("{keys}\n[actuator]")))
    };
    let wall = with("wall_stiffness_n_per_m = 41600").unwrap().wall;
    assert_eq!((wall.stiffness_n_per_m, wall.basis.as_str()), (Some(41600.0), "assumed"));
    let refused = [
        ("wall_stiffness_n_per_m = 41.6", "wall stiffness must be", "N/mm"),
        ("wall_stiffness_n_per_m = 41600\nhinge_curvature_per_m = 0.1", "repeats a wall", "remove"),
        ("wall_stiffness_n_per_m = 41600\nwall_basis = \"geometry\"", "is none of the words", "predicted"),
        ("wall_basis = \"measured\"", "wall_basis without a wall", "add"),
    ];
    for (keys, message, help) in refused {
        let error = with(keys).unwrap_err();
        assert!(error.message.contains(message) && error.help.unwrap_or_default().contains(help), "{keys}");
    }
}
