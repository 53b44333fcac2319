use crate::arrays::{matrix, rows_mm, vector, with_z};
use crate::errors::raised;
use crate::inputs::hash_of;
use crate::source::ScenarioSource;
use ibr::models::{CHANNELS, Loads, Prediction, Tip};
use ibr::pages::predicted_files;
use ibr::shown::predicted::{PredictedState, above_limit, beyond_words, text};
use ibr::{AtPressure, Predictor};
use numpy::ndarray::Array3;
use numpy::{IntoPyArray, PyArray1, PyArray2};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};
use std::sync::{Arc, OnceLock};

/// Number of points along a centre line, base and tip included.
const LINE_POINTS: usize = 101;

/// Shape of a robot at one pressure. It pickles, and is equal to a state of an equal robot at the same pressures.
#[pyclass(frozen, module = "ibr")]
pub struct State {
    robot: Arc<Predictor>,
    source: Arc<ScenarioSource>,
    loads: Loads,
    tip: Tip,
    markers_m: Vec<[f64; 2]>,
    /// Of a robot with strips round the body.
    markers_z_m: Option<Vec<f64>>,
    /// All of it: of a robot with history as it was found, of others when it is asked for.
    whole: OnceLock<AtPressure>,
}

impl State {
    pub(crate) fn new(
        robot: &Arc<Predictor>,
        source: &Arc<ScenarioSource>,
        loads: Loads,
        at: &Prediction,
    ) -> PyResult<State> {
        let (tip, markers_m) = (at.tip, at.markers.clone());
        let markers_z_m = robot.model.is_spatial().then(|| at.markers_z_m.clone());
        let (robot, source) = (robot.clone(), source.clone());
        let state = State { robot, source, loads, tip, markers_m, markers_z_m, whole: OnceLock::new() };
        if state.robot.model.has_history() {
            state.keep(state.robot.with_slopes(&loads, at.clone()))?;
        }
        Ok(state)
    }

    fn whole(&self) -> PyResult<&AtPressure> {
        match self.whole.get() {
            Some(whole) => Ok(whole),
            None => self.keep(self.robot.state(&self.loads)),
        }
    }

    fn keep(&self, whole: Result<AtPressure, ibr::Error>) -> PyResult<&AtPressure> {
        let whole = whole.map_err(raised)?;
        Ok(self.whole.get_or_init(|| whole))
    }
}

