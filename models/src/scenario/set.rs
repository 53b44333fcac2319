//! Numbers of a scenario set without its text, for a robot that changes thousands of times.

use super::built::is_off;
use super::check::{are_too_low, is_known};
use super::keys::key;
use super::stated::Scenario;
use crate::effects::by_name;

/// A number at its place in the text, such as `body.radius_mm` or `effects.friction.moment_nm`, in the unit of the text.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Setting<'a> {
    /// Table.
    pub table: &'a str,
    /// Key in it.
    pub key: &'a str,
    /// Value.
    pub number: f64,
    /// Whether it is written as a whole number.
    pub is_whole: bool,
}

impl Scenario {
    /// The scenario that the text would give with these numbers in it. `None` where only the text decides: it refuses one of them,
    /// an effect is not there yet, a key has a meaning by its absence, or strips are round the body.
    ///
    /// ```
    /// use models::scenario::Setting;
    /// let text = models::shipped("epam").unwrap();
    /// let scenario = models::Scenario::parse(text).unwrap();
    /// let radius = |number| Setting { table: "body", key: "radius_mm", number, is_whole: true };
    /// let wide = models::Scenario::parse(&text.replace("radius_mm = 40", "radius_mm = 45")).unwrap();
    /// assert_eq!(scenario.with_numbers(&[radius(45.0)]), Some(wide));
    /// assert_eq!(scenario.with_numbers(&[radius(-45.0)]), None);
    /// ```
    pub fn with_numbers(&self, settings: &[Setting]) -> Option<Scenario> {
        let mut changed = self.clone();
        settings.iter().try_for_each(|setting| changed.set(setting))?;
        changed.numbers_fit().then_some(changed)
    }

    fn set(&mut self, setting: &Setting) -> Option<()> {
        let Setting { table, key: name, number, is_whole } = *setting;
        if let Some(effect) = table.strip_prefix("effects.") {
            return self.set_parameter(effect, name, number);
        }
        let refused = match (table, name) {
            ("body", "hinge_curvature_per_m") => self.wall.stiffness_n_per_m.is_some(),
            ("actuator", "fold_mm") => !self.actuator.kind.has_pouches(),
            ("actuator", "bias_deg") => self.actuator.kind.has_pouches(),
            _ => false,
        };
        let is_there = !refused && (table != "actuator" || self.actuator.exists());
        let key = key(table, name).filter(|key| is_there && key.tables[0] == table)?;
        key.set(self, number, is_whole)
    }

    fn set_parameter(&mut self, name: &str, key: &str, number: f64) -> Option<()> {
        let chosen = self.effects.iter_mut().find(|effect| effect.name == name)?;
        let parameters = by_name(name)?.parameters;
        let index = parameters.iter().position(|parameter| parameter.key == key)?;
        let parameter = &parameters[index];
        let fits = parameter.is_possible(number) && (is_known(&chosen.basis) || parameter.is_usual(number));
        fits.then(|| chosen.values[index] = number * parameter.si)
    }

    /// Whether the numbers fit each other, as the reader of the text asks; a planar robot.
    fn numbers_fit(&self) -> bool {
        let (length_m, actuator) = (self.length_m, &self.actuator);
        let is_on = |station_m: f64| !is_off(station_m, length_m);
        let has_units = !actuator.exists()
            || is_on(actuator.start_m + actuator.covered_m(self.radius_m)) && self.can_be_built().is_ok();
        has_units
            && !self.is_spatial()
            && self.zones.iter().all(|zone| is_on(zone.to_m))
            && self.markers_m.iter().all(|station_m| is_on(*station_m))
            && !self.markers_m.last().is_some_and(|last_m| are_too_low(*last_m, length_m))
            && self.idle_force_n().is_none()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::{KEYS, SHIPPED};

    /// The text with a number at a place, written as a separate line behind the head of the table.
    fn written(text: &str, table: &str, key: &str, number: &str) -> String {
        let mut inside = false;
        let mut lines: Vec<String> = Vec::new();
        for line in text.lines() {
            if line.starts_with('[') {
                inside = line == format!("[{table}]");
            }
            if !(inside && line.starts_with(&format!("{key} ="))) {
                lines.push(line.into());
            }
            if line == format!("[{table}]") {
                lines.push(format!("{key} = {number}"));
            }
        }
        lines.join("\n")
    }

    /// Every key of every shipped robot at values from a thousandth to a thousand times its own.
    #[test]
    fn a_number_that_is_set_is_that_of_the_text() {
        let (mut taken, mut left) = (0, 0);
        for (name, text) in SHIPPED {
            let scenario = Scenario::parse(text).unwrap();
            let keys = KEYS.iter().filter_map(|key| Some((key.tables[0].to_string(), key.name, key.value(&scenario)?)));
            let of_effects = scenario.effects.iter().flat_map(|effect| {
                let parameters = by_name(&effect.name).unwrap().parameters;
                let named = move |(parameter, si): (&crate::effects::Parameter<'static>, &f64)| {
                    (format!("effects.{}", effect.name), parameter.key, si / parameter.si)
                };
                parameters.iter().zip(&effect.values).map(named).collect::<Vec<_>>()
            });
            for (table, key, value) in keys.chain(of_effects) {
                for factor in [-1.0, 0.0, 1e-3, 0.3, 0.9, 1.0, 1.02, 1.7, 3.0, 1e3] {
                    for is_whole in [true, false] {
                        let number = if is_whole { (value * factor).round() } else { value * factor + 0.017 };
                        let typed = if is_whole { format!("{number:.0}") } else { format!("{number:?}") };
                        let read = Scenario::parse(&written(text, &table, key, &typed));
                        let set = scenario.with_numbers(&[Setting { table: &table, key, number, is_whole }]);
                        match (set, read) {
                            (Some(set), read) => assert_eq!(Ok(set), read, "{name}: {table}.{key} = {typed}"),
                            (None, Ok(read)) => {
                                assert!(read.is_spatial(), "{name}: {table}.{key} = {typed} is left to the text")
                            }
                            (None, Err(_)) => left += 1,
                        }
                        taken += 1;
                    }
                }
            }
        }
        assert!(left > 100 && taken > 4 * left / 3, "{taken} numbers, {left} of them refused");
    }

    #[test]
    fn numbers_that_fit_only_together_are_set_together() {
        let scenario = Scenario::parse(SHIPPED[2].1).unwrap();
        let set = |table, key, number| Setting { table, key, number, is_whole: true };
        let [shorter, fewer] = [set("actuator", "length_mm", 90.0), set("actuator", "count", 4.0)];
        assert_eq!(scenario.with_numbers(&[shorter]), None);
        assert_eq!(scenario.with_numbers(&[shorter, fewer]).unwrap().actuator.count, 4);
        for place in [set("effects.friction", "moment_nm", 1.0), set("zone", "to_mm", 1.0), set("body", "wall", 1.0)] {
            assert_eq!(scenario.with_numbers(&[place]), None, "{place:?}");
        }
    }
}
