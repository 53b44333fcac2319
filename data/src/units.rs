//! Units allowed as the last `_token` of a column name.

use spelling::units::{Dimension, Unit, units_of};

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum MeasuredQuantity {
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

impl MeasuredQuantity {
    /// All units of this dimension, the house unit first.
    fn units(self) -> Vec<Unit> {
        match self {
            MeasuredQuantity::Length => units_of(Dimension::LENGTH).collect(),
            MeasuredQuantity::Pressure => units_of(Dimension::PRESSURE).collect(),
            MeasuredQuantity::Time => units_of(Dimension::TIME).collect(),
            MeasuredQuantity::Force => units_of(Dimension::FORCE).collect(),
            MeasuredQuantity::Ratio => RATIOS.to_vec(),
            MeasuredQuantity::Angle => vec![DEGREES],
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
            MeasuredQuantity::Length => "lengths",
            MeasuredQuantity::Pressure => "pressures",
            MeasuredQuantity::Time => "times",
            MeasuredQuantity::Force => "forces",
            MeasuredQuantity::Ratio => return "strains are in pct (per cent), ratio".into(),
            MeasuredQuantity::Angle => "directions",
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
        let si = |dimension: MeasuredQuantity, name: &str, value: f64| dimension.unit(name).unwrap().to_si(value);
        assert_eq!(si(MeasuredQuantity::Length, "mm", 361.0), 0.361);
        assert_eq!(si(MeasuredQuantity::Length, "cm", 36.0), 0.36);
        assert_eq!(si(MeasuredQuantity::Pressure, "bar", 0.3), 30_000.0);
        assert_eq!(si(MeasuredQuantity::Pressure, "mpa", 0.03), 30_000.0);
        assert!((si(MeasuredQuantity::Pressure, "psi", 1.0) - 4.448_221_615_260_5 / 0.0254_f64.powi(2)).abs() < 1e-9);
        assert_eq!(si(MeasuredQuantity::Time, "ms", 5000.0), si(MeasuredQuantity::Time, "min", 1.0) / 12.0);
        assert!(MeasuredQuantity::Length.unit("kpa").is_none());
    }
}
