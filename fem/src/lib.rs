//! The explicit finite element engine of `ibr`: thin inflated fabric with buckling and contact.
//!
//! A [`Problem`] describes the model (mesh, fabrics, chambers, supports, loads, settings); a [`Simulation`] steps it
//! through time by central differences with lumped masses. A run is a list of [`Transient`] terms over the node positions
//! `[x₀, y₀, z₀, 0, x₁, …]` ([`NODE`] numbers per node, the fourth is padding for the vector units), and keeps the same
//! energy ledger as the reduced model: nothing is simulated that is not on the balance.
//!
//! | module | holds |
//! |---|---|
//! | [`mesh`] | nodes, parts, sets; generators; mesh files; quality and closedness checks |
//! | [`problem`] | what a run needs besides the mesh |
//! | [`sheet`] | shells: membrane, hourglass control, viscosity, bending, follower pressure; the fast kernels |
//! | [`terms`] | nodal force, gravity, obstacles, rest curvature, tension-only yarns: the other entries of the list |
//! | [`contact`] | node-to-face contact with side memory and Coulomb friction |
//! | [`robot`] | robots from scenarios and sewing patterns |
//! | [`run`] | time stepping, stable step, ledger, guards |
//! | [`session`] | a run, or several, from text to typed result: folder, checkpoints, cache |
//! | [`record`] | files that are written and read again, with their version |
//! | [`case`] | the TOML file that describes a run |
//!
//! `fem` never sees a measurement.

mod amplitude;
mod bytes;
pub mod case;
pub mod contact;
pub mod cost;
pub mod error;
pub mod mesh;
mod output;
mod policy;
pub mod problem;
mod random;
pub mod record;
pub mod robot;
pub mod run;
pub mod session;
#[cfg(test)]
mod shared_tests;
pub mod sheet;
pub mod terms;
mod transient;
pub mod vec3;

pub use case::DeclaredKey;
pub use error::FemError;
pub use mesh::{Mesh, Part};
pub use problem::Problem;
pub use run::Simulation;
pub use transient::{Tick, Transient};

/// What a call gives, or why it was refused.
pub type Result<T, E = FemError> = std::result::Result<T, E>;

/// Raised whenever the same problem gives other numbers than before: stored results of an older engine are then not used.
pub const ENGINE: u32 = 11;

/// Numbers per node in position, velocity and force arrays: x, y, z and one of padding (always 0).
pub const NODE: usize = 4;
