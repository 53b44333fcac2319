//! From outcomes to the rows of the table.

use super::cases::{Named, SetOutcome, names};
use super::row::{Goal, Rate};
use super::{Confusion, Lot, Slice};
use crate::Hiding;
use Goal::{AtLeast, AtMost, Between};

/// The rows, in the order of the table.
pub(super) fn rows(outcomes: &[SetOutcome]) -> Vec<Rate> {
    let one = |part| one(outcomes, part);
    let parts = [
        nothing(outcomes),
        one(Lot::Hidden(Hiding::One)),
        one(Lot::Measured(Hiding::One)),
        lossy(outcomes),
        alone(outcomes, Lot::Clamp, "a clamp of any stiffness"),
        alone(outcomes, Lot::Softening, "a softening wall"),
        below(outcomes),
        after(outcomes),
        two(outcomes),
        outside(outcomes),
        quality(outcomes),
        slips(outcomes),
    ];
    parts.concat()
}

/// Sets of a part that were diagnosed.
pub(super) fn found(outcomes: &[SetOutcome], part: Lot) -> Vec<(&SetOutcome, &Named)> {
    outcomes.iter().filter(|o| o.part == part).filter_map(|o| Some((o, o.named.as_ref()?))).collect()
}

fn shares(sets: &[(&SetOutcome, &Named)], hit: impl Fn(&Named) -> bool) -> Vec<bool> {
    sets.iter().map(|(_, named)| hit(named)).collect()
}

fn nothing(outcomes: &[SetOutcome]) -> Vec<Rate> {
    let all = found(outcomes, Lot::Hidden(Hiding::Nothing));
    let told = shares(&all, |named| named.bending_alarm);
    let (few, many): (Vec<_>, Vec<_>) = all.into_iter().partition(|(outcome, _)| outcome.truth.runs < 5);
    let case = "no hidden effect";
    let alarm = |named: &Named| named.score.alarm;
    let heavy = found(outcomes, Lot::HeavyTails);
    let (tested_case, tested) =
        ("no hidden effect, B measured to 10 %", found(outcomes, Lot::Measured(Hiding::Nothing)));
    let lossy = found(outcomes, Lot::LostMarkers(Hiding::Nothing));
    vec![
        Rate::share("no hidden effect, markers lost", "false alarms", AtMost(0.05), &shares(&lossy, alarm)),
        Rate::share("no hidden effect, heavy tails", "false alarms", AtMost(0.05), &shares(&heavy, alarm)),
        Rate::share(case, "false alarms, 5 and 10 runs", AtMost(0.03), &shares(&many, alarm)),
        Rate::share(case, "false alarms, 3 runs", AtMost(0.05), &shares(&few, alarm)),
        Rate::share(tested_case, "false alarms", AtMost(0.05), &shares(&tested, alarm)),
        Rate::share(case, "told another stiffness", AtMost(0.05), &told),
        Rate::share(tested_case, "told another stiffness", AtMost(0.05), &shares(&tested, |named| named.bending_alarm)),
    ]
}

fn one(outcomes: &[SetOutcome], part: Lot) -> Vec<Rate> {
    let all = found(outcomes, part);
    let alarmed = alarmed(&all);
    let case = match part {
        Lot::Measured(_) => "one hidden effect, B measured to 10 %",
        _ => "one hidden effect",
    };
    let top = |most: usize| move |named: &Named| named.score.rank.is_some_and(|rank| rank <= most);
    let sized: Vec<f64> = alarmed.iter().map(|(_, n)| n.score.set_size as f64).filter(|n| *n > 0.0).collect();
    let mean = (!sized.is_empty()).then(|| sized.iter().sum::<f64>() / sized.len() as f64);
    vec![
        Rate::share(case, "alarm", AtLeast(0.95), &shares(&all, |named| named.score.alarm)),
        Rate::share(case, "alarm, and too small to name", AtMost(0.10), &shares(&all, |n| n.score.too_small)),
        Rate::share(case, "large enough to name: truth on top", AtLeast(0.80), &shares(&alarmed, top(1))),
        Rate::share(case, "large enough to name: truth in the first three", AtLeast(0.92), &shares(&alarmed, top(3))),
        Rate::share(
            case,
            "large enough to name: truth in the stated set",
            AtLeast(0.93),
            &shares(&alarmed, |n| n.score.in_set),
        ),
        Rate::number(case, "mean size of the stated set", AtMost(2.5), mean, sized.len()),
        Rate::share(
            case,
            "large enough to name: called outside the catalogue",
            AtMost(0.05),
            &shares(&alarmed, |n| n.score.out_of_catalog),
        ),
    ]
}

