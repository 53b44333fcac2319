//! Pieces of work that do not depend on each other, each with a file of its own.

use crate::SweepError;
use fem::FemError;
use fem::session::Progress;
use rayon::prelude::*;
use std::ops::ControlFlow;
use std::path::Path;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Files that this process has begun.
static UNDER_WAY: AtomicUsize = AtomicUsize::new(0);

/// Makes pieces beside each other on threads (0: one per core); the answers are in order. `progress` is told what is made and how far
/// it is, and says whether to go on.
///
/// # Errors
/// What `make` says; [`FemError::Interrupted`] if `progress` asked to end.
pub fn beside<T: Send>(
    pieces: usize,
    threads: usize,
    what: &str,
    progress: Progress,
    make: &(dyn Fn(usize) -> Result<T, SweepError> + Sync),
) -> Result<Vec<T>, SweepError> {
    let told = Mutex::new((0_usize, progress));
    let one = |piece: usize| -> Result<T, SweepError> {
        let made = make(piece)?;
        let mut told = told.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
        told.0 += 1;
        let done = told.0;
        match (told.1)(what, Some(done as f64 / pieces as f64)) {
            ControlFlow::Break(()) if done < pieces => {
                Err(FemError::Interrupted { time_s: 0.0, step: 0, done, of: pieces }.into())
            }
            _ => Ok(made),
        }
    };
    let all = || (0..pieces).into_par_iter().map(one).collect();
    match rayon::ThreadPoolBuilder::new().num_threads(threads).build() {
        Ok(pool) => pool.install(all),
        Err(_) => all(),
    }
}

/// Writes the file of a piece, whole or not at all. Two workers may make the same piece: either file is right.
///
/// # Errors
/// The folder cannot be written to.
pub fn keep(path: &Path, bytes: &[u8]) -> Result<(), SweepError> {
    let number = UNDER_WAY.fetch_add(1, Ordering::Relaxed);
    let partial = path.with_extension(format!("{}-{number}.partial", std::process::id()));
    let written = std::fs::write(&partial, bytes).and_then(|()| std::fs::rename(&partial, path));
    written.map_err(|cause| {
        let _ = std::fs::remove_file(&partial);
        SweepError::unwritable(path, &cause)
    })
}

/// A folder for pieces.
///
/// # Errors
/// It cannot be made.
pub fn folder(path: &Path) -> Result<(), SweepError> {
    std::fs::create_dir_all(path).map_err(|cause| SweepError::unwritable(path, &cause))
}
