//! Ovalisation: the bent body flattens, and the arm of the actuator with it.
//!
//! ```text
//! D = (D₀ + β·lift)/(1 + o g_r² (g/g_r)ⁿ)      g = ηε/(D₀ + β·lift): curvature of the round body at the same stroke
//! n = 2: the moment of the line on κ is N (D₀ + β·lift)/(1 + 3 o g²)
//! ```
//!
//! n is 2 for an elastic tube, 1 for an inflated one that dents under a line load. Written over g, κ is an explicit, rising function of the
//! stroke: an arm that shrinks as `D₀(1 − oκ²)`, the first order of the same law, lets κD fall again beyond `κ = 1/√(3o)` and has two
//! equilibria there. Brazier's elastic tube under pressure has `o = E t R³/(4 p R²)` before it wrinkles, and next to none after: a fitted o
//! is a number for a section that collapses between the pouches.

use super::entry::*;
use crate::site::SectionLaw;

/// Curvature g_r at which o is the flattening whatever the exponent \[1/m\].
const REFERENCE_PER_M: f64 = 2.0;

pub(super) const ENTRY: Effect = Effect {
    name: "ovalization",
    group: Group::Body,
    formula: "D = D₀/(1 + o g_r² (g/g_r)ⁿ), g = ηε/D₀, g_r = 2 /m;  n = 2: κ = g (1 + o g²)",
    sentence: "The bent body flattens, so the actuator sits closer to its far wall: shorter lever, more bend per stroke.",
    differs: "Less bend at low pressure than at high: the curve over pressure stays steep where others flatten.",
    remedy: "Measure the body's height at its middle, straight and fully bent; repeat at another body pressure.",
    validity: "o g² below about 1; body pressure moment of the round section",
    reference: "Brazier 1927 for the squared curvature; derived here",
    parameters: &[
        parameter("flattening_m2", "o", "m²", 1.0)
            .usual(0.02, [0.0, 0.5])
            .by_actuator(&[("spam", 0.07), ("epam", 0.014), ("cpam", 0.0078), ("fpam", 0.05)])
            .means("flattening per squared curvature, at 2 /m"),
        shape("exponent", "n", "-", 1.0).around(2.0, [0.5, 3.0]).means("exponent of the curvature"),
    ],
    add: |values, assembly| {
        for site in &mut assembly.sites {
            site.linkage.section = Some(SectionLaw { law: flattened, parameters: [values[0], values[1]] });
        }
    },
    ..BALANCE
};

/// κ = g (1 + o g_r² (g/g_r)ⁿ) and dκ/dg.
fn flattened([flattening_m2, exponent]: [f64; 2], g: f64) -> (f64, f64) {
    let flat = match exponent == 2.0 {
        true => flattening_m2 * g * g,
        false => flattening_m2 * REFERENCE_PER_M.powi(2) * (g.abs() / REFERENCE_PER_M).powf(exponent),
    };
    (g + flat * g, 1.0 + (1.0 + exponent) * flat)
}
