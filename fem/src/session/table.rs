//! What several runs of a robot gave: heights of each, mean and spread of those that differ in their seed only.

use super::{FeRun, Many, Variation, heights_mm, rounded};
use crate::Result;
use crate::vec3::{share, where_so};
use serde::Serialize;

/// A robot's heights at one pressure.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Heights {
    /// Gauge pressure of the actuator at this hold \[kPa\].
    pub actuator_kpa: f64,
    /// Height of the outermost marker across the straight robot \[mm\].
    pub marker_mm: f64,
    /// Height of the tip across the straight robot \[mm\].
    pub tip_mm: f64,
    /// Whether the tip was at rest when it was read.
    pub is_at_rest: bool,
}

/// Heights of the outermost marker and the tip in one run.
#[derive(Debug, Clone, PartialEq)]
pub struct RunRow {
    /// The run's label, and what differs from the common scenario.
    pub variation: Variation,
    /// Heights at the ends of the holds, by time.
    pub heights: Vec<Heights>,
    /// Folder; empty if the row shares the run of another row.
    pub folder: String,
    /// Processor time \[s\]; 0 if the row shares the run of another row.
    pub cpu_s: f64,
}

/// Runs that differ in their seed only, at one pressure.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SeedGroup {
    /// Name of the group: what its runs have in common.
    pub group: String,
    /// Gauge pressure of the actuator at this hold \[kPa\].
    pub actuator_kpa: f64,
    /// Number of runs in the group, one per seed.
    pub runs: usize,
    /// Mean height of the tip over the runs \[mm\].
    pub tip_mean_mm: f64,
    /// Standard deviation of the sample; 0 for one.
    pub tip_sd_mm: f64,
}

/// Heights of several runs of one robot, as a table.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct RunTable {
    /// One row per run, in the order of the variations.
    pub rows: Vec<RunRow>,
}

impl RunTable {
    /// Of variations and what [`super::simulate_all`] made of them.
    ///
    /// # Errors
    /// The error of the first run that was stopped.
    pub fn of(variations: &[Variation], many: Many) -> Result<RunTable> {
        let runs = many.runs.into_iter().collect::<Result<Vec<FeRun>>>()?;
        let first = |index: usize| many.of.iter().position(|of| *of == many.of[index]) == Some(index);
        let row = |(index, variation): (usize, &Variation)| {
            let run = &runs[many.of[index]];
            let folder = if first(index) { variation.label.clone() } else { String::new() };
            let cpu_s = where_so(first(index), run.cost.cpu_s_of_all_sessions);
            RunRow { variation: variation.clone(), heights: heights(run), folder, cpu_s }
        };
        Ok(RunTable { rows: variations.iter().enumerate().map(row).collect() })
    }

    /// Mean and spread of the tips, group by group and pressure by pressure.
    pub fn groups(&self) -> Vec<SeedGroup> {
        let mut tips: Vec<(&str, f64, Vec<f64>)> = Vec::new();
        for row in &self.rows {
            for h in &row.heights {
                match tips.iter_mut().find(|g| g.0 == row.variation.group && g.1 == h.actuator_kpa) {
                    Some(group) => group.2.push(h.tip_mm),
                    None => tips.push((&row.variation.group, h.actuator_kpa, vec![h.tip_mm])),
                }
            }
        }
        let group = |(group, actuator_kpa, tips): (&str, f64, Vec<f64>)| {
            let runs = tips.len();
            let tip_mean_mm = tips.iter().sum::<f64>() / runs as f64;
            let sum: f64 = tips.iter().map(|t| (t - tip_mean_mm).powi(2)).sum();
            let tip_sd_mm = share(sum, runs as f64 - 1.0).sqrt();
            SeedGroup { group: group.into(), actuator_kpa, runs, tip_mean_mm, tip_sd_mm }
        };
        tips.into_iter().map(group).collect()
    }

    /// Text of `table.csv`: a line per run and hold, with a head.
    pub fn csv(&self) -> String {
        let mut out = String::from("run,changes,p_act_kpa,marker_mm,tip_mm,at_rest,cpu_s\n");
        for RunRow { variation: Variation { label, changes, .. }, heights, cpu_s, .. } in &self.rows {
            let changes: Vec<String> = changes.iter().map(|(k, v)| format!("{k}={v}").replace(',', ";")).collect();
            let changes = changes.join(" ");
            for Heights { actuator_kpa, marker_mm, tip_mm, is_at_rest } in heights {
                out.push_str(&format!("{label},{changes},{actuator_kpa},{marker_mm},{tip_mm},{is_at_rest},{cpu_s}\n"));
            }
        }
        out
    }
}

fn heights(run: &FeRun) -> Vec<Heights> {
    let pressed = run.readings().iter().filter(|r| r.actuator_pa > 0.0);
    let of = pressed.map(|r| {
        let [marker_mm, tip_mm] = heights_mm(r);
        Heights { actuator_kpa: rounded(r.actuator_pa * 1e-3), marker_mm, tip_mm, is_at_rest: r.is_at_rest }
    });
    of.collect()
}
