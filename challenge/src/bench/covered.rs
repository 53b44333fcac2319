//! How often a stated set holds the truth: the figure that is printed with a set.
//!
//! First, over all sets with a verdict that names, whatever is hidden. Second, with one law left out, over single effects: the margin is
//! how far an effect may be behind the best and still be stated. It is tuned to cover [`TARGET`] of the sets of all other laws; the figure
//! is its coverage of the law left out.

use super::outcome::{Lot, Named, SetOutcome, names};
use super::row::{Goal, Rate};
use super::table;
use crate::Hiding;
use compare::policy;
use compare::stats::quantile;

const TARGET: f64 = 0.95;
const WITHIN: f64 = 0.03;

/// Rows of the table; `others`: whether the stated sets of other parts contain the truth.
pub(super) fn rows(outcomes: &[SetOutcome], others: impl Iterator<Item = bool>) -> Vec<Rate> {
    let all = table::found(outcomes, Lot::Hidden(Hiding::One));
    let named = outcomes.iter().filter_map(|o| o.named.as_ref());
    let stated = named.filter(|n| n.score.set_size > 0).map(|n| n.score.in_set);
    let hits: Vec<bool> = stated.chain(others).collect();
    let printed = Goal::Between(policy::COVERED - WITHIN, policy::COVERED + WITHIN);
    let hidden = outcomes.iter().filter(|o| !o.truth.effects.is_empty()).filter_map(|o| o.named.as_ref());
    let sure: Vec<bool> = hidden.filter(|n| n.identified).map(|n| n.score.in_set).collect();
    vec![
        Rate::share("every stated set", "it holds a true effect, as is printed", printed, &hits),
        Rate::share("one name, called identified", "it is the truth", Goal::AtLeast(TARGET), &sure),
        Rate::share(
            "a margin for 95 % of all other laws' sets",
            "it covers the law that was left out",
            Goal::Between(TARGET - WITHIN, TARGET + WITHIN),
            &left_out(&behind(&all)),
        ),
    ]
}

/// Law of every set, and by how much it was behind the best; none that was rejected.
fn behind(all: &[(&SetOutcome, &Named)]) -> Vec<(String, f64)> {
    let asked = all.iter().filter(|(_, named)| named.score.set_size > 0);
    asked.map(|(o, named)| (names(&o.truth).join(" + "), named.bic_behind.unwrap_or(f64::MAX))).collect()
}

/// Of every set, whether a margin from the sets of all other laws covers it.
fn left_out(behind: &[(String, f64)]) -> Vec<bool> {
    let covered = |(law, own): &(String, f64)| {
        let mut others: Vec<f64> = behind.iter().filter(|(other, _)| other != law).map(|(_, b)| *b).collect();
        others.sort_by(f64::total_cmp);
        quantile(&others, TARGET).is_some_and(|margin| *own <= margin)
    };
    behind.iter().map(covered).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Nineteen laws that are never behind, and one that always is: the margin of the others does not cover it.
    #[test]
    fn a_law_that_is_left_out_does_not_widen_its_own_margin() {
        let mut behind: Vec<(String, f64)> = (0..95).map(|i| (format!("law {}", i % 19), f64::from(i % 5))).collect();
        assert!(left_out(&behind).iter().all(|covered| *covered));
        behind.extend((0..5).map(|_| ("odd".to_string(), 50.0)));
        let covered = left_out(&behind);
        assert!(covered[..95].iter().all(|c| *c) && covered[95..].iter().all(|c| !c));
    }
}
