//! One dataset as the missing moment sees it, and the pieces of the body that may bend each in its own way.

use crate::fit::numbers::mean;
use crate::fit::whiten::Whitener;
use data::{Dataset, Direct};
use models::{Loads, Model, Scenario, Step};

/// Measurements under one set of loads.
#[derive(Clone, Copy)]
pub struct View<'a> {
    /// The robot with the data's markers and loads.
    pub scenario: &'a Scenario,
    pub dataset: &'a Dataset,
    pub direct: Direct,
    /// Mean over runs \[m\], in run layout.
    pub target_m: &'a [f64],
    pub whitener: &'a Whitener,
}

/// A stretch of the body with one bend.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Place {
    /// Start along the taut generator \[m\].
    pub from_m: f64,
    pub to_m: f64,
    /// Whether any actuator is in it.
    pub is_active: bool,
}

impl Place {
    pub fn length_m(&self) -> f64 {
        self.to_m - self.from_m
    }

    /// Where it begins and ends \[mm\].
    pub(crate) fn ends_mm(&self) -> [f64; 2] {
        [1e3 * self.from_m, 1e3 * self.to_m]
    }
}

/// Samples of one hold that are taken together.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HoldMoment {
    pub hold: usize,
    /// Which of the hold's groups, in time.
    pub group: usize,
    pub t_s: f64,
}

/// Parts of the data with a separate bend each.
#[derive(Debug, Clone, PartialEq)]
pub struct Division {
    pub places: Vec<Place>,
    /// Groups of samples in each hold.
    pub groups: usize,
    /// Groups of samples, hold after hold.
    pub moments: Vec<HoldMoment>,
}

/// Groups of samples in a hold; more show no more of a creep.
const MOST_GROUPS: usize = 6;
/// Most free numbers that a shape may have.
const MOST_NUMBERS: usize = 160;
/// A place is as long as it takes for its bend to be known to this share of the largest one.
const KNOWN_TO: f64 = 0.1;
/// Error of the bend of a stretch of length L from the positions of its ends: this times σ/L².
const BEND_ERROR: f64 = 2.45;

impl Division {
    /// Of a dataset, whose largest bend is about `bend_per_m`.
    pub fn of(view: &View, bend_per_m: f64) -> Division {
        let (samples, holds) = (view.dataset.samples_per_hold, &view.dataset.holds);
        let sigma_m = view.whitener.unit_m() / (samples as f64).sqrt();
        let least_m = (BEND_ERROR * sigma_m / (KNOWN_TO * bend_per_m.max(1e-3))).sqrt();
        let mut cuts = cuts(view, least_m);
        let mut groups = MOST_GROUPS.min(samples);
        if holds.len() * (cuts.len() + groups) > MOST_NUMBERS {
            groups = 1;
        }
        while !cuts.is_empty() && holds.len() * (cuts.len() + groups) > MOST_NUMBERS {
            cuts.pop();
        }
        Division::new(view, &cuts, groups)
    }

    pub fn uniform(view: &View) -> Division {
        Division::new(view, &[], 1)
    }

    fn new(view: &View, cuts: &[f64], groups: usize) -> Division {
        let model = Model::in_pieces(view.scenario, cuts);
        let ends: Vec<f64> = [0.0].iter().chain(cuts).chain([&view.scenario.length_m]).copied().collect();
        let place = |ends: &[f64]| {
            let inside = |i: &usize| (ends[0]..ends[1]).contains(&model.segments()[*i].middle_m());
            let is_active = (0..model.segments().len()).filter(inside).any(|i| model.is_active(i));
            Place { from_m: ends[0], to_m: ends[1], is_active }
        };
        let samples = view.dataset.samples_per_hold;
        let moment = |hold: usize, group: usize| {
            let own = (0..samples).filter(|t| t * groups / samples == group);
            HoldMoment { hold, group, t_s: mean(own.map(|t| view.dataset.holds[hold].t_s[t])) }
        };
        Division {
            places: ends.windows(2).map(place).collect(),
            groups,
            moments: (0..view.dataset.holds.len()).flat_map(|h| (0..groups).map(move |g| moment(h, g))).collect(),
        }
    }

    pub fn cuts(&self) -> Vec<f64> {
        self.places.iter().skip(1).map(|place| place.from_m).collect()
    }

    pub fn group(&self, sample: usize, samples: usize) -> usize {
        sample * self.groups / samples
    }

    /// The protocol, one step per group of samples.
    pub fn steps(&self, dataset: &Dataset) -> Vec<Step> {
        let step = |m: &HoldMoment| {
            let hold = &dataset.holds[m.hold];
            Step { t_s: m.t_s, loads: Loads::uniform(hold.p_body_pa, hold.p_act_pa) }
        };
        self.moments.iter().map(step).collect()
    }
}

/// Markers between which the bends are separate: seen in every hold, and far enough from each other.
fn cuts(view: &View, least_m: f64) -> Vec<f64> {
    let (stations, dataset) = (&view.scenario.markers_m, view.dataset);
    let seen = |marker: usize| (0..dataset.holds.len()).all(|hold| dataset.is_seen(hold, marker));
    let last_m = stations.iter().copied().fold(0.0, f64::max);
    let (mut cuts, mut from_m) = (Vec::new(), 0.0);
    for (marker, s) in stations.iter().enumerate() {
        if s - from_m >= least_m && last_m - s >= least_m && seen(marker) {
            cuts.push(*s);
            from_m = *s;
        }
    }
    cuts
}

/// A model with the pieces of a division, and which place each of them belongs to.
pub(super) struct Pieces {
    pub model: Model,
    place_of: Vec<Option<usize>>,
}

impl Pieces {
    pub(super) fn new(scenario: &Scenario, division: &Division) -> Pieces {
        let model = Model::in_pieces(scenario, &division.cuts());
        let place_of = (0..model.segments().len()).map(|i| place_of(&model, i, &division.places)).collect();
        Pieces { model, place_of }
    }

    /// Curvature of every piece \[1/m\] from the curvatures of the places; a passive piece next to actuators stays straight.
    pub(super) fn curvatures(&self, bends: &[f64]) -> Vec<f64> {
        self.place_of.iter().map(|place| place.map_or(0.0, |place| bends[place])).collect()
    }

    /// Mean of a value of the pieces over each place's length.
    pub(super) fn mean(&self, of_pieces: &[f64], places: usize) -> Vec<f64> {
        let mut sums = vec![[0.0; 2]; places];
        for ((segment, place), value) in self.model.segments().iter().zip(&self.place_of).zip(of_pieces) {
            if let Some(place) = place {
                sums[*place][0] += segment.length_m * value;
                sums[*place][1] += segment.length_m;
            }
        }
        sums.iter().map(|[sum, length]| sum / length).collect()
    }
}

fn place_of(model: &Model, segment: usize, places: &[Place]) -> Option<usize> {
    let middle = model.segments()[segment].middle_m();
    let place = places.iter().position(|place| (place.from_m..place.to_m).contains(&middle))?;
    (model.is_active(segment) || !places[place].is_active).then_some(place)
}
