//! `ibr diagnose SCENARIO --published`: what the one displacement that the paper prints can tell.

use crate::prelude::*;
use crate::shown::one_number::{OneNumberAnswer, text};
use compare::study::one_number::one_number;
use ibr::pages::one_number_files;
use models::scenario::SHIPPED;

pub(super) fn run(kind: &str, out: Option<&Path>, context: &mut Context) -> Result<Outcome, Failure> {
    out.map_or(Ok(()), check_folder)?;
    if models::shipped(kind).is_none() {
        let message = format!("the paper printed no displacement of `{kind}`");
        let kinds: Vec<&str> = SHIPPED.iter().map(|s| s.0).collect();
        let help = format!("with --published name a robot of the paper; {}", spelling::known(kind, &kinds));
        return Err(Failure::usage(message, help));
    }
    let one = one_number(kind)?;
    let mut outcome = Outcome::answer(text(&one), "ibr.one_number", &OneNumberAnswer { result: &one });
    if let Some(folder) = out {
        write_files(folder, &one_number_files(&one)?, &[], context)?;
        outcome.notes.push(format!("plot: {}", folder.join(format!("one_number_{kind}.png")).display()));
    }
    Ok(outcome)
}
