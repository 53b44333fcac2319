//! Speed of the model, of the finite elements and of a diagnosis on this machine, compared with their targets.

pub mod discovery;
pub mod engine;
pub mod model;
pub mod plain_loop;
pub mod workloads;
