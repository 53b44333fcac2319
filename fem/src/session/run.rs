//! How a run is made, and a complete one.

use super::folder;
use super::manifest::{FileHash, MANIFEST, Maker};
use super::source::Loaded;
use super::summary::{Cost, SUMMARY, Summary};
use crate::error::Damage;
use crate::robot::{Reading, Sample};
use crate::{FemError, Result};
use serde::Deserialize;
use std::path::{Path, PathBuf};
use std::time::Duration;

/// Further files of a complete run, by name, made before it is marked as complete: plots.
pub type Further = fn(&Loaded, &FeRun) -> Result<Vec<(String, Vec<u8>)>, String>;

/// Folder, threads, checkpoints and resumption of one run.
#[derive(Debug, Clone)]
pub struct RunSettings {
    /// Folder of the run. `None`: nothing is written, files of the end are in [`FeRun::files`], and energies are judged at the
    /// start, at the holds and at the end.
    pub folder: Option<PathBuf>,
    /// Go on with an interrupted run, or with a complete one to a later end.
    pub resume: bool,
    /// Folder of a complete run of the same mesh, fabrics and numerics; this one goes on from its end, with its own loads.
    pub from: Option<PathBuf>,
    /// Keep the end, so that another run can go on from it.
    pub keep_end: bool,
    /// Replace a run that is in the folder already.
    pub force: bool,
    /// Write frames, if the case wants them.
    pub frames: bool,
    /// Make tables and pictures of the end, which take as long as a short run.
    pub files: bool,
    /// Simulated time, if not the case's \[s\].
    pub end_s: Option<f64>,
    /// Threads; 0: one per core. Results do not depend on it.
    pub threads: usize,
    /// Real time between checkpoints; more where they would take over a fiftieth of it.
    pub checkpoint_every: Duration,
    /// Function that makes further files of the complete run.
    pub further: Option<Further>,
    /// Program and machine, for the manifest.
    pub maker: Maker,
}

impl Default for RunSettings {
    fn default() -> RunSettings {
        RunSettings {
            folder: None,
            resume: false,
            from: None,
            keep_end: false,
            force: false,
            frames: true,
            files: true,
            end_s: None,
            threads: 0,
            checkpoint_every: Duration::from_secs(30),
            further: None,
            maker: Maker { program: concat!("ibr-fem ", env!("CARGO_PKG_VERSION")).into(), ..Maker::default() },
        }
    }
}

/// Results of a complete run, new or read from its folder.
#[derive(Debug, Clone, PartialEq)]
pub struct FeRun {
    /// Physical results, the content of `summary.json`.
    pub summary: Summary,
    /// Processor time, real time, threads and speed of the run.
    pub cost: Cost,
    /// Folder of the run; `None` if nothing was written.
    pub folder: Option<PathBuf>,
    /// False if it was complete before, and nothing was done.
    pub fresh: bool,
    /// What to know about how it was made.
    pub notices: Vec<String>,
    /// Energies of a robot every few dozen steps; empty for a run that was complete before.
    pub energies: Vec<Sample>,
    /// Files of the end by name, for a run without a folder.
    pub files: Vec<(String, Vec<u8>)>,
}

impl FeRun {
    /// The complete run in a folder.
    ///
    /// # Errors
    /// [`FemError::Folder`] if it cannot be read, [`FemError::Record`] with the place if it is damaged.
    pub fn read(folder: &Path) -> Result<FeRun> {
        #[derive(Deserialize)]
        struct FinishedRun {
            cost: Cost,
            outputs: Vec<FileHash>,
        }
        let text = |name: &str| {
            let path = folder.join(name);
            let text = std::fs::read_to_string(&path).map_err(|cause| folder::unwritable(&path, &cause))?;
            Ok::<_, FemError>((path.display().to_string(), text))
        };
        let help =
            format!("delete {} and give the command again: that run is repeated, others are kept", folder.display());
        let (file, summary_text) = text("summary.json")?;
        let summary = SUMMARY.read(&file, &summary_text, &help)?;
        let (listed, manifest) = text("manifest.json")?;
        let FinishedRun { cost, outputs } = MANIFEST.read(&listed, &manifest, &help)?;
        let own = FileHash::of("summary.json", summary_text.as_bytes());
        if outputs.iter().any(|output| output.name == own.name && output.sha256 != own.sha256) {
            return Err(Damage::changed(&file, &help));
        }
        let (notices, energies, files) = (Vec::new(), Vec::new(), Vec::new());
        Ok(FeRun { summary, cost, folder: Some(folder.into()), fresh: false, notices, energies, files })
    }

    /// A robot with its markers at every hold, by time; empty for other cases.
    pub fn readings(&self) -> &[Reading] {
        self.summary.robot.as_ref().map_or(&[], |robot| &robot.readings)
    }

    /// The deformed meshes of the outputs in its folder, by time; `run.pvd` there lists their times.
    pub fn frames(&self) -> Vec<PathBuf> {
        let entries = self.folder.iter().filter_map(|folder| std::fs::read_dir(folder.join("frames")).ok()).flatten();
        let mut found: Vec<PathBuf> = entries.filter_map(|entry| Some(entry.ok()?.path())).collect();
        found.sort();
        found
    }
}
