//! Meshes put together.

use super::Mesh;
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
    fn a_part_name_used_twice_is_refused() {
        let error = shifted("a", 0.0).append(shifted("a", 1.0)).unwrap_err();
        assert_eq!(error.to_string(), "mesh: both meshes have a part `a`; rename one");
    }
}
