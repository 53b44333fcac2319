//! Tables with a row for every time and two columns for every marker: `t, x1, y1, x2, y2, …`; pressures may stand beside them.

use std::collections::HashMap;

use super::columns::Roles;
use super::formats::Format;
use super::options::ImportOptions;
use super::recording::{FrameClock, Lengths, Pivot, Recording};
use super::sheet::CellText;
use crate::cells::label;
use crate::error::DataError;

pub(super) const FORMAT: Format = Format {
    name: "a wide table",
    known_by: "a time and columns like x1, y1, x2, y2",
    likelihood: None,
    recognise: |sheet, head, options| {
        let roles = head.first().and_then(|header| Roles::of(sheet, 1, header, options).ok());
        roles.is_some_and(|roles| roles.time.is_some() && roles.coordinates.len() >= 2)
    },
    read,
};

/// A marker's columns of x, y and z.
type Columns = (String, [Option<usize>; 3]);

pub(super) fn read(sheet: &CellText, options: &ImportOptions) -> Result<Vec<Recording>, DataError> {
    let mut lines = sheet.lines();
    let Some((first, header)) = lines.next() else {
        return Err(sheet.fault(0, "the file is empty", "export it again"));
    };
    let roles = Roles::of(sheet, first, &sheet.split(header), options)?;
    let Some((time, second)) = roles.time else {
        return Err(sheet.fault(first, "no column is the time", "say which: --map t=Time, or frame=Frame"));
    };
    let markers = markers(sheet, first, &roles)?;
    let mut runs = Runs::new(roles.lengths(sheet, first)?, second);
    let mut cells = Vec::new();
    for (number, line) in lines {
        sheet.split_into(line, &mut cells);
        let cell = |index: usize| cells.get(index).copied().unwrap_or_default();
        let pivot = runs.of(roles.run.map(cell), roles.actuator.map(cell));
        let t = second.unwrap_or(1.0) * sheet.time(cell(time), number, "time")?;
        if pivot.recording.times.last().is_some_and(|last| t <= *last) {
            let help = "give every run a file of its own, or say which column tells the runs apart: --map run=Trial";
            return Err(sheet.fault(number, format!("the time goes back here, to {}", cell(time)), help));
        }
        let frame = pivot.frame(t);
        for (name, parts) in &markers {
            let value = |part: Option<usize>| part.map_or(Ok(0.0), |index| sheet.expect(cell(index), number, name));
            let marker = pivot.marker(name);
            pivot.put(frame, marker, [value(parts[0])?, value(parts[1])?, value(parts[2])?], true);
        }
        roles.read_pressures(sheet, number, &cells, pivot, frame)?;
    }
    Ok(runs.finish(&roles.told))
}

fn markers(sheet: &CellText, line: u64, roles: &Roles) -> Result<Vec<Columns>, DataError> {
    let mut markers: Vec<Columns> = Vec::new();
    for (index, axis, name, _) in &roles.coordinates {
        let at = markers.iter().position(|(known, _)| known == name).unwrap_or_else(|| {
            markers.push((name.clone(), [None; 3]));
            markers.len() - 1
        });
        if markers[at].1[*axis].replace(*index).is_some() {
            let message = format!("two columns hold {} of marker {name}", ["x", "y", "z"][*axis]);
            return Err(sheet.fault(line, message, "give every marker a name of its own: x_a, y_a, x_b, y_b"));
        }
    }
    match markers.iter().find(|(_, parts)| parts[0].is_none() || parts[1].is_none()) {
        Some((name, _)) => {
            Err(sheet.fault(line, format!("marker {name} has not both x and y"), "every marker needs x and y"))
        }
        None => Ok(markers),
    }
}

/// Recordings by their label, in order of first appearance.
pub(super) struct Runs {
    pivots: Vec<Pivot>,
    numbers: HashMap<String, usize>,
    lengths: Lengths,
    clock: FrameClock,
    last: usize,
}

impl Runs {
    pub fn new(lengths: Lengths, second: Option<f64>) -> Runs {
        let clock = if second.is_some() { FrameClock::Seconds } else { FrameClock::Frames };
        Runs { pivots: Vec::new(), numbers: HashMap::new(), lengths, clock, last: 0 }
    }

    /// The recording of a run.
    pub fn of(&mut self, run: Option<&str>, actuator: Option<&str>) -> &mut Pivot {
        let run = run.map(label).unwrap_or_default();
        let same =
            self.pivots.get(self.last).is_some_and(|pivot| pivot.recording.run.as_deref().unwrap_or_default() == run);
        if !same {
            self.last = self.numbers.get(run).copied().unwrap_or(self.pivots.len());
            if self.last == self.pivots.len() {
                let mut pivot = Pivot::new(self.lengths, self.clock);
                pivot.recording.run = Some(run.to_string()).filter(|run| !run.is_empty());
                pivot.recording.actuator = actuator.map(str::to_lowercase).filter(|kind| !kind.is_empty());
                self.numbers.insert(run.to_string(), self.last);
                self.pivots.push(pivot);
            }
        }
        &mut self.pivots[self.last]
    }

    pub fn finish(self, told: &[String]) -> Vec<Recording> {
        let mut runs: Vec<Recording> = self.pivots.into_iter().map(Pivot::finish).collect();
        runs.iter_mut().take(1).for_each(|run| run.told.extend_from_slice(told));
        runs
    }
}
