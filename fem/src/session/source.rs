//! Source of a simulation: the text of a case or of a robot's scenario, and the problem it describes.

use super::watch::WatchedRobot;
use crate::case::{Case, Outputs, is_case};
use crate::error::TextFault;
use crate::problem::PrintedLoads;
use crate::robot::{RobotRun, RobotStart, outputs, with_fem};
use crate::{FemError, Result};
use models::{Scenario, ScenarioError};
use std::path::{Path, PathBuf};

/// A text that describes a run, and where it is from.
#[derive(Debug, Clone, PartialEq)]
pub struct RunSource {
    /// TOML of a finite element case, or of a robot's scenario with or without `[fem]`.
    pub text: String,
    /// File, or name of what comes with the program: for errors and manifests.
    pub name: String,
    /// Folder that paths in it count from.
    pub folder: PathBuf,
}

/// Checked case with its source, ready to run.
#[derive(Clone)]
pub struct Loaded {
    /// File or text from which the case was read.
    pub source: RunSource,
    /// Problem and outputs of the case.
    pub case: Case,
    /// The robot, if it is one.
    pub robot: Option<WatchedRobot>,
}

impl RunSource {
    /// A text without files next to it.
    pub fn new(name: &str, text: &str) -> RunSource {
        RunSource { text: text.into(), name: name.into(), folder: PathBuf::new() }
    }

    /// Whether it is the scenario of a robot.
    ///
    /// ```
    /// use fem::session::RunSource;
    /// assert!(RunSource::new("epam", models::shipped("epam").unwrap()).is_robot());
    /// assert!(!RunSource::new("pillow", fem::case::shipped_case("pillow").unwrap()).is_robot());
    /// ```
    pub fn is_robot(&self) -> bool {
        let table = |name: &str| self.text.lines().any(|line| line.trim() == name);
        !is_case(&self.text) && table("[body]") && table("[actuator]")
    }

    /// The same with keys of `[fem]` set to other values, which are written as in TOML.
    ///
    /// # Errors
    /// [`FemError::Setting`] if the table cannot be separated from the text around it.
    pub fn with(&self, changes: &[(String, String)]) -> Result<RunSource> {
        let changes: Vec<(&str, &str)> = changes.iter().map(|(key, value)| (key.as_str(), value.as_str())).collect();
        let text = with_fem(&self.text, &changes).ok_or_else(|| {
            let message = format!("the table [fem] of {} cannot be changed from the command line", self.name);
            FemError::setting(message, "write `[fem]` on a separate line, or set the keys in the file")
        })?;
        Ok(RunSource { text, ..self.clone() })
    }

    /// A robot's scenario at another body pressure and with as many pouches of another length as fit into the length of its actuator.
    ///
    /// # Errors
    /// [`FemError::Setting`] for pouches longer than the actuator, and for a text that is not TOML.
    pub fn varied(&self, body_kpa: f64, pouch_mm: Option<f64>) -> Result<RunSource> {
        let shape = self.robot_run()?.0.actuator;
        let unreadable =
            |_| FemError::setting(format!("{} cannot be changed", self.name), "check the file with ibr predict");
        let mut all: toml::Table = self.text.parse().map_err(unreadable)?;
        let mut set = |table: &str, key: &str, value: toml::Value| {
            if let Some(table) = all.get_mut(table).and_then(toml::Value::as_table_mut) {
                table.insert(key.into(), value);
            }
        };
        set("body", "pressure_kpa", body_kpa.into());
        if let Some(mm) = pouch_mm {
            let whole = shape.count as f64 * shape.shape.length_m * 1e3;
            let count = (whole / mm + 1e-6).floor();
            if count < 1.0 {
                let message = format!("--pouch {mm}mm is longer than the actuator of {}, {whole:.0} mm", self.name);
                let help = "write shorter pouches, for example --pouch 45mm,90mm";
                return Err(FemError::setting(message, help));
            }
            set("actuator", "length_mm", mm.into());
            set("actuator", "count", (count as i64).into());
        }
        Ok(RunSource { text: all.to_string(), ..self.clone() })
    }

    /// The case that it describes.
    ///
    /// # Errors
    /// [`FemError::Refused`] with the place; errors of the mesh file that it names.
    pub fn load(&self) -> Result<Loaded> {
        self.load_after(None)
    }

    /// The same; a robot's loads go on from those at a time \[s\] of an earlier run.
    pub(super) fn load_after(&self, earlier: Option<(f64, &PrintedLoads)>) -> Result<Loaded> {
        let mut read_mesh = |path: &Path| crate::mesh::file::read(&self.folder.join(path));
        let made = match self.is_robot() {
            true => self.robot(earlier).map(|(case, robot)| (case, Some(robot))),
            false => Case::parse(&self.text, &mut read_mesh).map(|case| (case, None)),
        };
        let (case, robot) = made.map_err(|error| self.refused(error))?;
        Ok(Loaded { source: self.clone(), case, robot })
    }

    fn robot(&self, earlier: Option<(f64, &PrintedLoads)>) -> Result<(Case, WatchedRobot)> {
        let scenario = self.scenario()?;
        let mut run = RobotRun::parse(&self.text, &scenario)?;
        run.start = earlier.map(|(time_s, loads)| RobotStart::of(&scenario, time_s, loads));
        let problem = run.problem(&scenario)?;
        let robot = WatchedRobot::new(&scenario, &run, &problem)?;
        // The pictures of a robot are its own.
        let outputs = Outputs { pictures: false, ..outputs(&scenario, &problem.mesh) };
        Ok((Case { problem, outputs, notices: Vec::new() }, robot))
    }

    fn scenario(&self) -> Result<Scenario> {
        let fault = |ScenarioError { message, help, span }: ScenarioError| FemError::Case {
            message: help.map_or(message.clone(), |help| format!("{message}\n{help}")),
            span: span.map(|(start, end)| start..end),
        };
        Scenario::parse(&self.text).map_err(fault)
    }

    /// Scenario and settings of a robot.
    ///
    /// # Errors
    /// [`FemError::Refused`] with the place.
    pub fn robot_run(&self) -> Result<(Scenario, RobotRun)> {
        let both = self.scenario().and_then(|scenario| {
            let run = RobotRun::parse(&self.text, &scenario)?;
            Ok((scenario, run))
        });
        both.map_err(|error| self.refused(error))
    }

    /// An error about the problem as one about the text that describes it.
    pub(super) fn refused(&self, error: FemError) -> FemError {
        let (told, span) = match error {
            FemError::Case { message, span } => (message, span),
            FemError::Mesh(message) | FemError::Problem(message) => (format!("{}: {message}", self.name), None),
            other => return other,
        };
        let mut lines = told.lines();
        let message = lines.next().unwrap_or_default().to_string();
        let help = lines.collect::<Vec<_>>().join(" ");
        FemError::Refused(Box::new(TextFault { file: self.name.clone(), text: self.text.clone(), message, help, span }))
    }
}
