//! The state of all nodes and elements at one moment, checked before it is written.

use crate::run::{ChamberState, ElementFields};
use crate::{FemError, Mesh, Result, Simulation};

/// The state of all nodes and elements at one moment, in mesh order.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Frame {
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

impl Frame {
    pub(crate) fn of(run: &Simulation) -> Frame {
        Frame {
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
        let Frame { fields, .. } = self;
        self.finite("time", "run", 1, [self.time_s].iter().map(std::slice::from_ref))?;
        self.finite("position", "node", nodes, self.positions.iter().map(<[f64; 3]>::as_slice))?;
        self.finite("velocity", "node", nodes, self.velocities.iter().map(<[f64; 3]>::as_slice))?;
        if !self.contact_pressure_pa.is_empty() {
            let pressures = self.contact_pressure_pa.iter().map(std::slice::from_ref);
            self.finite("contact pressure", "node", nodes, pressures)?;
        }
        let scalars = [("von Mises stress", &fields.von_mises_pa), ("thickness", &fields.thickness_m)];
        for (name, values) in scalars {
            self.finite(name, "element", elements, values.iter().map(std::slice::from_ref))?;
        }
        let chambers: Vec<[f64; 2]> = self.chambers.iter().map(|c| [c.pressure_pa, c.volume_m3]).collect();
        self.finite("pressure or volume", "chamber", chambers.len(), chambers.iter().map(<[f64; 2]>::as_slice))?;
        let directions = fields.principal_direction.iter().map(|d| d.as_flattened());
        self.finite("principal direction", "element", elements, directions)?;
        let pairs = [("principal stress", &fields.principal_stress_pa), ("strain", &fields.principal_strain)];
        for (name, values) in pairs {
            self.finite(name, "element", elements, values.iter().map(<[f64; 2]>::as_slice))?;
        }
        match fields.wrinkle_state.len() {
            count if count == elements => Ok(()),
            count => Err(self.length("wrinkle state", "element", count, elements)),
        }
    }

    fn finite<'a>(
        &self,
        name: &str,
        of: &str,
        expected: usize,
        values: impl ExactSizeIterator<Item = &'a [f64]>,
    ) -> Result<()> {
        if values.len() != expected {
            return Err(self.length(name, of, values.len(), expected));
        }
        for (index, entry) in values.enumerate() {
            if let Some(bad) = entry.iter().find(|value| !value.is_finite()) {
                return Err(self.refused(format!(
                    "{name} of {of} {} is {bad}: nothing of this moment was written. PictureLook at the last frame before it, \
                     then try a smaller cfl or slower loading",
                    index + 1
                )));
            }
        }
        Ok(())
    }

    fn length(&self, name: &str, of: &str, found: usize, expected: usize) -> FemError {
        self.refused(format!("{found} values of {name} for {expected} {of}s: these results belong to another mesh"))
    }

    fn refused(&self, reason: String) -> FemError {
        FemError::Stopped { step: self.step, time_s: self.time_s, reason }
    }
}

#[cfg(test)]
#[path = "frame_tests.rs"]
pub(super) mod samples;
