//! Models compared with one evidence: how far off, and where.

use crate::error::CompareError;
use crate::evaluate::{EvaluateOptions, Evaluation, evaluate};
use crate::evidence::Evidence;
use crate::prepare::{OutlyingRun, Prepared, outlying_runs, prepare};
use crate::slips::pressure::{PressureSlipFound, pressure_words};
use crate::slips::slips_of;
use crate::study::calibrate::{Knob, calibrate};
use crate::study::predict::{fit_scenario, predict_dataset, seen_by};
use crate::typed_effect::with_effect;
use data::check::Outlier;
use data::{About, Dataset};
use models::{Known, Scenario};

/// A model to hold against data.
#[derive(Debug, Clone)]
pub struct Contender {
    /// Short name of the model for tables.
    pub label: String,
    /// How the model's values are known.
    pub known: Known,
    /// Effects of the model, or the source of its values.
    pub why: String,
    /// The model as given, before it is fitted to the data's stations and loads.
    pub scenario: Scenario,
}

impl Contender {
    /// A scenario under the name `scenario`, known as well as its weakest value.
    pub fn as_given(scenario: &Scenario) -> Contender {
        let own: Vec<&str> = scenario.effects.iter().map(|e| e.name.as_str()).collect();
        let why = if own.is_empty() { "no effect".to_string() } else { format!("with {}", own.join(", ")) };
        Contender { label: "scenario".into(), known: basis(scenario), why, scenario: scenario.clone() }
    }

    /// The same with one more effect, typed as `name` or `name:key=value,…`.
    ///
    /// # Errors
    /// A name, key or value that is not possible.
    pub fn with(&self, effect: &str) -> Result<Contender, CompareError> {
        let (scenario, why) = with_effect(&self.scenario, effect)?;
        Ok(Contender { label: format!("+ {effect}"), known: Known::Assumed, why: why.into(), scenario })
    }
}

/// The weakest basis that the scenario states for its effects.
fn basis(scenario: &Scenario) -> Known {
    let is_known = |word: &str| matches!(word, "measured" | "predicted" | "published");
    match () {
        () if scenario.effects.iter().any(|e| e.basis == "calibrated") => Known::Calibrated,
        () if scenario.effects.iter().any(|e| !is_known(&e.basis)) => Known::Assumed,
        () if scenario.bending_stiffness > 0.0 => Known::Assumed,
        () => Known::Predicted,
    }
}

/// One model of a [`Comparison`], with its evaluation.
#[derive(Debug, Clone)]
pub struct Variant {
    /// Short name of the model for tables.
    pub label: String,
    /// How the model's values are known.
    pub known: Known,
    /// Effects of the model, or the source of its values.
    pub why: String,
    /// The model, fitted to stations and loads of the data.
    pub scenario: Scenario,
    /// Accuracy, residual map, where it fails.
    pub evaluation: Evaluation,
}

impl Variant {
    /// Error beyond noise \[mm\]; the root-mean-square error where the noise is unknown.
    pub fn error_mm(&self) -> f64 {
        let all = &self.evaluation.metrics.overall;
        all.systematic_mm.unwrap_or(all.rmse_mm)
    }
}

/// The data, and one or more models on them.
#[derive(Debug, Clone)]
pub struct Comparison {
    /// The data as they were compared: without copies of runs, strays replaced.
    pub dataset: Dataset,
    /// Description of the data from `about.toml`, if there is one.
    pub about: Option<About>,
    /// Models with their evaluations, the one given first.
    pub variants: Vec<Variant>,
    /// What does not match between scenario and data.
    pub warnings: Vec<String>,
}

impl Comparison {
    /// Puts a slip of the pressures before all other cautions.
    pub fn tell_first(&mut self, slip: Option<PressureSlipFound>) {
        let in_numbers = pressure_words(&self.dataset);
        if let Some(found) = slip {
            self.warnings.retain(|warning| !in_numbers.contains(warning));
            self.warnings.insert(0, found.words);
        }
    }

    /// Error beyond noise of the model given first \[mm\].
    pub fn error_mm(&self) -> f64 {
        self.variants.first().map_or(f64::NAN, Variant::error_mm)
    }
}

/// Holds a scenario against measurements.
///
/// # Errors
/// What does not match, does not balance or cannot be evaluated.
pub fn compare(scenario: &Scenario, evidence: &Evidence) -> Result<Comparison, CompareError> {
    compare_all(&[Contender::as_given(scenario)], evidence, &EvaluateOptions::default(), None)
}

