//! Tracker (physlets.org): a row with the names of the tracks, a row `t, x, y, …`, then a row for every step.

use super::columns::{ColumnName, lengths, si};
use super::formats::Format;
use super::options::ImportOptions;
use super::recording::{FrameClock, Lengths, Pivot, Recording};
use super::sheet::CellText;
use crate::error::DataError;
use crate::units::Measured;

pub(super) const FORMAT: Format = Format {
    name: "Tracker (physlets.org)",
    known_by: "a row of track names, then a row t, x, y",
    likelihood: None,
    recognise: |_, head, _| rows(head).is_some(),
    read,
};

/// Which of the first rows have the names of tracks and of columns.
fn rows(head: &[Vec<&str>]) -> Option<[usize; 2]> {
    let first = usize::from(head.first()?.first()?.starts_with("#multi"));
    let (names, columns) = (head.get(first)?, head.get(first + 1)?);
    let has = |what: &str| columns.iter().skip(1).any(|cell| ColumnName::of(cell).is(what));
    let named = names.iter().any(|name| !name.is_empty() && name.parse::<f64>().is_err());
    let alone =
        names.iter().filter(|name| !name.is_empty()).count() < columns.iter().filter(|name| !name.is_empty()).count();
    let timed = columns.first().is_some_and(|cell| ColumnName::of(cell).is("t"));
    (named && alone && timed && has("x") && has("y")).then_some([first, first + 1])
}

/// The two columns of a track.
struct TrackColumns {
    marker: usize,
    parts: [usize; 2],
}

fn read(sheet: &CellText, _options: &ImportOptions) -> Result<Vec<Recording>, DataError> {
    let head = sheet.head(3);
    let [names, columns] = rows(&head).unwrap_or([0, 1]);
    let unit = head[columns].iter().find_map(|cell| Some(ColumnName::of(cell)).filter(|name| name.is("x"))?.unit);
    let mut pivot = Pivot::new(unit.and_then(|unit| lengths(&unit)).unwrap_or(Lengths::Unsaid), FrameClock::Seconds);
    let second = ColumnName::of(head[columns][0]).unit.and_then(|unit| si(&unit, Measured::Time)).unwrap_or(1.0);
    let tracks = tracks(sheet, &head[names], &head[columns], &mut pivot)?;
    let mut cells = Vec::new();
    for (number, line) in sheet.lines().skip(columns + 1) {
        sheet.split_into(line, &mut cells);
        let frame = pivot.frame(second * sheet.time(cells[0], number, "t")?);
        for TrackColumns { marker, parts } in &tracks {
            let value = |part: usize| {
                sheet.expect(cells.get(parts[part]).copied().unwrap_or_default(), number, ["x", "y"][part])
            };
            pivot.put(frame, *marker, [value(0)?, value(1)?, 0.0], true);
        }
    }
    Ok(vec![pivot.finish()])
}

/// A track begins where its name stands, or, for names side by side, where x comes again.
fn tracks(
    sheet: &CellText,
    names: &[&str],
    columns: &[&str],
    pivot: &mut Pivot,
) -> Result<Vec<TrackColumns>, DataError> {
    let is = |index: &usize, axis: &str| ColumnName::of(columns[*index]).is(axis);
    let xs: Vec<usize> = (0..columns.len()).filter(|index| is(index, "x")).collect();
    let said: Vec<&str> = names.iter().copied().filter(|name| !name.is_empty()).collect();
    if said.len() != xs.len() {
        let message = format!("{} names stand above {} pairs of x and y", said.len(), xs.len());
        return Err(sheet.fault(1, message, "export the tracks again with names, x and y"));
    }
    let mut tracks = Vec::new();
    for (k, &x) in xs.iter().enumerate() {
        let end = xs.get(k + 1).copied().unwrap_or(columns.len());
        let Some(y) = (x..end).find(|index| is(index, "y")) else {
            return Err(sheet.fault(2, format!("track {} has x and no y", said[k]), "export x and y of every track"));
        };
        tracks.push(TrackColumns { marker: pivot.marker(said[k]), parts: [x, y] });
    }
    Ok(tracks)
}
