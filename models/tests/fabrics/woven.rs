//! Woven fabric: yarns turn, memory loses exactly the loop, jammed yarns stiffen.

use crate::support::*;
use models::Fabric;
use models::fabrics::{Curve, Recipe, Woven, Yarn, by_name};

const T: f64 = 5e-5;

fn load() -> Curve {
    Curve::table(&[[0.0, 0.0], [0.02, 1.6e6], [0.1, 12e6], [0.2, 22e6]]).unwrap()
}

fn unload() -> Curve {
    Curve::table(&[[0.0, 0.0], [0.02, 0.3e6], [0.1, 4e6], [0.2, 12e6]]).unwrap()
}

fn sheet(unloading: Option<Curve>) -> Woven {
    let yarns = [Yarn::new(load(), unloading).unwrap(), Yarn::new(Curve::linear(120e6), None).unwrap()];
    Woven::new(yarns, Curve::linear(1e6), 0.0, T).unwrap()
}

/// Green–Lagrange strain of a nominal one along warp.
fn pulled(nominal: f64) -> [f64; 3] {
    [nominal * (1.0 + 0.5 * nominal), 0.0, 0.0]
}

#[test]
fn pulled_along_warp_the_curve_comes_out_again() {
    let fabric = sheet(None);
    for strain in [-0.1, 0.01, 0.02, 0.05, 0.15, 0.3] {
        let nominal_tension = fabric.tension(pulled(strain), &FRESH)[0] * (1.0 + strain);
        assert!((nominal_tension / (T * load().value(strain)) - 1.0).abs() < 1e-12, "{strain}");
    }
}

#[test]
fn turned_yarns_without_stretch_cost_shear_energy_alone() {
    let fabric = sheet(None);
    for gamma in [-1.2, -0.3, 0.1, 0.7, 1.3_f64] {
        let e = [0.0, 0.0, gamma.sin()];
        assert!((fabric.energy(e, &FRESH) / (T * 0.5 * 1e6 * gamma * gamma) - 1.0).abs() < 1e-12, "{gamma}");
        // The force that a picture frame feels is the moment over cos γ.
        assert!((fabric.tension(e, &FRESH)[2] / (T * 1e6 * gamma / gamma.cos()) - 1.0).abs() < 1e-12, "{gamma}");
    }
}

#[test]
fn a_cycle_loses_exactly_the_area_of_its_loop() {
    let (fabric, mut past) = (sheet(Some(unload())), FRESH);
    let mut work = 0.0;
    const STEPS: usize = 20_000;
    let path = |k: usize| {
        let x = k as f64 / STEPS as f64;
        if x < 0.5 { 0.3 * x } else { 0.3 * (1.0 - x) }
    };
    for k in 0..STEPS {
        let (a, b) = (path(k), path(k + 1));
        let force = |x: f64, past: &[f64; 2]| fabric.tension(pulled(x), past)[0] * (1.0 + x);
        let before = force(a, &past);
        fabric.remember(pulled(b), &mut past);
        work += 0.5 * (before + force(b, &past)) * (b - a);
    }
    assert!((past[0] - 0.15).abs() < 1e-12 && past[1] == 0.0, "{past:?}");
    let back = load().value(0.15) / unload().value(0.15) * unload().integral(0.15);
    let loop_area = T * (load().integral(0.15) - back);
    assert!(loop_area > 0.1 * T * load().integral(0.15));
    assert!((fabric.dissipated(&past) / loop_area - 1.0).abs() < 1e-12);
    assert!((work / loop_area - 1.0).abs() < 1e-6, "{work} {loop_area}");
}

#[test]
fn energy_plus_loss_is_the_work_done_wherever_a_random_path_leads() {
    let (fabric, mut past, mut random) = (sheet(Some(unload())), FRESH, Random::new(5));
    let (mut at, mut work) = (0.0, 0.0);
    let mut lost = 0.0;
    for _ in 0..40 {
        let target = random.between(-0.05, 0.25);
        const STEPS: usize = 2000;
        for k in 1..=STEPS {
            let next = at + (target - at) / (STEPS + 1 - k) as f64;
            let force = |x: f64| fabric.tension(pulled(x), &past)[0] * (1.0 + x);
            work += 0.5 * (force(at) + force(next)) * (next - at);
            at = next;
            fabric.remember(pulled(at), &mut past);
            let now = fabric.dissipated(&past);
            assert!(now >= lost - 1e-12 * T * load().integral(0.25), "a loss came back: {lost} {now}");
            lost = now;
        }
        let stored = fabric.energy(pulled(at), &past);
        assert!((stored + lost - work).abs() < 1e-6 * T * load().integral(0.25), "{stored} + {lost} is not {work}");
    }
    assert!(lost > 0.0);
}

#[test]
fn tension_is_continuous_at_the_turning_point_and_below_the_loading_curve_under_it() {
    let fabric = sheet(Some(unload()));
    for turn in [0.01, 0.05, 0.12, 0.3] {
        let s = |x: f64| fabric.tension(pulled(x), &[turn, 0.0])[0];
        assert!((s(turn * (1.0 - 1e-10)) / s(turn * (1.0 + 1e-10)) - 1.0).abs() < 1e-8);
        for share in [0.1, 0.5, 0.9] {
            assert!(
                s(turn * share) <= fabric.tension(pulled(turn * share), &FRESH)[0] * (1.0 + 1e-12),
                "{turn} {share}"
            );
        }
    }
}

