//! Selective mass scaling: waves of a few elements, which limit the step, are heavy; long ones keep the lumped mass.
//!
//! ```text
//! M⁻¹ = (q² + ε) D⁻¹ / (1 + ε)      q = Π (1 − αₖ D⁻¹ L)      L = Σ wᵢⱼ (eᵢ − eⱼ)(eᵢ − eⱼ)ᵀ over the sides of the elements
//! u(n+½) = [u(n−½)(1 − ½αΔt) + Δt f(n)/m] / (1 + ½αΔt)      v = D M⁻¹ u      kinetic(n) = ½ Σ m v(n−½)·u(n+½)
//! ```
//! D lumped masses; u = D⁻¹ M v momentum per lumped mass, which the run steps; wᵢⱼ = ½ s cᵢⱼ min(mᵢ/dᵢ, mⱼ/dⱼ) with the number
//! cᵢⱼ of elements at a side, dᵢ = Σ cᵢⱼ and s [`SHARE`]. D⁻¹L is 0 for what moves as one, ½ s (sin²(θ/2) + sin²(φ/2)) for waves of a grid
//! whose phase grows by θ and φ from element to element, and at most s. One factor, α = 1: two passes over the sides. A grid's membrane
//! then allows 2.4 times the step, or the same step with a sixth of the mass. A wave of n elements is slower by 0.9 sin²(π/n), in addition to
//! (π/n)²/6 of lumping.
//!
//! More passes, for meshes that are finer than what moves: y q(y²) is the Chebyshev polynomial (−1)ᴺ T₂ₙ₊₁(y)/(2N + 1) of
//! y² = λ/λ₁, λ the eigenvalues of D⁻¹L, which makes the largest λ q² for λ ≤ λ₁ as small as it can be, λ₁/(2N + 1)². Four passes allow
//! 1.4 times the step of two, six 1.8 times; waves of up to about twice and three times as many elements are heavy then.
//!
//! M⁻¹ is symmetric and not negative and acts on each axis alike: momentum, angular momentum (of m u) and energy are kept as
//! with lumped masses. Nodes that rigid bodies, ties or moving supports carry are left out. Not for `contact::edges`,
//! which divides by a node's own mass.
//!
//! Source: Olovsson, Simonsson, Unosson, Int. J. Numer. Meth. Eng. 63 (2005), and for the inverse, which needs no solver, Tkachuk,
//! Bischoff, Int. J. Numer. Meth. Eng. 101 (2015); this form: this project.

use std::f64::consts::PI;

use rayon::prelude::*;

use super::update::{PIECE, Update};
use crate::mesh::Mesh;
use crate::vec3::Nodes;

/// s: waves of two elements along one side of a grid have D⁻¹L = 0.9.
const SHARE: f64 = 1.8;
/// λ₁ for one, two and three factors. All waves, λ ≤ s, for the latter two: stuck plies of fine meshes bend in waves of two elements
/// both ways as fast as they stretch.
const LARGEST: [f64; 3] = [4.0 / 3.0, SHARE, SHARE];
/// ε: no wave is heavier than a hundred times its lumped mass, or it would not settle.
const LEAST: f64 = 0.01;

/// M⁻¹ of a mesh, and the momenta.
#[derive(Debug, Clone)]
pub(super) struct Selective {
    /// Where the links of a node begin.
    first: Vec<u32>,
    ends: Vec<u32>,
    /// Weights wᵢⱼ of the links, node after node \[kg\].
    weights: Vec<f64>,
    rows: Vec<NodeMass>,
    /// α of the passes, the same forwards and backwards, so that M⁻¹ stays symmetric where nodes are held.
    passes: Vec<f64>,
    /// Prescribed axes, which stand still or are set by others.
    fixed: Vec<(u32, [bool; 3])>,
    pub u: Vec<[f64; 4]>,
    /// u after some passes, and room for the next.
    half: Vec<[f64; 4]>,
    next: Vec<[f64; 4]>,
    /// Places of the fixed nodes during a step \[m\].
    held: Vec<[f64; 4]>,
    /// Σ m u·v, twice the kinetic energy \[J\].
    pub(crate) twice_j: f64,
}

#[derive(Debug, Clone, Copy)]
struct NodeMass {
    mass: f64,
    /// 1/m; 0 for nodes without mass.
    inverse: f64,
    /// Sum of the weights of a node's links over its mass.
    shed: f64,
}

