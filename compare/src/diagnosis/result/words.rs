//! Numbers, values with units, and intervals in words.

use crate::diagnosis::candidates::taken_away;
use crate::diagnosis::result::ParameterValue;
use crate::wording::list;

pub use crate::wording::value;

/// `adding a and b`, `leaving out c`, `adding a and leaving out c`.
pub fn change(names: &[String]) -> String {
    let gone: Vec<&str> = names.iter().filter_map(|name| taken_away(name)).collect();
    let new: Vec<&str> = names.iter().map(String::as_str).filter(|name| taken_away(name).is_none()).collect();
    let parts = [("adding", new), ("leaving out", gone)].into_iter().filter(|(_, names)| !names.is_empty());
    parts.map(|(verb, names)| format!("{verb} {}", list(names))).collect::<Vec<_>>().join(" and ")
}

/// `Calibrated: a, k = 2 (1…3).`, or `Taken away: a.`
pub fn step(name: &str, parameters: &[ParameterValue]) -> String {
    match taken_away(name) {
        Some(gone) => format!("Taken away: {gone}."),
        None => format!("Calibrated: {name}, {}.", listed(parameters)),
    }
}

/// `1.5 N/m`, or the number alone if it has no unit.
pub fn quantity(v: f64, unit: &str) -> String {
    with_unit(&value(v), unit)
}

/// Three significant digits, needless zeros too.
pub fn three(v: f64) -> String {
    let size = v.abs();
    match size {
        0.0 => "0".into(),
        s if !(1e-3..1e5).contains(&s) => format!("{v:.1e}"),
        s => format!("{v:.*}", (2 - s.log10().floor() as i32).max(0) as usize),
    }
}

/// A value and its unit, which is `-` for a pure number.
pub fn with_unit(value: &str, unit: &str) -> String {
    if unit == "-" { value.to_string() } else { format!("{value} {unit}") }
}

/// `M_f = 0.51 N m (0.50…0.52)`, `n = 1.00 (held)`.
pub fn named(p: &ParameterValue) -> String {
    let interval = match (p.lo, p.hi) {
        (Some(lo), Some(hi)) => format!(" ({}…{})", three(lo), three(hi)),
        _ => p.held_mark().into(),
    };
    format!("{} = {}{interval}", p.symbol, with_unit(&three(p.value), &p.unit))
}

/// Several values with their symbols, separated by commas.
pub fn listed(values: &[ParameterValue]) -> String {
    values.iter().map(named).collect::<Vec<_>>().join(", ")
}

/// `β = 0.42 (0.40 to 0.44)`, `n = 1 (held)`.
pub fn with_interval(p: &ParameterValue) -> String {
    let unit = if p.unit == "-" { String::new() } else { format!(" {}", p.unit) };
    let range = match (p.lo, p.hi) {
        (Some(lo), Some(hi)) if lo == hi => format!("{unit} (the end of its range)"),
        (Some(lo), Some(hi)) => format!(" ({} to {}){unit}", value(lo), value(hi)),
        _ => format!("{unit}{}", p.held_mark()),
    };
    format!("{} = {}{range}", p.symbol, value(p.value))
}
