//! The linear pouch law shared by sPAM, cPAM and ePAM.
//!
//! Two inextensible sheets of flat length L₀ become two circular arcs of half angle θ:
//!
//! ```text
//! ε(θ) = 1 − sinθ/θ                       contraction
//! v(θ) = W L₀ (θ − sinθ cosθ)/(2θ²)       volume per unit flat length
//! N(θ) = P dv/dε = P W L₀ cosθ/θ          force along the body
//! h(θ) = L₀ (1 − cosθ)/θ                  height of the lens
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | θ | half of the arc's central angle | rad |
//! | L₀, W | flat length along the body, width across it | m |
//! | P | actuator gauge pressure | Pa |
//!
//! **Validity**: inextensible film, no bending stiffness, quasi-static, and no restraint by the sealed side edges (that
//! is the effect `sealed_sides`). **Do not use** for pouches much longer than wide: there the side seams decide.
//! Reference: Niiyama et al., Soft Robotics 2(2), 2015 (pouch motor); the volume and its derivative are derived here.

use super::actuator::{Actuator, Demand, Family, Stroke, converged};
use super::pattern::{ChamberBottom, flat};
use super::shape::ActuatorShape;
use crate::root::halved;
use crate::trig::sin_cos;
use std::f64::consts::{FRAC_PI_2, PI};

/// What all pouches share; entries say how they differ.
pub(super) const POUCH: Actuator = Actuator {
    name: "",
    title: "",
    sentence: "",
    formula: "",
    reference: "",
    validity: "",
    family: Family::Pouch,
    stroke,
    range: RANGE,
    guess,
    area,
    arm,
    edge_restraint: |_| 1.0,
    pattern: |shape| flat(shape, ChamberBottom::Wall),
};

/// θ stays below a full circle; at π the two arcs would meet.
pub(crate) const RANGE: (f64, f64) = (1e-6, PI - 1e-6);

/// The pouch law at half arc angle `theta` \[rad\].
pub fn stroke(shape: &ActuatorShape, theta: f64) -> Stroke {
    if theta < SERIES_BELOW {
        return stroke_series(shape, theta);
    }
    let (sin, cos) = sin_cos(theta);
    let inverse = 1.0 / theta;
    let slope = (sin - theta * cos) * inverse * inverse;
    let area = shape.volume_gain * shape.width_m * shape.length_m;
    let height = shape.length_m * (1.0 - cos) * inverse;
    Stroke {
        contraction: 1.0 - sin * inverse,
        d_contraction: slope,
        volume: area * (theta - sin * cos) * 0.5 * inverse * inverse,
        d_volume: area * cos * inverse * slope,
        lift: 0.5 * height,
        d_lift: 0.5 * (shape.length_m * sin - height) * inverse,
        weight: theta,
    }
}

/// Below this angle 1 − sinθ/θ loses more digits to cancellation than the series to truncation (θ⁶/5040 ≈ 2e-16).
const SERIES_BELOW: f64 = 0.01;

fn stroke_series(shape: &ActuatorShape, theta: f64) -> Stroke {
    let t2 = theta * theta;
    let slope = theta * (1.0 / 3.0 - t2 * (1.0 / 30.0 - t2 / 840.0));
    let area = shape.volume_gain * shape.width_m * shape.length_m;
    let cos = theta.cos();
    Stroke {
        contraction: t2 * (1.0 / 6.0 - t2 * (1.0 / 120.0 - t2 / 5040.0)),
        d_contraction: slope,
        volume: area * theta * (1.0 / 3.0 - t2 * (1.0 / 15.0 - t2 * 2.0 / 315.0)),
        d_volume: area * cos / theta * slope,
        lift: 0.5 * shape.length_m * theta * (0.5 - t2 * (1.0 / 24.0 - t2 / 720.0)),
        d_lift: 0.5 * shape.length_m * (0.5 - t2 * (1.0 / 8.0 - t2 / 144.0)),
        weight: theta,
    }
}

/// Half angle in \[0, π\] of a lens that has contracted by `contraction`: `sinθ/θ = 1 − ε`, by bisection to the last digit.
pub fn half_angle(contraction: f64) -> f64 {
    halved([0.0, PI], 64, |theta| theta.sin() / theta > 1.0 - contraction)[1]
}

