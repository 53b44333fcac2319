//! The highest mode of the whole mesh, which limits the step less than the worst element or node.
//!
//! ```text
//! Δt² λ(Δt)/4 = 1,   λ(Δt) = largest eigenvalue of M⁻¹ (K + 2 C/Δt)        γ = Δt/Δt(bounds) ≥ 1
//! ```
//! K: A Bᵀ D B of every element at its stiffest state, plus the nodes' bounds of everything else; C: viscosity. λ by Lanczos from
//! a fixed start vector. λ takes a step below Δt, so C counts too much rather than too little: Δt(bounds), with selective masses
//! the step found from it. Supports and
//! rigid bodies only lower the mode and are left out.
//!
//! Between two estimates the bounds follow the shape, and γ stays; `cfl` covers what it changes.
//! Source: the global estimator of explicit codes; Lanczos as in Golub, Van Loan, Matrix Computations, ch. 10.

use std::borrow::Cow;

use super::constraint;
use super::selective::Selective;
use crate::mesh::Tie;
use crate::random::gaussian;
use crate::sheet::Sheet;
use crate::sheet::bound::Tangent;
use crate::vec3::{Nodes, cross};

/// Factor on the estimated frequency: Lanczos comes from below. 80 steps find up to a thousandth more.
const SURE: f64 = 1.01;
const MOST: usize = 80;
/// Steps between two looks at the estimate, and what it must have gained since, as a share, to go on.
const LOOK: usize = 5;
const ENOUGH: f64 = 5e-4;

/// γ at positions `x`: the stable step of the whole mesh over the step from the nodes' bounds, `nodes_s`; `others` are the bounds of
/// all terms but the shells \[N/m\], `mass` the nodes' \[kg\], `selective` what smooths their velocities.
pub(super) fn gain(
    sheet: &Sheet,
    ties: &[Tie],
    x: &Nodes,
    mut others: Vec<f64>,
    mass: &[f64],
    nodes_s: f64,
    selective: Option<&Selective>,
) -> f64 {
    let tangents = sheet.tangents(x.as_flattened(), &mut others);
    let inverse = |m: &f64| if *m > 0.0 { 1.0 / m } else { 0.0 };
    let inverse = mass.iter().map(inverse).collect();
    let mut whole = StepMatrix { tangents, rest: others, ties, inverse, selective, rate_1_s: 2.0 / nodes_s };
    let start = whole.start(sheet, x);
    let mut gain = 2.0 / (SURE * whole.highest_1_s2(&start).sqrt() * nodes_s);
    if selective.is_some() && gain > 1.0 {
        // Twice the step is viscosity's half: once more, from a step that is still too short.
        whole.rate_1_s /= gain;
        gain = 2.0 / (SURE * whole.highest_1_s2(&start).sqrt() * nodes_s);
    }
    // Not a number, too: the bounds hold then.
    if gain > 1.0 { gain } else { 1.0 }
}

/// M⁻¹ (K + 2 C/Δt), symmetric in the product uᵀ (K + 2 C/Δt) v.
struct StepMatrix<'a> {
    tangents: Vec<Tangent>,
    rest: Vec<f64>,
    ties: &'a [Tie],
    /// 1/m; 0 for nodes without mass.
    inverse: Vec<f64>,
    selective: Option<&'a Selective>,
    rate_1_s: f64,
}

