//! Declared keys: one list for a table says name, unit, bounds and meaning of every number, and how it is read and written. The parser,
//! "did you mean", `--set`, studies and the tests of the documents all go over that list.

use super::range::{Checked, Range, number, plain, plain_number, refuse};
use toml::{Spanned, Value};

/// One number of a table that describes an `S`.
#[derive(Debug)]
pub struct Key<S: 'static> {
    /// Name with unit, as in the file.
    pub name: &'static str,
    /// Factor from the file to SI.
    pub si: f64,
    /// Accepted numbers, as in the file.
    pub bounds: [f64; 2],
    /// What it is, and what is usual.
    pub meaning: &'static str,
    /// Reads it \[SI\], if it is set.
    pub get: fn(&S) -> Option<f64>,
    /// Writes it \[SI\].
    pub set: fn(&mut S, f64),
}

pub(crate) const fn key<S>(
    name: &'static str,
    si: f64,
    bounds: [f64; 2],
    meaning: &'static str,
    get: fn(&S) -> Option<f64>,
    set: fn(&mut S, f64),
) -> Key<S> {
    Key { name, si, bounds, meaning, get, set }
}

impl<S> Key<S> {
    /// Writes a number as typed.
    pub(crate) fn read(&self, to: &mut S, value: &Spanned<Value>) -> Checked<()> {
        let [low, high] = self.bounds;
        let range = Range { si: self.si, ..plain(low, high, self.meaning) };
        let si = number(self.name, plain_number(self.name, value)?, value.span(), &range)?;
        if self.name == "seed" && si.fract() != 0.0 {
            return refuse(format!("seed must be a whole number, not {si}"), "write for example 1", value.span());
        }
        if self.name == "mass_passes" && ![2.0, 4.0, 6.0].contains(&si) {
            return refuse(format!("mass_passes cannot be {si}"), "write 2, 4 or 6", value.span());
        }
        (self.set)(to, si);
        Ok(())
    }
}

/// The number of that name.
pub(crate) fn named<S>(keys: &'static [Key<S>], name: &str) -> Option<&'static Key<S>> {
    keys.iter().find(|key| key.name == name)
}
