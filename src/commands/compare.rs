//! `ibr compare`

use super::inputs::{self, positive, with_effect};
use super::tables::{number, table};
use super::validate::{Fall, fall};
use super::{Context, Outcome};
use crate::cli::Compare;
use crate::failure::{Failure, MISSED};
use crate::output::{check_folder, machine, program, today, write_files};
use compare::EvaluateOptions;
use compare::known::Known;
use compare::study::{Candidate, Study, Variant, study};
use ibr::pages::{Imprint, compare_page};
use models::Scenario;
use serde_json::{Value, json};
use std::path::PathBuf;

pub fn run(args: &Compare, context: &mut Context) -> Result<Outcome, Failure> {
    if let Some(outcome) = super::held::run(args, context)? {
        return Ok(outcome);
    }
    let (scenario_spec, data_spec) = both(args)?;
    let limit_m = args.max_error.as_deref().map(|t| positive("--max-error", t)).transpose()?;
    let sigma_m = args.sigma.as_deref().map(|t| positive("--sigma", t)).transpose()?;
    args.out.as_deref().map_or(Ok(()), check_folder)?;
    let named = inputs::scenario_or_own(scenario_spec, data_spec)?;
    let models = models(&named.scenario, &args.effect)?;
    let (dataset, about, input) = inputs::dataset(data_spec, context)?;
    (context.progress)("comparing", None);
    let candidates: Vec<Candidate> = models.iter().map(Model::candidate).collect();
    let options = EvaluateOptions { sigma_m, ..EvaluateOptions::default() };
    let study = study(&candidates, dataset, about, &options, args.calibrate)?;
    let folder = out_folder(args, &study, context.json);
    let warnings = warnings(args, data_spec, &study);
    let fall = fall(&named, &study, &input.sha256, sigma_m);
    let mut outcome =
        Outcome::new(text(&study, fall.as_ref()), to_json(scenario_spec, &study, &warnings, fall.as_ref()));
    if let Some(folder) = folder {
        (context.progress)("drawing the report", None);
        let imprint = Imprint { program: program(), date: today(), machine: machine() };
        let files = compare_page(&study, &imprint)?;
        write_files(&folder, &files, &[named.input, input], context)?;
        outcome.notes.push(format!("report: {}", folder.join("report.html").display()));
    }
    outcome.notes.extend(warnings.iter().map(|w| format!("warning: {w}")));
    let last = study.variants.last().map(error_mm);
    if let (Some(limit), Some(error)) = (limit_m, last)
        && error > limit * 1e3
    {
        outcome.notes.push(format!("error beyond noise {error:.2} mm exceeds --max-error {:.2} mm", limit * 1e3));
        outcome.code = MISSED;
    }
    Ok(outcome)
}

/// Scenario and data.
fn both(args: &Compare) -> Result<(&str, &str), Failure> {
    match &args.inputs[..] {
        [data] if inputs::own_scenario(data).is_some() => Ok(("its own", data)),
        [scenario, data] => Ok((scenario, data)),
        other => {
            let message = format!("ibr compare takes a scenario and data, not {} names", other.len());
            let help =
                "for example `ibr compare epam synthetic-epam`; `ibr compare spam epam --engines` takes scenarios only";
            Err(Failure::usage(message, help))
        }
    }
}

/// What the reader should know about the data and the options before trusting the figures.
fn warnings(args: &Compare, data_spec: &str, study: &Study) -> Vec<String> {
    let mut warnings = study.warnings.clone();
    let outliers = data::check(&study.dataset, study.about.as_ref()).outliers;
    if let Some(o) = outliers.iter().max_by(|a, b| a.robust_z.total_cmp(&b.robust_z)) {
        warnings.push(format!(
            "{} samples are far from the other runs, first of all run {}, marker {} ({:+.1}, {:+.1} mm): \
             look at `ibr data check {}`",
            outliers.len(),
            o.run,
            o.marker,
            o.dx_mm,
            o.dy_mm,
            data_spec
        ));
    }
    if args.sigma.is_some() && study.dataset.runs.len() > 1 {
        warnings.push("--sigma is for a single run and was not used: several runs show the noise themselves".into());
    }
    warnings
}

/// A model with the words that go with it.
struct Model {
    label: String,
    known: Known,
    why: String,
    scenario: Scenario,
}

impl Model {
    fn candidate(&self) -> Candidate<'_> {
        Candidate { label: &self.label, known: self.known, why: &self.why, scenario: &self.scenario }
    }
}