/// Holds models against measurements; with a knob, also the last one with that number fitted to these data.
///
/// # Errors
/// As [`compare`]; no model at all.
pub fn compare_all(
    models: &[Contender],
    evidence: &Evidence,
    options: &EvaluateOptions,
    knob: Option<Knob>,
) -> Result<Comparison, CompareError> {
    let Evidence { dataset: read, about, .. } = evidence;
    let Prepared { dataset, outliers, warnings: told_of_data, .. } = prepare(read, about.as_ref());
    let sessions = sessions(&dataset, about.as_ref(), options);
    let options = &EvaluateOptions { sessions, ..options.clone() };
    let (mut variants, mut warnings) = (Vec::<Variant>::new(), Vec::new());
    let fits = models.iter().map(|model| fit_scenario(&model.scenario, &dataset, about.as_ref()));
    let fits = fits.collect::<Result<Vec<_>, _>>()?;
    let dataset = &seen_by(&models.first().ok_or(CompareError::NoModel)?.scenario, dataset);
    for (model, (scenario, told)) in models.iter().zip(fits) {
        if variants.is_empty() {
            warnings.extend(slips_of(read, &scenario));
            warnings.extend(told);
        }
        let evaluation = held(&scenario, dataset, options)?;
        let Contender { label, known, why, .. } = model.clone();
        variants.push(Variant { label, known, why, scenario, evaluation });
    }
    let last = variants.last().ok_or(CompareError::NoModel)?;
    if let Some(knob) = knob {
        variants.push(calibrated(&last.scenario, dataset, options, knob)?);
    }
    warnings.extend(told_of_data);
    warnings.extend(strays(&outliers.samples, &evidence.name));
    warnings.extend(variants.first().into_iter().flat_map(|v| {
        outlying_runs(dataset, &v.evaluation.noise_model).iter().map(OutlyingRun::words).collect::<Vec<_>>()
    }));
    Ok(Comparison { dataset: dataset.clone(), about: about.clone(), variants, warnings })
}

/// Where the samples are that are far from the other runs.
pub(super) fn strays(outliers: &[Outlier], name: &str) -> Option<String> {
    let o = outliers.iter().max_by(|a, b| a.robust_z.total_cmp(&b.robust_z))?;
    let dz = o.dz_mm.map_or(String::new(), |dz| format!(", {dz:+.1}"));
    Some(format!(
        "the farthest of them is of run {}, marker {} ({:+.1}, {:+.1}{dz} mm): look at `ibr data check {name}`",
        o.run, o.marker, o.dx_mm, o.dy_mm
    ))
}

/// Session of every run: as given, else as `about.toml` labels them.
fn sessions(dataset: &Dataset, about: Option<&About>, options: &EvaluateOptions) -> Vec<usize> {
    let label = |run: &String| about?.runs.iter().find(|r| r.id == *run)?.session.clone();
    let labels: Vec<Option<String>> = dataset.runs.iter().map(label).collect();
    if !options.sessions.is_empty() || labels.iter().all(Option::is_none) {
        return options.sessions.clone();
    }
    labels.iter().map(|l| labels.iter().position(|other| other == l).unwrap_or(0)).collect()
}

fn held(scenario: &Scenario, dataset: &Dataset, options: &EvaluateOptions) -> Result<Evaluation, CompareError> {
    let predicted = predict_dataset(scenario, dataset)?;
    evaluate(dataset, &predicted.coordinates_m, &predicted.d_ln_pressure_m, options)
}

fn calibrated(
    scenario: &Scenario,
    dataset: &Dataset,
    options: &EvaluateOptions,
    knob: Knob,
) -> Result<Variant, CompareError> {
    let fit = calibrate(scenario, dataset, options, knob)?;
    let options = EvaluateOptions { fitted_parameters: options.fitted_parameters + 1, ..options.clone() };
    let evaluation = held(&fit.scenario, dataset, &options)?;
    let misses = if fit.misses { ", wide because the model misses by more than noise" } else { "" };
    let interval = fit.interval.map_or(String::new(), |i| format!(", 95 % interval {:.3}–{:.3}{misses}", i[0], i[1]));
    let (symbol, unit, what) = match knob {
        Knob::Bending => ("bending B", "N m²", "a stiffness"),
        Knob::BodyPressure => ("body pressure p_b", "kPa", "another body pressure"),
    };
    let short = symbol.rsplit(' ').next().unwrap_or(symbol);
    let bound = match (fit.at_bound, fit.misses) {
        (true, true) => format!("; at its bound: {what} does not explain these data"),
        (true, false) => "; at its bound, and the model agrees there".to_string(),
        _ => String::new(),
    };
    Ok(Variant {
        label: format!("+ {symbol} = {:.3} {unit}", fit.value),
        known: Known::Calibrated,
        why: format!("{short} fitted to these data{interval}{bound}"),
        scenario: fit.scenario,
        evaluation,
    })
}