/// α of two, four or six passes.
fn factors(passes: usize) -> Vec<f64> {
    let half = passes / 2;
    let root = |k: usize| (PI * (k as f64 - 0.5) / (2.0 * half as f64 + 1.0)).cos().powi(2);
    // T₃ has its root where λ₁ is chosen to put it, at λ = 1; said without rounding.
    let of = |k: usize| if half == 1 { 1.0 } else { 1.0 / (LARGEST[half - 1] * root(k)) };
    (1..=half).chain((1..=half).rev()).map(of).collect()
}

/// How much larger than with two passes the square of the step may be.
pub(crate) fn gain(passes: usize) -> f64 {
    let peak = |half: usize| LARGEST[half - 1] / (2.0 * half as f64 + 1.0).powi(2) + 0.5 * SHARE * LEAST;
    peak(1) / peak(passes / 2)
}

impl Selective {
    /// For lumped masses and two, four or six passes; `carried` nodes are left out.
    pub(super) fn new(
        mesh: &Mesh,
        mass: &[f64],
        passes: usize,
        fixed: &[(u32, [bool; 3])],
        carried: &[bool],
    ) -> Selective {
        let shared = shared(mesh, |node| mass[node as usize] > 0.0 && !carried[node as usize]);
        let count: Vec<f64> = shared.iter().map(|row| row.iter().map(|(_, c)| c).sum()).collect();
        let light = |i: usize| mass[i] / count[i];
        let (mut first, mut ends, mut weights, mut rows) = (vec![0], Vec::new(), Vec::new(), Vec::new());
        for (i, row) in shared.iter().enumerate() {
            let from = weights.len();
            ends.extend(row.iter().map(|(node, _)| *node));
            weights.extend(row.iter().map(|(node, c)| 0.5 * SHARE * c * light(i).min(light(*node as usize))));
            let inverse = if mass[i] > 0.0 { 1.0 / mass[i] } else { 0.0 };
            rows.push(NodeMass { mass: mass[i], inverse, shed: inverse * weights[from..].iter().sum::<f64>() });
            first.push(ends.len() as u32);
        }
        Selective {
            first,
            ends,
            weights,
            rows,
            passes: factors(passes),
            fixed: fixed.to_vec(),
            u: Vec::new(),
            half: Vec::new(),
            next: Vec::new(),
            held: Vec::new(),
            twice_j: 0.0,
        }
    }

    /// With momenta, all at rest, which smoothing alone does not need.
    pub(super) fn at_rest(self) -> Selective {
        let still = vec![[0.0; 4]; self.rows.len()];
        Selective { u: still.clone(), half: still.clone(), next: still, ..self }
    }

    /// D M⁻¹ u, with prescribed axes at rest.
    pub(crate) fn smoothed(&self, u: &Nodes) -> Vec<[f64; 4]> {
        let mut first = u.to_vec();
        self.rest(&mut first);
        let (mut from, mut to) = (first.clone(), first.clone());
        for &alpha in &self.passes {
            self.rest(&mut from);
            self.smooth(pulp::Arch::Scalar, alpha, &from, &mut to);
            std::mem::swap(&mut from, &mut to);
        }
        for (smooth, u) in from.iter_mut().zip(&first) {
            *smooth = [0, 1, 2, 3].map(|k| mixed(smooth[k], u[k]));
        }
        self.rest(&mut from);
        from
    }

    /// Begins with velocities, which become smooth.
    pub(super) fn begin(&mut self, v: &mut Nodes) {
        self.u.copy_from_slice(v);
        v.copy_from_slice(&self.smoothed(&self.u));
        self.twice_j = self.rows.iter().zip(&self.u).zip(&*v).map(|((row, u), v)| row.mass * dot(u, v)).sum();
    }

    /// Takes over velocities that others have set.
    pub(super) fn carry(&mut self, moved: &[(u32, [bool; 3])], v: &Nodes) {
        for (node, axes) in moved {
            let i = *node as usize;
            for k in (0..3).filter(|k| axes[*k]) {
                self.u[i][k] = v[i][k];
            }
        }
    }

