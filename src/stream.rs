//! Lines of pressures: of a stream, which go on whatever comes, and of a file, which have to be right.

use compare::CompareError;
use models::{CHANNELS, Loads, Model, Scenario};
use spelling::units::{Dimension, Range, Unit, units_of};
use std::fs::File;
use std::io::{BufRead, BufReader, Read};
use std::path::Path;

const MOST_LINE: u64 = 4096;

/// What a line of the stream is marked with, and what that means; in the order of the counts of [`crate::Followed`].
pub(crate) const MARKS: [(&str, &str); 7] = [
    ("zero", "a pressure from -0.5 kPa to 0 counts as 0"),
    ("held", "a pressure is not a number or out of its bounds: the last good one is used"),
    ("line", "the line cannot be read: the last reading is used"),
    ("clock", "the time goes back or is not a number: the last reading is used"),
    ("unsolved", "no equilibrium exists: the last pose is printed"),
    ("limit", "a pressure is above max_pressure_kpa of the scenario"),
    ("beyond", "the pose is beyond a limit of the model: do not trust it"),
];
const ZERO: usize = 0;
const HELD: usize = 1;
pub(crate) const LINE: usize = 2;
const CLOCK: usize = 3;
pub(crate) const UNSOLVED: usize = 4;
pub(crate) const LIMIT: usize = 5;
pub(crate) const BEYOND: usize = 6;

pub(crate) type Marked = [bool; MARKS.len()];

#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum StreamColumn {
    Time,
    Body,
    All,
    Channel(usize),
}

pub(crate) const HEADER: &str =
    "the first line names the columns, for example t_s,p_kpa or t_s,p0_kpa,p1_kpa; then numbers";

const TABLE: &str =
    "the first line names the columns, for example p_kpa or p0_kpa,p1_kpa; then numbers, a line for each pose";

/// Pressures of a file, a line for each pose: columns as for [`crate::follow`], without a time.
///
/// # Errors
/// A file that cannot be read; a line that cannot be understood, by its number; more than `most` lines.
pub fn pressures_of(scenario: &Scenario, path: &Path, most: usize) -> Result<Vec<Loads>, CompareError> {
    let name = path.display().to_string();
    let unread = |cause: std::io::Error| CompareError::Unread {
        path: name.clone(),
        cause: cause.to_string(),
        help: "give a CSV file of pressures".into(),
    };
    let input = BufReader::new(File::open(path).map_err(unread)?);
    let channels: Vec<usize> = Model::new(scenario).channels().collect();
    let (mut lines, columns) = StreamLines::begin(input, &name, TABLE, |header| columns(header, &channels, false))?;
    let mut all = Vec::new();
    while let Some(line) = lines.next()? {
        let line = line.map_err(|what| lines.fault(&what))?;
        if all.len() == most {
            return Err(lines.fault_with(&format!("more than {most} pressures"), "ibr sweep computes more, in parts"));
        }
        all.push(read(&line, &columns, scenario.p_body_pa).map_err(|what| lines.fault(&what))?);
    }
    if all.is_empty() { Err(lines.fault("the file has no line of pressures")) } else { Ok(all) }
}

/// Lines that are read one by one into one buffer.
pub(crate) struct StreamLines<R> {
    input: R,
    /// For messages: where they are from, and how they should look.
    from: String,
    how: &'static str,
    number: u64,
    line: Vec<u8>,
}

impl<R: BufRead> StreamLines<R> {
    pub(crate) fn begin<T>(
        input: R,
        from: &str,
        how: &'static str,
        header: impl Fn(&str) -> Result<T, String>,
    ) -> Result<(StreamLines<R>, T), CompareError> {
        let mut lines = StreamLines { input, from: from.into(), how, number: 0, line: Vec::new() };
        let Some(first) = lines.next()? else { return Err(lines.fault("nothing came in")) };
        let first = first.map_err(|what| lines.fault(&what))?;
        let found = header(&first).map_err(|what| lines.fault(&what))?;
        Ok((lines, found))
    }

    /// Of the line that was read last, from 1.
    pub(crate) fn number(&self) -> u64 {
        self.number
    }

