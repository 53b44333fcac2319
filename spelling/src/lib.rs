//! What people type: the nearest known name for a misspelling, rows of exactly so many numbers, units. And files and folders: read
//! whole, and written whole or not at all.

pub mod files;
pub mod folders;
pub mod quantity;
pub mod si;
pub mod units;

use serde::de::{Deserialize, Deserializer, Error, SeqAccess, Visitor};
use std::fmt;
use std::ops::Deref;

/// So many numbers, neither more nor fewer: an array of a TOML file would silently drop the rest.
#[derive(Debug, Clone, Copy)]
pub struct Exactly<const N: usize>(pub [f64; N]);

impl<'de, const N: usize> Deserialize<'de> for Exactly<N> {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        from.deserialize_seq(ArrayVisitor)
    }
}

struct ArrayVisitor<const N: usize>;

impl<'de, const N: usize> Visitor<'de> for ArrayVisitor<N> {
    type Value = Exactly<N>;
    fn expecting(&self, to: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(to, "an array of length {N}")
    }
    fn visit_seq<A: SeqAccess<'de>>(self, mut row: A) -> Result<Exactly<N>, A::Error> {
        let mut given = Vec::new();
        while let Some(number) = row.next_element()? {
            given.push(number);
        }
        let count = given.len();
        given.try_into().map(Exactly).map_err(|_| A::Error::invalid_length(count, &self))
    }
}

impl<const N: usize> Deref for Exactly<N> {
    type Target = [f64; N];
    fn deref(&self) -> &[f64; N] {
        &self.0
    }
}

/// Fewest letters of a word that is taken for the beginning of a name.
const BEGUN: usize = 3;

/// The name nearest to `wrong` by edit distance, if it is near enough to be a slip; else the shortest one that begins with it.
///
/// ```
/// assert_eq!(spelling::nearest("epan", ["spam", "epam"]), Some("epam"));
/// assert_eq!(spelling::nearest("epam-text", ["epam", "epam-textbook"]), Some("epam-textbook"));
/// assert_eq!(spelling::nearest("tube", ["spam", "epam"]), None);
/// ```
pub fn nearest<'a>(wrong: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let (wrong, letters) = (wrong.to_lowercase(), wrong.chars().count());
    let distance = |name: &str| strsim::damerau_levenshtein(&wrong, &name.to_lowercase());
    let known: Vec<&str> = known.into_iter().collect();
    let (found, edits) = known.iter().map(|name| (*name, distance(name))).min_by_key(|(_, edits)| *edits)?;
    // A word all of whose letters are changed is another word.
    let near = (edits <= 1 + letters / 4 && edits < letters).then_some(found);
    let begun =
        || known.into_iter().filter(|name| letters >= BEGUN && name.starts_with(&wrong)).min_by_key(|n| n.len());
    near.or_else(begun)
}

/// "did you mean friction? ", to put before the known names; empty if nothing is near.
pub fn meant<'a>(wrong: &str, known: impl IntoIterator<Item = &'a str>) -> String {
    nearest(wrong, known).map_or(String::new(), |name| format!("did you mean {name}? "))
}

/// [`meant`] and the list of all names.
pub fn known(wrong: &str, names: &[&str]) -> String {
    format!("{}known: {}", meant(wrong, names.iter().copied()), names.join(", "))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_slip_finds_its_word_and_another_word_finds_none() {
        assert_eq!(nearest("p_act_kpa", ["p_atc_kpa", "note"]), Some("p_atc_kpa"));
        assert_eq!(nearest("x_mm", ["comment", "operator"]), None);
        assert_eq!(nearest("quds", ["nodes", "quads", "set"]), Some("quads"));
        assert_eq!(nearest("x", ["s", "R"]), None);
        assert_eq!(known("epm", &["spam", "epam"]), "did you mean epam? known: spam, epam");
        assert_eq!(known("robot", &["spam"]), "known: spam");
    }
}
