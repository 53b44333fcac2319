//! The hot loops: element forces of a group of eight, and the sum at the nodes.
//!
//! For one quadrilateral, with the strain measures of [`super::reference`]:
//!
//! ```text
//! E = ½(FᵀF − 1)        S = ∂W/∂E + (η/Δt) ΔE          T_a = A Σ_b S_ab F_b
//! q = ¼(h·x − Σ s_a F_a)     g_a = F_a·q     U_h = ½ k (g₁² + g₂²)     T_a += k g_a q     G = k Σ g_a F_a
//! f_n = −Σ_a B_na T_a − γ_n G  + p ∫ N_n n dA
//! ∫ N_n n dA = a×b + ⅓ ξ_n a×c + ⅓ η_n c×b,   a = ∂x/∂ξ, b = ∂x/∂η at the centre, c = ¼ h·x
//! ```
//!
//! Everything is the exact derivative of an energy (the hourglass form sees in-plane parts of q only, because F is
//! tangent to the sheet), the pressure force that of −pV with V the volume under the bilinear surface.
//! No fused multiply-add: the bits must not depend on the processor.

use models::Fabric;
use models::fabrics::{NeoHookean, Orthotropic, Past};

use super::group::{Group, LANES, Lane};

/// Forces on the corners of a group: `[corner][axis][lane]`.
pub type CornerForces = [[Lane; 3]; 4];

/// One vector for each element of a group.
pub type Lane3 = [Lane; 3];

/// What one pass over a patch adds up, in SI units.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Sums {
    /// Membrane energy \[J\].
    pub membrane: f64,
    /// Hourglass energy \[J\].
    pub hourglass: f64,
    /// Energy turned to heat by viscosity in this step \[J\].
    pub viscous: f64,
}

/// A membrane law that the kernels compile for themselves.
pub trait Law {
    /// Tension and energy per area of lane `l`.
    fn at(&self, e: [f64; 3], past: &Past) -> ([f64; 3], f64);
}

impl Law for NeoHookean {
    #[inline(always)]
    fn at(&self, e: [f64; 3], past: &Past) -> ([f64; 3], f64) {
        (self.tension(e, past), self.energy(e, past))
    }
}

impl Law for Orthotropic {
    #[inline(always)]
    fn at(&self, e: [f64; 3], past: &Past) -> ([f64; 3], f64) {
        (self.tension(e, past), self.energy(e, past))
    }
}

/// Any other fabric, called element by element.
pub struct Called<'a>(pub &'a dyn Fabric);

impl Law for Called<'_> {
    #[inline(always)]
    fn at(&self, e: [f64; 3], past: &Past) -> ([f64; 3], f64) {
        (self.0.tension(e, past), self.0.energy(e, past))
    }
}

/// Rate and history of the elements of a group.
#[derive(Debug, Clone)]
#[repr(C, align(64))]
pub struct Strain(pub [Lane; 3]);

/// Positions of one corner of eight elements.
#[inline(always)]
fn gather(q: &[[f64; 4]], node: &[u32; LANES]) -> [Lane; 3] {
    let mut x = [[0.0; LANES]; 3];
    for lane in 0..LANES {
        let p = &q[node[lane] as usize];
        x[0][lane] = p[0];
        x[1][lane] = p[1];
        x[2][lane] = p[2];
    }
    x
}

/// What a batch of groups has in common.
#[derive(Debug, Clone, Copy)]
pub struct Batch<'a> {
    /// Node positions.
    pub q: &'a [[f64; 4]],
    /// Pressure behind minus pressure in front \[Pa\].
    pub pressure: f64,
    /// 1/Δt, or 0 without viscosity \[1/s\].
    pub rate: f64,
}

