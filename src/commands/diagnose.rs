//! `ibr diagnose`

use super::extend::{short, value};
use super::inputs::{self, diagnosed, positive};
use super::tables::{number, table};
use super::{Context, Outcome};
use crate::cli::Diagnose;
use crate::failure::Failure;
use crate::output::{Input, check_folder, earlier, machine, program, remove_all, today, write_files};
use compare::diagnosis::{Diagnosis, Experiment, Group, Options, Ranked, Verdict};
use compare::study::engines::{TERMS, known_runs};
use compare::study::witness::{HEIGHTS, Witness, witness};
use ibr::pages::{Diagnosed, Imprint, diagnosis_page, diagnosis_pictures};
use serde_json::{Value, json};
use std::path::Path;

pub fn run(args: &Diagnose, context: &mut Context) -> Result<Outcome, Failure> {
    if args.published {
        return super::published::run(&args.scenario, args.out.as_deref(), context);
    }
    if let Some(outcome) = super::diagnose_bench::run(args, context)? {
        return Ok(outcome);
    }
    let Some(data) = args.data.as_deref() else {
        let message = format!("{} alone is no table of bench tests, and markers need a scenario", args.scenario);
        let help = "for example `ibr diagnose epam synthetic-epam`, `ibr diagnose festo-bolen-2026`, `ibr diagnose epam --published`";
        return Err(Failure::usage(message, help));
    };
    let sigma_m = args.sigma.as_deref().map(|t| positive("--sigma", t)).transpose()?;
    let tolerance_m = args.tolerance.as_deref().map(|t| positive("--tolerance", t)).transpose()?;
    let named = inputs::scenario(&args.scenario)?;
    args.out.as_deref().map_or(Ok(()), check_folder)?;
    let loaded = inputs::datasets(data, &args.also, context)?;
    let inputs::Loaded { dataset, about, .. } = &loaded[0];
    (context.progress)("fitting every effect", None);
    let options = Options {
        sigma_m,
        tolerance_m,
        refit_present: args.refit,
        keep_bending: args.keep_bending,
        ..Options::default()
    };
    let diagnosis = diagnosed(&named.scenario, &loaded, &options)?;
    let runs = known_runs(args.runs.as_deref())?;
    let witness = witness(&diagnosis, &named.scenario, dataset, about.as_ref(), &runs)?;
    let answer = to_json(&args.scenario, &loaded, &diagnosis, witness.as_ref());
    let file = format!("{answer:#}\n").into_bytes();
    let mut outcome = Outcome::new(text(&diagnosis, witness.as_ref()), answer);
    let told_first = |warning: &&String| diagnosis.slips.contains(warning);
    outcome.notes.extend(diagnosis.warnings.iter().filter(|w| !told_first(w)).map(|w| format!("warning: {w}")));
    if let (Some(folder), None) = (&args.runs, &witness) {
        let why = "is of this robot at a pressure of the data";
        outcome.notes.push(format!("warning: no finite element run in {} {why}", folder.display()));
    }
    if let Some(folder) = &args.out {
        (context.progress)("drawing the report", None);
        let found = Diagnosed {
            diagnosis: &diagnosis,
            scenario: &named.scenario,
            dataset,
            about: about.as_ref(),
            witness: witness.as_ref(),
            typed: [&args.scenario, data],
            more: more(args),
        };
        let inputs: Vec<_> = std::iter::once(&named.input).chain(loaded.iter().map(|l| &l.input)).cloned().collect();
        // What was found took long, and is printed where it cannot be written.
        match report(folder, &found, file, &inputs, context) {
            Ok(()) => outcome.notes.push(format!("report: {}", folder.join("report.html").display())),
            Err(failure) => outcome.fail(&failure),
        }
    }
    if args.sigma.is_some() && dataset.runs.len() > 1 {
        outcome.notes.push(
            "warning: --sigma is for a single run and was not used: several runs show the noise themselves".into(),
        );
    }
    Ok(outcome)
}

/// Writes the report and takes away pictures of an earlier one that this one has not.
fn report(
    folder: &Path,
    found: &Diagnosed,
    json: Vec<u8>,
    inputs: &[Input],
    context: &mut Context,
) -> Result<(), Failure> {
    let imprint = Imprint { program: program(), date: today(), machine: machine() };
    let mut files = diagnosis_page(found, &imprint)?;
    files.files.insert(0, ("diagnosis.json".into(), json));
    let pictures = diagnosis_pictures().into_iter().flat_map(|name| [format!("{name}.svg"), format!("{name}.png")]);
    let old = earlier(folder, &pictures.collect::<Vec<_>>());
    write_files(folder, &files, inputs, context)?;
    remove_all(folder, old.iter().filter(|name| files.files.iter().all(|(made, _)| made != *name)))
}

