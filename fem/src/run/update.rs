//! The update of velocities and positions by lumped masses.

use crate::sheet::group::{LANES, Lane};
use crate::sheet::lanes::{V, sum};
use crate::vec3::Nodes;

/// Most nodes per piece of the update; fixed, so that sums have one order. Handing a piece to another thread takes as long as
/// some hundred nodes.
pub(super) const PIECE: usize = 3072;

/// The update of velocities and positions; leaves the forces at zero.
#[derive(Clone, Copy)]
pub(super) struct Update {
    pub dv: f64,
    pub dt: f64,
    pub damping: f64,
    pub(crate) arch: pulp::Arch,
}

impl Update {
    /// Updates everything; returns kinetic energy and Σ m |v̄|².
    pub(super) fn all(self, mass: &[f64], force: &mut Nodes, v: &mut Nodes, x: &mut Nodes) -> [f64; 2] {
        if mass.len() <= PIECE {
            return self.arch.dispatch(UpdatePiece { update: self, mass, force, v, x });
        }
        let half = (mass.len() / 2).next_multiple_of(LANES);
        let (mass, force) = (mass.split_at(half), force.split_at_mut(half));
        let (v, x) = (v.split_at_mut(half), x.split_at_mut(half));
        let (low, high) = rayon::join(|| self.all(mass.0, force.0, v.0, x.0), || self.all(mass.1, force.1, v.1, x.1));
        [low[0] + high[0], low[1] + high[1]]
    }
}

/// A piece of the update as a value, compiled for every set of vector instructions.
struct UpdatePiece<'a> {
    update: Update,
    mass: &'a [f64],
    force: &'a mut [[f64; 4]],
    v: &'a mut [[f64; 4]],
    x: &'a mut [[f64; 4]],
}

impl pulp::WithSimd for UpdatePiece<'_> {
    type Output = [f64; 2];

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, simd: S) -> [f64; 2] {
        let UpdatePiece { update, mass, force, v, x } = self;
        let mut tally = [[0.0; LANES]; 2];
        let (pairs, last) = mass.as_chunks::<2>();
        let even = pairs.len() * 2;
        let (force, last_force) = force.split_at_mut(even);
        let (v, last_v) = v.split_at_mut(even);
        let (x, last_x) = x.split_at_mut(even);
        let moving = force.as_flattened_mut().as_chunks_mut::<LANES>().0.iter_mut();
        let moving = moving.zip(v.as_flattened_mut().as_chunks_mut::<LANES>().0);
        let moving = moving.zip(x.as_flattened_mut().as_chunks_mut::<LANES>().0);
        for (mass, ((force, v), x)) in pairs.iter().zip(moving) {
            update.two_nodes(simd, *mass, force, v, x, &mut tally);
        }
        if let ([mass], [force], [v], [x]) = (last, last_force, last_v, last_x) {
            let pad = |a: &[f64; 4]| [a[0], a[1], a[2], a[3], 0.0, 0.0, 0.0, 0.0];
            let (mut f, mut w, mut p) = (pad(force), pad(v), pad(x));
            update.two_nodes(simd, [*mass, 0.0], &mut f, &mut w, &mut p, &mut tally);
            force.copy_from_slice(&f[..4]);
            v.copy_from_slice(&w[..4]);
            x.copy_from_slice(&p[..4]);
        }
        [0.5 * sum(&tally[0]), sum(&tally[1])]
    }
}

impl Update {
    /// Two nodes, or the eight numbers they are.
    #[inline(always)]
    fn two_nodes<S: pulp::Simd>(
        self,
        simd: S,
        [m0, m1]: [f64; 2],
        force: &mut Lane,
        v: &mut Lane,
        x: &mut Lane,
        tally: &mut [Lane; 2],
    ) {
        // A node without mass is placed by what it is tied to.
        let inverse = |m: f64| if m > 0.0 { 1.0 / m } else { 0.0 };
        let (w0, w1) = (inverse(m0), inverse(m1));
        let mass = [m0, m0, m0, m0, m1, m1, m1, m1];
        let inverse = [w0, w0, w0, w0, w1, w1, w1, w1];
        let gain = V::all(simd, self.dv / (1.0 + 0.5 * self.damping * self.dv));
        for part in 0..LANES / S::F64_LANES {
            let m = V::load(simd, &mass, part);
            let old = V::load(simd, v, part);
            let push = V::load(simd, &inverse, part) * V::load(simd, force, part);
            let new = old + gain * (push - V::all(simd, self.damping) * old);
            let mean = V::all(simd, 0.5) * (old + new);
            V::all(simd, 0.0).store(force, part);
            new.store(v, part);
            (V::load(simd, x, part) + V::all(simd, self.dt) * new).store(x, part);
            (m * (old * new)).add_to(&mut tally[0], part);
            (m * (mean * mean)).add_to(&mut tally[1], part);
        }
    }
}
