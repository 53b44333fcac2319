//! STL, text and binary: <https://www.loc.gov/preservation/digital/formats/fdd/fdd000504.shtml>. Solids are parts.
//!
//! Facets do not share nodes in the file. Those with an equal side are joined there. Where four or more meet in one plane,
//! sheets lie on each other, and every facet is joined to the one that its sheet goes on with.

use std::collections::HashMap;

use super::build::{Builder, MeshFile};
use super::scan::{Scan, cut_off, place};
use crate::vec3::{V3, area, dot, norm};

/// Cosine from which two facets lie in one plane.
const FLAT: f64 = 0.999;
const HEADER: usize = 84;
const FACET: usize = 50;

/// A facet and the solid it belongs to.
struct SolidFacet {
    corners: [[f64; 3]; 3],
    solid: usize,
}

/// Whether the bytes have the length that a binary file gives.
pub(super) fn is_binary(bytes: &[u8]) -> bool {
    let count = bytes.get(..HEADER).and_then(|head| head.last_chunk()).map(|count| u32::from_le_bytes(*count) as usize);
    count.is_some_and(|count| bytes.len() == HEADER + FACET * count)
}

pub(super) fn read_binary(bytes: &[u8]) -> Result<MeshFile, String> {
    let mut facets = Vec::new();
    for (i, facet) in bytes.get(HEADER..).unwrap_or(&[]).chunks_exact(FACET).enumerate() {
        // A normal, then three corners.
        let number = |k: usize| f64::from(f32::from_le_bytes([facet[k], facet[k + 1], facet[k + 2], facet[k + 3]]));
        let corners = [0, 1, 2].map(|c| [0, 1, 2].map(|k| number(12 + 12 * c + 4 * k)));
        if corners.as_flattened().iter().any(|x| !x.is_finite()) {
            return Err(format!("facet {} has a corner that is not a number", i + 1));
        }
        facets.push(SolidFacet { corners, solid: 0 });
    }
    joined(&facets, &["sheet".to_string()])
}

pub(super) fn read(scan: &mut Scan) -> Result<MeshFile, String> {
    let (mut facets, mut solids, mut corners) = (Vec::new(), Vec::new(), Vec::new());
    loop {
        let words = scan.row("`endsolid`")?;
        match words[..] {
            ["solid", ref name @ ..] => solids.push(if name.is_empty() { "sheet".into() } else { name.join("_") }),
            ["vertex", ref xyz @ ..] => corners.push(place(xyz)?),
            ["endloop"] => {
                let corners: [[f64; 3]; 3] = std::mem::take(&mut corners)
                    .try_into()
                    .map_err(|found: Vec<[f64; 3]>| format!("a facet has 3 corners, this one {}", found.len()))?;
                let solid = solids.len().checked_sub(1).ok_or("a facet before the first `solid`")?;
                facets.push(SolidFacet { corners, solid });
            }
            ["facet", ..] | ["outer", "loop"] | ["endfacet"] => {}
            ["endsolid", ..] => {
                let at = scan.number;
                match scan.line() {
                    None => {
                        scan.number = at;
                        return joined(&facets, &solids);
                    }
                    Some(next) => match next.strip_prefix("solid") {
                        Some(name) => solids.push(name.trim().replace(' ', "_")),
                        None => return Err(format!("expected `solid` or the end of the file, found `{next}`")),
                    },
                }
            }
            ref other => return Err(format!("expected facets, found `{}`", other.join(" "))),
        }
    }
}

#[derive(Clone, Copy)]
struct FacetSide {
    facet: usize,
    from: usize,
    to: usize,
    ascending: bool,
}

/// Bits of a place, in which −0 is 0.
fn bits(place: V3) -> [u64; 3] {
    place.map(|x| (x + 0.0).to_bits())
}

/// The mesh in which facets share nodes along their common sides.
fn joined(facets: &[SolidFacet], solids: &[String]) -> Result<MeshFile, String> {
    if facets.is_empty() {
        return Err(cut_off("the first facet"));
    }
    let mut sides: HashMap<[[u64; 3]; 2], Vec<FacetSide>> = HashMap::new();
    let mut order = Vec::new();
    for (facet, SolidFacet { corners, .. }) in facets.iter().enumerate() {
        for k in 0..3 {
            let (a, b) = (bits(corners[k]), bits(corners[(k + 1) % 3]));
            let side = FacetSide { facet, from: 3 * facet + k, to: 3 * facet + (k + 1) % 3, ascending: a < b };
            let meeting = sides.entry([a.min(b), a.max(b)]).or_default();
            if meeting.is_empty() {
                order.push([a.min(b), a.max(b)]);
            }
            meeting.push(side);
        }
    }
    let mut node: Vec<usize> = (0..3 * facets.len()).collect();
    let mut passing = 0;
    for key in order {
        passing += usize::from(join(&mut node, &sides[&key], facets));
    }
    let mut builder = Builder::default();
    for (facet, SolidFacet { corners, solid }) in facets.iter().enumerate() {
        let roots = [0, 1, 2].map(|k| root(&mut node, 3 * facet + k) as u64);
        for (root, corner) in roots.iter().zip(corners) {
            // A corner that is there already is the same node.
            let _ = builder.node(*root, *corner);
        }
        let nodes = builder.find(&roots.map(|n| n.to_string()).each_ref().map(String::as_str))?;
        builder.element(&solids[*solid], &nodes)?;
    }
    let mut file = builder.finish()?;
    if passing > 0 {
        file.told.push(format!(
            "sheets lie on each other along {passing} sides; they are joined where one ends only: STL cannot mark a seam between \
             pouches, Gmsh and Abaqus can"
        ));
    }
    Ok(file)
}

/// Joins the facets that meet at a side; true if sheets pass each other there.
fn join(node: &mut [usize], meeting: &[FacetSide], facets: &[SolidFacet]) -> bool {
    let normal = |side: &FacetSide| area(&facets[side.facet].corners);
    let cosine = |a: &FacetSide, b: &FacetSide| dot(normal(a), normal(b)) / (norm(normal(a)) * norm(normal(b)));
    let first = &meeting[0];
    let flat = meeting.len() > 2 && meeting.iter().all(|other| cosine(first, other).abs() > FLAT);
    for (i, side) in meeting.iter().enumerate() {
        // Neighbours in one sheet run along their common side in opposite ways, and look the same way.
        let goes_on = |other: &&FacetSide| !flat || (other.ascending != side.ascending && cosine(side, other) > 0.0);
        for other in meeting[i + 1..].iter().filter(goes_on) {
            let [from, to] =
                if other.ascending == side.ascending { [other.from, other.to] } else { [other.to, other.from] };
            unite(node, side.from, from);
            unite(node, side.to, to);
        }
    }
    flat
}

fn root(node: &mut [usize], mut at: usize) -> usize {
    while node[at] != at {
        node[at] = node[node[at]];
        at = node[at];
    }
    at
}

fn unite(node: &mut [usize], a: usize, b: usize) {
    let (a, b) = (root(node, a), root(node, b));
    node[a.max(b)] = a.min(b);
}
