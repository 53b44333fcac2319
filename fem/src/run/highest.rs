//! The highest mode of the whole mesh, which limits the step less than the worst element or node.
//!
//! ```text
//! Δt² λ(Δt)/4 = 1,   λ(Δt) = largest eigenvalue of M⁻¹ (K + 2 C/Δt)        γ = Δt/Δt(bounds) ≥ 1
//! ```
//! K: A Bᵀ D B of every element at its stiffest state, plus the nodes' bounds of everything else; C: viscosity. λ by Lanczos from
//! a fixed start vector. Δt(bounds) stands for Δt in λ: it is shorter, so C counts too much rather than too little. Supports and
//! rigid bodies only lower the mode and are left out.
//!
//! Between two estimates the bounds follow the shape, and γ stays; `cfl` covers what it changes.
//! Source: the global estimator of explicit codes; Lanczos as in Golub, Van Loan, Matrix Computations, ch. 10.

use super::{constraint, setup};
use crate::mesh::Tie;
use crate::sheet::Sheet;
use crate::sheet::tangent::Tangent;

/// Factor on the estimated frequency: Lanczos comes from below. 80 steps find up to a thousandth more.
const SURE: f64 = 1.01;
/// Most Lanczos steps.
const MOST: usize = 80;
/// Steps between two looks at the estimate, and what it must have gained since, as a share, to go on.
const LOOK: usize = 5;
const ENOUGH: f64 = 5e-4;

/// γ at positions `x`: the stable step of the whole mesh over that of the nodes' bounds, `nodes_s`; `others` are the bounds of
/// all terms but the shells \[N/m\], `mass` the nodes' \[kg\].
pub(super) fn gain(
    sheet: &Sheet,
    ties: &[Tie],
    x: &[[f64; 4]],
    mut others: Vec<f64>,
    mass: &[f64],
    nodes_s: f64,
) -> f64 {
    let tangents = sheet.tangents(x.as_flattened(), &mut others);
    let root = |m: &f64| if *m > 0.0 { 1.0 / m.sqrt() } else { 0.0 };
    let whole = Whole { tangents, rest: others, ties, light: mass.iter().map(root).collect(), rate_1_s: 2.0 / nodes_s };
    let highest_1_s = SURE * whole.highest_1_s2().sqrt();
    let gain = 2.0 / (highest_1_s * nodes_s);
    // Not a number, too: the bounds hold then.
    if gain > 1.0 { gain } else { 1.0 }
}

/// M^(−½) (K + 2 C/Δt) M^(−½).
struct Whole<'a> {
    tangents: Vec<Tangent>,
    rest: Vec<f64>,
    ties: &'a [Tie],
    /// 1/√m; 0 for nodes without mass.
    light: Vec<f64>,
    rate_1_s: f64,
}

impl Whole<'_> {
    fn times(&self, v: &[[f64; 4]]) -> Vec<[f64; 4]> {
        let mut u: Vec<[f64; 4]> = v.iter().zip(&self.light).map(|(v, w)| v.map(|v| w * v)).collect();
        for tie in self.ties {
            let follow = |k: usize| tie.to.iter().map(|(n, w)| w * u[*n as usize][k]).sum::<f64>();
            u[tie.node as usize] = [follow(0), follow(1), follow(2), 0.0];
        }
        let mut force: Vec<[f64; 4]> = u.iter().zip(&self.rest).map(|(u, k)| u.map(|u| k * u)).collect();
        self.tangents.iter().for_each(|t| t.add(self.rate_1_s, &u, &mut force));
        constraint::hand_over(self.ties, &mut force);
        force.iter_mut().zip(&self.light).for_each(|(f, w)| *f = f.map(|f| w * f));
        force
    }

    /// The largest eigenvalue, from below.
    fn highest_1_s2(&self) -> f64 {
        let draw = |i: usize| [0, 1, 2].map(|k| setup::gaussian(0, (4 * i + k) as u64));
        let start = |(i, w): (usize, &f64)| if *w > 0.0 { draw(i) } else { [0.0; 3] };
        let mut v: Vec<[f64; 4]> = self.light.iter().enumerate().map(start).map(|[x, y, z]| [x, y, z, 0.0]).collect();
        let mut before = vec![[0.0; 4]; v.len()];
        let (mut diagonal, mut beside, mut largest) = (Vec::new(), Vec::new(), 0.0);
        let mut length = norm(&v);
        for step in 1..=MOST {
            v.iter_mut().for_each(|v| *v = v.map(|v| v / length));
            let mut next = self.times(&v);
            let own = inner(&next, &v);
            let last = if step == 1 { 0.0 } else { length };
            for ((next, v), before) in next.iter_mut().zip(&v).zip(&before) {
                (0..4).for_each(|k| next[k] -= own * v[k] + last * before[k]);
            }
            diagonal.push(own);
            before = std::mem::replace(&mut v, next);
            length = norm(&v);
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

fn inner(a: &[[f64; 4]], b: &[[f64; 4]]) -> f64 {
    a.as_flattened().iter().zip(b.as_flattened()).map(|(a, b)| a * b).sum()
}

fn norm(a: &[[f64; 4]]) -> f64 {
    inner(a, a).sqrt()
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
