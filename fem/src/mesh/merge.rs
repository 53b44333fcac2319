//! Meshes put together: append, then weld.

use std::collections::{BTreeSet, HashMap};

use super::Mesh;
use super::geometry::{norm, sub};
use super::names::meant;
use crate::FemError;

impl Mesh {
    /// Adds another mesh beside this one. Part names must differ; sets of the same name unite, and a chamber named by both
    /// is one chamber. Nothing is welded.
    ///
    /// # Errors
    /// [`FemError::Mesh`] naming a part that both have.
    pub fn append(&mut self, other: Mesh) -> Result<(), FemError> {
        if let Some(part) = other.parts.iter().find(|part| self.parts.iter().any(|own| own.name == part.name)) {
            return fault(format!("both meshes have a part `{}`; rename one", part.name));
        }
        if self.points.len() + other.points.len() > u32::MAX as usize {
            return fault("more nodes than can be numbered".into());
        }
        let offset = self.points.len() as u32;
        if self.start.is_empty() && !other.start.is_empty() {
            self.start = self.points.clone();
        }
        if !self.start.is_empty() {
            self.start.extend(if other.start.is_empty() { &other.points } else { &other.start });
        }
        self.points.extend(other.points);
        for mut part in other.parts {
            part.quads.iter_mut().flatten().for_each(|n| *n = n.saturating_add(offset));
            part.triangles.iter_mut().flatten().for_each(|n| *n = n.saturating_add(offset));
            self.parts.push(part);
        }
        for (name, nodes) in other.sets {
            self.sets.entry(name).or_default().extend(nodes.iter().map(|n| n.saturating_add(offset)));
        }
        for mut tie in other.ties {
            tie.node = tie.node.saturating_add(offset);
            tie.to.iter_mut().for_each(|(n, _)| *n = n.saturating_add(offset));
            self.ties.push(tie);
        }
        Ok(())
    }

    /// Merges nodes of the named sets that start within `tolerance_m` of each other; gives the number of nodes removed.
    ///
    /// Of the nodes that meet, the one with the lowest number stays where it is. Later nodes move up.
    ///
    /// # Errors
    /// [`FemError::Mesh`] for an unknown set, a tolerance that is not positive, two nodes that meet at the start but not in
    /// the stress-free shape (a node has one stress-free place), an element or a tie that would lose a node.
    pub fn weld(&mut self, sets: &[&str], tolerance_m: f64) -> Result<usize, FemError> {
        if !(tolerance_m.is_finite() && tolerance_m > 0.0) {
            return fault(format!("weld: tolerance is {tolerance_m}, and must be a positive length in metres"));
        }
        let candidates = self.members(sets)?;
        let stays = self.partners(&candidates, tolerance_m)?;
        let mut number = Vec::with_capacity(self.points.len());
        let mut kept = 0;
        for (node, stays) in stays.iter().enumerate() {
            number.push(if *stays as usize == node { kept } else { number[*stays as usize] });
            kept += u32::from(*stays as usize == node);
        }
        let merged = self.renumbered(&number, &stays)?;
        let removed = self.points.len() - merged.points.len();
        *self = merged;
        Ok(removed)
    }

    /// All nodes of the sets, ascending.
    fn members(&self, sets: &[&str]) -> Result<BTreeSet<u32>, FemError> {
        let mut members = BTreeSet::new();
        for name in sets {
            let Some(nodes) = self.sets.get(*name) else {
                let meant = meant(name, self.sets.keys().map(String::as_str));
                return fault(format!("weld: there is no set `{name}`{meant}"));
            };
            members.extend(nodes.iter().filter(|n| (**n as usize) < self.points.len()));
        }
        Ok(members)
    }

    /// For every node, the node that takes its place.
    fn partners(&self, candidates: &BTreeSet<u32>, tolerance: f64) -> Result<Vec<u32>, FemError> {
        let mut stays: Vec<u32> = (0..self.points.len() as u32).collect();
        let mut cells: HashMap<[i64; 3], Vec<u32>> = HashMap::new();
        for node in candidates {
            let place = self.start_of(*node as usize);
            let cell = place.map(|x| (x / tolerance).floor() as i64);
            let near = (0..27i64).filter_map(|k| {
                let [i, j, k] = [k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1];
                cells.get(&[cell[0].saturating_add(i), cell[1].saturating_add(j), cell[2].saturating_add(k)])
            });
            let meets = |other: &&u32| norm(sub(self.start_of(**other as usize), place)) <= tolerance;
            let Some(other) = near.flatten().filter(meets).min() else {
                cells.entry(cell).or_default().push(*node);
                continue;
            };
            let apart = norm(sub(self.points[*other as usize], self.points[*node as usize]));
            if apart > tolerance {
                return fault(format!(
                    "weld: nodes {} and {} meet at the start, but are {:.3} mm apart in the stress-free shape; a node has one \
                     stress-free place",
                    other + 1,
                    node + 1,
                    apart * 1e3
                ));
            }
            stays[*node as usize] = *other;
        }
        Ok(stays)
    }

