//! Every fact of the paper with the check of its name.

use super::PaperRun;
use super::facts::{FactCase, FactRow, FactVerdict};
use super::in_print::IN_PRINT;
use super::in_runs::IN_RUNS;
use data::{Published, PublishedFact};

/// All facts of the paper, in the order of its file.
pub fn facts(paper: &Published, runs: &[PaperRun]) -> Vec<FactRow> {
    let row = |fact: &PublishedFact| {
        let case = FactCase { paper, runs, numbers: &fact.numbers };
        let known = IN_PRINT.iter().chain(IN_RUNS).find(|(id, ..)| *id == fact.id);
        let (missing, found) = known.map_or(("there is no check of it", None), |(_, of, check)| (*of, check(&case)));
        let (found, verdict) = found.unwrap_or_else(|| ("–".into(), FactVerdict::CannotBeChecked(missing.into())));
        FactRow { id: fact.id.clone(), place: fact.place.clone(), says: fact.says.clone(), found, verdict }
    };
    paper.facts.iter().map(row).collect()
}
