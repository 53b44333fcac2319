//! Results for scenarios and data: the text of the command, its JSON, a table, and the report page.

use crate::arrays::columns;
use crate::errors::raised;
use crate::inputs::Data;
use crate::progress::beside;
use crate::scenario::Scenario;
use ibr::compared::{Compared, unused_sigma};
use ibr::data::Table;
use ibr::pages::{Climbed, Diagnosed, Files, PageError, compare_page, diagnosis_page, ladder_page, residuals};
use ibr::program::maker;
use ibr::shown::comparison::{CompareAnswer, text};
use ibr::shown::extension::LadderAnswer;
use ibr::shown::validation::{self, ValidateAnswer};
use ibr::shown::{as_json, diagnosis, extension};
use ibr::study::ladder::MOST_EFFECTS;
use ibr::study::study::Knob;
use ibr::study::study::engines::known_runs;
use ibr::study::validation::BeforeAfter;
use ibr::study::witness::{Witness, witness};
use ibr::{Diagnosis, DiagnosisOptions, EffectWish, Evidence, Extension, ScenarioFile};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};

type Page = Box<dyn Fn() -> Result<Files, PageError> + Send + Sync>;

/// A result as the command gives it.
#[pyclass(frozen, module = "ibr")]
pub struct Answer {
    /// Text of the answer, as the command prints it.
    #[pyo3(get)]
    text: String,
    /// JSON of the answer, as the command prints it with `--json`.
    #[pyo3(get)]
    json: String,
    /// What to know before believing it.
    #[pyo3(get)]
    warnings: Vec<String>,
    table: Table,
    page: Option<Page>,
    extended: Vec<(String, ScenarioFile)>,
    diagnosis: Option<Diagnosis>,
}

impl Answer {
    pub fn of(text: String, json: &serde_json::Value, warnings: Vec<String>) -> Answer {
        let (table, page, extended, diagnosis) = (Table::default(), None, Vec::new(), None);
        Answer { text, json: json.to_string(), warnings, table, page, extended, diagnosis }
    }

    /// Of a scenario or a correction on other data.
    pub(crate) fn of_validation(answer: &ValidateAnswer) -> Answer {
        let warnings = answer.datasets.iter().flat_map(|v| v.warnings.iter().map(|w| format!("{}: {w}", v.data)));
        Answer::of(validation::text(answer), &as_json("ibr.validate", answer), warnings.collect())
    }

    pub(crate) fn found(&self) -> Option<&Diagnosis> {
        self.diagnosis.as_ref()
    }
}

#[pymethods]
impl Answer {
    /// Its numbers as columns; empty where they are lists of the JSON.
    fn columns<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        columns(py, &self.table)
    }

    /// The files of its report by name; empty without one.
    fn files<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let files = py.detach(|| self.page.as_ref().map_or(Ok(Files::default()), |page| page())).map_err(raised)?;
        let all = PyDict::new(py);
        for (name, bytes) in &files.files {
            all.set_item(name, PyBytes::new(py, bytes))?;
        }
        Ok(all)
    }

    /// New scenarios by name.
    fn scenarios(&self) -> Vec<(String, Scenario)> {
        self.extended.iter().cloned().map(|(name, file)| (name, Scenario::of(file))).collect()
    }
}

fn metres(mm: Option<f64>) -> Option<f64> {
    mm.map(|mm| mm / 1e3)
}

/// Answer of `ibr compare` for a scenario and data.
#[pyfunction]
#[pyo3(signature = (scenario, data, effects, sigma_mm, calibrate))]
pub(crate) fn compare(
    py: Python<'_>,
    scenario: &Scenario,
    data: &Data,
    effects: Vec<String>,
    sigma_mm: Option<f64>,
    calibrate: Option<&str>,
) -> PyResult<Answer> {
    let knob = calibrate.map(str::parse::<Knob>).transpose();
    let knob = knob.map_err(|known| crate::errors::refused(format!("calibrate={calibrate:?} is not known"), known))?;
    let (file, evidence, sigma_m) = (scenario.file()?, &data.evidence, metres(sigma_mm));
    let Compared { found, added } =
        py.detach(|| Compared::of(file, evidence, &effects, sigma_m, knob)).map_err(raised)?;
    let answer = CompareAnswer::of(&file.name, &found, added.as_ref());
    let warnings = found.warnings.iter().cloned().chain(unused_sigma(sigma_m, evidence)).collect();
    let told = Answer::of(text(&answer), &as_json("ibr.compare", &answer), warnings);
    let table = residuals(&found);
    Ok(Answer { table, page: Some(Box::new(move || compare_page(&found, &maker()))), ..told })
}

