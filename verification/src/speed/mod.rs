//! Speed of the model, of the finite elements and of a diagnosis on this machine, beside what is wanted.

pub mod discovery;
pub mod engine;
pub mod model;
pub mod plain_loop;
pub mod workloads;
