//! Motive (OptiTrack): a line of settings, then rows Type, Name, ID, Position, axes, and a row for every frame.

use super::format::Format;
use super::labels::without_subject;
use super::layout::Layout;
use super::options::ImportOptions;
use super::recording::{Recording, counted};
use super::sheet::CellText;
use super::triples::unit_of;
use crate::error::Result;

pub(super) const FORMAT: Format = Format {
    name: "Motive (OptiTrack)",
    known_by: "first line Format Version",
    fixture: "cases/c02-motive/vine_1.csv",
    likelihood: None,
    recognise: |_, head, _| head.first().is_some_and(|row| row[0] == "Format Version"),
    read,
};

#[derive(Default)]
struct Head<'a> {
    settings: Vec<&'a str>,
    types: Vec<&'a str>,
    names: Vec<&'a str>,
    what: Vec<&'a str>,
}

impl Head<'_> {
    /// The name of the marker whose position a column has.
    fn marker(&self, column: usize) -> Option<&str> {
        let cell = |row: &[&str]| row.get(column).map_or(String::new(), ToString::to_string);
        let is_place = cell(&self.types).contains("Marker") && cell(&self.what) == "Position";
        self.names.get(column).copied().filter(|_| is_place)
    }
}

fn read(sheet: &CellText, _options: &ImportOptions) -> Result<Vec<Recording>> {
    let mut head = Head::default();
    let mut lines = sheet.lines();
    let (number, axes) = loop {
        let Some((number, line)) = lines.next() else {
            let help = "export the take again as CSV with its header";
            return Err(sheet.fault(0, "the row Frame, Time (Seconds) is missing", help));
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
    let time = axes.iter().position(|name| name.starts_with("Time")).unwrap_or(1);
    let unit = head.settings.iter().position(|cell| *cell == "Length Units").and_then(|at| head.settings.get(at + 1));
    let mut layout = Layout::new(time, Some(1.0), unit_of(sheet, 1, unit.copied().unwrap_or_default())?);
    let is_named = |name: &str| !name.rsplit(':').next().unwrap_or_default().starts_with("Unlabeled");
    let found: Vec<(usize, &str)> = (2..axes.len()).filter_map(|column| Some((column, head.marker(column)?))).collect();
    let unnamed = found.iter().filter(|(_, name)| !is_named(name)).count() / 3;
    if unnamed > 0 {
        let count = counted(unnamed as u64, "unlabeled marker");
        layout.told.push(format!("left out: {count}; name them in Motive to have them"));
    }
    let named: Vec<(usize, &str)> = found.iter().copied().filter(|(_, name)| is_named(name)).collect();
    let short = without_subject(&named.iter().map(|(_, name)| *name).collect::<Vec<_>>());
    for ((column, _), short) in named.iter().zip(short) {
        let part = ["X", "Y", "Z"].iter().position(|axis| *axis == axes[*column]);
        part.map_or(Ok(()), |part| layout.add(sheet, number, short, part, *column))?;
    }
    layout.read(sheet, number, 3, lines)
}
