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

use super::Known;
use super::solve::{falling_root, integral, sinc, sine_deficit};

/// Contraction of a fully round pouch, 1 − 2/π.
pub const MAX_CONTRACTION: f64 = 1.0 - 2.0 / PI;

/// Volume of the square paper bag divided by w³, lowest known value (Kepert, quoted on Wikipedia, "Paper bag problem").
pub const KEPERT_VOLUME_LOW: f64 = 0.2055;

/// Volume of the square paper bag divided by w³, upper value (Kepert, quoted on Wikipedia, "Paper bag problem").
pub const KEPERT_VOLUME_HIGH: f64 = 0.217;

/// Flat size of a pouch.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pouch {
    /// Flat length L0 along the direction of contraction \[m\].
    pub length_m: f64,
    /// Width W \[m\].
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
/// and each section of half height a closes at both sides by a quarter circle, which costs ½πa² of W a:
///
/// ```text
/// V = 2 ∫ (W a − ½ π a²) dx     a = r (cos φ − cos θ), x = r sin φ, r = L₀/2θ
/// ```
///
/// An approximation: it holds each section where the lens is, and lets the sides follow without a pull along them. Finite elements of
/// fabric that does not stretch hold 0 to 2 % more. Derived here.
pub fn sealed_volume_m3(pouch: &Pouch, theta: f64) -> f64 {
    let r = pouch.length_m / (2.0 * theta);
    let section = |phi: f64| {
        let a = r * (phi.cos() - theta.cos());
        (pouch.width_m * a - 0.5 * PI * a * a) * r * phi.cos()
    };
    2.0 * integral(section, -theta, theta, 8)
}

/// Lens half angle at which a sealed pouch without load holds most: contraction is `contraction(θ)`, 21.9 % where W = L₀.
pub fn sealed_theta(pouch: &Pouch) -> f64 {
    const STEP: f64 = 1e-4;
    let slope = |theta: f64| sealed_volume_m3(pouch, theta + STEP) - sealed_volume_m3(pouch, theta - STEP);
    falling_root(slope, 0.2, FRAC_PI_2)
}

/// Film tension per width `P r = P L0/(2θ)` \[N/m\].
pub fn film_tension_n_per_m(pouch: &Pouch, theta: f64, pressure_pa: f64) -> f64 {
    pressure_pa * pouch.length_m / (2.0 * theta)
}

/// Height of one arc above its chord, `h = L0 (1 − cos θ)/(2θ)` \[m\].
pub fn bulge_height_m(pouch: &Pouch, theta: f64) -> f64 {
    0.25 * pouch.length_m * theta * sinc(0.5 * theta).powi(2)
}

/// Half angle θ at which the pouch carries `force_n`: the root of `cos θ/θ = F/(P L0 W)` in \[0, π/2\].
///
/// `None` for a negative force, or for a pressure that is not positive. The left side falls from ∞ to 0: one root.
pub fn theta_from_force(pouch: &Pouch, pressure_pa: f64, force_n: f64) -> Option<f64> {
    if pressure_pa <= 0.0 || force_n < 0.0 {
        return None;
    }
    let load = force_n / (pressure_pa * pouch.length_m * pouch.width_m);
    Some(falling_root(|theta| theta.cos() - load * theta, 0.0, FRAC_PI_2))
}

/// Contraction with Niiyama's film elasticity, `ε_c = ε (1 + π/(π−2) C P) − C P`.
///
/// C is a compliance \[1/Pa\] fitted to the film: two published codes use 5.0e-6 and 1.0934e-6. Shifts the flat end by
/// −C P and leaves the round end where it is. Second hand: taken from code, the printed form was not read.
pub fn elastic_contraction(contraction: f64, compliance_per_pa: f64, pressure_pa: f64) -> f64 {
    let shift = compliance_per_pa * pressure_pa;
    contraction * (1.0 + PI / (PI - 2.0) * shift) - shift
}

/// Half angle of a pouch laid over a hinge folded by α: `sin θ/θ = cos(α/2)` for 0 ≤ α ≤ π.
///
/// The chord of the film joins the free ends of two facets of length L0/2. Derived here.
pub fn hinge_theta(fold_angle: f64) -> f64 {
    let chord = (0.5 * fold_angle).cos();
    falling_root(|theta| sinc(theta) - chord, 0.0, PI)
}

/// Volume between the film and the two facets, `V = W [L0² (θ − sin θ cos θ)/(4θ²) + (L0²/8) sin α]` \[m³\].
///
/// One arc over the chord, and the triangle between chord and facets. Derived here; Niiyama's printed form was not seen.
pub fn hinge_volume_m3(pouch: &Pouch, fold_angle: f64) -> f64 {
    let triangle = pouch.length_m.powi(2) / 8.0 * fold_angle.sin();
    0.5 * volume_m3(pouch, hinge_theta(fold_angle)) + pouch.width_m * triangle
}

