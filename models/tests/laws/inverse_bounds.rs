//! The inverse of every effect alone, at the bounds of its parameters and between them.

use crate::support::*;
use models::effects::Effect;
use models::{Loads, Model, Prediction, Scenario, Target, Unsolved};

/// Where between its bounds a parameter lies.
const SHARES: [f64; 4] = [0.0, 0.1, 0.5, 1.0];

/// The robot with one effect, all of its parameters at one share of their ranges.
fn with_one(scenario: &Scenario, effect: &Effect, share: f64) -> Scenario {
    let of = |p: &models::effects::Parameter| (p.lower + share * (p.upper - p.lower)) * p.si;
    scenario.with_effect(effect.name, &effect.parameters.iter().map(of).collect::<Vec<f64>>())
}

/// What comes of asking for the pressure of a bend that a prediction at `p` reaches.
fn asked(model: &Model, p_body_pa: f64, p: f64, target: fn(&Prediction) -> Target) -> Result<bool, String> {
    let Ok(reached) = predicted(model, &Loads::uniform(p_body_pa, p)) else { return Ok(false) };
    // A pose beyond collapse is told as such: there the robot has several.
    if !model.beyond(&Loads::uniform(p_body_pa, p), &reached).is_empty() {
        return Ok(false);
    }
    let wanted = target(&reached);
    match model.pressure_for(wanted, p_body_pa, &mut model.prediction()) {
        Ok(found) => {
            let again = predicted(model, &Loads::uniform(p_body_pa, found)).map_err(|e| e.to_string())?;
            let met = match (wanted, target(&again)) {
                (Target::Angle(a), Target::Angle(b)) | (Target::TipHeight(a), Target::TipHeight(b)) => {
                    (a - b).abs() <= 1e-9
                }
                _ => false,
            };
            if met { Ok(true) } else { Err(format!("{wanted:?} at {found} Pa is {:?}", target(&again))) }
        }
        Err(error) => Err(error.to_string()),
    }
}

#[test]
fn the_inverse_holds_for_every_effect_over_its_bounds() {
    let (mut met, mut without, mut wrong) = (0, 0, Vec::new());
    for name in actuators() {
        let plain = robot(name).with_bending(0.3);
        for (effect, share) in applicable(&plain).flat_map(|effect| SHARES.map(|share| (effect, share))) {
            let model = Model::new(&with_one(&plain, effect, share));
            let targets: [fn(&Prediction) -> Target; 2] =
                [|at| Target::Angle(at.tip.angle_rad), |at| Target::TipHeight(at.tip.y_m)];
            for (p, target) in [500.0, 5e3, 3e4, 9.9e4].into_iter().flat_map(|p| targets.map(|target| (p, target))) {
                match asked(&model, plain.p_body_pa, p, target) {
                    Ok(true) => met += 1,
                    Ok(false) => without += 1,
                    Err(why) => wrong.push(format!("{name} {} at {share} of its range, {p} Pa: {why}", effect.name)),
                }
            }
        }
    }
    println!("{met} met, {without} without a pose to ask for");
    assert!(wrong.is_empty(), "{} wrong:\n{}", wrong.len(), wrong.join("\n"));
    assert!(met > 10 * without && met > 2000, "{met} met, {without} without a pose to ask for");
}

/// What cannot be had is refused with a reason that a prediction confirms, at any bound of any effect.
#[test]
fn what_no_pressure_reaches_is_refused_for_every_effect() {
    for name in actuators() {
        let plain = robot(name).with_bending(0.3);
        for (effect, share) in applicable(&plain).flat_map(|effect| [0.0, 1.0].map(|share| (effect, share))) {
            let model = Model::new(&with_one(&plain, effect, share));
            let told = model.pressure_for(Target::Angle(99.0), plain.p_body_pa, &mut model.prediction());
            let Err(error) = told else { panic!("{name} {}: 99 rad at {told:?}", effect.name) };
            if let Unsolved::OutOfReach { highest, .. } = error {
                assert!(highest < 99.0_f64.to_degrees() || highest.is_nan(), "{name} {}: {error}", effect.name);
            }
        }
    }
}
