//! Hypotheses of a diagnosis weighed by one rule on the bends that were measured ([`crate::moment::weigh`]).
//!
//! Nothing, one effect, two, a law that nobody wrote down, and a fault of a place, a hold or a marker. Every law's form is
//! uncertain by a smooth factor along bend and pressure.

use super::case::Case;
use super::decide::Decision;
use super::judge::{Hypothesis, Judge};
use crate::error::CompareError;
use crate::moment::shares;
use crate::policy;
use crate::stats::chi2_tail;
use serde::Serialize;

/// What kind of thing a hypothesis says.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Kind {
    /// Nothing is missing.
    Nothing,
    /// One effect of the catalogue.
    One,
    /// Two of them.
    Two,
    /// A law that is not in the catalogue.
    Unknown,
    /// A place, a hold or a marker is at fault.
    Fault,
}

/// A hypothesis and its share of the evidence.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Judged {
    /// What it says: effects as `a` or `a + b`, else words.
    pub hypothesis: String,
    /// Its kind.
    pub kind: Kind,
    /// Share of all evidence.
    pub share: f64,
    /// What it leaves of the measured bends, in squares of standard deviations.
    pub misfit: f64,
    /// p of that and of what the shape leaves, which no hypothesis of bending mends.
    pub p_misfit: f64,
}

/// What the shares say.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Ruling {
    /// Something is missing.
    pub alarm: bool,
    /// The smallest set that holds [`policy::RULED`] of what is not nothing, best first.
    pub set: Vec<String>,
    /// An unknown law or a fault has more than all effects, or the best of all does not meet the data.
    pub outside: bool,
}

impl Ruling {
    /// Of weighed hypotheses, the largest share first.
    pub fn of(judged: &[Judged]) -> Ruling {
        let sum = |kinds: &[Kind]| judged.iter().filter(|j| kinds.contains(&j.kind)).map(|j| j.share).sum::<f64>();
        let (nothing, effects) = (sum(&[Kind::Nothing]), sum(&[Kind::One, Kind::Two]));
        let mut entries = entries(judged);
        entries.sort_by(|a, b| b.1.total_cmp(&a.1));
        let (mut held, mut set) = (0.0, Vec::new());
        for (hypothesis, share) in entries {
            if held < policy::RULED * (1.0 - nothing) {
                set.push(hypothesis);
            }
            held += share;
        }
        let is_met = judged.first().is_some_and(|best| best.p_misfit > policy::UNMET);
        let outside = sum(&[Kind::Unknown, Kind::Fault]) > effects || !is_met;
        Ruling { alarm: nothing < 1.0 - policy::RULED, set, outside }
    }
}

/// Names and their shares: those of one name together, and a pair that says less than one of its effects alone with that effect.
fn entries(judged: &[Judged]) -> Vec<(String, f64)> {
    let mut entries: Vec<(String, f64)> = Vec::new();
    for j in judged.iter().filter(|j| j.kind != Kind::Nothing) {
        let part = |name: &str| j.hypothesis == name || j.hypothesis.split(" + ").any(|part| part == name);
        // The largest come first, so that what holds more than a pair is there before it.
        match entries.iter_mut().find(|(name, _)| part(name)) {
            Some((_, share)) => *share += j.share,
            None => entries.push((j.hypothesis.clone(), j.share)),
        }
    }
    entries
}

/// Weighs everything; the largest share first.
///
/// # Errors
/// Data of which no shape comes near.
pub fn judged(case: &Case, decision: &Decision) -> Result<Vec<Judged>, CompareError> {
    let judge = Judge::new(case)?;
    let mut all = judge.singles(decision);
    all.extend(judge.pairs(&all));
    all.extend(judge.nothing());
    all.extend(judge.unknown());
    all.extend(judge.faults());
    let shares = shares(&all.iter().map(|h| (h.weighed.minus_two_ln, h.weight)).collect::<Vec<_>>());
    let of_shape = judge.p_of_shapes();
    let told = |(h, share): (Hypothesis, f64)| Judged {
        hypothesis: h.words,
        kind: h.kind,
        share,
        misfit: h.weighed.misfit,
        p_misfit: (2.0 * chi2_tail(h.weighed.misfit, judge.dof()).min(of_shape)).min(1.0),
    };
    let mut told: Vec<Judged> = all.into_iter().zip(shares).map(told).collect();
    told.sort_by(|a, b| b.share.total_cmp(&a.share));
    Ok(told)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_set_is_the_smallest_that_holds_enough_and_nothing_is_no_name() {
        let judged = |hypothesis: &str, kind, share| Judged {
            hypothesis: hypothesis.into(),
            kind,
            share,
            misfit: 0.0,
            p_misfit: 0.5,
        };
        let all = [
            judged("a", Kind::One, 0.6),
            judged("unknown law", Kind::Unknown, 0.25),
            judged("unknown law", Kind::Unknown, 0.1),
            judged("nothing", Kind::Nothing, 0.03),
            judged("a + b", Kind::Two, 0.01),
            judged("b", Kind::One, 0.01),
        ];
        let ruling = Ruling::of(&all);
        assert!(ruling.alarm && !ruling.outside);
        assert_eq!(ruling.set, ["a", "unknown law"]);
        assert!(!Ruling::of(&[judged("a", Kind::One, 0.9), judged("nothing", Kind::Nothing, 0.1)]).alarm);
    }
}
