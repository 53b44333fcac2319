//! Statistics held against simulated truth.

mod laboratory;
mod monte_carlo;
mod scenarios;
pub(crate) mod synthetic;
