//! One run in one folder, from its start or its last checkpoint to its summary.

use super::folder::{self, Marker, Opened, Wish, Workplace};
use super::input::Loaded;
use super::robot::Robot;
use super::stepping::{Ended, Running};
use super::summary::{Cost, SUMMARY, Summary};
use super::{robot_files, write_failure};
use crate::commands::Context;
use crate::failure::Failure;
use crate::output::{MANIFEST, manifest, output, sha256};
use serde::Deserialize;
use serde_json::{Value, json};
use std::path::{Path, PathBuf};
use std::sync::PoisonError;
use std::time::{Duration, Instant};

/// How it is run.
#[derive(Debug, Clone)]
pub struct Manner {
    /// Folder.
    pub folder: PathBuf,
    /// Go on with an interrupted run.
    pub resume: bool,
    /// Replace a run.
    pub force: bool,
    /// Write frames.
    pub frames: bool,
    /// Simulated time, if not the case's \[s\].
    pub end_s: Option<f64>,
    /// Threads.
    pub threads: usize,
    /// Real time between checkpoints.
    pub every: Duration,
}

/// How it ended.
pub enum Done {
    /// Now, and what to tell.
    Now(Finished, Vec<String>),
    /// It was complete before.
    Before(Finished),
    /// The user asked to stop.
    Interrupted {
        /// Time and step reached.
        at: (f64, u64),
        /// What to tell.
        notes: Vec<String>,
    },
}

/// A complete run.
#[derive(Debug, Clone)]
pub struct Finished {
    /// The physics, `summary.json`.
    pub summary: Summary,
    /// What it took, of `manifest.json`.
    pub cost: Cost,
}

impl Finished {
    /// Reads the complete run in a folder.
    pub fn read(folder: &Path) -> Result<Finished, Failure> {
        #[derive(Deserialize)]
        struct Made {
            cost: Cost,
        }
        let text = |name: &str| {
            let path = folder.join(name);
            let text = std::fs::read_to_string(&path).map_err(|cause| write_failure(&path, &cause))?;
            Ok::<_, Failure>((path.display().to_string(), text))
        };
        let help =
            format!("delete {} and give the command again: that run is made anew, others are kept", folder.display());
        let (file, summary) = text("summary.json")?;
        let summary = SUMMARY.read(&file, &summary, &help)?;
        let (file, manifest) = text("manifest.json")?;
        Ok(Finished { summary, cost: MANIFEST.read::<Made>(&file, &manifest, &help)?.cost })
    }
}

/// Runs it.
pub fn run(mut loaded: Loaded, manner: &Manner, context: &mut Context) -> Result<Done, Failure> {
    let started = Instant::now();
    let text = loaded.named.text.clone();
    let wish = Wish { folder: &manner.folder, text: &text, resume: manner.resume, force: manner.force };
    let marker = Marker {
        case_sha256: sha256(text.as_bytes()),
        end_s: manner.end_s.unwrap_or(loaded.case.problem.settings.end_s),
        frames: loaded.case.outputs.frames && manner.frames,
    };
    // A problem that cannot be simulated is refused before a folder is touched.
    loaded.case.problem.settings.end_s = marker.end_s;
    loaded.case.problem.settings.threads = manner.threads;
    let fresh = fem::Simulation::new(&loaded.case.problem).map_err(|error| loaded.named.in_case(error))?;
    let place = match folder::open(&wish)? {
        Opened::Complete => return Finished::read(&manner.folder).map(Done::Before),
        Opened::Work(place) => place,
    };
    let marker = same_run(&place, marker, manner)?;
    loaded.case.problem.settings.end_s = marker.end_s;
    loaded.case.outputs.frames = marker.frames;
    let robot = loaded.robot.as_ref().map(|robot| robot.watch(&loaded.case.problem));
    let mut running = match &place.interrupted {
        Some(_) => {
            place.keep_case(&text)?;
            Running::resume(&loaded.case, fresh, &place.folder, robot)?
        }
        None => {
            place.start(&marker, &text)?;
            Running::start(&loaded.case, fresh, &place.folder, robot)?
        }
    };
    context.interrupt.await_one();
    let ended = running.step_on(manner.every, context);
    context.interrupt.let_one_go();
    match ended.map_err(|error| stopped(error, &place))? {
        Ended::Interrupted => {
            Ok(Done::Interrupted { at: (running.run.time_s(), running.run.step()), notes: running.notices })
        }
        Ended::Complete => finish(&loaded, running, place, started, context),
    }
}

/// The run that was asked for, or the interrupted one if the options agree with it.
fn same_run(place: &Workplace, asked: Marker, manner: &Manner) -> Result<Marker, Failure> {
    let Some(begun) = &place.interrupted else { return Ok(asked) };
    if manner.end_s.is_some() && asked.end_s != begun.end_s {
        let message = format!("the interrupted run ends at {} s, not at {} s", begun.end_s, asked.end_s);
        return Err(Failure::usage(message, "leave --end out, or start again with --force"));
    }
    if !manner.frames && begun.frames {
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

/// Writes summary, pictures and manifest, and puts the run where it belongs.
fn finish(
    loaded: &Loaded,
    running: Running,
    place: Workplace,
    started: Instant,
    context: &mut Context,
) -> Result<Done, Failure> {
    let summary = Summary::of(&loaded.case, &running, loaded.robot.as_ref());
    let cost = Cost::of(&loaded.case, &running, started.elapsed());
    (context.progress)("writing the summary", Some(1.0));
    let mut written = context.written.lock().unwrap_or_else(PoisonError::into_inner);
    let text = format!("{:#}\n", SUMMARY.stamped(&summary));
    data::write_atomically(&place.folder.join("summary.json"), text.as_bytes())?;
    let mut picture = running.picture(&place.folder)?;
    if let (Some(robot), Some(seen)) = (&loaded.robot, &running.robot) {
        robot_files::write(robot, seen, &loaded.case.problem.mesh, &running.run, &place.folder)?;
        picture = Some("side.png");
    }
    let outputs: Vec<Value> = place.files()?.iter().map(|(name, bytes)| output(name, bytes)).collect();
    let mut sheet = manifest(&outputs, std::slice::from_ref(&loaded.named.input));
    sheet["cost"] = json!(cost);
    let folder = place.target().to_path_buf();
    let older = place.complete(&sheet)?;
    *written = true;
    let mut notes = running.notices.clone();
    notes.extend(older);
    notes.extend(loaded.robot.as_ref().and_then(Robot::left_out));
    notes.extend(picture.map(|name| format!("picture: {}", folder.join(name).display())));
    let (open, file) = match running.has_frames() {
        true => ("open in ParaView", "run.pvd"),
        false => ("history", "history.csv"),
    };
    notes.push(format!("{open}: {}", folder.join(file).display()));
    Ok(Done::Now(Finished { summary, cost }, notes))
}
