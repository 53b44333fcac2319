//! A pouch with side folds, four layers 0.01 mm apart, blown up: do the layers stay in their order?
//!
//! Two measures at every output. *Order*: signed distance of each node from the faces of the neighbouring layer below and
//! above it, negative on the wrong side. *Piercing*: sides of elements that run through a face that they do not share a
//! node with, however little.
//!
//! Where folds crumple a node may be in front of the stretch of a layer that it touches and behind another one farther
//! off, so its order is judged by the closest face alone.
//!
//! Nodes against faces alone leave up to 284 piercings and nodes 0.27 mm on the wrong side at 3 mm elements (556 and 1.5 mm
//! without contact): sides pass each other between their nodes, mostly at sharp creases of one layer, and then
//! springs that remember sides pull the wrong way. `contact::edges` leaves none: see there.

use super::apart::{nodes, triangles};
use super::setup::*;
use crate::speed::workloads::folded_cpam;
use fem::vec3::{V3, cross, dot, norm, scale, sub, unit};

pub(super) const CHECK: Check = Check::slow(
    "folded-pouch",
    "A pouch with side folds of four layers 0.01 mm apart blows up to 30 kPa without layers passing through each other.",
    "bodies do not pass through each other; the same run without contact",
    run,
);

const OUTPUTS: usize = 16;
/// Pairs of neighbouring layers: below, above.
const STACK: [(&str, &str); 6] = [
    ("bottom", "right_lower"),
    ("right_lower", "right_upper"),
    ("right_upper", "top"),
    ("bottom", "left_lower"),
    ("left_lower", "left_upper"),
    ("left_upper", "top"),
];

/// Pouch of 60 by 60 mm with folds of 24 mm in coated nylon, blown up within 30 ms, as in an actuator with side gussets.
/// `element_m` near 3 mm makes 1.4 thousand elements, 1 mm 13 thousand.
///
/// # Errors
/// [`FemError::Mesh`] for an element size that is not positive or far too small.
fn pouch(element_m: f64, peak_pa: f64, contact: bool) -> Result<Problem, FemError> {
    let mut problem = folded_cpam(element_m, false)?;
    problem.chambers = vec![chamber("air", rise(0.03, peak_pa))];
    problem.contact = contact.then(|| Contact { edges: true, ..Contact::default() });
    problem.settings.end_s = 0.04;
    Ok(problem)
}

fn run() -> CheckResult {
    let [order, pierced, residual] = blow_up(true)?;
    let without = blow_up(false)?[1];
    Ok(vec![
        CheckedNumber::at_least(
            "smallest distance between layers [mm], negative on the wrong side",
            1e3 * order,
            -0.05,
        ),
        CheckedNumber::at_most("sides of elements that pierce another face", pierced, 0.0),
        CheckedNumber::at_least("the same without contact", without, 50.0),
        CheckedNumber::at_most("energy residual over external work", residual, 0.02),
    ]
    .into())
}

/// Least distance \[m\], most piercings and largest residual of a run to 30 kPa.
fn blow_up(contact: bool) -> Result<[f64; 3], FemError> {
    let problem = pouch(3e-3, 30e3, contact)?;
    let mut run = Simulation::new(&problem)?;
    let [mut order, mut pierced, mut residual] = [f64::INFINITY, 0.0, 0.0];
    for i in 1..=OUTPUTS {
        advance(&mut run, problem.settings.end_s * i as f64 / OUTPUTS as f64)?;
        let x = run.positions();
        order = order.min(least_distance_m(&problem.mesh, &x));
        pierced = f64::max(pierced, piercings(&problem.mesh, &x) as f64);
        residual = f64::max(residual, run.ledger().residual_share());
    }
    Ok([order, pierced, residual])
}

fn part<'a>(mesh: &'a Mesh, name: &str) -> Option<&'a fem::Part> {
    mesh.parts.iter().find(|p| p.name == name)
}

