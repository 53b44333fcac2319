//! A beam without actuator, from a scenario without `[actuator]`. No stretch of it is active, so none of its laws is evaluated.

use super::actuator::{Actuator, Family, Stroke};
use super::pattern::{ChamberBottom, Pattern, flat};
use super::shape::ActuatorShape;

/// In a scenario without `[actuator]`; not in the list of actuators.
pub const BEAM: Actuator = Actuator {
    name: "beam",
    title: "inflated beam without actuator",
    sentence: "A body alone: loads and its own weight bend it.",
    formula: "-",
    reference: "-",
    validity: "no actuator",
    family: Family::Pouch,
    stroke: |_, _| Stroke {
        contraction: 0.0,
        d_contraction: 0.0,
        volume: 0.0,
        d_volume: 0.0,
        lift: 0.0,
        d_lift: 0.0,
        weight: 1.0,
    },
    range: (0.0, 0.0),
    guess: |_, _| (0.0, 0.0),
    area: |_| 0.0,
    arm: |radius_m, _| 2.0 * radius_m,
    edge_restraint: |_| 0.0,
    pattern: |shape: &ActuatorShape| Pattern { panels: Vec::new(), ..flat(shape, ChamberBottom::Wall) },
};
