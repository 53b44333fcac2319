//! Numbers of a scenario that a hand may turn: where they stand in the text, and from where to where.

use super::Scenario;

/// A number to turn, in the unit of its key.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct Dial {
    /// Place in the scenario's text, as `body.radius_mm`.
    pub place: &'static str,
    /// What it is, in words.
    pub name: &'static str,
    /// Unit.
    pub unit: &'static str,
    /// What the scenario says.
    pub value: f64,
    /// Least value to turn to.
    pub low: f64,
    /// Largest value to turn to.
    pub high: f64,
    /// Distance of two values.
    pub step: f64,
}

/// Bending stiffness to which a body of fabric can be turned \[N·m²\]; fits of the robots here end below.
const STIFF_NM2: f64 = 2.0;

impl Scenario {
    /// Sizes, body pressure and stiffness, each from half to twice what it is. A size may not fit the others all the way: the
    /// scenario is then refused as any other.
    pub fn dials(&self) -> Vec<Dial> {
        let a = &self.actuator;
        let around = |place, name, unit, value: f64, step: f64| Dial {
            place,
            name,
            unit,
            value,
            low: (0.5 * value / step).ceil() * step,
            high: (2.0 * value / step).floor() * step,
            step,
        };
        let mm = |place, name, value_m: f64| around(place, name, "mm", 1e3 * value_m, 1.0);
        let stiffness = Dial {
            low: 0.0,
            high: STIFF_NM2.max(2.0 * self.bending_stiffness),
            ..around(
                "body.bending_stiffness_nm2",
                "bending stiffness of the body",
                "N m²",
                self.bending_stiffness,
                0.01,
            )
        };
        let mut dials = vec![
            around("body.pressure_kpa", "body pressure", "kPa", 1e-3 * self.p_body_pa, 0.1),
            mm("body.radius_mm", "body radius", self.radius_m),
            mm("body.length_mm", "body length", self.length_m),
            stiffness,
        ];
        if a.exists() {
            let count = around("actuator.count", "units in a row", "", a.count as f64, 1.0);
            dials.push(mm("actuator.length_mm", "length of one unit", a.shape.length_m));
            dials.push(mm("actuator.width_mm", "width of one unit", a.shape.width_m));
            dials.extend((a.count > 1).then_some(count));
            let turns = around("actuator.turns", "turns of the strip round the body", "", a.turns, 0.05);
            dials.extend((a.turns > 0.0).then_some(turns));
        }
        if a.shape.fold_m > 0.0 {
            dials.push(mm("actuator.fold_mm", "depth of the folds", a.shape.fold_m));
        }
        dials
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
