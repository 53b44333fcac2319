//! A diagnosis held against the truth.

use super::effects::by_name;
use super::truth::Truth;
use crate::diagnosis::{Diagnosis, Verdict};
use serde::Serialize;

/// What a diagnosis says, as far as it is scored.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Answer {
    /// `none`, `effect` or `out_of_catalog`; empty if it gives no verdict.
    pub verdict: String,
    /// Effects of the catalogue, best first, those on a bound left out.
    pub ranked: Vec<String>,
    /// The indistinguishable set; a pair is written `a + b`.
    pub set: Vec<String>,
    /// Effects it adds to the model.
    pub added: Vec<String>,
}

/// How good an answer is.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Score {
    /// It says that something is missing.
    pub alarm: bool,
    /// It says that nothing in the catalogue explains the data.
    pub out_of_catalog: bool,
    /// The verdict is the right one of the three.
    pub verdict_right: bool,
    /// Place of the best placed true effect in the ranking, counted from 1.
    pub rank: Option<usize>,
    /// A true effect is in the stated set.
    pub in_set: bool,
    /// All true effects are in the stated set together (a pair of them, or the one).
    pub all_in_set: bool,
    /// Names in the set.
    pub set_size: usize,
    /// True effects among the added.
    pub named: usize,
    /// Added effects that are not true, and for which no true one stands in the set.
    pub wrong: usize,
}

impl Answer {
    /// Of a diagnosis.
    pub fn of(diagnosis: &Diagnosis) -> Answer {
        let verdict = match diagnosis.verdict {
            Some(Verdict::None) => "none",
            Some(Verdict::Effect) => "effect",
            Some(Verdict::OutOfCatalog) => "out_of_catalog",
            None => "",
        };
        let mut ranked: Vec<_> = diagnosis.ranked.iter().filter(|row| !row.at_bound).collect();
        ranked.sort_by(|a, b| a.bic_difference.total_cmp(&b.bic_difference));
        Answer {
            verdict: verdict.to_string(),
            ranked: ranked.iter().map(|row| row.effect.clone()).collect(),
            set: diagnosis.indistinguishable.clone(),
            added: diagnosis.added.iter().map(|added| added.effect.clone()).collect(),
        }
    }
}

/// Scores an answer.
pub fn score(truth: &Truth, answer: &Answer) -> Score {
    let inside = |name: &&str| by_name(name).is_some_and(|effect| !effect.is_outside());
    let names: Vec<&str> = truth.effects.iter().map(|choice| choice.name.as_str()).collect();
    let true_names: Vec<&str> = names.iter().copied().filter(|name| inside(name)).collect();
    let right = match (names.len(), true_names.len()) {
        (0, _) => "none",
        (all, inside) if all == inside => "effect",
        _ => "out_of_catalog",
    };
    let members = |entry: &str| entry.split('+').map(|part| part.trim().to_string()).collect::<Vec<_>>();
    let holds = |entry: &String, name: &str| members(entry).iter().any(|member| member == name);
    let in_set = true_names.iter().any(|name| answer.set.iter().any(|entry| holds(entry, name)));
    let all_of = |entry: &String| true_names.iter().all(|name| holds(entry, name));
    let named = true_names.iter().filter(|name| answer.added.iter().any(|added| added == *name)).count();
    let wrong = answer.added.iter().filter(|added| !names.contains(&added.as_str())).count();
    Score {
        alarm: !answer.verdict.is_empty() && answer.verdict != "none",
        out_of_catalog: answer.verdict == "out_of_catalog",
        verdict_right: answer.verdict == right,
        rank: answer.ranked.iter().position(|name| true_names.contains(&name.as_str())).map(|place| place + 1),
        in_set,
        all_in_set: !true_names.is_empty() && answer.set.iter().any(all_of),
        set_size: answer.set.len(),
        named,
        wrong: if in_set { 0 } else { wrong },
    }
}
