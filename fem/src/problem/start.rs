//! What contradicts itself before the first step.

use super::{Problem, Support};
use crate::FemError;
use crate::mesh::check::{near, planes, rim};
use crate::vec3::centre;

const AXES: [&str; 3] = ["x", "y", "z"];

impl Problem {
    /// Edges of a chamber that is open between planes must stay in these planes: what is beyond them is not there.
    pub(super) fn check_rims(&self) -> Result<(), FemError> {
        for (chamber, open) in self.chambers.iter().filter_map(|c| Some((&c.name, c.open_axis?))) {
            let rim = rim(&self.mesh, chamber);
            let held = self.held();
            let (near, at) = (near(&self.mesh, &rim), |n: u32| self.mesh.start_of(n as usize));
            let lies = |[a, b]: &[u32; 2], k: usize| (at(*a)[k] - at(*b)[k]).abs() <= near;
            let rests = |edge: &[u32; 2], k: usize| lies(edge, k) && edge.iter().all(|n| held[*n as usize][k]);
            if let Some(edge) = rim.iter().find(|edge| !(0..3).any(|k| open[k] && rests(edge, k))) {
                let axis = |fits: &dyn Fn(usize) -> bool| (0..3).find(|k| fits(*k));
                let other = axis(&|k| !open[k] && rests(edge, k));
                return Err(FemError::Problem(match (other, axis(&|k| open[k] && lies(edge, k))) {
                    (Some(other), _) => {
                        let all: String = (0..3).filter(|k| open[*k] || *k == other).map(|k| AXES[k]).collect();
                        format!("{} along {} and held there too. Try: open_axis = \"{all}\"", self.ends(chamber, *edge), AXES[other])
                    }
                    (None, Some(k)) => self.free(chamber, *edge, k, &held),
                    (None, None) => format!(
                        "{} in no plane perpendicular to an axis of open_axis. Try: a mesh whose edge there lies in one",
                        self.ends(chamber, *edge)
                    ),
                }));
            }
            let planes = planes(&self.mesh, &rim, |n, k| held[n as usize][k]);
            if open == [true; 3] && planes.iter().all(|along| along.len() > 1) {
                return Err(FemError::Problem(format!(
                    "chamber `{chamber}` ends at two planes or more along each of x, y and z, and its volume cannot be counted. \
                     Try: a model that ends at one plane along one of them"
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
        let node = if held[edge[0] as usize][axis] { edge[1] } else { edge[0] };
        let sets = self.mesh.sets.iter().filter(|(_, nodes)| nodes.contains(&node)).map(|(name, _)| name.as_str());
        let (letter, sets) = (AXES[axis], sets.collect::<Vec<_>>().join(", "));
        format!(
            "chamber `{chamber}` is open along {letter}, and node {} on its edge is not held along {letter}: its pressure would \
             push it out of its plane. Add [[support]] with axes = \"{letter}\" for the sets of these edges (this node is in: {})",
            node + 1,
            if sets.is_empty() { "none" } else { &sets }
        )
    }

    /// Two supports that move one node along one axis must agree.
    pub(super) fn check_supports(&self) -> Result<(), FemError> {
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
