//! Lists of the library as numpy arrays.

use ibr::data::{Column, Table};
use numpy::ndarray::Array2;
use numpy::{AllowTypeChange, IntoPyArray, PyArray1, PyArray2, PyArrayLikeDyn, PyReadonlyArray1};
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// An array of numbers, or what numpy makes one of: lists, whole numbers.
pub(crate) type NumberArray<'py> = PyArrayLikeDyn<'py, f64, AllowTypeChange>;

/// Points in metres as rows of millimetres, without a copy.
pub(crate) fn rows_mm<const AXES: usize>(py: Python<'_>, points_m: Vec<[f64; AXES]>) -> Bound<'_, PyArray2<f64>> {
    let count = points_m.len();
    let mut flat = points_m.into_flattened();
    flat.iter_mut().for_each(|v| *v *= 1e3);
    matrix(py, count, AXES, flat)
}

/// x, y and z of points whose z is in a separate list.
pub(crate) fn with_z(xy: &[[f64; 2]], z: &[f64]) -> Vec<[f64; 3]> {
    xy.iter().zip(z).map(|([x, y], z)| [*x, *y, *z]).collect()
}

/// A matrix of so many rows and columns; empty if the numbers are fewer.
pub(crate) fn matrix(py: Python<'_>, rows: usize, columns: usize, flat: Vec<f64>) -> Bound<'_, PyArray2<f64>> {
    Array2::from_shape_vec((rows, columns), flat).unwrap_or_default().into_pyarray(py)
}

pub(crate) fn vector(py: Python<'_>, values: Vec<f64>) -> Bound<'_, PyArray1<f64>> {
    values.into_pyarray(py)
}

/// The numbers of an array of any shape, and its shape.
pub(crate) fn numbers(array: &NumberArray<'_>) -> (Vec<f64>, Vec<usize>) {
    let view = array.as_array();
    (view.iter().copied().collect(), view.shape().to_vec())
}

/// A table as a dictionary of arrays, texts as lists.
pub(crate) fn columns<'py>(py: Python<'py>, table: &Table) -> PyResult<Bound<'py, PyDict>> {
    let all = PyDict::new(py);
    for (name, column) in &table.columns {
        match column {
            Column::F64(values) => all.set_item(name, values.clone().into_pyarray(py))?,
            Column::I64(values) => all.set_item(name, values.clone().into_pyarray(py))?,
            Column::Str(values) => all.set_item(name, values)?,
            Column::Bool(values) => all.set_item(name, values)?,
        }
    }
    Ok(all)
}

/// A table of named columns, numbers as arrays and texts as lists.
pub(crate) fn table(columns: Vec<(String, Bound<'_, PyAny>)>) -> PyResult<Table> {
    let column = |(name, values): (String, Bound<'_, PyAny>)| {
        let column = if let Ok(numbers) = values.extract::<PyReadonlyArray1<'_, f64>>() {
            Column::F64(numbers.as_array().to_vec())
        } else if let Ok(whole) = values.extract::<PyReadonlyArray1<'_, i64>>() {
            Column::I64(whole.as_array().to_vec())
        } else {
            Column::Str(values.extract()?)
        };
        Ok((name, column))
    };
    Ok(Table { columns: columns.into_iter().map(column).collect::<PyResult<_>>()? })
}
