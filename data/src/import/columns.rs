//! Names of columns as people write them: `x_a_mm`, `a - X (cm)`, `Time [ms]`, `p_act_kpa`, `Pressure (bar)`.

use std::ops::Range;

use super::layout::{LIKELIHOOD, PARTS};
use super::options::ImportOptions;
use super::recording::Lengths;
use super::sheet::CellText;
use crate::error::Result;
use crate::units::MeasuredQuantity;

#[derive(Debug, Clone, PartialEq)]
pub(crate) struct ColumnName {
    base: String,
    /// Words in lower case, digits apart from letters, and their places in it.
    words: Vec<(String, Range<usize>)>,
    /// The unit as written, in lower case.
    pub unit: Option<String>,
}

/// Units by other names, with their SI value; frames and pixels have none.
const OTHER_NAMES: [(MeasuredQuantity, f64, &[&str]); 9] = [
    (MeasuredQuantity::Time, 1.0, &["sec", "secs", "second", "seconds"]),
    (MeasuredQuantity::Time, 1e-3, &["msec", "milliseconds", "millis"]),
    (MeasuredQuantity::Time, 1e-6, &["micros", "µs"]),
    (MeasuredQuantity::Length, 1e-3, &["millimeters", "millimetres"]),
    (MeasuredQuantity::Length, 1e-2, &["centimeters", "centimetres"]),
    (MeasuredQuantity::Length, 1.0, &["meters", "metres"]),
    (MeasuredQuantity::Length, 1e-6, &["micron", "µm", "um"]),
    (MeasuredQuantity::Length, 0.0254, &["in"]),
    (MeasuredQuantity::Pressure, 1e2, &["mbar", "hpa"]),
];

/// SI value of a unit, if it is one of this dimension.
pub(crate) fn si(unit: &str, dimension: MeasuredQuantity) -> Option<f64> {
    let is_named = |(of, _, names): &&(MeasuredQuantity, f64, &[&str])| *of == dimension && names.contains(&unit);
    let named = || OTHER_NAMES.iter().find(is_named).map(|(_, factor, _)| *factor);
    dimension.unit(unit).map(|unit| unit.factor()).or_else(named)
}

pub(crate) fn is_pixel(unit: &str) -> bool {
    matches!(unit, "px" | "pixel" | "pixels")
}

pub(crate) fn is_frame(unit: &str) -> bool {
    matches!(unit, "frame" | "frames")
}

pub(super) fn is_unit(word: &str) -> bool {
    let dimensions = [MeasuredQuantity::Length, MeasuredQuantity::Time, MeasuredQuantity::Pressure];
    is_pixel(word) || is_frame(word) || dimensions.into_iter().any(|dimension| si(word, dimension).is_some())
}

impl ColumnName {
    pub(super) fn of(text: &str) -> ColumnName {
        let text = text.trim();
        let (base, bracket) = match text.find(['(', '[']) {
            Some(at) if text.ends_with([')', ']']) => {
                (&text[..at], Some(text[at + 1..text.len() - 1].trim().to_lowercase()))
            }
            _ => (text, None),
        };
        let mut words = words(base);
        let ends_with_unit = words.len() > 1 && words.last().is_some_and(|(word, _)| is_unit(word));
        let last = words.pop_if(|_| bracket.is_none() && ends_with_unit).map(|(word, _)| word);
        let end = words.last().map_or(0, |(_, at)| at.end);
        ColumnName { base: base[..end].to_string(), words, unit: bracket.or(last) }
    }

    pub(super) fn is(&self, name: &str) -> bool {
        self.words.iter().map(|(word, _)| word.as_str()).eq(name.split('_'))
    }

    fn word(&self) -> Option<&str> {
        Some(self.words.as_slice()).filter(|words| words.len() == 1).map(|words| words[0].0.as_str())
    }

    pub(super) fn is_any(&self, names: &[&str]) -> bool {
        names.iter().any(|name| self.is(name))
    }

