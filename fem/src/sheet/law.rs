//! Membrane laws as the kernels call them: vector twins of the common fabrics, and any other one by one.

use std::sync::Arc;

use models::Fabric;
use models::fabrics::{InlinedFabric, Mixed, NeoHookean, Orthotropic, Past};
use pulp::Simd;

use super::group::{LANES, Stock};
use super::lanes::{V, axes, inner};

/// Eight elements, and which of them are in the registers.
#[derive(Clone, Copy)]
pub(super) struct Who<'a> {
    pub(crate) stock: &'a Stock,
    /// Their memory, if the fabric has one.
    pub past: Option<&'a [Past; LANES]>,
    pub part: usize,
}

/// Tension and energy of several elements at once, per [`Stock::per`] and area.
pub(super) trait ShellLaw: Copy {
    /// Tension and energy of the lanes at the strain (E₁₁, E₂₂, 2E₁₂).
    fn at<S: Simd>(self, simd: S, e: [V<S>; 3], who: Who) -> ([V<S>; 3], V<S>);
}

/// Number of the fabric whose loop each fabric goes through. Films of any stiffness go through one, since rows of elements
/// across a seam are then whole: their moduli and loads in compression are with the elements.
pub(super) fn loops(fabrics: &[Arc<dyn Fabric>]) -> Vec<usize> {
    let kind = |wrinkles: bool| {
        fabrics.iter().position(|f| match f.kind() {
            InlinedFabric::WrinklingFilm(_) => wrinkles,
            InlinedFabric::NeoHookean(_) => !wrinkles,
            _ => false,
        })
    };
    let film = kind(true).or(kind(false));
    let of = |p: usize| match fabrics[p].kind() {
        InlinedFabric::NeoHookean(_) | InlinedFabric::WrinklingFilm(_) => film.unwrap_or(p),
        _ => fabrics.iter().position(|f| Arc::ptr_eq(f, &fabrics[p])).unwrap_or(p),
    };
    (0..fabrics.len()).map(of).collect()
}

/// Unit of the tension that a fabric's loop computes \[N/m\], 1 for all but films, and the root of the energy of compression in
/// that unit at which a film wrinkles.
pub(super) fn own(fabric: &dyn Fabric) -> [f64; 2] {
    match fabric.kind() {
        InlinedFabric::NeoHookean(film) => [modulus(film), NEVER],
        InlinedFabric::WrinklingFilm(film) => {
            let per = modulus(&film.film);
            [per, (film.flat_n_per_m() / per).sqrt().min(NEVER)]
        }
        _ => [1.0, NEVER],
    }
}

/// Far above the root of any energy of compression.
const NEVER: f64 = 1e6;

/// Shear modulus times thickness at rest, 2 t C₁₀ \[N/m\].
fn modulus(film: &NeoHookean) -> f64 {
    2.0 * film.thickness_m * film.c10_pa
}

/// Neo-Hookean film of the given 2 t C₁₀.
#[derive(Clone, Copy)]
pub(super) struct Rubber(pub f64);

impl ShellLaw for Rubber {
    #[inline(always)]
    fn at<S: Simd>(self, simd: S, e: [V<S>; 3], _: Who) -> ([V<S>; 3], V<S>) {
        let (trace, product) = (e[0] + e[1], e[0] * e[1]);
        let d = V::all(simd, 2.0) * trace + V::all(simd, 4.0) * product - e[2] * e[2];
        let inverse = (V::all(simd, 1.0) + d).inverse();
        let scale = V::all(simd, self.0) * inverse * inverse;
        let spare = d * (V::all(simd, 2.0) + d);
        let s = [scale * (spare - V::all(simd, 2.0) * e[1]), scale * (spare - V::all(simd, 2.0) * e[0]), scale * e[2]];
        let w = V::all(simd, 0.5 * self.0) * (V::all(simd, 2.0) * trace - d * inverse);
        (s, w)
    }
}

/// Wrinkling film with 2 t C₁₀ = 1.
#[derive(Clone, Copy)]
pub(super) struct UnitFilm;

