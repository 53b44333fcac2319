//! Results in words: text tables, nothing decided.

pub mod breakdown;
pub mod engines;
pub mod held;
pub mod paper;
