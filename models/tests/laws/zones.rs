//! Zones, channels and segments of unequal length.

use crate::support::*;
use models::{Loads, Model, Scenario};

fn with_zones(actuator: &str, zones: &str) -> Scenario {
    let text = format!("{}\n{zones}", models::shipped(actuator).unwrap());
    Scenario { zones: Scenario::parse(&text).unwrap().zones, ..robot(actuator) }
}

fn differ(a: &Scenario, b: &Scenario, loads: &Loads) -> f64 {
    let (a, b) = (predicted(&Model::new(a), loads).unwrap(), predicted(&Model::new(b), loads).unwrap());
    a.markers.iter().flatten().zip(b.markers.iter().flatten()).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

#[test]
fn two_zones_of_equal_design_are_one() {
    for actuator in actuators() {
        let zones = "[[zone]]\nfrom_mm = 0\nto_mm = 140\n[[zone]]\nfrom_mm = 140\nto_mm = 360\n";
        let (one, two) = (robot(actuator), with_zones(actuator, zones));
        for p in [1e3, 10e3, 30e3] {
            let error = differ(&one, &two, &Loads::uniform(2e3, p));
            assert!(error < 1e-12, "{actuator} {p}: {error:e} m");
        }
    }
}

#[test]
fn an_unequal_division_under_load_agrees_with_an_equal_one() {
    for actuator in actuators() {
        let zones = "[[zone]]\nfrom_mm = 37\nto_mm = 151\n[[zone]]\nfrom_mm = 151\nto_mm = 360\n";
        let fine = |mut s: Scenario| {
            s.segments = 200;
            s.with_bending(0.8).with_effect("gravity", &[1.0]).with_effect("tip_load", &[0.1, -0.2])
        };
        let error = differ(&fine(robot(actuator)), &fine(with_zones(actuator, zones)), &Loads::uniform(2e3, 15e3));
        assert!(error < 2e-6, "{actuator}: {error:e} m");
    }
}

#[test]
fn a_passive_zone_is_straight() {
    for actuator in actuators() {
        let scenario = with_zones(actuator, "[[zone]]\nfrom_mm = 120\nto_mm = 240\npassive = true\n");
        let model = Model::new(&scenario);
        let at = predicted(&model, &Loads::uniform(2e3, 30e3)).unwrap();
        for (segment, kappa) in model.curvatures(&at) {
            let passive = segment.start_m > 0.1199 && segment.start_m + segment.length_m < 0.2401;
            assert_eq!(kappa == 0.0, passive || model.assembly().sites[segment.site].actuator.is_none(), "{actuator}");
        }
        let [a, b] = [at.markers[2], at.markers[3]];
        assert!(((b[0] - a[0]).hypot(b[1] - a[1]) - 0.06).abs() < 1e-14, "markers at 150 and 210 mm are 60 mm apart");
    }
}

#[test]
fn each_channel_drives_its_own_zone() {
    for actuator in actuators() {
        let zones = "[[zone]]\nfrom_mm = 0\nto_mm = 180\n[[zone]]\nfrom_mm = 180\nto_mm = 360\nchannel = 2\n";
        let model = Model::new(&with_zones(actuator, zones));
        let mut loads = Loads::uniform(2e3, 0.0);
        loads.actuator_pa[2] = 20e3;
        let at = predicted(&model, &loads).unwrap();
        for (segment, kappa) in model.curvatures(&at) {
            let driven = model.assembly().sites[segment.site].actuator.is_some() && segment.start_m > 0.179;
            assert_eq!(kappa > 0.1, driven, "{actuator} at {}", segment.start_m);
        }
        let slopes = model.jacobian(&loads, &mut model.prediction()).unwrap();
        assert!(slopes[2].y_per_pa > 0.0 && slopes[1].y_per_pa == 0.0 && slopes[3].y_per_pa == 0.0);
        assert!(slopes[0].y_per_pa.is_nan(), "a flat pouch rises with an infinite slope: none is given");
    }
}

#[test]
fn a_robot_without_markers_or_with_one_segment_predicts() {
    let mut scenario = everything("epam").with_markers(&[]);
    scenario.segments = 1;
    let at = predict(&scenario, 2e3, 20e3);
    assert!(at.markers.is_empty() && at.tip.y_m.is_finite());
}
