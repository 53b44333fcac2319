//! A law of the missing moment where the catalogue has none: the one of a small library that predicts pressures left out.
//!
//! ```text
//! M = f(κ, P, p_b, pull; x) + ε      x̂ = least squares under the covariance of the points
//! score(law)² = mean over pressure levels of  eᵀ Σ⁻¹ e / n      e: what the law, fitted without a level, misses there
//! ```
//!
//! The laws that predict moments best are fitted to the markers by the full model. Of these the one with the fewest numbers is
//! taken, unless another is closer to the markers at pressures left out by a fifth; no law at all is one of them.

mod choose;
mod library;
#[cfg(test)]
mod tests;

pub(crate) use choose::{MomentMaterial, Tried, rank, taken};
#[cfg(test)]
pub(crate) use library::{LIBRARY, Number};
pub(crate) use library::{LawFormula, PULL};
