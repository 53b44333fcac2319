//! From outcomes to the rows of the table.

use super::outcome::{Lot, Named, SetOutcome, names};
use super::row::{Goal, Rate};
use crate::Hiding;
use Goal::{AtLeast, AtMost, Between};
use compare::policy;
use serde::Serialize;
use std::collections::BTreeMap;

/// One named effect with the hidden one.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Confusion {
    /// Effect that was hidden in these sets.
    pub truth: String,
    /// On top of the ranking; `none` without alarm, `out_of_catalog` for that verdict.
    pub named: String,
    /// In how many sets this name came on top.
    pub count: usize,
    /// Median λ between the two where the diagnosis gave it: below 16 the data do not hold the answer.
    pub lambda: Option<f64>,
    /// Median BIC by which the truth is behind the name: large without λ means that the catalogue's formula is not the
    /// robot's law.
    pub bic_behind: Option<f64>,
    /// Where nothing was found: smallest size of the truth that would have been, in typical sizes (median).
    pub smallest_detectable: Option<f64>,
}

/// A share of sets: its name, the goal, and whether a set counts.
type Counted = (&'static str, Goal, fn(&Named) -> bool);

const ALARM: Counted = ("alarm", AtLeast(0.95), |n| n.score.alarm);
const FALSE_ALARM: Counted = ("false alarms", AtMost(0.05), |n| n.score.alarm);
const IN_SET: Counted = ("with an alarm: truth in the stated set", AtLeast(0.93), |n| n.score.in_set);
const ALONE_IN_SET: Counted = (IN_SET.0, AtLeast(0.90), IN_SET.2);
const OUTSIDE: Counted = ("with an alarm: called outside the catalogue", AtMost(0.05), |n| n.score.out_of_catalog);
const NOTHING: Lot = Lot::Hidden(Hiding::Nothing);
const ONE: Lot = Lot::Hidden(Hiding::One);

/// Share of the names called identified that are true, and what the share printed with a set may be off by.
const TARGET: f64 = 0.95;
const WITHIN: f64 = 0.03;

type NamedOutcomes<'o> = Vec<(&'o SetOutcome, &'o Named)>;

pub(super) fn rows(outcomes: &[SetOutcome]) -> Vec<Rate> {
    let mut rows = nothing(outcomes);
    rows.extend(one(outcomes, ONE, "one hidden effect"));
    rows.extend(one(outcomes, Lot::Measured(Hiding::One), "one hidden effect, B measured to 10 %"));
    let lossy = found(outcomes, Lot::LostMarkers(Hiding::One));
    rows.extend(named(&lossy, "one hidden effect, markers lost", &[ALARM], &[IN_SET, OUTSIDE]));
    let white = found(outcomes, Lot::White(Hiding::One));
    rows.extend(named(&white, "one hidden effect, white noise", &[ALARM], &[IN_SET, OUTSIDE]));
    for (part, case) in [(Lot::Clamp, "a clamp of any stiffness"), (Lot::Softening, "a softening wall")] {
        rows.extend(named(&found(outcomes, part), case, &[ALARM], &[ALONE_IN_SET]));
    }
    let all: NamedOutcomes = outcomes.iter().filter_map(|o| Some((o, o.named.as_ref()?))).collect();
    rows.extend(after(outcomes));
    let two: [Counted; 5] = [
        ("at least one named", AtLeast(0.90), |n| n.score.named >= 1),
        ("both named", AtLeast(0.40), |n| n.score.named == 2),
        ("at least one in the stated set", AtLeast(0.90), |n| n.score.in_set),
        ("both, as one entry of the stated set", AtLeast(0.40), |n| n.score.all_in_set),
        ("a wrong name asserted", AtMost(0.15), |n| n.score.wrong),
    ];
    rows.extend(named(&found(outcomes, Lot::Hidden(Hiding::Two)), "two hidden effects", &two, &[]));
    let outside = found(outcomes, Lot::Hidden(Hiding::Outside));
    let flagged: Counted = ("flagged as such", AtLeast(0.90), |n| n.score.out_of_catalog);
    rows.push(share(&outside, "outside the catalogue", flagged));
    rows.extend(quality(outcomes));
    // Exchanged labels are the slip among the hidden effects.
    let is_slip = |outcome: &SetOutcome| outcome.truth.effects.iter().any(|choice| choice.name == "swapped_markers");
    let (slipped, right): (NamedOutcomes, NamedOutcomes) =
        all.iter().copied().partition(|(outcome, _)| is_slip(outcome));
    rows.push(share(&slipped, "labels exchanged", ("reported as a slip", AtLeast(0.90), |n| n.slip)));
    rows.push(share(&right, "all other sets", ("a slip reported without one", AtMost(0.01), |n| n.slip)));
    let pressures: Counted = ("a slip of pressures reported", AtMost(0.01), |n| n.pressure_slip);
    rows.push(share(&all, "sets with right pressures", pressures));
    rows
}

fn found(outcomes: &[SetOutcome], part: Lot) -> NamedOutcomes<'_> {
    outcomes.iter().filter(|o| o.part == part).filter_map(|o| Some((o, o.named.as_ref()?))).collect()
}

