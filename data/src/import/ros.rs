//! Topics of ROS as `rostopic echo -p` prints them: stamps in nanoseconds since 1970, and places in metres.

use super::format::Format;
use super::layout::{Layout, PARTS};
use super::options::ImportOptions;
use super::recording::{Lengths, Recording};
use super::sheet::CellText;
use crate::error::Result;

pub(super) const FORMAT: Format = Format {
    name: "ROS (topic print)",
    known_by: "columns %time and field.NAME.x",
    fixture: "cases/c25-ros-echo/all_markers.csv",
    likelihood: None,
    recognise: |_, head, _| head.first().is_some_and(|row| is_topic(row[0])),
    read,
};

/// Whether the first column belongs to a topic.
pub(super) fn is_topic(name: &str) -> bool {
    name == "%time" || name.starts_with("field.")
}

/// The column of the time: of the message, else of its arrival.
pub(super) fn stamp(names: &[&str]) -> usize {
    names.iter().position(|name| name.ends_with("header.stamp")).unwrap_or(0)
}

/// Parts of a name that are not of a marker.
const FRAME: [&str; 6] = ["field", "pose", "transform", "position", "translation", "point"];
/// What x, y and z of a message may be besides a place.
const NO_PLACE: [&str; 5] = ["orientation", "rotation", "linear", "angular", "size"];

fn read(sheet: &CellText, _options: &ImportOptions) -> Result<Vec<Recording>> {
    let names = sheet.head(1).pop().unwrap_or_default();
    let mut layout = Layout::new(stamp(&names), Some(1.0), Lengths::Metres(1.0));
    layout.width = Some(names.len());
    for (column, name) in names.iter().enumerate() {
        let mut words: Vec<&str> = name.split('.').collect();
        let part = PARTS[..3].iter().position(|part| words.last() == Some(part));
        let Some(part) = part.filter(|_| !words.iter().any(|word| NO_PLACE.contains(word))) else { continue };
        words.pop();
        words.retain(|word| !FRAME.contains(word));
        layout.add(sheet, 1, &words.join("_"), part, column)?;
    }
    layout.read(sheet, 1, 2, sheet.lines().skip(1))
}
