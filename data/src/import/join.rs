//! Tracking files and pressure logs as recordings with times in seconds and pressures in place.

use std::io::Read;
use std::path::{Path, PathBuf};

use super::columns::Roles;
use super::options::ImportOptions;
use super::pressure::Log;
use super::recording::{Recording, counted};
use super::sheet::CellText;
use super::{binary, formats, labels, loggers, tables};
use crate::agreement::{Doubt, LogSeen, stands_still};
use crate::cells::stem;
use crate::error::{DataError, Result};
use crate::lines::Progress;
use crate::policy::is_a_room;
use crate::units::kpa;
use spelling::files::{MOST_DATA, read_whole};
use spelling::units::Range;

/// Text of a file; binary files are refused by their first bytes, with the export to use.
pub(crate) fn text_of(path: &Path) -> Result<String> {
    let shown = path.display().to_string();
    let unread = |cause: std::io::Error| {
        let message = format!("cannot open the file: {cause}");
        DataError::file(&shown, message, "check the path")
    };
    // A large binary file is refused before it is read. A pipe can be read only once.
    let mut head = Vec::new();
    if path.is_file() {
        let file = std::fs::File::open(path).map_err(unread)?;
        file.take(binary::HEAD as u64).read_to_end(&mut head).map_err(unread)?;
    }
    binary::refuse(&shown, &head)?;
    let bytes = read_whole(path, MOST_DATA).map_err(unread)?;
    if let [0xff, 0xfe, rest @ ..] = &bytes[..] {
        let units = rest.chunks_exact(2).map(|pair| u16::from_le_bytes([pair[0], pair[1]]));
        return Ok(String::from_utf16_lossy(&units.collect::<Vec<u16>>()));
    }
    // Names with accents in an old encoding; a file that is not a text has zero bytes, and is refused for them.
    let latin = |bytes: Vec<u8>| bytes.into_iter().map(char::from).collect();
    Ok(String::from_utf8(bytes).unwrap_or_else(|error| latin(error.into_bytes())))
}

#[derive(Default)]
pub(crate) struct Joined {
    /// The program that wrote the files.
    pub program: &'static str,
    /// Every run with its file, times in seconds and pressures in place.
    pub runs: Vec<(String, Recording)>,
    pub told: Vec<String>,
    pub logs: Vec<LogSeen>,
}

pub(crate) fn recordings(files: &[PathBuf], options: &ImportOptions, progress: Progress) -> Result<Joined> {
    for (k, (quantity, column)) in options.columns.iter().enumerate() {
        let is_other = |(what, other): &&(String, String)| other.eq_ignore_ascii_case(column) && what != quantity;
        if let Some((other, _)) = options.columns[..k].iter().find(is_other) {
            let message = format!("--map gives column {column} to {other} and to {quantity}");
            let file = files.first().map_or(String::new(), |file| file.display().to_string());
            return Err(DataError::of(&file, message, "name another column for one of them"));
        }
    }
    let mut absent: Vec<&(String, String)> = options.columns.iter().collect();
    let mut joined = Joined::default();
    let logs = logs(files.len(), options, &mut joined.told, &mut absent)?;
    for (k, path) in files.iter().enumerate() {
        let shown = path.display().to_string();
        if files[..k].contains(path) {
            let help = "name every file once: each is a separate run";
            return Err(DataError::file(&shown, "the file is named twice", help));
        }
        progress(k as u64, files.len() as u64);
        let text = text_of(path)?;
        let sheet = CellText::new(&shown, &text)?;
        drop_named(&mut absent, &sheet.head(1).pop().unwrap_or_default());
        let added = joined.add(&sheet, logs.get(k).or(logs.last()), options);
        // A name that is not in the last file either may be why it was not understood.
        let is_told = added.is_err() || k + 1 == files.len();
        if let Some((quantity, column)) = absent.first().filter(|_| is_told) {
            let message = format!("--map reads {quantity} from column {column}, and no file has this column");
            return Err(sheet.fault(0, message, "write the name as in the file's first line"));
        }
        added?;
    }
    joined.merge();
    let mut stamped = joined.runs.iter_mut().map(|(_, run)| run).filter(|run| run.is_stamped()).peekable();
    let since = stamped.peek().map(|run| run.times[0]);
    stamped.for_each(Recording::zeroed);
    if let Some(t) = since {
        joined.tell(format!("times are seconds since 1970; the first frame of a run is at 0 s, here at {t:.3}"));
    }
    let frames: usize = joined.runs.iter().map(|(_, run)| run.times.len()).sum();
    let (runs, frames) = (counted(joined.runs.len() as u64, "run"), counted(frames as u64, "frame"));
    joined.logs = logs.into_iter().map(Log::seen).collect();
    joined.told.insert(0, format!("read as {}: {runs}, {frames}", joined.program));
    Ok(joined)
}