    /// The next line that is neither empty nor a comment, or its fault.
    pub(crate) fn next(&mut self) -> Result<Option<Result<String, String>>, CompareError> {
        loop {
            self.line.clear();
            self.number += 1;
            let got = self.read_part()?;
            if got as u64 == MOST_LINE && self.line.last() != Some(&b'\n') {
                while self.line.last() != Some(&b'\n') {
                    self.line.clear();
                    if self.read_part()? == 0 {
                        break;
                    }
                }
                return Ok(Some(Err(format!("it is longer than {MOST_LINE} bytes"))));
            }
            let Ok(text) = std::str::from_utf8(&self.line) else { return Ok(Some(Err("it is not text".into()))) };
            let text = text.trim_start_matches('\u{feff}').trim();
            match text {
                _ if got == 0 => return Ok(None),
                "" => {}
                text if text.starts_with('#') => {}
                text => return Ok(Some(Ok(text.to_string()))),
            }
        }
    }

    /// Reads to the end of a line, at most [`MOST_LINE`] bytes.
    fn read_part(&mut self) -> Result<usize, CompareError> {
        let got = (&mut self.input).take(MOST_LINE).read_until(b'\n', &mut self.line);
        got.map_err(|cause| self.fault_with(&cause.to_string(), ""))
    }

    fn fault(&self, what: &str) -> CompareError {
        self.fault_with(what, self.how)
    }

    fn fault_with(&self, what: &str, help: &str) -> CompareError {
        let cause = format!("line {}: {what}", self.number);
        CompareError::Unread { path: self.from.clone(), cause, help: help.into() }
    }
}

/// The columns of the header, with a time or without; a channel that feeds nothing is refused.
pub(crate) fn columns(header: &str, fed: &[usize], timed: bool) -> Result<Vec<(StreamColumn, Unit)>, String> {
    let mut found: Vec<(StreamColumn, Unit)> = Vec::new();
    for name in header.split(',').map(|name| name.trim().to_lowercase()) {
        let (base, unit) = name.rsplit_once('_').ok_or_else(|| format!("`{name}` has no unit"))?;
        let (column, dimension) = match base {
            "t" => (StreamColumn::Time, Dimension::TIME),
            "p_body" => (StreamColumn::Body, Dimension::PRESSURE),
            "p" | "p_act" => (StreamColumn::All, Dimension::PRESSURE),
            _ => match base.strip_prefix('p').and_then(|digits| digits.parse().ok()) {
                Some(channel) if fed.contains(&channel) => (StreamColumn::Channel(channel), Dimension::PRESSURE),
                Some(channel) => {
                    return Err(format!("`{name}`: nothing is supplied by channel {channel} in this scenario"));
                }
                None => return Err(format!("column `{name}` is not understood")),
            },
        };
        let unit = units_of(dimension).find(|known| known.symbol.to_lowercase() == unit);
        let unit = unit.ok_or_else(|| format!("`{name}` has an unknown unit"))?;
        if found.iter().any(|(known, _)| *known == column) {
            return Err(format!("column `{name}` comes twice"));
        }
        found.push((column, unit));
    }
    let has = |column: StreamColumn| found.iter().any(|(known, _)| *known == column);
    let (some, every) =
        (fed.iter().any(|c| has(StreamColumn::Channel(*c))), fed.iter().all(|c| has(StreamColumn::Channel(*c))));
    match (has(StreamColumn::Time), has(StreamColumn::All), some) {
        (false, ..) if timed => Err("column t_s is missing".into()),
        (true, ..) if !timed => Err("it has times: give it to ibr predict --follow as standard input".into()),
        (_, true, true) => Err("p for all channels and pressures of single ones give the same twice".into()),
        (_, false, _) if !every => Err(format!("not every one of the channels {fed:?} has a pressure")),
        _ => Ok(found),
    }
}

fn put(column: StreamColumn, pa: f64, loads: &mut Loads) {
    match column {
        StreamColumn::Time => {}
        StreamColumn::Body => loads.body_pa = pa,
        StreamColumn::All => loads.actuator_pa = [pa; CHANNELS],
        StreamColumn::Channel(channel) => loads.actuator_pa[channel] = pa,
    }
}

fn read(line: &str, columns: &[(StreamColumn, Unit)], body_pa: f64) -> Result<Loads, String> {
    let cells: Vec<&str> = line.split(',').map(str::trim).collect();
    if cells.len() != columns.len() {
        return Err(format!("{} cells, the header has {}", cells.len(), columns.len()));
    }
    let mut loads = Loads { body_pa, actuator_pa: [0.0; CHANNELS] };
    for (cell, (column, unit)) in cells.into_iter().zip(columns) {
        let number: f64 = cell.parse().map_err(|_| format!("`{cell}` is not a number"))?;
        put(*column, unit.to_si(number), &mut loads);
    }
    loads.checked().map_err(|error| error.to_string())
}

