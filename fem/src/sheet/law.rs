//! Membrane laws as the kernels call them: vector twins of the two common fabrics, and any other one by one.

use models::Fabric;
use models::fabrics::{NeoHookean, Orthotropic, Past};
use pulp::Simd;

use super::group::LANES;
use super::lanes::V;

/// Tension and energy per reference area of several elements at once.
pub trait Law: Copy {
    /// At strain (E₁₁, E₂₂, 2E₁₂) of part `part` of a group; `past` is the group's memory, if the fabric has one.
    fn at<S: Simd>(self, simd: S, e: [V<S>; 3], past: Option<&[Past; LANES]>, part: usize) -> ([V<S>; 3], V<S>);
}

impl Law for &NeoHookean {
    #[inline(always)]
    fn at<S: Simd>(self, simd: S, e: [V<S>; 3], _: Option<&[Past; LANES]>, _: usize) -> ([V<S>; 3], V<S>) {
        let all = |value| V::all(simd, value);
        let (trace, product) = (e[0] + e[1], e[0] * e[1]);
        let d = all(2.0) * trace + all(4.0) * product - e[2] * e[2];
        let inverse = (all(1.0) + d).inverse();
        let k = 2.0 * self.thickness_m * self.c10_pa;
        let scale = all(k) * inverse * inverse;
        let spare = d * (all(2.0) + d);
        let s = [scale * (spare - all(2.0) * e[1]), scale * (spare - all(2.0) * e[0]), scale * e[2]];
        let w = all(0.5 * k) * (all(2.0) * trace - d * inverse);
        (s, w)
    }
}

impl Law for &Orthotropic {
    #[inline(always)]
    fn at<S: Simd>(self, simd: S, e: [V<S>; 3], _: Option<&[Past; LANES]>, _: usize) -> ([V<S>; 3], V<S>) {
        let all = |value| V::all(simd, value);
        let s = [
            all(self.a11) * e[0] + all(self.a12) * e[1],
            all(self.a12) * e[0] + all(self.a22) * e[1],
            all(self.a66) * e[2],
        ];
        let w = all(0.5) * (s[0] * e[0] + s[1] * e[1] + s[2] * e[2]);
        (s, w)
    }
}

/// Any other fabric, called element by element.
#[derive(Clone, Copy)]
pub struct Called<'a>(pub &'a dyn Fabric);

impl Law for Called<'_> {
    #[inline(always)]
    fn at<S: Simd>(self, simd: S, e: [V<S>; 3], past: Option<&[Past; LANES]>, part: usize) -> ([V<S>; 3], V<S>) {
        let strain = e.map(V::lanes);
        let mut s = [[0.0; LANES]; 3];
        let mut w = [0.0; LANES];
        for l in 0..S::F64_LANES {
            let e = [strain[0][l], strain[1][l], strain[2][l]];
            let past = past.map_or([0.0; 2], |past| past[part * S::F64_LANES + l]);
            let tension = self.0.tension(e, &past);
            (0..3).for_each(|k| s[k][l] = tension[k]);
            w[l] = self.0.energy(e, &past);
        }
        (s.map(|lane| V::load(simd, &lane, 0)), V::load(simd, &w, 0))
    }
}