impl Joined {
    /// Files of one marker without a name each, whose stamps overlap, are one run.
    fn merge(&mut self) {
        let alone = |run: &Recording| run.markers == [""] && run.is_stamped();
        let within = |run: &Recording, of: &Recording| {
            run.times.first() <= of.times.last() && of.times.first() <= run.times.last()
        };
        let one = |a: &Recording, b: &Recording| alone(a) && alone(b) && within(a, b);
        let mut groups: Vec<Vec<(String, Recording)>> = Vec::new();
        for run in std::mem::take(&mut self.runs) {
            match groups.iter_mut().find(|group| one(&run.1, &group[0].1)) {
                Some(group) => group.push(run),
                None => groups.push(vec![run]),
            }
        }
        for mut group in groups {
            let stems: Vec<String> = group.iter().map(|(file, _)| stem(file)).collect();
            let (file, mut first) = group.remove(0);
            if alone(&first) {
                group.iter().for_each(|(_, run)| first.beside(run));
                first.markers = labels::distinct(&stems);
            }
            self.runs.push((file, first));
        }
    }

    fn add(&mut self, sheet: &CellText, log: Option<&Log>, options: &ImportOptions) -> Result<()> {
        let format = formats::recognised(sheet, options)?;
        if !self.program.is_empty() && self.program != format.name {
            let (own, others) = (format.name, self.program);
            let message = format!("this file is of {own}, the others are of {others}");
            return Err(sheet.fault(0, message, "import files of one program at a time"));
        }
        self.program = format.name;
        let found = (format.read)(sheet, options)?;
        if found.is_empty() {
            let help = "export it again";
            return Err(sheet.fault(0, "the file has names of columns and no rows", help));
        }
        for mut run in found {
            check_run(sheet, &run)?;
            let mut words = vec![seconds(sheet, &mut run, options)?];
            words.append(&mut run.told);
            // Before the clocks: a frozen picture looks like another clock.
            if let Some(Doubt { message, help }) = stands_still(&run.times, &run.places) {
                return Err(sheet.fault(0, message, help));
            }
            if options.likelihood.is_some() && format.likelihood.is_none() {
                words.push(tables::NOT_USED.to_string());
            }
            words.extend(pressures(sheet, &mut run, log, options)?);
            words.into_iter().for_each(|word| self.tell(word));
            self.runs.push((sheet.file.to_string(), run));
        }
        Ok(())
    }

    fn tell(&mut self, word: String) {
        if !self.told.contains(&word) {
            self.told.push(word);
        }
    }
}

fn check_run(sheet: &CellText, run: &Recording) -> Result<()> {
    if let Some((marker, time)) = &run.twice {
        let message = format!("marker {marker} has two places at {time} of one run");
        let help = "give every run its own file, or add a column run";
        return Err(sheet.fault(0, message, help));
    }
    for time in &run.times {
        Range::TIME.check(time.abs()).map_err(|(message, help)| sheet.fault(0, message, help))?;
    }
    if run.times.len() < 2 || run.places.iter().flatten().all(|place| place[0].is_nan()) {
        let help = "check the export, or lower --likelihood";
        return Err(sheet.fault(0, "hardly any marker was seen in this run", help));
    }
    Ok(())
}

/// Takes the columns that a file has off those that the caller named.
fn drop_named(absent: &mut Vec<&(String, String)>, names: &[&str]) {
    absent.retain(|(_, column)| !names.iter().any(|name| name.eq_ignore_ascii_case(column)));
}

