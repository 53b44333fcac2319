//! Friction, creep, set and leak: what a protocol leaves behind, and where its work went.

use crate::support::*;
use models::effects::{EFFECTS, Stage, by_name};
use models::term::RowKind;
use models::{Loads, Model, Pose, Prediction, Remembering, Scenario, Step};

const BODY: f64 = 2e3;

/// A protocol from pressures [kPa] held for `hold_s` each, looked at `samples` times in every hold.
fn protocol(kpa: &[f64], hold_s: f64, samples: usize) -> Vec<Step> {
    let step = |i: usize, p: f64, k: usize| Step {
        t_s: hold_s * (i as f64 + (k + 1) as f64 / samples as f64),
        loads: Loads::uniform(BODY, 1e3 * p),
    };
    kpa.iter().enumerate().flat_map(|(i, p)| (0..samples).map(move |k| step(i, *p, k))).collect()
}

/// Every pressure held for `hold_s` and looked at twice: when it has just been set, and at the end.
fn set_and_held(kpa: &[f64], hold_s: f64) -> Vec<Step> {
    let step = |i: usize, p: f64, k: usize| Step { t_s: hold_s * (i + k) as f64, loads: Loads::uniform(BODY, 1e3 * p) };
    kpa.iter().enumerate().flat_map(|(i, p)| (0..2).map(move |k| step(i, *p, k))).collect()
}

/// One value per state of a protocol.
fn walk(scenario: &Scenario, steps: &[Step], value: fn(&Model, &Step, &Prediction) -> f64) -> Vec<f64> {
    let model = Model::new(scenario);
    let mut values = Vec::new();
    let mut take = |i: usize, at: &Prediction| values.push(value(&model, &steps[i], at));
    model.follow(steps, &mut model.prediction(), &mut take).unwrap();
    values
}

fn height(_: &Model, _: &Step, at: &Prediction) -> f64 {
    at.tip.y_m
}

fn heights(scenario: &Scenario, steps: &[Step]) -> Vec<f64> {
    walk(scenario, steps, height)
}

/// Sum of the ledger's lines of a kind, and of one name if given.
fn energy(model: &Model, step: &Step, at: &Prediction, kind: RowKind, name: Option<&str>) -> f64 {
    let lines = model.ledger(&step.loads, at);
    lines.iter().filter(|l| l.kind == kind && name.is_none_or(|name| l.name == name)).map(|l| l.energy_j).sum()
}

fn lost(model: &Model, step: &Step, at: &Prediction) -> f64 {
    energy(model, step, at, RowKind::Dissipated, None)
}

/// What everything but the actuator's pressure stores.
fn stored(model: &Model, step: &Step, at: &Prediction) -> f64 {
    energy(model, step, at, RowKind::Stored, None) + step.loads.actuator_pa[0] * volume(model, step, at)
}

fn volume(model: &Model, step: &Step, at: &Prediction) -> f64 {
    -energy(model, step, at, RowKind::Stored, Some("actuator_pressure")) / step.loads.actuator_pa[0]
}

/// A robot with every effect that has history, at typical values.
fn remembering(actuator: &str) -> Scenario {
    let names = ["plastic_set", "friction", "creep"];
    let typical = |s: Scenario, name: &&str| s.with_effect(name, &by_name(name).unwrap().typical());
    names.iter().fold(robot(actuator).with_bending(1.0), typical)
}

/// Pressures up and down twice between 4 and 30 kPa, in `count` parts per way.
fn loops(count: usize) -> Vec<f64> {
    let way = |k: usize| 4.0 + 26.0 * k as f64 / count as f64;
    let up_down = || (0..count).chain((1..=count).rev()).map(way);
    up_down().chain(up_down()).chain([4.0]).collect()
}

/// Work of the actuator's pressure over the steps by the trapezoidal rule \[J\].
fn pressure_work(steps: &[Step], volumes: &[f64]) -> f64 {
    let p = |i: usize| steps[i].loads.actuator_pa[0];
    (1..volumes.len()).map(|i| 0.5 * (p(i) + p(i - 1)) * (volumes[i] - volumes[i - 1])).sum()
}

