//! What is remembered of two sides of elements that are near each other.

use super::super::surface::{NONE, Surface};
use super::segment::{Lines, closest, lines};
use super::sides::Sides;
use crate::vec3::{V3, along, dot, node, norm, scale};

/// Sines below this are parallel: nodes and faces take care.
const SINE: f64 = 0.1;
/// A pair that was active stays so this far beyond the ends, lest it switch at every step.
const BEYOND: f64 = 0.02;
/// Beyond this the sign is decided anew when the pair comes back.
const AWAY: f64 = 0.25;

/// Two sides of elements.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Pair {
    pub sides: [u32; 2],
    pub nodes: [u32; 4],
    /// Which side of the first's faces the second is on (+1 in front, 0 not decided), and of the second's the first.
    pub way: [i8; 2],
    /// Sign s of the normal s e₁×e₂; 0 while the lines are parallel or apart.
    pub sign: i8,
    /// True while closest points are within both sides.
    pub on: bool,
    /// Distance that is kept now, and the one that is wanted \[m\].
    pub rest_m: f64,
    pub wanted_m: f64,
    pub stiffness_n_m: f64,
    pub damping_n_s_m: f64,
    /// Rest gap minus distance in the step before \[m\], and the part of it that pushed.
    pub last_m: f64,
    pub deep_m: f64,
    /// Damping force of the step before \[N\].
    pub damped_n: f64,
}

/// A pair at one moment.
#[derive(Debug, Clone, Copy)]
pub(super) struct Touch {
    pub depth_m: f64,
    /// From the second to the first.
    pub normal: V3,
    /// Of the four nodes; sum 0.
    pub weights: [f64; 4],
}

/// Where a pair stands in space.
pub(super) struct Scene<'a> {
    pub surface: &'a Surface,
    pub sides: &'a Sides,
    pub x: &'a [[f64; 4]],
    /// Sides are remembered within this distance \[m\].
    pub reach_m: f64,
    pub thickness_m: f64,
    pub dt_s: f64,
}

impl Pair {
    #[inline]
    pub fn ends(&self, x: &[[f64; 4]]) -> [[V3; 2]; 2] {
        let [a, b, c, d] = self.nodes.map(|n| node(x, n as usize));
        [[a, b], [c, d]]
    }

    /// Distance and normal, if the pair is active.
    #[inline]
    pub fn touch(&self, x: &[[f64; 4]]) -> Option<Touch> {
        let [a, b] = self.ends(x);
        if self.on && self.sign != 0 { Some(self.touch_of(&lines(a, b))) } else { None }
    }

    #[inline]
    fn touch_of(&self, l: &Lines) -> Touch {
        let per = f64::from(self.sign) / norm(l.product);
        let [u, v] = l.place;
        Touch {
            depth_m: self.rest_m - l.triple * per,
            normal: scale(l.product, per),
            weights: [1.0 - u, u, v - 1.0, -v],
        }
    }

    /// Switches the pair on or off for this step and eases its rest gap; the touch if it may push.
    pub fn update(&mut self, scene: &Scene) -> Option<Touch> {
        let [a, b] = self.ends(scene.x);
        let l = lines(a, b);
        let within = |by: f64| l.place.iter().all(|p| *p > -by && *p < 1.0 + by);
        if l.sine_square.is_nan() || l.sine_square <= SINE * SINE || !within(AWAY) {
            (self.sign, self.on) = (0, false);
            return None;
        }
        let inside = within(if self.on { BEYOND } else { 0.0 });
        if self.sign == 0 && inside {
            self.sign = self.decide(scene, &l);
        }
        if self.sign == 0 {
            self.on = false;
            return None;
        }
        let mut touch = self.touch_of(&l);
        let distance_m = self.rest_m - touch.depth_m;
        if inside && !self.on {
            // Nothing pushes at once: the pair keeps what it has, and gets its gap back when it is apart.
            self.rest_m = self.wanted_m.min(distance_m);
        } else if distance_m > self.rest_m {
            self.rest_m = self.wanted_m.min(distance_m);
        }
        let shift = self.rest_m - distance_m - touch.depth_m;
        self.last_m += shift;
        touch.depth_m += shift;
        self.on = inside;
        Some(touch)
    }

    /// Sign with which the normal leads from the second to the first: what the remembered ways say, or, if they say
    /// little, the present distance.
    fn decide(&self, scene: &Scene, l: &Lines) -> i8 {
        let to = self.direction(scene);
        let clear = dot(to, l.product) / norm(l.product);
        let far = l.triple.abs() > 0.25 * scene.thickness_m * norm(l.product);
        if clear.abs() > 0.2 {
            return if clear > 0.0 { 1 } else { -1 };
        }
        if far && l.triple > 0.0 {
            1
        } else if far {
            -1
        } else {
            0
        }
    }

    /// From the second to the first by the remembered ways.
    fn direction(&self, scene: &Scene) -> V3 {
        let [a, b] = self.sides.map(|s| scene.sides.normal(scene.surface, scene.x, s));
        along(scale(b, f64::from(self.way[1])), -f64::from(self.way[0]), a)
    }

    /// Decides or forgets the ways by the closest points of the segments; returns their distance.
    pub fn settle(&mut self, scene: &Scene) -> f64 {
        let [a, b] = self.ends(scene.x);
        let r = closest(a, b).2;
        let distance_m = norm(r);
        if distance_m > scene.reach_m {
            self.way = [0, 0];
            return distance_m;
        }
        for k in 0..2 {
            let border = scene.sides.list[self.sides[k] as usize].faces[1] == NONE;
            if self.way[k] != 0 && !(border && distance_m > scene.thickness_m) {
                continue;
            }
            let n = scene.sides.normal(scene.surface, scene.x, self.sides[k]);
            let height = if k == 0 { -dot(n, r) } else { dot(n, r) };
            let clear = height.abs() > 0.5 * distance_m * norm(n) && height != 0.0;
            self.way[k] = match (clear, self.way[k]) {
                (true, 0) => {
                    if height > 0.0 {
                        1
                    } else {
                        -1
                    }
                }
                (false, _) => 0,
                (true, way) => way,
            };
        }
        distance_m
    }

    /// Normal force of a step with a touch; the loss is the work of the step less what the spring stores.
    pub fn press(&mut self, touch: &Touch, dt_s: f64, sums: &mut [f64; 2]) -> f64 {
        let closed = touch.depth_m - self.last_m;
        let deep = if self.on { touch.depth_m.max(0.0) } else { 0.0 };
        let elastic = self.stiffness_n_m * deep;
        let damped = if deep > 0.0 { (self.damping_n_s_m / dt_s * closed).max(-elastic) } else { 0.0 };
        let work = 0.5 * (damped + self.damped_n + elastic + self.stiffness_n_m * self.deep_m) * closed;
        let stored = 0.5 * elastic * deep;
        sums[0] += stored;
        sums[1] += work - stored + 0.5 * self.stiffness_n_m * self.deep_m * self.deep_m;
        (self.last_m, self.deep_m, self.damped_n) = (touch.depth_m, deep, damped);
        elastic + damped
    }

    /// Lets go of what the spring holds; returns the energy lost.
    pub fn release(&mut self) -> f64 {
        let lost = 0.5 * self.stiffness_n_m * self.deep_m * self.deep_m;
        (self.deep_m, self.damped_n) = (0.0, 0.0);
        lost
    }
}
