//! Tables of bench tests in `ibr compare` and `ibr diagnose`: a beam, a muscle.

use super::inputs;
use crate::cli::{CompareArgs, DiagnoseArgs};
use crate::prelude::*;
use crate::shown::diagnosis_tables::p_text;
use crate::shown::held::{BenchAnswer, HeldTable, text};
use compare::bench::held;
use compare::diagnosis::words::listed;
use compare::diagnosis::{BenchDiagnosis, BenchOptions, BenchRanked, Verdict, diagnose_bench};
use compare::progress::shares::READ;
use compare::study::Knob;
use compare::typed_effect::with_effect;
use data::Bench;
use data::bench::bench;

/// The comparison, if the data are a table of bench tests.
pub(super) fn compared(args: &CompareArgs, context: &mut Context) -> Result<Option<Outcome>> {
    let Some((spec, typed)) = args.inputs.split_last().filter(|(_, before)| before.len() < 2) else {
        return Ok(None);
    };
    let Some(bench) = bench(spec)? else { return Ok(None) };
    let given = [
        ("--sigma", args.noise.sigma.is_some()),
        ("--max-error", args.max_error.is_some()),
        ("--out", args.out.is_some()),
        ("--calibrate=body-pressure", args.calibrate == Some(Knob::BodyPressure)),
    ];
    refuse_options(spec, &given)?;
    (context.progress)("comparing", None);
    let mut scenario = scenario(typed.first(), &bench)?;
    inputs::each_once("--effect", inputs::effect_names(&args.effect))?;
    for text in &args.effect {
        let Some(before) = &scenario else {
            return Err(Failure::usage("--effect without a scenario", "name a scenario before the table"));
        };
        scenario = Some(with_effect(before, text)?.0);
    }
    let held = held(&bench, scenario.as_ref(), args.calibrate.is_some())?;
    let (kind, provenance) = (bench.kind.name, bench.provenance);
    let answer = BenchAnswer { data: spec, kind, provenance, held: HeldTable::of(&held) };
    Ok(Some(Outcome::answer(text(&held), "ibr.compare.bench", &answer)))
}

/// The diagnosis, if what was typed last is a table of bench tests.
pub(super) fn diagnosed(args: &DiagnoseArgs, context: &mut Context) -> Result<Option<Outcome>> {
    let spec = args.data.as_deref().unwrap_or(&args.scenario);
    let Some(table) = bench(spec)? else {
        return args.fit.also.iter().try_for_each(|also| needs_markers(also)).map(|()| None);
    };
    let given = [
        ("--also", !args.fit.also.is_empty()),
        ("--base", !args.fit.base.is_empty()),
        ("--keep-bending", args.fit.keep_bending),
        ("--not", !args.fit.not.is_empty()),
        ("--tolerance", args.fit.tolerance.is_some()),
        ("--runs", args.runs.is_some()),
        ("--out", args.out.is_some()),
    ];
    refuse_options(spec, &given)?;
    let sigma = args.fit.noise.sigma.as_deref().map(share).transpose()?;
    let scenario = scenario(args.data.as_ref().map(|_| &args.scenario), &table)?;
    (context.progress)("fitting every effect", Some(READ));
    let options = BenchOptions { sigma, refit: args.refit, ..BenchOptions::default() };
    let found = diagnose_bench(&table, scenario.as_ref(), &options)?;
    let answer = BenchDiagnosisAnswer { found: &found, provenance: table.provenance };
    Ok(Some(Outcome::answer(diagnosis_text(&found, &table), "ibr.diagnose.bench", &answer)))
}

fn scenario(typed: Option<&String>, bench: &Bench) -> Result<Option<Scenario>> {
    Ok(match (typed, &bench.scenario) {
        (Some(typed), _) => Some(ibr::studies::scenario(typed)?.planar()?.scenario),
        (None, Some((place, text))) => Some(ScenarioFile::parse(place, text)?.planar()?.scenario),
        (None, None) => None,
    })
}

