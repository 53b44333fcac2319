use super::*;
use crate::actuators::ACTUATORS;
use crate::term::{Account, LedgerLine};

struct NoValue;

impl Term for NoValue {
    fn line(&self) -> LedgerLine {
        LedgerLine::new("bending", Account::Wall)
    }

    fn add(&self, _: &Pose, force: &mut [f64]) -> f64 {
        force[actuator_q::COORDINATE] = f64::NAN;
        f64::NAN
    }
}

#[test]
fn the_start_value_of_a_place_without_effects_is_its_equilibrium_also_with_a_growing_arm() {
    for actuator in ACTUATORS {
        for (stiffness, arm_growth) in [(0.0, 0.0), (0.0, 1.0), (1.35, 0.0), (1.35, 0.5), (0.3, 2.0)] {
            let shape = ActuatorShape {
                length_m: 0.06,
                width_m: 0.07,
                fold_m: 0.0,
                volume_gain: 1.2,
                bias_rad: std::f64::consts::FRAC_PI_4,
            };
            let linkage = Linkage {
                active_fraction: 0.9,
                stroke_fraction: 0.95,
                arm_m: 0.08,
                arm_growth,
                compliance_per_n: 0.0,
                section: None,
            };
            let body = BodyPressure { radius_m: 0.04, hinge_curvature: 1e-4, share: 1.0 };
            let mut site = Site::new(0.04, body, WallBending { stiffness }, linkage, Some(actuator), shape, 0);
            for p_act_pa in [5e3, 2e4, 1e5] {
                let loads = SiteLoads { p_body_pa: 2e3, p_act_pa, moment: 0.01, s_m: 0.0, dt_s: 0.0, stamp: 0 };
                let start = site.start(actuator, &loads, &[]);
                let imbalance = |a: f64| site.balance(actuator, a, &loads, &[]).imbalance;
                let slope = (imbalance(start.x + 1e-5) - imbalance(start.x - 1e-5)) / 2e-5;
                assert!((imbalance(start.x) / slope).abs() < 1e-14, "{} {stiffness} {arm_growth}", actuator.name);
                assert!((start.slope / slope - 1.0).abs() < 1e-7, "{} {stiffness} {arm_growth}", actuator.name);
            }
            site.act(NoValue, SideEffects::SHIFT);
            assert_eq!(site.without_value(&SiteLoads::new(2e3, 2e4)), Some("bending"));
        }
    }
}

/// A law without a value would let the search for the balance end anywhere.
#[test]
fn every_law_of_a_shipped_robot_has_a_value_in_narrow_and_wide_pouches() {
    for robot in ["spam", "cpam", "epam"] {
        for width_mm in [20, 40, 80, 100, 110, 120] {
            let text = crate::shipped(robot).unwrap().replace("width_mm = 60", &format!("width_mm = {width_mm}"));
            let Ok(scenario) = crate::Scenario::parse(&text) else { continue };
            let model = crate::Model::new(&scenario);
            for p in [2001.0, 2.3e3, 3e3, 6e3, 3e4] {
                let found = model.assembly().sites[0].without_value(&SiteLoads::new(2e3, p));
                assert_eq!(found, None, "{robot} {width_mm} mm {p} Pa");
            }
        }
    }
}
