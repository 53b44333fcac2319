//! What of a problem cannot be simulated, or contradicts itself before the first step.

use super::{Pressure, Problem, Section, Settings, Support, solid};
use crate::mesh::check::{near, planes, rim};
use crate::mesh::{Mesh, Part};
use crate::vec3::{V3, area, centre, cross, norm, sub};
use crate::{FemError, Result, policy};

const AXES: [&str; 3] = ["x", "y", "z"];
/// The warp of a part that has none.
pub(crate) const X: V3 = [1.0, 0.0, 0.0];

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
            let message = format!("{} parts but {} sections", self.mesh.parts.len(), self.sections.len());
            return refuse(message);
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
            let message = format!("the time step must be positive, not {dt}; leave it out");
            return refuse(message);
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
            let message = format!("cfl {} is over 1, the limit of stability", self.cfl);
            return refuse(message);
        }
        Ok(())
    }
}

impl Problem {
    /// Edges of a chamber that is open between planes must stay in these planes: the model has nothing beyond them.
    pub(super) fn check_rims(&self) -> Result<()> {
        for (chamber, open) in self.chambers.iter().filter_map(|c| Some((&c.name, c.open_axis?))) {
            let rim = rim(&self.mesh, chamber);
            let held = self.held();
            let near = near(&self.mesh, &rim);
            let at = |n: u32| self.mesh.start_of(n as usize);
            let lies = |[a, b]: &[u32; 2], k: usize| (at(*a)[k] - at(*b)[k]).abs() <= near;
            let rests = |edge: &[u32; 2], k: usize| lies(edge, k) && edge.iter().all(|n| held[*n as usize][k]);
            if let Some(edge) = rim.iter().find(|edge| !(0..3).any(|k| open[k] && rests(edge, k))) {
                let axis = |fits: &dyn Fn(usize) -> bool| (0..3).find(|k| fits(*k));
                let other = axis(&|k| !open[k] && rests(edge, k));
                return Err(FemError::Problem(match (other, axis(&|k| open[k] && lies(edge, k))) {
                    (Some(other), _) => {
                        let all: String = (0..3).filter(|k| open[*k] || *k == other).map(|k| AXES[k]).collect();
                        format!(
                            "{} along {} and held there too. Try: open_axis = \"{all}\"",
                            self.ends(chamber, *edge),
                            AXES[other]
                        )
                    }
                    (None, Some(k)) => self.free(chamber, *edge, k, &held),
                    (None, None) => format!(
                        "{} in no plane perpendicular to an axis of open_axis. Try: a mesh whose edge there is in one",
                        self.ends(chamber, *edge)
                    ),
                }));
            }
            let planes = planes(&self.mesh, &rim, |n, k| held[n as usize][k]);
            if let Some(k) = (0..3).find(|k| open[*k] && planes[*k].is_empty()) {
                return Err(FemError::Problem(format!(
                    "chamber `{chamber}` does not end at a plane perpendicular to {}. Try: open_axis without this letter, or no \
                     open_axis for a closed chamber",
                    AXES[k]
                )));
            }
            if open == [true; 3] && planes.iter().all(|along| along.len() > 1) {
                return Err(FemError::Problem(format!(
                    "chamber `{chamber}` ends at two planes or more along each of x, y and z, and its volume cannot be counted. \
                     Try: a model that ends at one plane along one of them"
                )));
            }
        }
        Ok(())
    }

    /// A chamber that is sealed from the start must hold some gas; `volumes_m3` are the volumes at the start.
    pub(super) fn check_gas(&self, volumes_m3: &[(String, f64)]) -> Result<()> {
        for (chamber, (name, volume_m3)) in self.chambers.iter().zip(volumes_m3) {
            let Pressure::Sealed { sealed_at_s, gas, .. } = &chamber.pressure else { continue };
            let faces =
                |part: &&Part| [&part.front, &part.back].iter().any(|side| side.as_deref() == Some(name.as_str()));
            let area = |part: &Part| (0..part.len()).map(|i| norm(normal(&self.mesh, part, i))).sum::<f64>();
            let area_m2: f64 = self.mesh.parts.iter().filter(faces).map(area).sum();
            if *sealed_at_s == 0.0 && !policy::holds_gas((volume_m3 + gas.dead_m3) / area_m2.powf(1.5)) {
                return Err(FemError::Problem(format!(
                    "chamber `{name}` holds no gas when it is sealed: its volume is {:.3} cm³ with its dead volume. Try: \
                     dead_volume_cm3 for the hose, or sealed_at_s after it is filled",
                    1e6 * (volume_m3 + gas.dead_m3)
                )));
            }
        }
        Ok(())
    }

    /// Which nodes rest along which axes.
    fn held(&self) -> Vec<[bool; 3]> {
        let mut held = vec![[false; 3]; self.mesh.points.len()];
        for support in &self.supports {
            let rests = |k: usize| support.axes[k] && support.motion.as_ref().is_none_or(|m| m[k].peak() == 0.0);
            for node in self.mesh.sets.get(&support.set).into_iter().flatten() {
                (0..3).for_each(|k| held[*node as usize][k] |= rests(k));
            }
        }
        held
    }

    fn ends(&self, chamber: &str, [a, b]: [u32; 2]) -> String {
        let [x, y, z] = centre(&[a, b].map(|n| self.mesh.start_of(n as usize))).map(|c| c * 1e3 + 0.0);
        format!(
            "chamber `{chamber}` ends at the edge between nodes {} and {} at ({x:.1}, {y:.1}, {z:.1}) mm, open",
            a + 1,
            b + 1
        )
    }

