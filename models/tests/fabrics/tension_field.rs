//! Tension field: taut, wrinkled, slack; isotropic in closed form, orthotropic against the relaxed energy by brute force.

use crate::support::*;
use models::Fabric;
use models::fabrics::{Orthotropic, TensionField};

const T: f64 = 6e-4;

fn cloth() -> Orthotropic {
    Orthotropic::from_bias(96.5e6, 120e6, 4.05e6, 0.3, 5e-5).unwrap()
}

#[test]
fn an_isotropic_film_is_taut_wrinkled_or_slack_by_its_closed_form() {
    let (e_pa, nu) = (588e6, 0.4);
    let field = TensionField::new(Orthotropic::isotropic(e_pa, nu, T), 0.0).unwrap();
    let mut random = Random::new(9);
    let mut seen = [0; 3];
    for _ in 0..2000 {
        let e = random.strain(0.02);
        let (mean, radius) = (0.5 * (e[0] + e[1]), (0.5 * (e[0] - e[1])).hypot(0.5 * e[2]));
        let (high, low) = (mean + radius, mean - radius);
        let (state, expected) = if high <= 0.0 {
            (2, 0.0)
        } else if low >= -nu * high {
            (0, 0.5 * e_pa * T / (1.0 - nu * nu) * (high * high + 2.0 * nu * high * low + low * low))
        } else {
            (1, 0.5 * e_pa * T * high * high)
        };
        seen[state] += 1;
        let (w, s) = (field.energy(e, &FRESH), field.tension(e, &FRESH));
        assert!((w - expected).abs() <= 1e-10 * expected, "{e:?}: {w} {expected}");
        let lowest = 0.5 * (s[0] + s[1]) - (0.5 * (s[0] - s[1])).hypot(s[2]);
        assert!(lowest >= -1e-9 * (s[0] + s[1]).abs(), "compression {lowest} at {e:?}");
    }
    assert!(seen.iter().all(|n| *n > 100), "{seen:?}");
}

#[test]
fn an_orthotropic_cloth_has_the_least_energy_that_any_fold_leaves() {
    // E/G about 100 and 1000.
    [cloth(), Orthotropic::checked(96.5e6, 120e6, 0.3, 1e5, 5e-5).unwrap()].into_iter().for_each(compare_with_folds);
}

fn compare_with_folds(sheet: Orthotropic) {
    let field = TensionField::new(sheet, 0.0).unwrap();
    let mut random = Random::new(10);
    for _ in 0..60 {
        let e = random.strain(0.02);
        let relaxed = field.energy(e, &FRESH);
        let mut least = sheet.energy(e, &FRESH);
        // Folds across every direction, each as deep as pays: P = β n⊗n, β = −n·S n/(n n·A n n).
        for k in 0..20_000 {
            let (s, c) = (k as f64 * std::f64::consts::PI / 20_000.0).sin_cos();
            let n = [c * c, s * s, 2.0 * c * s];
            let dot = |a: [f64; 3]| n[0] * a[0] + n[1] * a[1] + n[2] * a[2];
            let depth = (-dot(sheet.tension(e, &FRESH)) / dot(sheet.tension(n, &FRESH))).max(0.0);
            least = least.min(sheet.energy(std::array::from_fn(|i| e[i] + depth * n[i]), &FRESH));
        }
        assert!(relaxed <= least * (1.0 + 1e-12), "{e:?}: {relaxed} is more than {least}");
        one_fold_attains(&sheet, &field, e);
    }
}

/// The fold P = A⁻¹S − e leaves exactly the relaxed energy, and swallows no negative length in any direction.
fn one_fold_attains(sheet: &Orthotropic, field: &TensionField, e: [f64; 3]) {
    let relaxed = field.energy(e, &FRESH);
    let taut = solve(sheet.tangent(e, &FRESH), field.tension(e, &FRESH));
    let fold: [f64; 3] = std::array::from_fn(|i| taut[i] - e[i]);
    let (mean, radius) = (0.5 * (fold[0] + fold[1]), (0.5 * (fold[0] - fold[1])).hypot(0.5 * fold[2]));
    let size = e.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
    assert!(mean - radius >= -1e-12 * size, "{e:?} folds by {fold:?}");
    assert!((sheet.energy(taut, &FRESH) - relaxed).abs() <= 1e-9 * relaxed, "{e:?}");
}