/// Refuses options that are about markers, each with whether it is given.
fn refuse_options(spec: &str, options: &[(&str, bool)]) -> Result<()> {
    let Some((option, _)) = options.iter().find(|(_, given)| *given) else { return Ok(()) };
    let help = match *option {
        "--also" => "put the rows of all tests of one kind into one table",
        "--base" => "a base predicts markers",
        "--calibrate=body-pressure" => "--calibrate fits the number of a table",
        "--keep-bending" => "a table has nothing fitted that was not asked for",
        "--max-error" => "a table has no error beyond noise",
        "--not" => "a table's ranking shows every effect separately",
        "--out" => "a table has no report; --json gives everything that was found",
        "--runs" => "finite elements are compared with robots",
        "--sigma" => "the table has the scatter of a row",
        _ => "say what a row scatters by instead, --sigma 3%",
    };
    let message = format!("{option} is about marker data, {spec} is a table of bench tests");
    Err(Failure::usage(message, format!("leave {option} out: {help}")))
}

/// Refuses a table of bench tests where markers are needed.
fn needs_markers(spec: &str) -> Result<()> {
    match bench(spec)? {
        None => Ok(()),
        Some(bench) => {
            let message = format!("{spec} is a {} table, not markers of a robot", bench.kind.name);
            Err(Failure::usage(message, format!("`ibr compare {spec}` holds it against its model")))
        }
    }
}

/// Reads a percentage as a share: `3%` is 0.03.
fn share(text: &str) -> Result<f64> {
    let value = text.trim().strip_suffix('%').and_then(|number| number.trim().parse::<f64>().ok());
    value.filter(|v| *v > 0.0 && *v <= 100.0).map(|v| 0.01 * v).ok_or_else(|| {
        let message = format!("--sigma {text} is not a share of the measured value");
        Failure::usage(message, "write what a row of the table scatters by in per cent, for example --sigma 3%")
    })
}

/// `ibr.diagnose.bench`: `ibr diagnose TABLE`, a table of bench tests
#[derive(Serialize)]
struct BenchDiagnosisAnswer<'a> {
    #[serde(flatten)]
    found: &'a BenchDiagnosis,
    /// How its numbers came to be
    provenance: Provenance,
}

fn diagnosis_text(d: &BenchDiagnosis, bench: &Bench) -> String {
    let verdict = match d.verdict {
        Some(Verdict::None) => "no missing effect detectable",
        Some(Verdict::Effect) => "an effect is missing",
        Some(Verdict::OutOfCatalog) => "something is missing that no single effect of the catalogue explains",
        None => "none: ranking only",
    };
    let head = format!("{} compared with {}, {} rows ({})", d.scenario, d.table, d.rows, bench.provenance.word());
    let mut out = format!("{head}\n\nVerdict: {verdict}\n{}{}", lines("  - ", &d.summary), ranking(d));
    for r in d.set().filter(|_| d.verdict != Some(Verdict::None)) {
        let BenchRanked { effect, sentence, differs, remedy, .. } = r;
        let group = r.group.word();
        out += &format!("\n{effect} ({group}): {sentence}\n  shows: {differs}\n  check: {remedy}\n");
    }
    out += &format!("\nWhere the model as it is fails:\n{}", lines("  - ", &d.where_it_fails));
    if let Some(best) = d.set().next() {
        out += &format!("\nWhere it fails with {}:\n{}", best.effect, lines("  - ", &d.leftover));
    }
    out
}

fn ranking(d: &BenchDiagnosis) -> String {
    let mark = |r: &&BenchRanked| match (r.in_set && d.verdict != Some(Verdict::None), r.at_bound) {
        (true, _) => "=",
        (false, true) => "!",
        (false, false) => "",
    };
    let mut rows = TextTable::of(&d.ranked)
        .words("", mark)
        .words("effect", |r| &r.effect)
        .words("value, 95 %", |r| listed(&r.parameters))
        .number("off %", 1, |r| 100.0 * r.off);
    for (k, left) in d.left_out.iter().enumerate() {
        rows = rows.number(format!("left-out {} %", left.what), 1, |r| r.left_out.get(k).map(|l| 100.0 * l.off));
    }
    let rows =
        rows.number("gain", 1, |r| r.gain).right("p corrected", |r| r.p_corrected.map_or("–".into(), p_text)).text();
    let percent = |share: f64| number(Some(100.0 * share), 1);
    let base: String = d.left_out.iter().map(|l| format!(", {} at left-out {}s", percent(l.off), l.what)).collect();
    let legend = "= fits as well as the best · ! on a physical bound, rejected";
    format!("\nEach effect alone (model as it is: {} % off{base}):\n{rows}{legend}\n", percent(d.off))
}
