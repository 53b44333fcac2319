//! A scenario with the text it was read from.

use crate::error::CompareError;
use data::Fault;
use fem::session::sha256;
use models::scenario::SHIPPED;
use models::{Scenario, ScenarioError};
use spelling::files::{MOST_TEXT, read_whole};
use std::ops::Deref;
use std::path::Path;

/// A robot's scenario: what its text means, and the text itself, which an extension keeps.
#[derive(Debug, Clone)]
pub struct ScenarioFile {
    /// File or name, as it was asked for.
    pub name: String,
    /// The TOML text.
    pub text: String,
    /// What it means.
    pub scenario: Scenario,
}

impl Deref for ScenarioFile {
    type Target = Scenario;

    fn deref(&self) -> &Scenario {
        &self.scenario
    }
}

impl ScenarioFile {
    /// Reads a TOML file, or takes a shipped robot by name.
    ///
    /// # Errors
    /// No such file, or a fault in it with its line and what to write.
    pub fn read(name: &str) -> Result<ScenarioFile, CompareError> {
        let cause = match (read_whole(Path::new(name), MOST_TEXT), models::shipped(name)) {
            (Err(_), Some(text)) if !Path::new(name).exists() => return ScenarioFile::parse(name, text),
            (Err(cause), _) => cause.to_string(),
            (Ok(bytes), _) => match String::from_utf8(bytes) {
                Ok(text) if text.trim().is_empty() => "the file is empty".to_string(),
                Ok(text) => return ScenarioFile::parse(name, &text),
                Err(_) => "it is not a text in UTF-8".to_string(),
            },
        };
        let names: Vec<&str> = SHIPPED.iter().map(|s| s.0).collect();
        let (meant, names) = (spelling::meant(name, names.iter().copied()), names.join(", "));
        let help =
            format!("{meant}give a TOML file, or a shipped robot: {names}; `ibr new epam > my.toml` makes a start");
        Err(CompareError::Unread { path: name.into(), cause, help })
    }

    /// Of a text; `name` is for messages.
    ///
    /// # Errors
    /// A fault in it with its line and what to write.
    pub fn parse(name: &str, text: &str) -> Result<ScenarioFile, CompareError> {
        let scenario = Scenario::parse(text).map_err(|error| fault(name, text, &error))?;
        Ok(ScenarioFile { name: name.into(), text: text.into(), scenario })
    }

    /// The scenario that an embedded set or a folder of data brings along.
    ///
    /// # Errors
    /// A fault in it.
    pub fn beside(data: &str) -> Result<Option<ScenarioFile>, CompareError> {
        let of_set = || data::set_file(data, "scenario.toml").ok().map(str::to_string);
        let text = std::fs::read_to_string(Path::new(data).join("scenario.toml")).ok().or_else(of_set);
        text.map(|text| ScenarioFile::parse(&format!("{data}/scenario.toml"), &text)).transpose()
    }

    /// SHA-256 of the text, in hex.
    pub fn sha256(&self) -> String {
        sha256(self.text.as_bytes())
    }
}

/// A refused scenario with its place in the file.
pub fn fault(name: &str, text: &str, error: &ScenarioError) -> CompareError {
    let other = fem::case::is_case(text).then(|| format!("this is a finite element case: ibr simulate {name}"));
    let help = other.or(error.help.clone()).unwrap_or_else(|| what_to_type(&error.message).into());
    let fault = Fault::of_text(name, text, error.span, error.message.clone(), help);
    CompareError::Scenario(Box::new(fault))
}

/// Help for TOML errors that bring none.
fn what_to_type(message: &str) -> &'static str {
    match message {
        m if m.contains("expected f64") => {
            "write a plain number without quotation marks; the unit is in the name of the key"
        }
        m if m.contains("expected i64") => "write a whole number without quotation marks",
        _ => "`ibr new epam` prints a complete scenario to compare with",
    }
}
