//! Topics of ROS as `rostopic echo -p` prints them: stamps in nanoseconds since 1970, and places in metres.

use super::format::*;

pub(super) const FORMAT: Format = Format {
    name: "ROS (topic print)",
    known_by: "columns %time and field.NAME.x",
    fixture: "cases/c25-ros-echo/all_markers.csv",
    likelihood: None,
    recognise: |begin| begin.first() == "%time" || begin.first().starts_with("field."),
    read,
};

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
    let mut layout = FrameColumns::new(1, stamp(&names), Some(1.0), Lengths::Metres(1.0));
    layout.width = Some(names.len());
    let columns = names.iter().enumerate().filter_map(|(column, name)| {
        let mut words: Vec<&str> = name.split('.').collect();
        let axis = PARTS[..LIKELIHOOD].iter().position(|part| words.last() == Some(part))?;
        words.pop();
        let is_place = !words.iter().any(|word| NO_PLACE.contains(word));
        words.retain(|word| !FRAME.contains(word));
        is_place.then(|| (column, words.join("_"), axis))
    });
    layout.columns(sheet, columns)?;
    layout.read(sheet, 2, sheet.lines().skip(1))
}
