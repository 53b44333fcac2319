//! fPAM: a tube of woven fabric cut at 45° to its yarns; a McKibben muscle without a separate braid.
//!
//! Yarns do not stretch, so the braid angle α follows the contraction, cosα = (1 − ε)/√2:
//!
//! ```text
//! r(ε) = r₀ √(2 − (1 − ε)²)                  tube radius, r₀ = W/π
//! v(ε) = π r₀² (2 − (1 − ε)²)(1 − ε)         volume per unit flat length
//! N(ε) = P dv/dε = P π r₀² (3(1 − ε)² − 2) = 2π P r₀² (3cos²α − 1)
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | ε | contraction; N = 0 at 1 − √(2/3) = 0.1835 | - |
//! | W, r₀ | flat width, radius of the round tube at 45° | m |
//! | P | actuator gauge pressure | Pa |
//!
//! **Validity**: long tube (L ≫ W), inextensible yarns, no fabric shear stiffness (that is the effect
//! `shear_stiffness`, which makes the free stroke depend on pressure). Reference: Chou & Hannaford 1996 (McKibben);
//! Naclerio & Hawkes 2020 (fPAM); the 45° form is derived here.

use super::pattern::{Film, Joint, Pattern, flat};
use super::{Actuator, ActuatorShape, Demand, Family, Stroke, converged};
use std::f64::consts::{FRAC_PI_4, PI};

pub(super) const ENTRY: Actuator = Actuator {
    name: "fpam",
    title: "fabric pneumatic artificial muscle",
    sentence: "A bias-cut fabric tube glued along the body: pressure shears the weave, the tube widens and shortens.",
    formula: "N = P π r₀² (3(1 − ε)² − 2);  r = r₀ √(2 − (1 − ε)²), r₀ = W/π;  arm = 2R + r₀ + β (r − r₀)",
    reference: "Chou & Hannaford 1996; Naclerio & Hawkes 2020; 45° form derived here",
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
    let mut pattern = flat(shape, Joint::Bonded { film: Film::Glue, warp_rad: -FRAC_PI_4 });
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

fn stroke(shape: &ActuatorShape, contraction: f64) -> Stroke {
    let length = 1.0 - contraction;
    let area = shape.volume_gain * PI * rest_radius(shape).powi(2);
    let spread = 2.0 - length * length;
    let radius = rest_radius(shape) * spread.sqrt();
    Stroke {
        contraction,
        d_contraction: 1.0,
        volume: area * spread * length,
        d_volume: area * (3.0 * length * length - 2.0),
        lift: radius - rest_radius(shape),
        d_lift: rest_radius(shape) * rest_radius(shape) * length / radius,
        weight: 1.0,
    }
}

/// Root of `3(1 − ε)² − 2 − m`, m the need at ε: the root of the quadratic of an arm at rest, then Newton.
fn guess(shape: &ActuatorShape, demand: &Demand) -> (f64, f64) {
    let (m0, m1) = (demand.constant.min(1.0), demand.per_contraction);
    let root = (m1 * m1 + 12.0 * (2.0 + m0 + m1)).sqrt();
    let (mut contraction, mut slope) = (1.0 - (root - m1) / 6.0, -root);
    if demand.growth == 0.0 {
        return (contraction, slope);
    }
    let mut last = 0.0;
    let (growth, demand) = (rest_radius(shape) * demand.growth, Demand { constant: m0, ..*demand });
    for _ in 0..6 {
        let length = 1.0 - contraction;
        let spread = (2.0 - length * length).sqrt();
        let per = 1.0 / spread;
        let lift = [growth * (spread - 1.0), growth * length * per, -2.0 * growth * per * per * per];
        let need = demand.need([contraction, 1.0, 0.0], lift);
        let by_contraction = -6.0 * length - need.slope;
        let step = (3.0 * length * length - 2.0 - need.value) / by_contraction;
        slope = by_contraction * need.lever;
        contraction -= step;
        if converged(step, last) {
            break;
        }
        last = step;
    }
    (contraction, slope)
}
