//! Lines with their numbers, and the numbers in them: what all readers share.

/// The lines of a text that have something on them.
pub(super) struct Scan<'a> {
    lines: std::str::Lines<'a>,
    /// Bytes of text: no count in it can be larger.
    size: usize,
    /// Line that messages name, counted from 1: the last one read, unless a reader looks back.
    pub(super) number: usize,
}

impl<'a> Scan<'a> {
    pub(super) fn new(text: &'a str) -> Scan<'a> {
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        Scan { lines: text.lines(), size: text.len(), number: 0 }
    }

    /// The next line that is not empty, without spaces around it; `None` at the end.
    pub(super) fn line(&mut self) -> Option<&'a str> {
        for line in self.lines.by_ref() {
            self.number += 1;
            if !line.trim().is_empty() {
                return Some(line.trim());
            }
        }
        None
    }

    /// Words of a line that must be there.
    pub(super) fn row(&mut self, what: &str) -> Result<Vec<&'a str>, String> {
        let line = self.line().ok_or_else(|| cut_off(what))?;
        Ok(line.split_whitespace().collect())
    }

    pub(super) fn count(&self, word: &str) -> Result<usize, String> {
        let count: usize = word.parse().map_err(|_| format!("expected how many lines follow, found `{word}`"))?;
        if count > self.size {
            return Err(format!("{count} lines cannot follow in a file of {} bytes", self.size));
        }
        Ok(count)
    }
}

pub(super) fn cut_off(what: &str) -> String {
    format!("the file ends before {what}: it was cut off; write it again")
}

/// A finite number; `1.5D-3` as Fortran writes it too.
pub(super) fn number(word: &str) -> Result<f64, String> {
    let number = word.parse().or_else(|_| word.replace(['d', 'D'], "e").parse::<f64>());
    match number {
        Err(_) => Err(format!("expected a number, found `{word}`")),
        Ok(number) if number.is_finite() => Ok(number),
        Ok(_) => Err(format!("expected a finite number, found `{word}`")),
    }
}

pub(super) fn numbers(words: &[&str]) -> Result<Vec<f64>, String> {
    words.iter().map(|word| number(word)).collect()
}

/// The first three words as a place.
pub(super) fn place(words: &[&str]) -> Result<[f64; 3], String> {
    let [x, y, z, ..] = words else { return Err(format!("expected x y z, found {} words", words.len())) };
    Ok([number(x)?, number(y)?, number(z)?])
}

/// A number of a node, an element or a group.
pub(super) fn whole(word: &str) -> Result<u64, String> {
    word.parse().map_err(|_| format!("expected a whole number, found `{word}`"))
}
