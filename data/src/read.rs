//! The tidy marker table, read as a stream.
//!
//! | column | meaning |
//! |---|---|
//! | `run`, `actuator`, `marker` | labels |
//! | `t_s` | time since the start of the run; grows row by row in each (run, marker) |
//! | `p_body_kpa`, `p_act_kpa` | gauge pressures |
//! | `phase` | `load`, `hold` or `unload` |
//! | `x_mm`, `y_mm` | position, x along the undeformed body from its base, y towards the actuator; both empty or NaN where the marker was not seen |
//! | `z_mm` (optional) | third coordinate, right-handed: of robots with strips round the body |
//! | `s_mm` (optional) | station of the marker on the undeformed body |
//! | `p_act_1_kpa`, … `p_act_3_kpa` (optional) | pressures of supply channels 1 to 3; `p_act_kpa` is then the pressure of channel 0 |
//! | `p_gauge_kpa` (optional) | reading of a gauge at the actuator, where `p_act_kpa` is what was set |
//!
//! Other units by suffix: mm, cm, m; kPa, Pa, MPa, psi, bar, mbar, inH2O; s, ms, min. `y_down_mm` means −y. Extra columns are ignored.
//! Rows belong to **steady** pressures; a new hold begins when the phase changes or a pressure departs from the mean of
//! the hold by more than max(0.5 kPa, 5 %) (actuator) or max(0.2 kPa, 5 %) (body).

use std::collections::BTreeSet;
use std::fs::File;
use std::io::Read;
use std::path::Path;

use crate::about::About;
use crate::align::align;
use crate::cells::stem;
use crate::dataset::Dataset;
use crate::error::{DataError, Result};
use crate::header::{ACTUATOR, read_header};
use crate::lines::{LineReader, Progress};
use crate::policy;
use crate::ramps::check_kept;
use crate::rows::{Cells, RowReader};
use crate::streams::plausible::{check_units, check_y_up};
use crate::streams::{Recorder, Stream};
use crate::table::{Table, TableReader};

/// Actuator kinds remembered for the error message that lists them.
const MOST_KINDS: usize = 20;

/// Context of a marker table, in addition to the table.
#[derive(Debug, Clone, Copy, Default)]
pub struct ReadOptions<'a> {
    /// Its description: stations and labels are taken from it and checked against the table.
    pub about: Option<&'a About>,
    /// Read only the rows of this actuator kind.
    pub actuator: Option<&'a str>,
    /// Size of the table for the progress function \[bytes\]; 0 if unknown.
    pub bytes_total: u64,
}

