//! Models held against one evidence in x, y and z, each supply channel at its own pressure.
//!
//! ```text
//! e = f − ȳ     mean square of e over samples, markers and axes = model error² + noise²,   noise² = mean of s²/R
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | f, ȳ | coordinate of the model, and measured, mean over runs | m |
//! | s, R | standard deviation of a coordinate over runs, number of runs | m, - |
//!
//! Validity: runs are independent, so sessions are not told apart. s²/R needs no model of the noise, and gives no p-value: errors that
//! the markers of a run share make the noise of one hold uncertain.

use super::comparison::{Contender, strays};
use super::generate::in_channels;
use super::predict::fit_in_space;
use crate::error::CompareError;
use crate::evidence::Evidence;
use crate::prepare::{Prepared, prepare};
use data::{About, Dataset, Hold};
use models::{Known, Loads, Model, Prediction, Scenario, Step};
use serde::Serialize;

/// Errors of a model over some values. Printed units.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SpaceErrors {
    /// Root-mean-square error of one coordinate over samples, markers and axes \[mm\].
    pub rmse_mm: f64,
    /// The same of x, y and z by themselves \[mm\].
    pub rmse_axes_mm: Vec<f64>,
    /// Root-mean-square distance of a marker from its prediction \[mm\].
    pub rms_distance_mm: f64,
    /// Mean of model minus measurement along x, y and z \[mm\].
    pub bias_mm: Vec<f64>,
    /// Root-mean-square noise of one coordinate of the mean \[mm\]; `None` where it is unknown.
    pub noise_floor_mm: Option<f64>,
    /// Error of one coordinate beyond noise \[mm\].
    pub systematic_mm: Option<f64>,
}

/// Errors of a hold.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SpaceHold {
    /// Pressure of every supply channel that the table has \[kPa\]; one is for all.
    pub p_act_channels_kpa: Vec<f64>,
    /// Body pressure \[kPa\].
    pub p_body_kpa: f64,
    /// `load`, `hold` or `unload`: whether the sum of the pressures rose.
    pub phase: &'static str,
    /// 0 for the first hold with these pressures and this phase, 1 for the second, …
    pub occurrence: usize,
    /// Errors over its markers.
    pub errors: SpaceErrors,
    /// Model minus measurement of the outermost marker seen, along x, y and z \[mm\].
    pub tip_error_mm: Vec<f64>,
    /// Length of that \[mm\].
    pub tip_distance_mm: f64,
}

/// A marker at a hold.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SpaceMarker {
    /// Index of the hold.
    pub hold: usize,
    /// Label.
    pub marker: String,
    /// Mean over samples and runs \[mm\].
    pub measured_mm: Vec<f64>,
    /// Standard deviation over runs of the means over samples \[mm\]; 0 of one run.
    pub scatter_mm: Vec<f64>,
    /// Of the model \[mm\].
    pub predicted_mm: Vec<f64>,
}

/// A model of an [`InSpace`].
#[derive(Debug, Clone)]
pub struct SpaceVariant {
    /// In words.
    pub label: String,
    /// How its values are known.
    pub known: Known,
    /// Where they come from.
    pub why: String,
    /// The model, fitted to stations of the data.
    pub scenario: Scenario,
    /// Hold by hold.
    pub holds: Vec<SpaceHold>,
    /// Over all holds.
    pub overall: SpaceErrors,
    /// Markers of all holds that were seen.
    pub markers: Vec<SpaceMarker>,
}

impl SpaceVariant {
    /// Error beyond noise \[mm\]; the root-mean-square error where the noise is unknown.
    pub fn error_mm(&self) -> f64 {
        self.overall.systematic_mm.unwrap_or(self.overall.rmse_mm)
    }

    /// The hold with the farthest tip.
    pub fn worst(&self) -> Option<&SpaceHold> {
        self.holds.iter().max_by(|a, b| a.tip_distance_mm.total_cmp(&b.tip_distance_mm))
    }
}

/// The data, and one or more models on them.
#[derive(Debug, Clone)]
pub struct InSpace {
    /// The data as they were compared.
    pub dataset: Dataset,
    /// Their description.
    pub about: Option<About>,
    /// Coordinates compared: 2 where the table has no z.
    pub axes: usize,
    /// Largest distance of a measured marker from the straight body \[mm\].
    pub d_max_mm: f64,
    /// Models, the one given first.
    pub variants: Vec<SpaceVariant>,
    /// What does not match between scenario and data.
    pub warnings: Vec<String>,
}

/// Pressures of a hold: one actuator pressure is for all channels.
pub fn loads(hold: &Hold) -> Loads {
    in_channels(hold.p_body_pa, hold.channels_pa())
}

