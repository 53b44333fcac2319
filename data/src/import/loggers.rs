//! Pressure logs of programs that write no plain table: each becomes one, with the numbers of its lines.

use super::columns::{ColumnName, is_time, is_unit};
use super::ros;
use crate::cells::clock_s;
use crate::error::{DataError, Result};

/// A log as rows of cells. A line of `text` that is not a row is empty, so its lines keep their numbers.
#[derive(Default)]
pub(super) struct Plain {
    /// Names of the columns; empty where a line of the text has them.
    pub names: Vec<String>,
    pub text: String,
    pub told: Vec<String>,
}

/// The text of a log as a table.
pub(super) fn plain(file: &str, text: String) -> Result<Plain> {
    let marked = text.trim_start_matches('\u{feff}');
    if marked.starts_with("LabVIEW Measurement") {
        return labview(file, marked);
    }
    if marked.starts_with("%time") {
        return Ok(topic(marked));
    }
    let [stamped, readings] = serial_shares(&text);
    if stamped >= MOSTLY || readings >= MOSTLY {
        return Ok(serial(&text, stamped >= MOSTLY, readings >= MOSTLY));
    }
    Ok(Plain { text, ..Plain::default() })
}

/// Line that ends each of the two headers of a LabVIEW measurement file.
const END_OF_HEADER: &str = "***End_of_Header***";

/// LabVIEW (.lvm): a header of the file, and segments that follow each other in time. A segment has a header of the channels with
/// their units, names, and rows of the time in seconds and values.
fn labview(file: &str, text: &str) -> Result<Plain> {
    let lines: Vec<&str> = text.lines().collect();
    let fault = |line: usize, message: &str, help: &str| Err(DataError::of(file, message, help).at_line(line as u64));
    let sign = if lines.iter().any(|line| line.starts_with("Separator,")) { ',' } else { '\t' };
    let first = |k: usize| lines[k].split(sign).next().unwrap_or_default().trim();
    let Some(end) = lines.iter().rposition(|line| line.starts_with(END_OF_HEADER)) else {
        let help = "write the file again with its headers";
        return fault(1, "the line ***End_of_Header*** is missing", help);
    };
    let heads: Vec<usize> = (0..lines.len()).filter(|k| first(*k) == "X_Value").collect();
    if heads.last().is_none_or(|at| *at < end) {
        let help = "write the file again with a header for every segment and one column of times";
        let message = "the line X_Value with the names of the channels is missing";
        return fault(end + 2, message, help);
    }
    let mut plain = Plain::default();
    let mut from = 0;
    for (segment, &at) in heads.iter().enumerate() {
        let names = channels(&lines[from..at], lines[at], sign);
        if names.iter().skip(1).any(|name| name == "X_Value") {
            let help = "write the file again with one time column only (X columns: one)";
            return fault(at + 1, "every channel has its own column of times", help);
        }
        if segment > 0 && names != plain.names {
            let message = "this segment has other channels, or other units, than the first";
            return fault(at + 1, message, "write every segment into a separate file");
        }
        plain.names = names;
        let is_header = |k: &usize| first(*k).starts_with(char::is_alphabetic);
        let next = heads.get(segment + 1).map(|next| (at + 1..*next).find(is_header).unwrap_or(*next));
        let end = next.unwrap_or(lines.len());
        plain.text.push_str(&"\n".repeat(at + 1 - from));
        rows(&lines[from..at], &lines[at + 1..end], sign, &mut plain.text);
        from = end;
    }
    let segments = if heads.len() > 1 { format!(" of {} segments", heads.len()) } else { String::new() };
    plain.told.push(format!("read as LabVIEW text{segments}"));
    Ok(plain)
}

/// The cells of the line of a LabVIEW header that begins with a key.
fn keyed<'t>(header: &[&'t str], key: &str, sign: char) -> Option<Vec<&'t str>> {
    let mut cells = header.iter().rev().map(|line| line.split(sign).map(str::trim).collect::<Vec<_>>());
    cells.find(|cells| cells[0] == key)
}

/// Names of the columns of a LabVIEW segment, with their units.
fn channels(header: &[&str], line: &str, sign: char) -> Vec<String> {
    let mut names: Vec<String> = line.split(sign).map(|cell| cell.trim().to_string()).collect();
    let units = keyed(header, "Y_Unit_Label", sign).unwrap_or_default();
    for (name, unit) in names.iter_mut().zip(&units).skip(1) {
        if !unit.is_empty() && ColumnName::of(name).unit.is_none() {
            *name = format!("{name} ({unit})");
        }
    }
    names[0] = "t_s".into();
    names.iter_mut().filter(|name| *name == "Comment").for_each(String::clear);
    names
}

