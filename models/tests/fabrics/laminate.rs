//! Bonded plies: sums, turns and the glue between.

use crate::support::*;
use models::Fabric;
use models::fabrics::{InlinedFabric, Laminate, NeoHookean, Orthotropic, Ply, Recipe, by_name};
use std::sync::Arc;

fn ply(fabric: impl Fabric + 'static, angle_deg: f64) -> Ply {
    Ply { fabric: Arc::new(fabric), angle_rad: f64::to_radians(angle_deg) }
}

fn cloth(thickness_m: f64) -> Orthotropic {
    Orthotropic::from_bias(96.5e6, 120e6, 4.05e6, 0.3, thickness_m).unwrap()
}

fn same(a: &dyn Fabric, b: &dyn Fabric, tolerance: f64) {
    let mut random = Random::new(3);
    assert!((a.thickness_m() - b.thickness_m()).abs() < 1e-15);
    for _ in 0..100 {
        let e = random.strain(0.1);
        let (s, r) = (a.tension(e, &FRESH), b.tension(e, &FRESH));
        assert!(apart(s, r, 0.0) < tolerance, "{e:?}: {s:?} {r:?}");
        assert!((a.energy(e, &FRESH) - b.energy(e, &FRESH)).abs() < tolerance * b.energy(e, &FRESH));
    }
}

#[test]
fn two_equal_plies_are_one_of_double_thickness() {
    same(&Laminate::new(vec![ply(cloth(5e-5), 0.0), ply(cloth(5e-5), 0.0)]).unwrap(), &cloth(1e-4), 1e-12);
    let film = |thickness_m| NeoHookean::new(50.3e6, thickness_m);
    same(&Laminate::new(vec![ply(film(1e-4), 0.0), ply(film(1e-4), 0.0)]).unwrap(), &film(2e-4), 1e-12);
}

#[test]
fn rubber_and_linear_plies_add_up_to_one_formula_and_other_laws_do_not() {
    let film = NeoHookean::new(50.3e6, 1e-4);
    let inner = Laminate::new(vec![ply(cloth(5e-5), 20.0), ply(film, 0.0)]).unwrap();
    let outer = Laminate::new(vec![ply(inner, 30.0), ply(film, 45.0), ply(cloth(2e-5), -70.0)]).unwrap();
    let InlinedFabric::Mixed(mixed) = outer.kind() else { panic!("{:?}", outer.kind()) };
    let mut random = Random::new(5);
    for _ in 0..100 {
        let e = random.strain(0.1);
        let linear = mixed.linear.map(|row| row[0] * e[0] + row[1] * e[1] + row[2] * e[2]);
        let rubber = mixed.rubber.tension(e, &FRESH);
        let sum = [rubber[0] + linear[0], rubber[1] + linear[1], rubber[2] + linear[2]];
        assert!(apart(sum, outer.tension(e, &FRESH), 0.0) < 1e-12, "{e:?}");
    }
    assert!((mixed.rubber.thickness_m - 2e-4).abs() < 1e-18);
    let films = Laminate::new(vec![ply(film, 0.0), ply(film, 30.0)]).unwrap();
    assert!(matches!(films.kind(), InlinedFabric::NeoHookean(both) if (both.thickness_m - 2e-4).abs() < 1e-18));
    let woven = (by_name("woven").unwrap().make)(&(by_name("woven").unwrap().example)()).unwrap();
    let with_curves = Laminate::new(vec![ply(film, 0.0), Ply { fabric: woven, angle_rad: 0.0 }]).unwrap();
    assert!(matches!(with_curves.kind(), InlinedFabric::Other));
}

#[test]
fn a_quarter_turn_swaps_warp_and_fill_and_an_isotropic_film_does_not_notice_any() {
    let swapped = Orthotropic::checked(120e6, 96.5e6, 0.3 * 120.0 / 96.5, cloth(5e-5).a66 / 5e-5, 5e-5).unwrap();
    same(&Laminate::new(vec![ply(cloth(5e-5), 90.0)]).unwrap(), &swapped, 1e-10);
    let film = NeoHookean::new(50.3e6, 2e-4);
    same(&Laminate::new(vec![ply(film, 33.0)]).unwrap(), &film, 1e-10);
}

#[test]
fn a_ply_turned_by_its_angle_is_pulled_off_its_yarns_by_as_much() {
    let turned = Laminate::new(vec![ply(cloth(5e-5), 30.0)]).unwrap();
    for angle in [0.0, 15.0, 30.0, 75.0] {
        let (found, expected) = (modulus(&turned, angle, 1e-6), modulus(&cloth(5e-5), angle - 30.0, 1e-6));
        assert!((found / expected - 1.0).abs() < 1e-9, "{angle}: {found} {expected}");
    }
    assert!((modulus(&turned, 75.0, 1e-6) / 4.05e6 - 1.0).abs() < 1e-9);
}

#[test]
fn cross_plies_at_45_degrees_are_symmetric_and_stiffer_than_each() {
    let crossed = Laminate::new(vec![ply(cloth(5e-5), 45.0), ply(cloth(5e-5), -45.0)]).unwrap();
    let tangent = crossed.tangent([0.0; 3], &FRESH);
    let scale = tangent[0][0];
    assert!((tangent[0][0] - tangent[1][1]).abs() < 1e-12 * scale);
    assert!((0.9..1.5).contains(&(modulus(&crossed, 0.0, 1e-6) / 4.05e6)));
}

#[test]
fn the_glue_adds_its_own_stiffness_and_thickness() {
    let mut recipe = Recipe::of(&[("glue_thickness_mm", 0.1), ("glue_e_MPa", 2.0), ("glue_nu", 0.5)]);
    recipe.plies = vec![ply(cloth(5e-5), 0.0), ply(cloth(5e-5), 45.0)];
    let bare = Laminate::new(recipe.plies.clone()).unwrap();
    let glued = (by_name("glued").unwrap().make)(&recipe).unwrap();
    assert!((glued.thickness_m() - 2e-4).abs() < 1e-15);
    let film = Orthotropic::isotropic(2e6, 0.5, 1e-4);
    let mut random = Random::new(4);
    for _ in 0..50 {
        let e = random.strain(0.05);
        let (with, without, alone) = (glued.tension(e, &FRESH), bare.tension(e, &FRESH), film.tension(e, &FRESH));
        assert!(apart(with, std::array::from_fn(|i| without[i] + alone[i]), 0.0) < 1e-12);
    }
}

#[test]
fn plies_remember_what_their_own_yarns_saw() {
    let law = by_name("woven").unwrap();
    let woven = (law.make)(&(law.example)()).unwrap();
    let at = |angle_deg: f64| Ply { fabric: woven.clone(), angle_rad: f64::to_radians(angle_deg) };
    let laminate = Laminate::new(vec![at(90.0), ply(cloth(5e-5), 10.0)]).unwrap();
    let mut past = FRESH;
    laminate.remember([0.0, 0.105, 0.0], &mut past);
    assert!((past[0] - 0.1).abs() < 1e-12 && past[1].abs() < 1e-12, "{past:?}");
    assert_eq!(laminate.dissipated(&past), woven.dissipated(&past));
    assert!(laminate.has_memory() && laminate.dissipated(&past) > 0.0);
    assert!(Laminate::new(vec![at(0.0), at(45.0)]).unwrap_err().contains("45"));
    assert!(Laminate::new(vec![]).is_err() && Laminate::new(vec![at(f64::NAN)]).is_err());
}
