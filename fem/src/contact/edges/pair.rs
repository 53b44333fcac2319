//! Two sides of elements, or a node and a triangle, that are near each other.

use super::super::closest::{blend, on_triangle};
use crate::vec3::{Nodes, V3, add, along, cross, dot, node, norm, scale, share, sub};

/// Sines below this are parallel: nodes and faces take care.
const SINE: f64 = 0.1;
/// Share of what a pair is too close by which its gap grows in a step.
const GROWTH: f64 = 0.02;
/// Share of its gap by which a pair may move before it is looked at again.
const SLACK: f64 = 0.25;

/// Two sides, or a node and a triangle.
#[derive(Debug, Clone, Copy, Default, serde::Serialize, serde::Deserialize)]
pub(super) struct Pair {
    /// True for a node and a triangle.
    pub face: bool,
    /// Numbers of the sides; of the node and the triangle.
    pub key: [u32; 2],
    #[serde(skip)]
    pub nodes: [u32; 4],
    /// Distance that the spring keeps now, and its target \[m\]; 0 without a spring.
    pub(crate) rest_m: f64,
    pub wanted_m: f64,
    #[serde(skip)]
    pub(crate) stiffness_n_m: f64,
    #[serde(skip)]
    pub(crate) damping_n_s_m: f64,
    /// True while closest points are within both sides.
    pub on: bool,
    /// Rest gap minus distance in the step before \[m\], and the part of it that pushed.
    pub last_m: f64,
    pub(crate) deep_m: f64,
    /// Damping force of the step before \[N\].
    pub(crate) damped_n: f64,
}

#[derive(Debug, Clone, Copy)]
pub(super) struct EdgeTouch {
    pub distance_m: f64,
    /// From the second to the first.
    pub normal: V3,
    /// Of the four nodes; sum 0.
    pub weights: [f64; 4],
    /// Closest points are within both sides, which cross at an angle.
    pub inside: bool,
}

/// Closest points of a node and a triangle or of two segments.
#[inline]
pub(super) fn touch(face: bool, [a, b, c, d]: [V3; 4]) -> EdgeTouch {
    let (weights, r, inside) = if face {
        let [u, v, w] = on_triangle(a, b, c, d);
        ([1.0, -u, -v, -w], sub(a, blend([u, v, w], b, c, d)), false)
    } else {
        segments([a, b], [c, d])
    };
    let distance_m = norm(r);
    let normal = if distance_m > 0.0 { scale(r, 1.0 / distance_m) } else { [0.0; 3] };
    EdgeTouch { distance_m, normal, weights, inside }
}

/// Weights of the ends of two segments, vector from the second to the first, and whether they cross within their ends
/// (Ericson, Real-Time Collision Detection, 2005, 5.1.9).
fn segments([p, q]: [V3; 2], [r, s]: [V3; 2]) -> ([f64; 4], V3, bool) {
    let (e1, e2, w) = (sub(q, p), sub(s, r), sub(p, r));
    let a = dot(e1, e1);
    let b = dot(e1, e2);
    let c = dot(e2, e2);
    let d = dot(e1, w);
    let e = dot(e2, w);
    let m = cross(e1, e2);
    let square = dot(m, m);
    let free = if square > 1e-12 * a * c { share(b * e - c * d, square) } else { 0.5 };
    let mut u = free.clamp(0.0, 1.0);
    let reach = share(b * u + e, c);
    let v = reach.clamp(0.0, 1.0);
    let inside = u == free && v == reach && square > SINE * SINE * a * c;
    if v != reach {
        u = share(b * v - d, a).clamp(0.0, 1.0);
    }
    if inside {
        // Along the common normal, without the cancellation of two close points.
        return ([1.0 - u, u, v - 1.0, -v], scale(m, dot(w, m) / square), true);
    }
    ([1.0 - u, u, v - 1.0, -v], along(along(w, u, e1), -v, e2), false)
}

impl Pair {
    #[inline]
    pub(super) fn corners(&self, x: &Nodes) -> [V3; 4] {
        self.nodes.map(|n| node(x, n as usize))
    }

    #[inline]
    pub(super) fn touch(&self, x: &Nodes) -> EdgeTouch {
        touch(self.face, self.corners(x))
    }