impl StepMatrix<'_> {
    /// Stiffness of one step with its viscosity, (K + 2 C/Δt) v.
    fn stiff(&self, v: &Nodes) -> Vec<[f64; 4]> {
        let u = self.tied(v);
        let mut force: Vec<[f64; 4]> = u.iter().zip(&self.rest).map(|(u, k)| u.map(|u| k * u)).collect();
        for t in self.tangents.iter() {
            t.add(self.rate_1_s, &u, &mut force);
        }
        constraint::hand_over(self.ties, &mut force);
        force
    }

    /// `v` with the tied nodes following those that they are tied to.
    fn tied<'v>(&self, v: &'v Nodes) -> Cow<'v, Nodes> {
        let mut u = Cow::Borrowed(v);
        for tie in self.ties {
            let follow = |k: usize| tie.to.iter().map(|(n, w)| w * u[*n as usize][k]).sum::<f64>();
            let place = [follow(0), follow(1), follow(2), 0.0];
            u.to_mut()[tie.node as usize] = place;
        }
        u
    }

    /// Accelerations of the forces, M⁻¹ f, with selective masses where they are used.
    fn light(&self, force: &Nodes) -> Vec<[f64; 4]> {
        let u: Vec<[f64; 4]> = force.iter().zip(&self.inverse).map(|(f, w)| f.map(|f| w * f)).collect();
        match self.selective {
            Some(selective) => selective.smoothed(&u),
            None => u,
        }
    }

    /// Random forces with a part along every mode, drawn in the axes of the elements: they turn with the mesh, and so do all
    /// digits of γ but the last.
    fn start(&self, sheet: &Sheet, x: &Nodes) -> Vec<[f64; 4]> {
        let mut force = vec![[0.0; 4]; x.len()];
        for (i, item) in sheet.elements.iter().enumerate() {
            let [f1, f2] = item.deformation(x);
            let axes = [f1, f2, cross(f1, f2)];
            for (corner, node) in item.nodes().iter().enumerate().filter(|(_, n)| self.inverse[**n as usize] > 0.0) {
                for (k, axis) in axes.iter().enumerate() {
                    let draw = gaussian(0, (12 * i + 3 * corner + k) as u64) / self.inverse[*node as usize];
                    for c in 0..3 {
                        force[*node as usize][c] += draw * axis[c];
                    }
                }
            }
        }
        force
    }

    fn highest_1_s2(&self, start: &Nodes) -> f64 {
        let mut v = self.light(start);
        let mut pull = self.stiff(&v);
        let mut before = vec![[0.0; 4]; v.len()];
        let (mut diagonal, mut beside, mut largest) = (Vec::new(), Vec::new(), 0.0);
        let mut length = inner(&v, &pull).sqrt();
        for step in 1..=MOST {
            for v in v.iter_mut().chain(&mut pull) {
                *v = v.map(|v| v / length);
            }
            let mut next = self.light(&pull);
            let own = inner(&next, &pull);
            let last = if step == 1 { 0.0 } else { length };
            for ((next, v), before) in next.iter_mut().zip(&v).zip(&before) {
                for k in 0..4 {
                    next[k] -= own * v[k] + last * before[k];
                }
            }
            diagonal.push(own);
            before = std::mem::replace(&mut v, next);
            pull = self.stiff(&v);
            // Rounding may leave less than nothing.
            length = inner(&v, &pull).max(0.0).sqrt();
            if !(own.is_finite() && length.is_finite()) {
                return f64::NAN;
            }
            let over = length <= 1e-12 * own;
            if over || step % LOOK == 0 {
                let found = largest_of(&diagonal, &beside);
                if over || found < largest * (1.0 + ENOUGH) {
                    return found;
                }
                largest = found;
            }
            beside.push(length);
        }
        largest
    }
}

fn inner(a: &Nodes, b: &Nodes) -> f64 {
    a.as_flattened().iter().zip(b.as_flattened()).map(|(a, b)| a * b).sum()
}

/// The largest eigenvalue of a symmetric tridiagonal matrix.
fn largest_of(diagonal: &[f64], beside: &[f64]) -> f64 {
    let n = diagonal.len();
    let entry = |i: usize, j: usize| match i.abs_diff(j) {
        0 => diagonal[i],
        1 => beside[i.min(j)],
        _ => 0.0,
    };
    nalgebra::DMatrix::from_fn(n, n, entry).symmetric_eigenvalues().max()
}

#[cfg(test)]
#[path = "highest_tests.rs"]
mod tests;
