//! Progress of a run, and numbers without noise.

use std::ops::ControlFlow;

/// Told what is being done and, if known, which share of the whole is done, some times a second; says whether to go on.
pub type Progress<'a> = &'a mut (dyn FnMut(&str, Option<f64>) -> ControlFlow<()> + Send);

/// Without the digits that a change of unit leaves behind.
pub fn rounded(value: f64) -> f64 {
    format!("{value:.9e}").parse().unwrap_or(value)
}
