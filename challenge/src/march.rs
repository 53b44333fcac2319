//! A run: the protocol in time, cell by cell, with what the cells remember.

use super::poses::CellPoses;
use super::robot::{CellLoads, TrueRobot};
use super::wall::{CellMemory, CellWall};
use compare::error::CompareError;
use data::Hold;

/// Time in which a regulator reaches a new set pressure \[s\].
const RAMP_S: f64 = 0.4;
const RAMP_STEPS: usize = 8;
/// Longest step while a pressure is held \[s\].
const LONGEST_STEP_S: f64 = 0.5;
/// Rounds in which loads and shape must agree: where each takes only a fiftieth of the gap, 350 make it a thousand times smaller.
const MAX_ROUNDS: usize = 2000;
/// Target agreement \[N·m\]: a millionth of a hinge moment.
const AGREED_NM: f64 = 1e-7;

struct March<'a> {
    robot: &'a TrueRobot,
    gain: f64,
    memory: Vec<CellMemory>,
    curvatures: Vec<f64>,
    moments: Vec<f64>,
}

/// Pressures and time step of one call of the solver.
#[derive(Clone, Copy)]
struct Instant {
    p_body_pa: f64,
    set_pa: f64,
    held_s: f64,
    dt_s: f64,
}

/// Marker positions of one run as an ideal camera records them, `[hold][sample][marker][x, y]` \[m\]; `gains` are
/// the run's factors on the actuator pressure of the holds.
pub(crate) fn run(robot: &TrueRobot, holds: &[Hold], gains: &[f64]) -> Result<Vec<f64>, CompareError> {
    let n = robot.cells.len();
    let mut march = March {
        robot,
        gain: 1.0,
        memory: vec![CellMemory::default(); n],
        curvatures: vec![0.0; n],
        moments: vec![0.0; n],
    };
    let (mut xy_m, mut set_pa, mut time_s) = (Vec::new(), 0.0, 0.0);
    for (hold, gain) in holds.iter().zip(gains) {
        let begin_s = time_s;
        march.gain = *gain;
        if robot.remembers() {
            march.ramp(hold, set_pa)?;
            time_s += RAMP_S;
        }
        for (k, t_s) in hold.t_s.iter().enumerate() {
            if k == 0 || robot.remembers() || robot.supply.leak_per_s != [0.0; 2] {
                march.hold(hold, begin_s, &mut time_s, *t_s)?;
            }
            march.sight(hold.p_act_pa, &mut xy_m);
        }
        set_pa = hold.p_act_pa;
        time_s = hold.t_s.last().copied().unwrap_or(time_s);
    }
    Ok(xy_m)
}

/// For how long a set pressure has been held since it was reached \[s\]; the hold before ended at `begin_s`.
pub(super) fn held_s(time_s: f64, begin_s: f64) -> f64 {
    (time_s - begin_s - RAMP_S).max(0.0)
}

impl TrueRobot {
    fn remembers(&self) -> bool {
        let memory =
            |wall: &CellWall| [wall.friction_nm, wall.creep_nm2, wall.set].as_flattened().iter().any(|v| *v != 0.0);
        self.cells.iter().any(|cell| memory(&cell.wall))
    }
}

impl March<'_> {
    fn ramp(&mut self, hold: &Hold, from_pa: f64) -> Result<(), CompareError> {
        for step in 1..=RAMP_STEPS {
            let share = step as f64 / RAMP_STEPS as f64;
            let set_pa = if step == RAMP_STEPS { hold.p_act_pa } else { from_pa + share * (hold.p_act_pa - from_pa) };
            let dt_s = RAMP_S / RAMP_STEPS as f64;
            self.step(&Instant { p_body_pa: hold.p_body_pa, set_pa, held_s: 0.0, dt_s })?;
        }
        Ok(())
    }

    fn hold(&mut self, hold: &Hold, begin_s: f64, time_s: &mut f64, until_s: f64) -> Result<(), CompareError> {
        let left = (until_s - *time_s).max(0.0);
        let steps = if self.robot.remembers() { (left / LONGEST_STEP_S).ceil().max(1.0) } else { 1.0 };
        for _ in 0..steps as usize {
            let dt_s = left / steps;
            *time_s += dt_s;
            let held_s = held_s(*time_s, begin_s);
            self.step(&Instant { p_body_pa: hold.p_body_pa, set_pa: hold.p_act_pa, held_s, dt_s })?;
        }
        Ok(())
    }

    fn step(&mut self, at: &Instant) -> Result<(), CompareError> {
        if self.robot.loads.any() {
            self.agree(at)?;
        } else {
            self.solve(at)?;
        }
        for ((cell, memory), kappa) in self.robot.cells.iter().zip(&mut self.memory).zip(&self.curvatures) {
            cell.wall.remember(*kappa, memory, at.dt_s);
        }
        Ok(())
    }

    /// Moments and shape in turn, more cautiously whenever they part.
    fn agree(&mut self, at: &Instant) -> Result<(), CompareError> {
        let (mut share, mut before) = (1.0, f64::INFINITY);
        for _ in 0..MAX_ROUNDS {
            self.solve(at)?;
            let wanted =
                CellPoses::new(&self.robot.cells, &self.curvatures).moments(&self.robot.cells, &self.robot.loads);
            let gap = wanted.iter().zip(&self.moments).fold(0.0_f64, |most, (w, m)| most.max((w - m).abs()));
            if gap < AGREED_NM {
                return Ok(());
            }
            if gap > 0.95 * before {
                share = f64::max(0.5 * share, 0.02);
            }
            before = gap;
            self.moments.iter_mut().zip(wanted).for_each(|(m, w)| *m += share * (w - *m));
        }
        Err(unbalanced(at, "loads and shape do not agree"))
    }

    fn solve(&mut self, at: &Instant) -> Result<(), CompareError> {
        let cells = &self.robot.cells;
        let p_act_pa = self.robot.supply.pressure(at.set_pa, self.gain, at.held_s);
        for i in 0..cells.len() {
            let alike = i > 0
                && cells[i].drive == cells[i - 1].drive
                && cells[i].wall == cells[i - 1].wall
                && self.moments[i] == self.moments[i - 1]
                && self.memory[i] == self.memory[i - 1];
            self.curvatures[i] = if alike {
                self.curvatures[i - 1]
            } else {
                let (p_body_pa, dt_s) = (at.p_body_pa, at.dt_s);
                let acting = CellLoads { p_body_pa, p_act_pa, moment: self.moments[i], dt_s };
                let solved = cells[i].solve(&acting, &self.memory[i]);
                solved.ok_or_else(|| unbalanced(at, &format!("s = {:.0} mm", cells[i].start_m * 1e3)))?
            };
        }
        Ok(())
    }

    fn sight(&self, set_pa: f64, xy_m: &mut Vec<f64>) {
        let shape = CellPoses::new(&self.robot.cells, &self.curvatures);
        for station in &self.robot.markers_m {
            let point = shape.point(&self.robot.cells, &self.curvatures, *station);
            xy_m.extend(self.robot.camera.see(&point, set_pa));
        }
    }
}

fn unbalanced(at: &Instant, place: &str) -> CompareError {
    let (p, body) = (at.set_pa / 1e3, at.p_body_pa / 1e3);
    let problem =
        format!("nothing balances at {p} kPa on a body of {body} kPa ({place}); make the hidden effect smaller");
    CompareError::NotSimulated { problem }
}
