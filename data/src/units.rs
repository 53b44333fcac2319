//! Units allowed as the last `_token` of a column name.

use spelling::units::{Dimension, Unit, units_of};

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Measured {
    Length,
    Pressure,
    Time,
    Force,
    Ratio,
    Angle,
}

const RATIOS: [Unit; 2] = [Unit::new("pct", Dimension::NONE, 1.0, 1e2), Unit::new("ratio", Dimension::NONE, 1.0, 1.0)];
/// Degrees stay degrees: directions of a test are labels, not angles to compute with.
const DEGREES: Unit = Unit::new("deg", Dimension::NONE, 1.0, 1.0);

impl Measured {
    /// All units of this dimension, the house unit first.
    fn units(self) -> Vec<Unit> {
        match self {
            Measured::Length => units_of(Dimension::LENGTH).collect(),
            Measured::Pressure => units_of(Dimension::PRESSURE).collect(),
            Measured::Time => units_of(Dimension::TIME).collect(),
            Measured::Force => units_of(Dimension::FORCE).collect(),
            Measured::Ratio => RATIOS.to_vec(),
            Measured::Angle => vec![DEGREES],
        }
    }

    /// The unit written `name` (lower case), if it is one of this dimension.
    pub(crate) fn unit(self, name: &str) -> Option<Unit> {
        self.units().into_iter().find(|unit| unit.symbol.to_lowercase() == name)
    }

    /// `lengths are in mm, cm, m`, for error texts.
    pub(crate) fn sentence(self) -> String {
        let symbols: Vec<_> = self.units().iter().map(|unit| unit.symbol).collect();
        let word = match self {
            Measured::Length => "lengths",
            Measured::Pressure => "pressures",
            Measured::Time => "times",
            Measured::Force => "forces",
            Measured::Ratio => return "strains are in pct (per cent), ratio".into(),
            Measured::Angle => "directions",
        };
        format!("{word} are in {}", symbols.join(", "))
    }
}

pub(crate) fn mm(length_m: f64) -> f64 {
    length_m * 1e3
}

pub(crate) fn kpa(pressure_pa: f64) -> f64 {
    pressure_pa / 1e3
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_convert_to_si() {
        let si = |dimension: Measured, name: &str, value: f64| dimension.unit(name).unwrap().to_si(value);
        assert_eq!(si(Measured::Length, "mm", 361.0), 0.361);
        assert_eq!(si(Measured::Length, "cm", 36.0), 0.36);
        assert_eq!(si(Measured::Pressure, "bar", 0.3), 30_000.0);
        assert_eq!(si(Measured::Pressure, "mpa", 0.03), 30_000.0);
        assert!((si(Measured::Pressure, "psi", 1.0) - 4.448_221_615_260_5 / 0.0254_f64.powi(2)).abs() < 1e-9);
        assert_eq!(si(Measured::Time, "ms", 5000.0), si(Measured::Time, "min", 1.0) / 12.0);
        assert!(Measured::Length.unit("kpa").is_none());
    }
}
