//! One line of the table as one checked observation in SI units.

use crate::cells::{Decimals, is_nothing, label, no_number, with_comma};
use crate::columns::TableSheet;
use crate::dataset::Phase;
use crate::error::{DataError, Result};
use crate::header::{
    ACTUATOR, GAUGE, MARKER, P_BODY, PHASE, PRESSURES, QUANTITIES, RUN, RowPressures, STATION, TIME, X, Y, Z,
};
use crate::lines::TextLine;
use crate::policy;
use spelling::units::{Range, Unit};
use std::ops::Deref;

/// One observation; texts borrow from the reader.
#[derive(Debug)]
pub(crate) struct Observation<'a> {
    pub run: &'a str,
    pub marker: &'a str,
    pub phase: Phase,
    pub t_s: f64,
    /// 0 of a channel without a column.
    pub pressures_pa: RowPressures,
    pub x_m: f64,
    pub y_m: f64,
    pub z_m: Option<f64>,
    pub station_m: Option<f64>,
    pub gauge_pa: Option<f64>,
}

/// Splits lines into cells and cells into observations.
pub(crate) struct RowReader {
    pub sheet: TableSheet,
    splitter: csv_core::Reader,
    cells: Vec<u8>,
    ends: Vec<usize>,
    decimals: Decimals,
    /// 1 where every row begins with a name that the header has not, as R writes tables.
    shift: usize,
    rows: u64,
    /// A label and a time that were not written as this program would.
    label: Option<String>,
    duration: Option<String>,
}

/// Numbers that stand for no position where both x and y have them. No camera sees a marker at one of them to the last digit.
const PLACEHOLDERS: [(f64, &str); 9] = [
    (0.0, "0, 0"),
    (-1.0, "-1, -1"),
    (999.0, "999, 999"),
    (-999.0, "-999, -999"),
    (9999.0, "9999, 9999"),
    (-9999.0, "-9999, -9999"),
    (99999.0, "99999, 99999"),
    (-99999.0, "-99999, -99999"),
    (65535.0, "65535, 65535"),
];

const SECONDS: [&str; 4] = ["seconds", "secs", "sec", "s"];

/// Gauge pressures of a body and absolute ones, up to the room's 115 kPa more: they are read, so that the slips can say what to subtract.
const BODY_READING: Range = Range { high: Range::BODY_PRESSURE.high + 115.0, ..Range::BODY_PRESSURE };

pub(crate) fn pressure_bounds(quantity: usize) -> &'static Range {
    if quantity == P_BODY { &BODY_READING } else { &Range::ACTUATOR_PRESSURE }
}

/// Means of holds below this are no noise of a sensor \[Pa\].
pub(crate) fn lowest_mean_pa(quantity: usize) -> f64 {
    if quantity == P_BODY { BODY_READING.low * BODY_READING.si } else { policy::LOWEST_GAUGE_PA }
}

impl RowReader {
    pub(crate) fn new(sheet: TableSheet) -> RowReader {
        // The line end is already gone; a lone carriage return is then an ordinary character.
        let end = csv_core::Terminator::Any(b'\n');
        let splitter = csv_core::ReaderBuilder::new().delimiter(sheet.head.delimiter as u8).terminator(end).build();
        // Two places more than columns, so that names of rows and a row with too many cells are noticed.
        let ends = vec![0; sheet.head.names.len() + 2];
        let (cells, decimals) = (Vec::new(), Decimals::default());
        RowReader { sheet, splitter, cells, ends, decimals, shift: 0, rows: 0, label: None, duration: None }
    }

