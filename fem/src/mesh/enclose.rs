//! Walls of a chamber, found from how elements meet: for meshes that say parts and no chambers.

use std::collections::BTreeMap;

use super::check::{counted, near, planes, signed_volume};
use super::{Mesh, Part};
use crate::{FemError, Result};

/// A face: its part and its place there.
type Face = (usize, usize);

/// Two faces that meet at an edge, and whether they look the same way.
type Neighbours = BTreeMap<usize, Vec<(usize, bool)>>;

/// Makes parts the walls of a chamber with the gas inside; gives how many elements were turned over for it.
///
/// A part whose elements all look inwards has the chamber in front. Where a part is at odds with itself, the fewer ones of its
/// elements are turned. [`super::check::check`] finds out whether the chamber is closed.
///
/// # Errors
/// [`FemError::Mesh`] for a part that would have two chambers on one side, or that two chambers want turned in different ways.
pub fn enclose(mesh: &mut Mesh, chamber: &str, parts: &[usize], open: [bool; 3]) -> Result<usize> {
    let faces: Vec<Face> = parts.iter().flat_map(|p| (0..mesh.parts[*p].len()).map(move |i| (*p, i))).collect();
    let outward = outward(mesh, &faces, open);
    let mut turned = 0;
    for part in parts {
        let signs: Vec<bool> =
            faces.iter().zip(&outward).filter(|(face, _)| face.0 == *part).map(|(_, o)| *o).collect();
        let count = signs.iter().filter(|outward| **outward).count();
        let back = 2 * count >= signs.len();
        let block = &mut mesh.parts[*part];
        let wrong: Vec<usize> = (0..signs.len()).filter(|i| signs[*i] != back).collect();
        if !wrong.is_empty() && (block.front.is_some() || block.back.is_some()) {
            return Err(FemError::Mesh(format!(
                "part `{}` is between two chambers and {} of its elements look the other way than the rest; turn them over",
                block.name,
                wrong.len()
            )));
        }
        wrong.iter().for_each(|i| turn(block, *i));
        turned += wrong.len();
        let slot = if back { &mut block.back } else { &mut block.front };
        if let Some(other) = slot.replace(chamber.into()) {
            return Err(FemError::Mesh(format!(
                "part `{}` would have chambers `{other}` and `{chamber}` on one side; name the parts of each chamber",
                block.name
            )));
        }
    }
    Ok(turned)
}

/// Whether every face looks out of the chamber.
fn outward(mesh: &Mesh, faces: &[Face], open: [bool; 3]) -> Vec<bool> {
    let edges = edges(mesh, faces);
    let neighbours = neighbours(&edges);
    let counted = counted(mesh, &ends(mesh, &edges, open));
    let mut outward: Vec<Option<bool>> = vec![None; faces.len()];
    for first in 0..faces.len() {
        if outward[first].is_some() {
            continue;
        }
        outward[first] = Some(true);
        let (mut sheet, mut at) = (vec![first], 0);
        while let Some(face) = sheet.get(at).copied() {
            at += 1;
            for (other, alike) in neighbours.get(&face).into_iter().flatten() {
                if outward[*other].is_none() {
                    outward[*other] = outward[face].map(|way| way == *alike);
                    sheet.push(*other);
                }
            }
        }
        let ways: Vec<bool> = sheet.iter().map(|face| outward[*face] == Some(true)).collect();
        let way_of = |(face, outward): (&usize, &bool)| {
            let (part, i) = faces[*face];
            (mesh.parts[part].nodes(i), if *outward { 1.0 } else { -1.0 })
        };
        let signed = |(axes, origin): &(Vec<usize>, [f64; 3])| {
            signed_volume(mesh, sheet.iter().zip(&ways).map(way_of), axes, *origin)
        };
        // A flat pouch has no inside yet: most of its elements keep the orientation of the file.
        let majority = 2 * ways.iter().filter(|way| **way).count() >= ways.len();
        let right = match counted.as_ref().map(signed) {
            Some((volume, true)) => volume > 0.0,
            _ => majority,
        };
        if !right {
            sheet.iter().for_each(|face| outward[*face] = outward[*face].map(|way| !way));
        }
    }
    outward.into_iter().map(|way| way == Some(true)).collect()
}

/// Faces by the edges that they have, and whether they run along them to the higher node.
type FacesByEdge = BTreeMap<(u32, u32), Vec<(usize, bool)>>;

fn edges(mesh: &Mesh, faces: &[Face]) -> FacesByEdge {
    let mut edges = FacesByEdge::new();
    for (face, (part, i)) in faces.iter().enumerate() {
        let nodes = mesh.parts[*part].nodes(*i);
        for k in 0..nodes.len() {
            let (a, b) = (nodes[k], nodes[(k + 1) % nodes.len()]);
            edges.entry((a.min(b), a.max(b))).or_default().push((face, a < b));
        }
    }
    edges
}

/// Faces that meet two by two.
fn neighbours(edges: &FacesByEdge) -> Neighbours {
    let mut neighbours = Neighbours::new();
    for meeting in edges.values() {
        if let [(a, up), (b, other)] = meeting[..] {
            neighbours.entry(a).or_default().push((b, up != other));
            neighbours.entry(b).or_default().push((a, up != other));
        }
    }
    neighbours
}

/// Where the faces end along the axes along which the chamber is open: planes with open edges that nothing is beyond.
fn ends(mesh: &Mesh, edges: &FacesByEdge, open: [bool; 3]) -> [Vec<f64>; 3] {
    let rim: Vec<[u32; 2]> = edges.iter().filter(|(_, faces)| faces.len() == 1).map(|((a, b), _)| [*a, *b]).collect();
    let near = near(mesh, &rim);
    let beyond = |k: usize, at: f64, sign: f64| {
        edges.keys().any(|(a, b)| [a, b].iter().any(|n| sign * (mesh.start_of(**n as usize)[k] - at) > near))
    };
    let mut all = planes(mesh, &rim, |_, k| open[k]);
    for (k, places) in all.iter_mut().enumerate() {
        places.retain(|at| !beyond(k, *at, 1.0) || !beyond(k, *at, -1.0));
    }
    // An opening without such an edge is open all the same: along this axis nothing is counted.
    let uncounted = |places: Vec<f64>, open| match open && places.is_empty() {
        true => vec![f64::NEG_INFINITY, f64::INFINITY],
        false => places,
    };
    let mut open = open.into_iter();
    all.map(|places| uncounted(places, open.next() == Some(true)))
}

fn turn(part: &mut Part, i: usize) {
    let quads = part.quads.len();
    match part.quads.get_mut(i) {
        Some(quad) => quad.reverse(),
        None => part.triangles[i - quads].reverse(),
    }
}
