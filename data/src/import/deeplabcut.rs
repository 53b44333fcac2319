//! DeepLabCut: rows `scorer`, `individuals` (with several animals), `bodyparts`, `coords`, then a row for every frame.

use super::format::*;

pub(super) const FORMAT: Format = Format {
    name: "DeepLabCut",
    known_by: "rows scorer, bodyparts, coords",
    fixture: "cases/c01-deeplabcut/run1.csv",
    likelihood: Some(NOT_SEEN),
    recognise: |begin| begin.first() == "scorer" && begin.head.iter().any(|row| row[0] == "bodyparts"),
    read,
};

/// Names of the rows above the frames.
const HEADS: [&str; 4] = ["scorer", "individuals", "bodyparts", "coords"];

fn read(sheet: &CellText, options: &ImportOptions) -> Result<Vec<Recording>> {
    let is_head = |(_, line): &(u64, &str)| HEADS.contains(&sheet.split(line)[0]);
    let heads: Vec<Vec<&str>> = sheet.lines().take_while(is_head).map(|(_, line)| sheet.split(line)).collect();
    let first = sheet.lines().nth(heads.len()).map_or(0, |(number, _)| number);
    let row = |name: &str| heads.iter().find(|row| row[0] == name);
    let (Some(parts), Some(coords)) = (row("bodyparts"), row("coords")) else {
        let help = "export the analysed video again as CSV";
        return Err(sheet.fault(first, "the row coords is missing", help));
    };
    let animals = row("individuals");
    let several = animals.is_some_and(|row| row.iter().skip(1).any(|name| *name != row[1] && *name != "single"));
    let lengths = if coords.contains(&"z") { Lengths::Unsaid } else { Lengths::Pixels };
    let mut layout = FrameColumns::new(first, 0, None, lengths);
    layout.width = Some(heads[0].len());
    layout.unlikely(options, NOT_SEEN, 1.0, "less likely than");
    let column = |column: usize| {
        let animal = animals.and_then(|row| row.get(column)).filter(|name| several && **name != "single");
        let name = animal.map_or(parts[column].to_string(), |animal| format!("{animal}_{}", parts[column]));
        Some((column, name, part(coords[column])?))
    };
    layout.columns(sheet, (1..coords.len().min(parts.len())).filter_map(column))?;
    layout.read(sheet, 2, sheet.lines().skip(heads.len()))
}
