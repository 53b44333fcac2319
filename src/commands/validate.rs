//! `ibr validate`

use super::inputs::{self, NamedScenario, positive};
use super::tables::{number, table};
use super::{Context, Outcome};
use crate::cli::Validate;
use crate::extended::{Origin, origins};
use crate::failure::Failure;
use compare::EvaluateOptions;
use compare::evaluate::default_tolerance_m;
use compare::known::Known;
use compare::study::{Candidate, Study, study};
use data::{About, Dataset};
use models::Scenario;
use serde::Serialize;
use serde_json::json;

/// An error that falls to less than this share is called a fall, one that rises above its inverse a rise.
const CLEAR: f64 = 0.7;
/// Lengths that differ by less are the same.
const SAME_LENGTH: f64 = 0.02;

pub fn run(args: &Validate, context: &mut Context) -> Result<Outcome, Failure> {
    let sigma_m = args.sigma.as_deref().map(|t| positive("--sigma", t)).transpose()?;
    let named = inputs::scenario(&args.scenario)?;
    let added = added(&named.scenario, &named.text, &args.without)?;
    let before = without(&named.scenario, &added);
    let mut outcome = Outcome::default();
    let mut trials = Vec::new();
    for spec in &args.data {
        let (dataset, about, input) = inputs::dataset(spec, context)?;
        (context.progress)(&format!("comparing with {spec}"), None);
        let fitted_to_these = added.iter().any(|o| o.data_sha256.contains(&input.sha256));
        let (trial, warnings) = trial(spec, [&before, &named.scenario], (dataset, about), sigma_m, fitted_to_these)?;
        outcome.notes.extend(warnings.into_iter().map(|w| format!("warning: {spec}: {w}")));
        trials.push(trial);
    }
    let names: Vec<String> = added.iter().map(|o| o.effect.clone()).collect();
    outcome.text = text(&args.scenario, &names, [&before, &named.scenario], &trials);
    outcome.json = Some(json!({
        "schema": "ibr.validate", "version": 1, "scenario_file": args.scenario, "added": names,
        "bending_nm2": {"before": before.bending_stiffness, "after": named.scenario.bending_stiffness},
        "datasets": trials,
    }));
    Ok(outcome)
}

/// One dataset, nothing refitted.
#[derive(Debug, Serialize)]
struct Trial {
    data: String,
    runs: usize,
    p_body_kpa: Vec<f64>,
    p_act_kpa: Vec<f64>,
    fitted_to_these: bool,
    geometry_of_data: Vec<String>,
    before: Fit,
    after: Fit,
    noise_floor_mm: Option<f64>,
    verdict: &'static str,
    sentence: String,
}

/// How well a model meets a dataset.
#[derive(Debug, Serialize)]
struct Fit {
    beyond_noise_mm: f64,
    reduced_chi2: Option<f64>,
    largest_tip_error_mm: f64,
}

/// Effects to judge: those named, else those that `ibr add` wrote.
fn added(scenario: &Scenario, text: &str, named: &[String]) -> Result<Vec<Origin>, Failure> {
    let written = origins(text);
    let has = |name: &str| scenario.effects.iter().any(|e| e.name == name);
    if let Some(unknown) = named.iter().find(|name| !has(name)) {
        let own: Vec<&str> = scenario.effects.iter().map(|e| e.name.as_str()).collect();
        return Err(Failure::usage(
            format!("the scenario has no effect `{unknown}`"),
            format!("{}its effects: {}", spelling::meant(unknown, own.iter().copied()), own.join(", ")),
        ));
    }
    let found: Vec<Origin> = match named {
        [] => written,
        _ => {
            let by_hand =
                |name: &String| Origin { effect: name.clone(), data_sha256: Vec::new(), bending_without_nm2: None };
            let of = |name: &String| written.iter().find(|o| o.effect == *name).cloned();
            named.iter().map(|name| of(name).unwrap_or_else(|| by_hand(name))).collect()
        }
    };
    if found.is_empty() {
        let message = "no effect of this scenario was written by `ibr add`, so there is no before and after";
        return Err(Failure::usage(message, "name the effect to judge with --without EFFECT"));
    }
    Ok(found)
}

