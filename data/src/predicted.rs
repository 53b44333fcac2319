//! Predictions of another simulator at the holds and markers of a dataset, as a table.
//!
//! | column | meaning |
//! |---|---|
//! | `marker`, `x_mm`, `y_mm`, `z_mm` (of data in space) | as in a marker table, in any of its units |
//! | `p_body_kpa`, `p_act_kpa`, `p_act_1_kpa`, … | pressures of the hold; `p_body_kpa` only where the data have several |
//! | `t_s` | time since the start of a run: in place of pressures, or to separate equal holds |
//! | `phase`, `run`, and other columns of a marker table | optional |
//!
//! A row belongs to the hold with its pressures, and to all such holds where neither phase nor time separates them. Several rows of one
//! hold and marker, of several runs or times, are averaged.

use std::collections::HashMap;

use crate::columns::{Field, Head, TableRow, TableSheet, field, plain};
use crate::dataset::{Dataset, Hold};
use crate::error::{DataError, Result};
use crate::header::RowPressures;
use crate::lines::LineReader;
use crate::policy;
use crate::streams::are_near;
use crate::units::{MeasuredQuantity, kpa};

const MARKER: usize = 0;
const PLACE: [usize; 3] = [1, 2, 3];
/// Body, actuator, and the supply channels from 1 on.
const PRESSURES: [usize; 5] = [4, 5, 6, 7, 8];
const TIME: usize = 9;
const PHASE: usize = 10;
const RUN: usize = 11;

const FIELDS: [Field; 12] = [
    plain("marker", true),
    field("x", "x_mm", MeasuredQuantity::Length, true),
    field("y", "y_mm", MeasuredQuantity::Length, true),
    field("z", "z_mm", MeasuredQuantity::Length, false),
    field("p_body", "p_body_kpa", MeasuredQuantity::Pressure, false),
    field("p_act", "p_act_kpa", MeasuredQuantity::Pressure, false),
    field("p_act_1", "p_act_1_kpa", MeasuredQuantity::Pressure, false),
    field("p_act_2", "p_act_2_kpa", MeasuredQuantity::Pressure, false),
    field("p_act_3", "p_act_3_kpa", MeasuredQuantity::Pressure, false),
    field("t", "t_s", MeasuredQuantity::Time, false),
    plain("phase", false),
    plain("run", false),
];

/// Predictions of another simulator for every hold and marker of a dataset.
#[derive(Debug, Clone, PartialEq)]
pub struct Predictions {
    /// File, for messages.
    pub file: String,
    /// Places, laid out `[hold][marker][axis]` \[m\]; what too few runs saw may be 0.
    pub places_m: Vec<f64>,
    /// Line of the first row of every `[hold][marker]`; 0 without one.
    lines: Vec<u64>,
}

impl Predictions {
    /// A fault of the prediction of a marker in a hold, at its line.
    pub fn fault(&self, cell: usize, message: impl Into<String>, help: impl Into<String>) -> DataError {
        DataError::of(&self.file, message, help).at_line(self.lines.get(cell).copied().unwrap_or(0))
    }
}

/// Reads the table of predictions for a dataset.
///
/// # Errors
/// A column that is missing, a row that belongs to no hold or marker of the data, two predictions of one place, a hold or marker without
/// a prediction: with file, line and remedy.
pub fn parse_predictions(file: &str, text: &str, dataset: &Dataset) -> Result<Predictions> {
    let mut lines = LineReader::of_text(file, text);
    let (_, Some(head)) = Head::read(&mut lines)? else {
        let help = "write columns such as p_act_kpa,marker,x_mm,y_mm";
        return Err(DataError::of(file, "the file is empty", help));
    };
    head.without_unit(&FIELDS, |at| Some(FIELDS[at].needed))?;
    let sheet = head.sheet(&FIELDS)?;
    let sheet = TableSheet { comma: sheet.head.delimiter != ',', ..sheet };
    if let Some([message, help]) = lacks(&sheet, dataset) {
        return Err(sheet.head.line.line().fault(message, help));
    }
    let mut found = Collected::new(dataset, &sheet);
    sheet.each_row(&mut lines, |row| found.take(row))?;
    found.complete(file)
}

