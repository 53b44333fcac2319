//! The TOML file of a sweep: the keys to vary, and the outputs of every case.

pub use crate::axis::{Axis, PRESSURE};
use crate::axis::{CaseChanges, Levels, RawAxis, as_number, assumed, axes, channel};
use crate::form::{Form, ReadRobot, Wrong};
use crate::policy::MOST_CASES;
use crate::sample::{Method, Points};
use compare::{CompareError, ScenarioFile};
use models::{CHANNELS, Scenario};
use serde::Deserialize;
use std::path::Path;
use toml::{Spanned, Value};

/// Engine that computes the cases of a study.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
pub enum Engine {
    /// Reduced model, by balance of virtual work.
    #[serde(rename = "reduced")]
    Reduced,
    /// Finite elements with explicit time integration.
    #[serde(rename = "finite elements")]
    Elements,
}

impl Engine {
    /// As written in a study and in the table.
    pub fn word(self) -> &'static str {
        match self {
            Engine::Reduced => "reduced",
            Engine::Elements => "finite elements",
        }
    }
}

/// Groups of columns that a study asks for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Output {
    /// Place and turn of the tip.
    Tip,
    /// Positions of all markers of the scenario.
    Markers,
    /// Energies of the ledger at equilibrium.
    Ledger,
    /// Whether the pose can be trusted.
    Limits,
    /// Processor time. It is another one every time, so that two tables with it are not the same to the bit.
    Time,
}

/// A sweep as read from its file.
#[derive(Debug, Clone)]
pub struct Study {
    /// Robot whose keys the study varies.
    pub base: ScenarioFile,
    /// Folder that paths in the robot's file count from.
    pub folder: std::path::PathBuf,
    /// Engines that compute the cases, one or both.
    pub engines: Vec<Engine>,
    /// Groups of columns in the table of results.
    pub outputs: Vec<Output>,
    /// Keys that vary from robot to robot.
    pub axes: Vec<Axis>,
    /// Pressures of every robot \[kPa\]; empty where they are among the axes: of a sample, or of single channels.
    pub pressures_kpa: Vec<f64>,
    points: Option<Points>,
    robots: usize,
    checked: usize,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawStudy {
    #[serde(rename = "kind")]
    _kind: Option<StudyKind>,
    scenario: Spanned<String>,
    engines: Option<Spanned<Vec<Engine>>>,
    outputs: Option<Spanned<Vec<Output>>>,
    #[serde(default)]
    vary: Vec<Spanned<RawAxis>>,
    assumed: Option<Spanned<bool>>,
    sample: Option<Spanned<RawSample>>,
}

#[derive(Deserialize)]
#[serde(rename_all = "lowercase")]
enum StudyKind {
    Sweep,
}

/// A list of the study, each entry once, or its default.
fn listed_once<T: Copy + PartialEq>(given: Option<&Spanned<Vec<T>>>, usual: &[T], key: &str) -> Result<Vec<T>, Wrong> {
    let Some(given) = given else { return Ok(usual.to_vec()) };
    let all = given.get_ref();
    let twice = (1..all.len()).any(|i| all[..i].contains(&all[i]));
    match all.is_empty() || twice {
        true => Err((
            Some(given.span()),
            format!("`{key}` is empty, or has an entry twice"),
            "leave it out, or name each once",
        )),
        false => Ok(all.clone()),
    }
}

#[derive(Clone, Copy, Deserialize)]
#[serde(deny_unknown_fields)]
struct RawSample {
    method: Method,
    cases: usize,
    seed: Option<u32>,
    /// How many of them, from the first on, finite elements compute too.
    checked: Option<usize>,
}

const FORM: Form<RawStudy, Study> =
    Form { what: "study", page: "docs/sweep.md", scenario: |raw| &raw.scenario, of: Study::of };

impl Study {
    /// Reads a study; `scenario` reads the robot that it names, first as a file in the same folder.
    ///
    /// # Errors
    /// A file that cannot be read; a fault of the study or of the robot, with its line and what to write.
    pub fn read(path: &Path, scenario: ReadRobot) -> Result<Study, CompareError> {
        FORM.read(path, scenario)?.checked()
    }

