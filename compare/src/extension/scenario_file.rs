//! A scenario with the text it was read from.

use crate::error::CompareError;
use data::Fault;
use fem::session::{RunSource, sha256};
use models::scenario::{ROBOTS, Setting};
use models::{Scenario, ScenarioError};
use spelling::files::{MOST_TEXT, read_whole};
use std::io::ErrorKind;
use std::ops::Deref;
use std::path::Path;
use toml_edit::{DocumentMut, Item, Table, TableLike, Value};

/// A robot's scenario: what its text means, and the text itself, which an extension keeps.
#[derive(Debug, Clone)]
pub struct ScenarioFile {
    /// File or name, as it was asked for.
    pub name: String,
    /// TOML text of the scenario, with its comments.
    pub text: String,
    /// The same robot as values in SI units.
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
            (Err(cause), _) if cause.kind() == ErrorKind::NotFound => "no robot and no file has this name".to_string(),
            (Err(cause), _) => cause.to_string(),
            (Ok(bytes), _) => match String::from_utf8(bytes) {
                Ok(text) if text.trim().is_empty() => "the file is empty".to_string(),
                Ok(text) => return ScenarioFile::parse(name, &text),
                Err(_) => "it is not a text in UTF-8".to_string(),
            },
        };
        Err(CompareError::Unread { path: name.into(), cause, help: ScenarioFile::help(name, &ROBOTS) })
    }

    /// Help where a file of this name cannot be read, with the names of shipped ones.
    pub fn help(name: &str, shipped: &[&str]) -> String {
        if data::sets().iter().any(|set| set.name == name) {
            return format!("{name} is data, and the scenario comes first: for example `ibr compare epam {name}`");
        }
        let meant = spelling::meant(name, shipped.iter().copied());
        let names = shipped.join(", ");
        format!("{meant}give a TOML file, or a shipped robot: {names}; `ibr new epam > my.toml` makes a start")
    }

    /// Of a text; `name` is for messages.
    ///
    /// # Errors
    /// A fault in it with its line and what to write.
    pub fn parse(name: &str, text: &str) -> Result<ScenarioFile, CompareError> {
        let scenario = Scenario::parse(text).map_err(|error| fault(name, text, &error))?;
        Ok(ScenarioFile { name: name.into(), text: text.into(), scenario })
    }

    /// The same robot, for code that handles planar robots only.
    ///
    /// # Errors
    /// Strips round the body, with their line.
    pub fn planar(self) -> Result<ScenarioFile, CompareError> {
        if !self.scenario.is_spatial() {
            return Ok(self);
        }
        let start = ["[[strip]]", "azimuth_deg", "turns"].iter().find_map(|key| self.text.find(key));
        let error = ScenarioError {
            message: "this robot has strips round the body, and what was asked is built for planar robots".into(),
            help: Some(
                "ibr predict, compare and diagnose take it; for the rest remove [[strip]], azimuth_deg and turns"
                    .into(),
            ),
            span: start.map(|start| (start, start + 1)),
        };
        Err(fault(&self.name, &self.text, &error))
    }

    /// The same with values set, each at its place such as `body.radius_mm` and written as in TOML; the rest of the text stays.
    /// The first of several tables `[[strip]]` is `strip.1`.
    ///
    /// # Errors
    /// A value that is not TOML, a place below something that is not a table; a fault of the new text with its line.
    pub fn with(&self, changes: &[(String, String)]) -> Result<ScenarioFile, CompareError> {
        let new = self.with_in_space(changes)?;
        if self.scenario.is_spatial() { Ok(new) } else { new.planar() }
    }

    /// The scenario of [`ScenarioFile::with`] without its text, in microseconds where only numbers change. Errors as there.
    pub fn scenario_with(&self, changes: &[(String, String)]) -> Result<Scenario, CompareError> {
        fn setting((place, text): &(String, String)) -> Option<Setting<'_>> {
            let (table, key) = place.rsplit_once('.')?;
            let is_whole = text.parse::<i64>().is_ok();
            Some(Setting { table, key, number: text.parse().ok()?, is_whole })
        }
        let settings: Option<Vec<Setting>> = changes.iter().map(setting).collect();
        match settings.and_then(|settings| self.scenario.with_numbers(&settings)) {
            Some(scenario) => Ok(scenario),
            None => Ok(self.with(changes)?.scenario),
        }
    }

    /// As [`ScenarioFile::with`], and strips round the body may come in. Errors as there.
    pub fn with_in_space(&self, changes: &[(String, String)]) -> Result<ScenarioFile, CompareError> {
        let refused = |message: String| {
            CompareError::refused(message, "write for example body.radius_mm = 40, and text in quotes")
        };
        let mut document = self.document()?;
        for (place, text) in changes {
            let value: Value = text.parse().map_err(|_| refused(format!("{place} = {text} is not a TOML value")))?;
            set(&mut document, place, value)
                .ok_or_else(|| refused(format!("{place} is not in a table of {}", self.name)))?;
        }
        ScenarioFile::parse(&self.name, &document.to_string())
    }

    /// The same without these effects; the rest of the text stays.
    ///
    /// # Errors
    /// An effect that it does not have.
    pub fn without(&self, effects: &[String]) -> Result<ScenarioFile, CompareError> {
        let mut document = self.document()?;
        let mut tables = document.get_mut("effects").and_then(Item::as_table_like_mut);
        for name in effects {
            if tables.as_mut().and_then(|tables| tables.remove(name)).is_none() {
                let known: Vec<&str> = self.effects.iter().map(|effect| effect.name.as_str()).collect();
                let help = if known.is_empty() { "it has none".into() } else { spelling::known(name, &known) };
                return Err(CompareError::refused(format!("{} has no effect \"{name}\"", self.name), help));
            }
        }
        ScenarioFile::parse(&self.name, &document.to_string())
    }

    fn document(&self) -> Result<DocumentMut, CompareError> {
        let refused = |error: toml_edit::TomlError| CompareError::refused(error.message(), "write it as TOML");
        self.text.parse().map_err(refused)
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

    /// For finite elements, with the folder that paths in it count from.
    pub fn source(&self, folder: &Path) -> RunSource {
        RunSource { text: self.text.clone(), name: self.name.clone(), folder: folder.to_path_buf() }
    }

    /// SHA-256 of the text, in hex.
    pub fn sha256(&self) -> String {
        sha256(self.text.as_bytes())
    }
}

