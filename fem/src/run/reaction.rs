//! What supports do to the structure.
//!
//! ```text
//! R(n) = Σ [m (v(n+½) − v(n−½))/Δt − f(n)]      M(n) = Σ (x(n) − x̄(n)) × R      over the nodes and axes that a set holds
//! ```
//! f everything else that acts on a node: shells, pressure, loads, contact, and what ties hand over. So R is the force **on the
//! structure**, and R·v of a driven set is the power that goes in. A node and axis that several supports name counts for the first of
//! them, so that sums over all supports are right. Nodes that a rigid body or a tie carries along are not held by a support.

use crate::problem::Problem;
use crate::vec3::{Nodes, V3};
use crate::{Mesh, Result};

/// Force and moment that the supports of one node set exert on the structure.
#[derive(Debug, Clone, PartialEq)]
pub struct Reaction {
    /// Name of the node set whose supports react.
    pub set: String,
    /// Which of x, y, z its supports hold or drive.
    pub axes: [bool; 3],
    /// Force on the structure \[N\]; 0 along axes that are not held.
    pub force_n: [f64; 3],
    /// Moment of these forces about the mean place of the set's nodes \[N·m\].
    pub moment_nm: [f64; 3],
}

/// The reactions of a run, as they were in the last step that somebody looks at.
#[derive(Debug, Clone, Default)]
pub(super) struct Reactions {
    pub all: Vec<Reaction>,
    /// Nodes of each, with the axes that are its own.
    nodes: Vec<Vec<(u32, [bool; 3])>>,
}

impl Reactions {
    /// One for every node set that supports name, in their order.
    pub(super) fn new(problem: &Problem, mesh: &Mesh) -> Result<Reactions> {
        let mut free = vec![[true; 3]; mesh.points.len()];
        for rigid in &problem.rigid {
            for node in mesh.set(&rigid.set, "rigid")?.iter() {
                free[*node as usize] = [false; 3];
            }
        }
        for tie in mesh.ties.iter() {
            free[tie.node as usize] = [false; 3];
        }
        let mut reactions = Reactions::default();
        for support in &problem.supports {
            let place = reactions.place_of(&support.set);
            let Reaction { axes, .. } = &mut reactions.all[place];
            (0..3).for_each(|k| axes[k] |= support.axes[k]);
            for node in mesh.set(&support.set, "support")? {
                let free = &mut free[*node as usize];
                let own = [0, 1, 2].map(|k| support.axes[k] && free[k]);
                (0..3).for_each(|k| free[k] &= !support.axes[k]);
                reactions.nodes[place].push((*node, own));
            }
        }
        Ok(reactions)
    }

    fn place_of(&mut self, set: &str) -> usize {
        self.all.iter().position(|r| r.set == set).unwrap_or_else(|| {
            let (axes, nothing) = ([false; 3], [0.0; 3]);
            self.all.push(Reaction { set: set.into(), axes, force_n: nothing, moment_nm: nothing });
            self.nodes.push(Vec::new());
            self.all.len() - 1
        })
    }

    pub(super) fn clear(&mut self) {
        for r in self.all.iter_mut() {
            (r.force_n, r.moment_nm) = ([0.0; 3], [0.0; 3]);
        }
    }

    /// Adds a share of the nodes' forces \[N\], their places being `x` \[m\].
    pub(super) fn add(&mut self, x: &Nodes, share: impl Fn(usize) -> V3) {
        for (reaction, nodes) in self.all.iter_mut().zip(&self.nodes) {
            let count = nodes.len() as f64;
            let mut mean = [0.0; 3];
            nodes.iter().for_each(|(node, _)| (0..3).for_each(|k| mean[k] += x[*node as usize][k] / count));
            for (node, axes) in nodes {
                let (i, force) = (*node as usize, share(*node as usize));
                let force = [0, 1, 2].map(|k| if axes[k] { force[k] } else { 0.0 });
                let moment = crate::vec3::cross([0, 1, 2].map(|k| x[i][k] - mean[k]), force);
                (0..3).for_each(|k| reaction.force_n[k] += force[k]);
                (0..3).for_each(|k| reaction.moment_nm[k] += moment[k]);
            }
        }
    }

    pub(super) fn save(&self) -> Vec<[V3; 2]> {
        self.all.iter().map(|r| [r.force_n, r.moment_nm]).collect()
    }

    pub(super) fn restore(&mut self, from: &[[V3; 2]]) -> Option<()> {
        (from.len() == self.all.len()).then_some(())?;
        for (reaction, saved) in self.all.iter_mut().zip(from) {
            [reaction.force_n, reaction.moment_nm] = *saved;
        }
        Some(())
    }
}

#[cfg(test)]
#[path = "reaction_tests.rs"]
mod tests;
