//! A neo-Hookean film that wrinkles: the least energy over folds, the load of the wrinkles, and one film of several sheets.

use crate::support::*;
use models::Fabric;
use models::fabrics::{InlinedFabric, Laminate, NeoHookean, Ply, WrinklingFilm, wrinkling_load_n_per_m};
use std::sync::Arc;

const FILM: NeoHookean = NeoHookean::new(50.3e6, 2e-4);

fn with(load_n_per_m: f64) -> WrinklingFilm {
    WrinklingFilm { film: FILM, load_n_per_m }
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

/// Compressed across a fixed stretch, a film resists with its stiffness up to the load of its wrinkles, then with that load.
#[test]
fn the_load_of_wrinkles_is_constant_in_strain_and_the_slope_of_the_energy() {
    let (load, stiffness) = (5.0, 8.0 * FILM.c10_pa * FILM.thickness_m);
    let energy = |short: f64| {
        // Narrower than the width that a pull alone leaves it.
        let pulled = 1.01_f64;
        let wide = pulled.powf(-0.5) - short;
        with(load).energy([0.5 * (wide * wide - 1.0), 0.5 * (pulled * pulled - 1.0), 0.0], &FRESH)
    };
    let carried = |short: f64| (energy(short + 1e-7) - energy(short - 1e-7)) / 2e-7;
    let limit = load / stiffness;
    assert!((carried(0.3 * limit) / (0.3 * load) - 1.0).abs() < 0.03, "{}", carried(0.3 * limit));
    for (short, above) in [(5.0 * limit, 0.02), (0.02, 0.03), (0.1, 0.13)] {
        let ratio = carried(short) / load;
        assert!((0.98..1.0 + above).contains(&ratio), "{short}: {ratio}");
    }
}

#[test]
fn a_film_of_any_load_is_the_film_and_the_slopes_are_those_of_its_energy() {
    let mut random = Random::new(22);
    let mut wrinkled = 0;
    for _ in 0..200 {
        let e = random.strain(0.1);
        assert_eq!(with(f64::INFINITY).tension(e, &FRESH), FILM.tension(e, &FRESH));
        assert_eq!(with(f64::INFINITY).energy(e, &FRESH), FILM.energy(e, &FRESH));
        let film = with(300.0);
        let (s, d) = (film.tension(e, &FRESH), film.tangent(e, &FRESH));
        wrinkled += usize::from(film.energy(e, &FRESH) < FILM.energy(e, &FRESH));
        for j in 0..3 {
            let moved = |by: f64| {
                let mut at = e;
                at[j] += by;
                at
            };
            let [up, down] = [moved(1e-6), moved(-1e-6)];
            let slope = (film.energy(up, &FRESH) - film.energy(down, &FRESH)) / 2e-6;
            assert!((slope - s[j]).abs() < 1e-5 * stiffness_n_per_m() * 0.1, "{e:?}: {slope} {}", s[j]);
            let [a, b] = [film.tension(up, &FRESH), film.tension(down, &FRESH)];
            for i in 0..3 {
                let slope = (a[i] - b[i]) / 2e-6;
                assert!((slope - d[i][j]).abs() < 2e-4 * stiffness_n_per_m(), "{e:?} {i} {j}: {slope} {}", d[i][j]);
            }
        }
        let stored = film.compressed_j_per_m2(e);
        assert!(stored >= 0.0 && stored <= film.energy(e, &FRESH) * (1.0 + 1e-12));
    }
    assert!((20..180).contains(&wrinkled), "{wrinkled}");
}

fn stiffness_n_per_m() -> f64 {
    6.0 * FILM.c10_pa * FILM.thickness_m
}

#[test]
fn two_films_that_wrinkle_at_one_strain_are_one_film() {
    let two = |loads: [f64; 2]| {
        let ply = |load: f64| Ply { fabric: Arc::new(with(load)) as Arc<dyn Fabric>, angle_rad: 0.3 };
        Laminate::new(loads.map(ply).to_vec()).unwrap()
    };
    let same = two([5.0; 2]);
    let InlinedFabric::WrinklingFilm(film) = same.kind() else { panic!("{:?}", same.kind()) };
    let e = [0.02, -0.03, 0.01];
    assert!(apart(film.tension(e, &FRESH), same.tension(e, &FRESH), 0.0) < 1e-12);
    assert!(matches!(two([5.0, 10.0]).kind(), InlinedFabric::Other));
}

#[test]
fn the_load_is_the_least_that_bending_and_tension_leave() {
    let (bending_nm, tension_n_per_m, length_m) = (5e-5, 80.0, 0.08);
    let of = |wave_m: f64| {
        let pi = std::f64::consts::PI;
        4.0 * pi * pi * bending_nm / (wave_m * wave_m) + tension_n_per_m * wave_m * wave_m / (4.0 * length_m * length_m)
    };
    let least = (1..10_000).map(|k| of(f64::from(k) * 1e-5)).fold(f64::INFINITY, f64::min);
    assert!((wrinkling_load_n_per_m(bending_nm, tension_n_per_m, length_m) / least - 1.0).abs() < 1e-5);
}
