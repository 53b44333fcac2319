//! Effects commute: geometry is decided in one place, and a permutation of the effects of a robot changes nothing.

use crate::support::*;
use models::effects::Stage;
use models::{Loads, Model, Scenario};

/// Tip of a robot after a step of pressure, with the time in a hold.
fn tip(scenario: &Scenario) -> Option<[f64; 3]> {
    let model = Model::new(scenario);
    let mut at = model.prediction();
    model.predict_held(&Loads::uniform(2e3, 25e3), &mut at).ok()?;
    Some([at.tip.x_m, at.tip.y_m, at.tip.angle_rad])
}

fn permuted(scenario: &Scenario, random: &mut Random) -> Scenario {
    let mut other = scenario.clone();
    for i in (1..other.effects.len()).rev() {
        other.effects.swap(i, (random.unit() * (i + 1) as f64) as usize);
    }
    other
}

fn hold(scenario: &Scenario, random: &mut Random) -> bool {
    let before = tip(scenario);
    for _ in 0..4 {
        let other = permuted(scenario, random);
        match (before, tip(&other)) {
            (Some(a), Some(b)) => assert!(a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-9), "{:?}", other.effects),
            (a, b) => assert_eq!(a.is_some(), b.is_some(), "{:?}", other.effects),
        }
    }
    before.is_some()
}

#[test]
fn permuted_effects_of_full_robots_and_of_random_ones_give_the_same_pose() {
    let (mut random, mut solved) = (Random(52), 0);
    for actuator in actuators() {
        assert!(hold(&full(actuator), &mut random), "{actuator}");
        for _ in 0..60 {
            let base = full(actuator).with_bending(0.5);
            let some = applicable(&base).filter(|e| e.stage != Stage::Camera && random.unit() < 0.25);
            let chosen: Vec<_> = some.map(|e| (e.name, e.typical())).collect();
            let scenario = chosen.iter().fold(base.clone(), |s, (name, values)| s.with_effect(name, values));
            solved += usize::from(hold(&scenario, &mut random));
        }
    }
    assert!(solved > 120, "{solved}");
}

/// The wall around a pouch is one section: how wide its welds are changes nothing of the arm, nor of the wall that its sides pull.
#[test]
fn the_section_of_the_wall_does_not_depend_on_the_welds() {
    let site = |weld_m: f64| {
        let model = Model::new(&full("epam").with_effect("weld_width", &[weld_m]));
        let site = model.assembly().sites.iter().find(|site| site.actuator.is_some()).unwrap();
        (site.linkage.arm_m, site.area_m2)
    };
    assert_eq!(site(1e-3), site(6e-3));
}
