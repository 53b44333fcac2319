//! Names people type: the nearest known one for a misspelling.

/// The name nearest to `wrong` by edit distance, if it is near enough to be a slip.
pub(crate) fn nearest<'a>(wrong: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let wrong: Vec<char> = wrong.to_lowercase().chars().collect();
    let (found, edits) = known.into_iter().map(|name| (name, edits(&wrong, name))).min_by_key(|(_, edits)| *edits)?;
    (edits <= 1 + wrong.len() / 4).then_some(found)
}

/// " Did you mean `x`?", or nothing.
pub(crate) fn meant<'a>(wrong: &str, known: impl IntoIterator<Item = &'a str>) -> String {
    nearest(wrong, known).map_or(String::new(), |name| format!("; did you mean `{name}`?"))
}

/// Insertions, deletions and replacements from one word to the other.
fn edits(wrong: &[char], name: &str) -> usize {
    let mut row: Vec<usize> = (0..=wrong.len()).collect();
    for (i, letter) in name.to_lowercase().chars().enumerate() {
        let mut diagonal = row[0];
        row[0] = i + 1;
        for (j, other) in wrong.iter().enumerate() {
            let replaced = diagonal + usize::from(letter != *other);
            diagonal = row[j + 1];
            row[j + 1] = replaced.min(row[j] + 1).min(diagonal + 1);
        }
    }
    row[wrong.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_slip_finds_its_word_and_another_word_finds_none() {
        assert_eq!(nearest("quds", ["nodes", "quads", "set"]), Some("quads"));
        assert_eq!(nearest("elephant", ["nodes", "quads", "set"]), None);
        assert_eq!(edits(&"kitten".chars().collect::<Vec<_>>(), "sitting"), 3);
    }
}
