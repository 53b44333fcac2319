//! Runs of the paper's own model below a folder.

use super::{Kinetic, PaperRun, Peak};
use crate::study::engines::{as_it_is, as_run, is_paper};
use crate::study::published::shipped_scenario;
use fem::FemError;
use fem::session::{FeRun, Summary, finished_below, rounded};
use std::path::Path;

/// Keys of `[fem]` that leave the paper's modelling choices as they are: loads, sizes, supports, seeds.
const FREE: [&str; 7] = ["pressures_kpa", "separate", "mesh_mm", "body_mesh_mm", "actuator_mesh_mm", "base", "seed"];
/// Folders in folders: `ibr simulate` puts several runs into one.
const DEPTH: usize = 3;

/// All finished ones of the present engine, made by `ibr simulate epam-paper` and its like.
///
/// # Errors
/// [`FemError::Record`] for one that is damaged.
pub fn runs_below(folder: &Path) -> Result<Vec<PaperRun>, FemError> {
    Ok(finished_below(folder, DEPTH)?.iter().filter_map(paper_run).collect())
}

/// A run of a robot of the paper at one pressure with nothing of the preset changed; `None` if it is another.
fn paper_run(made: &FeRun) -> Option<PaperRun> {
    let Summary { robot, kinetic_share: shares, added_mass_share, .. } = &made.summary;
    let robot = robot.as_ref()?;
    let unchanged = robot.set.iter().all(|key| FREE.contains(&key.as_str()));
    (is_paper(&made.summary) && unchanged).then_some(())?;
    let run = as_run(made)?;
    as_it_is(&run, &shipped_scenario(&run.actuator).ok()?).then_some(())?;
    // The filled body and one pressure: a ramp through several is another loading.
    let [_, last] = &robot.readings[..] else { return None };
    Some(PaperRun {
        run,
        encastre: robot.base == "encastre",
        added_mass_share: rounded(*added_mass_share),
        kinetic: Kinetic {
            outputs: shares.outputs as u64,
            below_10_pct_of_internal: shares.below_10_pct_of_internal.kept_at as u64,
            below_1_pct_of_total: shares.below_1_pct_of_total.kept_at as u64,
            at_end: rounded(shares.end?),
        },
        peak: Peak {
            part: last.von_mises_part.clone(),
            at_mm: rounded(last.von_mises_at_m * 1e3),
            on_seam: last.von_mises_on_seam,
        },
    })
}
