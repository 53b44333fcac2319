//! Qualisys Track Manager: rows of keys, then the columns Frame, Time, and X, Y, Z of every marker in millimetres.

use super::format::*;
use super::triples::rate_of;

pub(super) const FORMAT: Format = Format {
    name: "Qualisys (TSV)",
    known_by: "first line NO_OF_FRAMES",
    fixture: "cases/c23-qualisys-tsv/m1.tsv",
    likelihood: None,
    recognise: |begin| begin.first() == "NO_OF_FRAMES",
    read,
};

fn read(sheet: &CellText, _options: &ImportOptions) -> Result<Vec<Recording>> {
    let (mut rate, mut lines) = (None, sheet.lines());
    let help = "export again with column names, frame numbers and times (Export, TSV, Include time data)";
    let (header, names) = loop {
        let Some((number, line)) = lines.next() else {
            let message = "the row Frame, Time and the columns of markers is missing";
            return Err(sheet.fault(0, message, help));
        };
        let cells = sheet.split(line);
        match cells[0] {
            "Frame" | "Time" => break (number, cells),
            "FREQUENCY" => rate = cells.get(1).map(|cell| rate_of(sheet, number, cell)),
            first if sheet.number(first).is_some() => {
                let message = "the numbers begin without names of their columns";
                return Err(sheet.fault(number, message, help));
            }
            _ => {}
        }
    };
    let (time, second) = match names.iter().position(|name| *name == "Time") {
        Some(time) => (time, 1.0),
        None => (0, 1.0 / rate.unwrap_or_else(|| rate_of(sheet, header, ""))?),
    };
    let mut layout = FrameColumns::new(header, time, Some(second), Lengths::Metres(1e-3));
    layout.width = Some(names.len());
    let columns = names.iter().enumerate().filter_map(|(column, name)| {
        let (marker, axis) = name.rsplit_once(' ')?;
        Some((column, marker.trim(), ["X", "Y", "Z"].iter().position(|known| *known == axis)?))
    });
    layout.columns(sheet, columns)?;
    layout.read(sheet, 3, lines)
}
