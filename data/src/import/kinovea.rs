//! Kinovea: trajectories as a text, blocks separated by blank lines, with clock times. Its kinematics are a wide table.

use super::format::*;
use crate::cells::clock_s;

pub(super) const TRAJECTORIES: Format = Format {
    name: "Kinovea, trajectories",
    known_by: "first line #Kinovea Trajectory",
    fixture: "made/kinovea_trajectory.txt",
    likelihood: None,
    recognise: |begin| begin.sheet.text.trim_start().starts_with("#Kinovea"),
    read: trajectories,
};

fn trajectories(sheet: &CellText, _options: &ImportOptions) -> Result<Vec<Recording>> {
    // Pixels, or the units of a calibration: the file does not say.
    let mut pivot = Pivot::new(Lengths::Unsaid, true);
    let (mut block, mut open) = (0_usize, false);
    for (line, number) in sheet.text.lines().zip(1..) {
        let cells: Vec<&str> = line.split_whitespace().collect();
        match cells[..] {
            [] => open = false,
            [first, ..] if first.starts_with('#') => {}
            [time, x, y] => {
                block += usize::from(!open);
                open = true;
                let marker = pivot.marker(&block.to_string());
                let time = clock_s(time).map_or_else(|| sheet.time(time, 1.0, number, "T"), Ok)?;
                let value = |text: &str| sheet.expect(text, number, "X Y");
                let frame = pivot.frame(time);
                pivot.put(frame, marker, [value(x)?, value(y)?, 0.0], true);
            }
            _ => {
                let message = format!("expected T X Y, found {} cells", cells.len());
                return Err(sheet.fault(number, message, "export the trajectories again"));
            }
        }
    }
    pivot.recording.named = false;
    Ok(vec![pivot.finish()])
}