/// The scenario as it was: without the effects, with the B that was calibrated without the first of them.
fn without(scenario: &Scenario, added: &[Origin]) -> Scenario {
    let mut before = scenario.clone();
    before.effects.retain(|e| !added.iter().any(|o| o.effect == e.name));
    before.bending_stiffness = added.iter().find_map(|o| o.bending_without_nm2).unwrap_or(scenario.bending_stiffness);
    before
}

/// What the effects that `ibr add` wrote bring on data, for a comparison.
#[derive(Debug, Serialize)]
pub(super) struct Fall {
    effects: Vec<String>,
    before: Fit,
    after: Fit,
    fitted_to_these: bool,
    /// In words.
    #[serde(skip)]
    pub sentence: String,
}

/// `None` if it wrote none, or if the robot has no equilibrium without them.
pub(super) fn fall(named: &NamedScenario, study: &Study, sha256: &str, sigma_m: Option<f64>) -> Option<Fall> {
    let is_there = |o: &Origin| named.scenario.effects.iter().any(|e| e.name == o.effect);
    let added: Vec<Origin> = origins(&named.text).into_iter().filter(is_there).collect();
    if added.is_empty() {
        return None;
    }
    let fitted_to_these = added.iter().any(|o| o.data_sha256.iter().any(|own| own == sha256));
    let before = without(&named.scenario, &added);
    let data = (study.dataset.clone(), study.about.clone());
    let (trial, _) = trial("", [&before, &named.scenario], data, sigma_m, fitted_to_these).ok()?;
    let effects: Vec<String> = added.into_iter().map(|o| o.effect).collect();
    let sentence = format!("Error beyond noise without → with {}: {}", effects.join(", "), trial.sentence);
    Some(Fall { effects, before: trial.before, after: trial.after, fitted_to_these, sentence })
}

fn trial(
    spec: &str,
    models: [&Scenario; 2],
    (dataset, about): (Dataset, Option<About>),
    sigma_m: Option<f64>,
    fitted_to_these: bool,
) -> Result<(Trial, Vec<String>), Failure> {
    let (geometry_of_data, sized) = match about.as_ref() {
        Some(about) => in_size(models, about),
        None => (Vec::new(), models.map(Scenario::clone)),
    };
    let candidate = |label: &'static str, scenario| Candidate { label, known: Known::Predicted, why: "", scenario };
    let candidates = [candidate("before", &sized[0]), candidate("after", &sized[1])];
    let options = EvaluateOptions { sigma_m, bootstrap_samples: 0, ..EvaluateOptions::default() };
    let study = study(&candidates, dataset, about, &options, None)?;
    let [before, after] = [0, 1].map(|k| fit(&study, k));
    let all = &study.variants[1].evaluation.metrics.overall;
    let tolerance_mm = 1e3 * default_tolerance_m(1e-3 * all.d_max_mm);
    let (verdict, sentence) = judged(before.beyond_noise_mm, after.beyond_noise_mm, tolerance_mm, fitted_to_these);
    let levels = |of: fn(&data::Hold) -> f64| {
        let mut levels: Vec<f64> = study.dataset.holds.iter().map(|h| (of(h) * 1e-2).round() * 0.1).collect();
        levels.sort_by(f64::total_cmp);
        levels.dedup();
        levels
    };
    let trial = Trial {
        data: spec.to_string(),
        runs: study.dataset.runs.len(),
        p_body_kpa: levels(|h| h.p_body_pa),
        p_act_kpa: levels(|h| h.p_act_pa),
        fitted_to_these,
        geometry_of_data,
        noise_floor_mm: all.noise_floor_mm,
        before,
        after,
        verdict,
        sentence,
    };
    Ok((trial, study.warnings))
}

fn fit(study: &Study, k: usize) -> Fit {
    let all = &study.variants[k].evaluation.metrics.overall;
    Fit {
        beyond_noise_mm: all.systematic_mm.unwrap_or(all.rmse_mm),
        reduced_chi2: all.reduced_chi2,
        largest_tip_error_mm: all.largest_tip_error_mm,
    }
}

