//! Corners of a checkerboard from a table.

use std::path::Path;

use super::homography::Homography;
use super::join::text_of;
use super::sheet::CellText;
use crate::error::Result;

/// Two readings of one corner are at most so far apart \[px\].
const SAME_CORNER_PX: f64 = 5.0;

/// Reads corners: rows of column and row on the board, and x and y in the picture; a line of names may stand above them.
///
/// # Errors
/// Not readable; a row without four numbers; one corner at two places; corners that make no plane.
pub fn read_board(path: &Path) -> Result<Vec<[f64; 4]>> {
    let (shown, text) = (path.display().to_string(), text_of(path)?);
    let sheet = CellText::new(&shown, &text)?;
    let mut corners: Vec<[f64; 4]> = Vec::new();
    let rows = sheet.lines().filter(|(_, line)| !line.starts_with('#'));
    for (k, (number, line)) in rows.enumerate() {
        let cells = sheet.split(line);
        let numbers = cells.iter().map(|cell| sheet.number(cell).filter(|v| v.is_finite()));
        let numbers = numbers.collect::<Option<Vec<f64>>>().unwrap_or_default();
        let Ok(corner) = <[f64; 4]>::try_from(numbers) else {
            if k == 0 && cells.len() == 4 {
                continue;
            }
            let message = format!("expected four numbers, found {}", cells.len());
            let help =
                "every row is column,row,x,y of a corner: its place on the board, counted from 0, and in the picture";
            return Err(sheet.fault(number, message, help));
        };
        let [column, row, x, y] = corner;
        let is_far = |[.., px, py]: &[f64; 4]| (px - x).hypot(py - y) > SAME_CORNER_PX;
        let other = corners.iter().find(|other| other[..2] == corner[..2] && is_far(other));
        if let Some([.., px, py]) = other {
            let message =
                format!("corner {column},{row} is at {x:.1}, {y:.1} px here and at {px:.1}, {py:.1} px above");
            let help = "delete the wrong row, or correct its column and row";
            return Err(sheet.fault(number, message, help));
        }
        corners.push(corner);
    }
    // Whether they make a plane is known before the tracks are read; the side of a square does not matter for it.
    Homography::of_board(&corners, 1.0).map_err(|message| {
        let help = "give at least four corners, no three on a line: a table column,row,x,y";
        sheet.fault(0, message, help)
    })?;
    Ok(corners)
}
