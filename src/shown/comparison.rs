//! Text and JSON of a comparison, `ibr.compare`.

use crate::prelude::*;
use crate::words::hold_name;
use compare::metrics::{HoldMetrics, OverallMetrics};
use compare::residuals::ResidualMap;
use compare::study::comparison::{Comparison, Variant};
use compare::validation::{HowFar, Validation};
use compare::where_it_fails::Statement;
use compare::{Evaluation, NoiseSummary, ScalingCheck};

/// `ibr.compare`: `ibr compare SCENARIO DATA`
#[derive(Serialize)]
pub struct CompareAnswer<'a> {
    /// Scenario as typed, or `its own`
    pub scenario: &'a str,
    /// Path or name of the data as typed
    pub data: &'a str,
    /// Kind of the actuator, `epam` for example
    pub actuator: &'a str,
    /// Number of runs in the data
    pub runs: usize,
    /// How the data came to be; null without about.toml
    pub provenance: Option<Provenance>,
    /// Noise of the mean over runs
    pub noise: &'a NoiseSummary,
    /// How prediction and measurement are paired
    pub pairing: &'a str,
    /// How far off the scenario as given is
    #[serde(flatten)]
    pub errors: ModelErrors<'a>,
    /// Whether shapes depend on P/p only
    pub scaling: &'a ScalingCheck,
    /// The scenario, then every addition and calibration
    pub models: Vec<ModelOnData<'a>>,
    /// What effects that `ibr add` wrote bring here; null without any
    pub added: Option<AddedOnData<'a>>,
    /// Reasons to doubt data or comparison
    pub warnings: &'a [String],
    #[serde(skip)]
    found: &'a Comparison,
    #[serde(skip)]
    sentence: Option<&'a str>,
}

/// A model compared with the data.
#[derive(Serialize)]
pub struct ModelOnData<'a> {
    /// Name of the model in words
    pub label: &'a str,
    /// How the values of the model are known
    pub how_known: Known,
    /// Source of its values in one sentence
    pub why: &'a str,
    /// Effective bending stiffness B of the body
    pub bending_nm2: f64,
    /// Names of the effects in the model
    pub effects: Vec<&'a str>,
    /// Errors of the model on the data, as keys of this object
    #[serde(flatten)]
    pub errors: ModelErrors<'a>,
}

/// How far off a model is, and where.
#[derive(Serialize)]
pub struct ModelErrors<'a> {
    /// Accuracy and its companions, hold by hold
    pub holds: &'a [HoldMetrics],
    /// Accuracy and its companions over all holds
    pub overall: &'a OverallMetrics,
    /// Residuals of every marker in every hold
    pub residual_map: &'a ResidualMap,
    /// Where it fails, in plain language
    pub where_it_fails: &'a [Statement],
}

impl<'a> ModelErrors<'a> {
    fn of(Evaluation { metrics, residual_map, where_it_fails, .. }: &'a Evaluation) -> ModelErrors<'a> {
        ModelErrors { holds: &metrics.holds, overall: &metrics.overall, residual_map, where_it_fails }
    }
}

/// What added effects bring on the data.
#[derive(Serialize)]
pub struct AddedOnData<'a> {
    /// Effects that were added to the scenario
    pub effects: &'a [String],
    /// Errors of the scenario without the added effects
    pub before: &'a HowFar,
    /// Errors of the scenario with the added effects
    pub after: &'a HowFar,
    /// They were fitted to these very data: no test
    pub fitted_to_these: bool,
}

impl<'a> CompareAnswer<'a> {
    /// Of a scenario, as typed, and what was found; with effects that were added to it, and what they bring here.
    pub fn of(scenario: &'a str, found: &'a Comparison, added: Option<&'a (Vec<String>, Validation)>) -> Self {
        let first = &found.variants[0].evaluation;
        let model = |v: &'a Variant| ModelOnData {
            label: &v.label,
            how_known: v.known,
            why: &v.why,
            bending_nm2: v.scenario.bending_stiffness,
            effects: v.scenario.effects.iter().map(|e| e.name.as_str()).collect(),
            errors: ModelErrors::of(&v.evaluation),
        };
        let on_data = |(effects, v): &'a (Vec<String>, Validation)| {
            let Validation { before, after, fitted_to_these, .. } = v;
            AddedOnData { effects, before, after, fitted_to_these: *fitted_to_these }
        };
        CompareAnswer {
            scenario,
            data: &found.dataset.name,
            actuator: &found.dataset.actuator,
            runs: found.dataset.runs.len(),
            provenance: found.about.as_ref().map(|a| a.provenance),
            noise: &first.noise,
            pairing: first.metrics.pairing,
            errors: ModelErrors::of(first),
            scaling: &first.scaling,
            models: found.variants.iter().map(model).collect(),
            added: added.map(on_data),
            warnings: &found.warnings,
            found,
            sentence: added.map(|(_, v)| v.sentence.as_str()),
        }
    }
}

/// Text of the comparison as the command prints it.
pub fn text(answer: &CompareAnswer) -> String {
    let CompareAnswer { found, added, sentence, .. } = answer;
    let first = &found.variants[0];
    let mut out = format!("{} compared with {}\n", first.scenario.name, found.dataset.name);
    out += &format!("{}\n", first.evaluation.noise.sentence);
    for variant in &found.variants {
        out += &format!("\n{} ({}): {}\n{}", variant.label, variant.known.word(), variant.why, holds(variant));
    }
    if let Some((added, sentence)) = added.as_ref().zip(*sentence) {
        out += &format!("\nError beyond noise without → with {}: {sentence}.\n", added.effects.join(", "));
    }
    let fails = lines("  - ", first.evaluation.where_it_fails.iter().map(|s| &s.sentence));
    let scaling = &first.evaluation.scaling.sentence;
    out + &format!("\nWhere the scenario's model fails:\n{fails}\nP/p scaling: {scaling}\n")
}

fn holds(variant: &Variant) -> String {
    let percent = |share: Option<f64>| share.map(|a| 100.0 * a);
    let holds = &variant.evaluation.metrics.holds;
    let has_z = holds.iter().any(|h| h.tip_error_z_mm.is_some());
    TextTable::of(holds)
        .words("hold", |h| hold_name(&h.label))
        .when(!has_z, |table| {
            table
                .number("paper accuracy %", 1, |h| percent(h.paper_accuracy))
                .number("noise ceiling %", 1, |h| percent(h.noise_ceiling))
                .number("rms rel. %", 1, |h| h.rms_relative_pct)
        })
        .number("RMSE mm", 2, |h| h.rmse_mm)
        .number("noise floor mm", 2, |h| h.noise_floor_mm)
        .number("beyond noise mm", 2, |h| h.systematic_mm)
        .when(!has_z, |table| table.signed("tip error mm", 2, |h| h.tip_error_mm))
        .when(has_z, |table| {
            table
                .signed("tip error x mm", 2, |h| h.tip_error_x_mm)
                .signed("y mm", 2, |h| h.tip_error_mm)
                .signed("z mm", 2, |h| h.tip_error_z_mm)
                .number("tip distance mm", 2, |h| h.tip_distance_mm)
        })
        .number("χ²/dof", 1, |h| h.reduced_chi2)
        .text()
}
