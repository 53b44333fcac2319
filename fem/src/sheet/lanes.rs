//! Vector arithmetic on as many elements as the processor takes at once, with ordinary operators.
//!
//! No fused multiply-add, so that every width gives the same bits.

use std::ops::{Add, Mul, Sub};

use pulp::Simd;

use super::group::{LANES, Lane};

/// `[expression; k = 0, 1, 2]`. Closures would hide the vector instructions from the inliner.
macro_rules! axes {
    ($k:ident => $value:expr) => {
        [
            {
                let $k = 0;
                $value
            },
            {
                let $k = 1;
                $value
            },
            {
                let $k = 2;
                $value
            },
        ]
    };
}
pub(crate) use axes;

/// A vector register of f64 with the arithmetic of the kernels.
#[derive(Clone, Copy)]
pub(crate) struct V<S: Simd>(S, S::f64s);

impl<S: Simd> Add for V<S> {
    type Output = V<S>;
    #[inline(always)]
    fn add(self, other: V<S>) -> V<S> {
        V(self.0, self.0.add_f64s(self.1, other.1))
    }
}

impl<S: Simd> Sub for V<S> {
    type Output = V<S>;
    #[inline(always)]
    fn sub(self, other: V<S>) -> V<S> {
        V(self.0, self.0.sub_f64s(self.1, other.1))
    }
}

impl<S: Simd> Mul for V<S> {
    type Output = V<S>;
    #[inline(always)]
    fn mul(self, other: V<S>) -> V<S> {
        V(self.0, self.0.mul_f64s(self.1, other.1))
    }
}

impl<S: Simd> V<S> {
    /// The same number in every lane.
    #[inline(always)]
    pub(crate) fn all(simd: S, value: f64) -> V<S> {
        V(simd, simd.splat_f64s(value))
    }

    #[inline(always)]
    pub(crate) fn inverse(self) -> V<S> {
        V(self.0, self.0.div_f64s(self.0.splat_f64s(1.0), self.1))
    }

    #[inline(always)]
    pub(crate) fn sqrt(self) -> V<S> {
        V(self.0, self.0.sqrt_f64s(self.1))
    }

    /// The larger of two, lane by lane.
    #[inline(always)]
    pub(crate) fn max(self, other: V<S>) -> V<S> {
        V(self.0, self.0.max_f64s(self.1, other.1))
    }

    /// The smaller of two, lane by lane.
    #[inline(always)]
    pub(crate) fn min(self, other: V<S>) -> V<S> {
        V(self.0, self.0.min_f64s(self.1, other.1))
    }

    /// `yes` in lanes where `self` is not negative, `no` in the others.
    #[inline(always)]
    pub(crate) fn choose(self, yes: V<S>, no: V<S>) -> V<S> {
        let zero = self.0.splat_f64s(0.0);
        V(self.0, self.0.select_f64s(self.0.greater_than_or_equal_f64s(self.1, zero), yes.1, no.1))
    }

    #[inline(always)]
    pub(crate) fn largest(self) -> f64 {
        self.0.reduce_max_f64s(self.1)
    }

    /// Part number `part` of eight lanes.
    #[inline(always)]
    pub(crate) fn load(simd: S, from: &Lane, part: usize) -> V<S> {
        V(simd, S::as_simd_f64s(from).0[part])
    }

    /// The same of a vector for each lane.
    #[inline(always)]
    pub(crate) fn load_all(simd: S, [x, y, z]: &[Lane; 3], part: usize) -> [V<S>; 3] {
        [V::load(simd, x, part), V::load(simd, y, part), V::load(simd, z, part)]
    }

    /// Writes part number `part` of eight lanes.
    #[inline(always)]
    pub(crate) fn store(self, to: &mut Lane, part: usize) {
        S::as_mut_simd_f64s(to).0[part] = self.1;
    }

    #[inline(always)]
    pub(crate) fn add_to(self, to: &mut Lane, part: usize) {
        (V::load(self.0, to, part) + self).store(to, part);
    }

    #[inline(always)]
    pub(crate) fn load_from(simd: S, from: &[f64], at: usize) -> V<S> {
        V(simd, S::as_simd_f64s(&from[at..at + S::F64_LANES]).0[0])
    }

    #[inline(always)]
    pub(crate) fn store_to(self, to: &mut [f64], at: usize) {
        S::as_mut_simd_f64s(&mut to[at..at + S::F64_LANES]).0[0] = self.1;
    }

    /// Positions of corner `c` of the elements in part number `part` of a group.
    #[inline(always)]
    pub(crate) fn gather(simd: S, x: [&[f64]; 3], node: &[[u32; 4]; LANES], c: usize, part: usize) -> [V<S>; 3] {
        let width = S::F64_LANES;
        let mut out = [[0.0; LANES]; 3];
        for (k, out) in out.iter_mut().enumerate() {
            for lane in 0..width {
                out[lane] = x[k][node[part * width + lane][c] as usize];
            }
        }
        V::load_all(simd, &out, 0)
    }

    /// The lanes as numbers, the first `S::F64_LANES` of them meaningful.
    #[inline(always)]
    pub(crate) fn lanes(self) -> Lane {
        let mut out = [0.0; LANES];
        self.store(&mut out, 0);
        out
    }
}

#[inline(always)]
pub(crate) fn inner<S: Simd>(a: [V<S>; 3], b: [V<S>; 3]) -> V<S> {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[inline(always)]
pub(crate) fn product<S: Simd>(a: [V<S>; 3], b: [V<S>; 3]) -> [V<S>; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// Sum over the lanes, in one order.
#[inline(always)]
pub(crate) fn sum(lane: &Lane) -> f64 {
    ((lane[0] + lane[1]) + (lane[2] + lane[3])) + ((lane[4] + lane[5]) + (lane[6] + lane[7]))
}
