//! A recording as the checks see it: every frame of every run in the robot's frame, and the holds in it.

use crate::dataset::Dataset;
use crate::import::{PressedRun, median, plateaus};
use crate::policy::{tolerance_act_pa, tolerance_body_pa};

/// What contradicts what, and what to type.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Doubt {
    pub message: String,
    pub help: String,
}

impl Doubt {
    pub(super) fn new(message: String, help: &str) -> Doubt {
        Doubt { message, help: help.to_string() }
    }
}

pub(crate) struct LogSeen {
    pub file: String,
    pub times_s: Vec<f64>,
    pub act_pa: Vec<f64>,
}

#[derive(Debug, Clone)]
pub(super) struct Level {
    pub frames: Vec<usize>,
    /// Mean body and actuator pressure \[Pa\].
    pub pressures_pa: [f64; 2],
    /// Median place of every marker \[m\]; `None` where it was not seen.
    pub places_m: Vec<Option<[f64; 3]>>,
}

impl Level {
    /// Whether both pressures equal the pressures of another hold.
    pub(super) fn is_like(&self, other: &Level) -> bool {
        let [[body, act], [b, a]] = [self.pressures_pa, other.pressures_pa];
        (body - b).abs() <= tolerance_body_pa(body) && (act - a).abs() <= tolerance_act_pa(act)
    }
}

pub(super) struct SeenRun {
    pub label: String,
    pub times_s: Vec<f64>,
    /// Body and actuator pressure of every frame \[Pa\].
    pub pressures_pa: [Vec<f64>; 2],
    /// `[marker][frame]` \[m\]; NaN where not seen.
    pub places_m: Vec<Vec<[f64; 3]>>,
    pub levels: Vec<Level>,
}

impl SeenRun {
    /// The first hold at the lowest pressure.
    pub(super) fn rest(&self) -> Option<&Level> {
        self.levels.iter().min_by(|a, b| a.pressures_pa[1].total_cmp(&b.pressures_pa[1]))
    }

    /// Places of all markers at rest; `None` if one was not seen.
    pub(super) fn at_rest(&self) -> Option<Vec<[f64; 3]>> {
        self.rest()?.places_m.iter().copied().collect()
    }
}

pub(crate) struct Seen {
    pub(super) runs: Vec<SeenRun>,
    /// Labels, and stations that somebody measured \[m\].
    pub(super) markers: Vec<(String, Option<f64>)>,
    pub(super) logs: Vec<LogSeen>,
}

impl Seen {
    /// The frames of an import, before any is left out.
    pub(crate) fn of_import(
        runs: &[PressedRun],
        markers: Vec<(String, Option<f64>)>,
        options: &crate::import::ImportOptions,
        logs: Vec<LogSeen>,
    ) -> Seen {
        let run = |run: &PressedRun| {
            let places = |column: &Vec<[f64; 2]>| column.iter().map(|[x, y]| [*x, *y, 0.0]).collect();
            let holds = plateaus(run, options).into_iter().map(|hold| hold.frames).collect();
            let places_m = run.xy_m.iter().map(places).collect();
            seen_run(run.label.clone(), run.times_s.clone(), run.pressures_pa.clone(), places_m, holds)
        };
        Seen { runs: runs.iter().map(run).collect(), markers, logs }
    }

    pub(crate) fn of_dataset(set: &Dataset) -> Seen {
        let samples = set.samples_per_hold;
        let cells = || (0..set.holds.len()).flat_map(|hold| (0..samples).map(move |sample| (hold, sample)));
        let of_hold = |of: &dyn Fn(usize) -> f64| cells().map(|(hold, _)| of(hold)).collect::<Vec<f64>>();
        let run = |run: usize| {
            let place = |(hold, sample), marker| {
                let place = set.place(run, hold, sample, marker);
                let lost = set.is_lost(run, hold, marker);
                let at = |axis: usize| place.get(axis).copied().unwrap_or(0.0);
                if lost { [f64::NAN; 3] } else { [at(0), at(1), at(2)] }
            };
            let column = |marker| cells().map(|cell| place(cell, marker)).collect();
            let pressures = [of_hold(&|hold| set.holds[hold].p_body_pa), of_hold(&|hold| set.holds[hold].sum_act_pa())];
            let times_s = cells().map(|(hold, sample)| set.holds[hold].t_s[sample]).collect();
            let holds = (0..set.holds.len()).map(|hold| (hold * samples..(hold + 1) * samples).collect()).collect();
            let places_m = (0..set.markers.len()).map(column).collect();
            seen_run(set.runs[run].clone(), times_s, pressures, places_m, holds)
        };
        let markers = set.markers.iter().map(|marker| (marker.name.clone(), marker.station_m)).collect();
        Seen { runs: (0..set.runs.len()).map(run).collect(), markers, logs: Vec::new() }
    }

