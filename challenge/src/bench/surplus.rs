//! Robots whose scenario has an effect that they do not have: five effects on each robot, nothing hidden.

use super::outcome::{Diagnoser, about};
use super::row::{Goal, Rate};
use crate::truth::{ROBOTS, standard_protocol};
use crate::{Draw, Truth};
use compare::Evidence;
use compare::diagnosis::{Options, Verdict, taken_away};
use compare::error::CompareError;
use serde::{Deserialize, Serialize};

/// The effects, each at its typical size: body, loads, supply and camera.
const EFFECTS: [&str; 5] = ["friction", "tail_tension", "fabric_stretch", "pressure_loss", "camera_scale"];
/// Sets of a round: every effect on every robot.
const SETS: usize = EFFECTS.len() * ROBOTS.len();
/// First of their streams of random numbers; other parts have smaller ones.
const STREAM: u64 = 101 << 32;

/// A set with an effect too many in its scenario, and the diagnosis of it.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct SurplusSet {
    /// Effect that the scenario has and the robot does not have.
    pub effect: String,
    /// Robot, noise and runs, without that effect.
    pub truth: Truth,
    /// Verdict; `None` if the data do not allow one.
    pub verdict: Option<Verdict>,
    /// The stated set; a pair is written `a + b`.
    pub stated: Vec<String>,
}

impl SurplusSet {
    /// Whether the stated set holds the truth; `None` without one.
    pub(super) fn holds(&self) -> Option<bool> {
        (self.verdict == Some(Verdict::Effect)).then(|| self.is_named())
    }

    fn is_named(&self) -> bool {
        let is_it = |part: &str| taken_away(part) == Some(&self.effect);
        self.stated.iter().any(|entry| entry.split(" + ").any(is_it))
    }
}

/// Sets of a bench, a round for every hundred of its sets.
pub(super) fn count(sets: usize) -> usize {
    SETS * sets.div_ceil(100)
}

pub(super) fn surplus(seed: u64, index: usize, diagnose: Diagnoser) -> Result<SurplusSet, CompareError> {
    let name = EFFECTS[index / ROBOTS.len() % EFFECTS.len()];
    let robot = ROBOTS[index % ROBOTS.len()].0;
    let truth = Truth::draw(robot, &mut Draw::new(seed, STREAM + index as u64))?;
    let missing = || CompareError::NotSimulated { problem: format!("the catalogue has no {name}") };
    let effect = models::effects::by_name(name).ok_or_else(missing)?;
    let scenario = truth.told()?.with_effect(name, &effect.typical_for(robot));
    let evidence = [Evidence::of(truth.dataset("surplus", &standard_protocol())?, Some(about(&truth)?))];
    let options = Options::default().without_advice();
    let found = diagnose(&scenario, &evidence, &options, &mut |_, _| ())?;
    Ok(SurplusSet { effect: name.into(), truth, verdict: found.verdict, stated: found.indistinguishable })
}

pub(super) fn rows(sets: &[SurplusSet]) -> Vec<Rate> {
    let alarmed: Vec<&SurplusSet> = sets.iter().filter(|set| set.verdict != Some(Verdict::None)).collect();
    let case = "an effect too many in the scenario";
    let share = |figure, goal, hit: fn(&SurplusSet) -> bool| {
        Rate::share(case, figure, goal, &alarmed.iter().map(|set| hit(set)).collect::<Vec<_>>())
    };
    let is_another = |set: &SurplusSet| set.verdict == Some(Verdict::Effect) && !set.is_named();
    vec![
        share("with an alarm: named as one too many", Goal::AtLeast(0.85), SurplusSet::is_named),
        share("with an alarm: only absent effects named", Goal::AtMost(0.05), is_another),
    ]
}
