//! A neo-Hookean film that wrinkles: the least energy over folds, one tension, and one film of several sheets.

use crate::support::*;
use models::Fabric;
use models::fabrics::{Kind, Laminate, NeoHookean, Ply, WrinklingFilm};
use std::sync::Arc;

const FILM: NeoHookean = NeoHookean { c10_pa: 50.3e6, thickness_m: 2e-4 };

fn with(share: f64) -> WrinklingFilm {
    WrinklingFilm { film: FILM, share }
}

/// Least of the film's energy over folds e + β n⊗n, β ≥ 0, by golden section in β for every direction.
fn least_over_folds(e: [f64; 3]) -> f64 {
    let mut least = FILM.energy(e, &FRESH);
    for k in 0..2000 {
        let (s, c) = (f64::from(k) * std::f64::consts::PI / 2000.0).sin_cos();
        let n = [c * c, s * s, 2.0 * c * s];
        let at = |depth: f64| FILM.energy(std::array::from_fn(|i| e[i] + depth * n[i]), &FRESH);
        let (mut low, mut high) = (0.0, 0.5);
        for _ in 0..60 {
            let (a, b) = (low + 0.382 * (high - low), low + 0.618 * (high - low));
            if at(a) < at(b) { high = b } else { low = a }
        }
        least = least.min(at(0.5 * (low + high)));
    }
    least
}

#[test]
fn a_film_has_the_least_energy_that_any_fold_leaves_and_one_tension() {
    let mut random = Random::new(21);
    let mut seen = [0; 3];
    for _ in 0..60 {
        let e = random.strain(0.1);
        let (w, s) = (with(0.0).energy(e, &FRESH), with(0.0).tension(e, &FRESH));
        let full = FILM.energy(e, &FRESH);
        let lowest = 0.5 * (s[0] + s[1]) - (0.5 * (s[0] - s[1])).hypot(s[2]);
        assert!(s[0] + s[1] >= 0.0 && lowest >= -1e-9 * (s[0] + s[1]), "{e:?}: {s:?}");
        if s == [0.0; 3] {
            // Folds in two directions: one alone cannot take all of it away.
            assert!(w == 0.0 && 0.5 * (e[0] + e[1]) + (0.5 * (e[0] - e[1])).hypot(0.5 * e[2]) <= 0.0);
            seen[2] += 1;
            continue;
        }
        assert!((w - least_over_folds(e)).abs() <= 1e-5 * full, "{e:?}: {w} {}", least_over_folds(e));
        seen[usize::from(w < full)] += 1;
    }
    assert!(seen.iter().all(|n| *n >= 5), "{seen:?}");
}

#[test]
fn pulled_one_way_a_film_is_as_wide_as_it_likes_and_narrower_it_wrinkles_at_the_same_tension() {
    let stretch = 1.2_f64;
    let width = stretch.powf(-0.5);
    let strain = |wide: f64| [0.5 * (stretch * stretch - 1.0), 0.5 * (wide * wide - 1.0), 0.0];
    let free = FILM.tension(strain(width), &FRESH);
    assert!(free[1].abs() < 1e-9 * free[0]);
    for wide in [width - 1e-9, 0.9 * width, 0.5 * width] {
        let s = with(0.0).tension(strain(wide), &FRESH);
        assert!((s[0] / free[0] - 1.0).abs() < 1e-8 && s[1].abs() < 1e-9 * s[0], "{wide}: {s:?}");
    }
}

#[test]
fn without_its_folds_a_film_is_as_little_taut_as_can_be() {
    let mut random = Random::new(23);
    let mut changed = 0;
    for _ in 0..200 {
        let e = random.strain(0.2);
        let u = WrinklingFilm::unfolded(e);
        let (mean, r) = (1.0 + u[0] + u[1], (u[0] - u[1]).hypot(u[2]));
        let (large, small) = (mean + r, mean - r);
        assert!(large >= 1.0 - 1e-12 && small * large.sqrt() >= 1.0 - 1e-12, "{e:?}: {u:?}");
        // Directions stay: both are multiples of one traceless matrix.
        assert!(((u[0] - u[1]) * e[2] - (e[0] - e[1]) * u[2]).abs() < 1e-12);
        if with(0.0).energy(e, &FRESH) == FILM.energy(e, &FRESH) {
            assert!(apart(u, e, 1e-12) < 1e-9, "{e:?}: {u:?}");
        } else {
            assert!((small * large.sqrt() - 1.0).abs() < 1e-9, "{e:?}: {u:?}");
            // Its energy is what the folded film has.
            assert!(
                (FILM.energy(u, &FRESH) - with(0.0).energy(e, &FRESH)).abs() < 1e-9 * FILM.c10_pa * FILM.thickness_m
            );
            changed += 1;
        }
    }
    assert!((50..200).contains(&changed), "{changed}");
}

#[test]
fn the_share_is_what_compression_meets_and_all_of_it_is_the_film() {
    let e = [-0.01, -0.02, 0.004];
    let full = FILM.tension(e, &FRESH);
    assert!(apart(with(0.05).tension(e, &FRESH), full.map(|s| 0.05 * s), 0.0) < 1e-12);
    let mut random = Random::new(22);
    for _ in 0..200 {
        let e = random.strain(0.1);
        assert_eq!(with(1.0).tension(e, &FRESH), FILM.tension(e, &FRESH));
        assert_eq!(with(1.0).energy(e, &FRESH), FILM.energy(e, &FRESH));
    }
}

#[test]
fn two_films_of_one_share_are_one_film() {
    let two = |shares: [f64; 2]| {
        let ply = |share: f64| Ply { fabric: Arc::new(with(share)) as Arc<dyn Fabric>, angle_rad: 0.3 };
        Laminate::new(shares.map(ply).to_vec()).unwrap()
    };
    let same = two([0.01; 2]);
    let Kind::WrinklingFilm(film) = same.kind() else { panic!("{:?}", same.kind()) };
    let e = [0.02, -0.03, 0.01];
    assert!(apart(film.tension(e, &FRESH), same.tension(e, &FRESH), 0.0) < 1e-12);
    assert!(matches!(two([0.01, 0.02]).kind(), Kind::Other));
}
