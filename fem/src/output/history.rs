//! `history.csv`: the energy balance, chambers and probes, one row per output.
//!
//! | column | meaning |
//! |---|---|
//! | `time_s`, `step`, `dt_s` | time \[s\], steps done, step length \[s\] |
//! | `kinetic_J` | kinetic energy |
//! | `<row>_J` | one line of the ledger; lines of the same name and kind are added, the same name with another kind gets `_stored`, `_dissipated` or `_supplied` |
//! | `external_work_J`, `residual_J` | work from outside so far; what the balance misses |
//! | `residual_share`, `kinetic_share` | residual and kinetic energy over the largest external work so far; 0 before any |
//! | `<chamber>_kPa`, `<chamber>_cm3` | gauge pressure and volume |
//! | `<set>_x_N`, `_y_N`, `_z_N` | force that the supports of a node set exert on the structure, along the axes that they hold |
//! | `<set>_mx_Nm`, `_my_Nm`, `_mz_Nm` | their moment about the set's mean place, where all three axes are held |
//! | `<set>_dx_mm`, `_dy_mm`, `_dz_mm` | mean displacement of a probed node set from its start |
//!
//! Numbers have the digits that give the same bits when read back.

use std::path::Path;

use models::{Row, RowKind};

use super::table::{StepTable, check_label, number};
use crate::run::{ChamberState, Ledger, Reaction};
use crate::vec3::{V3, share};
use crate::{FemError, Mesh, Result, Simulation};

const AXES: [&str; 3] = ["x", "y", "z"];

#[derive(Debug, Clone, PartialEq)]
pub(crate) struct HistoryRecord {
    pub step: u64,
    pub time_s: f64,
    pub dt_s: f64,
    pub ledger: Ledger,
    pub chambers: Vec<ChamberState>,
    /// What supports do to the structure.
    pub reactions: Vec<Reaction>,
    /// Node positions in mesh order \[m\]; not looked at without probes.
    pub positions: Vec<[f64; 3]>,
}

impl HistoryRecord {
    pub(crate) fn of(run: &Simulation) -> HistoryRecord {
        HistoryRecord {
            step: run.step(),
            time_s: run.time_s(),
            dt_s: run.dt_s(),
            ledger: run.ledger(),
            chambers: run.chambers(),
            reactions: run.reactions().to_vec(),
            positions: run.positions(),
        }
    }
}

#[derive(Debug)]
pub(crate) struct HistoryTable {
    pub table: StepTable,
    probes: Vec<Probe>,
}

#[derive(Debug)]
struct Probe {
    name: String,
    nodes: Vec<u32>,
    start: [f64; 3],
}

impl HistoryTable {
    /// The history after the rows of `times_s` \[s\], which a checkpoint knows of, with the node sets of `mesh` named in `probes`;
    /// later rows are dropped.
    pub(crate) fn open(path: &Path, mesh: &Mesh, probes: &[String], times_s: &[f64]) -> Result<HistoryTable> {
        let probes = find_probes(mesh, probes)?;
        Ok(HistoryTable { table: StepTable::open(path, times_s, 1)?, probes })
    }

    /// Adds a row; a step that has a row already is not written again.
    pub(crate) fn append(&mut self, record: &HistoryRecord) -> Result<()> {
        let cells = self.cells(record)?;
        if let Some((name, value)) = cells.iter().find(|(_, value)| !value.is_finite()) {
            let reason = format!("{name} is {value}: try a smaller cfl or slower loading");
            return Err(FemError::stopped(record.step, record.time_s, reason));
        }
        let mut names: Vec<&str> = cells.iter().map(|(name, _)| name.as_str()).collect();
        let mut values: Vec<String> = cells.iter().map(|(_, value)| number(*value)).collect();
        names.insert(1, "step");
        values.insert(1, record.step.to_string());
        self.table.append(record.step, &names.join(","), &(values.join(",") + "\n"))
    }

