//! Tables of motion capture in which the name of a marker heads three columns X, Y, Z: Vicon Nexus and TRC.

use super::columns::lengths;
use super::format::Format;
use super::labels::without_subject;
use super::layout::Layout;
use super::options::ImportOptions;
use super::recording::{Lengths, Recording};
use super::sheet::CellText;
use crate::error::Result;

pub(super) const VICON: Format = Format {
    name: "Vicon Nexus",
    known_by: "a line Trajectories, then Frame, Sub Frame, X, Y, Z",
    fixture: "cases/c21-vicon-nexus/trial1.csv",
    likelihood: None,
    recognise: |sheet, _, _| sheet.lines().any(|(_, line)| is_title(sheet, line)),
    read: vicon,
};

pub(super) const TRC: Format = Format {
    name: "TRC (OpenSim)",
    known_by: "first line PathFileType",
    fixture: "cases/c22-trc/run1.trc",
    likelihood: None,
    recognise: |_, head, _| head.first().is_some_and(|row| row[0] == "PathFileType"),
    read: trc,
};

fn is_title(sheet: &CellText, line: &str) -> bool {
    line.split(sheet.delimiter).next().is_some_and(|cell| cell.trim().trim_matches('"') == "Trajectories")
}

/// The section Trajectories: frames per second, names, axes, units, and a row for every frame. Another section may follow.
fn vicon(sheet: &CellText, _options: &ImportOptions) -> Result<Vec<Recording>> {
    let mut lines = sheet.lines().skip_while(|(_, line)| !is_title(sheet, line)).skip(1);
    let mut next = |what: &str| {
        let found = lines.next().map(|(number, line)| (number, sheet.split(line)));
        found.ok_or_else(|| sheet.fault(0, format!("the file has no row of {what}"), "export the trial again as ASCII"))
    };
    let (line, rate) = next("frames per second")?;
    let fps = rate_of(sheet, line, rate[0])?;
    let ((line, names), (_, axes), (unit_line, units)) = (next("names")?, next("axes")?, next("units")?);
    let is_length = |column: &usize| axes.get(*column).is_some_and(|axis| ["X", "Y", "Z"].contains(axis));
    let mut named = (0..units.len()).filter(is_length).filter(|column| !units[*column].is_empty());
    let unit = named.next().map_or("", |column| units[column]);
    let lengths = unit_of(sheet, line, unit)?;
    for column in named {
        if unit_of(sheet, unit_line, units[column])? != lengths {
            let message = format!("column {} is in {}, and an earlier one in {unit}", column + 1, units[column]);
            return Err(sheet.fault(unit_line, message, "export all trajectories in one unit"));
        }
    }
    let layout = Layout::new(0, Some(1.0 / fps), lengths);
    let is_row = |(_, text): &(u64, &str)| sheet.split(text).iter().filter(|cell| !cell.is_empty()).count() > 1;
    columns(sheet, line, layout, &names, &axes)?.read(sheet, line, 3, lines.take_while(is_row))
}

/// Keys, their values, names, axes, and a row for every frame.
fn trc(sheet: &CellText, _options: &ImportOptions) -> Result<Vec<Recording>> {
    let mut lines = sheet.lines().skip(1);
    let mut next = |what: &str| {
        let found = lines.next().map(|(number, line)| (number, sheet.split(line)));
        found.ok_or_else(|| sheet.fault(0, format!("the file has no row of {what}"), "export the file again"))
    };
    let ((_, keys), (line, values)) = (next("keys, DataRate and Units")?, next("values")?);
    let of = |key: &str| keys.iter().position(|known| *known == key).and_then(|at| values.get(at)).copied();
    let unit = unit_of(sheet, line, of("Units").unwrap_or_default())?;
    let ((line, names), (_, axes)) = (next("names")?, next("axes")?);
    let layout = match names.iter().position(|name| *name == "Time") {
        Some(time) => Layout::new(time, Some(1.0), unit),
        None => Layout::new(0, Some(1.0 / rate_of(sheet, line, of("DataRate").unwrap_or_default())?), unit),
    };
    columns(sheet, line, layout, &names, &axes)?.read(sheet, line, 3, lines)
}

/// Frames per second in a cell.
pub(super) fn rate_of(sheet: &CellText, line: u64, cell: &str) -> Result<f64> {
    let rate = sheet.number(cell).filter(|rate| spelling::units::Range::FRAME_RATE.check(*rate).is_ok());
    rate.ok_or_else(|| {
        let help = "export the file again with its frames per second";
        sheet.fault(line, format!("\"{cell}\" is not a number of frames per second"), help)
    })
}

/// Lengths of a unit as written; unsaid where nothing is written.
pub(super) fn unit_of(sheet: &CellText, line: u64, word: &str) -> Result<Lengths> {
    if word.is_empty() {
        return Ok(Lengths::Unsaid);
    }
    let help = "export in m, cm or mm";
    lengths(&word.to_lowercase()).ok_or_else(|| sheet.fault(line, format!("the unit {word} is not known"), help))
}

fn columns(sheet: &CellText, line: u64, mut layout: Layout, names: &[&str], axes: &[&str]) -> Result<Layout> {
    let labeled = |name: &str| !name.is_empty() && !name.starts_with('*') && !name.contains("Unlabeled");
    let is_axis = |column: usize| axes.get(column).is_some_and(|axis| axis.starts_with(['X', 'Y', 'Z']));
    let heads: Vec<usize> = (0..names.len()).filter(|column| labeled(names[*column]) && is_axis(*column)).collect();
    let short = without_subject(&heads.iter().map(|column| names[*column]).collect::<Vec<_>>());
    for (head, name) in heads.into_iter().zip(short) {
        for column in (head..head + 3).filter(|column| is_axis(*column)) {
            let part = ["X", "Y", "Z"].iter().position(|axis| axes[column].starts_with(axis)).unwrap_or_default();
            layout.add(sheet, line, name, part, column)?;
        }
    }
    Ok(layout)
}
