use super::inputs;
use crate::cli::DiagnoseArgs;
use crate::prelude::*;
use crate::shown::diagnosis::{DiagnosisAnswer, text};
use compare::diagnose;
use compare::diagnosis::Options;
use compare::progress::part;
use compare::progress::shares::{DIAGNOSED, READ};
use compare::study::engines::known_runs;
use compare::witness::witness;
use ibr::compared::unused_sigma;
use ibr::pages::{Diagnosed, diagnosis_page, diagnosis_pictures};

pub(super) fn run(args: &DiagnoseArgs, context: &mut Context) -> Result<Outcome> {
    if args.published {
        return super::published::run(&args.scenario, args.out.as_deref(), context);
    }
    if let Some(outcome) = super::bench_tables::diagnosed(args, context)? {
        return Ok(outcome);
    }
    let Some(data) = args.data.as_deref() else {
        return Err(inputs::without_data("diagnose", &args.scenario));
    };
    let fit = &args.fit;
    let options = Options { refit_present: args.refit, ..inputs::fit_options(fit)? };
    let file = ibr::studies::scenario(&args.scenario)?;
    args.out.as_deref().map_or(Ok(()), check_folder)?;
    let evidence = inputs::all_evidence(&file, data, fit, context)?;
    let end = args.out.as_ref().map_or(1.0, |_| DIAGNOSED);
    let diagnosis = diagnose(&file, &evidence, &options, &mut part(context.progress, [READ, end]))?;
    let runs = known_runs(args.runs.as_deref())?;
    let first = &evidence[0];
    let witness = witness(&diagnosis, &file, &first.dataset, first.about.as_ref(), &runs)?;
    let answer = DiagnosisAnswer::of(&diagnosis, witness.as_ref(), &args.scenario);
    let mut outcome = Outcome::answer(text(&diagnosis, witness.as_ref(), args.tables), "ibr.diagnose", &answer);
    let json = outcome.json.as_ref().map_or(Vec::new(), |answer| format!("{answer:#}\n").into_bytes());
    let told_first = |warning: &&String| diagnosis.slips.contains(warning);
    outcome.warn(diagnosis.warnings.iter().filter(|w| !told_first(w)));
    if let (Some(folder), None) = (&args.runs, &witness) {
        let why = "is of this robot at a pressure of the data";
        outcome.notes.push(format!("warning: no finite element run in {} {why}", folder.display()));
    }
    if let Some(folder) = &args.out {
        let also = fit.also.iter().map(|data| format!(" --also {data}"));
        let more = also
            .chain(fit.base.iter().map(|base| format!(" --base {base}")))
            .chain(fit.keep_bending.then(|| " --keep-bending".into()))
            .chain(fit.not.iter().map(|not| format!(" --not {not}")))
            .collect();
        let found = Diagnosed::of(&diagnosis, &file, first, [&args.scenario, data]);
        let found = Diagnosed { witness: witness.as_ref(), more, ..found };
        // What was found took long, and is printed where it cannot be written.
        match report(folder, &found, json, &inputs::named(&file, &evidence)?, context) {
            Ok(()) => outcome.report(folder),
            Err(failure) => outcome.fail(&failure),
        }
    }
    outcome.notes.extend(unused_sigma(options.sigma_m, first));
    Ok(outcome)
}

/// Writes the report and takes away pictures of an earlier one that this one has not.
fn report(folder: &Path, found: &Diagnosed, json: Vec<u8>, inputs: &[Input], context: &mut Context) -> Result<()> {
    let mut files = diagnosis_page(found, &maker(), &mut part(context.progress, [DIAGNOSED, 1.0]))?;
    files.files.insert(0, ("diagnosis.json".into(), json));
    files.retire(&diagnosis_pictures());
    write_files(folder, &files, inputs, context)
}
