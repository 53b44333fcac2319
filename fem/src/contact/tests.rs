//! Contact against its laws, and in small explicit runs of nodes and springs.

mod hand_over;
mod laws;
pub(crate) mod rig;
mod runs;
mod start;
