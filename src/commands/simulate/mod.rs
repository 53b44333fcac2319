mod plan;
mod several;

use super::fem_inputs::seconds;
use crate::cli::SimulateArgs;
use crate::prelude::*;
use crate::shown::run::{cost_text, text};
use fem::FemError;
use fem::session::{Cost, Export, FeRun, Further, RunSettings, RunSource, SUMMARY, Solver, Summary, export, simulate};
use ibr::fe_source;
use ibr::pages::run_plots;
use plan::RunPlan;
use std::time::Duration;

pub(super) fn run(args: &SimulateArgs, context: &mut Context) -> Result<Outcome> {
    let plan = plan::plan(args, fe_source(&args.case)?)?;
    if let Some(file) = &args.export {
        return exported(args, &plan, file, context.force);
    }
    let help = "name one mesh and leave separate out, then go on from one run to another";
    let message = "--from goes on with one run, and this is several";
    refuse_if(args.from.is_some() && !matches!(plan, RunPlan::Single(_)), message, help)?;
    let folder = args.out.clone().unwrap_or_else(|| plan.folder(args));
    let settings = RunSettings {
        resume: args.resume,
        from: args.from.clone(),
        keep_end: true,
        force: context.force,
        frames: !args.no_frames,
        files: true,
        end_s: args.end.as_deref().map(|text| seconds("--end", text)).transpose()?,
        threads: context.threads,
        checkpoint_every: Duration::from_secs_f64(seconds("--checkpoint-every", &args.checkpoint_every)?),
        further: Some(run_plots as Further),
        maker: maker(),
        folder: Some(folder.clone()),
    };
    check_folder(&folder)?;
    match plan {
        RunPlan::Single(_) if args.shards.asked() => {
            let help =
                "add --seeds, --uncertain, --set separate=true or several --mesh, or leave --shard and --engine out";
            Err(Failure::usage("one run has no shards", help))
        }
        RunPlan::Single(source) => one(args, &source, &settings, context),
        RunPlan::Table(base, variations) => several::table(&base, &variations, &settings, &args.shards, context),
        RunPlan::Uncertain(cube) => several::uncertain(&cube, args, settings, context),
    }
}

fn exported(args: &SimulateArgs, plan: &RunPlan, file: &Path, force: bool) -> Result<Outcome> {
    let RunPlan::Single(source) = plan else {
        let help = "leave out --seeds, --uncertain and further values of --mesh";
        return Err(Failure::usage("--export writes one run, and this is several", help));
    };
    let help = "give --force to replace it, or another name";
    let message = format!("{} exists already", file.display());
    refuse_if(file.exists() && !force, message, help)?;
    let solver = if args.solver.as_deref() == Some("calculix") { Solver::CalculiX } else { Solver::Abaqus };
    let Export { nodes, elements, notices, left_out } = export(source, file, solver)?;
    let text = format!("{}: {nodes} nodes, {elements} elements\n", file.display());
    let left_out = left_out.into_iter().map(|what| format!("the file does not say: {what}"));
    Ok(Outcome { text, notes: notices.into_iter().chain(left_out).collect(), ..Outcome::default() })
}

fn one(args: &SimulateArgs, source: &RunSource, settings: &RunSettings, context: &mut Context) -> Result<Outcome> {
    let folder = settings.folder.as_deref().unwrap_or(Path::new(""));
    let run = match context.fem(|progress| simulate(source, settings, progress)) {
        Err(FemError::Interrupted { time_s, step, .. }) => {
            let force = if context.force { " --force" } else { "" };
            return Ok(Outcome::interrupted(format!(
                "interrupted at t = {time_s:.6} s, step {step}; go on with: ibr simulate {}{} --out {} --resume{force}",
                args.case,
                typed_again(args),
                folder.display(),
            )));
        }
        other => other?,
    };
    let cost = run.fresh.then_some(&run.cost);
    let answer = SimulateAnswer { summary: &run.summary, cost, folder: cost.map(|_| folder.display().to_string()) };
    let mut outcome = Outcome::new(text(&run.summary), SUMMARY.stamped(&answer));
    if !run.fresh {
        let (time_s, folder) = (run.summary.time_s, folder.display());
        outcome.notes.push(format!(
            "the run in {folder} is complete at t = {time_s:.6} s; nothing was done. A later --end goes on with it"
        ));
        return Ok(outcome);
    }
    outcome.text += &cost_text(&run.cost);
    outcome.notes = notes(&run, folder);
    Ok(outcome)
}

/// `ibr.simulate`: `ibr simulate CASE`
#[derive(Serialize)]
struct SimulateAnswer<'a> {
    #[serde(flatten)]
    summary: &'a Summary,
    /// Processor time, real time and speed of the run
    #[serde(skip_serializing_if = "Option::is_none")]
    cost: Option<&'a Cost>,
    /// Folder in which the run was written
    #[serde(skip_serializing_if = "Option::is_none")]
    folder: Option<String>,
}

/// What to know about a run, and what to open.
fn notes(run: &FeRun, folder: &Path) -> Vec<String> {
    let mut notes = run.notices.clone();
    let there = |name: &&str| folder.join(name).exists();
    let open = |what: &str, name: &str| format!("{what}: {}", folder.join(name).display());
    notes.extend(["side.png", "picture.png"].iter().find(|name| there(name)).map(|name| open("picture", name)));
    notes.push(match there(&"run.pvd") {
        true => open("open in ParaView", "run.pvd"),
        false => open("history", "history.csv"),
    });
    notes
}

fn typed_again(args: &SimulateArgs) -> String {
    let pressure = args.pressure.iter().map(|p| ("pressure", p));
    let others = args.mesh.iter().map(|m| ("mesh", m)).chain(args.changes.set.iter().map(|s| ("set", s)));
    let from = args.from.iter().map(|folder| format!(" --from {}", folder.display()));
    pressure.chain(others).map(|(option, value)| format!(" --{option} {value}")).chain(from).collect()
}
