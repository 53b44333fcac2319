//! Tracking files and pressure logs as recordings with times in seconds and pressures in place.

use std::path::{Path, PathBuf};

use super::counted;
use super::formats;
use super::options::Options;
use super::pressure::Log;
use super::recording::{Clock, Recording};
use super::sheet::Sheet;
use crate::error::{DataError, Fault};
use crate::read::ABSOLUTE_PA;
use crate::units::kpa;

/// A file's text.
///
/// # Errors
/// It cannot be read, or is no text.
pub(crate) fn text_of(path: &Path) -> Result<String, DataError> {
    let shown = path.display().to_string();
    let bytes = std::fs::read(path).map_err(|cause| {
        DataError::File(Box::new(Fault::of_file(&shown, format!("cannot open the file: {cause}"), "check the path")))
    })?;
    if let [0xff, 0xfe, rest @ ..] = &bytes[..] {
        let units: Vec<u16> = rest.chunks_exact(2).map(|pair| u16::from_le_bytes([pair[0], pair[1]])).collect();
        return Ok(String::from_utf16_lossy(&units));
    }
    String::from_utf8(bytes).or_else(|error| {
        // A workbook or a picture has zero bytes; names with accents in an old encoding have not.
        let bytes = error.into_bytes();
        if bytes.contains(&0) {
            let help = "export the tracks as text: CSV, TXT or XML";
            return Err(DataError::Layout(Box::new(Fault::of_file(&shown, "the file is no text", help))));
        }
        Ok(bytes.iter().map(|byte| char::from(*byte)).collect())
    })
}

/// Recordings of all files, with their file, times in seconds and pressures in place.
pub(crate) fn recordings(
    files: &[PathBuf],
    options: &Options,
    told: &mut Vec<String>,
    progress: &mut dyn FnMut(u64, u64),
) -> Result<(&'static str, Vec<(String, Recording)>), DataError> {
    let logs = logs(files.len(), options, told)?;
    let mut program: Option<&'static str> = None;
    let mut runs = Vec::new();
    for (k, path) in files.iter().enumerate() {
        progress(k as u64, files.len() as u64);
        let (shown, text) = (path.display().to_string(), text_of(path)?);
        let sheet = Sheet::new(&shown, &text)?;
        let format = formats::recognised(&sheet, options)?;
        if program.is_some_and(|known| known != format.name) {
            let message = format!("this file is of {}, the others are of {}", format.name, program.unwrap_or_default());
            return Err(sheet.fault(0, message, "import files of one program at a time"));
        }
        let found = (format.read)(&sheet, options)?;
        let first = program.replace(format.name).is_none();
        for mut run in found {
            if run.times.len() < 2 || run.places.iter().flatten().all(|place| place[0].is_nan()) {
                return Err(sheet.fault(
                    0,
                    "hardly any marker was seen in this run",
                    "check the export, or lower --likelihood",
                ));
            }
            seconds(&sheet, &mut run, options, first.then_some(&mut *told))?;
            let words = pressures(&sheet, &mut run, logs.get(k.min(logs.len().saturating_sub(1))), options)?;
            let own = std::mem::take(&mut run.told);
            own.into_iter()
                .chain(words)
                .filter(|word| !told.contains(word))
                .collect::<Vec<_>>()
                .into_iter()
                .for_each(|word| told.push(word));
            runs.push((shown.clone(), run));
        }
    }
    let program = program.unwrap_or_default();
    let frames: usize = runs.iter().map(|(_, run)| run.times.len()).sum();
    let counts = [counted(runs.len() as u64, "run"), counted(frames as u64, "frame")];
    told.insert(0, format!("written by {program}: {}", counts.join(", ")));
    Ok((program, runs))
}