/// A column that the data ask for and the table has not, and what to add.
fn lacks(sheet: &TableSheet, dataset: &Dataset) -> Option<[String; 2]> {
    let missing = |field: usize, why: &str| {
        let name = FIELDS[field].expected;
        Some([format!("column {name} is missing{why}"), format!("add {name} with a value in every row")])
    };
    let z = Some(PLACE[2]).filter(|z| dataset.has_z() && !sheet.has(*z));
    if let Some(field) = sheet.missing().or(z) {
        return missing(field, "");
    }
    if !sheet.has(PRESSURES[1]) {
        let hold = || missing(PRESSURES[1], ", and so is t_s: a row has no hold");
        return if sheet.has(TIME) { None } else { hold() };
    }
    let more = &PRESSURES[2..2 + dataset.more_channels()];
    if let Some(field) = more.iter().find(|field| dataset.channels_differ() && !sheet.has(**field)) {
        return missing(*field, ": the data have pressures of this supply channel");
    }
    let first = dataset.holds.first().map_or(0.0, |hold| hold.p_body_pa);
    let is_other = |hold: &Hold| (hold.p_body_pa - first).abs() > policy::tolerance_body_pa(first);
    if dataset.holds.iter().any(is_other) && !sheet.has(PRESSURES[0]) {
        return missing(PRESSURES[0], ": the data have several body pressures");
    }
    None
}

/// Sum over the rows of a hold and marker, their count, and the line of the first.
#[derive(Debug, Clone, Copy, Default)]
struct Sum {
    place_m: [f64; 3],
    count: u32,
    line: u64,
}

/// What was read so far.
struct Collected<'d> {
    dataset: &'d Dataset,
    pressed: bool,
    /// `[hold][marker]`
    sums: Vec<Sum>,
    /// Place and line of every label of a row: run, time, pressures, phase, marker.
    seen: HashMap<Vec<String>, ([f64; 3], u64)>,
    last_line: u64,
}