    /// Splits one line into cells, to be read as [`Cells`].
    pub(crate) fn split(&mut self, line: &TextLine) -> Result<()> {
        self.cells.resize(self.cells.len().max(line.text.len() + 1), 0);
        self.splitter.reset();
        let (_, _, written, mut count) =
            self.splitter.read_record(line.text.as_bytes(), &mut self.cells, &mut self.ends);
        if count < self.ends.len() {
            let (ends, cells) = (&mut self.ends[count..], &mut self.cells[written..]);
            let (_, _, _, more) = self.splitter.read_record(&[], cells, ends);
            count += more;
        }
        self.rows += 1;
        let longer = count == self.sheet.head.names.len() + 1;
        if self.rows == 1 && longer {
            self.shift = usize::from(self.has_row_name(line));
        }
        if self.shift == 1 && longer && !self.counts_on(line) {
            let message = "the rows have one cell more than the header, and their first cells are no running numbers";
            let help = "write decimals with a point, or give the first column a name";
            return Err(line.fault(message, help));
        }
        if count == self.sheet.head.names.len() + self.shift {
            self.listen(line)
        } else {
            Err(self.wrong_count(line, count))
        }
    }

    /// Whether the first row begins with its number or a quoted name, before cells that fit the header.
    fn has_row_name(&mut self, line: &TextLine) -> bool {
        self.shift = 1;
        self.counts_on(line) && Cells { reader: self, line }.phase().is_ok()
    }

    /// Whether the first cell is quoted or the number of its row.
    fn counts_on(&self, line: &TextLine) -> bool {
        let first = self.ends.first().and_then(|end| self.cells.get(..*end)).unwrap_or_default();
        line.text.starts_with('"') || first == self.rows.to_string().as_bytes()
    }

    /// Notes how numbers and labels of a line are written.
    fn listen(&mut self, line: &TextLine) -> Result<()> {
        if self.sheet.head.delimiter != ',' && line.text.contains([',', '.']) {
            let mut decimals = std::mem::take(&mut self.decimals);
            for quantity in (0..QUANTITIES.len()).filter(|quantity| !self.sheet.unit(*quantity).is_empty()) {
                decimals.number(self.text(quantity), true, line)?;
            }
            self.decimals = decimals;
        }
        let is_long = |text: &&str| label(text) != *text;
        let label = [self.text(RUN), self.text(MARKER)].into_iter().find(is_long).map(str::to_string);
        let time = Some(self.text(TIME)).filter(|time| time.ends_with(|c: char| c.is_alphabetic()));
        let duration = time.map(str::to_string);
        self.label = self.label.take().or(label);
        self.duration = self.duration.take().or(duration);
        Ok(())
    }

    pub(crate) fn told(&self) -> Result<Vec<String>> {
        let comma = self.decimals.finish()?;
        let r_names = "every row begins with a name that the header has not, as R writes it: left out";
        let separator = || format!("a first line names the separator: {}", self.sheet.head.delimiter);
        let labels = |text: &String| format!("labels such as {text} are read as {}", label(text));
        let times = |text: &String| format!("times such as \"{text}\" are read as seconds");
        let told = [
            self.sheet.head.named.then(separator),
            comma.then(|| "decimals are written with a comma".into()),
            (self.shift > 0).then(|| r_names.into()),
            self.label.as_ref().map(labels),
            self.duration.as_ref().map(times),
        ];
        Ok(told.into_iter().flatten().collect())
    }

    fn has(&self, quantity: usize) -> bool {
        self.sheet.has(quantity)
    }

    fn text(&self, quantity: usize) -> &str {
        let Some(column) = &self.sheet.at[quantity] else { return "" };
        let index = column.index + self.shift;
        let start = if index == 0 { 0 } else { self.ends[index - 1] };
        let bytes = self.cells.get(start..self.ends[index]).unwrap_or_default();
        std::str::from_utf8(bytes).unwrap_or_default().trim()
    }

    fn wrong_count(&self, line: &TextLine, count: usize) -> DataError {
        let expected = self.sheet.head.names.len() + self.shift;
        let more = if count > expected { format!("more than {expected}") } else { count.to_string() };
        let begin = if line.ended { "" } else { "the file ends in the middle of a row: " };
        let help = match line.text.matches('"').count() % 2 {
            1 => "close the quotation mark on the same line",
            _ if count > expected && line.text.contains(',') => {
                "write decimals with a point, and put cells that contain the separator in quotation marks"
            }
            _ => "complete the row or delete it; if the copy was cut short, copy the file again",
        };
        line.fault(format!("{begin}expected {expected} cells, found {more}"), help)
    }
}

