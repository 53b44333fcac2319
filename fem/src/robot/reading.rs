//! What a robot looks like at one moment: markers, tip, volumes, stresses, weld forces, energies.

use models::Scenario;
use serde::{Deserialize, Serialize};

use super::inflated::{InflatedPouch, Tape};
use super::rest::Rest;
use super::seams::Seams;
use super::{marker_points, sections, sew};
use crate::output::centre_line::CentreLine;
use crate::vec3::{V3, along, cross, share};
use crate::{FemError, Mesh, Problem, Simulation};

impl Reading {
    /// Displacement along z of the tip, and the largest of all markers and the tip, with its sign \[m\].
    pub fn out_of_plane_m(&self) -> [f64; 2] {
        let z = |d: &[f64; 3]| d[2];
        let largest = |most: f64, z: f64| if z.abs() > most.abs() { z } else { most };
        [self.moved_m.last().map_or(0.0, z), self.moved_m.iter().map(z).fold(0.0, largest)]
    }

    /// The displacement of the tip along z over its whole displacement; 0 where it did not move.
    pub(crate) fn out_of_plane_share(&self) -> f64 {
        let [x, y, z] = self.moved_m.last().copied().unwrap_or_default();
        share(z.abs(), x.hypot(y).hypot(z))
    }
}

/// Reads a robot while it runs.
#[derive(Debug, Clone)]
pub(crate) struct RobotGauge {
    line: CentreLine,
    seen: CentreLine,
    rings: Vec<Vec<u32>>,
    tip: Vec<u32>,
    seams: Seams,
    /// Where the pouches of every strip begin, and their distance, along the straight robot \[m\].
    pouches_m: Vec<[f64; 2]>,
    tape: Option<Tape>,
    mesh: Mesh,
    is_spatial: bool,
}

/// A robot at one moment; SI, displacements from the start.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Reading {
    /// Simulated time of the reading \[s\].
    pub time_s: f64,
    /// Actuator gauge pressure \[Pa\]; the highest of all strips.
    pub actuator_pa: f64,
    /// Gauge pressure of every strip \[Pa\]; none in readings that did not keep it.
    #[serde(default)]
    pub strips_pa: Vec<f64>,
    /// Gauge pressure in the body \[Pa\].
    pub body_pa: f64,
    /// Marker stations and, last, the tip \[m\].
    pub stations_m: Vec<f64>,
    /// Displacement of the section's centroid at each station \[m\].
    pub moved_m: Vec<[f64; 3]>,
    /// Displacement of the wall where a marker sticks at each marker's station, without the tip \[m\]: on the side that faces a
    /// camera. With strips round the body no side is free of them, and it is the section's centroid.
    pub seen_moved_m: Vec<[f64; 3]>,
    /// Displacement of the mean of the ring of nodes at (or next to) each station \[m\].
    pub ring_moved_m: Vec<[f64; 3]>,
    /// Turn of the tip's ring \[rad\]: in the x–y plane, positive towards the actuator; with strips round the body the angle between
    /// its normal and the straight one.
    pub tip_angle_rad: f64,
    /// Volume of gas in the body \[m³\].
    pub body_m3: f64,
    /// Volume of the actuator, all strips \[m³\].
    pub actuator_m3: f64,
    /// Largest von Mises stress \[Pa\], with the part and the place along the robot \[m\] of its element.
    pub von_mises_pa: f64,
    /// Part of the element with that stress.
    pub von_mises_part: String,
    /// Its place along the straight robot \[m\].
    pub von_mises_at_m: f64,
    /// Whether this element is next to a weld.
    #[serde(default)]
    pub von_mises_on_seam: bool,
    /// Largest pull on a weld \[N/m\].
    pub seam_n_per_m: f64,
    /// Part of the element that pulls.
    pub seam_part: String,
    /// Its place along the straight robot \[m\].
    pub seam_at_m: f64,
    /// The weld: `seam 3` is the third across the robot from the base, `side of pouch 3` runs along it; empty in readings that
    /// did not keep it.
    #[serde(default)]
    pub seam: String,
    /// That pull over the strength of a weld, where `weld_strength_n_per_m` is known.
    #[serde(default)]
    pub seam_share: Option<f64>,
    /// Force of the support at the base on the robot \[N\]; 0 in readings that did not keep it.
    #[serde(default)]
    pub base_n: [f64; 3],
    /// Its moment about the middle of the nodes that are held \[N·m\].
    #[serde(default)]
    pub base_nm: [f64; 3],
    /// Shape of the pouches; `None` for one unit, and in readings that did not keep it.
    #[serde(default)]
    pub inflated: Option<InflatedPouch>,
    /// Ledger: name, `stored`, `dissipated` or `supplied`, and energy \[J\].
    pub ledger: Vec<(String, String, f64)>,
    /// Kinetic over kinetic and stored energy.
    pub kinetic_share: f64,
    /// Time that the hold waited for rest \[s\].
    pub waited_s: f64,
    /// How far the tip still goes by its last movements \[m\]; `None` without waiting.
    pub ahead_m: Option<f64>,
    /// Whether the tip is at rest, by `fem/src/robot/rest.rs`.
    pub is_at_rest: bool,
}

