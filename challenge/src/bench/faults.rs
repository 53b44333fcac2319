//! Instruments that read wrongly and places that bend otherwise: twelve kinds on each robot, by laws of this file and of `effects`,
//! with nothing else hidden. The protocol goes up and down again.

use super::outcome::{Diagnoser, about};
use super::row::{Goal, Rate};
use crate::truth::ROBOTS;
use crate::{Draw, Truth};
use compare::Evidence;
use compare::diagnosis::{Options, Verdict};
use compare::error::CompareError;
use data::{Dataset, Hold};
use serde::{Deserialize, Serialize};
use std::f64::consts::PI;

/// Set pressures of the actuator \[Pa\], on a body of 2 kPa.
const PROTOCOL_PA: [f64; 7] = [0.0, 10e3, 20e3, 30e3, 20e3, 10e3, 0.0];
const BODY_PA: f64 = 2e3;

/// How a fault gets into the data of a set.
enum HiddenFault {
    /// Of the robot: an effect of the generator.
    Robot,
    /// The camera's picture of a point \[m\] in a hold.
    Camera(fn([f64; 2], usize) -> [f64; 2]),
    /// The pressures \[Pa\] of body and actuator that are there in a hold.
    Pressures(fn(usize) -> [f64; 2]),
    /// Frames show the robot so much later \[s\].
    Late(f64),
}

/// The kinds, by the name of the catalogue's effect.
const KINDS: [(&str, HiddenFault); 12] = [
    ("weak_place", HiddenFault::Robot),
    ("tapered_wall", HiddenFault::Robot),
    ("tip_spring", HiddenFault::Robot),
    ("camera_lens", HiddenFault::Robot),
    ("camera_tilt", HiddenFault::Camera(|p, _| tilted(p))),
    ("camera_moved", HiddenFault::Camera(|p, hold| if hold >= 3 { knocked(p) } else { p })),
    ("clock_lag", HiddenFault::Late(3.0)),
    (
        "gauge_drift",
        HiddenFault::Pressures(|hold| [BODY_PA, when_filled(hold, -1.5e3 * (1.0 - (-(hold as f64) / 4.0).exp()))]),
    ),
    (
        "gauge_curve",
        HiddenFault::Pressures(|hold| [BODY_PA, when_filled(hold, 0.7e3 * (PI * PROTOCOL_PA[hold] / 30e3).sin())]),
    ),
    (
        "regulator_hysteresis",
        HiddenFault::Pressures(|hold| [BODY_PA, when_filled(hold, if hold > 3 { 1.2e3 } else { 0.0 })]),
    ),
    ("body_leak", HiddenFault::Pressures(|hold| [BODY_PA / (1.0 + 0.08 * hold as f64), PROTOCOL_PA[hold]])),
    (
        "sealed_body",
        HiddenFault::Pressures(|hold| [BODY_PA + 1e3 * (PROTOCOL_PA[hold] / 30e3).powf(0.8), PROTOCOL_PA[hold]]),
    ),
];

/// Sets of a round: every kind on every robot.
const SETS: usize = KINDS.len() * ROBOTS.len();
/// First of their streams of random numbers; other parts have smaller ones.
const STREAM: u64 = 102 << 32;

/// A pressure that is off where the actuator is filled.
fn when_filled(hold: usize, off_pa: f64) -> f64 {
    if PROTOCOL_PA[hold] > 0.0 { PROTOCOL_PA[hold] + off_pa } else { 0.0 }
}

/// A pinhole camera 0.9 m away, turned by 7° along the robot and 4° across it: rotation matrices, then projection.
fn tilted([x, y]: [f64; 2]) -> [f64; 2] {
    let [(sa, ca), (sb, cb)] = [7.0_f64, 4.0].map(|deg| deg.to_radians().sin_cos());
    let [turned, deep] = [ca * x, sa * x];
    let [up, depth] = [cb * y - sb * deep, sb * y + cb * deep];
    [turned, up].map(|v| v * 0.9 / (0.9 + depth))
}

/// The tripod was touched: 4 mm to the side, 2 mm up, turned by 0.6° about a point in the picture.
fn knocked([x, y]: [f64; 2]) -> [f64; 2] {
    let (sin, cos) = 0.6_f64.to_radians().sin_cos();
    let [dx, dy] = [x - 0.12, y - 0.05];
    [0.124 + dx * cos - dy * sin, 0.052 + dx * sin + dy * cos]
}

/// A set with one fault, and the diagnosis of it.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct FaultSet {
    /// The catalogue's name of the fault.
    pub fault: String,
    /// Robot, noise and runs without the fault.
    pub truth: Truth,
    /// Verdict; `None` if the data do not allow one.
    pub verdict: Option<Verdict>,
    /// The stated set; a pair is written `a + b`.
    pub stated: Vec<String>,
}