    pub(super) fn has(&self, any: &[&str]) -> bool {
        self.words.iter().any(|(word, _)| any.contains(&word.as_str()))
    }

    /// The part of [`PARTS`] and the name of the marker of a column such as `x_tip`, `tip.x`, `x1` or `tip_score`.
    pub(super) fn coordinate(&self) -> Option<(usize, String)> {
        let part = |word: &str| match word {
            "score" | "confidence" => Some(LIKELIHOOD),
            _ => PARTS.iter().position(|part| *part == word),
        };
        let mut found = self.words.iter().filter_map(|(word, at)| Some((part(word)?, at)));
        let (part, at) = found.next().filter(|_| found.next().is_none())?;
        let around = [&self.base[..at.start], &self.base[at.end..]];
        let around = around.map(|part| part.trim_matches(|c: char| !c.is_alphanumeric()));
        let marker: Vec<&str> = around.into_iter().filter(|part| !part.is_empty()).collect();
        Some((part, marker.join("_")))
    }

    /// The name of the marker of a coordinate or likelihood; empty without one.
    fn marker(&self) -> String {
        self.coordinate().map_or(String::new(), |(_, marker)| marker)
    }
}

/// Letters and digits parted by anything else and from each other, in lower case, and where they stand.
fn words(text: &str) -> Vec<(String, Range<usize>)> {
    let mut words: Vec<(String, Range<usize>)> = Vec::new();
    let mut before = ' ';
    for (at, c) in text.char_indices() {
        if c.is_alphanumeric() {
            let same = before.is_alphanumeric() && before.is_ascii_digit() == c.is_ascii_digit();
            if !same {
                words.push((String::new(), at..at));
            }
            if let Some((word, place)) = words.last_mut() {
                word.extend(c.to_lowercase());
                place.end = at + c.len_utf8();
            }
        }
        before = c;
    }
    words
}

/// What the columns of a table are, for tables whose names no program fixes.
#[derive(Debug, Default)]
pub(crate) struct Roles {
    /// Column of the time and its seconds, or `None` for frames.
    pub time: Option<(usize, Option<f64>)>,
    pub run: Option<usize>,
    pub actuator: Option<usize>,
    pub marker: Option<usize>,
    /// Body's and actuator's pressure, with their pascals.
    pub pressures: [Option<(usize, f64)>; 2],
    /// Column, marker and part of every coordinate and likelihood, the part as in [`PARTS`].
    pub columns: Vec<(usize, String, usize)>,
    /// Units of the coordinates.
    pub units: Vec<Option<String>>,
    /// The largest likelihood that there is.
    pub most_likely: Option<f64>,
    /// Names of columns that nothing is known of.
    pub unused: Vec<String>,
    pub told: Vec<String>,
}

/// Quantities that a column can be said to hold.
pub const QUANTITIES: [&str; 11] =
    ["run", "actuator", "marker", "t", "frame", "p_act", "p_body", "x", "y", "z", "likelihood"];

impl Roles {
    pub(super) fn of(sheet: &CellText, line: u64, header: &[&str], options: &ImportOptions) -> Result<Roles> {
        let mut roles = Roles::default();
        // A quantity that was given a column of this table has no other.
        let is_named = |quantity: &&str| {
            let column = options.column(quantity);
            column.is_some_and(|column| header.iter().any(|name| name.eq_ignore_ascii_case(column)))
        };
        for (index, text) in header.iter().copied().enumerate() {
            let name = ColumnName::of(text);
            let said = options.columns.iter().find(|(_, column)| column.eq_ignore_ascii_case(text));
            let quantity = match said {
                Some((said, _)) => QUANTITIES.into_iter().find(|quantity| quantity == said),
                None => meaning(&name).filter(|quantity| !is_named(quantity)),
            };
            match quantity {
                Some(quantity) => roles.take(sheet, line, [quantity, text], index, &name, options)?,
                None if text.is_empty() => {}
                None => roles.unused.push(text.to_string()),
            }
        }
        if !roles.unused.is_empty() {
            roles.told.push(format!("columns that are not used: {}", roles.unused.join(", ")));
        }
        Ok(roles)
    }

