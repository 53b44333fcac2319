//! The references that the product is compared with.
//!
//! | module | holds |
//! |---|---|
//! | [`exact`] | closed forms, and their numbers as computed independently |
//! | [`checks`] | finite element problems with known answers |
//! | [`speed`] | the speed of both engines and of a diagnosis, and how often that is right |
//!
//! Uses the libraries as anybody would; none of them knows of it.

pub mod checks;
mod cost;
pub mod exact;
mod findings;
pub mod speed;

pub use findings::{Error, Findings, Printed};
