//! What a run came to: the record `summary.json`.

use super::stepping::{EnergyBalance, Running};
use super::watch::{RobotSummary, WatchedRobot};
use crate::case::Case;
use crate::policy;
use crate::record::RecordShape;
use crate::run::{LESS_HOURGLASS, Through};
use crate::vec3::share;
use serde::{Deserialize, Serialize};
use std::time::Duration;

/// Name and version of the record in `summary.json`.
pub const SUMMARY: RecordShape = RecordShape { schema: "ibr.simulate", version: 1 };

/// A complete run in numbers that depend on the case alone: the same to the bit however often it was interrupted.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Summary {
    /// Name of the case or scenario.
    pub name: String,
    /// Number of the engine that made it.
    pub engine: u32,
    /// What was read of a robot.
    pub robot: Option<RobotSummary>,
    /// Time at which it went on from another run; 0 for a run from the start \[s\].
    #[serde(default)]
    pub began_s: f64,
    /// Simulated time at the end of the run \[s\].
    pub time_s: f64,
    /// Number of steps of the whole run.
    pub steps: u64,
    /// Length of the last time step \[s\].
    pub dt_s: f64,
    /// Number of nodes of the mesh.
    pub nodes: usize,
    /// Number of shell elements of the mesh.
    pub elements: usize,
    /// Mass added by scaling, over the true mass.
    pub added_mass_share: f64,
    /// Whether waves of a few elements are heavy in place of everything.
    pub selective_mass: bool,
    /// Shape of the elements: sides, and the worst ratios.
    pub quality: Option<MeshQuality>,
    /// Node sets that the case asks for.
    pub probes: Vec<ProbeEnd>,
    /// Pressure and volume of every chamber at the end.
    pub chambers: Vec<ChamberEnd>,
    /// Force and moment of every support at the end.
    #[serde(default)]
    pub reactions: Vec<ReactionEnd>,
    /// Energies of every term at the end.
    pub ledger: Vec<EnergyLine>,
    /// Kinetic energy at the end \[J\].
    pub kinetic_j: f64,
    /// Work done from outside since the start \[J\].
    pub external_work_j: f64,
    /// Energy that the balance misses at the end \[J\].
    pub residual_j: f64,
    /// The same over what it is judged against.
    pub residual_share: f64,
    /// Largest value of that share at any output.
    pub residual_share_peak: f64,
    /// Energy of hourglass control over all that is stored.
    #[serde(default)]
    pub hourglass_share: f64,
    /// Kinetic energy over kinetic and stored energy, at the outputs.
    pub kinetic_share: KineticShares,
    /// Nodes that came through a layer; without contact `None`.
    #[serde(default)]
    pub changed_sides: Option<Through>,
}

/// Shape of the elements: smallest, median and largest side, and the worst of each.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct MeshQuality {
    /// Smallest, median and largest side \[mm\].
    pub side_mm: [f64; 3],
    /// Largest ratio of longest to shortest side; 1 is best.
    pub aspect: f64,
    /// Smallest ratio of the corner areas of a quad; 1 is best.
    pub jacobian_ratio: f64,
    /// Largest distance of a quad's corners from its plane, over the root of its area.
    pub warpage: f64,
}

/// Mean displacement of a node set from where it started.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ProbeEnd {
    /// Name of the node set, as in the case.
    pub set: String,
    /// Mean displacement along x, y and z \[mm\].
    pub displacement_mm: [f64; 3],
}

/// Pressure and volume of one chamber at the end of the run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ChamberEnd {
    /// Name of the chamber, as in the case.
    pub name: String,
    /// Gauge pressure in the chamber \[kPa\].
    pub pressure_kpa: f64,
    /// Volume enclosed by the chamber's wall \[cm³\].
    pub volume_cm3: f64,
}

/// Force of a support on the structure, along the axes that it holds, and its moment about the middle of the set.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ReactionEnd {
    /// Name of the node set whose supports react.
    pub set: String,
    /// Force along the axes that are held \[N\].
    pub force_n: [Option<f64>; 3],
    /// Moment of these forces about the middle of the set \[N·m\].
    pub moment_nm: [f64; 3],
}

