//! Tracker (physlets.org): a row with the names of the tracks, a row `t, x, y, …`, then a row for every step.

use super::format::*;

pub(super) const FORMAT: Format = Format {
    name: "Tracker (physlets.org)",
    known_by: "a row of track names, then a row t, x, y",
    fixture: "made/tracker_multi.txt",
    likelihood: None,
    recognise: |begin| rows(&begin.head).is_some(),
    read,
};

/// Which of the first rows has the names of tracks; the names of columns are in the next.
fn rows(head: &[Vec<&str>]) -> Option<usize> {
    let first = usize::from(head.first()?.first()?.starts_with("#multi"));
    let (names, columns) = (head.get(first)?, head.get(first + 1)?);
    let has = |what: &str| columns.iter().skip(1).any(|cell| ColumnName::of(cell).is(what));
    let count = |row: &[&str]| row.iter().filter(|name| !name.is_empty()).count();
    let named = names.iter().any(|name| !name.is_empty() && name.parse::<f64>().is_err());
    let timed = columns.first().is_some_and(|cell| ColumnName::of(cell).is("t"));
    (named && count(names) < count(columns) && timed && has("x") && has("y")).then_some(first)
}

fn read(sheet: &CellText, _options: &ImportOptions) -> Result<Vec<Recording>> {
    let head = sheet.head(3);
    let first = rows(&head).unwrap_or_default();
    let columns: Vec<ColumnName> = head[first + 1].iter().map(|cell| ColumnName::of(cell)).collect();
    let unit = columns.iter().find(|name| name.is("x")).and_then(|name| name.unit.as_deref());
    let second = columns[0].unit.as_deref().and_then(|unit| si(unit, MeasuredQuantity::Time)).unwrap_or(1.0);
    let mut layout = FrameColumns::new(2, 0, Some(second), unit.and_then(lengths).unwrap_or(Lengths::Unsaid));
    let names: Vec<&str> = head[first].iter().copied().filter(|name| !name.is_empty()).collect();
    let pairs = columns.iter().filter(|name| name.is("x")).count();
    if names.len() != pairs {
        let message = format!("{} names stand above {pairs} pairs of x and y", names.len());
        return Err(sheet.fault(1, message, "export the tracks again with names, x and y"));
    }
    // A track begins where x comes again.
    let mut begun = 0;
    let of_track = columns.iter().enumerate().filter_map(|(index, name)| {
        begun += usize::from(name.is("x"));
        let axis = ["x", "y"].iter().position(|axis| name.is(axis))?;
        Some((index, *names.get(begun.checked_sub(1)?)?, axis))
    });
    layout.columns(sheet, of_track)?;
    layout.read(sheet, 2, sheet.lines().skip(first + 2))
}
