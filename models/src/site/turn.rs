//! Geometry of a place: from the strain of the actuator's line to the bend of the body, and the section around the strip.

use super::Site;
use crate::actuators::Stroke;
use crate::body::soft_step;
use crate::section::CutSection;
use crate::statics::StripPull;
use std::f64::consts::PI;

/// Newton steps; 3 to 8 are usual.
const STEPS: usize = 60;
/// Share of the arm of a line inside the wall that a bend away leaves without: the wall next to it is taut.
const SUNK: f64 = 0.99;

impl Site {
    /// Arm of the line from the far side at a stroke \[m\].
    #[inline(always)]
    pub(super) fn arm(&self, stroke: &Stroke) -> f64 {
        self.linkage.arm_m + self.linkage.arm_growth * stroke.lift
    }

    /// Curvature of inextensible fabric at a stroke \[1/m\].
    pub(crate) fn geometric(&self, stroke: &Stroke) -> f64 {
        self.linkage.bent(self.turn(self.linkage.stroke_fraction * stroke.contraction, self.arm(stroke)).0).0
    }

    /// Section of its body around the strip, drawn in to a chord: all effects read it here. `None`: too wide for the body.
    pub(crate) fn drawn_in(&self, chord_m: f64) -> Option<CutSection> {
        CutSection::drawn_in(self.radius_m, self.strip_m, chord_m)
    }

    /// What an actuator that pulls at a coordinate makes of the section.
    pub(crate) fn pull(&self, azimuth_rad: f64, coordinate: f64) -> StripPull {
        let arm =
            self.actuator.map_or(self.linkage.arm_m, |actuator| self.arm(&(actuator.stroke)(&self.shape, coordinate)));
        let lost_m2 = PI * self.radius_m.powi(2) - self.area_m2;
        StripPull { azimuth_rad, from_axis_m: arm - self.radius_m, lost_m2, first_m3: self.first_m3 }
    }

    /// Curvature \[1/m\] of a line at distance `arm` from the far side that shortens by `strain`, and its lever \[m\].
    ///
    /// A line that lengthens bends the body away: the generator next to it is taut then, and the lever falls to `arm` − 2R.
    #[inline(always)]
    pub(super) fn turn(&self, strain: f64, arm: f64) -> (f64, f64) {
        if strain < 0.0 { self.turn_away(strain, arm) } else { (strain * (1.0 / arm), arm) }
    }

    /// `strain = arm κ + d k ln cosh(κ/k)`, rising and convex, by Newton; d = 2R, or a little less than the arm of a line inside the wall.
    #[cold]
    fn turn_away(&self, strain: f64, arm: f64) -> (f64, f64) {
        let (least_m, diameter_m) =
            (self.linkage.arm_m - self.linkage.arm_growth * self.shape.width_m / PI, 2.0 * self.radius_m);
        let across_m = if least_m < (1.0 - 1e-9) * diameter_m { SUNK * least_m.max(0.0) } else { diameter_m };
        let mut kappa = 0.0;
        for _ in 0..STEPS {
            let (log, tanh) = soft_step(kappa, self.centre_line.turn_per_m);
            let step = (strain - arm * kappa - across_m * log) / (arm + across_m * tanh);
            kappa += step;
            if step.abs() <= 4.0 * f64::EPSILON * kappa.abs() {
                break;
            }
        }
        (kappa, arm + across_m * soft_step(kappa, self.centre_line.turn_per_m).1)
    }
}
