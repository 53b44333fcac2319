//! One table of units for column names, formulas and typed quantities; accepted intervals of numbers in files.

use std::f64::consts::PI;
use std::fmt::{Display, Formatter};

/// Powers of kilogram, metre and second; an angle has none.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Dimension(pub [f64; 3]);

impl Dimension {
    /// Of a pure number or an angle.
    pub const NONE: Dimension = Dimension([0.0; 3]);
    /// Dimension of a length: metre to the power of one.
    pub const LENGTH: Dimension = Dimension([0.0, 1.0, 0.0]);
    /// Dimension of a time: second to the power of one.
    pub const TIME: Dimension = Dimension([0.0, 0.0, 1.0]);
    /// Dimension of a force, kg·m/s² in base units.
    pub const FORCE: Dimension = Dimension([1.0, 1.0, -2.0]);
    /// Of a pressure or a stress.
    pub const PRESSURE: Dimension = Dimension([1.0, -1.0, -2.0]);
    /// Of a moment or an energy.
    pub const MOMENT: Dimension = Dimension([1.0, 2.0, -2.0]);
    /// Dimension of a mass: kilogram to the power of one.
    pub const MASS: Dimension = Dimension([1.0, 0.0, 0.0]);

    /// Dimension of a product with the `power` of another.
    pub fn times(self, other: Dimension, power: f64) -> Dimension {
        let part = |i: usize| self.0[i] + power * other.0[i];
        Dimension([part(0), part(1), part(2)])
    }

    /// Whether the two dimensions are equal.
    pub fn is(self, other: Dimension) -> bool {
        self.0.iter().zip(other.0).all(|(a, b)| (a - b).abs() < 1e-9)
    }

    /// As a user would write it.
    pub fn words(self) -> String {
        if self.is(Dimension::NONE) {
            return "a pure number".into();
        }
        if let Some(unit) = UNITS.iter().find(|unit| unit.factor() == 1.0 && self.is(unit.dimension)) {
            return unit.symbol.into();
        }
        // With the newton first, as mechanics has it.
        let newton = self.0[0];
        let rest = [("N", newton), ("m", self.0[1] - newton), ("s", self.0[2] + 2.0 * newton)];
        let part = |(name, power): &(&str, f64)| match *power {
            1.0 => name.to_string(),
            power => format!("{name}^{power}"),
        };
        rest.iter().filter(|(_, power)| power.abs() > 1e-9).map(part).collect::<Vec<_>>().join(" ")
    }
}

/// A unit: `value_SI = value · numerator / denominator`, a ratio so that whole millimetres are rounded once.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Unit {
    /// Symbol of the unit, as printed and as typed.
    pub symbol: &'static str,
    /// Powers of kilogram, metre and second in the unit.
    pub dimension: Dimension,
    numerator: f64,
    denominator: f64,
}

impl Unit {
    /// A unit of so much SI.
    pub const fn new(symbol: &'static str, dimension: Dimension, numerator: f64, denominator: f64) -> Unit {
        Unit { symbol, dimension, numerator, denominator }
    }

    /// `value` of this unit in SI.
    pub fn to_si(self, value: f64) -> f64 {
        value * self.numerator / self.denominator
    }

    /// Value of one of this unit in SI.
    pub fn factor(self) -> f64 {
        self.numerator / self.denominator
    }
}

