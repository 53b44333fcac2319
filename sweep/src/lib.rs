//! Many cases of one robot: any key of its scenario varied, the reduced model or finite elements asked, a row per case.
//!
//! ```text
//! study.toml ─► Study (axes, cases) ─► parts ─► reduced model or finite elements ─► parts/HASH.part ─► Table
//! ```
//!
//! A part is some cases that are computed together. Its file is named by the hash of all that its numbers depend on. So nothing is
//! computed twice, a killed sweep goes on where it was, and a shard is nothing but every N-th part.

mod axis;
mod columns;
pub mod design;
mod elements;
mod error;
mod form;
pub mod influence;
mod part;
pub mod pieces;
pub mod policy;
mod reduced;
mod run;
mod sample;
pub mod schedule;
mod study;
mod table;
#[cfg(test)]
mod tests;

pub use error::SweepError;
pub use fem::session::Shard;
pub use form::ReadRobot;
pub use run::{Found, Settings, parts_missing, run, there};
pub use study::{Axis, Engine, Output, PRESSURE, Study};
pub use table::{collect, names};
