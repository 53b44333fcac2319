//! A robot as a chain of joints, linear about a working point: what simulators and linear control take.
//!
//! ```text
//! moment that bends joint i = bᵢ + Σ Bᵢ P − Kᵢ qᵢ − Cᵢ qᵢ'        q: angle of the joint, P: pressure of a channel
//! ```
//!
//! K and B are slopes of the moment that would have to be added to hold the joint ([`Prediction::missing_moments`]), by its
//! angle and by the pressure; b makes the line pass through the working point. Loads across the body (`gravity`, `tip_load`)
//! bend the working point but stand in none of the three: a simulator has its own.

use crate::error::Solved;
use crate::follow::Step;
use crate::model::{MOST_ACTUATOR_PA, Model, Prediction};
use crate::scenario::Scenario;
use crate::term::{CHANNELS, Loads};
use serde::Serialize;
use spelling::si;

/// A joint: a piece of the body, bent as a whole.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
pub struct Joint {
    /// Start of its piece along the undeformed body \[m\].
    #[serde(rename = "s_mm", serialize_with = "si::mm")]
    pub start_m: f64,
    /// Length of its piece along the undeformed body \[m\].
    #[serde(rename = "length_mm", serialize_with = "si::mm")]
    pub length_m: f64,
    /// Its axis along the straight chain from the base \[m\]: halfway through its piece. Its two halves are rigid and
    /// (h/2) tan(q/2)/(q/2) long, so that the piece ends where the model's arc does.
    #[serde(rename = "joint_at_mm", serialize_with = "si::mm")]
    pub joint_at_m: f64,
    /// Its axis from the centre line, away from the actuator \[m\]: on the taut generator, whose length is kept.
    #[serde(rename = "line_offset_mm", serialize_with = "si::mm")]
    pub line_offset_m: f64,
    /// Angle q at the working point \[rad\].
    pub angle_rad: f64,
    /// K \[N·m/rad\]; NaN (null) where the actuator is flat and no bend has a slope.
    #[serde(rename = "k_nm_per_rad")]
    pub stiffness_nm: f64,
    /// B of each channel \[N·m/Pa\]; NaN (null) likewise.
    #[serde(rename = "b_nm_per_kpa", serialize_with = "si::per_kpa")]
    pub per_pa: [f64; CHANNELS],
    /// Moment b at zero angle and pressure \[N·m\]; NaN (null) likewise.
    #[serde(rename = "b_nm")]
    pub offset_nm: f64,
    /// C \[N·m·s/rad\]: of slow motion with the effect `creep`; `None` without, for nothing else here depends on the rate.
    #[serde(rename = "c_nms_per_rad")]
    pub damping_nms: Option<f64>,
}

impl Joint {
    /// Length of either rigid half of its piece \[m\].
    pub(super) fn half_m(&self) -> f64 {
        let x = 0.5 * self.angle_rad;
        0.5 * self.length_m * if x.abs() < 1e-6 { 1.0 } else { x.tan() / x }
    }
}

/// Chain of rigid links and linear joints about one working point, base to tip.
#[derive(Debug, Clone, PartialEq)]
pub struct Linear {
    /// Pressures of the working point, about which the joints are linear.
    pub loads: Loads,
    /// The tip along the straight chain, on the centre line \[m\].
    pub tip_at_m: f64,
    /// Joints between the rigid links, base to tip.
    pub joints: Vec<Joint>,
}

const ACROSS: [&str; 2] = ["gravity", "tip_load"];
/// Step of the differences over the value, and over the least value that counts \[1/m, Pa\].
const NUDGE: f64 = 1e-4;
const LEAST: [f64; 2] = [0.1, 1e3];

