//! What the chain of a rigid-body simulator has besides its joints: places of hinges, masses, gravity.
//!
//! ```text
//!  base    hinge 1          hinge 2         tip       centre line, y = 0
//!   |───────────┬───────────────┬────────────|
//!               ○               ○                     hinges, y = −a: `line_offset_mm` from the centre line, on the taut generator
//!       ℓ₁      |  ℓ₁  +  ℓ₂    |     ℓ₂              ℓ = (h/2) tan(q/2)/(q/2) at the working point
//! ```
//!
//! With this ℓ a hinge moves the end of its piece as the arc does, exactly at the working point. In the model's nodes, the ends of
//! pieces, are the masses: each is half of both neighbouring pieces.

use super::linear::{Joint, Linear};

/// The surroundings of a chain in a file for a simulator.
#[derive(Debug, Clone)]
pub struct Surroundings<'a> {
    /// Name of the robot, which the model in the file carries.
    pub name: &'a str,
    /// The command that made the file.
    pub command: &'a str,
    /// Radius of the body, as the links are drawn \[m\].
    pub radius_m: f64,
    /// Mass of the body per length \[kg/m\], from which the links have theirs.
    pub mass_kg_per_m: f64,
    /// Gravity along x and y \[m/s²\].
    pub gravity_m_s2: [f64; 2],
    /// Largest actuator pressure of the robot \[Pa\], the upper end of the control range.
    pub most_pa: f64,
}

/// A rigid link, which begins at its hinge.
pub(super) struct Link {
    /// Its hinge in the frame of the link before \[m\].
    pub at_m: [f64; 2],
    /// End of its piece, where its mass is, in its own frame \[m\].
    pub centre_m: [f64; 2],
    pub mass_kg: f64,
    pub inertia_kg_m2: f64,
    /// C, or the assumed [`SETTLING_S`] times K \[N·m·s/rad\].
    pub damping_nms: f64,
}

/// Time in which a joint without creep settles, assumed \[s\].
const SETTLING_S: f64 = 0.02;

impl Surroundings<'_> {
    pub(super) fn words(&self) -> String {
        let text = format!(
            "made by ibr: {}. x along the straight robot, y towards the actuator, hinges on the taut generator. Linear about its working \
             point, with the tip of the model there. Damping is {SETTLING_S} s times K without creep, assumed",
            self.command
        );
        // Two hyphens end a comment.
        text.replace("--", "- -")
    }
}

impl Linear {
    pub(super) fn links(&self, about: &Surroundings) -> Vec<Link> {
        let radius = about.radius_m;
        let link = |i: usize| {
            let (joint, half) = (&self.joints[i], self.joints[i].half_m());
            let before = i.checked_sub(1).map(|i| &self.joints[i]);
            let [behind, offset_m] = before.map_or([0.0; 2], |joint| [joint.half_m(), joint.line_offset_m]);
            let length_m = 0.5 * (joint.length_m + self.joints.get(i + 1).map_or(0.0, |next| next.length_m));
            let mass_kg = about.mass_kg_per_m * length_m;
            Link {
                at_m: [behind + half, offset_m - joint.line_offset_m],
                centre_m: [half, joint.line_offset_m],
                mass_kg,
                inertia_kg_m2: mass_kg * (0.5 * radius * radius + length_m * length_m / 12.0),
                damping_nms: joint.damping_nms.unwrap_or(SETTLING_S * joint.stiffness_nm),
            }
        };
        (0..self.joints.len()).map(link).collect()
    }

    /// Iterates over the channels whose pressure moves at least one joint.
    pub fn channels(&self) -> impl Iterator<Item = usize> {
        let drives = |channel: &usize| self.joints.iter().any(|joint: &Joint| joint.per_pa[*channel] != 0.0);
        (0..crate::CHANNELS).filter(drives)
    }
}

pub(super) fn xml(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('"', "&quot;")
}
