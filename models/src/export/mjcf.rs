//! A linear chain for MuJoCo: hinges with springs, and one actuator for every supply channel, whose control is its pressure in kPa.
//!
//! A fixed tendon hands the pressure on to the joints with the coefficients B; K is the stiffness and b/K the rest angle of a hinge.

use super::linear::Linear;
use super::rigid::{Surroundings, xml};

const STEP_S: f64 = 5e-4;
/// Largest share of a joint's fastest oscillation in a step: its armature is as large as that needs.
const SHARE: f64 = 0.2;

impl Linear {
    /// The chain as an MJCF file (m, kg, s, N, rad; pressures in kPa), gravity of `about` included. Its key `working_point` has angles and
    /// pressures. Every joint needs K > 0.
    pub fn mjcf(&self, about: &Surroundings) -> String {
        let links = self.links(about);
        let [gx, gy] = about.gravity_m_s2.map(|g| g + 0.0);
        let r = about.radius_m;
        let mut bodies = String::new();
        for (i, (joint, link)) in self.joints.iter().zip(&links).enumerate() {
            let (number, [x, y], [cx, cy]) = (i + 1, link.at_m, link.centre_m);
            let (k, damping) = (joint.stiffness_nm, link.damping_nms);
            // The last link ends at the tip, in the middle between its hinge and the next one's place.
            let drawn_m = if number == links.len() { cx } else { 2.0 * cx };
            let (armature, rest) = (k * (STEP_S / SHARE).powi(2), joint.offset_nm / k);
            bodies += &format!(
                "<body name=\"link_{number}\" pos=\"{x} {y} 0\">\n\
                 <inertial pos=\"{cx} {cy} 0\" mass=\"{}\" diaginertia=\"{2} {2} {2}\"/>\n\
                 <joint name=\"joint_{number}\" axis=\"0 0 1\" stiffness=\"{k}\" springref=\"{rest}\" damping=\"{damping}\" \
                 armature=\"{armature}\"/>\n\
                 <geom type=\"capsule\" fromto=\"0 {cy} 0 {} {cy} 0\" size=\"{r}\" contype=\"0\" conaffinity=\"0\"/>\n",
                link.mass_kg, drawn_m, link.inertia_kg_m2,
            );
        }
        let end = links.last().map_or([0.0; 2], |link| link.centre_m);
        bodies += &format!("<site name=\"tip\" pos=\"{} {} 0\"/>\n", end[0], end[1]);
        bodies += &"</body>\n".repeat(links.len());
        let (mut tendons, mut motors, mut controls) = (String::new(), String::new(), Vec::new());
        for channel in self.channels() {
            let coefficient = |(i, joint): (usize, &super::Joint)| {
                format!("<joint joint=\"joint_{}\" coef=\"{}\"/>\n", i + 1, joint.per_pa[channel] * 1e3)
            };
            let joints: String = self.joints.iter().enumerate().map(coefficient).collect();
            tendons += &format!("<fixed name=\"drive_{channel}\">\n{joints}</fixed>\n");
            motors += &format!(
                "<motor name=\"pressure_{channel}_kpa\" tendon=\"drive_{channel}\" ctrllimited=\"true\" ctrlrange=\"0 {}\"/>\n",
                about.most_pa / 1e3
            );
            controls.push(self.loads.actuator_pa[channel] / 1e3);
        }
        let row = |values: Vec<f64>| values.iter().map(f64::to_string).collect::<Vec<_>>().join(" ");
        let angles = row(self.joints.iter().map(|joint| joint.angle_rad).collect());
        format!(
            "<mujoco model=\"{}\">\n<!-- {} -->\n<compiler angle=\"radian\"/>\n\
             <option timestep=\"{STEP_S}\" integrator=\"implicitfast\" gravity=\"{gx} {gy} 0\"/>\n\
             <worldbody>\n{bodies}</worldbody>\n<tendon>\n{tendons}</tendon>\n<actuator>\n{motors}</actuator>\n\
             <sensor>\n<framepos name=\"tip_m\" objtype=\"site\" objname=\"tip\"/>\n</sensor>\n\
             <keyframe>\n<key name=\"working_point\" qpos=\"{angles}\" ctrl=\"{}\"/>\n</keyframe>\n</mujoco>\n",
            xml(about.name),
            about.words(),
            row(controls),
        )
    }
}
