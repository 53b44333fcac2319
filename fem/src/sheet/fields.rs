//! Stress, strain, thickness and wrinkling of every element, for pictures and reports.

use models::fabrics::{InlinedFabric, WrinklingFilm};

use super::reference::strain;
use super::{Element, Sheet};
use crate::vec3::{V3, along, cross, direction, dot};

/// Element results in mesh order (parts one after the other, quads before triangles), averaged over plies.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct ElementFields {
    /// Von Mises equivalent of the Cauchy stress \[Pa\].
    pub von_mises_pa: Vec<f64>,
    /// Principal Cauchy stresses, larger first \[Pa\].
    pub principal_stress_pa: Vec<[f64; 2]>,
    /// Unit vectors along them, in the sheet; the first has no component against the fabric's warp.
    pub principal_direction: Vec<[[f64; 3]; 2]>,
    /// Principal Green–Lagrange strains of each element, larger first.
    pub principal_strain: Vec<[f64; 2]>,
    /// Current thickness of the section (incompressible) \[m\].
    pub thickness_m: Vec<f64>,
    /// 0 taut, 1 wrinkled (smaller principal stress not tensile), 2 slack (larger not tensile either).
    pub wrinkle_state: Vec<u8>,
}

impl Sheet {
    /// Evaluates all elements at positions `q` (stride 4).
    pub fn fields(&self, q: &[f64]) -> ElementFields {
        let mut fields = ElementFields::default();
        let past = self.past();
        for (index, element) in self.elements.iter().enumerate() {
            let past = past.get(index).copied().unwrap_or_default();
            self.push(&mut fields, element, element.deformation(q.as_chunks().0), &past);
        }
        fields
    }

    /// Energy that compression of films stores at positions `q` (stride 4) \[J\]: flat ones up to the load of their wrinkles, and wrinkled
    /// ones. It is part of the membrane energy.
    pub(crate) fn compressed_j(&self, q: &[f64]) -> f64 {
        let of = |element: &Element| {
            let film = match self.fabrics[element.part].kind() {
                InlinedFabric::WrinklingFilm(film) => *film,
                InlinedFabric::NeoHookean(film) => WrinklingFilm { film: *film, load_n_per_m: f64::INFINITY },
                _ => return 0.0,
            };
            let f = element.deformation(q.as_chunks().0);
            element.reference.area * film.compressed_j_per_m2(strain(f))
        };
        self.elements.iter().map(of).sum()
    }

    fn push(&self, fields: &mut ElementFields, element: &Element, f: [V3; 2], past: &[f64; 2]) {
        let fabric = &*self.fabrics[element.part];
        let c = [dot(f[0], f[0]), dot(f[1], f[1]), dot(f[0], f[1])];
        let e = strain(f);
        let s = fabric.tension(e, past);
        let area_ratio = (c[0] * c[1] - c[2] * c[2]).max(0.0).sqrt();
        // Cauchy tension σt = F S Fᵀ / det F per current length; over the current thickness t/det F it is F S Fᵀ / t.
        let [s1, s2] = cauchy(s, c).map(|n| n / fabric.thickness_m());
        fields.von_mises_pa.push((s1 * s1 - s1 * s2 + s2 * s2).sqrt());
        fields.principal_stress_pa.push([s1, s2]);
        fields.principal_direction.push(directions(s, c, f));
        fields.principal_strain.push(principal([e[0], e[1], 0.5 * e[2]]));
        fields.thickness_m.push(fabric.thickness_m() / area_ratio.max(f64::MIN_POSITIVE));
        fields.wrinkle_state.push(if s1 <= 0.0 { 2 } else { u8::from(s2 <= 0.0) });
    }

