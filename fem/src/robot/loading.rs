//! Loads of a robot's run: pressures one after the other in one ramp, and what else pushes on it.
//!
//! Between two pressures the logarithm of the actuator's pressure plus `ramp_floor_pa` rises at one rate, the same in the whole
//! ramp ([`Amplitude::Growing`]), for a sixth of the ramp at least; then the pressure is held for `hold_s`, and read at the end
//! of it. Without a stop the robot cannot be read: while the pressure passes by, its motion holds a tenth of the energy.

use models::{CHANNELS, Scenario};

use super::{Preset, RobotSettings, problem, sew};
use crate::problem::{Amplitude, GRAVITY, Obstacle, Pressure, PrintedLoads, force_on, motion_of, pressure_of};
use crate::{FemError, Problem, Result};

/// Shortest way between two pressures, as a share of the ramp: a robot that is stopped faster swings past its place, and stays
/// there in other folds.
const SHORTEST: f64 = 1.0 / 6.0;

/// Everything about a robot's run: its numbers and its loads.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct RobotRun {
    /// Where the settings come from that no key of `[fem]` sets.
    pub model: Preset,
    /// Keys that `[fem]` sets, without `model`.
    pub set: Vec<String>,
    /// Numbers of mesh, fabrication and integration for one run.
    pub settings: RobotSettings,
    /// Whether every pressure is a separate run.
    pub separate: bool,
    /// Pressures of the channels that are read, in this order \[Pa\].
    pub pressures_pa: Vec<[f64; CHANNELS]>,
    /// Dead load on the tip's ring \[N\].
    pub tip_force_n: Load,
    /// Gravity \[m/s²\], which acts on the true mass.
    pub gravity_m_s2: Load,
    /// A cylinder along z in the way.
    pub obstacle: Option<Obstacle>,
    /// How far it has moved at every pressure \[m\]; empty: it does not.
    pub obstacle_moves_m: Vec<[f64; 3]>,
    /// Where another run ended that this one goes on from.
    pub start: Option<RobotStart>,
    /// Element sizes of body and actuator that a study of the mesh compares \[m\]; `settings` has the sizes of one run.
    pub meshes_m: Vec<[f64; 2]>,
}

/// A moment at which a robot is read: the end of a hold.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HoldEnd {
    /// Simulated time of the end of the hold \[s\].
    pub time_s: f64,
    /// Pressures of the channels then \[Pa\].
    pub pressures_pa: [f64; CHANNELS],
}

impl HoldEnd {
    /// Highest of the channels' pressures at that time \[Pa\].
    pub fn highest_pa(&self) -> f64 {
        highest_pa(&self.pressures_pa)
    }
}

/// The highest pressure of all channels \[Pa\].
pub(super) fn highest_pa(channels: &[f64; CHANNELS]) -> f64 {
    channels.iter().copied().fold(0.0, f64::max)
}

impl RobotRun {
    /// When the robot is read: full body, or the end of the run before, first, then every pressure.
    pub fn holds(&self) -> Vec<HoldEnd> {
        let begun = self.start.as_ref().map(|start| (start.time_s, start.pressures_pa));
        let (mut time_s, mut before) = begun.unwrap_or((self.settings.body_ramp_s, [0.0; CHANNELS]));
        let mut holds = vec![HoldEnd { time_s, pressures_pa: before }];
        for pressures_pa in &self.pressures_pa {
            time_s += self.ramp_s(&before, pressures_pa) + self.settings.hold_s;
            holds.push(HoldEnd { time_s, pressures_pa: *pressures_pa });
            before = *pressures_pa;
        }
        holds
    }

    /// As long as the channel with the longest way takes.
    fn ramp_s(&self, from_pa: &[f64; CHANNELS], to_pa: &[f64; CHANNELS]) -> f64 {
        let way = |from: f64, to: f64| match self.settings.ramp_floor_pa {
            Some(floor_pa) => ((to - from) / (from + floor_pa)).ln_1p().abs(),
            None => (to - from).abs(),
        };
        let whole = way(0.0, self.settings.actuator_pa).max(f64::MIN_POSITIVE);
        let longest = from_pa.iter().zip(to_pa).map(|(from, to)| way(*from, *to)).fold(0.0, f64::max);
        self.settings.actuator_ramp_s * (longest / whole).max(SHORTEST)
    }

    /// (time \[s\], value) points of a quantity that is `before` at the first hold and changes at each later hold.
    pub(super) fn stairs<T: Copy>(&self, before: T, each: impl IntoIterator<Item = T>) -> Vec<(f64, T)> {
        let holds = self.holds();
        let mut points = vec![(holds[0].time_s, before)];
        for (hold, value) in holds[1..].iter().zip(each) {
            points.push((hold.time_s - self.settings.hold_s, value));
            if self.settings.hold_s > 0.0 {
                points.push((hold.time_s, value));
            }
        }
        points
    }

    /// The problem, ready to run.
    ///
    /// # Errors
    /// As [`problem`]; several pressures that are to be runs of their own.
    pub fn problem(&self, scenario: &Scenario) -> Result<Problem> {
        if self.separate && self.pressures_pa.len() > 1 {
            let message = "robot: every pressure is a separate run here (`separate`, which model = \"paper\" sets); \
                           name one pressure, or write separate = false for one ramp through all";
            return Err(FemError::Problem(message.into()));
        }
        let mut made = problem(scenario, &self.settings)?;
        let holds = self.holds();
        for (i, strip) in scenario.strips().enumerate() {
            let channel = |channels: &[f64; CHANNELS]| channels[strip.channel];
            let points = self.stairs(channel(&holds[0].pressures_pa), self.pressures_pa.iter().map(channel));
            let name = sew::of_strip(sew::ACTUATOR, i);
            if let Some(chamber) = made.chambers.iter_mut().find(|c| c.name == name) {
                chamber.pressure = Pressure::Set(self.settings.rise(points));
            }
        }
        made.settings.end_s = holds[holds.len() - 1].time_s;
        if let Some(start) = &self.start {
            let points = self.stairs(start.body_pa, std::iter::repeat(scenario.p_body_pa));
            made.chambers[0].pressure = Pressure::Set(Amplitude::Smooth(points));
        }
        self.load(&mut made)?;
        Ok(made)
    }
}

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
    pub fn of(scenario: &Scenario, time_s: f64, loads: &PrintedLoads) -> RobotStart {
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