/// Puts a value at a place; `None` if something above it is not a table.
fn set(document: &mut DocumentMut, place: &str, value: Value) -> Option<()> {
    let mut parts: Vec<&str> = place.split('.').collect();
    let key = parts.pop()?;
    let mut at: &mut dyn TableLike = document.as_table_mut();
    let mut parts = parts.into_iter();
    while let Some(part) = parts.next() {
        let mut implicit = Table::new();
        implicit.set_implicit(true);
        at = match at.entry(part).or_insert(Item::Table(implicit)) {
            Item::ArrayOfTables(tables) => tables.get_mut(parts.next()?.parse::<usize>().ok()?.checked_sub(1)?)?,
            item => item.as_table_like_mut()?,
        };
    }
    match at.get_mut(key).and_then(Item::as_value_mut) {
        Some(old) => {
            let decor = old.decor().clone();
            *old = value;
            *old.decor_mut() = decor;
        }
        None => _ = at.insert(key, Item::Value(value)),
    }
    Some(())
}

/// A refused scenario with its place in the file.
pub fn fault(name: &str, text: &str, error: &ScenarioError) -> CompareError {
    let other = fem::case::is_case(text).then(|| format!("this is a finite element case: ibr simulate {name}"));
    let help = other.or(error.help.clone()).unwrap_or_else(|| what_to_type(&error.message).into());
    let fault = Fault::of_text(name, text, error.span, error.message.clone(), help);
    CompareError::Scenario(Box::new(fault))
}