fn lossy(outcomes: &[SetOutcome]) -> Vec<Rate> {
    let all = found(outcomes, Lot::LostMarkers(Hiding::One));
    let alarmed = alarmed(&all);
    let case = "one hidden effect, markers lost";
    vec![
        Rate::share(case, "alarm", AtLeast(0.95), &shares(&all, |named| named.score.alarm)),
        Rate::share(
            case,
            "large enough to name: truth in the stated set",
            AtLeast(0.93),
            &shares(&alarmed, |n| n.score.in_set),
        ),
        Rate::share(
            case,
            "large enough to name: called outside the catalogue",
            AtMost(0.05),
            &shares(&alarmed, |n| n.score.out_of_catalog),
        ),
    ]
}

/// Sets of one effect by itself.
fn alone(outcomes: &[SetOutcome], part: Lot, case: &'static str) -> Vec<Rate> {
    let all = found(outcomes, part);
    let named = alarmed(&all);
    vec![
        Rate::share(case, "alarm", AtLeast(0.95), &shares(&all, |named| named.score.alarm)),
        Rate::share(
            case,
            "large enough to name: truth in the stated set",
            AtLeast(0.90),
            &shares(&named, |n| n.score.in_set),
        ),
    ]
}

/// Names that cannot pay: of errors that began within the tolerance.
fn below(outcomes: &[SetOutcome]) -> Vec<Rate> {
    let all: Vec<_> = outcomes.iter().filter_map(|o| Some((o, o.named.as_ref()?))).collect();
    let pays_nothing = |n: &Named| !n.answer.added.is_empty() && n.systematic_mm[0] <= n.tolerance_mm;
    vec![Rate::share("all sets", "an effect named within the tolerance", AtMost(0.0), &shares(&all, pays_nothing))]
}

/// Those of which a name was asked: something is missing, and not too small to name.
fn alarmed<'o>(all: &[(&'o SetOutcome, &'o Named)]) -> Vec<(&'o SetOutcome, &'o Named)> {
    all.iter().filter(|(_, named)| named.score.alarm && !named.score.too_small).copied().collect()
}

fn after(outcomes: &[SetOutcome]) -> Vec<Rate> {
    let all = found(outcomes, Lot::Hidden(Hiding::One));
    let scores: Vec<_> = all.iter().filter_map(|(_, named)| named.after.as_ref()).map(|after| &after.score).collect();
    let top: Vec<bool> = scores.iter().map(|score| score.rank == Some(1)).collect();
    let in_set: Vec<bool> = scores.iter().map(|score| score.in_set).collect();
    let case = "ambiguous, after the next experiment";
    vec![
        Rate::share(case, "truth on top", AtLeast(0.90), &top),
        Rate::share(case, "truth in the stated set", AtLeast(0.93), &in_set),
    ]
}

/// Of every set missed after the next experiment, whether it is missed with next to no noise too.
pub(super) fn missed_in_silence(outcomes: &[SetOutcome]) -> Vec<bool> {
    let all = found(outcomes, Lot::Hidden(Hiding::One));
    all.iter().filter_map(|(_, named)| named.after_in_silence.as_ref()).map(|score| score.rank != Some(1)).collect()
}

fn two(outcomes: &[SetOutcome]) -> Vec<Rate> {
    let all = found(outcomes, Lot::Hidden(Hiding::Two));
    let case = "two hidden effects";
    vec![
        Rate::share(case, "at least one named", AtLeast(0.90), &shares(&all, |named| named.score.named >= 1)),
        Rate::share(case, "both named", AtLeast(0.40), &shares(&all, |named| named.score.named == 2)),
        Rate::share(case, "at least one in the stated set", AtLeast(0.90), &shares(&all, |named| named.score.in_set)),
        Rate::share(case, "both, as one entry of the stated set", AtLeast(0.40), &shares(&all, |n| n.score.all_in_set)),
        Rate::share(case, "a wrong name asserted", AtMost(0.15), &shares(&all, |named| named.score.wrong)),
    ]
}

fn outside(outcomes: &[SetOutcome]) -> Vec<Rate> {
    let all = found(outcomes, Lot::Hidden(Hiding::Outside));
    let flagged = shares(&all, |named| named.score.out_of_catalog);
    vec![Rate::share("outside the catalogue", "flagged as such", AtLeast(0.90), &flagged)]
}

fn quality(outcomes: &[SetOutcome]) -> Vec<Rate> {
    let own = found(outcomes, Lot::Interval);
    let covered: Vec<bool> = own.iter().filter_map(|(_, named)| named.covered).collect();
    let all = found(outcomes, Lot::Hidden(Hiding::One));
    let alarmed = || all.iter().map(|(_, named)| *named).filter(|named| !named.answer.added.is_empty());
    let ratio = |[before, after]: [f64; 2]| (before > 0.0).then(|| after / before);
    let fitted: Vec<f64> = alarmed().filter_map(|named| ratio(named.systematic_mm)).collect();
    let held: Vec<f64> = alarmed().filter_map(|named| named.heldout_mm.and_then(ratio)).collect();
    let case = "error beyond noise, one hidden effect";
    vec![
        Rate::share(
            "one effect by the catalogue's own law",
            "95 % interval holds the true value",
            Between(0.93, 0.97),
            &covered,
        ),
        Rate::number(case, "median of after / before", AtMost(0.10), median(&fitted), fitted.len()),
        Rate::number(case, "the same on held-out runs", AtMost(0.10), median(&held), held.len()),
    ]
}

