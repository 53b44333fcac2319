use super::inputs::{self, positive};
use crate::cli::ValidateArgs;
use crate::prelude::*;
use crate::shown::validation::{ValidateAnswer, text};
use compare::validation::BeforeAfter;

pub(super) fn run(args: &ValidateArgs, context: &mut Context) -> Result<Outcome> {
    let sigma_m = positive("--sigma", args.noise.sigma.as_ref())?;
    let file = ibr::studies::scenario(&args.scenario)?;
    let both = BeforeAfter::of(&file, &args.without)?;
    let mut found = Vec::new();
    for spec in &args.data {
        let evidence = inputs::evidence(spec, context)?;
        (context.progress)(&format!("comparing with {spec}"), None);
        found.push(both.judge(&evidence, sigma_m)?);
    }
    let answer = ValidateAnswer::of(&args.scenario, &both, &found);
    let mut outcome = Outcome::answer(text(&args.scenario, &both, &found), "ibr.validate", &answer);
    let warnings = found.iter().flat_map(|v| v.warnings.iter().map(|w| format!("warning: {}: {w}", v.data)));
    outcome.notes.extend(warnings);
    Ok(outcome)
}
