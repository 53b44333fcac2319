//! The numbers of the table `[fem]`: every setting of a robot that is one.

use super::RobotSettings;
use crate::case::range::{DeclaredKey, key};
use crate::{FemError, Result};

/// Numbers of the table `[fem]`, each with unit, bounds and meaning.
#[rustfmt::skip]
pub const KEYS: &[DeclaredKey<RobotSettings>] = &[
    key("mesh_mm", 1e-3, [0.5, 50.0], "element size of body and actuator",
        |s| Some(s.body_size_m), |s, v| { s.body_size_m = v; s.actuator_size_m = v; }),
    key("body_mesh_mm", 1e-3, [0.5, 50.0], "element size of the body", |s| Some(s.body_size_m), |s, v| s.body_size_m = v),
    key("actuator_mesh_mm", 1e-3, [0.5, 50.0], "element size of the actuator and the strip under it",
        |s| Some(s.actuator_size_m), |s, v| s.actuator_size_m = v),
    key("ring_spacing", 1.0, [0.1, 10.0], "distance of the rings at the actuator over its element size",
        |s| s.ring_spacing, |s, v| s.ring_spacing = Some(v)),
    key("seam_row_mm", 1e-3, [0.1, 100.0], "length of the rows next to welds, from which rows grow to the distance of the rings",
        |s| s.seam_row_m, |s, v| s.seam_row_m = Some(v)),
    key("layer_gap_mm", 1e-3, [1e-4, 1.0], "distance between layers at the start",
        |s| Some(s.layer_gap_m), |s, v| s.layer_gap_m = v),
    key("layer_friction", 1.0, [0.0, 2.0], "Coulomb friction between layers that touch",
        |s| Some(s.layer_friction), |s, v| s.layer_friction = v),
    key("weld_mm", 1e-3, [0.0, 100.0], "width of the welds across the robot; 0: a line", |s| Some(s.weld_m), |s, v| s.weld_m = v),
    key("bending_factor", 1.0, [0.0, 10.0], "bending stiffness of one sheet relative to a solid plate",
        |s| Some(s.bending_factor), |s, v| s.bending_factor = v),
    key("bending_share", 1.0, [1e-3, 1.0], "share of all bending stiffness that is kept, for a study of what carries a difference",
        |s| Some(s.bending_share), |s, v| s.bending_share = v),
    key("wrinkle_length", 1.0, [1e-3, 1e3], "length of wrinkles relative to the geometry's; their load is inverse to it",
        |s| s.wrinkle_length, |s, v| s.wrinkle_length = Some(v)),
    key("bond", 1.0, [0.0, 1.0], "how far taped and glued plies bend as one", |s| Some(s.bond), |s, v| s.bond = v),
    key("tape_mm", 1e-3, [1e-3, 5.0], "thickness of the transfer tape", |s| Some(s.tape_m), |s, v| s.tape_m = v),
    key("tape_e_mpa", 1e6, [1e-3, 1e4], "Young's modulus of its adhesive", |s| Some(s.tape_e_pa), |s, v| s.tape_e_pa = v),
    key("tape_margin_mm", 1e-3, [0.0, 100.0], "width of the taped sheet beyond the welds along its sides",
        |s| Some(s.tape_margin_m), |s, v| s.tape_margin_m = v),
    key("glue_mm", 1e-3, [1e-3, 5.0], "thickness of the glue film", |s| Some(s.glue_m), |s, v| s.glue_m = v),
    key("glue_e_mpa", 1e6, [1e-3, 1e4], "Young's modulus of the glue", |s| Some(s.glue_e_pa), |s, v| s.glue_e_pa = v),
    key("nu12", 1.0, [0.0, 0.9], "contraction along fill per stretch along warp of an anisotropic fabric",
        |s| s.nu12, |s, v| s.nu12 = Some(v)),
    key("sheet_mm", 1e-3, [1e-3, 5.0], "thickness of the actuator's sheet", |s| s.sheet_m, |s, v| s.sheet_m = Some(v)),
    key("sheet_e_mpa", 1e6, [0.1, 1e5], "Young's modulus of the actuator's sheet", |s| s.sheet_e_pa, |s, v| s.sheet_e_pa = Some(v)),
    key("body_sheet_mm", 1e-3, [1e-3, 5.0], "thickness of the body's sheet", |s| s.body_sheet_m, |s, v| s.body_sheet_m = Some(v)),
    key("body_sheet_e_mpa", 1e6, [0.1, 1e5], "Young's modulus of the body's sheet",
        |s| s.body_sheet_e_pa, |s, v| s.body_sheet_e_pa = Some(v)),
    key("weld_strength_n_per_m", 1.0, [1.0, 1e6], "force per length that a weld carries",
        |s| s.weld_strength_n_per_m, |s, v| s.weld_strength_n_per_m = Some(v)),
    key("density_kg_m3", 1.0, [50.0, 2e4], "mass per volume of fabrics, tape and glue",
        |s| Some(s.density_kg_m3), |s, v| s.density_kg_m3 = v),
    key("body_ramp_s", 1.0, [1e-4, 1e3], "duration of the body's ramp", |s| Some(s.body_ramp_s), |s, v| s.body_ramp_s = v),
    key("actuator_ramp_s", 1.0, [1e-4, 1e3], "duration of the actuator's ramp to its highest pressure, holds left out",
        |s| Some(s.actuator_ramp_s), |s, v| s.actuator_ramp_s = v),
    key("ramp_floor_kpa", 1e3, [1e-3, 1e6], "pressure from which the actuator's grows by equal shares in equal times",
        |s| s.ramp_floor_pa, |s, v| s.ramp_floor_pa = Some(v)),
    key("hold_s", 1.0, [0.0, 1e3], "time at each pressure before the robot is watched", |s| Some(s.hold_s), |s, v| s.hold_s = v),
    key("rest_s", 1.0, [0.0, 1e3], "longest time that a hold then waits until the tip is at rest; six times the ramp unless written",
        |s| s.rest_s, |s, v| s.rest_s = Some(v)),
    key("mass_factor", 1.0, [1.0, 1e4], "square of the step over the time of sound through the smallest element",
        |s| s.mass_factor, |s, v| s.mass_factor = Some(v)),
    key("mass_passes", 1.0, [2.0, 6.0], "passes of the selective masses, 2, 4 or 6: more allow longer steps and make longer waves heavy",
        |s| s.mass_passes.map(|n| n as f64), |s, v| s.mass_passes = Some(v as usize)),
    key("creep", 1.0, [1e-6, 1.0], "movement of the tip that a hold does not wait for, over its displacement",
        |s| Some(s.creep), |s, v| s.creep = v),
    key("cfl", 1.0, [1e-3, 1.0], "share of the stable step that is used", |s| Some(s.cfl), |s, v| s.cfl = v),
    key("viscosity", 1.0, [0.0, 10.0], "in-plane viscosity as a share of critical damping of the highest mode",
        |s| Some(s.viscosity), |s, v| s.viscosity = v),
    key("mass_damping_1_s", 1.0, [0.0, 1e5], "mass damping; 1.4 times the tip's lowest frequency unless written",
        |s| s.mass_damping_1_s, |s, v| s.mass_damping_1_s = Some(v)),
    key("hourglass", 1.0, [0.0, 1.0], "hourglass coefficient", |s| Some(s.hourglass), |s, v| s.hourglass = v),
    key("guard_hourglass", 1.0, [0.0, 1.0], "share of the stored energy that hourglass control may hold at the end",
        |s| Some(s.guard_hourglass), |s, v| s.guard_hourglass = v),
    key("imperfection", 1.0, [0.0, 0.2], "random offset of the nodes over the element size",
        |s| Some(s.imperfection), |s, v| s.imperfection = v),
    key("waviness_mm", 1e-3, [0.0, 1.0], "departure of the sewn shape from the pattern, root mean square along each axis",
        |s| Some(s.waviness_m), |s, v| s.waviness_m = v),
    key("seed", 1.0, [0.0, 4e15], "seed of imperfection and waviness_mm", |s| Some(s.seed as f64), |s, v| s.seed = v as u64),
];