/// Root of `cosθ − θ m` by Newton, m the need at θ.
fn guess(shape: &ActuatorShape, demand: &Demand) -> (f64, f64) {
    let (m0, m1) = (demand.constant, demand.per_contraction);
    let growth = 0.5 * shape.length_m * demand.growth;
    // A start within a few thousandths at working pressures: growth as at θ = 1.45, or 1.1 where the wall is stiff, the root
    // for m = m₀, and the cube root of θ − sinθ ≈ θ³/6, its factor fitted.
    let lever = 1.0 + 0.84 * growth;
    let mut theta = FRAC_PI_2 * lever / (lever + m0);
    if m1 > 0.0 {
        let m1 = m1 / ((1.0 + 0.72 * growth) * (1.0 + 0.5 * growth));
        let factor = 0.22 + 0.0617 / (1.0 + 1.6 * m1);
        theta /= rough_cbrt(1.0 + factor * m1 * theta * theta * theta);
    }
    let (mut slope, mut last) = (-1.0, 0.0);
    for _ in 0..6 {
        let (sin, cos) = sin_cos(theta);
        let per = 1.0 / theta;
        let de = (sin * per - cos) * per;
        let height = (1.0 - cos) * per;
        let d_height = (sin - height) * per;
        let lift = [growth * height, growth * d_height, growth * (cos - 2.0 * d_height) * per];
        let need = demand.need([1.0 - sin * per, de, (sin - 2.0 * de) * per], lift);
        let by_theta = -sin - need.value - theta * need.slope;
        let step = (cos - theta * need.value) / by_theta;
        slope = by_theta * need.lever;
        theta -= step;
        if converged(step, last) {
            break;
        }
        last = step;
    }
    (theta, slope)
}

/// Cube root of a positive number within 1e-4: a third of the exponent (Kahan's constant), and one Halley step.
fn rough_cbrt(x: f64) -> f64 {
    let y = f64::from_bits(x.to_bits() / 3 + (715_094_163 << 32));
    let cube = y * y * y;
    y * (cube + 2.0 * x) / (2.0 * cube + x)
}

/// P·W·L₀ is the force at cosθ = θ.
fn area(shape: &ActuatorShape) -> f64 {
    shape.volume_gain * shape.width_m * shape.length_m
}

/// Pouch in or on the wall: its chord is on the body surface, one diameter from the taut generator.
fn arm(radius_m: f64, _shape: &ActuatorShape) -> f64 {
    2.0 * radius_m
}

#[cfg(test)]
mod tests {
    use super::super::BIAS;
    use super::*;

    #[test]
    fn the_guess_meets_its_demand_to_rounding() {
        let shape = ActuatorShape { length_m: 0.06, width_m: 0.05, fold_m: 0.0, volume_gain: 1.0, bias_rad: BIAS };
        for constant in [0.0, 0.0465, 0.5, 1.0, 30.0, 1e4] {
            for per_contraction in [0.0, 0.01, 2.0, 25.0, 1e4] {
                let (theta, slope) = guess(&shape, &Demand { constant, per_contraction, growth: 0.0 });
                let left = theta.cos() - constant * theta - per_contraction * (theta - theta.sin());
                assert!((left / slope).abs() < 1e-14 * (1.0 + theta), "{constant} {per_contraction}: {theta}");
            }
        }
    }

    #[test]
    fn the_rough_cube_root_is_good_for_a_start() {
        for i in 0..600 {
            let x = 10f64.powf(0.05 * f64::from(i) - 3.0);
            assert!((rough_cbrt(x) / x.cbrt() - 1.0).abs() < 1e-4, "{x}");
        }
    }

    #[test]
    fn the_series_meets_the_closed_form_where_they_join() {
        let shape = ActuatorShape { length_m: 0.06, width_m: 0.05, fold_m: 0.0, volume_gain: 1.0, bias_rad: BIAS };
        let (a, b) = (stroke_series(&shape, SERIES_BELOW), stroke(&shape, SERIES_BELOW));
        for (series, closed) in [
            (a.contraction, b.contraction),
            (a.d_contraction, b.d_contraction),
            (a.volume, b.volume),
            (a.d_volume, b.d_volume),
            (a.lift, b.lift),
            (a.d_lift, b.d_lift),
        ] {
            assert!((series / closed - 1.0).abs() < 1e-9, "{series} {closed}");
        }
    }
}