    /// Of a text; `name` is for messages. Errors as for [`Study::read`].
    ///
    /// ```
    /// use sweep::{Engine, Study};
    /// let text = "kind = \"sweep\"\nscenario = \"epam\"\n[[vary]]\nkey = \"actuator.width_mm\"\nvalues = [40, 60]\n\
    ///             [[vary]]\nkey = \"pressure_kpa\"\nvalues = [10, 20, 30]\n";
    /// let study = Study::parse("study.toml", text, "".as_ref(), compare::ScenarioFile::read).unwrap();
    /// assert_eq!((study.cases(Engine::Reduced), study.per_robot()), (2 * 3, 3));
    /// ```
    pub fn parse(name: &str, text: &str, folder: &Path, scenario: ReadRobot) -> Result<Study, CompareError> {
        FORM.parse(name, text, folder, scenario)?.checked()
    }

    /// Refuses a key that the scenario does not have before computing anything.
    fn checked(self) -> Result<Study, CompareError> {
        if self.robots > 0 {
            self.robot(0)?;
        }
        Ok(self)
    }

    fn of(raw: RawStudy, base: ScenarioFile, folder: &Path) -> Result<Study, Wrong> {
        let engines = listed_once(raw.engines.as_ref(), &[Engine::Reduced], "engines")?;
        let outputs = listed_once(raw.outputs.as_ref(), &[Output::Tip, Output::Limits], "outputs")?;
        let raw_sample = raw.sample.as_ref();
        let mut axes = axes(&raw.vary, raw_sample.is_some(), &base)?;
        let is_run = |axis: &Axis| axis.key.starts_with("fem.") && !engines.contains(&Engine::Elements);
        if let Some(idle) = axes.iter().position(is_run) {
            let message = format!("`{}` moves nothing of the reduced model", axes[idle].key);
            return Err((Some(raw.vary[idle].span()), message, "add engines = [\"finite elements\"]"));
        }
        if let Some(span) = raw.assumed.as_ref().filter(|wish| *wish.get_ref()).map(Spanned::span) {
            let wrong = |message: &str, help| (Some(span.clone()), message.to_string(), help);
            if raw_sample.is_none() || !engines.contains(&Engine::Elements) {
                let help = "add a [sample], and engines = [\"finite elements\"]";
                return Err(wrong("assumed numbers are drawn, for finite elements", help));
            }
            axes.extend(assumed(&base, folder, &axes).map_err(|cause| wrong(&cause.to_string(), "try ibr simulate"))?);
        }
        let own = axes.iter().position(|axis| axis.key == PRESSURE);
        let mut pressures_kpa: Vec<f64> = base.pressures_pa.iter().map(|pa| pa * 1e-3).collect();
        match own.map(|i| &axes[i].levels) {
            Some(Levels::Listed(all)) if raw_sample.is_none() => {
                pressures_kpa = all.iter().filter_map(as_number).collect();
                axes.retain(|axis| axis.key != PRESSURE);
            }
            Some(_) => pressures_kpa = Vec::new(),
            None if axes.iter().any(|axis| channel(&axis.key).is_some()) => pressures_kpa = Vec::new(),
            None if pressures_kpa.is_empty() => {
                let help = "add [[vary]] with key = \"pressure_kpa\", or [predict] pressures_kpa to the scenario";
                return Err((None, "no pressure is given".into(), help));
            }
            None => {}
        }
        let (robots, points) = match &raw.sample {
            None => (axes.iter().try_fold(1_usize, |n, axis| n.checked_mul(axis.entries()?)), None),
            Some(sample) => {
                let RawSample { method, cases, seed, checked } = *sample.get_ref();
                if cases == 0 {
                    return Err((
                        Some(sample.span()),
                        "a sample without a case".into(),
                        "write for example cases = 100",
                    ));
                }
                if checked.is_some() && !engines.contains(&Engine::Elements) {
                    let help = "add engines = [\"reduced\", \"finite elements\"], or leave checked out";
                    return Err((Some(sample.span()), "`checked` without finite elements".into(), help));
                }
                (Some(cases), (cases <= MOST_CASES).then(|| Points::new(method, cases, axes.len(), seed.unwrap_or(1))))
            }
        };
        let per_robot = pressures_kpa.len().max(1);
        let robots = robots.filter(|n| n.checked_mul(per_robot).is_some_and(|all| all <= MOST_CASES)).ok_or((
            raw.sample.as_ref().map(Spanned::span),
            format!("more than {MOST_CASES} cases"),
            "take fewer steps, or a [sample]",
        ))?;
        let checked = raw.sample.as_ref().and_then(|sample| sample.get_ref().checked).unwrap_or(robots).min(robots);
        let folder = folder.to_path_buf();
        Ok(Study { base, folder, engines, outputs, axes, pressures_kpa, points, robots, checked })
    }

