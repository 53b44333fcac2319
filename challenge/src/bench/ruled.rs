//! The evidence rule beside the verdict, on the same sets.

use super::cases::{Named, SetOutcome, names};
use super::row::{Goal, Rate};
use super::{Lot, table};
use crate::{Hiding, Truth};
use Goal::{AtLeast, AtMost};
use compare::diagnosis::{Diagnosis, Ruling};

/// What the rule says of a set, held against the truth.
#[derive(Debug, Clone, PartialEq)]
pub struct Ruled {
    /// Something is missing.
    pub alarm: bool,
    /// The first effect named is true.
    pub first: bool,
    /// A true effect is in the set.
    pub in_set: bool,
    /// All true effects are in one entry of the set.
    pub all_in_set: bool,
    /// Entries of the set.
    pub set_size: usize,
    /// It says that the catalogue does not explain it.
    pub outside: bool,
}

impl Ruled {
    /// Of a diagnosis; `None` where nothing was weighed.
    pub fn of(truth: &Truth, found: &Diagnosis) -> Option<Ruled> {
        (!found.judged.is_empty()).then(|| {
            let (ruling, names) = (Ruling::of(&found.judged), names(truth));
            let parts = |entry: &str| entry.split(" + ").map(str::to_string).collect::<Vec<_>>();
            let any = |entry: &str| parts(entry).iter().any(|part| names.contains(&part.as_str()));
            let all = |entry: &str| names.iter().all(|name| parts(entry).iter().any(|part| part == name));
            let effect = found.judged.iter().find(|j| models::effects::by_name(&parts(&j.hypothesis)[0]).is_some());
            Ruled {
                alarm: ruling.alarm,
                first: effect.is_some_and(|j| any(&j.hypothesis)),
                in_set: ruling.set.iter().any(|entry| any(entry)),
                all_in_set: ruling.set.iter().any(|entry| all(entry)),
                set_size: ruling.set.len(),
                outside: ruling.alarm && ruling.outside,
            }
        })
    }
}

/// Its rows, after those of the verdict.
pub(super) fn rows(outcomes: &[SetOutcome]) -> Vec<Rate> {
    let of = |kind: Hiding| -> Vec<&Ruled> {
        let all = table::found(outcomes, Lot::Hidden(kind)).into_iter();
        all.filter_map(|(_, named): (_, &Named)| named.ruled.as_ref()).collect()
    };
    let share = |case, figure, target, sets: &[&Ruled], hit: fn(&Ruled) -> bool| {
        Rate::share(case, figure, target, &sets.iter().map(|r| hit(r)).collect::<Vec<_>>())
    };
    let (none, one, two, outside) = (of(Hiding::Nothing), of(Hiding::One), of(Hiding::Two), of(Hiding::Outside));
    let alarmed: Vec<&Ruled> = one.iter().filter(|r| r.alarm).copied().collect();
    let sizes = alarmed.iter().map(|r| r.set_size as f64).sum::<f64>();
    let mean = (!alarmed.is_empty()).then(|| sizes / alarmed.len() as f64);
    let case = "evidence rule, one hidden effect";
    vec![
        share("evidence rule, no hidden effect", "false alarms", AtMost(0.03), &none, |r| r.alarm),
        share(case, "alarm", AtLeast(0.95), &one, |r| r.alarm),
        share(case, "given alarm: truth on top", AtLeast(0.82), &alarmed, |r| r.first),
        share(case, "given alarm: truth in the stated set", AtLeast(0.93), &alarmed, |r| r.in_set),
        Rate::number(case, "mean size of the stated set", AtMost(2.5), mean, alarmed.len()),
        share(case, "given alarm: called outside the catalogue", AtMost(0.03), &alarmed, |r| r.outside),
        share("evidence rule, two hidden effects", "at least one in the stated set", AtLeast(0.85), &two, |r| r.in_set),
        share("evidence rule, two hidden effects", "both, as one entry of the stated set", AtLeast(0.40), &two, |r| {
            r.all_in_set
        }),
        share("evidence rule, outside the catalogue", "flagged as such", AtLeast(0.85), &outside, |r| r.outside),
    ]
}
