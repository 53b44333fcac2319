//! Markers that a camera lost for a whole hold.
//!
//! A cell (hold, marker) that at least two thirds of the runs saw is kept, and what the others lost is put in its place: the mean of
//! the runs that saw it, moved as the run is,
//!
//! ```text
//! y_r = ȳ + U c_r R/(R − 1),    U = [ȳ − ȳ(first hold), δx, δy, δφ·(−y, x)]
//! ```
//!
//! with c_r fitted to the deviations of the run where it was seen: a mean over runs of other composition would look like a misfit
//! of the model there. Of z, U has the bend and a shift. A cell that fewer runs saw is left out of everything.
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | ȳ | mean over the runs that saw the cell | m |
//! | c_r | bend, shift and rotation of run r against the mean | -, m, m, rad |
//! | R | runs | |
//!
//! Validity: losses that do not depend on the noise (a marker that leaves the picture at a certain bend, a hand in front of it).
//! The variance of a filled mean is R/(R − lost) of the others', which is not accounted for.

use crate::dataset::{Dataset, Lost};

/// Part of a column that must be new to separate it from the columns before it.
const SMALLEST_NEW_PART: f64 = 1e-3;

/// Fewest runs that must see a cell.
fn needed(runs: usize) -> usize {
    (2 * runs).div_ceil(3)
}

impl Dataset {
    /// The same as a camera sees it that lost these markers: cells (run, hold, marker), each for the whole hold.
    ///
    /// ```
    /// let (set, _) = data::load("synthetic-epam", &mut |_, _| {}).unwrap();
    /// let lost = set.losing(&[[0, 3, 5]]);
    /// assert_eq!((lost.lost.filled.len(), lost.lost.unseen.len()), (1, 0));
    /// ```
    pub fn losing(mut self, cells: &[[usize; 3]]) -> Dataset {
        let mut sorted = cells.to_vec();
        sorted.sort_unstable();
        sorted.dedup();
        fill(&mut self, &sorted);
        self
    }
}

/// Fills the cells (run, hold, marker), in order, that were lost, and lists which are filled and which left out.
pub(crate) fn fill(dataset: &mut Dataset, cells: &[[usize; 3]]) {
    let runs = dataset.runs.len();
    let seen_by = |hold: usize, marker: usize| seen(runs, cells, hold, marker).count();
    let mut lost = Lost::default();
    for hold in 0..dataset.holds.len() {
        let is_unseen = |marker: &usize| seen_by(hold, *marker) < needed(runs);
        lost.unseen.extend((0..dataset.markers.len()).filter(is_unseen).map(|marker| [hold, marker]));
    }
    let is_kept = |[_, hold, marker]: &&[usize; 3]| !lost.unseen.contains(&[*hold, *marker]);
    lost.filled = cells.iter().filter(is_kept).copied().collect();
    dataset.lost = lost;
    dataset.coordinates_m = filled(dataset, cells);
}

/// Runs that saw a marker in a hold.
fn seen(runs: usize, cells: &[[usize; 3]], hold: usize, marker: usize) -> impl Iterator<Item = usize> + '_ {
    (0..runs).filter(move |run| cells.binary_search(&[*run, hold, marker]).is_err())
}

/// Indices of a cell in run layout, all samples.
fn of_cell(dataset: &Dataset, hold: usize, marker: usize) -> Vec<usize> {
    let first = |sample: usize| dataset.offset(hold, sample, marker);
    (0..dataset.samples_per_hold).flat_map(|sample| first(sample)..first(sample) + dataset.axes).collect()
}

/// The coordinates with cells that were lost filled in.
fn filled(dataset: &Dataset, cells: &[[usize; 3]]) -> Vec<f64> {
    let mean = mean_of_seen(dataset, cells);
    let made = made(dataset, &mean, cells);
    let (n, mut all) = (mean.len(), dataset.coordinates_m.clone());
    for [run, hold, marker] in &dataset.lost.filled {
        for i in of_cell(dataset, *hold, *marker) {
            all[run * n + i] = made[*run][i];
        }
    }
    for [hold, marker] in &dataset.lost.unseen {
        for i in of_cell(dataset, *hold, *marker) {
            (0..dataset.runs.len()).for_each(|run| all[run * n + i] = mean[i]);
        }
    }
    all
}

/// Mean over the runs that saw each value; where none did, the marker's mean in the nearest hold by pressure that one saw, or zero.
fn mean_of_seen(dataset: &Dataset, cells: &[[usize; 3]]) -> Vec<f64> {
    let mut mean = vec![0.0; dataset.values_per_run()];
    let holds = &dataset.holds;
    for marker in 0..dataset.markers.len() {
        let seen = |hold: usize| seen(dataset.runs.len(), cells, hold, marker);
        for (hold, own) in holds.iter().enumerate() {
            // The hold itself, if a run saw the marker there.
            let gap = |h: &usize| if *h == hold { -1.0 } else { (holds[*h].p_act_pa - own.p_act_pa).abs() };
            let known = (0..holds.len()).filter(|h| seen(*h).next().is_some());
            let Some(from) = known.min_by(|a, b| gap(a).total_cmp(&gap(b))) else { continue };
            let places = of_cell(dataset, from, marker).into_iter();
            for (to, at) in of_cell(dataset, hold, marker).into_iter().zip(places) {
                mean[to] = seen(from).map(|run| dataset.run(run)[at]).sum::<f64>() / seen(from).count() as f64;
            }
        }
    }
    mean
}

