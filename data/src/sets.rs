//! The embedded datasets: every folder of `data/sets/` is in the binary, without a list to edit.

use include_dir::{Dir, include_dir};

use crate::about::{About, Provenance, parse_about};
use crate::error::{DataError, Result};

static SETS: Dir = include_dir!("$CARGO_MANIFEST_DIR/sets");

/// What `ibr data list` prints of an embedded set.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct SetInfo {
    /// Name of its folder, which `load` accepts in place of a path.
    pub name: String,
    /// Title of the set in one line.
    pub title: String,
    /// How its numbers came to be.
    pub provenance: Provenance,
    /// Who or what they come from.
    pub source: String,
    /// Licence under which the set may be passed on.
    pub licence: String,
    /// File names in the folder, sorted.
    pub files: Vec<String>,
}

impl SetInfo {
    /// Whether the set holds marker positions (and not only published tables).
    pub fn has_markers(&self) -> bool {
        self.files.iter().any(|file| file == "markers.csv")
    }
}

/// All embedded sets, sorted by name. A set whose `about.toml` does not parse is left out; the tests of this crate see
/// to it that there is none.
pub fn sets() -> Vec<SetInfo> {
    let mut sets: Vec<SetInfo> = names().iter().filter_map(|name| info(name).ok()).collect();
    sets.sort_by(|a, b| a.name.cmp(&b.name));
    sets
}

/// The text of one file of an embedded set, for example `set_file("du-pasquier-2023", "published.toml")`.
///
/// # Errors
/// No such set or file, or it is not UTF-8.
pub fn set_file(set: &str, file: &str) -> Result<&'static str> {
    let shown = shown(set, file);
    let missing = || {
        let help = format!("embedded sets: {}", names().join(", "));
        DataError::file(&shown, "no such file among the embedded sets", help)
    };
    let found = SETS.get_file(format!("{set}/{file}")).ok_or_else(missing)?;
    found.contents_utf8().ok_or_else(|| DataError::of(&shown, "the text is not UTF-8", "save the file as UTF-8"))
}

/// The description of an embedded set.
///
/// ```
/// assert_eq!(data::set_about("fem-epam").unwrap().provenance, data::Provenance::Synthetic);
/// assert!(data::set_about("fem-epan").is_err());
/// ```
///
/// # Errors
/// No such set, or its `about.toml` is wrong.
pub fn set_about(set: &str) -> Result<About> {
    parse_about(&shown(set, "about.toml"), set_file(set, "about.toml")?)
}

pub(crate) fn names() -> Vec<&'static str> {
    let mut names: Vec<&str> = SETS.dirs().filter_map(|dir| dir.path().file_name()?.to_str()).collect();
    names.sort_unstable();
    names
}

/// How a file of an embedded set is named in errors.
pub(crate) fn shown(set: &str, file: &str) -> String {
    format!("set:{set}/{file}")
}

fn info(name: &str) -> Result<SetInfo> {
    let About { title, provenance, source, licence, .. } = set_about(name)?;
    let files = SETS.get_dir(name).into_iter().flat_map(Dir::files);
    let mut files: Vec<String> =
        files.filter_map(|file| Some(file.path().file_name()?.to_str()?.to_string())).collect();
    files.sort();
    Ok(SetInfo { name: name.to_string(), title, provenance, source, licence, files })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::load::load;

    #[test]
    fn every_folder_is_a_set_with_title_provenance_source_and_licence() {
        let found = sets();
        assert!(found.iter().any(|set| set.name == "du-pasquier-2023"));
        for name in names() {
            set_about(name).unwrap();
            let set = found.iter().find(|set| set.name == name).unwrap();
            assert!(!set.title.is_empty() && !set.source.is_empty() && !set.licence.is_empty(), "{name}");
            assert!(set.files.iter().any(|file| file == "about.toml") && set.files.len() > 1, "{name}");
        }
    }

    #[test]
    fn every_marker_table_of_a_set_loads_under_the_name_of_its_folder() {
        for set in sets().into_iter().filter(SetInfo::has_markers) {
            let (dataset, about) = load(&set.name, &mut |_, _| ()).unwrap();
            let about = about.unwrap();
            assert_eq!((dataset.name.as_str(), about.provenance), (set.name.as_str(), set.provenance));
            assert!(dataset.markers.iter().all(|marker| marker.station_m.is_some()), "{}: stations", set.name);
            assert!(dataset.coordinates_m.iter().all(|value| value.is_finite()));
        }
    }

    #[test]
    fn an_unknown_set_names_the_known_ones() {
        let error = set_file("unknown-1900", "about.toml").unwrap_err();
        assert!(error.help().contains("du-pasquier-2023"), "{error}");
    }
}
