//! Independent pieces of work, each with its own file.

use crate::SweepError;
use fem::FemError;
use fem::session::Progress;
use rayon::prelude::*;
use spelling::files::{clear, replace, sealed, unsealed};
use std::io::ErrorKind;
use std::ops::ControlFlow;
use std::path::Path;
use std::sync::Mutex;

/// Makes pieces in parallel on threads (0: one per core); the answers are in order. `progress` gets the name of the work and the
/// share that is done, and returns whether to go on.
///
/// # Errors
/// The error of `make`; [`FemError::Interrupted`] if `progress` asked to end.
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
            ControlFlow::Break(()) if done < pieces => Err(FemError::interrupted(done, pieces).into()),
            _ => Ok(made),
        }
    };
    let all = || (0..pieces).into_par_iter().map(one).collect();
    match rayon::ThreadPoolBuilder::new().num_threads(threads).build() {
        Ok(pool) => pool.install(all),
        Err(_) => all(),
    }
}

/// Writes the file of a piece, whole or not at all, with a checksum. Two workers may make the same piece: either file is right.
///
/// # Errors
/// The folder cannot be written to.
pub fn keep(path: &Path, bytes: Vec<u8>) -> Result<(), SweepError> {
    let bytes = sealed(bytes);
    replace(path, &mut |out| out.write_all(&bytes)).map_err(|cause| SweepError::unwritable(path, &cause))
}

/// The bytes that [`keep`] wrote; `None` without a file.
///
/// # Errors
/// A file that cannot be read, or whose bytes are not those that were written.
pub fn kept(path: &Path) -> Result<Option<Vec<u8>>, SweepError> {
    match std::fs::read(path) {
        Ok(bytes) => unsealed(&bytes).map(|whole| Some(whole.to_vec())).ok_or_else(|| SweepError::damaged(path)),
        Err(cause) if cause.kind() == ErrorKind::NotFound => Ok(None),
        Err(cause) => Err(SweepError::Damaged { path: path.to_path_buf(), cause: cause.to_string() }),
    }
}

/// A folder for pieces, without what killed workers of this machine left of theirs.
pub fn folder(path: &Path) -> Result<(), SweepError> {
    clear(path, &|_| true);
    std::fs::create_dir_all(path).map_err(|cause| SweepError::unwritable(path, &cause))
}
