//! A diagnosis compared with the truth.

use super::effects::by_name;
use super::truth::Truth;
use compare::diagnosis::{Diagnosis, Verdict};
use serde::{Deserialize, Serialize};

/// The scored part of a diagnosis.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Claim {
    /// `none`, `effect` or `out_of_catalog`; `None` if it gives no verdict.
    pub verdict: Option<String>,
    /// Effects of the catalogue, best first, those on a bound left out.
    pub ranked: Vec<String>,
    /// The indistinguishable set; a pair is written `a + b`.
    pub set: Vec<String>,
    /// Effects it adds to the model.
    pub added: Vec<String>,
}

/// How an answer compares with the truth.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct ClaimScore {
    /// It reports that something is missing.
    pub alarm: bool,
    /// It reports that nothing in the catalogue explains the data.
    pub out_of_catalog: bool,
    /// The verdict is the right one of the three.
    pub verdict_right: bool,
    /// Place of the best placed true effect in the ranking, counted from 1.
    pub rank: Option<usize>,
    /// A true effect is in the stated set.
    pub in_set: bool,
    /// All true effects are in the stated set together (a pair of them, or the one).
    pub all_in_set: bool,
    /// Number of names or pairs in the stated set.
    pub set_size: usize,
    /// How many of the added effects are true.
    pub named: usize,
    /// An effect that is not true is asserted: it was added, and no entry of the stated set is free of such.
    pub wrong: bool,
}

impl Claim {
    /// The scored parts of a diagnosis.
    pub fn of(diagnosis: &Diagnosis) -> Claim {
        let verdict = match diagnosis.verdict {
            Some(Verdict::None) => Some("none"),
            Some(Verdict::Effect) => Some("effect"),
            Some(Verdict::OutOfCatalog) => Some("out_of_catalog"),
            None => None,
        };
        let mut ranked: Vec<_> = diagnosis.ranked.iter().filter(|row| !row.at_bound).collect();
        ranked.sort_by(|a, b| a.bic_difference.total_cmp(&b.bic_difference));
        Claim {
            verdict: verdict.map(str::to_string),
            ranked: ranked.iter().map(|row| row.effect.clone()).collect(),
            set: diagnosis.indistinguishable.clone(),
            added: diagnosis.added.iter().map(|added| added.effect.clone()).collect(),
        }
    }
}

/// Compares an answer with the truth; effects outside the catalogue cannot be named.
pub fn score(truth: &Truth, answer: &Claim) -> ClaimScore {
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
    let is_true = |name: &String| names.contains(&name.as_str());
    let excused = answer.set.iter().any(|entry| members(entry).iter().all(is_true));
    let verdict = answer.verdict.as_deref();
    let asserted = verdict == Some("effect") && !answer.added.iter().all(is_true);
    ClaimScore {
        alarm: verdict.is_some_and(|verdict| verdict != "none"),
        out_of_catalog: verdict == Some("out_of_catalog"),
        verdict_right: verdict == Some(right),
        rank: answer.ranked.iter().position(|name| true_names.contains(&name.as_str())).map(|place| place + 1),
        in_set,
        all_in_set: !true_names.is_empty() && answer.set.iter().any(all_of),
        set_size: answer.set.len(),
        named,
        wrong: asserted && !excused,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Draw;

    fn scored(hidden: &[&str], verdict: &str, set: &[&str], added: &[&str]) -> ClaimScore {
        let mut truth = Truth::draw("epam", &mut Draw::new(1, 1)).unwrap();
        hidden.iter().for_each(|name| truth.add(name, 1.0));
        let own = |list: &[&str]| list.iter().map(|name| name.to_string()).collect::<Vec<_>>();
        let ranked = own(&["gravity", "creep", "leak"]);
        score(&truth, &Claim { verdict: Some(verdict.into()), ranked, set: own(set), added: own(added) })
    }

    #[test]
    fn a_wrong_name_beside_the_right_one_in_the_set_is_no_assertion() {
        let s = scored(&["creep"], "effect", &["gravity", "creep"], &["gravity"]);
        assert_eq!((s.alarm, s.verdict_right, s.rank, s.in_set, s.wrong), (true, true, Some(2), true, false));
        assert!(scored(&["creep"], "effect", &["gravity"], &["gravity"]).wrong);
    }

    #[test]
    fn of_two_effects_a_pair_with_one_wrong_member_is_wrong_unless_the_set_offers_a_right_one() {
        let hidden = ["creep", "leak"];
        assert!(scored(&hidden, "effect", &["creep + gravity"], &["creep", "gravity"]).wrong);
        let s = scored(&hidden, "effect", &["creep + gravity", "leak + creep"], &["creep", "gravity"]);
        assert_eq!((s.wrong, s.named, s.all_in_set), (false, 1, true));
        assert_eq!(scored(&hidden, "effect", &["creep + leak"], &["creep", "leak"]).named, 2);
    }

    #[test]
    fn nothing_and_something_outside_have_verdicts_of_their_own() {
        assert!(scored(&[], "none", &[], &[]).verdict_right && !scored(&[], "effect", &[], &[]).verdict_right);
        assert!(scored(&["kink"], "out_of_catalog", &[], &[]).verdict_right);
    }
}
