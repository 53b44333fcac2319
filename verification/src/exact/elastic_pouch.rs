//! Wide pouch with film that stretches: contraction with and without load, exact at finite strain.
//!
//! [`super::pouch`] has the arcs of stretchless film. Here each film is λ times longer; the arcs stay circular, because
//! pressure makes the tension uniform along them. The width keeps its size (plane strain) or is free to shrink:
//!
//! ```text
//! λ L0 = 2 r θ       L = 2 r sin θ      ε = 1 − λ sin θ/θ
//! n(λ) = p r λ_w = λ λ_w p L0/(2θ)      F = 2 p r W λ_w cos θ
//! ```
//!
//! | film | width | n, tension per unstressed width | λ |
//! |---|---|---|---|
//! | linear (St. Venant–Kirchhoff), A₁₁ | kept | ½ A₁₁ λ(λ² − 1) | √(1 + p L0/(θ A₁₁)) |
//! | neo-Hookean, C₁₀ t | kept | 2 C₁₀t (λ − λ⁻³) | (1 − p L0/(4θ C₁₀t))^(−¼) |
//! | neo-Hookean, C₁₀ t | free | 2 C₁₀t (λ − λ⁻²), λ_w = λ^(−½) | root |
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | L0, W | flat length and width of the unstressed pouch | m |
//! | θ, r | half angle of an arc, its radius | rad, m |
//! | p, F | gauge pressure, pulling force | Pa, N |
//! | A₁₁ | membrane stiffness along L0 with the width kept, Et/(1 − ν²) | N/m |
//!
//! θ = π/2 is the free pouch: two sheets of length L0 blown to one circle of radius λL0/π. To first order
//! `ε = 1 − (2/π)(1 + p L0/(π A₁₁))`. Width kept: the sides run between smooth walls, or W ≫ L0 between stiff ends. Width
//! free: open sides, pressure on the films only. No weld width, film without bending stiffness. Derived here.

use std::f64::consts::FRAC_PI_2;

use super::KnownSections;
use super::pouch::Pouch;
use super::solve::{falling_root, sinc};

/// Law of the film of which a pouch is made.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum PouchFilm {
    /// Linear between Green strain and second Piola–Kirchhoff tension, width kept; A₁₁ \[N/m\].
    Linear(f64),
    /// Incompressible neo-Hookean, width kept; C₁₀ t \[N/m\].
    NeoHookean(f64),
    /// Incompressible neo-Hookean, width free to shrink; C₁₀ t \[N/m\].
    NeoHookeanFreeWidth(f64),
}

/// Stretch λ of the film at a half angle θ; not a number beyond the burst pressure of a neo-Hookean film.
pub fn stretch(pouch: &Pouch, film: PouchFilm, theta: f64, pressure_pa: f64) -> f64 {
    let load = pressure_pa * pouch.length_m / theta;
    match film {
        PouchFilm::Linear(a11) => (1.0 + load / a11).sqrt(),
        PouchFilm::NeoHookean(c10_t) => (1.0 - 0.25 * load / c10_t).powf(-0.25),
        PouchFilm::NeoHookeanFreeWidth(c10_t) => stretch_of_free_width(0.25 * load / c10_t),
    }
}

/// Contraction `ε = 1 − λ sin θ/θ`; negative where the film stretches more than the arc takes up.
pub fn contraction(pouch: &Pouch, film: PouchFilm, theta: f64, pressure_pa: f64) -> f64 {
    1.0 - stretch(pouch, film, theta, pressure_pa) * sinc(theta)
}

/// Contraction of the free pouch, `ε = 1 − 2λ/π`.
pub fn free_contraction(pouch: &Pouch, film: PouchFilm, pressure_pa: f64) -> f64 {
    contraction(pouch, film, FRAC_PI_2, pressure_pa)
}

/// Pulling force `F = p λ λ_w L0 W cos θ/θ` \[N\].
pub fn force_n(pouch: &Pouch, film: PouchFilm, theta: f64, pressure_pa: f64) -> f64 {
    let stretched = stretch(pouch, film, theta, pressure_pa);
    let width = width_stretch(film, stretched) * pouch.width_m;
    pressure_pa * stretched * pouch.length_m * width * theta.cos() / theta
}

/// Volume `V = 2 r² (θ − sin θ cos θ) W λ_w` \[m³\].
pub fn volume_m3(pouch: &Pouch, film: PouchFilm, theta: f64, pressure_pa: f64) -> f64 {
    let stretched = stretch(pouch, film, theta, pressure_pa);
    width_stretch(film, stretched) * stretched * stretched * super::pouch::volume_m3(pouch, theta)
}

fn width_stretch(film: PouchFilm, stretch: f64) -> f64 {
    match film {
        PouchFilm::NeoHookeanFreeWidth(_) => 1.0 / stretch.sqrt(),
        _ => 1.0,
    }
}