/// What the commands that come next need of what was typed.
fn more(args: &Diagnose) -> String {
    let also = args.also.iter().map(|data| format!(" --also {data}"));
    also.chain(args.keep_bending.then(|| " --keep-bending".into())).collect()
}

fn to_json(scenario: &str, data: &[inputs::Loaded], diagnosis: &Diagnosis, witness: Option<&Witness>) -> Value {
    let mut value = json!(diagnosis);
    if let Some(object) = value.as_object_mut() {
        object.insert("schema".into(), "ibr.diagnose".into());
        object.insert("version".into(), 1.into());
        object.insert("finite_elements".into(), json!(witness));
        object.insert("scenario_file".into(), scenario.into());
        object.insert("data_sha256".into(), data.iter().map(|data| data.input.sha256.clone()).collect());
    }
    value
}

fn text(d: &Diagnosis, witness: Option<&Witness>) -> String {
    let mut out = format!("{} held against {}, {} runs\n{}\n\n", d.scenario, d.dataset, d.runs, d.noise.sentence);
    let verdict = match d.verdict {
        Some(Verdict::None) => "no missing effect detectable",
        Some(Verdict::Effect) => "an effect is missing",
        Some(Verdict::OutOfCatalog) if d.is_either() => {
            "something is missing: a fault that is not in the catalogue, or effects"
        }
        Some(Verdict::OutOfCatalog) => "something is missing that is not in the catalogue",
        None => "none: ranking only",
    };
    d.slips.iter().for_each(|slip| out.push_str(&format!("Before the verdict, look at the data. {slip}\n\n")));
    out.push_str(&format!("Verdict: {verdict}\n"));
    d.summary.iter().for_each(|s| out.push_str(&format!("  - {s}\n")));
    out.push_str(&ranking(d));
    out.push_str(&pairs(d));
    out.push_str(&details(d));
    out.push_str(&witness.map(finite_elements).unwrap_or_default());
    out.push_str(&unseen(d));
    out.push_str(&experiments(d));
    out
}

fn ranking(d: &Diagnosis) -> String {
    let blocks = [("Supply and measurement, to be ruled out first", true), ("Physics and loads", false)];
    let mut out = String::new();
    for (title, nuisance) in blocks {
        let chosen = d.ranked.iter().filter(|r| r.group.is_nuisance() == nuisance);
        let rows: Vec<Vec<String>> = chosen.map(|r| row(d, r)).collect();
        if !rows.is_empty() {
            out.push_str(&format!("\n{title} (base: {:.2} mm beyond noise):\n", d.base.systematic_mm));
            out.push_str(&table(&HEAD, 3, rows));
        }
    }
    out.push_str("= cannot be told from the best · ! on a physical bound, rejected\n");
    out
}

const HEAD: [&str; 8] =
    ["", "effect", "value, 95 %", "after mm", "held-out pressure mm", "held-out run mm", "gain", "p corrected"];

fn row(d: &Diagnosis, r: &Ranked) -> Vec<String> {
    // Where pairs are stated, no single effect is.
    let alike = r.in_set && d.verdict != Some(Verdict::None) && d.pairs.is_empty();
    let mark = match (alike, r.at_bound) {
        (_, true) => "!",
        (true, _) => "=",
        _ => "",
    };
    let values: Vec<String> = r.parameters.iter().map(value).collect();
    vec![
        mark.into(),
        r.effect.clone(),
        values.join(", "),
        format!("{:.2}", r.systematic_after_mm),
        number(r.heldout_mm, 2),
        number(r.heldout_run_mm, 2),
        format!("{:.0}", r.gain),
        r.p_corrected.map_or("–".into(), p_text),
    ]
}

pub fn p_text(p: f64) -> String {
    match p {
        p if p <= 1e-6 => "< 1e-6".into(),
        p if p < 1e-3 => format!("{p:.0e}"),
        p => format!("{p:.3}"),
    }
}

