use crate::prelude::*;
use crate::shown::demo::{DemoAnswer, text};
use compare::demo::demo;
use compare::progress::part;
use compare::progress::shares::SHOWN;
use ibr::pages::demo_page;

pub(super) fn run(folder: &Path, context: &mut Context) -> Result<Outcome> {
    check_folder(folder)?;
    let computed = demo(&mut part(context.progress, [0.0, SHOWN]))?;
    (context.say)(&text(&computed));
    let files = demo_page(&computed, &maker(), &mut part(context.progress, [SHOWN, 1.0]))?;
    write_files(folder, &files, &[], context)?;
    let mut outcome = Outcome::answer(String::new(), "ibr.demo", &DemoAnswer::of(&computed));
    outcome.report(folder);
    Ok(outcome)
}