impl Linear {
    /// Cuts the body into `joints` equal pieces (more where a zone ends within one) and takes their slopes at these pressures.
    ///
    /// ```
    /// let robot = models::Scenario::parse(models::shipped("epam").unwrap()).unwrap();
    /// let chain = models::export::Linear::new(&robot, 6, &models::Loads::uniform(2e3, 10e3)).unwrap();
    /// assert!(chain.joints.len() == 6 && chain.joints[2].stiffness_nm > 0.0 && chain.joints[2].per_pa[0] > 0.0);
    /// ```
    pub fn new(scenario: &Scenario, joints: usize, loads: &Loads) -> Solved<Linear> {
        let cuts: Vec<f64> = (1..joints).map(|i| scenario.length_m * i as f64 / joints as f64).collect();
        let whole = Model::in_pieces(scenario, &cuts);
        let mut state = whole.prediction();
        whole.predict(loads, &mut state)?;
        let bent: Vec<f64> = whole.states(&state).iter().map(|place| place.curvature).collect();
        let mut unloaded = scenario.clone();
        unloaded.effects.retain(|effect| !ACROSS.contains(&effect.name.as_str()));
        let mut held = BentRobot { model: Model::in_pieces(&unloaded, &cuts), state, loads: *loads, bent };
        held.state = held.model.prediction();
        let creep = scenario.effects.iter().find(|effect| effect.name == "creep");
        let joint = |i| held.joint(i, creep.map(|effect| effect.values[0] * effect.values[1]));
        let mut joints = (0..whole.segments().len()).map(joint).collect::<Result<Vec<_>, _>>()?;
        let mut end_m = 0.0;
        for joint in &mut joints {
            joint.joint_at_m = end_m + joint.half_m();
            end_m = joint.joint_at_m + joint.half_m();
        }
        Ok(Linear { loads: *loads, tip_at_m: end_m, joints })
    }
}

struct BentRobot {
    model: Model,
    state: Prediction,
    loads: Loads,
    bent: Vec<f64>,
}

impl BentRobot {
    /// Moment that is missing at a joint when it has another curvature and the robot other pressures \[N·m\].
    fn missing(&mut self, index: usize, curvature: f64, loads: &Loads) -> Solved<f64> {
        let (mut bent, mut found) = (self.bent.clone(), f64::NAN);
        bent[index] = curvature;
        let step = [Step { t_s: 0.0, loads: *loads }];
        self.model.hold(&step, &[bent], &mut self.state, &mut |_, at| found = at.missing_moments()[index])?;
        Ok(found)
    }

    fn joint(&mut self, index: usize, creeping_s: Option<f64>) -> Solved<Joint> {
        let segment = self.model.segments()[index];
        let site = self.model.assembly().site(index);
        let (h, channel, bending) = (segment.length_m, site.channel, site.bending.stiffness);
        let [_, line_offset_m, _] = site.centre_line.shortening(self.bent[index]);
        let (is_active, bent, loads) = (self.model.is_active(index), self.bent[index], self.loads);
        let at_point = self.missing(index, bent, &loads)?;
        let step = NUDGE * bent.abs().max(LEAST[0]);
        let [up, down] = [self.missing(index, bent + step, &loads)?, self.missing(index, bent - step, &loads)?];
        // At the end of a stroke only one side has a moment.
        let slope = match (up.is_nan(), down.is_nan()) {
            (false, true) => (up - at_point) / step,
            (true, false) => (at_point - down) / step,
            _ => (up - down) / (2.0 * step),
        };
        let mut per_pa = [0.0; CHANNELS];
        if is_active {
            per_pa[channel] = self.by_pressure(index, channel)?;
        }
        let (stiffness_nm, angle_rad) = (slope / h, bent * h);
        let driven: f64 = (0..CHANNELS).map(|c| per_pa[c] * loads.actuator_pa[c]).sum();
        let offset_nm = stiffness_nm * angle_rad - driven - at_point;
        let damping_nms = creeping_s.map(|share_s| share_s * bending / h);
        let place = Joint { start_m: segment.start_m, length_m: h, line_offset_m, angle_rad, ..Joint::default() };
        Ok(Joint { stiffness_nm, per_pa, offset_nm, damping_nms, ..place })
    }

    /// How much more moment a joint has per pascal of its channel.
    fn by_pressure(&mut self, index: usize, channel: usize) -> Solved<f64> {
        let step = NUDGE * self.loads.actuator_pa[channel].max(LEAST[1]);
        let [mut up, mut down] = [self.loads; 2];
        up.actuator_pa[channel] = (up.actuator_pa[channel] + step).min(MOST_ACTUATOR_PA);
        down.actuator_pa[channel] = (down.actuator_pa[channel] - step).max(0.0);
        let span = up.actuator_pa[channel] - down.actuator_pa[channel];
        let bent = self.bent[index];
        Ok((self.missing(index, bent, &down)? - self.missing(index, bent, &up)?) / span)
    }
}
