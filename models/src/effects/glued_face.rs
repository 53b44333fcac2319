//! Glued face: half of a fabric muscle is stuck to the body's wall, whose yarns along and across hold it.
//!
//! ```text
//! xᵤ = y − κh,  xₗ = y + κh,  h = 2r/π      lengths of the free and the glued half, y of the axis, per flat length
//! ```
//!
//! e is the Green strain of the glued half around the tube. The wall's yarns across keep that half from widening, those along from
//! lengthening; along the body it may fold. So only the free half shears, and a muscle that is glued over its whole width shortens a quarter
//! as much as a free one. [`crate::muscle`] has the law. A muscle that is glued along a line, or hangs in loops, has none of it.

use super::entry::*;

pub(super) const ENTRY: Effect = Effect {
    name: "glued_face",
    formula: "E += ½K e² + ½K ((xₗ² − 1)/2)₊² per metre and width of the glued half",
    sentence: "Half of the muscle is stuck to the wall of the body, whose yarns keep that half from shearing.",
    differs: "Most bend is missing at every pressure, as if the muscle were weaker.",
    remedy: "Take E t of the body along its yarns from tensile tests; look whether the muscle is glued over its whole width.",
    validity: "glued over the whole flat width to a wall with yarns along and across",
    reference: "derived here",
    parameters: &[parameter("wall_n_per_m", "K", "N/m", 1.0)
        .usual(5400.0, [0.0, 3e4])
        .fitted(Fitted::FromDesign)
        .means("E t of the wall along its yarns")],
    needs: Needs::Family(Family::Mckibben),
    add: |values, assembly| {
        for site in assembly.active_sites(Family::Mckibben) {
            site.weave.wall_n_per_m = values[0];
        }
    },
    ..BALANCE
};
