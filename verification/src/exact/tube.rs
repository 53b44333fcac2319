//! Closed cylinder of any fabric under pressure, at finite strain: how far it shortens, widens and twists.
//!
//! A point at (X, Y) of the flat sheet, X along the axis and Y around it, goes to axial λₓX and hoop λ_cY + gX:
//!
//! ```text
//! F = | λₓ  0  |     E = ½(FᵀF − 1)     V/V₀ = λₓ λ_c²     Π/(2πR L) = W(E) − ½ p R λₓ λ_c² − N λₓ/(2πR)
//!     | g   λ_c |
//! ∂W/∂λₓ = ½ p R λ_c² + N/(2πR)         ∂W/∂λ_c = p R λₓ λ_c         ∂W/∂g = 0 (ends turn freely)
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | R, L | radius and length of the unstressed cylinder | m |
//! | λₓ, λ_c | stretch along the axis and around it | – |
//! | g | slide of a generator around the tube per length, r·(twist per length) | – |
//! | p | gauge pressure, also on the end caps | Pa |
//! | N | axial pull from outside, beyond the pressure on the caps | N |
//! | ψ | angle of the warp from the axis, positive towards +Y | rad |
//!
//! The same as local equilibrium in the deformed shape: hoop tension p r, axial tension p r/2 + N/(2πr), no shear. A
//! bias fabric with unequal yarns turns its ends although no torque acts.
//!
//! Valid away from the ends (see [`super::shell`] for how far they reach), for a wall that is taut in both directions,
//! without bending stiffness, on first loading. Derived here.

use std::f64::consts::{FRAC_PI_4, PI};

use super::KnownSections;
use models::fabrics::{Fabric, NeoHookean, Orthotropic};

/// A closed cylinder of fabric, before it is inflated.
#[derive(Debug, Clone, Copy)]
pub struct ClosedTube<'a> {
    /// Radius R of the unstressed cylinder \[m\]; flat width/π.
    pub radius_m: f64,
    /// Angle ψ of the warp from the axis \[rad\]; π/4 for a bias cut.
    pub warp_angle: f64,
    /// Fabric of the wall, its warp at `warp_angle`.
    pub fabric: &'a dyn Fabric,
}

/// Which motion the ends of the tube allow.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Ends {
    /// They move apart and turn freely under an axial pull N \[N\]; 0 for a free tube.
    Free(f64),
    /// They move apart under N \[N\] but cannot turn.
    NoTwist(f64),
    /// They are held at λₓ and cannot turn.
    Held(f64),
}

/// Deformation of the inflated tube from its unstressed state.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Inflated {
    /// Stretch λₓ along the tube's axis.
    pub axial_stretch: f64,
    /// Stretch λ_c around the tube's axis.
    pub hoop_stretch: f64,
    /// Slide g of a generator around the tube per unstressed length.
    pub slide: f64,
}

impl Inflated {
    /// Contraction `1 − λₓ` along the axis.
    pub fn contraction(&self) -> f64 {
        1.0 - self.axial_stretch
    }
}

/// Equilibrium at a gauge pressure; `None` where the path from the unstressed state ends (burst) or an input is not a number.
pub fn inflate(tube: &ClosedTube, pressure_pa: f64, ends: Ends) -> Option<Inflated> {
    let (mut at, mut done, mut step) = (UNSTRESSED, 0.0, 1.0);
    while done < 1.0 {
        let share = f64::min(1.0, done + step);
        match newton(tube, share * pressure_pa, part_way(ends, share), at) {
            Some(next) => {
                (at, done) = (next, share);
                step *= 2.0;
            }
            None => step *= 0.5,
        }
        if step < SMALLEST_STEP {
            return None;
        }
    }
    Some(Inflated { axial_stretch: at[0], hoop_stretch: at[1], slide: at[2] })
}

/// Axial pull N that holds the tube at a state \[N\]: `2πR ∂W/∂λₓ − p π R² λ_c²`. Negative: it pushes.
pub fn axial_pull_n(tube: &ClosedTube, pressure_pa: f64, at: &Inflated) -> f64 {
    let q = [at.axial_stretch, at.hoop_stretch, at.slide];
    2.0 * PI * tube.radius_m * energy_slopes(tube, q)[0] - pressure_pa * PI * (tube.radius_m * q[1]).powi(2)
}

