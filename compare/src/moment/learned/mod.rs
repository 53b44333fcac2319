//! A law of the missing moment where the catalogue has none: the one of a small library that predicts pressures left out.
//!
//! ```text
//! M = f(κ, P, p_b, pull; x) + ε      x̂ = least squares under the covariance of the points
//! score(law) = mean over pressure levels of  eᵀ Σ⁻¹ e / n      e: what the law, fitted without a level, misses there
//! ```
//!
//! Of the laws whose score lies within one standard error of the best, over levels, the one with the fewest numbers is taken;
//! no law at all is one of them.

mod choose;
mod library;
#[cfg(test)]
mod tests;

pub use choose::{Choice, Material, Tried, choose};
pub use library::{Form, LIBRARY, Number};