impl ShellLaw for UnitFilm {
    #[inline(always)]
    fn at<S: Simd>(self, simd: S, e: [V<S>; 3], who: Who) -> ([V<S>; 3], V<S>) {
        let (full, stored) = Rubber(1.0).at(simd, e, who);
        let (zero, half, one) = (V::all(simd, 0.0), V::all(simd, 0.5), V::all(simd, 1.0));
        let (mean, d, c) = (e[0] + e[1], e[0] - e[1], e[2]);
        // Never 0, so that its inverse is a number; its factor is 0 there.
        let r = (d * d + c * c).max(V::all(simd, f64::MIN_POSITIVE)).sqrt();
        // Where x < 0 the film is slack, and it is so with 0 in its place.
        let (x, y) = ((mean + r).max(zero), mean - r);
        let a = (one + x).sqrt();
        let z = x * (a + one).inverse();
        let (over, per_r) = (a.inverse(), half * r.inverse());
        let sigma = z * (a * a + a + one) * over * over * over;
        let along = [half + d * per_r, half - d * per_r, c * per_r];
        let w = half * z * z * (a + V::all(simd, 2.0)) * over;
        // √X, 0 where the film is taut, and the part of it beyond the load of the wrinkles.
        let root = (y + z + y * z).choose(zero, (stored - w).max(zero).sqrt());
        let beyond = (root - V::load(simd, &who.stock.flat, who.part)).max(zero);
        let share = beyond * root.max(V::all(simd, f64::MIN_POSITIVE)).inverse();
        (axes!(i => full[i] + share * (sigma * along[i] - full[i])), stored - beyond * beyond)
    }
}

impl ShellLaw for &Orthotropic {
    #[inline(always)]
    fn at<S: Simd>(self, simd: S, e: [V<S>; 3], _: Who) -> ([V<S>; 3], V<S>) {
        let s = [
            V::all(simd, self.a11) * e[0] + V::all(simd, self.a12) * e[1],
            V::all(simd, self.a12) * e[0] + V::all(simd, self.a22) * e[1],
            V::all(simd, self.a66) * e[2],
        ];
        let w = V::all(simd, 0.5) * (s[0] * e[0] + s[1] * e[1] + s[2] * e[2]);
        (s, w)
    }
}

impl ShellLaw for &Mixed {
    #[inline(always)]
    fn at<S: Simd>(self, simd: S, e: [V<S>; 3], who: Who) -> ([V<S>; 3], V<S>) {
        let row = axes!(i => axes!(j => V::all(simd, self.linear[i][j]) * e[j]));
        let s = axes!(i => row[i][0] + row[i][1] + row[i][2]);
        let w = V::all(simd, 0.5) * inner(s, e);
        if self.rubber.thickness_m == 0.0 {
            return (s, w);
        }
        let (rubber, stored) = Rubber(modulus(&self.rubber)).at(simd, e, who);
        (axes!(i => rubber[i] + s[i]), stored + w)
    }
}

/// Any other fabric, called element by element.
#[derive(Clone, Copy)]
pub(super) struct Called<'a>(pub &'a dyn Fabric);

impl ShellLaw for Called<'_> {
    #[inline(always)]
    fn at<S: Simd>(self, simd: S, e: [V<S>; 3], who: Who) -> ([V<S>; 3], V<S>) {
        let strain = [e[0].lanes(), e[1].lanes(), e[2].lanes()];
        let mut s = [[0.0; LANES]; 3];
        let mut w = [0.0; LANES];
        for l in 0..S::F64_LANES {
            let e = [strain[0][l], strain[1][l], strain[2][l]];
            let past = who.past.map_or([0.0; 2], |past| past[who.part * S::F64_LANES + l]);
            let tension = self.0.tension(e, &past);
            for k in 0..3 {
                s[k][l] = tension[k];
            }
            w[l] = self.0.energy(e, &past);
        }
        (V::load_all(simd, &s, 0), V::load(simd, &w, 0))
    }
}
