//! Inflated cantilever under a tip load, from the first wrinkle to collapse.
//!
//! The moment falls linearly to the tip, so the wrinkled zone grows from the base. With m = M/M_c and the curvature
//! κ(m) of [`super::beam`] (Comer–Levy), integrated along the length:
//!
//! ```text
//! f = F L/M_c       v = ∫₀ᴸ κ x dx = (L²/f²) ∫₀ᶠ κ(m) m dm
//! f ≤ ½:  κ = 2 κ_w m:  v = ⅔ f κ_w L² = F L³/(3 E t π R³)
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | F, L | tip load, length | N, m |
//! | M_c, κ_w | moment of collapse N R, curvature of the first wrinkle | N m, 1/m |
//! | f | share of the collapse load: ½ at the first wrinkle at the base | – |
//! | v | deflection of the tip by bending | m |
//!
//! The integral runs over the logarithm of the half angle of the taut zone, in which it is smooth. It grows as (1 − f)^(−½)
//! towards collapse.
//!
//! Valid for small rotations, thrust N not changed by the load, a wall without bending stiffness, cross-sections that stay
//! round, no shear. Shear adds F L/(p π R² + G t π R): see [`tip_deflection_with_shear_m`]. Derived here.

use std::f64::consts::PI;

use super::KnownSections;
use super::beam::{
    BeamTheory, Cantilever, TubeSection, collapse_moment_nm, curvature_ratio, moment_ratio, tip_deflection_m,
    wrinkling_curvature_per_m,
};
use super::solve::{falling_root, integral};

/// Bending deflection of the tip \[m\] under a tip load; infinite from the collapse load on.
pub fn bending_deflection_m(tube: &TubeSection, length_m: f64, load_n: f64) -> f64 {
    let share = load_n.abs() * length_m / collapse_moment_nm(tube);
    let unit = wrinkling_curvature_per_m(tube) * length_m.powi(2);
    (unit * deflection_ratio(share)).copysign(load_n)
}

/// Deflection with shear \[m\]: [`bending_deflection_m`] plus Fichter's `F L/(p π R² + G t π R)` of the unwrinkled wall.
///
/// The shear part of a wrinkled wall is not known in closed form; below the first wrinkle the sum is exact in the theory.
pub fn tip_deflection_with_shear_m(beam: &Cantilever, load_n: f64) -> f64 {
    let shear = tip_deflection_m(beam, load_n, BeamTheory::Fichter) - tip_deflection_m(beam, load_n, BeamTheory::Euler);
    bending_deflection_m(&tube_of(beam), beam.length_m, load_n) + shear
}

/// The tube of a cantilever, with the thrust of its pressure alone.
pub fn tube_of(beam: &Cantilever) -> TubeSection {
    TubeSection {
        radius_m: beam.radius_m,
        membrane_stiffness_n_per_m: beam.young_pa * beam.thickness_m,
        thrust_n: beam.pressure_pa * PI * beam.radius_m.powi(2),
    }
}

/// v/(κ_w L²) at a share f of the collapse load, `∫₀ᶠ κ/κ_w m dm/f²`: 2f/3 up to f = 1/2.
pub fn deflection_ratio(share: f64) -> f64 {
    if share >= 1.0 {
        return f64::INFINITY;
    }
    let elastic = share.min(0.5);
    let linear = 2.0 * elastic.powi(3) / 3.0;
    if share <= 0.5 {
        return linear / (share * share);
    }
    let last = falling_root(|taut| moment_ratio(PI - taut) - share, 0.0, PI);
    let wrinkled = |log_taut: f64| {
        let taut = log_taut.exp();
        curvature_ratio(PI - taut) * moment_ratio(PI - taut) * moment_slope(taut) * taut
    };
    (linear + integral(wrinkled, last.ln(), PI.ln(), 200)) / (share * share)
}

/// −dm/dδ, the fall of the moment with the half angle δ of the taut zone: `sin δ (A δ − 4 B sin δ)/(4 B²)` with
/// A = 2δ − sin 2δ, B = sin δ − δ cos δ.
fn moment_slope(taut: f64) -> f64 {
    let (sine, cosine) = taut.sin_cos();
    let (a, b) = (2.0 * taut - 2.0 * sine * cosine, sine - taut * cosine);
    sine * (a * taut - 4.0 * b * sine) / (4.0 * b * b)
}

pub(super) fn known() -> KnownSections {
    let deflections = [0.25, 0.5, 0.6, 0.75, 0.9, 0.95, 0.99].map(deflection_ratio);
    vec![("inflated cantilever under a tip load", deflections.to_vec())]
}

#[cfg(test)]
mod tests {
    use super::super::beam::moment_ratio_from_curvature_ratio;
    use super::*;

    const BEAM: Cantilever = Cantilever {
        radius_m: 0.04,
        thickness_m: 2e-4,
        length_m: 0.36,
        young_pa: 208e6,
        shear_pa: 80e6,
        pressure_pa: 2e3,
    };

    #[test]
    fn below_the_first_wrinkle_it_is_fichters_beam() {
        let exact = tip_deflection_m(&BEAM, 0.5, BeamTheory::Fichter);
        assert!((tip_deflection_with_shear_m(&BEAM, 0.5) / exact - 1.0).abs() < 1e-13);
        assert_eq!(
            bending_deflection_m(&tube_of(&BEAM), 0.36, -0.5),
            -bending_deflection_m(&tube_of(&BEAM), 0.36, 0.5)
        );
    }

    #[test]
    fn marching_along_the_length_gives_the_same_tip() {
        let tube = tube_of(&BEAM);
        for share in [0.6, 0.9, 0.99] {
            let (steps, mut slope, mut deflection) = (4000, 0.0, 0.0);
            let ds = 1.0 / f64::from(steps);
            for i in 0..steps {
                let moment = share * (1.0 - (f64::from(i) + 0.5) * ds);
                // κ(m) by bisection of m(κ): the other way round than the integral.
                let kappa = falling_root(|k| moment - moment_ratio_from_curvature_ratio(k), 0.0, 1e6);
                deflection += (slope + 0.5 * kappa * ds) * ds;
                slope += kappa * ds;
            }
            let load = share * collapse_moment_nm(&tube) / 0.36;
            let unit = wrinkling_curvature_per_m(&tube) * 0.36;
            assert!(
                (bending_deflection_m(&tube, 0.36, load) / (unit * 0.36 * deflection) - 1.0).abs() < 1e-4,
                "{share}"
            );
        }
    }

    #[test]
    fn the_deflection_grows_with_the_inverse_root_of_the_distance_to_collapse() {
        let growth = deflection_ratio(1.0 - 1e-8) / deflection_ratio(1.0 - 1e-6);
        assert!((growth - 10.0).abs() < 0.05, "{growth}");
        assert_eq!(deflection_ratio(1.0), f64::INFINITY);
        assert!(deflection_ratio(f64::NAN).is_nan());
    }
}
