//! The actuators: one file each, one line in [`ACTUATORS`].
//!
//! An actuator states its **stroke law**: how contraction, volume and the lift of its line of action follow from one
//! coordinate. Everything else (pressure work, arm, body, effects) is common.

mod actuator;
mod beam;
mod cpam;
mod epam;
mod fpam;
pub mod pattern;
pub mod pouch;
mod shape;
mod spam;

/// The list: what `ibr list`, the scenarios, the tests and the benches know.
pub const ACTUATORS: &[Actuator] = &[spam::ENTRY, cpam::ENTRY, epam::ENTRY, fpam::ENTRY];

pub use actuator::{Actuator, Demand, Family, Stroke};
pub use beam::BEAM;
pub use shape::{ActuatorShape, BIAS};

/// Finds an actuator of [`ACTUATORS`] by its name in scenarios; `None` if there is none.
pub fn by_name(name: &str) -> Option<&'static Actuator> {
    ACTUATORS.iter().find(|a| a.name == name)
}