/// Below zero by less than this a pressure is the noise of a sensor \[Pa\].
const NEAR_ZERO_PA: f64 = 500.0;
/// After so many late lines in a row that follow each other the clock has begun again.
const NEW_CLOCK: usize = 5;

#[derive(Debug)]
pub(crate) struct StreamReading {
    pub t_s: f64,
    pub loads: Loads,
    /// Shift added to the times, since a clock began again \[s\].
    ahead_s: f64,
    /// Late lines in a row, and the time of the last one \[s\].
    late: (usize, f64),
}

impl StreamReading {
    /// At time 0, with nothing in the actuators.
    pub(crate) fn at_rest(body_pa: f64) -> StreamReading {
        let loads = Loads { body_pa, actuator_pa: [0.0; CHANNELS] };
        StreamReading { t_s: 0.0, loads, ahead_s: 0.0, late: (0, 0.0) }
    }

    /// Takes the good values of a line, and marks the others.
    pub(crate) fn take(&mut self, line: &str, columns: &[(StreamColumn, Unit)], marked: &mut Marked) {
        let cells: Vec<&str> = line.split(',').map(str::trim).collect();
        if cells.len() != columns.len() {
            marked[LINE] = true;
            return;
        }
        let value = |cell: &str, unit: &Unit| unit.to_si(cell.parse().unwrap_or(f64::NAN));
        let all = || cells.iter().zip(columns).map(|(cell, (column, unit))| (*column, value(cell, unit)));
        let time = all().find(|(column, _)| *column == StreamColumn::Time).map_or(f64::NAN, |(_, t_s)| t_s);
        if !self.is_next(time) {
            marked[CLOCK] = true;
            return;
        }
        for (column, pa) in all().filter(|(column, _)| *column != StreamColumn::Time) {
            let bounds = if column == StreamColumn::Body { &Range::BODY_PRESSURE } else { &Range::ACTUATOR_PRESSURE };
            if bounds.contains(pa) {
                put(column, pa, &mut self.loads);
            } else if column != StreamColumn::Body && (-NEAR_ZERO_PA..0.0).contains(&pa) {
                marked[ZERO] = true;
                put(column, 0.0, &mut self.loads);
            } else {
                marked[HELD] = true;
            }
        }
    }

    /// Whether a time is good and not before the last one; it is then the last one.
    fn is_next(&mut self, time_s: f64) -> bool {
        if !Range::TIME.contains(time_s) {
            return false;
        }
        if time_s + self.ahead_s < self.t_s {
            let follows = self.late.0 > 0 && time_s >= self.late.1;
            self.late = (if follows { self.late.0 + 1 } else { 1 }, time_s);
            if self.late.0 == NEW_CLOCK {
                (self.ahead_s, self.late) = (self.t_s - time_s, (0, 0.0));
            }
            return false;
        }
        (self.t_s, self.late) = (time_s + self.ahead_s, (0, 0.0));
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn robot() -> Scenario {
        Scenario::parse(models::shipped("epam-textbook").unwrap()).unwrap()
    }

    #[test]
    fn a_file_of_pressures_is_read_line_by_line_without_times() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("p.csv");
        let read = |text: &str| {
            std::fs::write(&path, text).unwrap();
            pressures_of(&robot(), &path, 3).map_err(|error| error.to_string())
        };
        let found = read("p_bar,p_body_kpa\n0.1,2\n\n0.2,3\n").unwrap();
        assert_eq!(found, [Loads::uniform(2e3, 0.1e5), Loads::uniform(3e3, 0.2e5)]);
        for (text, words) in [
            ("p_kpa\n", "the file has no line of pressures"),
            ("p_kpa\n1\nx\n", "line 3: `x` is not a number"),
            ("t_s,p_kpa\n0,1\n", "line 1: it has times"),
            ("p_kpa\n1\n2\n3\n4\n", "line 5: more than 3 pressures"),
        ] {
            let error = read(text).unwrap_err();
            assert!(error.contains(words) && error.contains("p.csv"), "{text}: {error}");
        }
        std::fs::remove_file(&path).unwrap();
        assert!(pressures_of(&robot(), &path, 3).unwrap_err().to_string().contains("p.csv"));
    }
}
