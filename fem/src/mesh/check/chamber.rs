//! Chambers: closed, bounded by one consistently oriented surface, with the gas inside.

use super::elements::{describe, fault, meant, millimetres};
use crate::mesh::{Mesh, Part};
use crate::vec3::{V3, area, centre, extent, norm, scale, sub};
use crate::{FemError, Result};

/// Share of the area to the power 3/2 below which a volume is flat and has no sign.
const FLAT: f64 = 1e-9;
/// Share of the size of the mesh within which open edges count as in a plane.
const IN_PLANE: f64 = 1e-6;

/// Results of the check of closed chambers.
pub(super) struct Closed {
    /// Volume at the start by chamber \[m³\].
    pub(super) volumes_m3: Vec<(String, f64)>,
    /// Edges at which a chamber touches itself.
    pub(super) seams: usize,
}

#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Use {
    low: u32,
    high: u32,
    part: usize,
    element: usize,
    ascending: bool,
}

pub(super) fn check(mesh: &Mesh, chambers: &[&str], open: &[&str]) -> Result<Closed> {
    let openings = openings(mesh, open)?;
    let tied = tied(mesh);
    let mut closed = Closed { volumes_m3: Vec::new(), seams: 0 };
    for name in chambers {
        let uses = uses(mesh, name);
        let mut cuts: [Vec<f64>; 3] = Default::default();
        let mut turned: Vec<(Use, Use)> = Vec::new();
        for edge in uses.chunk_by(|a, b| (a.low, a.high) == (b.low, b.high)) {
            let up = edge.iter().filter(|u| u.ascending).count();
            if 2 * up == edge.len() {
                closed.seams += usize::from(edge.len() > 2);
            } else if edge.len() == 1 {
                match opening(mesh, &openings, edge[0])? {
                    Some(flat) => (0..3).filter(|k| flat[*k]).for_each(|k| {
                        let at_m = mesh.start_of(edge[0].low as usize)[k];
                        cuts[k].push(at_m);
                    }),
                    None if tied[edge[0].low as usize] && tied[edge[0].high as usize] => {}
                    None => return Err(leak(mesh, name, edge[0], &uses)),
                }
            } else if edge.len() == 2 {
                turned.push((edge[0], edge[1]));
            } else {
                return Err(pinch(mesh, name, edge));
            }
        }
        if !turned.is_empty() {
            return Err(flipped(mesh, name, &turned));
        }
        closed.volumes_m3.push((name.to_string(), volume(mesh, name, cuts)?));
    }
    Ok(closed)
}

/// Edges at which one chamber ends, ties left out, run along with its outside in front.
pub fn rim(mesh: &Mesh, chamber: &str) -> Vec<[u32; 2]> {
    let (uses, tied) = (uses(mesh, chamber), tied(mesh));
    let edges = uses.chunk_by(|a, b| (a.low, a.high) == (b.low, b.high)).filter(|edge| edge.len() == 1);
    let along = |edge: &Use| if edge.ascending { [edge.low, edge.high] } else { [edge.high, edge.low] };
    edges.map(|edge| along(&edge[0])).filter(|ends| !ends.iter().all(|n| tied[*n as usize])).collect()
}

/// Places along x, y and z of the planes perpendicular to them in which edges lie at the start; `held` chooses nodes and axes.
pub fn planes(mesh: &Mesh, edges: &[[u32; 2]], held: impl Fn(u32, usize) -> bool) -> [Vec<f64>; 3] {
    [0, 1, 2].map(|k| {
        let at = |n: u32| mesh.start_of(n as usize)[k];
        let near = near(mesh, edges);
        let lies = |[a, b]: &&[u32; 2]| (at(*a) - at(*b)).abs() <= near && held(*a, k) && held(*b, k);
        distinct(edges.iter().filter(lies).map(|[a, _]| at(*a)).collect(), near)
    })
}

/// Distance within which nodes of these edges count as lying in one plane \[m\].
pub fn near(mesh: &Mesh, edges: &[[u32; 2]]) -> f64 {
    let reach = extent(edges.iter().flatten().map(|n| mesh.start_of(*n as usize)));
    IN_PLANE * reach.into_iter().fold(0.0, f64::max)
}

/// Sorted, those within `near` of another left out.
fn distinct(mut places: Vec<f64>, near: f64) -> Vec<f64> {
    places.sort_by(f64::total_cmp);
    places.dedup_by(|b, a| *b - *a <= near);
    places
}

