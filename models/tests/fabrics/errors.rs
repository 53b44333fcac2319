//! Bad recipes are refused with the key and what to write.

use models::fabrics::{FABRICS, Need, Orthotropic, Recipe, by_name};

fn refused(law: &str, numbers: &[(&str, f64)]) -> String {
    (by_name(law).unwrap().make)(&Recipe::of(numbers)).unwrap_err()
}

#[test]
fn every_number_of_every_law_has_bounds_that_hold_and_a_message_that_names_it() {
    for law in FABRICS {
        for p in law.parameters {
            for bad in [p.lower - 1.0, p.upper * 2.0 + 1.0, f64::NAN, f64::INFINITY, -1e-3] {
                let mut recipe = (law.example)();
                recipe.numbers.insert(p.key.into(), bad);
                let message = (law.make)(&recipe).unwrap_err();
                assert!(message.contains(p.key) && message.contains(law.name), "{bad}: {message}");
            }
            if p.need == Need::Required {
                let mut recipe = (law.example)();
                recipe.numbers.remove(p.key);
                let message = (law.make)(&recipe).unwrap_err();
                assert!(message.contains(p.key) && message.contains(p.unit), "{message}");
            }
        }
    }
}

#[test]
fn every_curve_of_every_law_says_which_row_is_wrong() {
    for law in FABRICS {
        for c in law.curves {
            let mut recipe = (law.example)();
            let single = ["e0_MPa", "e90_MPa", "e45_MPa", "g_MPa"];
            recipe.numbers.retain(|key, _| !single.contains(&key.as_str()));
            if c.key == "bias_extension" {
                recipe.curves.remove("shear");
            }
            recipe.curves.insert(c.key.into(), vec![[0.0, 0.0], [1.0, 2.0], [2.0, 1.0]]);
            let message = (law.make)(&recipe).unwrap_err();
            assert!(message.contains(c.key) && message.contains("row 3"), "{message}");
        }
    }
}

#[test]
fn what_a_law_does_not_know_is_listed_with_what_it_knows() {
    let message = refused("neo-hookean", &[("c10_mpa", 50.3), ("thickness_mm", 0.2)]);
    assert!(message.contains("`c10_mpa`") && message.contains("c10_MPa"), "{message}");
    let mut recipe = Recipe::of(&[("c10_MPa", 50.3), ("thickness_mm", 0.2)]);
    recipe.curves.insert("warp".into(), vec![]);
    let message = (by_name("neo-hookean").unwrap().make)(&recipe).unwrap_err();
    assert!(message.contains("no curve `warp`"), "{message}");
    let message = refused("glued", &[("glue_thickness_mm", 0.1), ("glue_e_MPa", 1.0)]);
    assert!(message.contains("0 plies") && message.contains("write 2"), "{message}");
}

#[test]
fn moduli_that_contradict_each_other_are_refused() {
    let cloth = |e45: f64, nu12: f64| {
        refused(
            "orthotropic",
            &[("e0_MPa", 96.5), ("e90_MPa", 120.0), ("e45_MPa", e45), ("nu12", nu12), ("thickness_mm", 0.05)],
        )
    };
    assert!(cloth(4.05, 0.9).contains("below 0.897"), "{}", cloth(4.05, 0.9));
    assert!(cloth(220.0, 0.0).contains("below 213.9"), "{}", cloth(220.0, 0.0));
    assert!(Orthotropic::from_bias(96.5e6, 120e6, 213e6, 0.0, 5e-5).is_ok());
    let both = [("e0_MPa", 96.5), ("e90_MPa", 120.0), ("e45_MPa", 4.0), ("g_MPa", 1.0), ("thickness_mm", 0.05)];
    assert!(refused("orthotropic", &both).contains("more than one"));
    assert!(refused("woven", &[both[0], both[1], both[4]]).contains("e45_MPa`, `g_MPa`, `shear`"));
    assert!(refused("tension-field", &[("e0_MPa", 1.0), ("g_MPa", 1.0), ("thickness_mm", 1.0)]).contains("e90_MPa"));
    for (nu12, t) in [(-0.1, 1e-4), (0.0, -1e-4), (0.0, 0.0), (f64::NAN, 1e-4), (1.0, 1e-4)] {
        assert!(Orthotropic::checked(1e6, 1e6, nu12, 1e6, t).is_err(), "{nu12} {t}");
    }
}

#[test]
fn a_coupling_that_slack_yarns_cannot_carry_is_refused() {
    let numbers = [
        ("e0_MPa", 96.5),
        ("e90_MPa", 120.0),
        ("g_MPa", 1.0),
        ("nu12", 0.3),
        ("compression_share", 0.01),
        ("thickness_mm", 0.05),
    ];
    let message = refused("woven", &numbers);
    assert!(message.contains("nu12") && message.contains("compression_share"), "{message}");
    let mut fits = Recipe::of(&numbers);
    fits.numbers.insert("nu12".into(), 0.005);
    assert!((by_name("woven").unwrap().make)(&fits).is_ok());
}
