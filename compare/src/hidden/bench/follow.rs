//! The recommended next experiment, done on the same robot.
//!
//! What can be recorded in one table (other pressures, another body pressure, longer holds) is measured after the first
//! protocol in the same runs; "repeat" doubles the runs. A tip force or gravity turned over needs a description of its
//! own, so these data are diagnosed alone.

use super::cases::about;
use crate::diagnosis::Experiment;
use crate::error::CompareError;
use crate::hidden::Truth;
use crate::hidden::measure::measure_holds;
use crate::hidden::truth::standard_protocol;
use crate::study::generate::{Generator, holds};
use crate::study::parse_protocol;
use data::{About, AboutRun, Dataset, Hold};

/// Known force of the experiment "tip force" \[N\].
const TIP_N: [f64; 2] = [0.0, 0.3];
/// Length of a hold of the experiment "long hold" \[s\].
const LONG_HOLD_S: f64 = 60.0;

/// Measures again as recommended.
///
/// # Errors
/// A protocol that cannot be read; a hold at which nothing balances.
pub(super) fn follow_up(truth: &Truth, experiment: &Experiment) -> Result<(Dataset, About), CompareError> {
    // Its scatter is another one than that of the first data.
    let mut again = Truth { seed: truth.seed ^ 0x5EED, ..truth.clone() };
    let (mut robot, mut about) = (truth.robot()?, about(truth)?);
    let first = holds(&again.measurement(&standard_protocol()).generator);
    let wanted = parse_protocol(&experiment.protocol)?;
    let hold_s = if experiment.name == "long hold" { LONG_HOLD_S } else { Generator::default().hold_s };
    let second = holds(&Generator { hold_s, protocol: wanted, ..Generator::default() });
    let holds = match experiment.name.as_str() {
        "repeat" => {
            again.runs *= 2;
            first
        }
        "tip force" => {
            robot.loads.tip_n = TIP_N;
            let run = |r: usize| AboutRun { id: r.to_string(), tip_force_n: TIP_N, session: None };
            about.runs = (1..=again.runs).map(run).collect();
            second
        }
        "turned over" => {
            robot.loads.down = robot.loads.down.map(|d| -d);
            about.gravity_direction = about.gravity_direction.map(|g| g.map(|d| -d));
            second
        }
        _ => joined(first, second),
    };
    let measurement = again.measurement(&standard_protocol());
    let data = measure_holds(&robot, &truth.told()?, "follow-up", &measurement, holds)?;
    Ok((data, about))
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
