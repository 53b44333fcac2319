//! Oracles of the closed cylinder: local equilibrium of the deformed wall solved with 30 digits.

use std::f64::consts::{FRAC_PI_4, PI};

use super::super::tube::{ClosedTube, Ends, Inflated, axial_pull_n, inflate};
use super::{OracleRow, section};
use models::fabrics::{Fabric, NeoHookean, Orthotropic};

/// Rows of [`super::super::tube`].
pub fn rows() -> Vec<OracleRow> {
    [bias(), isotropic(), neo_hookean()].concat()
}

/// Yarns 96.5 and 120 MPa, G = 1.032 MPa, 0.05 mm, flat width 60 mm, ±45°: the fabric muscle far from its ends.
fn bias() -> Vec<OracleRow> {
    let fabric = |nu12| Orthotropic::new(96.5e6, 120e6, nu12, 1.032e6, 5e-5);
    let (plain, coupled) = (fabric(0.0), fabric(0.3));
    let free = |fabric: &Orthotropic, pressure_pa| state(fabric, FRAC_PI_4, 0.06 / PI, pressure_pa, Ends::Free(0.0));
    let held = state(&coupled, FRAC_PI_4, 0.06 / PI, 10e3, Ends::Held(0.95));
    let tube = ClosedTube { radius_m: 0.06 / PI, warp_angle: FRAC_PI_4, fabric: &coupled };
    section(
        "bias tube, 60 mm flat, free ends",
        [
            ("ε, ν12 = 0, 3 kPa", "0.07469742328", free(&plain, 3e3).contraction()),
            ("ε, ν12 = 0, 5 kPa", "0.09394092385", free(&plain, 5e3).contraction()),
            ("ε, ν12 = 0, 10 kPa", "0.1105363763", free(&plain, 10e3).contraction()),
            ("ε, ν12 = 0, 20 kPa", "0.1059276908", free(&plain, 20e3).contraction()),
            ("ε, ν12 = 0, 30 kPa", "0.08836973498", free(&plain, 30e3).contraction()),
            ("hoop stretch, ν12 = 0, 30 kPa", "1.243036905", free(&plain, 30e3).hoop_stretch),
            ("slide g, ν12 = 0, 30 kPa", "0.0147253729", free(&plain, 30e3).slide),
            ("ε, ν12 = 0.3, 3 kPa", "0.07737792835", free(&coupled, 3e3).contraction()),
            ("ε, ν12 = 0.3, 10 kPa", "0.1192365661", free(&coupled, 10e3).contraction()),
            ("ε, ν12 = 0.3, 20 kPa", "0.1232706136", free(&coupled, 20e3).contraction()),
            ("ε, ν12 = 0.3, 30 kPa", "0.1146620199", free(&coupled, 30e3).contraction()),
            ("slide g, ν12 = 0.3, 30 kPa", "0.01417037151", free(&coupled, 30e3).slide),
            ("hoop stretch, held at 0.95, 10 kPa", "1.08779311939", held.hoop_stretch),
            ("pull, held at 0.95, 10 kPa [N]", "5.4724855983", axial_pull_n(&tube, 10e3, &held)),
        ],
    )
}

fn isotropic() -> Vec<OracleRow> {
    let fabric = Orthotropic::isotropic(208e6, 0.3, 2e-4);
    let at = |pressure_pa| state(&fabric, 0.0, 0.04, pressure_pa, Ends::Free(0.0));
    section(
        "closed tube, isotropic linear, R = 40 mm, Et = 41.6 kN/m",
        [
            ("axial strain, 2 kPa", "0.00038708719990", at(2e3).axial_stretch - 1.0),
            ("hoop strain, 2 kPa", "0.0016331951040", at(2e3).hoop_stretch - 1.0),
            ("axial strain, 20 kPa", "0.0040880659021", at(2e4).axial_stretch - 1.0),
            ("hoop strain, 20 kPa", "0.0162112128295", at(2e4).hoop_stretch - 1.0),
        ],
    )
}

fn neo_hookean() -> Vec<OracleRow> {
    let fabric = NeoHookean { c10_pa: 208e6 / 6.0, thickness_m: 2e-4 };
    let at = |pressure_pa, pull_n| state(&fabric, 0.0, 0.04, pressure_pa, Ends::Free(pull_n));
    section(
        "closed tube, neo-Hookean, R = 40 mm, 6 C10 t = 41.6 kN/m",
        [
            ("hoop stretch, 2 kPa", "1.001446834507", at(2e3, 0.0).hoop_stretch),
            ("axial stretch, 100 kPa", "1.0048702874306", at(1e5, 0.0).axial_stretch),
            ("hoop stretch, 100 kPa", "1.0867007993558", at(1e5, 0.0).hoop_stretch),
            ("axial stretch, 200 kPa", "1.033741048492", at(2e5, 0.0).axial_stretch),
            ("hoop stretch, 200 kPa", "1.233966553723", at(2e5, 0.0).hoop_stretch),
            ("axial stretch, 100 kPa, pushed with 200 N", "0.985885038074", at(1e5, -200.0).axial_stretch),
            ("hoop stretch, 100 kPa, pushed with 200 N", "1.095009152024", at(1e5, -200.0).hoop_stretch),
        ],
    )
}

fn state(fabric: &dyn Fabric, warp_angle: f64, radius_m: f64, pressure_pa: f64, ends: Ends) -> Inflated {
    let none = Inflated { axial_stretch: f64::NAN, hoop_stretch: f64::NAN, slide: f64::NAN };
    inflate(&ClosedTube { radius_m, warp_angle, fabric }, pressure_pa, ends).unwrap_or(none)
}
