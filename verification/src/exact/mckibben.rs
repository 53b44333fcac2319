//! McKibben muscles: a braid of inextensible threads around a bladder.
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | b, n | length of a thread, its turns around the muscle | m, – |
//! | θ | angle of the threads from the axis (Chou–Hannaford); α0 is θ at rest (Tondu–Lopez) | rad |
//! | L, D | length and diameter of the muscle | m |
//! | r0 | radius at rest | m |
//! | ε | contraction, 1 − L/L_rest | – |
//! | P, F | gauge pressure, pulling force | Pa, N |
//!
//! The Chou–Hannaford and Tondu–Lopez texts were not read: their formulas are standard and the geometry is derived here.
//! Without bladder stiffness, end caps and friction, free contraction does not depend on pressure. **Real muscles do.**

use std::f64::consts::PI;

use super::Known;

/// Braid of a McKibben muscle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Braid {
    /// Length b of one thread \[m\].
    pub thread_m: f64,
    /// Turns n of one thread around the muscle.
    pub turns: f64,
}

/// Length `L = b cos θ` \[m\].
pub fn braid_length_m(braid: &Braid, theta: f64) -> f64 {
    braid.thread_m * theta.cos()
}

/// Volume `V = b³ sin²θ cos θ/(4π n²)` \[m³\], with D = b sin θ/(nπ).
pub fn braid_volume_m3(braid: &Braid, theta: f64) -> f64 {
    braid.thread_m.powi(3) * theta.sin().powi(2) * theta.cos() / (4.0 * PI * braid.turns.powi(2))
}

/// Force `F = −P dV/dL = P b²/(4π n²) (3 cos²θ − 1)` \[N\]; zero at the magic angle 54.74°.
///
/// Chou & Hannaford, IEEE Trans. Robotics and Automation 12 (1996) 90–102.
pub fn braid_force_n(braid: &Braid, theta: f64, pressure_pa: f64) -> f64 {
    pressure_pa * braid.thread_m.powi(2) / (4.0 * PI * braid.turns.powi(2)) * (3.0 * theta.cos().powi(2) - 1.0)
}

/// [`braid_force_n`] with a bladder of wall thickness t_k: adds `π P [D0 t_k (2 sin θ − 1/sin θ) − t_k²]`, D0 = b/(nπ).
///
/// Attributed to Chou & Hannaford (1996); recalled, not checked against the text. Needs θ > 0.
pub fn thick_braid_force_n(braid: &Braid, theta: f64, pressure_pa: f64, wall_m: f64) -> f64 {
    let widest = braid.thread_m / (braid.turns * PI);
    let wall = widest * wall_m * (2.0 * theta.sin() - theta.sin().recip()) - wall_m.powi(2);
    braid_force_n(braid, theta, pressure_pa) + PI * pressure_pa * wall
}

/// Coefficients `[a, b]` of [`tondu_lopez_force_n`]: `a = 3/tan²α0`, `b = 1/sin²α0`.
pub fn tondu_lopez_coefficients(rest_angle: f64) -> [f64; 2] {
    [3.0 / rest_angle.tan().powi(2), rest_angle.sin().powi(-2)]
}

/// Force `F = π r0² P [a (1 − k ε)² − b]` \[N\]; k = 1 for a cylinder to the ends, larger where the ends taper.
///
/// B. Tondu & P. Lopez, IEEE Control Systems 20 (2000) 15–38. Read in third-party code; k is recalled. The friction of the
/// braid, `±f` against the motion, is left out.
pub fn tondu_lopez_force_n(radius_m: f64, rest_angle: f64, contraction: f64, pressure_pa: f64, end_shape: f64) -> f64 {
    let [a, b] = tondu_lopez_coefficients(rest_angle);
    PI * radius_m.powi(2) * pressure_pa * (a * (1.0 - end_shape * contraction).powi(2) - b)
}

