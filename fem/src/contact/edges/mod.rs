//! Nothing passes through anything: springs between sides of elements, and steps that stop short of a meeting.
//!
//! ```text
//! d = |a + u e₁ − b − v e₂|      E = Σ ½ k (g − d)₊²      F = k (g − d)₊ − c ḋ   along n = ∇d
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | e₁, e₂ | two sides (or diagonals that halve quadrilaterals) without a common node | m |
//! | u, v | places of their closest points; the spring acts while both are inside and the sine between them is over 0.1 | - |
//! | g | rest gap: `gap_m` or the distance if smaller for layers that start close, later `thickness_m` (at most a quarter of an element) as far as the pair was apart | m |
//! | k | 0.05 m/dt², m the lightest of the four nodes | N/m |
//! | c | 2 ζ √(k m), ζ = 0.1; only pushes | N·s/m |
//!
//! **Springs** hold sides apart that cross between their nodes; nodes on faces are held by [`super`], which has friction,
//! too. A distance has no side: since nothing ever passed, the present side is the right one, and no memory can be wrong.
//! [`super`] then trusts the present side of a face as well. A spring pushes nothing at once; what it stores when the closest
//! points leave the ends is in `edge damping`. A pair that is pressed closer than half of `gap_m` gets a larger rest gap,
//! slowly, until its spring carries the load; the work of that is a negative loss.
//!
//! **Meetings.** Springs are finite, so all pairs of sides and all pairs of a node and a triangle are followed through the
//! motion of the coming step (additive continuous collision detection). Where two would come closer than a fifth of their
//! distance, or of `gap_m`, the motion is changed by an impulse along their normal at that moment that leaves some of the
//! distance, pair by pair until none is left; pairs that after 20 rounds still meet move as one body in that step. An
//! impulse is a force of the step: momentum is kept, and its work is in `collisions` (inelastic: it is a loss, but for
//! parting pairs closer than a fifth of `gap_m`).
//!
//! **Cost.** A pair is looked at when nodes of its chunk can have moved far enough against each other to matter. The search
//! measures the distances of what it finds, so that a pair far apart waits. A folded pouch of 1400 elements takes 6.4 times the
//! CPU time per step of one with nodes against faces alone, and a seventh more steps. Closest points and meetings, one pair
//! after the other, are half of it; what the search does besides is a fifth: a search without cost would leave 5 times, closest
//! points without cost in addition 2.2. A step looks at 1500 springs and 1700 meetings; 400 springs push.
//! A skin of 0.4 or 0.6 elements takes the same time within the scatter; 0.15 takes a fifth more.
//!
//! **Validity**: layers must start apart and not crossed. What starts as one point (closer than 0.0001 `gap_m`) is left alone
//! until it parts; what starts crossed stays so. Nodes that ties, rigid bodies or supports move count as driven.
//! Sources: Li, Kaufman, Jiang, ACM Trans. Graph. 40 (2021), 170 (detection); Bridson, Fedkiw, Anderson, ACM Trans. Graph.
//! 21 (2002), 594 (impulses, bodies that move as one); growing gaps: this project.

mod body;
mod chunk;
pub(crate) mod hold;
mod pair;
mod sides;
#[cfg(test)]
mod tests;

use models::{Account, LedgerLine, Pose, Row, Term};
use rayon::prelude::*;

use super::follow::Searched;
use super::push;
use crate::bytes::{pack, unpack};
use crate::transient::{dissipated, stored};
use crate::{Tick, Transient};
pub use body::Edges;
use body::ForceMemory;
use chunk::EdgeChunk;

/// What edges cannot find again from positions, after the number of sides.
type SavedEdges = (usize, Searched, [f64; 2], ForceMemory, Vec<EdgeChunk>);

impl Term for Edges {
    fn line(&self) -> LedgerLine {
        LedgerLine::new("edge contact", Account::Contact)
    }

    fn add(&self, at: &Pose, force: &mut [f64]) -> f64 {
        let (x, force) = (at.q.as_chunks::<4>().0, force.as_chunks_mut::<4>().0);
        let mut energy_j = 0.0;
        for pair in self.active() {
            let touch = pair.touch(x);
            let depth_m = pair.rest_m - touch.distance_m;
            if !touch.inside || depth_m <= 0.0 {
                continue;
            }
            energy_j += 0.5 * pair.stiffness_n_m * depth_m * depth_m;
            let push_n = crate::vec3::scale(touch.normal, pair.stiffness_n_m * depth_m);
            for (n, w) in pair.nodes.iter().zip(touch.weights) {
                push(&mut force[*n as usize], w, push_n);
            }
        }
        energy_j
    }
}

impl Transient for Edges {
    fn advance(&mut self, at: &Pose, tick: &Tick, force: &mut [f64]) -> f64 {
        let (x, force) = (at.q.as_chunks::<4>().0, force.as_chunks_mut::<4>().0);
        if self.searched.is_due(x, self.skin_m) {
            self.search(x);
        }
        let (path_m, floor_m) = (self.searched.path_m, 0.5 * self.gap_m.min(self.thickness_m));
        self.chunks.par_iter_mut().for_each(|chunk| chunk.press(x, path_m, tick.dt_s, floor_m));
        self.stored_j = 0.0;
        for chunk in &self.chunks {
            self.stored_j += chunk.sums[0];
            self.lost_j += chunk.sums[1];
            for (nodes, weights, push_n) in &chunk.pushes {
                for (n, w) in nodes.iter().zip(weights) {
                    push(&mut force[*n as usize], *w, *push_n);
                }
            }
        }
        self.stored_j
    }

    /// Lines at the positions of the last step.
    fn ledger(&self, _at: &Pose) -> Vec<Row> {
        vec![
            stored("edge contact", Account::Contact, self.stored_j),
            dissipated("edge damping", Account::Contact, self.lost_j),
            dissipated("collisions", Account::Contact, self.held.lost_j),
        ]
    }

    fn stiffness_bound(&self, at: &Pose, bound: &mut [f64]) {
        let x = at.q.as_chunks::<4>().0;
        for pair in self.active() {
            // K = k b bᵀ, b the weights: uᵀK u ≤ k Σ|b| Σ|bᵢ| uᵢ².
            let touch = pair.touch(x);
            if !touch.inside {
                continue;
            }
            let whole = touch.weights.iter().map(|w| w.abs()).sum::<f64>();
            for (n, w) in pair.nodes.iter().zip(touch.weights) {
                bound[*n as usize] += pair.stiffness_n_m * whole * w.abs();
            }
        }
    }

    fn save(&self) -> Vec<u8> {
        let lost_j = [self.stored_j, self.lost_j];
        pack(&(self.sides.list.len(), &self.searched, lost_j, &self.held, &self.chunks))
    }

    fn restore(&mut self, saved: &[u8]) -> Option<()> {
        let (sides, searched, [stored_j, lost_j], held, chunks): SavedEdges = unpack(saved)?;
        let count = self.searched.placed_m.len();
        let fits = sides == self.sides.list.len()
            && searched.placed_m.len() == count
            && (held.before_m.is_empty() || held.before_m.len() == count)
            && held.forces.iter().all(|(node, _)| (*node as usize) < count);
        fits.then_some(())?;
        self.chunks = chunks.into_iter().map(|saved| self.fitting(saved)).collect::<Option<_>>()?;
        self.arrange();
        (self.searched, self.stored_j, self.lost_j, self.held) = (searched, stored_j, lost_j, held);
        Some(())
    }
}
