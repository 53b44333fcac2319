//! The robot of the generator, cut into cells; and the equilibrium of one cell.

use super::camera::Camera;
use super::drive::Drive;
use super::loads::{AttachedLoads, in_plane};
use super::root::root;
use super::supply::TrueSupply;
use super::wall::{CellMemory, CellWall};
use compare::error::CompareError;
use models::actuators::Family;
use models::{Loads, Model, Scenario};
use std::f64::consts::PI;

/// Cells of a robot: four times the model's segments, and not a multiple of the pouches' places of the markers.
pub(crate) const CELLS: usize = 48;

#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Cell {
    pub start_m: f64,
    pub length_m: f64,
    /// Distance of the centre line from the taut generator \[m\].
    pub centre_line_m: f64,
    pub drive: Option<Drive>,
    pub wall: CellWall,
}

#[derive(Debug, Clone, PartialEq)]
pub(crate) struct TrueRobot {
    pub cells: Vec<Cell>,
    pub length_m: f64,
    /// Marker stations where they really are \[m\].
    pub markers_m: Vec<f64>,
    pub supply: TrueSupply,
    pub loads: AttachedLoads,
    pub camera: Camera,
    /// Curvature of the robot without hidden effects at 30 kPa on 2 kPa \[1/m\]: the scale of what depends on size.
    pub scale_per_m: f64,
}

/// Pressures of the scale: the top of the standard protocol.
const SCALE_PA: [f64; 2] = [2e3, 30e3];

impl TrueRobot {
    /// The robot of a scenario. The only effect understood is `arm_growth`, the geometry of an external actuator.
    pub(crate) fn new(scenario: &Scenario) -> Result<TrueRobot, CompareError> {
        if scenario.wall != models::scenario::Wall::default() || !scenario.actuator.exists() {
            let problem =
                "the generator knows neither wall_stiffness_n_per_m nor a beam without [actuator]".to_string();
            return Err(CompareError::NotSimulated { problem });
        }
        let mut lift_share = 0.0;
        for effect in scenario.effects.iter() {
            if effect.name != "arm_growth" {
                let problem =
                    format!("the scenario already has the effect {}; start from one without effects", effect.name);
                return Err(CompareError::NotSimulated { problem });
            }
            lift_share = effect.values[0];
        }
        let scale_per_m = scale(scenario)?;
        let cells: Vec<Cell> = cells(scenario, lift_share, scale_per_m);
        Ok(TrueRobot {
            loads: AttachedLoads::none(cells.len(), in_plane(scenario.gravity_direction)),
            cells,
            length_m: scenario.length_m,
            markers_m: scenario.markers_m.clone(),
            supply: TrueSupply::default(),
            camera: Camera { length_m: scenario.length_m, ..Camera::default() },
            scale_per_m,
        })
    }

    /// Rolls the robot by 180°: gravity, a pulley, an obstacle and the camera stay where they are in the room.
    pub(crate) fn roll_over(&mut self) {
        let loads = &mut self.loads;
        loads.down[1] = -loads.down[1];
        loads.pulley_m[1] = -loads.pulley_m[1];
        // It stood on the side to which the robot bent.
        loads.obstacle_n_per_m = 0.0;
        self.camera.roll_rad = self.camera.roll_rad.map(|roll| -roll);
    }

    /// Calls `change` on every cell with its middle \[m\].
    pub(crate) fn each(&mut self, mut change: impl FnMut(&mut Cell, f64)) {
        for cell in &mut self.cells {
            let middle = cell.start_m + 0.5 * cell.length_m;
            change(cell, middle);
        }
    }
}

/// Largest curvature of the bare robot at [`SCALE_PA`].
fn scale(scenario: &Scenario) -> Result<f64, CompareError> {
    let model = Model::new(scenario);
    let mut state = model.prediction();
    model.predict(&Loads::uniform(SCALE_PA[0], SCALE_PA[1]), &mut state)?;
    Ok(model.curvatures(&state).fold(1e-3, |most, (_, kappa)| f64::max(most, kappa)))
}

