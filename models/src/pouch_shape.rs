//! What a predicted pose looks like: arm, width and height of the pouches, volumes of actuator and body.
//!
//! ```text
//! a₀ = r (1 − cosθ)      width W − σe (π − 2) q a₀      height 2 a₀
//! ```
//! Gussets narrow the width by a law of their own (`gusset.rs`). Volumes are the slopes of the energy by the pressures (`gases.rs`).
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | a₀, r, θ | half height of the lens in its middle, radius, half arc angle | m, m, rad |
//! | W, σe | width between the side welds, share of the sides that are sealed | m, – |
//!
//! **Validity**: regulated pressures. The finite elements measure the same on their mesh, `fem::robot::Inflated`.

use crate::gusset;
use crate::model::{Model, Prediction};
use crate::term::Loads;

/// Shape of a predicted pose; lengths are means over the robot's active stretches.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct PouchShape {
    /// From the actuator's line of action to the far side \[m\].
    pub arm_m: f64,
    /// Between the sides of a pouch in its middle \[m\].
    pub width_m: f64,
    /// Of a pouch in its middle \[m\].
    pub height_m: f64,
    /// Gas of the whole actuator \[m³\].
    pub actuator_m3: f64,
    /// Volume of gas in the whole body \[m³\].
    pub body_m3: f64,
}

impl Model {
    /// Shape of a state of [`Model::predict`] at its loads; `None` without pouches.
    pub fn pouch_shape(&self, loads: &Loads, at: &Prediction) -> Option<PouchShape> {
        self.planar("").ok()?;
        let (mut shape, mut active_m) = (PouchShape::default(), 0.0);
        let body_pa = self.body_pa(loads, &at.work);
        for (index, segment) in self.assembly().segments.iter().enumerate() {
            let site = self.assembly().site(index);
            let [actuator_m3, lost_m3] = self.moved_m3(body_pa, at, index);
            shape.actuator_m3 += actuator_m3;
            shape.body_m3 += site.area_m2 * segment.length_m - lost_m3;
            let Some(actuator) = site.actuator.filter(|a| a.has_pouches()) else { continue };
            let theta = at.work.states[index].coordinate.max(actuator.range.0);
            let stroke = (actuator.stroke)(&site.shape, theta);
            let folded = site.gusset_share * gusset::narrowing_m(site.shape.length_m, site.shape.fold_m, theta);
            let of_length = segment.length_m;
            active_m += of_length;
            shape.arm_m += of_length * (site.linkage.arm_m + site.linkage.arm_growth * stroke.lift);
            let [q, _] = gusset::side_share(site.shape.width_m, [stroke.lift, 0.0]);
            let narrowed = q * (site.side_effects.narrows * stroke.lift + folded);
            shape.width_m += of_length * (site.shape.width_m - narrowed);
            shape.height_m += of_length * 2.0 * stroke.lift;
        }
        for mean in [&mut shape.arm_m, &mut shape.width_m, &mut shape.height_m] {
            *mean /= active_m;
        }
        (active_m > 0.0).then_some(shape)
    }
}