fn logs(
    files: usize,
    options: &ImportOptions,
    told: &mut Vec<String>,
    absent: &mut Vec<&(String, String)>,
) -> Result<Vec<Log>> {
    let count = options.pressure_logs.len();
    if count > 1 && count != files {
        let file = options.pressure_logs[0].display().to_string();
        let message = format!("{count} pressure logs for {files} tracking files");
        let help = "give one log for all runs, or one for every file in the same order";
        return Err(DataError::of(&file, message, help));
    }
    let mut logs = Vec::new();
    for path in &options.pressure_logs {
        let shown = path.display().to_string();
        let plain = loggers::plain(&shown, text_of(path)?)?;
        let sheet = CellText::new(&shown, &plain.text)?;
        let log = Log::read(&sheet, &plain, options)?;
        drop_named(absent, &log.names.iter().map(String::as_str).collect::<Vec<_>>());
        told.extend(log.told.iter().map(|word| format!("pressure log: {word}")));
        logs.push(log);
    }
    Ok(logs)
}

fn seconds(sheet: &CellText, run: &mut Recording, options: &ImportOptions) -> Result<String> {
    match (run.in_seconds, options.frames_per_s) {
        (false, None) => {
            let message = "the file counts frames and does not say how many there are in a second";
            let help = "add --fps with the camera's frames per second, for example --fps 30";
            Err(sheet.fault(0, message, help))
        }
        (false, Some(fps)) => {
            given(sheet, "--fps", &Range::FRAME_RATE, fps)?;
            run.times.iter_mut().for_each(|t| *t /= fps);
            Ok(format!("frame 0 is at 0 s, {fps} frames are a second, as given"))
        }
        (true, None) => Ok("times are seconds".to_string()),
        (true, Some(_)) => Ok("times are seconds: --fps was not used".to_string()),
    }
}

/// Refuses a number of an option that is out of its bounds.
fn given(sheet: &CellText, option: &str, bounds: &Range, value: f64) -> Result<()> {
    let refused = |(message, help)| sheet.fault(0, format!("{option}: {message}"), help);
    bounds.check(value).map(|_| ()).map_err(refused)
}

/// Puts every pressure in place: of the file, of the log, or as given.
fn pressures(sheet: &CellText, run: &mut Recording, log: Option<&Log>, options: &ImportOptions) -> Result<Vec<String>> {
    let mut told = Vec::new();
    if let Some(log) = log {
        if run.pressures.iter().any(Option::is_some) {
            told.push("pressures are read from the log, not from the tracking file".to_string());
        }
        told.extend(log.join(sheet.file, run, options)?);
    }
    let own = || Roles::maybe_pressures(sheet, options).unwrap_or_default();
    let [body, act] = &mut run.pressures;
    if act.is_none() {
        let help = "add --pressure log.csv, a table of time and pressure: time_s,p_act_kpa,p_body_kpa";
        return Err(sheet.fault(0, "the actuator's pressure is not known", format!("{help}{}", own())));
    }
    match options.body_pa {
        Some(body_pa) => {
            given(sheet, "--body-pressure", &Range::BODY_PRESSURE, body_pa)?;
            if body.replace(vec![body_pa; run.times.len()]).is_some() {
                let message = "the body's pressure is given, and the files have it too";
                return Err(sheet.fault(0, message, "leave --body-pressure out"));
            }
            told.push(format!("the body was kept at {} kPa, as given", kpa(body_pa)));
        }
        None if body.is_none() => {
            let help = "add --body-pressure 2kPa, or a column p_body_kpa in the pressure log";
            return Err(sheet.fault(0, "the body's pressure is not known", format!("{help}{}", own())));
        }
        None => {}
    }
    let room_pa = options.room_pa.unwrap_or(0.0);
    let lowest_pa = run.pressures.each_ref().map(|column| {
        let known = column.iter().flatten().copied().filter(|p| p.is_finite());
        known.fold(f64::INFINITY, f64::min) - room_pa
    });
    if options.room_pa.is_none() && lowest_pa.iter().all(|lowest_pa| is_a_room(*lowest_pa)) {
        let lowest = kpa(lowest_pa[1]);
        let message =
            format!("pressures are never below {lowest:.1} kPa: they look absolute, or the robot was never vented");
        let help = "take the room's off with --room 101.3kPa; if they are gauge pressures, say --room 0kPa";
        return Err(sheet.fault(0, message, help));
    }
    if room_pa != 0.0 {
        let room = kpa(room_pa);
        told.push(format!("the room's {room} kPa are subtracted from all pressures, as given"));
        run.pressures.iter_mut().flatten().flatten().for_each(|p| *p -= room_pa);
    }
    Ok(told)
}
