//! Several runs in parallel, each in its own folder below one: by name, or by the hash of problem and engine, so that
//! asking twice costs nothing. A finished one is kept, an interrupted one goes on.

use super::together::{shared, together};
use super::{FeRun, Loaded, Progress, RunSettings, RunSource, folder, simulate};
use crate::{FemError, Result};
use serde::Deserialize;
use std::path::{Path, PathBuf};

/// One run for [`simulate_all`]: its source, name and folder.
#[derive(Debug, Clone)]
pub struct RunJob {
    /// Case or scenario that is simulated.
    pub source: RunSource,
    /// What to call it while it runs.
    pub what: String,
    /// Name of its folder. `None`: by the hash of problem and engine; a finished run of this problem is then taken whatever
    /// text described it, and one of another text goes.
    pub folder: Option<String>,
}

/// Results of several runs, of which equal problems share one.
#[derive(Debug)]
pub struct Many {
    /// Each problem once, in the order of the first jobs: the run, or the error of the guard that stopped it.
    pub runs: Vec<Result<FeRun>>,
    /// Which of them each job has.
    pub of: Vec<usize>,
}

/// Runs the jobs that are not complete yet, below [`RunSettings::folder`], the longest first.
///
/// # Errors
/// [`FemError::Refused`] and [`FemError::Folder`] before the first run costs time; [`FemError::Interrupted`].
pub fn simulate_all(jobs: &[RunJob], settings: &RunSettings, progress: Progress) -> Result<Many> {
    let root = settings.folder.clone().unwrap_or_default();
    if jobs.iter().any(|job| job.folder.is_some()) && root.join("case.toml").exists() {
        let help = "choose another folder with --out; several runs get a folder each inside it";
        return Err(FemError::folder(&root, "it holds a single run", help));
    }
    let (tasks, of) = tasks(jobs, &root)?;
    if !settings.force {
        tasks.iter().filter(|task| jobs[task.at].folder.is_some()).try_for_each(|task| task.check(jobs))?;
    }
    let mut order: Vec<usize> = (0..tasks.len()).collect();
    order.sort_by(|a, b| tasks[*b].effort.total_cmp(&tasks[*a].effort));
    let one = |k: usize, threads: usize, tell: Progress| {
        let task = &tasks[order[k]];
        let (job, each) = (&jobs[task.at], RunSettings { threads, ..settings.clone() });
        let what = format!("{} of {}, {}", task.at + 1, jobs.len(), job.what);
        let run = task.run(job, &each, &mut |text, share| tell(&format!("{what}: {text}"), share));
        match run {
            Err(stopped) if stopped.is_stop() => Ok(Err(stopped)),
            other => other.map(Ok),
        }
    };
    let found = simulate_each(tasks.len(), settings.threads, progress, &one)?;
    let mut runs: Vec<(usize, Result<FeRun>)> = order.into_iter().zip(found).collect();
    runs.sort_by_key(|run| run.0);
    Ok(Many { runs: runs.into_iter().map(|run| run.1).collect(), of })
}

/// Does work `0..count` in parallel on threads (0: one per core); `one` gets its number, its threads and the progress callback.
///
/// # Errors
/// The error of the first work that failed; after it, or once `progress` asks to end, nothing new is begun.
pub fn simulate_each<T: Send>(
    count: usize,
    threads: usize,
    progress: Progress,
    one: &(dyn Fn(usize, usize, Progress) -> Result<T> + Sync),
) -> Result<Vec<T>> {
    let (workers, threads) = shared(threads, count);
    together(count, workers, progress, &|k, tell: Progress| one(k, threads, tell))
}

/// One run: in memory, or below [`RunSettings::folder`] in its own folder, where a finished one of the same problem is taken.
///
/// # Errors
/// As [`simulate`].
pub fn simulate_job(job: &RunJob, settings: &RunSettings, progress: Progress) -> Result<FeRun> {
    let Some(root) = &settings.folder else { return simulate(&job.source, settings, progress) };
    let task = Task::of(0, job, &job.source.load()?, root);
    task.run(job, settings, &mut |text, share| progress(&format!("{}: {text}", job.what), share))
}

/// One share of several runs, for several machines that see one folder.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Shard {
    /// Number of this shard, counted from 1.
    pub which: usize,
    /// Number of shards in all, 1 or more.
    pub of: usize,
}

impl Shard {
    /// The only shard of one: all runs.
    pub const WHOLE: Shard = Shard { which: 1, of: 1 };

    /// Reads `2/7`; `Err` names the fault and the format.
    pub fn parse(text: &str) -> Result<Shard, String> {
        let read = text.split_once('/').and_then(|(which, of)| Some((which.parse().ok()?, of.parse().ok()?)));
        match read {
            Some((which, of)) if (1..=of).contains(&which) => Ok(Shard { which, of }),
            _ => Err(format!("`{text}` is not a shard: write K/N, for example 2/7, with K from 1 to N")),
        }
    }

