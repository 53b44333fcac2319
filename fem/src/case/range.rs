//! Values as typed: numbers → SI, texts, switches; refused where they cannot be meant, with the words for it.

use crate::problem::Amplitude;
use crate::vec3::V3;
use crate::{FemError, Result};
use spelling::Exactly;
pub(crate) use spelling::units::Range;
use std::collections::BTreeMap;
use std::ops::Range as Span;
use toml::{Spanned, Value};

pub(crate) type Checked<T> = Result<T>;
pub(crate) type Num = Spanned<f64>;
pub(crate) type Text = Spanned<String>;
/// Rows of time \[s\] and values, if they are there.
pub(crate) type TimeRows<const N: usize> = Option<Spanned<Vec<Exactly<N>>>>;
/// A table whose keys depend on one of its values: a mesh generator, a fabric law.
pub(crate) type FreeTable = BTreeMap<Text, Spanned<Value>>;

pub(crate) const LENGTH: Range = Range::LENGTH;
pub(crate) const THICKNESS: Range = Range {
    low: 0.002,
    high: 20.0,
    too_small: "this looks like metres: write millimetres, for example 0.2 for 200 µm",
    too_large: "this looks like micrometres: write millimetres, for example 0.2 for 200 µm",
    ..LENGTH
};
pub(crate) const GAP: Range = Range { low: 1e-5, high: 10.0, ..THICKNESS };
pub(crate) const POSITION: Range =
    Range { low: -1e5, too_small: "any number of this size is accepted with its sign", ..LENGTH };
pub(crate) const PRESSURE: Range = Range::PRESSURE;
/// Gauge pressures of a chamber, below the room's too.
pub(crate) const GAUGE: Range =
    Range { low: -1000.0, too_small: "this looks like pascals: write kilopascals, -101.325 is a vacuum", ..PRESSURE };
pub(crate) const ATMOSPHERE: Range = Range {
    low: 1.0,
    high: 1000.0,
    too_small: "this looks like bar: write kilopascals, for example 101.325",
    too_large: "this looks like pascals: write kilopascals, for example 101.325",
    ..PRESSURE
};
pub(crate) const TIME: Range = Range {
    unit: "s",
    too_small: "time starts at 0",
    ..plain(0.0, 1000.0, "this looks like milliseconds: write seconds")
};
pub(crate) const DENSITY: Range = Range {
    unit: "kg/m³",
    too_small: "this looks like g/cm³ or kg/m²: write kg/m³, for example 1140 for nylon; kg/m² over the thickness in m",
    ..plain(50.0, 20_000.0, "write kg/m³, for example 1140 for nylon")
};
pub(crate) const ANGLE: Range = Range { si: std::f64::consts::PI / 180.0, ..plain(-360.0, 360.0, "write degrees") };

pub(crate) const fn plain(low: f64, high: f64, usual: &'static str) -> Range {
    Range::plain(low, high, usual)
}

/// A refusal: the fault, what to type, and where.
pub(crate) fn refuse<T>(message: impl AsRef<str>, help: impl AsRef<str>, span: Span<usize>) -> Checked<T> {
    Err(FemError::case(format!("{}\n{}", message.as_ref(), help.as_ref()), span))
}

/// Refuses two ways to say one thing.
pub(crate) fn at_once<T>(what: &str, span: Span<usize>) -> Checked<T> {
    refuse(format!("{what} at once"), "keep one of the two", span)
}

pub(crate) fn si(key: &str, value: &Num, range: &Range) -> Checked<f64> {
    number(key, *value.get_ref(), value.span(), range)
}

/// A number in SI; an error points to `span`, the larger entry that contains it.
pub(crate) fn number(key: &str, v: f64, span: Span<usize>, range: &Range) -> Checked<f64> {
    range.si(key, v).or_else(|(message, help)| refuse(message, help, span))
}

/// A number that may be left out.
pub(crate) fn optional(key: &str, value: &Option<Num>, range: &Range) -> Checked<Option<f64>> {
    value.as_ref().map(|v| si(key, v, range)).transpose()
}

pub(crate) fn vector(key: &str, value: &Spanned<Exactly<3>>, range: &Range) -> Checked<V3> {
    let Exactly([x, y, z]) = *value.get_ref();
    let one = |v: f64| number(key, v, value.span(), range);
    Ok([one(x)?, one(y)?, one(z)?])
}

