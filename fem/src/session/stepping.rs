//! A run on its way: rows, frames and checkpoints as it goes, so that it can go on where it was interrupted.

use super::Progress;
use super::watch::{Watched, WatchedState};
use crate::bytes::{pack, unpack};
use crate::case::Case;
use crate::cost::thread_seconds;
use crate::output::MeshFrame;
use crate::output::centre_line::{CentreLine, CentreLineFile};
use crate::output::checkpoint::{Checkpoint, read_checkpoint, write_checkpoint};
use crate::output::history::{HistoryRecord, HistoryTable};
use crate::output::pvd::Series;
use crate::output::table::StepTable;
use crate::robot::Rest;
use crate::run::Advance;
use crate::{FemError, Result, Simulation};
use serde::{Deserialize, Serialize};
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// Time between two lines of progress; a wish to stop is heard then.
const TELL_EVERY: Duration = Duration::from_millis(50);

/// Energies at one output, for the judgement at the end.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) struct EnergyBalance {
    pub time_s: f64,
    /// Kinetic energy over kinetic and stored energy.
    pub kinetic_share: f64,
    /// Missing energy over external work; 0 while that is below the floor of the guard.
    pub residual_share: f64,
}

/// What a run has done so far: the number of its next output, processor seconds of the sessions before, energies at its outputs.
#[derive(Default, Serialize, Deserialize)]
pub(super) struct Done {
    next: u64,
    pub cpu_s: f64,
    pub balances: Vec<EnergyBalance>,
}

pub(super) struct Running<'a> {
    pub run: Simulation,
    pub done: Done,
    /// Notices for the user, shown at the end.
    pub notices: Vec<String>,
    /// Where this session began: steps, and processor seconds.
    pub began: (u64, f64),
    /// Readings of a robot.
    pub robot: Option<Watched>,
    case: &'a Case,
    files: Option<RunFiles>,
}

struct RunFiles {
    folder: PathBuf,
    history: HistoryTable,
    series: Option<Series>,
    centre_line: Option<CentreLineFile>,
    fingerprint: u64,
}

