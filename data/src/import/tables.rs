//! Tables whose names no program fixes: this program's own, other people's, and Kinovea's kinematics.

use super::columns::{ColumnName, Roles};
use super::deeplabcut::LIKELIHOOD;
use super::format::Format;
use super::layout::{self, Layout};
use super::options::ImportOptions;
use super::recording::{Lengths, Recording};
use super::sheet::CellText;
use crate::error::Result;

pub(super) const LONG: Format = Format {
    name: "a long table",
    known_by: "columns of time, marker, x and y",
    fixture: "made/long_foreign.tsv",
    likelihood: Some(LIKELIHOOD),
    recognise: |sheet, head, options| of_roles(sheet, head, options, |roles| roles.marker.is_some()),
    read: long,
};

pub(super) const WIDE: Format = Format {
    name: "a wide table",
    known_by: "a time and columns like x1, y1, x2, y2",
    fixture: "made/wide_pixels.csv",
    likelihood: Some(LIKELIHOOD),
    recognise: |sheet, head, options| of_roles(sheet, head, options, |_| true),
    read: wide,
};

pub(super) const KINEMATICS: Format = Format {
    name: "Kinovea, kinematics",
    known_by: "columns Time (ms) and NAME - X (cm)",
    fixture: "made/kinovea_seconds.csv",
    likelihood: None,
    recognise: |_, head, _| {
        let is_x = |name: &str| name.contains(" - X") || name.contains("/X");
        head.first().is_some_and(|row| ColumnName::of(row[0]).is("time") && row.iter().any(|name| is_x(name)))
    },
    read: wide,
};

pub(super) const ANIPOSE: Format = Format {
    name: "Anipose (3D)",
    known_by: "columns fnum and NAME_x, NAME_ncams",
    fixture: "made/anipose.csv",
    likelihood: Some(LIKELIHOOD),
    recognise: |_, head, _| {
        head.first().is_some_and(|row| row.contains(&"fnum") && row.iter().any(|name| name.ends_with("_ncams")))
    },
    read: wide,
};

pub(super) const TRACKPY: Format = Format {
    name: "trackpy",
    known_by: "columns frame, particle, mass, x and y",
    fixture: "made/trackpy.csv",
    likelihood: None,
    recognise: |_, head, _| {
        head.first().is_some_and(|row| ["frame", "particle", "mass", "x", "y"].iter().all(|name| row.contains(name)))
    },
    read: trackpy,
};

fn of_roles(sheet: &CellText, head: &[Vec<&str>], options: &ImportOptions, also: fn(&Roles) -> bool) -> bool {
    let roles = head.first().and_then(|header| Roles::of(sheet, 1, header, options).ok());
    roles.is_some_and(|roles| roles.time.is_some() && roles.coordinates.len() >= 2 && also(&roles))
}

/// A row for every time and marker.
fn long(sheet: &CellText, options: &ImportOptions) -> Result<Vec<Recording>> {
    long_of(sheet, begin(sheet, options)?)
}

/// The same in pixels; particles have numbers.
fn trackpy(sheet: &CellText, options: &ImportOptions) -> Result<Vec<Recording>> {
    let (first, roles, mut layout) = begin(sheet, options)?;
    (layout.lengths, layout.named) = (Lengths::Pixels, false);
    long_of(sheet, (first, roles, layout))
}

fn long_of(sheet: &CellText, (first, roles, mut layout): (u64, Roles, Layout)) -> Result<Vec<Recording>> {
    layout.marker = roles.marker;
    for axis in 0..3 {
        let column = roles.coordinates.iter().find(|(_, known, ..)| *known == axis);
        column.map_or(Ok(()), |(column, ..)| layout.add(sheet, first, "", axis, *column))?;
    }
    if ![0, 1].iter().all(|axis| roles.coordinates.iter().any(|(_, known, ..)| known == axis)) {
        return Err(sheet.fault(first, "no columns of x and y", "say which: --map x=PosX,y=PosY"));
    }
    roles.likelihoods.iter().try_for_each(|(column, ..)| layout.add(sheet, first, "", layout::LIKELIHOOD, *column))?;
    layout.y_down = roles.coordinates.iter().any(|(_, axis, name, _)| *axis == 1 && name == "down");
    layout.twice = Some("name the column that identifies the run: --map run=Trial");
    layout.read(sheet, first, 2, sheet.lines().skip(1))
}

/// A row for every time and two columns or three for every marker: `t, x1, y1, x2, y2, …`.
fn wide(sheet: &CellText, options: &ImportOptions) -> Result<Vec<Recording>> {
    let (first, roles, mut layout) = begin(sheet, options)?;
    roles.coordinates.iter().try_for_each(|(column, axis, name, _)| layout.add(sheet, first, name, *axis, *column))?;
    let has = |marker: &String| roles.coordinates.iter().any(|(_, _, known, _)| known == marker);
    let mut likelihoods = roles.likelihoods.iter().filter(|(_, marker, _)| has(marker));
    likelihoods.try_for_each(|(column, name, _)| layout.add(sheet, first, name, layout::LIKELIHOOD, *column))?;
    layout.rises = true;
    layout.read(sheet, first, 2, sheet.lines().skip(1))
}

/// The header of a table, and what both kinds have.
fn begin(sheet: &CellText, options: &ImportOptions) -> Result<(u64, Roles, Layout)> {
    let (first, header) = sheet.lines().next().unwrap_or_default();
    let roles = Roles::of(sheet, first, &sheet.split(header), options)?;
    let Some((time, second)) = roles.time else {
        return Err(sheet.fault(first, "no column is the time", "say which: --map t=Time, or frame=Frame"));
    };
    let mut layout = Layout::new(time, second, roles.lengths(sheet, first)?);
    (layout.run, layout.actuator, layout.pressures) = (roles.run, roles.actuator, roles.pressures);
    layout.told.clone_from(&roles.told);
    if let Some(most) = roles.likelihoods.iter().map(|(.., most)| *most).reduce(f64::max) {
        let limit = options.likelihood.unwrap_or(LIKELIHOOD);
        layout.likely = [limit, most];
        layout.told.push(format!("positions less likely than {limit} are lost markers (--likelihood)"));
    } else if options.likelihood.is_some() {
        layout.told.push("the files have no likelihood: --likelihood was not used".to_string());
    }
    Ok((first, roles, layout))
}
