//! Tables with a row for every time and marker, under any names of columns: this program's own and those of others.

use super::columns::Roles;
use super::formats::Format;
use super::options::ImportOptions;
use super::recording::Recording;
use super::sheet::CellText;
use super::wide::Runs;
use crate::cells::label;
use crate::error::DataError;

pub(super) const FORMAT: Format = Format {
    name: "a long table",
    known_by: "columns of time, marker, x and y",
    likelihood: None,
    recognise: |sheet, head, options| {
        let roles = head.first().and_then(|header| Roles::of(sheet, 1, header, options).ok());
        roles.is_some_and(|roles| roles.time.is_some() && roles.marker.is_some() && roles.coordinates.len() >= 2)
    },
    read,
};

fn read(sheet: &CellText, options: &ImportOptions) -> Result<Vec<Recording>, DataError> {
    let mut lines = sheet.lines();
    let (first, header) = lines.next().unwrap_or_default();
    let roles = Roles::of(sheet, first, &sheet.split(header), options)?;
    let (Some((time, second)), Some(marker)) = (roles.time, roles.marker) else {
        return Err(sheet.fault(first, "no columns of time and marker", "say which: --map t=Time,marker=Point"));
    };
    let column = |axis: usize| roles.coordinates.iter().find(|(_, known, ..)| *known == axis).map(|(index, ..)| *index);
    let (Some(x), Some(y)) = (column(0), column(1)) else {
        return Err(sheet.fault(first, "no columns of x and y", "say which: --map x=PosX,y=PosY"));
    };
    let down = roles.coordinates.iter().any(|(_, axis, name, _)| *axis == 1 && name == "down");
    let mut runs = Runs::new(roles.lengths(sheet, first)?, second);
    let mut cells = Vec::new();
    for (number, line) in lines {
        sheet.split_into(line, &mut cells);
        let cell = |index: usize| cells.get(index).copied().unwrap_or_default();
        let pivot = runs.of(roles.run.map(cell), roles.actuator.map(cell));
        let frame = pivot.frame(second.unwrap_or(1.0) * sheet.time(cell(time), number, "time")?);
        let value = |index: Option<usize>| index.map_or(Ok(0.0), |index| sheet.expect(cell(index), number, "x, y"));
        let y = value(Some(y))?;
        let place = [value(Some(x))?, if down { -y } else { y }, value(column(2))?];
        let name = label(cell(marker));
        let number_of = pivot.marker(name);
        if !pivot.put(frame, number_of, place, true) {
            let message = format!("marker {name} is there twice at {} of one run", cell(time));
            return Err(sheet.fault(number, message, "say which column tells the runs apart: --map run=Trial"));
        }
        roles.read_pressures(sheet, number, &cells, pivot, frame)?;
    }
    Ok(runs.finish(&roles.told))
}
