//! Pressure logs: read, and joined to frames by time (as-of: the last reading counts until the next).

use super::clock::{Clock, Readings, agree, tracks};
use super::columns::{ColumnName, Roles, is_time, is_unit};
use super::holds::median;
use super::loggers::Plain;
use super::options::ImportOptions;
use super::recording::{Recording, counted};
use super::sheet::CellText;
use crate::agreement::LogSeen;
use crate::error::{DataError, Fault, Result};
use crate::policy::{HIGHEST_GAUGE_PA, ROOM_PA, tolerance_act_pa, tolerance_body_pa};
use crate::units::kpa;
use spelling::units::Range;

#[derive(Debug, Clone)]
pub(crate) struct Log {
    file: String,
    times_s: Vec<f64>,
    /// Pressures of body and actuator \[Pa\], where the log has them.
    values_pa: [Option<Vec<f64>>; 2],
    pub names: Vec<String>,
    pub told: Vec<String>,
}

/// Two readings of one time are one if nearer than this \[s\].
const SAME_TIME_S: f64 = 1e-6;
/// A robot moves between readings that are farther apart than this \[s\].
const COARSE_S: f64 = 0.25;
const DAY_S: f64 = 86_400.0;
/// Lines among which the names of the columns are looked for.
const MOST_HEAD: usize = 100;

/// Names of the columns, with the units of a row below them, and the number of lines up to the first row.
fn named(sheet: &CellText, lines: &[(u64, &str)], options: &ImportOptions) -> Result<(usize, Vec<String>)> {
    // Numbers, clocks and dates.
    let is_value = |cell: &str| cell.starts_with(|c: char| c.is_ascii_digit()) || sheet.number(cell).is_some();
    let is_row = |line: &str| {
        let cells = sheet.split(line);
        let mut filled = cells.iter().filter(|cell| !cell.is_empty()).peekable();
        filled.peek().is_some() && filled.all(|cell| is_value(cell))
    };
    let first = owned(sheet.split(lines[0].1));
    let mut head = lines.iter().take(MOST_HEAD);
    let Some(row) = head.position(|(_, line)| is_row(line)) else { return Ok((1, first)) };
    if row == 0 {
        return unnamed(sheet, lines[0], options).map(|names| (0, names));
    }
    let above = sheet.split(lines[row - 1].1);
    let may_be_unit = |cell: &&str| cell.is_empty() || is_unit(&bare(cell).to_lowercase());
    if row < 2 || !above.iter().all(may_be_unit) {
        // A word among the numbers is a fault of its row, not of the names.
        let is_header = first.len() == above.len() && first.iter().any(|name| is_time(&ColumnName::of(name)));
        return Ok(if is_header { (1, first) } else { (row, owned(above)) });
    }
    let with_unit = |(name, unit): (&&str, &&str)| match bare(unit) {
        "" => (*name).to_string(),
        unit => format!("{name} ({unit})"),
    };
    let names = sheet.split(lines[row - 2].1);
    Ok((row, names.iter().zip(&above).map(with_unit).collect()))
}

fn owned(cells: Vec<&str>) -> Vec<String> {
    cells.into_iter().map(str::to_string).collect()
}

fn bare(cell: &str) -> &str {
    cell.trim_matches(['(', ')', '[', ']'])
}

/// Names of the file, or the caller's where they are `-` or the file's has no known unit; and the note on the others.
fn renamed(names: Vec<String>, given: &[String]) -> (Vec<String>, Option<String>) {
    let has_unit = |name: &str| ColumnName::of(name).unit.is_some_and(|unit| is_unit(&unit));
    let is_kept = |(name, given): (&String, &String)| given != "-" && has_unit(name) && name != given;
    let kept: Vec<&str> =
        names.iter().zip(given).filter(|pair| is_kept(*pair)).map(|(name, _)| name.as_str()).collect();
    let note = "its columns have names: --log-columns was not used";
    if given.len() != names.len() {
        return (names, (!given.is_empty()).then(|| note.to_string()));
    }
    let note = (!kept.is_empty()).then(|| format!("{note} for {}", kept.join(", ")));
    let name = |pair: (&String, &String)| if is_kept(pair) { pair.0.clone() } else { pair.1.clone() };
    (names.iter().zip(given).map(name).collect(), note)
}

