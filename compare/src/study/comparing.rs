//! One scenario held against one dataset: every model, and what is found of it.

use crate::error::CompareError;
use crate::evaluate::{EvaluateOptions, Evaluation, evaluate};
use crate::known::Known;
use crate::slips::slips;
use crate::study::calibrate::{Knob, calibrate};
use crate::study::predict::{fit_scenario, predict_dataset};
use data::{About, Dataset};
use models::Scenario;

/// One model on the data of a [`Study`].
#[derive(Debug, Clone)]
pub struct Variant {
    /// In words.
    pub label: String,
    /// How its values are known.
    pub known: Known,
    /// Where they come from.
    pub why: String,
    /// The model, fitted to stations and loads of the data.
    pub scenario: Scenario,
    /// Accuracy, residual map, where it fails.
    pub evaluation: Evaluation,
}

/// A comparison: the data, and one or more models on them.
#[derive(Debug, Clone)]
pub struct Study {
    /// The data.
    pub dataset: Dataset,
    /// Their description.
    pub about: Option<About>,
    /// Models, the one given first.
    pub variants: Vec<Variant>,
    /// What does not match between scenario and data.
    pub warnings: Vec<String>,
}

/// A model to hold against data.
pub struct Candidate<'a> {
    /// In words.
    pub label: &'a str,
    /// How its values are known.
    pub known: Known,
    /// Where they come from.
    pub why: &'a str,
    /// The model.
    pub scenario: &'a Scenario,
}

/// Holds candidates against a dataset; with a knob, also the last one with that number fitted to these data.
///
/// # Errors
/// What does not match, does not balance or cannot be evaluated.
pub fn study(
    candidates: &[Candidate],
    dataset: Dataset,
    about: Option<About>,
    options: &EvaluateOptions,
    knob: Option<Knob>,
) -> Result<Study, CompareError> {
    if candidates.is_empty() {
        return Err(CompareError::NoModel);
    }
    let options = &EvaluateOptions { sessions: sessions(&dataset, about.as_ref(), options), ..options.clone() };
    let mut study = Study { dataset, about, variants: Vec::new(), warnings: Vec::new() };
    for c in candidates {
        let (scenario, warnings) = fit_scenario(c.scenario, &study.dataset, study.about.as_ref())?;
        if study.variants.is_empty() {
            study.warnings.extend(slips(&study.dataset, &scenario.markers_m, scenario.radius_m));
            study.warnings.extend(warnings);
        }
        let evaluation = held(&scenario, &study.dataset, options)?;
        let (label, why) = (c.label.to_string(), c.why.to_string());
        study.variants.push(Variant { label, known: c.known, why, scenario, evaluation });
    }
    if let (Some(last), Some(knob)) = (study.variants.last(), knob) {
        let variant = calibrated(&last.scenario, &study.dataset, options, knob)?;
        study.variants.push(variant);
    }
    Ok(study)
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
    evaluate(dataset, &predicted.xy_m, &predicted.d_ln_pressure_m, options)
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
    let bound =
        if fit.at_bound { format!("; at its bound: {what} does not explain these data") } else { String::new() };
    Ok(Variant {
        label: format!("+ {symbol} = {:.3} {unit}", fit.value),
        known: Known::Calibrated,
        why: format!("{short} fitted to these data{interval}{bound}"),
        scenario: fit.scenario,
        evaluation,
    })
}
