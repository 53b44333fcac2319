//! Labels of runs and markers.

use std::collections::HashMap;

/// Labels numbered in order of first appearance.
#[derive(Debug, Default)]
pub(crate) struct Labels {
    pub names: Vec<String>,
    numbers: HashMap<String, usize>,
    last: usize,
}

impl Labels {
    /// The number of a label, new or known.
    pub(crate) fn number(&mut self, name: &str) -> usize {
        if self.names.get(self.last).is_none_or(|last| last != name) {
            self.last = match self.numbers.get(name) {
                Some(&number) => number,
                None => self.insert(name),
            };
        }
        self.last
    }

    fn insert(&mut self, name: &str) -> usize {
        self.names.push(name.to_string());
        self.numbers.insert(name.to_string(), self.names.len() - 1);
        self.names.len() - 1
    }
}
