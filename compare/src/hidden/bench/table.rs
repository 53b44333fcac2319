//! From outcomes to the rows of the table.

use super::cases::{Named, Outcome, names};
use super::row::{Row, Target};
use super::{Confusion, Part};
use crate::hidden::Kind;
use Target::{AtLeast, AtMost, Between};

/// The rows, in the order of the table.
pub(super) fn rows(outcomes: &[Outcome]) -> Vec<Row> {
    [nothing(outcomes), one(outcomes), after(outcomes), two(outcomes), outside(outcomes), quality(outcomes)].concat()
}

/// Sets of a part that were diagnosed.
fn found(outcomes: &[Outcome], part: Part) -> Vec<(&Outcome, &Named)> {
    outcomes.iter().filter(|o| o.part == part).filter_map(|o| Some((o, o.named.as_ref()?))).collect()
}

fn shares(sets: &[(&Outcome, &Named)], hit: impl Fn(&Named) -> bool) -> Vec<bool> {
    sets.iter().map(|(_, named)| hit(named)).collect()
}

fn nothing(outcomes: &[Outcome]) -> Vec<Row> {
    let all = found(outcomes, Part::Hidden(Kind::Nothing));
    let (few, many): (Vec<_>, Vec<_>) = all.into_iter().partition(|(outcome, _)| outcome.truth.runs < 5);
    let case = "no hidden effect";
    let alarm = |named: &Named| named.score.alarm;
    vec![
        Row::share(case, "false alarms, 5 and 10 runs", AtMost(0.03), &shares(&many, alarm)),
        Row::share(case, "false alarms, 3 runs", AtMost(0.05), &shares(&few, alarm)),
    ]
}

fn one(outcomes: &[Outcome]) -> Vec<Row> {
    let all = found(outcomes, Part::Hidden(Kind::One));
    let alarmed: Vec<_> = all.iter().filter(|(_, named)| named.score.alarm).copied().collect();
    let case = "one hidden effect";
    let top = |most: usize| move |named: &Named| named.score.rank.is_some_and(|rank| rank <= most);
    let sized: Vec<f64> = alarmed.iter().map(|(_, n)| n.score.set_size as f64).filter(|n| *n > 0.0).collect();
    let mean = (!sized.is_empty()).then(|| sized.iter().sum::<f64>() / sized.len() as f64);
    vec![
        Row::share(case, "alarm", AtLeast(0.95), &shares(&all, |named| named.score.alarm)),
        Row::share(case, "given alarm: truth on top", AtLeast(0.80), &shares(&alarmed, top(1))),
        Row::share(case, "given alarm: truth in the first three", AtLeast(0.92), &shares(&alarmed, top(3))),
        Row::share(case, "given alarm: truth in the stated set", AtLeast(0.93), &shares(&alarmed, |n| n.score.in_set)),
        Row::number(case, "mean size of the stated set", AtMost(2.5), mean, sized.len()),
        Row::share(
            case,
            "given alarm: called outside the catalogue",
            AtMost(0.05),
            &shares(&alarmed, |n| n.score.out_of_catalog),
        ),
    ]
}

fn after(outcomes: &[Outcome]) -> Vec<Row> {
    let all = found(outcomes, Part::Hidden(Kind::One));
    let scores: Vec<_> = all.iter().filter_map(|(_, named)| named.after.as_ref()).collect();
    let top: Vec<bool> = scores.iter().map(|score| score.rank == Some(1)).collect();
    vec![Row::share("ambiguous, after the next experiment", "truth on top", AtLeast(0.90), &top)]
}

fn two(outcomes: &[Outcome]) -> Vec<Row> {
    let all = found(outcomes, Part::Hidden(Kind::Two));
    let case = "two hidden effects";
    vec![
        Row::share(case, "at least one named", AtLeast(0.90), &shares(&all, |named| named.score.named >= 1)),
        Row::share(case, "both named", AtLeast(0.40), &shares(&all, |named| named.score.named == 2)),
        Row::share(case, "a wrong name asserted", AtMost(0.15), &shares(&all, |named| named.score.wrong)),
    ]
}

fn outside(outcomes: &[Outcome]) -> Vec<Row> {
    let all = found(outcomes, Part::Hidden(Kind::Outside));
    let flagged = shares(&all, |named| named.score.out_of_catalog);
    vec![Row::share("outside the catalogue", "flagged as such", AtLeast(0.90), &flagged)]
}

fn quality(outcomes: &[Outcome]) -> Vec<Row> {
    let own = found(outcomes, Part::Interval);
    let covered: Vec<bool> = own.iter().filter_map(|(_, named)| named.covered).collect();
    let all = found(outcomes, Part::Hidden(Kind::One));
    let alarmed = || all.iter().map(|(_, named)| *named).filter(|named| !named.answer.added.is_empty());
    let ratio = |[before, after]: [f64; 2]| (before > 0.0).then(|| after / before);
    let fitted: Vec<f64> = alarmed().filter_map(|named| ratio(named.systematic_mm)).collect();
    let held: Vec<f64> = alarmed().filter_map(|named| named.heldout_mm.and_then(ratio)).collect();
    let case = "error beyond noise, one hidden effect";
    vec![
        Row::share(
            "one effect by the catalogue's own law",
            "95 % interval holds the true value",
            Between(0.93, 0.97),
            &covered,
        ),
        Row::number(case, "median of after / before", AtMost(0.10), median(&fitted), fitted.len()),
        Row::number(case, "the same on held-out runs", AtMost(0.10), median(&held), held.len()),
    ]
}

fn median(values: &[f64]) -> Option<f64> {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let n = sorted.len();
    (n > 0).then(|| 0.5 * (sorted[(n - 1) / 2] + sorted[n / 2]))
}

/// Truth against the name on top, single effects, most frequent misses first.
pub(super) fn confusion(outcomes: &[Outcome]) -> Vec<Confusion> {
    let mut seen: Vec<(Confusion, Vec<f64>)> = Vec::new();
    for (outcome, named) in found(outcomes, Part::Hidden(Kind::One)) {
        let truth = names(&outcome.truth).join(" + ");
        let on_top = match named.answer.verdict.as_str() {
            "effect" => named.answer.ranked.first().cloned().unwrap_or_default(),
            other => other.to_string(),
        };
        let lambda = named.separations.iter().find(|(rival, _)| *rival == truth).map(|(_, lambda)| *lambda);
        match seen.iter_mut().find(|(c, _)| c.truth == truth && c.named == on_top) {
            Some((confusion, lambdas)) => {
                confusion.count += 1;
                lambdas.extend(lambda);
            }
            None => {
                let confusion = Confusion { truth, named: on_top, count: 1, lambda: None };
                seen.push((confusion, lambda.into_iter().collect()));
            }
        }
    }
    let mut all: Vec<Confusion> =
        seen.into_iter().map(|(confusion, lambdas)| Confusion { lambda: median(&lambdas), ..confusion }).collect();
    all.sort_by(|a, b| (&a.truth, b.count, &a.named).cmp(&(&b.truth, a.count, &b.named)));
    all
}
