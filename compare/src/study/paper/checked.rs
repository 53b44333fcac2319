//! Every fact of the paper with the check of its name.

use super::PaperRun;
use super::facts::{FactCase, FactRow, FactVerdict};
use super::in_print::IN_PRINT;
use super::in_runs::IN_RUNS;
use data::{Published, PublishedFact};

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
