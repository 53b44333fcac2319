//! What Python gives: pressures, values, measurements.

use crate::arrays::table;
use crate::errors::{raised, refused};
use ibr::Evidence;
use ibr::data::{markers_of_table, parse_about, read_about};
use ibr::models::CHANNELS;
use ibr::models::scenario::Setting;
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyDict, PyFloat, PyInt, PyString, PyTuple};
use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::Path;

/// One actuator pressure, or one for every supply channel \[Pa\].
pub(crate) struct Pressures {
    pa: [f64; CHANNELS],
    /// How many were given; more than there are channels is refused later, by the library.
    count: usize,
}

impl Pressures {
    pub(crate) fn pa(&self) -> &[f64] {
        &self.pa[..self.count]
    }
}

impl<'a, 'py> FromPyObject<'a, 'py> for Pressures {
    type Error = PyErr;

    fn extract(given: Borrowed<'a, 'py, PyAny>) -> PyResult<Pressures> {
        if let Ok(kpa) = given.extract::<f64>() {
            return Ok(Pressures { pa: [kpa * 1e3; CHANNELS], count: 1 });
        }
        let many: Vec<f64> = given.extract().map_err(|_| {
            PyTypeError::new_err(
                "pressure_kpa is a number, or one number for every supply channel; many states: batch()",
            )
        })?;
        if !(1..=CHANNELS).contains(&many.len()) {
            let message = format!("{} actuator pressures; there are {CHANNELS} supply channels", many.len());
            return Err(refused(message, "many states at once: batch(pressures)"));
        }
        let mut pa = [0.0; CHANNELS];
        many.iter().zip(&mut pa).for_each(|(kpa, pa)| *pa = kpa * 1e3);
        Ok(Pressures { pa, count: many.len() })
    }
}

/// A Python value as it is written in TOML.
pub(crate) fn toml_text(value: &Bound<'_, PyAny>) -> PyResult<String> {
    if let Ok(yes) = value.cast::<PyBool>() {
        return Ok(yes.is_true().to_string());
    }
    if let Ok(text) = value.cast::<PyString>() {
        return Ok(serde_json::Value::from(text.to_string()).to_string());
    }
    if let Some((number, is_whole)) = plain_number(value) {
        return Ok(number_text(number, is_whole));
    }
    if value.len().is_ok() {
        let parts = value.try_iter()?.map(|part| toml_text(&part?)).collect::<PyResult<Vec<String>>>()?;
        return Ok(format!("[{}]", parts.join(", ")));
    }
    match value.extract::<i64>() {
        Ok(whole) => Ok(whole.to_string()),
        Err(_) => Ok(format!("{:?}", value.extract::<f64>()?)),
    }
}

/// A number of Python's own types, and whether it is whole by its type; one beyond 2⁵³ is left to its text.
fn plain_number(value: &Bound<'_, PyAny>) -> Option<(f64, bool)> {
    if value.is_instance_of::<PyFloat>() {
        return Some((value.extract().ok()?, false));
    }
    let whole: i64 = value.is_exact_instance_of::<PyInt>().then(|| value.extract().ok()).flatten()?;
    (whole.unsigned_abs() < 1 << 53).then_some((whole as f64, true))
}

fn number_text(number: f64, is_whole: bool) -> String {
    if is_whole { format!("{number:.0}") } else { format!("{number:?}") }
}

/// A value to set at a place of a scenario's text.
#[derive(Clone)]
pub(crate) struct Change {
    place: String,
    value: Value,
}

#[derive(Clone)]
enum Value {
    /// A number, and whether it is written as a whole one.
    Number(f64, bool),
    /// As it is written in TOML.
    Text(String),
}

impl Change {
    /// As the model takes it, where it is a number.
    pub(crate) fn setting(&self) -> Option<Setting<'_>> {
        let (table, key) = self.place.rsplit_once('.')?;
        match self.value {
            Value::Number(number, is_whole) => Some(Setting { table, key, number, is_whole }),
            Value::Text(_) => None,
        }
    }

    /// Place and value as they are written.
    pub(crate) fn written(&self) -> (String, String) {
        let text = match &self.value {
            Value::Number(number, is_whole) => number_text(*number, *is_whole),
            Value::Text(text) => text.clone(),
        };
        (self.place.clone(), text)
    }
}

/// The places in a scenario's text of values that are given by table: `body={"radius_mm": 40}` and `body_radius_mm=40` are both
/// `body.radius_mm`.
pub(crate) fn places(table: &str, given: &Bound<'_, PyDict>, found: &mut Vec<Change>) -> PyResult<()> {
    for (key, value) in given.iter() {
        let key = key.cast::<PyString>()?.to_cow()?;
        let place = match table {
            "" => key.replacen('_', ".", 1),
            _ => format!("{table}.{key}"),
        };
        if let Ok(inner) = value.cast::<PyDict>() {
            places(&place, inner, found)?;
            continue;
        }
        let value = match plain_number(&value) {
            Some((number, is_whole)) => Value::Number(number, is_whole),
            None => Value::Text(toml_text(&value)?),
        };
        found.push(Change { place, value });
    }
    Ok(())
}

/// Of equal values the same, in every process.
pub(crate) fn hash_of(value: &impl Hash) -> u64 {
    let mut hasher = DefaultHasher::new();
    value.hash(&mut hasher);
    hasher.finish()
}

