//! Strip that bends without stretching, at any rotation: cantilever under a tip force or end moment, buckled strut.
//!
//! B θ'' = −F cos θ (cantilever) has the first integral ½B θ'² = F (sin θ_L − sin θ). With 1 + sin θ = 2k² sin²φ:
//!
//! ```text
//! cantilever  k² = ½(1 + sin θ_L)   φ₀ = asin 1/(k√2)
//!             L√(F/B) = ∫ dφ/Δ      v√(F/B) = ∫ (2k² sin²φ − 1) dφ/Δ      x_L = √(2 sin θ_L B/F)     over φ₀ … π/2
//! strut       k = sin(α/2)          P/P_E = (2K/π)²      chord/L = 2E/K − 1      rise/L = k/K
//! end moment  κ = M/B               x = sin κL/κ         v = (1 − cos κL)/κ
//! Δ = √(1 − k² sin²φ)               K, E complete elliptic integrals of modulus k
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | B | bending stiffness of the strip: [`super::plate::strip_bending_stiffness_nm2`] | N m² |
//! | L, F, M | length; tip force that keeps its direction; moment | m, N, N m |
//! | θ_L, v, x_L | rotation of the tip, deflection along F, distance from the clamp across F | rad, m |
//! | α | rotation of a strut's ends | rad |
//! | P_E | Euler's load π²B/L² of the strut with hinged ends | N |
//!
//! Valid without stretch, shear and weight. Derivation standard: Bisshopp & Drucker (1945), Timoshenko & Gere, Theory of
//! Elastic Stability, §2.7 (recalled; their printed tables are reproduced in `known.txt`).

use std::f64::consts::{FRAC_PI_2, PI};

use super::Known;
use super::solve::{falling_root, integral, sinc};

/// Where the tip of a cantilever ends, in lengths L.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tip {
    /// Deflection v/L.
    pub deflection: f64,
    /// Shortening of the projection on the clamp's tangent, 1 − x_L/L.
    pub shortening: f64,
    /// Rotation θ_L \[rad\].
    pub rotation: f64,
}

/// Shape of a buckled strut with hinged ends, in lengths L.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Strut {
    /// P/P_E.
    pub load: f64,
    /// Distance of the ends; negative once they have passed each other.
    pub chord: f64,
    /// Distance of the middle from the chord.
    pub rise: f64,
}

/// Cantilever under a tip force of fixed direction; `load` = F L²/B ≥ 0.
pub fn cantilever(load: f64) -> Tip {
    if load == 0.0 {
        return Tip { deflection: 0.0, shortening: 0.0, rotation: 0.0 };
    }
    let root = load.sqrt();
    let rotation = falling_root(|tip| root - from_tip(tip, |_| 1.0), 0.0, FRAC_PI_2);
    Tip {
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

/// Cantilever under an end moment; `turn` = M L/B is the rotation of the tip.
pub fn end_moment(turn: f64) -> Tip {
    let half = 0.5 * turn;
    Tip { deflection: half * sinc(half).powi(2), shortening: 1.0 - sinc(turn), rotation: turn }
}

/// Buckled strut whose ends have turned by α, 0 ≤ α < π \[rad\].
pub fn strut(end_rotation: f64) -> Strut {
    let k = (0.5 * end_rotation).sin();
    let (first, second) = (complete(k, |d| 1.0 / d), complete(k, |d| d));
    Strut { load: (2.0 * first / PI).powi(2), chord: 2.0 * second / first - 1.0, rise: k / first }
}

/// Load P/P_E of a strut whose ends have come closer by `shortening` = 1 − chord/L, between 0 and 1.
pub fn strut_at_shortening(shortening: f64) -> Strut {
    strut(falling_root(|alpha| strut(alpha).chord - 1.0 + shortening, 0.0, 0.75 * PI))
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

/// ∫ f(Δ) dφ from 0 to π/2.
fn complete(k: f64, f: impl Fn(f64) -> f64) -> f64 {
    integral(|phi: f64| f((1.0 - (k * phi.sin()).powi(2)).sqrt()), 0.0, FRAC_PI_2, PANELS)
}

/// See `known.txt`.
pub(super) fn known() -> Known {
    let at = |degrees: f64| strut(degrees.to_radians());
    let [quarter, one, two, five, ten] = [0.25, 1.0, 2.0, 5.0, 10.0].map(cantilever);
    let all = |tip: &Tip| [tip.deflection, tip.shortening, tip.rotation];
    let tip_force = [&[quarter.deflection][..], &all(&one), &[two.deflection, five.deflection], &all(&ten)];
    let printed = [&[one.deflection][..], &all(&two), &[five.deflection, ten.deflection, ten.shortening]];
    let buckled = [20.0, 60.0, 120.0].map(at).map(|strut| [strut.load, strut.chord, strut.rise]);
    let turned = end_moment(FRAC_PI_2);
    vec![
        ("elastica, cantilever", tip_force.concat()),
        ("elastica, cantilever, printed table", printed.concat()),
        ("elastica, buckled strut", [buckled.as_flattened(), &[at(160.0).load, at(160.0).chord]].concat()),
        (
            "elastica, buckled strut, printed table",
            vec![
                at(20.0).chord,
                at(40.0).chord,
                2.0 * at(40.0).rise,
                at(60.0).load,
                2.0 * at(60.0).rise,
                at(80.0).chord,
                2.0 * at(120.0).rise,
            ],
        ),
        ("strip under an end moment", vec![turned.deflection, turned.shortening]),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

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

    #[test]
    fn an_end_moment_makes_an_arc() {
        assert!((end_moment(PI).shortening - 1.0).abs() < 1e-15);
        assert!((end_moment(PI).deflection - 2.0 / PI).abs() < 1e-15);
        assert!((end_moment(2.0 * PI).deflection).abs() < 1e-15);
    }

    #[test]
    fn a_strut_starts_at_eulers_load_and_stiffens_with_half_its_shortening() {
        let at = strut(1e-3);
        assert!((at.load - 1.0 - (1.0 - at.chord) / 2.0).abs() < 1e-11);
        assert!((strut_at_shortening(0.258_980_393_924).load - 1.151_719_620_47).abs() < 1e-10);
    }
}