    /// Every N-th of some things, from the K-th on.
    ///
    /// ```
    /// let shard = fem::session::Shard::parse("2/3").unwrap();
    /// assert_eq!(shard.own(0..8).collect::<Vec<_>>(), [1, 4, 7]);
    /// assert!(fem::session::Shard::parse("4/3").is_err());
    /// ```
    pub fn own<T>(self, all: impl IntoIterator<Item = T>) -> impl Iterator<Item = T> {
        all.into_iter().skip(self.which - 1).step_by(self.of)
    }
}

/// Each problem of some jobs once, with the folder of its run below `root`.
///
/// # Errors
/// [`FemError::Refused`] for a job that cannot be run.
pub fn problems<'a>(jobs: &'a [RunJob], root: &Path) -> Result<Vec<(&'a RunJob, PathBuf)>> {
    Ok(tasks(jobs, root)?.0.into_iter().map(|task| (&jobs[task.at], task.folder)).collect())
}

/// Each problem once, and which of them each job has.
fn tasks(jobs: &[RunJob], root: &Path) -> Result<(Vec<Task>, Vec<usize>)> {
    let (mut tasks, mut of) = (Vec::<Task>::new(), Vec::new());
    for (at, job) in jobs.iter().enumerate() {
        let task = Task::of(at, job, &job.source.load()?, root);
        let known = tasks.iter().position(|known| known.fingerprint == task.fingerprint);
        of.push(known.unwrap_or(tasks.len()));
        if known.is_none() {
            tasks.push(task);
        }
    }
    Ok((tasks, of))
}

/// What a step with contact costs, in steps without.
const CONTACT: f64 = 2.5;

struct Task {
    at: usize,
    fingerprint: u64,
    /// Grows with the time it will take.
    effort: f64,
    folder: PathBuf,
}

impl Task {
    fn of(at: usize, job: &RunJob, loaded: &Loaded, root: &Path) -> Task {
        let problem = &loaded.case.problem;
        let contact = if problem.contact.is_some() { CONTACT } else { 1.0 };
        // Smaller elements need more steps as well.
        let effort = contact * problem.settings.end_s * (problem.mesh.elements() as f64).powf(1.5);
        let fingerprint = problem.fingerprint();
        let kind = loaded.robot.as_ref().map_or("case", |r| r.scenario.actuator.kind.name);
        let by_hash = || format!("{kind}-{fingerprint:016x}-{}", crate::ENGINE);
        let folder = root.join(job.folder.clone().unwrap_or_else(by_hash));
        Task { at, fingerprint, effort, folder }
    }

    /// Refuses a folder with a run of another case.
    fn check(&self, jobs: &[RunJob]) -> Result<()> {
        if folder::is_of(&self.folder, &jobs[self.at].source.text)? != Some(false) {
            return Ok(());
        }
        let cause = "it holds a run of another case, or the case has changed";
        let help = "choose another folder with --out, or add --force to run it again";
        Err(FemError::folder(&self.folder, cause, help))
    }

    fn run(&self, job: &RunJob, settings: &RunSettings, tell: Progress) -> Result<FeRun> {
        if job.folder.is_none()
            && let Some(run) = finished(&self.folder)?
        {
            return Ok(run);
        }
        let other = folder::is_of(&self.folder, &job.source.text)? == Some(false);
        let folder = Some(self.folder.clone());
        let settings = RunSettings { folder, resume: !other, force: other, keep_end: false, ..settings.clone() };
        simulate(&job.source, &settings, tell)
    }
}

/// The complete run in a folder, if it is one of the present engine.
fn finished(folder: &Path) -> Result<Option<FeRun>> {
    #[derive(Deserialize)]
    struct EngineVersion {
        engine: u32,
    }
    let text = std::fs::read(folder.join("summary.json")).unwrap_or_default();
    // Runs of other engines may be records of another shape, which is not an error.
    let of_another = serde_json::from_slice(&text).is_ok_and(|EngineVersion { engine }| engine != crate::ENGINE);
    if of_another || !folder::is_finished(folder) {
        return Ok(None);
    }
    FeRun::read(folder).map(Some)
}

/// All complete runs of the present engine in a folder and in those below it down to `depth`, by name.
///
/// # Errors
/// [`FemError::Record`] for one that is damaged.
pub fn finished_below(folder: &Path, depth: usize) -> Result<Vec<FeRun>> {
    let mut found: Vec<FeRun> = finished(folder)?.into_iter().collect();
    if depth > 0 {
        let entries = std::fs::read_dir(folder).into_iter().flatten();
        let mut folders: Vec<PathBuf> = entries.filter_map(|e| Some(e.ok()?.path())).filter(|p| p.is_dir()).collect();
        folders.sort();
        for inner in folders {
            found.extend(finished_below(&inner, depth - 1)?);
        }
    }
    Ok(found)
}