fn logs(files: usize, options: &Options, told: &mut Vec<String>) -> Result<Vec<Log>, DataError> {
    let count = options.pressure_logs.len();
    if count > 1 && count != files {
        let message = format!("{count} pressure logs for {files} tracking files");
        let fault = Fault::of_file(
            &options.pressure_logs[0].display().to_string(),
            message,
            "give one log for all runs, or one for every file in the same order",
        );
        return Err(DataError::Runs(Box::new(fault)));
    }
    let mut logs = Vec::new();
    for path in &options.pressure_logs {
        let (shown, text) = (path.display().to_string(), text_of(path)?);
        let log = Log::read(&Sheet::new(&shown, &text)?, options)?;
        told.extend(log.told.iter().map(|word| format!("pressure log: {word}")));
        logs.push(log);
    }
    Ok(logs)
}

/// Frames become seconds.
fn seconds(
    sheet: &Sheet,
    run: &mut Recording,
    options: &Options,
    told: Option<&mut Vec<String>>,
) -> Result<(), DataError> {
    match (run.clock, options.frames_per_s) {
        (Clock::Frames, None) => Err(sheet.fault(
            0,
            "the file counts frames and does not say how many there are in a second",
            "add --fps with the camera's frames per second, for example --fps 30",
        )),
        (Clock::Frames, Some(fps)) => {
            run.times.iter_mut().for_each(|t| *t /= fps);
            told.into_iter()
                .for_each(|told| told.push(format!("frame 0 is at 0 s, {fps} frames are a second, as given")));
            Ok(())
        }
        (Clock::Seconds, given) => {
            let step = (run.times[run.times.len() - 1] - run.times[0]) / (run.times.len() - 1) as f64;
            let text = format!("times are seconds, {:.3} s apart in the mean", step);
            told.into_iter().for_each(|told| {
                told.push(if given.is_some() { format!("{text}; --fps was not needed") } else { text.clone() })
            });
            Ok(())
        }
    }
}

/// Puts every pressure in place: of the file, of the log, or as given.
fn pressures(
    sheet: &Sheet,
    run: &mut Recording,
    log: Option<&Log>,
    options: &Options,
) -> Result<Vec<String>, DataError> {
    let mut told = match log {
        Some(log) => log.join(run, options)?,
        None => Vec::new(),
    };
    if run.pressures[1].is_none() {
        let help = "add --pressure log.csv, a table of time and pressure: time_s,p_act_kpa,p_body_kpa";
        return Err(sheet.fault(0, "the actuator's pressure is not known", help));
    }
    if let Some(body_pa) = options.body_pa {
        if run.pressures[0].is_some() {
            return Err(sheet.fault(
                0,
                "the body's pressure is given, and the files have it too",
                "leave --body-pressure out",
            ));
        }
        told.push(format!("the body was kept at {} kPa, as given", kpa(body_pa)));
        run.pressures[0] = Some(vec![body_pa; run.times.len()]);
    }
    if run.pressures[0].is_none() {
        return Err(sheet.fault(
            0,
            "the body's pressure is not known",
            "add --body-pressure 2kPa, or a column p_body_kpa in the pressure log",
        ));
    }
    let room_pa = options.room_pa.unwrap_or(0.0);
    let lowest = |which: usize| {
        run.pressures[which].iter().flatten().copied().filter(|p| p.is_finite()).fold(f64::INFINITY, f64::min) - room_pa
    };
    if options.room_pa.is_none() && [0, 1].iter().all(|which| ABSOLUTE_PA.contains(&lowest(*which))) {
        let message = format!(
            "pressures are never below {:.1} kPa: they look absolute, or the robot was never vented",
            kpa(lowest(1))
        );
        return Err(sheet.fault(
            0,
            message,
            "take the room's off with --room 101.3kPa; if they are gauge pressures, say --room 0kPa",
        ));
    }
    if room_pa != 0.0 {
        told.push(format!("{} kPa of the room are taken off all pressures, as given", kpa(room_pa)));
        run.pressures.iter_mut().flatten().flatten().for_each(|p| *p -= room_pa);
    }
    Ok(told)
}