    /// Words for an edge that may leave its plane.
    fn free(&self, chamber: &str, edge: [u32; 2], axis: usize, held: &[[bool; 3]]) -> String {
        let node = edge.into_iter().find(|n| !held[*n as usize][axis]).unwrap_or(edge[1]);
        let sets = self.mesh.sets.iter().filter(|(_, nodes)| nodes.contains(&node)).map(|(name, _)| name.as_str());
        let (letter, sets) = (AXES[axis], sets.collect::<Vec<_>>().join(", "));
        format!(
            "chamber `{chamber}` is open along {letter}, and node {} on its edge is not held along {letter}: its pressure would \
             push it out of its plane. Add [[support]] with axes = \"{letter}\" for the sets of these edges (this node is in: {})",
            node + 1,
            if sets.is_empty() { "none" } else { &sets }
        )
    }

    /// A fabric with directions needs a warp in the plane of every element.
    pub(super) fn check_warps(&self) -> Result<()> {
        let parts = self.mesh.parts.iter().zip(&self.sections);
        let found = parts.map(|(part, section)| warp_fault(&self.mesh, part, section)).find_map(|fault| fault);
        found.map_or(Ok(()), |(message, help)| Err(FemError::Problem(format!("{message}. Try: {help}"))))
    }

    /// Two supports that move one node along one axis must agree.
    pub(super) fn check_supports(&self) -> Result<()> {
        let mut first: std::collections::BTreeMap<(u32, usize), &Support> = std::collections::BTreeMap::new();
        for support in &self.supports {
            let Some(nodes) = self.mesh.sets.get(&support.set) else { continue };
            for (node, axis) in
                nodes.iter().flat_map(|n| (0..3).map(move |k| (*n, k))).filter(|(_, k)| support.axes[*k])
            {
                let other = *first.entry((node, axis)).or_insert(support);
                // Held and moved by nothing are the same.
                let path = |s: &Support| s.motion.as_ref().map(|m| m[axis].clone()).filter(|m| m.peak() > 0.0);
                if path(other) != path(support) {
                    let words =
                        |s: &Support| format!("`{}` {}", s.set, if path(s).is_some() { "moves" } else { "holds" });
                    return Err(FemError::Problem(format!(
                        "two supports contradict each other: {} node {} along {} and {} it another way. Take the node out of one of \
                         the sets, or leave the axis out of one of the supports",
                        words(other),
                        node + 1,
                        AXES[axis],
                        words(support)
                    )));
                }
            }
        }
        Ok(())
    }
}

/// The first element of a part onto which its warp, or x where it has none, cannot be laid, and the remedy. Without its own warp
/// only a section with directions has a fault.
pub(crate) fn warp_fault(mesh: &Mesh, part: &Part, section: &Section) -> Option<(String, String)> {
    if part.warp.is_empty() && !has_directions(section) {
        return None;
    }
    let lies = |i: usize, warp: V3| {
        let normal = normal(mesh, part, i);
        policy::is_in_sheet(norm(cross(warp, normal)) / (norm(warp) * norm(normal)))
    };
    let warp = |i: usize| part.warp_of(i).unwrap_or(X);
    let i = (0..part.len()).find(|i| !lies(*i, warp(*i)))?;
    let axis = |k: usize| [0, 1, 2].map(|c| f64::from(u8::from(c == k)));
    let fit: Vec<String> = (0..3)
        .filter(|k| (0..part.len()).all(|i| lies(i, axis(*k))))
        .map(|k| format!("warp = \"{}\"", AXES[k]))
        .collect();
    let name = &part.name;
    let help = match fit.is_empty() {
        true => format!("warp = [x, y, z] in [part.{name}], or parts of their own for sheets that face different ways"),
        false => format!("{} in [part.{name}]", fit.join(" or ")),
    };
    let [x, y, z] = warp(i);
    let direction = match part.warp.is_empty() {
        true => "x, its direction without the key warp,".to_string(),
        false => format!("its direction ({x}, {y}, {z})"),
    };
    let what = crate::mesh::check::describe(part, i);
    let message = format!(
        "cannot lay the warp of part `{name}` onto {what}: {direction} is along the normal there, within one degree"
    );
    Some((message, help))
}

/// Area vector of an element where it is free of stress.
fn normal(mesh: &Mesh, part: &Part, i: usize) -> V3 {
    area(&part.nodes(i).iter().map(|n| mesh.free_of(*n as usize)).collect::<Vec<_>>())
}

/// Whether it matters where the warp of a section is.
pub(crate) fn has_directions(section: &Section) -> bool {
    !section.plies.iter().all(|ply| is_isotropic(&*ply.fabric))
}

/// Whether tensions turn with strains, so that it does not matter where the warp is.
fn is_isotropic(fabric: &dyn models::Fabric) -> bool {
    // (11, 22, 12) turned by an angle; shear as it enters, once in a tension and twice in a strain.
    let turned = |[a, b, c]: V3, shear: f64, angle: f64| {
        let ((s2, c2), c) = ((2.0 * angle).sin_cos(), c / shear);
        let (mean, half) = (0.5 * (a + b), 0.5 * (a - b));
        let (half, c) = (half * c2 - c * s2, half * s2 + c * c2);
        [mean + half, mean - half, shear * c]
    };
    let states = [[0.01, 0.004, 0.003], [0.01, -0.02, 0.004]];
    states.iter().all(|e| {
        let s = fabric.tension(*e, &[0.0; 2]);
        [0.4, 1.1, std::f64::consts::FRAC_PI_2].iter().all(|angle| {
            let wanted = turned(s, 1.0, *angle);
            let found = fabric.tension(turned(*e, 2.0, *angle), &[0.0; 2]);
            norm(sub(wanted, found)) <= 1e-9 * norm(s)
        })
    })
}
