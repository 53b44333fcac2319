//! Fabric muscle (fPAM): a bias-cut tube whose own weave is the braid, with the stiffness of the fabric in shear.
//!
//! Threads at 45° to the axis at rest, inextensible; the angle α from the axis grows as the tube shortens:
//!
//! ```text
//! L = b cos α    r = √2 r45 sin α    γ = 2α − π/2    U = ½ G t γ² (2 W Lf)
//! F = −P dV/dL − dU/d(−L) = 2π P r45² (3 cos²α − 1) − G t (2 W Lf) γ · 2/(b sin α)
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | W, Lf | width of the flat tube, its length at rest | m |
//! | r45, b | radius at 45°, W/π; thread length per axial run, √2 Lf | m |
//! | α, γ | angle of the threads, shear angle of the fabric | rad |
//! | G t | shear stiffness of the fabric per width | N/m |
//!
//! Valid up to the locking angle of the weave (γ ≈ 45° for a plain weave; free contraction reaches 19.5°), for uniform
//! shear, no end caps. Derived here; Naclerio & Hawkes, IEEE Robotics and Automation Letters 5 (2020) 3406–3413, start
//! from the same McKibben geometry, but only their abstract was read and their stiffness term is not known here. The shear
//! term makes the free contraction rise with pressure; without it, it is the same at every pressure. Threads that stretch
//! lengthen the tube again at high pressure, and unequal ones twist it: see [`super::tube`].

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI, SQRT_2};

use super::KnownSections;
use super::hinge::{BentBody, LeverRule, axis_point_m, restoring_moment_nm};
use super::solve::falling_root;
use models::fabrics::shear_modulus;

/// Size and shear stiffness of a fabric muscle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fpam {
    /// Width W of the flat tube \[m\].
    pub flat_width_m: f64,
    /// Length Lf of the tube at rest \[m\].
    pub rest_length_m: f64,
    /// Shear stiffness G t of the fabric \[N/m\].
    pub shear_stiffness_n_per_m: f64,
}

/// Length `L = b cos α` \[m\].
pub fn length_m(muscle: &Fpam, alpha: f64) -> f64 {
    thread_m(muscle) * alpha.cos()
}

/// Radius `r = √2 r45 sin α` \[m\].
pub fn radius_m(muscle: &Fpam, alpha: f64) -> f64 {
    SQRT_2 * radius_at_45_m(muscle) * alpha.sin()
}

/// Contraction `ε = 1 − √2 cos α`: zero at 45°.
pub fn contraction(alpha: f64) -> f64 {
    1.0 - SQRT_2 * alpha.cos()
}

/// Pulling force `F = 2π P r45² (3 cos²α − 1) − G t (2 W Lf)(2α − π/2) · 2/(b sin α)` \[N\].
pub fn force_n(muscle: &Fpam, alpha: f64, pressure_pa: f64) -> f64 {
    let braid = 2.0 * PI * pressure_pa * radius_at_45_m(muscle).powi(2) * (3.0 * alpha.cos().powi(2) - 1.0);
    let fabric = 2.0 * muscle.flat_width_m * muscle.rest_length_m;
    let shear = muscle.shear_stiffness_n_per_m * fabric * (2.0 * alpha - FRAC_PI_2) * 2.0;
    braid - shear / (thread_m(muscle) * alpha.sin())
}

/// Angle α at which the unloaded muscle comes to rest; 54.74° without shear stiffness.
pub fn free_alpha(muscle: &Fpam, pressure_pa: f64) -> f64 {
    falling_root(|alpha| force_n(muscle, alpha, pressure_pa), FRAC_PI_4, magic_angle())
}

/// Lever of the muscle's force on a body of radius R whose far fibre is the hinge \[m\].
///
/// The muscle is outside the body, axis at d = R + r(α), so a shortening ε Lf turns the body by
/// `Φ = ε Lf/(R + d)`. [`LeverRule::VirtualWork`]: `(R + d)/(1 − (ε/ε′) r′/(R + d))` with ε′ = √2 sin α, r′ = √2 r45 cos α.
pub fn lever_m(muscle: &Fpam, body_radius_m: f64, alpha: f64, rule: LeverRule) -> f64 {
    let arm = 2.0 * body_radius_m + radius_m(muscle, alpha);
    match rule {
        LeverRule::CurrentArm => arm,
        LeverRule::VirtualWork => {
            let arm_per_contraction = radius_at_45_m(muscle) / alpha.tan();
            arm / (1.0 - contraction(alpha) * arm_per_contraction / arm)
        }
    }
}

/// Angle α at which the muscle balances a fully wrinkled body: `F(α) ℓ(α) = p π R³`.
///
/// 45° (no bending) where the pressure is too low to move it. Same assumptions as [`super::hinge`].
pub fn bending_alpha(muscle: &Fpam, body_radius_m: f64, actuator_pa: f64, body_pa: f64, rule: LeverRule) -> f64 {
    let moment = restoring_moment_nm(body_radius_m, body_pa);
    let excess =
        |alpha: f64| force_n(muscle, alpha, actuator_pa) * lever_m(muscle, body_radius_m, alpha, rule) - moment;
    falling_root(excess, FRAC_PI_4, magic_angle())
}

/// Total bending angle `Φ = ε Lf/(2R + r)` \[rad\].
pub fn total_angle(muscle: &Fpam, body_radius_m: f64, alpha: f64) -> f64 {
    contraction(alpha) * muscle.rest_length_m / (2.0 * body_radius_m + radius_m(muscle, alpha))
}

