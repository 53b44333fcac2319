//! How a fabric is written down: named numbers and tables in the units of the text, and the catalogue entry that reads them.

use std::collections::BTreeMap;
use std::sync::Arc;

use super::curve::Curve;
use super::fabric::{Fabric, Ply};
use crate::Text;

/// What a user wrote about one fabric, in the units of the keys.
#[derive(Debug, Clone, Default)]
pub struct Recipe {
    /// Numbers by key: `c10_MPa = 50.3`.
    pub numbers: BTreeMap<String, f64>,
    /// Tables by key: `warp = [[0, 0], [0.01, 0.9]]`.
    pub curves: BTreeMap<String, Vec<[f64; 2]>>,
    /// Fabrics this one is made of, ready-made; only for laws of several plies.
    pub plies: Vec<Ply>,
}

impl Recipe {
    /// A recipe of numbers alone.
    ///
    /// ```
    /// use models::fabrics::{self, Recipe};
    /// let recipe = Recipe::of(&[("c10_MPa", 50.3), ("thickness_mm", 0.2)]);
    /// let sheet = (fabrics::by_name("neo-hookean").unwrap().make)(&recipe).unwrap();
    /// assert_eq!(sheet.thickness_m(), 2e-4);
    /// ```
    pub fn of(numbers: &[(&str, f64)]) -> Recipe {
        let numbers = numbers.iter().map(|(key, value)| (key.to_string(), *value)).collect();
        Recipe { numbers, ..Recipe::default() }
    }
}

/// One number of a law. Values are in `unit` in recipes, in SI (`value × si`) inside.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LawParameter {
    /// Key, with the unit as suffix.
    pub key: &'static str,
    /// Unit of the value in a recipe, which the key has as suffix.
    pub unit: &'static str,
    /// Factor from the value in a recipe to SI.
    pub si: f64,
    /// Smallest accepted value, in the unit of the recipe.
    pub lower: f64,
    /// Largest accepted value, in the unit of the recipe.
    pub upper: f64,
    /// Whether a recipe must have it, and its value where it is left out.
    pub need: Need,
    /// Meaning in a few words, for documents and messages.
    pub meaning: &'static str,
}

/// Whether a parameter must be written.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Need {
    /// A recipe without it is refused.
    Required,
    /// It has this value (as written) otherwise.
    Default(f64),
    /// It may be left out; `meaning` gives the law without it, or the key that takes its place.
    Optional,
}

/// One table of a law; always optional, in place of the number its `meaning` names.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CurveInput {
    /// Key of the table in a recipe.
    pub key: &'static str,
    /// Unit of the first column in a recipe.
    pub x_unit: &'static str,
    /// Factor of the first column to SI.
    pub x_si: f64,
    /// Unit of the second column in a recipe.
    pub y_unit: &'static str,
    /// Factor of the second column to SI.
    pub y_si: f64,
    /// Meaning in a few words, and the number that the table replaces.
    pub meaning: &'static str,
}

/// A fabric law as an entry of the catalogue.
#[derive(Debug, Clone, Copy)]
pub struct Law {
    /// Name by which recipes and materials call the law.
    pub name: &'static str,
    /// Numbers that its recipes have, required and optional.
    pub parameters: &'static [LawParameter],
    /// Tables that its recipes may have in place of numbers.
    pub curves: &'static [CurveInput],
    /// Fewest and most plies it is made of.
    pub plies: [usize; 2],
    /// Green–Lagrange strain up to which the law is meant.
    pub strain_limit: f64,
    /// Makes a complete recipe that the law accepts.
    pub example: fn() -> Recipe,
    /// Makes the fabric.
    ///
    /// # Errors
    /// A message that names the key and the remedy.
    pub make: fn(&Recipe) -> Result<Arc<dyn Fabric>, String>,
}

impl Law {
    /// Checks names, presence, bounds and number of plies.
    pub(super) fn read<'a>(&self, recipe: &'a Recipe) -> Result<RecipeValues<'a>, String> {
        let keys: Vec<&str> = self.parameters.iter().map(|p| p.key).collect();
        let curve_keys: Vec<&str> = self.curves.iter().map(|c| c.key).collect();
        known(self.name, "number", recipe.numbers.keys(), &keys)?;
        known(self.name, "curve", recipe.curves.keys(), &curve_keys)?;
        let [least, most] = self.plies;
        let n = recipe.plies.len();
        if n < least || n > most {
            let count = if most == usize::MAX { format!("{least} or more") } else { format!("{least}") };
            return Err(format!("fabric `{}` got {n} plies; write {count}", self.name));
        }
        let mut si = BTreeMap::new();
        for p in self.parameters {
            if let Some(value) = p.value(self.name, recipe)? {
                si.insert(p.key, value * p.si);
            }
        }
        Ok(RecipeValues { law: *self, si, recipe })
    }
}

