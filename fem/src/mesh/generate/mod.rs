//! Structured meshes of the standard shapes.
//!
//! Every generator names its node sets, winds its elements counter-clockwise seen from the front, and returns a mesh that
//! passes [`super::check::check`] for the chambers it names. Shapes are stress free unless the generator names a start shape.
//! Node sets of all: `docs/case.md`; of [`folded_pouch`], which is not a generator of cases, its own page.

mod disc;
mod folded_pouch;
mod grid;
mod layers;
mod plate;
mod sphere;
mod tube;

pub use disc::disc_balloon;
pub use folded_pouch::{FoldedPouch, folded_pouch};
pub use layers::{flat_tube, long_pouch, pillow};
pub use plate::{Distortion, crossed_sheets, plate};
pub use sphere::sphere;
pub use tube::{Around, Cap, Tube, tube};

use crate::policy;
use crate::{FemError, Result};

/// Refuses a length that is not a positive number.
fn positive(what: &str, name: &str, value: f64) -> Result<()> {
    if value.is_finite() && value > 0.0 {
        return Ok(());
    }
    Err(FemError::Mesh(format!("{what}: {name} is {value}, and must be a positive length in metres")))
}

/// Refuses a count of elements below `least`.
fn at_least(what: &str, name: &str, value: usize, least: usize) -> Result<()> {
    if value >= least {
        return Ok(());
    }
    Err(FemError::Mesh(format!("{what}: {name} is {value}, and must be at least {least}")))
}

/// Refuses odd counts, because a named point would fall between nodes.
fn even(what: &str, name: &str, value: usize) -> Result<()> {
    if value >= 2 && value.is_multiple_of(2) {
        return Ok(());
    }
    Err(FemError::Mesh(format!("{what}: {name} is {value}, and must be even so that a node is in the middle")))
}

fn few_enough(what: &str, a: usize, b: usize) -> Result<()> {
    if a.saturating_add(1).saturating_mul(b.saturating_add(1)) <= policy::MOST_NODES {
        return Ok(());
    }
    Err(FemError::Mesh(format!("{what}: {a} by {b} elements is more than {} nodes; use fewer", policy::MOST_NODES)))
}

#[cfg(test)]
mod tests;
