//! Fabric muscles against the ideal braid and exact tubes.

#![allow(clippy::unwrap_used)]

use models::actuators::{ActuatorShape, by_name};
use models::fabrics::Orthotropic;
use models::{Machine, Scenario, shipped};
use std::f64::consts::PI;
use verification::exact::mckibben::{max_contraction, tondu_lopez_force_n};
use verification::exact::tube::{ClosedTube, Ends, inflate};

fn shape(bias_deg: f64) -> ActuatorShape {
    let bias_rad = bias_deg.to_radians();
    ActuatorShape { length_m: 0.3, width_m: 0.06, fold_m: 0.0, volume_gain: 1.0, bias_rad }
}

/// The shipped muscle without any effects.
fn fpam() -> Scenario {
    Scenario::parse(shipped("fpam").unwrap()).unwrap().bare()
}

/// Free contraction of it with effects of one parameter each.
fn free_contraction(effects: &[(&str, f64)], p_act_pa: f64) -> f64 {
    let muscle = effects.iter().fold(fpam(), |muscle, (name, value)| muscle.with_effect(name, &[*value]));
    Machine::new(&muscle).unwrap().free_contraction(p_act_pa)
}

#[test]
fn the_force_at_any_bias_angle_is_that_of_a_braid_and_ends_at_the_magic_angle() {
    let radius_m = 0.06 / PI;
    for bias_deg in [20.0_f64, 30.0, 42.5, 45.0, 50.0] {
        let (shape, bias) = (shape(bias_deg), bias_deg.to_radians());
        let force = |contraction: f64| 30e3 * (by_name("fpam").unwrap().stroke)(&shape, contraction).d_volume;
        let at_rest = PI * radius_m.powi(2) * 30e3 * (3.0 * bias.cos().powi(2) - 1.0) / bias.sin().powi(2);
        assert!((force(0.0) / at_rest - 1.0).abs() < 1e-12, "{bias_deg}");
        for contraction in [-0.02, 0.0, 0.05, 0.1] {
            let braid = tondu_lopez_force_n(radius_m, bias, contraction, 30e3, 1.0);
            assert!((force(contraction) - braid).abs() < 1e-11 * at_rest, "{bias_deg} {contraction}");
        }
        let free = 1.0 - 1.0 / (3.0_f64.sqrt() * bias.cos());
        assert!(force(free).abs() < 1e-11 * at_rest && (free - max_contraction(bias)).abs() < 1e-15, "{bias_deg}");
    }
}

#[test]
fn a_muscle_without_effects_is_the_ideal_braid_at_any_angle() {
    for degrees in [20.0_f64, 33.0, 45.0] {
        let mut muscle = fpam();
        muscle.actuator.shape.bias_rad = degrees.to_radians();
        let radius = muscle.actuator.shape.width_m / std::f64::consts::PI;
        let machine = Machine::new(&muscle).unwrap();
        for e in [-0.02, 0.0, 0.05, 0.11] {
            let exact = tondu_lopez_force_n(radius, degrees.to_radians(), e, 3e4, 1.0);
            assert!((machine.pull_n(3e4, e).unwrap() / exact - 1.0).abs() < 1e-9, "{degrees} {e}");
        }
        assert!((machine.free_contraction(3e4) - max_contraction(degrees.to_radians())).abs() < 1e-9);
        assert_eq!((machine.pull_n(0.0, 0.1), machine.free_contraction(0.0)), (Some(0.0), 0.0));
        assert!(machine.pull_n(3e4, 0.7).is_none());
    }
}

#[test]
fn a_free_tube_with_yarns_that_give_is_the_exact_closed_tube() {
    let (e_pa, thickness_m) = (108.25e6, 50e-6);
    for (nu, p) in [(0.0, 3e3), (0.0, 30e3), (0.2, 30e3), (0.3, 60e3)] {
        let fabric = Orthotropic::new(e_pa, e_pa, nu, 1.0, thickness_m);
        let tube = ClosedTube { radius_m: 0.06 / PI, warp_angle: PI / 4.0, fabric: &fabric };
        let exact = inflate(&tube, p, Ends::Free(0.0)).unwrap().contraction();
        let free = free_contraction(&[("yarn_stretch", (1.0 - nu) / (e_pa * thickness_m))], p);
        assert!((free - exact).abs() < 2e-6, "{nu} {p}: {free} {exact}");
    }
}

#[test]
fn shear_in_the_cell_is_that_of_the_exact_tube() {
    let (e_pa, thickness_m, shear_n_per_m) = (108.25e6, 50e-6, 51.4);
    let fabric = Orthotropic::new(e_pa, e_pa, 0.0, shear_n_per_m / thickness_m, thickness_m);
    let tube = ClosedTube { radius_m: 0.06 / PI, warp_angle: PI / 4.0, fabric: &fabric };
    for p in [3e3, 10e3, 30e3] {
        let exact = inflate(&tube, p, Ends::Free(0.0)).unwrap().contraction();
        let free =
            free_contraction(&[("yarn_stretch", 1.0 / (e_pa * thickness_m)), ("shear_stiffness", shear_n_per_m)], p);
        // The hoop does not feel the shear here: of the order G_t c.
        assert!((free - exact).abs() < 2.0 * shear_n_per_m / (e_pa * thickness_m) * exact, "{p}: {free} {exact}");
    }
}