/// The scenario as given, then with one effect after the other.
fn models(scenario: &Scenario, effects: &[String]) -> Result<Vec<Model>, Failure> {
    let own: Vec<&str> = scenario.effects.iter().map(|e| e.name.as_str()).collect();
    let why = if own.is_empty() { "no effect".to_string() } else { format!("with {}", own.join(", ")) };
    let first = Model { label: "scenario".into(), known: basis(scenario), why, scenario: scenario.clone() };
    let mut models = vec![first];
    for text in effects {
        let (next, why) = with_effect(&models[models.len() - 1].scenario, text)?;
        models.push(Model { label: format!("+ {text}"), known: Known::Assumed, why, scenario: next });
    }
    Ok(models)
}

/// The weakest basis that the scenario states for its effects.
fn basis(scenario: &Scenario) -> Known {
    let says = |word: &str| scenario.effects.iter().any(|e| e.basis == word);
    if says("calibrated") {
        return Known::Calibrated;
    }
    if scenario.effects.iter().all(|e| matches!(e.basis.as_str(), "measured" | "predicted" | "published")) {
        return if scenario.bending_stiffness > 0.0 { Known::Assumed } else { Known::Predicted };
    }
    Known::Assumed
}

fn error_mm(variant: &Variant) -> f64 {
    let all = &variant.evaluation.metrics.overall;
    all.systematic_mm.unwrap_or(all.rmse_mm)
}

fn out_folder(args: &Compare, study: &Study, json: bool) -> Option<PathBuf> {
    let name: String =
        study.dataset.name.chars().map(|c| if c.is_ascii_alphanumeric() || c == '-' { c } else { '-' }).collect();
    match &args.out {
        Some(folder) => Some(folder.clone()),
        None => (!json).then(|| PathBuf::from(format!("ibr-report/compare-{name}"))),
    }
}

fn text(study: &Study, fall: Option<&Fall>) -> String {
    let first = &study.variants[0];
    let mut out = format!("{} held against {}\n", first.scenario.name, study.dataset.name);
    out.push_str(&format!("{}\n", first.evaluation.noise.sentence));
    for variant in &study.variants {
        out.push_str(&format!("\n{} ({}): {}\n", variant.label, variant.known.word(), variant.why));
        out.push_str(&holds(variant));
    }
    if let Some(fall) = fall {
        out.push_str(&format!("\n{}.\n", fall.sentence));
    }
    out.push_str("\nWhere the scenario's model fails:\n");
    for statement in &first.evaluation.where_it_fails {
        out.push_str(&format!("  - {}\n", statement.sentence));
    }
    out.push_str(&format!("\nP/p scaling: {}\n", first.evaluation.scaling.sentence));
    out
}

fn holds(variant: &Variant) -> String {
    let head = [
        "hold",
        "paper accuracy %",
        "noise ceiling %",
        "rms rel. %",
        "RMSE mm",
        "noise floor mm",
        "beyond noise mm",
        "tip error mm",
        "χ²/dof",
    ];
    let percent = |v: Option<f64>| number(v.map(|a| 100.0 * a), 1);
    let rows = variant.evaluation.metrics.holds.iter().map(|h| {
        vec![
            format!("{:.0} kPa {} (body {:.0})", h.p_act_kpa, h.phase, h.p_body_kpa),
            percent(h.paper_accuracy),
            percent(h.noise_ceiling),
            number(h.rms_relative_pct, 1),
            number(Some(h.rmse_mm), 2),
            number(h.noise_floor_mm, 2),
            number(h.systematic_mm, 2),
            format!("{:+.2}", h.tip_error_mm),
            number(h.reduced_chi2, 1),
        ]
    });
    table(&head, 1, rows.collect())
}

fn to_json(scenario: &str, study: &Study, warnings: &[String], fall: Option<&Fall>) -> Value {
    let variant = |v: &Variant| {
        json!({
            "label": v.label, "how_known": v.known.word(), "why": v.why,
            "bending_nm2": v.scenario.bending_stiffness,
            "effects": v.scenario.effects.iter().map(|e| e.name.clone()).collect::<Vec<_>>(),
            "holds": v.evaluation.metrics.holds, "overall": v.evaluation.metrics.overall,
            "residual_map": v.evaluation.residual_map, "where_it_fails": v.evaluation.where_it_fails,
        })
    };
    let first = &study.variants[0].evaluation;
    json!({
        "schema": "ibr.compare", "version": 1, "scenario": scenario, "data": study.dataset.name,
        "actuator": study.dataset.actuator, "runs": study.dataset.runs.len(),
        "provenance": study.about.as_ref().map(|a| a.provenance.word()),
        "noise": first.noise, "holds": first.metrics.holds, "overall": first.metrics.overall,
        "pairing": first.metrics.pairing, "residual_map": first.residual_map,
        "where_it_fails": first.where_it_fails, "scaling": first.scaling,
        "models": study.variants.iter().map(variant).collect::<Vec<_>>(),
        "added": fall, "warnings": warnings,
    })
}
