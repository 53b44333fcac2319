//! What a predicted pose looks like: arm, width and height of the pouches, volumes of actuator and body.
//!
//! At a fixed pose the energy Π of all terms knows the gas by its pressures, so its slopes are the volumes, whatever effects
//! there are:
//!
//! ```text
//! V_a = −∂Π/∂P      V_b = A₀ l − ∂Π/∂p_b      a₀ = r (1 − cosθ)      width W − σe (π − 2) a₀      height 2 a₀
//! ```
//! Gussets narrow the width by a law of their own (`gusset.rs`).
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | P, p_b | gauge pressures of actuator and body | Pa |
//! | A₀, l | section at rest, drawn in by the weld lines where `chord_arm` acts; length | m², m |
//! | a₀, r, θ | half height of the lens in its middle, radius, half arc angle | m, m, rad |
//! | W, σe | width between the side welds, share of the sides that are sealed | m, – |
//!
//! **Validity**: regulated pressures. Volumes of folds that round off are in it, as their tension follows the pressure. Derived here
//! (the envelope theorem); the finite elements measure the same on their mesh, `fem::robot::Inflated`.

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

/// Step of the slopes over pressure, as a share of it: energies are linear in pressures, folds go with their roots.
const STEP: f64 = 1e-3;

impl Model {
    /// Shape of a state of [`Model::predict`] at its loads; `None` without pouches.
    pub fn pouch_shape(&self, loads: &Loads, at: &Prediction) -> Option<PouchShape> {
        self.planar("").ok()?;
        let (mut shape, mut active_m) = (PouchShape::default(), 0.0);
        let body_pa = self.body_pa(loads, &at.work);
        for (index, segment) in self.assembly().segments.iter().enumerate() {
            let site = self.assembly().site(index);
            let [actuator_m3, lost_m3] = self.volumes(body_pa, at, index);
            shape.actuator_m3 += actuator_m3;
            shape.body_m3 += site.area_m2 * segment.length_m - lost_m3;
            let Some(actuator) = site.actuator.filter(|a| a.has_pouches()) else { continue };
            let theta = at.work.states[index].coordinate.max(actuator.range.0);
            let stroke = (actuator.stroke)(&site.shape, theta);
            let folded = site.gusset_share * gusset::narrowing_m(site.shape.length_m, site.shape.fold_m, theta);
            let of_length = segment.length_m;
            active_m += of_length;
            shape.arm_m += of_length * (site.linkage.arm_m + site.linkage.arm_growth * stroke.lift);
            shape.width_m += of_length * (site.shape.width_m - site.side_effects.narrows * stroke.lift - folded);
            shape.height_m += of_length * 2.0 * stroke.lift;
        }
        for mean in [&mut shape.arm_m, &mut shape.width_m, &mut shape.height_m] {
            *mean /= active_m;
        }
        (active_m > 0.0).then_some(shape)
    }

    /// What the actuator of a segment holds, and what the body has lost there \[m³\].
    fn volumes(&self, body_pa: f64, at: &Prediction, index: usize) -> [f64; 2] {
        let own = [body_pa, at.work.p_act_pa[index]];
        let energy = |pressures: [f64; 2]| {
            let mut lines = Vec::new();
            self.site_energies(index, pressures, &at.work, &mut lines);
            lines.iter().map(|line| line.energy_j).sum::<f64>()
        };
        let slope = |k: usize| {
            let step = STEP * own[k];
            let moved = |sign: f64| std::array::from_fn(|i| if i == k { own[i] + sign * step } else { own[i] });
            if step > 0.0 { (energy(moved(1.0)) - energy(moved(-1.0))) / (2.0 * step) } else { 0.0 }
        };
        [-slope(1), slope(0)]
    }
}
