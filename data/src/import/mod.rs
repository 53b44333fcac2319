//! From the files of a tracking program and a pressure log to a marker table and the beginning of its description.
//!
//! ```text
//! tracking files ─► recordings ─► + pressures by time ─► robot's frame ─► holds or bins ─► markers.csv, about.toml
//! ```
//!
//! Every kind of file is one entry of [`FORMATS`], known by its content. Anything else comes from the caller
//! ([`ImportOptions`]); it lists its assumptions, and refuses files that can be read in two ways.

mod binary;
mod board;
mod clock;
mod columns;
mod cut;
mod deeplabcut;
mod format;
mod formats;
mod frame;
mod holds;
mod homography;
mod join;
mod kinovea;
mod labels;
mod layout;
mod lens;
mod loggers;
mod motive;
mod moved;
mod options;
mod pressure;
mod qualisys;
mod recording;
mod ros;
pub(crate) mod sheet;
mod sleap;
mod table;
mod tables;
mod tracker;
mod trackmate;
mod triples;
pub mod typed;
mod vectors;

use std::path::PathBuf;

use crate::about::{About, parse_about};
use crate::agreement::{Doubt, Seen, doubts, still_inside};
use crate::dataset::Dataset;
use crate::error::{DataError, Result};
use crate::lines::Progress;
use crate::policy::tolerance_act_pa;
use crate::read::{ReadOptions, parse_markers};
use crate::units::kpa;
pub use board::read_board;
pub use columns::QUANTITIES;
use cut::{CutRuns, cut, pressed};
pub use format::Format;
pub use formats::{FORMATS, LOGS};
use frame::{CameraRuns, PlacedRuns, RestAndTop};
pub(crate) use holds::{Kept, PressedRun, median, plateaus};
use join::Joined;
pub use options::{FileAxis, FilePlace, ImportOptions, Offset, Scale};
use recording::{DROPPED, Recording, counted};

/// Tables and descriptions that an import made.
#[derive(Debug, Clone, PartialEq)]
pub struct Imported {
    /// The program that wrote the files.
    pub program: &'static str,
    /// What was understood and assumed, in words.
    pub told: Vec<String>,
    /// Text of the marker table, in the project's format.
    pub markers_csv: String,
    /// Its description, half filled, with questions as comments.
    pub about_toml: String,
    /// The marker table, read back from its text.
    pub dataset: Dataset,
    /// The description, read back from its text.
    pub about: About,
    /// The tracks over time, for a picture.
    pub tracks: Vec<RunTrack>,
}

/// Markers and holds of one run over time, for a picture.
#[derive(Debug, Clone, PartialEq)]
pub struct RunTrack {
    /// Label of the run, as in the marker table.
    pub run: String,
    /// Markers: label and (time \[s\], y \[m\]) of frames, thinned for a picture; NaN where not seen.
    pub lines: Vec<(String, Vec<[f64; 2]>)>,
    /// Begin and end \[s\] and actuator pressure \[Pa\] of every hold.
    pub holds: Vec<[f64; 3]>,
}

const MOST_HOLDS: usize = 30;
const MOST_POINTS: usize = 1_500;

/// Reads tracking files, each a run or several, joins the pressures, and makes the marker table.
///
/// # Errors
/// A file that is not understood; scale, base, axes, frame rate or pressures that are not known; clocks that disagree; no holds;
/// runs that do not fit together; a recording that contradicts itself. Every message names the option to add.
pub fn import(files: &[PathBuf], options: &ImportOptions, progress: Progress) -> Result<Imported> {
    let Some(first) = files.first().map(|file| file.display().to_string()) else {
        return Err(DataError::file("import", "no file was given", "name the tracking files"));
    };
    let (file, joined) = (first.as_str(), join::recordings(files, options, progress)?);
    let Joined { program, mut runs, mut told, logs } = joined;
    labels::number_runs(&mut runs);
    labels::same_markers(file, &mut runs)?;
    let mut runs: Vec<Recording> = runs.into_iter().map(|(_, run)| run).collect();
    told.extend(losses(&runs));
    let ends = runs.iter().map(|run| ends(file, run)).collect::<Result<Vec<_>>>()?;
    labels::rename(file, &mut runs, &ends, options, &mut told)?;
    let actuator = actuator(file, &runs, options)?;
    let scene = CameraRuns { file, runs: &runs, ends: &ends, options };
    let PlacedRuns { xy_m, markers } = scene.place(&mut told)?;
    let runs = pressed(runs, xy_m);
    let given = markers.iter().map(|name| (name.clone(), options.station_m(name))).collect();
    let seen = Seen::of_import(&runs, given, options, logs);
    if let Some(Doubt { message, help }) = doubts(&seen).into_iter().next() {
        return Err(DataError::of(file, message, help));
    }
    told.extend(still_inside(&seen));
    let cut = cut(file, runs, options, &mut told)?;
    if let Some((unknown, _)) = options.stations_m.iter().find(|(name, _)| !markers.contains(name)) {
        let message = format!("--stations names {unknown}, which is not a marker");
        let help = format!("the markers are {}", markers.join(", "));
        return Err(DataError::of(file, message, help));
    }
    let stations = table::stations(&cut, &markers, options);
    if stations.iter().any(|(.., given)| !given) {
        let shown = |(name, s, _): &(String, f64, bool)| format!("{name} {:.0} mm", s * 1e3);
        let list = stations.iter().map(shown).collect::<Vec<_>>().join(", ");
        told.push(format!("stations of markers are estimated from the robot at rest: {list} (--stations)"));
    }
    let markers_csv = table::markers_csv(&cut, &markers, &actuator, options.bin_pa.is_some());
    let name = |file: &PathBuf| file.file_name().unwrap_or(file.as_os_str()).to_string_lossy().into_owned();
    let names: Vec<String> = files.iter().map(name).collect();
    let about_toml = table::about_toml(program, &names, &stations, &actuator, &told);
    let about = parse_about("about.toml as imported", &about_toml)?;
    let read = ReadOptions::of(Some(&about));
    let dataset = parse_markers("the table made", &mut markers_csv.as_bytes(), read, &mut |_, _| ());
    let dataset = dataset.map_err(|error| unusable(file, &cut, &error))?;
    let tracks = cut.iter().map(|(run, holds)| track(run, holds, &markers)).collect();
    Ok(Imported { program, told, markers_csv, about_toml, dataset, about, tracks })
}

