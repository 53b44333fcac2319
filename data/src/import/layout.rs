//! What the columns of a tracking table hold. Every kind of file declares it; one loop reads the rows.

use std::borrow::Cow;

use super::options::ImportOptions;
use super::recording::{Lengths, Pivot, Recording, counted};
use super::sheet::CellText;
use crate::cells::{Labels, is_nothing, label};
use crate::error::Result;

/// What a column of a marker holds.
pub(super) const PARTS: [&str; 4] = ["x", "y", "z", "likelihood"];

pub(super) const LIKELIHOOD: usize = 3;

/// Likelihood below which DeepLabCut's network itself marks a point as not seen.
pub(super) const NOT_SEEN: f64 = 0.9;

/// The part that a word names, in small letters or large ones.
pub(super) fn part(word: &str) -> Option<usize> {
    PARTS.iter().position(|part| part.eq_ignore_ascii_case(word))
}

/// The columns of one marker, in the order of [`PARTS`].
struct MarkerColumns {
    /// Empty where a column names the marker of every row.
    name: String,
    columns: [Option<usize>; PARTS.len()],
}

/// The columns of a table with a row for every frame, or for every frame and marker.
#[derive(Default)]
pub(super) struct FrameColumns {
    /// The line that names the columns.
    pub line: u64,
    pub time: usize,
    /// Seconds of its unit; `None` for numbers of frames.
    pub second: Option<f64>,
    pub lengths: Lengths,
    /// Columns that name the run, the actuator and the marker of a row.
    pub run: Option<usize>,
    pub actuator: Option<usize>,
    pub marker: Option<usize>,
    /// Columns of the body's and the actuator's pressure, with their pascals.
    pub pressures: [Option<(usize, f64)>; 2],
    /// Least likelihood of a position, and the largest that there is.
    pub likely: [f64; 2],
    pub y_down: bool,
    /// Cells of every row; `None` if rows may be shorter.
    pub width: Option<usize>,
    /// The time rises from row to row of a run.
    pub rises: bool,
    pub named: bool,
    /// What a row is, and what names its marker.
    pub row_of: [&'static str; 2],
    /// What to do about a marker that has two places at one time; `None` if every run has its own file.
    pub twice: Option<&'static str>,
    pub told: Vec<String>,
    tracks: Vec<MarkerColumns>,
}

impl FrameColumns {
    /// No marker yet; times of this unit in this column, which a line names with the others.
    pub(super) fn new(line: u64, time: usize, second: Option<f64>, lengths: Lengths) -> FrameColumns {
        FrameColumns {
            line,
            time,
            second,
            lengths,
            likely: [f64::NEG_INFINITY, f64::INFINITY],
            named: true,
            row_of: ["row", "marker"],
            ..FrameColumns::default()
        }
    }

    /// Positions below a likelihood, the caller's or the usual one, are lost; likelihoods go up to `most`.
    pub(super) fn unlikely(&mut self, options: &ImportOptions, usual: f64, most: f64, below: &str) {
        let limit = options.likelihood.unwrap_or(usual);
        self.likely = [limit, most];
        self.told.push(format!("positions {below} {limit} are lost markers (--likelihood)"));
    }

    /// Columns of markers, new or known: the column, its marker, and which of [`PARTS`] it holds.
    pub(super) fn columns<N: AsRef<str>>(
        &mut self,
        sheet: &CellText,
        columns: impl IntoIterator<Item = (usize, N, usize)>,
    ) -> Result<()> {
        for (column, name, part) in columns {
            let name = name.as_ref();
            let at = self.tracks.iter().position(|track| track.name == name).unwrap_or_else(|| {
                self.tracks.push(MarkerColumns { name: name.to_string(), columns: [None; PARTS.len()] });
                self.tracks.len() - 1
            });
            if self.tracks[at].columns[part].replace(column).is_some() {
                let message = format!("two columns are {} of {}", PARTS[part], of(name));
                let help = "give every marker a different name: x_a, y_a, x_b, y_b";
                return Err(sheet.fault(self.line, message, help));
            }
        }
        Ok(())
    }

