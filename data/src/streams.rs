//! Observations sorted into (run, marker) streams, streams cut into holds, holds kept as at most 64 samples.
//!
//! Rows may come sorted by time or by marker: each (run, marker) pair is followed on its own. A new hold begins when
//! the phase changes or a pressure departs from the mean of the current hold by more than its tolerance.

mod placeholders;
pub(crate) mod plausible;
mod segments;

use std::collections::HashMap;

use crate::cells::Labels;
use crate::columns::TableSheet;
use crate::error::{DataError, Result};
use crate::header::{GAUGE, MARKER, P_ACT, P_BODY, PRESSURES, QUANTITIES, RUN, STATION, TIME, X, Y, Z, more_channels};
use crate::lines::TextLine;
use crate::policy;
use crate::rows::{Cells, Observation, lowest_mean_pa};
use placeholders::Placeholders;
pub(crate) use segments::{HoldSegment, SampleSums, Stream, are_near, merged};

/// Everything kept of a file while it is read.
#[derive(Debug, Default)]
pub(crate) struct Recorder {
    pub file: String,
    pub runs: Labels,
    pub markers: Labels,
    pub streams: Vec<Stream>,
    /// Station of each marker from the `s_mm` column \[m\].
    pub stations_m: Vec<Option<f64>>,
    /// Largest values by quantity, for the check of units.
    pub largest: [f64; QUANTITIES.len()],
    /// Supply channels beyond the first that the table has.
    pub more_channels: usize,
    /// The table has a third coordinate.
    pub has_z: bool,
    /// The table has readings of a gauge.
    pub has_gauge: bool,
    /// Units that the columns of actuator and body pressure name.
    pub pressure_units: [&'static str; 2],
    pub lost_frames: u64,
    /// Runs and markers of rows without a position, and the first line of each pair.
    lost: (Labels, Labels, HashMap<[usize; 2], u64>),
    /// Rows with a placeholder for a position.
    pub placeholders: Placeholders,
    by_pair: HashMap<(usize, usize), usize>,
    series: usize,
}

impl Recorder {
    /// Nothing yet, of a table with this header.
    pub(crate) fn of(sheet: &TableSheet) -> Recorder {
        Recorder {
            file: sheet.head.line.file.clone(),
            more_channels: more_channels(sheet),
            has_z: sheet.has(Z),
            has_gauge: sheet.has(GAUGE),
            pressure_units: [P_ACT, P_BODY].map(|column| sheet.unit(column)),
            ..Recorder::default()
        }
    }

    /// Runs, holds or markers that do not fit together, first seen in a line.
    pub(crate) fn fault(&self, message: String, help: &str, line: u64) -> DataError {
        DataError::of(&self.file, message, help).at_line(line)
    }

    pub(crate) fn words(&self, stream: &Stream) -> String {
        format!("run {}, marker {}", self.runs.names[stream.run], self.markers.names[stream.marker])
    }

    pub(crate) fn add(&mut self, cells: Cells) -> Result<()> {
        let row = cells.row()?;
        let (run, marker) = (self.runs.number(row.run), self.markers.number(row.marker));
        let limits = [(RUN, "run", run, policy::MOST_RUNS), (MARKER, "marker", marker, policy::MOST_MARKERS)];
        if let Some((quantity, what, _, most)) = limits.into_iter().find(|(.., found, most)| found >= most) {
            let help = format!("split the file: at most {most} {what}s are read at once; is the {what} column right?");
            return Err(cells.fault(quantity, format!("more than {most} {what}s"), help));
        }
        let places = [(X, row.x_m), (Y, row.y_m), (Z, row.z_m.unwrap_or(0.0)), (STATION, row.station_m.unwrap_or(0.0))];
        for (quantity, value) in places.into_iter().chain(PRESSURES.into_iter().zip(row.pressures_pa)) {
            self.largest[quantity] = self.largest[quantity].max(value.abs());
        }
        self.set_station(marker, &row, cells)?;
        self.add_to_stream([run, marker], &row, cells)
    }

    /// Takes a row in which a marker was not seen.
    pub(crate) fn note_lost(&mut self, cells: Cells) {
        let (runs, markers, lines) = &mut self.lost;
        if lines.len() < policy::MOST_SERIES {
            lines.entry([runs.number(cells.run()), markers.number(cells.marker())]).or_insert(cells.line.number);
        }
    }

