//! Elements one by one: different nodes, an area, no corner turned inside out, a warp direction in the plane.

use crate::mesh::{Mesh, Part};
use crate::policy;
use crate::vec3::{V3, area, centre, cross, dot, norm, sub};
use crate::{FemError, Result};

/// Checks every element in its stress-free shape, and its area at the start.
pub(super) fn check(mesh: &Mesh) -> Result<()> {
    for part in &mesh.parts {
        if !(part.warp.len() <= 1 || part.warp.len() == part.len()) {
            let (name, found, count) = (&part.name, part.warp.len(), part.len());
            return fault(format!("part `{name}` has {found} warp directions; give 1, or {count} (one per element)"));
        }
        for i in 0..part.len() {
            shape(mesh, part, i)?;
            warp(mesh, part, i)?;
        }
        twins(part)?;
    }
    Ok(())
}

/// Two elements of a part on the same nodes would count their fabric twice.
fn twins(part: &Part) -> Result<()> {
    let corners = |i: usize| {
        let mut corners = [u32::MAX; 4];
        corners[..part.nodes(i).len()].copy_from_slice(part.nodes(i));
        corners.sort_unstable();
        (corners, i)
    };
    let mut all: Vec<([u32; 4], usize)> = (0..part.len()).map(corners).collect();
    all.sort_unstable();
    match all.windows(2).find(|pair| pair[0].0 == pair[1].0) {
        None => Ok(()),
        Some(pair) => {
            let (what, first) = (describe(part, pair[1].1), pair[0].1 + 1);
            fault(format!("{what} has the nodes of element {first}; remove one (a second ply belongs in the section)"))
        }
    }
}

fn shape(mesh: &Mesh, part: &Part, i: usize) -> Result<()> {
    let nodes = part.nodes(i);
    if let Some(k) = (1..nodes.len()).find(|k| nodes[..*k].contains(&nodes[*k])) {
        return fault(format!("{} has node {} twice", describe(part, i), nodes[k] + 1));
    }
    let mut corners = [[0.0; 3]; 4];
    let x = stress_free(mesh, nodes, &mut corners);
    let normal = area(x);
    if !has_area(x) {
        return fault(format!("{} at {} has no area", describe(part, i), millimetres(centre(x))));
    }
    if let Some(k) = (0..x.len()).find(|k| dot(corner(x, *k), normal) <= 0.0) {
        let (element, place, node) = (describe(part, i), millimetres(x[k]), nodes[k] + 1);
        return fault(format!(
            "{element} is inverted at node {node}, {place}: its corner there is 180 degrees or more"
        ));
    }
    let bent = if mesh.membrane.is_empty() { &[] } else { &mesh.points[..] };
    for (shape, places) in [("at the start", &mesh.start[..]), ("as it bends", bent)] {
        let mut corners = [[0.0; 3]; 4];
        for (n, x) in nodes.iter().zip(&mut corners) {
            *x = *places.get(*n as usize).unwrap_or(x);
        }
        let x = &corners[..nodes.len()];
        if !places.is_empty() && !has_area(x) {
            return fault(format!("{} at {} has no area {shape}", describe(part, i), millimetres(centre(x))));
        }
    }
    Ok(())
}

fn warp(mesh: &Mesh, part: &Part, i: usize) -> Result<()> {
    let Some(warp) = part.warp_of(i) else { return Ok(()) };
    if !(norm(warp) > 0.0 && norm(warp).is_finite()) {
        return fault(format!("{}: warp direction {warp:?} has no direction", describe(part, i)));
    }
    let mut corners = [[0.0; 3]; 4];
    let normal = area(stress_free(mesh, part.nodes(i), &mut corners));
    if !policy::is_in_sheet(norm(cross(warp, normal)) / (norm(warp) * norm(normal))) {
        let what = describe(part, i);
        return fault(format!("{what}: warp direction {warp:?} is parallel to the normal; give one in the sheet"));
    }
    Ok(())
}

/// Stress-free places of the nodes of one element.
pub(super) fn stress_free<'a>(mesh: &Mesh, nodes: &[u32], into: &'a mut [V3; 4]) -> &'a [V3] {
    for (n, x) in nodes.iter().zip(into.iter_mut()) {
        *x = mesh.free_of(*n as usize);
    }
    &into[..nodes.len()]
}

/// Area vector spanned by the two sides that meet in corner `k`.
pub(super) fn corner(x: &[V3], k: usize) -> V3 {
    let (next, last) = ((k + 1) % x.len(), (k + x.len() - 1) % x.len());
    cross(sub(x[next], x[k]), sub(x[last], x[k]))
}

/// False also for an area that overflows.
fn has_area(x: &[V3]) -> bool {
    let side = |k: usize| sub(x[k], x[(k + 1) % x.len()]);
    let longest_squared = (0..x.len()).map(side).map(|e| dot(e, e)).fold(0.0, f64::max);
    let area = norm(area(x));
    policy::is_area(area, longest_squared)
}

/// Element `i` of a part, as messages name it.
pub(crate) fn describe(part: &Part, i: usize) -> String {
    let nodes: Vec<String> = part.nodes(i).iter().map(|n| (u64::from(*n) + 1).to_string()).collect();
    format!("element {} of part `{}` (nodes {})", i + 1, part.name, nodes.join(", "))
}

/// A place, as messages give it.
pub(super) fn millimetres(x: V3) -> String {
    // Adding 0 turns −0 into 0.
    let [x, y, z] = x.map(|v| (v * 1e4).round() / 10.0 + 0.0);
    format!("({x:.1}, {y:.1}, {z:.1}) mm")
}

pub(super) fn fault<T>(message: String) -> Result<T> {
    Err(FemError::Mesh(message))
}

/// "; did you mean `x`?", or nothing.
pub(super) fn meant<'a>(wrong: &str, known: impl IntoIterator<Item = &'a str>) -> String {
    spelling::nearest(wrong, known).map_or(String::new(), |name| format!("; did you mean `{name}`?"))
}