/// One energy of the ledger at the end of the run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct EnergyLine {
    /// Name of the term or supply in the ledger.
    pub name: String,
    /// Side of the balance: `stored`, `dissipated` or `supplied`.
    pub kind: String,
    /// Energy of the term at the end of the run \[J\].
    pub energy_j: f64,
}

/// Kinetic energy over kinetic and stored energy at the outputs after the start, compared with the two rules.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct KineticShares {
    /// Number of outputs after the start.
    pub outputs: usize,
    /// Median of the share over these outputs.
    pub median: Option<f64>,
    /// Share at the last output of the run.
    pub end: Option<f64>,
    /// Largest share at any of these outputs.
    pub peak: Option<f64>,
    /// Time of the output with the largest share \[s\].
    pub peak_time_s: Option<f64>,
    /// The rule of the paper's source.
    pub below_10_pct_of_internal: Rule,
    /// The paper's own rule: below 1 % of all energy.
    pub below_1_pct_of_total: Rule,
}

/// A bound of the kinetic energy.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Rule {
    /// Number of outputs that keep the rule.
    pub kept_at: usize,
    /// Last output that does not \[s\].
    pub last_broken_s: Option<f64>,
}

/// Cost of a run; part of the manifest.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Cost {
    /// Processor time of this session \[s\].
    pub cpu_s: f64,
    /// Processor time of all sessions \[s\].
    pub cpu_s_of_all_sessions: f64,
    /// Real time of this session \[s\].
    pub wall_s: f64,
    /// Threads asked for; 0: one per core.
    pub threads: usize,
    /// Step at which this session began.
    pub resumed_at_step: u64,
    /// Elements times steps per second of processor time, in this session.
    pub element_steps_per_cpu_s: f64,
}

impl Summary {
    /// Reads a run that has reached its end.
    pub(super) fn of(case: &Case, running: &Running, robot: Option<&WatchedRobot>) -> Summary {
        let (run, mesh) = (&running.run, &case.problem.mesh);
        let ledger = run.ledger_in_detail();
        let energy =
            |r: &models::Row| EnergyLine { name: r.name.into(), kind: r.kind.word().into(), energy_j: r.energy_j };
        let chamber = |c: crate::run::ChamberState| ChamberEnd {
            name: c.name,
            pressure_kpa: c.pressure_pa / 1e3,
            volume_cm3: c.volume_m3 * 1e6,
        };
        let reaction = |r: &crate::run::Reaction| ReactionEnd {
            set: r.set.clone(),
            force_n: [0, 1, 2].map(|k| r.axes[k].then_some(r.force_n[k])),
            moment_nm: r.moment_nm,
        };
        let positions = run.positions();
        let probe = |set: &String| {
            let moved = mesh.mean_moved(mesh.sets.get(set)?, &positions);
            Some(ProbeEnd { set: set.clone(), displacement_mm: moved.map(|d| d * 1e3) })
        };
        Summary {
            name: case.problem.name.clone(),
            engine: crate::ENGINE,
            robot: robot.zip(running.robot.as_ref()).map(|(robot, seen)| seen.summary(robot)),
            began_s: running.done.balances.first().map_or(0.0, |first| first.time_s),
            time_s: run.time_s(),
            steps: run.step(),
            dt_s: run.dt_s(),
            nodes: mesh.points.len(),
            elements: run.elements(),
            added_mass_share: run.added_mass(),
            selective_mass: run.selective_mass(),
            quality: quality(case),
            probes: case.outputs.probes.iter().filter_map(probe).collect(),
            chambers: run.chambers().into_iter().map(chamber).collect(),
            reactions: run.reactions().iter().map(reaction).collect(),
            ledger: ledger.rows.iter().map(energy).collect(),
            kinetic_j: ledger.kinetic_j,
            external_work_j: ledger.external_work_j,
            residual_j: ledger.residual_j,
            residual_share: ledger.residual_share(),
            residual_share_peak: running.done.balances.iter().fold(0.0, |most, b| b.residual_share.max(most)),
            hourglass_share: ledger.hourglass_share(),
            kinetic_share: kinetic(&running.done.balances),
            changed_sides: run.changed_sides(),
        }
    }

