//! Uniaxial tests: the moduli that were put in come out again, and rubber follows its closed form.

use crate::support::*;
use models::Fabric;
use models::fabrics::{NeoHookean, Recipe, by_name};

const MODULI: [(&str, f64); 5] =
    [("e0_MPa", 96.5), ("e90_MPa", 120.0), ("e45_MPa", 4.05), ("nu12", 0.3), ("thickness_mm", 0.05)];

#[test]
fn fabrics_give_back_the_moduli_along_warp_fill_and_bias() {
    for name in ["orthotropic", "woven"] {
        let fabric = (by_name(name).unwrap().make)(&Recipe::of(&MODULI)).unwrap();
        for (angle, e_pa) in [(0.0, 96.5e6), (90.0, 120e6), (45.0, 4.05e6), (-45.0, 4.05e6)] {
            // Tension of a strain of 1e-8: the answer differs from the limit by as much.
            let found = modulus(&*fabric, angle, 1e-8 * e_pa * 5e-5);
            assert!((found / e_pa - 1.0).abs() < 1e-6, "{name} at {angle}: {found}");
        }
    }
}

#[test]
fn a_straight_woven_curve_is_the_uniaxial_test_at_large_stretch_too() {
    let fabric = (by_name("woven").unwrap().make)(&Recipe::of(&MODULI)).unwrap();
    // S₁ = P/λ with P = E₁(λ − 1) t; the fill contracts freely by ν₁₂.
    let (stretch, e1, nu): (f64, f64, f64) = (1.2, 96.5e6, 0.3);
    let fill: f64 = 1.0 - nu * 0.2;
    let s = fabric.tension([0.5 * (stretch * stretch - 1.0), 0.5 * (fill * fill - 1.0), 0.0], &FRESH);
    assert!((s[0] * stretch / (e1 * 0.2 * 5e-5) - 1.0).abs() < 1e-12 && s[1].abs() < 1e-9, "{s:?}");
}

#[test]
fn a_film_is_equally_stiff_in_every_direction() {
    let recipe = Recipe::of(&[("e_MPa", 588.0), ("nu", 0.4), ("thickness_mm", 0.6)]);
    let film = (by_name("isotropic").unwrap().make)(&recipe).unwrap();
    for angle in [0.0, 20.0, 45.0, 77.0, 90.0] {
        assert!((modulus(&*film, angle, 1e-3) / 588e6 - 1.0).abs() < 1e-9, "{angle}");
    }
}

#[test]
fn small_strain_modulus_of_the_neo_hookean_film_is_six_times_its_constant() {
    let film = NeoHookean::new(50.3e6, 2e-4);
    for angle in [0.0, 30.0, 45.0, 90.0] {
        let found = modulus(&film, angle, 1e-8 * 6.0 * 50.3e6 * 2e-4);
        assert!((found / (6.0 * 50.3e6) - 1.0).abs() < 1e-6, "{angle}: {found}");
    }
}

#[test]
fn pulled_rubber_follows_its_closed_form_at_any_stretch() {
    let film = NeoHookean::new(50.3e6, 2e-4);
    for stretch in [0.7, 0.95, 1.0, 1.1, 1.5, 2.0, 3.0_f64] {
        let e = [0.5 * (stretch * stretch - 1.0), 0.5 * (1.0 / stretch - 1.0), 0.0];
        let s = film.tension(e, &FRESH);
        let nominal = 2.0 * 50.3e6 * (stretch - stretch.powi(-2));
        assert!((s[0] * stretch / 2e-4 - nominal).abs() < 1e-6 * 50.3e6, "{stretch}: {s:?}");
        assert!(s[1].abs() < 1e-9 * 50.3e6 * 2e-4, "{stretch}: lateral {s:?}");
        let energy = 2e-4 * 50.3e6 * (stretch * stretch + 2.0 / stretch - 3.0);
        assert!((film.energy(e, &FRESH) - energy).abs() < 1e-9 * 50.3e6 * 2e-4, "{stretch}");
    }
}