/// Exchanged labels are the slip among what is hidden.
fn slips(outcomes: &[SetOutcome]) -> Vec<Rate> {
    let all: Vec<_> = outcomes.iter().filter_map(|o| Some((o, o.named.as_ref()?))).collect();
    let (slipped, right): (Vec<_>, Vec<_>) =
        all.iter().copied().partition(|(o, _)| o.truth.effects.iter().any(|choice| choice.name == "swapped_markers"));
    vec![
        Rate::share("labels exchanged", "told as a slip", AtLeast(0.90), &shares(&slipped, |named| named.slip)),
        Rate::share("all other sets", "told a slip that is none", AtMost(0.01), &shares(&right, |named| named.slip)),
        Rate::share(
            "sets with right pressures",
            "told a slip of pressures",
            AtMost(0.01),
            &shares(&all, |n| n.pressure_slip),
        ),
    ]
}

fn median(values: &[f64]) -> Option<f64> {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let n = sorted.len();
    (n > 0).then(|| 0.5 * (sorted[(n - 1) / 2] + sorted[n / 2]))
}

/// A cell of the confusion table while it is counted.
#[derive(Default)]
struct Count {
    truth: String,
    named: String,
    count: usize,
    lambdas: Vec<f64>,
    behind: Vec<f64>,
    detectable: Vec<f64>,
}

/// Truth against the name on top, single effects, by truth and then by frequency.
pub(super) fn confusion(outcomes: &[SetOutcome]) -> Vec<Confusion> {
    let mut cells: Vec<Count> = Vec::new();
    for (outcome, found) in found(outcomes, Lot::Hidden(Hiding::One)) {
        let truth = names(&outcome.truth).join(" + ");
        let named = match found.answer.verdict.as_deref().unwrap_or_default() {
            "effect" => found.answer.ranked.first().cloned().unwrap_or_default(),
            other => other.to_string(),
        };
        let at = cells.iter().position(|cell| cell.truth == truth && cell.named == named).unwrap_or_else(|| {
            cells.push(Count { truth: truth.clone(), named: named.clone(), ..Count::default() });
            cells.len() - 1
        });
        let cell = &mut cells[at];
        cell.count += 1;
        cell.lambdas.extend(found.separations.iter().find(|(rival, _)| *rival == truth).map(|(_, lambda)| *lambda));
        cell.behind.extend(found.bic_behind);
        cell.detectable.extend(found.smallest_detectable.filter(|_| named == "none"));
    }
    cells.sort_by(|a, b| (&a.truth, b.count, &a.named).cmp(&(&b.truth, a.count, &b.named)));
    let finish = |cell: Count| Confusion {
        lambda: median(&cell.lambdas),
        bic_behind: median(&cell.behind),
        smallest_detectable: median(&cell.detectable),
        truth: cell.truth,
        named: cell.named,
        count: cell.count,
    };
    cells.into_iter().map(finish).collect()
}

/// Figures of single effects by actuator, camera noise and runs.
pub(super) fn breakdown(outcomes: &[SetOutcome]) -> Vec<Slice> {
    let all = found(outcomes, Lot::Hidden(Hiding::One));
    let keys = |outcome: &SetOutcome| {
        let truth = &outcome.truth;
        [truth.actuator.clone(), format!("{} mm", truth.camera_sd_m * 1e3), format!("{} runs", truth.runs)]
    };
    let mut names: Vec<(usize, String)> =
        all.iter().flat_map(|(outcome, _)| keys(outcome).into_iter().enumerate()).collect();
    names.sort();
    names.dedup();
    let share = |hits: usize, of: usize| if of > 0 { hits as f64 / of as f64 } else { 0.0 };
    let part = |(place, of): (usize, String)| {
        let sets: Vec<&Named> = all.iter().filter(|(o, _)| keys(o)[place] == of).map(|(_, named)| *named).collect();
        let alarmed: Vec<&&Named> = sets.iter().filter(|named| named.score.alarm).collect();
        let count = |hit: &dyn Fn(&Named) -> bool| alarmed.iter().filter(|named| hit(named)).count();
        Slice {
            of,
            sets: sets.len(),
            alarm: share(alarmed.len(), sets.len()),
            on_top: share(count(&|named| named.score.rank == Some(1)), alarmed.len()),
            in_set: share(count(&|named| named.score.in_set), alarmed.len()),
        }
    };
    names.into_iter().map(part).collect()
}
