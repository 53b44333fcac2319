//! The centre line in space: the frame carried along the arc without twist, exactly for piecewise constant curvature.
//!
//! ```text
//! n = (κ_y e_y + κ_z e_z)/|κ|,  u = |κ| h        t' = t cos u + n sin u,   n' = n cos u − t sin u
//! Δ = (1 − ε) h (t sin u/u + n (1 − cos u)/u)      ε contraction of the centre line
//! ```

use crate::shape::sinc_pair;
use std::f64::consts::FRAC_PI_2;

/// A place and the frame there: tangent, and the directions of azimuth 0° and 90°.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Frame {
    /// Position (x, y, z) in the frame of the clamp \[m\].
    pub at: [f64; 3],
    /// Unit vector along the centre line, towards the tip.
    pub tangent: [f64; 3],
    /// Unit vectors towards azimuth 0° and 90°.
    pub sides: [[f64; 3]; 2],
}

impl Frame {
    pub(crate) const BASE: Frame =
        Frame { at: [0.0; 3], tangent: [1.0, 0.0, 0.0], sides: [[0.0, 1.0, 0.0], [0.0, 0.0, 1.0]] };
}

/// Unit vector (y, z) at an azimuth, exact at quarter turns.
pub(crate) fn direction(azimuth_rad: f64) -> [f64; 2] {
    let quarters = (azimuth_rad / FRAC_PI_2).round();
    let (sin, cos) = (azimuth_rad - quarters * FRAC_PI_2).sin_cos();
    match (quarters as i64).rem_euclid(4) {
        0 => [cos, sin],
        1 => [-sin, cos],
        2 => [-cos, -sin],
        _ => [sin, -cos],
    }
}

#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Bend {
    /// κ_y, κ_z per unpressurised length \[1/m\].
    pub kappa: [f64; 2],
    pub contraction: f64,
}

impl Bend {
    pub(crate) fn size(&self) -> f64 {
        self.kappa[0].hypot(self.kappa[1])
    }
}

#[derive(Debug, Clone, Copy)]
pub(crate) struct SpaceStretch {
    pub from: Frame,
    pub bend: Bend,
    pub contraction: f64,
}

pub(crate) fn mix(a: f64, x: [f64; 3], b: f64, y: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|i| a * x[i] + b * y[i])
}

impl SpaceStretch {
    /// Place and frame at a distance from its start \[m\].
    pub(crate) fn at(&self, offset_m: f64) -> Frame {
        let Frame { at, tangent, sides } = self.from;
        let (size, [ky, kz]) = (self.bend.size(), self.bend.kappa);
        let [along, across, _, _, _, _, sin, cos] = sinc_pair(size * offset_m);
        let toward = if size == 0.0 { [1.0, 0.0] } else { [ky / size, kz / size] };
        let normal = mix(toward[0], sides[0], toward[1], sides[1]);
        let length = (1.0 - self.contraction) * offset_m;
        let step = mix(length * along, tangent, length * across, normal);
        // Both sides turn by what the normal turns, as far as they lie along it.
        let turn = mix(cos - 1.0, normal, -sin, tangent);
        Frame {
            at: mix(1.0, at, 1.0, step),
            tangent: mix(cos, tangent, sin, normal),
            sides: std::array::from_fn(|i| mix(1.0, sides[i], toward[i], turn)),
        }
    }
}
