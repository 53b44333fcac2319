//! Processor time that was used; a browser does not say.

/// As many threads as asked for; 0: one per core.
pub(crate) fn threads(asked: usize) -> usize {
    let cores = || std::thread::available_parallelism().map_or(1, usize::from);
    if asked == 0 { cores() } else { asked }
}

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