#[test]
fn the_stress_state_of_wrinkled_cloth_is_uniaxial_tension() {
    let field = TensionField::new(cloth(), 0.0).unwrap();
    let mut random = Random::new(11);
    for _ in 0..2000 {
        let e = random.strain(0.05);
        let s = field.tension(e, &FRESH);
        let size = (s[0] + s[1]).abs();
        let lowest = 0.5 * (s[0] + s[1]) - (0.5 * (s[0] - s[1])).hypot(s[2]);
        assert!(s[0] + s[1] >= 0.0 && lowest >= -1e-9 * size, "{e:?}: {s:?}");
    }
}

#[test]
fn the_share_is_what_compression_meets() {
    let sheet = Orthotropic::isotropic(588e6, 0.4, T);
    let field = TensionField::new(sheet, 0.01).unwrap();
    let e = [-0.01, -0.01, 0.002];
    assert!(apart(field.tension(e, &FRESH), sheet.tension(e, &FRESH).map(|s| 0.01 * s), 0.0) < 1e-12);
    let pulled = [0.01, 0.01, 0.002];
    assert!(apart(field.tension(pulled, &FRESH), sheet.tension(pulled, &FRESH), 0.0) < 1e-12);
    assert!(TensionField::new(sheet, 1.5).is_err() && TensionField::new(sheet, f64::NAN).is_err());
    assert!(TensionField::new(Orthotropic { a12: 2.0 * sheet.a11, ..sheet }, 0.0).is_err());
}

#[test]
fn nearly_slack_cloth_still_has_the_least_energy() {
    let field = TensionField::new(cloth(), 0.0).unwrap();
    let mut random = Random::new(13);
    for _ in 0..200 {
        // Principal strains −0.01 and a millionth of that: the stretched cone is a tenth of a degree wide.
        let (sin, cos) = random.between(0.0, 6.3).sin_cos();
        let e = [-0.005 * (1.0 - 1e-6) + 0.005 * cos, -0.005 * (1.0 - 1e-6) - 0.005 * cos, 0.01 * sin];
        let s = field.tension(e, &FRESH);
        assert!(field.energy(e, &FRESH) > 0.0);
        one_fold_attains(&cloth(), &field, e);
        let tangent = field.tangent(e, &FRESH);
        // Of degree one: T e = S.
        let degree: [f64; 3] = std::array::from_fn(|i| (0..3).map(|j| tangent[i][j] * e[j]).sum());
        assert!(apart(s, degree, 0.0) < 1e-4, "{s:?} {degree:?}");
    }
}

#[test]
fn tension_does_not_jump_between_the_states() {
    let field = TensionField::new(cloth(), 0.0).unwrap();
    let mut random = Random::new(12);
    let stiffest = 1.2 * cloth().a22;
    for _ in 0..20 {
        let (from, to) = (random.strain(0.02), random.strain(0.02));
        let at = |x: f64| std::array::from_fn(|i| from[i] + x * (to[i] - from[i]));
        let length = (0..3).map(|i| (to[i] - from[i]).powi(2)).sum::<f64>().sqrt();
        const STEPS: usize = 1000;
        for k in 0..STEPS {
            let (a, b) = (at(k as f64 / STEPS as f64), at((k + 1) as f64 / STEPS as f64));
            let jump = apart(field.tension(a, &FRESH), field.tension(b, &FRESH), 1.0);
            let size = field.tension(a, &FRESH).iter().fold(1.0_f64, |m, s| m.max(s.abs()));
            assert!(jump * size <= 2.0 * stiffest * length / STEPS as f64, "{a:?}");
        }
    }
}
