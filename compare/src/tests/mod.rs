//! Noise model and diagnosis compared with the truth of simulated data.

mod laboratory;
mod monte_carlo;
mod scenarios;
pub(crate) mod synthetic;
