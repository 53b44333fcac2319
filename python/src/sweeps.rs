use crate::arrays::columns;
use crate::errors::{Told, raised};
use crate::progress::beside;
use ibr::Error;
use ibr::studies::scenario;
use ibr::sweep::{Settings, Shard, Study, SweepError, collect, run};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::path::{Path, PathBuf};

impl From<SweepError> for Told {
    fn from(error: SweepError) -> Told {
        let help = error.help();
        match error {
            SweepError::Study(error) => error.into(),
            SweepError::Run(error) => error.into(),
            other => Error::refused(other.to_string(), help).into(),
        }
    }
}

/// `ibr sweep`: the table as a dictionary of arrays. A study with a line break is its text, else its file.
#[pyfunction]
#[pyo3(signature = (study, folder, threads, progress = None))]
pub(crate) fn sweep<'py>(
    py: Python<'py>,
    study: String,
    folder: PathBuf,
    threads: usize,
    progress: Option<Py<PyAny>>,
) -> PyResult<Bound<'py, PyDict>> {
    let study = match study.contains('\n') {
        true => Study::parse("study", &study, Path::new(""), scenario),
        false => Study::read(Path::new(&study), scenario),
    }
    .map_err(raised)?;
    let settings = Settings { folder, shard: Shard::WHOLE, keep_runs: false, threads, maker: ibr::program::maker() };
    let made = beside(py, progress.as_ref(), |tell| run(&study, &settings, tell))?;
    made.map_err(raised)?;
    columns(py, &py.detach(|| collect(&study, &settings.folder, false)).map_err(raised)?)
}