/// Closing torque `τ = P dV/dα = P W [(L0²/8) cos α + (L0² cos θ/(4θ)) sin(α/2)]` \[N m\]. Derived here; see [`hinge_volume_m3`].
pub fn hinge_torque_nm(pouch: &Pouch, fold_angle: f64, pressure_pa: f64) -> f64 {
    let square = pouch.length_m.powi(2);
    let theta = hinge_theta(fold_angle);
    let arc = square * theta.cos() / (4.0 * theta) * (0.5 * fold_angle).sin();
    pressure_pa * pouch.width_m * (square / 8.0 * fold_angle.cos() + arc)
}

/// Sealed-end factor `η = 1 − 0.142 π (L0/W)(1 − 10^(−W/L0))` for W ≥ L0.
///
/// Robin's volume of a sealed rectangular bag, `w³ (h/(πw) − 0.142 (1 − 10^(−h/w)))` with w = L0 and h = W, divided by the
/// volume L0² W/π of the wide pouch. The quotient is derived here; the bag formula was read on Wikipedia ("Paper bag
/// problem", after A. C. Robin 2004). **An empirical fit**: Kepert's bounds for the square bag ([`KEPERT_VOLUME_LOW`])
/// put η(1) 7–12 % higher. Using a ratio of volumes as a ratio of contractions is an assumption, not a result.
pub fn robin_end_factor(width_over_length: f64) -> f64 {
    // 1 − 10^(−x) through exp_m1, exact for small x.
    let ends = -(-width_over_length * LN_10).exp_m1();
    1.0 - 0.142 * PI * ends / width_over_length
}

/// Sealed-end factor of a square pouch whose bag volume is `ratio` × w³: `η = π ratio`, because the wide pouch holds w³/π.
pub fn square_end_factor(ratio: f64) -> f64 {
    PI * ratio
}

/// See `known.txt`; L0 = W = 60 mm.
pub(super) fn known() -> Known {
    const SQUARE: Pouch = Pouch { length_m: 0.06, width_m: 0.06 };
    let arcs = [0.25, 0.5, 1.0, 1.25, 1.4, 1.5, FRAC_PI_2];
    let linear = arcs.map(|theta| [contraction(theta), volume_m3(&SQUARE, theta), force_n(&SQUARE, theta, 30e3)]);
    let loaded = [10e3, 20e3, 30e3].map(|pressure_pa| {
        let theta = theta_from_force(&SQUARE, pressure_pa, 5.0).unwrap_or(f64::NAN);
        [theta, contraction(theta)]
    });
    let elastic = [10e3, 20e3, 30e3].map(|pressure_pa| elastic_contraction(contraction(1.0), 5e-6, pressure_pa));
    let hinge = [0.5, 1.0, 1.5, 2.0].map(|fold| [hinge_theta(fold), hinge_torque_nm(&SQUARE, fold, 30e3)]);
    let robin = [1.0, 2.0, 46.0 / 17.25, 5.0, 10.0, 30.0 / 22.93].map(robin_end_factor);
    let kepert = [KEPERT_VOLUME_LOW, KEPERT_VOLUME_HIGH].map(square_end_factor);
    let sealed = [1.0, 1.5, 2.0, 4.0].map(|ratio| Pouch { length_m: 1.0, width_m: ratio });
    let ends = sealed.map(|pouch| contraction(sealed_theta(&pouch)));
    let holds = sealed.map(|pouch| sealed_volume_m3(&pouch, sealed_theta(&pouch)));
    vec![
        ("pouch motor, linear", [&[MAX_CONTRACTION][..], linear.as_flattened()].concat()),
        ("pouch motor, loaded and elastic", [loaded.as_flattened(), &elastic].concat()),
        ("pouch motor, angular", hinge.concat()),
        ("pouch motor, sealed ends", [&robin[..], &kepert].concat()),
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
    fn hinge_torque_is_pressure_times_slope_of_volume_over_fold_angle() {
        for alpha in [0.3, 0.5, 1.0, 1.5, 2.0, 2.5] {
            let h = 1e-5;
            let slope = (hinge_volume_m3(&POUCH, alpha + h) - hinge_volume_m3(&POUCH, alpha - h)) / (2.0 * h);
            let torque = hinge_torque_nm(&POUCH, alpha, PRESSURE_PA);
            assert!((torque - PRESSURE_PA * slope).abs() < 1e-7, "α = {alpha}");
        }
    }

    #[test]
    fn angle_from_force_inverts_the_force_over_six_decades() {
        for force in [1e-3, 0.1, 5.0, 100.0, 1000.0] {
            let theta = theta_from_force(&POUCH, PRESSURE_PA, force).unwrap();
            assert!((force_n(&POUCH, theta, PRESSURE_PA) - force).abs() < 1e-12 * (1.0 + force));
        }
        assert_eq!(theta_from_force(&POUCH, 0.0, 1.0), None);
        assert_eq!(theta_from_force(&POUCH, 1.0, -1.0), None);
    }

    #[test]
    fn film_tension_times_width_and_slope_carries_the_force() {
        // Each of the two films meets the end seam at angle θ from the chord: F = 2 T W cos θ.
        for theta in [0.25, 1.0, 1.4] {
            let pull = 2.0 * film_tension_n_per_m(&POUCH, theta, PRESSURE_PA) * POUCH.width_m * f64::cos(theta);
            assert!((pull - force_n(&POUCH, theta, PRESSURE_PA)).abs() < 1e-12 * pull);
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
