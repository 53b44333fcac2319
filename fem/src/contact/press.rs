//! Forces of pairs: spring, damping and friction, and the energies that go with them.

use super::pack::{Pack, Touches};
use super::record::{ContactStep, Record, Touch};
use crate::terms::slide;
use crate::vec3::{Nodes, V3, add, along, node, scale, sub};

/// Share of what a pair is too close by which its rest gap grows in a step.
const GROWTH: f64 = 0.02;

/// Force of a pair on its node; the corners of the triangle take their shares of its opposite.
#[derive(Debug, Clone, Copy)]
pub(super) struct PairForce {
    pub nodes: [u32; 4],
    pub weights: [f64; 3],
    pub force_n: V3,
}

/// Energies of a chunk in one step \[J\].
#[derive(Debug, Clone, Copy, Default, serde::Serialize, serde::Deserialize)]
pub(super) struct ContactEnergies {
    pub stored: f64,
    pub friction: f64,
    pub damping: f64,
}

/// A lane that touches, or did in the step before.
#[inline(always)]
pub(super) fn press_lane(
    pack: &mut Pack,
    lane: usize,
    touches: &Touches,
    records: &mut [Record],
    step: &ContactStep,
    sums: &mut ContactEnergies,
    pushes: &mut Vec<PairForce>,
) {
    let mut touch = touches.of(lane);
    let (k, c) = (pack.stiffness_n_m[lane], pack.damping_n_s_m[lane]);
    let kept = [&mut pack.rest_m[lane], &mut pack.last_m[lane], &mut pack.damped_n[lane]];
    let normal_n = press(k, c, kept, &mut touch, step, sums);
    let mut force = scale(touch.normal, normal_n);
    if step.friction > 0.0 {
        force = add(force, rub(&mut records[pack.record[lane] as usize], &touch, normal_n, step, sums));
    }
    let nodes = [pack.node[0][lane], pack.node[1][lane], pack.node[2][lane], pack.node[3][lane]];
    pushes.push(PairForce { nodes, weights: touch.weights, force_n: force });
}

/// The same for an edge or corner.
pub(super) fn press_round(
    record: &mut Record,
    touch: &Touch,
    step: &ContactStep,
    sums: &mut ContactEnergies,
    pushes: &mut Vec<PairForce>,
) {
    let mut touch = *touch;
    let (k, c) = (record.stiffness_n_m, record.damping_n_s_m);
    let kept = [&mut record.rest_m, &mut record.last_m, &mut record.damped_n];
    let normal_n = press(k, c, kept, &mut touch, step, sums);
    record.wanted_m = record.wanted_m.max(record.rest_m);
    let mut force = scale(touch.normal, normal_n);
    if step.friction > 0.0 {
        force = add(force, rub(record, &touch, normal_n, step, sums));
    }
    let [a, b, c] = record.corners;
    pushes.push(PairForce { nodes: [record.node, a, b, c], weights: touch.weights, force_n: force });
}

/// Growth of the rest gap of a pair that is pressed too close, and the depth with it. The work comes from nowhere: it is
/// booked as a negative loss.
#[inline(always)]
fn grow(k: f64, rest_m: f64, touch: &mut Touch, last_m: f64, step: &ContactStep, sums: &mut ContactEnergies) -> f64 {
    let distance_m = rest_m - touch.depth_m;
    if distance_m >= step.reach.floor_m || rest_m >= step.reach.thickness_m {
        return 0.0;
    }
    let by_m = GROWTH * (step.reach.floor_m - distance_m).min(step.reach.floor_m);
    let (was, is) = (positive(last_m), positive(last_m + by_m));
    sums.damping -= 0.5 * k * (is * is - was * was);
    touch.depth_m += by_m;
    by_m
}

/// Normal force of a pair; its rest gap, and depth and damping force of the step before, move on. The loss is the work of the step
/// less what the spring stores: damping, and what a step that ends or begins within the gap takes or gives.
#[inline(always)]
fn press(
    k: f64,
    c: f64,
    kept: [&mut f64; 3],
    touch: &mut Touch,
    step: &ContactStep,
    sums: &mut ContactEnergies,
) -> f64 {
    let [rest_m, last_m, damped_n] = kept;
    let grown_m = grow(k, *rest_m, touch, *last_m, step, sums);
    *rest_m += grown_m;
    *last_m += grown_m;
    let (depth_m, closed) = (touch.depth_m, touch.depth_m - *last_m);
    let (deep, was) = (positive(depth_m), positive(*last_m));
    let elastic = k * deep;
    let pull = c / step.dt_s * closed;
    // The layers do not stick to each other: damping never pulls more than the spring pushes.
    let damped = if depth_m > 0.0 { if pull > -elastic { pull } else { -elastic } } else { 0.0 };
    let work = 0.5 * (damped + *damped_n + k * (deep + was)) * closed;
    let stored = 0.5 * elastic * deep;
    sums.damping += work - (stored - 0.5 * k * was * was);
    sums.stored += stored;
    *damped_n = damped;
    elastic + damped
}

#[inline(always)]
fn positive(value: f64) -> f64 {
    if value > 0.0 { value } else { 0.0 }
}

#[inline]
fn rub(record: &mut Record, touch: &Touch, normal_n: f64, step: &ContactStep, sums: &mut ContactEnergies) -> V3 {
    let k = record.stiffness_n_m;
    let moved = motion(record, touch, step.x, step.before);
    let (spring, lost) = slide(record.spring_m, moved, touch.normal, k, step.friction * normal_n);
    record.spring_m = spring;
    sums.friction += lost;
    sums.stored += record.slide_j();
    scale(spring, -k)
}

/// Motion of the node against the touched point since the step before.
#[inline(always)]
pub(super) fn motion(record: &Record, touch: &Touch, x: &Nodes, before: &Nodes) -> V3 {
    let one = |n: u32| sub(node(x, n as usize), node(before, n as usize));
    let mut moved = one(record.node);
    for (n, w) in record.corners.iter().zip(touch.weights) {
        moved = along(moved, -w, one(*n));
    }
    moved
}

#[inline(always)]
pub(super) fn push(out: &mut [f64; 4], weight: f64, force: V3) {
    out[0] += weight * force[0];
    out[1] += weight * force[1];
    out[2] += weight * force[2];
}
