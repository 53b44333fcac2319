//! What no test could exceed: from the true means without noise and the true noise, which no diagnosis knows.
//!
//! Of every set the distance λ of the truth to the nearest explanation of a kind is known ([`compare::diagnosis::distances`]), so the
//! power of the best test of a level is Φ(√λ − z). Its mean over the sets bounds a row of the table. Laws count as the
//! catalogue's formulas here: a separate number gives how far the catalogue's own effects are from their formulas,
//! because a diagnosis must not call that "outside the catalogue".

use super::outcome::{Lot, Named, SetOutcome, about, names};
use crate::measure::ideal;
use crate::truth::standard_protocol;
use crate::{Hiding, Truth};
use compare::diagnosis::{Distances, KnownNoise, distances, power};
use compare::error::CompareError;
use data::Dataset;
use serde::Serialize;

/// False alarms allowed at five runs and more.
const FALSE_ALARMS: f64 = 0.03;
/// Kinds of effects among which an alarm has to look: about as many independent ones as the catalogue holds.
const KINDS: f64 = 10.0;
/// Share of sets inside the catalogue that a test may wrongly flag.
const FALSE_FLAGS: f64 = 0.05;
/// λ at which a known difference is seen nine times in ten at the level of 1 %: (2.33 + 1.28)².
const SEEN: f64 = 13.0;

/// Bounds of two rows of the table, what the robots' own laws would give in two more, and why sets outside the catalogue were not flagged.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Attainable {
    /// Alarms of one hidden effect, if the effect and the noise were known; false alarms in 3 %.
    pub alarm_known: Option<f64>,
    /// The same if one of ten kinds had to be looked for.
    pub alarm_any: Option<f64>,
    /// Given alarm: the true name on top, for whoever has every law as it is in these robots.
    pub on_top: Option<f64>,
    /// The same, in the first three.
    pub first_three: Option<f64>,
    /// Two hidden effects: one of them at least in the first pair named, for whoever has every law as it is.
    pub one_of_two: Option<f64>,
    /// Two hidden effects: both in that pair.
    pub both: Option<f64>,
    /// Flags outside the catalogue, if no effect or one is an explanation; false flags in 5 %.
    pub flag_one: Option<f64>,
    /// The same if pairs of effects are explanations too.
    pub flag_two: Option<f64>,
    /// What the nearest formula leaves of an effect of the catalogue, as a share of the misfit's amplitude: median and 90 %
    /// quantile over single effects.
    pub form: Option<[f64; 2]>,
    /// Sets outside the catalogue that were not flagged.
    pub missed: usize,
    /// Of these: λ to the nearest one or two effects below 13.
    pub missed_unseen: usize,
    /// Of the others: what the nearest one or two effects leave is below the 90 % quantile of `form`.
    pub missed_alike: usize,
}

/// Distances of a set; `data` gives its holds and markers.
pub(super) fn distances_of(truth: &Truth, data: &Dataset, pairs: bool) -> Result<Distances, CompareError> {
    let g = truth.measurement(&standard_protocol()).generator;
    let mean = Dataset { runs: vec!["1".into()], coordinates_m: ideal(&truth.robot()?, &g)?, ..data.clone() };
    let run_sd = [g.pressure_sd, g.alignment_sd_m, g.alignment_sd_m, g.rotation_sd];
    let noise = KnownNoise { runs: g.runs, sigma_m: g.camera_sd_m, run_sd };
    distances(&truth.told()?, &mean, Some(&about(truth)?), noise, pairs)
}

pub(super) fn of(outcomes: &[SetOutcome]) -> Attainable {
    let (one, outside) = (found(outcomes, Hiding::One), found(outcomes, Hiding::Outside));
    let mean = |sets: &[(&Named, Distances)], see: &dyn Fn(&Distances) -> f64| {
        let sum: f64 = sets.iter().map(|(_, d)| see(d)).sum();
        (!sets.is_empty()).then(|| sum / sets.len() as f64)
    };
    let left = |nearest: f64, base: f64| if base > 0.0 { (nearest / base).sqrt() } else { 0.0 };
    let mut forms: Vec<f64> = one.iter().filter(|(_, d)| d.base > SEEN).map(|(_, d)| left(d.one, d.base)).collect();
    forms.sort_by(f64::total_cmp);
    let quantile = |share: f64| compare::stats::quantile(&forms, share);
    let form = quantile(0.5).zip(quantile(0.9)).map(|(median, most)| [median, most]);
    let missed: Vec<Distances> =
        outside.iter().filter(|(named, _)| !named.score.out_of_catalog).map(|(_, d)| *d).collect();
    let is_alike = |d: &&Distances| d.two >= SEEN && form.is_some_and(|[_, most]| left(d.two, d.base) < most);
    let best = |kind: Hiding, k: usize| {
        let named = outcomes.iter().filter(|o| o.part == Lot::Hidden(kind)).filter_map(|o| o.named.as_ref());
        let shares: Vec<f64> = named.filter_map(|named| Some(named.at_best?[k])).collect();
        (!shares.is_empty()).then(|| shares.iter().sum::<f64>() / shares.len() as f64)
    };
    Attainable {
        on_top: best(Hiding::One, 0),
        first_three: best(Hiding::One, 1),
        one_of_two: best(Hiding::Two, 0),
        both: best(Hiding::Two, 1),
        alarm_known: mean(&one, &|d| power(d.base, FALSE_ALARMS)),
        alarm_any: mean(&one, &|d| power(d.base, FALSE_ALARMS / KINDS)),
        flag_one: mean(&outside, &|d| power(d.one, FALSE_FLAGS)),
        flag_two: mean(&outside, &|d| power(d.two, FALSE_FLAGS)),
        form,
        missed: missed.len(),
        missed_unseen: missed.iter().filter(|d| d.two < SEEN).count(),
        missed_alike: missed.iter().filter(is_alike).count(),
    }
}

fn found(outcomes: &[SetOutcome], kind: Hiding) -> Vec<(&Named, Distances)> {
    let of_kind = outcomes.iter().filter(|o| o.part == Lot::Hidden(kind) && !names(&o.truth).is_empty());
    of_kind.filter_map(|o| o.named.as_ref()).filter_map(|named| Some((named, named.distances?))).collect()
}