    /// Number of cases of an engine; finite elements compute only the checked robots.
    pub fn cases(&self, engine: Engine) -> usize {
        let robots = if engine == Engine::Elements { self.checked } else { self.robots };
        robots * self.per_robot()
    }

    /// Number of consecutive cases with the same robot.
    pub fn per_robot(&self) -> usize {
        self.pressures_kpa.len().max(1)
    }

    /// Values of the axes for a robot.
    pub fn values(&self, robot: usize) -> Vec<Value> {
        if let Some(points) = &self.points {
            return self.axes.iter().zip(points.of(robot)).map(|(axis, share)| axis.at(*share)).collect();
        }
        let mut rest = robot;
        let mut values = Vec::with_capacity(self.axes.len());
        // The last key changes first.
        for axis in self.axes.iter().rev() {
            let Levels::Listed(all) = &axis.levels else { continue };
            values.push(all[rest % all.len()].clone());
            rest /= all.len();
        }
        values.reverse();
        values
    }

    /// Coordinates of a place: z only of robots with strips round the body.
    pub fn axes_of_place(&self) -> &'static [&'static str] {
        if self.base.scenario.is_spatial() { &["x", "y", "z"] } else { &["x", "y"] }
    }

    /// Outputs that are drawn and printed, and what they are called.
    pub fn heights(&self) -> &'static [(&'static str, &'static str)] {
        let both = &[("tip_y_mm", "height of the tip"), ("tip_z_mm", "z of the tip")];
        &both[..self.axes_of_place().len() - 1]
    }

    /// Whether single channels have pressures of their own.
    pub fn has_channels(&self) -> bool {
        self.axes.iter().any(|axis| matches!(channel(&axis.key), Some(Some(_))))
    }

    /// Keys that have a column: those that vary, and last the pressure, unless single channels have their own.
    pub(crate) fn keys(&self) -> impl Iterator<Item = String> {
        let own = self.axes.iter().map(|axis| axis.key.clone()).filter(|key| key != PRESSURE);
        own.chain((!self.has_channels()).then(|| PRESSURE.to_string()))
    }

    /// Values set in the scenario of a robot, and its pressures.
    pub(crate) fn changes(&self, robot: usize) -> CaseChanges {
        CaseChanges::of(self.axes.iter().zip(self.values(robot)))
    }

    /// A robot, and its pressures in every channel \[kPa\].
    ///
    /// # Errors
    /// Values that its scenario refuses.
    pub fn robot(&self, robot: usize) -> Result<(ScenarioFile, Vec<[f64; CHANNELS]>), CompareError> {
        self.made(robot, |values| if values.is_empty() { Ok(self.base.clone()) } else { self.base.with(values) })
    }

    /// The same for the reduced model: without the text of the scenario, and without keys that only finite elements read. Errors as
    /// for [`Study::robot`].
    pub(crate) fn scenario(&self, robot: usize) -> Result<(Scenario, Vec<[f64; CHANNELS]>), CompareError> {
        self.made(robot, |values| {
            let read = values.iter().filter(|(key, _)| !key.starts_with("fem.")).cloned();
            self.base.scenario_with(&read.collect::<Vec<_>>())
        })
    }

    fn made<T>(
        &self,
        robot: usize,
        make: impl Fn(&[(String, String)]) -> Result<T, CompareError>,
    ) -> Result<(T, Vec<[f64; CHANNELS]>), CompareError> {
        let CaseChanges { values, pressures_kpa } = self.changes(robot);
        let all = || self.pressures_kpa.iter().map(|kpa| [*kpa; CHANNELS]).collect();
        Ok((make(&values)?, pressures_kpa.map_or_else(all, |own| vec![own])))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn studies_that_come_along_are_read() {
        for (name, cases) in [("epam-designs", [300, 30]), ("night", [100_000, 1_000])] {
            let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../studies/{name}.toml"));
            let study = Study::read(&path, ScenarioFile::read).unwrap();
            assert_eq!([Engine::Reduced, Engine::Elements].map(|engine| study.cases(engine)), cases, "{name}");
        }
    }
}