/// λ ≥ 1 with `λ − λ⁻² = load λ^½`: `λ^½ − λ^(−5/2) = load`, which rises from 0.
fn stretch_of_free_width(load: f64) -> f64 {
    let highest = (1.0 + load).powi(2);
    falling_root(|x| load - x.sqrt() + x.powf(-2.5), 1.0, highest)
}

/// See `known.txt`; L0 = W = 60 mm, t = 0.05 mm, E = 208 MPa.
pub(super) fn known() -> KnownSections {
    let pouch = Pouch { length_m: 0.06, width_m: 0.06 };
    let (linear, neo) = (PouchFilm::Linear(10.4e3 / 0.91), PouchFilm::NeoHookean(10.4e3 / 6.0));
    let open = PouchFilm::NeoHookeanFreeWidth(10.4e3 / 6.0);
    let free = |film| [30e3, 90e3].map(|pressure_pa| free_contraction(&pouch, film, pressure_pa));
    let round = |film| [stretch(&pouch, film, FRAC_PI_2, 30e3)];
    let force = |film| [force_n(&pouch, film, 1.0, 30e3)];
    let held = [contraction(&pouch, linear, 1.0, 30e3)];
    let of_linear = [&round(linear)[..], &free(linear), &held, &force(linear)].concat();
    let of_rubber = [&round(neo)[..], &free(neo), &force(neo), &free(open), &force(open)].concat();
    vec![("wide pouch of film that stretches", [of_linear, of_rubber].concat())]
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    const POUCH: Pouch = Pouch { length_m: 0.06, width_m: 0.06 };
    const FILMS: [PouchFilm; 3] =
        [PouchFilm::Linear(11.4e3), PouchFilm::NeoHookean(1.73e3), PouchFilm::NeoHookeanFreeWidth(1.73e3)];

    /// Energy of the film per unstressed area \[J/m²\].
    fn film_energy_j_per_m2(film: PouchFilm, stretch: f64) -> f64 {
        let square = stretch * stretch;
        match film {
            PouchFilm::Linear(a11) => 0.125 * a11 * (square - 1.0).powi(2),
            PouchFilm::NeoHookean(c10_t) => c10_t * (square + 1.0 / square - 2.0),
            PouchFilm::NeoHookeanFreeWidth(c10_t) => c10_t * (square + 2.0 / stretch - 3.0),
        }
    }

    #[test]
    fn film_tension_balances_pressure_times_radius() {
        for film in FILMS {
            let (theta, p, h) = (1.1, 60e3, 1e-5);
            let at = stretch(&POUCH, film, theta, p);
            let tension = (film_energy_j_per_m2(film, at + h) - film_energy_j_per_m2(film, at - h)) / (2.0 * h);
            let radius = at * POUCH.length_m / (2.0 * theta);
            assert!((tension / (p * radius * width_stretch(film, at)) - 1.0).abs() < 1e-6, "{film:?}");
        }
    }

    #[test]
    fn force_is_the_slope_of_film_energy_less_pressure_work_over_length() {
        for film in [FILMS[0], FILMS[1]] {
            for theta in [0.3, 0.9, 1.4] {
                let (p, h) = (20e3, 1e-5);
                let sheet = 2.0 * POUCH.length_m * POUCH.width_m;
                let energy = |x: f64| {
                    sheet * film_energy_j_per_m2(film, stretch(&POUCH, film, x, p)) - p * volume_m3(&POUCH, film, x, p)
                };
                let length = |x: f64| POUCH.length_m * (1.0 - contraction(&POUCH, film, x, p));
                let slope = (energy(theta + h) - energy(theta - h)) / (length(theta + h) - length(theta - h));
                let force = force_n(&POUCH, film, theta, p);
                assert!((slope / force - 1.0).abs() < 1e-6, "{film:?} {theta}: {slope} {force}");
            }
        }
    }

    #[test]
    fn a_stiff_film_is_the_stretchless_pouch_and_softness_costs_contraction_to_first_order() {
        let stiff = free_contraction(&POUCH, PouchFilm::Linear(1e15), 30e3);
        assert!((stiff - super::super::pouch::MAX_CONTRACTION).abs() < 1e-12);
        let (p, a11) = (100.0, 10e3);
        let loss = 2.0 / PI * p * 0.06 / (PI * a11);
        for film in
            [PouchFilm::Linear(a11), PouchFilm::NeoHookean(a11 / 8.0), PouchFilm::NeoHookeanFreeWidth(a11 / 6.0)]
        {
            let lost = stiff - free_contraction(&POUCH, film, p);
            assert!((lost / loss - 1.0).abs() < 1e-3, "{film:?}");
        }
    }
}