impl RobotGauge {
    /// For a robot's problem.
    ///
    /// # Errors
    /// [`FemError::Problem`] for a marker off the robot.
    pub(crate) fn new(scenario: &Scenario, problem: &Problem) -> Result<RobotGauge, FemError> {
        let mesh = problem.mesh.clone();
        let mut stations_m = scenario.markers_m.clone();
        let mut rings: Vec<Vec<u32>> = (1..=stations_m.len()).map(|k| ring(&mesh, &format!("marker_{k}"))).collect();
        let tip = ring(&mesh, "tip");
        // The tip may carry a marker; it is listed once more then, as the tip.
        stations_m.push(scenario.length_m);
        rings.push(tip.clone());
        let line = sections(&mesh, &stations_m)?;
        let seen = match scenario.is_spatial() {
            true => sections(&mesh, &scenario.markers_m)?,
            false => marker_points(&mesh, &scenario.markers_m)?,
        };
        Ok(RobotGauge {
            line,
            seen,
            rings,
            tip,
            seams: Seams::of(&mesh),
            pouches_m: scenario
                .strips()
                .map(|strip| [strip.start_m, strip.shape.length_m * strip.cos_slant(scenario.radius_m)])
                .collect(),
            tape: Tape::of(scenario, &mesh),
            mesh,
            is_spatial: scenario.is_spatial(),
        })
    }

    /// The robot now.
    ///
    /// # Errors
    /// [`FemError::Problem`] if the run is of another mesh.
    pub(crate) fn read(&self, run: &Simulation, rest: Rest) -> Result<Reading, FemError> {
        let (positions, fields) = (run.positions(), run.element_fields());
        let (waited_s, ahead_m, is_at_rest) = match rest {
            Rest::Over { waited_s, ahead_m, is_at_rest } => {
                (waited_s, ahead_m.is_finite().then_some(ahead_m), is_at_rest)
            }
            Rest::Until(_) => (0.0, None, false),
        };
        let peak = |values: &[f64]| (0..values.len()).max_by(|a, b| values[*a].total_cmp(&values[*b])).unwrap_or(0);
        let hottest = peak(&fields.von_mises_pa);
        let seam = self.seams.largest(&fields);
        let (von_mises_part, von_mises_at_m) = self.place(hottest);
        let (seam_part, seam_at_m) = seam.map_or((String::new(), 0.0), |s| self.place(s.element));
        let seam_name = seam.map_or(String::new(), |s| self.weld(s.is_across, &seam_part, seam_at_m));
        let (body, strips): (Vec<_>, Vec<_>) = run.chambers().into_iter().partition(|c| c.name == sew::BODY);
        let strips_pa: Vec<f64> = strips.iter().map(|c| c.pressure_pa).collect();
        // The base is the only thing that is held, with one row of nodes or two.
        let base = run.reactions().first();
        let ledger = run.ledger_in_detail();
        let mut rows = vec![("kinetic".to_string(), "stored".to_string(), ledger.kinetic_j)];
        rows.extend(ledger.rows.iter().map(|r| (r.name.to_string(), r.kind.word().to_string(), r.energy_j)));
        Ok(Reading {
            time_s: run.time_s(),
            actuator_pa: strips_pa.iter().copied().fold(0.0, f64::max),
            strips_pa,
            body_pa: body.first().map_or(0.0, |c| c.pressure_pa),
            stations_m: self.line.stations_m().to_vec(),
            moved_m: self.line.moved_m(&positions)?,
            seen_moved_m: self.seen.moved_m(&positions)?,
            ring_moved_m: self.rings.iter().map(|ring| self.mesh.mean_moved(ring, &positions)).collect(),
            tip_angle_rad: self.turn_rad(&positions),
            body_m3: body.first().map_or(0.0, |c| c.volume_m3),
            actuator_m3: strips.iter().map(|c| c.volume_m3).sum(),
            von_mises_pa: fields.von_mises_pa.get(hottest).copied().unwrap_or(0.0),
            von_mises_part,
            von_mises_at_m,
            von_mises_on_seam: self.seams.elements().binary_search(&hottest).is_ok(),
            seam_n_per_m: seam.map_or(0.0, |s| s.n_per_m),
            seam_part,
            seam_at_m,
            seam: seam_name,
            seam_share: None,
            base_n: base.map_or([0.0; 3], |r| r.force_n),
            base_nm: base.map_or([0.0; 3], |r| r.moment_nm),
            inflated: self.tape.as_ref().map(|tape| tape.read(&positions)),
            ledger: rows,
            kinetic_share: ledger.kinetic_share(),
            waited_s,
            ahead_m,
            is_at_rest,
        })
    }

