//! `ibr ladder`

use super::extend::{Ground, Rung, drawn, rungs_text, value};
use super::inputs::{self, Loaded, NamedScenario, diagnosed, positive};
use super::{Context, Outcome};
use crate::cli::Ladder;
use crate::extended::extended;
use crate::failure::Failure;
use crate::output::{check_folder, machine, program, today, write_files};
use compare::diagnosis::{Confidence, Diagnosis, Group, KeptBending, Options, ParameterValue, Verdict};
use compare::known::Known;
use data::Dataset;
use ibr::pages::{Imprint, LadderPage, ladder_page};
use models::Scenario;
use serde::Serialize;
use serde_json::{Value, json};
use std::path::{Path, PathBuf};

pub fn run(args: &Ladder, context: &mut Context) -> Result<Outcome, Failure> {
    let tolerance_m = args.tolerance.as_deref().map(|t| positive("--tolerance", t)).transpose()?;
    args.out.as_deref().map_or(Ok(()), check_folder)?;
    let named = inputs::scenario(&args.scenario)?;
    let data = inputs::datasets(&args.data, &args.also, context)?;
    let dataset = &data[0].dataset;
    let options =
        Options { tolerance_m, keep_bending: args.keep_bending, next_experiment: false, ..Options::default() };
    let climb = climb(&named, &data, &options, args.effects as usize, context)?;
    let mut outcome = Outcome::new(text(&climb), to_json(args, &climb));
    outcome.notes.extend(climb.warnings.iter().map(|w| format!("warning: {w}")));
    if let Some(folder) = folder(args, dataset, context.json) {
        // What was found took long, and is printed where it cannot be written.
        match report(args, &folder, (&named, &data), &climb, context) {
            Ok(notes) => outcome.notes.extend(notes),
            Err(failure) => outcome.fail(&failure),
        }
    }
    Ok(outcome)
}

/// Writes report and scenarios; what to say of them.
fn report(
    args: &Ladder,
    folder: &Path,
    (named, data): (&NamedScenario, &[Loaded]),
    climb: &Climb,
    context: &mut Context,
) -> Result<Vec<String>, Failure> {
    let imprint = Imprint { program: program(), date: today(), machine: machine() };
    let page = LadderPage {
        title: format!("{}: one effect after the other, on {}", named.scenario.name, data[0].dataset.name),
        lead: climb.ending.clone(),
        rungs: &drawn(&climb.rungs),
        floor_mm: climb.floor_mm,
        told: climb.told.clone(),
        typed: [&args.scenario, &args.data],
        also: &args.also,
    };
    let mut files = ladder_page(&page, &imprint)?;
    for (name, text) in &climb.files {
        files.files.insert(0, (name.clone(), text.clone().into_bytes()));
    }
    let inputs = std::iter::once(named.input.clone()).chain(data.iter().map(|data| data.input.clone()));
    write_files(folder, &files, &inputs.collect::<Vec<_>>(), context)?;
    let names: Vec<&str> = climb.files.iter().map(|(name, _)| name.as_str()).collect();
    let mut notes = vec![format!("scenarios in {}: {}", folder.display(), names.join(", "))];
    let old = earlier_steps(folder, &names);
    if !old.is_empty() {
        notes.push(format!("warning: of an earlier ladder, and not of this one: {}", old.join(", ")));
    }
    notes.push(format!("report: {}", folder.join("report.html").display()));
    Ok(notes)
}

/// Scenarios in the folder that look like steps and are none of these.
fn earlier_steps(folder: &Path, names: &[&str]) -> Vec<String> {
    let entries = std::fs::read_dir(folder).into_iter().flatten();
    let there = entries.filter_map(|entry| entry.ok()?.file_name().into_string().ok());
    let mut old: Vec<String> = there
        .filter(|name| name.starts_with("step-") && name.ends_with(".toml") && !names.contains(&name.as_str()))
        .collect();
    old.sort();
    old
}

