//! A robot's scenario, ready to be asked.

use crate::arrays::{NumberArray, matrix, numbers, vector};
use crate::errors::{raised, refused};
use crate::inputs::{Change, Pressures, hash_of, places};
use crate::source::ScenarioSource;
use crate::states::{State, states};
use ibr::models::{Aim, CHANNELS, GASES, Limits, Loads, Prediction, Target};
use ibr::{Follower, Predictor, ScenarioFile};
use numpy::{PyArray1, PyArray2};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::path::PathBuf;
use std::sync::{Arc, OnceLock};

/// A robot: its body, actuators and physical effects, as a text in TOML. It never changes.
///
/// Pressures are gauge pressures in kPa, lengths mm, angles degrees, times seconds. It pickles, compares and hashes by its text.
#[pyclass(frozen, module = "ibr")]
pub struct Scenario {
    source: Arc<ScenarioSource>,
    robot: Arc<Predictor>,
    /// For many states, of a robot whose numbers were set without its text.
    often: OnceLock<Arc<Predictor>>,
}

impl Scenario {
    pub fn of(file: ScenarioFile) -> Scenario {
        let (robot, base) = (Arc::new(Predictor::new(&file)), Arc::new(file));
        let source = ScenarioSource { base: base.clone(), changes: Vec::new(), file: OnceLock::from(base) };
        Scenario { source: Arc::new(source), robot: robot.clone(), often: OnceLock::from(robot) }
    }

    pub(crate) fn file(&self) -> PyResult<&Arc<ScenarioFile>> {
        self.source.file()
    }

    fn often(&self) -> &Arc<Predictor> {
        self.often.get_or_init(|| Arc::new(Predictor::new(&self.robot.scenario)))
    }

    fn state(&self, loads: Loads, at: &Prediction) -> PyResult<State> {
        State::new(&self.robot, &self.source, loads, at)
    }

    /// The same with numbers set, if none of them needs the text.
    fn with_numbers(&self, set: &[Change]) -> Option<Scenario> {
        let settings = set.iter().map(Change::setting).collect::<Option<Vec<_>>>()?;
        let scenario = self.robot.scenario.with_numbers(&settings)?;
        let changes = [&self.source.changes[..], set].concat();
        let source = ScenarioSource { base: self.source.base.clone(), changes, file: OnceLock::new() };
        let robot = Arc::new(Predictor::for_few(scenario));
        Some(Scenario { source: Arc::new(source), robot, often: OnceLock::new() })
    }

    fn loads(&self, pressure: &Pressures, body_kpa: Option<f64>) -> PyResult<Loads> {
        let body_pa = body_kpa.map(|kpa| kpa * 1e3);
        self.robot.loads(body_pa, pressure.pa()).map_err(raised)
    }

    /// One state per row of `pressure_kpa`, at the body pressure given for all or for each.
    fn all_loads(&self, pressure_kpa: &NumberArray<'_>, body_kpa: Option<&NumberArray<'_>>) -> PyResult<Vec<Loads>> {
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
        let mut all = Vec::with_capacity(count);
        for (i, row) in kpa.chunks_exact(columns).enumerate() {
            row.iter().zip(&mut pa).for_each(|(kpa, pa)| *pa = 1e3 * kpa);
            all.push(self.robot.loads(body(i), &pa[..columns]).map_err(|error| {
                refused(format!("state {i} of the batch: {error}"), "leave it out, or give another pressure")
            })?);
        }
        Ok(all)
    }
}

fn channels(pressure_kpa: &NumberArray<'_>) -> usize {
    pressure_kpa.as_array().shape().get(1).copied().unwrap_or(1)
}

type GasArrays<'py> = (Bound<'py, PyArray1<f64>>, Bound<'py, PyArray2<f64>>);

fn target(tip_mm: Option<f64>, angle_deg: Option<f64>) -> PyResult<Target> {
    match (tip_mm, angle_deg) {
        (Some(mm), None) => Ok(Target::TipHeight(mm / 1e3)),
        (None, Some(deg)) => Ok(Target::Angle(deg.to_radians())),
        _ => Err(refused("one target is needed", "give tip_mm=100 (height) or angle_deg=60 (total bend)")),
    }
}

#[pymethods]
impl Scenario {
    /// A robot or study that comes with the package (`python -m ibr list`), or a TOML file.
    #[staticmethod]
    fn named(name: PathBuf) -> PyResult<Scenario> {
        ibr::studies::scenario(&name.to_string_lossy()).map(Scenario::of).map_err(raised)
    }

    /// A TOML file, or its text.
    #[staticmethod]
    fn from_toml(source: PathBuf) -> PyResult<Scenario> {
        let text = source.to_string_lossy();
        if text.contains('\n') {
            return Scenario::_parsed("scenario", &text);
        }
        Scenario::named(source)
    }

    /// A text, with the name for messages.
    #[staticmethod]
    fn _parsed(name: &str, text: &str) -> PyResult<Scenario> {
        ScenarioFile::parse(name, text).map(Scenario::of).map_err(raised)
    }

