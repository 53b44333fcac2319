//! The hot loops: element forces of groups of eight.
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

use models::fabrics::Past;
use pulp::Simd;

use super::group::{Group, LANES, Lane};
use super::lanes::{V, inner, product};
use super::law::Law;

/// One vector for each element of a group.
pub type Lane3 = [Lane; 3];
/// Forces on the corners of a group: `[corner][axis][lane]`.
pub type CornerForces = [Lane3; 4];

/// What a pass adds up lane by lane, in SI units.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
#[repr(C, align(64))]
pub struct Tally {
    /// Membrane energy \[J\].
    pub membrane: Lane,
    /// Hourglass energy \[J\].
    pub hourglass: Lane,
    /// Energy turned to heat by viscosity in this step \[J\].
    pub viscous: Lane,
    /// ∫ x n_x, ∫ y n_y, ∫ z n_z over the elements \[m³\].
    pub flux: Lane3,
}

/// Strains of the elements of a group at the step before.
#[derive(Debug, Clone)]
#[repr(C, align(64))]
pub struct Strain(pub Lane3);

/// What a batch of groups has in common.
#[derive(Clone, Copy)]
pub struct Batch<'a> {
    /// Node positions.
    pub q: &'a [[f64; 4]],
    /// Pressure behind minus pressure in front \[Pa\].
    pub pressure: f64,
    /// 1/Δt, or 0 without viscosity \[1/s\].
    pub rate: f64,
    /// Elements of the batch.
    pub groups: &'a [Group],
    /// Memory of the fabric, or empty.
    pub past: &'a [[Past; LANES]],
}

/// Forces, energies and fluxes of quadrilaterals.
#[inline(always)]
pub fn quads<S: Simd, L: Law>(
    simd: S,
    batch: Batch,
    law: L,
    strains: &mut [Strain],
    out: &mut [CornerForces],
    tally: &mut Tally,
) {
    for (index, ((group, strain), out)) in batch.groups.iter().zip(strains).zip(out).enumerate() {
        for part in 0..LANES / S::F64_LANES {
            quad(simd, batch, law, group, batch.past.get(index), part, strain, out, tally);
        }
    }
}

#[inline(always)]
#[allow(clippy::too_many_arguments)] // one call, inlined: a struct would only rename the list
fn quad<S: Simd, L: Law>(
    simd: S,
    batch: Batch,
    law: L,
    group: &Group,
    past: Option<&[Past; LANES]>,
    part: usize,
    strain: &mut Strain,
    out: &mut CornerForces,
    tally: &mut Tally,
) {
    let lane = |from: &Lane| V::load(simd, from, part);
    let all = |value: f64| V::all(simd, value);
    let axes = [0, 1, 2];
    let x: [[V<S>; 3]; 4] = [0, 1, 2, 3].map(|c: usize| V::gather(simd, batch.q, &group.node[c], part));
    let d13 = axes.map(|k| x[0][k] - x[2][k]);
    let d24 = axes.map(|k| x[1][k] - x[3][k]);
    let odd = axes.map(|k| x[0][k] + x[2][k]);
    let even = axes.map(|k| x[1][k] + x[3][k]);
    let h = axes.map(|k| odd[k] - even[k]);

    let b: [[V<S>; 2]; 2] = [0, 1].map(|c: usize| [lane(&group.b[c][0]), lane(&group.b[c][1])]);
    let f1 = axes.map(|k| b[0][0] * d13[k] + b[1][0] * d24[k]);
    let f2 = axes.map(|k| b[0][1] * d13[k] + b[1][1] * d24[k]);
    let e = [
        all(0.5) * (inner(f1, f1) - all(1.0)),
        all(0.5) * (inner(f2, f2) - all(1.0)),
        inner(f1, f2),
    ];
    let (s, w) = law.at(simd, e, past, part);
    let (area, own) = (lane(&group.area), lane(&group.own));
    let t = with_viscosity(simd, batch.rate, group, part, e, s, strain, tally);

    let (s1, s2) = (lane(&group.s[0]), lane(&group.s[1]));
    let q = axes.map(|k| all(0.25) * (h[k] - s1 * f1[k] - s2 * f2[k]));
    let (g1, g2) = (inner(f1, q), inner(f2, q));
    let stiffness = lane(&group.hourglass);
    let (k1, k2) = (stiffness * g1, stiffness * g2);
    (lane(&tally.membrane) + own * area * w).store(&mut tally.membrane, part);
    (lane(&tally.hourglass) + all(0.5) * own * (k1 * g1 + k2 * g2)).store(&mut tally.hourglass, part);

    let a = axes.map(|k| all(0.25) * (d24[k] - d13[k]));
    let c = axes.map(|k| all(-0.25) * (d13[k] + d24[k]));
    let warp = axes.map(|k| all(0.25) * h[k]);
    let (n0, n1, n2) = (product(a, c), product(a, warp), product(warp, c));
    let p = all(batch.pressure) * lane(&group.real);
    let third = p * all(1.0 / 3.0);
    for k in 0..3 {
        let quarter = all(0.25) * (k1 * f1[k] + k2 * f2[k]);
        let r1 = t[0] * f1[k] + t[2] * f2[k] + k1 * q[k] - s1 * quarter;
        let r2 = t[2] * f1[k] + t[1] * f2[k] + k2 * q[k] - s2 * quarter;
        let p13 = b[0][0] * r1 + b[0][1] * r2;
        let p24 = b[1][0] * r1 + b[1][1] * r2;
        let (m0, m1, m2) = (p * n0[k], third * n1[k], third * n2[k]);
        let (low, high) = (m0 - quarter, m0 + quarter);
        let (sum, difference) = (m1 + m2 + p13, m1 - m2 - p24);
        (low - sum).store(&mut out[0][k], part);
        (high + difference).store(&mut out[1][k], part);
        (low + sum).store(&mut out[2][k], part);
        (high - difference).store(&mut out[3][k], part);
        let flux = (odd[k] + even[k]) * n0[k] + all(4.0 / 3.0) * (a[k] * n1[k] + c[k] * n2[k]);
        (lane(&tally.flux[k]) + own * flux).store(&mut tally.flux[k], part);
    }
}

