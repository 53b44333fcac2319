//! Motive (OptiTrack): a line of settings, then rows Type, Name, ID, Position, axes, and a row for every frame.

use super::columns::lengths;
use super::counted;
use super::formats::Format;
use super::options::ImportOptions;
use super::recording::{FrameClock, Lengths, Pivot, Recording};
use super::sheet::CellText;
use crate::error::DataError;

pub(super) const FORMAT: Format = Format {
    name: "Motive (OptiTrack)",
    known_by: "first line Format Version",
    likelihood: None,
    recognise: |_, head, _| head.first().is_some_and(|row| row[0] == "Format Version"),
    read,
};

/// The rows above the frames.
#[derive(Default)]
struct Head<'a> {
    settings: Vec<&'a str>,
    types: Vec<&'a str>,
    names: Vec<&'a str>,
    what: Vec<&'a str>,
}

fn read(sheet: &CellText, _options: &ImportOptions) -> Result<Vec<Recording>, DataError> {
    let mut head = Head::default();
    let mut lines = sheet.lines();
    let axes = loop {
        let Some((number, line)) = lines.next() else {
            return Err(sheet.fault(
                0,
                "the row Frame, Time (Seconds) is missing",
                "export the take again as CSV with its header",
            ));
        };
        let cells = sheet.split(line);
        match (cells[0], cells.get(1).copied().unwrap_or_default()) {
            ("Format Version", _) => head.settings = cells,
            ("Frame", _) => break (number, cells),
            (_, "Type") => head.types = cells,
            (_, "Name") => head.names = cells,
            (_, "ID" | "Parent") => {}
            _ => head.what = cells,
        }
    };
    let mut pivot = Pivot::new(unit(sheet, &head)?, FrameClock::Seconds);
    let columns = columns(sheet, &head, &axes, &mut pivot)?;
    if columns.is_empty() {
        return Err(sheet.fault(
            axes.0,
            "no column is the position of a marker",
            "export markers, not only rigid bodies",
        ));
    }
    let time = axes.1.iter().position(|name| name.starts_with("Time")).unwrap_or(1);
    let mut cells = Vec::new();
    for (number, line) in lines {
        sheet.split_into(line, &mut cells);
        let frame = pivot.frame(sheet.time(cells.get(time).copied().unwrap_or_default(), number, "Time (Seconds)")?);
        for (marker, parts) in &columns {
            let value =
                |axis: usize| sheet.expect(cells.get(parts[axis]).copied().unwrap_or_default(), number, "Position");
            pivot.put(frame, *marker, [value(0)?, value(1)?, value(2)?], true);
        }
    }
    Ok(vec![pivot.finish()])
}

fn unit(sheet: &CellText, head: &Head) -> Result<Lengths, DataError> {
    let said = head.settings.iter().position(|cell| *cell == "Length Units").and_then(|at| head.settings.get(at + 1));
    let Some(word) = said else { return Ok(Lengths::Unsaid) };
    let help = "export in meters, centimeters or millimeters";
    lengths(&word.to_lowercase())
        .ok_or_else(|| sheet.fault(1, format!("Length Units are {word}, which is not known"), help))
}

/// Columns of every marker's position; markers that were not named in Motive are left out.
///
/// # Errors
/// A marker that lacks one of its coordinates.
fn columns(
    sheet: &CellText,
    head: &Head,
    (line, axes): &(u64, Vec<&str>),
    pivot: &mut Pivot,
) -> Result<Vec<(usize, [usize; 3])>, DataError> {
    let cell = |row: &[&'_ str], index: usize| row.get(index).map_or(String::new(), ToString::to_string);
    let is_marker =
        |index: &usize| cell(&head.types, *index).contains("Marker") && cell(&head.what, *index) == "Position";
    let named = |name: &str| !name.rsplit(':').next().unwrap_or_default().starts_with("Unlabeled");
    let found: Vec<usize> = (2..axes.len()).filter(is_marker).collect();
    let unnamed = found.iter().filter(|index| !named(&cell(&head.names, **index))).count() / 3;
    if unnamed > 0 {
        pivot.recording.told.push(format!(
            "left out: {}; name them in Motive to have them",
            counted(unnamed as u64, "unlabeled marker")
        ));
    }
    let assets = |name: &str| name.split_once(':').map(|(asset, _)| asset.to_string());
    let names: Vec<String> = found.iter().map(|index| cell(&head.names, *index)).filter(|name| named(name)).collect();
    let one = names.iter().all(|name| assets(name) == assets(&names[0]));
    let mut columns: Vec<(usize, [Option<usize>; 3])> = Vec::new();
    for index in found {
        let name = cell(&head.names, index);
        let Some(axis) = ["X", "Y", "Z"].iter().position(|axis| *axis == axes[index]).filter(|_| named(&name)) else {
            continue;
        };
        let short = name.split_once(':').filter(|_| one).map_or(name.as_str(), |(_, short)| short);
        let marker = pivot.marker(short);
        if columns.last().is_none_or(|(last, _)| *last != marker) {
            columns.push((marker, [None; 3]));
        }
        if let Some((_, parts)) = columns.last_mut() {
            parts[axis] = Some(index);
        }
    }
    let whole = |(marker, parts): (usize, [Option<usize>; 3])| match parts {
        [Some(x), Some(y), Some(z)] => Ok((marker, [x, y, z])),
        _ => {
            let message = format!("the position of {} lacks one of X, Y, Z", pivot.recording.markers[marker]);
            Err(sheet.fault(*line, message, "export the take again as CSV with its header"))
        }
    };
    columns.into_iter().map(whole).collect()
}