impl<'a> Running<'a> {
    /// A run from its start, or from the end of another one, in a folder.
    pub(super) fn start(
        case: &'a Case,
        run: Simulation,
        folder: Option<&Path>,
        robot: Option<Watched>,
    ) -> Result<Running<'a>> {
        let files = folder.map(|folder| RunFiles::open(case, folder, &[])).transpose()?;
        let began = (run.step(), thread_seconds());
        let next = number_at(run.time_s(), case.problem.settings.output_every_s);
        let done = Done { next, ..Done::default() };
        Ok(Running { run, done, notices: Vec::new(), began, robot, case, files })
    }

    /// Goes on from the last checkpoint of a folder; from the beginning if there is none yet.
    pub(super) fn resume(
        case: &'a Case,
        fresh: Simulation,
        folder: &Path,
        mut robot: Option<Watched>,
    ) -> Result<Running<'a>> {
        let fingerprint = case.problem.fingerprint();
        let Some((Checkpoint { payload, .. }, notice)) = read_checkpoint(folder, fingerprint)? else {
            return Running::start(case, fresh, Some(folder), robot);
        };
        let what = "it holds something else than this program writes; start again with --force";
        let foreign = || FemError::checkpoint(folder.join("checkpoint"), what);
        let saved: Saved = unpack(&payload).ok_or_else(foreign)?;
        match (&mut robot, saved.robot) {
            (Some(robot), Some(state)) => robot.restore(state),
            (None, None) => {}
            _ => return Err(foreign()),
        }
        let run = Simulation::resume(&case.problem, &saved.run)?;
        // Outputs of the same step are one row and one frame.
        let mut times_s: Vec<f64> = saved.done.balances.iter().map(|b| b.time_s).collect();
        times_s.dedup();
        let files = Some(RunFiles::open(case, folder, &times_s)?);
        let (began, notices) = ((run.step(), thread_seconds()), notice.into_iter().collect());
        Ok(Running { run, done: saved.done, notices, began, robot, case, files })
    }

    /// Steps to the end of the case, or until `progress` asks to end, which is [`FemError::Interrupted`].
    pub(crate) fn step_on(&mut self, checkpoint_every: Duration, progress: Progress) -> Result<()> {
        let settings = &self.case.problem.settings;
        let (end_s, every_s) = (settings.end_s, settings.output_every_s);
        // The last output is the end itself; a whole number of intervals shall not get a second one just before it.
        let last = (end_s / every_s - 1e-6).ceil().max(1.0) as u64;
        let (now, from_s) = (Instant::now(), self.run.time_s());
        let (every, saving) = (checkpoint_every, Duration::ZERO);
        let mut pace = Pace { progress, began: now, from_s, end_s, told: None, every, saved_at: now, saving };
        while self.done.next <= last {
            let output_s = if self.done.next == last { end_s } else { self.done.next as f64 * every_s };
            let hold_s = self.robot.as_ref().and_then(Watched::next_s).filter(|hold_s| *hold_s <= output_s);
            self.advance(StopTime::Time(hold_s.unwrap_or(output_s)), &mut pace)?;
            match hold_s {
                Some(hold_s) => self.rest(hold_s, &mut pace)?,
                None => self.output()?,
            }
        }
        self.run.judge_end()
    }

    /// Waits at the end of a hold until the robot is at rest, then reads it.
    fn rest(&mut self, hold_s: f64, pace: &mut Pace) -> Result<()> {
        while let Some(robot) = &mut self.robot {
            match robot.rest(&self.run) {
                Rest::Until(waited_s) => self.advance(StopTime::Waited(waited_s, hold_s), pace)?,
                rest => return robot.read(&self.run, rest),
            }
        }
        Ok(())
    }

    /// Steps to a moment, with checkpoints on the way; [`FemError::Interrupted`] once `progress` asks to end.
    fn advance(&mut self, goal: StopTime, pace: &mut Pace) -> Result<()> {
        let (done, files, robot) = (&self.done, &self.files, &mut self.robot);
        let outside_s = done.cpu_s + thread_seconds() - self.began.1;
        let mut fault = None;
        let mut each = |run: &Simulation| {
            let flow = pace.tell(run);
            robot.iter_mut().for_each(|robot| robot.watch.sample(run));
            if let Some(files) = files.as_ref().filter(|_| pace.is_due()) {
                let cpu_s = outside_s + run.cpu_s();
                fault = pace.keep(|| files.save(run, Saved::pack(run, done, robot.as_ref(), cpu_s))).err();
            }
            fault.is_none() && flow.is_continue()
        };
        let advanced = match goal {
            StopTime::Time(time_s) => self.run.advance_until(time_s, &mut each)?,
            StopTime::Waited(waited_s, at_s) => self.run.wait_until(waited_s, at_s, &mut each)?,
        };
        fault.map_or(Ok(()), Err)?;
        if advanced == Advance::Interrupted {
            let saved = |files: &RunFiles| files.save(&self.run, self.saved(self.done.cpu_s + self.cpu_s()));
            self.files.iter().try_for_each(saved)?;
            return Err(FemError::Interrupted { time_s: self.run.time_s(), step: self.run.step(), done: 0, of: 1 });
        }
        Ok(())
    }

    fn saved(&self, cpu_s: f64) -> Vec<u8> {
        Saved::pack(&self.run, &self.done, self.robot.as_ref(), cpu_s)
    }

    fn output(&mut self) -> Result<()> {
        let record = HistoryRecord::of(&self.run);
        self.done.balances.push(EnergyBalance {
            time_s: record.time_s,
            kinetic_share: record.ledger.kinetic_share(),
            residual_share: record.ledger.residual_share(),
        });
        self.done.next += 1;
        let Some(files) = &mut self.files else { return Ok(()) };
        files.history.append(&record)?;
        if let Some(line) = &mut files.centre_line {
            line.append(record.step, record.time_s, &record.positions)?;
        }
        if let Some(series) = &mut files.series {
            let hold_pa = self.robot.as_ref().and_then(|robot| robot.hold_pa(record.time_s));
            series.push(&self.case.problem.mesh, &MeshFrame { hold_pa, ..MeshFrame::of(&self.run) })?;
        }
        Ok(())
    }

    /// The end of the run, the same to the bit however often it was interrupted.
    pub(super) fn end(&self) -> Vec<u8> {
        self.saved(0.0)
    }

    /// Processor seconds of this session: of the steps, and of this thread, which writes.
    pub(super) fn cpu_s(&self) -> f64 {
        self.run.cpu_s() + thread_seconds() - self.began.1
    }
}

impl RunFiles {
    /// Files of a run after its outputs at `times_s`; lost rows are refused before anything is cut.
    fn open(case: &Case, folder: &Path, times_s: &[f64]) -> Result<RunFiles> {
        let history = folder.join("history.csv");
        let path = folder.join("centre_line.csv");
        let line = centre_line(case)?;
        StepTable::check(&history, times_s, 1)?;
        line.iter().try_for_each(|line| StepTable::check(&path, times_s, line.stations_m().len()))?;
        Ok(RunFiles {
            folder: folder.into(),
            series: case.outputs.frames.then(|| Series::open(folder, times_s)).transpose()?,
            history: HistoryTable::open(&history, &case.problem.mesh, &case.outputs.probes, times_s)?,
            centre_line: line.map(|line| CentreLineFile::open(&path, line, times_s)).transpose()?,
            fingerprint: case.problem.fingerprint(),
        })
    }

