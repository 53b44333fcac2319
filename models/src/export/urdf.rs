//! A linear chain as URDF: links and revolute joints. The format has no springs, so K, B and b of a joint are a comment of it.

use super::linear::Linear;
use super::rigid::{Surroundings, xml};

/// Largest turn of a joint either way \[rad\].
const TURN_RAD: f64 = 1.6;

impl Linear {
    /// The chain as a URDF file (m, kg, s, N, rad).
    pub fn urdf(&self, about: &Surroundings) -> String {
        let mut parts = String::new();
        let (mut parent, mut end) = ("base".to_string(), [0.0; 2]);
        for (i, (joint, link)) in self.joints.iter().zip(self.links(about)).enumerate() {
            let (number, [x, y], [cx, cy]) = (i + 1, link.at_m, link.centre_m);
            let drive: String = self.channels().map(|c| format!(" + {} P{c}", joint.per_pa[c] * 1e3)).collect();
            parts += &format!(
                "<!-- moment of joint_{number} in N m: {}{drive} - {} q; P in kPa -->\n\
                 <joint name=\"joint_{number}\" type=\"revolute\">\n<parent link=\"{parent}\"/>\n<child link=\"link_{number}\"/>\n\
                 <origin xyz=\"{x} {y} 0\"/>\n<axis xyz=\"0 0 1\"/>\n\
                 <limit lower=\"-{TURN_RAD}\" upper=\"{TURN_RAD}\" effort=\"1000\" velocity=\"1000\"/>\n\
                 <dynamics damping=\"{}\"/>\n</joint>\n\
                 <link name=\"link_{number}\">\n<inertial>\n<origin xyz=\"{cx} {cy} 0\"/>\n<mass value=\"{}\"/>\n\
                 <inertia ixx=\"{4}\" ixy=\"0\" ixz=\"0\" iyy=\"{4}\" iyz=\"0\" izz=\"{4}\"/>\n</inertial>\n</link>\n",
                joint.offset_nm, joint.stiffness_nm, link.damping_nms, link.mass_kg, link.inertia_kg_m2,
            );
            (parent, end) = (format!("link_{number}"), link.centre_m);
        }
        format!(
            "<robot name=\"{}\">\n<!-- {} -->\n<mujoco>\n<compiler fusestatic=\"false\"/>\n</mujoco>\n<link name=\"base\"/>\n{parts}\
             <joint name=\"tip_joint\" type=\"fixed\">\n<parent link=\"{parent}\"/>\n<child link=\"tip\"/>\n\
             <origin xyz=\"{} {} 0\"/>\n</joint>\n<link name=\"tip\"/>\n</robot>\n",
            xml(about.name),
            about.words(),
            end[0],
            end[1],
        )
    }
}