/// A direction: three numbers, not all zero.
pub(crate) fn direction(key: &str, value: &Spanned<Exactly<3>>) -> Checked<V3> {
    let v = vector(key, value, &plain(-1e6, 1e6, "for example [0, 0, 1]"))?;
    match v.iter().all(|x| x.abs() < 1e-9) {
        true => refuse(format!("{key} has no direction: {v:?}"), "write for example [0, 0, 1]", value.span()),
        false => Ok(v),
    }
}

/// The amplitude that is given, if any; never two at once.
pub(crate) fn amplitude(smooth: &TimeRows<2>, linear: &TimeRows<2>, range: &Range) -> Checked<Option<Amplitude>> {
    Ok(amplitudes(smooth, linear, range)?.and_then(|mut one| one.pop()))
}

/// The same, one for every column behind the times.
pub(crate) fn amplitudes<const N: usize>(
    smooth: &TimeRows<N>,
    linear: &TimeRows<N>,
    range: &Range,
) -> Checked<Option<Vec<Amplitude>>> {
    let (rows, kind): (_, fn(_) -> Amplitude) = match (smooth, linear) {
        (Some(_), Some(second)) => {
            return at_once("a smooth and a linear curve", second.span());
        }
        (Some(rows), None) => (rows, Amplitude::Smooth),
        (None, Some(rows)) => (rows, Amplitude::Linear),
        (None, None) => return Ok(None),
    };
    let times: Vec<f64> = rows.get_ref().iter().map(|row| row.0[0]).collect();
    rising(&times, rows.span())?;
    let value = |v: f64| number("a number of a row", v, rows.span(), range);
    let column = |k: usize| rows.get_ref().iter().map(|row| Ok((row.0[0], value(row.0[k])?))).collect::<Checked<_>>();
    (1..N).map(|k| column(k).map(kind)).collect::<Checked<_>>().map(Some)
}

/// Times of a curve: at least two, from 0 on, each later than the one before.
fn rising(times: &[f64], span: Span<usize>) -> Checked<()> {
    if times.len() < 2 {
        let help = "write for example [[0, 0], [0.05, 5]]: time in s, value";
        return refuse("a curve needs two rows at least", help, span);
    }
    times.iter().try_for_each(|t| number("the time of a row", *t, span.clone(), &TIME).map(|_| ()))?;
    let Some(pair) = times.windows(2).find(|pair| pair[1] <= pair[0]) else { return Ok(()) };
    let message = format!("the times of a curve must rise: {} s comes after {} s", pair[1], pair[0]);
    refuse(message, "sort the rows, and write each time once", span)
}

pub(crate) fn choice<T: Copy>(what: &str, text: &Spanned<String>, known: &[(&str, T)]) -> Checked<T> {
    match known.iter().find(|(name, _)| name == text.get_ref()) {
        Some((_, value)) => Ok(*value),
        None => Err(unknown_name(what, text, &known.iter().map(|k| k.0).collect::<Vec<_>>())),
    }
}

/// A name that is not among the known ones.
pub(crate) fn unknown_name(what: &str, text: &Spanned<String>, known: &[&str]) -> FemError {
    FemError::case(unknown(what, text.get_ref(), known), text.span())
}

/// The known word that was probably meant: a slip away, or the beginning of just one.
pub(crate) fn nearest<'a>(wrong: &str, known: &[&'a str]) -> Option<&'a str> {
    // The same word with another unit or none: `smooth` or `side_m` for `side_mm`.
    let stem = wrong.rsplit_once('_').map_or(wrong, |(stem, _)| stem);
    let begun = || known.iter().filter(|known| stem.len() >= 3 && known.starts_with(stem)).copied();
    spelling::nearest(wrong, known.iter().copied()).or_else(|| begun().next().filter(|_| begun().count() == 1))
}

pub(crate) fn text(key: &str, value: &Spanned<Value>) -> Checked<Text> {
    match value.get_ref() {
        Value::String(text) => Ok(Spanned::new(value.span(), text.clone())),
        other => {
            let message = format!("{key} must be a text, not {}", kind(other));
            let help = "write it in quotation marks";
            refuse(message, help, value.span())
        }
    }
}

