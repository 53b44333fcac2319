//! Pressure logs: read, and joined to frames by time (as-of: the last reading counts until the next).

use super::clock::{Agreed, Clock, Readings, agree};
use super::columns::Roles;
use super::options::ImportOptions;
use super::recording::{FrameClock, Recording, counted};
use super::sheet::CellText;
use crate::agreement::LogSeen;
use crate::error::{DataError, Result};
use crate::policy::{HIGHEST_GAUGE_PA, ROOM_PA};
use spelling::units::Range;

#[derive(Debug, Clone)]
pub(crate) struct Log {
    file: String,
    times_s: Vec<f64>,
    /// Body's and actuator's pressure \[Pa\].
    values_pa: [Option<Vec<f64>>; 2],
    pub told: Vec<String>,
}

/// Two readings of one time are one if nearer than this \[s\].
const SAME_TIME_S: f64 = 1e-6;

impl Log {
    /// Reads a log.
    ///
    /// # Errors
    /// No column of time or pressure; a cell without a number; times that go back.
    pub(super) fn read(sheet: &CellText, options: &ImportOptions) -> Result<Log> {
        let mut lines = sheet.lines().filter(|(_, line)| !line.starts_with('#'));
        let Some((first, header)) = lines.next() else {
            return Err(sheet.fault(0, "the pressure log is empty", "export it again"));
        };
        let roles = Roles::of(sheet, first, &sheet.split(header), options)?;
        let (time, second) = Log::columns(sheet, first, &roles)?;
        let values_pa = roles.pressures.map(|column| column.map(|_| Vec::new()));
        let mut log = Log { file: sheet.file.to_string(), times_s: Vec::new(), values_pa, told: roles.told.clone() };
        let mut cells = Vec::new();
        for (number, line) in lines {
            sheet.split_into(line, &mut cells);
            let cell = |index: usize| cells.get(index).copied().unwrap_or_default();
            let t_s = second * sheet.time(cell(time), number, "time")?;
            if log.times_s.last().is_some_and(|last| t_s < *last) {
                return Err(sheet.fault(
                    number,
                    "the time of the pressure log goes back",
                    "sort its rows, or give one log per run",
                ));
            }
            log.times_s.push(t_s);
            for (column, values) in roles.pressures.iter().zip(&mut log.values_pa) {
                if let (Some((index, pa)), Some(values)) = (column, values) {
                    let pressure_pa = pa * sheet.expect(cell(*index), number, "pressure")?;
                    // Absolute pressures include the room's.
                    if pressure_pa.abs() > HIGHEST_GAUGE_PA + ROOM_PA[1] {
                        let told = Range::ACTUATOR_PRESSURE.check(pressure_pa.abs()).err();
                        let message = told.map_or(String::new(), |(message, _)| message);
                        return Err(sheet.fault(number, message, "check the reading and the unit of the column"));
                    }
                    values.push(pressure_pa);
                }
            }
        }
        if log.times_s.is_empty() {
            return Err(sheet.fault(0, "the pressure log has no rows", "export it again"));
        }
        Ok(log)
    }

    /// Its readings of the actuator.
    pub(super) fn seen(self) -> LogSeen {
        let [_, act] = self.values_pa;
        LogSeen { file: self.file, act_pa: act.unwrap_or_else(|| vec![0.0; self.times_s.len()]), times_s: self.times_s }
    }

    fn longest_gap_s(&self) -> f64 {
        self.times_s.windows(2).map(|pair| pair[1] - pair[0]).fold(0.0, f64::max)
    }

