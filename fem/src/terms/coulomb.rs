//! Coulomb friction as an elastic-plastic spring along the surface.
//!
//! ```text
//! trial  e* = e + Δu − n (n·Δu)         e: elastic slide remembered from the step before, turned into the surface
//! stick  k|e*| ≤ μN   e ← e*
//! slip   k|e*| > μN   e ← e* μN/(k|e*|)    lost  ½ k (e_old + e_new)·(e* − e_new)
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | k | stiffness of sticking | N/m |
//! | μN | largest friction force | N |
//! | Δu | motion relative to the surface in this step | m |
//!
//! With the work of a step taken as ½(T_old + T_new)·Δu, stored plus lost energy equals that work to rounding.
//! **Validity**: dry friction that does not depend on speed. Source: return map of ideal plasticity (Simo and Hughes,
//! Computational Inelasticity, 1998), in one direction of the plane.

use crate::vec3::{V3, add, along, dot, scale, sub};

/// New elastic slide \[m\] and energy lost in this step \[J\].
#[inline]
pub(crate) fn slide(spring_m: V3, moved_m: V3, normal: V3, stiffness_n_m: f64, limit_n: f64) -> (V3, f64) {
    let old = turned(spring_m, normal);
    let trial = add(old, along(moved_m, -dot(moved_m, normal), normal));
    let force = stiffness_n_m * dot(trial, trial).sqrt();
    if force <= limit_n {
        return (trial, 0.0);
    }
    let new = scale(trial, limit_n / force);
    (new, 0.5 * stiffness_n_m * dot(add(old, new), sub(trial, new)))
}

/// The spring laid into the plane across `normal` without changing its length, hence its energy.
fn turned(spring: V3, normal: V3) -> V3 {
    let before = dot(spring, spring);
    if before == 0.0 {
        return spring;
    }
    let flat = along(spring, -dot(spring, normal), normal);
    let after = dot(flat, flat);
    if after > 0.0 { scale(flat, (before / after).sqrt()) } else { flat }
}

#[cfg(test)]
mod tests {
    use super::*;

    const UP: V3 = [0.0, 0.0, 1.0];

    #[test]
    fn sticking_is_elastic_and_ignores_motion_across_the_surface() {
        let (spring, lost) = slide([1e-6, 0.0, 0.0], [0.0, 2e-6, 5e-6], UP, 1e6, 10.0);
        assert_eq!((spring, lost), ([1e-6, 2e-6, 0.0], 0.0));
    }

    #[test]
    fn stored_plus_lost_energy_is_the_work_of_the_trapezoidal_rule() {
        let (k, mut spring, mut lost, mut work) = (2e5, [0.0; 3], 0.0, 0.0);
        for i in 0..200 {
            let moved = [1e-6 * (0.1 * i as f64).sin(), 1e-6 * (0.07 * i as f64).cos(), 0.0];
            let limit = 2.0 + (0.3 * i as f64).sin();
            let (new, loss) = slide(spring, moved, UP, k, limit);
            assert!(k * dot(new, new).sqrt() <= limit * (1.0 + 1e-12));
            work += 0.5 * k * dot(add(spring, new), moved);
            lost += loss;
            spring = new;
        }
        let stored = 0.5 * k * dot(spring, spring);
        assert!(lost > 10.0 * stored, "the path slips");
        assert!((stored + lost - work).abs() < 1e-12 * work);
    }

    #[test]
    fn a_turning_surface_carries_the_spring_along_without_loss() {
        let mut spring = [1e-6, 0.0, 0.0];
        for i in 0..1000 {
            let a = i as f64 * 1e-3;
            spring = slide(spring, [0.0; 3], [a.sin(), 0.0, a.cos()], 1e6, 10.0).0;
        }
        assert!((dot(spring, spring).sqrt() - 1e-6).abs() < 1e-18);
    }

    #[test]
    fn lost_contact_gives_the_whole_spring_up() {
        let (spring, lost) = slide([1e-6, 0.0, 0.0], [0.0; 3], UP, 1e6, 0.0);
        assert_eq!(spring, [0.0; 3]);
        assert!((lost - 0.5e-6).abs() < 1e-20);
    }
}
