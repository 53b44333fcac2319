//! A sweep, or a shard of it: computes the missing parts.

use crate::columns::columns;
use crate::part::{Rows, StudyPart, parts};
use crate::pieces::{self, beside};
use crate::study::{Engine, Study};
use crate::{SweepError, elements, reduced};
use fem::session::{Maker, Progress, Shard};
use std::path::PathBuf;

/// Folder, shard and threads of a sweep.
#[derive(Debug, Clone)]
pub struct Settings {
    /// Folder of the parts.
    pub folder: PathBuf,
    /// Whether every finite element run keeps a folder below it, with summary and pictures.
    pub keep_runs: bool,
    /// Parts of the study that this call computes.
    pub shard: Shard,
    /// Threads; 0: one per core. Bits do not depend on it.
    pub threads: usize,
    /// For the manifests of finite element runs, whose folder is below the sweep's.
    pub maker: Maker,
}

/// Numbers of parts of a sweep: of this shard, kept from before, still missing.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct Found {
    /// Number of parts in this shard.
    pub parts: usize,
    /// Of them those that were there before.
    pub kept: usize,
    /// Parts of the whole study that are not there yet.
    pub missing: usize,
    /// Processor time of the parts of this shard \[s\].
    pub cpu_s: f64,
}

/// Parts of a study that are not in a folder.
pub fn parts_missing(study: &Study, folder: &std::path::Path) -> usize {
    parts(study).iter().filter(|part| !part.path(study, folder).exists()).count()
}

/// The finished parts of a study, without computing anything.
///
/// # Errors
/// A part whose file is damaged.
pub fn there(study: &Study, folder: &std::path::Path) -> Result<Found, SweepError> {
    let (all, width) = (parts(study), columns(study).len());
    let read = |part: &StudyPart| Rows::read(&part.path(study, folder), part.cases.len() * width);
    let found: Vec<Rows> = all.iter().map(read).filter_map(Result::transpose).collect::<Result<_, _>>()?;
    let (kept, cpu_s) = (found.len(), found.iter().map(|rows| rows.cpu_s).sum());
    Ok(Found { parts: all.len(), kept, missing: all.len() - kept, cpu_s })
}

/// Computes the missing parts of a shard. `progress` receives the finished share and answers whether to go on.
///
/// # Errors
/// A folder that cannot be written to; a part whose file is damaged; [`fem::FemError::Interrupted`] if `progress` asked to end: complete parts stay.
pub fn run(study: &Study, settings: &Settings, progress: Progress) -> Result<Found, SweepError> {
    let width = columns(study).len();
    pieces::folder(&settings.folder.join("parts"))?;
    let all = parts(study);
    let own: Vec<&StudyPart> = settings.shard.own(&all).collect();
    let there = |part: &StudyPart| Rows::read(&part.path(study, &settings.folder), part.cases.len() * width);
    let before: Vec<Option<Rows>> = own.iter().map(|part| there(part)).collect::<Result<_, _>>()?;
    let kept = before.iter().flatten().count();
    let mut cpu_s: f64 = before.iter().flatten().map(|rows| rows.cpu_s).sum();
    let wanted = own.into_iter().zip(&before).filter(|(_, rows)| rows.is_none()).map(|(part, _)| part.clone());
    let (quick, long): (Vec<StudyPart>, Vec<StudyPart>) = wanted.partition(|part| part.engine == Engine::Reduced);
    cpu_s += by_model(study, settings, &quick, progress)?;
    if !long.is_empty() {
        let (folder, maker) = (settings.keep_runs.then(|| settings.folder.join("runs")), settings.maker.clone());
        let (threads, usual) = (settings.threads, fem::session::RunSettings::default());
        let runs =
            fem::session::RunSettings { folder, frames: false, files: settings.keep_runs, threads, maker, ..usual };
        cpu_s += elements::compute(study, &long, &settings.folder, &runs, progress)?;
    }
    let missing = parts_missing(study, &settings.folder);
    Ok(Found { parts: kept + quick.len() + long.len(), kept, missing, cpu_s })
}

/// Computes parts in parallel on threads, and writes each as soon as it is complete.
fn by_model(study: &Study, settings: &Settings, parts: &[StudyPart], progress: Progress) -> Result<f64, SweepError> {
    let one = |part: usize| -> Result<f64, SweepError> {
        let rows = reduced::compute(study, &parts[part]);
        rows.write(&parts[part].path(study, &settings.folder))?;
        Ok(rows.cpu_s)
    };
    Ok(beside(parts.len(), settings.threads, "cases of the reduced model", progress, &one)?.iter().sum())
}