    /// Updates velocities and positions and leaves the forces at zero; returns kinetic energy and Σ m ū·v̄.
    pub(super) fn step(&mut self, update: Update, force: &mut Nodes, v: &mut Nodes, x: &mut Nodes) -> [f64; 2] {
        let (mut u, mut half) = (std::mem::take(&mut self.u), std::mem::take(&mut self.half));
        let across = push(MomentumPush { update, rows: &self.rows, force, u: &mut u, v });
        let mut next = std::mem::take(&mut self.next);
        let (first, between) = (self.passes[0], &self.passes[1..self.passes.len() - 1]);
        self.smooth(update.arch, first, &u, &mut half);
        self.rest(&mut half);
        for &alpha in between {
            self.smooth(update.arch, alpha, &half, &mut next);
            self.rest(&mut next);
            std::mem::swap(&mut half, &mut next);
        }
        self.held.clear();
        self.held.extend(self.fixed.iter().map(|(node, _)| x[*node as usize]));
        let now = place(NodeMove { update, all: self, half: &half, u: &u, begin: 0, v, x });
        self.rest(v);
        for ((node, axes), held) in self.fixed.iter().zip(&self.held) {
            for k in (0..3).filter(|k| axes[*k]) {
                x[*node as usize][k] = held[k];
            }
        }
        (self.u, self.half, self.next) = (u, half, next);
        // ū·v̄ of means over the step; M⁻¹ is symmetric, so both mixed products are one.
        let damped = 0.25 * (self.twice_j + 2.0 * across + now);
        self.twice_j = now;
        [0.5 * across, damped]
    }

    pub(super) fn save(&self) -> Vec<f64> {
        [self.u.as_flattened(), &[self.twice_j]].concat()
    }

    pub(super) fn restore(&mut self, from: &[f64]) -> Option<()> {
        let (twice_j, u) = from.split_last()?;
        (u.len() == 4 * self.u.len()).then(|| self.u.as_flattened_mut().copy_from_slice(u))?;
        self.twice_j = *twice_j;
        Some(())
    }

    fn rest(&self, v: &mut Nodes) {
        for (node, axes) in &self.fixed {
            for k in (0..3).filter(|k| axes[*k]) {
                v[*node as usize][k] = 0.0;
            }
        }
    }

    /// (1 − α D⁻¹ L) `from` at all nodes, in pieces of about one size.
    fn smooth(&self, arch: pulp::Arch, alpha: f64, from: &Nodes, to: &mut Nodes) {
        let piece = |begin: usize, to| arch.dispatch(Smooth { all: self, alpha, from, begin, to });
        if to.len() <= PIECE {
            return piece(0, to);
        }
        let size = to.len().div_ceil(to.len().div_ceil(PIECE));
        to.par_chunks_mut(size).enumerate().for_each(|(i, to)| piece(i * size, to));
    }

    /// (1 − α D⁻¹ L) `from` at one node.
    #[inline(always)]
    fn row(&self, alpha: f64, from: &Nodes, i: usize) -> [f64; 4] {
        let links = self.first[i] as usize..self.first[i + 1] as usize;
        let mut sum = [0.0; 4];
        for (end, w) in self.ends[links.clone()].iter().zip(&self.weights[links]) {
            let u = &from[*end as usize];
            for k in 0..4 {
                sum[k] += w * u[k];
            }
        }
        let (row, old, mut new) = (&self.rows[i], from[i], [0.0; 4]);
        let (own, inverse) = (1.0 - alpha * row.shed, alpha * row.inverse);
        for k in 0..4 {
            new[k] = own * old[k] + inverse * sum[k];
        }
        new
    }
}

/// (q² u + ε u)/(1 + ε).
#[inline(always)]
fn mixed(smooth: f64, u: f64) -> f64 {
    (1.0 / (1.0 + LEAST)) * (smooth + LEAST * u)
}

/// Nodes at the other ends of the sides at each node, and how many elements have the side.
fn shared(mesh: &Mesh, takes_part: impl Fn(u32) -> bool) -> Vec<Vec<(u32, f64)>> {
    let mut shared: Vec<Vec<(u32, f64)>> = vec![Vec::new(); mesh.points.len()];
    for corners in mesh.faces() {
        for (k, a) in corners.iter().enumerate() {
            let b = &corners[(k + 1) % corners.len()];
            if takes_part(*a) && takes_part(*b) {
                link(&mut shared[*a as usize], *b);
                link(&mut shared[*b as usize], *a);
            }
        }
    }
    shared.iter_mut().for_each(|row| row.sort_by_key(|(node, _)| *node));
    shared
}

fn link(row: &mut Vec<(u32, f64)>, end: u32) {
    match row.iter_mut().find(|(node, _)| *node == end) {
        Some((_, count)) => *count += 1.0,
        None => row.push((end, 1.0)),
    }
}

