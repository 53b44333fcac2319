//! The reduced models against the displacements that du Pasquier et al. 2023 print: one number per actuator.
//!
//! Four displacements cannot decide which effect is missing. The ladders show what each effect, with a value that comes
//! from geometry, from a fabric test or from a formula (never from the measured displacement, unless the rung says
//! *calibrated*), does to the prediction.

use crate::error::CompareError;
use crate::plots::Known;
use data::{Published, PublishedActuator, published};
use models::{Loads, Model, Scenario, shipped};

/// One rung: a model and what it predicts for the outermost marker.
#[derive(Debug, Clone, PartialEq)]
pub struct Rung {
    /// What was added, in words.
    pub label: String,
    /// The model.
    pub scenario: Scenario,
    /// Height of the outermost marker \[m\].
    pub y_m: f64,
    /// Range of that height over the stated range of the added value \[m\].
    pub range_m: Option<[f64; 2]>,
    /// How the value added is known.
    pub known: Known,
    /// Where the value comes from.
    pub why: String,
}

/// The rungs of one actuator and the published displacement.
#[derive(Debug, Clone, PartialEq)]
pub struct PublishedLadder {
    /// The paper's numbers.
    pub published: PublishedActuator,
    /// Bare model first.
    pub rungs: Vec<Rung>,
    /// B that makes the last uncalibrated rung meet the displacement \[N·m²\]; `None` if no B ≥ 0 does.
    pub calibrated_bending: Option<f64>,
}

/// Robin's paper-bag volume as an edge-loss coefficient, 0.142π.
pub const ROBIN: f64 = 0.142 * std::f64::consts::PI;
/// Edge-loss coefficients of Kepert's bounds on the volume of a square bag, by the same formula at W = L₀.
pub const KEPERT: [f64; 2] = [(1.0 - 0.6817) / 0.9, (1.0 - 0.6456) / 0.9];

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
        let top = paper.actuator_pressures_pa.iter().fold(0.0, |top: f64, p| top.max(*p));
        return Ok(vec![start(&shipped_scenario(kind)?, &Loads::uniform(paper.body_pressure_pa, top))?]);
    };
    let mut rungs = ladder(&paper, actuator)?.rungs;
    rungs.retain(|rung| rung.known != Known::Calibrated);
    Ok(rungs)
}

/// The scenario with an effect whose first parameter has a value; others stay neutral.
fn with(scenario: &Scenario, effect: &str, value: f64) -> Scenario {
    let mut values = models::effects::by_name(effect).map_or_else(Vec::new, |e| e.neutral());
    values.iter_mut().take(1).for_each(|first| *first = value);
    scenario.with_effect(effect, &values)
}

fn ladder(paper: &Published, actuator: &PublishedActuator) -> Result<PublishedLadder, CompareError> {
    let scenario = shipped_scenario(&actuator.kind)?;
    let loads = Loads::uniform(paper.body_pressure_pa, actuator.d_max_pressure_pa);
    let mut rungs = vec![start(&scenario, &loads)?];
    for addition in additions(paper, actuator) {
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
        let label = format!("+ {}", addition.effect);
        rungs.push(Rung { label, scenario: next, y_m, range_m, known: addition.known, why: addition.why.into() });
    }
    let calibrated_bending = calibrate(&mut rungs, &loads, actuator.d_max_m)?;
    Ok(PublishedLadder { published: actuator.clone(), rungs, calibrated_bending })
}

/// The scenario that comes with the library for an actuator kind.
///
/// # Errors
/// An unknown kind.
pub fn shipped_scenario(kind: &str) -> Result<Scenario, CompareError> {
    let missing = |problem: String| CompareError::NoScenario { kind: kind.to_string(), problem };
    let text = shipped(kind).ok_or_else(|| missing("there is none".into()))?;
    Scenario::parse(text).map_err(|e| missing(e.to_string()))
}

/// The bare law: constant arm, nothing added.
fn start(scenario: &Scenario, loads: &Loads) -> Result<Rung, CompareError> {
    let bare = scenario.bare();
    let y_m = height(&bare, loads)?;
    let why = "stroke law, constant arm, body pressure; nothing fitted".to_string();
    Ok(Rung { label: "bare model".into(), scenario: bare, y_m, range_m: None, known: Known::Predicted, why })
}

/// An effect to add, with the origin of its value.
struct Addition {
    effect: &'static str,
    value: f64,
    range: Option<[f64; 2]>,
    known: Known,
    why: &'static str,
}

fn additions(paper: &Published, actuator: &PublishedActuator) -> Vec<Addition> {
    let growth = Addition {
        effect: "arm_growth",
        value: 1.0,
        range: None,
        known: Known::Predicted,
        why: "geometry of an actuator outside the body: its axis rides on its own bulge",
    };
    let ends = Addition {
        effect: "end_constraint",
        value: ROBIN,
        range: Some(KEPERT),
        known: Known::Assumed,
        why: "sealed-bag volume of Robin; the range reaches to Kepert's bounds; that stroke is lost like volume is assumed, and finite elements lose none",
    };
    let contact = Addition {
        effect: "self_contact",
        value: 1000.0,
        range: None,
        known: Known::Assumed,
        why: "pouches side by side without a gap, hard stop",
    };
    let mut list = match actuator.kind.as_str() {
        "spam" => vec![growth, ends],
        "epam" => vec![ends],
        "cpam" => vec![contact],
        _ => vec![growth],
    };
    if let Some(fabric) = paper.fabrics.iter().find(|f| f.name == actuator.fabric) {
        list.extend(fabric_effects(fabric));
    }
    list
}

/// What the published moduli of the fabric say.
fn fabric_effects(fabric: &data::PublishedFabric) -> Vec<Addition> {
    match fabric.e45_pa {
        Some(e45) => {
            let shear = models::exact::fpam::shear_modulus_from_bias_pa(e45, fabric.e0_pa, fabric.e90_pa);
            vec![Addition {
                effect: "shear_stiffness",
                value: shear * fabric.thickness_m,
                range: None,
                known: Known::Predicted,
                why: "shear modulus from the published E0, E45, E90 and the published thickness",
            }]
        }
        None => vec![Addition {
            effect: "fabric_stretch",
            value: 1.0 / (fabric.e0_pa * fabric.thickness_m),
            range: None,
            known: Known::Predicted,
            why: "compliance from the published E0 and the published thickness",
        }],
    }
}

pub(crate) fn height(scenario: &Scenario, loads: &Loads) -> Result<f64, CompareError> {
    let model = Model::new(scenario);
    let mut state = model.prediction();
    model.predict(loads, &mut state)?;
    Ok(state.markers.last().map_or(state.tip.y_m, |xy| xy[1]))
}

/// Adds the rung with the B ≥ 0 that meets the displacement: one number fitted to one number, shown as such.
fn calibrate(rungs: &mut Vec<Rung>, loads: &Loads, wanted_m: f64) -> Result<Option<f64>, CompareError> {
    let last = rungs[rungs.len() - 1].clone();
    if last.y_m <= wanted_m {
        return Ok(None);
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
    Ok(Some(high))
}
