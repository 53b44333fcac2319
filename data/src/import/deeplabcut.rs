//! DeepLabCut: rows `scorer`, `individuals` (with several animals), `bodyparts`, `coords`, then a row for every frame.

use super::formats::Format;
use super::options::ImportOptions;
use super::recording::{FrameClock, Lengths, Pivot, Recording};
use super::sheet::CellText;
use crate::error::DataError;

pub(super) const FORMAT: Format = Format {
    name: "DeepLabCut",
    known_by: "rows scorer, bodyparts, coords",
    likelihood: Some(LIKELIHOOD),
    recognise: |_, head, _| {
        head.first().is_some_and(|row| row[0] == "scorer") && head.iter().any(|row| row[0] == "bodyparts")
    },
    read,
};

/// Likelihood below which the network itself marks a point as not seen.
const LIKELIHOOD: f64 = 0.9;

/// Columns of one marker: x, y, z and likelihood.
struct NetworkColumns {
    marker: usize,
    parts: [Option<usize>; 4],
}

fn read(sheet: &CellText, options: &ImportOptions) -> Result<Vec<Recording>, DataError> {
    let mut pivot = Pivot::new(Lengths::Pixels, FrameClock::Frames);
    let limit = options.likelihood.unwrap_or(LIKELIHOOD);
    let mut heads: Vec<(&str, Vec<&str>)> = Vec::new();
    let mut columns: Vec<NetworkColumns> = Vec::new();
    let mut cells = Vec::new();
    for (number, line) in sheet.lines() {
        sheet.split_into(line, &mut cells);
        if matches!(cells[0], "scorer" | "individuals" | "bodyparts" | "coords") {
            heads.push((cells[0], cells.clone()));
            continue;
        }
        if columns.is_empty() {
            columns = columns_of(sheet, number, &heads, &mut pivot)?;
        }
        sheet.whole_row(&cells, heads[0].1.len(), number)?;
        let time = sheet.time(cells[0], number, "frame")?;
        let frame = pivot.frame(time);
        for NetworkColumns { marker, parts } in &columns {
            let value = |part: usize| match parts[part].and_then(|index| cells.get(index)) {
                Some(text) => sheet.expect(text, number, "coords"),
                None => Ok(if part == 2 { 0.0 } else { f64::NAN }),
            };
            let likelihood = value(3)?;
            if !(likelihood.is_nan() || (0.0..=1.0).contains(&likelihood)) {
                let message = format!("a likelihood of {likelihood} is not from 0 to 1");
                return Err(sheet.fault(number, message, "export the analysed video again as CSV"));
            }
            pivot.put(frame, *marker, [value(0)?, value(1)?, value(2)?], likelihood.is_nan() || likelihood >= limit);
        }
    }
    pivot.recording.told.push(format!("positions less likely than {limit} are lost markers (--likelihood)"));
    Ok(vec![pivot.finish()])
}

fn columns_of(
    sheet: &CellText,
    number: u64,
    heads: &[(&str, Vec<&str>)],
    pivot: &mut Pivot,
) -> Result<Vec<NetworkColumns>, DataError> {
    let row = |name: &str| heads.iter().find(|(first, _)| *first == name).map(|(_, cells)| cells);
    let (Some(parts), Some(coords)) = (row("bodyparts"), row("coords")) else {
        return Err(sheet.fault(number, "the row coords is missing", "export the analysed video again as CSV"));
    };
    let animals = row("individuals");
    let several = animals.is_some_and(|row| row.iter().skip(1).any(|name| *name != row[1] && *name != "single"));
    let mut columns: Vec<NetworkColumns> = Vec::new();
    for index in 1..coords.len().min(parts.len()) {
        let animal = animals.and_then(|row| row.get(index)).filter(|name| several && **name != "single");
        let name = animal.map_or(parts[index].to_string(), |animal| format!("{animal}_{}", parts[index]));
        let Some(part) = ["x", "y", "z", "likelihood"].iter().position(|known| *known == coords[index]) else {
            continue;
        };
        let marker = pivot.marker(&name);
        if columns.last().is_none_or(|column| column.marker != marker) {
            columns.push(NetworkColumns { marker, parts: [None; 4] });
        }
        let Some(column) = columns.last_mut() else { continue };
        if column.parts[part].replace(index).is_some() {
            let message = format!("two columns are {} of {name}", coords[index]);
            return Err(sheet.fault(number, message, "name every body part once"));
        }
    }
    if columns.iter().any(|column| column.parts[2].is_some()) {
        pivot.recording.lengths = Lengths::Unsaid;
    }
    Ok(columns)
}
