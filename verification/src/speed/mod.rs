//! Speed of the model, of the finite elements and of a diagnosis on this machine, beside what is wanted.

pub mod discovery;
pub mod engine;
pub mod model;
pub mod plain_loop;
pub mod workloads;

/// Processor seconds of this process, all threads.
pub(crate) fn cpu_seconds() -> f64 {
    cpu_time::ProcessTime::try_now().map_or(0.0, |t| t.as_duration().as_secs_f64())
}
