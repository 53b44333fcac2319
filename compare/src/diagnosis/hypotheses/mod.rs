//! Hypotheses: what may be missing, how it is fitted, and how hypotheses are ordered.

pub mod candidates;
pub mod detect;
pub mod evaluator;
pub mod heldout;
pub mod interval;
pub mod known;
pub mod order;
pub mod pairs;
pub mod problem;
pub mod screen;
pub mod singles;
