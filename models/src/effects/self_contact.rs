//! Neighbouring pouches touch and block each other.
//!
//! The arcs leave a seam at angle θ from their chords; with chords at angle κ₀L₀ to each other they touch when
//! 2θ + κ₀L₀ = φ. Arcs that meet in a line have φ = π; welds with a stiff rim and ends folded up like a pillow's touch
//! earlier, a gap between the pouches makes it later. Past that a penalty acts per pouch:
//!
//! ```text
//! E = ½ k (2θ + κ₀L₀ − φ)₊² / L₀ per metre
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | θ | half arc angle | rad |
//! | κ₀ | curvature of inextensible fabric, ηε/D | 1/m |
//! | φ | angle at which neighbours touch; π without rim and gap | rad |
//! | k | contact stiffness of one pouch; large k is a hard stop | N·m/rad |
//!
//! Validity: pouches side by side; φ = π is derived here, another value is to be seen on the robot or fitted.

use super::{Effect, Group, Parameter, Stage};
use crate::actuators::Family;
use crate::assembly::Assembly;
use crate::term::{Pose, Term, actuator_q};
use std::f64::consts::PI;

pub(super) const ENTRY: Effect = Effect {
    name: "self_contact",
    group: Group::Actuator,
    stage: Stage::Balance,
    history: false,
    formula: "E = ½ k (2θ + κL₀ − φ)₊²/L₀ per metre",
    sentence: "Neighbouring pouches press on each other and stop the bend.",
    differs: "The bend stops at a value that no further pressure exceeds.",
    remedy: "Look at the side view at full pressure: do the pouches touch?",
    validity: "pouches side by side; k → large is a hard stop",
    reference: "derived here",
    parameters: &[
        Parameter {
            key: "stiffness_nm_per_rad",
            symbol: "k",
            unit: "N m/rad",
            si: 1.0,
            neutral: 0.0,
            typical: 20.0,
            lower: 0.0,
            upper: 1000.0,
            starts: &[1.0, 20.0, 300.0],
            by_actuator: &[],
            meaning: "contact stiffness of one pouch",
        },
        Parameter {
            key: "touch_rad",
            symbol: "φ",
            unit: "rad",
            si: 1.0,
            neutral: PI,
            typical: PI,
            lower: 0.5,
            upper: 4.0,
            starts: &[1.0, 1.6, 2.2, 2.7, 3.3],
            by_actuator: &[],
            meaning: "angle at which neighbours touch",
        },
    ],
    family: Some(Family::Pouch),
    add,
};

struct SelfContact {
    stiffness: f64,
    touch: f64,
    length_m: f64,
}

fn add(values: &[f64], assembly: &mut Assembly) {
    for site in assembly.active_sites(Family::Pouch) {
        let length_m = site.shape.length_m;
        site.actuator_terms.push(Box::new(SelfContact { stiffness: values[0], touch: values[1], length_m }));
    }
}

impl Term for SelfContact {
    fn name(&self) -> &'static str {
        ENTRY.name
    }

    fn add(&self, at: &Pose, force: &mut [f64]) -> f64 {
        let turned = 2.0 * at.q[actuator_q::COORDINATE] + at.q[actuator_q::CURVATURE] * self.length_m;
        let overlap = (turned - self.touch).max(0.0);
        let moment = self.stiffness * overlap / self.length_m;
        force[actuator_q::COORDINATE] -= 2.0 * moment;
        force[actuator_q::CURVATURE] -= self.length_m * moment;
        0.5 * moment * overlap
    }
}