/// A diagnosis with all that its report is made of.
struct Whole {
    diagnosis: Diagnosis,
    witness: Option<Witness>,
    file: ScenarioFile,
    first: Evidence,
}

impl Whole {
    fn page(&self) -> Result<Files, PageError> {
        let typed = [self.file.name.as_str(), &self.first.name];
        let found = Diagnosed::of(&self.diagnosis, &self.file, &self.first, typed);
        let found = Diagnosed { witness: self.witness.as_ref(), ..found };
        diagnosis_page(&found, &maker(), &mut |_, _| ())
    }
}

#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub(crate) struct Asked {
    sigma_mm: Option<f64>,
    tolerance_mm: Option<f64>,
    refit: bool,
    keep_bending: bool,
    without: Vec<String>,
}

impl Asked {
    fn options(self) -> DiagnosisOptions {
        DiagnosisOptions {
            sigma_m: metres(self.sigma_mm),
            tolerance_m: metres(self.tolerance_mm),
            refit_present: self.refit,
            keep_bending: self.keep_bending,
            not: self.without,
            ..DiagnosisOptions::default()
        }
    }
}

pub(crate) fn all_evidence(data: &[PyRef<'_, Data>]) -> Vec<Evidence> {
    data.iter().map(|data| data.evidence.clone()).collect()
}

/// Answer of `ibr diagnose` for a scenario and data.
#[pyfunction]
#[pyo3(signature = (scenario, data, asked, progress = None))]
pub(crate) fn diagnose(
    py: Python<'_>,
    scenario: &Scenario,
    data: Vec<PyRef<'_, Data>>,
    asked: Asked,
    progress: Option<Py<PyAny>>,
) -> PyResult<Answer> {
    let (file, evidence, options) = (ScenarioFile::clone(scenario.file()?), all_evidence(&data), asked.options());
    let made = beside(py, progress.as_ref(), |tell| {
        let diagnosis = ibr::diagnose(&file, &evidence, &options, &mut |what, share| _ = tell(what, share))?;
        let no_data = || ibr::Error::refused("no data to diagnose", "name at least one set");
        let first = evidence.into_iter().next().ok_or_else(no_data)?;
        let witness = witness(&diagnosis, &file, &first.dataset, first.about.as_ref(), &known_runs(None)?)?;
        Ok(Whole { diagnosis, witness, file, first })
    })?;
    let whole = made.map_err(|error: ibr::Error| raised(error))?;
    let d = &whole.diagnosis;
    let json = as_json("ibr.diagnose", &diagnosis::DiagnosisAnswer::of(d, whole.witness.as_ref(), &whole.file.name));
    let warnings = d.warnings.iter().cloned().chain(unused_sigma(options.sigma_m, &whole.first)).collect();
    let told = Answer::of(diagnosis::text(d, whole.witness.as_ref(), false), &json, warnings);
    Ok(Answer { diagnosis: Some(d.clone()), page: Some(Box::new(move || whole.page())), ..told })
}

fn extended(file: &ScenarioFile, evidence: &[Evidence], found: Extension) -> PyResult<Answer> {
    let json = as_json("ibr.add", &extension::AddAnswer::of(file, evidence, &found, "").map_err(raised)?);
    let mut text: String = found.told.iter().map(|sentence| format!("{sentence}\n")).collect();
    if !found.steps.is_empty() {
        text += &format!("\n{}", extension::steps_text(&found.steps, found.noise_floor_mm));
    }
    let told = Answer::of(text, &json, found.warnings);
    Ok(Answer { extended: vec![(found.file.name.clone(), found.file)], ..told })
}

/// The scenario with what a diagnosis adds.
#[pyfunction]
pub(crate) fn extend(py: Python<'_>, scenario: &Scenario, diagnosed: &Answer) -> PyResult<Answer> {
    let found = diagnosed.found();
    let found =
        found.ok_or_else(|| crate::errors::refused("this is not a diagnosis", "give the result of diagnose()"))?;
    let file = scenario.file()?;
    let extension = py.detach(|| ibr::extend(file, found)).map_err(raised)?;
    extended(file, &[], extension)
}

/// Answer of `ibr add` for a scenario, an effect and data.
#[pyfunction]
#[pyo3(signature = (scenario, effect, data, asked, progress = None))]
pub(crate) fn add(
    py: Python<'_>,
    scenario: &Scenario,
    effect: &str,
    data: Vec<PyRef<'_, Data>>,
    asked: Asked,
    progress: Option<Py<PyAny>>,
) -> PyResult<Answer> {
    let (file, evidence) = (scenario.file()?, all_evidence(&data));
    let options = asked.options().without_advice();
    let found = beside(py, progress.as_ref(), |tell| {
        let wish = EffectWish::read(file, effect, !evidence.is_empty())?;
        ibr::add(file, &wish, &evidence, &options, &mut |what, share| _ = tell(what, share))
    })?;
    extended(file, &evidence, found.map_err(raised)?)
}

/// `ibr ladder`.
#[pyfunction]
#[pyo3(signature = (scenario, data, asked, progress = None))]
pub(crate) fn ladder(
    py: Python<'_>,
    scenario: &Scenario,
    data: Vec<PyRef<'_, Data>>,
    asked: Asked,
    progress: Option<Py<PyAny>>,
) -> PyResult<Answer> {
    let (file, evidence) = (scenario.file()?, all_evidence(&data));
    let options = asked.options().without_advice();
    let climbed = beside(py, progress.as_ref(), |tell| {
        ibr::ladder(file, &evidence, &options, MOST_EFFECTS, &mut |what, share| _ = tell(what, share))
    })?;
    let climb = climbed.map_err(raised)?;
    let name = |one: &Evidence| one.name.clone();
    let data = evidence.first().map_or_else(String::new, name);
    let also: Vec<String> = evidence.iter().skip(1).map(name).collect();
    let answer = LadderAnswer { climb: &climb, scenario_file: &file.name, data: &data, also: &also };
    let told = Answer::of(extension::climb_text(&climb), &as_json("ibr.ladder", &answer), climb.warnings.clone());
    let step = |(name, text): &(String, String)| Ok((name.clone(), ScenarioFile::parse(name, text).map_err(raised)?));
    let extended = climb.files.iter().map(step).collect::<PyResult<_>>()?;
    let names = [file.scenario.name.clone(), evidence[0].dataset.name.clone()];
    let typed = [file.name.clone(), data];
    let page = move || {
        let (names, typed) = (names.each_ref().map(String::as_str), typed.each_ref().map(String::as_str));
        ladder_page(&Climbed { climb: &climb, names, typed, also: &also }, &maker())
    };
    Ok(Answer { extended, page: Some(Box::new(page)), ..told })
}

/// A command as the words after the name of the program, as for [`ibr::ask`].
#[pyfunction]
#[pyo3(signature = (typed, progress = None))]
pub(crate) fn ask(py: Python<'_>, typed: Vec<String>, progress: Option<Py<PyAny>>) -> PyResult<Answer> {
    let found = beside(py, progress.as_ref(), |tell| ibr::ask(&typed, tell))?.map_err(raised)?;
    Ok(Answer::of(found.text, &found.json, found.warnings))
}

/// Answer of `ibr validate` for a scenario and other data.
#[pyfunction]
#[pyo3(signature = (scenario, data, without, sigma_mm))]
pub(crate) fn validate(
    py: Python<'_>,
    scenario: &Scenario,
    data: Vec<PyRef<'_, Data>>,
    without: Vec<String>,
    sigma_mm: Option<f64>,
) -> PyResult<Answer> {
    let (file, evidence) = (scenario.file()?, all_evidence(&data));
    let judged = py.detach(|| {
        let both = BeforeAfter::of(file, &without)?;
        let found = evidence.iter().map(|one| both.judge(one, metres(sigma_mm))).collect::<Result<Vec<_>, _>>()?;
        Ok((both, found))
    });
    let (both, found) = judged.map_err(|error: ibr::Error| raised(error))?;
    Ok(Answer::of_validation(&ValidateAnswer::of(&file.name, &both, &found)))
}
