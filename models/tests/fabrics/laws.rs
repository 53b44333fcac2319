//! Over every entry of the list: tension is the slope of the energy, rest is rest, and no strain gives energy away.

use crate::support::*;
use models::Fabric;
use models::fabrics::{FABRICS, Law};
use std::sync::Arc;

const STRAINS: usize = 400;

fn each(check: impl Fn(&Law, Arc<dyn Fabric>, &mut Random)) {
    assert!(FABRICS.len() >= 7);
    for (i, law) in FABRICS.iter().enumerate() {
        check(law, (law.make)(&(law.example)()).unwrap(), &mut Random::new(i as u64 + 1));
    }
}

/// Nothing seen, or up to the limit.
fn memory(fabric: &dyn Fabric, limit: f64, random: &mut Random) -> [f64; 2] {
    if fabric.has_memory() { [random.between(0.0, limit), random.between(0.0, limit)] } else { FRESH }
}

/// Central difference of the energy, each entry at the best of several steps: small ones lose digits, large ones cross rows.
fn worst_slope(fabric: &dyn Fabric, e: [f64; 3], past: &[f64; 2]) -> f64 {
    let s = fabric.tension(e, past);
    let stiff = fabric.tangent([0.0; 3], &FRESH);
    let largest = e.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
    let size = s.iter().fold(1e-3 * stiff[2][2] * largest, |m, x| m.max(x.abs()));
    let mut worst = 0.0_f64;
    for (i, slope) in s.iter().enumerate() {
        let error = |h: f64| {
            let moved = |by: f64| fabric.energy(std::array::from_fn(|k| e[k] + if k == i { by } else { 0.0 }), past);
            ((moved(h) - moved(-h)) / (2.0 * h) - slope).abs() / size
        };
        worst = worst.max((2..=7).map(|k| error(largest * 0.1_f64.powi(k))).fold(f64::INFINITY, f64::min));
    }
    worst
}

#[test]
fn tension_is_the_slope_of_the_energy_at_random_strains() {
    each(|law, fabric, random| {
        for _ in 0..STRAINS {
            let e = random.strain(law.strain_limit);
            let past = memory(&*fabric, law.strain_limit, random);
            let error = worst_slope(&*fabric, e, &past);
            assert!(error < 1e-6, "{} at {e:?} after {past:?}: {error:e}", law.name);
        }
    });
}

#[test]
fn the_tangent_is_the_slope_of_the_tension() {
    each(|law, fabric, random| {
        let scale = fabric.tangent([0.0; 3], &FRESH).as_flattened().iter().fold(0.0_f64, |m, k| m.max(k.abs()));
        for _ in 0..STRAINS {
            let (e, past) = (random.strain(law.strain_limit), memory(&*fabric, law.strain_limit, random));
            let largest = e.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
            let tangent = fabric.tangent(e, &past);
            let error = |h: f64| {
                let moved = |j: usize, by: f64| {
                    fabric.tension(std::array::from_fn(|k| e[k] + if k == j { by } else { 0.0 }), &past)
                };
                let column = |j: usize| {
                    let (up, down) = (moved(j, h), moved(j, -h));
                    std::array::from_fn(|i| (up[i] - down[i]) / (2.0 * h))
                };
                (0..3).map(|j| apart(tangent.map(|row| row[j]), column(j), scale)).fold(0.0, f64::max)
            };
            let best = (2..=7).map(|k| error(largest * 0.1_f64.powi(k))).fold(f64::INFINITY, f64::min);
            assert!(best < 1e-6, "{} at {e:?}: {best:e}", law.name);
            let asymmetry = (tangent[0][2] - tangent[2][0]).abs().max((tangent[0][1] - tangent[1][0]).abs());
            assert!(asymmetry < 1e-12 * scale, "{} at {e:?}: {asymmetry:e}", law.name);
        }
    });
}

#[test]
fn no_strain_gives_energy_away_and_rest_is_rest() {
    each(|law, fabric, random| {
        for _ in 0..STRAINS {
            let past = memory(&*fabric, law.strain_limit, random);
            assert_eq!(fabric.energy([0.0; 3], &past), 0.0, "{}", law.name);
            assert_eq!(fabric.tension([0.0; 3], &past).map(f64::abs), [0.0; 3], "{}", law.name);
            let e = random.strain(law.strain_limit);
            assert!(fabric.energy(e, &past) >= 0.0, "{} at {e:?} after {past:?}", law.name);
        }
        assert!(fabric.energy([0.01, 0.0, 0.0], &FRESH) > 0.0 && fabric.thickness_m() > 0.0, "{}", law.name);
    });
}

#[test]
fn turning_the_deformed_sheet_in_space_changes_nothing() {
    each(|law, fabric, random| {
        for _ in 0..20 {
            let n = 0.3 * law.strain_limit;
            let f: [[f64; 3]; 2] =
                std::array::from_fn(|a| std::array::from_fn(|i| f64::from(a == i) + random.between(-n, n)));
            let turned = f.map(|column| turn(column, 2.0, 0.7));
            let (before, after) = (green(f), green(turned));
            let (w, v) = (fabric.energy(before, &FRESH), fabric.energy(after, &FRESH));
            assert!((w - v).abs() <= 1e-9 * w, "{}: {w} {v}", law.name);
        }
    });
}

/// Green–Lagrange strain of the columns of F.
fn green(f: [[f64; 3]; 2]) -> [f64; 3] {
    let dot = |a: [f64; 3], b: [f64; 3]| a.iter().zip(b).map(|(x, y)| x * y).sum::<f64>();
    [0.5 * (dot(f[0], f[0]) - 1.0), 0.5 * (dot(f[1], f[1]) - 1.0), dot(f[0], f[1])]
}

fn turn(v: [f64; 3], z: f64, x: f64) -> [f64; 3] {
    let ((sz, cz), (sx, cx)) = (z.sin_cos(), x.sin_cos());
    let w = [cz * v[0] - sz * v[1], sz * v[0] + cz * v[1], v[2]];
    [w[0], cx * w[1] - sx * w[2], sx * w[1] + cx * w[2]]
}

#[test]
fn names_and_keys_are_unique_and_every_entry_says_what_it_is() {
    for (i, law) in FABRICS.iter().enumerate() {
        assert!(FABRICS[..i].iter().all(|other| other.name != law.name), "{}", law.name);
        let keys: Vec<&str> = law.parameters.iter().map(|p| p.key).chain(law.curves.iter().map(|c| c.key)).collect();
        assert!(keys.iter().enumerate().all(|(k, key)| !keys[..k].contains(key)), "{}", law.name);
        for p in law.parameters {
            assert!(p.lower < p.upper && p.si > 0.0 && !p.meaning.is_empty(), "{} {}", law.name, p.key);
        }
    }
}