    /// Puts the log's pressures into the frames of a recording (times in seconds); on a ramp readings are joined by lines.
    ///
    /// # Errors
    /// The clocks disagree; hardly any frame is within the log.
    pub(super) fn join(&self, video: &str, recording: &mut Recording, options: &ImportOptions) -> Result<Vec<String>> {
        let (clock, words) =
            self.clock(recording, options).map_err(|[message, help]| DataError::runs(video, message, help))?;
        let mut told = vec![words];
        let places = self.readings_at(&recording.times, clock);
        let outside = places.iter().filter(|place| place.is_none()).count();
        if outside == places.len() {
            let range = |times: &[f64]| format!("{:.1} to {:.1} s", times[0], times[times.len() - 1]);
            let message = format!(
                "no frame lies within the pressure log: frames are at {}, its clock {} s ahead, and the log is at {}",
                range(&recording.times),
                clock.offset_s,
                range(&self.times_s)
            );
            return Err(self.fault(message, "give --clock-offset: the log's time minus the camera's, or find"));
        }
        if outside > 0 {
            told.push(format!("left out: {} outside the pressure log", counted(outside as u64, "frame")));
        }
        for (which, values) in self.values_pa.iter().enumerate() {
            let Some(values) = values else { continue };
            let value = |(place, t): (&Option<usize>, &f64)| match place {
                Some(k) if options.bin_pa.is_some() => self.between(values, *k, clock.at(*t)),
                Some(k) => values[*k],
                None => f64::NAN,
            };
            recording.pressures[which] = Some(places.iter().zip(&recording.times).map(value).collect());
        }
        if recording.clock == FrameClock::Frames {
            recording.times.iter_mut().for_each(|t| *t *= clock.rate);
        }
        Ok(told)
    }

    /// The clock that the caller gives, or that movement and pressure show.
    ///
    /// # Errors
    /// As [`agree`].
    fn clock(&self, recording: &Recording, options: &ImportOptions) -> Agreed {
        let none = vec![0.0; self.times_s.len()];
        let [body, act] = [0, 1].map(|which| self.values_pa[which].as_deref().unwrap_or(&none));
        let readings = Readings { times_s: &self.times_s, values_pa: [body, act] };
        agree(&readings, recording, options)
    }

    /// Column of the time and its seconds.
    ///
    /// # Errors
    /// None, or frames in its place; no pressure.
    fn columns(sheet: &CellText, line: u64, roles: &Roles) -> Result<(usize, f64)> {
        let (message, help) = match roles.time {
            Some((time, Some(second))) if roles.pressures.iter().any(Option::is_some) => return Ok((time, second)),
            Some((_, Some(_))) => ("a pressure", "say which: --map p_act=NAME, and p_body=NAME if there is one"),
            _ => ("the time", "say which: --map t=NAME (a log counts seconds, not frames)"),
        };
        let names = sheet.head(1).first().map_or(String::new(), |row| row.join(", "));
        Err(sheet.fault(line, format!("no column of the pressure log is {message}; there are {names}"), help))
    }

    /// The last reading at or before every frame; none before the first, or later after the last than readings are apart.
    fn readings_at(&self, times: &[f64], clock: Clock) -> Vec<Option<usize>> {
        let end = self.times_s[self.times_s.len() - 1] + self.longest_gap_s().max(SAME_TIME_S);
        let mut next = 0;
        let reading = |t: &f64| {
            let t_s = clock.at(*t);
            while next < self.times_s.len() && self.times_s[next] <= t_s + SAME_TIME_S {
                next += 1;
            }
            next.checked_sub(1).filter(|_| t_s <= end)
        };
        times.iter().map(reading).collect()
    }

    fn between(&self, values: &[f64], k: usize, t_s: f64) -> f64 {
        let Some(next) = values.get(k + 1) else { return values[k] };
        let width = self.times_s[k + 1] - self.times_s[k];
        let part = if width > 0.0 { ((t_s - self.times_s[k]) / width).clamp(0.0, 1.0) } else { 0.0 };
        values[k] + part * (next - values[k])
    }

    fn fault(&self, message: String, help: &str) -> DataError {
        DataError::Runs(Box::new(crate::error::Fault::of_file(&self.file, message, help)))
    }
}
