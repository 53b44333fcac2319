//! Poses that the model gives but a robot does not hold: collapse under load, a body folded onto itself; and how long a robot
//! may be.

use crate::error::Solved;
use crate::model::{Model, Prediction};
use crate::scenario::Scenario;
use crate::statics::Statics;
use crate::term::Loads;
use serde::Serialize;
use spelling::si;
use std::f64::consts::PI;

/// Limit that a stretch of the body can exceed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Limit {
    /// Outer loads have more moment than wall and pull can carry under the pressure: πp_bR³ with the bend or without an
    /// actuator, p_b A (D − ȳ) against it. A membrane folds here, and only B and other effects hold the pose.
    Collapse,
    /// κR reached 1: the body is bent about its own axis, and its centre line has no length left.
    Fold,
    /// The body runs into itself: beyond half a turn, two places of its centre line are nearer than 2R.
    Crossing,
}

/// Stretch of the body that exceeds one limit.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Beyond {
    /// Limit that the stretch of the body exceeds.
    pub limit: Limit,
    /// Start along the taut generator \[m\].
    #[serde(rename = "s_mm", serialize_with = "si::mm")]
    pub start_m: f64,
    /// Length along the taut generator \[m\].
    #[serde(rename = "length_mm", serialize_with = "si::mm")]
    pub length_m: f64,
    /// Largest share of the limit there \[-\]: above 1.
    pub share: f64,
}

impl Model {
    /// Stretches of a predicted pose that are beyond a limit, base to tip; none of a pose that can be trusted.
    pub fn beyond(&self, loads: &Loads, at: &Prediction) -> Vec<Beyond> {
        let collapse = self.stretches(Limit::Collapse, &|i| self.collapse_share(loads, at, i));
        let fold = |i: usize| at.work.states[i].curvature.abs() * self.assembly().site(i).radius_m;
        let fold = self.stretches(Limit::Fold, &fold);
        collapse.into_iter().chain(fold).chain(self.crossing(at)).collect()
    }

    /// The part that runs into one nearer to the base, with 2R over the distance of the two.
    fn crossing(&self, at: &Prediction) -> Option<Beyond> {
        let segments = &self.assembly().segments;
        let sizes = segments.iter().zip(&at.work.states).map(|(s, state)| (s.length_m * state.curvature).abs());
        if sizes.sum::<f64>() < PI {
            return None;
        }
        let (mut places, mut turned): (Vec<LinePlace>, f64) = (Vec::new(), 0.0);
        for (i, segment) in segments.iter().enumerate() {
            let (radius_m, kappa) = (self.assembly().site(i).radius_m, at.work.states[i].curvature.abs());
            let count = (segment.length_m / (SPACING * radius_m)).ceil();
            for k in 0..=count as usize {
                let offset_m = segment.length_m * k as f64 / count;
                let turned = turned + kappa * offset_m;
                let (s_m, at) = (segment.start_m + offset_m, self.point(&at.work, i, offset_m));
                places.push(LinePlace { s_m, at, turned, radius_m });
            }
            turned += kappa * segment.length_m;
        }
        let mut found: Option<Beyond> = None;
        for (i, place) in places.iter().enumerate() {
            let share = |other: &LinePlace| (place.radius_m + other.radius_m) / distance(place.at, other.at);
            let near = places[..i].iter().take_while(|other| place.turned - other.turned > PI).map(share);
            let share = near.fold(0.0, f64::max);
            if share > 1.0 {
                let start_m = found.map_or(place.s_m, |found| found.start_m);
                let share = found.map_or(share, |found| found.share.max(share));
                found = Some(Beyond { limit: Limit::Crossing, start_m, length_m: place.s_m - start_m, share });
            }
        }
        found
    }

    fn collapse_share(&self, loads: &Loads, at: &Prediction, index: usize) -> f64 {
        if self.assembly().node_terms.is_empty() {
            return 0.0;
        }
        self.carried_share(loads, at, index, [0.0; 2])
    }

    /// Moment of the loads on a segment over the one that its section can carry; with a tail of this tension, at this distance
    /// from the axis towards the actuator, inside a planar robot.
    pub(crate) fn carried_share(
        &self,
        loads: &Loads,
        at: &Prediction,
        index: usize,
        [tail_n, tail_at_m]: [f64; 2],
    ) -> f64 {
        let (assembly, work) = (self.assembly(), &at.work);
        let (site, state) = (assembly.site(index), &work.states[index]);
        let (p_body_pa, radius_m) = (self.body_pa(loads, work), site.radius_m);
        if self.is_spatial() {
            let [y, z, shortening] = work.space.loaded.outer(index);
            let strips = assembly.around[index].iter().zip(&work.space.strips[index]);
            let pulling = strips.filter(|(_, state)| state.tension > 0.0);
            let pulls = &mut pulling.map(|(at, s)| assembly.sites[at.site].pull(at.azimuth_rad, s.coordinate));
            return Statics { p_body_pa, radius_m, moment_nm: [y, z], tension_n: -shortening, pulls }.share();
        }
        let tension_n = if assembly.node_terms.is_empty() { 0.0 } else { work.tension_n(index) };
        // From the taut generator to the axis.
        let moment =
            state.moment_nm() + site.centre_line.shortening(state.curvature)[1] * tension_n + tail_n * tail_at_m;
        let tension_n = tension_n - tail_n;
        let pulls = &mut (state.tension > 0.0).then(|| site.pull(0.0, state.coordinate)).into_iter();
        Statics { p_body_pa, radius_m, moment_nm: [moment, 0.0], tension_n, pulls }.share()
    }