fn cells(scenario: &Scenario, lift_share: f64, scale_per_m: f64) -> Vec<Cell> {
    let mut cells = Vec::new();
    for span in scenario.spans() {
        let count = ((CELLS as f64 * span.length_m / scenario.length_m).round() as usize).max(1);
        let length_m = span.length_m / count as f64;
        let drive = span.actuator.map(|actuator| Drive {
            family: actuator.family,
            length_m: span.shape.length_m,
            width_m: span.shape.width_m,
            gain: span.shape.volume_gain,
            arm_m: span.arm_m,
            lift_share,
            strength: 1.0,
            edge_loss: [0.0; 2],
            swell_m: [0.0; 2],
            stretch_m_per_n: [0.0; 2],
            crease_nm: [0.0; 2],
            shear_n_per_m: [0.0; 2],
            lock_n_per_m: [0.0; 2],
        });
        let wall = CellWall {
            bending: span.bending_stiffness,
            hinge_m3: scenario.hinge_share * PI * span.radius_m.powi(3),
            step_per_m: scenario.hinge_curvature,
            scale_per_m,
            ..CellWall::default()
        };
        let start = |i: usize| span.start_m + i as f64 * length_m;
        cells.extend((0..count).map(|i| Cell {
            start_m: start(i),
            length_m,
            centre_line_m: span.centre_line_m,
            drive,
            wall,
        }));
    }
    cells
}

/// What acts on one cell in one step of time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct CellLoads {
    pub p_body_pa: f64,
    pub p_act_pa: f64,
    /// Moment of weights and forces about the cell \[N·m\].
    pub moment: f64,
    pub dt_s: f64,
}

/// Actuator pressure below which a pouch is slack \[Pa\].
const SLACK_PA: f64 = 1e-6;
/// Bend radius of 10 mm \[1/m\].
const FOLDED_PER_M: f64 = 100.0;

impl Cell {
    pub(crate) fn is(&self, family: Family) -> bool {
        self.drive.is_some_and(|drive| drive.family == family)
    }

    /// Curvature at which actuator, body and loads balance.
    pub(super) fn solve(&self, acting: &CellLoads, memory: &CellMemory) -> Option<f64> {
        match &self.drive {
            Some(drive) if drive.strength * acting.p_act_pa > SLACK_PA => {
                let (low, high) = drive.range();
                let a = root(|a| self.imbalance(drive, a, acting, memory).1, low, high)?;
                Some(self.imbalance(drive, a, acting, memory).0)
            }
            _ => {
                let left = |k: f64| acting.moment - self.wall.moment(k, acting.p_body_pa, memory, acting.dt_s);
                root(left, -FOLDED_PER_M, FOLDED_PER_M)
            }
        }
    }

    /// Curvature at a coordinate, and the weighted moment that is left: N ∂(κD)/∂κ + M_load − M_wall.
    fn imbalance(&self, drive: &Drive, a: f64, acting: &CellLoads, memory: &CellMemory) -> (f64, f64) {
        let pull = drive.at(a, acting.p_act_pa);
        let mut kappa = pull.contraction / pull.arm;
        let mut tension = 0.0;
        // The arm gives way to curvature (ovalization) and the fabric to tension: both small, so a few rounds suffice.
        for _ in 0..ROUNDS {
            let (factor, _) = self.wall.arm_factor(kappa);
            tension = pull.push / (pull.d_contraction - kappa * factor * pull.d_arm);
            let next = (pull.contraction - drive.stretch(tension)) / (pull.arm * factor);
            let done = (next - kappa).abs() <= 1e-13 * next.abs();
            kappa = next;
            if done {
                break;
            }
        }
        let slope = pull.arm * self.wall.arm_factor(kappa).1;
        let wall = self.wall.moment(kappa, acting.p_body_pa, memory, acting.dt_s);
        (kappa, (tension * slope + acting.moment - wall) * pull.weight)
    }
}

/// Rounds of the fixed point in [`Cell::imbalance`].
const ROUNDS: usize = 30;