fn judged(before: f64, after: f64, tolerance_mm: f64, fitted_to_these: bool) -> (&'static str, String) {
    let fall = format!("{before:.2} → {after:.2} mm");
    match () {
        () if fitted_to_these => {
            ("fitted_to_these", format!("{fall}: no test, the effect was fitted to these very data"))
        }
        () if before.max(after) <= tolerance_mm => (
            "no_argument",
            format!("{fall}: both within the tolerance of {tolerance_mm:.2} mm, no argument either way"),
        ),
        () if after < CLEAR * before => ("helps", format!("{fall}: the effect helps where it was not fitted")),
        () if after > before / CLEAR => {
            ("worse", format!("{fall}: worse with the effect; its name or its value does not hold here"))
        }
        () => ("no_difference", format!("{fall}: hardly a difference; these data do not support the effect")),
    }
}

/// Both models in the size that the data's `about.toml` states, and what was changed.
fn in_size(models: [&Scenario; 2], about: &About) -> (Vec<String>, [Scenario; 2]) {
    let mut changed = Vec::new();
    let sized = models.map(|model| {
        let mut own = Vec::new();
        let scenario = resized(model, about, &mut own);
        changed = own;
        scenario
    });
    (changed, sized)
}

fn resized(scenario: &Scenario, about: &About, changed: &mut Vec<String>) -> Scenario {
    let mut sized = scenario.clone();
    let Some(g) = &about.geometry else { return sized };
    let mut set = |what: &str, mine: &mut f64, theirs: Option<f64>| {
        if let Some(v) = theirs.filter(|v| (v - *mine).abs() > SAME_LENGTH * mine.abs()) {
            changed.push(format!("{what} {:.1} mm, not {:.1}", v * 1e3, *mine * 1e3));
            *mine = v;
        }
    };
    set("body radius", &mut sized.radius_m, Some(g.body_radius_m));
    set("body length", &mut sized.length_m, Some(g.body_length_m));
    let shape = &mut sized.actuator.shape;
    set("actuator length", &mut shape.length_m, g.pouch_length_m);
    set("actuator width", &mut shape.width_m, g.pouch_width_m);
    set("fold depth", &mut shape.fold_m, g.fold_m);
    if let Some(arm) = &mut sized.actuator.arm_m {
        set("arm", arm, g.arm_m);
    }
    if let Some(count) = g.pouches.filter(|n| *n != sized.actuator.count) {
        changed.push(format!("{count} units, not {}", sized.actuator.count));
        sized.actuator.count = count;
    }
    let end = sized.actuator.start_m + sized.actuator.shape.length_m * sized.actuator.count as f64;
    if end > sized.length_m * (1.0 + 1e-9) || !sized.zones.is_empty() {
        // Half a robot of the data and half of the scenario would be neither; the comparison then warns of the difference.
        changed.clear();
        return scenario.clone();
    }
    sized
}

fn text(file: &str, names: &[String], [before, after]: [&Scenario; 2], trials: &[Trial]) -> String {
    let mut out = format!(
        "{file}: {} on other data, nothing refitted (B {:.3} N m² with, {:.3} without)\n",
        names.join(" and "),
        after.bending_stiffness,
        before.bending_stiffness
    );
    let levels = |l: &[f64]| l.iter().map(|p| format!("{p}")).collect::<Vec<_>>().join(", ");
    let row = |t: &Trial| {
        vec![
            t.data.clone(),
            levels(&t.p_act_kpa),
            levels(&t.p_body_kpa),
            t.runs.to_string(),
            number(t.noise_floor_mm, 2),
            number(Some(t.before.beyond_noise_mm), 2),
            number(Some(t.after.beyond_noise_mm), 2),
            number(t.before.reduced_chi2, 1),
            number(t.after.reduced_chi2, 1),
        ]
    };
    let head =
        ["data", "actuator kPa", "body kPa", "runs", "noise mm", "before mm", "after mm", "χ²/dof before", "after"];
    out.push_str(&table(&head, 1, trials.iter().map(row).collect()));
    for t in trials {
        out.push_str(&format!("  - {}: {}.\n", t.data, t.sentence));
        if !t.geometry_of_data.is_empty() {
            out.push_str(&format!("    size of the data's robot taken: {}\n", t.geometry_of_data.join("; ")));
        }
    }
    if trials.iter().all(|t| t.fitted_to_these) {
        out.push_str(
            "Only data it was not fitted to can test it: another pressure, another size, another body pressure.\n",
        );
    }
    out
}
