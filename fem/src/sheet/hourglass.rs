//! How stiff hourglass control is.
//!
//! An element with one point of integration has in-plane modes without strain, g_a = F_a·q in [`super::kernel`]. A stiffness
//! k = 4 h A λ_max(Σ B Bᵀ) A₁₁ holds them; h = ⅓ would be that of a fully integrated square. Where a wall wrinkles at the
//! scale of its mesh these modes are the pleats, and what holds them stiffens the wall: only the ratio of h to the load
//! p R/(E t) counts (`verify::balloon`). With next to nothing instead elements turn inside out while a film fills.
//!
//! ```text
//! U = ½ k G + ⅒ f G⁵     G = g₁² + g₂²     h = min(1/100, c p R/A₁₁)     f = k(1/100)·(4/A)⁴
//! ```
//!
//! | symbol | meaning |
//! |---|---|
//! | p, R | largest pressure of a chamber beside the part, √(area of its wall/4π) |
//! | c | 0.015 |
//! | f | 1/100 more where an element is inside out, G = A/4; nothing in a pleat, G = A/80 |
//!
//! A wall without pressure has h = 1/100, which does not lock where it is smooth at the scale of its mesh. A coefficient that
//! is given is h, and f = 0. Measured, the Mylar balloon of `verify::balloon` in a stiff film that fills fast, and its square airbag:
//!
//! | c | 0.01 | 0.015 | 0.02 | 0.03 |
//! |---|---|---|---|---|
//! | balloon: thickness − 1 \[%\] | −1.2 | −1.3 | −1.4 | −1.5 |
//! | balloon: share of the stored energy \[%\] | 7.6 | 10.8 | 13.7 | 18.7 |
//! | airbag: pull-in from 32 to 48 elements \[%\] | 3.3 | 0.6 | 1.0 | 0.4 |

use std::f64::consts::PI;

use super::Element;
use super::reference::{Reference, dot};
use crate::Mesh;
use crate::mesh::Part;
use crate::problem::{Chamber, Pressure};

/// h of a wall without pressure, the most under pressure, and what f adds to an element that is inside out; .05 and more lock.
const MOST: f64 = 0.01;

/// c: less lets walls crumple while they fill, more takes energy from pleats.
const SHARE: f64 = 0.015;

/// h and what f adds of it for every part, whose areas \[m²\] and stiffnesses A₁₁ \[N/m\] these are.
pub fn coefficients(
    mesh: &Mesh,
    chambers: &[Chamber],
    given: Option<f64>,
    areas: &[f64],
    stiffness: &[f64],
) -> Vec<[f64; 2]> {
    let usual =
        |(pull, stiffness): (f64, &f64)| [if pull > 0.0 { MOST.min(SHARE * pull / stiffness) } else { MOST }, MOST];
    match given {
        Some(given) => vec![[given, 0.0]; stiffness.len()],
        None => pulls_n_m(mesh, chambers, areas).into_iter().zip(stiffness).map(usual).collect(),
    }
}

/// p R of every part, the largest of its chambers' \[N/m\].
fn pulls_n_m(mesh: &Mesh, chambers: &[Chamber], areas: &[f64]) -> Vec<f64> {
    let faces = |part: &Part, name: &str| [&part.front, &part.back].iter().any(|c| c.as_deref() == Some(name));
    let mut pulls = vec![0.0_f64; mesh.parts.len()];
    for chamber in chambers {
        let wall: Vec<usize> = (0..mesh.parts.len()).filter(|p| faces(&mesh.parts[*p], &chamber.name)).collect();
        let area: f64 = wall.iter().map(|p| areas[*p]).sum();
        let (Pressure::Set(curve) | Pressure::Sealed { filling: curve, .. }) = &chamber.pressure;
        let pull = curve.peak() * (area / (4.0 * PI)).sqrt();
        wall.iter().for_each(|p| pulls[*p] = pulls[*p].max(pull));
    }
    pulls
}

/// k \[N/m\] and f \[N/m⁹\] of a quadrilateral from its part's coefficients and A₁₁ \[N/m\].
pub fn of_element(reference: &Reference, [h, more]: [f64; 2], stiffness: f64) -> [f64; 2] {
    let [g11, g22, g12] = reference.metric(4);
    let largest = 0.5 * (g11 + g22) + (0.25 * (g11 - g22) * (g11 - g22) + g12 * g12).sqrt();
    let unit = 4.0 * stiffness * reference.area * largest;
    [h * unit, more * unit * (4.0 / reference.area).powi(4)]
}

impl Element {
    /// Bound of the stiffness of hourglass control beyond k at nodes `x`, whose deformation gradient is `f` \[N/m\].
    pub(super) fn hourglass_growth(&self, f: [[f64; 3]; 2], x: &[[f64; 4]]) -> f64 {
        let [_, growth] = self.hourglass;
        if growth == 0.0 {
            return 0.0;
        }
        let s = self.reference.s;
        let at = |n: usize, k: usize| x[self.node[n] as usize][k];
        let mode =
            [0, 1, 2].map(|k| 0.25 * (at(0, k) - at(1, k) + at(2, k) - at(3, k) - s[0] * f[0][k] - s[1] * f[1][k]));
        let square = dot(f[0], mode).powi(2) + dot(f[1], mode).powi(2);
        growth * (self.reference.area / 4.0).powi(4).max(9.0 * square.powi(4))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::problem::Amplitude;

    fn disc(pressure_pa: f64, given: Option<f64>) -> Vec<[f64; 2]> {
        let mesh = crate::mesh::generate::disc_balloon(0.1, 8).unwrap();
        let air =
            Chamber { name: "air".into(), pressure: Pressure::Set(Amplitude::Constant(pressure_pa)), open_axis: None };
        coefficients(&mesh, &[air], given, &[PI * 0.01; 2], &[1e4; 2])
    }

    #[test]
    fn a_wall_is_held_by_what_it_carries_unless_told() {
        let r_m = (0.02_f64 / 4.0).sqrt();
        let [h, more] = disc(1e3, None)[0];
        assert!((h / (SHARE * 1e3 * r_m / 1e4) - 1.0).abs() < 1e-12 && more == MOST);
        assert_eq!(disc(1e6, None), [[MOST; 2]; 2]);
        assert_eq!(disc(0.0, None), [[MOST; 2]; 2]);
        assert_eq!(disc(1e3, Some(0.02)), [[0.02, 0.0]; 2]);
    }
}
