//! Centre line of the cells, and the moments that weights and forces exert on them.

use super::camera::SeenPoint;
use super::robot::Cell;

/// Height of the base over the table \[m\].
const TABLE_M: f64 = 0.3;

/// Weights and forces; all off at 0.
#[derive(Debug, Clone, PartialEq)]
pub struct DeadLoads {
    /// Weight per length of each cell \[N/m\].
    pub weight_n_per_m: Vec<f64>,
    /// Unit vector of gravity.
    pub down: [f64; 2],
    /// Pull of a cable on the tip \[N\].
    pub cable_n: f64,
    /// The cable's pulley \[m\].
    pub pulley_m: [f64; 2],
    /// Weight of what the tip carries \[N\].
    pub cap_n: f64,
    /// Weight per length of a hose that hangs from the tip down to a table below the base \[N/m\].
    pub hose_n_per_m: f64,
    /// Known force on the tip, as `about.toml` says \[N\].
    pub tip_n: [f64; 2],
    /// Stiffness of a soft obstacle in the tip's way \[N/m\].
    pub obstacle_n_per_m: f64,
    /// y at which the obstacle begins \[m\].
    pub obstacle_y_m: f64,
}

impl DeadLoads {
    /// Nothing.
    pub fn none(cells: usize, down: [f64; 2]) -> DeadLoads {
        DeadLoads {
            weight_n_per_m: vec![0.0; cells],
            down,
            cable_n: 0.0,
            pulley_m: [0.0; 2],
            cap_n: 0.0,
            hose_n_per_m: 0.0,
            tip_n: [0.0; 2],
            obstacle_n_per_m: 0.0,
            obstacle_y_m: 0.0,
        }
    }

    pub(super) fn any(&self) -> bool {
        [self.cable_n, self.cap_n, self.hose_n_per_m].iter().any(|load| *load != 0.0)
            || self.tip_n != [0.0; 2]
            || self.obstacle_n_per_m != 0.0
            || self.weight_n_per_m.iter().any(|w| *w != 0.0)
    }

    /// Force on a tip there \[N\].
    pub(super) fn on_tip(&self, tip: [f64; 2]) -> [f64; 2] {
        let to_pulley = [self.pulley_m[0] - tip[0], self.pulley_m[1] - tip[1]];
        let distance = to_pulley[0].hypot(to_pulley[1]).max(1e-9);
        let pressed = (tip[1] - self.obstacle_y_m).max(0.0) * self.obstacle_n_per_m;
        let cable = to_pulley.map(|d| self.cable_n * d / distance);
        let lifted_m = (TABLE_M - tip[0] * self.down[0] - tip[1] * self.down[1]).max(0.0);
        let hung = self.down.map(|d| d * (self.cap_n + self.hose_n_per_m * lifted_m));
        [self.tip_n[0] + cable[0] + hung[0], self.tip_n[1] + cable[1] + hung[1] - pressed]
    }
}

/// Shape of the robot: the start of every cell and its end, by exact arcs of the shortened centre line.
pub(super) struct CellPoses {
    nodes: Vec<[f64; 2]>,
    headings: Vec<f64>,
}

impl CellPoses {
    pub fn new(cells: &[Cell], curvatures: &[f64]) -> CellPoses {
        let (mut xy, mut heading) = ([0.0; 2], 0.0);
        let mut shape = CellPoses { nodes: vec![xy], headings: vec![heading] };
        for (cell, kappa) in cells.iter().zip(curvatures) {
            xy = along(xy, heading, *kappa, cell.length_m, cell.centre_line_m);
            heading += kappa * cell.length_m;
            shape.nodes.push(xy);
            shape.headings.push(heading);
        }
        shape
    }

    /// The point of the centre line at a station.
    pub fn point(&self, cells: &[Cell], curvatures: &[f64], station_m: f64) -> SeenPoint {
        let i = cells.iter().rposition(|cell| cell.start_m <= station_m).unwrap_or(0);
        let (cell, offset) = (&cells[i], station_m - cells[i].start_m);
        let xy = along(self.nodes[i], self.headings[i], curvatures[i], offset, cell.centre_line_m);
        SeenPoint { xy, heading: self.headings[i] + curvatures[i] * offset, station_m }
    }

    /// Generalised force of the loads on every curvature \[N·m\]: the turn of what lies beyond the cell's middle, and the
    /// shortening of the centre line there.
    pub fn moments(&self, cells: &[Cell], loads: &DeadLoads) -> Vec<f64> {
        let tip = self.nodes[cells.len()];
        let mut beyond = FarForces { force: [0.0; 2], turn: 0.0 };
        beyond.add(tip, loads.on_tip(tip));
        let mut moments = vec![0.0; cells.len()];
        for (i, cell) in cells.iter().enumerate().rev() {
            let (a, b) = (self.nodes[i], self.nodes[i + 1]);
            let middle = [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])];
            let half = 0.5 * loads.weight_n_per_m[i] * cell.length_m;
            let weight = loads.down.map(|d| half * d);
            beyond.add(middle, weight);
            let (sin, cos) = (0.5 * (self.headings[i] + self.headings[i + 1])).sin_cos();
            let [fx, fy] = beyond.force;
            let lever = beyond.turn - (middle[0] * fy - middle[1] * fx);
            moments[i] = lever - cell.centre_line_m * (cos * fx + sin * fy);
            beyond.add(middle, weight);
        }
        moments
    }
}

/// Sum of the forces beyond a place, and their turning moment about the origin.
struct FarForces {
    force: [f64; 2],
    turn: f64,
}

impl FarForces {
    fn add(&mut self, at: [f64; 2], force: [f64; 2]) {
        self.force = [self.force[0] + force[0], self.force[1] + force[1]];
        self.turn += at[0] * force[1] - at[1] * force[0];
    }
}

/// End of an arc of curvature `kappa` over a taut length; its centre line is (1 − κR) as long.
fn along([x, y]: [f64; 2], heading: f64, kappa: f64, taut_m: f64, centre_line_m: f64) -> [f64; 2] {
    let turn = 0.5 * kappa * taut_m;
    let chord = (1.0 - kappa * centre_line_m) * taut_m * if turn.abs() < 1e-8 { 1.0 } else { turn.sin() / turn };
    let (sin, cos) = (heading + turn).sin_cos();
    [x + chord * cos, y + chord * sin]
}
