//! A key that varies, and its values.

use crate::form::Wrong;
use crate::policy::MOST_CASES;
use compare::ScenarioFile;
use fem::FemError;
use fem::robot::ValueSpacing;
use fem::session::{Felt, felt, rounded};
use models::{CHANNELS, Model};
use serde::Deserialize;
use std::path::Path;
use toml::{Spanned, Value};

/// The key of the actuator pressure, which a scenario does not have.
pub const PRESSURE: &str = "pressure_kpa";

/// A share this close to an end is at it.
const AT_END: f64 = 1e-3;

/// Key of the scenario that varies, with its levels or range.
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

    /// The end of the range, or of a list of numbers, that a share is at, and a value beyond it: by a hundredth of the range, or by the
    /// step from the entry before.
    pub(crate) fn beyond(&self, share: f64) -> Option<(f64, Value)> {
        match &self.levels {
            Levels::Between { .. } => {
                let (end, out) = match share {
                    share if share < AT_END => (0.0, -0.01),
                    share if share > 1.0 - AT_END => (1.0, 1.01),
                    _ => return None,
                };
                Some((as_number(&self.at(end))?, self.at(out)))
            }
            Levels::Listed(all) => {
                let here = as_number(&self.at(share))?;
                let mut numbers = all.iter().map(as_number).collect::<Option<Vec<f64>>>()?;
                numbers.sort_by(f64::total_cmp);
                numbers.dedup();
                let from_end: Vec<f64> = match *numbers {
                    [.., last] if here == last => numbers.into_iter().rev().take(2).collect(),
                    [first, ..] if here == first => numbers.into_iter().take(2).collect(),
                    _ => return None,
                };
                let [end, before] = <[f64; 2]>::try_from(from_end).ok()?;
                Some((end, number(2.0 * end - before)))
            }
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

/// An axis for every unmeasured number that affects the finite elements of this robot, except the numbers that vary anyway.
pub(crate) fn assumed(base: &ScenarioFile, folder: &Path, axes: &[Axis]) -> Result<Vec<Axis>, FemError> {
    let known: Vec<&str> = axes.iter().filter_map(|axis| axis.key.strip_prefix("fem.")).collect();
    let of = |(number, key): Felt| {
        let [from, to] = number.interval.map(|si| rounded(si / key.si));
        Axis {
            key: format!("fem.{}", key.name),
            levels: Levels::Between { from, to, log: number.spread == ValueSpacing::Factor },
        }
    };
    Ok(felt(&base.source(folder), &known)?.into_iter().map(of).collect())
}

/// Whether a key is a pressure: of all channels, or of one.
pub(crate) fn channel(key: &str) -> Option<Option<usize>> {
    let rest = key.strip_prefix(PRESSURE)?;
    match rest.strip_prefix('.') {
        None => rest.is_empty().then_some(None),
        Some(number) => number.parse().ok().filter(|channel| *channel < CHANNELS).map(Some),
    }
}

/// Values set in a scenario, and the pressures of its channels if they are among the keys \[kPa\].
pub(crate) struct CaseChanges {
    pub values: Vec<(String, String)>,
    pub pressures_kpa: Option<[f64; CHANNELS]>,
}

impl CaseChanges {
    /// Of keys with their values. If only some channels have a pressure, the others get 0.
    pub(crate) fn of<'a>(all: impl Iterator<Item = (&'a Axis, Value)>) -> CaseChanges {
        let mut changes = CaseChanges { values: Vec::with_capacity(all.size_hint().0), pressures_kpa: None };
        for (axis, value) in all {
            match (channel(&axis.key), as_number(&value)) {
                (Some(None), Some(kpa)) => changes.pressures_kpa = Some([kpa; CHANNELS]),
                (Some(Some(one)), Some(kpa)) => changes.pressures_kpa.get_or_insert([0.0; CHANNELS])[one] = kpa,
                _ => changes.values.push((axis.key.clone(), value.to_string())),
            }
        }
        changes
    }
}

/// Keys with their values, each once; with a sample ranges have no steps.
pub(crate) fn axes(raw: &[Spanned<RawAxis>], sampled: bool, base: &ScenarioFile) -> Result<Vec<Axis>, Wrong> {
    let mut all: Vec<Axis> = Vec::new();
    for raw in raw {
        let wrong = |message: String, help| Err((Some(raw.span()), message, help));
        let axis = match axis(raw.get_ref(), sampled) {
            Ok(axis) => axis,
            Err((message, help)) => return wrong(message, help),
        };
        if all.iter().any(|other| other.key == axis.key) {
            return wrong(format!("`{}` is there twice", axis.key), "leave one of them out");
        }
        if models::scenario::moves_nothing(&axis.key) {
            return wrong(format!("`{}` moves nothing", axis.key), "vary a size, a pressure or a value of an effect");
        }
        if axis.key.ends_with(".pressures_kpa") {
            return wrong(format!("`{}` is a list of pressures", axis.key), "vary pressure_kpa");
        }
        if axis.key.starts_with(PRESSURE) && (channel(&axis.key).is_none() || !axis.is_pressure()) {
            let message = format!("`{}` is not a pressure, or has a value below zero", axis.key);
            return wrong(message, "write pressure_kpa, or pressure_kpa.0 to pressure_kpa.3 for single channels");
        }
        let both = |a: &str, b: &str| channel(a) == Some(None) && matches!(channel(b), Some(Some(_)));
        if all.iter().any(|other| both(&axis.key, &other.key) || both(&other.key, &axis.key)) {
            return wrong(
                "a pressure for all channels together with one for a channel".into(),
                "leave one of them out",
            );
        }
        all.push(axis);
    }
    let fed: Vec<usize> = Model::new(&base.scenario).channels().collect();
    let idle = |(raw, axis): (&Spanned<RawAxis>, &Axis)| {
        let one = channel(&axis.key).flatten().filter(|one| !fed.contains(one))?;
        let message = format!("nothing of {} is on supply channel {one}", base.name);
        Some((Some(raw.span()), message, "leave it out, or write pressure_kpa"))
    };
    raw.iter().zip(&all).find_map(idle).map_or(Ok(()), Err)?;
    Ok(all)
}

/// A key with its values; with a sample ranges have no steps.
fn axis(raw: &RawAxis, sampled: bool) -> Result<Axis, (String, &'static str)> {
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
                i if raw.log => between(from, to, true, i as f64 / (n - 1) as f64),
                // One rounding, so that whole steps give whole numbers.
                i => (from * (n - 1 - i) as f64 + to * i as f64) / (n - 1) as f64,
            };
            Levels::Listed((0..n).map(|i| number(at(i))).collect())
        }
    };
    Ok(Axis { key, levels })
}

pub(crate) fn as_number(value: &Value) -> Option<f64> {
    match value {
        Value::Integer(whole) => Some(*whole as f64),
        Value::Float(number) => Some(*number),
        _ => None,
    }
}