/// Holds models against measurements in space; `sigma_m` is the noise of one coordinate, used for a single run.
///
/// # Errors
/// What does not match or does not balance; channels that the table or the robot has not; no model at all.
pub fn compare_in_space(
    models: &[Contender],
    evidence: &Evidence,
    sigma_m: Option<f64>,
) -> Result<InSpace, CompareError> {
    let Evidence { dataset: read, about, .. } = evidence;
    let Prepared { dataset, outliers, sessions, warnings: told_of_data } = prepare(read, about.as_ref());
    let axes = 2 + usize::from(dataset.z_m.is_some());
    let (mut variants, mut warnings) = (Vec::new(), Vec::new());
    for model in models {
        let (scenario, told) = fit_in_space(&model.scenario, &dataset, about.as_ref())?;
        let assembled = Model::new(&scenario);
        let channels = channels(&assembled, &dataset)?;
        if variants.is_empty() {
            warnings.extend(told.into_iter().chain(channels));
        }
        let beside = Beside::new(&assembled, &dataset, axes, sigma_m)?;
        let Contender { label, known, why, .. } = model.clone();
        let (holds, overall, markers) = (beside.holds(), beside.errors(0..dataset.holds.len()), beside.markers());
        variants.push(SpaceVariant { label, known, why, scenario, holds, overall, markers });
    }
    let first: &SpaceVariant = variants.first().ok_or(CompareError::NoModel)?;
    if axes == 2 {
        warnings.push(format!("{}: the table has no z; x and y are compared", dataset.name));
    }
    if !sessions.is_empty() {
        warnings.push("sessions are not told apart here: the noise is that of all runs together".into());
    }
    let across = |m: &SpaceMarker| m.measured_mm[1..].iter().map(|v| v * v).sum::<f64>().sqrt();
    let d_max_mm = first.markers.iter().map(across).fold(0.0, f64::max);
    warnings.extend(told_of_data);
    warnings.extend(strays(&outliers.samples, &evidence.name));
    Ok(InSpace { axes, d_max_mm, about: about.clone(), variants, warnings, dataset })
}

/// What is told of the supply channels.
///
/// # Errors
/// A channel of the robot without pressure in the table, or a pressure of a channel that supplies nothing.
fn channels(model: &Model, dataset: &Dataset) -> Result<Option<String>, CompareError> {
    let fed: Vec<usize> = model.channels().collect();
    let last = dataset.more_channels();
    if last == 0 {
        let several = fed.len() > 1;
        return Ok(several.then(|| {
            let names: Vec<String> = fed.iter().map(usize::to_string).collect();
            let given = "the table has one actuator pressure, used for all: give each its column, such as p_act_1_kpa";
            format!("{}: the robot has supply channels {}; {given}", dataset.name, names.join(" and "))
        }));
    }
    if let Some(channel) = fed.iter().find(|channel| **channel > last) {
        let message = format!("the robot has supply channel {channel}, and {} has no pressure of it", dataset.name);
        return Err(CompareError::refused(message, format!("add the column p_act_{channel}_kpa")));
    }
    let pressed =
        |channel: &usize| dataset.holds.iter().any(|hold| hold.channels_pa().nth(*channel).unwrap_or(0.0) > 0.0);
    match (1..=last).find(|channel| !fed.contains(channel) && pressed(channel)) {
        Some(channel) => {
            let message = format!(
                "nothing is supplied by channel {channel} in this scenario, and {} has pressures of it",
                dataset.name
            );
            let help =
                format!("write channel = {channel} into its [[strip]] or [[zone]], or delete p_act_{channel}_kpa");
            Err(CompareError::refused(message, help))
        }
        None => Ok(None),
    }
}

/// A prediction beside the mean over runs, hold by hold; a value is (sample, marker, axis).
struct Beside<'a> {
    dataset: &'a Dataset,
    axes: usize,
    /// `[hold][sample][marker]`
    predicted_m: Vec<[f64; 3]>,
    sigma_m: Option<f64>,
}

impl<'a> Beside<'a> {
    fn new(model: &Model, dataset: &'a Dataset, axes: usize, sigma_m: Option<f64>) -> Result<Beside<'a>, CompareError> {
        let mut predicted_m = Vec::new();
        let mut take = |at: &Prediction| {
            let places = at.markers.iter().zip(&at.markers_z_m);
            predicted_m.extend(places.map(|([x, y], z)| [*x, *y, *z]));
        };
        let mut state = model.prediction();
        if model.has_history() {
            let of_hold =
                |hold: &Hold| hold.t_s.iter().map(|t_s| Step { t_s: *t_s, loads: loads(hold) }).collect::<Vec<_>>();
            let steps: Vec<Step> = dataset.holds.iter().flat_map(of_hold).collect();
            model.follow(&steps, &mut state, &mut |_, at| take(at))?;
        } else {
            for hold in &dataset.holds {
                model.predict(&loads(hold), &mut state)?;
                (0..dataset.samples_per_hold).for_each(|_| take(&state));
            }
        }
        Ok(Beside { dataset, axes, predicted_m, sigma_m })
    }

    fn predicted_m(&self, hold: usize, sample: usize, marker: usize) -> [f64; 3] {
        self.predicted_m[self.dataset.offset(hold, sample, marker) / 2]
    }

    /// A coordinate over the runs \[m\].
    fn runs_m(&self, hold: usize, sample: usize, marker: usize, axis: usize) -> Vec<f64> {
        let of_run = |run: usize| self.dataset.place(run, hold, sample, marker)[axis];
        (0..self.dataset.runs.len()).filter_map(of_run).collect()
    }

    fn seen(&self, hold: usize) -> impl Iterator<Item = usize> + '_ {
        (0..self.dataset.markers.len()).filter(move |marker| self.dataset.is_seen(hold, *marker))
    }