/// Units of everything but pure numbers and angles; of each dimension the house unit first.
pub const UNITS: &[Unit] = &[
    Unit::new("mm", Dimension::LENGTH, 1.0, 1e3),
    Unit::new("cm", Dimension::LENGTH, 1.0, 1e2),
    Unit::new("m", Dimension::LENGTH, 1.0, 1.0),
    Unit::new("kPa", Dimension::PRESSURE, 1e3, 1.0),
    Unit::new("Pa", Dimension::PRESSURE, 1.0, 1.0),
    Unit::new("MPa", Dimension::PRESSURE, 1e6, 1.0),
    // 1 psi = 1 lbf/in² (NIST SP 811, B.8).
    Unit::new("psi", Dimension::PRESSURE, 6_894.757_293_168, 1.0),
    Unit::new("bar", Dimension::PRESSURE, 1e5, 1.0),
    Unit::new("mbar", Dimension::PRESSURE, 1e2, 1.0),
    // Conventional inch of water (NIST SP 811, B.8).
    Unit::new("inH2O", Dimension::PRESSURE, 249.088_91, 1.0),
    Unit::new("s", Dimension::TIME, 1.0, 1.0),
    Unit::new("ms", Dimension::TIME, 1.0, 1e3),
    Unit::new("min", Dimension::TIME, 60.0, 1.0),
    Unit::new("N", Dimension::FORCE, 1.0, 1.0),
    Unit::new("kN", Dimension::FORCE, 1e3, 1.0),
    Unit::new("mN", Dimension::FORCE, 1.0, 1e3),
    // NIST SP 811, B.8.
    Unit::new("lbf", Dimension::FORCE, 4.448_221_615_260_5, 1.0),
    Unit::new("J", Dimension::MOMENT, 1.0, 1.0),
    Unit::new("kg", Dimension::MASS, 1.0, 1.0),
    Unit::new("g", Dimension::MASS, 1.0, 1e3),
];

/// Units of angles, whose SI unit is the radian.
pub const ANGLES: &[Unit] =
    &[Unit::new("deg", Dimension::NONE, PI, 180.0), Unit::new("rad", Dimension::NONE, 1.0, 1.0)];

const PURE: &[Unit] = &[
    Unit::new("1", Dimension::NONE, 1.0, 1.0),
    Unit::new("-", Dimension::NONE, 1.0, 1.0),
    Unit::new("%", Dimension::NONE, 1.0, 1e2),
];

/// Units of a dimension, the house unit first.
pub fn units_of(dimension: Dimension) -> impl Iterator<Item = Unit> + Clone {
    UNITS.iter().copied().filter(move |unit| unit.dimension == dimension)
}

/// Accepted interval of a quantity as typed, its factor to SI, and the slip to suspect outside.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Range {
    /// Its name, where it has no key.
    pub name: &'static str,
    /// Unit after the number; empty for a pure one.
    pub unit: &'static str,
    /// Factor from the number as typed to SI.
    pub si: f64,
    /// Least accepted number, as typed; itself accepted.
    pub low: f64,
    /// Largest accepted number, as typed; itself accepted.
    pub high: f64,
    /// What to type instead of something smaller.
    pub too_small: &'static str,
    /// What to type instead of something larger.
    pub too_large: &'static str,
}

impl Range {
    /// Lengths in millimetres, from 1 mm to 100 m.
    pub const LENGTH: Range = Range {
        name: "length",
        unit: "mm",
        si: 1e-3,
        too_small: "this looks like metres: write millimetres, for example 60 for 0.06 m",
        ..Range::plain(1.0, 1e5, "write millimetres")
    };
    /// Places of markers along the undeformed body.
    pub const STATION: Range = Range {
        name: "station",
        low: 1e-3,
        too_small: "stations count from the base along the undeformed body; write 1 for a marker at the base",
        ..Range::LENGTH
    };
    /// Times since the start of a run.
    pub const TIME: Range =
        Range { name: "time", unit: "s", ..Range::plain(0.0, 1e10, "write seconds since the start of the run") };
    /// Frames of a camera in a second.
    pub const FRAME_RATE: Range = Range {
        name: "frames per second",
        ..Range::plain(1e-3, 1e6, "write how many frames the camera takes in a second, for example 30")
    };
    /// Gauge pressures of a body, which has no shape without pressure.
    pub const BODY_PRESSURE: Range = Range {
        name: "body pressure",
        low: 0.5,
        high: 100.0,
        too_small: "this looks like psi: write kilopascals, for example 2 for 0.29 psi (1 psi is 6.895 kPa)",
        ..Range::PRESSURE
    };
    /// Gauge pressures of an actuator in kilopascals, from 0 to 1000 kPa.
    pub const ACTUATOR_PRESSURE: Range = Range { name: "actuator pressure", high: 1000.0, ..Range::PRESSURE };
    /// Gauge pressures in kilopascals, from 0 to 500 kPa.
    pub const PRESSURE: Range = Range {
        name: "pressure",
        unit: "kPa",
        si: 1e3,
        too_small: "pressures are gauge pressures and not negative",
        ..Range::plain(0.0, 500.0, "this looks like pascals: write kilopascals, for example 30 for 30000 Pa")
    };

