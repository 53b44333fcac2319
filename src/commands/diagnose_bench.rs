//! `ibr diagnose` of a table of bench tests: a beam, a muscle.

use super::extend::value;
use super::tables::{number, table};
use super::{Context, Outcome, held, inputs};
use crate::cli::Diagnose;
use crate::failure::Failure;
use compare::diagnosis::{BenchDiagnosis, BenchOptions, BenchRanked, Verdict, diagnose_bench};
use data::Bench;
use serde_json::json;

/// The diagnosis, if what was typed last is a table of bench tests.
pub fn run(args: &Diagnose, context: &mut Context) -> Result<Option<Outcome>, Failure> {
    let spec = args.data.as_deref().unwrap_or(&args.scenario);
    let Some(bench) = data::bench::bench(spec)? else {
        return args.also.iter().try_for_each(|also| held::needs_markers(also)).map(|()| None);
    };
    refuse_options(args, spec)?;
    let sigma = args.sigma.as_deref().map(share).transpose()?;
    let scenario = match (&args.data, &bench.scenario) {
        (Some(_), _) => Some(inputs::scenario(&args.scenario)?.scenario),
        (None, Some(text)) => Some(held::own(spec, text)?),
        (None, None) => None,
    };
    (context.progress)("fitting every effect", None);
    let options = BenchOptions { sigma, refit: args.refit, ..BenchOptions::default() };
    let found = diagnose_bench(&bench, scenario.as_ref(), &options)?;
    let mut answer = json!(found);
    if let Some(object) = answer.as_object_mut() {
        object.insert("schema".into(), "ibr.diagnose.bench".into());
        object.insert("version".into(), 1.into());
        object.insert("provenance".into(), bench.provenance.word().into());
    }
    Ok(Some(Outcome::new(text(&found, &bench), answer)))
}

/// What is about markers, and what to do instead.
fn refuse_options(args: &Diagnose, spec: &str) -> Result<(), Failure> {
    let given = [
        ("--also", !args.also.is_empty(), "put the rows of all tests of one kind into one table"),
        ("--keep-bending", args.keep_bending, "a table has nothing fitted that was not asked for"),
        ("--tolerance", args.tolerance.is_some(), "say what a row scatters by instead, --sigma 3%"),
        ("--runs", args.runs.is_some(), "finite elements are held against robots"),
        ("--out", args.out.is_some(), "a table has no report; --json gives everything that was found"),
    ];
    match given.iter().find(|(_, given, _)| *given) {
        None => Ok(()),
        Some((option, _, help)) => {
            let message = format!("{option} is about marker data, {spec} is a table of bench tests");
            Err(Failure::usage(message, format!("leave {option} out: {help}")))
        }
    }
}

/// `3%` → 0.03.
fn share(text: &str) -> Result<f64, Failure> {
    let value = text.trim().strip_suffix('%').and_then(|number| number.trim().parse::<f64>().ok());
    value.filter(|v| *v > 0.0 && *v <= 100.0).map(|v| 0.01 * v).ok_or_else(|| {
        let message = format!("--sigma {text} is no share of what a row measured");
        Failure::usage(message, "write what a row of the table scatters by in per cent, for example --sigma 3%")
    })
}

fn text(d: &BenchDiagnosis, bench: &Bench) -> String {
    let mut out = format!("{} held against {}, {} rows ({})\n\n", d.scenario, d.table, d.rows, bench.provenance.word());
    let verdict = match d.verdict {
        Some(Verdict::None) => "no missing effect detectable",
        Some(Verdict::Effect) => "an effect is missing",
        Some(Verdict::OutOfCatalog) => "something is missing that no single effect of the catalogue explains",
        None => "none: ranking only",
    };
    out.push_str(&format!("Verdict: {verdict}\n"));
    d.summary.iter().for_each(|s| out.push_str(&format!("  - {s}\n")));
    out.push_str(&ranking(d));
    for r in d.set().filter(|_| d.verdict != Some(Verdict::None)) {
        let BenchRanked { effect, sentence, differs, remedy, .. } = r;
        let group = r.group.word();
        out.push_str(&format!("\n{effect} ({group}): {sentence}\n  shows: {differs}\n  check: {remedy}\n"));
    }
    out.push_str("\nWhere the model as it is fails:\n");
    d.where_it_fails.iter().for_each(|s| out.push_str(&format!("  - {s}\n")));
    if let Some(best) = d.set().next() {
        out.push_str(&format!("\nWhere it fails with {}:\n", best.effect));
        d.leftover.iter().for_each(|s| out.push_str(&format!("  - {s}\n")));
    }
    out
}

fn ranking(d: &BenchDiagnosis) -> String {
    let percent = |share: f64| number(Some(100.0 * share).filter(|v| v.is_finite()), 1);
    let left_out = d.left_out.iter().map(|l| format!("left-out {} %", l.what));
    let head: Vec<String> = ["", "effect", "value, 95 %", "off %"]
        .map(String::from)
        .into_iter()
        .chain(left_out)
        .chain(["gain", "p corrected"].map(String::from))
        .collect();
    let row = |r: &BenchRanked| {
        let mark = if r.at_bound { "!" } else { "" };
        let mark = if r.in_set && d.verdict != Some(Verdict::None) { "=" } else { mark };
        let values = r.parameters.iter().map(value).collect::<Vec<_>>().join(", ");
        let mut cells = vec![mark.to_string(), r.effect.clone(), values, percent(r.off)];
        cells.extend(r.left_out.iter().map(|l| percent(l.off)));
        cells.extend([format!("{:.1}", r.gain), r.p_corrected.map_or("–".into(), super::diagnose::p_text)]);
        cells
    };
    let base: Vec<String> =
        d.left_out.iter().map(|l| format!(", {} at left-out {}s", percent(l.off), l.what)).collect();
    let head: Vec<&str> = head.iter().map(String::as_str).collect();
    let rows = table(&head, 3, d.ranked.iter().map(row).collect());
    let legend = "= cannot be told from the best · ! on a physical bound, rejected";
    format!("\nEach effect alone (model as it is: {} % off{}):\n{rows}{legend}\n", percent(d.off), base.concat())
}
