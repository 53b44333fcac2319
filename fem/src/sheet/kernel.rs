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
//! tangent to the sheet), the pressure force the derivative of −pV with V the volume under the bilinear surface.

use models::fabrics::Past;
use pulp::Simd;

use super::group::{ElementGroup, LANES, Lane, RestShape, Stock};
use super::lanes::{V, axes, inner, product};
use super::law::{ShellLaw, Who};

/// One vector for each element of a group.
pub(super) type Lane3 = [Lane; 3];
/// Forces on the corners of a group: `[corner][axis][lane]`.
pub(super) type CornerForces = [Lane3; 4];

/// What a pass adds up lane by lane, in SI units.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
#[repr(C, align(64))]
pub(super) struct Tally {
    pub membrane: Lane,
    pub hourglass: Lane,
    /// Energy turned to heat by viscosity in this step \[J\].
    pub viscous: Lane,
    /// ∫ x n_x, ∫ y n_y, ∫ z n_z over the elements \[m³\].
    pub(crate) flux: Lane3,
}

/// Strains of the elements of a group at the step before.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[repr(C, align(64))]
pub(super) struct Strain(pub Lane3);

/// Where quadrilaterals put their corner forces.
pub(super) enum Corners<'a> {
    /// Groups in regular rows: by corner, axis and node.
    Rows([[&'a mut [f64]; 3]; 4]),
    Groups(&'a mut [CornerForces]),
}

/// What a batch of groups has in common.
#[derive(Clone, Copy)]
pub(super) struct BatchInputs<'a> {
    pub x: [&'a [f64]; 3],
    /// Pressure behind minus pressure in front \[Pa\].
    pub pressure: f64,
    /// 1/Δt, or 0 without viscosity \[1/s\].
    pub rate: f64,
    pub groups: &'a [ElementGroup],
    /// Shapes of all groups of the patch.
    pub shapes: &'a [RestShape],
    /// Stocks of all groups of the patch.
    pub(crate) stocks: &'a [Stock],
    /// Memory of the fabric, or empty.
    pub past: &'a [[Past; LANES]],
}

impl<'a> BatchInputs<'a> {
    #[inline(always)]
    fn who(&self, index: usize, part: usize) -> Who<'a> {
        Who { stock: &self.stocks[self.groups[index].stock as usize], past: self.past.get(index), part }
    }
}

/// Forces of quadrilaterals, with `BOOKS` also energies and fluxes; `ROWS` promises that all groups are in regular rows.
#[inline(always)]
pub(super) fn quads<S: Simd, L: ShellLaw, const ROWS: bool, const BOOKS: bool>(
    simd: S,
    batch: BatchInputs,
    law: L,
    strains: &mut [Strain],
    mut out: Corners,
    tally: &mut Tally,
) {
    // All of one length, so that a place is checked once and not for every array.
    let nodes = batch.x[0].len();
    let place = axes!(k => &batch.x[k][..nodes]);
    if let Corners::Rows(rows) = &mut out {
        for row in rows.as_flattened_mut() {
            *row = &mut std::mem::take(row)[..nodes];
        }
    }
    for (index, (group, strain)) in batch.groups.iter().zip(strains).enumerate() {
        let shape = &batch.shapes[group.shape as usize];
        for part in 0..LANES / S::F64_LANES {
            let mut first = [0; 4];
            let mut x = [[V::all(simd, 0.0); 3]; 4];
            for c in 0..4 {
                first[c] = group.node[0][c] as usize + part * S::F64_LANES;
                if ROWS {
                    x[c] = axes!(k => V::load_from(simd, place[k], first[c]));
                } else {
                    x[c] = V::gather(simd, batch.x, &group.node, c, part);
                }
            }
            let who = batch.who(index, part);
            let force = quad::<S, L, ROWS, BOOKS>(simd, batch, law, shape, who, x, strain, tally);
            match &mut out {
                Corners::Rows(rows) => {
                    for c in 0..4 {
                        for k in 0..3 {
                            force[c][k].store_to(rows[c][k], first[c]);
                        }
                    }
                }
                Corners::Groups(groups) => {
                    for c in 0..4 {
                        for k in 0..3 {
                            force[c][k].store(&mut groups[index][c][k], part);
                        }
                    }
                }
            }
        }
    }
}

#[inline(always)]
#[allow(clippy::too_many_arguments)] // one call, inlined: a struct would only rename the list
fn quad<S: Simd, L: ShellLaw, const ROWS: bool, const BOOKS: bool>(
    simd: S,
    batch: BatchInputs,
    law: L,
    shape: &RestShape,
    who: Who,
    x: [[V<S>; 3]; 4],
    strain: &mut Strain,
    tally: &mut Tally,
) -> [[V<S>; 3]; 4] {
    let Who { stock, part, .. } = who;
    let d13 = axes!(k => x[0][k] - x[2][k]);
    let d24 = axes!(k => x[1][k] - x[3][k]);
    let odd = axes!(k => x[0][k] + x[2][k]);
    let even = axes!(k => x[1][k] + x[3][k]);
    let h = axes!(k => odd[k] - even[k]);

    let b = gradients(simd, shape, part);
    let f1 = axes!(k => b[0][0] * d13[k] + b[1][0] * d24[k]);
    let f2 = axes!(k => b[0][1] * d13[k] + b[1][1] * d24[k]);
    let t = tension::<S, L, BOOKS>(simd, batch.rate, law, shape, who, [f1, f2], strain, tally);
    let own = V::load(simd, &stock.own, part);

    let s1 = V::load(simd, &shape.s[0], part);
    let s2 = V::load(simd, &shape.s[1], part);
    let warp = axes!(k => V::all(simd, 0.25) * h[k]);
    let q = axes!(k => warp[k] - s1 * f1[k] - s2 * f2[k]);
    let (g1, g2) = (inner(f1, q), inner(f2, q));
    let stiffness = V::load(simd, &shape.hourglass, part);
    let (k1, k2) = (stiffness * g1, stiffness * g2);
    if BOOKS {
        (V::all(simd, 0.5) * own * (k1 * g1 + k2 * g2)).add_to(&mut tally.hourglass, part);
    }

    let a = axes!(k => V::all(simd, 0.25) * (d24[k] - d13[k]));
    let c = axes!(k => V::all(simd, -0.25) * (d13[k] + d24[k]));
    let (n0, n1, n2) = (product(a, c), product(a, warp), product(warp, c));
    // Regular rows have no empty lanes.
    let p = V::all(simd, batch.pressure);
    let p = if ROWS { p } else { p * V::load(simd, &stock.real, part) };
    let third = p * V::all(simd, 1.0 / 3.0);
    let mut force = [[V::all(simd, 0.0); 3]; 4];
    for k in 0..3 {
        let whole = k1 * f1[k] + k2 * f2[k];
        let quarter = V::all(simd, 0.25) * whole;
        let r1 = t[0] * f1[k] + t[2] * f2[k] + k1 * q[k] - s1 * whole;
        let r2 = t[2] * f1[k] + t[1] * f2[k] + k2 * q[k] - s2 * whole;
        let p13 = b[0][0] * r1 + b[0][1] * r2;
        let p24 = b[1][0] * r1 + b[1][1] * r2;
        let (m0, m1, m2) = (p * n0[k], third * n1[k], third * n2[k]);
        let (low, high) = (m0 - quarter, m0 + quarter);
        let (sum, difference) = (m1 + m2 + p13, m1 - m2 - p24);
        force[0][k] = low - sum;
        force[1][k] = high + difference;
        force[2][k] = low + sum;
        force[3][k] = high - difference;
        if BOOKS {
            let flux = (odd[k] + even[k]) * n0[k] + V::all(simd, 4.0 / 3.0) * (a[k] * n1[k] + c[k] * n2[k]);
            (own * flux).add_to(&mut tally.flux[k], part);
        }
    }
    force
}

/// Forces, energies and fluxes of triangles; the fourth corner gets nothing.
#[inline(always)]
pub(super) fn triangles<S: Simd, L: ShellLaw>(
    simd: S,
    batch: BatchInputs,
    law: L,
    strains: &mut [Strain],
    out: &mut [CornerForces],
    tally: &mut Tally,
) {
    for (index, ((group, strain), out)) in batch.groups.iter().zip(strains).zip(out).enumerate() {
        for part in 0..LANES / S::F64_LANES {
            let (shape, who) = (&batch.shapes[group.shape as usize], batch.who(index, part));
            let x = axes!(c => V::gather(simd, batch.x, &group.node, c, part));
            let u = axes!(k => x[1][k] - x[0][k]);
            let v = axes!(k => x[2][k] - x[0][k]);
            let b = gradients(simd, shape, part);
            let f1 = axes!(k => b[0][0] * u[k] + b[1][0] * v[k]);
            let f2 = axes!(k => b[0][1] * u[k] + b[1][1] * v[k]);
            let t = tension::<S, L, true>(simd, batch.rate, law, shape, who, [f1, f2], strain, tally);
            let own = V::load(simd, &who.stock.own, part);

            let normal = product(u, v);
            let p = V::all(simd, batch.pressure / 6.0) * V::load(simd, &who.stock.real, part);
            for k in 0..3 {
                let r1 = t[0] * f1[k] + t[2] * f2[k];
                let r2 = t[2] * f1[k] + t[1] * f2[k];
                let (p2, p3) = (b[0][0] * r1 + b[0][1] * r2, b[1][0] * r1 + b[1][1] * r2);
                let push = p * normal[k];
                (push + (p2 + p3)).store(&mut out[0][k], part);
                (push - p2).store(&mut out[1][k], part);
                (push - p3).store(&mut out[2][k], part);
                let flux = V::all(simd, 1.0 / 6.0) * (x[0][k] + x[1][k] + x[2][k]) * normal[k];
                (own * flux).add_to(&mut tally.flux[k], part);
            }
        }
    }
}

/// Gradients of the shape functions, by corner and axis.
#[inline(always)]
fn gradients<S: Simd>(simd: S, shape: &RestShape, part: usize) -> [[V<S>; 2]; 2] {
    let [[b11, b12], [b21, b22]] = &shape.b;
    [[V::load(simd, b11, part), V::load(simd, b12, part)], [V::load(simd, b21, part), V::load(simd, b22, part)]]
}

/// A·(S + viscous part) as (11, 22, 12) for F = (f₁, f₂); keeps the strains and books the heat, with `BOOKS` the energy too.
#[inline(always)]
#[allow(clippy::too_many_arguments)] // shared part of the two kernels, inlined
fn tension<S: Simd, L: ShellLaw, const BOOKS: bool>(
    simd: S,
    rate: f64,
    law: L,
    shape: &RestShape,
    who: Who,
    [f1, f2]: [[V<S>; 3]; 2],
    strain: &mut Strain,
    tally: &mut Tally,
) -> [V<S>; 3] {
    let Who { stock, part, .. } = who;
    let (half, one) = (V::all(simd, 0.5), V::all(simd, 1.0));
    // E = ½(FᵀF − 1) as (11, 22, 2·12).
    let e = [half * (inner(f1, f1) - one), half * (inner(f2, f2) - one), inner(f1, f2)];
    let (s, w) = law.at(simd, e, who);
    let own = V::load(simd, &stock.own, part);
    let amount = V::load(simd, &shape.area, part) * V::load(simd, &stock.per, part);
    let eta = V::load(simd, &shape.viscosity, part) * V::all(simd, rate);
    let d = axes!(k => e[k] - V::load(simd, &strain.0[k], part));
    for (e, kept) in e.into_iter().zip(&mut strain.0) {
        e.store(kept, part);
    }
    let drag = [eta * d[0], eta * d[1], half * eta * d[2]];
    (own * inner(drag, d)).add_to(&mut tally.viscous, part);
    if BOOKS {
        (own * amount * w).add_to(&mut tally.membrane, part);
    }
    axes!(k => amount * s[k] + drag[k])
}
