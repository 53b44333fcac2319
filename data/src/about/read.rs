//! From the text of an `about.toml` to a description.

use std::path::Path;

use spelling::files::{MOST_TEXT, read_whole};

use super::About;
use super::checks::{CheckedText, RawAbout};
use crate::error::{DataError, Fault, Result};

/// Reads an `about.toml`.
///
/// # Errors
/// File not readable; unknown key, wrong type, missing key; a length not positive; a direction that is not a unit vector.
pub fn read_about(path: &Path) -> Result<About> {
    let shown = path.display().to_string();
    let read = read_whole(path, MOST_TEXT).and_then(|bytes| String::from_utf8(bytes).map_err(std::io::Error::other));
    let text = read.map_err(|cause| {
        let help = "check the path; the file must be UTF-8 text";
        DataError::file(&shown, format!("cannot read the file: {cause}"), help)
    })?;
    parse_about(&shown, &text)
}

/// Reads the text of an `about.toml`; `file` names it in errors.
///
/// ```
/// let text = "title = \"a\"\nprovenance = \"measured\"\nsource = \"us\"\nlicence = \"CC0-1.0\"\n\
///             [markers]\nnames = [\"tip\"]\ns_mm = [330]\n";
/// let about = data::parse_about("about.toml", text).unwrap();
/// assert!((about.markers[0].station_m - 0.33).abs() < 1e-12, "lengths become metres");
/// ```
pub fn parse_about(file: &str, text: &str) -> Result<About> {
    let raw: RawAbout = parse_toml(file, text)?;
    let check = CheckedText { file, text };
    let geometry = raw.geometry.map(|geometry| check.geometry(geometry)).transpose()?;
    Ok(About {
        markers: raw.markers.map_or(Ok(Vec::new()), |markers| check.markers(markers))?,
        gravity_direction: raw.gravity.map(|gravity| check.direction(&gravity.direction)).transpose()?,
        direct: raw.direct,
        bending_nm2: raw.bending.map(|bending| check.bending(&bending)).transpose()?,
        measured: check.measured(raw.measured)?,
        runs: check.runs(raw.run)?,
        title: check.filled("title", &raw.title)?,
        source: check.filled("source", &raw.source)?,
        licence: check.filled("licence", &raw.licence)?,
        provenance: raw.provenance,
        actuator: raw.actuator.map(|kind| kind.trim().to_lowercase()),
        geometry,
        notes: raw.notes,
    })
}

/// Parses TOML into a struct with the place of every fault.
pub(crate) fn parse_toml<T: serde::de::DeserializeOwned>(file: &str, text: &str) -> Result<T> {
    toml::from_str(text).map_err(|cause| {
        let span = cause.span().map(|span| (span.start, span.end));
        let message = cause.message().trim().replace('\n', "; ");
        let help = "the keys and an example are in docs/scenario.md, under about.toml".to_string();
        Fault::of_text(file, text, span, message, help).into()
    })
}
