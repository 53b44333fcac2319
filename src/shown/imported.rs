//! What an import understood.

use crate::prelude::*;
use data::import::Imported;

/// What was understood, a line each.
pub(crate) fn told(made: &Imported) -> String {
    let set = &made.dataset;
    let count = |n: usize, word: &str| format!("{n} {word}{}", if n == 1 { "" } else { "s" });
    let sizes = [(set.runs.len(), "run"), (set.holds.len(), "hold"), (set.markers.len(), "marker")];
    format!("{}\n{}", sizes.map(|(n, word)| count(n, word)).join(", "), lines("- ", &made.told))
}

/// `ibr.data.import`: `ibr data import FILES`
#[derive(Serialize)]
pub(crate) struct ImportAnswer<'a> {
    /// The program that wrote the files
    pub program: &'a str,
    /// Labels of runs
    pub runs: &'a [String],
    /// Labels of markers
    pub markers: Vec<&'a str>,
    /// Holds
    pub holds: usize,
    /// What was understood and assumed
    pub told: &'a [String],
    /// Folder that was written; null without `--out`
    pub folder: Option<String>,
}

impl<'a> ImportAnswer<'a> {
    /// Of an import into a folder.
    pub(crate) fn of(made: &'a Imported, folder: Option<&Path>) -> ImportAnswer<'a> {
        let Imported { dataset: set, program, told, .. } = made;
        let markers = set.markers.iter().map(|marker| marker.name.as_str()).collect();
        let folder = folder.map(|out| out.display().to_string());
        ImportAnswer { program, runs: &set.runs, markers, holds: set.holds.len(), told, folder }
    }
}

/// `ibr.data.import.example`: `ibr data import --example FOLDER`
#[derive(Serialize)]
pub(crate) struct ImportExample {
    /// Files that were written
    pub files: Vec<String>,
}

/// `ibr.characterize.example`: `ibr characterize --example FOLDER`
#[derive(Serialize)]
pub(crate) struct CharacterizeExample {
    /// Files that were written
    pub files: Vec<String>,
}

/// `ibr.data.generate`: `ibr data generate SCENARIO`
#[derive(Serialize)]
pub(crate) struct Generated {
    /// Folder that was written
    pub folder: String,
    /// Runs
    pub runs: usize,
}

/// `ibr.data.fem`: `ibr data fem SCENARIO`
#[derive(Serialize)]
pub(crate) struct SeenByFem {
    /// Folder that was written
    pub folder: String,
    /// Runs
    pub runs: usize,
}