/// A number, not a text or a table.
pub(crate) fn plain_number(key: &str, value: &Spanned<Value>) -> Checked<f64> {
    match value.get_ref() {
        Value::Float(v) => Ok(*v),
        Value::Integer(v) => Ok(*v as f64),
        other => {
            let message = format!("{key} must be a number, not {}", kind(other));
            let help = "write a plain number without quotation marks; the unit is in the name of the key";
            refuse(message, help, value.span())
        }
    }
}

fn kind(value: &Value) -> &'static str {
    match value {
        Value::String(_) => "a text",
        Value::Array(_) => "a list",
        Value::Boolean(_) => "true or false",
        Value::Table(_) => "a table",
        Value::Datetime(_) => "a date",
        Value::Float(_) | Value::Integer(_) => "a number",
    }
}

/// Value of a key that has a word or a list, if it is there.
pub(crate) fn find<'a>(table: &'a FreeTable, wanted: &str) -> Option<&'a Spanned<Value>> {
    table.iter().find(|(key, _)| key.get_ref() == wanted).map(|(_, value)| value)
}

/// A switch; `without` describes what happens without it.
pub(crate) fn switch(name: &str, value: &Spanned<Value>, without: &str) -> Checked<bool> {
    let refused = || refuse(format!("{name} must be true or false"), format!("leave it out: {without}"), value.span());
    value.get_ref().as_bool().map_or_else(refused, Ok)
}

/// Message for an unknown name: it lists the known names and the one probably meant.
pub(crate) fn unknown(what: &str, wrong: &str, known: &[&str]) -> String {
    let list = known.join(", ");
    match nearest(wrong, known) {
        Some(meant) => format!("unknown {what} `{wrong}`; known here: {list}\ndid you mean `{meant}`?"),
        None if known.is_empty() => format!("unknown {what} `{wrong}`\nremove it: nothing is expected here"),
        None => format!("unknown {what} `{wrong}`\nknown here: {list}"),
    }
}

/// One number of a table that describes an `S`.
#[derive(Debug)]
pub struct DeclaredKey<S: 'static> {
    /// Name with unit, as in the file.
    pub name: &'static str,
    /// Factor from the file to SI.
    pub si: f64,
    /// Accepted numbers, as in the file.
    pub bounds: [f64; 2],
    /// Meaning, and usual values.
    pub meaning: &'static str,
    /// Reads it \[SI\], if it is set.
    pub get: fn(&S) -> Option<f64>,
    /// Writes the number \[SI\] into an `S`.
    pub set: fn(&mut S, f64),
}

pub(crate) const fn key<S>(
    name: &'static str,
    si: f64,
    bounds: [f64; 2],
    meaning: &'static str,
    get: fn(&S) -> Option<f64>,
    set: fn(&mut S, f64),
) -> DeclaredKey<S> {
    DeclaredKey { name, si, bounds, meaning, get, set }
}

impl<S> DeclaredKey<S> {
    pub(crate) fn read(&self, to: &mut S, value: &Spanned<Value>) -> Checked<()> {
        let [low, high] = self.bounds;
        let range = Range { si: self.si, ..plain(low, high, self.meaning) };
        let si = number(self.name, plain_number(self.name, value)?, value.span(), &range)?;
        if self.name == "seed" && si.fract() != 0.0 {
            let message = format!("seed must be a whole number, not {si}");
            let help = "write for example 1";
            return refuse(message, help, value.span());
        }
        if self.name == "mass_passes" && ![2.0, 4.0, 6.0].contains(&si) {
            let message = format!("mass_passes cannot be {si}");
            let help = "write 2, 4 or 6";
            return refuse(message, help, value.span());
        }
        (self.set)(to, si);
        Ok(())
    }
}

pub(crate) fn named<S>(keys: &'static [DeclaredKey<S>], name: &str) -> Option<&'static DeclaredKey<S>> {
    keys.iter().find(|key| key.name == name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slips_of_the_finger_are_recognised_and_other_words_are_not() {
        let known = ["side_mm", "elements", "smooth_s_kPa"];
        for (wrong, meant) in [("sdie_mm", "side_mm"), ("side_m", "side_mm"), ("Elements", "elements")] {
            assert_eq!(nearest(wrong, &known), Some(meant), "{wrong}");
        }
        assert_eq!(nearest("smooth", &known), Some("smooth_s_kPa"));
        assert_eq!(nearest("radius_mm", &known), None);
        assert_eq!(nearest("", &[]), None);
    }
}
