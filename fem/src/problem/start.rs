//! What contradicts itself before the first step.

use super::{Problem, Support};
use crate::FemError;

impl Problem {
    /// Edges of a chamber that is open between two planes must stay in these planes: what is beyond them is not there.
    pub(super) fn check_rims(&self) -> Result<(), FemError> {
        for (chamber, axis) in self.chambers.iter().filter_map(|c| Some((&c.name, c.open_axis?))) {
            let holds = |set: &str| self.supports.iter().any(|s| s.set == set && s.axes[axis]);
            let held: Vec<&Vec<u32>> = self.mesh.sets.iter().filter(|(set, _)| holds(set)).map(|s| s.1).collect();
            let rim = crate::mesh::check::rim(&self.mesh, chamber);
            let Some(node) = rim.into_iter().find(|n| !held.iter().any(|set| set.contains(n))) else { continue };
            let letter = ["x", "y", "z"][axis];
            let sets = self.mesh.sets.iter().filter(|(_, nodes)| nodes.contains(&node)).map(|(name, _)| name.as_str());
            let sets = sets.collect::<Vec<_>>().join(", ");
            return Err(FemError::Problem(format!(
                "chamber `{chamber}` is open along {letter}, and node {} on its edge is not held along {letter}: its pressure would \
                 push it out of its plane. Add [[support]] with axes = \"{letter}\" for the sets of these edges (this node is in: {})",
                node + 1,
                if sets.is_empty() { "none" } else { &sets }
            )));
        }
        Ok(())
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
                        ["x", "y", "z"][axis],
                        words(support)
                    )));
                }
            }
        }
        Ok(())
    }
}
