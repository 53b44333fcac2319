//! One set of the bench: draws it, measures it and diagnoses it.

use super::follow::{follow_up, tested};
use super::outcome::{After, Diagnoser, Lot, Named, PlannedSet, about, names};
use crate::score::{Claim, score};
use crate::truth::{ROBOTS, standard_protocol};
use crate::{Draw, HIDDEN, HiddenEffect, Hiding, OUTSIDE, Truth, truth};
use compare::Evidence;
use compare::diagnosis::{Confidence, Diagnosis, Experiment, Options, Verdict, with_fitted};
use compare::error::CompareError;
use compare::study::{fit_scenario, generate, predict_dataset};
use data::{About, Dataset};
use models::Scenario;

/// Step through a list of effects, prime to their numbers, so that a short bench sees different groups.
const STRIDE: usize = 13;

/// A protocol that no set has: body and actuator pressure \[Pa\].
const UNSEEN: [[f64; 2]; 5] = [[3e3, 0.0], [3e3, 7e3], [3e3, 15e3], [3e3, 25e3], [3e3, 12e3]];

/// Stiffness of clamps, over the typical one: from a soft one to a rigid cap.
const CLAMPS: [f64; 2] = [0.5, 30.0];

/// Draws a set; robots and effects take turns, so that all are equally frequent.
pub(super) fn draw(part: Lot, seed: u64, stream: u64, index: usize) -> Result<Truth, CompareError> {
    let mut draw = Draw::new(seed, stream);
    let actuator = ROBOTS[index % ROBOTS.len()].0;
    let turn = index / ROBOTS.len();
    let mut truth = Truth::draw(actuator, &mut draw)?;
    let mut hide_one = |list: Vec<HiddenEffect>, truth: &mut Truth| {
        truth.add(list[turn * STRIDE % list.len()].name, draw.between(0.8, 1.5));
    };
    match part {
        Lot::Hidden(Hiding::One)
        | Lot::Measured(Hiding::One)
        | Lot::LostMarkers(Hiding::One)
        | Lot::White(Hiding::One) => {
            hide_one(truth::applicable(actuator, HIDDEN)?, &mut truth);
        }
        Lot::Interval => {
            let mut list = truth::applicable(actuator, HIDDEN)?;
            list.retain(|effect| models::effects::by_name(effect.name).is_some());
            hide_one(list, &mut truth);
        }
        Lot::Hidden(Hiding::Outside) => truth.add(OUTSIDE[turn * STRIDE % OUTSIDE.len()].name, 1.0),
        Lot::Hidden(kind) | Lot::Measured(kind) => truth.hide(kind, &mut draw)?,
        Lot::HeavyTails => truth.heavy_tails = true,
        Lot::LostMarkers(_) | Lot::White(_) => {}
        Lot::Clamp => {
            let [softest, stiffest] = CLAMPS.map(f64::ln);
            truth.add(["base_clamp", "tip_clamp"][turn % 2], draw.between(softest, stiffest).exp());
        }
        Lot::Softening => truth.add("softening", draw.between(0.8, 1.5)),
    }
    truth.holds_scatter = !matches!(part, Lot::White(_));
    truth.lost_markers = matches!(part, Lot::LostMarkers(_));
    Ok(truth)
}

/// Makes and diagnoses a set; `Err` gives the reason for a failure.
pub(super) fn named(case: &PlannedSet, diagnose: Diagnoser) -> Result<Named, String> {
    let truth = &case.truth;
    let found = match case.part {
        Lot::Hidden(kind) => hidden(truth, kind, diagnose),
        Lot::HeavyTails => hidden(truth, Hiding::Nothing, diagnose),
        Lot::Measured(_) => tested(truth).and_then(|about| alone(truth, about, diagnose)),
        Lot::Interval => interval(truth, diagnose),
        Lot::LostMarkers(_) | Lot::White(_) | Lot::Clamp | Lot::Softening => {
            about(truth).and_then(|about| alone(truth, about, diagnose))
        }
    };
    found.map_err(|error| format!("{} {:?}: {error}", truth.actuator, names(truth)))
}

fn diagnosed(
    truth: &Truth,
    data: Vec<(Dataset, About)>,
    next_experiment: bool,
    diagnose: Diagnoser,
) -> Result<Diagnosis, CompareError> {
    let options = Options { next_experiment, missing_moment: false, ..Options::default() };
    let evidence: Vec<Evidence> = data.into_iter().map(|(data, about)| Evidence::of(data, Some(about))).collect();
    diagnose(&truth.told()?, &evidence, &options, &mut |_, _| ())
}

fn hidden(truth: &Truth, kind: Hiding, diagnose: Diagnoser) -> Result<Named, CompareError> {
    let data = truth.dataset("hidden", &standard_protocol())?;
    let found = diagnosed(truth, vec![(data, about(truth)?)], kind == Hiding::One, diagnose)?;
    let mut named = scored(truth, &found);
    let is_ambiguous = named.answer.verdict.as_deref() == Some("effect") && named.answer.set.len() > 1;
    let next = found.next_experiment.as_ref().and_then(|next| next.recommended.as_ref());
    if let Some(experiment) = next.filter(|_| kind == Hiding::One && is_ambiguous) {
        named.after = Some(after(truth, experiment, diagnose)?);
    }
    Ok(named)
}