/// One step up.
#[derive(Debug, Serialize)]
struct Step {
    added: Vec<Named>,
    indistinguishable: Vec<String>,
    p_value: Option<f64>,
    confidence: Option<Confidence>,
    file: String,
}

/// An effect and its fitted values.
#[derive(Debug, Serialize)]
struct Named {
    effect: String,
    parameters: Vec<ParameterValue>,
}

/// Everything that was found on the way up.
#[derive(Default)]
struct Climb {
    rungs: Vec<Rung>,
    steps: Vec<Step>,
    told: Vec<String>,
    /// Scenario of every step.
    files: Vec<(String, String)>,
    floor_mm: Option<f64>,
    /// Why it ended, for programs and for readers.
    stopped: &'static str,
    ending: String,
    /// The answer with the B of the last scenario, where with a fitted one there is none.
    kept_bending: Option<KeptBending>,
    warnings: Vec<String>,
}

fn climb(
    named: &NamedScenario,
    data: &[Loaded],
    options: &Options,
    most: usize,
    context: &mut Context,
) -> Result<Climb, Failure> {
    let (mut text, mut scenario) = (named.text.clone(), named.scenario.clone());
    let mut climb = Climb::default();
    let mut count = 0;
    loop {
        (context.progress)(&format!("step {}: fitting every effect", climb.steps.len() + 1), None);
        let d = diagnosed(&scenario, data, options)?;
        let ground = Ground::new(&d, &scenario, data);
        if climb.rungs.is_empty() {
            climb.start(&ground, &text, &scenario)?;
        }
        let left_mm = climb.rungs.last().map_or(d.base.systematic_mm, |r| r.training_mm);
        if let Some((stopped, ending)) = end(&d, left_mm, (count, most)) {
            climb.stopped = stopped;
            climb.kept_bending = d.kept_bending.clone();
            climb.ending = ending;
            climb.told.push(climb.ending.clone());
            return Ok(climb);
        }
        count += d.added.len();
        (text, scenario) = climb.step(&ground, &text, &scenario)?;
    }
}

impl Climb {
    fn start(&mut self, ground: &Ground, text: &str, scenario: &Scenario) -> Result<(), Failure> {
        self.rungs = ground.first_rungs();
        self.floor_mm = ground.d.base.noise_floor_mm;
        self.warnings = ground.warnings();
        if let Some(bending) = ground.new_bending(ground.base_bending()) {
            let (calibrated, _) = extended(text, scenario, Some(&bending), &[])?;
            self.files.push(("step-0-calibrated.toml".into(), calibrated));
        }
        Ok(())
    }

    /// Adds what the diagnosis adds; the new text and the scenario it describes.
    fn step(&mut self, ground: &Ground, text: &str, scenario: &Scenario) -> Result<(String, Scenario), Failure> {
        let d = ground.d;
        let rung = ground.verdict_rung();
        let additions: Vec<_> = d.added.iter().map(|a| ground.calibrated(&a.effect, &a.parameters)).collect();
        let bending = ground.new_bending(rung.bending_nm2);
        let (text, scenario) = extended(text, scenario, bending.as_ref(), &additions)?;
        let names: Vec<&str> = d.added.iter().map(|a| a.effect.as_str()).collect();
        let file = format!("step-{}-{}.toml", self.steps.len() + 1, names.join("-"));
        self.told.push(told(self.steps.len() + 1, d));
        self.rungs.push(rung);
        self.files.push((file.clone(), text.clone()));
        let added = d.added.iter().map(|a| Named { effect: a.effect.clone(), parameters: a.parameters.clone() });
        self.steps.push(Step {
            added: added.collect(),
            indistinguishable: d.indistinguishable.clone(),
            p_value: d.p_value,
            confidence: d.confidence,
            file,
        });
        Ok((text, scenario))
    }
}

