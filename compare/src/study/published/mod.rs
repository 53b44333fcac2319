//! The reduced models against the displacements that du Pasquier et al. 2023 print: one number per actuator.
//!
//! Four displacements cannot decide which effect is missing. The ladders show what each effect, with a value that comes
//! from geometry, from a fabric test or from a formula (never from the measured displacement, unless the rung is marked
//! *calibrated*), does to the prediction.

mod mechanics;
pub mod one_number;
pub mod tradeoff;

use crate::error::CompareError;
use data::{Published, PublishedActuator, published};
use mechanics::{additions, with};
use models::{Known, Loads, Model, Scenario, shipped};
use serde::Serialize;
use spelling::si;

/// One rung: a model and what it predicts for the outermost marker.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Rung {
    /// What this rung adds to the one before, in words.
    #[serde(rename = "model")]
    pub label: String,
    /// The model of this rung, with everything added so far.
    #[serde(skip)]
    pub scenario: Scenario,
    /// Height of the outermost marker \[m\].
    #[serde(rename = "y_mm", serialize_with = "si::mm")]
    pub y_m: f64,
    /// Range of that height over the stated range of the added value \[m\].
    #[serde(rename = "range_mm", serialize_with = "si::mm")]
    pub range_m: Option<[f64; 2]>,
    /// How the value added is known.
    #[serde(rename = "how_known")]
    pub known: Known,
    /// Source of the added value, or why it is assumed.
    pub why: String,
}

/// The rungs of one actuator and the published displacement.
#[derive(Debug, Clone, PartialEq)]
pub struct PublishedLadder {
    /// Displacements and accuracies that the paper prints.
    pub published: PublishedActuator,
    /// Models in order, the bare one first.
    pub rungs: Vec<Rung>,
}

/// Ladders of all published actuators.
///
/// # Errors
/// A damaged embedded set, or a model without equilibrium.
pub fn published_ladders() -> Result<Vec<PublishedLadder>, CompareError> {
    let paper = published()?;
    paper.actuators.iter().map(|a| ladder(&paper, a)).collect()
}

/// The models of a ladder without the calibrated one: bare, then one effect after the other. An actuator of which nothing is
/// published has the bare model alone.
///
/// # Errors
/// A damaged embedded set, or an actuator without a shipped scenario.
pub fn model_ladder(kind: &str) -> Result<Vec<Rung>, CompareError> {
    let paper = published()?;
    let Some(actuator) = paper.actuator(kind) else {
        let top = paper.protocol.actuator_pa.iter().fold(0.0, |top: f64, p| top.max(*p));
        return Ok(vec![start(&shipped_scenario(kind)?, &Loads::uniform(paper.protocol.body_pa, top))?]);
    };
    let mut rungs = ladder(&paper, actuator)?.rungs;
    rungs.retain(|rung| rung.known != Known::Calibrated);
    Ok(rungs)
}

fn ladder(paper: &Published, actuator: &PublishedActuator) -> Result<PublishedLadder, CompareError> {
    let scenario = shipped_scenario(&actuator.kind)?;
    let loads = Loads::uniform(paper.protocol.body_pa, actuator.d_max_pressure_pa);
    let mut rungs = vec![start(&scenario, &loads)?];
    for addition in additions(paper, &scenario.actuator) {
        let before = &rungs[rungs.len() - 1].scenario;
        let next = with(before, addition.effect, addition.value);
        let range_m = match addition.range {
            Some(ends) => {
                let y = |v: f64| height(&with(before, addition.effect, v), &loads);
                let all = [y(ends[0])?, y(ends[1])?, y(addition.value)?];
                Some([all.into_iter().fold(f64::INFINITY, f64::min), all.into_iter().fold(0.0, f64::max)])
            }
            None => None,
        };
        let y_m = height(&next, &loads)?;
        let last = rungs.len() - 1;
        if y_m == rungs[last].y_m && range_m.is_none_or(|[low, high]| low == high) {
            // An effect that does nothing in this actuator, as sealed sides where gussets free them, gets no rung.
            rungs[last].scenario = next;
            continue;
        }
        let label = format!("+ {}", addition.effect);
        rungs.push(Rung { label, scenario: next, y_m, range_m, known: addition.known, why: addition.why.into() });
    }
    calibrate(&mut rungs, &loads, actuator.d_max_m)?;
    Ok(PublishedLadder { published: actuator.clone(), rungs })
}

/// The scenario that comes with the library for an actuator kind.
pub fn shipped_scenario(kind: &str) -> Result<Scenario, CompareError> {
    let missing = |problem: String| CompareError::NoScenario { kind: kind.to_string(), problem };
    let text = shipped(kind).ok_or_else(|| missing("there is none".into()))?;
    Scenario::parse(text).map_err(|e| missing(e.to_string()))
}

/// The same without the mechanics that textbook models lack.
pub fn textbook_scenario(kind: &str) -> Result<Scenario, CompareError> {
    shipped_scenario(&format!("{kind}-textbook"))
}

/// The bare law: constant arm, nothing added.
fn start(scenario: &Scenario, loads: &Loads) -> Result<Rung, CompareError> {
    let bare = scenario.bare();
    let y_m = height(&bare, loads)?;
    let why = "stroke law, constant arm, body pressure; nothing fitted".to_string();
    Ok(Rung { label: "bare model".into(), scenario: bare, y_m, range_m: None, known: Known::Predicted, why })
}

/// Heights of the outermost marker, else of the tip, and of the tip \[m\].
///
/// # Errors
/// No equilibrium.
pub fn heights_m(scenario: &Scenario, loads: &Loads) -> Result<[f64; 2], CompareError> {
    let model = Model::new(scenario);
    let mut state = model.prediction();
    model.predict(loads, &mut state)?;
    Ok([state.markers.last().map_or(state.tip.y_m, |xy| xy[1]), state.tip.y_m])
}

pub(crate) fn height(scenario: &Scenario, loads: &Loads) -> Result<f64, CompareError> {
    Ok(heights_m(scenario, loads)?[0])
}

/// Adds the rung with the B ≥ 0 that meets the displacement: one number fitted to one number, shown as such.
fn calibrate(rungs: &mut Vec<Rung>, loads: &Loads, wanted_m: f64) -> Result<(), CompareError> {
    let last = rungs[rungs.len() - 1].clone();
    if last.y_m <= wanted_m {
        return Ok(());
    }
    let (mut low, mut high) = (0.0, 1.0);
    while height(&last.scenario.with_bending(high), loads)? > wanted_m && high < 1e3 {
        high *= 2.0;
    }
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if height(&last.scenario.with_bending(middle), loads)? > wanted_m { low = middle } else { high = middle }
    }
    let scenario = last.scenario.with_bending(high);
    let y_m = height(&scenario, loads)?;
    let label = format!("+ bending B = {high:.2} N m²");
    let why = "fitted to the measured displacement itself, so it meets it: proves nothing".to_string();
    rungs.push(Rung { label, scenario, y_m, range_m: None, known: Known::Calibrated, why });
    Ok(())
}
