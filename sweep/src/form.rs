//! TOML files that name a robot: a study and a wish.

use compare::{CompareError, ScenarioFile};
use data::Fault;
use serde::de::DeserializeOwned;
use spelling::files::{MOST_TEXT, read_whole};
use std::path::Path;
use toml::Spanned;

/// Bytes at fault, message and help.
pub(crate) type Wrong = (Option<std::ops::Range<usize>>, String, &'static str);

/// Reads the robot of a name.
pub type ReadRobot = fn(&str) -> Result<ScenarioFile, CompareError>;

/// What such a file is called, and how it is read.
pub(crate) struct Form<Raw, T> {
    pub what: &'static str,
    pub page: &'static str,
    pub scenario: fn(&Raw) -> &Spanned<String>,
    /// From the robot, and the folder that paths in its file count from.
    pub of: fn(Raw, ScenarioFile, &Path) -> Result<T, Wrong>,
}

impl<Raw: DeserializeOwned, T> Form<Raw, T> {
    /// Reads a file; `scenario` reads the robot, first as a file in the same folder.
    pub(crate) fn read(&self, path: &Path, scenario: ReadRobot) -> Result<T, CompareError> {
        let name = path.display().to_string();
        let unread = |cause: String| {
            let help = format!("write a {} as {} shows", self.what, self.page);
            CompareError::Unread { path: name.clone(), cause, help }
        };
        let bytes = read_whole(path, MOST_TEXT).map_err(|cause| unread(cause.to_string()))?;
        let text = String::from_utf8(bytes).map_err(|_| unread("it is not a text in UTF-8".into()))?;
        self.parse(&name, &text, path.parent().unwrap_or(Path::new("")), scenario)
    }

    /// Of a text; `name` is for messages.
    pub(crate) fn parse(&self, name: &str, text: &str, folder: &Path, scenario: ReadRobot) -> Result<T, CompareError> {
        let fault = |(span, message, help): (Option<std::ops::Range<usize>>, String, &str)| {
            let span = span.map(|span| (span.start, span.end));
            CompareError::Scenario(Box::new(Fault::of_text(name, text, span, message, help.into())))
        };
        let raw: Raw = toml::from_str(text).map_err(|error| {
            let help = format!("{} shows every key of a {}", self.page, self.what);
            fault((error.span(), error.message().to_string(), &help))
        })?;
        let named = (self.scenario)(&raw);
        let beside = folder.join(named.get_ref());
        if beside == Path::new(name) {
            let message = format!("`scenario` names the {} itself", self.what);
            return Err(fault((Some(named.span()), message, "name a robot, for example scenario = \"epam\"")));
        }
        let spec = if beside.exists() { beside.display().to_string() } else { named.get_ref().clone() };
        let base = scenario(&spec)?;
        (self.of)(raw, base, beside.parent().unwrap_or(folder)).map_err(fault)
    }
}