/// Why not another step, for programs and for readers.
fn end(d: &Diagnosis, left: f64, (count, most): (usize, usize)) -> Option<(&'static str, String)> {
    let sentence = match d.verdict {
        None => {
            let why = format!("{} usable runs: at least three are needed for p-values, so no effect is added", d.runs);
            return Some(("no_p_values", why + "; `ibr diagnose` prints the uncalibrated ranking."));
        }
        Some(Verdict::None) => {
            ("noise", format!("What is left, {left:.2} mm beyond noise, is not significant: noise."))
        }
        Some(_) if left <= d.tolerance_mm && !is_of_supply(d) => {
            let limit = d.tolerance_mm;
            (
                "tolerance",
                format!("What is left, {left:.2} mm, is more than noise but within the tolerance of {limit:.2} mm."),
            )
        }
        Some(Verdict::OutOfCatalog) => {
            let places: Vec<&str> = d.leftover.iter().map(|s| s.sentence.as_str()).collect();
            let places = places.join(" ");
            let of = if count > 0 { " Of the last step's scenario:" } else { "" };
            let kept = d.told_of_kept_bending().map_or(String::new(), |told| format!("{of} {told}"));
            ("out_of_catalog", format!("Nothing in the catalogue explains what is left, {left:.2} mm. {places}{kept}"))
        }
        Some(Verdict::Effect) if count + d.added.len() > most => {
            let names: Vec<&str> = d.added.iter().map(|a| a.effect.as_str()).collect();
            let next = names.join(" and ");
            (
                "most_effects",
                format!(
                    "{left:.2} mm are left and {next} would come next, but {most} effects are the most that is added."
                ),
            )
        }
        Some(Verdict::Effect) => return None,
    };
    Some(sentence)
}

/// Whether it adds to the supply what a gauge has shown, which the positions, predicted at its readings, do not see.
fn is_of_supply(d: &Diagnosis) -> bool {
    !d.gauges.is_empty() && !d.added.is_empty() && d.added.iter().all(|a| a.group == Group::Supply)
}

fn told(number: usize, d: &Diagnosis) -> String {
    let values = |a: &compare::diagnosis::Added| {
        format!("{}, {}", a.effect, a.parameters.iter().map(value).collect::<Vec<_>>().join(", "))
    };
    let names: Vec<String> = d.added.iter().map(values).collect();
    let mut told = format!(
        "Step {number}: {}. {:.2} → {:.2} mm.",
        names.join("; "),
        d.base.systematic_mm,
        d.base.systematic_with_added_mm
    );
    if d.indistinguishable.len() > 1 {
        told.push_str(&format!(
            " The name is one of several that these data cannot tell apart: {}.",
            d.indistinguishable.join(", ")
        ));
    }
    if d.confidence == Some(Confidence::Hint) {
        told.push_str(" A hint only: the evidence is weak.");
    }
    told
}

fn folder(args: &Ladder, dataset: &Dataset, json: bool) -> Option<PathBuf> {
    let plain = |c: char| if c.is_ascii_alphanumeric() || c == '-' { c } else { '-' };
    let name: String = dataset.name.chars().map(plain).collect();
    args.out.clone().or_else(|| (!json).then(|| PathBuf::from(format!("ibr-report/ladder-{name}"))))
}

fn text(climb: &Climb) -> String {
    let mut out = rungs_text(&climb.rungs, climb.floor_mm);
    climb.told.iter().for_each(|s| out.push_str(&format!("  - {s}\n")));
    if climb.steps.len() > 1 {
        out.push_str("Effects of earlier steps keep the values of their step; B is fitted anew on each.\n");
    }
    if climb.rungs.last().is_some_and(|r| r.how_known == Known::Calibrated.word()) && !climb.steps.is_empty() {
        out.push_str("A smaller error does not prove a name: `ibr validate` tries it on data it was not fitted to.\n");
    }
    out
}

fn to_json(args: &Ladder, climb: &Climb) -> Value {
    json!({
        "schema": "ibr.ladder", "version": 1, "scenario_file": args.scenario, "data": args.data, "also": args.also,
        "rungs": climb.rungs, "noise_floor_mm": climb.floor_mm, "steps": climb.steps,
        "stopped": climb.stopped, "ending": climb.ending, "kept_bending": climb.kept_bending,
        "warnings": climb.warnings,
    })
}