/// Tensions per deformed length \[N/m\]: axial, hoop, shear. `F S Fᵀ/det F`.
pub fn wall_tension_n_per_m(tube: &ClosedTube, at: &Inflated) -> [f64; 3] {
    let q = [at.axial_stretch, at.hoop_stretch, at.slide];
    let s = sheet_tension(tube, q);
    let area = q[0] * q[1];
    let axial = q[0] * q[0] * s[0];
    let shear = q[0] * (q[2] * s[0] + q[1] * s[2]);
    let hoop = q[2] * q[2] * s[0] + 2.0 * q[2] * q[1] * s[2] + q[1] * q[1] * s[1];
    [axial / area, hoop / area, shear / area]
}

const UNSTRESSED: [f64; 3] = [1.0, 1.0, 0.0];
/// Greatest change of a stretch within one load step: larger ones may land on another branch.
const LARGEST_MOVE: f64 = 0.05;
/// Load steps below this mean that the path has ended; a bias fabric 10⁶ times softer in shear needs 2⁻²⁰.
const SMALLEST_STEP: f64 = 1e-9;

fn part_way(ends: Ends, share: f64) -> Ends {
    match ends {
        Ends::Free(pull) => Ends::Free(share * pull),
        Ends::NoTwist(pull) => Ends::NoTwist(share * pull),
        Ends::Held(stretch) => Ends::Held(1.0 + share * (stretch - 1.0)),
    }
}

/// Newton's method with a difference Jacobian; converged to rounding or `None`.
fn newton(tube: &ClosedTube, pressure_pa: f64, ends: Ends, start: [f64; 3]) -> Option<[f64; 3]> {
    const STEP: f64 = 1e-6;
    let mut q = start;
    for _ in 0..20 {
        let rest = out_of_balance(tube, pressure_pa, ends, q);
        let mut jacobian = [[0.0; 3]; 3];
        for k in 0..3 {
            let (mut up, mut down) = (q, q);
            up[k] += STEP;
            down[k] -= STEP;
            let (high, low) =
                (out_of_balance(tube, pressure_pa, ends, up), out_of_balance(tube, pressure_pa, ends, down));
            for i in 0..3 {
                jacobian[i][k] = (high[i] - low[i]) / (2.0 * STEP);
            }
        }
        let change = solve_3x3(jacobian, rest);
        for i in 0..3 {
            q[i] -= change[i];
        }
        if !(0..3).all(|i| (q[i] - start[i]).abs() < LARGEST_MOVE) {
            return None;
        }
        if change.iter().all(|c| c.abs() < 1e-14) {
            return Some(q);
        }
    }
    None
}

/// Slopes of the potential per sheet area; a blocked coordinate gives its distance from where it is held.
fn out_of_balance(tube: &ClosedTube, pressure_pa: f64, ends: Ends, q: [f64; 3]) -> [f64; 3] {
    let slope = energy_slopes(tube, q);
    let thrust = pressure_pa * tube.radius_m;
    let per_girth = 1.0 / (2.0 * PI * tube.radius_m);
    let hoop = slope[1] - thrust * q[0] * q[1];
    let axial = |pull: f64| slope[0] - 0.5 * thrust * q[1] * q[1] - pull * per_girth;
    match ends {
        Ends::Free(pull) => [axial(pull), hoop, slope[2]],
        Ends::NoTwist(pull) => [axial(pull), hoop, q[2]],
        Ends::Held(stretch) => [q[0] - stretch, hoop, q[2]],
    }
}

/// `[∂W/∂λₓ, ∂W/∂λ_c, ∂W/∂g]`, the entries of F S.
fn energy_slopes(tube: &ClosedTube, q: [f64; 3]) -> [f64; 3] {
    let s = sheet_tension(tube, q);
    [q[0] * s[0], q[2] * s[2] + q[1] * s[1], q[2] * s[0] + q[1] * s[2]]
}

