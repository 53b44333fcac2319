//! The data as every comparison and every fit see them: copies of runs left out, stray samples replaced, sessions named.

use crate::directions::DirectionFit;
use crate::fit::numbers::{differences, groups};
use crate::noise::NoiseModel;
use crate::policy;
use crate::stats::f_tail;
use data::{About, Dataset};
use serde::Serialize;

pub(crate) struct Prepared {
    pub dataset: Dataset,
    /// Session of every run; empty if there is one.
    pub sessions: Vec<usize>,
    /// What was found on the way; outlying runs come later.
    pub outliers: Outliers,
    pub warnings: Vec<String>,
}

/// Leaves copies out and replaces stray samples by the mean of the other runs.
pub(crate) fn prepare(dataset: &Dataset, about: Option<&About>) -> Prepared {
    let report = data::check(dataset, about);
    let mut warnings = Vec::new();
    let copies = report.identical_runs;
    let mut clean = without_copies(dataset, &copies);
    for [first, second] in &copies {
        warnings.push(format!("run {second} is a copy of run {first} and was left out: copies are not repeats"));
    }
    let samples = report.outliers;
    let share = samples.len() as f64 / (dataset.coordinates_m.len() as f64 / dataset.axes as f64);
    let (count, percent, are) = (samples.len(), 100.0 * share, "are far from the other runs");
    if count > 0 && policy::are_strays(share, clean.runs.len()) {
        replace(&mut clean, &samples);
        let words = "replaced by the mean of the other runs there";
        warnings.push(format!("{count} samples ({percent:.1} %) {are}: {words}"));
    } else if count > 0 {
        let words = "too many to be strays, so they were kept and count as noise";
        warnings.push(format!("{percent:.1} % of the samples {are}: {words}"));
    }
    let sessions = sessions(&clean, about, &mut warnings);
    Prepared { dataset: clean, sessions, outliers: Outliers { samples, share, runs: Vec::new(), copies }, warnings }
}

/// Runs whose scatter about the mean, beyond pressure, alignment and rotation, exceeds the scatter of the others.
pub(crate) fn outlying_runs(dataset: &Dataset, noise: &NoiseModel) -> Vec<OutlyingRun> {
    let runs = dataset.runs.len();
    if !noise.gives_p_values() {
        return Vec::new();
    }
    let fit = DirectionFit::new(&noise.directions);
    let mean = dataset.mean_over_runs();
    let rest = |run: usize| fit.solve(&differences(dataset.run(run), &mean)).1;
    let squares: Vec<f64> = (0..runs).map(|run| rest(run).iter().map(|r| r * r).sum()).collect();
    let total: f64 = squares.iter().sum();
    let dof = noise.seen(0..mean.len()) - fit.count();
    let outlying = |(run, s): (usize, &f64)| {
        let ratio = s * (runs - 1) as f64 / (total - s);
        let p = (runs as f64 * f_tail(ratio, dof, (runs - 1) * dof)).min(1.0);
        let found = OutlyingRun { run: dataset.runs[run].clone(), scatter_ratio: ratio, p_corrected: p };
        policy::run_stands_out(p, ratio).then_some(found)
    };
    squares.iter().enumerate().filter_map(outlying).collect()
}

fn without_copies(dataset: &Dataset, copies: &[[String; 2]]) -> Dataset {
    let is_copy = |run: &String| copies.iter().any(|[_, second]| second == run);
    let kept: Vec<usize> = (0..dataset.runs.len()).filter(|r| !is_copy(&dataset.runs[*r])).collect();
    Dataset {
        runs: kept.iter().map(|r| dataset.runs[*r].clone()).collect(),
        coordinates_m: kept.iter().flat_map(|r| dataset.run(*r)).copied().collect(),
        ..dataset.clone()
    }
}

fn replace(dataset: &mut Dataset, strays: &[data::check::Outlier]) {
    let n = dataset.values_per_run();
    let place = |o: &data::check::Outlier, data: &Dataset| {
        let run = data.runs.iter().position(|r| *r == o.run)?;
        let marker = data.markers.iter().position(|m| m.name == o.marker)?;
        Some((run, data.offset(o.hold, o.sample, marker)))
    };
    let places: Vec<(usize, usize)> = strays.iter().filter_map(|o| place(o, dataset)).collect();
    for &(run, at) in &places {
        let good = |r: &usize| !places.contains(&(*r, at));
        let others: Vec<usize> = (0..dataset.runs.len()).filter(good).collect();
        if others.is_empty() {
            continue;
        }
        for axis in 0..dataset.axes {
            let sum: f64 = others.iter().map(|r| dataset.coordinates_m[r * n + at + axis]).sum();
            dataset.coordinates_m[run * n + at + axis] = sum / others.len() as f64;
        }
    }
}

/// Session labels of `about.toml` as numbers; none if they name one session only, or nothing repeats in any.
fn sessions(dataset: &Dataset, about: Option<&About>, warnings: &mut Vec<String>) -> Vec<usize> {
    let Some(about) = about else { return Vec::new() };
    let label = |run: &String| about.runs.iter().find(|a| a.id == *run).and_then(|a| a.session.clone());
    let labels: Vec<Option<String>> = dataset.runs.iter().map(label).collect();
    let names = groups(&labels, |a, b| a == b);
    match names.len() {
        0 | 1 => Vec::new(),
        n if n == labels.len() => {
            let single = "every session of about.toml has a single run, so nothing repeats within one";
            warnings.push(format!("{single}: taken as one session"));
            Vec::new()
        }
        _ => (0..labels.len()).filter_map(|run| names.iter().position(|own| own.contains(&run))).collect(),
    }
}

/// Samples and runs that stand out from the others.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct Outliers {
    /// Samples far from the median over runs; they were replaced by the mean of the other runs.
    pub samples: Vec<data::check::Outlier>,
    /// Replaced samples as a share of all samples.
    pub share: f64,
    /// Runs whose shape differs from the others, beyond pressure, alignment and rotation.
    pub runs: Vec<OutlyingRun>,
    /// Pairs of runs that are copies; the second was left out.
    pub copies: Vec<[String; 2]>,
}

/// A run that differs from the others.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct OutlyingRun {
    /// Label of the run as in the data.
    pub run: String,
    /// Its scatter over the scatter of the other runs.
    pub scatter_ratio: f64,
    /// p of the ratio, corrected for the number of runs.
    pub p_corrected: f64,
}

impl OutlyingRun {
    /// A sentence that names the run and its excess scatter.
    pub fn words(&self) -> String {
        let (run, times) = (&self.run, self.scatter_ratio);
        format!("run {run} scatters {times:.1} times as much as the others: look at it before believing anything")
    }
}
