//! Poses that the model gives but a robot does not hold: collapse under load, a body folded onto itself; and how long a robot
//! may be.

use crate::error::Unsolved;
use crate::model::{Model, Prediction};
use crate::scenario::Scenario;
use crate::term::Loads;
use serde::Serialize;
use spelling::si;
use std::f64::consts::PI;

/// What is beyond its limit.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Limit {
    /// Outer loads carry more moment than the pressure can, πp_bR³, against the bend of the actuators or where they have
    /// none: a membrane would fold here, and only B and other effects hold the pose.
    Collapse,
    /// κR reached 1: the body is bent about its own axis, and its centre line has no length left.
    Fold,
}

/// A stretch beyond a limit.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Beyond {
    /// Which.
    pub limit: Limit,
    /// Start along the taut generator \[m\].
    #[serde(rename = "s_mm", serialize_with = "si::mm")]
    pub start_m: f64,
    /// Length \[m\].
    #[serde(rename = "length_mm", serialize_with = "si::mm")]
    pub length_m: f64,
    /// Largest share of the limit there \[-\]: above 1.
    pub share: f64,
}

impl Model {
    /// Stretches of a predicted pose that are beyond a limit, base to tip; none of a pose that can be trusted.
    pub fn beyond(&self, loads: &Loads, at: &Prediction) -> Vec<Beyond> {
        let collapse = self.stretches(Limit::Collapse, &|i| self.collapse_share(loads, at, i));
        let fold = self.stretches(Limit::Fold, &|i| {
            at.work.states[i].curvature * self.assembly().sites[self.assembly().segments[i].site].radius_m
        });
        collapse.into_iter().chain(fold).collect()
    }

    /// Moment of the loads that the wall has to carry in a segment over πp_bR³.
    fn collapse_share(&self, loads: &Loads, at: &Prediction, index: usize) -> f64 {
        let site = &self.assembly().sites[self.assembly().segments[index].site];
        let [load, wall] = site.moments(&at.work.states[index], at.work.history.of_segment(index));
        // What helps the actuator must not exceed the wall's alone; against it the line of a taut actuator pulls too. Loads
        // that are nothing leave the wall what the actuator makes of it.
        let carried = if load == 0.0 { 0.0 } else { load.max(-wall) };
        carried / (PI * self.body_pa(loads) * site.radius_m.powi(3))
    }

    fn stretches(&self, limit: Limit, share: &dyn Fn(usize) -> f64) -> Vec<Beyond> {
        let mut found: Vec<Beyond> = Vec::new();
        for (i, segment) in self.assembly().segments.iter().enumerate() {
            let share = share(i);
            // Written so that what is no number is no limit.
            if share < 1.0 || share.is_nan() {
                continue;
            }
            match found.last_mut().filter(|last| (last.start_m + last.length_m - segment.start_m).abs() < 1e-9) {
                Some(last) => (last.length_m, last.share) = (last.length_m + segment.length_m, last.share.max(share)),
                None => found.push(Beyond { limit, start_m: segment.start_m, length_m: segment.length_m, share }),
            }
        }
        found
    }
}

/// Longest robot tried, over the scenario's length, and how much longer every next one is.
const LONGEST: f64 = 50.0;
const LONGER: f64 = 1.03;
/// Relative width of the interval to which a length is narrowed.
const NARROW: f64 = 1e-4;
/// Fewest segments: loads act on nodes.
const SEGMENTS: usize = 60;

/// Length \[m\] from which a robot of this design collapses under the loads of the scenario (`gravity`, `tip_load`) at
/// these pressures: all stretches grow alike, with as many more units. `None`: not up to 50 times its length, or it carries
/// no load.
///
/// A straight robot across gravity folds at its base when w L²/2 + F L = πp_bR³; a steered one has a shorter lever.
pub fn collapse_length_m(scenario: &Scenario, loads: &Loads) -> Option<f64> {
    let fine = Scenario { segments: scenario.segments.max(SEGMENTS), markers_m: Vec::new(), ..scenario.clone() };
    let holds = |factor: f64| -> Result<bool, Unsolved> {
        let model = Model::stretched(&fine, factor);
        let mut at = model.prediction();
        model.predict(loads, &mut at)?;
        Ok(model.beyond(loads, &at).iter().all(|beyond| beyond.limit != Limit::Collapse))
    };
    let holds = |factor: f64| holds(factor).unwrap_or(false);
    if Model::new(&fine).assembly().node_terms.is_empty() {
        return None;
    }
    let (mut low, mut high) = (0.0, 1.0 / LONGEST);
    while holds(high) {
        (low, high) = (high, high * LONGER);
        if high > LONGEST {
            return None;
        }
    }
    while high - low > NARROW * high {
        let middle = 0.5 * (low + high);
        if holds(middle) { low = middle } else { high = middle }
    }
    Some(0.5 * (low + high) * scenario.length_m)
}