#[test]
fn an_unloading_curve_that_would_create_energy_is_refused() {
    let bulging = Curve::table(&[[0.0, 0.0], [0.02, 3e6], [0.2, 22e6]]).unwrap();
    let message = Yarn::new(load(), Some(bulging)).unwrap_err();
    assert!(message.contains("create energy") && message.contains("0.02"), "{message}");
    let flat_end = Curve::table(&[[0.0, 0.0], [0.1, 3e6], [0.2, 3.1e6]]).unwrap();
    assert!(Yarn::new(load(), Some(flat_end)).is_err());
}

#[test]
fn a_bias_extension_test_sets_the_shear_curve() {
    let mut recipe = Recipe::of(&[("e0_MPa", 96.5), ("e90_MPa", 120.0), ("thickness_mm", 0.05)]);
    // Rows of a strip 250 mm by 20 mm whose shear force is 0.02 N/mm per radian.
    let rows = vec![[0.0, 0.0], [25.2325254, 0.202938974], [46.9681594, 0.440893099], [64.9222197, 0.706023369]];
    recipe.curves.insert("bias_extension".into(), rows);
    let make = |recipe: &Recipe| (by_name("woven").unwrap().make)(recipe);
    assert!(make(&recipe).unwrap_err().contains("bias_width_mm"));
    recipe.numbers.extend([("bias_length_mm".to_string(), 250.0), ("bias_width_mm".to_string(), 20.0)]);
    let fabric = make(&recipe).unwrap();
    for gamma in [0.2335667, 0.4669, 0.7_f64] {
        // T₁₂/cos γ = F_sh/t
        let s = fabric.tension([0.0, 0.0, gamma.sin()], &FRESH)[2];
        assert!((s / (20.0 * gamma) - 1.0).abs() < 1e-6, "{gamma}: {s}");
    }
    recipe.curves.get_mut("bias_extension").unwrap().push([96.0, 2.0]);
    assert!(make(&recipe).unwrap_err().contains("row 5"));
}

#[test]
fn jammed_yarns_stiffen_both_ways() {
    let recipe = |extra: &[(&str, f64)]| {
        let basic = [("e0_MPa", 96.5), ("e90_MPa", 120.0), ("g_MPa", 1.0), ("thickness_mm", 0.05)];
        Recipe::of(&[&basic, extra].concat())
    };
    let make = |extra: &[(&str, f64)]| (by_name("woven").unwrap().make)(&recipe(extra)).unwrap();
    let (free, jams) = (make(&[]), make(&[("locking_deg", 40.0), ("locking_MPa", 50.0)]));
    let shear = |fabric: &dyn Fabric, deg: f64| fabric.tension([0.0, 0.0, deg.to_radians().sin()], &FRESH)[2];
    assert_eq!(shear(&*free, 39.0), shear(&*jams, 39.0));
    for deg in [45.0, -45.0_f64] {
        let extra = 50e6 * 5f64.to_radians() * T / deg.to_radians().cos() * deg.signum();
        assert!(((shear(&*jams, deg) - shear(&*free, deg)) / extra - 1.0).abs() < 1e-9);
    }
}

#[test]
fn compression_takes_the_rows_below_zero_or_a_share_of_the_slope() {
    let make = |rows: &[[f64; 2]], share: Option<f64>| {
        let mut recipe = Recipe::of(&[("e90_MPa", 120.0), ("g_MPa", 1.0), ("thickness_mm", 0.05)]);
        recipe.curves.insert("warp".into(), rows.to_vec());
        recipe.numbers.extend(share.map(|s| ("compression_share".to_string(), s)));
        (by_name("woven").unwrap().make)(&recipe)
    };
    let rising: &[[f64; 2]] = &[[0.0, 0.0], [0.1, 10.0]];
    let with_rows: &[[f64; 2]] = &[[-0.1, -0.5], [0.0, 0.0], [0.1, 10.0]];
    for (rows, share, mpa) in [(rising, None, 5.0), (rising, Some(0.01), 0.05), (with_rows, None, 0.25)] {
        let s = make(rows, share).unwrap().tension(pulled(-0.05), &FRESH)[0];
        assert!((s * 0.95 / (-mpa * 1e6 * T) - 1.0).abs() < 1e-12, "{s}");
    }
    assert!(make(with_rows, Some(0.01)).unwrap_err().contains("compression_share"));
}

#[test]
fn a_collapsed_element_gives_finite_numbers() {
    let fabric = sheet(Some(unload()));
    for e in [[-0.5, 0.0, 0.0], [-0.5, -0.5, 0.0], [0.0, 0.0, 1.0], [0.0, 0.0, -1.0], [-0.7, 0.1, 3.0]] {
        let (w, s) = (fabric.energy(e, &FRESH), fabric.tension(e, &FRESH));
        assert!(w.is_finite() && s.iter().all(|x| x.is_finite()), "{e:?}: {w} {s:?}");
    }
}
