//! A stream of pressures in, a stream of poses out, line by line: for a simulator or a log next to the real robot.

use crate::shown::predicted::{above_limit, beyond_words};
use crate::stream::{BEYOND, HEADER, LIMIT, LINE, MARKS, Marked, StreamLines, StreamReading, UNSOLVED, columns};
use compare::CompareError;
use models::{CHANNELS, InLine, Loads, Model, Prediction, Scenario, Step};
use spelling::units::Range;
use std::io::{BufRead, Write};

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
    /// A time before the last one, a pressure that means nothing, or no equilibrium; the robot is then as it was.
    pub fn next(&mut self, t_s: f64, set: &Loads) -> Result<&Prediction, CompareError> {
        let since = self.before.map_or(0.0, |last| last.t_s);
        if let Err((message, help)) = Range::TIME.check(t_s) {
            return Err(CompareError::refused(message, help));
        }
        if t_s < since {
            let message = format!("the time {t_s} s is before {since} s");
            return Err(CompareError::refused(message, "times count from the start and do not go back"));
        }
        let (mut loads, way) = (*set, self.way);
        if let Some(line) = &self.scenario.line {
            line.pass(&set.actuator_pa, t_s - since, &mut self.way);
            loads.actuator_pa = self.way.arrived_pa;
        }
        let step = Step { t_s, loads };
        // A path that fails half way has changed what the robot remembers.
        let remembered = self.has_history.then(|| self.state.clone());
        let solved = match self.has_history {
            true => self.model.follow_on(self.before, &step, &mut self.state),
            false => self.model.predict(&loads, &mut self.state),
        };
        if let Err(error) = solved {
            self.way = way;
            self.state = remembered.unwrap_or_else(|| self.model.prediction());
            return Err(error.into());
        }
        self.before = Some(step);
        Ok(&self.state)
    }

    /// Pressures that arrived in the actuators \[Pa\].
    pub fn arrived_pa(&self) -> [f64; CHANNELS] {
        self.before.map_or([0.0; CHANNELS], |last| last.loads.actuator_pa)
    }

    /// Channels that feed an actuator, whose pressures a line may set.
    pub fn channels(&self) -> Vec<usize> {
        self.model.channels().collect()
    }
}

/// What a stream had, when it ends.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Followed {
    /// Number of lines that were answered with a state.
    pub lines: u64,
    /// Lines of each mark, and the first one.
    marks: [(u64, u64); MARKS.len()],
    /// Of the first pose beyond a limit and of the highest pressure above the scenario's, as `ibr predict` warns.
    warnings: [Option<String>; 2],
}

impl Followed {
    fn count(&mut self, number: u64, marked: &Marked) {
        self.lines += 1;
        for ((count, first), _) in self.marks.iter_mut().zip(marked).filter(|(_, marked)| **marked) {
            *first = if *count == 0 { number } else { *first };
            *count += 1;
        }
    }

    /// The stream in words: how many lines have each mark, and the warnings.
    pub fn words(&self) -> Vec<String> {
        let found = MARKS.iter().zip(self.marks).filter(|(_, (count, _))| *count > 0);
        let word = |((name, what), (count, first)): (&(&str, &str), (u64, u64))| {
            format!("warning: {count} of {} lines are marked {name}, the first is line {first}: {what}", self.lines)
        };
        found.map(word).chain(self.warnings.iter().flatten().cloned()).collect()
    }
}