/// Forces, energies and fluxes of triangles; the fourth corner gets nothing.
#[inline(always)]
pub fn triangles<S: Simd, L: Law>(
    simd: S,
    batch: Batch,
    law: L,
    strains: &mut [Strain],
    out: &mut [CornerForces],
    tally: &mut Tally,
) {
    for (index, ((group, strain), out)) in batch.groups.iter().zip(strains).zip(out).enumerate() {
        for part in 0..LANES / S::F64_LANES {
            triangle(simd, batch, law, group, batch.past.get(index), part, strain, out, tally);
        }
    }
}

#[inline(always)]
#[allow(clippy::too_many_arguments)] // one call, inlined: a struct would only rename the list
fn triangle<S: Simd, L: Law>(
    simd: S,
    batch: Batch,
    law: L,
    group: &Group,
    past: Option<&[Past; LANES]>,
    part: usize,
    strain: &mut Strain,
    out: &mut CornerForces,
    tally: &mut Tally,
) {
    let lane = |from: &Lane| V::load(simd, from, part);
    let all = |value: f64| V::all(simd, value);
    let axes = [0, 1, 2];
    let x: [[V<S>; 3]; 3] = [0, 1, 2].map(|c: usize| V::gather(simd, batch.q, &group.node[c], part));
    let u = axes.map(|k| x[1][k] - x[0][k]);
    let v = axes.map(|k| x[2][k] - x[0][k]);
    let b: [[V<S>; 2]; 2] = [0, 1].map(|c: usize| [lane(&group.b[c][0]), lane(&group.b[c][1])]);
    let f1 = axes.map(|k| b[0][0] * u[k] + b[1][0] * v[k]);
    let f2 = axes.map(|k| b[0][1] * u[k] + b[1][1] * v[k]);
    let e = [
        all(0.5) * (inner(f1, f1) - all(1.0)),
        all(0.5) * (inner(f2, f2) - all(1.0)),
        inner(f1, f2),
    ];
    let (s, w) = law.at(simd, e, past, part);
    let (area, own) = (lane(&group.area), lane(&group.own));
    let t = with_viscosity(simd, batch.rate, group, part, e, s, strain, tally);
    (lane(&tally.membrane) + own * area * w).store(&mut tally.membrane, part);

    let normal = product(u, v);
    let p = all(batch.pressure / 6.0) * lane(&group.real);
    for k in 0..3 {
        let r1 = t[0] * f1[k] + t[2] * f2[k];
        let r2 = t[2] * f1[k] + t[1] * f2[k];
        let (p2, p3) = (b[0][0] * r1 + b[0][1] * r2, b[1][0] * r1 + b[1][1] * r2);
        let push = p * normal[k];
        (push + (p2 + p3)).store(&mut out[0][k], part);
        (push - p2).store(&mut out[1][k], part);
        (push - p3).store(&mut out[2][k], part);
        let flux = all(1.0 / 6.0) * (x[0][k] + x[1][k] + x[2][k]) * normal[k];
        (lane(&tally.flux[k]) + own * flux).store(&mut tally.flux[k], part);
    }
}

/// A·(S + viscous part) as (11, 22, 12); keeps the strains and books the heat.
#[inline(always)]
#[allow(clippy::too_many_arguments)] // shared tail of the two kernels, inlined
fn with_viscosity<S: Simd>(
    simd: S,
    rate: f64,
    group: &Group,
    part: usize,
    e: [V<S>; 3],
    s: [V<S>; 3],
    strain: &mut Strain,
    tally: &mut Tally,
) -> [V<S>; 3] {
    let lane = |from: &Lane| V::load(simd, from, part);
    let (area, half) = (lane(&group.area), V::all(simd, 0.5));
    let eta = lane(&group.viscosity) * V::all(simd, rate);
    let d = [0, 1, 2].map(|k| e[k] - lane(&strain.0[k]));
    (0..3).for_each(|k| e[k].store(&mut strain.0[k], part));
    let heat = lane(&group.own) * area * eta * (d[0] * d[0] + d[1] * d[1] + half * d[2] * d[2]);
    (lane(&tally.viscous) + heat).store(&mut tally.viscous, part);
    [area * (s[0] + eta * d[0]), area * (s[1] + eta * d[1]), area * (s[2] + half * eta * d[2])]
}
