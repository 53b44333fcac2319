//! The native part of the Python package `ibr`: every call is one of the library `ibr`, with kPa, mm and degrees outside and numpy
//! arrays for lists. It holds no physics and decides nothing; `python/ibr/` gives results their Python form.

mod answers;
mod arrays;
mod errors;
mod foreign;
mod inputs;
mod progress;
mod runs;
mod scenario;
mod source;
mod states;
mod sweeps;

use pyo3::prelude::*;

/// Native calls of the package `ibr`.
#[pymodule]
mod _ibr {
    #[pymodule_export]
    use super::answers::{Answer, add, ask, compare, diagnose, extend, ladder, validate};
    #[pymodule_export]
    use super::errors::Error;
    #[pymodule_export]
    use super::foreign::{Base, Correction, validate_correction};
    #[pymodule_export]
    use super::inputs::{Data, import_tracks};
    #[pymodule_export]
    use super::program;
    #[pymodule_export]
    const VERSION: &str = env!("CARGO_PKG_VERSION");
    #[pymodule_export]
    use super::runs::{read_run, simulate};
    #[pymodule_export]
    use super::scenario::Scenario;
    #[pymodule_export]
    use super::states::State;
    #[pymodule_export]
    use super::sweeps::sweep;
}

/// The command line: runs what was typed and returns the exit code. It takes over Ctrl-C.
#[pyfunction]
fn program(py: Python<'_>, typed: Vec<std::ffi::OsString>) -> u8 {
    py.detach(|| ibr::program::run(typed))
}
