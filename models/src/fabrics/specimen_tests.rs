//! Tests of the reduction of specimens.

use super::super::{Fabric, NeoHookean};
use super::*;

fn rows(n: usize, end: f64, y: impl Fn(f64) -> f64) -> Vec<[f64; 2]> {
    (0..=n).map(|i| end * i as f64 / n as f64).map(|x| [x, y(x)]).collect()
}

#[test]
fn the_fit_recovers_the_constant_of_the_sheet_law_pulled_with_free_edges() {
    let sheet = NeoHookean::new(50.3e6, 2e-4);
    let pulled = |strain: f64| {
        // Incompressible and free to contract: C₂₂ = 1/λ.
        let stretch: f64 = 1.0 + strain;
        let e = [0.5 * (stretch * stretch - 1.0), 0.5 * (1.0 / stretch - 1.0), 0.0];
        sheet.tension(e, &[0.0; 2])[0] * stretch / sheet.thickness_m
    };
    let curve = rows(30, 0.3, pulled);
    assert!((c10_pa(&curve).unwrap() / 50.3e6 - 1.0).abs() < 1e-12);
    assert!((c10_by_share_pa(&curve).unwrap() / 50.3e6 - 1.0).abs() < 1e-12);
    assert!(misfit(&curve, |e| neo_hookean_pa(50.3e6, e)) < 1e-12);
    assert_eq!(c10_pa(&[[0.0, 0.0]]), None);
}

#[test]
fn the_two_weights_differ_where_the_curve_has_another_shape() {
    // P = 1000 ε + 20000 ε²: the share looks at small strains (6 C₁₀ → 1000), the stress at large ones.
    let curve = rows(100, 0.2, |e| 1e3 * e + 2e4 * e * e);
    let (stress, share) = (c10_pa(&curve).unwrap(), c10_by_share_pa(&curve).unwrap());
    assert!(share < 0.9 * stress && misfit(&curve, |e| neo_hookean_pa(stress, e)) > 0.02, "{share} {stress}");
}

#[test]
fn the_slope_of_a_line_is_found_whatever_its_intercept() {
    assert!((slope(&rows(10, 0.01, |x| 3.0 + 96.5 * x)).unwrap() - 96.5).abs() < 1e-9);
    assert_eq!(slope(&[[0.1, 1.0]]), None);
    assert_eq!(slope(&[]), None);
}

#[test]
fn a_drop_that_is_made_good_is_a_slip_and_a_break_or_noise_is_none() {
    let slipped = rows(100, 0.2, |x| if x < 0.1 { 1e3 * x } else { 1e3 * x - 20.0 });
    let found = drop(&slipped).unwrap();
    assert!((found.at - 0.098).abs() < 1e-9 && (found.until - 0.118).abs() < 1e-9, "{found:?}");
    assert!((found.lost - (1.0 - 80.0 / 98.0)).abs() < 1e-9);
    assert_eq!(drop(&rows(100, 0.2, |x| if x < 0.15 { 1e3 * x } else { 30.0 })), None);
    assert_eq!(drop(&rows(200, 0.2, |x| 1e3 * x + 2.0 * (900.0 * x).sin())), None);
}

#[test]
fn a_flat_stretch_between_two_rises_is_a_slip_and_a_soft_start_is_none() {
    let flat = rows(200, 0.2, |x| 1e3 * (x.min(0.1) + (x - 0.13).max(0.0)));
    let found = plateau(&flat).unwrap();
    assert!((found.at - 0.1).abs() < 0.006 && (found.until - 0.13).abs() < 0.006, "{found:?}");
    assert_eq!(plateau(&rows(200, 0.2, |x| 1e4 * x * x)), None);
    assert_eq!(plateau(&rows(200, 0.2, |x| 1e3 * x.min(0.12))), None);
}

#[test]
fn locking_is_where_the_lines_meet_and_an_even_rise_has_none() {
    let found = locking(&rows(60, 0.9, |x| 50.0 * x + 900.0 * (x - 0.75).max(0.0))).unwrap();
    assert!((found.angle - 0.75).abs() < 0.01, "{found:?}");
    assert!((found.slopes[0] - 50.0).abs() < 2.0 && (found.slopes[1] - 950.0).abs() < 60.0, "{found:?}");
    assert_eq!(locking(&rows(60, 0.9, |x| 50.0 * x)), None);
    assert_eq!(locking(&rows(60, 0.9, |x| 50.0 * x + 30.0 * x * x)), None);
    assert_eq!(locking(&[]), None);
}

#[test]
fn rising_keeps_what_rises_and_pools_what_falls() {
    let straight = [[0.0, 0.0], [1.0, 2.0], [2.0, 3.0]];
    assert_eq!(rising(&straight), straight);
    let pooled = rising(&[[1.0, 1.0], [2.0, 3.0], [3.0, 2.0], [4.0, 5.0]]);
    assert_eq!(pooled, [[0.0, 0.0], [1.0, 1.0], [2.5, 2.5], [4.0, 5.0]]);
    assert_eq!(rising(&[[0.0, 0.0], [1.0, -1.0], [2.0, -2.0]]), [[0.0, 0.0]]);
}

#[test]
fn thinning_keeps_a_straight_line_and_reading_is_straight_between_rows() {
    let thin = thinned(&rows(10_000, 1.0, |x| 4.0 * x), 100);
    assert_eq!(thin.len(), 100);
    assert!(thin.iter().all(|[x, y]| (y - 4.0 * x).abs() < 1e-12));
    assert_eq!(thinned(&[[0.0, 1.0]], 4), [[0.0, 1.0]]);
    assert_eq!([0.5, -1.0, 3.0].map(|x| at(&[[0.0, 0.0], [1.0, 2.0]], x)), [1.0, 0.0, 2.0]);
}