/// The names that the caller gives to the columns of a log without names.
fn unnamed(sheet: &CellText, (number, line): (u64, &str), options: &ImportOptions) -> Result<Vec<String>> {
    let cells = sheet.split(line);
    let given = &options.log_columns;
    if given.len() == cells.len() {
        return Ok(given.clone());
    }
    let row = cells.join(", ");
    let message = match (given.len(), cells.len()) {
        (0, _) => format!("the pressure log has no names of columns; its first row is {row}"),
        (count, found) => format!("--log-columns names {count} columns, the row has {found}: {row}"),
    };
    let body = (cells.len() > 2).then_some("p_body_kpa");
    let known = ["t_s"].into_iter().chain(body).chain(["p_act_kpa"]).chain(std::iter::repeat("-"));
    let names = known.take(cells.len()).collect::<Vec<_>>().join(",");
    let help = "name each of them with its unit, and write - for unused columns, for example --log-columns";
    Err(sheet.fault(number, message, format!("{help} {names}")))
}

impl Log {
    /// Reads the rows; `plain` has the names of the columns if no line of the file has them.
    pub(super) fn read(sheet: &CellText, plain: &Plain, options: &ImportOptions) -> Result<Log> {
        let lines: Vec<(u64, &str)> = sheet.lines().filter(|(_, line)| !line.starts_with('#')).collect();
        if lines.is_empty() {
            return Err(sheet.fault(0, "the pressure log is empty", "export it again"));
        }
        let (at, names) =
            if plain.names.is_empty() { named(sheet, &lines, options)? } else { (0, plain.names.clone()) };
        let (names, unused) = renamed(names, &options.log_columns);
        let shown: Vec<&str> = names.iter().map(String::as_str).collect();
        let first = lines[at.saturating_sub(1)].0;
        let roles = Roles::of(sheet, first, &shown, options)?;
        let (time, second) = Log::columns(sheet, first, &shown, &roles)?;
        let values_pa = roles.pressures.map(|column| column.map(|_| Vec::new()));
        let told = plain.told.iter().chain(&roles.told).cloned().chain(unused).collect();
        let mut log = Log { file: sheet.file.to_string(), times_s: Vec::new(), values_pa, names, told };
        let (mut cells, mut midnights) = (Vec::new(), 0.0);
        for (number, line) in lines.into_iter().skip(at) {
            sheet.split_into(line, &mut cells);
            let cell = |index: usize| cells.get(index).copied().unwrap_or_default();
            let last_s = log.times_s.last().copied().unwrap_or(f64::NEG_INFINITY);
            let mut t_s = midnights + sheet.time(cell(time), second, number, "time")?;
            // A clock begins again at midnight.
            if cell(time).contains(':') && t_s < last_s - 0.5 * DAY_S {
                (midnights, t_s) = (midnights + DAY_S, t_s + DAY_S);
            }
            if t_s < last_s {
                let help = "sort its rows, or give one log per run";
                return Err(sheet.fault(number, "the time of the pressure log goes back", help));
            }
            log.times_s.push(t_s);
            for (column, values) in roles.pressures.iter().zip(&mut log.values_pa) {
                let (Some((index, pa)), Some(values)) = (column, values) else { continue };
                let now_pa = pa * sheet.expect(cell(*index), number, "pressure")?;
                // Absolute pressures include the room's.
                if now_pa.abs() > HIGHEST_GAUGE_PA + ROOM_PA[1] {
                    let message = Range::ACTUATOR_PRESSURE.mistake(now_pa.abs());
                    let help = "check the reading and the unit of the column";
                    return Err(sheet.fault(number, message, help));
                }
                let before_pa = values.last().copied().filter(|_| t_s - last_s < SAME_TIME_S);
                let gauge_pa = before_pa.unwrap_or(now_pa) - options.room_pa.unwrap_or(0.0);
                // Two readings at one time do not differ by more than readings of one hold.
                if let Some(before_pa) = before_pa.filter(|p| (now_pa - p).abs() > tolerance_act_pa(gauge_pa)) {
                    let [before, now] = [before_pa, now_pa].map(kpa);
                    let message = format!("the pressure log has both {before:.1} and {now:.1} kPa at {t_s} s");
                    let help =
                        "delete the wrong row; where the clock is too coarse, export the times with their decimals";
                    return Err(sheet.fault(number, message, help));
                }
                values.push(now_pa);
            }
        }
        if log.times_s.is_empty() {
            return Err(sheet.fault(0, "the pressure log has no rows", "export it again"));
        }
        Ok(log)
    }

    pub(super) fn seen(self) -> LogSeen {
        let Log { file, times_s, values_pa: [_, act], .. } = self;
        let act_pa = act.unwrap_or_else(|| vec![0.0; times_s.len()]);
        LogSeen { file, act_pa, times_s }
    }

