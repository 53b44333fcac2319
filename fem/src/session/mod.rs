//! A finite element run from its text to its result: the same for a program, a library and a browser.
//!
//! ```no_run
//! use fem::session::{RunSettings, RunSource, simulate};
//! use std::ops::ControlFlow;
//!
//! let robot = RunSource::new("epam", models::shipped("epam").unwrap());
//! let settings = RunSettings { folder: Some("epam-run".into()), resume: true, ..RunSettings::default() };
//! let run = simulate(&robot, &settings, &mut |what, _share| {
//!     println!("{what}");
//!     ControlFlow::Continue(())
//! })?;
//! for reading in run.readings() {
//!     println!("{} Pa: tip at {:?}", reading.actuator_pa, reading.moved_m.last());
//! }
//! # Ok::<(), fem::FemError>(())
//! ```
//!
//! A run in a folder is marked as unfinished until its last file is written; killed at any moment it can go on with
//! [`RunSettings::resume`], and ends with the same bits.

mod common;
mod export;
mod folder;
mod goes_on;
mod manifest;
mod many;
mod memory;
mod plan;
mod robot_files;
mod run;
mod source;
mod stepping;
mod summary;
mod table;
mod together;
mod watch;

pub use common::{Progress, rounded};
pub use export::{Export, Solver, export};
pub use folder::is_finished;
pub use manifest::{FileHash, MANIFEST, Maker, Manifest, sha256};
pub use many::{Many, RunJob, Shard, finished_below, problems, simulate_all, simulate_each, simulate_job};
pub use memory::least_bytes;
pub use plan::{AS_IT_IS, Changes, Cube, Felt, Variation, cube, felt, mesh_keys, numerics, pressures_in_toml, product};
pub use run::{FeRun, Further, RunSettings};
pub use source::{Loaded, RunSource};
pub use summary::{
    ChamberEnd, Cost, EnergyLine, KineticShares, MeshQuality, ProbeEnd, ReactionEnd, Rule, SUMMARY, Summary,
};
pub use table::{Heights, RunRow, RunTable, SeedGroup};
pub use watch::{RobotSummary, WatchedRobot};

use crate::robot::Reading;
pub use crate::run::{FirstThrough, Through};
use crate::{FemError, Result, Simulation};
use folder::{RunIdentity, Workplace};
use goes_on::Earlier;
use std::time::Instant;
use stepping::Running;

/// Runs it, from its start or its last checkpoint to its summary.
///
/// # Errors
/// [`FemError::Refused`] for a text that describes no sound problem, before a folder is touched; [`FemError::Folder`] for a
/// folder that holds something else; [`FemError::StoppedIn`] by a guard; [`FemError::Interrupted`] if `progress` asked to
/// end: a checkpoint is written then.
pub fn simulate(source: &RunSource, settings: &RunSettings, progress: Progress) -> Result<FeRun> {
    let started = Instant::now();
    let earlier = settings.from.as_deref().map(Earlier::read).transpose()?;
    let mut loaded = source.load_after(earlier.as_ref().map(|earlier| (earlier.time_s, &earlier.end.loads)))?;
    let numerics = &mut loaded.case.problem.settings;
    numerics.end_s = settings.end_s.unwrap_or(numerics.end_s);
    numerics.threads = settings.threads;
    loaded.case.outputs.frames &= settings.frames;
    memory::check(&loaded.case.problem)?;
    let fresh = match &earlier {
        Some(earlier) => earlier.go_on(&mut loaded)?,
        None => Simulation::new(&loaded.case.problem).map_err(|error| loaded.source.refused(error))?,
    };
    let place = match &settings.folder {
        None => None,
        Some(folder) => match folder::open(folder, &loaded.source.text, settings.resume, settings.force)? {
            Some(place) => Some(place),
            None => match goes_on::reopened(folder, &loaded, settings)? {
                Some(place) => Some(place),
                None => return FeRun::read(folder),
            },
        },
    };
    begin(&mut loaded, place.as_ref(), settings, earlier.as_ref())?;
    let robot = loaded.robot.as_ref().map(|robot| robot.watch(&loaded.case.problem));
    let mut running = match &place {
        Some(place) if place.interrupted.is_some() => Running::resume(&loaded.case, fresh, &place.folder, robot)?,
        _ => Running::start(&loaded.case, fresh, place.as_ref().map(|place| place.folder.as_path()), robot)?,
    };
    running.step_on(settings.checkpoint_every, progress).map_err(|error| stopped(error, place.as_ref()))?;
    finish(&loaded, running, place, settings, started, progress)
}

