//! The inverse on random robots: it gives what was asked, or says truly that it cannot be had.

use crate::support::*;
use models::actuators::ACTUATORS;
use models::effects::Stage;
use models::{Loads, Model, Prediction, Scenario, Target, Unsolved};

/// A robot of any kind and size that can be built, with up to three effects in half of the cases.
pub(crate) fn any_robot(random: &mut Random) -> Scenario {
    let pick = |random: &mut Random, count: usize| (random.unit() * count as f64) as usize;
    let kind = ACTUATORS[pick(random, ACTUATORS.len())].name;
    let mut scenario = robot(kind).bare();
    scenario.radius_m = random.between(0.015, 0.08);
    scenario.p_body_pa = random.decades(500.0, 20e3);
    let muscle = kind == "fpam";
    scenario.actuator.count = if muscle { 1 } else { 1 + pick(random, 12) };
    scenario.actuator.shape.length_m = random.between(0.02, 0.12) * if muscle { 6.0 } else { 1.0 };
    scenario.actuator.shape.width_m = random.between(0.3, if muscle { 2.0 } else { 3.1 }) * scenario.radius_m;
    scenario.actuator.shape.fold_m *= scenario.actuator.shape.width_m / 0.06;
    let active_m = scenario.actuator.count as f64 * scenario.actuator.shape.length_m;
    scenario.actuator.start_m = random.between(0.0, 0.3) * active_m;
    scenario.length_m = active_m * random.between(1.3, 1.5);
    scenario.markers_m = vec![scenario.length_m];
    if random.unit() < 0.5 {
        scenario.bending_stiffness = random.decades(1e-3, 5.0);
    }
    if random.unit() < 0.3 {
        scenario.wall.stiffness_n_per_m = Some(random.decades(3e3, 1e6));
        scenario.wall.shear_n_per_m = Some(random.decades(100.0, 1e5));
    }
    if random.unit() < 0.5 {
        let all: Vec<_> = applicable(&scenario).filter(|e| e.stage != Stage::Camera && !e.history).collect();
        for _ in 0..1 + pick(random, 3) {
            let effect = all[pick(random, all.len())];
            let of = |p: &models::effects::Parameter, u: f64| (p.lower + u * (p.upper - p.lower)) * p.si;
            let values: Vec<f64> = effect.parameters.iter().map(|p| of(p, random.unit())).collect();
            scenario = scenario.with_effect(effect.name, &values);
        }
    }
    scenario
}

/// How an inverse can be wrong, and of how many robots nothing was asked.
#[derive(Debug, Default)]
struct Wrong {
    without: usize,
    /// Beyond collapse: only a wrong answer counts.
    beyond: usize,
    /// An answer whose state is not what was asked.
    answers: usize,
    /// "Out of reach" or "passed over" of what a prediction reaches.
    refusals: usize,
}

fn value(target: Target, at: &Prediction) -> f64 {
    match target {
        Target::TipHeight(_) => at.tip.y_m,
        Target::Angle(_) => at.tip.angle_rad,
    }
}

/// Asks for what a random pressure reaches, and for anything.
fn ask(scenario: &Scenario, random: &mut Random, wrong: &mut Wrong) {
    let model = Model::new(scenario);
    let (mut at, p_body) = (model.prediction(), scenario.p_body_pa);
    let p = if random.unit() < 0.7 { random.between(0.0, 1e5) } else { random.decades(1.0, 1e5) };
    let loads = Loads::uniform(p_body, p);
    if model.predict(&loads, &mut at).is_err() {
        wrong.without += 1;
        return;
    }
    // A pose beyond collapse is told as such: there the robot has several, and which one comes out is chance.
    let holds = model.beyond(&loads, &at).is_empty();
    wrong.beyond += usize::from(!holds);
    let (y, angle) = (at.tip.y_m, at.tip.angle_rad);
    let height = random.unit() < 0.5;
    for (wanted, is_reached) in [(if height { y } else { angle }, holds), (random.between(-0.2, 1.5) * y.abs(), false)]
    {
        // To say that nothing reaches a target takes a thousand predictions: every fifth robot is asked for anything.
        if !is_reached && random.unit() < 0.8 {
            continue;
        }
        let target = if height || !is_reached { Target::TipHeight(wanted) } else { Target::Angle(wanted) };
        match model.pressure_for(target, p_body, &mut at) {
            Ok(found) => {
                let again = predicted(&model, &Loads::uniform(p_body, found)).unwrap();
                let met = (value(target, &again) - wanted).abs() <= 1e-9 && again.tip == at.tip;
                if !met || !(0.0..=model.p_max_pa()).contains(&found) {
                    wrong.answers += 1;
                    println!("wrong: {target:?} at {found} gives {}, {scenario:?}", value(target, &again));
                }
            }
            Err(error) if is_reached => {
                wrong.refusals += 1;
                println!("{p} Pa gives {target:?}, {error}: {scenario:?}");
            }
            Err(Unsolved::OutOfReach { lowest, highest, .. }) => {
                assert!(!(lowest..=highest).contains(&(1e3 * wanted)), "{lowest} {wanted} {highest} {scenario:?}");
            }
            Err(_) => {}
        }
    }
}

fn asked(seed: u64, robots: usize) -> Wrong {
    let (mut random, mut wrong) = (Random(seed), Wrong::default());
    for _ in 0..robots {
        let scenario = any_robot(&mut random);
        ask(&scenario, &mut random, &mut wrong);
    }
    wrong
}

#[test]
fn the_inverse_of_random_robots_is_right_or_says_truly_why_not() {
    // 1e5 robots take minutes: `IBR_ROBOTS=100000 cargo test --release -p ibr-models random_inverse -- --nocapture`.
    let robots = std::env::var("IBR_ROBOTS").ok().and_then(|n| n.parse().ok()).unwrap_or(300);
    let wrong = asked(34, robots);
    println!("{robots} robots: {wrong:?}");
    assert_eq!((wrong.answers, wrong.refusals), (0, 0));
    assert!(5 * (wrong.without + wrong.beyond) < robots, "{wrong:?}");
}
