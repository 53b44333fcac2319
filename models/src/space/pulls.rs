//! What strips pull with: one strip at a coordinate, and all of a section together.

use super::frame::direction;
use crate::assembly::Strip;

/// A strip at one coordinate, in a section bent by k = κ·e.
#[derive(Clone, Copy, Default)]
pub(super) struct StripFit {
    /// Contraction ε₀ of the axis that goes with it.
    pub contraction: f64,
    /// Force on ε₀ \[N\]: tension times cos β.
    pub force: f64,
    /// Distance b of its line of action from the axis \[m\].
    pub from_axis_m: f64,
    pub tension: f64,
}

impl StripFit {
    /// `self + by·slope`.
    pub(super) fn moved(self, by: f64, slope: StripFit) -> StripFit {
        StripFit {
            contraction: self.contraction + by * slope.contraction,
            force: self.force + by * slope.force,
            from_axis_m: self.from_axis_m + by * slope.from_axis_m,
            tension: self.tension + by * slope.tension,
        }
    }
}

/// A strip at a coordinate, and the change of its fit per coordinate.
#[derive(Clone, Copy, Default)]
pub(super) struct StripTangent {
    pub a: f64,
    pub at: StripFit,
    pub slope: StripFit,
}

/// What decides the contraction ε₀ of the axis.
#[derive(Clone, Copy)]
pub(super) enum AxisContraction {
    At(f64),
    /// All strips pull with this force \[N\] together, at an ε₀ beyond the floor.
    By {
        thrust_n: f64,
        floor: f64,
    },
}

#[derive(Clone, Copy, Default)]
pub(super) struct Pulls {
    pub force: f64,
    /// Moment of all strips about the axis, Σ F b e.
    pub moment: [f64; 2],
    /// Σ K over (1, b e): stiffness of contraction, mixed, and of the bend.
    pub stiffness: f64,
    pub mixed: [f64; 2],
    pub bend: [[f64; 2]; 2],
}

impl Pulls {
    pub(super) fn add(&mut self, strip: &Strip, fit: StripFit, tangent: &StripTangent) {
        let stiffness = (-tangent.slope.force / tangent.slope.contraction).max(0.0);
        let arm = direction(strip.azimuth_rad).map(|e| e * fit.from_axis_m);
        self.force += fit.force;
        self.stiffness += stiffness;
        for i in 0..2 {
            self.moment[i] += fit.force * arm[i];
            self.mixed[i] += stiffness * arm[i];
            for j in 0..2 {
                self.bend[i][j] += stiffness * arm[i] * arm[j];
            }
        }
    }
}
