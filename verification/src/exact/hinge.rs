//! The virtual-work hinge model: pouches in series that fold an inflated body about its far fibre.
//!
//! Each of N units holds one pouch over a body length L0. The wall is inextensible and slack everywhere but at the far
//! fibre, so a fold by φ costs the volume πR²·Rφ and the body resists with the constant moment p π R³ (Comer and Levy's
//! collapse moment, [`super::beam::collapse_moment_nm`]).
//!
//! ```text
//! shortening   η L0 ε(θ) = (R + d) φ
//! energy       Π(θ) = −P η V(θ) + p π R³ φ(θ)
//! dΠ/dθ = 0    F(θ) ℓ(θ) = p π R³ ,   lever ℓ = d(L0 ε)/dφ = (R + d) / (1 − (ε/ε′) d′/(R + d))
//! shape        far fibre of length L_b keeps its length: axis radius ρ = L_b/Φ − R, Φ = N φ
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | P, p | gauge pressure in the pouch, in the body | Pa |
//! | R | radius of the body | m |
//! | d | distance of the pouch's chord from the body axis | m |
//! | η | sealed-end factor on contraction and volume ([`super::pouch::robin_end_factor`]) | – |
//! | θ, ε, V, F | half angle, contraction, volume and force of the pouch ([`super::pouch`]) | rad, –, m³, N |
//! | φ, Φ | fold angle of one unit, of the whole body | rad |
//!
//! Depends on P and p only through P/p. **No** wall or fold stiffness, weld width, gravity, friction, snap or stretch.
//! Derived here; it is not taken from a published model of these robots.

use std::f64::consts::{FRAC_PI_2, PI};

use super::KnownSections;
use super::pouch::{Pouch, bulge_height_m, contraction, force_n};
use super::solve::{falling_root, sinc, sine_lag};

/// Where the chord of the pouch runs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Arm {
    /// In the wall of the body: d = R.
    Embedded,
    /// On the wall, lifted by its own inner bulge: d = R + L0 (1 − cos θ)/(2θ).
    External,
}

/// Which lever turns the actuator's force into a moment when the arm changes with inflation.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LeverRule {
    /// ℓ = dΔL/dφ from dΠ/dθ = 0. The consistent one.
    VirtualWork,
    /// ℓ = R + d at the current inflation, its change left out. A shortcut, kept to show what it costs.
    CurrentArm,
}

/// One unit of the series: a pouch on a body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SeriesUnit {
    /// The pouch, its length along the body axis.
    pub pouch: Pouch,
    /// Radius R of the body \[m\].
    pub body_radius_m: f64,
    /// Sealed-end factor η, 1 for an ideal pouch.
    pub end_factor: f64,
    /// Where the chord of the pouch runs.
    pub arm: Arm,
}

/// A body bent into a circular arc of constant far-fibre length, straight beyond it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BentBody {
    /// Radius R of the body \[m\].
    pub body_radius_m: f64,
    /// Length L_b of the actuated body when straight, and of its far fibre always \[m\].
    pub length_m: f64,
    /// Total bending angle Φ of the arc \[rad\].
    pub total_angle: f64,
}

/// Moment p π R³ with which a fully wrinkled body resists folding \[N m\].
pub fn restoring_moment_nm(body_radius_m: f64, body_pressure_pa: f64) -> f64 {
    PI * body_pressure_pa * body_radius_m.powi(3)
}

/// Distance R + d from the far fibre to the pouch's chord \[m\].
pub fn arm_m(unit: &SeriesUnit, theta: f64) -> f64 {
    let lift = match unit.arm {
        Arm::Embedded => 0.0,
        Arm::External => bulge_height_m(&unit.pouch, theta),
    };
    2.0 * unit.body_radius_m + lift
}

/// Fold angle of one unit, `φ = η L0 ε(θ)/(R + d(θ))` \[rad\].
pub fn fold_angle(unit: &SeriesUnit, theta: f64) -> f64 {
    unit.end_factor * unit.pouch.length_m * contraction(theta) / arm_m(unit, theta)
}

/// Lever ℓ of the pouch's force at half angle θ \[m\]; both rules agree for [`Arm::Embedded`].
pub fn lever_m(unit: &SeriesUnit, theta: f64, rule: LeverRule) -> f64 {
    let arm = arm_m(unit, theta);
    if rule == LeverRule::CurrentArm || unit.arm == Arm::Embedded {
        return arm;
    }
    // d′ = L0 [θ sin θ − (1 − cos θ)]/(2θ²) and ε′ = (sin θ − θ cos θ)/θ²
    let arm_slope = 0.5 * unit.pouch.length_m * (sinc(theta) - 0.5 * sinc(0.5 * theta).powi(2));
    arm / (1.0 - contraction(theta) * arm_slope / (theta * sine_lag(theta) * arm))
}

