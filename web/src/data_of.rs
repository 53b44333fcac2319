//! Measurements of the page: an embedded set, or a table that was dropped onto it.

use compare::{CompareError, Evidence};
use data::{ReadOptions, SetInfo, parse_about, parse_markers, set_about, set_file};
use serde::Deserialize;
use serde_json::{Value, json};

/// Measurements of a question: an embedded set, or the text of a table.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Measured {
    /// Name of an embedded set, or of the file of the table.
    pub name: String,
    /// A marker table; without it the set of that name.
    #[serde(default)]
    pub csv: Option<String>,
    /// Description of the table, the text of its `about.toml`.
    #[serde(default)]
    pub about: Option<String>,
}

impl Measured {
    /// What was measured.
    ///
    /// # Errors
    /// A fault of table or description with its line and what to write.
    pub fn evidence(&self) -> Result<Evidence, CompareError> {
        let Some(csv) = &self.csv else { return Evidence::read(&self.name) };
        let about = self.about.as_ref().map(|text| parse_about("about.toml", text)).transpose()?;
        let options = ReadOptions { about: about.as_ref(), ..ReadOptions::default() };
        let dataset = parse_markers(&self.name, &mut csv.as_bytes(), options, &mut |_, _| ())?;
        Ok(Evidence::of(dataset, about))
    }
}

/// The embedded sets of markers: what they are, which robot they are of, and their files.
pub(crate) fn examples() -> Vec<Value> {
    let told = |set: SetInfo| {
        let about = set_about(&set.name).ok()?;
        Some(json!({
            "name": set.name, "title": set.title, "provenance": set.provenance.word(), "actuator": about.actuator,
            "csv": set_file(&set.name, "markers.csv").ok()?, "about": set_file(&set.name, "about.toml").ok()?,
        }))
    };
    data::sets().into_iter().filter(SetInfo::has_markers).filter_map(told).collect()
}
