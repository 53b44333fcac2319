//! Hypotheses: what may be missing, how it is fitted, and how hypotheses are ordered.

pub(super) mod candidates;
pub(super) mod detect;
pub(super) mod evaluator;
pub(super) mod heldout;
pub(super) mod interval;
pub(super) mod known;
pub(super) mod order;
pub(super) mod pairs;
pub(super) mod problem;
pub(super) mod screen;
pub(super) mod singles;
