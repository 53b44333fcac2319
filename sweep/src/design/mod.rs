//! The design for a target shape: the search varies the free keys until the reduced model meets the wish.
//!
//! ```text
//! min over the free keys x in their ranges:   Σ (rᵢ(x) / (t L))²  +  w_p (P / P_max)²  +  w_f A / A₀  +  w_r (ΔT / (t L))²
//! ```
//!
//! | symbol | meaning |
//! |---|---|
//! | rᵢ | a miss \[m\]: a distance, or an angle times L |
//! | t, L | tolerance, and length of the body |
//! | P, P_max | largest pressure of the design and of the scenario |
//! | A, A₀ | flat area of the actuator, of the design and of the scenario |
//! | ΔT | half of how far the tip moves over the assumed numbers \[m\] |
//!
//! Finite elements of a design correct the model for the next search ([`Rounds`]): space mapping with an additive term, as in
//! J. W. Bandler and others. Let m be the model's numbers, f the finite element numbers and xₖ the last design. The search then uses
//! m(x) + f(xₖ) − m(xₖ) in place of m(x). It adds the cost Σ (xⱼ − xₖⱼ)² over shares of the ranges, because the term is valid near xₖ only.
//!
//! Solved with the simplex of Nelder and Mead (argmin) from many Sobol points; lists stay at the entry of their point.

mod misses;
mod rounds;
mod search;
#[cfg(test)]
mod tests;
mod wish;

pub use misses::{Miss, misses_of_reading};
pub use rounds::{Checked, Round, Rounds, StopReason};
pub use search::{Design, Held, Spread, design};
pub use wish::{Cost, TargetPlace, TargetTurn, Wanted, Wish};
