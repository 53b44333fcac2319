//! The missing moment of a diagnosis, and the law that is learned from it.

pub(super) mod learned;
pub(super) mod missing;