/// Free contraction `ε_max = 1 − 1/(√3 cos α0)` at k = 1, whatever the pressure. Derived here.
pub fn max_contraction(rest_angle: f64) -> f64 {
    1.0 - 1.0 / (3.0_f64.sqrt() * rest_angle.cos())
}

/// Rest angle that gives a free contraction, the inverse of [`max_contraction`] \[rad\]; NaN above 1 − 1/√3.
pub fn rest_angle_from_max_contraction(max_contraction: f64) -> f64 {
    (1.0 / (3.0_f64.sqrt() * (1.0 - max_contraction))).acos()
}

/// Direction of motion in [`festo_pressure_pa`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Motion {
    /// S = +1
    Shortening,
    /// S = 0
    Still,
    /// S = −1
    Lengthening,
}

/// Pressure \[Pa\] of a Festo muscle at force F \[N\] and contraction ε: in kPa,
/// `P = 254.3 + 1.229 F + 15.6 S + 192 tan(2.0265 (ε/(ε_max − 0.331e-3 F) − 0.4609))`.
///
/// Empirical: Hunt et al. with the coefficients as corrected and printed by Bolen (2026). ε_max is the greatest contraction
/// of the muscle. The hysteresis, ±15.6 kPa, is 2.5 % of the 620 kPa the fit covers.
pub fn festo_pressure_pa(force_n: f64, contraction: f64, max_contraction: f64, motion: Motion) -> f64 {
    let sign = match motion {
        Motion::Shortening => 1.0,
        Motion::Still => 0.0,
        Motion::Lengthening => -1.0,
    };
    let relative = contraction / (max_contraction - 0.331e-3 * force_n);
    1e3 * (254.3 + 1.229 * force_n + 15.6 * sign + 192.0 * (2.0265 * (relative - 0.4609)).tan())
}

/// Coefficients of Bolen's (2026) fit for Festo muscles that are short enough to feel their ends.
///
/// `F = F620(l) · F*(ε*, P*)`, `F620 = f arctan(g (l − h))`, `F* = max(0, c0 (e^(−c1 ε*) − 1) + P* e^(−c2 ε*²))`,
/// P* = P/620 kPa, ε* = ε/ε620, l the length at rest.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BolenFit {
    /// Force scale f \[N\].
    pub force_scale_n: f64,
    /// Growth g with length \[1/m\].
    pub growth_per_m: f64,
    /// Length h lost at the ends \[m\].
    pub end_length_m: f64,
    /// c0, c1, c2 of the shape F*.
    pub shape: [f64; 3],
}

/// Bolen's coefficients for the 10 mm muscle.
pub const BOLEN_10_MM: BolenFit =
    BolenFit { force_scale_n: 303.5, growth_per_m: 19.03, end_length_m: 0.0075, shape: [0.5682, 4.254, 0.5597] };

/// Bolen's coefficients for the 20 mm muscle.
pub const BOLEN_20_MM: BolenFit =
    BolenFit { force_scale_n: 922.4, growth_per_m: 15.37, end_length_m: 0.013, shape: [0.2579, 6.477, 1.321] };

/// Pressure that scales P* in [`bolen_shape`] \[Pa\].
pub const BOLEN_PRESSURE_PA: f64 = 620e3;

/// Greatest force `F620(l)` \[N\] of a muscle of length l at 620 kPa and no contraction; see [`BolenFit`].
pub fn bolen_full_force_n(fit: &BolenFit, length_m: f64) -> f64 {
    fit.force_scale_n * (fit.growth_per_m * (length_m - fit.end_length_m)).atan()
}

/// Relative force `F*(ε*, P*)`, never negative; see [`BolenFit`].
pub fn bolen_shape(fit: &BolenFit, relative_contraction: f64, relative_pressure: f64) -> f64 {
    let [c0, c1, c2] = fit.shape;
    let pressed = relative_pressure * (-c2 * relative_contraction.powi(2)).exp();
    (c0 * (-c1 * relative_contraction).exp_m1() + pressed).max(0.0)
}