    fn save(&self, run: &Simulation, payload: Vec<u8>) -> Result<()> {
        self.history.table.sync()?;
        self.centre_line.iter().try_for_each(|line| line.table.sync())?;
        let (step, time_s) = (run.step(), run.time_s());
        let checkpoint = Checkpoint { fingerprint: self.fingerprint, step, time_s, payload };
        write_checkpoint(&self.folder, &checkpoint).map(|_| ())
    }
}

/// What a checkpoint of a session holds.
#[derive(Serialize, Deserialize)]
struct Saved {
    done: Done,
    robot: Option<WatchedState>,
    run: Vec<u8>,
}

impl Saved {
    fn pack(run: &Simulation, done: &Done, robot: Option<&Watched>, cpu_s: f64) -> Vec<u8> {
        let done = Done { cpu_s, next: done.next, balances: done.balances.clone() };
        pack(&Saved { done, robot: robot.map(Watched::save), run: run.save() })
    }
}

/// Number of the output at a time, or of the last one before it.
fn number_at(time_s: f64, every_s: f64) -> u64 {
    (time_s / every_s + 1e-6).floor() as u64
}

/// The state of the run in what [`Running::end`] gave.
pub(super) fn run_of(session: &[u8]) -> Option<Vec<u8>> {
    unpack::<Saved>(session).map(|saved| saved.run)
}

/// What [`Running::end`] gave as a checkpoint of the same run that goes on: its last output counts as one on the way.
pub(super) fn extended(session: &[u8], time_s: f64, every_s: f64) -> Option<Vec<u8>> {
    let mut saved: Saved = unpack(session)?;
    saved.done.next = number_at(time_s, every_s) + 1;
    Some(pack(&saved))
}

fn centre_line(case: &Case) -> Result<Option<CentreLine>> {
    let wanted = &case.outputs;
    let make = || CentreLine::new(&case.problem.mesh, &wanted.station_parts, wanted.station_axis, &wanted.stations_m);
    (!wanted.stations_m.is_empty()).then(make).transpose()
}

/// Where a run steps to \[s\].
#[derive(Clone, Copy)]
enum StopTime {
    Time(f64),
    /// A time waited in all, with the loads of a moment.
    Waited(f64, f64),
}

/// Receiver of progress, and when checkpoints are written.
struct Pace<'a> {
    progress: Progress<'a>,
    began: Instant,
    from_s: f64,
    end_s: f64,
    told: Option<Instant>,
    every: Duration,
    saved_at: Instant,
    saving: Duration,
}

impl Pace<'_> {
    /// A large run writes hundreds of megabytes: not for more than a fiftieth of its time.
    fn is_due(&self) -> bool {
        self.saved_at.elapsed() >= self.every.max(50 * self.saving)
    }

    fn keep(&mut self, save: impl FnOnce() -> Result<()>) -> Result<()> {
        let began = Instant::now();
        let saved = save();
        self.saved_at = Instant::now();
        self.saving = self.saved_at - began;
        saved
    }

    fn tell(&mut self, run: &Simulation) -> ControlFlow<()> {
        if self.told.is_some_and(|told| told.elapsed() < TELL_EVERY) {
            return ControlFlow::Continue(());
        }
        self.told = Some(Instant::now());
        let (t, ledger) = (run.time_s(), run.ledger());
        let done = (t - self.from_s) / (self.end_s - self.from_s).max(f64::MIN_POSITIVE);
        let left_s = self.began.elapsed().as_secs_f64() * (1.0 - done) / done.max(1e-9);
        let text = format!(
            "step {} · t {:.4} of {} s · dt {:.2} µs · kinetic {:.1} % · residual {:.2} % · {} left",
            run.step(),
            t,
            self.end_s,
            run.dt_s() * 1e6,
            100.0 * ledger.kinetic_share(),
            100.0 * ledger.residual_share(),
            clock(left_s)
        );
        (self.progress)(&text, Some(t / self.end_s))
    }
}

fn clock(seconds: f64) -> String {
    match seconds {
        s if s < 100.0 => format!("{s:.0} s"),
        s if s < 6000.0 => format!("{:.0} min", s / 60.0),
        s => format!("{:.1} h", s / 3600.0),
    }
}
