//! Shear stiffness of the fabric of an fPAM: contracting shears the weave, and a coated weave resists.
//!
//! ```text
//! cosα = (1 − ε)/√2      γ = 2α − π/2      E = G_t γ² W per metre   (½ G_t γ² over the flat tube's two layers, 2W)
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | α | yarn angle to the axis, 45° at rest | rad |
//! | γ | shear angle | rad |
//! | G_t | shear modulus × thickness; 1/G = 4/E₄₅ − (1/E₀ + 1/E₉₀): 51.6 N/m for E₀, E₄₅, E₉₀ = 96.5, 4.05, 120 MPa, 50 µm | N/m |
//!
//! Makes the free stroke rise with pressure, which no ideal McKibben law does. Validity: linear in γ, below locking
//! (about 35–45°). Derived here; modulus relation of an orthotropic sheet at 45° with ν₁₂ ≈ 0.

use super::{Effect, Fitted, Group, POSITIVE, Parameter, Stage};
use crate::actuators::Family;
use crate::assembly::Assembly;
use crate::term::{Pose, Term, actuator_q};
use std::f64::consts::{FRAC_PI_2, SQRT_2};

pub(super) const ENTRY: Effect = Effect {
    name: "shear_stiffness",
    group: Group::Actuator,
    stage: Stage::Balance,
    history: false,
    formula: "E = G_t γ² W per metre, γ = 2α − π/2, cosα = (1 − ε)/√2",
    sentence: "The coated weave resists shearing, so the muscle contracts less, most at low pressure.",
    differs: "Most bend is missing at low pressure; the free stroke rises with pressure.",
    remedy: "Take G_t from a 45° tensile or bias-extension test of the fabric.",
    validity: "below shear locking (|γ| < 35°); linear",
    reference: "derived here; 1/G = 4/E45 − (1/E0 + 1/E90)",
    parameters: &[Parameter {
        key: "shear_n_per_m",
        symbol: "G_t",
        unit: "N/m",
        si: 1.0,
        neutral: 0.0,
        typical: 45.0,
        lower: 0.0,
        upper: 400.0,
        possible: POSITIVE,
        starts: &[],
        by_actuator: &[],
        fitted: Fitted::Always,
        in_room: false,
        meaning: "shear modulus times thickness of the fabric",
    }],
    family: Some(Family::Mckibben),
    add,
};

struct ShearStiffness {
    shear_n_per_m: f64,
    width_m: f64,
}

fn add(values: &[f64], assembly: &mut Assembly) {
    for site in assembly.active_sites(Family::Mckibben) {
        let width_m = site.shape.width_m;
        site.actuator_terms.push(Box::new(ShearStiffness { shear_n_per_m: values[0], width_m }));
    }
}

impl Term for ShearStiffness {
    fn name(&self) -> &'static str {
        ENTRY.name
    }

    fn add(&self, at: &Pose, force: &mut [f64]) -> f64 {
        let cos = (1.0 - at.q[actuator_q::CONTRACTION]) / SQRT_2;
        let shear = 2.0 * cos.acos() - FRAC_PI_2;
        // dα/dε = 1/(√2 sinα), dγ = 2 dα
        let d_shear = SQRT_2 / (1.0 - cos * cos).sqrt();
        let moment = 2.0 * self.shear_n_per_m * self.width_m * shear;
        force[actuator_q::CONTRACTION] -= moment * d_shear;
        0.5 * moment * shear
    }
}