#[pymethods]
impl State {
    /// Tip of the centre line (mm), x along the undeformed body and y towards the actuator, shape (2,); with strips round the
    /// body x, y and z, shape (3,).
    #[getter]
    fn tip_mm<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        let z = self.markers_z_m.as_ref().map(|_| self.tip.z_m * 1e3);
        vector(py, [self.tip.x_m * 1e3, self.tip.y_m * 1e3].into_iter().chain(z).collect())
    }

    /// Total bending angle from base to tip (degrees).
    #[getter]
    fn angle_deg(&self) -> f64 {
        self.tip.angle_rad.to_degrees()
    }

    /// Markers as the camera sees them (mm), shape (markers, 2); with strips round the body (markers, 3).
    #[getter]
    fn markers_mm<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<f64>> {
        match &self.markers_z_m {
            Some(z_m) => rows_mm(py, with_z(&self.markers_m, z_m)),
            None => rows_mm(py, self.markers_m.clone()),
        }
    }

    /// Actuator gauge pressure of the first supply channel (kPa).
    #[getter]
    fn pressure_kpa(&self) -> f64 {
        self.loads.actuator_pa[0] / 1e3
    }

    /// Actuator gauge pressure of every supply channel (kPa), shape (4,).
    #[getter]
    fn channels_kpa<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        vector(py, self.loads.actuator_pa.iter().map(|p| p / 1e3).collect())
    }

    /// Gauge pressure of the body (kPa).
    #[getter]
    fn body_pressure_kpa(&self) -> f64 {
        self.loads.body_pa / 1e3
    }

    /// Points of the centre line from base to tip (mm), shape (101, 2); with strips round the body (101, 3).
    #[getter]
    fn curve_mm<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let (model, at) = (&self.robot.model, &self.whole()?.prediction);
        Ok(match model.is_spatial() {
            true => rows_mm(py, model.centre_line_in_space(at, LINE_POINTS)),
            false => rows_mm(py, model.centre_line(at, LINE_POINTS)),
        })
    }

    /// What to know before believing it: beyond a limit of the actuator, a body that would fold.
    #[getter]
    fn warnings(&self) -> PyResult<Vec<String>> {
        let whole = self.whole()?;
        let high = above_limit(&self.robot.scenario, &[whole.loads]);
        Ok(high.into_iter().chain(beyond_words(&self.robot.model, &whole.loads, &whole.prediction)).collect())
    }

    /// One state of `ibr predict --json`: curvatures, slopes, energy ledger.
    fn to_json(&self) -> PyResult<String> {
        let robot = &self.robot;
        Ok(PredictedState::of(&robot.model, &robot.scenario, self.whole()?).json().to_string())
    }

    /// The same as a dictionary: keys and units are in docs/json.md.
    fn to_dict<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        py.import("json")?.call_method1("loads", (self.to_json()?,))
    }

    /// The shape on axes of matplotlib; returns the axes. With strips round the body two axes, one for each side.
    #[pyo3(signature = (axes = None))]
    fn plot<'py>(slf: &Bound<'py, State>, axes: Option<Bound<'py, PyAny>>) -> PyResult<Bound<'py, PyAny>> {
        slf.py().import("ibr._plot")?.call_method1("state", (slf, axes))
    }

    fn _repr_html_(&self) -> PyResult<String> {
        let whole = std::slice::from_ref(self.whole()?);
        let files = predicted_files(&self.robot.scenario, whole).map_err(raised)?;
        let svg = files.files.iter().filter(|(name, _)| name.ends_with(".svg"));
        Ok(svg.map(|(_, svg)| String::from_utf8_lossy(svg)).collect())
    }

    fn __str__(&self) -> PyResult<String> {
        Ok(text(&self.robot.scenario, std::slice::from_ref(self.whole()?)))
    }

    fn __reduce__<'py>(slf: &Bound<'py, State>) -> PyResult<(Bound<'py, PyAny>, Py<PyTuple>)> {
        let (py, state) = (slf.py(), slf.get());
        let file = state.source.file()?;
        let pressures = (state.loads.actuator_pa.map(|pa| pa / 1e3), state.loads.body_pa / 1e3);
        let given = ((&file.name, &file.text), pressures).into_pyobject(py)?;
        Ok((slf.get_type().getattr("_again")?, given.unbind()))
    }

    /// A state of a robot by name and text, at pressures.
    #[staticmethod]
    fn _again(py: Python<'_>, robot: (String, String), pressures: ([f64; CHANNELS], f64)) -> PyResult<Py<PyAny>> {
        let scenario = py.import("ibr._ibr")?.getattr("Scenario")?.call_method1("_parsed", robot)?;
        Ok(scenario.call_method1("predict", pressures)?.unbind())
    }

    fn __eq__(&self, other: &State) -> PyResult<bool> {
        let is_same = self.loads == other.loads && self.tip == other.tip && self.markers_m == other.markers_m;
        Ok(is_same && self.source.file()?.text == other.source.file()?.text)
    }

    fn __hash__(&self) -> u64 {
        hash_of(&[self.tip.x_m, self.tip.y_m, self.loads.actuator_pa[0]].map(f64::to_bits))
    }

    fn __repr__(&self) -> String {
        let Tip { x_m, y_m, z_m, angle_rad } = self.tip;
        let pressure = ibr::words::pressure_words(&self.loads);
        let z = self.markers_z_m.as_ref().map_or(String::new(), |_| format!(", {:.2}", z_m * 1e3));
        let (x, y, angle) = (x_m * 1e3, y_m * 1e3, angle_rad.to_degrees());
        format!("State({pressure} kPa: tip {x:.2}, {y:.2}{z} mm, {angle:.2} deg)")
    }
}

/// Many states as `ibr.States`: pressures of so many channels, tips, markers with z of a robot with strips round the body, and times
/// of a walk.
pub(crate) fn states(
    py: Python<'_>,
    robot: &Predictor,
    (loads, channels): (&[Loads], usize),
    (tips, markers_m, markers_z_m): (&[Tip], Vec<[f64; 2]>, Option<&[f64]>),
    times: Option<Vec<f64>>,
) -> PyResult<Py<PyAny>> {
    let axes = if markers_z_m.is_some() { 3 } else { 2 };
    let mut places = Vec::with_capacity(axes * tips.len());
    tips.iter().for_each(|tip| places.extend([tip.x_m, tip.y_m, tip.z_m].into_iter().take(axes).map(|v| v * 1e3)));
    let angles = tips.iter().map(|tip| tip.angle_rad.to_degrees()).collect();
    let each = robot.scenario.markers_m.len();
    let mut flat = match markers_z_m {
        Some(z_m) => with_z(&markers_m, z_m).into_flattened(),
        None => markers_m.into_flattened(),
    };
    flat.iter_mut().for_each(|v| *v *= 1e3);
    let markers = Array3::from_shape_vec((tips.len(), each, axes), flat).unwrap_or_default();
    let mut given = Vec::with_capacity(channels * loads.len());
    loads.iter().for_each(|loads| given.extend(loads.actuator_pa[..channels].iter().map(|pa| pa / 1e3)));
    let given = match channels {
        1 => vector(py, given).into_any(),
        _ => matrix(py, loads.len(), channels, given).into_any(),
    };
    let of_states = PyDict::new(py);
    of_states.set_item("pressure_kpa", given)?;
    of_states.set_item("body_pressure_kpa", vector(py, loads.iter().map(|loads| loads.body_pa / 1e3).collect()))?;
    of_states.set_item("tips_mm", matrix(py, tips.len(), axes, places))?;
    of_states.set_item("angles_deg", vector(py, angles))?;
    of_states.set_item("markers_mm", markers.into_pyarray(py))?;
    of_states.set_item("t_s", times.map(|times| vector(py, times)))?;
    py.import("ibr._states")?.getattr("States")?.call((), Some(&of_states)).map(Bound::unbind)
}
