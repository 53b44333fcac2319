//! Effects that may be missing, and effects of the scenario that may be too many: the one place where the diagnosis meets the
//! catalogue.

use crate::diagnosis::result::explained::ParameterValue;
use crate::fit::least_squares::FitRange;
use crate::policy;
use data::{Hold, MeasuredValue};
use models::Scenario;
use models::effects::{Effect, Fitted, Group, Stage};

/// How the name of a candidate begins that takes an effect of the scenario away.
pub(crate) const WITHOUT: &str = "without ";

/// The effect of the scenario that a candidate of this name takes away.
pub fn taken_away(name: &str) -> Option<&str> {
    name.strip_prefix(WITHOUT)
}

/// An effect that can be switched on, or off, with what a fit and a reader need.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Candidate {
    /// Of the effect; with [`WITHOUT`] before it where it is taken away.
    pub name: String,
    /// Where it takes an effect of the scenario away: the number of parameters that adding the effect would fit. The penalty is the same.
    pub removes: Option<usize>,
    pub group: Group,
    /// Where in a prediction it acts.
    pub stage: Stage,
    pub sentence: String,
    /// What measurements show where it acts and the model lacks it.
    pub differs: String,
    pub remedy: String,
    pub parameters: Vec<Free>,
}

/// A parameter to fit; values in SI, `si` leads back to `unit`.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Free {
    pub key: String,
    pub symbol: String,
    pub unit: String,
    /// Factor from `unit` to the SI unit.
    pub si: f64,
    /// Value at which the effect vanishes.
    pub neutral: f64,
    pub typical: f64,
    pub lower: f64,
    pub upper: f64,
    pub possible: [f64; 2],
    /// Where a fit starts in addition to neutral and typical: thresholds and time scales.
    pub starts: Vec<f64>,
    /// When a fit may change it.
    pub fitted: Fitted,
    /// A robot rolled by 180° sees it with the other sign.
    pub in_room: bool,
    /// It stays neutral: the data at hand say nothing of it.
    pub is_held: bool,
}

impl Free {
    /// Whether it is fitted: a parameter that is typically zero (a force along the robot) stays there.
    pub(crate) fn is_free(&self) -> bool {
        !self.is_held && (self.typical != 0.0 || self.neutral != 0.0 || self.is_shape())
    }

    pub(crate) fn is_shape(&self) -> bool {
        self.fitted == Fitted::Shape
    }

    /// Value where it is not fitted: neutral, or as the design has it.
    pub(crate) fn held_at(&self) -> f64 {
        if self.fitted == Fitted::FromDesign { self.typical } else { self.neutral }
    }

    /// Range of a fit; a single value where it is not fitted.
    pub(crate) fn range(&self) -> FitRange {
        match self.is_free() {
            true => FitRange { lower: self.lower, upper: self.upper, scale: self.scale() },
            false => FitRange::fixed(self.held_at(), self.scale()),
        }
    }

    pub(crate) fn found(&self, value: f64, interval: Option<[f64; 2]>, at_bound: bool) -> ParameterValue {
        ParameterValue {
            key: self.key.clone(),
            symbol: self.symbol.clone(),
            unit: self.unit.clone(),
            value: value / self.si,
            held: !self.is_free(),
            lo: interval.map(|i| i[0] / self.si),
            hi: interval.map(|i| i[1] / self.si),
            at_bound,
        }
    }

    pub(crate) fn scale(&self) -> f64 {
        let typical = (self.typical - self.neutral).abs();
        if typical > 0.0 { typical } else { 0.1 * (self.upper - self.lower) }
    }

    /// Whether physics, too, has a bound on the side of the range that is nearer to a value; a share of 0.8 is nearly all there is.
    pub(crate) fn is_forbidden_beyond(&self, value: f64) -> bool {
        let side = usize::from(self.upper - value < value - self.lower);
        self.possible[side].is_finite()
    }

