use crate::answers::Answer;
use crate::errors::raised;
use crate::inputs::toml_text;
use crate::progress::beside;
use crate::scenario::Scenario;
use ibr::fem::session::{FeRun, Further, SUMMARY};
use ibr::pages::run_plots;
use ibr::shown::run::{cost_text, text};
use ibr::{FeSettings, FeSource, fe_source};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::path::PathBuf;

/// A scenario, or the name or path of a robot or a case.
#[derive(FromPyObject)]
pub(crate) enum Source<'py> {
    Robot(PyRef<'py, Scenario>),
    Named(PathBuf),
}

impl Source<'_> {
    fn load(&self) -> PyResult<FeSource> {
        match self {
            Source::Robot(scenario) => scenario.file().map(|file| FeSource::new(&file.name, &file.text)),
            Source::Named(path) => fe_source(&path.to_string_lossy()).map_err(raised),
        }
    }
}

/// `ibr simulate`, one run in a folder.
#[pyfunction]
#[pyo3(signature = (source, folder, changes, resume, force, end_s, threads, progress = None))]
#[expect(clippy::too_many_arguments, reason = "what Python passes by name")]
pub(crate) fn simulate(
    py: Python<'_>,
    source: Source<'_>,
    folder: PathBuf,
    changes: &Bound<'_, PyDict>,
    resume: bool,
    force: bool,
    end_s: Option<f64>,
    threads: usize,
    progress: Option<Py<PyAny>>,
) -> PyResult<Answer> {
    let source = source.load()?;
    let change = |(key, value): (Bound<'_, PyAny>, Bound<'_, PyAny>)| Ok((key.extract()?, toml_text(&value)?));
    let changes = changes.iter().map(change).collect::<PyResult<Vec<(String, String)>>>()?;
    let source = if changes.is_empty() { source } else { source.with(&changes).map_err(raised)? };
    let (maker, further) = (ibr::program::maker(), Some(run_plots as Further));
    let settings =
        FeSettings { folder: Some(folder), resume, force, end_s, threads, maker, further, ..FeSettings::default() };
    let made = beside(py, progress.as_ref(), |tell| ibr::simulate(&source, &settings, tell))?;
    answer(&made.map_err(raised)?)
}

/// The complete run in a folder.
#[pyfunction]
pub(crate) fn read_run(py: Python<'_>, folder: PathBuf) -> PyResult<Answer> {
    answer(&py.detach(|| FeRun::read(&folder)).map_err(raised)?)
}

fn answer(run: &FeRun) -> PyResult<Answer> {
    let mut json = SUMMARY.stamped(&run.summary);
    json["cost"] = serde_json::json!(run.cost);
    json["fresh"] = run.fresh.into();
    let text = text(&run.summary) + &cost_text(&run.cost);
    Ok(Answer::of(text, &json, run.notices.clone()))
}
