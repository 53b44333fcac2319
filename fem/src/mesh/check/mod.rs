//! Is this mesh fit to be simulated? What [`check`] refuses would end as a wrong answer, not as a crash.
//!
//! A chamber X is bounded by the elements that face it from one side. Its outward area vector is the element's normal
//! where `back` is X and the opposite where `front` is X; an element with X on both sides carries no pressure and is left out.
//! The chamber is closed where every edge is run along as often one way as the other:
//!
//! ```text
//!   once            open: the gas gets out
//!   twice           closed; the same way both times: one of the two is turned over
//!   3, 5, …         a wall that ends inside or leaves the chamber: not the surface of a volume
//!   4, 6, … even    closed and pinched: pouches in one supply line that share a seam; counted in `Quality::seams`
//! ```

mod chamber;
mod elements;
mod quality;

pub(super) use chamber::{counted, signed_volume};
pub use chamber::{near, planes, rim};
pub(crate) use elements::describe;
pub use quality::{LowMidHigh, Quality};

use crate::FemError;
use crate::mesh::Mesh;
use elements::{fault, meant, millimetres};

/// Checks a mesh whose chambers are all closed. `chambers` are the names that parts may use.
///
/// # Errors
/// [`FemError::Mesh`] naming the first fault found: what, in which element of which part (counted from 1, quads first),
/// which nodes (counted from 1), and where in mm.
pub fn check(mesh: &Mesh, chambers: &[&str]) -> Result<Quality, FemError> {
    check_open(mesh, chambers, &[])
}

/// Like [`check`], but chambers may be open along edges whose two nodes are in one of the sets `open`: a cut by a plane of
/// symmetry perpendicular to x, y or z, or an end held in such a plane. The volume counted is that up to the plane.
///
/// # Errors
/// As [`check`]; also when an open edge does not lie in a plane perpendicular to x, y or z.
pub fn check_open(mesh: &Mesh, chambers: &[&str], open: &[&str]) -> Result<Quality, FemError> {
    numbers(mesh)?;
    if mesh.elements() == 0 {
        return fault("there are no elements".into());
    }
    names(mesh, chambers)?;
    elements::check(mesh)?;
    every_node_used(mesh)?;
    ties(mesh)?;
    let closed = chamber::check(mesh, chambers, open)?;
    Ok(quality::measure(mesh, closed))
}

/// Lengths of lists, node numbers in range, coordinates that are numbers.
pub(super) fn numbers(mesh: &Mesh) -> Result<(), FemError> {
    let count = mesh.points.len();
    for (kind, places) in [("place", &mesh.points), ("start", &mesh.start), ("membrane", &mesh.membrane)] {
        if !places.is_empty() && places.len() != count {
            return fault(format!("{} {kind} places for {count} nodes; give one per node or none", places.len()));
        }
        if let Some(i) = places.iter().position(|p| p.iter().any(|c| !c.is_finite())) {
            return fault(format!("node {} has a {kind} that is not a number: {:?}", i + 1, places[i]));
        }
    }
    let beyond = |nodes: &[u32]| nodes.iter().map(|n| u64::from(*n) + 1).find(|n| *n > count as u64);
    for part in &mesh.parts {
        for i in 0..part.len() {
            if let Some(node) = beyond(part.nodes(i)) {
                let what = describe(part, i);
                return fault(format!("{what} has node {node}, but there are only {count} nodes"));
            }
        }
    }
    for (name, nodes) in &mesh.sets {
        if let Some(node) = beyond(nodes) {
            return fault(format!("set `{name}` has node {node}, but there are only {count} nodes"));
        }
    }
    for tie in &mesh.ties {
        if let Some(node) = tie.to.iter().map(|t| t.0).chain([tie.node]).find(|n| *n as usize >= count) {
            let (tied, node) = (tie.node as u64 + 1, node as u64 + 1);
            return fault(format!("tie of node {tied} has node {node}, but there are only {count}"));
        }
    }
    Ok(())
}

/// Parts that exist once, have elements, and face chambers that exist.
fn names(mesh: &Mesh, chambers: &[&str]) -> Result<(), FemError> {
    for (i, part) in mesh.parts.iter().enumerate() {
        if mesh.parts[..i].iter().any(|other| other.name == part.name) {
            return fault(format!("there are two parts called `{}`; rename one", part.name));
        }
        if part.is_empty() {
            return fault(format!("part `{}` has no elements; remove it", part.name));
        }
        for (side, name) in [("front", &part.front), ("back", &part.back)] {
            let Some(name) = name.as_deref().filter(|name| !chambers.contains(name)) else { continue };
            let known = if chambers.is_empty() { "none".into() } else { chambers.join(", ") };
            let meant = meant(name, chambers.iter().copied());
            return fault(format!(
                "part `{}` has chamber `{name}` at its {side}, which does not exist (chambers: {known}){meant}",
                part.name
            ));
        }
    }
    let faced = |name: &str| mesh.parts.iter().any(|p| [&p.front, &p.back].iter().any(|n| n.as_deref() == Some(name)));
    if let Some(name) = chambers.iter().find(|name| !faced(name)) {
        let sides = mesh.parts.iter().flat_map(|p| [p.front.as_deref(), p.back.as_deref()]).flatten();
        return fault(format!("no part faces chamber `{name}`{}", meant(name, sides)));
    }
    Ok(())
}

/// A node without elements would have no mass.
fn every_node_used(mesh: &Mesh) -> Result<(), FemError> {
    let mut used = vec![false; mesh.points.len()];
    for n in mesh.faces().flatten() {
        used[*n as usize] = true;
    }
    let unused = used.iter().filter(|used| !**used).count();
    match used.iter().position(|used| !used) {
        None => Ok(()),
        Some(i) => fault(format!(
            "node {} at {} belongs to no element and would have no mass; remove it ({unused} such)",
            i + 1,
            millimetres(mesh.points[i])
        )),
    }
}

/// Ties between existing nodes, each tied once, to nodes that are free, with weights of sum 1.
fn ties(mesh: &Mesh) -> Result<(), FemError> {
    let count = mesh.points.len();
    let mut tied = vec![false; count];
    for tie in &mesh.ties {
        let number = tie.node as u64 + 1;
        if std::mem::replace(&mut tied[tie.node as usize], true) {
            return fault(format!("node {number} is tied twice; keep one of the two ties"));
        }
        let sum: f64 = tie.to.iter().map(|t| t.1).sum();
        // Allows weights written with ten digits.
        if !sum.is_finite() || (sum - 1.0).abs() > 1e-9 {
            return fault(format!("tie of node {number}: weights sum to {sum}, and must sum to 1"));
        }
    }
    for tie in &mesh.ties {
        if let Some((to, _)) = tie.to.iter().find(|(to, _)| tied[*to as usize]) {
            let (node, to) = (tie.node + 1, to + 1);
            return fault(format!("node {node} is tied to node {to}, which is itself tied; tie both to free nodes"));
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests;
