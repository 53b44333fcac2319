//! Case and options as typed.

use super::robot::Robot;
use crate::failure::Failure;
use crate::output::Input;
use crate::studies::{STUDIES, study};
use fem::FemError;
use fem::case::{Case, Outputs, SHIPPED_CASES, is_case, shipped_case};
use fem::robot::{RobotRun, outputs, with_fem};
use models::{Scenario, ScenarioError};
use std::path::{Path, PathBuf};

/// Where a case came from.
pub struct NamedCase {
    /// Its text.
    pub text: String,
    /// For the manifest.
    pub input: Input,
    file: String,
}

impl NamedCase {
    /// An error about the problem as one about the file that describes it.
    pub fn in_case(&self, error: FemError) -> Failure {
        refused(&self.file, &self.text, error)
    }
}

/// What a user names: a text, and where it is from.
pub struct Named {
    /// Text.
    pub text: String,
    /// Name as typed.
    pub spec: String,
    /// Folder that paths in it count from.
    folder: PathBuf,
}

/// A case ready to run.
pub struct Loaded {
    /// Its text.
    pub named: NamedCase,
    /// The case.
    pub case: Case,
    /// The robot, if it is one.
    pub robot: Option<Robot>,
}

/// Reads a case file or the scenario of a robot, or takes a shipped one by name.
pub fn named(spec: &str) -> Result<Named, Failure> {
    let (text, folder) = text(spec)?;
    Ok(Named { text, spec: spec.into(), folder })
}

impl Named {
    /// Whether it is the scenario of a robot.
    pub fn is_robot(&self) -> bool {
        let table = |name: &str| self.text.lines().any(|line| line.trim() == name);
        !is_case(&self.text) && table("[body]") && table("[actuator]")
    }

    /// The same with keys of `[fem]` set to other values.
    pub fn with(&self, changes: &[(String, String)]) -> Result<Named, Failure> {
        let changes: Vec<(&str, &str)> = changes.iter().map(|(key, value)| (key.as_str(), value.as_str())).collect();
        let Some(text) = with_fem(&self.text, &changes) else {
            let message = format!("the table [fem] of {} cannot be changed from the command line", self.spec);
            return Err(Failure::usage(message, "write `[fem]` on a line of its own, or set the keys in the file"));
        };
        Ok(self.with_text(text))
    }

    /// The same name with another text.
    pub fn with_text(&self, text: String) -> Named {
        Named { text, spec: self.spec.clone(), folder: self.folder.clone() }
    }

    /// The case that it describes.
    pub fn load(&self) -> Result<Loaded, Failure> {
        let mut read_mesh = |path: &Path| fem::mesh::file::read(&self.folder.join(path));
        let made = match self.is_robot() {
            true => self.robot().map(|(case, robot)| (case, Some(robot))),
            false => Case::parse(&self.text, &mut read_mesh).map(|case| (case, None)),
        };
        let (case, robot) = made.map_err(|error| refused(&self.spec, &self.text, error))?;
        let input = Input::of(&self.spec, self.text.as_bytes());
        let named = NamedCase { text: self.text.clone(), input, file: self.spec.clone() };
        Ok(Loaded { named, case, robot })
    }

    /// The robot of a scenario.
    fn robot(&self) -> Result<(Case, Robot), FemError> {
        let scenario = self.scenario()?;
        let run = RobotRun::parse(&self.text, &scenario)?;
        let problem = run.problem(&scenario)?;
        let robot = Robot::new(&scenario, &run, &problem)?;
        // The pictures of a robot are its own.
        let outputs = Outputs { pictures: false, ..outputs(&scenario, &problem.mesh) };
        Ok((Case { problem, outputs }, robot))
    }

    fn scenario(&self) -> Result<Scenario, FemError> {
        let fault = |ScenarioError { message, help, span }: ScenarioError| FemError::Case {
            message: help.map_or(message.clone(), |help| format!("{message}\n{help}")),
            span: span.map(|(start, end)| start..end),
        };
        Scenario::parse(&self.text).map_err(fault)
    }

    /// Scenario and settings of a robot.
    pub fn robot_run(&self) -> Result<(Scenario, RobotRun), Failure> {
        let both = self.scenario().and_then(|scenario| {
            let run = RobotRun::parse(&self.text, &scenario)?;
            Ok((scenario, run))
        });
        both.map_err(|error| refused(&self.spec, &self.text, error))
    }
}

fn refused(file: &str, text: &str, error: FemError) -> Failure {
    let (message, span) = match error {
        FemError::Case { message, span } => (message, span),
        FemError::Mesh(message) | FemError::Problem(message) => (format!("{file}: {message}"), None),
        other => return Failure::Fem(other),
    };
    Failure::Case { file: file.into(), text: text.into(), message, span }
}

/// The text, and the folder that its paths count from.
fn text(spec: &str) -> Result<(String, PathBuf), Failure> {
    let path = Path::new(spec);
    let cause = match (std::fs::read(path), shipped_case(spec).or(models::shipped(spec)).or(study(spec))) {
        (Err(_), Some(text)) if !path.exists() => return Ok((text.to_string(), PathBuf::new())),
        (Err(cause), _) => cause.to_string(),
        (Ok(bytes), _) => match String::from_utf8(bytes) {
            Ok(text) if text.trim().is_empty() => "the file is empty".to_string(),
            Ok(text) => return Ok((text, path.parent().unwrap_or(Path::new("")).to_path_buf())),
            Err(_) => "it is not a text in UTF-8".to_string(),
        },
    };
    Err(unreadable(spec, &cause))
}

fn unreadable(spec: &str, cause: &str) -> Failure {
    let shipped = SHIPPED_CASES.iter().chain(models::scenario::SHIPPED).map(|c| c.0);
    let names: Vec<&str> = shipped.chain(STUDIES.iter().map(|s| s.0)).collect();
    let help = format!(
        "{}give a finite element case or a robot's scenario, or a shipped one: {}; `ibr new pillow > my.toml` makes a start",
        spelling::meant(spec, names.iter().copied()),
        names.join(", ")
    );
    Failure::Read { path: spec.into(), cause: cause.into(), help }
}

/// A time typed with its unit, above zero.
pub fn seconds(option: &str, text: &str) -> Result<f64, Failure> {
    let units = [("ms", 1e-3), ("min", 60.0), ("s", 1.0)];
    let typed = text.trim();
    let found = units.iter().find_map(|(unit, factor)| Some((typed.strip_suffix(unit)?.trim(), factor)));
    let value = found.and_then(|(number, factor)| Some(number.parse::<f64>().ok()? * factor));
    match value {
        // A year is more than any run or checkpoint needs, and less than a duration can hold.
        Some(v) if v > 0.0 && v < 3.2e7 => Ok(v),
        Some(v) if v.is_finite() => {
            Err(Failure::usage(format!("{option} {typed} is out of range"), format!("write for example {option} 30s")))
        }
        _ => {
            let message = format!("{option}: `{typed}` is not a time");
            Err(Failure::usage(
                message,
                format!("write a number and one of the units s, ms, min, for example {option} 30s"),
            ))
        }
    }
}
