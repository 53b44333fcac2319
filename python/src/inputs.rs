//! What Python gives: pressures, values, measurements.

use crate::arrays::table;
use crate::errors::{raised, refused};
use ibr::Evidence;
use ibr::data::{About, markers_of_table, parse_about, read_about};
use ibr::models::CHANNELS;
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyDict, PyString};
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
    if value.len().is_ok() {
        let parts = value.try_iter()?.map(|part| toml_text(&part?)).collect::<PyResult<Vec<String>>>()?;
        return Ok(format!("[{}]", parts.join(", ")));
    }
    match value.extract::<i64>() {
        Ok(whole) => Ok(whole.to_string()),
        Err(_) => Ok(format!("{:?}", value.extract::<f64>()?)),
    }
}

/// The places in a scenario's text of values that are given by table: `body={"radius_mm": 40}` and `body_radius_mm=40` are both
/// `body.radius_mm`.
pub(crate) fn places(table: &str, given: &Bound<'_, PyDict>, found: &mut Vec<(String, String)>) -> PyResult<()> {
    for (key, value) in given.iter() {
        let key: String = key.extract()?;
        let place = match table {
            "" => key.replacen('_', ".", 1),
            _ => format!("{table}.{key}"),
        };
        match value.cast::<PyDict>() {
            Ok(inner) => places(&place, inner, found)?,
            Err(_) => found.push((place, toml_text(&value)?)),
        }
    }
    Ok(())
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
}

impl Data {
    pub(crate) fn of(evidence: Evidence) -> Data {
        Data { told: evidence.dataset.told.clone(), evidence, about_toml: None }
    }
}

#[pymethods]
impl Data {
    /// A CSV file, a folder with markers.csv and about.toml, or an embedded set.
    #[staticmethod]
    fn read(py: Python<'_>, name: &str) -> PyResult<Data> {
        py.detach(|| Evidence::read(name)).map(Data::of).map_err(raised)
    }

    /// Columns of the marker table; `about` is the text or the path of an about.toml.
    #[staticmethod]
    #[pyo3(signature = (columns, name, about = None))]
    fn of_columns(columns: Vec<(String, Bound<'_, PyAny>)>, name: &str, about: Option<&str>) -> PyResult<Data> {
        let about = about.map(read_description).transpose()?;
        let read = markers_of_table(name, &table(columns)?, about.as_ref());
        let dataset = read.map_err(|error| raised(ibr::Error::from(error)))?;
        Ok(Data::of(Evidence::of(dataset, about)))
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

    /// The columns of its marker table, texts as lists.
    #[getter]
    fn table<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        crate::arrays::columns(py, &self.evidence.dataset.to_table())
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
    let mut made = py.detach(|| ibr::import_typed(&typed)).map_err(raised)?;
    made.dataset.name = "imported tracks".into();
    let evidence = Evidence::of(made.dataset, Some(made.about));
    Ok(Data { evidence, told: made.told, about_toml: Some(made.about_toml) })
}

fn read_description(about: &str) -> PyResult<About> {
    let read = if about.contains('\n') { parse_about("about", about) } else { read_about(Path::new(about)) };
    read.map_err(|error| raised(ibr::Error::from(error)))
}
