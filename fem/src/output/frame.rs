//! The state of all nodes and elements at one moment, checked before it is written.

use crate::run::{ChamberState, ElementFields};
use crate::{FemError, Mesh, Result, Simulation};

/// The state of all nodes and elements at one moment, in mesh order.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct MeshFrame {
    pub step: u64,
    pub time_s: f64,
    pub positions: Vec<[f64; 3]>,
    pub velocities: Vec<[f64; 3]>,
    pub fields: ElementFields,
    /// Contact pressure at every node \[Pa\]; empty without contact.
    pub contact_pressure_pa: Vec<f64>,
    pub chambers: Vec<ChamberState>,
    /// Pressure of the present or next hold \[Pa\], of a robot that is read at holds.
    pub hold_pa: Option<f64>,
}

impl MeshFrame {
    pub(crate) fn of(run: &Simulation) -> MeshFrame {
        MeshFrame {
            step: run.step(),
            time_s: run.time_s(),
            positions: run.positions(),
            velocities: run.velocities(),
            fields: run.element_fields(),
            contact_pressure_pa: run.contact_pressure_pa(),
            chambers: run.chambers(),
            hold_pa: None,
        }
    }

    /// Checks that the frame fits the mesh and that every number is finite.
    pub(crate) fn check(&self, mesh: &Mesh) -> Result<()> {
        let (nodes, elements) = (mesh.points.len(), mesh.elements());
        let MeshFrame { fields, positions, velocities, contact_pressure_pa: contact, .. } = self;
        let pressed = if contact.is_empty() { 0 } else { nodes };
        let chambers: Vec<f64> = self.chambers.iter().flat_map(|c| [c.pressure_pa, c.volume_m3]).collect();
        let wrinkles: Vec<f64> = fields.wrinkle_state.iter().map(|state| f64::from(*state)).collect();
        let directions = fields.principal_direction.as_flattened().as_flattened();
        let [stress, strain] = [&fields.principal_stress_pa, &fields.principal_strain].map(|f| f.as_flattened());
        self.finite("time", "run", [1, 1], &[self.time_s])?;
        self.finite("position", "node", [nodes, 3], positions.as_flattened())?;
        self.finite("velocity", "node", [nodes, 3], velocities.as_flattened())?;
        self.finite("contact pressure", "node", [pressed, 1], contact)?;
        self.finite("pressure or volume", "chamber", [self.chambers.len(), 2], &chambers)?;
        let lists: [(&str, usize, &[f64]); 6] = [
            ("von Mises stress", 1, &fields.von_mises_pa),
            ("thickness", 1, &fields.thickness_m),
            ("principal direction", 6, directions),
            ("principal stress", 2, stress),
            ("strain", 2, strain),
            ("wrinkle state", 1, &wrinkles),
        ];
        lists.iter().try_for_each(|(name, each, values)| self.finite(name, "element", [elements, *each], values))
    }

    /// Checks that there are so many values of so many numbers each, all finite.
    fn finite(&self, name: &str, of: &str, [count, each]: [usize; 2], numbers: &[f64]) -> Result<()> {
        if numbers.len() != count * each {
            let found = numbers.len() / each;
            return Err(self
                .refused(format!("{found} values of {name} for {count} {of}s: these results belong to another mesh")));
        }
        let Some(at) = numbers.iter().position(|number| !number.is_finite()) else { return Ok(()) };
        let (number, bad) = (at / each + 1, numbers[at]);
        Err(self.refused(format!(
            "{name} of {of} {number} is {bad}: nothing of this moment was written. Look at the last frame before it, then try a \
             smaller cfl or slower loading"
        )))
    }

    fn refused(&self, reason: String) -> FemError {
        FemError::stopped(self.step, self.time_s, reason)
    }
}

#[cfg(test)]
#[path = "frame_tests.rs"]
pub(super) mod samples;
