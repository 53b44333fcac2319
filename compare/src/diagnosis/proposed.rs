//! Proposed experiments, as a diagnosis says them.

use serde::Serialize;

/// A proposed experiment.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Experiment {
    /// Short name.
    pub name: String,
    /// What to do.
    pub sentence: String,
    /// Protocol in the form of `ibr data generate --protocol`; empty of a test by itself.
    pub protocol: String,
    /// What is to be measured directly.
    pub direct: data::Direct,
    /// Tests of their own beside it, whose results go into `[measured]` of `about.toml`.
    pub tests: Vec<String>,
    /// Expected separation λ of the best explanation from each rival, same number of runs.
    pub separations: Vec<Separation>,
    /// λ that tells two explanations apart in about nine of ten cases: 16, and more the more a law's form is granted, a
    /// twentieth of the best gain.
    pub needed: f64,
    /// Rivals with as much.
    pub separated: usize,
    /// Smallest λ of the rivals it can tell apart (λ ≥ 3 after up to four times the runs), else the largest of all.
    pub lambda: f64,
    /// Runs needed for what suffices there; `None` if no number of runs does, or for a test by itself.
    pub runs_needed: Option<usize>,
}

impl Experiment {
    /// The protocol for a table: a dash of a test by itself.
    pub fn shown_protocol(&self) -> &str {
        if self.protocol.is_empty() { "–" } else { &self.protocol }
    }
}

/// Expected separation of two explanations after an experiment.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Separation {
    /// Rival explanation.
    pub rival: String,
    /// λ: expected difference of the whitened sums of squares.
    pub lambda: f64,
}

/// What to measure next.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
pub struct NextExperiment {
    /// The explanation the rivals are to be told from; empty where there are none.
    pub best: String,
    /// The recommended one; `None` if no listed experiment separates anything, and where no effect of the catalogue is the answer.
    pub recommended: Option<Experiment>,
    /// λ with what is there already.
    pub now: Vec<Separation>,
    /// λ that would suffice there.
    pub needed_now: f64,
    /// All that were tried, best first; none for an answer outside the catalogue.
    pub tried: Vec<Experiment>,
    /// In words.
    pub sentence: String,
}
