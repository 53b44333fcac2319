//! Pouch motor: a flat pouch that contracts as it inflates (Niiyama et al. 2015), and the loss at its sealed ends.
//!
//! Both faces are circular arcs of length L0 = 2 r θ over a chord L = 2 r sin θ.
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | L0 | flat length of the pouch along the direction of contraction | m |
//! | W | width across that direction | m |
//! | θ | half the central angle of an arc: 0 flat, π/2 round | rad |
//! | r | radius of the arcs, L0/(2θ) | m |
//! | ε | contraction, 1 − L/L0 | – |
//! | P | gauge pressure in the pouch | Pa |
//!
//! Valid for 0 ≤ θ ≤ π/2, inextensible film without bending stiffness, infinitely wide pouch (no sealed sides, no weld
//! width), quasi-static; film that stretches is in [`super::elastic_pouch`]. **A real pouch with W ≈ L0 contracts much
//! less**: see [`robin_end_factor`].
//!
//! Reference: R. Niiyama et al., Soft Robotics 2 (2015) 59–70. The printed text was not read: the geometry below follows
//! from the two arcs and agrees with two published codes that use it.

use std::f64::consts::{FRAC_PI_2, LN_10, PI};

use super::KnownSections;
use super::solve::{falling_root, integral, sinc, sine_deficit};

/// Contraction of a fully round pouch, 1 − 2/π.
pub const MAX_CONTRACTION: f64 = 1.0 - 2.0 / PI;

/// Flat size of a pouch, before it is filled.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pouch {
    /// Flat length L0 along the direction of contraction \[m\].
    pub length_m: f64,
    /// Width W across the direction of contraction \[m\].
    pub width_m: f64,
}

/// Contraction `ε = 1 − sin θ/θ`, accurate also for θ → 0.
pub fn contraction(theta: f64) -> f64 {
    theta * theta * sine_deficit(theta)
}

/// Enclosed volume `V = L0² W (θ − sin θ cos θ)/(2θ²)` \[m³\].
pub fn volume_m3(pouch: &Pouch, theta: f64) -> f64 {
    2.0 * pouch.length_m.powi(2) * pouch.width_m * theta * sine_deficit(2.0 * theta)
}

/// Pulling force `F = −P dV/dL = P L0 W cos θ/θ` \[N\]: infinite when flat, zero when round.
pub fn force_n(pouch: &Pouch, theta: f64, pressure_pa: f64) -> f64 {
    pressure_pa * pouch.length_m * pouch.width_m * theta.cos() / theta
}

/// Volume \[m³\] of a pouch whose four edges are sealed, two of them straight: its middle is a lens of half angle θ, flat across,
/// and each section of half height a closes at both sides by a quarter circle, which costs ½πa² of W a, times q:
///
/// ```text
/// V = 2 ∫ (W a − ½ π q a²) dx     a = r (cos φ − cos θ), x = r sin φ, r = L₀/2θ     q = 1.05 − 0.355 r (1 − cos θ)/W
/// ```
///
/// An approximation: it holds each section where the lens is. q = 1 is derived here, holds 0 to 2 % less than finite elements of fabric that
/// does not stretch and contracts 1 to 8 % less; the two numbers of q are calibrated on them, W/L₀ from ⅔ to 4.
pub fn sealed_volume_m3(pouch: &Pouch, theta: f64) -> f64 {
    let r = pouch.length_m / (2.0 * theta);
    let q = 1.05 - 0.355 * r * (1.0 - theta.cos()) / pouch.width_m;
    let section = |phi: f64| {
        let a = r * (phi.cos() - theta.cos());
        (pouch.width_m * a - 0.5 * PI * q * a * a) * r * phi.cos()
    };
    2.0 * integral(section, -theta, theta, 8)
}

