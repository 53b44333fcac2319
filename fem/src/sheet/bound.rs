//! An upper bound of every node's stiffness, for the stable step.
//!
//! The tangent of an element is A·(Bᵀ D B + geometric part). Its largest eigenvalue is bounded by the largest one of D·BBᵀ, a 3×3
//! matrix, through its largest row sum (exact for a square of isotropic fabric), plus the largest tension times the largest eigenvalue of
//! Σ B Bᵀ. Bending adds the row sums of K (Gershgorin).

use models::Fabric;
use models::fabrics::{InlinedFabric, Past, WrinklingFilm};

use super::chamber::Air;
use super::reference::mean_stiffness;
use super::{Element, Sheet};
use crate::vec3::{Nodes, V3, dot, share};

/// A state of an element at which its stiffness is asked for.
#[derive(Clone, Copy)]
struct At<'a> {
    fabric: &'a dyn Fabric,
    e: [f64; 3],
    past: Past,
    /// Right Cauchy–Green strain (C₁₁, C₂₂, C₁₂) of the state.
    c: [f64; 3],
    /// Tangent that the step must bear \[N/m\].
    d: [[f64; 3]; 3],
}

impl At<'_> {
    /// Bound of the largest eigenvalue of A·Bᵀ D B \[N/m\].
    fn material(&self, element: &Element) -> f64 {
        let (g, c, d) = (element.reference.metric(element.corners), self.c, self.d);
        // B Bᵀ of the strain operator in (E₁₁, E₂₂, 2E₁₂).
        let bb = [
            [c[0] * g[0], c[2] * g[2], c[0] * g[2] + c[2] * g[0]],
            [c[2] * g[2], c[1] * g[1], c[2] * g[1] + c[1] * g[2]],
            [c[0] * g[2] + c[2] * g[0], c[2] * g[1] + c[1] * g[2], c[0] * g[1] + c[1] * g[0] + 2.0 * c[2] * g[2]],
        ];
        let entry = |i: usize, j: usize| (0..3).map(|k| d[i][k] * bb[k][j]).sum::<f64>().abs();
        element.reference.area * (0..3).map(|i| (0..3).map(|j| entry(i, j)).sum::<f64>()).fold(0.0, f64::max)
    }

    /// Bound of the eigenvalues of the geometric part and of hourglass control \[N/m\].
    fn rest(&self, element: &Element) -> f64 {
        let g = element.reference.metric(element.corners);
        let s = self.fabric.tension(self.e, &self.past);
        let tension = largest(s[0], s[1], s[2]).max(0.0);
        let stretch = largest(self.c[0], self.c[1], self.c[2]);
        element.reference.area * tension * largest(g[0], g[1], g[2]) + element.hourglass * stretch * 0.5
    }

    fn all(&self, element: &Element) -> f64 {
        self.material(element) + self.rest(element)
    }
}

/// Strain by which a fabric may go on or back between two estimates of the step.
const AHEAD: f64 = 0.01;

/// The stiffest state of what comes next, and its bound: [`Fabric::steepest`] has curves that stiffen and ways back that are steeper
/// than the way there, and a film that is slack comes back taut, at a strain that has no folds.
fn ahead<'a>(item: &Element, here: At<'a>) -> (At<'a>, f64) {
    let bounded = |at: At<'a>| (at, at.all(item));
    let stiffer = |a: (At<'a>, f64), b: (At<'a>, f64)| if b.1 > a.1 { b } else { a };
    if let InlinedFabric::WrinklingFilm(wrinkling) = here.fabric.kind() {
        let e = WrinklingFilm::unfolded(here.e);
        let d = wrinkling.film.tangent(e, &here.past);
        let taut = At { fabric: &wrinkling.film, e, c: [1.0 + 2.0 * e[0], 1.0 + 2.0 * e[1], e[2]], d, ..here };
        return stiffer(bounded(here), bounded(taut));
    }
    bounded(here)
}

/// Larger eigenvalue of the symmetric matrix (a, b; off-diagonal c).
pub(crate) fn largest(a: f64, b: f64, c: f64) -> f64 {
    0.5 * (a + b) + (0.25 * (a - b) * (a - b) + c * c).sqrt()
}

impl Sheet {
    /// η = 2 ξ A/ω \[N s/m\], which makes ξ the damping ratio of an unstrained element's highest mode on its own masses.
    pub(super) fn viscosity_n_s_m(&self, element: &Element) -> f64 {
        let (fabric, area) = (&*self.fabrics[element.part], element.reference.area);
        let (e, past) = ([0.0; 3], [0.0; 2]);
        let (c, d) = ([1.0, 1.0, 0.0], fabric.tangent(e, &past));
        let stiffness = At { fabric, e, past, c, d }.all(element);
        let mass = self.areal_density[element.part] * area / element.corners as f64;
        let rate = (stiffness / mass).sqrt();
        share(2.0 * self.viscosity * mean_stiffness(fabric), rate)
    }

    /// True if some fabric may stiffen faster than linear and neo-Hookean ones do, or some gas.
    pub(crate) fn stiffens(&self) -> bool {
        self.fabrics.iter().any(|f| matches!(f.kind(), InlinedFabric::Other)) || self.air.iter().any(Air::follows)
    }

