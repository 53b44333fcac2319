//! One run in one folder, from its start or its last checkpoint to its summary.

use super::folder::{self, Marker, Opened, Wish, Workplace};
use super::input::Loaded;
use super::stepping::{Ended, Running};
use super::{robot_files, summary, write_failure};
use crate::commands::Context;
use crate::failure::Failure;
use crate::output::{manifest, output, sha256};
use serde_json::Value;
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
    /// Now.
    Now {
        /// The physics, `summary.json`.
        summary: Value,
        /// What it took.
        cost: Value,
        /// What to tell.
        notes: Vec<String>,
    },
    /// It was complete before.
    Before {
        /// The physics, `summary.json`.
        summary: Value,
        /// What it took.
        cost: Value,
    },
    /// The user asked to stop.
    Interrupted {
        /// Time and step reached.
        at: (f64, u64),
        /// What to tell.
        notes: Vec<String>,
    },
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
        Opened::Complete => return before(&manner.folder),
        Opened::Work(place) => place,
    };
    let marker = same_run(&place, marker, manner)?;
    loaded.case.problem.settings.end_s = marker.end_s;
    loaded.case.outputs.frames = marker.frames;
    let robot = loaded.robot.as_ref().map(|robot| robot.watch(&loaded.case.problem));
    let mut running = match &place.interrupted {
        Some(_) => Running::resume(&loaded.case, fresh, &place.folder, robot)?,
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

/// A run that needs nothing more.
fn before(folder: &Path) -> Result<Done, Failure> {
    let read = |name: &str| -> Result<Value, Failure> {
        let path = folder.join(name);
        let text = std::fs::read_to_string(&path).map_err(|cause| write_failure(&path, &cause))?;
        Ok(serde_json::from_str(&text).unwrap_or_default())
    };
    Ok(Done::Before { summary: read("summary.json")?, cost: read("manifest.json")?["cost"].clone() })
}

/// Writes summary, pictures and manifest, and puts the run where it belongs.
fn finish(
    loaded: &Loaded,
    running: Running,
    place: Workplace,
    started: Instant,
    context: &mut Context,
) -> Result<Done, Failure> {
    let found = summary::Summary::of(&loaded.case, &running, loaded.robot.as_ref(), started.elapsed());
    (context.progress)("writing the summary", Some(1.0));
    let mut written = context.written.lock().unwrap_or_else(PoisonError::into_inner);
    let text = format!("{:#}\n", found.physics);
    data::write_atomically(&place.folder.join("summary.json"), text.as_bytes())?;
    let mut picture = running.picture(&place.folder)?;
    if let (Some(robot), Some(seen)) = (&loaded.robot, &running.robot) {
        robot_files::write(robot, seen, &loaded.case.problem.mesh, &running.run, &place.folder)?;
        picture = Some("side.png");
    }
    let outputs: Vec<Value> = place.files()?.iter().map(|(name, bytes)| output(name, bytes)).collect();
    let mut sheet = manifest(&outputs, std::slice::from_ref(&loaded.named.input));
    sheet["cost"] = found.cost.clone();
    let folder = place.target().to_path_buf();
    place.complete(&sheet)?;
    *written = true;
    let mut notes = running.notices.clone();
    notes.extend(picture.map(|name| format!("picture: {}", folder.join(name).display())));
    let (open, file) = match running.has_frames() {
        true => ("open in ParaView", "run.pvd"),
        false => ("history", "history.csv"),
    };
    notes.push(format!("{open}: {}", folder.join(file).display()));
    Ok(Done::Now { summary: found.physics, cost: found.cost, notes })
}