impl<'d> Collected<'d> {
    fn new(dataset: &'d Dataset, sheet: &TableSheet) -> Collected<'d> {
        let sums = vec![Sum::default(); dataset.holds.len() * dataset.markers.len()];
        let pressed = sheet.has(PRESSURES[1]);
        Collected { dataset, pressed, sums, seen: HashMap::new(), last_line: 0 }
    }

    fn take(&mut self, row: &TableRow) -> Result<()> {
        let dataset = self.dataset;
        self.last_line = row.line.number;
        let name = crate::cells::label(row.text(MARKER));
        let names = dataset.markers.iter().map(|marker| marker.name.as_str());
        let Some(marker) = names.clone().position(|known| known == name) else {
            let meant = spelling::meant(name, names.clone());
            let help = format!("{meant}its markers are {}", names.collect::<Vec<_>>().join(", "));
            let message = format!("marker \"{name}\" is not in {}", dataset.name);
            return Err(row.fault(MARKER, message, help));
        };
        let mut place = [0.0; 3];
        for (axis, field) in PLACE.into_iter().take(dataset.axes).enumerate() {
            let value = row.number(field)?.unwrap_or(0.0);
            if value.abs() > policy::FARTHEST_M {
                let message = format!("\"{}\" is farther than any robot reaches", row.text(field));
                let help = "correct the unit in the name of the column: x_mm, x_cm or x_m";
                return Err(row.fault(field, message, help));
            }
            place[axis] = value;
        }
        let labels = [RUN, TIME, PHASE, MARKER].into_iter().chain(PRESSURES);
        let labels: Vec<String> = labels.map(|field| row.text(field).to_string()).collect();
        let before = self.seen.insert(labels, (place, row.line.number));
        if let Some((_, line)) = before.filter(|(before, _)| *before != place) {
            let message = format!("marker {name} has another prediction for the same hold in line {line}");
            return Err(row.line.fault(message, "keep one of the two rows"));
        }
        for hold in self.holds(row)? {
            let sum = &mut self.sums[hold * dataset.markers.len() + marker];
            if sum.count == 0 {
                sum.line = row.line.number;
            }
            sum.count += 1;
            (0..3).for_each(|axis| sum.place_m[axis] += place[axis]);
        }
        Ok(())
    }

    /// The holds to which a row belongs.
    fn holds(&self, row: &TableRow) -> Result<Vec<usize>> {
        let holds = &self.dataset.holds;
        let time = if row.text(TIME).is_empty() { None } else { row.number(TIME)? };
        let mut found: Vec<usize> = (0..holds.len()).collect();
        if self.pressed {
            let mut given: [Option<f64>; PRESSURES.len()] = [None; PRESSURES.len()];
            for (value, field) in given.iter_mut().zip(PRESSURES) {
                *value = row.number(field)?;
            }
            let is_near = |hold: &Hold| are_near(hold.pressures_pa(), filled(hold, given), 1.0);
            found.retain(|hold| is_near(&holds[*hold]));
            let gap = |hold: &usize| (holds[*hold].p_act_pa - given[1].unwrap_or(0.0)).abs();
            let least = found.iter().map(gap).fold(f64::INFINITY, f64::min);
            found.retain(|hold| gap(hold) <= least + policy::SAME_ACTUATOR_PA);
        } else if let Some(t_s) = time {
            let reach_s = reach_s(holds);
            found.retain(|hold| away_s(&holds[*hold], t_s) <= reach_s);
        }
        let phase = row.text(PHASE);
        if !phase.is_empty() {
            found.retain(|hold| holds[*hold].phase.word().eq_ignore_ascii_case(phase));
        }
        if let Some(t_s) = time.filter(|_| found.len() > 1) {
            let least = found.iter().map(|hold| away_s(&holds[*hold], t_s)).fold(f64::INFINITY, f64::min);
            found.retain(|hold| away_s(&holds[*hold], t_s) <= least);
        }
        if found.is_empty() {
            let field = if self.pressed { PRESSURES[1] } else { TIME };
            let message = format!("{} has no hold of this row", self.dataset.name);
            let listed = holds.iter().map(words).collect::<Vec<_>>().join("; ");
            let help = format!("its holds are {listed}; predict at their pressures, or delete the row");
            return Err(row.fault(field, message, help));
        }
        Ok(found)
    }

    fn complete(self, file: &str) -> Result<Predictions> {
        let Dataset { markers, holds, axes, .. } = self.dataset;
        let count = markers.len();
        let is_seen = |cell: usize| self.dataset.is_seen(cell / count, cell % count);
        let is_missing = |cell: &usize| self.sums[*cell].count == 0 && is_seen(*cell);
        if let Some(cell) = (0..self.sums.len()).find(is_missing) {
            let (hold, marker) = (cell / count, &markers[cell % count].name);
            let own = self.sums[hold * count..(hold + 1) * count].iter().map(|sum| sum.line);
            let (line, at) = (own.filter(|line| *line > 0).min(), words(&holds[hold]));
            let message = match line {
                Some(_) => format!("marker {marker} has no prediction at {at}"),
                None => format!("no row has the pressures of the hold at {at}"),
            };
            let error = DataError::of(file, message, "add a row for every marker at this pressure");
            return Err(error.at_line(line.unwrap_or(self.last_line)));
        }
        let mean = |sum: &Sum| sum.place_m.map(|total| total / f64::from(sum.count.max(1)));
        let places_m = self.sums.iter().flat_map(|sum| mean(sum).into_iter().take(*axes)).collect();
        let lines = self.sums.iter().map(|sum| sum.line).collect();
        Ok(Predictions { file: file.to_string(), places_m, lines })
    }
}

/// The pressures of a row; those that it has not, or the data have not, are the pressures of the hold.
fn filled(hold: &Hold, given: [Option<f64>; PRESSURES.len()]) -> RowPressures {
    let own = hold.pressures_pa();
    let known = 2 + hold.more_act_pa.len();
    std::array::from_fn(|k| given[k].filter(|_| k < known).unwrap_or(own[k]))
}

/// How far a time is from the samples of a hold \[s\].
fn away_s(hold: &Hold, t_s: f64) -> f64 {
    let [first, last] = [hold.t_s.first(), hold.t_s.last()].map(|t| t.copied().unwrap_or(0.0));
    (first - t_s).max(t_s - last).max(0.0)
}

/// How far a time may be from the samples of its hold: half of the shortest way from one hold to the next \[s\].
fn reach_s(holds: &[Hold]) -> f64 {
    let starts = holds.windows(2).map(|pair| (pair[1].t_s[0] - pair[0].t_s[0]).abs());
    0.5 * starts.fold(f64::INFINITY, f64::min)
}

fn words(hold: &Hold) -> String {
    let act: Vec<String> = hold.channels_pa().map(|pa| format!("{:.1}", kpa(pa))).collect();
    let (act, body, phase) = (act.join("/"), kpa(hold.p_body_pa), hold.phase.word());
    format!("{act} kPa actuator, {body:.1} kPa body ({phase})")
}