impl LawParameter {
    fn value(&self, law: &str, recipe: &Recipe) -> Result<Option<f64>, String> {
        match (recipe.numbers.get(self.key), self.need) {
            (Some(v), _) if (self.lower..=self.upper).contains(v) => Ok(Some(*v)),
            (Some(v), _) => Err(format!(
                "fabric `{law}`: `{}` is {v} {}; write a number from {} to {} ({})",
                self.key, self.unit, self.lower, self.upper, self.meaning
            )),
            (None, Need::Default(v)) => Ok(Some(v)),
            (None, Need::Optional) => Ok(None),
            (None, Need::Required) => {
                Err(format!("fabric `{law}` needs `{}` [{}]: {}", self.key, self.unit, self.meaning))
            }
        }
    }
}

/// Numbers of a checked recipe in SI, with the recipe for its tables.
pub(super) struct RecipeValues<'a> {
    law: Law,
    si: BTreeMap<&'static str, f64>,
    recipe: &'a Recipe,
}

impl RecipeValues<'_> {
    /// A number that is required or has a default \[SI\].
    pub(super) fn get(&self, key: &str) -> Result<f64, String> {
        self.optional(key).ok_or_else(|| self.says(format!("write `{key}`")))
    }

    /// A number that may be left out \[SI\].
    pub(super) fn optional(&self, key: &str) -> Option<f64> {
        self.si.get(key).copied()
    }

    pub(super) fn curve(&self, key: &str) -> Result<Option<Curve>, String> {
        let input = self.law.curves.iter().find(|c| c.key == key);
        let (Some(rows), Some(input)) = (self.recipe.curves.get(key), input) else {
            return Ok(None);
        };
        let typed = Curve::table(rows).map_err(|m| self.says(format!("curve `{key}`: {m}")))?;
        Ok(Some(typed.scaled(input.x_si, input.y_si)))
    }

    pub(super) fn plies(&self) -> &[Ply] {
        &self.recipe.plies
    }

    /// A message with the name of the law before it.
    pub(super) fn says(&self, message: String) -> String {
        format!("fabric `{}`: {message}", self.law.name)
    }

    /// Refuses two ways of saying the same thing, and none: the keys of which exactly one must be there.
    pub(super) fn exactly_one(&self, keys: &[&str]) -> Result<(), String> {
        let given = |key: &&&str| self.si.contains_key(**key) || self.recipe.curves.contains_key(**key);
        match keys.iter().filter(given).count() {
            1 => Ok(()),
            n => {
                let found = if n == 0 { "none is written" } else { "more than one is written" };
                Err(self.says(format!("write one of `{}`; {found}", keys.join("`, `"))))
            }
        }
    }
}

fn known<'a>(law: &str, what: &str, given: impl Iterator<Item = &'a String>, keys: &[&str]) -> Result<(), String> {
    for key in given {
        if !keys.contains(&key.as_str()) {
            let help = match keys {
                [] => format!("it has no {what}s; leave the line out"),
                _ => format!("write one of {}", keys.join(", ")),
            };
            return Err(format!("fabric `{law}` has no {what} `{key}`; {help}"));
        }
    }
    Ok(())
}

pub(super) const THICKNESS: LawParameter =
    number("thickness_mm", "mm", 1e-3, [1e-4, 100.0]).required("thickness of the sheet");

/// A number with its factor to SI, and its bounds as written.
pub(super) const fn number(key: Text, unit: Text, si: f64, [lower, upper]: [f64; 2]) -> LawParameter {
    LawParameter { key, unit, si, lower, upper, need: Need::Required, meaning: "" }
}

pub(super) const fn modulus(key: Text) -> LawParameter {
    number(key, "MPa", 1e6, [1e-6, 1e6])
}

pub(super) const fn ratio(key: Text, bounds: [f64; 2]) -> LawParameter {
    number(key, "-", 1.0, bounds)
}

impl LawParameter {
    pub(super) const fn required(self, meaning: Text) -> LawParameter {
        LawParameter { meaning, ..self }
    }

    pub(super) const fn optional(self, meaning: Text) -> LawParameter {
        let need = Need::Optional;
        LawParameter { need, meaning, ..self }
    }

    pub(super) const fn or(self, value: f64, meaning: Text) -> LawParameter {
        let need = Need::Default(value);
        LawParameter { need, meaning, ..self }
    }
}

type CurveColumn = (Text, f64);

/// Columns of a table, each a unit with its factor to SI.
pub(super) const fn table(key: Text, (x_unit, x_si): CurveColumn, (y_unit, y_si): CurveColumn) -> CurveInput {
    CurveInput { key, x_unit, x_si, y_unit, y_si, meaning: "" }
}

impl CurveInput {
    pub(super) const fn means(self, meaning: Text) -> CurveInput {
        CurveInput { meaning, ..self }
    }
}

/// What most laws are: one sheet described by numbers; entries say how they differ.
pub(super) const SHEET: Law = Law {
    name: "",
    parameters: &[],
    curves: &[],
    plies: [0, 0],
    strain_limit: 0.05,
    example: Recipe::default,
    make: |_| Err(String::new()),
};
