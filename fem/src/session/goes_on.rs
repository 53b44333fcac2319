//! A run that goes on where another one ended: for longer in the same folder, or in another folder with other loads.
//!
//! A complete run keeps its end in `checkpoint.end`. Time goes on from there, and so does the ledger: loads that are absent
//! from a later run are its line `earlier loads`.

use super::folder::{self, RunIdentity, Workplace};
use super::stepping::{self, Running};
use super::{FeRun, Loaded, RunSettings, sha256};
use crate::bytes::{pack, unpack};
use crate::output::checkpoint::{Checkpoint, read_end, write_checkpoint, write_end};
use crate::problem::{PrintedLoads, pressure_of};
use crate::{FemError, Result, Simulation};
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};

/// Loads that differ by more than this share jump.
const JUMP: f64 = 1e-3;

/// What the payload of `checkpoint.end` is.
#[derive(Serialize, Deserialize)]
pub(super) struct EndCheckpoint {
    /// Of the problem, whatever its length.
    fingerprint: u64,
    pub loads: PrintedLoads,
    session: Vec<u8>,
}

/// The end of a complete run.
pub(super) struct Earlier {
    folder: PathBuf,
    pub time_s: f64,
    pub sha256: String,
    structure: u64,
    step: u64,
    pub end: EndCheckpoint,
}

/// Keeps the end of a run in its folder.
pub(super) fn keep(folder: &Path, loaded: &Loaded, running: &Running) -> Result<()> {
    let (problem, run) = (&loaded.case.problem, &running.run);
    let mut loads = problem.loads_at(run.time_s());
    for sealed in run.chambers() {
        loads.entry(pressure_of(&sealed.name)).or_insert([sealed.pressure_pa, 0.0, 0.0]);
    }
    let fingerprint = problem.fingerprint_of_any_length();
    let payload = pack(&EndCheckpoint { fingerprint, loads, session: running.end() });
    let structure = problem.fingerprint_of_structure();
    write_end(folder, &Checkpoint { fingerprint: structure, step: run.step(), time_s: run.time_s(), payload })
}

impl Earlier {
    /// The end of the run in a folder.
    ///
    /// # Errors
    /// [`FemError::Setting`] for a folder without the end of a run, [`FemError::Checkpoint`] for a damaged one.
    pub(super) fn read(folder: &Path) -> Result<Earlier> {
        let refused = |cause: &str, help: &str| {
            FemError::setting(format!("cannot go on from {}: {cause}", folder.display()), help)
        };
        if !folder::is_finished(folder) {
            return Err(refused(
                "it holds no complete run",
                "name the folder of a run that is complete, or complete it with --resume",
            ));
        }
        let nothing =
            "it does not keep the end of its run: it was made by an earlier version, or as one of several runs";
        let Some((checkpoint, bytes)) = read_end(folder)? else {
            return Err(refused(nothing, "make the run again with --force"));
        };
        let Checkpoint { fingerprint: structure, step, time_s, payload } = checkpoint;
        let end: EndCheckpoint = unpack(&payload)
            .ok_or_else(|| refused("its checkpoint.end holds something else", "make the run again with --force"))?;
        Ok(Earlier { folder: folder.into(), time_s, sha256: sha256(&bytes), structure, step, end })
    }

    /// The run of another problem from here on, and what to know about it.
    pub(super) fn go_on(&self, loaded: &mut Loaded) -> Result<Simulation> {
        let (problem, from) = (&loaded.case.problem, self.folder.display());
        if problem.fingerprint_of_structure() != self.structure {
            let message = format!(
                "cannot go on from {from}: its mesh, fabrics, supports, contact or numerical settings differ from those asked for"
            );
            let own = self.folder.join("case.toml");
            let help =
                format!("change only pressures, forces, gravity, obstacles, outputs and times of {}", own.display());
            return Err(FemError::setting(message, help));
        }
        let foreign =
            || FemError::setting(format!("the end of the run in {from} does not fit"), "make it again with --force");
        let saved = stepping::run_of(&self.end.session).ok_or_else(foreign)?;
        let run = Simulation::go_on(problem, &saved).map_err(|error| loaded.source.refused(error))?;
        // Steps are not shortened to meet a moment.
        if problem.settings.end_s <= self.time_s + run.dt_s() {
            let message = format!(
                "cannot end at {} s: the run in {from} ended at {:.6} s, and time goes on from there",
                problem.settings.end_s, self.time_s
            );
            let help = "give a later end with --end, or as end_s of the case";
            return Err(FemError::setting(message, help));
        }
        let jumps = self.jumps(&problem.loads_at(self.time_s));
        loaded.case.notices.extend(jumps);
        Ok(run)
    }

    /// Warnings for loads that differ from the end before.
    fn jumps(&self, now: &PrintedLoads) -> Vec<String> {
        let jump = |what: &String| {
            // A sealed chamber keeps its gas.
            let value =
                |loads: &PrintedLoads| loads.get(what).copied().or((!what.starts_with("pressure")).then_some([0.0; 3]));
            let (before, after) = (value(&self.end.loads)?, value(now)?);
            let jumps = |k: &usize| (before[*k] - after[*k]).abs() > JUMP * before[*k].abs().max(after[*k].abs());
            let k = (0..3).find(jumps)?;
            let at_s = self.time_s;
            Some(format!(
                "warning: {what} jumps from {:.6} to {:.6} at t = {at_s:.6} s, where this run begins: times count from the start of the first run",
                before[k], after[k]
            ))
        };
        let gone = self.end.loads.keys().filter(|what| !now.contains_key(*what));
        now.keys().chain(gone).filter_map(jump).collect()
    }
}

/// The complete run in a folder as one that goes on to a later end; `None` if it ends there already.
///
/// # Errors
/// [`FemError::Setting`] for an end before the run's, or where the run resumed an earlier one and depends on it.
pub(super) fn reopened(folder: &Path, loaded: &Loaded, settings: &RunSettings) -> Result<Option<Workplace>> {
    let Some(end_s) = settings.end_s else { return Ok(None) };
    let ended = FeRun::read(folder)?.summary;
    if (end_s - ended.time_s).abs() <= ended.dt_s {
        return Ok(None);
    }
    if end_s < ended.time_s {
        let message = format!("the run in {} ended at {:.6} s, after --end {end_s} s", folder.display(), ended.time_s);
        let help = "leave --end out, give a later one, or run it again with --force";
        return Err(FemError::setting(message, help));
    }
    let earlier = Earlier::read(folder)?;
    let problem = &loaded.case.problem;
    if problem.fingerprint_of_any_length() != earlier.end.fingerprint {
        let message = format!("cannot go on with the run in {}: it is of another problem", folder.display());
        let help = "give the options that it was started with, --from too; for other loads, go on from it with --from";
        return Err(FemError::setting(message, help));
    }
    let marker = RunIdentity {
        case_sha256: sha256(loaded.source.text.as_bytes()),
        end_s,
        frames: folder.join("run.pvd").exists(),
        from: settings.from.as_deref().map(Earlier::read).transpose()?.map(|from| from.sha256),
    };
    let Earlier { time_s, step, end: EndCheckpoint { session, .. }, .. } = earlier;
    let payload = stepping::extended(&session, time_s, problem.settings.output_every_s).unwrap_or(session);
    let checkpoint = Checkpoint { fingerprint: problem.fingerprint(), step, time_s, payload };
    folder::reopen(folder, marker, &|| write_checkpoint(folder, &checkpoint).map(|_| ())).map(Some)
}
