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

pub mod bench;
mod camera;
mod drive;
mod effects;
pub mod entry;
mod laws;
mod loads;
mod march;
mod measure;
mod poses;
mod reveal;
mod riddle;
mod robot;
mod root;
mod score;
mod seal;
mod supply;
mod tested;
pub mod truth;
mod wall;

#[cfg(test)]
mod tests;

pub use effects::{ALSO, HIDDEN, HiddenEffect, Laws, OUTSIDE};
pub use reveal::reveal;
pub use riddle::{Handout, Riddle};
pub use score::{Claim, ClaimScore, score};
pub use truth::{Draw, Hiding, Truth};
