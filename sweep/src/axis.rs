//! A key that varies, and its values.

use crate::policy::MOST_CASES;
use compare::ScenarioFile;
use fem::FemError;
use fem::robot::Spread;
use fem::session::{Felt, Source, felt, rounded};
use serde::Deserialize;
use std::path::Path;
use toml::Value;

/// A key that varies.
#[derive(Debug, Clone, PartialEq)]
pub struct Axis {
    /// Place in the scenario, such as `actuator.width_mm`, or `pressure_kpa`.
    pub key: String,
    pub(crate) levels: Levels,
}

#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Levels {
    Listed(Vec<Value>),
    Between { from: f64, to: f64, log: bool },
}

impl Axis {
    /// Whether all of it are pressures.
    pub(crate) fn is_pressure(&self) -> bool {
        let fits = |kpa: f64| kpa.is_finite() && kpa >= 0.0;
        match &self.levels {
            Levels::Listed(all) => all.iter().all(|value| as_number(value).is_some_and(fits)),
            Levels::Between { from, to, .. } => fits(*from) && fits(*to),
        }
    }

    /// The value at a share of the range, from 0 to below 1; of a list every entry has an equal share.
    pub(crate) fn at(&self, share: f64) -> Value {
        match &self.levels {
            Levels::Listed(all) => all[((share * all.len() as f64) as usize).min(all.len() - 1)].clone(),
            Levels::Between { from, to, log } => number(between(*from, *to, *log, share)),
        }
    }

    /// Entries of a list; `None` for a range.
    pub(crate) fn entries(&self) -> Option<usize> {
        match &self.levels {
            Levels::Listed(all) => Some(all.len()),
            Levels::Between { .. } => None,
        }
    }

    /// The value at a share with so many digits, within the range; entries of lists as they are.
    pub(crate) fn rounded(&self, share: f64, digits: usize) -> Value {
        match (&self.levels, as_number(&self.at(share))) {
            (Levels::Between { from, to, .. }, Some(exact)) => {
                let rounded: f64 = format!("{exact:.*e}", digits - 1).parse().unwrap_or(exact);
                number(rounded.clamp(from.min(*to), from.max(*to)))
            }
            _ => self.at(share),
        }
    }

    /// The share of a value of a range.
    pub(crate) fn share_of(&self, value: &Value) -> Option<f64> {
        match (&self.levels, as_number(value)?) {
            (Levels::Between { from, to, log: true }, value) => Some((value / from).ln() / (to / from).ln()),
            (Levels::Between { from, to, .. }, value) => Some((value - from) / (to - from)),
            _ => None,
        }
        .filter(|share| share.is_finite())
    }
}

fn between(from: f64, to: f64, log: bool, share: f64) -> f64 {
    match log {
        true => from * (to / from).powf(share),
        false => from + (to - from) * share,
    }
}

/// Whole numbers are written as such: a count is one, and a length may be.
fn number(value: f64) -> Value {
    let whole = value.fract() == 0.0 && value.abs() < 1e15;
    if whole { Value::Integer(value as i64) } else { Value::Float(value) }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawAxis {
    key: String,
    values: Option<Vec<Value>>,
    from: Option<f64>,
    to: Option<f64>,
    steps: Option<usize>,
    #[serde(default)]
    log: bool,
}

/// An axis for every number that nobody measured and that the finite elements of this robot feel, but for those that vary anyway.
pub(crate) fn assumed(base: &ScenarioFile, folder: &Path, axes: &[Axis]) -> Result<Vec<Axis>, FemError> {
    let known: Vec<&str> = axes.iter().filter_map(|axis| axis.key.strip_prefix("fem.")).collect();
    let source = Source { text: base.text.clone(), name: base.name.clone(), folder: folder.to_path_buf() };
    let of = |(number, key): Felt| {
        let [from, to] = number.interval.map(|si| rounded(si / key.si));
        Axis {
            key: format!("fem.{}", key.name),
            levels: Levels::Between { from, to, log: number.spread == Spread::Factor },
        }
    };
    Ok(felt(&source, &known)?.into_iter().map(of).collect())
}

/// A key with its values; with a sample ranges have no steps.
pub(crate) fn axis(raw: &RawAxis, sampled: bool) -> Result<Axis, (String, &'static str)> {
    let one_way = "write values = [40, 50], or from, to and steps";
    let key = raw.key.clone();
    if let Some(values) = &raw.values {
        if raw.from.is_some() || raw.to.is_some() || raw.steps.is_some() || values.is_empty() {
            return Err((format!("`{key}` has no single list of values"), one_way));
        }
        return Ok(Axis { key, levels: Levels::Listed(values.clone()) });
    }
    let (Some(from), Some(to)) = (raw.from, raw.to) else {
        return Err((format!("`{key}` has no values"), one_way));
    };
    if !from.is_finite() || !to.is_finite() || raw.log && (from <= 0.0 || to <= 0.0) {
        return Err((format!("`{key}` goes from {from} to {to}"), "write two numbers, above zero with log = true"));
    }
    let levels = match (raw.steps, sampled) {
        (None, true) => Levels::Between { from, to, log: raw.log },
        (None, false) => return Err((format!("`{key}` has no steps"), "add steps = 7, or a [sample]")),
        (Some(_), true) => return Err((format!("`{key}` has steps, but a sample draws between"), "leave steps out")),
        (Some(0), _) => return Err((format!("`{key}` has no step"), "write steps = 1 or more")),
        (Some(1), _) if from != to => {
            return Err((format!("`{key}` goes from {from} to {to} in one step"), "write steps = 2 or more"));
        }
        (Some(MOST_CASES..), _) => return Err((format!("`{key}` has too many steps"), "take fewer")),
        (Some(n), false) => {
            let at = |i: usize| match i {
                0 => from,
                i if i + 1 == n => to,
                i => between(from, to, raw.log, i as f64 / (n - 1) as f64),
            };
            Levels::Listed((0..n).map(|i| number(at(i))).collect())
        }
    };
    Ok(Axis { key, levels })
}

/// A value as a number, if it is one.
pub fn as_number(value: &Value) -> Option<f64> {
    match value {
        Value::Integer(whole) => Some(*whole as f64),
        Value::Float(number) => Some(*number),
        _ => None,
    }
}