/// Measurements of one robot: a dataset by name, file or import.
#[pyclass(frozen, module = "ibr")]
pub struct Data {
    pub evidence: Evidence,
    /// What reading or import assumed, in words.
    #[pyo3(get)]
    told: Vec<String>,
    /// The beginning of an about.toml, of an import.
    #[pyo3(get)]
    about_toml: Option<String>,
    made: Made,
}

/// How measurements were made, to make them again in another process.
pub(crate) enum Made {
    /// By name.
    Read,
    /// Of columns, with the text of an about.toml.
    Columns(Option<String>),
    /// By an import with these words.
    Imported(Vec<String>),
    /// With another simulator's predictions in the place of the scenario's.
    OnBase,
}

impl Data {
    pub(crate) fn of(evidence: Evidence, made: Made) -> Data {
        Data { told: evidence.dataset.told.clone(), evidence, about_toml: None, made }
    }
}

#[pymethods]
impl Data {
    /// A CSV file, a folder with markers.csv and about.toml, or an embedded set.
    #[staticmethod]
    fn read(py: Python<'_>, name: &str) -> PyResult<Data> {
        py.detach(|| Evidence::read(name)).map(|read| Data::of(read, Made::Read)).map_err(raised)
    }

    /// Columns of the marker table; `ibr.data` makes them of any frame.
    #[staticmethod]
    #[pyo3(signature = (columns, name, about = None))]
    fn of_columns(columns: Vec<(String, Bound<'_, PyAny>)>, name: &str, about: Option<&str>) -> PyResult<Data> {
        let text = about.map(description).transpose()?;
        let about = text.as_ref().map(|text| parse_about("about", text)).transpose();
        let about = about.map_err(|error| raised(ibr::Error::from(error)))?;
        let read = markers_of_table(name, &table(columns)?, about.as_ref());
        let dataset = read.map_err(|error| raised(ibr::Error::from(error)))?;
        Ok(Data::of(Evidence::of(dataset, about), Made::Columns(text)))
    }

    /// Name by which the data were asked for.
    #[getter]
    fn name(&self) -> &str {
        &self.evidence.name
    }

    /// Labels of the runs, in the order of the table.
    #[getter]
    fn runs(&self) -> Vec<String> {
        self.evidence.dataset.runs.clone()
    }

    /// Labels of the markers, in the order of the table.
    #[getter]
    fn markers(&self) -> Vec<&str> {
        self.evidence.dataset.markers.iter().map(|marker| marker.name.as_str()).collect()
    }

    /// Kind of the actuator, for example `epam`.
    #[getter]
    fn actuator(&self) -> &str {
        &self.evidence.dataset.actuator
    }

    /// The marker table as columns: `pandas.DataFrame(data.table)`.
    #[getter]
    fn table<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        crate::arrays::columns(py, &self.evidence.dataset.to_table())
    }

    fn __reduce__<'py>(slf: &Bound<'py, Data>) -> PyResult<(Bound<'py, PyAny>, Py<PyTuple>)> {
        let (py, data) = (slf.py(), slf.get());
        let name = data.name();
        let of_class = |method: &str| slf.get_type().getattr(method);
        Ok(match &data.made {
            Made::Read => {
                // A file is found from any folder.
                let path = std::path::absolute(name).ok().filter(|path| path.exists());
                let name = path.map_or(name.to_string(), |path| path.to_string_lossy().into_owned());
                (of_class("read")?, (name,).into_pyobject(py)?.unbind())
            }
            Made::Columns(about) => {
                let columns = data.table(py)?.items();
                (of_class("of_columns")?, (columns, name, about.as_deref()).into_pyobject(py)?.unbind())
            }
            Made::Imported(typed) => {
                let made = py.import("ibr._ibr")?.getattr("import_tracks")?;
                (made, (typed.clone(),).into_pyobject(py)?.unbind())
            }
            Made::OnBase => {
                let message = "data with another simulator's predictions do not pickle";
                return Err(refused(message, "pickle the data and the predictions, and give base= again"));
            }
        })
    }

    fn __eq__(&self, other: &Data) -> bool {
        let (a, b) = (&self.evidence, &other.evidence);
        // In words an empty cell is equal to another.
        let table = |one: &Evidence| format!("{:?}", one.dataset.to_table());
        a.name == b.name && a.about == b.about && table(a) == table(b)
    }

    fn __hash__(&self) -> u64 {
        let set = &self.evidence.dataset;
        hash_of(&(&self.evidence.name, &set.runs, set.holds.len()))
    }

    fn __repr__(&self) -> String {
        let set = &self.evidence.dataset;
        format!(
            "Data({}: {} runs, {} holds, {} markers)",
            self.evidence.name,
            set.runs.len(),
            set.holds.len(),
            set.markers.len()
        )
    }
}

/// Files of a tracking program with the options of `ibr data import`.
#[pyfunction]
pub(crate) fn import_tracks(py: Python<'_>, typed: Vec<String>) -> PyResult<Data> {
    let mut found = py.detach(|| ibr::import_typed(&typed)).map_err(raised)?;
    found.dataset.name = "imported tracks".into();
    let evidence = Evidence::of(found.dataset, Some(found.about));
    Ok(Data { evidence, told: found.told, about_toml: Some(found.about_toml), made: Made::Imported(typed) })
}

/// The text of a description; `about` is it, or its path.
fn description(about: &str) -> PyResult<String> {
    if about.contains('\n') {
        return Ok(about.to_string());
    }
    // A fault of a file comes from its reader, with its name.
    read_about(Path::new(about)).map_err(|error| raised(ibr::Error::from(error)))?;
    Ok(std::fs::read_to_string(about)? + "\n")
}