/// Work put in, and what of it the ledger does not find again, over all states from the first.
fn balance(scenario: &Scenario, steps: &[Step]) -> (f64, f64) {
    let (volumes, stored, lost) =
        (walk(scenario, steps, volume), walk(scenario, steps, stored), walk(scenario, steps, lost));
    let last = steps.len() - 1;
    let work = pressure_work(steps, &volumes);
    (work, work - (stored[last] - stored[0]) - (lost[last] - lost[0]))
}

#[test]
fn the_pressures_work_is_what_is_stored_and_lost() {
    for actuator in actuators() {
        for (name, scenario) in [
            ("friction", robot(actuator).with_bending(1.0).with_effect("friction", &[0.3])),
            ("plastic_set", robot(actuator).with_bending(1.0).with_effect("plastic_set", &[0.3])),
            ("creep", robot(actuator).with_bending(1.0).with_effect("creep", &[0.8, 3.0])),
            ("all", remembering(actuator)),
        ] {
            let error = |count| {
                let (work, missing) = balance(&scenario, &set_and_held(&loops(count), 20.0 / count as f64));
                missing.abs() / work.abs()
            };
            // The trapezoidal rule's own error falls with the square of the step, over the corners of friction a little less.
            let (coarse, fine) = (error(60), error(240));
            assert!(fine < 2e-3 && fine < 0.25 * coarse, "{actuator} {name}: {coarse:e} {fine:e}");
        }
    }
}

#[test]
fn a_closed_loop_loses_its_area_and_never_less_than_nothing() {
    for actuator in actuators() {
        let scenario = robot(actuator).with_bending(1.0).with_effect("friction", &[0.3]);
        let count = 400;
        let steps = protocol(&loops(count), 1.0, 1);
        let (volumes, lost) = (walk(&scenario, &steps, volume), walk(&scenario, &steps, lost));
        assert!(lost.windows(2).all(|pair| pair[1] >= pair[0]), "{actuator}: what is lost stays lost");
        // The second loop starts and ends in the same state: at 4 kPa, coming down.
        let (from, to) = (2 * count, 4 * count);
        let area = pressure_work(&steps[from..], &volumes[from..]);
        let loss = lost[to] - lost[from];
        assert!((volumes[to] / volumes[from] - 1.0).abs() < 1e-9, "{actuator}: the loop is closed");
        assert!(loss > 1e-3 && (area / loss - 1.0).abs() < 1e-3, "{actuator}: area {area:e}, lost {loss:e}");
    }
}

#[test]
fn friction_bends_less_going_up_and_stays_bent_after_unloading() {
    for actuator in actuators() {
        let base = robot(actuator).with_bending(1.0);
        let steps = protocol(&[10.0, 20.0, 30.0, 20.0, 10.0, 0.0], 5.0, 1);
        let (free, rough) = (heights(&base, &steps), heights(&base.with_effect("friction", &[0.3]), &steps));
        assert!(
            (0..3).all(|i| rough[i] < free[i]) && (3..6).all(|i| rough[i] > free[i]),
            "{actuator}: {free:?} {rough:?}"
        );
        assert!(rough[5] > 1e-4 && rough[4] > rough[0] + 1e-3, "{actuator}: {rough:?}");
    }
}

#[test]
fn a_set_stays_after_unloading_and_grows_only_beyond_the_largest_bend() {
    for actuator in actuators() {
        // Without the body's own hinge the robot rests where the set says.
        let mut base = robot(actuator).with_bending(1.0);
        base.hinge_share = 0.0;
        let scenario = base.with_effect("plastic_set", &[0.2]);
        let angles =
            walk(&scenario, &protocol(&[20.0, 0.0, 15.0, 0.0, 30.0, 0.0], 5.0, 1), |_, _, at| at.tip.angle_rad);
        assert!((angles[1] / (0.2 * angles[0]) - 1.0).abs() < 1e-9, "{actuator}: {angles:?}");
        assert!((angles[3] / angles[1] - 1.0).abs() < 1e-9 && (angles[5] / (0.2 * angles[4]) - 1.0).abs() < 1e-9);
    }
}

