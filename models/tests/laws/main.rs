//! Laws that every actuator, effect and term obeys; one file per subject.

#![allow(clippy::unwrap_used)]

mod base;
mod batch;
mod beams;
mod catalogue;
mod forces;
mod full;
mod held;
mod history;
mod inverse;
mod inverse_bounds;
mod linear;
mod neutral;
mod random_inverse;
mod scaling;
mod shapes;
mod solver;
mod stationary;
mod steer;
mod support;
mod tables;
mod zones;