/// Keys that a study of the numerics varies: settings of the computation, on which no tip should depend, and the length of wrinkles.
#[rustfmt::skip]
pub const NUMERICAL: [&str; 16] = [
    "ring_spacing", "seam_row_mm", "layer_gap_mm", "wrinkle_length", "body_ramp_s", "actuator_ramp_s", "ramp_floor_kpa", "hold_s",
    "rest_s", "creep", "mass_factor", "cfl", "viscosity", "mass_damping_1_s", "hourglass", "imperfection",
];

/// Keys that are no single number.
pub const OTHERS: [&str; 13] = [
    "model",
    "taped",
    "pressures_kpa",
    "separate",
    "meshes_mm",
    "base",
    "contact",
    "selective_mass",
    "tip_force_n",
    "gravity_m_s2",
    "obstacle_mm",
    "obstacle_friction",
    "obstacle_moves_mm",
];

impl RobotSettings {
    /// Refuses numbers that cannot be meant.
    ///
    /// # Errors
    /// [`FemError::Problem`] with the name, the number and the accepted range.
    pub fn check(&self) -> Result<()> {
        for key in KEYS {
            let Some(value) = (key.get)(self).map(|value| value / key.si) else { continue };
            let [low, high] = key.bounds;
            // NaN is outside, too.
            if !(low * (1.0 - 1e-12)..=high * (1.0 + 1e-12)).contains(&value) {
                let message = format!("robot: {} is {value}; write a number from {low} to {high}", key.name);
                return Err(FemError::Problem(message));
            }
        }
        if !(0.0..=1e6).contains(&self.actuator_pa) {
            let message = format!("robot: the actuator's pressure is {} Pa; 0 to 1e6 are accepted", self.actuator_pa);
            return Err(FemError::Problem(message));
        }
        Ok(())
    }
}
