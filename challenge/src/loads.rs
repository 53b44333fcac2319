//! Weights and forces on the robot.

/// Height of the base over the table \[m\].
const TABLE_M: f64 = 0.3;

#[derive(Debug, Clone, PartialEq)]
pub(crate) struct AttachedLoads {
    pub weight_n_per_m: Vec<f64>,
    /// Unit vector of gravity in the plane of bending.
    pub down: [f64; 2],
    pub cable_n: f64,
    pub pulley_m: [f64; 2],
    pub cap_n: f64,
    /// Weight per length of a hose that hangs from the tip down to a table below the base \[N/m\].
    pub hose_n_per_m: f64,
    /// Known force on the tip, as `about.toml` states \[N\].
    pub tip_n: [f64; 2],
    pub obstacle_n_per_m: f64,
    pub obstacle_y_m: f64,
}

/// x and y of a direction: a planar robot has no other.
pub(crate) fn in_plane([x, y, _]: [f64; 3]) -> [f64; 2] {
    [x, y]
}

impl AttachedLoads {
    pub(crate) fn none(cells: usize, down: [f64; 2]) -> AttachedLoads {
        AttachedLoads {
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