    /// Force of a step; eases the rest gap. The loss is the work of the step less what the spring stores.
    ///
    /// Nothing pushes at once: a pair that comes near keeps what it has, and gets its gap back as far as it parts.
    pub(super) fn press(&mut self, touch: &EdgeTouch, dt_s: f64, floor_m: f64, sums: &mut [f64; 2]) -> f64 {
        let idle = self.deep_m == 0.0;
        if !touch.inside || (idle && touch.distance_m >= self.rest_m) {
            self.on = false;
            self.rest_m = if touch.inside { self.wanted_m.min(touch.distance_m) } else { self.wanted_m };
            // Lets go of what the spring holds.
            sums[1] += self.holds_j();
            (self.deep_m, self.damped_n) = (0.0, 0.0);
            return 0.0;
        }
        if !self.on {
            self.rest_m = self.rest_m.min(touch.distance_m);
            (self.on, self.last_m) = (true, 0.0);
        }
        self.grow(touch.distance_m, floor_m, sums);
        let depth_m = self.rest_m - touch.distance_m;
        let closed = depth_m - self.last_m;
        let deep = depth_m.max(0.0);
        let elastic = self.stiffness_n_m * deep;
        let damped = if deep > 0.0 { (self.damping_n_s_m / dt_s * closed).max(-elastic) } else { 0.0 };
        let work = 0.5 * (damped + self.damped_n + elastic + self.stiffness_n_m * self.deep_m) * closed;
        let stored = 0.5 * elastic * deep;
        sums[0] += stored;
        sums[1] += work - stored + self.holds_j();
        (self.last_m, self.deep_m, self.damped_n) = (depth_m, deep, damped);
        elastic + damped
    }

    /// Growth of the gap of a pair that is pressed too close, as with nodes and faces.
    fn grow(&mut self, distance_m: f64, floor_m: f64, sums: &mut [f64; 2]) {
        if distance_m < floor_m && self.rest_m < self.wanted_m {
            let by_m = GROWTH * (floor_m - distance_m);
            let deep = self.deep_m + by_m;
            if self.deep_m > 0.0 {
                sums[1] -= 0.5 * self.stiffness_n_m * (deep * deep - self.deep_m * self.deep_m);
                self.deep_m = deep;
            }
            self.rest_m += by_m;
            self.last_m += by_m;
        }
    }

    /// Motion of the two against each other until the spring must be looked at again.
    pub(crate) fn idle_m(&self, touch: &EdgeTouch) -> f64 {
        let gap_m = if touch.inside { self.rest_m } else { self.wanted_m };
        if self.on { 0.0 } else { (touch.distance_m - gap_m).max(SLACK * self.wanted_m) }
    }

    /// The same after a search, at a distance; none if the spring must be looked at.
    pub(super) fn far_m(&mut self, distance_m: f64) -> f64 {
        if self.face {
            return f64::INFINITY;
        }
        if self.on || distance_m < self.wanted_m {
            return f64::NEG_INFINITY;
        }
        self.rest_m = self.wanted_m;
        (distance_m - self.wanted_m).max(SLACK * self.wanted_m)
    }

    /// What the spring holds \[J\].
    pub(super) fn holds_j(&self) -> f64 {
        0.5 * self.stiffness_n_m * self.deep_m * self.deep_m
    }

    /// Touch when the distance falls to `stop` within the motion `by` (additive continuous collision
    /// detection: Li et al., ACM Trans. Graph. 40 (2021), algorithm 1).
    pub(super) fn meets(&self, now: &EdgeTouch, x: &Nodes, by: &[V3], stop: f64) -> Option<EdgeTouch> {
        let mut motion = self.nodes.map(|n| by[n as usize]);
        let mean = scale(motion.iter().fold([0.0; 3], |sum, m| add(sum, *m)), 0.25);
        motion.iter_mut().for_each(|m| *m = sub(*m, mean));
        let first = if self.face { 1 } else { 2 };
        let far = |part: &[V3]| part.iter().map(|m| dot(*m, *m)).fold(0.0, f64::max).sqrt();
        let most = far(&motion[..first]) + far(&motion[first..]);
        if most <= now.distance_m - stop {
            return None;
        }
        let corners = self.corners(x);
        // A plane that is between them before and after is so all the time.
        let height = |k: usize| dot(now.normal, add(sub(corners[k], corners[0]), motion[k]));
        let low = (0..first).map(height).fold(f64::INFINITY, f64::min);
        let high = (first..4).map(height).fold(f64::NEG_INFINITY, f64::max);
        if low - high >= stop {
            return None;
        }
        let (mut time, mut at) = (0.0, *now);
        for _ in 0..300 {
            time += (at.distance_m - stop) / most;
            if time >= 1.0 {
                return None;
            }
            at = touch(self.face, [0, 1, 2, 3].map(|k| along(corners[k], time, motion[k])));
            if at.distance_m <= 1.02 * stop {
                break;
            }
        }
        Some(at)
    }
}
