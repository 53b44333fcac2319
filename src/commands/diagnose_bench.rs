//! `ibr diagnose` of a table of bench tests: a beam, a muscle.

use super::{held, inputs};
use crate::cli::DiagnoseArgs;
use crate::prelude::*;
use crate::shown::bench_diagnosis::{BenchDiagnosisAnswer, text};
use compare::diagnosis::{BenchOptions, diagnose_bench};
use compare::progress::shares::READ;

/// The diagnosis, if what was typed last is a table of bench tests.
pub(super) fn run(args: &DiagnoseArgs, context: &mut Context) -> Result<Option<Outcome>, Failure> {
    let spec = args.data.as_deref().unwrap_or(&args.scenario);
    let Some(bench) = data::bench::bench(spec)? else {
        return args.fit.also.iter().try_for_each(|also| held::needs_markers(also)).map(|()| None);
    };
    refuse_options(args, spec)?;
    let sigma = args.fit.noise.sigma.as_deref().map(share).transpose()?;
    let scenario = match (&args.data, &bench.scenario) {
        (Some(_), _) => Some(inputs::scenario(&args.scenario)?.scenario),
        (None, Some(text)) => Some(held::own(spec, text)?),
        (None, None) => None,
    };
    (context.progress)("fitting every effect", Some(READ));
    let options = BenchOptions { sigma, refit: args.refit, ..BenchOptions::default() };
    let found = diagnose_bench(&bench, scenario.as_ref(), &options)?;
    let answer = BenchDiagnosisAnswer { found: &found, provenance: bench.provenance };
    Ok(Some(Outcome::answer(text(&found, &bench), "ibr.diagnose.bench", &answer)))
}

/// What is about markers, and what to do instead.
fn refuse_options(args: &DiagnoseArgs, spec: &str) -> Result<(), Failure> {
    let given = [
        ("--also", !args.fit.also.is_empty(), "put the rows of all tests of one kind into one table"),
        ("--keep-bending", args.fit.keep_bending, "a table has nothing fitted that was not asked for"),
        ("--not", !args.fit.not.is_empty(), "a table's ranking shows every effect by itself"),
        ("--tolerance", args.fit.tolerance.is_some(), "say what a row scatters by instead, --sigma 3%"),
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