fn share(sets: &[(&SetOutcome, &Named)], case: &'static str, (figure, goal, hit): Counted) -> Rate {
    Rate::share(case, figure, goal, &sets.iter().map(|(_, named)| hit(named)).collect::<Vec<_>>())
}

/// Shares of all sets, then of those with an alarm.
fn named(sets: &NamedOutcomes, case: &'static str, of_all: &[Counted], of_asked: &[Counted]) -> Vec<Rate> {
    let asked = asked(sets);
    let of_all = of_all.iter().map(|counted| share(sets, case, *counted));
    of_all.chain(of_asked.iter().map(|counted| share(&asked, case, *counted))).collect()
}

fn asked<'o>(sets: &NamedOutcomes<'o>) -> NamedOutcomes<'o> {
    sets.iter().filter(|(_, named)| named.score.alarm).copied().collect()
}

fn nothing(outcomes: &[SetOutcome]) -> Vec<Rate> {
    let (case, tested_case) = ("no hidden effect", "no hidden effect, B measured to 10 %");
    let (all, tested) = (found(outcomes, NOTHING), found(outcomes, Lot::Measured(Hiding::Nothing)));
    let (few, many): (NamedOutcomes, NamedOutcomes) =
        all.iter().copied().partition(|(outcome, _)| outcome.truth.runs < 5);
    let held: Vec<bool> = all.iter().filter_map(|(_, named)| named.bending_held).collect();
    let lossy = found(outcomes, Lot::LostMarkers(Hiding::Nothing));
    let white = found(outcomes, Lot::White(Hiding::Nothing));
    vec![
        share(&white, "no hidden effect, white noise", FALSE_ALARM),
        share(&lossy, "no hidden effect, markers lost", FALSE_ALARM),
        share(&found(outcomes, Lot::HeavyTails), "no hidden effect, heavy tails", FALSE_ALARM),
        share(&many, case, ("false alarms, 5 and 10 runs", AtMost(0.03), FALSE_ALARM.2)),
        share(&few, case, ("false alarms, 3 runs", AtMost(0.05), FALSE_ALARM.2)),
        share(&tested, tested_case, FALSE_ALARM),
        Rate::share(case, "95 % interval of B holds B", AtLeast(0.9), &held),
    ]
}

fn one(outcomes: &[SetOutcome], part: Lot, case: &'static str) -> Vec<Rate> {
    let all = found(outcomes, part);
    let of_all: [Counted; 1] = [ALARM];
    let of_asked: [Counted; 3] = [
        ("with an alarm: truth on top", AtLeast(0.80), |n| n.score.rank.is_some_and(|r| r <= 1)),
        ("with an alarm: truth in the first three", AtLeast(0.92), |n| n.score.rank.is_some_and(|r| r <= 3)),
        IN_SET,
    ];
    let asked = asked(&all);
    let sized: Vec<f64> = asked.iter().map(|(_, n)| n.score.set_size as f64).filter(|n| *n > 0.0).collect();
    let mean = (!sized.is_empty()).then(|| sized.iter().sum::<f64>() / sized.len() as f64);
    let mut rows = named(&all, case, &of_all, &of_asked);
    rows.push(Rate::number(case, "mean size of the stated set", AtMost(2.5), mean, sized.len()));
    rows.push(share(&asked, case, OUTSIDE));
    rows
}