    /// Distance of the farthest marker from the base at rest, the median over runs \[m\].
    pub(super) fn length_m(&self) -> f64 {
        let farthest = |run: &SeenRun| {
            let places = run.rest()?.places_m.iter().flatten().map(|place| size(*place));
            Some(places.fold(0.0, f64::max))
        };
        median(self.runs.iter().filter_map(farthest).collect()).unwrap_or(0.0)
    }

    /// Whether all runs have the same holds.
    pub(super) fn same_holds(&self) -> bool {
        let first = &self.runs[0].levels;
        self.runs
            .iter()
            .all(|run| run.levels.len() == first.len() && run.levels.iter().zip(first).all(|(a, b)| a.is_like(b)))
    }

    /// Whether markers are at distances from the base that separate a bend from a shift.
    pub(super) fn separates_shifts(&self) -> bool {
        let Some(places) = self.runs.iter().find_map(SeenRun::at_rest) else { return false };
        let away = || places.iter().map(|place| size(*place));
        away().fold(f64::INFINITY, f64::min) < 0.7 * away().fold(0.0, f64::max)
    }
}

fn seen_run(
    label: String,
    times_s: Vec<f64>,
    pressures_pa: [Vec<f64>; 2],
    places_m: Vec<Vec<[f64; 3]>>,
    holds: Vec<Vec<usize>>,
) -> SeenRun {
    let level = |frames: Vec<usize>| {
        let mean = |values: &[f64]| frames.iter().map(|k| values[*k]).sum::<f64>() / frames.len().max(1) as f64;
        let means_pa = [mean(&pressures_pa[0]), mean(&pressures_pa[1])];
        // The robot may be on its way at the beginning.
        let late = &frames[frames.len() / 2..];
        let places_m = places_m.iter().map(|column| middle(late.iter().map(|k| column[*k]))).collect();
        Level { frames, pressures_pa: means_pa, places_m }
    };
    let levels = holds.into_iter().map(level).collect();
    SeenRun { label, times_s, pressures_pa, places_m, levels }
}

pub(super) fn middle(places: impl Iterator<Item = [f64; 3]>) -> Option<[f64; 3]> {
    let seen: Vec<[f64; 3]> = places.filter(|place| place[0].is_finite()).collect();
    let over = |axis: usize| median(seen.iter().map(|place| place[axis]).collect());
    Some([over(0)?, over(1)?, over(2)?])
}

pub(super) fn minus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

pub(super) fn size(vector: [f64; 3]) -> f64 {
    vector.iter().map(|v| v * v).sum::<f64>().sqrt()
}

/// The mean of vectors; zero of none.
pub(super) fn mean(vectors: &[[f64; 3]]) -> [f64; 3] {
    let over = |axis: usize| vectors.iter().map(|v| v[axis]).sum::<f64>() / vectors.len().max(1) as f64;
    [over(0), over(1), over(2)]
}

/// Part of a common shift that each marker may be off it.
const UNLIKE: f64 = 0.3;

/// The shift that all markers have in common, if it is larger than `least_m`.
pub(super) fn common_shift(steps: &[[f64; 3]], least_m: f64) -> Option<[f64; 3]> {
    let common = mean(steps);
    let alike = |step: &[f64; 3]| size(minus(*step, common)) <= UNLIKE * size(common);
    (steps.len() >= 2 && size(common) > least_m && steps.iter().all(alike)).then_some(common)
}
