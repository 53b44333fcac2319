//! A stream of pressures in, a stream of poses out, line by line: for a simulator or a log beside the real robot. And a file of pressures.

use compare::CompareError;
use models::{CHANNELS, InLine, Loads, Model, Prediction, Scenario, Step};
use spelling::units::{Dimension, Range, Unit, units_of};
use std::fs::File;
use std::io::{BufRead, BufReader, Read, Write};
use std::path::Path;

/// Most bytes of a line.
const MOST_LINE: u64 = 4096;

/// A robot that follows a stream.
pub struct Follower {
    model: Model,
    scenario: Scenario,
    has_history: bool,
    state: Prediction,
    before: Option<Step>,
    way: InLine,
}

impl Follower {
    /// At rest, nothing in its lines, at time 0.
    pub fn new(scenario: &Scenario) -> Follower {
        let model = Model::new(scenario);
        let (has_history, state) = (model.has_history(), model.prediction());
        Follower { model, scenario: scenario.clone(), has_history, state, before: None, way: InLine::default() }
    }

    /// The state at a time \[s\], the pressures having been set since the time before. With `[supply]` they arrive late; a robot
    /// with history remembers.
    ///
    /// # Errors
    /// A time before the last one, a pressure that means nothing, or no equilibrium.
    pub fn next(&mut self, t_s: f64, set: &Loads) -> Result<&Prediction, CompareError> {
        let since = self.before.map_or(0.0, |last| last.t_s);
        if let Err((message, help)) = Range::TIME.check(t_s) {
            return Err(CompareError::refused(message, help));
        }
        if t_s < since {
            let message = format!("the time {t_s} s is before {since} s");
            return Err(CompareError::refused(message, "times count from the start and do not go back"));
        }
        let mut loads = *set;
        if let Some(line) = &self.scenario.line {
            line.pass(&set.actuator_pa, t_s - since, &mut self.way);
            loads.actuator_pa = self.way.arrived_pa;
        }
        let step = Step { t_s, loads };
        match self.has_history {
            true => self.model.follow_on(self.before, &step, &mut self.state)?,
            false => self.model.predict(&loads, &mut self.state)?,
        }
        self.before = Some(step);
        Ok(&self.state)
    }

    /// Pressures that arrived in the actuators \[Pa\].
    pub fn arrived_pa(&self) -> [f64; CHANNELS] {
        self.before.map_or([0.0; CHANNELS], |last| last.loads.actuator_pa)
    }

    /// Channels that feed an actuator.
    pub fn channels(&self) -> Vec<usize> {
        self.model.channels().collect()
    }
}

/// What a column of the stream is.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Column {
    Time,
    Body,
    All,
    Channel(usize),
}

/// Reads a header and lines of `t_s` and pressures (`p_kpa` for all channels, or `p0_kpa`, `p1_kpa` …, and `p_body_kpa`; other units
/// by their name), and writes a line for each, at once: `t_s,x_mm,y_mm,angle_deg` and the pressures that arrived. Keeps nothing.
///
/// # Errors
/// A line that cannot be understood or predicted, by its number; the lines before it are out. Of a closed output nothing is said.
pub fn follow(scenario: &Scenario, input: impl BufRead, mut output: impl Write) -> Result<(), CompareError> {
    let mut follower = Follower::new(scenario);
    let channels = follower.channels();
    let (mut lines, columns) =
        Lines::begin(input, "standard input", HEADER, |header| columns(header, &channels, true))?;
    let names: String = channels.iter().map(|channel| format!(",p{channel}_kpa")).collect();
    let mut say = |text: String| output.write_all(text.as_bytes()).and_then(|()| output.flush()).is_ok();
    let mut goes_on = say(format!("t_s,x_mm,y_mm,angle_deg{names}\n"));
    while goes_on {
        let Some(line) = lines.next()? else { break };
        let (t_s, loads) = read(&line, &columns, scenario.p_body_pa).map_err(|what| lines.fault(&what))?;
        let told = follower.next(t_s, &loads).map(|at| at.tip);
        let tip = told.map_err(|error| lines.fault_with(&error.to_string(), error.help().unwrap_or_default()))?;
        let arrived = follower.arrived_pa();
        let pressures: String = channels.iter().map(|channel| format!(",{:.4}", arrived[*channel] / 1e3)).collect();
        let (x, y, angle) = (tip.x_m * 1e3, tip.y_m * 1e3, tip.angle_rad.to_degrees());
        goes_on = say(format!("{t_s},{x:.4},{y:.4},{angle:.4}{pressures}\n"));
    }
    Ok(())
}

const HEADER: &str = "the first line names the columns, for example t_s,p_kpa or t_s,p0_kpa,p1_kpa; then numbers";

const TABLE: &str =
    "the first line names the columns, for example p_kpa or p0_kpa,p1_kpa; then numbers, a line for each pose";

