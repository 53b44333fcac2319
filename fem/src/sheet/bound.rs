//! An upper bound of every node's stiffness, for the stable step.
//!
//! The tangent of an element is A·(Bᵀ D B + geometric part). Its largest eigenvalue is bounded by that of D·BBᵀ, a 3×3
//! matrix, through its largest row sum (exact for a square of isotropic fabric), plus the largest tension times that of
//! Σ B Bᵀ. Bending adds the row sums of K (Gershgorin).

use models::Fabric;
use models::fabrics::{Kind, Past, WrinklingFilm};

use super::reference::dot;
use super::{Element, Sheet};

/// Bound of the largest eigenvalue of an element's stiffness \[N/m\] at strain `e`; `c` = C₁₁, C₂₂, C₁₂.
pub fn element(element: &Element, fabric: &dyn Fabric, e: [f64; 3], past: &Past, c: [f64; 3]) -> f64 {
    let g = element.reference.metric(element.corners);
    let d = fabric.tangent(e, past);
    // B Bᵀ of the strain operator in (E₁₁, E₂₂, 2E₁₂).
    let bb = [
        [c[0] * g[0], c[2] * g[2], c[0] * g[2] + c[2] * g[0]],
        [c[2] * g[2], c[1] * g[1], c[2] * g[1] + c[1] * g[2]],
        [c[0] * g[2] + c[2] * g[0], c[2] * g[1] + c[1] * g[2], c[0] * g[1] + c[1] * g[0] + 2.0 * c[2] * g[2]],
    ];
    let entry = |i: usize, j: usize| (0..3).map(|k| d[i][k] * bb[k][j]).sum::<f64>().abs();
    let material = (0..3).map(|i| (0..3).map(|j| entry(i, j)).sum::<f64>()).fold(0.0, f64::max);
    let s = fabric.tension(e, past);
    let tension = largest(s[0], s[1], s[2]).max(0.0);
    let stretch = largest(c[0], c[1], c[2]);
    element.reference.area * (material + tension * largest(g[0], g[1], g[2])) + element.hourglass * stretch * 0.5
}

/// Strain that a fabric may go on between two estimates of the step.
const AHEAD: f64 = 0.01;

/// The largest [`element`] for what comes next: curves stiffen at their rows, a way back may be steeper than the way there, and
/// a film that is slack comes back taut, at a strain that has no folds. Linear and neo-Hookean fabrics change too little to
/// look ahead.
fn ahead(item: &Element, fabric: &dyn Fabric, e: [f64; 3], past: &Past, c: [f64; 3]) -> f64 {
    let here = element(item, fabric, e, past, c);
    if let Kind::WrinklingFilm(wrinkling) = fabric.kind() {
        let taut = WrinklingFilm::unfolded(e);
        let at = [1.0 + 2.0 * taut[0], 1.0 + 2.0 * taut[1], taut[2]];
        return here.max(element(item, &wrinkling.film, taut, past, at));
    }
    if !matches!(fabric.kind(), Kind::Other) {
        return here;
    }
    let next = [e, [e[0] + AHEAD, e[1] + AHEAD, e[2]], [e[0], e[1], e[2] + AHEAD.copysign(e[2])]];
    let pasts = [*past, [0.0; 2]];
    let pasts = if fabric.has_memory() { &pasts[..] } else { &pasts[1..] };
    let all = next.iter().flat_map(|e| pasts.iter().map(|past| element(item, fabric, *e, past, c)));
    all.fold(here, f64::max)
}

/// Larger eigenvalue of the symmetric matrix (a, b; off-diagonal c).
fn largest(a: f64, b: f64, c: f64) -> f64 {
    0.5 * (a + b) + (0.25 * (a - b) * (a - b) + c * c).sqrt()
}

impl Sheet {
    /// True if some fabric may stiffen faster than linear and neo-Hookean ones do.
    pub(crate) fn stiffens(&self) -> bool {
        self.fabrics.iter().any(|f| matches!(f.kind(), Kind::Other))
    }

    /// Adds each node's stiffness bound at positions `q` (stride 4) \[N/m\].
    pub(super) fn add_bound(&self, q: &[f64], bound: &mut [f64]) {
        let q = q.as_chunks::<4>().0;
        let pressure = self.air.iter().map(|a| a.peak_pa()).fold(0.0, f64::max);
        let past = self.past();
        for (index, item) in self.elements.iter().enumerate() {
            let fabric = &*self.fabrics[item.part];
            let [f1, f2] = item.deformation(q);
            let c = [dot(f1, f1), dot(f2, f2), dot(f1, f2)];
            let e = [0.5 * (c[0] - 1.0), 0.5 * (c[1] - 1.0), c[2]];
            // Follower pressure: ∂(p N n)/∂x is of the order of p times an edge.
            let follower = pressure * item.reference.area.sqrt();
            let k = ahead(item, fabric, e, &past.get(index).copied().unwrap_or_default(), c) + follower;
            item.nodes().iter().for_each(|n| bound[*n as usize] += k);
        }
        bound.iter_mut().zip(&self.bending_bound).for_each(|(bound, bending)| *bound += bending);
    }
}

impl Element {
    /// Columns F₁, F₂ of the deformation gradient at the element's centre.
    pub fn deformation(&self, q: &[[f64; 4]]) -> [[f64; 3]; 2] {
        let mut f = [[0.0; 3]; 2];
        for (n, node) in self.nodes().iter().enumerate() {
            let b = self.reference.gradient(self.corners, n);
            let x = q[*node as usize];
            for a in 0..2 {
                (0..3).for_each(|k| f[a][k] += b[a] * x[k]);
            }
        }
        f
    }
}
