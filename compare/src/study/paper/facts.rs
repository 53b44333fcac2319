//! A sentence of the paper and its verdict, and what it may be compared with.

use super::{MESHES_MM, PaperRun, find};
use data::Published;
use serde::Serialize;

/// Result of checking a sentence of the paper.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(tag = "is", content = "why", rename_all = "snake_case")]
pub enum FactVerdict {
    /// The engine agrees.
    Holds,
    /// The engine gives something else.
    Misses(String),
    /// No run decides it.
    CannotBeChecked(String),
}

impl FactVerdict {
    /// The verdict with its reason, in words.
    pub fn words(&self) -> String {
        match self {
            FactVerdict::Holds => "holds".into(),
            FactVerdict::Misses(by) => format!("misses: {by}"),
            FactVerdict::CannotBeChecked(why) => format!("cannot be checked: {why}"),
        }
    }
}

/// A sentence of the paper and its verdict.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FactRow {
    /// Name of the fact in the list of facts.
    pub id: String,
    /// Section, table or figure of the paper.
    pub place: String,
    /// The sentence as the paper prints it, shortened.
    pub says: String,
    /// The result of the engine.
    pub found: String,
    /// Whether the finding supports the sentence.
    pub verdict: FactVerdict,
}

/// What a check found, in words, and what it is instead where the sentence does not hold; `None` without the runs that it needs.
pub(super) type FactFound = Option<(String, Option<String>)>;

/// Name of a fact, the runs that it needs, and its check.
pub(super) type FactCheck = (&'static str, &'static str, fn(&FactCase) -> FactFound);

pub(super) fn holds_if(holds: bool, found: String, else_by: impl Into<String>) -> FactFound {
    Some((found, (!holds).then(|| else_by.into())))
}

/// A fact with everything that it may be compared with.
pub(super) struct FactCase<'a> {
    pub paper: &'a Published,
    pub runs: &'a [PaperRun],
    pub numbers: &'a [f64],
}

impl<'a> FactCase<'a> {
    /// A number of the fact; NaN if the file has fewer, which a test refuses.
    pub(super) fn number(&self, k: usize) -> f64 {
        self.numbers.get(k).copied().unwrap_or(f64::NAN)
    }

    /// Runs of the robots at the pressures on the finest mesh that has all of them.
    pub(super) fn all(&self, wanted: &[(&str, f64)]) -> Option<([f64; 2], Vec<&'a PaperRun>)> {
        MESHES_MM.iter().rev().find_map(|mesh| {
            let found = wanted.iter().map(|(kind, kpa)| find(self.runs, kind, *mesh, *kpa));
            Some((*mesh, found.collect::<Option<_>>()?))
        })
    }
}