    /// The same with values of its text set: `body_radius_mm=45` and `body={"radius_mm": 45}` are both `radius_mm` of
    /// `[body]`; `effects={"friction": {"moment_nm": 0.2}}` sets or adds an effect. Comments stay.
    ///
    /// Numbers that the text has are set without reading it, in microseconds; predictions then equal the new text's to
    /// rounding.
    #[pyo3(signature = (**changes))]
    fn replace(&self, changes: Option<&Bound<'_, PyDict>>) -> PyResult<Scenario> {
        let mut set = Vec::new();
        changes.map_or(Ok(()), |changes| places("", changes, &mut set))?;
        if let Some(new) = self.with_numbers(&set) {
            return Ok(new);
        }
        let set: Vec<_> = set.iter().map(Change::written).collect();
        self.file()?.with_in_space(&set).map(Scenario::of).map_err(raised)
    }

    /// The same without these effects; `effects` lists what it has.
    #[pyo3(signature = (*effects))]
    fn without(&self, effects: Vec<String>) -> PyResult<Scenario> {
        self.file()?.without(&effects).map(Scenario::of).map_err(raised)
    }

    /// The same without any effect and with a bending stiffness of 0 N m2: the textbook's balance.
    fn bare(&self) -> PyResult<Scenario> {
        let all: Vec<String> = self.effects().into_iter().map(String::from).collect();
        let bare = self.file()?.without(&all).map_err(raised)?;
        bare.with_in_space(&[("body.bending_stiffness_nm2".into(), "0".into())]).map(Scenario::of).map_err(raised)
    }

    /// Writes the text to a file. A file with another content that this process did not write is kept, with an `ExistsError`,
    /// unless `force`.
    #[pyo3(signature = (path, force = false))]
    fn save(&self, py: Python<'_>, path: PathBuf, force: bool) -> PyResult<()> {
        py.import("ibr._results")?.getattr("save_text")?.call1((&self.file()?.text, path, force)).map(drop)
    }

    /// Text of the scenario in TOML, comments kept.
    #[getter]
    fn text(&self) -> PyResult<&str> {
        Ok(&self.file()?.text)
    }

    /// File or name as it was asked for.
    #[getter]
    fn source(&self) -> &str {
        &self.source.base.name
    }

    /// Name of the robot in the text.
    #[getter]
    fn name(&self) -> &str {
        &self.robot.scenario.name
    }

    /// Kind of the actuator, for example `epam`.
    #[getter]
    fn actuator(&self) -> &str {
        self.robot.scenario.actuator.kind.name
    }

    /// Names of the physical effects in the scenario.
    #[getter]
    fn effects(&self) -> Vec<&str> {
        self.robot.scenario.effects.iter().map(|effect| effect.name.as_str()).collect()
    }

    /// Stations of the markers along the undeformed body (mm).
    #[getter]
    fn stations_mm(&self) -> Vec<f64> {
        self.robot.scenario.markers_m.iter().map(|s| s * 1e3).collect()
    }

    /// Gauge pressure of the body where none is given (kPa).
    #[getter]
    fn body_pressure_kpa(&self) -> f64 {
        self.robot.scenario.p_body_pa / 1e3
    }

    /// Whether a state depends on those before it or on time: friction, creep, leaks.
    #[getter]
    fn has_history(&self) -> bool {
        self.robot.model.has_history()
    }

    /// Shape at an actuator gauge pressure (kPa), or at one for every supply channel. A robot with history is held there for
    /// 5 s, from rest.
    #[pyo3(signature = (pressure_kpa, body_pressure_kpa = None))]
    fn predict(&self, pressure_kpa: Pressures, body_pressure_kpa: Option<f64>) -> PyResult<State> {
        let loads = self.loads(&pressure_kpa, body_pressure_kpa)?;
        let mut at = self.robot.model.prediction();
        self.robot.model.predict_held(&loads, &mut at).map_err(|error| raised(ibr::Error::from(error)))?;
        self.state(loads, &at)
    }

    /// One state per actuator gauge pressure (kPa), shape (N,) or (N, channels), at one body pressure or N. Runs next to
    /// Python on so many threads, 0 is one per core. A robot with history is refused: its states have an order.
    #[pyo3(signature = (pressure_kpa, body_pressure_kpa = None, threads = 0))]
    fn batch(
        &self,
        py: Python<'_>,
        pressure_kpa: NumberArray<'_>,
        body_pressure_kpa: Option<NumberArray<'_>>,
        threads: usize,
    ) -> PyResult<Py<PyAny>> {
        let loads = self.all_loads(&pressure_kpa, body_pressure_kpa.as_ref())?;
        let batch = py.detach(|| self.often().batch(&loads, threads)).map_err(raised)?;
        let z_m = self.robot.model.is_spatial().then_some(&batch.markers_z_m[..]);
        let channels = channels(&pressure_kpa);
        states(py, &self.robot, (&loads, channels), (&batch.tips, batch.markers, z_m), None)
    }

