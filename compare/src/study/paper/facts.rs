//! Every sentence of the paper that can be checked, beside what the engine or the paper itself says.

use super::in_print::IN_PRINT;
use super::in_runs::IN_RUNS;
use super::{MESHES_MM, PaperRun, find};
use data::{Published, PublishedFact};
use serde::Serialize;

/// What a check came to.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(tag = "is", content = "why", rename_all = "snake_case")]
pub enum FactVerdict {
    /// The engine or the paper's own numbers say the same.
    Holds,
    /// They say something else.
    Misses(String),
    /// The paper says something else elsewhere.
    ContradictsItself(String),
    /// Nothing follows.
    CannotBeChecked(String),
}

impl FactVerdict {
    /// In words.
    pub fn words(&self) -> String {
        match self {
            FactVerdict::Holds => "holds".into(),
            FactVerdict::Misses(by) => format!("misses: {by}"),
            FactVerdict::ContradictsItself(how) => format!("contradicts itself: {how}"),
            FactVerdict::CannotBeChecked(why) => format!("cannot be checked: {why}"),
        }
    }

    /// Holds, or misses by what is said.
    pub(super) fn holds_if(holds: bool, else_by: impl Into<String>) -> FactVerdict {
        if holds { FactVerdict::Holds } else { FactVerdict::Misses(else_by.into()) }
    }
}

/// A sentence and its verdict.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FactRow {
    /// Name of the fact.
    pub id: String,
    /// Section, table or figure.
    pub place: String,
    /// As printed, shortened.
    pub says: String,
    /// What the engine says, or the paper elsewhere.
    pub found: String,
    /// What follows.
    pub verdict: FactVerdict,
}

/// What a check found, in words, and what follows.
pub(super) type FactFound = (String, FactVerdict);

/// A fact with everything it may be held against.
pub(super) struct FactCase<'a> {
    pub paper: &'a Published,
    pub runs: &'a [PaperRun],
    pub numbers: &'a [f64],
}

/// Name of a fact and its check.
pub(super) type FactCheck = (&'static str, fn(&FactCase) -> FactFound);

impl<'a> FactCase<'a> {
    /// A number of the fact; NaN if the file has fewer, which a test refuses.
    pub fn number(&self, k: usize) -> f64 {
        self.numbers.get(k).copied().unwrap_or(f64::NAN)
    }

    /// Runs of the robots at the pressures on the finest mesh that has all of them.
    pub fn all(&self, wanted: &[(&str, f64)]) -> Option<([f64; 2], Vec<&'a PaperRun>)> {
        MESHES_MM.iter().rev().find_map(|mesh| {
            let found: Option<Vec<&PaperRun>> =
                wanted.iter().map(|(kind, kpa)| find(self.runs, kind, *mesh, *kpa)).collect();
            Some((*mesh, found?))
        })
    }
}

/// For a check without its runs.
pub(super) fn no_runs(of: &str) -> FactFound {
    ("–".into(), FactVerdict::CannotBeChecked(format!("no run of {of}")))
}

/// All facts of the paper, in the order of its file.
pub fn facts(paper: &Published, runs: &[PaperRun]) -> Vec<FactRow> {
    paper.facts.iter().map(|fact| row(paper, runs, fact)).collect()
}

fn row(paper: &Published, runs: &[PaperRun], fact: &PublishedFact) -> FactRow {
    let check = IN_PRINT.iter().chain(IN_RUNS).find(|(id, _)| *id == fact.id);
    let case = FactCase { paper, runs, numbers: &fact.numbers };
    let (found, verdict) = check.map_or_else(
        || ("–".into(), FactVerdict::CannotBeChecked("there is no check of it".into())),
        |(_, check)| check(&case),
    );
    FactRow { id: fact.id.clone(), place: fact.place.clone(), says: fact.says.clone(), found, verdict }
}
