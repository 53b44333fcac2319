//! Fabric stretch: the actuator's own fabric gives way in tension and eats part of the stroke.
//!
//! N is the line tension of the actuator and W the width that carries it, `E = ½ (c/W) N²` per metre. c = 2.3e-5 m/N for 215 MPa × 0.2 mm.

use super::entry::*;

pub(super) const ENTRY: Effect = Effect {
    name: "fabric_stretch",
    formula: "κD = ηε − c N/W",
    sentence: "The actuator's fabric stretches under its own tension, so part of the stroke is lost; more at high force.",
    differs: "Most bend is missing where the actuator pulls hardest: it grows with both pressures.",
    remedy: "Take E t of the fabric from a tensile test along the body: c = 1/(E t).",
    validity: "linear elastic fabric; c from a tensile test is a prediction, a larger fitted c also holds seam slip",
    reference: "derived here; same origin as the correction of Niiyama et al. 2015",
    parameters: &[parameter("compliance_m_per_n", "c", "m/N", 1.0)
        .usual(8e-5, [0.0, 3e-4])
        .means("compliance 1/(E t) of the actuator's fabric")],
    needs: Needs::Actuator,
    add: |values, assembly| {
        for site in &mut assembly.sites {
            site.linkage.compliance_per_n += values[0] / site.shape.width_m;
        }
    },
    ..BALANCE
};
