//! Several meshes as one mesh, without any weld between them.

use super::Mesh;
use crate::FemError;

impl Mesh {
    /// Adds another mesh to this one. Part names must differ; sets of the same name unite, and a chamber named by both
    /// is one chamber. Nothing is welded.
    ///
    /// # Errors
    /// [`FemError::Mesh`] naming a part that both have.
    pub fn append(&mut self, mut other: Mesh) -> Result<(), FemError> {
        if let Some(part) = other.parts.iter().find(|part| self.parts.iter().any(|own| own.name == part.name)) {
            return Err(FemError::Mesh(format!("both meshes have a part `{}`; rename one", part.name)));
        }
        let Ok(offset) = u32::try_from(self.points.len() + other.points.len()).map(|_| self.points.len() as u32) else {
            return Err(FemError::Mesh("more nodes than can be numbered".into()));
        };
        if self.start.len() + other.start.len() > 0 {
            (self.start, other.start) = (self.starts(), other.starts());
            self.start.append(&mut other.start);
        }
        self.points.append(&mut other.points);
        other.each_node(|n| *n = n.saturating_add(offset));
        self.parts.append(&mut other.parts);
        other.sets.into_iter().for_each(|(name, nodes)| self.sets.entry(name).or_default().extend(nodes));
        self.ties.append(&mut other.ties);
        Ok(())
    }

    /// Changes the number of every node in elements, sets and ties.
    pub(crate) fn each_node(&mut self, mut change: impl FnMut(&mut u32)) {
        for part in &mut self.parts {
            part.quads.iter_mut().flatten().for_each(&mut change);
            part.triangles.iter_mut().flatten().for_each(&mut change);
        }
        self.sets.values_mut().flatten().for_each(&mut change);
        for tie in &mut self.ties {
            change(&mut tie.node);
            tie.to.iter_mut().for_each(|(node, _)| change(node));
        }
    }
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
    fn a_part_name_used_twice_is_refused() {
        let error = shifted("a", 0.0).append(shifted("a", 1.0)).unwrap_err();
        assert_eq!(error.to_string(), "mesh: both meshes have a part `a`; rename one");
    }
}