/// The axes along which a chamber's volume is counted and the point that it is counted from: those without a plane at which it ends,
/// or else one with one plane, from there.
pub(in crate::mesh) fn counted(mesh: &Mesh, planes: &[Vec<f64>; 3]) -> Option<(Vec<usize>, V3)> {
    let mut origin = mesh.start_of(0);
    let closed: Vec<usize> = (0..3).filter(|k| planes[*k].is_empty()).collect();
    if !closed.is_empty() {
        return Some((closed, origin));
    }
    let single = (0..3).find(|k| planes[*k].len() == 1)?;
    origin[single] = planes[single][0];
    Some((vec![single], origin))
}

/// +1 if the element's normal points out of the chamber, −1 if into it, 0 if it does not bound it.
fn side(part: &Part, chamber: &str) -> f64 {
    let [front, back] = [&part.front, &part.back].map(|name| name.as_deref() == Some(chamber));
    f64::from(i8::from(back) - i8::from(front))
}

/// Every edge of every face of the chamber, run along with the outside to the front, sorted by edge.
fn uses(mesh: &Mesh, chamber: &str) -> Vec<Use> {
    let mut uses = Vec::new();
    for (part, block) in mesh.parts.iter().enumerate().filter(|(_, block)| side(block, chamber) != 0.0) {
        let outward = side(block, chamber) > 0.0;
        for element in 0..block.len() {
            let nodes = block.nodes(element);
            for k in 0..nodes.len() {
                let (a, b) = (nodes[k], nodes[(k + 1) % nodes.len()]);
                uses.push(Use { low: a.min(b), high: a.max(b), part, element, ascending: (a < b) == outward });
            }
        }
    }
    uses.sort_unstable();
    uses
}

/// A node set along which a chamber may be open.
struct Opening {
    nodes: Vec<bool>,
    /// Axes to which the set is perpendicular at the start: one, or two where it is a line.
    flat: [bool; 3],
}

fn openings(mesh: &Mesh, open: &[&str]) -> Result<Vec<Opening>> {
    let mut openings = Vec::with_capacity(open.len());
    for name in open {
        let Some(members) = mesh.sets.get(*name) else {
            let meant = meant(name, mesh.sets.keys().map(String::as_str));
            return fault(format!("unknown set `{name}` for an opening{meant}"));
        };
        let mut nodes = vec![false; mesh.points.len()];
        members.iter().for_each(|node| nodes[*node as usize] = true);
        let spread = extent(members.iter().map(|node| mesh.start_of(*node as usize)));
        openings.push(Opening { nodes, flat: spread.map(|s| s <= IN_PLANE * norm(spread)) });
    }
    Ok(openings)
}

/// Axes perpendicular to the openings that contain an edge; `None` outside of them.
fn opening(mesh: &Mesh, openings: &[Opening], edge: Use) -> Result<Option<[bool; 3]>> {
    let inside = |o: &&Opening| o.nodes[edge.low as usize] && o.nodes[edge.high as usize];
    let mut sets = openings.iter().filter(inside).peekable();
    if sets.peek().is_none() {
        return Ok(None);
    }
    let flat = sets.fold([false; 3], |flat, set| [0, 1, 2].map(|k| flat[k] || set.flat[k]));
    if flat == [false; 3] {
        let place = millimetres(centre(&[edge.low, edge.high].map(|n| mesh.start_of(n as usize))));
        return fault(format!(
            "the open edge at {place} is not in a set whose nodes share a plane perpendicular to x, y or z"
        ));
    }
    Ok(Some(flat))
}

/// Nodes that follow an element or are followed: an edge between two such nodes is closed by its ties.
fn tied(mesh: &Mesh) -> Vec<bool> {
    let mut tied = vec![false; mesh.points.len()];
    for tie in &mesh.ties {
        tied[tie.node as usize] = true;
        tie.to.iter().for_each(|(to, _)| tied[*to as usize] = true);
    }
    tied
}

/// "the edge between nodes 5 and 6 at (1.0, 2.0, 0.0) mm".
fn describe_edge(mesh: &Mesh, edge: &Use) -> String {
    let ends = [edge.low, edge.high].map(|n| mesh.start_of(n as usize));
    format!("the edge between nodes {} and {} at {}", edge.low + 1, edge.high + 1, millimetres(centre(&ends)))
}

