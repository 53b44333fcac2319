//! Every sentence of the paper that can be checked, next to the result of the engine or of the paper itself.

use super::in_print::IN_PRINT;
use super::in_runs::IN_RUNS;
use super::{MESHES_MM, PaperRun, find};
use data::{Published, PublishedFact};
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

/// All facts of the paper with the checks of their names, in the order of its file.
pub fn facts(paper: &Published, runs: &[PaperRun]) -> Vec<FactRow> {
    let row = |fact: &PublishedFact| {
        let case = FactCase { paper, runs, numbers: &fact.numbers };
        let known = IN_PRINT.iter().chain(IN_RUNS).find(|(id, _)| *id == fact.id);
        let found = known.and_then(|(_, check)| check(&case));
        let unchecked = || {
            let why = if known.is_some() { missing(&fact.id) } else { "no check exists" };
            ("–".into(), FactVerdict::CannotBeChecked(why.into()))
        };
        let (found, verdict) = found.unwrap_or_else(unchecked);
        FactRow { id: fact.id.clone(), place: fact.place.clone(), says: fact.says.clone(), found, verdict }
    };
    paper.facts.iter().map(row).collect()
}

fn missing(id: &str) -> &'static str {
    match id {
        "patterns" => "readings hold no shape of the folds; the pictures of ibr simulate show them",
        "axes" => "readings hold no axis of the actuator",
        "order" => "no run of all four at 30 kPa on one mesh",
        "buckling" => "no run of the cPAM at 10 and 13 kPa on one mesh",
        "sensitive" => "no run of the cPAM at 10, 13, 20 and 30 kPa",
        "pressure-explains" => "no run of the cPAM at 10, 13 and 20 kPa",
        "fpam-stable" => "no run of the fPAM at 10, 20 and 30 kPa",
        "mesh-gain" | "mesh-deeper" => "no run of the cPAM or the ePAM on both meshes at 30 kPa",
        "mesh-cost" => "no run of one robot on both meshes at 30 kPa",
        "kinetic-valid" | "kinetic-kept" => "no run of any robot",
        "stress-seams" => "no run of a welded robot at 30 kPa",
        "stress-alike" => "no run of sPAM and ePAM at 30 kPa on one mesh",
        "stress-cap" => "no run of a robot at 30 kPa",
        "base" => "no run of a robot with an encastre base",
        "section" => "no run of the sPAM at 30 kPa",
        "ratio-epam" | "ratio-spam" | "mesh-insensitive" => "no run of these",
        _ => "a number that it needs is not printed",
    }
}
