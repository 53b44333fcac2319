//! The programs whose files are understood, the most particular first.

use super::options::ImportOptions;
use super::recording::Recording;
use super::sheet::CellText;
use super::{deeplabcut, kinovea, motive, sleap, tables, tracker, trackmate};
use crate::error::DataError;

/// A kind of tracking file.
#[derive(Debug)]
pub struct Format {
    /// What wrote it.
    pub name: &'static str,
    /// How it is known.
    pub known_by: &'static str,
    /// A small file of this kind below `data/tests`.
    pub fixture: &'static str,
    /// Likelihood below which positions are lost, unless the caller says another; `None` if there is none.
    pub likelihood: Option<f64>,
    /// Whether a text, of which these are the first lines as cells, is of this kind.
    pub(crate) recognise: fn(&CellText, &[Vec<&str>], &ImportOptions) -> bool,
    /// Its runs.
    pub(crate) read: fn(&CellText, &ImportOptions) -> Result<Vec<Recording>, DataError>,
}

/// All kinds.
pub const FORMATS: [&Format; 10] = [
    &deeplabcut::FORMAT,
    &sleap::FORMAT,
    &motive::FORMAT,
    &tracker::FORMAT,
    &kinovea::TRAJECTORIES,
    &tables::KINEMATICS,
    &trackmate::XML,
    &trackmate::SPOTS,
    &tables::LONG,
    &tables::WIDE,
];

/// A pressure log below `data/tests`.
pub const LOG_FIXTURE: &str = "cases/c01-deeplabcut/pressure.csv";

/// Lines that a kind is known by.
const LOOKED_AT: usize = 8;

/// The kind of a text.
///
/// # Errors
/// None of them.
pub(crate) fn recognised(sheet: &CellText, options: &ImportOptions) -> Result<&'static Format, DataError> {
    let head = sheet.head(LOOKED_AT);
    let found = FORMATS.into_iter().find(|format| (format.recognise)(sheet, &head, options));
    found.ok_or_else(|| {
        let first = sheet.lines().next();
        let shown: String = first.map_or(String::new(), |(_, line)| line.chars().take(80).collect());
        let kinds: Vec<String> = FORMATS.iter().map(|f| format!("{} ({})", f.name, f.known_by)).collect();
        let help = format!(
            "understood are {}. For a table with other names of columns say which is which: --map t=Time,marker=Point,x=PosX,y=PosY",
            kinds.join("; ")
        );
        sheet.fault(1, format!("no program is known that writes such a file; it begins with \"{shown}\""), help)
    })
}
