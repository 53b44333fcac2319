//! The missing moment of a diagnosis, and the law that is learned from it.

pub mod learned;
pub mod missing;
