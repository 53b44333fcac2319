//! Units as text: their factor to SI and their dimension.

/// Powers of kilogram, metre and second; an angle has none.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Dimension(pub [f64; 3]);

impl Dimension {
    pub const NONE: Dimension = Dimension([0.0; 3]);
    pub const MOMENT: Dimension = Dimension([1.0, 2.0, -2.0]);
    pub const PRESSURE: Dimension = Dimension([1.0, -1.0, -2.0]);
    pub const LENGTH: Dimension = Dimension([0.0, 1.0, 0.0]);

    /// Dimension of a product with the `power` of another.
    pub fn times(self, other: Dimension, power: f64) -> Dimension {
        let part = |i: usize| self.0[i] + power * other.0[i];
        Dimension([part(0), part(1), part(2)])
    }

    pub fn is(self, other: Dimension) -> bool {
        self.0.iter().zip(other.0).all(|(a, b)| (a - b).abs() < 1e-9)
    }

    /// As a user would write it.
    pub fn words(self) -> String {
        if let Some((name, ..)) =
            UNITS.iter().find(|(name, si, d)| *si == 1.0 && *name != "rad" && self.is(Dimension(*d)))
        {
            return if *name == "1" { "a pure number".into() } else { (*name).into() };
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

/// Name, factor to SI, powers of kg, m, s.
const UNITS: &[(&str, f64, [f64; 3])] = &[
    ("1", 1.0, [0.0; 3]),
    ("-", 1.0, [0.0; 3]),
    ("%", 0.01, [0.0; 3]),
    ("rad", 1.0, [0.0; 3]),
    ("deg", std::f64::consts::PI / 180.0, [0.0; 3]),
    ("N", 1.0, [1.0, 1.0, -2.0]),
    ("mN", 1e-3, [1.0, 1.0, -2.0]),
    ("kN", 1e3, [1.0, 1.0, -2.0]),
    ("m", 1.0, [0.0, 1.0, 0.0]),
    ("mm", 1e-3, [0.0, 1.0, 0.0]),
    ("cm", 1e-2, [0.0, 1.0, 0.0]),
    ("Pa", 1.0, [1.0, -1.0, -2.0]),
    ("kPa", 1e3, [1.0, -1.0, -2.0]),
    ("MPa", 1e6, [1.0, -1.0, -2.0]),
    ("J", 1.0, [1.0, 2.0, -2.0]),
    ("kg", 1.0, [1.0, 0.0, 0.0]),
    ("g", 1e-3, [1.0, 0.0, 0.0]),
    ("s", 1.0, [0.0, 0.0, 1.0]),
];

/// Factor to SI and dimension of a unit like `N m/rad^3`, `1/m`, `kPa` or `-`; a slash divides by the next factor alone.
///
/// The error is the part that is not known.
pub(crate) fn parse(text: &str) -> Result<(f64, Dimension), String> {
    let (mut si, mut dimension) = (1.0, Dimension::NONE);
    let spaced = text.replace('/', " /").replace(['·', '*'], " ");
    for word in spaced.split_whitespace() {
        let (over, word) = word.strip_prefix('/').map_or((1.0, word), |rest| (-1.0, rest));
        let (name, power) = split_power(word).ok_or_else(|| word.to_string())?;
        let (_, factor, powers) = UNITS.iter().find(|(known, ..)| *known == name).ok_or_else(|| word.to_string())?;
        si *= factor.powf(over * power);
        dimension = dimension.times(Dimension(*powers), over * power);
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
    fn dimensions_are_said_in_newtons_and_metres() {
        let words = |text: &str| parse(text).unwrap().1.words();
        assert_eq!(
            ["N", "N m", "N m2", "1/m", "kPa", "deg"].map(words),
            ["N", "J", "N m^2", "m^-1", "Pa", "a pure number"]
        );
    }
}