fn alone(truth: &Truth, about: About, diagnose: Diagnoser) -> Result<Named, CompareError> {
    let data = truth.dataset("hidden", &standard_protocol())?;
    Ok(scored(truth, &diagnosed(truth, vec![(data, about)], false, diagnose)?))
}

/// Answer to old and new data after the recommended experiment, and its score.
fn after(truth: &Truth, experiment: &Experiment, diagnose: Diagnoser) -> Result<After, CompareError> {
    let answer = Claim::of(&diagnosed(truth, follow_up(truth, experiment)?, false, diagnose)?);
    Ok(After { experiment: experiment.name.clone(), score: score(truth, &answer), answer })
}

/// The same robot with a hundredth of the noise and scatter.
fn silent(truth: &Truth) -> Truth {
    Truth {
        camera_sd_m: 0.01 * truth.camera_sd_m,
        pressure_sd: 0.01 * truth.pressure_sd,
        alignment_sd_m: 0.01 * truth.alignment_sd_m,
        holds_scatter: false,
        ..truth.clone()
    }
}

/// Data by the catalogue's own law, where "the true value" means something.
fn interval(truth: &Truth, diagnose: Diagnoser) -> Result<Named, CompareError> {
    let name = &truth.effects[0].name;
    let missing = || CompareError::NotSimulated { problem: format!("the catalogue has no {name}") };
    let effect = models::effects::by_name(name).ok_or_else(missing)?;
    let told = truth.told()?;
    // What only shapes the law stays as it is.
    let times = truth.effects[0].times_typical;
    let value = |(typical, neutral): (f64, f64)| if typical == neutral { typical } else { typical * times };
    let values: Vec<f64> = effect.typical().into_iter().zip(effect.neutral()).map(value).collect();
    let robot = told.with_bending(truth.bending_nm2).with_effect(name, &values);
    let data = generate(&robot, "own law", &truth.measurement(&standard_protocol()).generator)?;
    let found = diagnosed(truth, vec![(data, about(truth)?)], false, diagnose)?;
    let mut named = scored(truth, &found);
    let only = found.added.len() == 1 && found.added[0].effect == *name;
    if let Some(first) = found.added.first().and_then(|added| added.parameters.first()).filter(|_| only) {
        let wanted = values[0] / effect.parameters[0].si;
        named.covered = first.lo.zip(first.hi).map(|(lo, hi)| (lo..=hi).contains(&wanted));
    }
    Ok(named)
}

/// Errors of base and final model against the robot without noise, under the unseen protocol; `None` without a name, or where the
/// robot or a model has no equilibrium there.
fn unseen_mm(truth: &Truth, found: &Diagnosis) -> Option<[f64; 2]> {
    if found.verdict != Some(Verdict::Effect) {
        return None;
    }
    let right = silent(truth).dataset("unseen", &UNSEEN).ok()?;
    let mean_m = right.mean_over_runs();
    let given = fit_scenario(&truth.told().ok()?, &right, Some(&about(truth).ok()?)).ok()?.0;
    let added: Vec<_> = found.added.iter().map(|a| (a.effect.as_str(), &a.parameters[..])).collect();
    let models = [
        given.with_bending(found.base.bending.first()?.value_nm2),
        with_fitted(&given, &added, found.base.bending_with_added_nm2.first().copied()),
    ];
    let error_mm = |model: &Scenario| {
        let predicted = predict_dataset(model, &right).ok()?.coordinates_m;
        let squares: f64 = predicted.iter().zip(&mean_m).map(|(a, b)| (a - b).powi(2)).sum();
        Some(1e3 * (squares / mean_m.len() as f64).sqrt())
    };
    Some([error_mm(&models[0])?, error_mm(&models[1])?])
}

fn scored(truth: &Truth, found: &Diagnosis) -> Named {
    let answer = Claim::of(found);
    let is_true = |name: &String| truth.effects.first().is_some_and(|choice| choice.name == *name);
    let now = found.next_experiment.iter().flat_map(|next| &next.now);
    Named {
        score: score(truth, &answer),
        identified: found.confidence == Some(Confidence::IdentifiedInCatalog),
        slip: !found.slips.is_empty(),
        pressure_slip: found.pressure_slip.is_some(),
        unseen_mm: unseen_mm(truth, found),
        bending_held: found
            .base
            .bending
            .first()
            .and_then(|b| b.lo.zip(b.hi).map(|(lo, hi)| (lo..=hi).contains(&truth.bending_nm2))),
        bic_behind: found.ranked.iter().find(|row| is_true(&row.effect)).map(|row| row.bic_difference),
        smallest_detectable: found
            .undetectable
            .iter()
            .find(|row| is_true(&row.effect))
            .and_then(|row| row.times_typical),
        separations: now.map(|s| (s.rival.clone(), s.lambda)).collect(),
        answer,
        ..Named::default()
    }
}
