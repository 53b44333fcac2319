//! Numbers of a scenario that a hand may turn: where they stand in the text, and from where to where.

use super::keys::key;
use super::stated::Scenario;

/// A number to turn, in the unit of its key.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct Dial {
    /// Place in the scenario's text, as `body.radius_mm`.
    pub place: String,
    /// Meaning of the number in words.
    pub name: &'static str,
    /// Unit of value, ends and step; as in the key.
    pub unit: &'static str,
    /// Present value in the scenario, in the unit of the key.
    pub value: f64,
    /// Least value that the slider may have.
    pub low: f64,
    /// Largest value that the slider may have.
    pub high: f64,
    /// Distance between neighbouring values of the slider.
    pub step: f64,
}

/// What a hand may turn: place, words and step.
const DIALS: &[(&str, &str, &str, f64)] = &[
    ("body", "pressure_kpa", "body pressure", 0.1),
    ("body", "radius_mm", "body radius", 1.0),
    ("body", "length_mm", "body length", 1.0),
    ("body", "bending_stiffness_nm2", "bending stiffness of the body", 0.01),
    ("actuator", "length_mm", "length of one unit", 1.0),
    ("actuator", "width_mm", "width of one unit", 1.0),
    ("actuator", "count", "units in a row", 1.0),
    ("actuator", "turns", "turns of the strip round the body", 0.05),
    ("actuator", "fold_mm", "depth of the folds", 1.0),
];

/// Bending stiffness to which a body of fabric can be turned \[N·m²\]; fits of the robots here end below.
const STIFF_NM2: f64 = 2.0;

impl Scenario {
    /// Sizes, body pressure and stiffness, each from half to twice what it is. A size may not fit the others all the way: the
    /// scenario is then refused as any other.
    pub fn dials(&self) -> Vec<Dial> {
        let dial = |&(table, name, words, step): &(&str, &'static str, &'static str, f64)| {
            let key = key(table, name)?;
            let value = key.value(self)?;
            let (low, high) = match name {
                "bending_stiffness_nm2" => (0.0, STIFF_NM2.max(2.0 * value)),
                _ => ((0.5 * value / step).ceil() * step, (2.0 * value / step).floor() * step),
            };
            // Missing parts cannot be turned, nor can a count of one.
            let is_there = table == "body" || value > if name == "count" { 1.0 } else { 0.0 };
            let unit = key.range?.unit;
            is_there.then(|| Dial { place: key.place(), name: words, unit, value, low, high, step })
        };
        DIALS.iter().filter_map(dial).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::SHIPPED;

    #[test]
    fn every_dial_names_a_number_of_the_text_and_has_room_to_both_sides() {
        for (name, text) in SHIPPED {
            let scenario = Scenario::parse(text).unwrap();
            let raw: toml::Table = text.parse().unwrap();
            for dial in scenario.dials() {
                let (table, key) = dial.place.split_once('.').unwrap();
                let written = &raw[table][key];
                let value = written.as_float().or(written.as_integer().map(|v| v as f64)).unwrap();
                assert!((value - dial.value).abs() < 1e-9, "{name} {}", dial.place);
                assert!(dial.low <= value && dial.high > value, "{name} {}", dial.place);
            }
        }
    }

    #[test]
    fn a_beam_has_the_dials_of_its_body_and_no_channel() {
        let channels = |text: &str| crate::Model::new(&Scenario::parse(text).unwrap()).channels().collect::<Vec<_>>();
        let text = SHIPPED[2].1.replace("[markers]", "[[zone]]\nfrom_mm = 0\nto_mm = 120\nchannel = 2\n[markers]");
        assert_eq!((channels(SHIPPED[2].1), channels(&text)), (vec![0], vec![0, 2]));
        let beam = "[body]\nradius_mm = 40\nlength_mm = 360\npressure_kpa = 2";
        assert_eq!((channels(beam), Scenario::parse(beam).unwrap().dials().len()), (vec![], 4));
    }
}