/// Forces, energies and volume of quadrilaterals; `volume` collects ∫ x n_x, ∫ y n_y, ∫ z n_z over the batch.
#[inline(always)]
pub fn quads<L: Law>(
    batch: Batch,
    law: &L,
    groups: &[Group],
    strains: &mut [Strain],
    past: &[[Past; LANES]],
    out: &mut [CornerForces],
    volume: &mut Lane3,
) -> Sums {
    let mut membrane = [0.0; LANES];
    let mut hourglass = [0.0; LANES];
    let mut viscous = [0.0; LANES];
    for (index, ((group, strain), out)) in groups.iter().zip(strains).zip(out).enumerate() {
        let x = [0, 1, 2, 3].map(|c| gather(batch.q, &group.node[c]));
        let old = strain.0;
        let mut new = [[0.0; LANES]; 3];
        for l in 0..LANES {
            let at = |c: usize| [x[c][0][l], x[c][1][l], x[c][2][l]];
            let (x1, x2, x3, x4) = (at(0), at(1), at(2), at(3));
            let mut d13 = [0.0; 3];
            let mut d24 = [0.0; 3];
            let mut h = [0.0; 3];
            let mut f1 = [0.0; 3];
            let mut f2 = [0.0; 3];
            let (b11, b12) = (group.b[0][0][l], group.b[0][1][l]);
            let (b21, b22) = (group.b[1][0][l], group.b[1][1][l]);
            let (s1, s2) = (group.s[0][l], group.s[1][l]);
            for k in 0..3 {
                d13[k] = x1[k] - x3[k];
                d24[k] = x2[k] - x4[k];
                h[k] = (x1[k] + x3[k]) - (x2[k] + x4[k]);
                f1[k] = b11 * d13[k] + b21 * d24[k];
                f2[k] = b12 * d13[k] + b22 * d24[k];
            }
            let e = [
                0.5 * (inner(f1, f1) - 1.0),
                0.5 * (inner(f2, f2) - 1.0),
                inner(f1, f2),
            ];
            let none = [0.0; 2];
            let (s, w) = law.at(e, if past.is_empty() { &none } else { &past[index][l] });
            let area = group.area[l];
            let eta = group.viscosity[l] * batch.rate;
            let d = [e[0] - old[0][l], e[1] - old[1][l], e[2] - old[2][l]];
            new[0][l] = e[0];
            new[1][l] = e[1];
            new[2][l] = e[2];
            let t11 = area * (s[0] + eta * d[0]);
            let t22 = area * (s[1] + eta * d[1]);
            let t12 = area * (s[2] + 0.5 * eta * d[2]);
            let mut hg = [0.0; 3];
            for k in 0..3 {
                hg[k] = 0.25 * (h[k] - s1 * f1[k] - s2 * f2[k]);
            }
            let (g1, g2) = (inner(f1, hg), inner(f2, hg));
            let (k1, k2) = (group.hourglass[l] * g1, group.hourglass[l] * g2);
            let own = group.own[l];
            membrane[l] += own * area * w;
            hourglass[l] += own * 0.5 * (k1 * g1 + k2 * g2);
            viscous[l] += own * area * eta * (d[0] * d[0] + d[1] * d[1] + 0.5 * d[2] * d[2]);
            let p = batch.pressure * group.real[l];
            let mut a = [0.0; 3];
            let mut b = [0.0; 3];
            let mut c = [0.0; 3];
            for k in 0..3 {
                a[k] = 0.25 * (d24[k] - d13[k]);
                b[k] = -0.25 * (d13[k] + d24[k]);
                c[k] = 0.25 * h[k];
            }
            let n0 = product(a, b);
            let n1 = product(a, c);
            let n2 = product(c, b);
            for k in 0..3 {
                let quarter = 0.25 * (k1 * f1[k] + k2 * f2[k]);
                let r1 = t11 * f1[k] + t12 * f2[k] + k1 * hg[k] - s1 * quarter;
                let r2 = t12 * f1[k] + t22 * f2[k] + k2 * hg[k] - s2 * quarter;
                let p13 = b11 * r1 + b12 * r2;
                let p24 = b21 * r1 + b22 * r2;
                let third = p * (1.0 / 3.0);
                let (m0, m1, m2) = (p * n0[k], third * n1[k], third * n2[k]);
                let (even, odd) = (m0 - quarter, m0 + quarter);
                out[0][k][l] = even - (m1 + m2) - p13;
                out[1][k][l] = odd + (m1 - m2) - p24;
                out[2][k][l] = even + (m1 + m2) + p13;
                out[3][k][l] = odd - (m1 - m2) + p24;
                let mean = (x1[k] + x3[k]) + (x2[k] + x4[k]);
                let flux = mean * n0[k] + (4.0 / 3.0) * (a[k] * n1[k] + b[k] * n2[k]);
                volume[k][l] += own * flux;
            }
        }
        strain.0 = new;
    }
    Sums { membrane: sum(&membrane), hourglass: sum(&hourglass), viscous: sum(&viscous) }
}