/// Half angle θ in \[0, π/2\] where `F(θ) ℓ(θ) = p π R³`; η cancels. 0 for P = 0, π/2 for p = 0, NaN for NaN input.
pub fn equilibrium_theta(unit: &SeriesUnit, actuator_pa: f64, body_pa: f64, rule: LeverRule) -> f64 {
    let moment = restoring_moment_nm(unit.body_radius_m, body_pa);
    // Times θ, so that the pole of the force at θ = 0 is gone.
    let excess = |theta: f64| theta * (force_n(&unit.pouch, theta, actuator_pa) * lever_m(unit, theta, rule) - moment);
    falling_root(excess, 0.0, FRAC_PI_2)
}

/// Position `[x, y]` \[m\] of the axis point at far-fibre station s: `x = ρ sin(Φ s/L_b)`, `y = ρ (1 − cos(Φ s/L_b))`.
///
/// Beyond s = L_b the body goes on straight along its end tangent. Exact also for Φ → 0. Needs Φ < L_b/R, where the near
/// fibre would vanish.
pub fn axis_point_m(body: &BentBody, station_m: f64) -> [f64; 2] {
    let on_arc = station_m.min(body.length_m);
    let (tail, fraction) = (station_m - on_arc, on_arc / body.length_m);
    let angle = body.total_angle * fraction;
    let axis_arc = (body.length_m - body.body_radius_m * body.total_angle) * fraction;
    let x = axis_arc * sinc(angle) + tail * angle.cos();
    let y = 0.5 * axis_arc * angle * sinc(0.5 * angle).powi(2) + tail * angle.sin();
    [x, y]
}

/// See `known.txt`; R = 40 mm, p = 2 kPa, L_b = 360 mm, L0 = W = 60 mm.
pub(super) fn known() -> KnownSections {
    const BODY_PA: f64 = 2e3;
    const PRESSURES_PA: [f64; 3] = [10e3, 20e3, 30e3];
    const SQUARE: Pouch = Pouch { length_m: 0.06, width_m: 0.06 };
    const EMBEDDED: SeriesUnit = SeriesUnit { pouch: SQUARE, body_radius_m: 0.04, end_factor: 1.0, arm: Arm::Embedded };
    const EXTERNAL: SeriesUnit = SeriesUnit { arm: Arm::External, ..EMBEDDED };
    // y of the marker [mm] for `count` units at half angle θ.
    let marker_mm = |unit: &SeriesUnit, theta: f64, count: f64, station_mm: f64| {
        let body = BentBody { body_radius_m: 0.04, length_m: 0.36, total_angle: count * fold_angle(unit, theta) };
        1e3 * axis_point_m(&body, 1e-3 * station_mm)[1]
    };
    let theta = |unit: &SeriesUnit, rule, pressure_pa| equilibrium_theta(unit, pressure_pa, BODY_PA, rule);
    let work = LeverRule::VirtualWork;
    let height = |unit: &SeriesUnit, end_factor, rule, count, station_mm, pressure_pa| {
        marker_mm(&SeriesUnit { end_factor, ..*unit }, theta(unit, rule, pressure_pa), count, station_mm)
    };
    let embedded = |end_factor, pressure_pa| height(&EMBEDDED, end_factor, work, 6.0, 330.0, pressure_pa);
    let external = |end_factor, rule| PRESSURES_PA.map(|p| height(&EXTERNAL, end_factor, rule, 6.0, 330.0, p));
    let load = restoring_moment_nm(0.04, BODY_PA) / (30e3 * 0.06 * 0.06 * arm_m(&EMBEDDED, 0.0));
    let thetas = |unit: &SeriesUnit| PRESSURES_PA.map(|p| theta(unit, work, p));
    let sealed = [1.0, 0.598504, 0.6456, 0.6817].map(|eta| PRESSURES_PA.map(|p| embedded(eta, p)));
    let readings = [(5.0, 330.0), (6.0, 360.0)]
        .map(|(count, station)| PRESSURES_PA.map(|p| height(&EMBEDDED, 1.0, work, count, station, p)));
    let at_low = [2e3, 5e3].map(|p| embedded(1.0, p));
    let with_edges = [2e3, 5e3, 10e3, 20e3, 30e3].map(|p| embedded(0.62, p));
    let lifts = [0.5, 1.4].map(|theta| 1e3 * (arm_m(&EXTERNAL, theta) - 0.04));
    let outside = [external(1.0, work), external(0.598504, work), external(1.0, LeverRule::CurrentArm)];
    vec![
        (
            "hinge model, embedded",
            [&[load, theta(&EMBEDDED, work, 30e3)][..], &thetas(&EMBEDDED), sealed.as_flattened()].concat(),
        ),
        ("hinge model, embedded, other readings", [readings.as_flattened(), &at_low, &with_edges].concat()),
        ("hinge model, external", [&lifts[..], &thetas(&EXTERNAL), outside.as_flattened()].concat()),
    ]
}