/// Second Piola–Kirchhoff tension in axial and hoop axes: strain turned into the fabric's axes, tension turned back.
fn sheet_tension(tube: &ClosedTube, q: [f64; 3]) -> [f64; 3] {
    let [lx, lc, g] = q;
    // λ² − 1 as (λ − 1)(λ + 1): no cancellation at small strain.
    let e = [0.5 * ((lx - 1.0) * (lx + 1.0) + g * g), 0.5 * (lc - 1.0) * (lc + 1.0), g * lc];
    let (s, c) = tube.warp_angle.sin_cos();
    let (cc, ss, cs) = (c * c, s * s, c * s);
    let in_fabric = [
        cc * e[0] + ss * e[1] + cs * e[2],
        ss * e[0] + cc * e[1] - cs * e[2],
        2.0 * cs * (e[1] - e[0]) + (cc - ss) * e[2],
    ];
    let t = tube.fabric.tension(in_fabric, &[0.0; 2]);
    [
        cc * t[0] + ss * t[1] - 2.0 * cs * t[2],
        ss * t[0] + cc * t[1] + 2.0 * cs * t[2],
        cs * (t[0] - t[1]) + (cc - ss) * t[2],
    ]
}

/// Cramer's rule; not a number where the matrix is singular.
fn solve_3x3(m: [[f64; 3]; 3], b: [f64; 3]) -> [f64; 3] {
    let det = |m: &[[f64; 3]; 3]| {
        m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0])
            + m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0])
    };
    let whole = det(&m);
    std::array::from_fn(|k| {
        let mut replaced = m;
        for i in 0..3 {
            replaced[i][k] = b[i];
        }
        det(&replaced) / whole
    })
}

