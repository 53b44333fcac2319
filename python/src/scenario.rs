//! A robot's scenario, ready to be asked.

use crate::arrays::{Numbers, matrix, numbers};
use crate::errors::{raised, refused};
use crate::inputs::{Pressures, places};
use crate::states::{State, States};
use ibr::models::{Aim, CHANNELS, Limits, Loads, Target};
use ibr::{Follower, Predictor, ScenarioFile};
use numpy::PyArray2;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::path::PathBuf;
use std::sync::Arc;

/// A robot: its body, actuators and physical effects, as a text in TOML.
#[pyclass(frozen, module = "ibr")]
pub struct Scenario {
    pub file: ScenarioFile,
    robot: Arc<Predictor>,
}

impl Scenario {
    pub fn of(file: ScenarioFile) -> Scenario {
        let robot = Arc::new(Predictor::new(&file));
        Scenario { file, robot }
    }

    fn loads(&self, pressure: &Pressures, body_kpa: Option<f64>) -> PyResult<Loads> {
        let body_pa = body_kpa.map(|kpa| kpa * 1e3);
        self.robot.loads(body_pa, pressure.pa()).map_err(raised)
    }

    /// One state per row of `pressure_kpa`, at the body pressure given for all or for each.
    fn all_loads(&self, pressure_kpa: &Numbers<'_>, body_kpa: Option<&Numbers<'_>>) -> PyResult<Vec<Loads>> {
        let (kpa, shape) = numbers(pressure_kpa);
        let columns = match shape[..] {
            [_] => 1,
            [_, columns] if (1..=CHANNELS).contains(&columns) => columns,
            _ => {
                return Err(refused(
                    format!("pressures of shape {shape:?}"),
                    format!("give (N,) or (N, channels), at most {CHANNELS} channels"),
                ));
            }
        };
        let bodies = body_kpa.map(|array| numbers(array).0);
        let count = kpa.len() / columns;
        if let Some(found) = bodies.as_ref().map(Vec::len).filter(|found| *found != 1 && *found != count) {
            return Err(refused(
                format!("{found} body pressures for {count} states"),
                "give one for all, or one for each",
            ));
        }
        let body = |i: usize| bodies.as_ref().map(|all| 1e3 * if all.len() == 1 { all[0] } else { all[i] });
        let mut pa = [0.0; CHANNELS];
        let one = |(i, row): (usize, &[f64])| {
            row.iter().zip(&mut pa).for_each(|(kpa, pa)| *pa = 1e3 * kpa);
            self.robot.loads(body(i), &pa[..columns]).map_err(|error| {
                refused(format!("state {i} of the batch: {error}"), "leave it out, or give another pressure")
            })
        };
        kpa.chunks_exact(columns).enumerate().map(one).collect()
    }
}

#[pymethods]
impl Scenario {
    /// A robot or study that comes with the package, or a TOML file.
    #[staticmethod]
    fn named(name: PathBuf) -> PyResult<Scenario> {
        ibr::studies::scenario(&name.to_string_lossy()).map(Scenario::of).map_err(raised)
    }

    /// A TOML file, or its text.
    #[staticmethod]
    fn from_toml(source: PathBuf) -> PyResult<Scenario> {
        let text = source.to_string_lossy();
        if text.contains('\n') {
            return ScenarioFile::parse("scenario", &text).map(Scenario::of).map_err(raised);
        }
        Scenario::named(source)
    }

    /// The same scenario with values of its text set, comments kept.
    #[pyo3(signature = (**changes))]
    fn replace(&self, changes: Option<&Bound<'_, PyDict>>) -> PyResult<Scenario> {
        let mut set = Vec::new();
        changes.map_or(Ok(()), |changes| places("", changes, &mut set))?;
        self.file.with_in_space(&set).map(Scenario::of).map_err(raised)
    }

    /// Text of the scenario in TOML, comments kept.
    #[getter]
    fn text(&self) -> &str {
        &self.file.text
    }

    /// File or name as it was asked for.
    #[getter]
    fn source(&self) -> &str {
        &self.file.name
    }

    /// Name of the robot in the text.
    #[getter]
    fn name(&self) -> &str {
        &self.file.scenario.name
    }

    /// Kind of the actuator, for example `epam`.
    #[getter]
    fn actuator(&self) -> &str {
        self.file.actuator.kind.name
    }

    /// Names of the physical effects in the scenario.
    #[getter]
    fn effects(&self) -> Vec<&str> {
        self.file.effects.iter().map(|effect| effect.name.as_str()).collect()
    }

    /// Stations of the markers along the undeformed body (mm).
    #[getter]
    fn stations_mm(&self) -> Vec<f64> {
        self.file.markers_m.iter().map(|s| s * 1e3).collect()
    }

    /// Body pressure where none is given (kPa).
    #[getter]
    fn body_pressure_kpa(&self) -> f64 {
        self.file.p_body_pa / 1e3
    }

    /// Whether a state depends on those before it or on time.
    #[getter]
    fn has_history(&self) -> bool {
        self.robot.model.has_history()
    }

    /// Shape at one actuator pressure, or at one for every channel (kPa).
    #[pyo3(signature = (pressure_kpa, body_pressure_kpa = None))]
    fn predict(&self, pressure_kpa: Pressures, body_pressure_kpa: Option<f64>) -> PyResult<State> {
        let loads = self.loads(&pressure_kpa, body_pressure_kpa)?;
        let mut at = self.robot.model.prediction();
        self.robot.model.predict_held(&loads, &mut at).map_err(|error| raised(ibr::Error::from(error)))?;
        State::new(&self.robot, loads, &at)
    }

