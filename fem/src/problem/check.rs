//! What of a problem cannot be simulated.

use super::{Problem, Settings, solid};
use crate::{FemError, Result};

impl Problem {
    /// Refuses what cannot be simulated.
    ///
    /// # Errors
    /// [`FemError::Problem`] saying which value is wrong and what to write.
    pub fn check(&self) -> Result<()> {
        self.check_but_obstacles()?;
        solid::check(&self.mesh.starts(), &self.obstacles, 0.0)
    }

    /// The same where the run goes on from a later shape.
    pub(crate) fn check_but_obstacles(&self) -> Result<()> {
        let refuse = |message: String| Err(FemError::Problem(message));
        if self.sections.len() != self.mesh.parts.len() {
            return refuse(format!("{} parts but {} sections", self.mesh.parts.len(), self.sections.len()));
        }
        for (section, part) in self.sections.iter().zip(&self.mesh.parts) {
            let bad = |what: &str| refuse(format!("part `{}`{what}", part.name));
            let density = section.density_kg_m3;
            if section.plies.is_empty() {
                return bad(" has no ply");
            }
            if !(density > 0.0 && density.is_finite()) {
                return bad(&format!(": density must be positive, not {density}"));
            }
            if !(section.bending_factor >= 0.0 && section.bending_factor.is_finite()) {
                return bad(": bending_factor must be 0 or more");
            }
            let mut thick = section.plies.iter().map(|ply| ply.fabric.thickness_m());
            if let Some(thickness) = thick.find(|t| *t <= 0.0 || !t.is_finite()) {
                return bad(&format!(": thickness must be positive, not {thickness}"));
            }
            if section.plies.iter().any(|ply| !stiff(&*ply.fabric)) {
                return bad(": some stiffness of its fabric is not positive");
            }
        }
        let chambers: Vec<&str> = self.chambers.iter().map(|c| c.name.as_str()).collect();
        let open: Vec<&str> = self.open.iter().map(String::as_str).collect();
        let quality = crate::mesh::check::check_open(&self.mesh, &chambers, &open)?;
        self.check_gas(&quality.volumes_m3)?;
        self.check_rims()?;
        self.check_warps()?;
        self.check_supports()?;
        if self.settings.selective_mass && self.contact.as_ref().is_some_and(|c| c.edges) {
            let message = "contact: edges need each node's own mass; leave out edges, or selective_mass";
            return refuse(message.into());
        }
        self.settings.check()
    }
}

/// True if every small strain costs energy.
fn stiff(fabric: &dyn models::Fabric) -> bool {
    let a = fabric.tangent([0.0; 3], &[0.0; 2]);
    let finite = a.as_flattened().iter().all(|x| x.is_finite());
    finite && a[0][0] > 0.0 && a[2][2] > 0.0 && a[0][0] * a[1][1] > a[0][1] * a[1][0]
}

impl Settings {
    fn check(&self) -> Result<()> {
        let refuse = |message: String| Err(FemError::Problem(format!("settings: {message}")));
        let positive = [("end_s", self.end_s), ("cfl", self.cfl), ("output_every_s", self.output_every_s)];
        if let Some((name, value)) = positive.iter().find(|(_, v)| !(*v > 0.0 && v.is_finite())) {
            return refuse(format!("{name} must be positive, not {value}"));
        }
        if let Some(dt) = self.dt_s.filter(|dt| !(*dt > 0.0 && dt.is_finite())) {
            return refuse(format!("the time step must be positive, not {dt}; leave it out"));
        }
        let not_negative = [
            ("mass_damping_1_s", self.mass_damping_1_s),
            ("viscosity", self.viscosity),
            ("hourglass", self.hourglass),
            ("imperfection", self.imperfection),
        ];
        if let Some((name, value)) = not_negative.iter().find(|(_, v)| !(*v >= 0.0 && v.is_finite())) {
            return refuse(format!("{name} must be 0 or more, not {value}"));
        }
        let passes = self.mass_passes;
        if ![2, 4, 6].contains(&passes) {
            return refuse(format!("mass_passes must be 2, 4 or 6, not {passes}"));
        }
        if self.cfl > 1.0 {
            return refuse(format!("cfl {} is over 1, the limit of stability", self.cfl));
        }
        Ok(())
    }
}
