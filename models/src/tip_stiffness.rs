//! How the tip gives way to a force on it, at constant pressures.
//!
//! A section of compliance S (change of q per generalised load) at x(s) with tangent t and sides e_y, e_z moves the tip by its lever J:
//!
//! ```text
//! C = ∫ J S Jᵀ ds + ∫ (1 − ε)² n nᵀ/K ds     J = [(t × e_y) × (x_tip − x), (t × e_z) × (x_tip − x), −t]     q = (κ_y, κ_z, ε)
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | C | displacement of the tip per force on it | m/N |
//! | ε | contraction of the centre line | - |
//! | n, K | direction across the body, shear stiffness of its wall | -, N |
//!
//! Loads on the body change their levers as the tip moves: with them C is the last Newton step of their equilibrium, under a small force.
//!
//! **Validity**: first loading; small forces, as a section that is straight or at the end of its range has another stiffness to each side. A
//! planar robot gives way in its plane alone. Loads turn no shear. Derived here (unit-load method); `tests/laws/tip_stiffness.rs`
//! compares it with predictions under two forces.

use crate::error::Solved;
use crate::model::{Model, Prediction};
use crate::robot;
use crate::space::{self, Frame, Matrix, StripSection, cross, outer};
use crate::term::Loads;
use serde::Serialize;
use spelling::si;

/// Compliance and stiffness of the tip.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct TipStiffness {
    /// Displacement of the tip along x, y, z (row) per force on it (column); 0 across the plane of a planar robot \[m/N\].
    #[serde(rename = "compliance_mm_per_n", serialize_with = "si::mm")]
    pub compliance_m_per_n: [[f64; 3]; 3],
    /// Force along y per displacement that way, free to move the other ways: dF/dy \[N/m\].
    #[serde(rename = "y_n_per_mm", serialize_with = "si::n_per_mm")]
    pub y_n_per_m: f64,
}

/// Points and weights of Gauss on −1 … 1.
pub(crate) const GAUSS: [(f64, f64); 5] = [
    (-0.906_179_845_938_664, 0.236_926_885_056_189_1),
    (-0.538_469_310_105_683_1, 0.478_628_670_499_366_5),
    (0.0, 0.568_888_888_888_888_9),
    (0.538_469_310_105_683_1, 0.478_628_670_499_366_5),
    (0.906_179_845_938_664, 0.236_926_885_056_189_1),
];
/// Longest piece of a segment for these points, as its turn \[rad\]: exact to 1e-9.
const PIECE: f64 = 1.0;

impl Model {
    /// How the tip gives way to a force, on the first loading; `out` is overwritten.
    ///
    /// # Errors
    /// As [`Model::predict`].
    pub fn tip_stiffness(&self, loads: &Loads, out: &mut Prediction) -> Solved<TipStiffness> {
        self.settle(loads, out, false)?;
        let (assembly, body_pa) = (self.assembly(), self.body_pa(loads, &out.work));
        let compliance_m_per_n = match (assembly.node_terms.is_empty(), self.is_spatial()) {
            (true, _) => self.free_compliance(body_pa, out)?,
            (false, true) => space::tip_compliance(assembly, &mut out.work.space),
            (false, false) => robot::tip_compliance(assembly, body_pa, &mut out.work),
        };
        Ok(TipStiffness { compliance_m_per_n, y_n_per_m: 1.0 / compliance_m_per_n[1][1] })
    }

    /// Without loads on the body: every section for itself.
    fn free_compliance(&self, body_pa: f64, at: &mut Prediction) -> Solved<Matrix> {
        let (assembly, tip) = (self.assembly(), [at.tip.x_m, at.tip.y_m, at.tip.z_m]);
        let mut sum = [[0.0; 3]; 3];
        for (i, segment) in assembly.segments.iter().enumerate() {
            let (site, state) = (assembly.site(i), at.work.states[i]);
            let ([line, along, _], stiffness_n) =
                (site.centre_line.shortening(state.curvature), site.shear_stiffness_n(body_pa));
            let gives = if self.is_spatial() {
                let (bend, strips) = (at.work.space.bends[i], &mut at.work.space.strips[i]);
                StripSection::new(assembly, i, body_pa).compliance(strips, &bend)?
            } else {
                let way = [1.0, 0.0, along];
                let compliance = site.compliance(&state, at.work.history.of_segment(i));
                outer(way, way).map(|row| row.map(|x| compliance * x))
            };
            let pieces = (state.curvature.abs() * segment.length_m / PIECE).ceil().max(1.0);
            let half_m = 0.5 * segment.length_m / pieces;
            for (piece, (point, weight)) in (0..pieces as usize).flat_map(|k| GAUSS.map(|gauss| (k, gauss))) {
                let Frame { at: place, tangent, sides: [y, z] } =
                    self.frame(at, i, half_m * (2.0 * piece as f64 + 1.0 + point));
                let way = std::array::from_fn(|k| tip[k] - place[k]);
                let lever = |side| cross(cross(tangent, side), way);
                let levers = [lever(y), lever(z), tangent.map(|t| -t)];
                let slide = (1.0 - line).powi(2) / stiffness_n;
                for (j, k) in (0..9).map(|n| (n / 3, n % 3)) {
                    let bent: f64 = (0..9).map(|n| levers[n / 3][j] * gives[n / 3][n % 3] * levers[n % 3][k]).sum();
                    sum[j][k] += half_m * weight * (bent + slide * y[j] * y[k]);
                }
            }
        }
        Ok(sum)
    }

    /// Frame on the centre line of a segment.
    fn frame(&self, at: &Prediction, segment: usize, offset_m: f64) -> Frame {
        if self.is_spatial() {
            return self.stretch_in_space(&at.work, segment).at(offset_m);
        }
        let ([x, y], heading) = self.stretch(&at.work, segment).at(offset_m);
        let (sin, cos) = heading.sin_cos();
        Frame { at: [x, y, 0.0], tangent: [cos, sin, 0.0], sides: [[-sin, cos, 0.0], [0.0, 0.0, 1.0]] }
    }
}
