//! Columns of pressures that were written wrongly: ten kinds on each robot, without any hidden effect.

use super::cases::about;
use super::row::{Goal, Rate};
use super::{Diagnoser, DiscoveryOptions};
use crate::truth::{ROBOTS, standard_protocol};
use crate::{Draw, Truth};
use compare::Evidence;
use compare::diagnosis::Options;
use compare::error::CompareError;
use data::Hold;
use rayon::prelude::*;
use serde::Serialize;

/// What becomes of a hold's pressures.
type Spoil = fn(&mut Hold);

/// The kinds, by what stands in the column of kilopascals of gauge pressure.
const KINDS: [(&str, Spoil); 10] = [
    ("p_act in psi", |hold| hold.p_act_pa /= 6.894_757),
    ("p_act in mbar", |hold| hold.p_act_pa *= 10.0),
    ("p_act in inches of water", |hold| hold.p_act_pa /= 0.249_089),
    ("p_act in bar", |hold| hold.p_act_pa /= 100.0),
    ("p_act absolute", |hold| hold.p_act_pa += 101_325.0),
    ("p_body in psi", |hold| hold.p_body_pa /= 6.894_757),
    ("p_body in mbar", |hold| hold.p_body_pa *= 10.0),
    ("p_body in inches of water", |hold| hold.p_body_pa /= 0.249_089),
    ("p_body absolute", |hold| hold.p_body_pa += 101_325.0),
    ("exchanged", |hold| std::mem::swap(&mut hold.p_act_pa, &mut hold.p_body_pa)),
];

/// Sets of a round: every kind on every robot.
pub(super) const SETS: usize = KINDS.len() * ROBOTS.len();
/// Keeps their streams apart from those of the other parts.
const STREAM: u64 = 100 << 32;

/// What became of a set.
#[derive(Debug, Clone, Serialize)]
pub struct SlippedSet {
    /// What stands in the column.
    pub kind: &'static str,
    /// Robot, noise and runs.
    pub truth: Truth,
    /// It was told as a slip of the pressures.
    pub told: bool,
    /// What was said.
    pub words: Option<String>,
    /// Effects that the verdict adds.
    pub named: Vec<String>,
}

/// Makes, spoils and diagnoses the sets, a round for every hundred sets of the bench; what fails is told in `failed`.
pub fn slipped(options: &DiscoveryOptions, diagnose: Diagnoser, failed: &mut Vec<String>) -> Vec<SlippedSet> {
    let count = SETS * options.sets.div_ceil(100);
    let one = |index: usize| {
        let (kind, spoil) = KINDS[index / ROBOTS.len() % KINDS.len()];
        one(options.seed, index, spoil, diagnose, kind).map_err(|error| format!("{kind}: {error}"))
    };
    let made: Vec<Result<SlippedSet, String>> = (0..count).into_par_iter().map(one).collect();
    made.into_iter().filter_map(|made| made.map_err(|error| failed.push(error)).ok()).collect()
}

/// A refusal that names the column is an answer too.
fn one(
    seed: u64,
    index: usize,
    spoil: Spoil,
    diagnose: Diagnoser,
    kind: &'static str,
) -> Result<SlippedSet, CompareError> {
    let truth = Truth::draw(ROBOTS[index % ROBOTS.len()].0, &mut Draw::new(seed, STREAM + index as u64))?;
    let mut data = truth.dataset("slipped", &standard_protocol())?;
    data.holds.iter_mut().for_each(spoil);
    let options = Options { next_experiment: false, missing_moment: false, ..Options::default() };
    let evidence = [Evidence::of(data, Some(about(&truth)?))];
    let (words, named) = match diagnose(&truth.told()?, &evidence, &options, &mut |_, _| ()) {
        Ok(found) => {
            (found.pressure_slip.map(|slip| slip.words), found.added.into_iter().map(|added| added.effect).collect())
        }
        Err(CompareError::Refused { message, .. }) => (Some(message), Vec::new()),
        Err(error) => return Err(error),
    };
    Ok(SlippedSet { kind, truth, told: words.is_some(), words, named })
}

/// Their rows of the table.
pub(super) fn rows(sets: &[SlippedSet]) -> Vec<Rate> {
    let share = |figure, target, hit: fn(&SlippedSet) -> bool| {
        Rate::share("a column of pressures written wrongly", figure, target, &sets.iter().map(hit).collect::<Vec<_>>())
    };
    vec![
        share("told as a slip", Goal::AtLeast(0.9), |set| set.told),
        share("an effect named", Goal::AtMost(0.0), |set| !set.named.is_empty()),
    ]
}
