//! A load of a robot, and the loads at the end of a run that another one goes on from.

use models::{CHANNELS, Scenario};

use super::sew;
use crate::problem::{GRAVITY, Loads, force_on, motion_of, pressure_of};

/// A load of a robot's run.
#[derive(Debug, Clone, PartialEq)]
pub enum Load {
    /// It grows while the body is filled, and stays; in a run that goes on from another one it grows with the first pressure.
    Always([f64; 3]),
    /// One force or acceleration for every pressure, in their order.
    AtPressures(Vec<[f64; 3]>),
}

impl Default for Load {
    fn default() -> Load {
        Load::Always([0.0; 3])
    }
}

/// Pressures and loads at the end of a run that another one goes on from.
#[derive(Debug, Clone, PartialEq, Default)]
#[allow(missing_docs, reason = "names and units say it")]
pub struct RobotStart {
    pub time_s: f64,
    pub body_pa: f64,
    pub pressures_pa: [f64; CHANNELS],
    pub tip_force_n: [f64; 3],
    /// Acceleration of gravity at the end of that run \[m/s²\].
    pub gravity_m_s2: [f64; 3],
    /// How far the obstacle has moved \[m\].
    pub obstacle_m: [f64; 3],
}

impl RobotStart {
    /// Of loads at a time \[s\].
    pub fn of(scenario: &Scenario, time_s: f64, loads: &Loads) -> RobotStart {
        let of = |name: String| loads.get(&name).copied().unwrap_or_default();
        let mut pressures_pa = [0.0; CHANNELS];
        for (i, strip) in scenario.strips().enumerate() {
            pressures_pa[strip.channel] = of(pressure_of(&sew::of_strip(sew::ACTUATOR, i)))[0];
        }
        RobotStart {
            time_s,
            body_pa: of(pressure_of(sew::BODY))[0],
            pressures_pa,
            tip_force_n: of(force_on("tip")),
            gravity_m_s2: of(GRAVITY.into()),
            obstacle_m: of(motion_of(0)),
        }
    }
}