    /// Interval of a pure number, with one remedy for both ends.
    pub const fn plain(low: f64, high: f64, usual: &'static str) -> Range {
        Range { name: "", unit: "", si: 1.0, low, high, too_small: usual, too_large: usual }
    }

    /// A number that is in SI already. Errors as for [`Range::si`].
    #[inline]
    pub fn check(&self, value_si: f64) -> Result<f64, (String, &'static str)> {
        self.si(self.name, value_si / self.si).map(|_| value_si)
    }

    /// Whether a number in SI is within the bounds.
    #[inline]
    pub fn contains(&self, value_si: f64) -> bool {
        (self.low..=self.high).contains(&(value_si / self.si))
    }

    /// The mistake in a number in SI that is out of the bounds, and what to type.
    pub fn refusal(&self, value_si: f64) -> Refusal<'_> {
        Refusal { bounds: self, name: self.name, value: value_si / self.si }
    }

    /// The mistake alone, without what to type.
    pub fn mistake(&self, value_si: f64) -> String {
        self.refusal(value_si).mistake().to_string()
    }

    /// A number in SI.
    ///
    /// # Errors
    /// The mistake in the number called `name`, and what to type.
    pub fn si(&self, name: &str, value: f64) -> Result<f64, (String, &'static str)> {
        if (self.low..=self.high).contains(&value) {
            return Ok(value * self.si);
        }
        let refusal = Refusal { bounds: self, name, value };
        Err((refusal.mistake().to_string(), refusal.help()))
    }
}

/// A number out of its bounds, in words that need no heap.
#[derive(Debug, Clone, Copy)]
pub struct Refusal<'r> {
    bounds: &'r Range,
    name: &'r str,
    value: f64,
}

impl Refusal<'_> {
    fn help(&self) -> &'static str {
        match self.value {
            value if value.is_nan() => "write a number",
            value if value < 0.0 && self.bounds.low >= 0.0 => "a negative value means nothing here",
            value if value < self.bounds.low => self.bounds.too_small,
            _ => self.bounds.too_large,
        }
    }

    fn mistake(&self) -> impl Display {
        let Refusal { bounds: Range { unit, low, high, .. }, name, value } = *self;
        let space = if unit.is_empty() { "" } else { " " };
        // A number without a row of zeros.
        let plain = value == 0.0 || !value.is_finite() || (1e-6..1e12).contains(&value.abs());
        std::fmt::from_fn(move |f| {
            write!(f, "{name} must be from {low} to {high}{space}{unit}, not ")?;
            if plain { write!(f, "{value}") } else { write!(f, "{value:e}") }
        })
    }
}

impl Display for Refusal<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}; {}", self.mistake(), self.help())
    }
}

/// Factor to SI and dimension of a unit like `N m/rad^3`, `1/m`, `kPa` or `-`; a slash divides by the next factor alone.
///
/// ```
/// let (si, dimension) = spelling::units::parse("mm/kPa").unwrap();
/// assert!((si - 1e-6).abs() < 1e-20 && dimension.is(spelling::units::parse("m/Pa").unwrap().1));
/// ```
///
/// # Errors
/// The part that is not known.
pub fn parse(text: &str) -> Result<(f64, Dimension), String> {
    let (mut si, mut dimension) = (1.0, Dimension::NONE);
    let spaced = text.replace('/', " /").replace(['·', '*'], " ");
    for word in spaced.split_whitespace() {
        let (over, word) = word.strip_prefix('/').map_or((1.0, word), |rest| (-1.0, rest));
        let (name, power) = split_power(word).ok_or_else(|| word.to_string())?;
        let known = [PURE, ANGLES, UNITS].into_iter().flatten().find(|unit| unit.symbol == name);
        let unit = known.ok_or_else(|| word.to_string())?;
        si *= unit.factor().powf(over * power);
        dimension = dimension.times(unit.dimension, over * power);
    }
    if text.trim().is_empty() { Err("nothing".into()) } else { Ok((si, dimension)) }
}