    /// Moves the bound that is nearer to a value to ten times its distance from neutral.
    pub(crate) fn widen(&mut self, value: f64) {
        let further = |bound: f64| self.neutral + policy::WIDER * (bound - self.neutral);
        match self.upper - value < value - self.lower {
            true => self.upper = further(self.upper),
            false => self.lower = further(self.lower),
        }
    }

    /// Whether it shapes the law and has a value at an end of its range.
    pub(crate) fn is_shape_at_end(&self, value: f64) -> bool {
        let at_end = [self.lower, self.upper].iter().any(|end| (value - end).abs() < NEAR * self.scale());
        self.is_free() && !self.is_shape() && self.typical == self.neutral && at_end
    }
}

/// Distance from a bound, over the scale of the parameter, that is none.
pub(crate) const NEAR: f64 = 1e-6;

impl Candidate {
    /// The scenario with this effect at these values (SI), or without it. Known forces on the tip add up.
    pub(crate) fn apply(&self, scenario: &Scenario, values: &[f64]) -> Scenario {
        let name = taken_away(&self.name).unwrap_or(&self.name);
        let own = scenario.effects.iter().find(|e| e.name == name);
        match own {
            None if self.removes.is_some() => scenario.clone(),
            Some(known) if name == "tip_load" => {
                let sum: Vec<f64> = values.iter().zip(&known.values).map(|(a, b)| a + b).collect();
                scenario.with_effect(name, &sum)
            }
            _ => scenario.with_effect(name, values),
        }
    }

    /// Parameters that are held stay at these values of a scenario that has the effect; bounds widen to contain the values.
    pub(crate) fn as_given(&mut self, values: &[f64]) {
        for (p, value) in self.parameters.iter_mut().zip(values) {
            if p.is_held {
                (p.neutral, p.typical) = (*value, *value);
            }
            (p.lower, p.upper) = (p.lower.min(*value), p.upper.max(*value));
        }
    }

    pub(crate) fn at(&self, share: f64) -> Vec<f64> {
        self.parameters.iter().map(|p| p.neutral + share * (p.typical - p.neutral)).collect()
    }

    /// Whether it is there or not by design, with nothing to fit.
    pub(crate) fn is_by_design(&self) -> bool {
        self.removes.is_none() && self.parameters.iter().all(|p| p.fitted == Fitted::FromDesign)
    }

    /// Whether a fit can try it: something is fitted, or it is there or not.
    pub(crate) fn is_tried(&self) -> bool {
        self.count() > 0 || self.is_by_design() || self.removes.is_some()
    }

    /// First parameter whose typical value is not its neutral one.
    pub(crate) fn lead(&self) -> usize {
        self.parameters.iter().position(|p| p.typical != p.neutral).unwrap_or(0)
    }

    /// Values that a scenario has; neutral ones where it lacks the effect.
    pub(crate) fn own_values(&self, scenario: &Scenario) -> Vec<f64> {
        let own = scenario.effects.iter().find(|e| e.name == self.name);
        own.map_or_else(|| self.at(0.0), |e| e.values.clone())
    }

    pub(crate) fn count(&self) -> usize {
        self.parameters.iter().filter(|p| p.is_free()).count()
    }

    /// Number of those that do not shape its law; of an effect that is taken away, as many as adding it would fit.
    pub(crate) fn sizes(&self) -> usize {
        self.removes.unwrap_or_else(|| self.parameters.iter().filter(|p| p.is_free() && !p.is_shape()).count())
    }

