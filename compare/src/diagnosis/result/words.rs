//! Numbers and values in words.

use crate::diagnosis::result::ParameterValue;

pub use crate::wording::value;

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

/// The same of several.
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