fn leak(mesh: &Mesh, chamber: &str, edge: Use, uses: &[Use]) -> FemError {
    let open = uses.chunk_by(|a, b| (a.low, a.high) == (b.low, b.high)).filter(|edge| edge.len() == 1).count();
    FemError::Mesh(format!(
        "chamber `{chamber}` is open: {} belongs to {} only ({open} such edges); close it, weld the nodes there, or name \
         the set of nodes at which it may be open",
        describe_edge(mesh, &edge),
        describe(&mesh.parts[edge.part], edge.element)
    ))
}

fn pinch(mesh: &Mesh, chamber: &str, edge: &[Use]) -> FemError {
    let elements: Vec<String> = edge.iter().map(|u| describe(&mesh.parts[u.part], u.element)).collect();
    FemError::Mesh(format!(
        "chamber `{chamber}` is not the inside of a closed surface: {} of its faces meet at {}: {}; a wall that ends inside \
         a chamber must have it on both sides, or one of these is turned over",
        edge.len(),
        describe_edge(mesh, &edge[0]),
        elements.join(", ")
    ))
}

/// The element with most neighbours that disagree is the one turned over.
fn flipped(mesh: &Mesh, chamber: &str, turned: &[(Use, Use)]) -> FemError {
    let mut faces: Vec<(usize, usize)> = turned.iter().flat_map(|(a, b)| [a, b]).map(|u| (u.part, u.element)).collect();
    faces.sort_unstable();
    let worst = faces.chunk_by(|a, b| a == b).rev().max_by_key(|same| same.len()).map_or((0, 0), |same| same[0]);
    let touches = |u: &Use| (u.part, u.element) == worst;
    let pair = turned.iter().find(|(a, b)| touches(a) || touches(b)).unwrap_or(&turned[0]);
    let (wrong, right) = if touches(&pair.0) { pair } else { &(pair.1, pair.0) };
    FemError::Mesh(format!(
        "{} is turned over: at {} it faces chamber `{chamber}` the other way than {} ({} such edges); list its nodes in \
         the opposite order, or swap front and back of its part",
        describe(&mesh.parts[wrong.part], wrong.element),
        describe_edge(mesh, wrong),
        describe(&mesh.parts[right.part], right.element),
        turned.len()
    ))
}

/// V = Σ x·A over the axes along which it is [`counted`], divided by their number; refused if clearly negative.
fn volume(mesh: &Mesh, chamber: &str, cuts: [Vec<f64>; 3]) -> Result<f64> {
    let all: Vec<f64> = cuts.iter().flatten().copied().collect();
    let near = IN_PLANE * (all.iter().fold(0.0_f64, |m, x| m.max(x.abs())));
    let Some((axes, origin)) = counted(mesh, &cuts.map(|places| distinct(places, near))) else {
        return fault(format!(
            "chamber `{chamber}` is open at two planes along each of x, y and z, so it has no volume; close it at one"
        ));
    };
    let walls = mesh.parts.iter().map(|part| (part, side(part, chamber))).filter(|(_, side)| *side != 0.0);
    let faces = walls.flat_map(|(part, side)| (0..part.len()).map(move |i| (part.nodes(i), side)));
    let (volume, has_sign) = signed_volume(mesh, faces, &axes, origin);
    if has_sign && volume < 0.0 {
        let volume = volume * 1e9;
        return fault(format!(
            "chamber `{chamber}` is inside out (volume {volume:.1} mm³): all its faces are turned over; swap front and back"
        ));
    }
    Ok(volume)
}

/// Σ x·A over axes from a point, divided by their number, of faces whose normals count +1 outwards; and whether that is more than
/// rounding.
pub(in crate::mesh) fn signed_volume<'a>(
    mesh: &Mesh,
    faces: impl Iterator<Item = (&'a [u32], f64)>,
    axes: &[usize],
    origin: V3,
) -> (f64, bool) {
    let (mut sum, mut surface) = (0.0, 0.0);
    for (nodes, side) in faces {
        let mut corners = [origin; 4];
        for (n, x) in nodes.iter().zip(&mut corners) {
            *x = sub(mesh.start_of(*n as usize), origin);
        }
        for k in 2..nodes.len() {
            let triangle = [corners[0], corners[k - 1], corners[k]];
            let (middle, outward) = (centre(&triangle), scale(area(&triangle), side));
            sum += axes.iter().map(|k| middle[*k] * outward[*k]).sum::<f64>();
            surface += norm(outward);
        }
    }
    let volume = sum / axes.len() as f64;
    (volume, volume.abs() > FLAT * surface.powf(1.5))
}