    /// It taken away from a scenario that has it, with nothing to fit.
    fn away(self, scenario: &Scenario) -> Candidate {
        let (given, removes) = (self.own_values(scenario), Some(self.sizes()));
        let gone = |(p, given): (Free, f64)| Free {
            neutral: given,
            typical: p.neutral,
            lower: p.neutral.min(given),
            upper: p.neutral.max(given),
            starts: Vec::new(),
            fitted: Fitted::FromDesign,
            is_held: true,
            ..p
        };
        Candidate {
            name: format!("{WITHOUT}{}", self.name),
            removes,
            sentence: format!("The scenario has {}, and this robot may not: {}", self.name, self.sentence),
            differs: format!("The reverse of this: {}", self.differs),
            remedy: format!("Check whether the robot has {} at all. {}", self.name, self.remedy),
            parameters: self.parameters.into_iter().zip(given).map(gone).collect(),
            ..self
        }
    }

    /// Values from which a fit is started: neutral, typical, three times as much, and the other sign where bounds allow
    /// it, and what the catalogue names.
    pub(crate) fn starts(&self) -> Vec<Vec<f64>> {
        if self.count() == 0 {
            return vec![self.parameters.iter().map(Free::held_at).collect()];
        }
        let clamped = |share: f64| -> Vec<f64> {
            self.parameters.iter().zip(self.at(share)).map(|(p, v)| v.clamp(p.lower, p.upper)).collect()
        };
        let mut starts = vec![clamped(0.0), clamped(1.0), clamped(3.0)];
        if clamped(-1.0) != clamped(0.0) {
            starts.push(clamped(-1.0));
        }
        for (k, p) in self.parameters.iter().enumerate() {
            for value in p.starts.iter().filter(|_| !p.is_held) {
                let mut start = clamped(1.0);
                start[k] = *value;
                starts.push(start);
            }
        }
        starts.dedup();
        starts
    }
}

/// Holds parameters at their neutral values that the data do not hold: a bending stiffness that is kept, several body pressures and
/// tests of their own hold more.
pub(crate) fn hold(
    candidates: &mut [Candidate],
    kept_bending: bool,
    body_pressures: bool,
    measured: &[&MeasuredValue],
) {
    for candidate in candidates {
        for p in &mut candidate.parameters {
            let is_measured = measured.iter().any(|m| m.effect == candidate.name && m.key == p.key);
            p.is_held = match p.fitted {
                Fitted::WithKeptBending => !kept_bending,
                Fitted::WithBodyPressures => !body_pressures && !is_measured,
                Fitted::FromDesign => true,
                _ => false,
            };
        }
    }
}

const LAGS: usize = 5;

/// Times of the protocol are tried in the middle between two holds, lags between two samples: nothing changes elsewhere.
pub(crate) fn tried_between(candidates: &mut [Candidate], holds: &[Hold]) {
    let middle = |pair: &[Hold]| Some(0.5 * (pair[0].t_s.last()? + pair[1].t_s.first()?));
    let between: Vec<f64> = holds.windows(2).filter_map(middle).collect();
    let of_sample = |hold: &Hold| Some((hold.t_s.last()? - hold.t_s.first()?) / (hold.t_s.len() as f64 - 1.0).max(1.0));
    let sample_s = holds.first().and_then(of_sample).unwrap_or(0.0);
    let lags = (0..LAGS).map(|k| (k as f64 + 0.5) * sample_s).flat_map(|lag| [-lag, lag]);
    let lags: Vec<f64> = lags.filter(|lag| *lag != 0.0).collect();
    for p in candidates.iter_mut().flat_map(|c| &mut c.parameters) {
        let starts = match p.fitted {
            Fitted::BetweenHolds => &between,
            Fitted::BetweenSamples => &lags,
            _ => continue,
        };
        p.upper = starts.iter().fold(p.upper, |most, t| most.max(*t));
        p.starts.clone_from(starts);
    }
}

pub(crate) fn hold_shapes(candidates: &mut [Candidate]) {
    let all = candidates.iter_mut().flat_map(|c| &mut c.parameters);
    all.filter(|p| p.is_shape()).for_each(|p| p.is_held = true);
}

