//! The linear form of a robot.

use crate::prelude::*;
use models::export::{Joint, Linear};

pub(crate) fn text(scenario: &Scenario, chain: &Linear) -> String {
    let mut joints = Table::of(chain.joints.iter().enumerate())
        .right("joint", |(i, _)| (i + 1).to_string())
        .number("start [mm]", 1, |(_, joint)| joint.start_m * 1e3)
        .number("length [mm]", 1, |(_, joint)| joint.length_m * 1e3)
        .number("q [deg]", 2, |(_, joint)| joint.angle_rad.to_degrees())
        .right("K [N m/rad]", |(_, joint)| number(joint.stiffness_nm))
        .right("C [N m s/rad]", |(_, joint)| joint.damping_nms.map_or("-".into(), number))
        .right("b [N m]", |(_, joint)| number(joint.offset_nm));
    for channel in channels(chain) {
        joints = joints.right(format!("B{channel} [N m/kPa]"), |(_, joint)| number(joint.per_pa[channel] * 1e3));
    }
    format!(
        "{} at {} kPa, body pressure {} kPa\n{}Moment that bends a joint: b + B P - K q - C q\u{27}. Predicted.\n",
        scenario.name,
        pressure_words(&chain.loads),
        chain.loads.body_pa / 1e3,
        joints.text()
    )
}

/// A number; none where an actuator is flat.
fn number(value: f64) -> String {
    if value.is_nan() { "-".into() } else { format!("{value:.5}") }
}

/// Channels that drive a joint; at least the first.
fn channels(chain: &Linear) -> Vec<usize> {
    let drives = |channel: &usize| *channel == 0 || chain.joints.iter().any(|joint| joint.per_pa[*channel] != 0.0);
    (0..models::CHANNELS).filter(drives).collect()
}

/// `ibr.export.linear`: `ibr export linear SCENARIO`
#[derive(Serialize)]
pub(crate) struct LinearAnswer<'a> {
    /// Scenario as typed
    pub scenario: &'a str,
    /// Name in the scenario
    pub name: &'a str,
    /// Body pressure
    pub p_body_kpa: f64,
    /// Actuator pressure of every channel at the working point
    pub p_act_channels_kpa: Vec<f64>,
    /// Base to tip
    pub joints: &'a [Joint],
}

impl<'a> LinearAnswer<'a> {
    /// Of a scenario, as typed, and its chain.
    pub(crate) fn of(typed: &'a str, scenario: &'a Scenario, chain: &'a Linear) -> LinearAnswer<'a> {
        let Linear { loads, joints } = chain;
        let p_act_channels_kpa = loads.actuator_pa.iter().map(|p| p / 1e3).collect();
        LinearAnswer {
            scenario: typed,
            name: &scenario.name,
            p_body_kpa: loads.body_pa / 1e3,
            p_act_channels_kpa,
            joints,
        }
    }
}
