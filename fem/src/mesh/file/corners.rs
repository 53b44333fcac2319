//! Corners at which both sheets of a pouch have a triangle with all its nodes on the rim.
//!
//! ```text
//!   c ── b        a b c is an element of the upper and of the lower sheet: neither can leave the other.
//!   │ ╲  │        With the other diagonal, c d, every element of a sheet has its own node.
//!   a ── d
//! ```

use std::collections::HashMap;

use crate::mesh::{Mesh, Part};
use crate::vec3::{add, area, dot};

/// A triangle: its part and its place there.
type TrianglePlace = (usize, usize);

/// Edges by their nodes in the way they are run along.
type TrianglesByEdge = HashMap<(u32, u32), Vec<TrianglePlace>>;

/// Turns the diagonals at such corners in both sheets; returns the notice for the user.
pub(super) fn turn(mesh: &mut Mesh) -> Result<Option<String>, String> {
    let pairs = pairs(mesh);
    if pairs.is_empty() {
        return Ok(None);
    }
    let edges = edges(mesh);
    let is_corner = |at: &TrianglePlace| pairs.contains_key(at);
    let mut turned = Vec::new();
    for at in pairs.keys() {
        let Some([a, b, c]) = corner(mesh.parts[at.0].triangles[at.1], &edges) else { continue };
        let place = mesh.points[c as usize];
        let fault = || {
            let [x, y, z] = place;
            format!(
                "at the corner ({x}, {y}, {z}) both sheets have the triangle of nodes {}, {} and {}, all on the rim, so that they \
                 cannot part; turn the diagonal there, or use a finer mesh",
                a + 1,
                b + 1,
                c + 1
            )
        };
        let beside = edges.get(&(b, a)).into_iter().flatten().find(|other| other.0 == at.0 && !is_corner(other));
        let beside = *beside.filter(|other| other.1 < mesh.parts[at.0].triangles.len()).ok_or_else(fault)?;
        let whole = mesh.parts[at.0].triangles[beside.1];
        let d = whole.into_iter().find(|node| *node != a && *node != b).ok_or_else(fault)?;
        let new = [[c, a, d], [c, d, b]];
        let normal = |nodes: [u32; 3]| area(&nodes.map(|n| mesh.points[n as usize]));
        let both = add(normal([a, b, c]), normal(whole));
        if new.iter().any(|nodes| dot(normal(*nodes), both) <= 1e-6 * dot(both, both)) {
            return Err(fault());
        }
        let triangles = &mut mesh.parts[at.0].triangles;
        (triangles[at.1], triangles[beside.1]) = (new[0], new[1]);
        turned.push(place);
    }
    turned.sort_by(|a, b| a.partial_cmp(b).unwrap_or(std::cmp::Ordering::Equal));
    turned.dedup();
    let places: Vec<String> = turned.iter().take(4).map(|[x, y, z]| format!("({x}, {y}, {z})")).collect();
    let more = if turned.len() > places.len() { " and more" } else { "" };
    let told = format!(
        "both sheets had a triangle with all nodes on the rim in {} corners: the diagonal is turned at {}{more}",
        turned.len(),
        places.join(", ")
    );
    Ok((!turned.is_empty()).then_some(told))
}

/// Triangles on the same nodes that look opposite ways.
fn pairs(mesh: &Mesh) -> std::collections::BTreeMap<TrianglePlace, TrianglePlace> {
    let mut first: HashMap<[u32; 3], TrianglePlace> = HashMap::new();
    let mut pairs = std::collections::BTreeMap::new();
    for (part, block) in mesh.parts.iter().enumerate() {
        for (i, nodes) in block.triangles.iter().enumerate() {
            let mut sorted = *nodes;
            sorted.sort_unstable();
            let other = *first.entry(sorted).or_insert((part, i));
            let [a, b, _] = mesh.parts[other.0].triangles[other.1];
            let runs_back = (0..3).any(|k| (nodes[(k + 1) % 3], nodes[k]) == (a, b));
            if other != (part, i) && runs_back {
                pairs.insert((part, i), other);
                pairs.insert(other, (part, i));
            }
        }
    }
    pairs
}

/// Every edge with the elements that run along it that way; quads behind triangles.
fn edges(mesh: &Mesh) -> TrianglesByEdge {
    let mut edges = TrianglesByEdge::new();
    let mut note = |part: usize, i: usize, nodes: &[u32]| {
        for k in 0..nodes.len() {
            edges.entry((nodes[k], nodes[(k + 1) % nodes.len()])).or_default().push((part, i));
        }
    };
    for (part, Part { triangles, quads, .. }) in mesh.parts.iter().enumerate() {
        for (i, nodes) in triangles.iter().enumerate() {
            note(part, i, nodes);
        }
        for (i, nodes) in quads.iter().enumerate() {
            note(part, triangles.len() + i, nodes);
        }
    }
    edges
}

/// The nodes, the one at the corner last: its two edges belong to the pair only, the third one to two more elements.
fn corner(nodes: [u32; 3], edges: &TrianglesByEdge) -> Option<[u32; 3]> {
    let uses = |a: u32, b: u32| [(a, b), (b, a)].iter().filter_map(|edge| edges.get(edge)).map(Vec::len).sum::<usize>();
    let turned = |k: usize| [nodes[k], nodes[(k + 1) % 3], nodes[(k + 2) % 3]];
    (0..3).map(turned).find(|[a, b, c]| uses(*b, *c) == 2 && uses(*c, *a) == 2 && uses(*a, *b) > 2)
}