/// Pressures of a file, a line for each pose: columns as those of [`follow`], without a time.
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
    let (mut lines, columns) = Lines::begin(input, &name, TABLE, |header| columns(header, &channels, false))?;
    let mut all = Vec::new();
    while let Some(line) = lines.next()? {
        if all.len() == most {
            return Err(lines.fault_with(&format!("more than {most} pressures"), "ibr sweep computes more, in parts"));
        }
        all.push(read(&line, &columns, scenario.p_body_pa).map_err(|what| lines.fault(&what))?.1);
    }
    if all.is_empty() { Err(lines.fault("there is no line of pressures")) } else { Ok(all) }
}

/// Lines that are read one by one into one buffer.
struct Lines<R> {
    input: R,
    /// For messages: where they are from, and how they should look.
    from: String,
    how: &'static str,
    number: u64,
    line: Vec<u8>,
}

impl<R: BufRead> Lines<R> {
    fn begin<T>(
        input: R,
        from: &str,
        how: &'static str,
        header: impl Fn(&str) -> Result<T, String>,
    ) -> Result<(Lines<R>, T), CompareError> {
        let mut lines = Lines { input, from: from.into(), how, number: 0, line: Vec::new() };
        let Some(first) = lines.next()? else { return Err(lines.fault("nothing came in")) };
        let found = header(&first).map_err(|what| lines.fault(&what))?;
        Ok((lines, found))
    }