    /// Displacement of the mean of the tip's ring \[m\].
    pub(crate) fn tip_moved_m(&self, run: &Simulation) -> V3 {
        self.mesh.mean_moved(&self.tip, &run.positions())
    }

    /// Part and place along the straight robot of an element.
    pub(crate) fn place(&self, element: usize) -> (String, f64) {
        let mut first = 0;
        for part in &self.mesh.parts {
            if element < first + part.len() {
                let nodes = part.nodes(element - first);
                let sum: f64 = nodes.iter().map(|n| self.mesh.points[*n as usize][0]).sum();
                return (part.name.clone(), sum / nodes.len() as f64);
            }
            first += part.len();
        }
        (String::new(), f64::NAN)
    }

    /// Name of the weld next to an element of a part at a place along the straight robot \[m\].
    fn weld(&self, is_across: bool, part: &str, at_m: f64) -> String {
        let strip = (1..self.pouches_m.len()).rev().find(|i| sew::of_strip(sew::plain(part), *i) == part).unwrap_or(0);
        let [start_m, pitch_m] = self.pouches_m[strip];
        let pouches = (at_m - start_m) / pitch_m;
        let of = if strip > 0 { format!(" of strip {}", strip + 1) } else { String::new() };
        match is_across {
            true => format!("seam {:.0}{of}", pouches.round().max(0.0) + 1.0),
            false => format!("side of pouch {:.0}{of}", pouches.floor().max(0.0) + 1.0),
        }
    }

    /// Turn of the tip's ring for node positions in mesh order \[rad\]: its height vector Σ (y₀ − ȳ₀) x turns with the tip.
    pub(super) fn turn_rad(&self, positions: &[V3]) -> f64 {
        if self.is_spatial {
            let normal = self.normal(positions);
            return normal[1].hypot(normal[2]).atan2(normal[0]);
        }
        let start = |node: u32| self.mesh.start_of(node as usize);
        let middle = self.tip.iter().map(|n| start(*n)[1]).sum::<f64>() / self.tip.len() as f64;
        let (mut now, mut before) = ([0.0; 2], [0.0; 2]);
        for node in &self.tip {
            let height = start(*node)[1] - middle;
            for k in 0..2 {
                now[k] += height * positions[*node as usize][k];
                before[k] += height * start(*node)[k];
            }
        }
        let cross = before[0] * now[1] - before[1] * now[0];
        let dot = before[0] * now[0] + before[1] * now[1];
        cross.atan2(dot)
    }

    /// Normal of the tip's ring, x at the start, from its moments Σ (y₀ − ȳ₀) x and Σ (z₀ − z̄₀) x.
    fn normal(&self, positions: &[V3]) -> V3 {
        let starts = || self.tip.iter().map(|node| self.mesh.start_of(*node as usize));
        let moment = |axis: usize| {
            let middle = starts().map(|p| p[axis]).sum::<f64>() / self.tip.len() as f64;
            self.tip
                .iter()
                .zip(starts())
                .fold([0.0; 3], |sum, (node, start)| along(sum, start[axis] - middle, positions[*node as usize]))
        };
        cross(moment(1), moment(2))
    }
}

fn ring(mesh: &Mesh, name: &str) -> Vec<u32> {
    mesh.sets.get(name).cloned().unwrap_or_default()
}