fn what_to_type(message: &str) -> &'static str {
    match message {
        m if m.contains("expected f64") => {
            "write a plain number without quotation marks; the unit is in the name of the key"
        }
        m if m.contains("expected i64") => "write a whole number without quotation marks",
        _ => "`ibr new epam` prints a complete scenario to compare with",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn changed(changes: &[(&str, &str)]) -> Result<ScenarioFile, CompareError> {
        let changes: Vec<_> = changes.iter().map(|(place, value)| (place.to_string(), value.to_string())).collect();
        ScenarioFile::read("epam").unwrap().with(&changes)
    }

    #[test]
    fn values_are_set_at_their_places_and_comments_stay() {
        let new =
            changed(&[("body.radius_mm", "45"), ("effects.friction.moment_nm", "0.2"), ("name", "'mine'")]).unwrap();
        assert_eq!((new.radius_m, new.scenario.name.as_str()), (0.045, "mine"));
        assert!(new.effects.iter().any(|effect| effect.name == "friction" && effect.values == [0.2]));
        let old = ScenarioFile::read("epam").unwrap().text;
        let is_kept = |line: &&str| line.starts_with('#') && !new.text.contains(*line);
        assert_eq!(old.lines().find(is_kept), None);
    }

    #[test]
    fn a_scenario_without_its_text_is_that_of_the_text() {
        let robot = ScenarioFile::read("epam").unwrap();
        let set = |place: &str, value: &str| [(place.to_string(), value.to_string())];
        let taken = [("body.radius_mm", "45"), ("actuator.width_mm", "5.28e1"), ("effects.weld_width.width_mm", "4.0")];
        for (place, value) in taken.into_iter().chain([("effects.friction.moment_nm", "0.2"), ("name", "'mine'")]) {
            let set = set(place, value);
            assert_eq!(robot.scenario_with(&set).unwrap(), robot.with(&set).unwrap().scenario, "{place}");
        }
        for (place, value) in [("body.radius_mm", "-45"), ("actuator.count", "5.5"), ("radius_mm", "45")] {
            let set = set(place, value);
            let told = [robot.scenario_with(&set).map(|_| ()), robot.with(&set).map(|_| ())];
            let [short, long] = told.map(|refused| refused.unwrap_err().to_string());
            assert_eq!(short, long);
        }
    }

    #[test]
    fn what_cannot_be_set_is_refused_with_its_place() {
        let told = |changes: &[(&str, &str)]| changed(changes).unwrap_err().to_string();
        assert!(told(&[("body.radius_mn", "45")]).contains("epam:"), "{}", told(&[("body.radius_mn", "45")]));
        assert!(told(&[("body.radius_mm", "45 mm")]).contains("not a TOML value"));
        assert!(told(&[("name.first", "45")]).contains("is not in a table"));
        assert!(told(&[("markers.s_mm.1", "45")]).contains("is not in a table"));
    }

    #[test]
    fn effects_are_dropped_by_name_and_comments_stay() {
        let robot = ScenarioFile::read("epam").unwrap();
        let drop = |names: &[&str]| robot.without(&names.iter().map(ToString::to_string).collect::<Vec<_>>());
        let new = drop(&["chord_arm", "fold_energy"]).unwrap();
        assert_eq!(new.effects.len() + 2, robot.effects.len());
        assert!(!new.text.contains("chord_arm") && new.text.contains("# published: D_IBR = 80 mm"));
        let error = drop(&["chord_arms"]).unwrap_err();
        assert!(error.to_string().contains("chord_arms") && error.help().unwrap().contains("chord_arm"), "{error:?}");
    }

    #[test]
    fn a_strip_is_named_by_its_number() {
        let text = "[body]\nradius_mm = 40\nlength_mm = 360\npressure_kpa = 2\n[actuator]\nkind = 'epam'\nlength_mm = 60\n\
                    width_mm = 50\ncount = 6\nazimuth_deg = 0\n[[strip]]\nazimuth_deg = 90\nchannel = 1\n";
        let robot = ScenarioFile::parse("two", text).unwrap();
        let turned = |place: &str| robot.with_in_space(&[(place.into(), "80".into())]);
        assert!(turned("strip.1.azimuth_deg").unwrap().text.contains("[[strip]]\nazimuth_deg = 80\n"));
        for place in ["strip.0.azimuth_deg", "strip.2.azimuth_deg", "strip.azimuth_deg", "strip.1"] {
            assert!(turned(place).unwrap_err().to_string().contains("is not in a table of two"), "{place}");
        }
    }
}
