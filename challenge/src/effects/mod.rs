//! The hidden effects: one entry each; the laws stand in `drive`, `wall`, `loads`, `supply` and `camera`.
//!
//! The catalogue of `models` gives the names, so that a diagnosis can be scored; the laws are others on purpose. Each
//! mechanism has two, and [`Laws`] selects one for a robot. A *typical size* is set by what the effect does to the
//! markers under the standard protocol; it was set before any diagnosis of these data and is not tuned on one. The typical
//! size of a second law follows from the first's: it moves the markers as far ([`HiddenEffect::typical`]).

mod hidden;
mod kind;
mod others;
mod size;
#[cfg(test)]
mod tests;

pub use crate::laws::Laws;
pub use hidden::HIDDEN;
pub use kind::HiddenEffect;
pub use others::{ALSO, OUTSIDE};

pub(crate) fn by_name(name: &str) -> Option<&'static HiddenEffect> {
    HIDDEN.iter().chain(ALSO).chain(OUTSIDE).find(|effect| effect.name == name)
}