    /// Names and values of a row, without the step.
    fn cells(&self, record: &HistoryRecord) -> Result<Vec<(String, f64)>> {
        let Ledger { kinetic_j, rows, residual_j, external_work_j, scale_j } = &record.ledger;
        let mut cells = vec![
            ("time_s".to_string(), record.time_s),
            ("dt_s".to_string(), record.dt_s),
            ("kinetic_J".to_string(), *kinetic_j),
        ];
        cells.extend(merged(rows));
        cells.push(("external_work_J".to_string(), *external_work_j));
        cells.push(("residual_J".to_string(), *residual_j));
        cells.push(("residual_share".to_string(), share(*residual_j, *scale_j)));
        cells.push(("kinetic_share".to_string(), share(*kinetic_j, *scale_j)));
        for chamber in &record.chambers {
            check_label(&chamber.name, "the name of the chamber")?;
            cells.push((format!("{}_kPa", chamber.name), chamber.pressure_pa * 1e-3));
            cells.push((format!("{}_cm3", chamber.name), chamber.volume_m3 * 1e6));
        }
        for reaction in &record.reactions {
            cells.extend(of_support(reaction)?);
        }
        for probe in &self.probes {
            let now = mean(&probe.nodes, |node| record.positions.get(node).copied()).ok_or_else(|| {
                FemError::Problem(format!("probe `{}`: these positions belong to another mesh", probe.name))
            })?;
            for (k, axis) in AXES.into_iter().enumerate() {
                cells.push((format!("{}_d{axis}_mm", probe.name), (now[k] - probe.start[k]) * 1e3));
            }
        }
        Ok(cells)
    }
}

/// Columns of a support: forces along held axes, moments where all are.
fn of_support(reaction: &Reaction) -> Result<Vec<(String, f64)>> {
    check_label(&reaction.set, "the node set of the support")?;
    let set = reaction.set.replace(' ', "_");
    let forces = (0..3).filter(|k| reaction.axes[*k]).map(|k| (format!("{set}_{}_N", AXES[k]), reaction.force_n[k]));
    let moments = (0..3).filter(|_| reaction.axes == [true; 3]);
    let moments = moments.map(|k| (format!("{set}_m{}_Nm", AXES[k]), reaction.moment_nm[k]));
    Ok(forces.chain(moments).collect())
}

/// Mean of a property of some nodes; `None` without nodes or if one has none.
fn mean(nodes: &[u32], of: impl Fn(usize) -> Option<V3>) -> Option<V3> {
    let mut sum = [0.0; 3];
    for &node in nodes {
        let point = of(node as usize)?;
        (0..3).for_each(|k| sum[k] += point[k]);
    }
    (!nodes.is_empty()).then(|| sum.map(|total| total / nodes.len() as f64))
}

fn find_probes(mesh: &Mesh, names: &[String]) -> Result<Vec<Probe>> {
    let find = |name: &String| {
        check_label(name, "the node set")?;
        let known = || mesh.sets.keys().map(String::as_str).collect::<Vec<_>>().join(", ");
        let nodes = mesh.sets.get(name).ok_or_else(|| {
            FemError::Problem(format!("unknown node set `{name}` to probe; the mesh has: {}", known()))
        })?;
        let start = mean(nodes, |i| (i < mesh.points.len()).then(|| mesh.start_of(i))).ok_or_else(|| {
            FemError::Problem(format!("node set `{name}` is empty or names nodes that are not in the mesh"))
        })?;
        Ok(Probe { name: name.clone(), nodes: nodes.clone(), start })
    };
    names.iter().map(find).collect()
}

/// Ledger lines as columns in the order of their first appearance.
fn merged(rows: &[Row]) -> Vec<(String, f64)> {
    let mut sums: Vec<(&str, RowKind, f64)> = Vec::new();
    for row in rows {
        match sums.iter_mut().find(|(name, kind, _)| *name == row.name && *kind == row.kind) {
            Some((_, _, sum)) => *sum += row.energy_j,
            None => sums.push((row.name, row.kind, row.energy_j)),
        }
    }
    let column = |&(name, kind, sum): &(&str, RowKind, f64)| {
        let plain = name.replace([' ', ',', ';', '"'], "_");
        let alone = sums.iter().filter(|(other, _, _)| *other == name).count() == 1;
        (if alone { format!("{plain}_J") } else { format!("{plain}_{}_J", kind.word()) }, sum)
    };
    sums.iter().map(column).collect()
}

#[cfg(test)]
#[path = "history_tests.rs"]
mod tests;