/// The rows of a LabVIEW segment; without a column of times they are apart by Delta_X.
fn rows(header: &[&str], lines: &[&str], sign: char, text: &mut String) {
    let cell = |name: &str| Some(keyed(header, name, sign)?.get(1)?.replace(',', "."));
    let number = |name: &str| cell(name)?.parse::<f64>().ok();
    let (start, step) = (number("X0").unwrap_or(0.0), number("Delta_X").unwrap_or(f64::NAN));
    let mut count = 0;
    for line in lines {
        if !line.trim().is_empty() {
            if line.starts_with(sign) {
                text.push_str(&format!("{}", start + step * f64::from(count)));
            }
            count += 1;
            text.push_str(line);
        }
        text.push('\n');
    }
}

/// A topic of ROS, sensor_msgs/FluidPressure: pascals over nanoseconds since 1970.
fn topic(text: &str) -> Plain {
    let (head, rows) = text.split_once('\n').unwrap_or((text, ""));
    let names: Vec<&str> = head.trim().split(',').collect();
    let time = ros::stamp(&names);
    let name = |(k, name): (usize, &&str)| match *name {
        _ if k == time => "t_s".to_string(),
        "%time" => String::new(),
        name if name.ends_with("fluid_pressure") => format!("{name} (Pa)"),
        name => name.to_string(),
    };
    let told = vec!["read as a topic of ROS".to_string()];
    Plain { names: names.iter().enumerate().map(name).collect(), text: format!("\n{rows}"), told }
}

/// Lines looked at to know the text of a serial monitor, and the share of them that has its form.
const LOOKED_AT: usize = 40;
const MOSTLY: f64 = 0.6;
const ARROW: &str = "->";

/// A line without the time of its arrival, and that time.
fn arrival(line: &str) -> (Option<&str>, &str) {
    match line.split_once(ARROW) {
        Some((stamp, rest)) if clock_s(stamp.trim()).is_some() => (Some(stamp.trim()), rest.trim()),
        _ => (None, line.trim()),
    }
}

/// Shares of the first lines that have a time of arrival, and that are readings with names.
fn serial_shares(text: &str) -> [f64; 2] {
    let filled = text.lines().filter(|line| !line.trim().is_empty());
    let lines: Vec<(Option<&str>, &str)> = filled.take(LOOKED_AT).map(arrival).collect();
    let share =
        |has: fn(&&(Option<&str>, &str)) -> bool| lines.iter().filter(has).count() as f64 / lines.len().max(1) as f64;
    [share(|(stamp, _)| stamp.is_some()), share(|(_, rest)| readings(rest).is_some())]
}

/// What separates the cells of a line of a serial monitor.
const BETWEEN: [char; 4] = [',', ';', '\t', ' '];

fn tokens(line: &str) -> impl Iterator<Item = &str> {
    line.split(BETWEEN).filter(|token| !token.is_empty())
}

/// A serial monitor: `10:11:13.000 -> pb:2.00 pa:0.00`, `t: 12.3 p: 4.5 kPa`, or bare numbers after the time of arrival.
fn serial(text: &str, stamped: bool, named: bool) -> Plain {
    let (mut table, mut left_out) = (Plain::default(), 0);
    table.told.push("read as the text of a serial monitor".into());
    for line in text.lines() {
        let (stamp, rest) = arrival(line.trim_start_matches('\u{feff}'));
        let row: Option<Vec<String>> = match readings(rest).filter(|_| named) {
            Some(found) => {
                let columns: Vec<String> = found.iter().map(LoggerReading::column).collect();
                if table.names.is_empty() {
                    // The device's own time is better than the time of arrival.
                    let own = found.iter().any(|reading| is_time(&ColumnName::of(&reading.name)));
                    let arrival = if own { "arrival" } else { "time" };
                    let arrival = stamped.then(|| arrival.to_string());
                    table.names = arrival.into_iter().chain(columns.clone()).collect();
                }
                let same = columns == table.names[usize::from(stamped)..];
                same.then(|| found.into_iter().map(|reading| reading.value).collect())
            }
            None if named || rest.is_empty() => None,
            None => Some(tokens(rest).map(str::to_string).collect()),
        };
        match row.filter(|_| stamp.is_some() == stamped) {
            Some(row) => {
                let cells: Vec<String> = stamp.map(str::to_string).into_iter().chain(row).collect();
                table.text.push_str(&cells.join(","));
            }
            None => left_out += usize::from(!line.trim().is_empty()),
        }
        table.text.push('\n');
    }
    if left_out > 0 {
        let told = format!("left out: {left_out} lines without the readings of the others");
        table.told.push(told);
    }
    table
}

struct LoggerReading {
    name: String,
    value: String,
    unit: Option<String>,
}

impl LoggerReading {
    fn column(&self) -> String {
        let LoggerReading { name, unit, .. } = self;
        unit.as_ref().map_or(name.clone(), |unit| format!("{name} ({unit})"))
    }
}

