//! The recommended next experiment, done on the same robot.
//!
//! A bench test (bending, fabric, scale, caliper) adds its result to the data at hand.
//!
//! What can be recorded in one table (other pressures, another body pressure, longer holds) is measured after the first
//! protocol in the same runs; "repeat" doubles the runs. A tip force, gravity turned over, a gauge at the actuator in addition
//! to the set pressure, and positions from the base need a description of their own: these data are new runs, diagnosed together
//! with the first.

use super::outcome::about as description;
use crate::Truth;
use crate::camera::Camera;
use crate::measure::measure_holds;
use crate::tested::bench_tests;
use crate::truth::standard_protocol;
use compare::diagnosis::{BENDING_TEST, BENDING_TEST_NAME, Experiment};
use compare::error::CompareError;
use compare::study::generate::{Generator, NormalNumbers, holds};
use compare::study::parse_protocol;
use data::{About, AboutRun, Dataset, Direct, Hold};

/// Known force of the experiment "tip force" \[N\].
const TIP_N: [f64; 2] = [0.0, 0.3];
/// Length of a hold of the experiment "long hold" \[s\].
const LONG_HOLD_S: f64 = 60.0;

/// Measures again as recommended: all data to be diagnosed, with their descriptions.
pub(super) fn follow_up(truth: &Truth, experiment: &Experiment) -> Result<Vec<(Dataset, About)>, CompareError> {
    if experiment.name == BENDING_TEST_NAME {
        return Ok(vec![(truth.dataset("hidden", &standard_protocol())?, tested(truth)?)]);
    }
    if experiment.protocol.is_empty() {
        let about = About { measured: bench_tests(truth, &experiment.tests)?, ..description(truth)? };
        return Ok(vec![(truth.dataset("hidden", &standard_protocol())?, about)]);
    }
    // Its scatter differs from the scatter of the first data.
    let mut again = Truth { seed: truth.seed ^ 0x5EED, ..truth.clone() };
    let (mut robot, mut about) = (truth.robot()?, description(truth)?);
    let first = holds(&again.measurement(&standard_protocol()).generator);
    let wanted = parse_protocol(&experiment.protocol)?;
    let hold_s = if experiment.name.starts_with("long hold") { LONG_HOLD_S } else { Generator::default().hold_s };
    let second = holds(&Generator { hold_s, protocol: wanted, ..Generator::default() });
    let Direct { pressure, frame } = experiment.direct;
    about.direct = Direct { pressure: false, frame };
    about.measured = bench_tests(truth, &experiment.tests)?;
    if frame {
        robot.camera = Camera { length_m: robot.camera.length_m, ..Camera::default() };
    }
    let name = experiment.name.split(',').next().unwrap_or_default();
    let loaded = matches!(name, "tip force" | "turned over");
    match name {
        "tip force" => {
            robot.loads.tip_n = TIP_N;
            let run = |r: usize| AboutRun { id: r.to_string(), tip_force_n: TIP_N, session: None };
            about.runs = (1..=again.runs).map(run).collect();
        }
        "turned over" => {
            robot.roll_over();
            about.gravity_direction = about.gravity_direction.map(|[x, y]| [x, -y]);
        }
        _ => {}
    }
    let apart = loaded || pressure || frame;
    let holds = match (apart, name) {
        (true, _) => second,
        (false, "repeat") => {
            again.runs *= 2;
            first
        }
        (false, _) => joined(first, second),
    };
    let mut measurement = again.measurement(&standard_protocol());
    measurement.generator.gauge = pressure;
    let data = measure_holds(&robot, &truth.told()?, "follow-up", &measurement, holds)?;
    let mut all = vec![(data, about)];
    if apart {
        all.insert(0, (truth.dataset("hidden", &standard_protocol())?, description(truth)?));
    }
    Ok(all)
}

/// The description of a set, with the robot's bending stiffness from a separate test.
pub(super) fn tested(truth: &Truth) -> Result<About, CompareError> {
    let error = BENDING_TEST * NormalNumbers::new(truth.seed ^ 0xB).normal();
    let found_nm2 = truth.bending_nm2 * (1.0 + error);
    Ok(About { bending_nm2: Some([found_nm2, BENDING_TEST * found_nm2]), ..description(truth)? })
}

/// One protocol after the other on one clock.
fn joined(mut first: Vec<Hold>, second: Vec<Hold>) -> Vec<Hold> {
    let end_s = first.last().and_then(|hold| hold.t_s.last().copied()).unwrap_or(0.0);
    for mut hold in second {
        hold.t_s.iter_mut().for_each(|t| *t += end_s);
        let alike = |h: &&Hold| h.p_body_pa == hold.p_body_pa && h.p_act_pa == hold.p_act_pa && h.phase == hold.phase;
        hold.occurrence = first.iter().filter(alike).count();
        first.push(hold);
    }
    first
}