    /// Adds the bound of the gas in chambers that are sealed, or will be before `until_s` \[N/m\].
    pub(crate) fn add_gas_bound(&self, until_s: f64, q: &[f64], bound: &mut [f64]) {
        for air in self.air.iter() {
            air.add_bound(until_s, &self.elements, q.as_chunks().0, bound);
        }
    }

    /// Adds each node's stiffness bound at positions `q` (stride 4) \[N/m\].
    pub(super) fn add_bound(&self, q: &[f64], bound: &mut [f64]) {
        self.each_ahead(q, bound, |_, (_, bound), _| bound);
    }

    /// Adds each node's part of the bound that is bending's \[N/m\].
    pub(crate) fn add_bending_bound(&self, bound: &mut [f64]) {
        for (bound, bending) in bound.iter_mut().zip(&self.bending_bound) {
            *bound += bending;
        }
    }

    /// The material part of the tangent that the bound is of, element by element; adds the bounds of everything else.
    pub(crate) fn tangents(&self, q: &[f64], bound: &mut [f64]) -> Vec<Tangent> {
        let mut all = Vec::with_capacity(self.elements.len());
        self.each_ahead(q, bound, |item, (at, _), f| {
            // A film that comes taut has the length of its unfolded strain.
            let f = [0, 1].map(|k| f[k].map(|x| x * (at.c[k] / dot(f[k], f[k])).sqrt()));
            all.push(Tangent::new(item, f, at.d, self.viscosity_n_s_m(item)));
            at.rest(item)
        });
        all
    }

    /// Adds to the nodes each element's bound `of` at its stiffest state, and the bounds of bending and pressure.
    fn each_ahead(&self, q: &[f64], bound: &mut [f64], mut of: impl FnMut(&Element, (At, f64), [V3; 2]) -> f64) {
        let q = q.as_chunks::<4>().0;
        let pressure = self.air.iter().map(|a| a.peak_pa()).fold(0.0, f64::max);
        let past = self.past();
        for (index, item) in self.elements.iter().enumerate() {
            let fabric = &*self.fabrics[item.part];
            let f = item.deformation(q);
            let c = [dot(f[0], f[0]), dot(f[1], f[1]), dot(f[0], f[1])];
            let e = [0.5 * (c[0] - 1.0), 0.5 * (c[1] - 1.0), c[2]];
            let past = past.get(index).copied().unwrap_or_default();
            let here = At { fabric, e, past, c, d: fabric.steepest(e, &past, AHEAD) };
            // Follower pressure: ∂(p N n)/∂x is of the order of p times an edge.
            let k = of(item, ahead(item, here), f) + pressure * item.reference.area.sqrt();
            item.nodes().iter().for_each(|n| bound[*n as usize] += k);
        }
        self.add_bending_bound(bound);
    }
}

/// What an element adds to the tangent: A Bᵀ D B, and viscosity.
pub struct Tangent {
    /// Nodes of which F holds the differences, first minus second.
    pairs: [[u32; 2]; 2],
    /// Shape gradients that go with them \[1/m\].
    b: [[f64; 2]; 2],
    /// Columns of the deformation gradient F, along warp and fill.
    f: [[f64; 3]; 2],
    /// Area times tangent stiffness, A D \[N m\].
    stiff: [[f64; 3]; 3],
    /// Area times viscosity, A η \[N m s\].
    viscous: f64,
}

impl Tangent {
    /// From the columns of the deformation gradient, the fabric's tangent \[N/m\] and its viscosity \[N s/m\].
    pub fn new(item: &Element, f: [V3; 2], d: [V3; 3], viscosity: f64) -> Tangent {
        let area = item.reference.area;
        let [a, b, c, last] = item.node;
        // The first corner of a triangle has minus the gradients of both others.
        let pairs = if item.corners == 4 { [[a, c], [b, last]] } else { [[b, a], [c, a]] };
        let stiff = d.map(|row| row.map(|d| area * d));
        Tangent { pairs, b: item.reference.b, f, stiff, viscous: area * viscosity }
    }

    /// Adds (K + s C) u to `force`, both by nodes.
    pub fn add(&self, s: f64, u: &Nodes, force: &mut Nodes) {
        let mut g = [[0.0; 3]; 2];
        for (b, [plus, minus]) in self.b.iter().zip(self.pairs) {
            let (plus, minus) = (&u[plus as usize], &u[minus as usize]);
            for k in 0..3 {
                let apart = plus[k] - minus[k];
                g[0][k] += b[0] * apart;
                g[1][k] += b[1] * apart;
            }
        }
        let [f1, f2] = self.f;
        let e = [dot(f1, g[0]), dot(f2, g[1]), dot(f1, g[1]) + dot(f2, g[0])];
        let slow = s * self.viscous;
        let slow = [slow * e[0], slow * e[1], 0.5 * slow * e[2]];
        let t: [f64; 3] = std::array::from_fn(|i| dot(self.stiff[i], e) + slow[i]);
        for (b, [plus, minus]) in self.b.iter().zip(self.pairs) {
            for k in 0..3 {
                let pull = b[0] * (t[0] * f1[k] + t[2] * f2[k]) + b[1] * (t[1] * f2[k] + t[2] * f1[k]);
                force[plus as usize][k] += pull;
                force[minus as usize][k] -= pull;
            }
        }
    }
}