/// The readings of a line, each `name: number unit` or `name=number`; none if it has anything else.
fn readings(line: &str) -> Option<Vec<LoggerReading>> {
    let mut parts = line.split([':', '=']).peekable();
    let mut name = parts.next()?.trim().to_string();
    let mut found = Vec::new();
    while let Some(part) = parts.next() {
        if !name.starts_with(char::is_alphabetic) || name.contains([',', ';']) {
            return None;
        }
        let mut tokens = tokens(part);
        let (value, glued) = number(tokens.next()?)?;
        let mut rest: Vec<&str> = tokens.collect();
        let last = parts.peek().is_none();
        let is_unit = |word: &&str| is_unit(&word.to_lowercase()) && (last || rest.len() > 1);
        let unit = Some(glued).filter(|glued| !glued.is_empty());
        let parted = rest.first().copied().filter(|word| unit.is_none() && is_unit(word));
        rest.drain(..usize::from(parted.is_some()));
        let (value, unit) = (value.to_string(), unit.or(parted).map(str::to_string));
        found.push(LoggerReading { name, value, unit });
        name = rest.join(" ");
        if last != name.is_empty() {
            return None;
        }
    }
    (!found.is_empty()).then_some(found)
}

/// A number and the unit glued to it.
fn number(token: &str) -> Option<(&str, &str)> {
    let mut parts = (0..=token.len()).rev().filter_map(|end| token.split_at_checked(end));
    let is_unit = |unit: &str| unit.is_empty() || is_unit(&unit.to_lowercase());
    parts.find(|(value, unit)| value.parse::<f64>().is_ok() && is_unit(unit))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rows(text: &str) -> (String, Vec<String>) {
        let plain = plain("log.txt", text.to_string()).unwrap();
        (plain.names.join(","), plain.text.lines().map(str::to_string).collect())
    }

    #[test]
    fn lines_of_a_serial_monitor_become_rows_with_names_and_units() {
        let (names, lines) = rows("Ready\nt: 12.3 p: 4.5\nt: 12.4 p: 4.6\nt: 12.5 p: 4.7\nt: 12.6 p\n");
        assert_eq!(
            (names.as_str(), lines),
            ("t,p", ["", "12.3,4.5", "12.4,4.6", "12.5,4.7", ""].map(String::from).to_vec())
        );
        let (names, lines) = rows("10:11:13.000 -> pb:2.00 kPa, pa:0.50kPa\n10:11:14.000 -> pb:2.00 kPa, pa:nankPa\n");
        assert_eq!((names.as_str(), lines[0].as_str()), ("time,pb (kPa),pa (kPa)", "10:11:13.000,2.00,0.50"));
        assert_eq!(lines[1], "10:11:14.000,2.00,nan");
        let (names, lines) =
            rows("10:11:13.000 -> millis=5 body pressure=2\n10:11:14.000 -> millis=6 body pressure=2\n");
        assert_eq!((names.as_str(), lines[1].as_str()), ("arrival,millis,body pressure", "10:11:14.000,6,2"));
        let (names, lines) = rows("10:11:13.000 -> 2.00 0.50\n10:11:14.000 -> 2.00\t0.50\n");
        assert_eq!((names.as_str(), lines[1].as_str()), ("", "10:11:14.000,2.00,0.50"));
        for table in ["t_s,p_kpa\n0,1\n", "Time;p\n10:11:12;3\n", "", "# a: b\nt,p\n1,2\n"] {
            let plain = plain("log.csv", table.to_string()).unwrap();
            assert_eq!((plain.text.as_str(), plain.names.len()), (table, 0));
        }
    }

    #[test]
    fn times_that_labview_leaves_out_are_apart_by_its_step() {
        let head = "LabVIEW Measurement\t\nSeparator\tTab\nX_Columns\tNo\n***End_of_Header***\t\n\nY_Unit_Label\tkPa\n\
                    X0\t1.0E+0\nDelta_X\t0.5\n***End_of_Header***\t\nX_Value\tp_act\tComment\n";
        let (names, lines) = rows(&format!("{head}\t2.0\t\n\t3.0\t\n"));
        assert_eq!(
            (names.as_str(), &lines[lines.len() - 2..]),
            ("t_s,p_act (kPa),", &["1\t2.0\t", "1.5\t3.0\t"].map(String::from)[..])
        );
        let error = |text: &str| plain("log.lvm", text.to_string()).err().unwrap().to_string();
        assert!(error("LabVIEW Measurement\n").contains("End_of_Header"));
        assert!(error(&head.replace("X_Value", "Value")).contains("X_Value"));
        assert!(error(&head.replace("p_act\t", "p_act\tX_Value\t")).contains("own column of times"));
    }
}
