//! What contact remembers of one node near one piece of a layer.

use super::closest::{Closest, Feature};
use super::surface::ContactSurface;
use crate::vec3::V3;

/// Distances that decide about pairs \[m\].
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct ContactReach {
    /// A side is decided, and remembered, within this distance.
    pub side_m: f64,
    /// Candidates are complete up to `side_m` while nodes move less than half of this.
    pub(crate) skin_m: f64,
    /// Nodes may move this much against each other between two looks at a pair that is nearly touching.
    pub(crate) slack_m: f64,
    /// Within this of a triangle its plane is used: there the surface is nearly flat.
    pub flat_m: f64,
    /// Rest gap of pairs that meet during the run.
    pub thickness_m: f64,
    /// Largest rest gap between elements of one layer, whose own mesh must not push itself.
    pub(crate) own_layer_m: f64,
    /// The rest gap of a pair that is pressed closer than this grows, lest the two meet.
    pub(crate) floor_m: f64,
    /// Nothing passes through anything, so the present side of a face is the right one.
    pub solid: bool,
}

/// A node and a connected piece of one layer.
#[derive(Debug, Clone, Copy, Default, serde::Serialize, serde::Deserialize)]
pub(super) struct Record {
    pub node: u32,
    /// Corners of the triangle that is touched.
    pub corners: [u32; 3],
    pub element: u32,
    pub layer: u32,
    pub feature: Feature,
    /// Remembered side: +1 in front of the layer, −1 behind, 0 not decided.
    pub side: i8,
    /// True if the touched layer is the node's own.
    pub own: bool,
    /// First candidate in the chunk's list, and their number.
    pub first: u32,
    pub count: u32,
    /// Sign that turns the measured distance into one that grows away from the layer on the remembered side.
    pub sign: f64,
    /// Distance that is kept now, and its target \[m\].
    pub(crate) rest_m: f64,
    pub wanted_m: f64,
    pub(crate) stiffness_n_m: f64,
    pub(crate) damping_n_s_m: f64,
    /// Distance at the last look \[m\].
    pub distance_m: f64,
    /// Distance of the closest point at the last look, less the way of the chunk then; this plus the way now
    /// is an upper bound.
    pub(crate) within_m: f64,
    /// Way of the chunk at which to look again.
    pub(crate) due_m: f64,
    pub(crate) spring_m: V3,
    /// Depth in the step before \[m\].
    pub last_m: f64,
    /// Damping force of the step before \[N\].
    pub(crate) damped_n: f64,
}

impl Record {
    pub(super) fn new() -> Record {
        Record { within_m: f64::INFINITY, due_m: f64::NEG_INFINITY, ..Record::default() }
    }

    /// True if the step before left something to account for.
    pub(super) fn holds(&self) -> bool {
        self.damped_n != 0.0 || self.spring_m != [0.0; 3]
    }

    /// Way to go until it touches, by the last look; the distance of an undecided pair.
    pub(super) fn gap_m(&self) -> f64 {
        if self.side == 0 { self.distance_m } else { self.distance_m - self.rest_m }
    }

    /// Motion of the node against the layer until the next look. Half of the way left, so that a far pair is looked at
    /// again well before it touches; an undecided pair may come near before its side is asked for.
    pub(super) fn free_m(&self, reach: &ContactReach) -> f64 {
        let free_m = (0.5 * self.gap_m()).clamp(reach.slack_m, 0.25 * reach.side_m + reach.slack_m);
        if self.side == 0 { free_m.max(self.distance_m - reach.side_m) } else { free_m }
    }

    /// Energy of the elastic slide \[J\].
    pub(crate) fn slide_j(&self) -> f64 {
        let [x, y, z] = self.spring_m;
        0.5 * self.stiffness_n_m * (x * x + y * y + z * z)
    }

    /// After a change of feature: keeps the depth, lest the change push. A pair that is apart gets its gap back, as far
    /// as it is apart. Returns the energy that a reduced depth loses \[J\].
    pub(crate) fn ease(&mut self, before_m: f64, now_m: f64) -> f64 {
        let kept = before_m.max(0.0);
        let distance_m = self.rest_m - now_m;
        self.rest_m = self.wanted_m.min(distance_m + kept);
        let depth = (self.rest_m - distance_m).max(0.0);
        0.5 * self.stiffness_n_m * (kept * kept - depth * depth)
    }

    /// Takes the closest feature over; the side may be decided, released or reset.
    pub(super) fn settle(&mut self, surface: &ContactSurface, found: &Closest, reach: &ContactReach) {
        self.element = found.element;
        self.feature = found.feature;
        let nodes = &surface.elements[found.element as usize];
        self.corners = found.corners.map(|k| nodes[k as usize]);
        let distance = found.square_m2.sqrt();
        self.within_m = distance;
        let beside = found.cosine.abs() < 0.5;
        let behind = f64::from(self.side) * found.height_m < 0.0;
        if self.side != 0 && (distance > reach.side_m || (found.rim && beside)) {
            self.side = 0;
        } else if self.side == 0 && distance <= reach.side_m && distance > 0.0 && !beside {
            self.side = if found.height_m > 0.0 { 1 } else { -1 };
            let rest_m = if self.own { reach.thickness_m.min(reach.own_layer_m) } else { reach.thickness_m };
            self.wanted_m = rest_m;
            self.rest_m = rest_m.min(found.height_m.abs());
        }
        if reach.solid && self.side != 0 && self.feature == Feature::Face && behind {
            self.side = -self.side;
            self.rest_m = self.wanted_m.min(distance);
        }
        let side = f64::from(self.side);
        self.sign = match self.feature {
            Feature::Face => side,
            _ if reach.solid => side.abs(),
            // Around a sharp fold the mean normal is unreliable: a node that was on its side is still there.
            _ if behind && found.cosine.abs() > 0.05 => -side.abs(),
            _ => side.abs(),
        };
        self.distance_m = match self.feature {
            _ if self.side == 0 => distance,
            Feature::Face => self.sign * found.height_m,
            _ => self.sign * distance,
        };
    }
}

#[derive(Clone, Copy)]
pub(super) struct ContactStep<'a> {
    pub(crate) arch: pulp::Arch,
    pub surface: &'a ContactSurface,
    pub x: &'a [[f64; 4]],
    pub before: &'a [[f64; 4]],
    pub reach: ContactReach,
    pub dt_s: f64,
    pub friction: f64,
    /// Way of the fastest node since the start, summed over steps.
    pub(crate) path_m: f64,
}

#[derive(Debug, Clone, Copy)]
pub(super) struct Touch {
    /// Penetration: rest gap minus distance, positive in contact.
    pub(crate) depth_m: f64,
    /// Way in which the distance grows.
    pub normal: V3,
    pub weights: [f64; 3],
}