    /// Fabric memory by element number; empty if no fabric has any.
    pub(super) fn past(&self) -> Vec<[f64; 2]> {
        let mut all = Vec::new();
        for patch in self.patches.iter().filter(|p| !p.past.is_empty()) {
            all.resize(self.elements.len(), [0.0; 2]);
            for (elements, past) in patch.element.iter().zip(&patch.past) {
                for (element, past) in elements.iter().zip(past).filter(|(e, _)| **e != u32::MAX) {
                    all[*element as usize] = *past;
                }
            }
        }
        all
    }
}

/// Principal values of F S Fᵀ, larger first: the eigenvalues of S C, invariant under rotation.
fn cauchy(s: V3, c: V3) -> [f64; 2] {
    let trace = s[0] * c[0] + s[1] * c[1] + 2.0 * s[2] * c[2];
    let determinant = (s[0] * s[1] - s[2] * s[2]) * (c[0] * c[1] - c[2] * c[2]);
    let root = (0.25 * trace * trace - determinant).max(0.0).sqrt();
    [0.5 * trace + root, 0.5 * trace - root]
}

/// Unit vectors along the principal stresses: F α with (S C) α = λ₁ α, and across it. Along the warp where all directions are equal,
/// and 0 for an element that has collapsed.
fn directions(s: V3, c: V3, f: [V3; 2]) -> [V3; 2] {
    let a = [
        [s[0] * c[0] + s[2] * c[2], s[0] * c[2] + s[2] * c[1]],
        [s[2] * c[0] + s[1] * c[2], s[2] * c[2] + s[1] * c[1]],
    ];
    let largest = cauchy(s, c)[0];
    let [p, q] = [[a[0][1], largest - a[0][0]], [largest - a[1][1], a[1][0]]];
    let [alpha, beta] = if p[0].hypot(p[1]) > q[0].hypot(q[1]) { p } else { q };
    let along = along(f[0].map(|x| alpha * x), beta, f[1]);
    let along = if dot(along, along) > 0.0 { along } else { f[0] };
    let along = if dot(along, f[0]) < 0.0 { along.map(|x| -x) } else { along };
    let across = cross(cross(f[0], f[1]), along);
    [along, across].map(|v| if dot(v, v) > 0.0 { direction(v) } else { [0.0; 3] })
}

/// Eigenvalues of the symmetric matrix (a, b; off-diagonal c), larger first.
fn principal([a, b, c]: V3) -> [f64; 2] {
    let root = (0.25 * (a - b) * (a - b) + c * c).sqrt();
    [0.5 * (a + b) + root, 0.5 * (a + b) - root]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// σ t = F S Fᵀ is put together again from principal values and directions.
    #[test]
    fn principal_stresses_along_their_directions_are_the_stress() {
        let f = [[1.1, 0.2, -0.1], [-0.15, 0.3, 0.9]];
        let c = [dot(f[0], f[0]), dot(f[1], f[1]), dot(f[0], f[1])];
        for s in [[3.0, 1.0, 0.4], [1.0, 3.0, -0.7], [-2.0, -1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]] {
            let (values, [along, across]) = (cauchy(s, c), directions(s, c, f));
            assert!(
                dot(along, f[0]) >= 0.0 && dot(along, across).abs() < 1e-12 && (dot(along, along) - 1.0).abs() < 1e-12
            );
            for i in 0..3 {
                for j in 0..3 {
                    let pull = |a: usize, b: usize| f[a][i] * f[b][j];
                    let whole = s[0] * pull(0, 0) + s[1] * pull(1, 1) + s[2] * (pull(0, 1) + pull(1, 0));
                    let found = values[0] * along[i] * along[j] + values[1] * across[i] * across[j];
                    assert!((found - whole).abs() < 1e-12, "{s:?}: {found} {whole}");
                }
            }
        }
        assert_eq!(directions([0.0; 3], c, f)[0], direction(f[0]), "without stress along the warp");
        assert_eq!(directions([0.0; 3], [0.0; 3], [[0.0; 3]; 2]), [[0.0; 3]; 2]);
    }
}
