//! The force of every term is minus the slope of its energy, over random poses.

use crate::support::*;
use models::effects::{EFFECTS, Stage};
use models::{Model, Pose, Scenario, Term};
use std::collections::BTreeSet;

/// Poses per term and parameter set.
const POSES: usize = 200;

/// Largest relative error of the force over all coordinates, each at the best of several steps.
fn worst_error(term: &dyn Term, q: &[f64], p_body_pa: f64, p_act_pa: f64) -> f64 {
    let energy = |q: &[f64]| {
        let mut unused = vec![0.0; q.len()];
        term.add(&Pose::new(q, p_body_pa, p_act_pa), &mut unused)
    };
    let mut force = vec![0.0; q.len()];
    term.add(&Pose::new(q, p_body_pa, p_act_pa), &mut force);
    let mut worst = 0.0_f64;
    for i in 0..q.len() {
        let along = |x: f64| {
            let mut moved = q.to_vec();
            moved[i] = x;
            energy(&moved)
        };
        let error = |h: f64| {
            let difference = (force[i] + slope(along, q[i], h * q[i].abs().max(1e-9))).abs();
            if difference == 0.0 { 0.0 } else { difference / force[i].abs() }
        };
        worst = worst.max((1..=6).map(|k| error(0.1_f64.powi(k))).fold(f64::INFINITY, f64::min));
    }
    worst
}

/// Checks all terms of a robot; returns their names.
fn check(scenario: &Scenario, random: &mut Random) -> BTreeSet<&'static str> {
    let model = Model::new(scenario);
    let mut seen = BTreeSet::new();
    let mut hold = |term: &dyn Term, q: &[f64], p_body_pa: f64, p_act_pa: f64| {
        let error = worst_error(term, q, p_body_pa, p_act_pa);
        assert!(error < 1e-6, "{} {} at {q:?}, {p_body_pa} Pa: {error:e}", scenario.name, term.line().name);
        seen.insert(term.line().name);
    };
    for site in &model.assembly().sites {
        for _ in 0..POSES {
            let (p_body_pa, p_act_pa) = (random.decades(50.0, 1e5), random.decades(1.0, 5e5));
            let q = [
                random.between(0.05, 3.0),
                random.between(-0.2, 0.5),
                random.between(1e-5, 1e-2),
                random.decades(1e-3, 10.0),
            ];
            site.actuator_terms.iter().for_each(|t| hold(&**t, &q, p_body_pa, p_act_pa));
            let kappa = random.decades(1e-6, 20.0) * if random.unit() < 0.5 { -1.0 } else { 1.0 };
            let body = [&*site.body_pressure, &site.bending as &dyn Term].into_iter();
            body.chain(site.body_terms.iter().map(|t| &**t as &dyn Term))
                .for_each(|t| hold(t, &[kappa], p_body_pa, 0.0));
        }
    }
    for term in &model.assembly().node_terms {
        let nodes: Vec<f64> =
            (0..2 * (model.assembly().segments.len() + 1)).map(|_| random.between(-0.5, 0.5)).collect();
        hold(&**term, &nodes, 2e3, 0.0);
    }
    seen
}

#[test]
fn the_force_of_every_term_is_minus_the_slope_of_its_energy() {
    let mut random = Random(20_230_521);
    let mut seen = BTreeSet::new();
    for actuator in actuators() {
        seen.append(&mut check(&robot(actuator).with_bending(1.3), &mut random));
        seen.append(&mut check(&everything(actuator), &mut random));
        for effect in applicable(&robot(actuator)).filter(|e| e.stage == Stage::Balance) {
            for pick in [|p: &models::effects::Parameter| p.lower, |p: &models::effects::Parameter| p.upper] {
                let scenario = robot(actuator).bare().with_bending(1.3).with_effect(effect.name, &values(effect, pick));
                seen.append(&mut check(&scenario, &mut random));
            }
        }
    }
    // Eight effects change the linkage, one replaces the body pressure and three are the cell `muscle` together; all others must
    // have been visited as terms.
    let linkage = [
        "weld_width",
        "chord_arm",
        "end_constraint",
        "end_fittings",
        "arm_growth",
        "sunk_muscle",
        "fabric_stretch",
        "ovalization",
    ];
    let other = [&linkage[..], &["wrinkling", "yarn_stretch", "glued_face", "flat_ends"]].concat();
    let balance = EFFECTS.iter().filter(|e| e.stage == Stage::Balance && !other.contains(&e.name)).map(|e| e.name);
    for name in balance.chain(["actuator_pressure", "body_pressure", "bending", "muscle"]) {
        assert!(seen.contains(name), "{name} was not visited");
    }
}

#[test]
fn the_strokes_derivatives_are_slopes_of_its_values() {
    let mut random = Random(7);
    for actuator in models::actuators::ACTUATORS {
        let shape = robot(actuator.name).actuator.shape;
        let stroke = |a: f64| (actuator.stroke)(&shape, a);
        for _ in 0..POSES {
            let a = random.between(actuator.range.0.max(-0.2), actuator.range.1.min(3.0));
            let at = stroke(a);
            for (value, d) in [
                ((|s| s.contraction) as fn(models::actuators::Stroke) -> f64, at.d_contraction),
                (|s| s.volume, at.d_volume),
                (|s| s.lift, at.d_lift),
            ] {
                let best = (2..=5)
                    .map(|k| (slope(|x| value(stroke(x)), a, 0.1_f64.powi(k)) - d).abs())
                    .fold(f64::INFINITY, f64::min);
                assert!(best < 1e-9 * (d.abs() + value(at).abs()), "{} at {a}: {best:e} of {d:e}", actuator.name);
            }
        }
    }
}