/// Smallest signed distance between neighbouring layers \[m\], where they overlap squarely within 1.5 mm.
fn least_distance_m(mesh: &Mesh, x: &[V3]) -> f64 {
    let mut least = f64::INFINITY;
    for (below, above) in STACK {
        let (Some(below), Some(above)) = (part(mesh, below), part(mesh, above)) else { continue };
        // Fronts of bottom and upper gussets look down, fronts of top and lower gussets up.
        let up = |p: &fem::Part| if matches!(p.layer, 1 | 3 | 4) { 1.0 } else { -1.0 };
        for (of, from, sign) in [(above, below, up(below)), (below, above, -up(above))] {
            let faces = triangles(from, x);
            let own = nodes(from);
            let free = nodes(of).into_iter().filter(|n| own.binary_search(n).is_err());
            let heights = free.filter_map(|n| height(&faces, x[n]));
            least = heights.map(|h| sign * h).fold(least, f64::min);
        }
    }
    least
}

/// Distance of a point in front of the closest of some triangles, if it is less than 1.5 mm from the inside of that one.
/// Other stretches of a crumpled layer say nothing: they may well show the point their back.
fn height(faces: &[[V3; 3]], p: V3) -> Option<f64> {
    let all = faces.iter().filter_map(|face| distance_and_height(face, p));
    let (_, height) = all.min_by(|a, b| a.0.total_cmp(&b.0))?;
    height.filter(|h| h.abs() < 1.5e-3)
}

/// Distance from a triangle, and the height over its front if the closest point is not on its edge.
fn distance_and_height([a, b, c]: &[V3; 3], p: V3) -> Option<(f64, Option<f64>)> {
    let n = unit(cross(sub(*b, *a), sub(*c, *a)))?;
    let edges = [(a, b), (b, c), (c, a)];
    if edges.iter().all(|(s, e)| dot(cross(sub(**e, **s), sub(p, **s)), n) >= 0.0) {
        let h = dot(sub(p, *a), n);
        return Some((h.abs(), Some(h)));
    }
    let from_edge = |(s, e): &(&V3, &V3)| {
        let (along, to) = (sub(**e, **s), sub(p, **s));
        let share = (dot(to, along) / dot(along, along)).clamp(0.0, 1.0);
        norm(sub(to, scale(along, share)))
    };
    Some((edges.iter().map(from_edge).fold(f64::INFINITY, f64::min), None))
}

/// Number of sides of elements that run through a face.
fn piercings(mesh: &Mesh, x: &[V3]) -> usize {
    let at = |n: u32| x[n as usize];
    let faces = mesh.parts.iter().flat_map(|p| &p.quads).flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]);
    let faces: Vec<[u32; 3]> = faces.collect();
    let sides = mesh.parts.iter().flat_map(|p| &p.quads).flat_map(|q| [0, 1, 2, 3].map(|k| [q[k], q[(k + 1) % 4]]));
    let mut sides: Vec<[u32; 2]> = sides.filter(|s| s[0] < s[1]).collect();
    sides.sort_unstable();
    sides.dedup();
    let through = |side: &[u32; 2], face: &[u32; 3]| {
        let ([p, q], corners) = (side.map(at), face.map(at));
        let apart = |k: usize| {
            let (low, high) = corners.iter().fold((f64::MAX, f64::MIN), |(l, h), c| (l.min(c[k]), h.max(c[k])));
            p[k].max(q[k]) < low || p[k].min(q[k]) > high
        };
        if (0..3).any(apart) || face.iter().any(|n| side.contains(n)) {
            return false;
        }
        let [a, b, c] = corners;
        let Some(n) = unit(cross(sub(b, a), sub(c, a))) else { return false };
        let (hp, hq) = (dot(sub(p, a), n), dot(sub(q, a), n));
        if hp * hq >= 0.0 {
            return false;
        }
        let share = hp / (hp - hq);
        let hit = [0, 1, 2].map(|k| p[k] + share * (q[k] - p[k]));
        [(a, b), (b, c), (c, a)].iter().all(|(s, e)| dot(cross(sub(*e, *s), sub(hit, *s)), n) >= 0.0)
    };
    sides.iter().map(|side| faces.iter().filter(|face| through(side, face)).count()).sum()
}