    /// A marker that has rows in a run and no position there was lost in all its holds, if another run saw it.
    pub(crate) fn add_lost(&mut self) {
        let (runs, markers, lines) = std::mem::take(&mut self.lost);
        let mut lines: Vec<([usize; 2], u64)> = lines.into_iter().collect();
        lines.sort_unstable_by_key(|(_, line)| *line);
        let place = |known: &Labels, name: &String| known.names.iter().position(|other| other == name);
        for ([run, marker], first_line) in lines {
            let pair = place(&self.runs, &runs.names[run]).zip(place(&self.markers, &markers.names[marker]));
            let Some((run, marker)) = pair.filter(|pair| !self.by_pair.contains_key(pair)) else { continue };
            let [first_t_s, last_t_s] = [f64::INFINITY, f64::NEG_INFINITY];
            self.streams.push(Stream { run, marker, first_line, first_t_s, segments: Vec::new(), last_t_s });
        }
    }

    fn add_to_stream(&mut self, [run, marker]: [usize; 2], row: &Observation, cells: Cells) -> Result<()> {
        let index = *self.by_pair.entry((run, marker)).or_insert(self.streams.len());
        if index == self.streams.len() {
            let (first_line, first_t_s, last_t_s) = (cells.line.number, row.t_s, f64::NEG_INFINITY);
            self.streams.push(Stream { run, marker, first_line, first_t_s, segments: Vec::new(), last_t_s });
        }
        let stream = &mut self.streams[index];
        check_time(stream, row, cells)?;
        stream.last_t_s = row.t_s;
        stream.take_back(row);
        if !stream.segments.last().is_some_and(|segment| segment.continues_with(row)) {
            if policy::is_full(stream.segments.len(), self.series) {
                return Err(too_many_holds(cells.line));
            }
            self.series += 1;
            stream.segments.push(HoldSegment::new(row, cells.line.number));
        }
        if let Some(segment) = stream.segments.last_mut() {
            for (which, (pressure_pa, quantity)) in row.pressures_pa.into_iter().zip(PRESSURES).enumerate() {
                if pressure_pa < lowest_mean_pa(quantity) && segment.too_low[which].is_none() {
                    segment.too_low[which] = Some(cells.too_low(quantity, pressure_pa));
                }
            }
            segment.add(row);
        }
        Ok(())
    }

    fn set_station(&mut self, marker: usize, row: &Observation, cells: Cells) -> Result<()> {
        if self.stations_m.len() <= marker {
            self.stations_m.resize(marker + 1, None);
        }
        let Some(new) = row.station_m else { return Ok(()) };
        let old = *self.stations_m[marker].get_or_insert(new);
        if (new - old).abs() <= policy::SAME_STATION_M {
            return Ok(());
        }
        let (marker, [old, new]) = (row.marker, [old, new].map(|station_m| station_m * 1e3));
        let message = format!("marker {marker} has two stations: {old} mm and {new} mm");
        let help = "the station is the place on the undeformed robot: write the same number in every row";
        Err(cells.fault(STATION, message, help))
    }
}

fn check_time(stream: &Stream, row: &Observation, cells: Cells) -> Result<()> {
    if row.t_s > stream.last_t_s {
        return Ok(());
    }
    let of = format!("run {}, marker {}", row.run, row.marker);
    let (message, help) = if row.t_s == stream.last_t_s {
        (format!("{of} is there twice at this time"), "delete the duplicate row")
    } else {
        let help = "t_s counts from the start of the run and grows row by row for each marker; \
                    sort the rows, give repeated tests their own run label, and look for rows copied twice";
        (format!("time goes backwards in {of}: {} s after {} s", row.t_s, stream.last_t_s), help)
    };
    Err(cells.fault(TIME, message, help))
}

fn too_many_holds(line: &TextLine) -> DataError {
    let [own, all] = [policy::MOST_HOLDS, policy::MOST_SERIES];
    let message = format!("more than {own} holds in one run, or {all} in all");
    let help = "keep only rows recorded while the pressures are steady; a new hold begins when the phase changes or a \
                pressure moves by more than 5 %";
    line.fault(message, help)
}
