//! Tables of motion capture in which the name of a marker heads three columns X, Y, Z: Vicon Nexus and TRC.

use super::format::*;

pub(super) const VICON: Format = Format {
    name: "Vicon Nexus",
    known_by: "a line Trajectories, then Frame, Sub Frame, X, Y, Z",
    fixture: "cases/c21-vicon-nexus/trial1.csv",
    likelihood: None,
    recognise: |begin| begin.sheet.lines().any(|(_, line)| is_title(begin.sheet, line)),
    read: vicon,
};

pub(super) const TRC: Format = Format {
    name: "TRC (OpenSim)",
    known_by: "first line PathFileType",
    fixture: "cases/c22-trc/run1.trc",
    likelihood: None,
    recognise: |begin| begin.first() == "PathFileType",
    read: trc,
};

fn is_title(sheet: &CellText, line: &str) -> bool {
    line.split(sheet.delimiter).next().is_some_and(|cell| cell.trim().trim_matches('"') == "Trajectories")
}

/// Number and cells of the next row above the frames.
fn next<'s>(
    sheet: &CellText<'s>,
    lines: &mut impl Iterator<Item = (u64, &'s str)>,
    what: &str,
) -> Result<(u64, Vec<&'s str>)> {
    let found = lines.next().map(|(number, line)| (number, sheet.split(line)));
    let help = "export the trial again as text, with the rows above the frames";
    found.ok_or_else(|| sheet.fault(0, format!("the file has no row of {what}"), help))
}

/// The section Trajectories: frames per second, names, axes, units, and a row for every frame. Another section may follow.
fn vicon(sheet: &CellText, _options: &ImportOptions) -> Result<Vec<Recording>> {
    let mut lines = sheet.lines().skip_while(|(_, line)| !is_title(sheet, line)).skip(1);
    let (line, rate) = next(sheet, &mut lines, "frames per second")?;
    let fps = rate_of(sheet, line, rate[0])?;
    let (line, names) = next(sheet, &mut lines, "names")?;
    let (_, axes) = next(sheet, &mut lines, "axes")?;
    let (unit_line, units) = next(sheet, &mut lines, "units")?;
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
    let mut layout = FrameColumns::new(line, 0, Some(1.0 / fps), lengths);
    columns(sheet, &mut layout, &names, &axes)?;
    let is_row = |(_, text): &(u64, &str)| sheet.split(text).iter().filter(|cell| !cell.is_empty()).count() > 1;
    layout.read(sheet, 3, lines.take_while(is_row))
}

/// Keys, their values, names, axes, and a row for every frame.
fn trc(sheet: &CellText, _options: &ImportOptions) -> Result<Vec<Recording>> {
    let mut lines = sheet.lines().skip(1);
    let (_, keys) = next(sheet, &mut lines, "keys, DataRate and Units")?;
    let (value_line, values) = next(sheet, &mut lines, "values")?;
    let of = |key: &str| keys.iter().position(|known| *known == key).and_then(|at| values.get(at)).map_or("", |v| v);
    let unit = unit_of(sheet, value_line, of("Units"))?;
    let ((line, names), (_, axes)) = (next(sheet, &mut lines, "names")?, next(sheet, &mut lines, "axes")?);
    let (time, second) = match names.iter().position(|name| *name == "Time") {
        Some(time) => (time, 1.0),
        None => (0, 1.0 / rate_of(sheet, line, of("DataRate"))?),
    };
    let mut layout = FrameColumns::new(line, time, Some(second), unit);
    columns(sheet, &mut layout, &names, &axes)?;
    layout.read(sheet, 3, lines)
}

pub(super) fn rate_of(sheet: &CellText, line: u64, cell: &str) -> Result<f64> {
    let rate = sheet.number(cell).filter(|rate| spelling::units::Range::FRAME_RATE.check(*rate).is_ok());
    rate.ok_or_else(|| {
        let help = "export the file again with its frames per second";
        let message = format!("\"{cell}\" is not a number of frames per second");
        sheet.fault(line, message, help)
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

/// The columns X, Y, Z below every name.
fn columns(sheet: &CellText, layout: &mut FrameColumns, names: &[&str], axes: &[&str]) -> Result<()> {
    let labeled = |name: &str| !name.is_empty() && !name.starts_with('*') && !name.contains("Unlabeled");
    let axis = |column: usize| part(axes.get(column)?.get(..1)?).filter(|part| *part < LIKELIHOOD);
    let is_head = |column: &usize| labeled(names[*column]) && axis(*column).is_some();
    let heads: Vec<usize> = (0..names.len()).filter(is_head).collect();
    let short = without_subject(&heads.iter().map(|column| names[*column]).collect::<Vec<_>>());
    let below = heads.iter().zip(short).flat_map(|(head, name)| (*head..head + 3).map(move |column| (column, name)));
    layout.columns(sheet, below.filter_map(|(column, name)| Some((column, name, axis(column)?))))
}