    /// A protocol from rest at time 0: pressures change at once after the state before, then time passes until `t_s` (s),
    /// shape (N,), which does not fall. With `[supply]` in the scenario they arrive late.
    #[pyo3(signature = (t_s, pressure_kpa, body_pressure_kpa = None))]
    fn follow(
        &self,
        py: Python<'_>,
        t_s: NumberArray<'_>,
        pressure_kpa: NumberArray<'_>,
        body_pressure_kpa: Option<NumberArray<'_>>,
    ) -> PyResult<Py<PyAny>> {
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
            let mut follower = Follower::new(&self.robot.scenario);
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
        states(py, &self.robot, (&loads, channels(&pressure_kpa)), (&tips, markers, z_m), Some(times))
    }

    /// The state in which the tip has this height y (mm) or the robot this total bend (degrees); its `pressure_kpa` is the
    /// answer.
    #[pyo3(signature = (*, tip_mm = None, angle_deg = None, body_pressure_kpa = None))]
    fn inverse(&self, tip_mm: Option<f64>, angle_deg: Option<f64>, body_pressure_kpa: Option<f64>) -> PyResult<State> {
        let target = target(tip_mm, angle_deg)?;
        let body_pa = body_pressure_kpa.map(|kpa| kpa * 1e3);
        let (loads, at) = self.robot.inverse(target, body_pa).map_err(raised)?;
        self.state(loads, &at)
    }

    /// Least and largest pressure (kPa) for such a target over the `interval` of every assumed or calibrated number of an effect, at the
    /// scenario's body pressure; None without such numbers, or where no robot reaches the target.
    #[pyo3(signature = (*, tip_mm = None, angle_deg = None))]
    fn inverse_interval(&self, tip_mm: Option<f64>, angle_deg: Option<f64>) -> PyResult<Option<[f64; 2]>> {
        let found = ibr::pressure_interval(&self.robot.scenario, target(tip_mm, angle_deg)?).map_err(raised)?;
        Ok(found.and_then(|found| found.p_pa).map(|ends| ends.map(|pa| pa / 1e3)))
    }

    /// Several channels: the state nearest to a tip (x, y) or to places of all markers, and the distance that is left (mm,
    /// root mean square over markers). `channels_kpa` of the state is the answer. With `now_kpa` no pressure changes by more
    /// than `change_kpa`.
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
        Ok((self.state(found.loads, &at)?, found.miss_m * 1e3))
    }

    /// Change of tip x, tip y (mm/kPa) and angle (deg/kPa) with the pressure of each channel, shape (channels, 3); NaN where
    /// an actuator is flat.
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

    /// Gas of every channel and, last, of the body (cm³), shape (channels + 1,), and its slopes: volume (row) by pressure (column,
    /// cm³/kPa), shape (channels + 1, channels + 1); NaN by the pressure of a flat actuator.
    #[pyo3(signature = (pressure_kpa, body_pressure_kpa = None))]
    fn volumes<'py>(
        &self,
        py: Python<'py>,
        pressure_kpa: Pressures,
        body_pressure_kpa: Option<f64>,
    ) -> PyResult<GasArrays<'py>> {
        let found = self.robot.volumes(&self.loads(&pressure_kpa, body_pressure_kpa)?).map_err(raised)?;
        let slopes = found.per_pa.as_flattened().iter().map(|m3_per_pa| m3_per_pa * 1e9).collect();
        Ok((vector(py, found.m3.map(|m3| m3 * 1e6).to_vec()), matrix(py, GASES, GASES, slopes)))
    }

    /// Displacement of the tip along x, y, z (row) per force on it (column, mm/N), shape (3, 3), at constant pressures; 0 across the
    /// plane of a planar robot. dF/dy is `1 / compliance[1, 1]`.
    #[pyo3(signature = (pressure_kpa, body_pressure_kpa = None))]
    fn tip_compliance<'py>(
        &self,
        py: Python<'py>,
        pressure_kpa: Pressures,
        body_pressure_kpa: Option<f64>,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let found = self.robot.tip_stiffness(&self.loads(&pressure_kpa, body_pressure_kpa)?).map_err(raised)?;
        let mm_per_n = found.compliance_m_per_n.as_flattened().iter().map(|m_per_n| m_per_n * 1e3).collect();
        Ok(matrix(py, 3, 3, mm_per_n))
    }

    fn __reduce__<'py>(slf: &Bound<'py, Scenario>) -> PyResult<(Bound<'py, PyAny>, (String, String))> {
        let file = slf.get().file()?;
        Ok((slf.get_type().getattr("_parsed")?, (file.name.clone(), file.text.clone())))
    }

    fn __eq__(&self, other: &Scenario) -> PyResult<bool> {
        Ok(self.file()?.text == other.file()?.text)
    }

    fn __hash__(&self) -> PyResult<u64> {
        Ok(hash_of(&self.file()?.text))
    }

    fn __repr__(&self) -> String {
        let effects = self.effects().join(", ");
        format!("Scenario({}: {}, effects: {effects})", self.source.base.name, self.robot.scenario.name)
    }
}