    /// The mesh in new numbers, without the nodes that do not stay.
    fn renumbered(&self, number: &[u32], stays: &[u32]) -> Result<Mesh, FemError> {
        let keep = |places: &[[f64; 3]]| {
            places
                .iter()
                .zip(stays)
                .enumerate()
                .filter(|(i, (_, s))| *i == **s as usize)
                .map(|(_, (x, _))| *x)
                .collect()
        };
        let new = |n: u32| number.get(n as usize).copied().unwrap_or(n);
        let (points, membrane, start) = (keep(&self.points), keep(&self.membrane), keep(&self.start));
        let mut mesh = Mesh { points, membrane, start, ..self.clone() };
        for (part, old) in mesh.parts.iter_mut().zip(&self.parts) {
            part.quads.iter_mut().flatten().for_each(|n| *n = new(*n));
            part.triangles.iter_mut().flatten().for_each(|n| *n = new(*n));
            let collapsed = |i: &usize| {
                let nodes = part.nodes(*i);
                (1..nodes.len()).any(|k| nodes[..k].contains(&nodes[k]))
            };
            if let Some(i) = (0..old.len()).find(collapsed) {
                let (name, i) = (&old.name, i + 1);
                return fault(format!("weld: element {i} of part `{name}` would lose a node; use a smaller tolerance"));
            }
        }
        for nodes in mesh.sets.values_mut() {
            let mut seen = BTreeSet::new();
            *nodes = nodes.iter().map(|n| new(*n)).filter(|n| seen.insert(*n)).collect();
        }
        for tie in &mut mesh.ties {
            let node = u64::from(tie.node) + 1;
            tie.node = new(tie.node);
            tie.to.iter_mut().for_each(|(n, _)| *n = new(*n));
            if tie.to.iter().any(|(n, _)| *n == tie.node) {
                return fault(format!("weld: node {node} would be tied to itself; weld it or tie it, not both"));
            }
        }
        Ok(mesh)
    }
}

fn fault<T>(message: String) -> Result<T, FemError> {
    Err(FemError::Mesh(message))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::generate::plate;

    fn shifted(name: &str, x: f64) -> Mesh {
        let mut mesh = plate(1.0, 1.0, 2, 2, None).unwrap();
        mesh.parts[0].name = name.into();
        mesh.points.iter_mut().for_each(|p| p[0] += x);
        mesh
    }

    #[test]
    fn two_plates_welded_at_a_common_edge_are_one_sheet() {
        let mut mesh = shifted("a", 0.0);
        mesh.append(shifted("b", 1.0)).unwrap();
        assert_eq!(mesh.weld(&["left", "right"], 1e-6).unwrap(), 3);
        assert_eq!((mesh.points.len(), mesh.elements(), mesh.sets["right"].len()), (15, 8, 6));
        let quality = crate::mesh::check::check(&mesh, &[]).unwrap();
        assert_eq!((quality.side_m.min, quality.aspect.value), (0.5, 1.0));
        let width = |part: usize| mesh.parts[part].quads.iter().flatten().map(|n| mesh.points[*n as usize][0]);
        assert_eq!((width(0).fold(0.0, f64::max), width(1).fold(9.0, f64::min)), (1.0, 1.0));
    }

    #[test]
    fn a_part_name_used_twice_is_refused() {
        let error = shifted("a", 0.0).append(shifted("a", 1.0)).unwrap_err();
        assert_eq!(error.to_string(), "mesh: both meshes have a part `a`; rename one");
    }

    #[test]
    fn a_weld_that_would_collapse_an_element_is_refused() {
        let error = shifted("a", 0.0).weld(&["left"], 0.6).unwrap_err().to_string();
        assert_eq!(error, "mesh: weld: element 1 of part `a` would lose a node; use a smaller tolerance");
    }

    #[test]
    fn nodes_apart_in_the_stress_free_shape_are_not_welded() {
        let mut mesh = shifted("a", 0.0);
        mesh.append(shifted("b", 1.25)).unwrap();
        mesh.start = mesh.points.clone();
        mesh.start[9..].iter_mut().for_each(|p| p[0] -= 0.25);
        let error = mesh.weld(&["left", "right"], 1e-6).unwrap_err().to_string();
        assert!(error.starts_with("mesh: weld: nodes 3 and 10 meet at the start, but are 250.000 mm apart"), "{error}");
    }

    #[test]
    fn an_unknown_set_and_a_bad_tolerance_are_named() {
        let error = shifted("a", 0.0).weld(&["lft"], 1e-6).unwrap_err().to_string();
        assert_eq!(error, "mesh: weld: there is no set `lft`; did you mean `left`?");
        let error = shifted("a", 0.0).weld(&["left"], f64::NAN).unwrap_err().to_string();
        assert_eq!(error, "mesh: weld: tolerance is NaN, and must be a positive length in metres");
    }
}
