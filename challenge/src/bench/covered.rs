//! How often a stated set holds the truth, over all sets with a verdict that names: the figure that is printed with a set.

use super::outcome::SetOutcome;
use super::row::{Goal, Rate};
use compare::policy;

const TARGET: f64 = 0.95;
const WITHIN: f64 = 0.03;

/// Rows of the table; `others`: whether the stated sets of other parts contain the truth.
pub(super) fn rows(outcomes: &[SetOutcome], others: impl Iterator<Item = bool>) -> Vec<Rate> {
    let named = outcomes.iter().filter_map(|o| o.named.as_ref());
    let stated = named.filter(|n| n.score.set_size > 0).map(|n| n.score.in_set);
    let hits: Vec<bool> = stated.chain(others).collect();
    let printed = Goal::Between(policy::COVERED - WITHIN, policy::COVERED + WITHIN);
    let hidden = outcomes.iter().filter(|o| !o.truth.effects.is_empty()).filter_map(|o| o.named.as_ref());
    let sure: Vec<bool> = hidden.filter(|n| n.identified).map(|n| n.score.in_set).collect();
    vec![
        Rate::share("every stated set", "it holds a true effect, as is printed", printed, &hits),
        Rate::share("one name, called identified", "it is the truth", Goal::AtLeast(TARGET), &sure),
    ]
}