/// What the reader refuses in the table, with the holds of every run.
fn unusable(file: &str, cut: &CutRuns, error: &DataError) -> DataError {
    let shown = |hold: &Kept| format!("{:.0}", kpa(hold.act_pa)).replace("-0", "0");
    let of_run = |(run, kept): &(PressedRun, Vec<Kept>)| {
        let first: Vec<String> = kept.iter().take(MOST_HOLDS).map(shown).collect();
        let more = if kept.len() > MOST_HOLDS { ", …" } else { "" };
        format!("run {}: {}{more}", run.label, first.join(", "))
    };
    let runs = cut.iter().map(of_run).collect::<Vec<_>>().join("; ");
    let message = format!("{}; holds found [kPa]: {runs}", error.message());
    let more = "--hold, --frames, --settle and --bin change where holds begin and end";
    DataError::of(file, message, format!("{}; {more}", error.help()))
}

fn track(run: &PressedRun, kept: &[Kept], markers: &[String]) -> RunTrack {
    let step = run.times_s.len().div_ceil(MOST_POINTS).max(1);
    let thinned = (0..run.times_s.len()).step_by(step);
    let points = |column: &Vec<[f64; 2]>| thinned.clone().map(|k| [run.times_s[k], column[k][1]]).collect();
    let lines = markers.iter().zip(&run.xy_m).map(|(name, column)| (name.clone(), points(column)));
    let time = |frame: Option<&usize>| frame.map_or(f64::NAN, |frame| run.times_s[*frame]);
    let hold = |hold: &Kept| [time(hold.frames.first()), time(hold.frames.last()), hold.act_pa];
    let (run, holds) = (run.label.clone(), kept.iter().map(hold).collect());
    RunTrack { run, lines: lines.collect(), holds }
}

fn losses(runs: &[Recording]) -> Vec<String> {
    let count = |why: usize| runs.iter().map(|run| run.dropped[why]).sum::<u64>();
    let dropped = (0..DROPPED.len()).filter(|why| count(*why) > 0);
    let words = |why: usize| format!("lost markers: {} {}", counted(count(why), "position"), DROPPED[why]);
    dropped.map(words).collect()
}

/// Frames at the lowest and at the highest pressure.
fn ends(file: &str, run: &Recording) -> Result<RestAndTop> {
    let act = run.pressures[1].as_deref().unwrap_or_default();
    let known = || act.iter().copied().filter(|p| p.is_finite());
    let (low, high) = (known().fold(f64::INFINITY, f64::min), known().fold(f64::NEG_INFINITY, f64::max));
    if high - low <= 2.0 * tolerance_act_pa(low) {
        let [low, high] = [low, high].map(kpa);
        let message = format!("the actuator's pressure stays between {low:.1} and {high:.1} kPa in a run");
        let help = "check the column, its unit and the clock of the pressure log";
        return Err(DataError::of(file, message, help));
    }
    let is_near = |level: f64, k: &usize| (act[*k] - level).abs() <= tolerance_act_pa(level);
    let near = |level: f64| (0..act.len()).filter(|k| is_near(level, k)).collect();
    Ok(RestAndTop { rest: near(low), top: near(high) })
}

fn actuator(file: &str, runs: &[Recording], options: &ImportOptions) -> Result<String> {
    let given = options.actuator.as_ref().map(|kind| kind.to_lowercase());
    let known = given.or_else(|| runs.iter().find_map(|run| run.actuator.clone()));
    let help = "add --actuator epam, or the kind that your scenario has";
    known.ok_or_else(|| DataError::of(file, "the kind of the actuator is not known", help))
}