fn after(outcomes: &[SetOutcome]) -> [Rate; 2] {
    let all = found(outcomes, ONE);
    let scores: Vec<_> = all.iter().filter_map(|(_, named)| named.after.as_ref()).map(|after| &after.score).collect();
    let (top, in_set): (Vec<bool>, Vec<bool>) = scores.iter().map(|s| (s.rank == Some(1), s.in_set)).unzip();
    let case = "ambiguous, after the next experiment";
    [
        Rate::share(case, "truth on top", AtLeast(0.90), &top),
        Rate::share(case, "truth in the stated set", AtLeast(0.93), &in_set),
    ]
}

fn quality(outcomes: &[SetOutcome]) -> [Rate; 2] {
    let own = found(outcomes, Lot::Interval);
    let covered: Vec<bool> = own.iter().filter_map(|(_, named)| named.covered).collect();
    let unseen = outcomes.iter().filter_map(|o| o.named.as_ref()?.unseen_mm).map(|[before, after]| after < before);
    let unseen: Vec<bool> = unseen.collect();
    let (by_law, interval) = ("one effect by the catalogue's own law", "95 % interval holds the true value");
    [
        Rate::share(by_law, interval, Between(0.93, 0.97), &covered),
        Rate::share("an unseen protocol, a verdict that names", "the error falls", AtLeast(0.95), &unseen),
    ]
}

fn median(values: &[f64]) -> Option<f64> {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let n = sorted.len();
    (n > 0).then(|| 0.5 * (sorted[(n - 1) / 2] + sorted[n / 2]))
}

/// How often a truth had a name; λ, BIC behind and smallest size of these sets.
type NameCount = (usize, [Vec<f64>; 3]);

/// Truth against the name on top, single effects, by truth and then by frequency.
pub(super) fn confusion(outcomes: &[SetOutcome]) -> Vec<Confusion> {
    let mut cells: BTreeMap<(String, String), NameCount> = BTreeMap::new();
    for (outcome, found) in found(outcomes, ONE) {
        let truth = names(&outcome.truth).join(" + ");
        let named = match found.answer.verdict.as_deref().unwrap_or_default() {
            "effect" => found.answer.ranked.first().cloned().unwrap_or_default(),
            other => other.to_string(),
        };
        let lambda = found.separations.iter().find(|(rival, _)| *rival == truth).map(|(_, lambda)| *lambda);
        let own = [lambda, found.bic_behind, found.smallest_detectable.filter(|_| named == "none")];
        let (count, numbers) = cells.entry((truth, named)).or_default();
        *count += 1;
        numbers.iter_mut().zip(own).for_each(|(all, one)| all.extend(one));
    }
    let cells = cells.into_iter().map(|((truth, named), (count, numbers))| {
        let [lambda, bic_behind, smallest_detectable] = numbers.map(|all| median(&all));
        Confusion { truth, named, count, lambda, bic_behind, smallest_detectable }
    });
    let mut all: Vec<Confusion> = cells.collect();
    all.sort_by(|a, b| (&a.truth, b.count, &a.named).cmp(&(&b.truth, a.count, &b.named)));
    all
}

/// How often a stated set holds the truth, over all sets with a verdict that names: the figure that is printed with a set; `others`: whether the stated sets of other parts contain the truth.
pub(super) fn covered(outcomes: &[SetOutcome], others: impl Iterator<Item = bool>) -> Vec<Rate> {
    let named = outcomes.iter().filter_map(|o| o.named.as_ref());
    let stated = named.filter(|n| n.score.set_size > 0).map(|n| n.score.in_set);
    let hits: Vec<bool> = stated.chain(others).collect();
    let printed = Between(policy::COVERED - WITHIN, policy::COVERED + WITHIN);
    let hidden = outcomes.iter().filter(|o| !o.truth.effects.is_empty()).filter_map(|o| o.named.as_ref());
    let sure: Vec<bool> = hidden.filter(|n| n.identified).map(|n| n.score.in_set).collect();
    vec![
        Rate::share("every stated set", "it holds a true effect, as is printed", printed, &hits),
        Rate::share("one name, called identified", "it is the truth", AtLeast(TARGET), &sure),
    ]
}
