//! Processor time that was used; a browser does not say.

/// Processor seconds of the calling thread; 0 where the system does not say.
pub fn thread_seconds() -> f64 {
    #[cfg(not(target_family = "wasm"))]
    let spent = cpu_time::ThreadTime::try_now().map_or(0.0, |t| t.as_duration().as_secs_f64());
    #[cfg(target_family = "wasm")]
    let spent = 0.0;
    spent
}

/// Processor seconds of this process, all threads; 0 where the system does not say.
pub fn process_seconds() -> f64 {
    #[cfg(not(target_family = "wasm"))]
    let spent = cpu_time::ProcessTime::try_now().map_or(0.0, |t| t.as_duration().as_secs_f64());
    #[cfg(target_family = "wasm")]
    let spent = 0.0;
    spent
}