    fn stretches(&self, limit: Limit, share: &dyn Fn(usize) -> f64) -> Vec<Beyond> {
        let mut found: Vec<Beyond> = Vec::new();
        for (i, segment) in self.assembly().segments.iter().enumerate() {
            let share = share(i);
            // Written so that NaN does not count as a limit.
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

/// A place of the centre line, and ∫|κ| ds up to it.
struct LinePlace {
    s_m: f64,
    at: [f64; 3],
    turned: f64,
    radius_m: f64,
}

/// Distance of places that are compared, over the radius.
const SPACING: f64 = 0.25;

fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1]).hypot(a[2] - b[2])
}

/// Largest factor tried, the inverse of the first one, and how much larger every next one is.
const LARGEST: f64 = 50.0;
const LARGER: f64 = 1.03;
/// Relative width of the interval to which a factor is narrowed.
const NARROW: f64 = 1e-4;
/// Fewest segments: loads act on nodes.
const SEGMENTS: usize = 60;

/// The first factor at which a robot made with it has collapsed, or has no equilibrium; `None`: up to the largest it has not.
fn first_collapse(loads: &Loads, make: impl Fn(f64) -> Model) -> Option<f64> {
    let holds = |factor: f64| -> Solved<bool> {
        let model = make(factor);
        let mut at = model.prediction();
        model.predict(loads, &mut at)?;
        Ok(model.beyond(loads, &at).iter().all(|beyond| beyond.limit != Limit::Collapse))
    };
    let holds = |factor: f64| holds(factor).unwrap_or(false);
    let (mut low, mut high) = (0.0, 1.0 / LARGEST);
    while holds(high) {
        (low, high) = (high, high * LARGER);
        if high > LARGEST {
            return None;
        }
    }
    while high - low > NARROW * high {
        let middle = 0.5 * (low + high);
        if holds(middle) { low = middle } else { high = middle }
    }
    Some(0.5 * (low + high))
}

/// The scenario without markers, fine enough for loads on nodes; `None` if it carries none.
fn loaded(scenario: &Scenario) -> Option<Scenario> {
    let is_loaded = !Model::for_few(scenario).assembly().node_terms.is_empty();
    let segments = scenario.segments.max(SEGMENTS);
    is_loaded.then(|| Scenario { segments, markers_m: Vec::new(), ..scenario.clone() })
}

/// Length \[m\] from which a robot of this design collapses under the loads of the scenario (`gravity`, `tip_load`) at
/// these pressures: all stretches grow alike, with as many more units. `None`: not up to 50 times its length, or it carries
/// no load.
///
/// A straight robot across gravity folds at its base when w L²/2 + F L = πp_bR³; a steered one has a shorter lever.
pub fn collapse_length_m(scenario: &Scenario, loads: &Loads) -> Option<f64> {
    let fine = loaded(scenario)?;
    let factor = first_collapse(loads, |factor| Model::stretched(&fine, factor))?;
    Some(factor * scenario.length_m)
}

/// Factor of the loads of the scenario at which the robot collapses at these pressures, as they are and reversed. `None`: not up to
/// 50 times, or it carries no load.
///
/// A straight robot folds at its base when the factor times (w L²/2 + F L) is πp_bR³, to both sides alike; a steered one folds
/// at p_b A (D − ȳ) against the bend.
pub fn collapse_loads(scenario: &Scenario, loads: &Loads) -> [Option<f64>; 2] {
    let Some(fine) = loaded(scenario) else { return [None; 2] };
    [1.0, -1.0].map(|sign| {
        first_collapse(loads, |factor| {
            let mut scaled = fine.clone();
            let carried = scaled.effects.iter_mut().filter(|effect| LOADS.contains(&effect.name.as_str()));
            carried.for_each(|effect| effect.values.iter_mut().for_each(|value| *value *= sign * factor));
            Model::for_few(&scaled)
        })
    })
}

/// Effects that are dead loads, in proportion to their values.
pub const LOADS: [&str; 2] = ["gravity", "tip_load"];
