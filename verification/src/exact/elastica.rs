//! Strip of a thin plate: its stiffness, and a cantilever that bends without stretching, at any rotation.
//!
//! B θ'' = −F cos θ has the first integral ½B θ'² = F (sin θ_L − sin θ). With 1 + sin θ = 2k² sin²φ:
//!
//! ```text
//! k² = ½(1 + sin θ_L)   φ₀ = asin 1/(k√2)   Δ = √(1 − k² sin²φ)
//! L√(F/B) = ∫ dφ/Δ      v√(F/B) = ∫ (2k² sin²φ − 1) dφ/Δ      x_L = √(2 sin θ_L B/F)     over φ₀ … π/2
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | B | bending stiffness of the strip: [`plate_bending_stiffness_nm`] times its width if it is wide | N m² |
//! | L, F | length; tip force that keeps its direction | m, N |
//! | θ_L, v, x_L | rotation of the tip, deflection along F, distance from the clamp across F | rad, m |
//!
//! Valid without stretch, shear and weight. Derivation standard: Bisshopp & Drucker (1945), recalled; their printed table is
//! reproduced in `known.txt`.

use std::f64::consts::FRAC_PI_2;

use super::KnownSections;
use super::solve::{falling_root, integral};

/// Bending stiffness of a plate, `D = E t³/(12(1 − ν²))` \[N m\].
pub fn plate_bending_stiffness_nm(young_pa: f64, poisson: f64, thickness_m: f64) -> f64 {
    young_pa * thickness_m.powi(3) / (12.0 * (1.0 - poisson * poisson))
}

/// Tip deflection of a clamped strip under its own weight, small rotations: `w L⁴/(8 D)` \[m\].
pub fn weight_deflection_m(plate_nm: f64, length_m: f64, weight_n_per_m2: f64) -> f64 {
    weight_n_per_m2 * length_m.powi(4) / (8.0 * plate_nm)
}

/// Where the tip of a cantilever ends, in lengths L.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ElasticaTip {
    /// Deflection v/L across the clamp's tangent.
    pub deflection: f64,
    /// Shortening of the projection on the clamp's tangent, 1 − x_L/L.
    pub shortening: f64,
    /// Rotation θ_L of the tip's tangent \[rad\].
    pub rotation: f64,
}

/// Cantilever under a tip force of fixed direction; `load` = F L²/B ≥ 0.
pub fn cantilever(load: f64) -> ElasticaTip {
    if load == 0.0 {
        return ElasticaTip { deflection: 0.0, shortening: 0.0, rotation: 0.0 };
    }
    let root = load.sqrt();
    let rotation = falling_root(|tip| root - from_tip(tip, |_| 1.0), 0.0, FRAC_PI_2);
    ElasticaTip {
        deflection: from_tip(rotation, f64::sin) / root,
        shortening: 1.0 - (2.0 * rotation.sin()).sqrt() / root,
        rotation,
    }
}

/// Points (x/L, v/L) of the same cantilever from the clamp to its tip, `count` ≥ 2 of them, even in rotation.
pub fn cantilever_line(load: f64, count: usize) -> Vec<[f64; 2]> {
    let tip = cantilever(load);
    if load == 0.0 {
        return vec![[0.0, 0.0], [1.0, 0.0]];
    }
    let root = load.sqrt();
    let end = tip.rotation.sin();
    let square = 0.5 * (1.0 + end);
    // From the tangent: φ itself is badly known from its sine near the tip.
    let phi = |theta: f64| (1.0 + theta.sin()).sqrt().atan2((end - theta.sin()).max(0.0).sqrt());
    (0..count)
        .map(|i| {
            let theta = tip.rotation * (i as f64 / (count.max(2) - 1) as f64);
            let across = |phi: f64| {
                let s = square * phi.sin().powi(2);
                (2.0 * s - 1.0) / (1.0 - s).sqrt()
            };
            let x =
                ((2.0 * tip.rotation.sin()).sqrt() - (2.0 * (tip.rotation.sin() - theta.sin())).max(0.0).sqrt()) / root;
            [x, integral(across, phi(0.0), phi(theta), PANELS) / root]
        })
        .collect()
}

/// Panels of ten points for every integral: 16 digits up to a tip within 1e-3 of a right angle.
const PANELS: u32 = 24;