/// Lens half angle at which a sealed pouch without load holds most: contraction is `contraction(θ)`, 23.8 % where W = L₀.
pub fn sealed_theta(pouch: &Pouch) -> f64 {
    const STEP: f64 = 1e-4;
    let slope = |theta: f64| sealed_volume_m3(pouch, theta + STEP) - sealed_volume_m3(pouch, theta - STEP);
    falling_root(slope, 0.2, FRAC_PI_2)
}

/// Height of one arc above its chord, `h = L0 (1 − cos θ)/(2θ)` \[m\].
pub fn bulge_height_m(pouch: &Pouch, theta: f64) -> f64 {
    0.25 * pouch.length_m * theta * sinc(0.5 * theta).powi(2)
}

/// Sealed-end factor `η = 1 − 0.142 π (L0/W)(1 − 10^(−W/L0))` for W ≥ L0.
///
/// Robin's volume of a sealed rectangular bag, `w³ (h/(πw) − 0.142 (1 − 10^(−h/w)))` with w = L0 and h = W, divided by the
/// volume L0² W/π of the wide pouch. The quotient is derived here; the bag formula was read on Wikipedia ("Paper bag
/// problem", after A. C. Robin 2004). **An empirical fit**. Using a ratio of volumes as a ratio of contractions is an assumption, not a result.
pub fn robin_end_factor(width_over_length: f64) -> f64 {
    // 1 − 10^(−x) through exp_m1, exact for small x.
    let ends = -(-width_over_length * LN_10).exp_m1();
    1.0 - 0.142 * PI * ends / width_over_length
}

/// See `known.txt`; L0 = W = 60 mm.
pub(super) fn known() -> KnownSections {
    const SQUARE: Pouch = Pouch { length_m: 0.06, width_m: 0.06 };
    let arcs = [0.25, 0.5, 1.0, 1.25, 1.4, 1.5, FRAC_PI_2];
    let linear = arcs.map(|theta| [contraction(theta), volume_m3(&SQUARE, theta), force_n(&SQUARE, theta, 30e3)]);
    let robin = [1.0, 2.0, 46.0 / 17.25, 5.0, 10.0, 30.0 / 22.93].map(robin_end_factor);
    let sealed = [1.0, 1.5, 2.0, 4.0].map(|ratio| Pouch { length_m: 1.0, width_m: ratio });
    let ends = sealed.map(|pouch| contraction(sealed_theta(&pouch)));
    let holds = sealed.map(|pouch| sealed_volume_m3(&pouch, sealed_theta(&pouch)));
    vec![
        ("pouch motor, linear", [&[MAX_CONTRACTION][..], linear.as_flattened()].concat()),
        ("pouch motor, sealed ends", robin.to_vec()),
        ("sealed pouch, free", [ends, holds].concat()),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    const POUCH: Pouch = Pouch { length_m: 0.06, width_m: 0.06 };
    const PRESSURE_PA: f64 = 30e3;

    #[test]
    fn force_is_minus_pressure_times_slope_of_volume_over_length() {
        for theta in [0.05, 0.25, 0.7, 1.0, 1.3, 1.5] {
            let h = 1e-5;
            let dv = volume_m3(&POUCH, theta + h) - volume_m3(&POUCH, theta - h);
            let dl = -POUCH.length_m * (contraction(theta + h) - contraction(theta - h));
            let force = force_n(&POUCH, theta, PRESSURE_PA);
            assert!((force + PRESSURE_PA * dv / dl).abs() < 1e-7 * force, "θ = {theta}");
        }
    }

    #[test]
    fn contraction_of_a_nearly_flat_pouch_keeps_its_digits() {
        let theta: f64 = 1e-5;
        assert!((contraction(theta) / (theta * theta / 6.0) - 1.0).abs() < 1e-10);
    }

    #[test]
    fn end_factor_tends_to_one_for_a_wide_pouch() {
        assert!((robin_end_factor(1e6) - 1.0).abs() < 1e-6);
        assert!(robin_end_factor(1.0) < robin_end_factor(2.0));
    }
}
