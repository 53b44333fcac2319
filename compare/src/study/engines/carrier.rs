//! Which term carries a difference of both engines: it is cut in both, and the difference goes.
//!
//! ```text
//! d = tip_reduced/tip_fe − 1        d′: the same without the term        carried by the term of the least |d′| < ½ |d|
//! ```
//!
//! The finite elements keep a tenth of the term, since a mesh without bending stiffness crumples; the reduced model loses
//! the effects that store energy on the account of the term. A bare model has none, and stays as it is: it is the model that does not
//! know the term. **Validity**: terms that a setting of the robot scales. The work of the gas is the load and cannot be cut.

use super::{EnginePair, EngineRun, EngineState};
use crate::error::CompareError;
use crate::policy;
use fem::session::RobotSummary;
use models::{Account, Loads, Model, Scenario};
use serde::Serialize;

/// A term that is cut to a tenth.
#[derive(Debug)]
pub struct ReducedTerm {
    /// Name of the term in [`super::TERMS`].
    pub term: &'static str,
    /// Its account in the reduced model.
    account: Account,
    /// Key of `[fem]` that scales it, and what it becomes.
    pub key: (&'static str, f64),
}

/// Terms that runs cut to a tenth.
pub const CUTS: [ReducedTerm; 2] = [
    ReducedTerm { term: "wall bending", account: Account::Wall, key: ("bending_share", 0.1) },
    ReducedTerm { term: "compressed sheets", account: Account::Compression, key: ("wrinkle_length", 10.0) },
];

/// The term without which the two engines differ least.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Carrier {
    /// Name of the term in [`super::TERMS`].
    pub term: &'static str,
    /// Reduced minus finite element tip over the latter, without the term.
    pub difference_without: f64,
}

impl ReducedTerm {
    /// The cut of a run, if a term was cut.
    pub(super) fn of(about: &RobotSummary) -> Option<&'static ReducedTerm> {
        CUTS.iter().find(|cut| (about.setting(cut.key.0) / cut.key.1 - 1.0).abs() < 1e-9)
    }
}

/// What carries the difference of a pair of this run, of all runs.
pub fn carrier(
    scenario: &Scenario,
    run: &EngineRun,
    pair: &EnginePair,
    all: &[EngineRun],
) -> Result<Option<Carrier>, CompareError> {
    let Some(difference) = pair.difference().filter(|_| pair.parts()) else { return Ok(None) };
    let mut best: Option<Carrier> = None;
    for cut in &CUTS {
        let same = |other: &&EngineRun| other.cut == cut.term && place(other) == place(run);
        let at = |state: &&EngineState| policy::is_same_reading(state.actuator_kpa, pair.actuator_kpa);
        let Some(state) = all.iter().find(same).and_then(|other| other.states.iter().find(at)) else { continue };
        let tip_mm = without(scenario, cut.account, run.body_kpa, pair.actuator_kpa)?;
        let difference_without = tip_mm / state.tip_mm - 1.0;
        let least = best.map_or(0.5 * difference.abs(), |best| best.difference_without.abs());
        if difference_without.abs() < least {
            best = Some(Carrier { term: cut.term, difference_without });
        }
    }
    Ok(best)
}

fn place(run: &EngineRun) -> (&str, &str, [u64; 2], usize, [f64; 4]) {
    let lengths = [run.body_kpa, run.pouch_mm, run.radius_mm, run.width_mm];
    (&run.actuator, &run.scenario, run.mesh_mm.map(f64::to_bits), run.count, lengths)
}

/// Tip of the reduced model without the effects of an account \[mm\].
fn without(scenario: &Scenario, account: Account, body_kpa: f64, actuator_kpa: f64) -> Result<f64, CompareError> {
    let loads = Loads::uniform(body_kpa * 1e3, actuator_kpa * 1e3);
    let lines = |scenario: &Scenario| -> Result<(usize, f64), CompareError> {
        let model = Model::new(scenario);
        let mut at = model.prediction();
        model.predict(&loads, &mut at)?;
        let on_it = model.ledger(&loads, &at).iter().filter(|line| line.account == account).count();
        Ok((on_it, at.tip.y_m * 1e3))
    };
    let mut kept = scenario.clone();
    if account == Account::Wall {
        kept.bending_stiffness = 0.0;
    }
    for effect in scenario.effects.iter() {
        let mut fewer = kept.clone();
        fewer.effects.retain(|other| other.name != effect.name);
        if lines(&fewer)?.0 < lines(&kept)?.0 {
            kept = fewer;
        }
    }
    Ok(lines(&kept)?.1)
}