/// See `known.txt`.
pub(super) fn known() -> Known {
    let tondu_lopez = [20.0_f64, 30.0, 45.0].map(f64::to_radians).map(|rest| {
        let [a, b] = tondu_lopez_coefficients(rest);
        let [blocked, shorter] = [0.0, 0.1].map(|contraction| tondu_lopez_force_n(0.01, rest, contraction, 30e3, 1.0));
        [a, b, blocked, shorter, max_contraction(rest)]
    });
    let braid = Braid { thread_m: 0.3, turns: 2.0 };
    let [narrow, half] = [30.0_f64, 45.0].map(f64::to_radians);
    let short_n = bolen_full_force_n(&BOLEN_10_MM, 0.054);
    let pressures = [Motion::Shortening, Motion::Still, Motion::Lengthening];
    let festo = [
        bolen_full_force_n(&BOLEN_10_MM, 0.112),
        short_n,
        short_n * bolen_shape(&BOLEN_10_MM, 0.0, 300e3 / BOLEN_PRESSURE_PA),
        bolen_shape(&BOLEN_10_MM, 0.5, 1.0),
        bolen_shape(&BOLEN_10_MM, 0.2, 0.5),
    ];
    vec![
        (
            "McKibben, Tondu–Lopez, r0 = 10 mm, 30 kPa",
            [tondu_lopez.as_flattened(), &[rest_angle_from_max_contraction(0.3).to_degrees()]].concat(),
        ),
        (
            "McKibben, Chou–Hannaford, b = 0.3 m, n = 2, 30 kPa",
            vec![
                braid_force_n(&braid, narrow, 30e3),
                braid_force_n(&braid, half, 30e3),
                thick_braid_force_n(&braid, narrow, 30e3, 1e-3),
            ],
        ),
        (
            "McKibben, Festo fits",
            [&festo[..], &pressures.map(|motion| 1e-3 * festo_pressure_pa(100.0, 0.1, 0.165, motion))].concat(),
        ),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    const BRAID: Braid = Braid { thread_m: 0.3, turns: 2.0 };

    #[test]
    fn braid_force_is_minus_pressure_times_slope_of_volume_over_length() {
        for theta in [0.2, 0.5, 0.8, 1.1] {
            let h = 1e-5;
            let dv = braid_volume_m3(&BRAID, theta + h) - braid_volume_m3(&BRAID, theta - h);
            let dl = braid_length_m(&BRAID, theta + h) - braid_length_m(&BRAID, theta - h);
            assert!((braid_force_n(&BRAID, theta, 30e3) + 30e3 * dv / dl).abs() < 1e-6);
        }
    }

    #[test]
    fn both_braid_models_are_the_same_muscle() {
        let (rest, theta) = (0.5_f64, 0.7_f64);
        let radius = BRAID.thread_m * rest.sin() / (2.0 * PI * BRAID.turns);
        let contraction = 1.0 - theta.cos() / rest.cos();
        let force = tondu_lopez_force_n(radius, rest, contraction, 30e3, 1.0);
        assert!((force - braid_force_n(&BRAID, theta, 30e3)).abs() < 1e-11);
    }

    #[test]
    fn force_vanishes_at_the_free_contraction() {
        let rest = 0.5;
        assert!(tondu_lopez_force_n(0.01, rest, max_contraction(rest), 30e3, 1.0).abs() < 1e-12);
        assert!(rest_angle_from_max_contraction(0.5).is_nan());
    }

    #[test]
    fn a_slack_festo_muscle_does_not_push() {
        assert_eq!(bolen_shape(&BOLEN_20_MM, 1.5, 0.0), 0.0);
        assert_eq!(bolen_shape(&BOLEN_10_MM, 0.0, 1.0), 1.0);
    }
}