/// `m`, `m2`, `m^2`, `m²` → name and power.
fn split_power(word: &str) -> Option<(&str, f64)> {
    for (mark, power) in [("²", 2.0), ("³", 3.0)] {
        if let Some(name) = word.strip_suffix(mark) {
            return Some((name, power));
        }
    }
    if let Some((name, power)) = word.split_once('^') {
        return power.parse().ok().filter(|p: &f64| p.is_finite()).map(|power| (name, power));
    }
    let name = word.trim_end_matches(|c: char| c.is_ascii_digit());
    if name.is_empty() || name.len() == word.len() {
        return Some((word, 1.0));
    }
    word[name.len()..].parse().ok().map(|power| (name, power))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_have_their_factor_and_dimension() {
        for (text, si, powers) in [
            ("N m", 1.0, [1.0, 2.0, -2.0]),
            ("N m/rad^3", 1.0, [1.0, 2.0, -2.0]),
            ("N·m²", 1.0, [1.0, 3.0, -2.0]),
            ("N m2", 1.0, [1.0, 3.0, -2.0]),
            ("1/m", 1.0, [0.0, -1.0, 0.0]),
            ("N/mm", 1e3, [1.0, 0.0, -2.0]),
            ("mm^2/kPa", 1e-9, [-1.0, 3.0, 2.0]),
            ("-", 1.0, [0.0; 3]),
        ] {
            let (factor, dimension) = parse(text).unwrap();
            assert!(
                (factor / si - 1.0).abs() < 1e-12 && dimension.is(Dimension(powers)),
                "{text}: {factor} {dimension:?}"
            );
        }
        for text in ["", "furlong", "N m/x", "m^", "m^x"] {
            assert!(parse(text).is_err(), "{text}");
        }
    }

    #[test]
    fn a_bound_holds_on_both_sides_and_says_what_to_type() {
        assert_eq!(Range::BODY_PRESSURE.check(500.0), Ok(500.0));
        assert_eq!(Range::ACTUATOR_PRESSURE.check(1e6), Ok(1e6));
        for (range, value_si, words) in [
            (Range::BODY_PRESSURE, 0.0, "body pressure must be from 0.5 to 100 kPa, not 0"),
            (Range::BODY_PRESSURE, 5e-324, "body pressure must be from 0.5 to 100 kPa, not "),
            (Range::ACTUATOR_PRESSURE, -3e3, "actuator pressure must be from 0 to 1000 kPa, not -3"),
            (Range::ACTUATOR_PRESSURE, f64::NAN, "actuator pressure must be from 0 to 1000 kPa, not NaN"),
            (Range::TIME, f64::INFINITY, "time must be from 0 to 10000000000 s, not inf"),
            (Range::STATION, 0.0, "station must be from 0.001 to 100000 mm, not 0"),
            (Range::FRAME_RATE, 0.0, "frames per second must be from 0.001 to 1000000, not 0"),
        ] {
            let (message, help) = range.check(value_si).unwrap_err();
            assert!(message.starts_with(words) && message.len() < 90 && !help.is_empty(), "{message}");
        }
    }

    #[test]
    fn dimensions_are_said_in_newtons_and_metres() {
        let words = |text: &str| parse(text).unwrap().1.words();
        assert_eq!(
            ["N", "N m", "N m2", "1/m", "kPa", "deg"].map(words),
            ["N", "J", "N m^2", "m^-1", "Pa", "a pure number"]
        );
    }
}
