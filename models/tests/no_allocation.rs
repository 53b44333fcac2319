//! Predicting allocates nothing after set-up: counted by an instrumented allocator.

#![allow(clippy::unwrap_used)]

use models::actuators::ACTUATORS;
use models::effects::EFFECTS;
use models::{Aim, Limits, Loads, Model, Scenario, Step, Target, shipped};
use stats_alloc::{INSTRUMENTED_SYSTEM, Region, StatsAlloc};
use std::alloc::System;

#[global_allocator]
static COUNTING: &StatsAlloc<System> = &INSTRUMENTED_SYSTEM;

/// An effect of the scenario's own, switched on.
const FORMULA: &str = r#"
[[formula]]
name = "cubic_spring"
moment = "-k*theta^3 * exp(-s/R)"
[formula.parameters.k]
unit = "N m"
typical = 0.5
bounds = [0, 20]
[effects.cubic_spring]
k = 0.5
"#;

/// Every applicable effect at its typical value.
fn everything(scenario: &Scenario) -> Scenario {
    let family = scenario.actuator.kind.family;
    let effects = EFFECTS.iter().filter(|e| e.applies_to(family));
    effects.fold(scenario.with_bending(0.7), |s, e| s.with_effect(e.name, &e.typical()))
}

fn allocations(work: impl FnOnce()) -> usize {
    let region = Region::new(COUNTING);
    work();
    let change = region.change();
    change.allocations + change.reallocations
}

// Without the test harness, whose own thread allocates at any time and would be counted too.
fn main() {
    assert!(allocations(|| drop(std::hint::black_box(vec![1.0]))) > 0, "the counter counts");
    for name in ACTUATORS.iter().map(|actuator| actuator.name) {
        let shipped = Scenario::parse(shipped(name).unwrap()).unwrap();
        let with_formula = Scenario::parse(&(self::shipped(name).unwrap().to_string() + FORMULA)).unwrap();
        for scenario in [shipped.bare(), shipped.clone(), everything(&shipped), everything(&with_formula)] {
            let model = Model::new(&scenario);
            let mut out = model.prediction();
            let sweep: Vec<Loads> = (0..50).map(|i| Loads::uniform(2e3, 1e3 * f64::from(i))).collect();
            let (mut batch, mut steering) = (model.batch(sweep.len(), 1), model.steering());
            let found = allocations(|| {
                for loads in &sweep {
                    model.predict(loads, &mut out).unwrap();
                }
                let target = Target::TipHeight(out.tip.y_m);
                model.pressure_for(target, 2e3, &mut out).unwrap();
                model.pressure_for(Target::Angle(0.02), 2e3, &mut out).unwrap();
                model.jacobian(&sweep[20], &mut out).unwrap();
                model.steer(Aim::Tip([0.3, 0.1]), 2e3, &Limits::up_to(50e3), &mut steering).unwrap();
                model.predict_batch(&sweep, &mut batch).unwrap();
            });
            assert_eq!(found, 0, "allocations in predict, inverse, Jacobian, steering or batch of {name}");
            let steps: Vec<Step> =
                sweep.iter().enumerate().map(|(i, loads)| Step { t_s: i as f64, loads: *loads }).collect();
            let found = allocations(|| model.follow(&steps, &mut out, &mut |_, _| ()).unwrap());
            assert_eq!(found, 0, "allocations in a protocol of {name}");
        }
    }
    println!("predict, inverse, Jacobian, steering, batch and protocol allocate nothing after set-up");
}