/// The cells of the line that was split last, with its place for faults.
#[derive(Clone, Copy)]
pub(crate) struct Cells<'a> {
    pub reader: &'a RowReader,
    pub line: &'a TextLine<'a>,
}

impl Deref for Cells<'_> {
    type Target = RowReader;
    fn deref(&self) -> &RowReader {
        self.reader
    }
}

impl<'a> Cells<'a> {
    pub(crate) fn actuator(&self) -> Result<&'a str> {
        self.word(ACTUATOR)
    }

    /// Whether the marker of the line was not seen: no coordinate, or NaN for each.
    pub(crate) fn is_lost(&self) -> bool {
        [X, Y].iter().all(|axis| is_nothing(self.text(*axis))) && (!self.has(Z) || is_nothing(self.text(Z)))
    }

    /// The placeholder of a position that was not seen, as some programs write it: 0, 0 or -1, -1 or 9999, 9999.
    pub(crate) fn placeholder(&self) -> Option<&'static str> {
        let (x, y) = (self.text(X), self.text(Y));
        // Most positions begin with another digit.
        if !x.starts_with(['0', '-', '.', '9', '6']) {
            return None;
        }
        let (x, y) = (x.parse::<f64>().ok()?, y.parse::<f64>().ok()?);
        // Another third coordinate is a place.
        if self.has(Z) && self.text(Z).parse().is_ok_and(|z: f64| z != x) {
            return None;
        }
        PLACEHOLDERS.iter().find(|(value, _)| x == *value && y == *value).map(|(_, words)| *words)
    }

    pub(crate) fn run(&self) -> &'a str {
        label(self.reader.text(RUN))
    }

    pub(crate) fn marker(&self) -> &'a str {
        label(self.reader.text(MARKER))
    }

    /// The cell of the station, if it is a number \[m\].
    pub(crate) fn station_m(&self) -> Option<f64> {
        let unit = self.sheet.at[STATION].as_ref()?.unit?;
        self.text(STATION).parse().ok().map(|value| unit.to_si(value))
    }

    pub(crate) fn row(&self) -> Result<Observation<'a>> {
        Ok(Observation {
            run: label(self.word(RUN)?),
            marker: label(self.word(MARKER)?),
            phase: self.phase()?,
            t_s: self.bounded(TIME, &Range::TIME)?,
            pressures_pa: self.pressures()?,
            x_m: self.length(X)?,
            y_m: self.length(Y)?,
            z_m: self.has(Z).then(|| self.length(Z)).transpose()?,
            station_m: self.has(STATION).then(|| self.bounded(STATION, &Range::STATION)).transpose()?,
            gauge_pa: self.has(GAUGE).then(|| self.pressure(GAUGE)).transpose()?,
        })
    }

    fn pressures(&self) -> Result<RowPressures> {
        let mut pressures_pa = RowPressures::default();
        for (k, quantity) in PRESSURES.into_iter().enumerate().filter(|(_, q)| self.has(*q)) {
            pressures_pa[k] = self.pressure(quantity)?;
        }
        Ok(pressures_pa)
    }

    /// The fault of one cell, with its column, text and span.
    pub(crate) fn fault(&self, quantity: usize, message: impl Into<String>, help: impl Into<String>) -> DataError {
        let Cells { line, reader } = self;
        let error = line.fault(message, help);
        let Some(column) = &self.sheet.at[quantity] else { return error };
        let mut error = error.in_column(self.sheet.name(quantity), Some(self.text(quantity)));
        if !line.text.contains('"') {
            let cells = || line.text.split(self.sheet.head.delimiter);
            let index = column.index + reader.shift;
            let start = line.start + cells().take(index).map(|cell| cell.len() + 1).sum::<usize>();
            let length = cells().nth(index).unwrap_or_default().len();
            error.fault_mut().span = Some((start, start + length));
        }
        error
    }

    fn word(&self, quantity: usize) -> Result<&'a str> {
        let text = self.reader.text(quantity);
        if text.is_empty() {
            let help = format!("write the {} in every row", QUANTITIES[quantity].base);
            return Err(self.fault(quantity, "the cell is empty", help));
        }
        Ok(text)
    }

    fn phase(&self) -> Result<Phase> {
        let text = self.word(PHASE)?;
        let help = "write load (actuator pressure raised), hold (unchanged) or unload (lowered)";
        Phase::of(text).ok_or_else(|| self.fault(PHASE, format!("unknown phase \"{text}\""), help))
    }

    fn number(&self, quantity: usize) -> Result<f64> {
        let text = self.text(quantity);
        let seconds = self.sheet.unit(quantity) == "s";
        let suffix = SECONDS.iter().filter(|_| seconds).find_map(|word| text.strip_suffix(word));
        let plain = suffix.unwrap_or(text).trim_end();
        let comma = || if self.sheet.head.delimiter == ',' { None } else { with_comma(plain) };
        let value = plain.parse::<f64>().ok().or_else(comma);
        let column = self.sheet.at[quantity].as_ref().filter(|column| column.unit.is_some());
        let si = value.zip(column).and_then(|(value, column)| column.si(value, Unit::to_si));
        si.ok_or_else(|| {
            let lost = match quantity {
                X | Y | Z if self.has(Z) => "; of a marker that was not seen leave x, y and z empty",
                X | Y => "; of a marker that was not seen leave x and y empty",
                _ => "",
            };
            let [message, help] = no_number(text, QUANTITIES[quantity].expected, lost);
            self.fault(quantity, message, help)
        })
    }

    fn length(&self, quantity: usize) -> Result<f64> {
        let value = self.number(quantity)?;
        if value.abs() > policy::FARTHEST_M {
            let name = QUANTITIES[quantity].expected;
            let message = format!("\"{}\" is farther than any robot reaches", self.text(quantity));
            let help = format!("correct or delete the row; {name} is the name of a column in millimetres");
            return Err(self.fault(quantity, message, help));
        }
        Ok(value)
    }

    /// A number of a quantity within its bounds.
    fn bounded(&self, quantity: usize, bounds: &Range) -> Result<f64> {
        let value = self.number(quantity)?;
        bounds.check(value).map_err(|(message, help)| self.fault(quantity, message, help))
    }

    /// Readings below zero are judged by the mean of their hold, but for a gauge, which belongs to no hold.
    fn pressure(&self, quantity: usize) -> Result<f64> {
        let value = self.number(quantity)?;
        let bounds = pressure_bounds(quantity);
        if value > bounds.high * bounds.si {
            let better = if self.sheet.unit(quantity) == "kPa" { "Pa" } else { "kPa" };
            let name = format!("{}_{}", QUANTITIES[quantity].base, better.to_lowercase());
            let why = bounds.mistake(value);
            let [message, help] = match bounds.contains(value * 1e-3) {
                true => [format!("{why}; it looks like {better}"), format!("name the column {name}")],
                false => [why, "correct the number, or the unit in the name of the column".into()],
            };
            return Err(self.fault(quantity, message, help));
        }
        if quantity == GAUGE && value < policy::LOWEST_GAUGE_PA {
            return Err(self.too_low(quantity, value));
        }
        Ok(value)
    }

    /// The fault of a pressure below its bounds.
    pub(crate) fn too_low(&self, quantity: usize, value_pa: f64) -> DataError {
        let zero = "give gauge pressure (0 is the air of the room); subtract the sensor's zero";
        let exchanged = "; or the columns of body and actuator are exchanged";
        let help = zero.to_string() + if quantity == P_BODY { exchanged } else { "" };
        self.fault(quantity, pressure_bounds(quantity).mistake(value_pa), help)
    }
}