/// Radius at α = 45°, `r45 = W/π` \[m\].
pub fn radius_at_45_m(muscle: &Fpam) -> f64 {
    muscle.flat_width_m / PI
}

fn thread_m(muscle: &Fpam) -> f64 {
    SQRT_2 * muscle.rest_length_m
}

/// `acos(1/√3)`, where pressure neither shortens nor lengthens a braid.
fn magic_angle() -> f64 {
    (1.0 / 3.0_f64.sqrt()).acos()
}

/// See `known.txt`; W = 60 mm, Lf = 300 mm, R = 40 mm, p = 2 kPa.
pub(super) fn known() -> KnownSections {
    const PRESSURES_PA: [f64; 3] = [10e3, 20e3, 30e3];
    let muscle = |shear_stiffness_n_per_m| Fpam { flat_width_m: 0.06, rest_length_m: 0.3, shear_stiffness_n_per_m };
    let alpha = |shear, pressure_pa, rule| bending_alpha(&muscle(shear), 0.04, pressure_pa, 2e3, rule);
    let angle = |shear, pressure_pa, rule| total_angle(&muscle(shear), 0.04, alpha(shear, pressure_pa, rule));
    let height_mm = |shear, pressure_pa, rule| {
        let body = BentBody { body_radius_m: 0.04, length_m: 0.3, total_angle: angle(shear, pressure_pa, rule) };
        1e3 * axis_point_m(&body, 0.33)[1]
    };
    let shear_pa = shear_modulus(96.5e6, 120e6, 4.05e6, 0.0).unwrap_or(f64::NAN);
    let force = [35.0_f64, 40.0, 45.0, 50.0, magic_angle().to_degrees()]
        .map(|degrees| force_n(&muscle(0.0), degrees.to_radians(), 30e3));
    let free = [1e3, 5e3, 10e3, 20e3, 30e3].map(|p| contraction(free_alpha(&muscle(50.625), p)));
    let limit = contraction(free_alpha(&muscle(0.0), 30e3));
    let arm = LeverRule::CurrentArm;
    let current = [
        PRESSURES_PA.map(|p| alpha(51.6, p, arm).to_degrees()),
        PRESSURES_PA.map(|p| contraction(alpha(51.6, p, arm))),
        PRESSURES_PA.map(|p| angle(51.6, p, arm)),
        PRESSURES_PA.map(|p| height_mm(51.6, p, arm)),
        PRESSURES_PA.map(|p| height_mm(0.0, p, arm)),
    ];
    let work = LeverRule::VirtualWork;
    let by_work =
        PRESSURES_PA.map(|p| [alpha(51.6, p, work).to_degrees(), height_mm(51.6, p, work), height_mm(0.0, p, work)]);
    vec![
        ("fabric muscle, bias modulus 4.05 MPa, t = 50 µm", vec![1e-6 * shear_pa, 50e-6 * shear_pa]),
        (
            "fabric muscle, linear, 30 kPa or G t = 50.625 N/m",
            [&[length_m(&muscle(0.0), 35.0_f64.to_radians())][..], &force, &free, &[limit]].concat(),
        ),
        ("fabric muscle, bending, current arm, G t = 51.6 N/m", current.concat()),
        ("fabric muscle, bending, virtual work, G t = 51.6 N/m", by_work.concat()),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    const MUSCLE: Fpam = Fpam { flat_width_m: 0.06, rest_length_m: 0.3, shear_stiffness_n_per_m: 51.6 };

    /// Energy `−P V + U` of the muscle alone at fixed pressure \[J\].
    fn energy_j(muscle: &Fpam, alpha: f64, pressure_pa: f64) -> f64 {
        let volume = PI * radius_m(muscle, alpha).powi(2) * length_m(muscle, alpha);
        let shear = 2.0 * alpha - FRAC_PI_2;
        let fabric = 2.0 * muscle.flat_width_m * muscle.rest_length_m;
        0.5 * muscle.shear_stiffness_n_per_m * shear.powi(2) * fabric - pressure_pa * volume
    }

    #[test]
    fn force_is_the_slope_of_energy_over_length() {
        for alpha in [0.8, 0.85, 0.9, 0.95] {
            let h = 1e-5;
            let de = energy_j(&MUSCLE, alpha + h, 30e3) - energy_j(&MUSCLE, alpha - h, 30e3);
            let dl = length_m(&MUSCLE, alpha + h) - length_m(&MUSCLE, alpha - h);
            assert!((force_n(&MUSCLE, alpha, 30e3) - de / dl).abs() < 1e-6);
        }
    }

    #[test]
    fn virtual_work_lever_makes_the_total_energy_stationary() {
        let total =
            |alpha| energy_j(&MUSCLE, alpha, 20e3) + restoring_moment_nm(0.04, 2e3) * total_angle(&MUSCLE, 0.04, alpha);
        let at = bending_alpha(&MUSCLE, 0.04, 20e3, 2e3, LeverRule::VirtualWork);
        let h = 1e-4;
        assert!(((total(at + h) - total(at - h)) / (2.0 * h)).abs() < 1e-6);
        assert!(total(at) < total(at - h) && total(at) < total(at + h));
    }

    #[test]
    fn too_low_a_pressure_does_not_bend_the_body() {
        let alpha = bending_alpha(&MUSCLE, 0.04, 100.0, 2e3, LeverRule::VirtualWork);
        assert!(contraction(alpha).abs() < 1e-14);
    }
}