fn dot(a: &[f64; 4], b: &[f64; 4]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Some nodes whose momenta are pushed.
struct MomentumPush<'a> {
    update: Update,
    rows: &'a [NodeMass],
    force: &'a mut [[f64; 4]],
    u: &'a mut [[f64; 4]],
    v: &'a [[f64; 4]],
}

/// Σ m v(n−½)·u(n+½) over the rows of a piece, halved recursively so that its order is fixed.
fn push(piece: MomentumPush) -> f64 {
    let count = piece.rows.len();
    if count <= PIECE {
        return piece.update.arch.dispatch(piece);
    }
    let MomentumPush { update, rows, force, u, v } = piece;
    let half = count / 2;
    let (rows, force) = (rows.split_at(half), force.split_at_mut(half));
    let (u, v) = (u.split_at_mut(half), v.split_at(half));
    let low = MomentumPush { update, rows: rows.0, force: force.0, u: u.0, v: v.0 };
    let high = MomentumPush { update, rows: rows.1, force: force.1, u: u.1, v: v.1 };
    let (low, high) = rayon::join(|| push(low), || push(high));
    low + high
}

impl pulp::WithSimd for MomentumPush<'_> {
    type Output = f64;

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _simd: S) -> f64 {
        let gain = self.update.dv / (1.0 + 0.5 * self.update.damping * self.update.dv);
        let (damping, mut across) = (self.update.damping, [0.0; 4]);
        for (((row, force), u), v) in self.rows.iter().zip(self.force).zip(self.u).zip(self.v) {
            // Copies: what was just stored by parts cannot be loaded as a whole without waiting.
            let (mass, inverse, old, f, v) = (row.mass, row.inverse, *u, *force, *v);
            let mut new = old;
            for k in 0..4 {
                new[k] += gain * (inverse * f[k] - damping * old[k]);
            }
            for k in 0..4 {
                across[k] += mass * (v[k] * new[k]);
            }
            *force = [0.0; 4];
            *u = new;
        }
        across.iter().sum()
    }
}

/// Some nodes whose velocities are smoothed.
struct Smooth<'a> {
    all: &'a Selective,
    alpha: f64,
    from: &'a [[f64; 4]],
    begin: usize,
    to: &'a mut [[f64; 4]],
}

impl pulp::WithSimd for Smooth<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _simd: S) {
        for (i, to) in self.to.iter_mut().enumerate() {
            *to = self.all.row(self.alpha, self.from, self.begin + i);
        }
    }
}

/// Some nodes that get their velocities and move.
struct NodeMove<'a> {
    update: Update,
    all: &'a Selective,
    half: &'a [[f64; 4]],
    u: &'a [[f64; 4]],
    begin: usize,
    v: &'a mut [[f64; 4]],
    x: &'a mut [[f64; 4]],
}

/// Σ m u·v over the nodes of a piece, halved recursively so that its order is fixed.
fn place(piece: NodeMove) -> f64 {
    let count = piece.x.len();
    if count <= PIECE {
        return piece.update.arch.dispatch(piece);
    }
    let NodeMove { update, all, half, u, begin, v, x } = piece;
    let middle = count / 2;
    let (v, x) = (v.split_at_mut(middle), x.split_at_mut(middle));
    let low = NodeMove { update, all, half, u, begin, v: v.0, x: x.0 };
    let high = NodeMove { update, all, half, u, begin: begin + middle, v: v.1, x: x.1 };
    let (low, high) = rayon::join(|| place(low), || place(high));
    low + high
}

impl pulp::WithSimd for NodeMove<'_> {
    type Output = f64;

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _simd: S) -> f64 {
        let (dt, last, mut now) = (self.update.dt, self.all.passes[0], [0.0; 4]);
        for (i, (v, x)) in self.v.iter_mut().zip(self.x).enumerate() {
            let i = self.begin + i;
            let mut new = self.all.row(last, self.half, i);
            let u = self.u[i];
            let mut place = *x;
            let mass = self.all.rows[i].mass;
            for k in 0..4 {
                new[k] = mixed(new[k], u[k]);
            }
            for k in 0..4 {
                place[k] += dt * new[k];
            }
            for k in 0..4 {
                now[k] += mass * (u[k] * new[k]);
            }
            *v = new;
            *x = place;
        }
        now.iter().sum()
    }
}

#[cfg(test)]
#[path = "selective_tests.rs"]
mod tests;
