use super::inputs::{self, plain, positive};
use crate::cli::CompareArgs;
use crate::prelude::*;
use crate::shown::comparison::{CompareAnswer, text};
use compare::Comparison;
use compare::progress::shares::{COMPARED, READ};
use compare::study::comparison::Variant;
use ibr::compared::{Compared, contenders, unused_sigma};
use ibr::pages::compare_page;

pub(super) fn run(args: &CompareArgs, context: &mut Context) -> Result<Outcome> {
    let message = "--runs, --stored and --pressure are about finite element runs";
    let help = "add --engines or --paper, or leave them out";
    refuse_if(args.runs.stored || args.runs.runs.is_some() || args.pressure.is_some(), message, help)?;
    if let Some(outcome) = super::bench_tables::compared(args, context)? {
        return Ok(outcome);
    }
    let (file, data_spec) = both(args)?;
    let limit_m = positive("--max-error", args.max_error.as_ref())?;
    let sigma_m = positive("--sigma", args.noise.sigma.as_ref())?;
    args.out.as_deref().map_or(Ok(()), check_folder)?;
    // Wrong options are refused before data are read.
    inputs::each_once("--effect", inputs::effect_names(&args.effect))?;
    contenders(&file, &args.effect)?;
    let evidence = inputs::evidence(data_spec, context)?;
    (context.progress)("comparing", Some(READ));
    let scenario = if args.inputs.len() == 1 { "its own" } else { &file.name };
    let Compared { found, added } = Compared::of(&file, &evidence, &args.effect, sigma_m, args.calibrate)?;
    let answer = CompareAnswer::of(scenario, &found, added.as_ref());
    let mut outcome = Outcome::answer(text(&answer), "ibr.compare", &answer);
    report(args, (&file, &evidence, &found), &mut outcome, context)?;
    outcome.warn(&found.warnings);
    outcome.notes.extend(unused_sigma(sigma_m, &evidence));
    check_error(&mut outcome, found.variants.last().map_or(0.0, Variant::error_mm), limit_m);
    Ok(outcome)
}

fn report(
    args: &CompareArgs,
    (file, evidence, found): (&ScenarioFile, &Evidence, &Comparison),
    outcome: &mut Outcome,
    context: &mut Context,
) -> Result<()> {
    let folder = format!("ibr-report/compare-{}", plain(&evidence.dataset.name));
    let Some(folder) = args.out.clone().or_else(|| (!context.json).then(|| PathBuf::from(folder))) else {
        return Ok(());
    };
    (context.progress)("drawing the report", Some(COMPARED));
    write_files(&folder, &compare_page(found, &maker())?, &inputs::named(file, [evidence])?, context)?;
    outcome.report(&folder);
    Ok(())
}

/// Ends with another code where the last model misses by more than was allowed.
fn check_error(outcome: &mut Outcome, last_mm: f64, limit_m: Option<f64>) {
    if let Some(limit_mm) = limit_m.map(|m| 1e3 * m).filter(|limit_mm| last_mm > *limit_mm) {
        outcome.notes.push(format!("error beyond noise {last_mm:.2} mm exceeds --max-error {limit_mm:.2} mm"));
        outcome.code = MISSED;
    }
}

/// Scenario and data; data with a scenario of their own may stand alone.
fn both(args: &CompareArgs) -> Result<(ScenarioFile, &str)> {
    match &args.inputs[..] {
        [data] => ScenarioFile::beside(data)?.map(|file| (file, data.as_str())),
        [scenario, data] => Some((ibr::studies::scenario(scenario)?, data.as_str())),
        _ => None,
    }
    .ok_or_else(|| {
        if let [scenario] = &args.inputs[..] {
            return inputs::without_data("compare", scenario);
        }
        let message = format!("ibr compare takes a scenario and data, not {} names", args.inputs.len());
        let help =
            "for example `ibr compare epam synthetic-epam`; `ibr compare spam epam --engines` takes scenarios only";
        Failure::usage(message, help)
    })
}
