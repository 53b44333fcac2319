//! The cell against the ideal braid, quadrature and its own energy.

use super::*;

const YARNS: f64 = 1.48e-4;
const LENGTH_M: f64 = 0.3;

fn muscle(bias_deg: f64, weave: Weave) -> Muscle {
    let bias_rad = bias_deg.to_radians();
    let shape = ActuatorShape { length_m: LENGTH_M, width_m: 0.06, fold_m: 0.0, volume_gain: 1.0, bias_rad };
    Muscle::of(&weave, &shape, 0.068)
}

/// Force of the ideal braid \[N\].
fn braid_n(radius_m: f64, bias: f64, contraction: f64, p_act_pa: f64) -> f64 {
    let pulled = 3.0 * (1.0 - contraction).powi(2) / bias.tan().powi(2) - 1.0 / bias.sin().powi(2);
    PI * radius_m.powi(2) * p_act_pa * pulled
}

/// Contraction at which it pulls no more.
fn max_contraction(bias: f64) -> f64 {
    1.0 - 1.0 / (3.0_f64.sqrt() * bias.cos())
}

/// Squared stretch around the tube of a half of length x.
fn hoop2(half: &Half, tau: f64, x: f64) -> f64 {
    1.0 + 2.0 * half.hoop[0] * tau + half.hoop[1] * (x * x - 1.0)
}

fn stretchy(compliance_m_per_n: f64) -> Weave {
    Weave { compliance_m_per_n, ..Weave::default() }
}

fn pull_n(at: &Muscle, contraction: f64, p_act_pa: f64) -> f64 {
    -at.potential(contraction, p_act_pa, 0.0).1
}

fn root(mut f: impl FnMut(f64) -> f64, mut low: f64, mut high: f64) -> f64 {
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        if f(middle) > 0.0 { low = middle } else { high = middle }
    }
    low
}

#[test]
fn stiff_yarns_make_the_ideal_muscle_at_every_bias_angle() {
    for bias_deg in [25.0_f64, 42.5, 45.0, 50.0] {
        let (at, bias) = (muscle(bias_deg, Weave::default()), bias_deg.to_radians());
        for contraction in [-0.03, 0.0, 0.07, 0.15] {
            let braid = braid_n(at.radius_m, bias, contraction, 30e3);
            assert!((pull_n(&at, contraction, 30e3) - braid).abs() < 1e-10, "{bias_deg} {contraction}");
        }
        assert!(pull_n(&at, max_contraction(bias), 30e3).abs() < 1e-11, "{bias_deg}");
    }
}

#[test]
fn what_the_supply_gives_is_stored_in_the_yarns_or_pulled_out() {
    // At fixed pressure −∂E/∂P is the volume, so E + P v is what the yarns store: m²/c over both halves.
    let (cell, contraction, p) = (muscle(45.0, stretchy(YARNS)), 0.06, 30e3);
    let energy = |contraction: f64, p: f64| cell.potential(contraction, p, 0.0).0;
    let volume = (energy(contraction, p - 1.0) - energy(contraction, p + 1.0)) / 2.0;
    let y = 1.0 - contraction;
    let around = cell.halves.map(|half| hoop2(&half, p * cell.radius_m * y, y));
    let shape = PI * cell.radius_m.powi(2) * 0.5 * (around[0] + around[1]) * y;
    assert!((volume / shape - 1.0).abs() < 1e-8, "{volume} {shape}");
    let strain = YARNS * p * cell.radius_m * (1.0 - contraction);
    let stored = 2.0 * PI * cell.radius_m * strain.powi(2) / YARNS;
    assert!(((energy(contraction, p) + p * volume) / stored - 1.0).abs() < 1e-6);
    // Round a loop of contraction and pressure no work is left over.
    let corners = [(0.02, 10e3), (0.08, 10e3), (0.08, 40e3), (0.02, 40e3), (0.02, 10e3)];
    let mut work = 0.0;
    for side in corners.windows(2) {
        for i in 0..2000 {
            let along = |t: f64| {
                let [from, to] = [side[0], side[1]];
                (from.0 + t * (to.0 - from.0), from.1 + t * (to.1 - from.1))
            };
            let (middle, dp) = (along((f64::from(i) + 0.5) / 2000.0), (side[1].1 - side[0].1) / 2000.0);
            let de = (side[1].0 - side[0].0) / 2000.0;
            let volume = (energy(middle.0, middle.1 - 1.0) - energy(middle.0, middle.1 + 1.0)) / 2.0;
            work += pull_n(&cell, middle.0, middle.1) * de + volume * dp;
        }
    }
    assert!(work.abs() < 1e-7, "{work:e} J/m");
}