pub(super) fn known() -> KnownSections {
    let state = |fabric: &dyn Fabric, warp_angle, radius_m, pressure_pa, ends| {
        let none = Inflated { axial_stretch: f64::NAN, hoop_stretch: f64::NAN, slide: f64::NAN };
        inflate(&ClosedTube { radius_m, warp_angle, fabric }, pressure_pa, ends).unwrap_or(none)
    };
    let flat_m = 0.06 / PI;
    let [plain, coupled] = [0.0, 0.3].map(|nu12| Orthotropic::new(96.5e6, 120e6, nu12, 1.032e6, 5e-5));
    let free = |fabric: &Orthotropic, pressure_pa| state(fabric, FRAC_PI_4, flat_m, pressure_pa, Ends::Free(0.0));
    let held = state(&coupled, FRAC_PI_4, flat_m, 10e3, Ends::Held(0.95));
    let tube = ClosedTube { radius_m: flat_m, warp_angle: FRAC_PI_4, fabric: &coupled };
    let bias = [
        &[3e3, 5e3, 10e3, 20e3, 30e3].map(|p| free(&plain, p).contraction())[..],
        &[free(&plain, 30e3).hoop_stretch, free(&plain, 30e3).slide],
        &[3e3, 10e3, 20e3, 30e3].map(|p| free(&coupled, p).contraction()),
        &[free(&coupled, 30e3).slide, held.hoop_stretch, axial_pull_n(&tube, 10e3, &held)],
    ];
    let linear = Orthotropic::isotropic(208e6, 0.3, 2e-4);
    let isotropic = [2e3, 2e4].map(|p| state(&linear, 0.0, 0.04, p, Ends::Free(0.0)));
    let rubber = NeoHookean::new(208e6 / 6.0, 2e-4);
    let neo = |pressure_pa, pull_n| state(&rubber, 0.0, 0.04, pressure_pa, Ends::Free(pull_n));
    let both = |at: Inflated| [at.axial_stretch, at.hoop_stretch];
    let blown = [both(neo(1e5, 0.0)), both(neo(2e5, 0.0)), both(neo(1e5, -200.0))];
    vec![
        ("bias tube, 60 mm flat, free ends", bias.concat()),
        (
            "closed tube, isotropic linear, R = 40 mm, Et = 41.6 kN/m",
            isotropic.map(|at| both(at).map(|stretch| stretch - 1.0)).concat(),
        ),
        (
            "closed tube, neo-Hookean, R = 40 mm, 6 C10 t = 41.6 kN/m",
            [&[neo(2e3, 0.0).hoop_stretch][..], blown.as_flattened()].concat(),
        ),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bias(nu12: f64) -> Orthotropic {
        Orthotropic::new(96.5e6, 120e6, nu12, 1.032e6, 50e-6)
    }

    #[test]
    fn hoop_tension_is_pr_axial_half_of_it_and_shear_vanishes_in_the_deformed_wall() {
        let fabric = bias(0.3);
        let neo = NeoHookean::new(35e6, 2e-4);
        for (wall, angle, p) in [(&fabric as &dyn Fabric, 0.6, 30e3), (&neo, 0.0, 150e3), (&fabric, PI / 4.0, 3e3)] {
            let tube = ClosedTube { radius_m: 0.03, warp_angle: angle, fabric: wall };
            let at = inflate(&tube, p, Ends::Free(0.0)).unwrap();
            let hoop = p * tube.radius_m * at.hoop_stretch;
            let t = wall_tension_n_per_m(&tube, &at);
            assert!((t[1] / hoop - 1.0).abs() < 1e-9, "{t:?}");
            assert!((t[0] / hoop - 0.5).abs() < 1e-9 && (t[2] / hoop).abs() < 1e-9, "{t:?}");
        }
    }

    #[test]
    fn small_pressure_gives_the_thin_wall_strains() {
        let (young, nu, t, radius, p) = (208e6, 0.3, 2e-4, 0.04, 1.0);
        let fabric = Orthotropic::isotropic(young, nu, t);
        let tube = ClosedTube { radius_m: radius, warp_angle: 0.0, fabric: &fabric };
        let at = inflate(&tube, p, Ends::Free(0.0)).unwrap();
        let unit = p * radius / (young * t);
        assert!(((at.hoop_stretch - 1.0) / unit - (1.0 - 0.5 * nu)).abs() < 1e-5);
        assert!(((at.axial_stretch - 1.0) / unit - (0.5 - nu)).abs() < 1e-5);
    }

    #[test]
    fn stiff_yarns_without_shear_stiffness_reach_the_netting_limit() {
        let fabric = Orthotropic::new(1e12, 1e12, 0.0, 10.0, 5e-5);
        let tube = ClosedTube { radius_m: 0.02, warp_angle: PI / 4.0, fabric: &fabric };
        let at = inflate(&tube, 30e3, Ends::Free(0.0)).unwrap();
        assert!((at.contraction() - (1.0 - (2.0 / 3.0_f64).sqrt())).abs() < 1e-5);
        assert!(at.slide.abs() < 1e-9);
    }

    #[test]
    fn stretchless_yarns_in_shear_give_the_closed_form_of_the_fabric_muscle_at_small_shear() {
        // W = ½ A₆₆ (2E₁₂)², and 2E₁₂ = sin γ between stretchless yarns: equal to ½ G t γ² up to γ⁴.
        let fabric = Orthotropic::new(1e13, 1e13, 0.0, 51.6 / 5e-5, 5e-5);
        let tube = ClosedTube { radius_m: 0.06 / PI, warp_angle: PI / 4.0, fabric: &fabric };
        let muscle = super::super::fpam::Fpam { flat_width_m: 0.06, rest_length_m: 0.3, shear_stiffness_n_per_m: 51.6 };
        let alpha = super::super::fpam::free_alpha(&muscle, 200.0);
        let at = inflate(&tube, 200.0, Ends::Free(0.0)).unwrap();
        let closed = super::super::fpam::contraction(alpha);
        assert!((at.contraction() / closed - 1.0).abs() < 2.0 * (2.0 * alpha - PI / 2.0).powi(2), "{closed}");
    }

    #[test]
    fn pull_that_holds_a_length_is_the_pull_that_reaches_it() {
        let fabric = bias(0.3);
        let tube = ClosedTube { radius_m: 0.06 / PI, warp_angle: PI / 4.0, fabric: &fabric };
        let held = inflate(&tube, 10e3, Ends::Held(0.95)).unwrap();
        let pull = axial_pull_n(&tube, 10e3, &held);
        let reached = inflate(&tube, 10e3, Ends::NoTwist(pull)).unwrap();
        assert!(pull > 0.0 && (reached.axial_stretch - 0.95).abs() < 1e-11);
    }

    #[test]
    fn a_tube_beyond_its_burst_pressure_or_without_numbers_has_no_state() {
        let neo = NeoHookean::new(208e6 / 6.0, 2e-4);
        let tube = ClosedTube { radius_m: 0.04, warp_angle: 0.0, fabric: &neo };
        assert_eq!(inflate(&tube, 5e5, Ends::Free(0.0)), None);
        assert_eq!(inflate(&tube, f64::NAN, Ends::Free(0.0)), None);
        assert_eq!(inflate(&tube, 0.0, Ends::Free(0.0)).unwrap().contraction(), 0.0);
    }
}