/// A line that starts late, with a soft toe before it: the slack is where the line would start.
#[test]
fn slack_is_where_the_straight_line_behind_a_soft_toe_starts() {
    let toe = |x: f64| if x < 0.002 { 0.25 * x * x / 0.001 } else { x - 0.001 };
    let rows: Vec<[f64; 2]> = (0..=60).map(|i| 2.5e-4 * f64::from(i)).map(|x| [x, 1e8 * toe(x)]).collect();
    let found = slack(&rows, 0.01).unwrap();
    assert!((found.at - 0.001).abs() < 2.5e-5, "{found:?}");
    // A straight line, a noisy one, a softening curve and one that goes on to stiffen have none.
    let noise = |i: i32| 2e4 * f64::from((i * 7919) % 13 - 6);
    let made = |law: &dyn Fn(i32) -> f64| (0..=60).map(|i| [2.5e-4 * f64::from(i), law(i)]).collect::<Vec<[f64; 2]>>();
    let x = |i: i32| 2.5e-4 * f64::from(i);
    for rows in [
        made(&|i| 1e8 * x(i)),
        made(&|i| 1e8 * x(i) + noise(i)),
        made(&|i| 1e8 * x(i) * (1.0 - 20.0 * x(i))),
        made(&|i| 1e10 * x(i).powi(2)),
    ] {
        assert_eq!(slack(&rows, 0.01), None, "{rows:?}");
    }
}

/// 150 mm of a sheet of 300 MPa that is pulled by 6 % after a slack, with a corner that is sharp or rounded over 0.2 mm, and the noise of a load
/// cell; rows every 0.02 to 0.1 mm.
#[test]
fn slack_of_any_length_leaves_the_modulus() {
    for tenth_mm in 3..=30 {
        for (step_mm, round_mm, noise) in [(0.02, 0.0, 0.0), (0.1, 0.0, 0.0), (0.05, 0.2, 0.0), (0.05, 0.1, 3e-4)] {
            let slack_mm = 0.1 * f64::from(tenth_mm);
            let taut = |x: f64| {
                let past = x - slack_mm;
                if past.abs() < round_mm { (past + round_mm).powi(2) / (4.0 * round_mm) } else { past.max(0.0) }
            };
            let row = |k: usize| {
                let x = step_mm * k as f64;
                let scatter = noise * 30e6 * (7.3 * (k * k % 101) as f64).sin();
                [x / 150.0, neo_hookean_pa(50e6, taut(x) / 150.0) + scatter]
            };
            let rows: Vec<[f64; 2]> = (0..(9.0 / step_mm) as usize).map(row).collect();
            let found = slack(&rows, 0.01).unwrap_or_else(|| panic!("{slack_mm} mm, every {step_mm} mm"));
            let behind = rows[found.from..].iter().map(|[x, y]| [x - found.at, *y]).take_while(|row| row[0] <= 0.01);
            let modulus = slope(&[[0.0, 0.0]].into_iter().chain(behind).collect::<Vec<_>>()).unwrap();
            assert!((modulus / 300e6 - 1.0).abs() < 0.02, "{slack_mm} mm, every {step_mm} mm: {} MPa", modulus * 1e-6);
        }
    }
}

/// The same with the noise of a small load cell on a weak specimen: 0.1 to 0.4 % of the largest force. The noise alone leaves 1.2 % of the modulus.
#[test]
fn slack_is_found_in_noise() {
    let mut state = 5_u64;
    let mut uniform = move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 53) as f64
    };
    let (mut worst, mut unseen) = ([0.0_f64; 3], 0);
    for (k, noise) in [1e-3, 2e-3, 4e-3].into_iter().enumerate() {
        for slack_mm in (3..=30).map(|tenth| 0.1 * f64::from(tenth)) {
            for round_mm in [0.0, 0.1, 0.2] {
                let taut = |x: f64| {
                    let past = x - slack_mm;
                    if past.abs() < round_mm { (past + round_mm).powi(2) / (4.0 * round_mm) } else { past.max(0.0) }
                };
                let row = |k: usize| {
                    let x = 0.02 * k as f64;
                    let scatter = (0..12).map(|_| uniform()).sum::<f64>() - 6.0;
                    [x / 150.0, 300e6 * taut(x) / 150.0 + noise * 12e6 * scatter]
                };
                let rows: Vec<[f64; 2]> = (0..400).map(row).collect();
                let Some(found) = slack(&rows, 0.01) else {
                    unseen += 1;
                    continue;
                };
                let behind =
                    rows[found.from..].iter().map(|[x, y]| [x - found.at, *y]).take_while(|row| row[0] <= 0.01);
                let modulus = slope(&[[0.0, 0.0]].into_iter().chain(behind).collect::<Vec<_>>()).unwrap();
                worst[k] = worst[k].max((modulus / 300e6 - 1.0).abs());
            }
        }
    }
    assert!(unseen == 0 && worst[1] < 0.02 && worst[2] < 0.04, "{worst:?} {unseen}");
}

#[test]
fn crimp_that_goes_on_to_stiffen_is_no_slack() {
    for knee in [0.02, 0.03, 0.05] {
        let curve = |x: f64| if x < knee { x * x / (2.0 * knee) } else { x - 0.5 * knee };
        assert_eq!(slack(&rows(200, 0.08, |x| 300e6 * curve(x)), 0.01), None, "{knee}");
    }
}