#[test]
fn a_flat_end_is_the_shape_of_most_volume() {
    let r = 0.02;
    // Without a pull the profile A/cosψ = const, by quadrature over v = 1 − u: singular only in s, not in the shortening.
    let (mut shorter, mut missing, n) = (0.0, 0.0, 100_000);
    for i in 0..n {
        let v = (f64::from(i) + 0.5) / f64::from(n);
        let cos = 1.0 - v * v;
        let sin = (1.0 - cos * cos).sqrt();
        shorter += (1.0 - cos) / sin * r / f64::from(n);
        missing += v / sin * r / f64::from(n);
    }
    assert!((shorter / ((SQRT_2 - 1.0) * r) - 1.0).abs() < 1e-6);
    assert!((missing / (FRAC_PI_4 * r) - 1.0).abs() < 1e-6);
    assert!(end_pull(SQRT_2 - 1.0)[0].abs() < 1e-15);
    for pull in [-0.3, 0.0, 0.5, 4.0] {
        let m = 2.0 + 2.0 * pull;
        let d = f64::sqrt(m) - (m - 1.0).sqrt();
        assert!((end_pull(d)[0] - pull).abs() < 1e-12, "{pull}");
        let slope = (end_work(d + 1e-6) - end_work(d - 1e-6)) / 2e-6;
        assert!((slope - pull).abs() < 1e-7, "{pull} {slope}");
    }
}

#[test]
fn a_free_muscle_with_flat_ends_is_shorter_by_their_closed_form() {
    let cell = muscle(45.0, Weave { flat_ends: 2.0, ..Weave::default() });
    let free = root(|contraction| pull_n(&cell, contraction, 30e3), 0.0, 0.5);
    assert_eq!(cell.halves.map(|half| hoop2(&half, 30e3 * cell.radius_m, 1.0)), [1.0; 2]);
    let ends = 2.0 * (SQRT_2 - 1.0) * cell.radius_m / LENGTH_M;
    let idle = 2.0 * FRAC_PI_4 * cell.radius_m / LENGTH_M;
    let weave = (1.0 - idle) * max_contraction(FRAC_PI_4);
    assert!((free - weave - ends).abs() < 1e-12, "{free} {weave} {ends}");
}

#[test]
fn a_stiff_wall_keeps_the_length_and_the_width_of_the_half_that_is_glued_to_it() {
    let weave = Weave { wall_n_per_m: 1e12, compliance_m_per_n: YARNS, ..Weave::default() };
    let cell = muscle(45.0, weave);
    let (half, thrust) = (cell.halves[1], 30e3 * cell.radius_m);
    // All of the hoop tension is then the wall's, e = P r₀/K.
    assert!((hoop2(&half, thrust, 1.0) - 1.0 - 2.0 * thrust / 1e12).abs() < 1e-12);
    // Longer than its yarns it resists with the wall's stiffness, shorter it folds.
    assert!((half.slopes(1.001, 1.0, thrust).own[0] / 1e9 - 1.0).abs() < 0.01);
    assert!(Half::new(&weave, cell.bias, 5400.0).slopes(0.999, 1.0, 573.0).own[0].abs() < 573.0);
}

#[test]
fn the_force_is_minus_the_slope_of_the_energy_with_all_of_it_on() {
    let weave = Weave {
        compliance_m_per_n: YARNS,
        wall_n_per_m: 5400.0,
        flat_ends: 2.0,
        drawn_in_m2: 1.47e-3,
        shear_n_per_m: 51.4,
    };
    for bias_deg in [35.0, 45.0] {
        for p in [1e3, 3e3, 10e3, 30e3, 90e3] {
            for contraction in [-0.02, 0.01, 0.05, 0.08, 0.2] {
                let cell = muscle(bias_deg, weave);
                let energy =
                    |contraction: f64| cell.add(&Pose::new(&[0.0, contraction, 0.0, 0.0], 2e3, p), &mut [0.0; 4]);
                let mut force = [0.0; 4];
                cell.add(&Pose::new(&[0.0, contraction, 0.0, 0.0], 2e3, p), &mut force);
                let central = |h: f64| (energy(contraction + h) - energy(contraction - h)) / (2.0 * h);
                let slope = (4.0 * central(1e-4) - central(2e-4)) / 3.0;
                assert!((force[1] + slope).abs() < 1e-6 * (force[1].abs() + p * 1e-3), "{bias_deg} {p} {contraction}");
            }
        }
    }
}