/// ∫ f(θ) dφ/Δ from φ₀ to π/2 for a tip rotation.
fn from_tip(tip: f64, f: impl Fn(f64) -> f64) -> f64 {
    let square = 0.5 * (1.0 + tip.sin());
    let start = (1.0 / (2.0 * square).sqrt()).asin();
    let integrand = |phi: f64| {
        let s = square * phi.sin().powi(2);
        f((2.0 * s - 1.0).asin()) / (1.0 - s).sqrt()
    };
    integral(integrand, start, FRAC_PI_2, PANELS)
}

pub(super) fn known() -> KnownSections {
    let [quarter, one, two, five, ten] = [0.25, 1.0, 2.0, 5.0, 10.0].map(cantilever);
    let all = |tip: &ElasticaTip| [tip.deflection, tip.shortening, tip.rotation];
    let tip_force = [&[quarter.deflection][..], &all(&one), &[two.deflection, five.deflection], &all(&ten)];
    let printed = [&[one.deflection][..], &all(&two), &[five.deflection, ten.deflection, ten.shortening]];
    vec![("elastica, cantilever", tip_force.concat()), ("elastica, cantilever, printed table", printed.concat())]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stiffness_is_the_second_moment_of_the_plane_strain_stress() {
        let (young, nu, t) = (208e6, 0.3, 2e-4);
        let layers = 20_000;
        let mut sum = 0.0;
        for i in 0..layers {
            let z = t * ((f64::from(i) + 0.5) / f64::from(layers) - 0.5);
            sum += young / (1.0 - nu * nu) * z * z * t / f64::from(layers);
        }
        let d = plate_bending_stiffness_nm(young, nu, t);
        assert!((sum / d - 1.0).abs() < 1e-8);
    }

    #[test]
    fn droop_is_the_integral_of_moment_times_arm() {
        let (d, length, w) = (1e-5, 0.02, 1.5);
        let sum = integral(|x| 0.5 * w * x * x / d * x, 0.0, length, 1);
        assert!((weight_deflection_m(d, length, w) / sum - 1.0).abs() < 1e-13);
    }

    #[test]
    fn a_small_tip_force_gives_the_linear_beam() {
        let tip = cantilever(1e-3);
        assert!((tip.deflection / (1e-3 / 3.0) - 1.0).abs() < 1e-6);
        assert!((tip.rotation / (1e-3 / 2.0) - 1.0).abs() < 1e-6);
        // Shortening of the parabola, ½∫θ² ds = F²L⁴/15B²; a difference of numbers near one.
        assert!((tip.shortening / (1e-6 / 15.0) - 1.0).abs() < 1e-4);
        assert_eq!(cantilever(0.0).deflection, 0.0);
    }

    #[test]
    fn marching_the_moment_along_the_strip_ends_with_no_moment_at_the_tip() {
        for load in [1.0, 5.0] {
            let tip = cantilever(load);
            let (steps, mut theta, mut x, mut v) = (20_000, 0.0_f64, 0.0, 0.0);
            let (ds, arm) = (1.0 / f64::from(steps), 1.0 - tip.shortening);
            for _ in 0..steps {
                let middle = theta + 0.5 * ds * load * (arm - x);
                let at = x + 0.5 * ds * middle.cos();
                theta += ds * load * (arm - at);
                x += ds * middle.cos();
                v += ds * middle.sin();
            }
            assert!((theta - tip.rotation).abs() < 1e-7 && (v - tip.deflection).abs() < 1e-7);
            assert!((x - arm).abs() < 1e-7, "{load}");
        }
    }

    #[test]
    fn the_line_of_the_cantilever_is_as_long_as_the_strip_and_ends_at_its_tip() {
        for load in [0.3, 3.0, 10.0] {
            let (tip, line) = (cantilever(load), cantilever_line(load, 400));
            let length: f64 = line.windows(2).map(|w| (w[1][0] - w[0][0]).hypot(w[1][1] - w[0][1])).sum();
            assert!((length - 1.0).abs() < 1e-5, "{load}: {length}");
            let end = line[399];
            assert!((end[0] - 1.0 + tip.shortening).abs() < 1e-12 && (end[1] - tip.deflection).abs() < 1e-12);
        }
    }
}