#[test]
fn creep_goes_from_the_stiff_wall_to_the_relaxed_one() {
    for actuator in actuators() {
        let base = robot(actuator).with_bending(1.0);
        let creeping = base.with_effect("creep", &[0.5, 2.0]);
        let (stiff, relaxed) = (predict(&base.with_bending(1.5), BODY, 30e3), predict(&base, BODY, 30e3));
        let y =
            heights(&creeping, &[0.0, 1.0, 2.0, 5.0, 200.0].map(|t_s| Step { t_s, loads: Loads::uniform(BODY, 30e3) }));
        assert!((y[0] - stiff.tip.y_m).abs() < 1e-12, "{actuator}: at once {} {}", y[0], stiff.tip.y_m);
        assert!(y.windows(2).all(|pair| pair[1] > pair[0]), "{actuator}: {y:?}");
        assert!((y[4] - relaxed.tip.y_m).abs() < 1e-9, "{actuator}: in the end {} {}", y[4], relaxed.tip.y_m);
    }
}

#[test]
fn the_integration_of_creep_converges_with_the_square_of_the_step() {
    for actuator in actuators() {
        let scenario = robot(actuator).with_bending(1.0).with_effect("creep", &[0.5, 2.0]);
        let at_the_end = |samples: usize| heights(&scenario, &protocol(&[10.0, 30.0], 4.0, samples))[2 * samples - 1];
        let exact = at_the_end(4096);
        let errors = [32, 64, 128].map(|n| (at_the_end(n) - exact).abs());
        for pair in errors.windows(2) {
            let rate = (pair[0] / pair[1]).log2();
            assert!((rate - 2.0).abs() < 0.2, "{actuator}: {errors:?}");
        }
    }
}

#[test]
fn more_samples_in_a_hold_change_nothing_beyond_the_time_steps_own_error() {
    for actuator in actuators() {
        for (share, time_s) in [(0.25, 2.0), (2.0, 0.4), (2.0, 30.0)] {
            let scenario = robot(actuator).with_bending(1.0).with_effect("creep", &[share, time_s]);
            let ends = |samples: usize| -> Vec<f64> {
                let y = heights(&scenario, &protocol(&[10.0, 20.0, 30.0, 5.0], 5.0, samples));
                y.chunks(samples).map(|hold| hold[samples - 1]).collect()
            };
            let creep = (predict(&scenario, BODY, 30e3).tip.y_m
                - predict(&robot(actuator).with_bending(1.0), BODY, 30e3).tip.y_m)
                .abs();
            let (one, many) = (ends(1), ends(500));
            let worst = one.iter().zip(&many).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(worst < 1e-3 * creep, "{actuator} {share} {time_s}: {worst:e} of {creep:e}");
        }
        let rough = robot(actuator).with_bending(1.0).with_effect("friction", &[0.3]);
        let (one, many) = (
            heights(&rough, &protocol(&[10.0, 30.0, 0.0], 5.0, 1)),
            heights(&rough, &protocol(&[10.0, 30.0, 0.0], 5.0, 7)),
        );
        for (i, y) in one.iter().enumerate() {
            assert!(many[7 * i..7 * i + 7].iter().all(|other| other == y), "{actuator}: friction does not know time");
        }
    }
}

