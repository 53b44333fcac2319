//! Pressure logs: read, and joined to frames by time (as-of: the last reading counts until the next).

use super::columns::Roles;
use super::options::{ImportOptions, Offset};
use super::recording::{Recording, counted};
use super::sheet::CellText;
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
/// Frames and readings used to find the offset of the clocks.
const USED: [usize; 2] = [1_500, 20_000];
const TRIED: usize = 3_000;
/// Share of the frames that must lie within the log.
const OVERLAP: f64 = 0.6;
/// Fewest frames from which clocks that disagree can be found.
const FEWEST_FRAMES: usize = 100;
/// Clocks disagree if another offset fits so much better, and is so far away \[s\].
const DISAGREE: (f64, f64) = (0.05, 0.3);

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

    fn longest_gap_s(&self) -> f64 {
        self.times_s.windows(2).map(|pair| pair[1] - pair[0]).fold(0.0, f64::max)
    }

    /// Puts the log's pressures into the frames of a recording (times in seconds); on a ramp readings are joined by lines.
    ///
    /// # Errors
    /// The clocks disagree; hardly any frame is within the log.
    pub(super) fn join(&self, recording: &mut Recording, options: &ImportOptions) -> Result<Vec<String>> {
        let (offset_s, mut told) = self.offset(recording, options.offset)?;
        let places = self.readings_at(&recording.times, offset_s);
        let outside = places.iter().filter(|place| place.is_none()).count();
        if outside == places.len() {
            let range = |times: &[f64]| format!("{:.1} to {:.1} s", times[0], times[times.len() - 1]);
            let message = format!(
                "no frame lies within the pressure log: frames are at {}, its clock {offset_s} s ahead, and the log is at {}",
                range(&recording.times),
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
                Some(k) if options.bin_pa.is_some() => self.between(values, *k, t + offset_s),
                Some(k) => values[*k],
                None => f64::NAN,
            };
            recording.pressures[which] = Some(places.iter().zip(&recording.times).map(value).collect());
        }
        Ok(told)
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
    fn readings_at(&self, times: &[f64], offset_s: f64) -> Vec<Option<usize>> {
        let end = self.times_s[self.times_s.len() - 1] + self.longest_gap_s().max(SAME_TIME_S);
        let mut next = 0;
        let reading = |t: &f64| {
            let t_s = t + offset_s;
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

    /// The log's time minus the camera's.
    fn offset(&self, recording: &Recording, wanted: Offset) -> Result<(f64, Vec<String>)> {
        if let Offset::Given(offset_s) = wanted {
            return Ok((
                offset_s,
                vec![format!("the pressure log's clock is {offset_s} s ahead of the camera's, as given")],
            ));
        }
        let found = (recording.times.len() >= FEWEST_FRAMES || wanted == Offset::Find)
            .then(|| self.search(recording))
            .flatten();
        match (wanted, found) {
            (Offset::Find, None) => Err(self.fault(
                "movement and pressure do not tell the offset of the clocks".into(),
                "give --clock-offset 0s or what it is",
            )),
            (Offset::Find, Some((best_s, r, _))) => Ok((
                best_s,
                vec![format!(
                    "the pressure log's clock is {best_s:.2} s ahead of the camera's: movement and pressure then correlate by {r:.2}"
                )],
            )),
            (_, Some((best_s, best, now))) if best - now > DISAGREE.0 && best_s.abs() > DISAGREE.1 => {
                let message = format!(
                    "movement and pressure correlate by {now:.2} if the clocks are one, and by {best:.2} if the log's is {best_s:.2} s ahead"
                );
                Err(self.fault(
                    message,
                    "add --clock-offset find to take the second, or --clock-offset 0s to keep the first",
                ))
            }
            _ => Ok((0.0, vec!["the pressure log and the camera were taken to have one clock".to_string()])),
        }
    }

    /// The offset at which movement and actuator pressure correlate most, that correlation, and the one without offset.
    fn search(&self, recording: &Recording) -> Option<(f64, f64, f64)> {
        let pressures = self.values_pa[1].as_ref()?;
        let thin = |count: usize, most: usize| count.div_ceil(most).max(1);
        let movement = movement(recording, thin(recording.times.len(), USED[0]));
        let step = thin(self.times_s.len(), USED[1]);
        let log: Vec<[f64; 2]> = self.times_s.iter().zip(pressures).step_by(step).map(|(t, p)| [*t, *p]).collect();
        let (first, last) = (movement.first()?[0], movement.last()?[0]);
        let slack = OVERLAP * (last - first).min(log.last()?[0] - log[0][0]);
        let range = [log[0][0] - last + slack, log.last()?[0] - first - slack];
        let at = |offset_s: f64| correlation(&movement, &log, offset_s);
        let mut width = (range[1] - range[0]) / TRIED as f64;
        if width.is_nan() || width <= 0.0 {
            return None;
        }
        let better = |a: (f64, f64), b: (f64, f64)| if b.1 > a.1 + 1e-9 { b } else { a };
        let mut best = (0.0, at(0.0).unwrap_or(-1.0));
        for k in 0..=TRIED {
            let offset_s = range[0] + k as f64 * width;
            best = better(best, (offset_s, at(offset_s).unwrap_or(-1.0)));
        }
        for _ in 0..3 {
            let around = best.0;
            for k in -10..=10 {
                let offset_s = around + 0.1 * f64::from(k) * width;
                best = better(best, (offset_s, at(offset_s).unwrap_or(-1.0)));
            }
            width *= 0.1;
        }
        Some((best.0, best.1, at(0.0).unwrap_or(-1.0)))
    }
}

/// Time and mean distance of the markers from where they were first seen.
fn movement(recording: &Recording, step: usize) -> Vec<[f64; 2]> {
    let start: Vec<Option<[f64; 3]>> =
        recording.places.iter().map(|column| column.iter().find(|p| p[0].is_finite()).copied()).collect();
    let of_frame = |frame: usize| {
        let moved = recording.places.iter().zip(&start).filter_map(|(column, start)| {
            let (place, start) = (column[frame], (*start)?);
            place[0].is_finite().then(|| (0..3).map(|axis| (place[axis] - start[axis]).powi(2)).sum::<f64>().sqrt())
        });
        let (sum, count) = moved.fold((0.0, 0.0), |(sum, count), d| (sum + d, count + 1.0));
        (count > 0.0).then(|| [recording.times[frame], sum / count])
    };
    (0..recording.times.len()).step_by(step).filter_map(of_frame).collect()
}

/// Pearson's correlation of movement and the reading that holds then; `None` with too few pairs.
fn correlation(movement: &[[f64; 2]], log: &[[f64; 2]], offset_s: f64) -> Option<f64> {
    let (mut n, mut sums) = (0.0, [0.0; 5]);
    let (first, last) = (log[0][0], log[log.len() - 1][0]);
    for [t, moved] in movement {
        let t_s = t + offset_s;
        if t_s < first - SAME_TIME_S || t_s > last + SAME_TIME_S {
            continue;
        }
        let pressure = log[log.partition_point(|row| row[0] <= t_s + SAME_TIME_S).saturating_sub(1)][1];
        n += 1.0;
        for (sum, value) in
            sums.iter_mut().zip([*moved, pressure, moved * moved, pressure * pressure, moved * pressure])
        {
            *sum += value;
        }
    }
    if n < OVERLAP * movement.len() as f64 {
        return None;
    }
    let [m, p, mm, pp, mp] = sums.map(|sum| sum / n);
    let spread = ((mm - m * m) * (pp - p * p)).sqrt();
    (spread > 0.0).then(|| (mp - m * p) / spread)
}