    /// Reads the rows that are left; every marker has so many coordinates at least.
    pub(super) fn read<'s>(
        self,
        sheet: &CellText<'s>,
        axes: usize,
        rows: impl Iterator<Item = (u64, &'s str)>,
    ) -> Result<Vec<Recording>> {
        for track in &self.tracks {
            if let Some(part) = (0..axes).find(|part| track.columns[*part].is_none()) {
                let message = format!("{} has no column of {}", of(&track.name), PARTS[part]);
                let help = "every marker needs its coordinates: export it again";
                return Err(sheet.fault(self.line, message, help));
            }
        }
        if self.tracks.is_empty() {
            let help = "export the places of markers";
            return Err(sheet.fault(self.line, "no column is the position of a marker", help));
        }
        let mut runs = Runs::default();
        let (mut cells, mut nameless) = (Vec::new(), 0);
        for (number, line) in rows {
            sheet.split_into(line, &mut cells);
            if let Some(width) = self.width {
                sheet.whole_row(&cells, width, number)?;
            }
            let marker = self.marker.map(|column| label(cell(&cells, column)));
            if marker.is_some_and(is_nothing) && self.tracks[0].name.is_empty() {
                nameless += 1;
                continue;
            }
            let pivot = runs.of(&self, &cells);
            self.read_row(sheet, number, &cells, marker, pivot)?;
        }
        let [row, what] = self.row_of;
        let left_out = (nameless > 0).then(|| format!("left out: {} of no {what}", counted(nameless, row)));
        let mut runs: Vec<Recording> = runs.pivots.into_iter().map(Pivot::finish).collect();
        runs.iter_mut().for_each(|run| run.named = self.named);
        runs.iter_mut().take(1).for_each(|run| run.told.extend(left_out.iter().chain(&self.told).cloned()));
        Ok(runs)
    }

    fn read_row(
        &self,
        sheet: &CellText,
        number: u64,
        cells: &[&str],
        marker: Option<&str>,
        pivot: &mut Pivot,
    ) -> Result<()> {
        let time = cell(cells, self.time);
        let t = sheet.time(time, self.second.unwrap_or(1.0), number, "time")?;
        if self.rises && pivot.recording.times.last().is_some_and(|last| t <= *last) {
            let help = "give every run its own file, or name the column that identifies the run: --map run=Trial";
            return Err(sheet.fault(number, format!("the time goes back here, to {time}"), help));
        }
        let frame = pivot.frame(t);
        for MarkerColumns { name, columns } in &self.tracks {
            let value = |part: usize, absent: f64| {
                let Some(text) = columns[part].map(|column| cell(cells, column)) else { return Ok(absent) };
                let what = || format!("{} of {}", PARTS[part], of(name));
                sheet.finite(text).ok_or_else(|| sheet.no_number(text, number, &what()))
            };
            let likelihood = value(LIKELIHOOD, f64::NAN)?;
            let [least, most] = self.likely;
            if most.is_finite() && !likelihood.is_nan() && !(0.0..=most).contains(&likelihood) {
                let message = format!("a likelihood of {likelihood} is not from 0 to {most}");
                return Err(sheet.fault(number, message, "export the analysed video again as CSV"));
            }
            let [x, y, z] = [value(0, f64::NAN)?, value(1, f64::NAN)?, value(2, 0.0)?];
            let name: Cow<str> = match marker {
                Some(marker) if name.is_empty() => marker.into(),
                Some(marker) => format!("{marker}_{name}").into(),
                None => name.into(),
            };
            let place = [x, if self.y_down { -y } else { y }, z];
            let (marker, likely) = (pivot.marker(&name), likelihood.is_nan() || likelihood >= least);
            let is_new = pivot.put(frame, marker, place, likely);
            if let Some(help) = self.twice.filter(|_| !is_new) {
                let message = format!("marker {name} is there twice at {time} of one run");
                return Err(sheet.fault(number, message, help));
            }
        }
        for (which, pressure) in self.pressures.into_iter().enumerate() {
            let Some((column, pa)) = pressure else { continue };
            let value = sheet.expect(cell(cells, column), number, "pressure")?;
            pivot.read(frame, which, pa * value);
        }
        Ok(())
    }
}

fn cell<'c>(cells: &[&'c str], column: usize) -> &'c str {
    cells.get(column).copied().unwrap_or_default()
}

fn of(name: &str) -> String {
    if name.is_empty() { "every marker".into() } else { format!("marker {name}") }
}

/// Recordings by their label, in order of first appearance.
#[derive(Default)]
struct Runs {
    pivots: Vec<Pivot>,
    labels: Labels,
}

impl Runs {
    /// The recording of the run of a row.
    fn of(&mut self, layout: &FrameColumns, cells: &[&str]) -> &mut Pivot {
        let run = layout.run.map_or("", |column| label(cell(cells, column)));
        let number = self.labels.number(run);
        if number == self.pivots.len() {
            let actuator = layout.actuator.map(|column| cell(cells, column).to_lowercase());
            let mut pivot = Pivot::new(layout.lengths, layout.second.is_some());
            pivot.recording.run = Some(run.to_string()).filter(|run| !run.is_empty());
            pivot.recording.actuator = actuator.filter(|kind| !kind.is_empty());
            self.pivots.push(pivot);
        }
        &mut self.pivots[number]
    }
}
