//! Quantities typed with their unit, as on a command line: `30kPa`, `100mm`, `45deg`, `0.5s`.

use crate::units::{ANGLES, Dimension, Unit, units_of};

/// What a quantity measures; fixes the units that are understood.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Quantity {
    /// Gauge pressure, read in any known unit and returned in Pa.
    Pressure,
    /// Length, read in any known unit and returned in m.
    Length,
    /// Angle, read in any known unit and returned in rad.
    Angle,
    /// Time, read in any known unit and returned in s.
    Time,
}

impl Quantity {
    fn units(self) -> Vec<Unit> {
        match self {
            Quantity::Pressure => units_of(Dimension::PRESSURE).collect(),
            Quantity::Length => units_of(Dimension::LENGTH).collect(),
            Quantity::Angle => ANGLES.to_vec(),
            Quantity::Time => units_of(Dimension::TIME).collect(),
        }
    }
}

/// Reads one quantity into SI.
///
/// # Errors
/// A message with the mistake and what to type.
///
/// ```
/// use spelling::quantity::{Quantity, parse};
/// assert_eq!(parse("30 kPa", Quantity::Pressure), Ok(30e3));
/// assert!(parse("30", Quantity::Pressure).unwrap_err().contains("unit"));
/// ```
pub fn parse(text: &str, quantity: Quantity) -> Result<f64, String> {
    let text = text.trim();
    let split = text.find(|c: char| c.is_alphabetic() && c != 'e' && c != 'E').unwrap_or(text.len());
    let (number, unit) = text.split_at(split);
    let units = quantity.units();
    let symbols: Vec<&str> = units.iter().map(|u| u.symbol).collect();
    let example = format!("write a number and one of the units {}, for example 30{}", symbols.join(", "), symbols[0]);
    let value: f64 = number.trim().parse().map_err(|_| format!("`{text}` is not a quantity: {example}"))?;
    if unit.trim().is_empty() {
        return Err(format!("`{text}` has no unit: {example}"));
    }
    let known = units.iter().find(|u| u.symbol.eq_ignore_ascii_case(unit.trim()));
    let factor = known.map(|u| u.factor()).ok_or_else(|| format!("`{text}` has an unknown unit: {example}"))?;
    let si = value * factor;
    match () {
        () if !si.is_finite() => Err(format!("`{text}` is not finite: {example}")),
        () if value != 0.0 && !si.is_normal() => Err(format!("`{text}` rounds to 0: {example}")),
        () => Ok(si),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_are_converted_and_slips_explained() {
        assert_eq!(parse("2.5e1kPa", Quantity::Pressure), Ok(25e3));
        assert_eq!(parse("-40 mm", Quantity::Length), Ok(-0.04));
        assert!((parse("180deg", Quantity::Angle).unwrap() - std::f64::consts::PI).abs() < 1e-15);
        for wrong in ["", "kPa", "30", "30mm", "nankPa", "infkPa", "3O kPa", "30 kPa kPa", "1e-320kPa", "1e308kPa"] {
            assert!(parse(wrong, Quantity::Pressure).is_err(), "{wrong}");
        }
    }
}
