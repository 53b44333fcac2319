//! Fabric stretch: the actuator's own fabric gives way in tension and eats part of the stroke.
//!
//! ```text
//! κD = ηε − c N/W      E = ½ (c/W) N² per metre
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | c = 1/(E t) | compliance of the fabric; 2.3e-5 m/N for 215 MPa × 0.2 mm | m/N |
//! | N | line tension of the actuator | N |
//! | W | width that carries it | m |
//!
//! Validity: linear elastic, uniform over the width. Reference: the pressure correction of Niiyama et al. 2015 has the
//! same origin; this form is derived here.

use super::entry::*;

pub(super) const ENTRY: Effect = Effect {
    name: "fabric_stretch",
    group: Group::Actuator,
    formula: "κD = ηε − c N/W",
    sentence: "The actuator's fabric stretches under its own tension, so part of the stroke is lost; more at high force.",
    differs: "Most bend is missing where the actuator pulls hardest: it grows with both pressures.",
    remedy: "Take E t of the fabric from a tensile test along the body: c = 1/(E t).",
    validity: "linear elastic fabric; c from a tensile test is a prediction, a larger fitted c also holds seam slip",
    reference: "derived here; same origin as the correction of Niiyama et al. 2015",
    parameters: &[Parameter {
        key: "compliance_m_per_n",
        symbol: "c",
        unit: "m/N",
        typical: 8e-5,
        upper: 3e-4,
        meaning: "compliance 1/(E t) of the actuator's fabric",
        ..PLAIN
    }],
    needs: Needs::Actuator,
    add: |values, assembly| {
        for site in &mut assembly.sites {
            site.linkage.compliance_per_n += values[0] / site.shape.width_m;
        }
    },
    ..BALANCE
};