#[cfg(test)]
mod tests {
    use super::super::pouch::volume_m3;
    use super::*;

    fn unit(arm: Arm) -> SeriesUnit {
        let pouch = Pouch { length_m: 0.06, width_m: 0.06 };
        SeriesUnit { pouch, body_radius_m: 0.04, end_factor: 1.0, arm }
    }

    /// Energy `Π = −P η V(θ) + p π R³ φ(θ)` of one unit at fixed pressures \[J\].
    fn energy_j(unit: &SeriesUnit, theta: f64, actuator_pa: f64, body_pa: f64) -> f64 {
        let body = restoring_moment_nm(unit.body_radius_m, body_pa) * fold_angle(unit, theta);
        body - actuator_pa * unit.end_factor * volume_m3(&unit.pouch, theta)
    }

    #[test]
    fn energy_is_stationary_and_smallest_at_equilibrium_for_the_virtual_work_lever() {
        for arm in [Arm::Embedded, Arm::External] {
            for actuator_pa in [2e3, 10e3, 30e3] {
                let unit = unit(arm);
                let at = equilibrium_theta(&unit, actuator_pa, 2e3, LeverRule::VirtualWork);
                let energy = |theta| energy_j(&unit, theta, actuator_pa, 2e3);
                let h = 1e-4;
                let slope = (energy(at + h) - energy(at - h)) / (2.0 * h);
                assert!(slope.abs() < 1e-7 * energy(at).abs(), "{arm:?} {actuator_pa} Pa: slope {slope}");
                assert!(energy(at) < energy(at - h) && energy(at) < energy(at + h));
            }
        }
    }

    #[test]
    fn only_the_ratio_of_pressures_matters() {
        let unit = unit(Arm::External);
        let low = equilibrium_theta(&unit, 10e3, 2e3, LeverRule::VirtualWork);
        let high = equilibrium_theta(&unit, 40e3, 8e3, LeverRule::VirtualWork);
        assert!((low - high).abs() < 1e-14);
    }

    #[test]
    fn limits_of_no_actuator_pressure_and_no_body_pressure_are_flat_and_round() {
        let unit = unit(Arm::External);
        assert!(equilibrium_theta(&unit, 0.0, 2e3, LeverRule::VirtualWork) < 1e-30);
        assert!((equilibrium_theta(&unit, 1e3, 0.0, LeverRule::VirtualWork) - FRAC_PI_2).abs() < 1e-12);
        assert!(equilibrium_theta(&unit, f64::NAN, 2e3, LeverRule::VirtualWork).is_nan());
    }

    #[test]
    fn the_shortcut_lever_underpredicts_bending_of_an_external_pouch() {
        let unit = unit(Arm::External);
        for actuator_pa in [10e3, 20e3, 30e3] {
            let full = equilibrium_theta(&unit, actuator_pa, 2e3, LeverRule::VirtualWork);
            assert!(equilibrium_theta(&unit, actuator_pa, 2e3, LeverRule::CurrentArm) < full);
        }
    }

    #[test]
    fn a_hardly_bent_body_is_straight_and_the_tail_joins_smoothly() {
        let body = BentBody { body_radius_m: 0.04, length_m: 0.36, total_angle: 1e-9 };
        let [x, y] = axis_point_m(&body, 0.18);
        assert!((x - 0.18).abs() < 1e-10 && (y / (0.5 * 0.18 * 0.5e-9) - 1.0).abs() < 1e-6);
        let bent = BentBody { total_angle: 1.0, ..body };
        let step = |s: f64| axis_point_m(&bent, s + 1e-9)[1] - axis_point_m(&bent, s)[1];
        assert!((step(0.36) / 1e-9 - 1.0_f64.sin()).abs() < 1e-6);
    }
}