    /// What to know before believing the numbers: hourglass control, motion at the end, added mass, layers that were passed.
    pub fn warnings(&self) -> Vec<String> {
        let mut found = self.robot.as_ref().map_or(Vec::new(), RobotSummary::warnings);
        if policy::is_warped(self.hourglass_share) {
            found.push(format!("over 5 %, hourglass control is not small. Try: {}", LESS_HOURGLASS));
        }
        let stored = |of: &dyn Fn(&str) -> bool| {
            let rows = self.ledger.iter().filter(|row| row.kind == "stored" && of(&row.name));
            rows.map(|row| row.energy_j).sum::<f64>()
        };
        let contact = stored(&|name| name.ends_with("contact")) / stored(&|_| true);
        if policy::is_caught(contact) {
            found.push(format!(
                "contact holds {:.0} % of the stored energy at the end (usual: below 1 %): layers are caught in each other. Try: edges = \
                 true in [contact], a slower load, more mass_damping_1_s, or smaller elements",
                100.0 * contact
            ));
        }
        if let Some(end) = self.kinetic_share.end.filter(|end| !policy::is_at_rest(*end)) {
            found.push(format!(
                "{:.1} % of the energy still moves at the end: the state is not at rest. Simulate longer, load more slowly, or add mass_damping_1_s",
                100.0 * end
            ));
        }
        if policy::is_heavy(self.added_mass_share) {
            found.push("more mass was added than the fabric has: speeds are too low, and slow motions are late".into());
        }
        if let Some(Through { nodes, share, first: Some(first) }) = &self.changed_sides {
            found.push(format!(
                "nodes that came through a layer: {nodes}, {:.3} % of those in contact; the first: {}. Smaller elements, or edges = \
                 true in [contact], hold them",
                100.0 * share, first.text
            ));
        }
        found
    }
}

/// Shape of the elements; the run would not have started with a mesh that does not pass.
fn quality(case: &Case) -> Option<MeshQuality> {
    let problem = &case.problem;
    let chambers: Vec<&str> = problem.chambers.iter().map(|c| c.name.as_str()).collect();
    let open: Vec<&str> = problem.open.iter().map(String::as_str).collect();
    let quality = crate::mesh::check::check_open(&problem.mesh, &chambers, &open).ok()?;
    let side = &quality.side_m;
    Some(MeshQuality {
        side_mm: [side.min * 1e3, side.median * 1e3, side.max * 1e3],
        aspect: quality.aspect,
        jacobian_ratio: quality.jacobian_ratio,
        warpage: quality.warpage,
    })
}

fn kinetic(balances: &[EnergyBalance]) -> KineticShares {
    let later: Vec<&EnergyBalance> = balances.iter().filter(|b| b.time_s > 0.0).collect();
    let mut shares: Vec<f64> = later.iter().map(|b| b.kinetic_share).collect();
    shares.sort_by(f64::total_cmp);
    let peak = later.iter().max_by(|a, b| a.kinetic_share.total_cmp(&b.kinetic_share));
    let rule = |keeps: fn(f64) -> bool| {
        let broken: Vec<f64> = later.iter().filter(|b| !keeps(b.kinetic_share)).map(|b| b.time_s).collect();
        Rule { kept_at: later.len() - broken.len(), last_broken_s: broken.last().copied() }
    };
    KineticShares {
        outputs: later.len(),
        median: shares.get(shares.len() / 2).copied(),
        end: later.last().map(|b| b.kinetic_share),
        peak: peak.map(|b| b.kinetic_share),
        peak_time_s: peak.map(|b| b.time_s),
        below_10_pct_of_internal: rule(policy::is_valid),
        below_1_pct_of_total: rule(policy::is_at_rest),
    }
}

impl Cost {
    pub(super) fn of(case: &Case, running: &Running, wall: Duration) -> Cost {
        let (run, cpu_s) = (&running.run, running.cpu_s());
        let element_steps = (run.step() - running.began.0) as f64 * run.elements() as f64;
        Cost {
            cpu_s,
            cpu_s_of_all_sessions: running.done.cpu_s + cpu_s,
            wall_s: wall.as_secs_f64(),
            threads: case.problem.settings.threads,
            resumed_at_step: running.began.0,
            element_steps_per_cpu_s: share(element_steps, cpu_s),
        }
    }
}
