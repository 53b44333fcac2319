//! fPAM: a tube of woven fabric cut at an angle to its yarns; a McKibben muscle without a separate braid.
//!
//! Yarns do not stretch, so the braid angle α follows the contraction, cosα = (1 − ε) cosα₀:
//!
//! ```text
//! r(ε) = r₀ sinα/sinα₀ = r₀ √(j − k (1 − ε)²)      tube radius, r₀ = W/π, j = 1/sin²α₀, k = cot²α₀
//! v(ε) = π r₀² (j − k (1 − ε)²)(1 − ε)             volume per unit flat length
//! N(ε) = P dv/dε = P π r₀² (3k (1 − ε)² − j) = P π r₀² (3cos²α − 1)/sin²α₀
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | ε | contraction; N = 0 at cosα = 1/√3 (54.7°), which is 1 − √(2/3) = 0.1835 for 45° | - |
//! | α₀ | angle of both yarn families to the axis at rest, `bias_deg`; 45° has j = 2, k = 1 | rad |
//! | W, r₀ | flat width, radius of the round tube at rest | m |
//! | P | actuator gauge pressure | Pa |
//!
//! **Validity**: long tube (L ≫ W), inextensible yarns (the effect `yarn_stretch` lets them give), no fabric shear stiffness
//! (that is `shear_stiffness`, which makes the free stroke depend on pressure), yarns at +α₀ and −α₀: an orthogonal weave
//! cut off 45° has them at α₀ and α₀ − 90° and twists as well, see `verification::exact::tube`. Reference: Chou & Hannaford 1996
//! (McKibben); Naclerio & Hawkes 2020 (fPAM); the form over the contraction is derived here.

use super::actuator::{Actuator, Demand, Family, Stroke, converged};
use super::pattern::{ChamberBottom, Film, Pattern, flat};
use super::shape::ActuatorShape;
use std::f64::consts::{FRAC_PI_4, PI};

pub(super) const ENTRY: Actuator = Actuator {
    name: "fpam",
    title: "fabric pneumatic artificial muscle",
    sentence: "A bias-cut fabric tube glued along the body: pressure shears the weave, the tube widens and shortens.",
    formula: "N = P π r₀² (3k(1 − ε)² − j);  r = r₀ √(j − k(1 − ε)²), r₀ = W/π, j = 1/sin²α₀, k = cot²α₀;  arm = 2R + r₀ + β (r − r₀)",
    reference: "Chou & Hannaford 1996; Naclerio & Hawkes 2020; form over the contraction derived here",
    validity: "Long tube, inextensible yarns; needs shear_stiffness for a real coated fabric.",
    family: Family::Mckibben,
    stroke,
    range: (-0.25, 0.6),
    guess,
    area: |shape| shape.volume_gain * PI * rest_radius(shape).powi(2),
    arm: |radius_m, shape| 2.0 * radius_m + rest_radius(shape),
    edge_restraint: |_| 1.0,
    pattern,
};

/// Published: cut at 45° and glued with silicone (Sil-Poxy). Assumed: glued over its flat width, warp in one helix round
/// the tube, and a body of the same fabric with its yarns along and across: the paper names TPU-coated bodies for the
/// other three only, its glued surface is silicone-coated nylon and glue alone, and silicone glue holds on silicone.
fn pattern(shape: &ActuatorShape) -> Pattern {
    // Seen from outside the body, the underside of a helix turns the other way.
    let mut pattern = flat(shape, ChamberBottom::Bonded { film: Film::Glue, warp_rad: -FRAC_PI_4 });
    pattern.fabric = "silicone-nylon";
    pattern.body_fabric = "silicone-nylon";
    pattern.side_welds = false;
    pattern.panels[0].warp_rad = FRAC_PI_4;
    pattern
}

/// Radius r₀ = W/π of the round tube at rest \[m\].
fn rest_radius(shape: &ActuatorShape) -> f64 {
    shape.width_m / PI
}

fn braid(shape: &ActuatorShape) -> [f64; 2] {
    let [cos2, sin2] = shape.bias_squares();
    [1.0 / sin2, cos2 / sin2]
}

fn stroke(shape: &ActuatorShape, contraction: f64) -> Stroke {
    let length = 1.0 - contraction;
    let area = shape.volume_gain * PI * rest_radius(shape).powi(2);
    let [j, k] = braid(shape);
    // Pulled straight, the yarns would lie along the axis: the search for an equilibrium looks no further.
    let spread = (j - k * (length * length)).max(STRAIGHT);
    let radius = rest_radius(shape) * spread.sqrt();
    Stroke {
        contraction,
        d_contraction: 1.0,
        volume: area * spread * length,
        d_volume: area * (3.0 * length * length * k - j),
        lift: radius - rest_radius(shape),
        d_lift: rest_radius(shape) * rest_radius(shape) * length * k / radius,
        weight: 1.0,
    }
}

/// Least (r/r₀)²: keeps the radius real beyond the length of straight yarns.
const STRAIGHT: f64 = 1e-6;

/// Root of `3k(1 − ε)² − j − m`, m the need at ε: the root of the quadratic of an arm at rest, then Newton.
fn guess(shape: &ActuatorShape, demand: &Demand) -> (f64, f64) {
    let (m0, m1) = (demand.constant.min(1.0), demand.per_contraction);
    let [j, k] = braid(shape);
    let root = (m1 * m1 + 12.0 * k * (j + m0 + m1)).sqrt();
    let (mut contraction, mut slope) = (1.0 - (root - m1) / (6.0 * k), -root);
    if demand.growth == 0.0 {
        return (contraction, slope);
    }
    let mut last = 0.0;
    let (growth, demand) = (rest_radius(shape) * demand.growth, Demand { constant: m0, ..*demand });
    for _ in 0..6 {
        let length = 1.0 - contraction;
        let spread = (j - k * (length * length)).max(STRAIGHT).sqrt();
        let per = 1.0 / spread;
        let lift = [growth * (spread - 1.0), growth * length * k * per, -growth * j * k * per * per * per];
        let need = demand.need([contraction, 1.0, 0.0], lift);
        let by_contraction = -6.0 * length * k - need.slope;
        let step = (3.0 * length * length * k - j - need.value) / by_contraction;
        slope = by_contraction * need.lever;
        contraction -= step;
        if converged(step, last) {
            break;
        }
        last = step;
    }
    (contraction, slope)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn muscle(bias_deg: f64) -> ActuatorShape {
        let bias_rad = bias_deg.to_radians();
        ActuatorShape { length_m: 0.3, width_m: 0.06, fold_m: 0.0, volume_gain: 1.0, bias_rad }
    }

    #[test]
    fn the_guess_meets_its_demand_at_any_bias_angle() {
        for bias_deg in [30.0, 45.0, 52.0] {
            for (constant, per_contraction, growth) in [(0.0, 0.0, 0.0), (0.3, 2.0, 0.0), (0.3, 2.0, 5.0)] {
                let (shape, demand) = (muscle(bias_deg), Demand { constant, per_contraction, growth });
                let (at, _) = guess(&shape, &demand);
                let s = stroke(&shape, at);
                let arm = 1.0 + growth * s.lift;
                let need = (constant + per_contraction * at / arm) * (1.0 - at * growth * s.d_lift / arm) / arm;
                let left = s.d_volume / (PI * rest_radius(&shape).powi(2)) - need;
                assert!(left.abs() < 1e-12, "{bias_deg} {demand:?}: {left:e}");
            }
        }
    }
}