/// Forces, energies and volume of triangles; the fourth corner gets nothing.
#[inline(always)]
pub fn triangles<L: Law>(
    batch: Batch,
    law: &L,
    groups: &[Group],
    strains: &mut [Strain],
    past: &[[Past; LANES]],
    out: &mut [CornerForces],
    volume: &mut Lane3,
) -> Sums {
    let mut membrane = [0.0; LANES];
    let mut viscous = [0.0; LANES];
    for (index, ((group, strain), out)) in groups.iter().zip(strains).zip(out).enumerate() {
        let x = [0, 1, 2].map(|c| gather(batch.q, &group.node[c]));
        let old = strain.0;
        let mut new = [[0.0; LANES]; 3];
        for l in 0..LANES {
            let at = |c: usize| [x[c][0][l], x[c][1][l], x[c][2][l]];
            let (x1, x2, x3) = (at(0), at(1), at(2));
            let mut u = [0.0; 3];
            let mut v = [0.0; 3];
            let mut f1 = [0.0; 3];
            let mut f2 = [0.0; 3];
            let (b21, b22) = (group.b[0][0][l], group.b[0][1][l]);
            let (b31, b32) = (group.b[1][0][l], group.b[1][1][l]);
            for k in 0..3 {
                u[k] = x2[k] - x1[k];
                v[k] = x3[k] - x1[k];
                f1[k] = b21 * u[k] + b31 * v[k];
                f2[k] = b22 * u[k] + b32 * v[k];
            }
            let e = [
                0.5 * (inner(f1, f1) - 1.0),
                0.5 * (inner(f2, f2) - 1.0),
                inner(f1, f2),
            ];
            let none = [0.0; 2];
            let (s, w) = law.at(e, if past.is_empty() { &none } else { &past[index][l] });
            let area = group.area[l];
            let eta = group.viscosity[l] * batch.rate;
            let d = [e[0] - old[0][l], e[1] - old[1][l], e[2] - old[2][l]];
            new[0][l] = e[0];
            new[1][l] = e[1];
            new[2][l] = e[2];
            let t11 = area * (s[0] + eta * d[0]);
            let t22 = area * (s[1] + eta * d[1]);
            let t12 = area * (s[2] + 0.5 * eta * d[2]);
            let own = group.own[l];
            membrane[l] += own * area * w;
            viscous[l] += own * area * eta * (d[0] * d[0] + d[1] * d[1] + 0.5 * d[2] * d[2]);
            let normal = product(u, v);
            let p = batch.pressure * group.real[l] * (1.0 / 6.0);
            for k in 0..3 {
                let r1 = t11 * f1[k] + t12 * f2[k];
                let r2 = t12 * f1[k] + t22 * f2[k];
                let (p2, p3) = (b21 * r1 + b22 * r2, b31 * r1 + b32 * r2);
                let push = p * normal[k];
                out[0][k][l] = push + (p2 + p3);
                out[1][k][l] = push - p2;
                out[2][k][l] = push - p3;
                out[3][k][l] = 0.0;
                volume[k][l] += own * (1.0 / 6.0) * (x1[k] + x2[k] + x3[k]) * normal[k];
            }
        }
        strain.0 = new;
    }
    Sums { membrane: sum(&membrane), hourglass: 0.0, viscous: sum(&viscous) }
}

/// Sum over the lanes, in one order.
#[inline(always)]
pub fn sum(lane: &Lane) -> f64 {
    ((lane[0] + lane[1]) + (lane[2] + lane[3])) + ((lane[4] + lane[5]) + (lane[6] + lane[7]))
}

#[inline(always)]
fn inner(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[inline(always)]
fn product(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}
