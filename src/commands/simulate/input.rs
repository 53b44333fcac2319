//! Case and options as typed.

use crate::failure::Failure;
use crate::output::Input;
use fem::FemError;
use fem::case::{Case, SHIPPED_CASES, is_case, shipped_case};
use fem::robot::{RobotSettings, outputs, problem};
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

/// Reads a case file or the scenario of a robot, or takes a shipped one by name.
pub fn case(spec: &str) -> Result<(NamedCase, Case), Failure> {
    let (text, folder) = text(spec)?;
    let mut read_mesh = |path: &Path| fem::mesh::file::read(&folder.join(path));
    let case = match scenario(&text) {
        Some(robot) => robot.and_then(|scenario| as_case(&scenario)),
        None => Case::parse(&text, &mut read_mesh),
    };
    match case {
        Ok(case) => {
            let input = Input::of(spec, text.as_bytes());
            Ok((NamedCase { text, input, file: spec.into() }, case))
        }
        Err(error) => Err(refused(spec, &text, error)),
    }
}

/// The scenario of a robot, if the text is one and no case; or what is wrong with it.
fn scenario(text: &str) -> Option<Result<Scenario, FemError>> {
    let table = |name: &str| text.lines().any(|line| line.trim() == name);
    let robot = !is_case(text) && table("[body]") && table("[actuator]");
    let fault = |ScenarioError { message, help, span }: ScenarioError| FemError::Case {
        message: help.map_or(message.clone(), |help| format!("{message}\n{help}")),
        span: span.map(|(start, end)| start..end),
    };
    robot.then(|| Scenario::parse(text).map_err(fault))
}

/// A robot with the settings that its scenario does not say at their defaults.
fn as_case(scenario: &Scenario) -> Result<Case, FemError> {
    let problem = problem(scenario, &RobotSettings::default())?;
    let outputs = outputs(scenario, &problem.mesh);
    Ok(Case { problem, outputs })
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
    let cause = match (std::fs::read(path), shipped_case(spec).or(models::shipped(spec))) {
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
    let shipped = SHIPPED_CASES.iter().chain(models::scenario::SHIPPED);
    let names = shipped.map(|c| c.0).collect::<Vec<_>>().join(", ");
    let help = format!(
        "give a finite element case or a robot's scenario, or a shipped one: {names}; `ibr new pillow > my.toml` makes a start"
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
