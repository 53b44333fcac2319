//! Qualisys Track Manager: rows of keys, then the columns Frame, Time, and X, Y, Z of every marker in millimetres.

use super::format::Format;
use super::layout::Layout;
use super::options::ImportOptions;
use super::recording::{Lengths, Recording};
use super::sheet::CellText;
use super::triples::rate_of;
use crate::error::Result;

pub(super) const FORMAT: Format = Format {
    name: "Qualisys (TSV)",
    known_by: "first line NO_OF_FRAMES",
    fixture: "cases/c23-qualisys-tsv/m1.tsv",
    likelihood: None,
    recognise: |_, head, _| head.first().is_some_and(|row| row[0] == "NO_OF_FRAMES"),
    read,
};

fn read(sheet: &CellText, _options: &ImportOptions) -> Result<Vec<Recording>> {
    let (mut rate, mut lines) = (None, sheet.lines());
    let (header, names) = loop {
        let help = "export again with column names, frame numbers and times (Export, TSV, Include time data)";
        let Some((number, line)) = lines.next() else {
            return Err(sheet.fault(0, "the row Frame, Time and the columns of markers is missing", help));
        };
        let cells = sheet.split(line);
        match cells[0] {
            "Frame" | "Time" => break (number, cells),
            "FREQUENCY" => rate = cells.get(1).map(|cell| rate_of(sheet, number, cell)),
            first if sheet.number(first).is_some() => {
                return Err(sheet.fault(number, "the numbers begin without names of their columns", help));
            }
            _ => {}
        }
    };
    let mut layout = match names.iter().position(|name| *name == "Time") {
        Some(time) => Layout::new(time, Some(1.0), Lengths::Metres(1e-3)),
        None => Layout::new(0, Some(1.0 / rate.unwrap_or_else(|| rate_of(sheet, header, ""))?), Lengths::Metres(1e-3)),
    };
    for (column, name) in names.iter().enumerate() {
        let axis = name
            .rsplit_once(' ')
            .and_then(|(marker, axis)| Some((marker.trim(), ["X", "Y", "Z"].iter().position(|known| *known == axis)?)));
        axis.map_or(Ok(()), |(marker, part)| layout.add(sheet, header, marker, part, column))?;
    }
    layout.width = Some(names.len());
    layout.read(sheet, header, 3, lines)
}
