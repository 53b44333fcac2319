//! Motive (OptiTrack): a line of settings, then rows Type, Name, ID, Position, axes, and a row for every frame.

use super::format::*;
use super::triples::unit_of;

pub(super) const FORMAT: Format = Format {
    name: "Motive (OptiTrack)",
    known_by: "first line Format Version",
    fixture: "cases/c02-motive/vine_1.csv",
    likelihood: None,
    recognise: |begin| begin.first() == "Format Version",
    read,
};

fn read(sheet: &CellText, _options: &ImportOptions) -> Result<Vec<Recording>> {
    let [mut settings, mut types, mut marked, mut what] = [const { Vec::new() }; 4];
    let mut lines = sheet.lines();
    let (number, axes) = loop {
        let Some((number, line)) = lines.next() else {
            let help = "export the take again as CSV with its header";
            return Err(sheet.fault(0, "the row Frame, Time (Seconds) is missing", help));
        };
        let cells = sheet.split(line);
        match (cells[0], cells.get(1).copied().unwrap_or_default()) {
            ("Format Version", _) => settings = cells,
            ("Frame", _) => break (number, cells),
            (_, "Type") => types = cells,
            (_, "Name") => marked = cells,
            (_, "ID" | "Parent") => {}
            _ => what = cells,
        }
    };
    let time = axes.iter().position(|name| name.starts_with("Time")).unwrap_or(1);
    let unit = settings.iter().position(|cell| *cell == "Length Units").and_then(|at| settings.get(at + 1));
    let lengths = unit_of(sheet, 1, unit.copied().unwrap_or_default())?;
    let mut layout = FrameColumns::new(number, time, Some(1.0), lengths);
    let is_place = |column: &usize| {
        let is_marker = types.get(*column).is_some_and(|cell| cell.contains("Marker"));
        is_marker && what.get(*column) == Some(&"Position")
    };
    let places = (2..axes.len()).filter(is_place).filter_map(|column| Some((column, *marked.get(column)?)));
    let is_named = |name: &str| !name.rsplit(':').next().unwrap_or_default().starts_with("Unlabeled");
    let (named, unnamed): (Vec<(usize, &str)>, Vec<_>) = places.partition(|(_, name)| is_named(name));
    if unnamed.len() >= 3 {
        let count = counted(unnamed.len() as u64 / 3, "unlabeled marker");
        layout.told.push(format!("left out: {count}; name them in Motive to have them"));
    }
    let short = without_subject(&named.iter().map(|(_, name)| *name).collect::<Vec<_>>());
    let axis = |column: usize| ["X", "Y", "Z"].iter().position(|axis| *axis == axes[column]);
    let columns = named.iter().zip(short).filter_map(|((column, _), short)| Some((*column, short, axis(*column)?)));
    layout.columns(sheet, columns)?;
    layout.read(sheet, 3, lines)
}