    /// One state per pressure, computed on several threads (kPa).
    #[pyo3(signature = (pressure_kpa, body_pressure_kpa = None, threads = 0))]
    fn batch(
        &self,
        py: Python<'_>,
        pressure_kpa: Numbers<'_>,
        body_pressure_kpa: Option<Numbers<'_>>,
        threads: usize,
    ) -> PyResult<States> {
        let loads = self.all_loads(&pressure_kpa, body_pressure_kpa.as_ref())?;
        let batch = py.detach(|| self.robot.batch(&loads, threads)).map_err(raised)?;
        let z_m = self.robot.model.is_spatial().then_some(&batch.markers_z_m[..]);
        States::new(py, &batch.tips, batch.markers, z_m)
    }

    /// States of a protocol in time, from rest at time 0.
    #[pyo3(signature = (t_s, pressure_kpa, body_pressure_kpa = None))]
    fn follow(
        &self,
        py: Python<'_>,
        t_s: Numbers<'_>,
        pressure_kpa: Numbers<'_>,
        body_pressure_kpa: Option<Numbers<'_>>,
    ) -> PyResult<States> {
        let loads = self.all_loads(&pressure_kpa, body_pressure_kpa.as_ref())?;
        let (times, _) = numbers(&t_s);
        if times.len() != loads.len() {
            return Err(refused(
                format!("{} times for {} pressures", times.len(), loads.len()),
                "give one time for each",
            ));
        }
        let (mut tips, mut markers, mut z_m) = (Vec::new(), Vec::new(), Vec::new());
        let walked = py.detach(|| {
            let mut follower = Follower::new(&self.file);
            times.iter().zip(&loads).try_for_each(|(t_s, loads)| {
                let at = follower.next(*t_s, loads)?;
                tips.push(at.tip);
                markers.extend_from_slice(&at.markers);
                z_m.extend_from_slice(&at.markers_z_m);
                Ok(())
            })
        });
        walked.map_err(|error: ibr::Error| raised(error))?;
        let z_m = self.robot.model.is_spatial().then_some(&z_m[..]);
        States::new(py, &tips, markers, z_m)
    }

    /// The state in which the tip is on target.
    #[pyo3(signature = (*, tip_mm = None, angle_deg = None, body_pressure_kpa = None))]
    fn inverse(&self, tip_mm: Option<f64>, angle_deg: Option<f64>, body_pressure_kpa: Option<f64>) -> PyResult<State> {
        let target = match (tip_mm, angle_deg) {
            (Some(mm), None) => Target::TipHeight(mm / 1e3),
            (None, Some(deg)) => Target::Angle(deg.to_radians()),
            _ => return Err(refused("one target is needed", "give tip_mm=100 (height) or angle_deg=60 (total bend)")),
        };
        let body_pa = body_pressure_kpa.map(|kpa| kpa * 1e3);
        let (loads, at) = self.robot.inverse(target, body_pa).map_err(raised)?;
        State::new(&self.robot, loads, &at)
    }

    /// Pressures of all channels that bring tip or markers nearest to their targets.
    #[pyo3(signature = (*, tip_mm = None, markers_mm = None, now_kpa = None, change_kpa = None, body_pressure_kpa = None))]
    fn steer(
        &self,
        tip_mm: Option<[f64; 2]>,
        markers_mm: Option<Vec<[f64; 2]>>,
        now_kpa: Option<Pressures>,
        change_kpa: Option<f64>,
        body_pressure_kpa: Option<f64>,
    ) -> PyResult<(State, f64)> {
        let metres = |xy: &[f64; 2]| xy.map(|mm| mm / 1e3);
        let markers_m: Option<Vec<[f64; 2]>> = markers_mm.map(|all| all.iter().map(metres).collect());
        let aim = match (&tip_mm, &markers_m) {
            (Some(tip), None) => Aim::Tip(metres(tip)),
            (None, Some(markers)) => Aim::Markers(markers),
            _ => {
                return Err(refused(
                    "one aim is needed",
                    "give tip_mm=(290, 130) or markers_mm, a row for every marker",
                ));
            }
        };
        let limits = match (&now_kpa, change_kpa) {
            (Some(now), Some(kpa)) => {
                let now = self.loads(now, body_pressure_kpa)?.actuator_pa;
                Some(Limits::up_to(self.robot.scenario.p_max_pa).near(&now, kpa * 1e3))
            }
            (None, None) => None,
            _ => {
                return Err(refused(
                    "now_kpa and change_kpa go together",
                    "give present pressures and the largest change",
                ));
            }
        };
        let body_pa = body_pressure_kpa.map(|kpa| kpa * 1e3);
        let (found, at) = self.robot.steer(aim, body_pa, limits).map_err(raised)?;
        Ok((State::new(&self.robot, found.loads, &at)?, found.miss_m * 1e3))
    }

    /// Slopes of the tip, a row per channel: x and y (mm/kPa), angle (degrees/kPa).
    #[pyo3(signature = (pressure_kpa, body_pressure_kpa = None))]
    fn jacobian<'py>(
        &self,
        py: Python<'py>,
        pressure_kpa: Pressures,
        body_pressure_kpa: Option<f64>,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let loads = self.loads(&pressure_kpa, body_pressure_kpa)?;
        let slopes = self.robot.jacobian(&loads).map_err(raised)?;
        let row = |s: &ibr::models::TipSlope| [s.x_per_pa * 1e6, s.y_per_pa * 1e6, s.angle_per_pa.to_degrees() * 1e3];
        Ok(matrix(py, CHANNELS, 3, slopes.iter().flat_map(row).collect()))
    }

    fn __repr__(&self) -> String {
        let effects = self.effects().join(", ");
        format!("Scenario({}: {}, effects: {effects})", self.file.name, self.file.scenario.name)
    }
}
