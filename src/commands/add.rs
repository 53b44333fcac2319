use super::inputs;
use crate::cli::AddArgs;
use crate::prelude::*;
use crate::shown::extension::{AddAnswer, steps_text};
use compare::diagnosis::taken_away;
use compare::extension::{EffectWish, Extension, add};
use compare::foreign::ForeignCorrection;
use compare::progress::part;
use compare::progress::shares::READ;

pub(super) fn run(args: &AddArgs, context: &mut Context) -> Result<Outcome> {
    let file = ibr::studies::scenario(&args.scenario)?;
    let wish = EffectWish::read(&file, &args.effect, args.data.is_some())?;
    let evidence = match &args.data {
        Some(data) => inputs::all_evidence(&file, data, &args.fit, context)?,
        None if args.fit.also.is_empty() && args.fit.base.is_empty() => Vec::new(),
        None => return Err(Failure::usage("--also or --base without data", "name the first data before them")),
    };
    let options = inputs::fit_options(&args.fit)?.without_advice();
    let found = add(&file, &wish, &evidence, &options, &mut part(context.progress, [READ, 1.0]))?;
    let names: Vec<&str> = found.additions.iter().map(|a| a.name.as_str()).collect();
    let target = target(args, &names.join("-").replace(' ', "-"), context.force)?;
    let correction =
        is_correction(&target).then(|| ForeignCorrection::of(&file, &found, &evidence)?.text()).transpose()?;
    write_whole(&[(target.clone(), correction.as_ref().unwrap_or(&found.file.text))], context)?;
    let target = target.display().to_string();
    let answer = AddAnswer::of(&file, &evidence, &found, &target)?;
    let mut outcome = Outcome::answer(words(args, &found, &target), "ibr.add", &answer);
    outcome.warn(&found.warnings);
    Ok(outcome)
}

/// Whether a file is to hold a correction of another simulator's predictions, in place of a scenario.
fn is_correction(target: &Path) -> bool {
    target.extension().is_some_and(|end| end.eq_ignore_ascii_case("csv"))
}

/// Where the new scenario goes: never onto the old one, and onto another file only with --force.
fn target(args: &AddArgs, names: &str, force: bool) -> Result<PathBuf> {
    let old = Path::new(&args.scenario);
    let stem = old.file_stem().map_or("scenario".into(), |s| s.to_string_lossy().into_owned());
    let file = format!("{stem}-{names}.toml");
    let target = args.out.clone().unwrap_or_else(|| old.with_file_name(&file));
    let shown = target.display();
    let same = |a: &Path, b: &Path| matches!((a.canonicalize(), b.canonicalize()), (Ok(a), Ok(b)) if a == b);
    let (message, help) = match () {
        () if same(&target, old) => {
            let message = format!("{shown} is the scenario itself, which stays as it is");
            (message, "choose another file with --out".to_string())
        }
        () if target.is_dir() => {
            let help = format!("give a file, for example --out {}", target.join(&file).display());
            (format!("{shown} is a folder, not a file"), help)
        }
        () if target.exists() && !force => {
            let help = "choose another file with --out, or replace it with --force";
            (format!("{shown} exists already"), help.into())
        }
        () => return Ok(target),
    };
    Err(Failure::usage(message, help))
}

fn words(args: &AddArgs, found: &Extension, target: &str) -> String {
    let mut out = found.told.iter().map(|s| format!("{s}\n")).collect::<String>();
    if let [.., before, after] = &found.steps[..] {
        out.push_str(&format!("\n{}", steps_text(&found.steps, found.noise_floor_mm)));
        if after.training_mm > before.training_mm {
            out.push_str("The error does not fall with it: this effect is not the missing one, or not by that much.\n");
        }
        // Only what was added can be judged by its own parameters.
        let verb = match found.additions.iter().all(|a| taken_away(&a.name).is_some()) {
            true => "compare",
            false => "validate",
        };
        out.push_str("A smaller error does not prove the name; data the effect was not fitted to do more: ");
        let base = if is_correction(Path::new(target)) { " --base TABLE" } else { "" };
        out.push_str(&format!("`ibr {verb} {target} DATA{base}`\n"));
    }
    out.push_str(&format!("\nwritten: {target}; {} is as it was\n", args.scenario));
    let own = args.data.iter().filter(|_| !is_correction(Path::new(target)));
    own.for_each(|data| out.push_str(&format!("see it: ibr compare {target} {data}\n")));
    out
}
