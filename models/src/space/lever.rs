//! How the body beyond a segment moves with the segment's bend and contraction.
//!
//! ```text
//! w = h κ,  u = |w|,  a = sin u/u,  b = (1 − cos u)/u²        ω = t × w turns the frame
//! Δ = (1 − ε) h (a t + b w)       δx_k = δΔ + δφ × (x_k − x),  δφ = a δω + (1 − a)/u² (ω·δω) ω + b ω × δω
//! ```
//!
//! ε is the contraction of the centre line, x the end of the segment, x_k a node beyond it.

use super::frame::SpaceStretch;
use crate::shape::{SERIES_BELOW, alternating, inverse_of, sinc_pair};

pub(super) type Vector = [f64; 3];
/// Matrix by its rows: the first index is the row.
pub(crate) type Matrix = [[f64; 3]; 3];

pub(super) fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(crate) fn cross(a: Vector, b: Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

pub(crate) fn outer(a: Vector, b: Vector) -> Matrix {
    of_each(|i, j| a[i] * b[j])
}

pub(crate) fn of_each(make: impl Fn(usize, usize) -> f64) -> Matrix {
    std::array::from_fn(|i| std::array::from_fn(|j| make(i, j)))
}

pub(super) fn column(of: &Matrix, j: usize) -> Vector {
    [of[0][j], of[1][j], of[2][j]]
}

pub(crate) fn times(a: &Matrix, b: &Matrix) -> Matrix {
    of_each(|i, j| dot(a[i], column(b, j)))
}

pub(super) fn transposed(a: &Matrix) -> Matrix {
    of_each(|i, j| a[j][i])
}

pub(super) fn apply(a: &Matrix, x: Vector) -> Vector {
    a.map(|row| dot(row, x))
}

/// Inverse; not finite where there is none.
pub(crate) fn inverse(a: &Matrix) -> Matrix {
    let rows = [cross(a[1], a[2]), cross(a[2], a[0]), cross(a[0], a[1])];
    let per = 1.0 / dot(a[0], rows[0]);
    of_each(|i, j| rows[j][i] * per)
}

/// Forces beyond a segment about its end: their sum S, and Σ F ⊗ (x_k − x).
#[derive(Default)]
pub(super) struct OuterForces {
    pub force: Vector,
    pub tensor: Matrix,
}

impl OuterForces {
    pub(super) fn add(&mut self, force: &[f64]) {
        self.force.iter_mut().zip(force).for_each(|(sum, f)| *sum += f);
    }

    /// The same about a point at the distance `way` before the end.
    pub(super) fn about(&mut self, way: Vector) {
        self.tensor = of_each(|i, j| self.tensor[i][j] + self.force[i] * way[j]);
    }

    /// Σ (x_k − x) × F.
    fn moment(&self) -> Vector {
        let t = &self.tensor;
        [t[2][1] - t[1][2], t[0][2] - t[2][0], t[1][0] - t[0][1]]
    }

    fn trace(&self) -> f64 {
        self.tensor[0][0] + self.tensor[1][1] + self.tensor[2][2]
    }
}

/// Changes by κ_y, κ_z and ε, one a row.
#[derive(Debug, Clone, Copy)]
pub(super) struct Lever {
    /// Turn of the whole body beyond the segment \[rad per coordinate\].
    pub turn: Matrix,
    /// Displacement of the segment's end \[m per coordinate\].
    shift: Matrix,
    /// Second changes of the way of the end, by κ_i and κ_j.
    bow: [[Vector; 2]; 2],
    line: f64,
}

impl Lever {
    pub(super) fn new(stretch: &SpaceStretch, length_m: f64) -> Lever {
        let (from, [ky, kz]) = (stretch.from, stretch.bend.kappa);
        let w = [ky * length_m, kz * length_m];
        let [a, b, a1, b1, c] = even(w[0].hypot(w[1]));
        let world = |v: Vector| -> Vector {
            std::array::from_fn(|i| v[0] * from.tangent[i] + v[1] * from.sides[0][i] + v[2] * from.sides[1][i])
        };
        let line = 1.0 - stretch.contraction;
        let same = |p: usize, q: usize| if p == q { 1.0 } else { 0.0 };
        let way = |p: usize| {
            let size = line * length_m * length_m;
            let across = |i: usize| size * (b * same(p, i) + b1 * w[p] * w[i]);
            world([size * a1 * w[p], across(0), across(1)])
        };
        let bow = |p: usize, q: usize| {
            let size = line * length_m.powi(3);
            let across = |i: usize| size * b1 * (w[p] * same(q, i) + w[q] * same(p, i) + same(p, q) * w[i]);
            world([size * a1 * same(p, q), across(0), across(1)])
        };
        let omega = [0.0, -w[1], w[0]];
        let turn = |change: Vector| {
            let (aside, share) = (cross(omega, change), c * dot(omega, change));
            world(std::array::from_fn(|i| a * change[i] + share * omega[i] + b * aside[i]))
        };
        let shorter = world([-length_m * a, -length_m * b * w[0], -length_m * b * w[1]]);
        Lever {
            turn: [turn([0.0, 0.0, length_m]), turn([0.0, -length_m, 0.0]), [0.0; 3]],
            shift: [way(0), way(1), shorter],
            bow: [[bow(0, 0), bow(0, 1)], [bow(1, 0), bow(1, 1)]],
            line,
        }
    }

    /// Work of the forces beyond per change \[N·m², N·m\].
    pub(super) fn work(&self, beyond: &OuterForces) -> Vector {
        let moment = beyond.moment();
        std::array::from_fn(|q| dot(self.shift[q], beyond.force) + dot(self.turn[q], moment))
    }

    /// What a turn of the segments before changes of that work, per turn: Σ ∂x_k/∂q × F.
    pub(super) fn turned(&self, beyond: &OuterForces) -> Matrix {
        let trace = beyond.trace();
        std::array::from_fn(|q| {
            let (way, turn) = (cross(self.shift[q], beyond.force), self.turn[q]);
            std::array::from_fn(|i| way[i] + dot(column(&beyond.tensor, i), turn) - trace * turn[i])
        })
    }

    /// What its own changes change of that work, without terms of the order of its turn squared: for Newton's step.
    pub(super) fn own(&self, beyond: &OuterForces) -> Matrix {
        let trace = beyond.trace();
        let lever = |p: Vector, q: Vector| dot(q, apply(&beyond.tensor, p));
        of_each(|p, q| match (p, q) {
            (2, 2) => 0.0,
            (2, i) | (i, 2) => -dot(self.shift[i], beyond.force) / self.line,
            _ => {
                let (a, b) = (self.turn[p], self.turn[q]);
                0.5 * (lever(a, b) + lever(b, a)) - trace * dot(a, b) + dot(self.bow[p][q], beyond.force)
            }
        })
    }
}

/// a, b, a′/u, b′/u and (1 − a)/u².
fn even(u: f64) -> [f64; 5] {
    let [a, across, d_along, ..] = sinc_pair(u);
    let z = u * u;
    let (b, a1) = if u > 0.0 { (across / u, d_along / u) } else { (0.5, -1.0 / 3.0) };
    if u < SERIES_BELOW {
        let b1 = -alternating(z, const { inverse_of([12.0, 180.0, 6720.0, 453_600.0, 4.790_016e7]) });
        let c = alternating(z, const { inverse_of([6.0, 120.0, 5040.0, 362_880.0, 3.991_68e7]) });
        return [a, b, a1, b1, c];
    }
    [a, b, a1, (a - 2.0 * b) / z, (1.0 - a) / z]
}

/// Generalised forces of outer loads per length of body: on κ_y and κ_z \[N·m\] and on the contraction of the centre line \[N\].
pub(crate) type Outer = [f64; 3];

#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct LoadedSections {
    pub(super) sections: Vec<Coupling>,
    pub(super) nodes: Vec<f64>,
    pub(super) forces: Vec<f64>,
}

/// Loads of a section that the rest of the robot decides, and their slopes.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Coupling {
    /// Loads assumed, and their Newton step.
    pub(super) outer: Outer,
    pub(super) step: Outer,
    /// Loads of the shape less the assumed ones.
    pub(super) residual: Vector,
    pub(super) compliance: Matrix,
    /// Turn of the body beyond, per change of q; one a row.
    pub(super) turn: Matrix,
    /// ∂G/∂φ of the segments before, times the length.
    pub(super) turned: Matrix,
    /// ∂G/∂q of itself, times the length.
    pub(super) own: Matrix,
    pub(super) slope: Matrix,
}

impl LoadedSections {
    pub(super) fn new(segments: usize) -> LoadedSections {
        let nodes = if segments == 0 { 0 } else { 3 * (segments + 1) };
        LoadedSections {
            sections: vec![Coupling::default(); segments],
            nodes: vec![0.0; nodes],
            forces: vec![0.0; nodes],
        }
    }

    /// Loads on a section: moments on κ_y and κ_z \[N·m\], and the force that shortens the centre line \[N\].
    pub(crate) fn outer(&self, section: usize) -> Outer {
        self.sections[section].outer
    }
}
