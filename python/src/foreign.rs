//! Another simulator's predictions as the base of a diagnosis, and their correction.

use crate::answers::{Answer, all_evidence};
use crate::arrays::{NumberArray, numbers, table};
use crate::errors::{raised, refused};
use crate::inputs::{Data, Made};
use crate::scenario::Scenario;
use ibr::data::parse_correction;
use ibr::shown::validation::ValidateAnswer;
use ibr::study::foreign::{BaseTable, ForeignCorrection, judge, on_base, read_correction};
use numpy::ndarray::Array3;
use numpy::{IntoPyArray, PyArray3};
use pyo3::prelude::*;

/// Another simulator's predictions for data.
#[pyclass(frozen, module = "ibr")]
pub struct Base {
    table: BaseTable,
}

#[pymethods]
impl Base {
    /// A CSV or Parquet file.
    #[staticmethod]
    fn read(name: &str) -> PyResult<Base> {
        BaseTable::read(name).map(|table| Base { table }).map_err(raised)
    }

    /// Columns: marker, x_mm, y_mm, and p_act_kpa or t_s.
    #[staticmethod]
    fn of_columns(columns: Vec<(String, Bound<'_, PyAny>)>, name: &str) -> PyResult<Base> {
        BaseTable::of(name, &table(columns)?).map(|table| Base { table }).map_err(raised)
    }

    /// The data with this base in the place of the scenario's predictions.
    fn under(&self, py: Python<'_>, scenario: &Scenario, data: &Data) -> PyResult<Data> {
        let file = scenario.file()?;
        let under = py.detach(|| on_base(file, &data.evidence, &self.table)).map_err(raised)?;
        Ok(Data::of(under, Made::OnBase))
    }
}

/// What a diagnosis adds to another simulator's predictions.
#[pyclass(frozen, module = "ibr")]
pub struct Correction {
    fitted: ForeignCorrection,
}

#[pymethods]
impl Correction {
    /// Of a diagnosis of these data.
    #[staticmethod]
    fn of(py: Python<'_>, scenario: &Scenario, diagnosed: &Answer, data: Vec<PyRef<'_, Data>>) -> PyResult<Correction> {
        let found = diagnosed.found().ok_or_else(|| refused("not a diagnosis", "give the result of diagnose()"))?;
        let evidence = all_evidence(&data);
        let file = scenario.file()?;
        let fitted = py.detach(|| ForeignCorrection::of(file, &ibr::extend(file, found)?, &evidence));
        fitted.map(|fitted| Correction { fitted }).map_err(raised)
    }

    /// Displacements of the markers (mm) at actuator and body pressures (kPa), shape (N, markers, 2).
    fn at<'py>(
        &self,
        py: Python<'py>,
        act_kpa: NumberArray<'py>,
        body_kpa: NumberArray<'py>,
    ) -> PyResult<Bound<'py, PyArray3<f64>>> {
        let ((act, _), (body, _)) = (numbers(&act_kpa), numbers(&body_kpa));
        let pressures: Vec<[f64; 2]> = body.iter().zip(&act).map(|(body, act)| [1e3 * body, 1e3 * act]).collect();
        let moved: Vec<f64> = self.fitted.at(&pressures).map_err(raised)?.iter().map(|m| 1e3 * m).collect();
        let shape = (pressures.len(), self.fitted.markers().count(), 2);
        Ok(Array3::from_shape_vec(shape, moved).unwrap_or_default().into_pyarray(py))
    }

    /// The table as `ibr add … --out correction.csv` writes it.
    fn text(&self, py: Python<'_>) -> PyResult<String> {
        py.detach(|| self.fitted.text()).map_err(raised)
    }
}

/// `ibr validate correction.csv DATA --base TABLE`; `text` is the content of the file, where there is one.
#[pyfunction]
#[pyo3(signature = (name, text, data, bases, sigma_mm))]
pub(crate) fn validate_correction(
    py: Python<'_>,
    name: &str,
    text: Option<&str>,
    data: Vec<PyRef<'_, Data>>,
    bases: Vec<PyRef<'_, Base>>,
    sigma_mm: Option<f64>,
) -> PyResult<Answer> {
    let data = all_evidence(&data);
    let tables: Vec<_> = bases.iter().map(|base| base.table.clone()).collect();
    let judged = py.detach(|| {
        let correction = match text {
            Some(text) => parse_correction(name, text)?,
            None => read_correction(name)?,
        };
        let each = |(one, base)| judge(&correction, base, one, sigma_mm.map(|mm| mm / 1e3));
        let found = data.iter().zip(&tables).map(each).collect::<Result<Vec<_>, ibr::Error>>()?;
        Ok((correction, found))
    });
    let (correction, found) = judged.map_err(|error: ibr::Error| raised(error))?;
    Ok(Answer::of_validation(&ValidateAnswer::of_correction(&correction, &found)))
}
