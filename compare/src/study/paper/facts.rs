//! Every sentence of the paper that can be checked, next to the result of the engine or of the paper itself.

use super::{MESHES_MM, PaperRun, find};
use data::Published;
use serde::Serialize;

/// Result of checking a sentence of the paper.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(tag = "is", content = "why", rename_all = "snake_case")]
pub enum FactVerdict {
    /// The engine or the paper's own numbers say the same.
    Holds,
    /// The engine or the paper's own numbers say something else.
    Misses(String),
    /// The paper contradicts it elsewhere.
    ContradictsItself(String),
    /// Neither runs nor printed numbers decide it.
    CannotBeChecked(String),
}

impl FactVerdict {
    /// The verdict with its reason, in words.
    pub fn words(&self) -> String {
        match self {
            FactVerdict::Holds => "holds".into(),
            FactVerdict::Misses(by) => format!("misses: {by}"),
            FactVerdict::ContradictsItself(how) => format!("contradicts itself: {how}"),
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
    /// The result of the engine, or of the paper elsewhere.
    pub found: String,
    /// Whether the finding supports the sentence.
    pub verdict: FactVerdict,
}

/// What a check found, in words, and what follows; `None` without the numbers or runs that it needs.
pub(super) type FactFound = Option<(String, FactVerdict)>;

pub(super) type FactCheck = (&'static str, fn(&FactCase) -> FactFound);

pub(super) fn holds_if(holds: bool, found: String, else_by: impl Into<String>) -> FactFound {
    Some((found, if holds { FactVerdict::Holds } else { FactVerdict::Misses(else_by.into()) }))
}

pub(super) fn contradicts_itself(found: impl Into<String>, how: impl Into<String>) -> FactFound {
    Some((found.into(), FactVerdict::ContradictsItself(how.into())))
}

pub(super) fn cannot_be_checked(found: impl Into<String>, why: &str) -> FactFound {
    Some((found.into(), FactVerdict::CannotBeChecked(why.into())))
}

pub(super) fn joined(words: impl Iterator<Item = String>) -> String {
    words.collect::<Vec<_>>().join(", ")
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

    /// Largest displacement that the paper reports for this actuator \[mm\].
    pub(super) fn d_max_mm(&self, kind: &str) -> Option<f64> {
        Some(self.paper.actuator(kind)?.d_max_m * 1e3)
    }

    /// Runs of the robots at the pressures on the finest mesh that has all of them.
    pub(super) fn all(&self, wanted: &[(&str, f64)]) -> Option<([f64; 2], Vec<&'a PaperRun>)> {
        MESHES_MM.iter().rev().find_map(|mesh| {
            let found = wanted.iter().map(|(kind, kpa)| find(self.runs, kind, *mesh, *kpa));
            Some((*mesh, found.collect::<Option<_>>()?))
        })
    }
}
