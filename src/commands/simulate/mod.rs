//! `ibr simulate`

mod folder;
mod input;
mod stepping;
mod summary;

use super::{Context, Outcome};
use crate::cli::Simulate;
use crate::failure::{Failure, INTERRUPTED};
use crate::output::{check_folder, manifest, output, sha256};
use folder::{Marker, Opened, Wish, Workplace};
use serde_json::{Value, json};
use std::path::{Path, PathBuf};
use std::sync::PoisonError;
use std::time::{Duration, Instant};
use stepping::{Ended, Running};

pub fn run(args: &Simulate, context: &mut Context) -> Result<Outcome, Failure> {
    let started = Instant::now();
    let every = Duration::from_secs_f64(input::seconds("--checkpoint-every", &args.checkpoint_every)?);
    let end_s = args.end.as_deref().map(|text| input::seconds("--end", text)).transpose()?;
    let (named, mut case) = input::case(&args.case)?;
    let folder = args.out.clone().unwrap_or_else(|| default_folder(&args.case));
    check_folder(&folder)?;
    let wish = Wish { folder: &folder, text: &named.text, resume: args.resume, force: args.force };
    let marker = Marker {
        case_sha256: sha256(named.text.as_bytes()),
        end_s: end_s.unwrap_or(case.problem.settings.end_s),
        frames: case.outputs.frames && !args.no_frames,
    };
    // A problem that cannot be simulated is refused before a folder is touched.
    case.problem.settings.end_s = marker.end_s;
    case.problem.settings.threads = args.threads as usize;
    let fresh = fem::Simulation::new(&case.problem).map_err(|error| named.in_case(error))?;
    let place = match folder::open(&wish)? {
        Opened::Complete => return complete(&folder),
        Opened::Work(place) => place,
    };
    let marker = same_run(&place, marker, args)?;
    case.problem.settings.end_s = marker.end_s;
    case.outputs.frames = marker.frames;
    let mut running = match &place.interrupted {
        Some(_) => Running::resume(&case, fresh, &place.folder)?,
        None => {
            place.start(&marker, &named.text)?;
            Running::start(&case, fresh, &place.folder)?
        }
    };
    context.interrupt.set_awaited(true);
    let ended = running.step_on(every, context);
    context.interrupt.set_awaited(false);
    match ended.map_err(|error| stopped(error, &place))? {
        Ended::Interrupted => Ok(interrupted(args, &running, &folder)),
        Ended::Complete => {
            let found = summary::Summary::of(&case, &running, started.elapsed())?;
            finish(found, running, place, &[named.input], &folder, context)
        }
    }
}

/// The folder of a case if none is named.
fn default_folder(case: &str) -> PathBuf {
    let stem = Path::new(case).file_stem().unwrap_or_default().to_string_lossy();
    let name: String = stem.chars().map(|c| if c.is_ascii_alphanumeric() || c == '-' { c } else { '-' }).collect();
    PathBuf::from(format!("ibr-report/simulate-{name}"))
}

/// The run that was asked for, or the interrupted one if the options agree with it.
fn same_run(place: &Workplace, asked: Marker, args: &Simulate) -> Result<Marker, Failure> {
    let Some(begun) = &place.interrupted else { return Ok(asked) };
    if args.end.is_some() && asked.end_s != begun.end_s {
        let message = format!("the interrupted run ends at {} s, not at {} s", begun.end_s, asked.end_s);
        return Err(Failure::usage(message, "leave --end out, or start again with --force"));
    }
    if args.no_frames && begun.frames {
        let message = "the interrupted run writes frames";
        return Err(Failure::usage(message, "leave --no-frames out, or start again with --force"));
    }
    Ok(begun.clone())
}

/// A run that was stopped keeps what it has written.
fn stopped(error: Failure, place: &Workplace) -> Failure {
    match error {
        Failure::Fem(error @ fem::FemError::Stopped { .. }) => {
            Failure::Stopped { error, folder: place.folder.display().to_string() }
        }
        other => other,
    }
}

fn interrupted(args: &Simulate, running: &Running, folder: &Path) -> Outcome {
    let force = if args.force { " --force" } else { "" };
    let mut notes = running.notices.clone();
    notes.push(format!(
        "interrupted at t = {:.6} s, step {}; go on with: ibr simulate {} --out {} --resume{force}",
        running.run.time_s(),
        running.run.step(),
        args.case,
        folder.display()
    ));
    Outcome { notes, code: INTERRUPTED, ..Outcome::default() }
}

/// `--resume` of a run that needs nothing more.
fn complete(folder: &Path) -> Result<Outcome, Failure> {
    let path = folder.join("summary.json");
    let text = std::fs::read_to_string(&path).map_err(|cause| write_failure(&path, &cause))?;
    let value: Value = serde_json::from_str(&text).unwrap_or_default();
    let mut outcome = Outcome::new(summary::text(&value), value);
    outcome.notes.push(format!("the run in {} is complete; nothing was done", folder.display()));
    Ok(outcome)
}

/// Writes summary, picture and manifest, and puts the run where it belongs.
fn finish(
    found: summary::Summary,
    running: Running,
    place: Workplace,
    inputs: &[crate::output::Input],
    folder: &Path,
    context: &mut Context,
) -> Result<Outcome, Failure> {
    (context.progress)("writing the summary", Some(1.0));
    let mut written = context.written.lock().unwrap_or_else(PoisonError::into_inner);
    let text = format!("{:#}\n", found.physics);
    data::write_atomically(&place.folder.join("summary.json"), text.as_bytes())?;
    let picture = running.picture(&place.folder)?;
    let outputs: Vec<Value> = place.files()?.iter().map(|(name, bytes)| output(name, bytes)).collect();
    let mut sheet = manifest(&outputs, inputs);
    sheet["cost"] = found.cost.clone();
    place.complete(&sheet)?;
    *written = true;
    let mut answer = found.physics;
    let mut outcome = Outcome { text: summary::text(&answer), notes: running.notices.clone(), ..Outcome::default() };
    outcome.text.push_str(&summary::cost_text(&found.cost));
    answer["cost"] = found.cost;
    answer["folder"] = json!(folder.display().to_string());
    outcome.json = Some(answer);
    if let Some(name) = picture {
        outcome.notes.push(format!("picture: {}", folder.join(name).display()));
    }
    let open = if running.has_frames() { "open in ParaView" } else { "history" };
    let file = if running.has_frames() { "run.pvd" } else { "history.csv" };
    outcome.notes.push(format!("{open}: {}", folder.join(file).display()));
    Ok(outcome)
}

/// A file of the run that cannot be written, or read back.
fn write_failure(path: &Path, cause: &std::io::Error) -> Failure {
    Failure::Write {
        path: path.display().to_string(),
        cause: cause.to_string(),
        help: "choose another folder with --out".into(),
    }
}
