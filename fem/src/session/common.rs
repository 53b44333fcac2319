//! Progress of a run, and numbers without noise.

use std::ops::ControlFlow;

/// Receives the current step and, if known, the finished share of the whole, some times a second; returns whether to continue.
pub type Progress<'a> = &'a mut (dyn FnMut(&str, Option<f64>) -> ControlFlow<()> + Send);

/// Without the digits that a change of unit leaves behind.
///
/// ```
/// assert_eq!(fem::session::rounded(0.1 + 0.2), 0.3);
/// ```
pub fn rounded(value: f64) -> f64 {
    format!("{value:.9e}").parse().unwrap_or(value)
}
