//! What one displacement cannot decide: every effect of the catalogue, alone, at the value that meets it.
//!
//! A published displacement is one number. Each effect is given the value at which the model meets it, if any within
//! its bounds does; all of these models are then equally good there, and differ at the pressures in between. Values are
//! *calibrated* on that one number, so meeting it is not evidence for any of them.

use super::{height, shipped_scenario};
use crate::error::CompareError;
use crate::policy;
use crate::study::engines::{engines, stored};
use data::{PublishedActuator, published};
use models::effects::{Effect, Parameter};
use models::{Loads, Scenario};
use serde::Serialize;

/// Values of an effect tried between neutral and each bound.
const GRID: u32 = 60;
/// Halvings of the interval in which the displacement is met.
const HALVINGS: u32 = 60;

/// One parameter that alone meets a published displacement.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Explanation {
    /// Name of the effect, or `bending_stiffness`.
    pub effect: String,
    /// Key of the parameter that was varied.
    pub key: String,
    /// Unit of the value as scenarios write it.
    pub unit: String,
    /// The value that meets the displacement.
    pub value: f64,
    /// The same as a multiple of the typical size; `None` for B.
    pub times_typical: Option<f64>,
    /// Displacement at every pressure of the protocol \[mm\].
    pub y_mm: Vec<f64>,
}

/// A published displacement and all that meets it.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct OneNumber {
    /// Name of the robot as the paper prints it.
    pub robot: String,
    /// Actuator kind of the robot, such as `epam`.
    pub actuator: String,
    /// Pressures \[kPa\]; the displacement belongs to the last one.
    pub p_act_kpa: Vec<f64>,
    /// Displacement that the paper prints \[mm\].
    pub measured_mm: f64,
    /// The model with what its geometry brings, without bending stiffness, at every pressure \[mm\].
    pub bare_mm: Vec<f64>,
    /// Single effects that meet it, smallest multiple of their typical size first.
    pub met_by: Vec<Explanation>,
    /// Effects that meet it at no value within their bounds.
    pub not_met_by: Vec<String>,
    /// Term whose cut in both engines removes their difference at the highest pressure, where one does.
    pub fe_carrier: Option<String>,
}

impl OneNumber {
    /// Least and largest displacement of the explanations at a pressure \[mm\].
    pub fn spread_mm(&self, pressure: usize) -> Option<[f64; 2]> {
        let at = self.met_by.iter().map(|e| e.y_mm[pressure]);
        at.fold(None, |range: Option<[f64; 2]>, y| Some(range.map_or([y, y], |[a, b]| [a.min(y), b.max(y)])))
    }
}

/// Every explanation of the published displacement of a shipped robot, on top of the model of that name.
///
/// # Errors
/// An actuator of which nothing is published; a model without equilibrium.
pub fn one_number(name: &str) -> Result<OneNumber, CompareError> {
    let paper = published()?;
    let missing = || CompareError::NoScenario { kind: name.into(), problem: "nothing is published about it".into() };
    let bare = shipped_scenario(name)?;
    let kind = bare.actuator.kind.name;
    let actuator: &PublishedActuator = paper.actuator(kind).ok_or_else(missing)?;
    let top_pa = actuator.d_max_pressure_pa;
    let mut pressures: Vec<f64> =
        paper.protocol.actuator_pa.iter().copied().filter(|p| *p > 0.0 && *p < top_pa).collect();
    pressures.push(top_pa);
    let loads: Vec<Loads> = pressures.iter().map(|p| Loads::uniform(paper.protocol.body_pa, *p)).collect();
    let curve =
        |s: &Scenario| loads.iter().map(|l| Ok(1e3 * height(s, l)?)).collect::<Result<Vec<f64>, CompareError>>();
    let aim = HeightTarget { loads: loads[loads.len() - 1], wanted_m: actuator.d_max_m };
    let (mut met_by, mut not_met_by) = (Vec::new(), Vec::new());
    if let Some(value) = aim.reached(0.0, policy::MOST_BENDING, &|b| bare.with_bending(b)) {
        let y_mm = curve(&bare.with_bending(value))?;
        let [effect, key, unit] = ["bending_stiffness", "bending_stiffness_nm2", "N m²"].map(String::from);
        met_by.push(Explanation { effect, key, unit, value, times_typical: None, y_mm });
    }
    let family = bare.actuator.kind.family;
    let is_new = |e: &&Effect| e.applies_to(family) && e.is_fitted() && bare.effects.iter().all(|b| b.name != e.name);
    for effect in models::effects::EFFECTS.iter().filter(is_new) {
        let Some((p, value)) = aim.meets(&bare, effect) else {
            not_met_by.push(effect.name.to_string());
            continue;
        };
        let neutral = p.neutral * p.si;
        met_by.push(Explanation {
            effect: effect.name.into(),
            key: p.key.into(),
            unit: p.unit.into(),
            value: value / p.si,
            times_typical: Some((value - neutral) / (p.typical_for(kind) * p.si - neutral)),
            y_mm: curve(&with(&bare, effect, p, value))?,
        });
    }
    let size = |e: &Explanation| e.times_typical.map_or(0.0, f64::abs);
    met_by.sort_by(|a, b| size(a).total_cmp(&size(b)));
    let robots = engines(std::slice::from_ref(&bare), &stored()?)?.robots;
    let carrier = robots.first().and_then(|r| r.pairs.last()?.carrier);
    Ok(OneNumber {
        robot: actuator.printed_name.clone(),
        actuator: kind.into(),
        p_act_kpa: pressures.iter().map(|p| p * 1e-3).collect(),
        measured_mm: actuator.d_max_m * 1e3,
        bare_mm: curve(&bare)?,
        met_by,
        not_met_by,
        fe_carrier: carrier.map(|carrier| carrier.term.to_string()),
    })
}