/// Reads a header and lines of `t_s` and pressures (`p_kpa` for all channels, or `p0_kpa`, `p1_kpa` …, and `p_body_kpa`; other units
/// by their name), and writes a line for each, at once: `t_s,x_mm,y_mm,angle_deg`, the pressures that arrived, and marks. Keeps nothing.
///
/// A reading that is bad is never used as a pressure: its line is marked and counted, and the stream goes on.
///
/// ```
/// let robot = ibr::ScenarioFile::read("epam")?.scenario;
/// let mut lines = Vec::new();
/// ibr::follow(&robot, "t_s,p_kpa\n0,0\n0.1,20\n".as_bytes(), &mut lines)?;
/// assert_eq!(String::from_utf8_lossy(&lines).lines().count(), 1 + 2);
/// # Ok::<(), ibr::Error>(())
/// ```
///
/// # Errors
/// A header that cannot be understood, or an input that cannot be read. A closed output is not an error.
pub fn follow(scenario: &Scenario, input: impl BufRead, mut output: impl Write) -> Result<Followed, CompareError> {
    let mut follower = Follower::new(scenario);
    let channels = follower.channels();
    let (mut lines, columns) =
        StreamLines::begin(input, "standard input", HEADER, |header| columns(header, &channels, true))?;
    let names: String = channels.iter().map(|channel| format!(",p{channel}_kpa")).collect();
    let mut write = |text: String| output.write_all(text.as_bytes()).and_then(|()| output.flush()).is_ok();
    let mut goes_on = write(format!("t_s,x_mm,y_mm,angle_deg{names},mark\n"));
    let (mut last, mut followed, mut highest_pa) =
        (StreamReading::at_rest(scenario.p_body_pa), Followed::default(), 0.0);
    // Not a number until the first equilibrium.
    let mut tip = follower.state.tip;
    [tip.x_m, tip.y_m, tip.angle_rad] = [f64::NAN; 3];
    while goes_on {
        let mut marked = Marked::default();
        let Some(line) = lines.next()? else { break };
        match line {
            Ok(line) => last.take(&line, &columns, &mut marked),
            Err(_) => marked[LINE] = true,
        }
        match follower.next(last.t_s, &last.loads) {
            Ok(state) => tip = state.tip,
            Err(_) => marked[UNSOLVED] = true,
        }
        if !marked[UNSOLVED]
            && let Some(Step { loads, .. }) = follower.before
        {
            let beyond = beyond_words(&follower.model, &loads, &follower.state);
            marked[BEYOND] = !beyond.is_empty();
            followed.warnings[0] = followed.warnings[0].take().or(beyond.into_iter().next());
            let most_pa = loads.actuator_pa.iter().copied().fold(0.0, f64::max);
            let above = above_limit(scenario, &[loads]);
            marked[LIMIT] = above.is_some();
            if most_pa > highest_pa {
                (highest_pa, followed.warnings[1]) = (most_pa, above);
            }
        }
        followed.count(lines.number(), &marked);
        let arrived = follower.arrived_pa();
        let pressures: String = channels.iter().map(|channel| format!(",{:.4}", arrived[*channel] / 1e3)).collect();
        let (x, y, angle) = (tip.x_m * 1e3, tip.y_m * 1e3, tip.angle_rad.to_degrees());
        let marks = MARKS.iter().zip(marked).filter(|(_, marked)| *marked).map(|((name, _), _)| *name);
        let marks = marks.collect::<Vec<_>>().join("+");
        goes_on = write(format!("{},{x:.4},{y:.4},{angle:.4}{pressures},{marks}\n", last.t_s));
    }
    Ok(followed)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{HOLD_S, predict};

    fn robot(more: &str) -> Scenario {
        Scenario::parse(&(models::shipped("epam-textbook").unwrap().to_string() + more)).unwrap()
    }

    /// Numbers of the rows, their marks, and the words at the end or the error.
    type Answer = (Vec<Vec<f64>>, Vec<String>, Result<Vec<String>, String>);

    fn answer(scenario: &Scenario, text: &[u8]) -> Answer {
        let mut out = Vec::new();
        let notes = follow(scenario, text, &mut out).map(|end| end.words()).map_err(|error| error.to_string());
        let text = String::from_utf8(out).unwrap();
        let (mut rows, mut marks) = (Vec::new(), Vec::new());
        for line in text.lines().skip(1) {
            let (numbers, mark) = line.rsplit_once(',').unwrap();
            rows.push(numbers.split(',').map(|cell| cell.parse().unwrap()).collect());
            marks.push(mark.to_string());
        }
        (rows, marks, notes)
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
            let (rows, marks, notes) = answer(&scenario, text.as_bytes());
            assert_eq!((rows.len(), marks.concat(), notes), (4, String::new(), Ok(Vec::new())));
            for (i, (row, state)) in rows.iter().zip(&expected).enumerate() {
                assert_eq!(row[0], HOLD_S * (i + 1) as f64);
                assert!((row[2] - 1e3 * state.prediction.tip.y_m).abs() < 1e-4, "{effect:?} {row:?}");
            }
        }
    }

    #[test]
    fn pressures_arrive_as_the_supply_lets_them() {
        let (rows, ..) = answer(&robot("\n[supply]\nvalve_time_s = 0.5\n"), b"t_s,p_kpa\n0,0\n0.5,20\n1,20\n");
        let exact = |t: f64| 20.0 * (1.0 - (-t / 0.5_f64).exp());
        assert!((rows[1][4] - exact(0.5)).abs() < 1e-3 && (rows[2][4] - exact(1.0)).abs() < 1e-3, "{rows:?}");
        let (still, ..) = answer(&robot(""), format!("t_s,p_kpa\n0,{}\n", exact(1.0)).as_bytes());
        assert!((still[0][2] - rows[2][2]).abs() < 1e-3, "the tip follows the pressure that arrived");
    }

    #[test]
    fn a_bad_reading_is_marked_and_never_used() {
        let (good, ..) = answer(&robot(""), b"t_s,p_kpa\n0,5\n1,10\n2,0\n3,30\n");
        let [five, ten, none, thirty] = [0, 1, 2, 3].map(|k| &good[k][1..]);
        for (bad, mark, t_s, as_of) in [
            ("2,-0.02", "zero", 2.0, none),
            ("2,-0.5", "zero", 2.0, none),
            ("2,-0.6", "held", 2.0, ten),
            ("2,nan", "held", 2.0, ten),
            ("2,", "held", 2.0, ten),
            ("2,x", "held", 2.0, ten),
            ("2,inf", "held", 2.0, ten),
            ("2,2000", "held", 2.0, ten),
            ("2", "line", 1.0, ten),
            ("2,20,20", "line", 1.0, ten),
            ("0.5,20", "clock", 1.0, ten),
            ("nan,20", "clock", 1.0, ten),
            ("inf,20", "clock", 1.0, ten),
            ("-1,20", "clock", 1.0, ten),
        ] {
            let text = format!("t_s,p_kpa\n0,5\n1,10\n{bad}\n3,30\n");
            let (rows, marks, notes) = answer(&robot(""), text.as_bytes());
            assert_eq!((rows[2][0], &rows[2][1..], marks.join(" ")), (t_s, as_of, format!("  {mark} ")), "{bad}");
            assert_eq!((&rows[0][1..], &rows[3][1..]), (five, thirty), "the stream goes on after {bad}");
            assert!(
                notes.unwrap()[0]
                    .starts_with(&format!("warning: 1 of 4 lines are marked {mark}, the first is line 4:"))
            );
        }
        let long = [b"t_s,p_kpa\n0,5\n1,10\n".as_slice(), &[b'7'; 10_000], b"\n\xff,20\n3,30\n"].concat();
        let (rows, marks, _) = answer(&robot(""), &long);
        assert_eq!((marks.join(" "), &rows[3][1..], &rows[4][1..]), ("  line line ".to_string(), ten, thirty));
        let (rows, marks, _) = answer(&robot(""), b"t_s,p_kpa\nnan,nan\n1,10\n");
        assert_eq!((marks.join(" "), &rows[0][1..], &rows[1][1..]), ("clock ".to_string(), none, ten));
        let (rows, marks, _) = answer(&robot(""), b"t_s,p_body_kpa,p_kpa\n0,2,5\n1,-0.02,10\n");
        assert_eq!((marks.join(" "), &rows[1][1..]), (" held".to_string(), ten));
    }

    #[test]
    fn a_clock_that_begins_again_goes_on_after_a_few_late_lines() {
        let text: String =
            (0..10).map(|k| format!("{},{k}\n", 100 + k)).chain((0..10).map(|k| format!("{k},30\n"))).collect();
        let (rows, marks, _) = answer(&robot(""), format!("t_s,p_kpa\n{text}").as_bytes());
        let late = marks.iter().filter(|mark| *mark == "clock").count();
        assert_eq!((late, rows[14][4], rows[15][4], rows[15][0], rows[19][0]), (5, 9.0, 30.0, 110.0, 114.0));
    }

    #[test]
    fn pressures_and_poses_beyond_the_limits_are_warned_of_as_predict_does() {
        let (_, marks, notes) = answer(&robot(""), b"t_s,p_kpa\n0,5\n1,500\n2,600\n");
        let notes = notes.unwrap().join("\n");
        assert!(marks[0].is_empty() && marks[1..].iter().all(|mark| mark.contains("limit")), "{marks:?}");
        assert!(
            notes.contains("warning: 600 kPa is above max_pressure_kpa = ") && notes.contains("2 of 3 lines"),
            "{notes}"
        );
        let loaded = |robot: Scenario, newton: f64| {
            let heavy = robot.with_effect("tip_load", &[0.0, newton]);
            let (rows, marks, notes) = answer(&heavy, b"t_s,p_kpa\n0,0\n1,0\n");
            (rows[1][2], marks.join(" "), notes.unwrap().join("\n"))
        };
        let (y_mm, marks, notes) = loaded(robot("").with_bending(50.0), -2.0);
        assert!(y_mm < 0.0 && marks == "beyond beyond" && notes.contains("do not trust this pose"), "{marks}: {notes}");
        let (y_mm, marks, notes) = loaded(robot(""), -40.0);
        assert!(y_mm.is_nan() && marks == "unsolved unsolved" && notes.contains("no equilibrium"), "{marks}: {notes}");
    }

    #[test]
    fn a_header_that_is_not_understood_is_refused() {
        for (header, words) in [
            ("", "nothing came in"),
            ("0,5", "`0` has no unit"),
            ("t_s,p_furlong", "unknown unit"),
            ("t_s,p2_kpa", "nothing is supplied by channel 2"),
            ("t_s,t_s", "comes twice"),
            ("p_kpa", "column t_s is missing"),
            ("t_s", "has a pressure"),
            (&"t".repeat(5000), "longer than 4096"),
        ] {
            let (rows, _, notes) = answer(&robot(""), header.as_bytes());
            assert!(rows.is_empty() && notes.as_ref().unwrap_err().contains(words), "{header}: {notes:?}");
        }
    }
}