/// Marks the folder as this run's. In memory, energies are recorded at the start and at the end only.
fn begin(
    loaded: &mut Loaded,
    place: Option<&Workplace>,
    settings: &RunSettings,
    earlier: Option<&Earlier>,
) -> Result<()> {
    let Some(place) = place else {
        loaded.case.problem.settings.output_every_s = loaded.case.problem.settings.end_s;
        return Ok(());
    };
    let marker = same_run(place, loaded, settings, earlier)?;
    loaded.case.problem.settings.end_s = marker.end_s;
    loaded.case.outputs.frames = marker.frames;
    match place.interrupted {
        Some(_) => place.keep_case(&loaded.source.text),
        None => place.start(&marker, &loaded.source.text),
    }
}

/// The run that was asked for, or the interrupted one if the settings agree with it.
fn same_run(
    place: &Workplace,
    loaded: &Loaded,
    settings: &RunSettings,
    earlier: Option<&Earlier>,
) -> Result<RunIdentity> {
    let asked = RunIdentity {
        case_sha256: sha256(loaded.source.text.as_bytes()),
        end_s: loaded.case.problem.settings.end_s,
        frames: loaded.case.outputs.frames,
        from: earlier.map(|earlier| earlier.sha256.clone()),
    };
    let Some(begun) = &place.interrupted else { return Ok(asked) };
    let (message, help) = if asked.from != begun.from {
        let message = "the interrupted run goes on from the end of another run than the one asked for";
        (message.into(), "give the --from that it was started with")
    } else if settings.end_s.is_some() && asked.end_s != begun.end_s {
        let message = format!("the interrupted run ends at {} s, not at {} s", begun.end_s, asked.end_s);
        (message, "leave --end out")
    } else if !settings.frames && begun.frames {
        ("the interrupted run writes frames".into(), "leave --no-frames out")
    } else {
        return Ok(begun.clone());
    };
    Err(FemError::setting(message, format!("{help}, or start again with --force")))
}

/// A run that was stopped keeps what it has written.
fn stopped(error: FemError, place: Option<&Workplace>) -> FemError {
    let Some(place) = place.filter(|_| error.is_stop()) else { return error };
    let folder = place.folder.display();
    let help = format!("what was written until then is in {folder}; change the case and run it again with --force");
    FemError::StoppedIn { error: Box::new(error), help }
}

/// Makes summary and pictures, writes them with the manifest, and puts the run where it belongs.
fn finish(
    loaded: &Loaded,
    running: Running,
    place: Option<Workplace>,
    settings: &RunSettings,
    started: Instant,
    progress: Progress,
) -> Result<FeRun> {
    // A nearly complete run is not worth an interrupt.
    let _ = progress("writing the summary", Some(1.0));
    let mut run = FeRun {
        summary: Summary::of(&loaded.case, &running, loaded.robot.as_ref()),
        cost: Cost::of(&loaded.case, &running, started.elapsed()),
        folder: None,
        fresh: true,
        notices: [&loaded.case.notices[..], &running.notices].concat(),
        energies: running.robot.as_ref().map_or(Vec::new(), |seen| seen.watch.samples.clone()),
        files: Vec::new(),
    };
    let mut files = vec![("summary.json".to_string(), format!("{:#}\n", SUMMARY.stamped(&run.summary)).into_bytes())];
    if let Some(place) = place.as_ref().filter(|_| settings.keep_end) {
        goes_on::keep(&place.folder, loaded, &running)?;
    }
    if settings.files {
        files.extend(robot_files::files(loaded, &run, &running.run, settings.further)?);
    }
    if let Some(place) = place {
        files.iter().try_for_each(|(name, bytes)| folder::write(&place.folder.join(name), bytes))?;
        let manifest = Manifest {
            maker: settings.maker.clone(),
            inputs: vec![FileHash::of(&loaded.source.name, loaded.source.text.as_bytes())],
            outputs: place.files()?.iter().map(|(name, bytes)| FileHash::of(name, bytes)).collect(),
            cost: Some(run.cost.clone()),
        };
        run.folder = Some(place.target.clone());
        run.notices.extend(place.complete(&manifest)?);
    } else {
        run.files = files;
    }
    run.notices.extend(loaded.robot.as_ref().and_then(WatchedRobot::left_out));
    run.notices.extend(too_many(settings.threads));
    Ok(run)
}

/// Threads beyond the cores wait for each other.
fn too_many(threads: usize) -> Option<String> {
    let cores = crate::cost::threads(0);
    let message = format!("{threads} threads share {cores} cores: more threads than cores make a run slower");
    (threads > cores).then_some(message)
}

/// Height of the outermost marker and of the tip of a reading \[mm\].
pub fn heights_mm(reading: &Reading) -> [f64; 2] {
    let y = |from_end: usize| reading.moved_m.iter().rev().nth(from_end).map_or(f64::NAN, |d| d[1] * 1e3);
    [y(1), y(0)]
}