impl<'a> ReadOptions<'a> {
    /// All kinds of actuators, with a description.
    pub(crate) fn of(about: Option<&'a About>) -> ReadOptions<'a> {
        ReadOptions { about, ..ReadOptions::default() }
    }
}

/// Reads the marker table at `path`; `progress(bytes_done, bytes_total)` is called about every MiB and at the end.
///
/// # Errors
/// Every fault of the file as one [`DataError`] with line, column and cell.
pub fn read_markers(path: &Path, about: Option<&About>, progress: Progress) -> Result<Dataset> {
    read_markers_of(path, ReadOptions::of(about), progress)
}

pub(crate) fn read_markers_of(path: &Path, options: ReadOptions, progress: Progress) -> Result<Dataset> {
    let shown = path.display().to_string();
    let mut file = File::open(path).map_err(|cause| {
        let help = "check the path; `ibr data list` shows the embedded sets";
        DataError::file(&shown, format!("cannot open the file: {cause}"), help)
    })?;
    let bytes_total = file.metadata().map_or(0, |metadata| metadata.len());
    parse_markers(&shown, &mut file, ReadOptions { bytes_total, ..options }, progress)
}

/// Reads a marker table from `reader`; `file` names it in errors and its stem becomes the name of the dataset.
///
/// ```
/// let csv = "run,actuator,t_s,p_body_kpa,p_act_kpa,phase,marker,x_mm,y_mm,s_mm\n\
///            1,epam,1,2,0,load,1,330,0,330\n1,epam,2,2,20,load,1,310,90,330\n";
/// let read = data::parse_markers("my.csv", &mut csv.as_bytes(), Default::default(), &mut |_, _| ()).unwrap();
/// assert_eq!((read.holds[1].p_act_pa, read.xy(0, 1, 0, 0)), (20e3, [0.31, 0.09]));
/// ```
pub fn parse_markers(file: &str, reader: &mut dyn Read, options: ReadOptions, progress: Progress) -> Result<Dataset> {
    let mut lines = LineReader::new(file, reader, options.bytes_total, progress);
    let mut reader = RowReader::new(read_header(&mut lines)?);
    let (mut kind, mut recorder) = (ActuatorFilter::default(), Recorder::of(&reader.sheet));
    kind.wanted = options.actuator.map(str::to_lowercase);
    while let Some(line) = lines.next_filled()? {
        reader.split(&line)?;
        let cells = Cells { reader: &reader, line: &line };
        if !kind.takes(cells)? {
            continue;
        }
        match cells.placeholder() {
            _ if cells.is_lost() => {
                recorder.lost_frames += 1;
                recorder.note_lost(cells);
            }
            Some(words) if !sits_at_base(cells, options.about) => {
                recorder.placeholders.note(words, 1, line.number);
                recorder.note_lost(cells);
            }
            _ => recorder.add(cells)?,
        }
    }
    if recorder.streams.is_empty() {
        let unseen = recorder.lost_frames + recorder.placeholders.rows();
        return Err(no_rows(file, &kind, unseen));
    }
    recorder.add_lost();
    recorder.placeholders.take_out_shared(&mut recorder.streams);
    let mut told = reader.told()?;
    told.extend(recorder.placeholders.told());
    check_units(&reader.sheet, &recorder.largest)?;
    check_kept(&recorder)?;
    check_about_runs(file, &recorder, options.about)?;
    let stations_m = stations(file, &recorder, options.about)?;
    let actuator = kind.found.unwrap_or_default();
    let mut dataset = align(stem(file), actuator, &recorder, &stations_m)?;
    dataset.lost.frames = recorder.lost_frames;
    dataset.told = told;
    check_kind(file, &dataset.actuator, options.about)?;
    if !dataset.is_spatial() {
        check_y_up(Some(&reader.sheet), &dataset)?;
    }
    Ok(dataset)
}

/// Reads a marker table that is at hand, as if it were the CSV file of this name: faults say the line that it would have.
///
/// # Errors
/// As [`read_markers`]; columns of different length.
pub fn markers_of_table(name: &str, table: &Table, about: Option<&About>) -> Result<Dataset> {
    let rows = table.columns.iter().map(|(_, column)| column.len()).max().unwrap_or(0);
    if let Some((label, column)) = table.columns.iter().find(|(_, column)| column.len() != rows) {
        let message = format!("column {label} has {} of {rows} rows", column.len());
        let error = DataError::of(name, message, "give every column a value in every row");
        return Err(error.in_column(label, None));
    }
    parse_markers(name, &mut TableReader::new(table), ReadOptions::of(about), &mut |_, _| ())
}

/// Markers nearer to the base than this may be seen at 0, 0 \[m\].
const AT_BASE_M: f64 = 5e-3;

/// Whether the row's marker has its station at the base.
fn sits_at_base(cells: Cells, about: Option<&About>) -> bool {
    let described = about.and_then(|about| about.marker(cells.marker())).map(|marker| marker.station_m);
    described.or(cells.station_m()).is_some_and(|s| s < AT_BASE_M)
}

/// Which actuator kind is read, and which others were seen.
#[derive(Default)]
struct ActuatorFilter {
    wanted: Option<String>,
    found: Option<String>,
    seen: BTreeSet<String>,
}

impl ActuatorFilter {
    /// Whether a row is of the kind that is read.
    fn takes(&mut self, cells: Cells) -> Result<bool> {
        let cell = cells.actuator()?;
        if self.found.as_deref().is_some_and(|found| found.eq_ignore_ascii_case(cell)) {
            return Ok(true);
        }
        let kind = cell.to_lowercase();
        if self.wanted.as_ref().is_some_and(|wanted| *wanted != kind) {
            if self.seen.len() < MOST_KINDS {
                self.seen.insert(kind);
            }
            return Ok(false);
        }
        let found = self.found.get_or_insert_with(|| kind.clone());
        if *found != kind {
            let help = format!("choose one by adding #{found} or #{kind} to the file name, or split the file");
            let message = format!("several actuators in one file: {found} and {kind}");
            return Err(cells.fault(ACTUATOR, message, help));
        }
        Ok(true)
    }
}

fn no_rows(file: &str, kind: &ActuatorFilter, lost_frames: u64) -> DataError {
    if lost_frames > 0 {
        let help = "fill in x and y where the marker was seen";
        let message = format!("none of the {lost_frames} rows has a position");
        return DataError::of(file, message, help);
    }
    let Some(chosen) = &kind.wanted else {
        let help = "add one row per run, time and marker below the header";
        return DataError::of(file, "the file has a header and no rows", help);
    };
    let seen: Vec<_> = kind.seen.iter().map(String::as_str).collect();
    let message = format!("no rows of actuator {chosen}; found {}", seen.join(", "));
    DataError::of(file, message, "choose one of the kinds found")
}

fn check_kind(file: &str, kind: &str, about: Option<&About>) -> Result<()> {
    match about.and_then(|about| about.actuator.as_deref()) {
        Some(said) if said != kind => {
            let message = format!("the table is of actuator {kind}, its about.toml names {said}");
            let help = format!("correct the actuator column or `actuator = \"{kind}\"`");
            Err(DataError::of(file, message, help))
        }
        _ => Ok(()),
    }
}

fn check_about_runs(file: &str, recorder: &Recorder, about: Option<&About>) -> Result<()> {
    let names = &recorder.runs.names;
    let described = about.into_iter().flat_map(|about| &about.runs);
    let Some(unknown) = described.map(|run| &run.id).find(|&id| !names.contains(id)) else { return Ok(()) };
    let meant = spelling::meant(unknown, names.iter().map(String::as_str));
    let help =
        format!("{meant}correct `id = \"{unknown}\"` in about.toml; a [[run]] without rows would lose its tip force");
    let message = format!("about.toml describes run {unknown}, which has no rows");
    Err(DataError::of(file, message, help))
}

/// Stations in order of `recorder.markers`, from the `s_mm` column or from `about.toml`.
fn stations(file: &str, recorder: &Recorder, about: Option<&About>) -> Result<Vec<Option<f64>>> {
    let Some(about) = about.filter(|about| !about.markers.is_empty()) else {
        let all: Option<Vec<f64>> = recorder.stations_m.iter().copied().collect();
        return match all.and_then(|all| policy::one_station(&all)) {
            Some(message) => Err(DataError::of(file, message, policy::SAME_STATION)),
            None => Ok(recorder.stations_m.clone()),
        };
    };
    let station = |(name, column_m): (&String, &Option<f64>)| {
        let Some(station_m) = about.marker(name).map(|marker| marker.station_m) else {
            return Err(unknown_marker(recorder, name, about));
        };
        if column_m.is_some_and(|s| (s - station_m).abs() > policy::ROUNDED_STATION_M) {
            let mm = station_m * 1e3;
            let message = format!("the station of marker {name} is not the one in about.toml ({mm} mm)");
            let help = "correct the s_mm column or [markers] s_mm in about.toml";
            return Err(DataError::of(file, message, help));
        }
        Ok(Some(station_m))
    };
    recorder.markers.names.iter().zip(&recorder.stations_m).map(station).collect()
}

fn unknown_marker(recorder: &Recorder, name: &str, about: &About) -> DataError {
    let known: Vec<&str> = about.markers.iter().map(|marker| marker.name.as_str()).collect();
    let is_own = |stream: &&Stream| recorder.markers.names[stream.marker] == name;
    let line = recorder.streams.iter().find(is_own).map_or(0, |stream| stream.first_line);
    let message = format!("marker {name} is not in about.toml, which names {}", known.join(", "));
    let help = "correct the label, or add it to [markers] names and s_mm";
    recorder.fault(message, help, line).in_column("marker", Some(name))
}