    fn take(
        &mut self,
        sheet: &CellText,
        line: u64,
        [quantity, text]: [&str; 2],
        index: usize,
        name: &ColumnName,
        options: &ImportOptions,
    ) -> Result<()> {
        let unit = name.unit.as_deref();
        let taken = match quantity {
            "t" | "frame" => {
                let frames = quantity == "frame" || unit.is_some_and(is_frame);
                if frames && self.time.is_some() {
                    return Ok(());
                }
                // `millis` is a name and a unit.
                let seconds = unit.or(name.word()).and_then(|unit| si(unit, MeasuredQuantity::Time));
                if !frames && seconds.is_none() {
                    self.told.push(format!("column {text} names no unit of time: taken as seconds"));
                }
                let second = (!frames).then_some(seconds.unwrap_or(1.0));
                // Seconds are better than numbers of frames.
                self.time.replace((index, second)).is_some_and(|(_, before)| before.is_some())
            }
            "run" => self.run.replace(index).is_some(),
            "actuator" => self.actuator.replace(index).is_some(),
            "marker" => self.marker.replace(index).is_some(),
            "p_body" | "p_act" => {
                let (named, given) =
                    (unit.and_then(|unit| si(unit, MeasuredQuantity::Pressure)), options.pressure_unit_pa);
                if named.is_some() && given.is_some() && named != given {
                    self.told.push(format!("column {text} names its unit: --pressure-unit was not used for it"));
                }
                let Some(pa) = named.or(given) else {
                    let message = format!("the pressure column {text} names no unit");
                    let help = "say it: --pressure-unit kPa (or Pa, MPa, bar, mbar, psi)";
                    return Err(sheet.fault(line, message, help));
                };
                self.pressures[usize::from(quantity == "p_act")].replace((index, pa)).is_some()
            }
            "likelihood" => {
                // Scores of peaks may be above one.
                let most = if name.has(&["score"]) { f64::INFINITY } else { 1.0 };
                self.most_likely = Some(self.most_likely.map_or(most, |before| before.max(most)));
                self.columns.push((index, name.marker(), LIKELIHOOD));
                false
            }
            _ => {
                let named = PARTS[..LIKELIHOOD].iter().position(|axis| *axis == quantity);
                let axis = named.or(name.coordinate().map(|(part, _)| part)).unwrap_or(0);
                self.columns.push((index, name.marker(), axis));
                self.units.push(name.unit.clone());
                false
            }
        };
        if !taken {
            return Ok(());
        }
        let message = format!("two columns hold the {quantity}, the second is {text}");
        let help = format!("say which one: --map {quantity}={text}");
        Err(sheet.fault(line, message, help))
    }

    /// What to type if columns of numbers that are not used, of a table with a time, are pressures.
    pub(super) fn maybe_pressures(sheet: &CellText, options: &ImportOptions) -> Option<String> {
        let [header, row] = <[_; 2]>::try_from(sheet.head(2)).ok()?;
        let roles = Roles::of(sheet, 1, &header, options).ok().filter(|roles| roles.time.is_some())?;
        let is_number = |name: &&String| {
            let at = header.iter().position(|known| known == name);
            at.and_then(|at| row.get(at)).is_some_and(|cell| sheet.number(cell).is_some())
        };
        let is_body = |name: &&String| ColumnName::of(name).has(&BODY);
        let (body, act): (Vec<&String>, Vec<&String>) = roles.unused.iter().filter(is_number).partition(is_body);
        let missing =
            [("p_act", &act, 1), ("p_body", &body, 0)].into_iter().filter(|(.., k)| roles.pressures[*k].is_none());
        let typed = missing.filter_map(|(quantity, names, _)| Some(format!("{quantity}={}", names.first()?)));
        let typed = typed.collect::<Vec<_>>().join(",");
        (!typed.is_empty()).then(|| format!("; or, if the file has it, name its column: --map {typed}"))
    }