    fn errors(&self, holds: std::ops::Range<usize>) -> SpaceErrors {
        let (mut squares, mut sums, mut noise, mut count) =
            (vec![0.0; self.axes], vec![0.0; self.axes], Some(0.0), 0.0);
        for hold in holds {
            for (marker, sample) in
                self.seen(hold).flat_map(|m| (0..self.dataset.samples_per_hold).map(move |s| (m, s)))
            {
                count += 1.0;
                for axis in 0..self.axes {
                    let runs_m = self.runs_m(hold, sample, marker, axis);
                    let error = self.predicted_m(hold, sample, marker)[axis] - mean(&runs_m);
                    squares[axis] += error * error;
                    sums[axis] += error;
                    let own =
                        variance(&runs_m).map(|v| v / runs_m.len() as f64).or(self.sigma_m.map(|sigma| sigma * sigma));
                    noise = noise.zip(own).map(|(sum, v)| sum + v);
                }
            }
        }
        let values = count * self.axes as f64;
        let total: f64 = squares.iter().sum();
        let noise = noise.map(|sum| sum / values);
        SpaceErrors {
            rmse_mm: 1e3 * (total / values).sqrt(),
            rmse_axes_mm: squares.iter().map(|s| 1e3 * (s / count).sqrt()).collect(),
            rms_distance_mm: 1e3 * (total / count).sqrt(),
            bias_mm: sums.iter().map(|s| 1e3 * s / count).collect(),
            noise_floor_mm: noise.map(|v| 1e3 * v.sqrt()),
            systematic_mm: noise.map(|v| 1e3 * (total / values - v).max(0.0).sqrt()),
        }
    }

    fn marker(&self, hold: usize, marker: usize) -> SpaceMarker {
        let samples = self.dataset.samples_per_hold;
        let over_samples = |axis: usize| {
            let all: Vec<Vec<f64>> = (0..samples).map(|s| self.runs_m(hold, s, marker, axis)).collect();
            (0..self.dataset.runs.len())
                .map(|run| mean(&all.iter().map(|runs| runs[run]).collect::<Vec<_>>()))
                .collect()
        };
        let runs: Vec<Vec<f64>> = (0..self.axes).map(over_samples).collect();
        let predicted = |axis| mean(&(0..samples).map(|s| self.predicted_m(hold, s, marker)[axis]).collect::<Vec<_>>());
        SpaceMarker {
            hold,
            marker: self.dataset.markers[marker].name.clone(),
            measured_mm: runs.iter().map(|runs| 1e3 * mean(runs)).collect(),
            scatter_mm: runs.iter().map(|runs| 1e3 * variance(runs).unwrap_or(0.0).sqrt()).collect(),
            predicted_mm: (0..self.axes).map(|axis| 1e3 * predicted(axis)).collect(),
        }
    }

    fn markers(&self) -> Vec<SpaceMarker> {
        (0..self.dataset.holds.len()).flat_map(|h| self.seen(h).map(move |m| self.marker(h, m))).collect()
    }

    fn holds(&self) -> Vec<SpaceHold> {
        (0..self.dataset.holds.len()).map(|hold| self.hold(hold)).collect()
    }

    fn hold(&self, index: usize) -> SpaceHold {
        let hold = &self.dataset.holds[index];
        let tip = self.seen(index).last().map(|marker| self.marker(index, marker));
        let off =
            |tip: SpaceMarker| tip.predicted_mm.iter().zip(tip.measured_mm).map(|(f, y)| f - y).collect::<Vec<_>>();
        let tip_error_mm = tip.map(off).unwrap_or_default();
        SpaceHold {
            p_act_channels_kpa: hold.channels_pa().map(|p| 1e-3 * p).collect(),
            p_body_kpa: 1e-3 * hold.p_body_pa,
            phase: hold.phase.word(),
            occurrence: hold.occurrence,
            errors: self.errors(index..index + 1),
            tip_distance_mm: tip_error_mm.iter().map(|e| e * e).sum::<f64>().sqrt(),
            tip_error_mm,
        }
    }
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

/// `None` of one value.
fn variance(values: &[f64]) -> Option<f64> {
    let centre = mean(values);
    let sum: f64 = values.iter().map(|v| (v - centre).powi(2)).sum();
    (values.len() > 1).then(|| sum / (values.len() - 1) as f64)
}
