//! Tables whose names no program fixes: this program's own, other people's, and Kinovea's kinematics.

use super::format::*;

pub(super) const LONG: Format = Format {
    name: "a long table",
    known_by: "columns of time, marker, x and y",
    fixture: "made/long_foreign.tsv",
    likelihood: Some(NOT_SEEN),
    recognise: |begin| of_roles(begin).is_some_and(|roles| roles.marker.is_some()),
    read: long,
};

pub(super) const WIDE: Format = Format {
    name: "a wide table",
    known_by: "a time and columns like x1, y1, x2, y2",
    fixture: "made/wide_pixels.csv",
    likelihood: Some(NOT_SEEN),
    recognise: |begin| of_roles(begin).is_some(),
    read: wide,
};

pub(super) const KINEMATICS: Format = Format {
    name: "Kinovea, kinematics",
    known_by: "columns Time (ms) and NAME - X (cm)",
    fixture: "made/kinovea_seconds.csv",
    likelihood: None,
    recognise: |begin| {
        let is_x = |name: &str| name.contains(" - X") || name.contains("/X");
        ColumnName::of(begin.first()).is("time") && begin.any(is_x)
    },
    read: wide,
};

pub(super) const ANIPOSE: Format = Format {
    name: "Anipose (3D)",
    known_by: "columns fnum and NAME_x, NAME_ncams",
    fixture: "made/anipose.csv",
    likelihood: Some(NOT_SEEN),
    recognise: |begin| begin.has(&["fnum"]) && begin.any(|name| name.ends_with("_ncams")),
    read: wide,
};

pub(super) const TRACKPY: Format = Format {
    name: "trackpy",
    known_by: "columns frame, particle, mass, x and y",
    fixture: "made/trackpy.csv",
    likelihood: None,
    recognise: |begin| begin.has(&["frame", "particle", "mass", "x", "y"]),
    read: trackpy,
};

/// What the columns of a table with a time and coordinates are.
fn of_roles(begin: &Beginning) -> Option<Roles> {
    let roles = Roles::of(begin.sheet, 1, begin.head.first()?, begin.options).ok()?;
    Some(roles).filter(|roles| roles.time.is_some() && roles.units.len() >= 2)
}

fn long(sheet: &CellText, options: &ImportOptions) -> Result<Vec<Recording>> {
    let (roles, layout) = begin(sheet, options)?;
    long_of(sheet, &roles, layout)
}

/// The same in pixels; particles have numbers.
fn trackpy(sheet: &CellText, options: &ImportOptions) -> Result<Vec<Recording>> {
    let (roles, mut layout) = begin(sheet, options)?;
    (layout.lengths, layout.named) = (Lengths::Pixels, false);
    long_of(sheet, &roles, layout)
}

fn long_of(sheet: &CellText, roles: &Roles, mut layout: FrameColumns) -> Result<Vec<Recording>> {
    layout.marker = roles.marker;
    let of_part = |part: usize| roles.columns.iter().filter(move |column| column.2 == part);
    let first = |axis: usize| Some((of_part(axis).next()?.0, "", axis));
    if first(0).is_none() || first(1).is_none() {
        let help = "say which: --map x=PosX,y=PosY";
        return Err(sheet.fault(layout.line, "no columns of x and y", help));
    }
    layout.columns(sheet, (0..LIKELIHOOD).filter_map(first))?;
    layout.columns(sheet, of_part(LIKELIHOOD).map(|column| (column.0, "", LIKELIHOOD)))?;
    layout.y_down = of_part(1).any(|(_, name, _)| name == "down");
    layout.twice = Some("name the column that identifies the run: --map run=Trial");
    layout.read(sheet, 2, sheet.lines().skip(1))
}

/// A row for every time and two columns or three for every marker: `t, x1, y1, x2, y2, …`.
fn wide(sheet: &CellText, options: &ImportOptions) -> Result<Vec<Recording>> {
    let (roles, mut layout) = begin(sheet, options)?;
    let (mut likelihoods, places): (Vec<_>, Vec<_>) =
        roles.columns.into_iter().partition(|(.., part)| *part == LIKELIHOOD);
    likelihoods.retain(|(_, name, _)| places.iter().any(|(_, known, _)| known == name));
    layout.columns(sheet, places.into_iter().chain(likelihoods))?;
    layout.rises = true;
    layout.read(sheet, 2, sheet.lines().skip(1))
}

/// Note of an import whose files have no likelihood.
pub(super) const NOT_USED: &str = "the files have no likelihood: --likelihood was not used";

/// What the columns of a table are, and what both kinds have.
fn begin(sheet: &CellText, options: &ImportOptions) -> Result<(Roles, FrameColumns)> {
    let (first, header) = sheet.lines().next().unwrap_or_default();
    let roles = Roles::of(sheet, first, &sheet.split(header), options)?;
    let Some((time, second)) = roles.time else {
        let help = "say which: --map t=Time, or frame=Frame";
        return Err(sheet.fault(first, "no column is the time", help));
    };
    let mut layout = FrameColumns::new(first, time, second, roles.lengths(sheet, first)?);
    (layout.run, layout.actuator, layout.pressures) = (roles.run, roles.actuator, roles.pressures);
    layout.told.clone_from(&roles.told);
    if let Some(most) = roles.most_likely {
        layout.unlikely(options, NOT_SEEN, most, "less likely than");
    } else if options.likelihood.is_some() {
        layout.told.push(NOT_USED.to_string());
    }
    Ok((roles, layout))
}