    /// The next line that is neither empty nor a comment.
    fn next(&mut self) -> Result<Option<String>, CompareError> {
        loop {
            self.line.clear();
            self.number += 1;
            let got = (&mut self.input).take(MOST_LINE).read_until(b'\n', &mut self.line);
            let got = got.map_err(|cause| self.fault_with(&cause.to_string(), ""))?;
            if got as u64 == MOST_LINE && self.line.last() != Some(&b'\n') {
                return Err(self.fault(&format!("it is longer than {MOST_LINE} bytes")));
            }
            let Ok(text) = std::str::from_utf8(&self.line) else { return Err(self.fault("it is no text")) };
            let text = text.trim_start_matches('\u{feff}').trim();
            match text {
                _ if got == 0 => return Ok(None),
                "" => {}
                text if text.starts_with('#') => {}
                text => return Ok(Some(text.to_string())),
            }
        }
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
fn columns(header: &str, fed: &[usize], timed: bool) -> Result<Vec<(Column, Unit)>, String> {
    let mut found: Vec<(Column, Unit)> = Vec::new();
    for name in header.split(',').map(|name| name.trim().to_lowercase()) {
        let (base, unit) = name.rsplit_once('_').ok_or_else(|| format!("`{name}` has no unit"))?;
        let (column, dimension) = match base {
            "t" => (Column::Time, Dimension::TIME),
            "p_body" => (Column::Body, Dimension::PRESSURE),
            "p" | "p_act" => (Column::All, Dimension::PRESSURE),
            _ => match base.strip_prefix('p').and_then(|digits| digits.parse().ok()) {
                Some(channel) if fed.contains(&channel) => (Column::Channel(channel), Dimension::PRESSURE),
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
    let has = |column: Column| found.iter().any(|(known, _)| *known == column);
    let (some, every) = (fed.iter().any(|c| has(Column::Channel(*c))), fed.iter().all(|c| has(Column::Channel(*c))));
    match (has(Column::Time), has(Column::All), some) {
        (false, ..) if timed => Err("there is no column t_s".into()),
        (true, ..) if !timed => Err("it has times: give it to ibr predict --follow as standard input".into()),
        (_, true, true) => Err("p for all channels and pressures of single ones say the same twice".into()),
        (_, false, _) if !every => Err(format!("there is no pressure for each of the channels {fed:?}")),
        _ => Ok(found),
    }
}

/// Time and pressures of a line.
fn read(line: &str, columns: &[(Column, Unit)], body_pa: f64) -> Result<(f64, Loads), String> {
    let cells: Vec<&str> = line.split(',').map(str::trim).collect();
    if cells.len() != columns.len() {
        return Err(format!("{} cells, the header has {}", cells.len(), columns.len()));
    }
    let (mut t_s, mut loads) = (f64::NAN, Loads { body_pa, actuator_pa: [0.0; CHANNELS] });
    for (cell, (column, unit)) in cells.into_iter().zip(columns) {
        let number: f64 = cell.parse().map_err(|_| format!("`{cell}` is no number"))?;
        let si = unit.to_si(number);
        match column {
            Column::Time => t_s = si,
            Column::Body => loads.body_pa = si,
            Column::All => loads.actuator_pa = [si; CHANNELS],
            Column::Channel(channel) => loads.actuator_pa[*channel] = si,
        }
    }
    Ok((t_s, loads.checked().map_err(|error| error.to_string())?))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{HOLD_S, predict};

    fn robot(more: &str) -> Scenario {
        Scenario::parse(&(models::shipped("epam-textbook").unwrap().to_string() + more)).unwrap()
    }

    fn answer(scenario: &Scenario, text: &str) -> (Vec<Vec<f64>>, Option<String>) {
        let mut out = Vec::new();
        let told = follow(scenario, text.as_bytes(), &mut out).err().map(|error| error.to_string());
        let text = String::from_utf8(out).unwrap();
        let row = |line: &str| line.split(',').map(|cell| cell.parse().unwrap()).collect();
        (text.lines().skip(1).map(row).collect(), told)
    }

    #[test]
    fn lines_are_the_predictions_of_the_same_pressures_and_history_is_followed() {
        for effect in [None, Some(("creep", [0.4, 2.0])), Some(("friction", [0.3, 0.0]))] {
            let mut scenario = robot("").with_bending(0.8);
            if let Some((name, values)) = &effect {
                let count = scenario.catalogue().by_name(name).unwrap().parameters.len();
                scenario = scenario.with_effect(name, &values[..count]);
            }
            let pressures = [5e3, 20e3, 10e3, 0.0];
            let expected = predict(&scenario, &pressures.map(|p| Loads::uniform(2e3, p))).unwrap();
            let text = "# a log\nt_ms, p_Pa\n\n5000,5000\r\n10000,20000\n15000,10000\n20000,0\n";
            let (rows, told) = answer(&scenario, text);
            assert_eq!((rows.len(), told), (4, None));
            for (i, (row, state)) in rows.iter().zip(&expected).enumerate() {
                assert_eq!(row[0], HOLD_S * (i + 1) as f64);
                assert!((row[2] - 1e3 * state.prediction.tip.y_m).abs() < 1e-4, "{effect:?} {row:?}");
            }
        }
    }

    #[test]
    fn pressures_arrive_as_the_supply_lets_them() {
        let (rows, _) = answer(&robot("\n[supply]\nvalve_time_s = 0.5\n"), "t_s,p_kpa\n0,0\n0.5,20\n1,20\n");
        let exact = |t: f64| 20.0 * (1.0 - (-t / 0.5_f64).exp());
        assert!((rows[1][4] - exact(0.5)).abs() < 1e-3 && (rows[2][4] - exact(1.0)).abs() < 1e-3, "{rows:?}");
        let (still, _) = answer(&robot(""), &format!("t_s,p_kpa\n0,{}\n", exact(1.0)));
        assert!((still[0][2] - rows[2][2]).abs() < 1e-3, "the tip is that of the pressure that arrived");
    }

    #[test]
    fn a_file_of_pressures_is_read_line_by_line_without_times() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("p.csv");
        let read = |text: &str| {
            std::fs::write(&path, text).unwrap();
            pressures_of(&robot(""), &path, 3).map_err(|error| error.to_string())
        };
        let found = read("p_bar,p_body_kpa\n0.1,2\n\n0.2,3\n").unwrap();
        assert_eq!(found, [Loads::uniform(2e3, 0.1e5), Loads::uniform(3e3, 0.2e5)]);
        for (text, words) in [
            ("p_kpa\n", "there is no line of pressures"),
            ("p_kpa\n1\nx\n", "line 3: `x` is no number"),
            ("t_s,p_kpa\n0,1\n", "line 1: it has times"),
            ("p_kpa\n1\n2\n3\n4\n", "line 5: more than 3 pressures"),
        ] {
            let told = read(text).unwrap_err();
            assert!(told.contains(words) && told.contains("p.csv"), "{text}: {told}");
        }
        std::fs::remove_file(&path).unwrap();
        assert!(pressures_of(&robot(""), &path, 3).unwrap_err().to_string().contains("p.csv"));
    }

    #[test]
    fn a_bad_line_is_told_by_its_number_and_those_before_it_are_out() {
        for (bad, words) in [
            ("2,x", "line 4: `x` is no number"),
            ("2", "line 4: 1 cells, the header has 2"),
            ("0.5,10", "line 4: the time 0.5 s is before 1 s"),
            ("nan,10", "line 4: time must be from 0 to 10000000000 s, not NaN"),
            ("inf,10", "line 4: time must be from 0 to 10000000000 s, not inf"),
            ("2,-3", "line 4: actuator pressure must be from 0 to 1000 kPa, not -3"),
        ] {
            let (rows, told) = answer(&robot(""), &format!("t_s,p_kpa\n0,5\n1,10\n{bad}\n3,10\n"));
            assert!(rows.len() == 2 && told.as_ref().unwrap().contains(words), "{bad}: {told:?}");
        }
        for (header, words) in [
            ("", "nothing came in"),
            ("0,5", "`0` has no unit"),
            ("t_s,p_furlong", "unknown unit"),
            ("t_s,p2_kpa", "nothing is supplied by channel 2"),
            ("t_s,t_s", "comes twice"),
            ("p_kpa", "there is no column t_s"),
            ("t_s", "no pressure for each"),
            (&"t".repeat(5000), "longer than 4096"),
        ] {
            let (rows, told) = answer(&robot(""), header);
            assert!(rows.is_empty() && told.as_ref().unwrap().contains(words), "{header}: {told:?}");
        }
    }
}
