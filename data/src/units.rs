//! Units allowed as the last `_token` of a column name, and their conversion to SI.
//!
//! `value_SI = value · numerator / denominator`, kept as a ratio so that whole millimetres are rounded once.

/// What a column measures.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Dimension {
    Length,
    Pressure,
    Time,
    Force,
    Ratio,
    Angle,
}

/// A unit of one dimension.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Unit {
    /// As the suffix of a column name, lower case.
    pub name: &'static str,
    /// As printed.
    pub symbol: &'static str,
    numerator: f64,
    denominator: f64,
}

const fn unit(name: &'static str, symbol: &'static str, numerator: f64, denominator: f64) -> Unit {
    Unit { name, symbol, numerator, denominator }
}

const LENGTHS: &[Unit] = &[unit("mm", "mm", 1.0, 1e3), unit("cm", "cm", 1.0, 1e2), unit("m", "m", 1.0, 1.0)];
/// 1 psi = 1 lbf/in² = 6894.757293168 Pa (NIST SP 811, B.8).
const PRESSURES: &[Unit] = &[
    unit("kpa", "kPa", 1e3, 1.0),
    unit("pa", "Pa", 1.0, 1.0),
    unit("mpa", "MPa", 1e6, 1.0),
    unit("psi", "psi", 6_894.757_293_168, 1.0),
    unit("bar", "bar", 1e5, 1.0),
];
const TIMES: &[Unit] = &[unit("s", "s", 1.0, 1.0), unit("ms", "ms", 1.0, 1e3), unit("min", "min", 60.0, 1.0)];

/// 1 lbf = 4.4482216152605 N (NIST SP 811, B.8).
const FORCES: &[Unit] =
    &[unit("n", "N", 1.0, 1.0), unit("kn", "kN", 1e3, 1.0), unit("lbf", "lbf", 4.448_221_615_260_5, 1.0)];
const RATIOS: &[Unit] = &[unit("pct", "pct (per cent)", 1.0, 1e2), unit("ratio", "ratio", 1.0, 1.0)];
/// Degrees stay degrees: directions of a test are labels, not angles to compute with.
const ANGLES: &[Unit] = &[unit("deg", "deg", 1.0, 1.0)];

impl Dimension {
    /// All units of this dimension, the house unit first.
    pub fn units(self) -> &'static [Unit] {
        match self {
            Dimension::Length => LENGTHS,
            Dimension::Pressure => PRESSURES,
            Dimension::Time => TIMES,
            Dimension::Force => FORCES,
            Dimension::Ratio => RATIOS,
            Dimension::Angle => ANGLES,
        }
    }

    /// The unit written `name` (lower case), if it is one of this dimension.
    pub fn unit(self, name: &str) -> Option<Unit> {
        self.units().iter().copied().find(|unit| unit.name == name)
    }

    /// `lengths are in mm, cm, m`, for error texts.
    pub fn sentence(self) -> String {
        let names: Vec<_> = self.units().iter().map(|unit| unit.symbol).collect();
        let word = match self {
            Dimension::Length => "lengths",
            Dimension::Pressure => "pressures",
            Dimension::Time => "times",
            Dimension::Force => "forces",
            Dimension::Ratio => "strains",
            Dimension::Angle => "directions",
        };
        format!("{word} are in {}", names.join(", "))
    }
}

impl Unit {
    /// `value` of this unit in m, Pa, s, N, a ratio or degrees.
    pub fn to_si(self, value: f64) -> f64 {
        value * self.numerator / self.denominator
    }
}

/// Metres as millimetres.
pub(crate) fn mm(length_m: f64) -> f64 {
    length_m * 1e3
}

/// Pascals as kilopascals.
pub(crate) fn kpa(pressure_pa: f64) -> f64 {
    pressure_pa / 1e3
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_convert_to_si() {
        let si = |dimension: Dimension, name: &str, value: f64| dimension.unit(name).unwrap().to_si(value);
        assert_eq!(si(Dimension::Length, "mm", 361.0), 0.361);
        assert_eq!(si(Dimension::Length, "cm", 36.0), 0.36);
        assert_eq!(si(Dimension::Pressure, "bar", 0.3), 30_000.0);
        assert_eq!(si(Dimension::Pressure, "mpa", 0.03), 30_000.0);
        assert!((si(Dimension::Pressure, "psi", 1.0) - 4.448_221_615_260_5 / 0.0254_f64.powi(2)).abs() < 1e-9);
        assert_eq!(si(Dimension::Time, "ms", 5000.0), si(Dimension::Time, "min", 1.0) / 12.0);
        assert!(Dimension::Length.unit("kpa").is_none());
    }
}
