//! What the product is held against.
//!
//! | module | holds |
//! |---|---|
//! | [`exact`] | closed forms, and their numbers as computed independently |
//! | [`checks`] | finite element problems with known answers |
//! | [`speed`] | what the speed of both engines is measured on |
//!
//! Uses the libraries as anybody would; none of them knows of it.

pub mod checks;
pub mod exact;
pub mod speed;