struct HeightTarget {
    loads: Loads,
    wanted_m: f64,
}

impl HeightTarget {
    /// The parameter that is varied and the value nearest neutral at which the effect alone meets the displacement.
    fn meets(&self, bare: &Scenario, effect: &Effect<'static>) -> Option<(&'static Parameter<'static>, f64)> {
        let p = effect.parameters.iter().find(|p| p.typical != p.neutral)?;
        let (neutral, model) = (p.neutral * p.si, |value: f64| with(bare, effect, p, value));
        let found = [p.upper, p.lower].into_iter().filter_map(|end| self.reached(neutral, end * p.si, &model));
        let away = |v: &f64| (v - neutral).abs();
        found.min_by(|a, b| away(a).total_cmp(&away(b))).map(|value| (p, value))
    }

    /// The value nearest `from` on the way to `to` at which the displacement is met.
    fn reached(&self, from: f64, to: f64, model: &dyn Fn(f64) -> Scenario) -> Option<f64> {
        if from == to {
            return None;
        }
        let miss = |v: f64| height(&model(v), &self.loads).ok().map(|y| y - self.wanted_m);
        // Denser near neutral, where most effects act first.
        let at = |i: u32| from + (to - from) * (f64::from(i) / f64::from(GRID)).powi(2);
        let mut low = (at(0), miss(at(0))?);
        for i in 1..=GRID {
            let next = miss(at(i))?;
            if low.1 * next <= 0.0 && low.1 != next {
                let is_before = |v: f64| miss(v).is_some_and(|y| y * low.1 > 0.0);
                return Some(halved([low.0, at(i)], is_before));
            }
            low = (at(i), next);
        }
        None
    }
}

/// Where something stops being so between two values.
fn halved([mut low, mut high]: [f64; 2], is_before: impl Fn(f64) -> bool) -> f64 {
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if is_before(middle) { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

/// The bare model with one parameter of one effect set, others typical.
fn with(bare: &Scenario, effect: &Effect, varied: &Parameter, value_si: f64) -> Scenario {
    let mut values = effect.typical_for(bare.actuator.kind.name);
    let own = effect.parameters.iter().position(|p| p.key == varied.key);
    own.into_iter().for_each(|k| values[k] = value_si);
    bare.with_effect(effect.name, &values)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_explanation_meets_the_published_number_and_several_do() {
        for kind in ["spam-textbook", "epam-textbook", "fpam-textbook"] {
            let one = one_number(kind).unwrap();
            assert!(one.met_by.len() >= 3, "{kind}: {:?}", one.met_by);
            for e in &one.met_by {
                let y = e.y_mm[e.y_mm.len() - 1];
                assert!((y - one.measured_mm).abs() < 1e-3, "{kind} {}: {y} for {}", e.effect, one.measured_mm);
            }
        }
    }

    #[test]
    fn without_an_effect_the_pouches_bend_too_far() {
        let bare = |kind: &str| *one_number(kind).unwrap().bare_mm.last().unwrap();
        for (kind, y_mm) in [("epam-textbook", 161.6), ("spam-textbook", 145.5), ("epam", 111.7)] {
            assert!((bare(kind) - y_mm).abs() < 0.05, "{kind}: {}", bare(kind));
        }
    }
}