fn pairs(d: &Diagnosis) -> String {
    if d.pairs.is_empty() {
        return String::new();
    }
    let row = |p: &compare::diagnosis::Combination| {
        vec![
            if p.in_set { "=" } else { "" }.to_string(),
            p.effects.join(" + "),
            p.parameters.iter().map(value).collect::<Vec<_>>().join(", "),
            format!("{:.2}", p.systematic_after_mm),
            format!("{:.0}", p.gain),
            p.p_corrected.map_or("–".into(), p_text),
            if p.cancels { "the two cancel" } else { "" }.to_string(),
        ]
    };
    let head = ["", "pair", "values, 95 %", "after mm", "gain", "p over one", ""];
    format!("\nPairs:\n{}", table(&head, 3, d.pairs.iter().map(row).collect()))
}

/// Sentences, remedies and cautions of the set, and where the final model still fails.
fn details(d: &Diagnosis) -> String {
    let mut out = String::new();
    if d.verdict == Some(Verdict::None) {
        return out;
    }
    let told = |r: &Ranked| d.speaks_of(&r.effect) || r.in_set && d.pairs.is_empty();
    // Notes of an effect's own fit are no notes of a pair's.
    let notes = |r: &Ranked| if d.pairs.is_empty() { r.notes.clone() } else { Vec::new() };
    for r in d.ranked.iter().filter(|r| told(r)) {
        out.push_str(&format!(
            "\n{} ({}): {}\n  shows: {}\n  check: {}\n",
            r.effect,
            r.group.word(),
            r.sentence,
            r.differs,
            r.remedy
        ));
        notes(r).iter().for_each(|n| out.push_str(&format!("  note: {n}\n")));
    }
    for r in d.ranked.iter().filter(|r| r.at_bound && !told(r) && r.group != Group::Load) {
        out.push_str(&format!("\n{}: {}\n", r.effect, r.notes.first().cloned().unwrap_or_default()));
    }
    out.push_str("\nWhere the final model still fails:\n");
    d.leftover.iter().for_each(|s| out.push_str(&format!("  - {}\n", s.sentence)));
    out
}

fn finite_elements(w: &Witness) -> String {
    let mut out = "\nThe same robot in finite elements:\n".to_string();
    w.sentences.iter().for_each(|s| out.push_str(&format!("  - {s}\n")));
    out.push_str(&table(&HEIGHTS, 1, w.height_rows()));
    if w.fe_mj.is_some() {
        let mut head = vec!["energies mJ"];
        head.extend(TERMS);
        head.push("apart");
        out.push_str(&table(&head, 1, w.ledger_rows()));
    }
    out
}

fn unseen(d: &Diagnosis) -> String {
    let rows = d.undetectable.iter().map(|u| {
        let size = u
            .smallest_detectable
            .map_or(if d.noise.camera_mm.is_some() { "not within its bounds" } else { "not known" }.into(), |s| {
                inputs::with_unit(&short(s), &u.unit)
            });
        vec![u.effect.clone(), size, number(u.times_typical, 2)]
    });
    let mut out = "\nEffects not found; smallest size that would have been seen (90 %):\n".to_string();
    out.push_str(&table(&["effect", "size", "times typical"], 1, rows.collect()));
    d.limits.iter().for_each(|l| out.push_str(&format!("note: {l}\n")));
    out
}

fn experiments(d: &Diagnosis) -> String {
    let Some(next) = d.next_experiment.as_ref().filter(|next| !next.tried.is_empty()) else { return String::new() };
    let lambda = |e: &Experiment| -> Vec<String> { e.separations.iter().map(|s| format!("{:.1}", s.lambda)).collect() };
    let now = next.now.iter().map(|s| format!("{:.1}", s.lambda));
    let at_hand = ["data at hand".to_string(), "–".to_string(), format!("{:.0}", next.needed_now)];
    let mut rows = vec![at_hand.into_iter().chain(now).collect::<Vec<_>>()];
    rows.extend(next.tried.iter().map(|e| {
        [e.name.clone(), e.shown_protocol().to_string(), format!("{:.0}", e.needed)]
            .into_iter()
            .chain(lambda(e))
            .collect::<Vec<_>>()
    }));
    let mut head = vec!["experiment".to_string(), "protocol [kPa]".to_string(), "suffices".to_string()];
    head.extend(next.now.iter().map(|s| s.rival.clone()));
    let head: Vec<&str> = head.iter().map(String::as_str).collect();
    format!("\nExpected separation λ of {} from:\n{}", next.best, table(&head, 2, rows))
}
