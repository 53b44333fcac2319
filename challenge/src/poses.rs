//! Centre line of the cells, and the moments that weights and forces exert on them.

use super::camera::SeenPoint;
use super::loads::AttachedLoads;
use super::robot::Cell;

/// Shape of the robot: the start of every cell and its end, by exact arcs of the shortened centre line.
pub(super) struct CellPoses {
    nodes: Vec<[f64; 2]>,
    headings: Vec<f64>,
}

impl CellPoses {
    pub(crate) fn new(cells: &[Cell], curvatures: &[f64]) -> CellPoses {
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
    pub(crate) fn point(&self, cells: &[Cell], curvatures: &[f64], station_m: f64) -> SeenPoint {
        let i = cells.iter().rposition(|cell| cell.start_m <= station_m).unwrap_or(0);
        let (cell, offset) = (&cells[i], station_m - cells[i].start_m);
        let xy = along(self.nodes[i], self.headings[i], curvatures[i], offset, cell.centre_line_m);
        SeenPoint { xy, heading: self.headings[i] + curvatures[i] * offset, station_m }
    }

    /// Generalised force of the loads on every curvature \[N·m\]: the turn of everything beyond the cell's middle, and the
    /// shortening of the centre line there.
    pub(crate) fn moments(&self, cells: &[Cell], loads: &AttachedLoads) -> Vec<f64> {
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
