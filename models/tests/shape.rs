//! The shape against an independent integration of the heading along the arc.

#![allow(clippy::unwrap_used)]

use models::{Loads, Model, Scenario, shipped};
use ode_solvers::dop_shared::OutputType;
use ode_solvers::{Dopri5, System, Vector3};

/// One segment: dψ/ds = κ, d(x, y)/ds = (1 − s)(cos ψ, sin ψ) over its taut length, s = κR towards the actuator. Away from it the taut
/// generator is the one at the actuator: ds/dκ goes from R to −R as the hinge's moment does, with 1 + 2 tanh(κ/k).
struct Segment {
    kappa: f64,
    radius_m: f64,
}

const HINGE_PER_M: f64 = 0.05;

impl System<f64, Vector3<f64>> for Segment {
    fn system(&self, _s: f64, at: &Vector3<f64>, slope: &mut Vector3<f64>) {
        let away = 2.0 * HINGE_PER_M * (self.kappa.min(0.0) / HINGE_PER_M).cosh().ln();
        let stretch = 1.0 - (self.kappa + away) * self.radius_m;
        *slope = Vector3::new(stretch * at[2].cos(), stretch * at[2].sin(), self.kappa);
    }
}

/// Pose (x, y, ψ) after `length_m` of a segment.
fn integrate(segment: Segment, from: Vector3<f64>, length_m: f64) -> Vector3<f64> {
    let (h, tolerance) = (length_m, 1e-13);
    let mut stepper = Dopri5::from_param(
        segment,
        0.0,
        length_m,
        h,
        from,
        tolerance,
        tolerance,
        0.9,
        0.04,
        0.2,
        10.0,
        length_m,
        0.0,
        100_000,
        1000,
        OutputType::Sparse,
    );
    stepper.integrate().unwrap();
    *stepper.y_out().last().unwrap()
}

#[test]
fn integrating_the_heading_gives_the_same_tip() {
    for name in models::actuators::ACTUATORS.iter().map(|actuator| actuator.name) {
        let shipped = Scenario::parse(shipped(name).unwrap()).unwrap();
        let loaded = shipped.with_bending(0.6).with_effect("gravity", &[1.5]).with_effect("tip_load", &[0.1, -0.3]);
        for scenario in [shipped, loaded] {
            let model = Model::new(&scenario);
            let mut out = model.prediction();
            for p in [0.0, 5e3, 20e3, 60e3] {
                model.predict(&Loads::uniform(2e3, p), &mut out).unwrap();
                let mut at = Vector3::new(0.0, 0.0, 0.0);
                for (segment, kappa) in model.curvatures(&out) {
                    let radius_m = model.assembly().sites[segment.site].radius_m;
                    at = integrate(Segment { kappa, radius_m }, at, segment.length_m);
                }
                let error = (at[0] - out.tip.x_m).abs().max((at[1] - out.tip.y_m).abs());
                assert!(error < 1e-9 && (at[2] - out.tip.angle_rad).abs() < 1e-9, "{name} {p}: {error:e} m");
            }
        }
    }
}