impl FaultSet {
    /// Whether the stated set holds the truth; `None` without one.
    pub(super) fn holds(&self) -> Option<bool> {
        (self.verdict == Some(Verdict::Effect)).then(|| self.is_named())
    }

    fn is_named(&self) -> bool {
        self.stated.iter().any(|entry| entry.split(" + ").any(|part| part == self.fault))
    }
}

/// A bench of fewer sets of every kind has none of these.
const FEWEST: usize = 20;

/// Sets of a bench, a round for every hundred of its sets.
pub(super) fn count(sets: usize) -> usize {
    if sets < FEWEST { 0 } else { SETS * sets.div_ceil(100) }
}

pub(super) fn fault(seed: u64, index: usize, diagnose: Diagnoser) -> Result<FaultSet, CompareError> {
    let (name, kind) = &KINDS[index / ROBOTS.len() % KINDS.len()];
    let robot = ROBOTS[index % ROBOTS.len()].0;
    let mut truth = Truth::draw(robot, &mut Draw::new(seed, STREAM + index as u64))?;
    if matches!(kind, HiddenFault::Robot) {
        truth.add(name, 1.0);
    }
    let evidence = [Evidence::of(recorded(&truth, kind)?, Some(about(&truth)?))];
    let options = Options::default().without_advice();
    let found = diagnose(&truth.told()?, &evidence, &options, &mut |_, _| ())?;
    Ok(FaultSet { fault: (*name).into(), truth, verdict: found.verdict, stated: found.indistinguishable })
}

fn recorded(truth: &Truth, fault: &HiddenFault) -> Result<Dataset, CompareError> {
    let set: Vec<[f64; 2]> = PROTOCOL_PA.map(|p| [BODY_PA, p]).to_vec();
    let there = match fault {
        HiddenFault::Pressures(there) => (0..set.len()).map(there).collect(),
        _ => set.clone(),
    };
    let mut made = truth.dataset("fault", &there)?;
    let written = truth.dataset("fault", &set)?;
    let hold_values = made.values_per_run() / made.holds.len();
    match fault {
        HiddenFault::Camera(see) => {
            for (i, point) in made.coordinates_m.as_chunks_mut::<2>().0.iter_mut().enumerate() {
                *point = see(*point, 2 * i / hold_values % set.len());
            }
        }
        HiddenFault::Late(lag_s) => show_late(&mut made, *lag_s),
        HiddenFault::Robot | HiddenFault::Pressures(_) => {}
    }
    Ok(Dataset { holds: written.holds, ..made })
}

/// Samples within the lag of a new pressure show the hold before.
fn show_late(made: &mut Dataset, lag_s: f64) {
    let (sample, values) = (made.axes * made.markers.len(), made.values_per_run());
    let is_late = |pair: &[Hold], k: usize| pair[0].t_s.last().is_some_and(|end| pair[1].t_s[k] - lag_s < *end);
    let right = made.coordinates_m.clone();
    for run in 0..made.runs.len() {
        for h in 1..made.holds.len() {
            for k in (0..made.samples_per_hold).filter(|k| is_late(&made.holds[h - 1..=h], *k)) {
                let [to, from] = [h, h - 1].map(|h| run * values + (h * made.samples_per_hold + k) * sample);
                made.coordinates_m[to..to + sample].copy_from_slice(&right[from..from + sample]);
            }
        }
    }
}

pub(super) fn rows(sets: &[FaultSet]) -> Vec<Rate> {
    let is_physics = |part: &str| models::effects::by_name(part).is_none_or(|effect| !effect.group.is_nuisance());
    let all: Vec<&FaultSet> = sets.iter().collect();
    let is_place = |set: &&FaultSet| matches!(set.fault.as_str(), "weak_place" | "tapered_wall" | "tip_spring");
    let (places, instruments): (Vec<&FaultSet>, Vec<&FaultSet>) = all.iter().partition(|set| is_place(set));
    let is_alarm = |set: &FaultSet| set.verdict != Some(Verdict::None);
    let instead = |set: &FaultSet| {
        set.verdict == Some(Verdict::Effect)
            && !set.is_named()
            && set.stated.iter().all(|e| e.split(" + ").all(is_physics))
    };
    let of = |case, only_others, sets: &[&FaultSet]| {
        let share = |figure, goal, hit: &dyn Fn(&FaultSet) -> bool| {
            Rate::share(case, figure, goal, &sets.iter().map(|set| hit(set)).collect::<Vec<_>>())
        };
        [
            share("alarm", Goal::AtLeast(0.95), &is_alarm),
            share("named", Goal::AtLeast(0.7), &FaultSet::is_named),
            share(only_others, Goal::AtMost(0.1), &instead),
        ]
    };
    let instruments = of("an instrument reads wrongly", "only physics named instead", &instruments);
    [instruments, of("a place bends otherwise", "only others named instead", &places)].concat()
}