    pub(super) fn lengths(&self, sheet: &CellText, line: u64) -> Result<Lengths> {
        let mut units = self.units.iter().map(Option::as_deref);
        let Some(first) = units.next().flatten() else { return Ok(Lengths::Unsaid) };
        if let Some(other) = units.find(|unit| *unit != Some(first)) {
            let message = format!("coordinates are in {first} and in {}", other.unwrap_or("no unit"));
            return Err(sheet.fault(line, message, "export all coordinates in one unit"));
        }
        let message = format!("{first} is not a known unit of length");
        lengths(first).ok_or_else(|| sheet.fault(line, message, "give it: --scale mm"))
    }
}

pub(crate) fn lengths(unit: &str) -> Option<Lengths> {
    if is_pixel(unit) { Some(Lengths::Pixels) } else { si(unit, MeasuredQuantity::Length).map(Lengths::Metres) }
}

/// Names of a column of times.
const TIMES: &str = "t time timestamp ms millis micros date_time datetime date_and_time time_stamp arrival_time";

pub(super) fn is_time(name: &ColumnName) -> bool {
    TIMES.split(' ').any(|time| name.is(time))
}

/// Words for the body.
const BODY: [&str; 3] = ["body", "base", "tube"];

/// What a column with a telling name holds.
fn meaning(name: &ColumnName) -> Option<&'static str> {
    let in_pressure = name.unit.as_deref().is_some_and(|unit| si(unit, MeasuredQuantity::Pressure).is_some());
    let (pressure, coordinate) = (in_pressure || name.has(&["p", "pressure"]), name.coordinate());
    match name {
        _ if name.has(&["gauge"]) => None,
        _ if is_time(name) => Some("t"),
        _ if name.is_any(&["frame", "frame_idx", "frame_number", "fnum"]) => Some("frame"),
        _ if name.is_any(&["run", "trial"]) => Some("run"),
        _ if name.is("actuator") => Some("actuator"),
        _ if name.is_any(&["marker", "marker_name", "bodypart", "particle"]) => Some("marker"),
        _ if name.is("pb") || pressure && name.has(&BODY) => Some("p_body"),
        _ if name.is("pa") || pressure && coordinate.is_none() => Some("p_act"),
        _ => coordinate.map(|(part, _)| PARTS[part]),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_taken_apart_as_people_write_them() {
        let found = |text: &str| (ColumnName::of(text).coordinate(), ColumnName::of(text).unit);
        let a = |axis: usize, name: &str| Some((axis, name.to_string()));
        let unit = |text: &str| Some(text.to_string());
        assert_eq!(found("x_a_mm"), (a(0, "a"), unit("mm")));
        assert_eq!(found("a - Y (cm)"), (a(1, "a"), unit("cm")));
        assert_eq!(found("x12"), (a(0, "12"), None));
        assert_eq!(found("Tip.Z [px]"), (a(2, "Tip"), unit("px")));
        assert_eq!(found("P1_x"), (a(0, "P1"), None));
        assert_eq!((found("tip_score"), found("likelihood1")), ((a(3, "tip"), None), (a(3, "1"), None)));
        assert_eq!((ColumnName::of("Time (ms)").unit, ColumnName::of("p_act_kpa").is("p_act")), (unit("ms"), true));
        assert!(
            ColumnName::of("m").unit.is_none()
                && ColumnName::of("x1_mm").coordinate() == a(0, "1")
                && ColumnName::of("frame").is("frame")
        );
        assert_eq!(
            (
                si("ms", MeasuredQuantity::Time),
                si("ms", MeasuredQuantity::Length),
                si("micron", MeasuredQuantity::Length)
            ),
            (Some(1e-3), None, Some(1e-6))
        );
    }
}
