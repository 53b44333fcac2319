use super::inputs::{self, plain};
use crate::cli::LadderArgs;
use crate::prelude::*;
use crate::shown::extension::{LadderAnswer, climb_text};
use compare::ladder::{MOST_EFFECTS, ladder};
use compare::progress::part;
use compare::progress::shares::{CLIMBED, READ};
use ibr::pages::{Climbed, ladder_page};

pub(super) fn run(args: &LadderArgs, context: &mut Context) -> Result<Outcome> {
    args.out.as_deref().map_or(Ok(()), check_folder)?;
    let file = ibr::studies::scenario(&args.scenario)?;
    let evidence = inputs::all_evidence(&file, &args.data, &args.fit, context)?;
    let options = inputs::fit_options(&args.fit)?.without_advice();
    let climb = ladder(&file, &evidence, &options, MOST_EFFECTS, &mut part(context.progress, [READ, CLIMBED]))?;
    let (LadderArgs { scenario, data, .. }, also) = (args, &args.fit.also);
    let answer = LadderAnswer { climb: &climb, scenario_file: scenario, data, also };
    let mut outcome = Outcome::answer(climb_text(&climb), "ibr.ladder", &answer);
    outcome.warn(&climb.warnings);
    let name = &evidence[0].dataset.name;
    let folder = || PathBuf::from(format!("ibr-report/ladder-{}", plain(name)));
    if let Some(folder) = args.out.clone().or_else(|| (!context.json).then(folder)) {
        let page = Climbed { climb: &climb, names: [&file.scenario.name, name], typed: [scenario, data], also };
        // What was found took long, and is printed where it cannot be written.
        if let Err(failure) = report(&folder, &page, &inputs::named(&file, &evidence)?, context, &mut outcome) {
            outcome.fail(&failure);
        }
    }
    Ok(outcome)
}

fn report(folder: &Path, page: &Climbed, inputs: &[Input], context: &mut Context, outcome: &mut Outcome) -> Result<()> {
    write_files(folder, &ladder_page(page, &maker())?, inputs, context)?;
    let names: Vec<&str> = page.climb.files.iter().map(|(name, _)| name.as_str()).collect();
    outcome.notes.push(format!("scenarios in {}: {}", folder.display(), names.join(", ")));
    let old = earlier_steps(folder, &names).join(", ");
    outcome.warn(&(!old.is_empty()).then(|| format!("of an earlier ladder, and not of this one: {old}")));
    outcome.report(folder);
    Ok(())
}

/// Scenarios in the folder that look like steps and are none of these.
fn earlier_steps(folder: &Path, names: &[&str]) -> Vec<String> {
    let entries = std::fs::read_dir(folder).into_iter().flatten();
    let there = entries.filter_map(|entry| entry.ok()?.file_name().into_string().ok());
    let is_old = |n: &String| n.starts_with("step-") && n.ends_with(".toml") && !names.contains(&n.as_str());
    let mut old: Vec<String> = there.filter(is_old).collect();
    old.sort();
    old
}