/// What each run would have seen, in run layout; empty for a run without losses.
fn made(dataset: &Dataset, mean: &[f64], cells: &[[usize; 3]]) -> Vec<Vec<f64>> {
    let columns = columns(dataset, mean);
    let runs = dataset.runs.len();
    let share = runs as f64 / (runs as f64 - 1.0);
    let of_run = |run: usize| {
        if dataset.lost.filled.iter().all(|cell| cell[0] != run) {
            return Vec::new();
        }
        let (of_marker, of_hold) = (dataset.axes, dataset.axes * dataset.markers.len() * dataset.samples_per_hold);
        let is_used = |i: &usize| {
            let (hold, marker) = (i / of_hold, i / of_marker % dataset.markers.len());
            cells.binary_search(&[run, hold, marker]).is_err() && dataset.is_seen(hold, marker)
        };
        let used: Vec<usize> = (0..mean.len()).filter(is_used).collect();
        let deviation = used.iter().map(|i| dataset.run(run)[*i] - mean[*i]).collect();
        let here = |column: &Vec<f64>| used.iter().map(|i| column[*i]).collect();
        let found = least_squares(&columns.iter().map(here).collect::<Vec<_>>(), deviation);
        let moved = |i: usize| columns.iter().zip(&found).map(|(c, f)| f * c[i]).sum::<f64>();
        (0..mean.len()).map(|i| mean[i] + share * moved(i)).collect()
    };
    (0..runs).map(of_run).collect()
}

/// What a run may differ by: more or less bend, shifts, and rotations about the base.
fn columns(dataset: &Dataset, mean: &[f64]) -> Vec<Vec<f64>> {
    let (axes, markers) = (dataset.axes, dataset.markers.len());
    let first = |marker: usize| {
        let hold = (0..dataset.holds.len()).find(|hold| dataset.is_seen(*hold, marker)).unwrap_or(0);
        dataset.offset(hold, 0, marker)
    };
    let column = |value: &dyn Fn(usize, usize) -> f64| (0..mean.len()).map(|i| value(i, i % axes)).collect();
    let mut columns: Vec<Vec<f64>> = vec![column(&|i, axis| mean[i] - mean[first(i / axes % markers) + axis])];
    columns.extend((0..axes).map(|own| column(&|_, axis| f64::from(u8::from(axis == own)))));
    for [from, to] in [[0, 1], [0, 2], [1, 2]].into_iter().filter(|plane| plane[1] < axes) {
        columns.push(column(&|i, axis| match axis {
            axis if axis == from => -mean[i - from + to],
            axis if axis == to => mean[i - to + from],
            _ => 0.0,
        }));
    }
    columns
}

/// Coefficients of the columns that can be separated, zero of the others (Gram–Schmidt, shifts first).
fn least_squares(columns: &[Vec<f64>], mut rest: Vec<f64>) -> Vec<f64> {
    let mut basis: Vec<(Vec<f64>, Vec<f64>)> = Vec::new();
    let mut found = vec![0.0; columns.len()];
    for j in (1..columns.len()).chain([0]) {
        let (mut new, mut inverse) = (columns[j].clone(), vec![0.0; columns.len()]);
        inverse[j] = 1.0;
        for _ in 0..2 {
            for (known, t) in &basis {
                let along = dot(known, &new);
                add(&mut new, known, -along);
                add(&mut inverse, t, -along);
            }
        }
        let length = dot(&new, &new).sqrt();
        if length > SMALLEST_NEW_PART * dot(&columns[j], &columns[j]).sqrt() {
            new.iter_mut().chain(&mut inverse).for_each(|v| *v /= length);
            let along = dot(&new, &rest);
            add(&mut rest, &new, -along);
            add(&mut found, &inverse, along);
            basis.push((new, inverse));
        }
    }
    found
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn add(to: &mut [f64], what: &[f64], times: f64) {
    to.iter_mut().zip(what).for_each(|(to, w)| *to += times * w);
}

const MOST_NAMED: usize = 4;

/// What reading assumed and what was lost, in words; nothing if nothing was.
pub fn losses(dataset: &Dataset) -> Vec<String> {
    let Lost { unseen, filled, frames } = &dataset.lost;
    let name = &dataset.name;
    let place = |hold: usize, marker: usize| {
        let (marker, hold) = (&dataset.markers[marker].name, &dataset.holds[hold]);
        format!("marker {marker} at {:.1} kPa ({})", hold.p_act_pa / 1e3, hold.phase.word())
    };
    let list = |places: Vec<String>| match places.len().checked_sub(MOST_NAMED) {
        Some(more) if more > 0 => format!("{}, and {more} more", places[..MOST_NAMED].join(", ")),
        _ => places.join(", "),
    };
    let mut words: Vec<String> = dataset.told.iter().map(|note| format!("{name}: {note}")).collect();
    if *frames > 0 {
        words.push(format!("{name}: {frames} rows have no position and were passed over"));
    }
    if !filled.is_empty() {
        let one = |[run, hold, marker]: &[usize; 3]| format!("run {}, {}", dataset.runs[*run], place(*hold, *marker));
        let places = list(filled.iter().map(one).collect());
        let what = match filled.len() {
            1 => "a marker was".into(),
            count => format!("{count} times a marker was"),
        };
        let how = "lost in single runs for a whole hold, and put there as the other runs saw it, moved as the run is";
        words.push(format!("{name}: {what} {how}: {places}"));
    }
    if !unseen.is_empty() {
        let places = list(unseen.iter().map(|[hold, marker]| place(*hold, *marker)).collect());
        words.push(format!("{name}: seen by fewer than two thirds of the runs and left out: {places}"));
    }
    words
}
