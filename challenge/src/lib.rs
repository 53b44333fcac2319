//! Data with a hidden effect: a robot simulated by other laws than the diagnosing side has.
//!
//! ```text
//! Scenario ─► Robot (48 cells) ── HIDDEN / OUTSIDE effects put in ─► march in time ─► camera ─► scatter ─► Dataset
//! ```
//!
//! The base physics is the project's (pouch, body pressure, B, McKibben), written again and divided otherwise, so that
//! without a hidden effect the model is right up to discretisation; every hidden effect follows another law than the
//! catalogue's entry of the same name, as real robots do. There are two such laws of each, chosen by [`Laws`]. Quasi-static: at every instant each cell balances, with what it
//! remembers of friction, creep and set.

#![warn(unreachable_pub)]

pub mod bench;
pub mod camera;
pub mod drive;
pub mod effects;
pub mod entry;
mod laws;
pub mod loads;
pub mod march;
pub mod measure;
mod poses;
mod reveal;
pub mod riddle;
pub mod robot;
mod root;
pub mod score;
pub mod seal;
pub mod supply;
mod tested;
pub mod truth;
pub mod wall;

#[cfg(test)]
mod tests;

pub use effects::{ALSO, HIDDEN, HiddenEffect, Laws, OUTSIDE, by_name};
pub use measure::{Measurement, ideal, measure};
pub use reveal::reveal;
pub use riddle::{Handout, Riddle};
pub use robot::TrueRobot;
pub use score::{Claim, ClaimScore, score};
pub use truth::{Draw, Hiding, Truth};
