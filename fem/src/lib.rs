//! The explicit finite element engine of `ibr`.
//!
//! **Not built yet: this crate computes nothing.** It exists so that the workspace, the dependency arrows
//! (`fem` → `models`, never a measurement) and the build are those of the finished suite. When it comes, an FE run will be
//! a list of [`models::Term`]s over node positions, with the same energy ledger as the reduced model.

/// What `ibr` says when asked for the engine.
pub const STATUS: &str = "the finite element engine is not part of this release";

/// The interface that finite element terms will implement, over node positions.
pub use models::Term;
