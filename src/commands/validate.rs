use super::inputs::{self, positive};
use crate::cli::ValidateArgs;
use crate::prelude::*;
use crate::shown::validation::{ValidateAnswer, text};
use compare::foreign::{judge, read_correction};
use compare::validation::{BeforeAfter, Validation};

pub(super) fn run(args: &ValidateArgs, context: &mut Context) -> Result<Outcome> {
    let sigma_m = positive("--sigma", args.noise.sigma.as_ref())?;
    let path = Path::new(&args.scenario);
    if path.extension().is_some_and(|end| end.eq_ignore_ascii_case("csv")) {
        let correction = read_correction(&args.scenario)?;
        let mut bases = inputs::bases(&args.base, args.data.len())?.into_iter();
        let found = each(args, context, |evidence| match bases.next().flatten() {
            Some(base) => Ok(judge(&correction, &base, evidence, sigma_m)?),
            None => {
                let help = "name the other simulator's predictions for these data: --base TABLE";
                Err(Failure::usage("a correction alone predicts nothing", help))
            }
        })?;
        return Ok(answered(&ValidateAnswer::of_correction(&correction, &found)));
    }
    let help = "name the correction that `ibr add … --base TABLE --out correction.csv` wrote in place of the scenario";
    let message = "--base is for a correction of another simulator's predictions";
    refuse_if(!args.base.is_empty(), message, help)?;
    let file = ibr::studies::scenario(&args.scenario)?;
    let both = BeforeAfter::of(&file, &args.without)?;
    let found = each(args, context, |evidence| Ok(both.judge(evidence, sigma_m)?))?;
    Ok(answered(&ValidateAnswer::of(&args.scenario, &both, &found)))
}

fn each(
    args: &ValidateArgs,
    context: &mut Context,
    mut judged: impl FnMut(&Evidence) -> Result<Validation>,
) -> Result<Vec<Validation>> {
    let mut found = Vec::new();
    for spec in &args.data {
        let evidence = inputs::evidence(spec, context)?;
        (context.progress)(&format!("comparing with {spec}"), None);
        found.push(judged(&evidence)?);
    }
    Ok(found)
}

fn answered(answer: &ValidateAnswer) -> Outcome {
    let mut outcome = Outcome::answer(text(answer), "ibr.validate", answer);
    let warnings = answer.datasets.iter().flat_map(|v| v.warnings.iter().map(|w| format!("warning: {}: {w}", v.data)));
    outcome.notes.extend(warnings);
    outcome
}