/// Effects of the catalogue and formulas of the scenario that exist for this actuator and are not in the scenario yet. What follows
/// from how the robot is cut and joined is there or not, with nothing to fit: it may be missing where a scenario describes that.
pub(crate) fn candidates(scenario: &Scenario) -> Vec<Candidate> {
    let catalogue = scenario.catalogue();
    let is_described = scenario.effects.iter().any(|e| catalogue.by_name(&e.name).is_some_and(|e| !e.is_fitted()));
    of_catalogue(scenario, |e| scenario.takes(e) && (e.is_fitted() || is_described) && !has(scenario, e.name))
}

/// Whether a scenario has an effect.
pub(crate) fn has(scenario: &Scenario, name: &str) -> bool {
    scenario.effects.iter().any(|e| e.name == name)
}

/// Effects of the catalogue and formulas of a scenario, as candidates.
pub(crate) fn of_catalogue(scenario: &Scenario, is_wanted: impl Fn(&Effect) -> bool) -> Vec<Candidate> {
    let (catalogue, actuator) = (scenario.catalogue(), scenario.actuator.kind.name);
    catalogue.effects().filter(is_wanted).map(|e| candidate(&e, actuator)).collect()
}

/// The scenario's own effects, to be fitted along with the base; known forces stay known.
pub(crate) fn present(scenario: &Scenario) -> Vec<Candidate> {
    of_catalogue(scenario, |effect| effect.name != "tip_load" && has(scenario, effect.name))
}

/// The scenario's own effects, each taken away; those in `refitted` can go to zero anyway. Known forces stay.
pub(crate) fn surplus(scenario: &Scenario, refitted: &[Candidate]) -> Vec<Candidate> {
    let is_refitted = |own: &Candidate| own.count() > 0 && refitted.iter().any(|c| c.name == own.name);
    let mut all = present(scenario);
    hold(&mut all, true, true, &[]);
    all.retain(|own| !is_refitted(own));
    let mut away: Vec<Candidate> = all.into_iter().map(|own| own.away(scenario)).collect();
    away.retain(|away| away.parameters.iter().any(|p| p.typical != p.neutral));
    away
}

pub(crate) fn candidate(effect: &Effect, actuator: &str) -> Candidate {
    let free = |p: &models::effects::Parameter| Free {
        key: p.key.to_string(),
        symbol: p.symbol.to_string(),
        unit: p.unit.to_string(),
        si: p.si,
        neutral: p.neutral * p.si,
        typical: p.typical_for(actuator) * p.si,
        lower: p.lower * p.si,
        upper: p.upper * p.si,
        possible: p.possible.map(|v| v * p.si),
        starts: p.starts.iter().map(|v| v * p.si).collect(),
        fitted: p.fitted,
        in_room: p.in_room,
        is_held: false,
    };
    Candidate {
        name: effect.name.to_string(),
        removes: None,
        group: effect.group,
        stage: effect.stage,
        sentence: effect.sentence.to_string(),
        differs: effect.differs.to_string(),
        remedy: effect.remedy.to_string(),
        parameters: effect.parameters.iter().map(free).collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_range_may_end_where_physics_does_not() {
        let entry = |name: &str| candidate(models::effects::by_name(name).unwrap(), "epam").parameters;
        let [mut share, reach, _] = <[Free; 3]>::try_from(entry("base_clamp")).unwrap();
        assert!(!share.is_forbidden_beyond(share.upper) && share.is_forbidden_beyond(0.0));
        assert!(reach.is_forbidden_beyond(reach.upper) && reach.is_shape_at_end(reach.upper));
        share.widen(share.upper);
        assert_eq!((share.lower, share.upper), (0.0, 80.0));
        assert!(!reach.is_shape_at_end(1.5) && !share.is_shape_at_end(share.upper));
        let [loss, tail] = ["pressure_loss", "tail_tension"].map(|name| entry(name).remove(0));
        assert!(loss.is_forbidden_beyond(loss.upper) && !tail.is_forbidden_beyond(tail.lower));
    }
}
