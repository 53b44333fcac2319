//! Membrane laws as the kernels call them: vector twins of the common fabrics, and any other one by one.

use models::Fabric;
use models::fabrics::{Mixed, NeoHookean, Orthotropic, Past, WrinklingFilm};
use pulp::Simd;

use super::group::LANES;
use super::lanes::{V, axes, inner};

/// Tension and energy per reference area of several elements at once.
pub trait Law: Copy {
    /// At strain (E₁₁, E₂₂, 2E₁₂) of part `part` of a group; `past` is the group's memory, if the fabric has one.
    fn at<S: Simd>(self, simd: S, e: [V<S>; 3], past: Option<&[Past; LANES]>, part: usize) -> ([V<S>; 3], V<S>);
}

impl Law for &NeoHookean {
    #[inline(always)]
    fn at<S: Simd>(self, simd: S, e: [V<S>; 3], _: Option<&[Past; LANES]>, _: usize) -> ([V<S>; 3], V<S>) {
        let (trace, product) = (e[0] + e[1], e[0] * e[1]);
        let d = V::all(simd, 2.0) * trace + V::all(simd, 4.0) * product - e[2] * e[2];
        let inverse = (V::all(simd, 1.0) + d).inverse();
        let k = 2.0 * self.thickness_m * self.c10_pa;
        let scale = V::all(simd, k) * inverse * inverse;
        let spare = d * (V::all(simd, 2.0) + d);
        let s = [scale * (spare - V::all(simd, 2.0) * e[1]), scale * (spare - V::all(simd, 2.0) * e[0]), scale * e[2]];
        let w = V::all(simd, 0.5 * k) * (V::all(simd, 2.0) * trace - d * inverse);
        (s, w)
    }
}

impl Law for &WrinklingFilm {
    #[inline(always)]
    fn at<S: Simd>(self, simd: S, e: [V<S>; 3], past: Option<&[Past; LANES]>, part: usize) -> ([V<S>; 3], V<S>) {
        let (full, stored) = (&self.film).at(simd, e, past, part);
        let (zero, half, one) = (V::all(simd, 0.0), V::all(simd, 0.5), V::all(simd, 1.0));
        let (mean, d, c) = (e[0] + e[1], e[0] - e[1], e[2]);
        // Never 0, so that its inverse is a number; it is multiplied by what is 0 there.
        let r = (d * d + c * c).max(V::all(simd, f64::MIN_POSITIVE)).sqrt();
        let (x, y) = (mean + r, mean - r);
        let z = x * ((one + x).max(zero).sqrt() + one).inverse();
        let share = (y + z + y * z).choose(zero, V::all(simd, 1.0 - self.share));
        let z = z.max(zero);
        let a = one + z;
        let (over, per_r) = (a.inverse(), half * r.inverse());
        let k = V::all(simd, 2.0 * self.film.thickness_m * self.film.c10_pa);
        let sigma = k * z * (a * a + a + one) * over * over * over;
        let along = [half + d * per_r, half - d * per_r, c * per_r];
        let w = k * half * z * z * (a + V::all(simd, 2.0)) * over;
        (axes!(i => full[i] + share * (sigma * along[i] - full[i])), stored + share * (w - stored))
    }
}

impl Law for &Orthotropic {
    #[inline(always)]
    fn at<S: Simd>(self, simd: S, e: [V<S>; 3], _: Option<&[Past; LANES]>, _: usize) -> ([V<S>; 3], V<S>) {
        let s = [
            V::all(simd, self.a11) * e[0] + V::all(simd, self.a12) * e[1],
            V::all(simd, self.a12) * e[0] + V::all(simd, self.a22) * e[1],
            V::all(simd, self.a66) * e[2],
        ];
        let w = V::all(simd, 0.5) * (s[0] * e[0] + s[1] * e[1] + s[2] * e[2]);
        (s, w)
    }
}

impl Law for &Mixed {
    #[inline(always)]
    fn at<S: Simd>(self, simd: S, e: [V<S>; 3], past: Option<&[Past; LANES]>, part: usize) -> ([V<S>; 3], V<S>) {
        let row = axes!(i => axes!(j => V::all(simd, self.linear[i][j]) * e[j]));
        let s = axes!(i => row[i][0] + row[i][1] + row[i][2]);
        let w = V::all(simd, 0.5) * inner(s, e);
        if self.rubber.thickness_m == 0.0 {
            return (s, w);
        }
        let (rubber, stored) = (&self.rubber).at(simd, e, past, part);
        (axes!(i => rubber[i] + s[i]), stored + w)
    }
}

/// Any other fabric, called element by element.
#[derive(Clone, Copy)]
pub struct Called<'a>(pub &'a dyn Fabric);

impl Law for Called<'_> {
    #[inline(always)]
    fn at<S: Simd>(self, simd: S, e: [V<S>; 3], past: Option<&[Past; LANES]>, part: usize) -> ([V<S>; 3], V<S>) {
        let strain = [e[0].lanes(), e[1].lanes(), e[2].lanes()];
        let mut s = [[0.0; LANES]; 3];
        let mut w = [0.0; LANES];
        for l in 0..S::F64_LANES {
            let e = [strain[0][l], strain[1][l], strain[2][l]];
            let past = past.map_or([0.0; 2], |past| past[part * S::F64_LANES + l]);
            let tension = self.0.tension(e, &past);
            for k in 0..3 {
                s[k][l] = tension[k];
            }
            w[l] = self.0.energy(e, &past);
        }
        ([V::load(simd, &s[0], 0), V::load(simd, &s[1], 0), V::load(simd, &s[2], 0)], V::load(simd, &w, 0))
    }
}