    /// Puts the log's pressures into the frames of a recording (times in seconds); on a ramp readings are joined by lines.
    pub(super) fn join(&self, video: &str, recording: &mut Recording, options: &ImportOptions) -> Result<Vec<String>> {
        let none = vec![0.0; self.times_s.len()];
        let values_pa = [0, 1].map(|which| self.values_pa[which].as_deref().unwrap_or(&none));
        let readings = Readings { times_s: &self.times_s, values_pa };
        let (clock, words) = agree(&readings, recording, options).map_err(|[message, help]| {
            let fault = Box::new(Fault::of_file(video, message, help));
            match tracks(&readings, recording, options) {
                Some(tracks) => DataError::Clock(fault, Box::new(tracks)),
                None => DataError::Content(fault),
            }
        })?;
        let mut told = vec![words];
        let places = self.readings_at(&recording.times, clock);
        let outside = places.iter().filter(|place| place.is_none()).count();
        if outside == places.len() {
            let range = |times: &[f64]| format!("{:.1} to {:.1} s", times[0], times[times.len() - 1]);
            let (frames, log, ahead) = (range(&recording.times), range(&self.times_s), clock.offset_s);
            let message = format!(
                "no frame is within the pressure log: frames are at {frames}, its clock {ahead} s ahead, and the log is at {log}"
            );
            let help = "give --clock-offset: the log's time minus the camera's, or find";
            return Err(DataError::of(&self.file, message, help));
        }
        if outside > 0 {
            let frames = counted(outside as u64, "frame");
            told.push(format!("left out: {frames} outside the pressure log"));
        }
        let mut unknown = 0;
        for (which, values) in self.values_pa.iter().enumerate() {
            let Some(values) = values else { continue };
            let changing = self.changing(values, [tolerance_body_pa, tolerance_act_pa][which]);
            let value = |(place, t): (&Option<usize>, &f64)| match place {
                Some(k) if options.bin_pa.is_some() => self.between(values, *k, clock.at(*t)),
                Some(k) if changing[*k] && clock.at(*t) > self.times_s[*k] + SAME_TIME_S => f64::NAN,
                Some(k) => values[*k],
                None => f64::NAN,
            };
            let found: Vec<f64> = places.iter().zip(&recording.times).map(value).collect();
            unknown = unknown.max(found.iter().filter(|p| p.is_nan()).count() - outside);
            recording.pressures[which] = Some(found);
        }
        if unknown > 0 {
            let frames = counted(unknown as u64, "frame");
            told.push(format!("left out: {frames} between two readings in which the pressure changes"));
        }
        if !recording.in_seconds {
            recording.times.iter_mut().for_each(|t| *t *= clock.rate);
        }
        Ok(told)
    }

    fn columns(sheet: &CellText, line: u64, names: &[&str], roles: &Roles) -> Result<(usize, f64)> {
        let is_pressed = roles.pressures.iter().any(Option::is_some);
        let (what, help) = match roles.time {
            Some((time, Some(second))) if is_pressed => return Ok((time, second)),
            Some((_, Some(_))) => ("a pressure", "p_act=NAME, and p_body=NAME if there is one"),
            _ => ("the time", "t=NAME (a log counts seconds, not frames)"),
        };
        let message = format!("no column of the pressure log is {what}; there are {}", names.join(", "));
        Err(sheet.fault(line, message, format!("say which: --map {help}")))
    }

    /// The last reading at or before every frame; none before the first, or later after the last than readings are apart.
    fn readings_at(&self, times: &[f64], clock: Clock) -> Vec<Option<usize>> {
        let gaps = self.times_s.windows(2).map(|pair| pair[1] - pair[0]);
        let end = self.times_s[self.times_s.len() - 1] + gaps.fold(SAME_TIME_S, f64::max);
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

    /// Readings after which the pressure changes until the next one, and nothing shows when; a log that writes changes only is none.
    fn changing(&self, values: &[f64], tolerance_pa: fn(f64) -> f64) -> Vec<bool> {
        let gaps: Vec<f64> = self.times_s.windows(2).map(|pair| pair[1] - pair[0]).collect();
        let most_s = 2.0 * median(gaps.clone()).unwrap_or(0.0);
        let steps = || values.windows(2).map(|pair| (pair[1] - pair[0]).abs() > tolerance_pa(pair[0].min(pair[1])));
        let sampled = 2 * steps().filter(|changes| *changes).count() < steps().count();
        let is_lost = |(changes, gap_s): (bool, &f64)| sampled && changes && *gap_s > COARSE_S && *gap_s <= most_s;
        steps().zip(&gaps).map(is_lost).chain([false]).collect()
    }

    fn between(&self, values: &[f64], k: usize, t_s: f64) -> f64 {
        let Some(next) = values.get(k + 1) else { return values[k] };
        let (gone, width) = (t_s - self.times_s[k], self.times_s[k + 1] - self.times_s[k]);
        let part = if width > 0.0 { (gone / width).clamp(0.0, 1.0) } else { 0.0 };
        values[k] + part * (next - values[k])
    }
}