#[test]
fn a_leak_is_the_static_answer_at_the_sinking_pressure() {
    for actuator in actuators() {
        let base = robot(actuator).with_bending(1.0);
        let steps = protocol(&[10.0, 30.0], 5.0, 5);
        let y = heights(&base.with_effect("leak", &[0.05]), &steps);
        for (i, y) in y.iter().enumerate() {
            let held_s = (i % 5 + 1) as f64;
            let p = steps[i].loads.actuator_pa[0] * (-0.05 * held_s).exp();
            assert!((y - predict(&base, BODY, p).tip.y_m).abs() < 1e-10, "{actuator} {i}");
        }
    }
}

#[test]
fn the_base_turns_with_the_pressure() {
    let base = robot("epam").with_bending(1.0);
    let turned = base.with_effect("mount_rotation", &[1e-6]);
    for p in [0.0, 10e3, 30e3] {
        let (a, b) = (predict(&base, BODY, p), predict(&turned, BODY, p));
        for ([x, y], seen) in a.markers.iter().zip(&b.markers) {
            let (sin, cos) = (1e-6 * p).sin_cos();
            assert!((seen[0] - (x * cos - y * sin)).abs() < 1e-15 && (seen[1] - (x * sin + y * cos)).abs() < 1e-15);
        }
    }
}

#[test]
fn without_history_a_protocol_is_its_single_predictions() {
    for actuator in actuators() {
        for scenario in [robot(actuator).bare(), robot(actuator).with_bending(0.7)] {
            let model = Model::new(&scenario);
            assert!(!model.has_history());
            let steps = protocol(&[0.0, 10.0, 30.0, 20.0, 0.0], 5.0, 3);
            let mut count = 0;
            let mut each = |i: usize, at: &Prediction| {
                let single = predicted(&model, &steps[i].loads).unwrap();
                let apart =
                    at.markers.iter().flatten().zip(single.markers.iter().flatten()).map(|(a, b)| (a - b).abs());
                assert!(apart.fold(0.0, f64::max) < 1e-12, "{actuator} {i}");
                count += 1;
            };
            model.follow(&steps, &mut model.prediction(), &mut each).unwrap();
            assert_eq!(count, 15);
        }
    }
}

#[test]
fn a_protocol_does_not_depend_on_what_its_buffers_held_before_and_a_step_back_in_time_forgets() {
    for actuator in actuators() {
        let model = Model::new(&remembering(actuator).with_effect("leak", &[0.01]));
        let steps = protocol(&[10.0, 30.0, 0.0], 5.0, 3);
        let mut used = model.prediction();
        let mut runs: Vec<Vec<f64>> = Vec::new();
        for _ in 0..2 {
            let mut tips = Vec::new();
            model.follow(&steps, &mut used, &mut |_, at| tips.push(at.tip.y_m)).unwrap();
            runs.push(tips);
        }
        assert_eq!(runs[0], runs[1], "{actuator}");
        let twice: Vec<Step> = steps.iter().chain(&steps).copied().collect();
        let mut tips = Vec::new();
        model.follow(&twice, &mut used, &mut |_, at| tips.push(at.tip.y_m)).unwrap();
        assert_eq!(tips, [runs[0].clone(), runs[1].clone()].concat(), "{actuator}");
        // A prediction on its own starts from rest whatever the buffers remember.
        let loads = Loads::uniform(BODY, 20e3);
        model.predict(&loads, &mut used).unwrap();
        assert_eq!(used.tip, predicted(&model, &loads).unwrap().tip, "{actuator}");
    }
}

#[test]
fn transverse_loads_and_history_go_together() {
    for actuator in actuators() {
        let scenario = remembering(actuator).with_effect("gravity", &[0.4]).with_effect("tip_load", &[0.0, -0.05]);
        let steps = protocol(&[10.0, 30.0, 10.0, 0.0], 5.0, 3);
        let light = remembering(actuator).with_effect("gravity", &[1e-9]);
        let (loaded, nearly, free) =
            (heights(&scenario, &steps), heights(&light, &steps), heights(&remembering(actuator), &steps));
        assert!(loaded.iter().zip(&free).take(9).all(|(a, b)| a < b), "{actuator}: {loaded:?} {free:?}");
        let apart = nearly.iter().zip(&free).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(apart < 1e-6, "{actuator}: {apart:e}");
    }
}

