//! Tables over the pressure: within what they are allowed, or refused.

use crate::support::*;
use models::export::{MOST_BYTES, MOST_MISS, Table, Untabulated};
use models::{Loads, Model, Scenario, shipped};

#[test]
fn the_table_of_every_robot_is_small_and_near() {
    for actuator in actuators() {
        let scenario = full(actuator);
        let model = Model::new(&scenario);
        let table = Table::new(&model, 2e3, [0.0, 40e3]).unwrap();
        assert!(table.bytes() <= MOST_BYTES && table.bound.tip_m <= 1e-3 * 0.36, "{actuator}: {:?}", table.bound);
        // Markers of the muscle do not fit.
        assert!(table.markers() == scenario.markers_m.len() || actuator == "fpam", "{actuator}");
        if actuator == "epam" {
            assert!(table.bytes() <= 2048, "with its code in 3 kB of a Cortex-M4F: {} bytes", table.bytes());
        }
        let mut random = Random(3);
        for p in (0..500).map(|_| random.between(0.0, 40e3)) {
            let tip = predicted(&model, &Loads::uniform(2e3, p)).unwrap().tip;
            let miss = (table.at(p, 0)[0] - tip.x_m).hypot(table.at(p, 1)[0] - tip.y_m);
            assert!(miss <= table.bound.tip_m, "{actuator} at {p}: {miss:e}, stated {:e}", table.bound.tip_m);
        }
    }
}

/// A stretch of wall that lets go at one pressure.
#[test]
fn a_jump_is_refused_with_its_pressure() {
    let formula = "\n[[formula]]\nname = \"catch\"\nmoment = \"-A*step(p_act/Pj - 1)\"\n[formula.parameters.A]\n\
                   unit = \"N m\"\ntypical = 0.1\nbounds = [0, 1]\n[formula.parameters.Pj]\nunit = \"kPa\"\n\
                   neutral = 20\ntypical = 20\nbounds = [1, 100]\n[effects.catch]\nA = 0.1\n";
    let jumps = Scenario::parse(&(shipped("epam-textbook").unwrap().to_string() + formula)).unwrap();
    let error = Table::new(&Model::new(&jumps), 2e3, [0.0, 40e3]).unwrap_err();
    let Untabulated::TooRough { at_kpa } = error else { panic!("{error}") };
    assert!((at_kpa - 20.0).abs() < 1e-3, "{at_kpa}");
    assert!(Table::new(&Model::new(&jumps), 2e3, [0.0, 19.9e3]).is_ok());
}

#[test]
fn what_is_allowed_is_what_is_promised() {
    assert_eq!((MOST_BYTES, MOST_MISS), (4096, 1e-3));
}
