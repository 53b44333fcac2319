//! Laws that every actuator, effect and term obeys; one file per subject.

#![allow(clippy::unwrap_used)]

mod base;
mod batch;
mod beams;
mod catalogue;
mod forces;
mod full;
mod gases;
mod held;
mod history;
mod instruments;
mod inverse;
mod inverse_bounds;
mod kinematics;
mod linear;
mod neutral;
mod order;
mod random_inverse;
mod scaling;
mod shapes;
mod solver;
mod statics;
mod stationary;
mod steer;
mod support;
mod tables;
mod tip_stiffness;
mod zones;
