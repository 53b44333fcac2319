//! Statistics held against simulated truth.

mod monte_carlo;
mod scenarios;
pub mod synthetic;