#[test]
fn at_any_memory_the_force_is_minus_the_slope_of_the_energy_and_the_stored_energy_is_left_when_it_remembers() {
    let mut random = Random(77);
    for effect in EFFECTS.iter().filter(|e| e.stage == Stage::Balance) {
        let model = Model::new(&robot("spam").with_bending(1.3).with_effect(effect.name, &effect.typical()));
        for term in &model.assembly().sites[0].body_terms {
            let count = term.memory().values;
            for _ in 0..if count == 0 { 0 } else { 500 } {
                let memory: Vec<f64> = (0..count).map(|_| random.between(0.0, 3.0)).collect();
                let (kappa, dt_s) =
                    (random.between(-1.0, 4.0), random.decades(1e-6, 100.0) * f64::from(random.unit() < 0.8));
                hold_at(&**term, kappa, dt_s, &memory, effect.name);
            }
        }
    }
}

fn hold_at(term: &dyn Remembering, kappa: f64, dt_s: f64, memory: &[f64], name: &str) {
    let at = |kappa: f64, dt_s: f64, memory: &[f64]| {
        let mut force = [0.0];
        let q = [kappa];
        (term.add(&Pose { dt_s, memory, ..Pose::new(&q, BODY, 0.0) }, &mut force), force[0])
    };
    let (spent, force) = at(kappa, dt_s, memory);
    let error = |h: f64| (force + slope(|k| at(k, dt_s, memory).0, kappa, h)).abs();
    let best = (2..=6).map(|k| error(0.1_f64.powi(k))).fold(f64::INFINITY, f64::min);
    assert!(best < 1e-7 * (1.0 + force.abs()), "{name} at {kappa} {dt_s} {memory:?}: {best:e}");
    let mut next = memory.to_vec();
    let q = [kappa];
    let lost = term.remember(&Pose { dt_s, memory, ..Pose::new(&q, BODY, 0.0) }, &mut next);
    let (left, after) = at(kappa, 0.0, &next);
    assert!(lost >= 0.0 && left.is_finite(), "{name}: lost {lost:e}");
    assert!((after - force).abs() < 1e-12 * (1.0 + force.abs()), "{name}: the force stays when it is remembered");
    // At once, the incremental potential is what is stored and lost, from what was stored.
    if dt_s == 0.0 {
        assert!((left + lost - spent).abs() < 1e-12 * (1.0 + spent.abs()), "{name}: {left:e} + {lost:e} of {spent:e}");
    }
}

#[test]
fn every_effect_with_history_walks_up_and_down_at_all_its_bounds() {
    let picks: [fn(&models::effects::Parameter) -> f64; 3] = [|p| p.typical, |p| p.lower, |p| p.upper];
    for actuator in actuators() {
        for base in [robot(actuator).bare(), robot(actuator).with_bending(0.8)] {
            for effect in applicable(&base).filter(|e| e.history) {
                for pick in picks {
                    let scenario = base.with_effect(effect.name, &values(effect, pick));
                    for body_pa in [500.0, 2e3, 3e4] {
                        let mut steps =
                            protocol(&[0.0, 1e-3, 5.0, 30.0, 100.0, 30.0, 1.0, 1e-6, 0.0, 20.0, 0.0], 5.0, 3);
                        steps.iter_mut().for_each(|step| step.loads.body_pa = body_pa);
                        // A long pause, and another session at another body pressure.
                        let last = steps[steps.len() - 1].t_s;
                        steps.push(Step { t_s: last + 3600.0, loads: Loads::uniform(2.0 * body_pa, 20e3) });
                        let tips = heights(&scenario, &steps);
                        let fine = tips.iter().all(|y| y.is_finite() && *y > -1e-9);
                        assert!(fine, "{actuator} {} {body_pa}: {tips:?}", effect.name);
                    }
                }
            }
        }
    }
}
