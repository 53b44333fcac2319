//! The hidden effects of a dataset, as data: drawn from a seed, written as TOML, made into a robot and measured.

use super::effects::{ALSO, HIDDEN, HiddenEffect, Laws, OUTSIDE, by_name};
use super::measure::{Measurement, measure};
use super::robot::TrueRobot;
use compare::error::CompareError;
use compare::study::generate::{Generator, HoldScatter, NormalNumbers};
use data::Dataset;
use models::{Scenario, shipped};
use serde::{Deserialize, Serialize};

/// A robot to hide effects in: a shipped scenario and an effective bending stiffness \[N·m²\], **assumed** once so that the
/// robots bend about as far as the published ones (handbook of the prototype; the cPAM's is divided by its volume gain).
pub const ROBOTS: [(&str, f64); 4] = [("spam", 6.0), ("cpam", 0.5), ("epam", 1.35), ("fpam", 0.3)];

/// How many effects a set hides, and of which kind.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Hiding {
    /// No effect: the data come from the model and noise.
    Nothing,
    /// One effect that the catalogue also knows.
    One,
    /// Two effects that the catalogue also knows.
    Two,
    /// One that the catalogue does not know.
    Outside,
}

/// A hidden effect and its size.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct HiddenChoice {
    /// Name of the effect in the catalogue or among those outside.
    pub name: String,
    /// Size as a multiple of the effect's typical size.
    pub times_typical: f64,
}

/// A robot, its noise and its hidden effects: everything that a seal keeps secret.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Truth {
    /// Actuator kind of the robot, one of [`ROBOTS`].
    pub actuator: String,
    /// Bending stiffness of this robot \[N·m²\].
    pub bending_nm2: f64,
    /// Seed of the scatter of the measurement.
    pub seed: u64,
    /// Number of runs of the measurement.
    pub runs: usize,
    /// Camera noise of one coordinate \[m\].
    pub camera_sd_m: f64,
    /// Heavy-tailed camera noise (Student's t, 3 degrees of freedom).
    pub heavy_tails: bool,
    /// A camera that loses markers.
    #[serde(default)]
    pub lost_markers: bool,
    /// Holds of one run scatter as in [`HoldScatter::USUAL`].
    #[serde(default)]
    pub holds_scatter: bool,
    /// Run-to-run relative error of the pressure \[-\].
    pub pressure_sd: f64,
    /// Run-to-run shift of the camera \[m\].
    pub alignment_sd_m: f64,
    /// By which laws the effects act.
    #[serde(default, skip_serializing_if = "Laws::are_first")]
    pub laws: Laws,
    /// Hidden effects with their sizes; empty if nothing is hidden.
    #[serde(default, rename = "effect")]
    pub effects: Vec<HiddenChoice>,
}

/// Random numbers of one dataset: a separate stream for every (seed, index).
pub struct Draw(NormalNumbers);

impl Draw {
    /// Stream number `index` of a seed.
    pub fn new(seed: u64, index: u64) -> Draw {
        // Steps of an odd constant (2⁶⁴ over the golden ratio) keep neighbouring streams far apart.
        Draw(NormalNumbers::new(seed.wrapping_add(index.wrapping_add(1).wrapping_mul(0x9E37_79B9_7F4A_7C15))))
    }

    /// A uniform random number in [low, high).
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.0.uniform()
    }

    /// One of a list that is not empty.
    pub fn one_of<'a, T>(&mut self, list: &'a [T]) -> &'a T {
        &list[((list.len() as f64 * self.0.uniform()) as usize).min(list.len() - 1)]
    }
}

impl Truth {
    /// Draws a robot of that actuator with a bending stiffness within 15 % of its usual one, camera noise of 0.5–2 mm, 3,
    /// 5 or 10 runs, 2 % pressure and 0.5 mm alignment scatter between runs, scatter of holds, and nothing hidden.
    ///
    /// # Errors
    /// Not an actuator of [`ROBOTS`].
    pub fn draw(actuator: &str, draw: &mut Draw) -> Result<Truth, CompareError> {
        let (_, usual) = robot(actuator)?;
        Ok(Truth {
            actuator: actuator.to_string(),
            bending_nm2: usual * draw.between(0.85, 1.15),
            seed: draw.between(0.0, 1e15) as u64,
            runs: *draw.one_of(&[3, 5, 10]),
            camera_sd_m: *draw.one_of(&[0.5e-3, 1e-3, 2e-3]),
            heavy_tails: false,
            lost_markers: false,
            holds_scatter: true,
            pressure_sd: 0.02,
            alignment_sd_m: 0.5e-3,
            laws: Laws::First,
            effects: Vec::new(),
        })
    }

    /// Hides effects of that kind, each of 0.8–1.5 typical sizes; effects outside the catalogue have their typical size.
    pub(crate) fn hide(&mut self, kind: Hiding, draw: &mut Draw) -> Result<(), CompareError> {
        let inside = applicable(&self.actuator, HIDDEN)?;
        let first = draw.one_of(&inside).name;
        match kind {
            Hiding::Nothing => {}
            Hiding::One => self.add(first, draw.between(0.8, 1.5)),
            Hiding::Two => {
                let others: Vec<_> = inside.iter().filter(|effect| effect.name != first).collect();
                self.add(first, draw.between(0.8, 1.5));
                let second = draw.one_of(&others).name;
                self.add(second, draw.between(0.8, 1.5));
            }
            Hiding::Outside => self.add(draw.one_of(OUTSIDE).name, 1.0),
        }
        Ok(())
    }

    /// Adds an effect of this size to those that are hidden.
    pub fn add(&mut self, name: &str, times_typical: f64) {
        self.effects.push(HiddenChoice { name: name.to_string(), times_typical });
    }

    /// What the diagnosing side is given: the shipped robot with its usual bending stiffness.
    ///
    /// # Errors
    /// Not an actuator of [`ROBOTS`].
    pub fn told(&self) -> Result<Scenario, CompareError> {
        usual(&self.actuator)
    }

    /// The same as a scenario file.
    pub(crate) fn told_text(&self) -> Result<String, CompareError> {
        let (_, usual) = robot(&self.actuator)?;
        let line = |line: &str| match line.starts_with("bending_stiffness_nm2") {
            true => format!("bending_stiffness_nm2 = {usual}    # assumed: usual for such a robot; fit it\n"),
            false => format!("{line}\n"),
        };
        Ok(plain(&self.actuator).unwrap_or_default().lines().map(line).collect())
    }

    /// The robot as it is.
    pub(crate) fn robot(&self) -> Result<TrueRobot, CompareError> {
        let scenario = robot(&self.actuator)?.0.with_bending(self.bending_nm2);
        let mut robot = TrueRobot::new(&scenario)?;
        for choice in &self.effects {
            let effect = known(&choice.name)?;
            if !effect.applies_to(&scenario) {
                let problem = format!("{} does not exist for a robot of actuator {}", choice.name, self.actuator);
                return Err(CompareError::NotSimulated { problem });
            }
            let amount = choice.times_typical * effect.typical(self.laws, &self.actuator, &robot)?;
            effect.put(self.laws, &mut robot, amount);
        }
        Ok(robot)
    }

    pub(crate) fn measurement(&self, protocol: &[[f64; 2]]) -> Measurement {
        let generator = Generator {
            seed: self.seed,
            runs: self.runs,
            camera_sd_m: self.camera_sd_m,
            pressure_sd: self.pressure_sd,
            alignment_sd_m: self.alignment_sd_m,
            protocol: protocol.to_vec(),
            per_hold: if self.holds_scatter { HoldScatter::USUAL } else { HoldScatter::default() },
            ..Generator::default()
        };
        Measurement { generator, heavy_tails: self.heavy_tails, lost_markers: self.lost_markers }
    }

    /// The dataset under a protocol.
    ///
    /// # Errors
    /// A robot that does not balance; a hold at which nothing balances.
    pub fn dataset(&self, name: &str, protocol: &[[f64; 2]]) -> Result<Dataset, CompareError> {
        measure(&self.robot()?, &self.told()?, name, &self.measurement(protocol))
    }
}

/// The standard protocol: 0, 10, 20, 30, 0 kPa on a body of 2 kPa.
pub fn standard_protocol() -> Vec<[f64; 2]> {
    Generator::default().protocol
}

/// The shipped robot of that actuator with its usual bending stiffness.
pub(super) fn usual(actuator: &str) -> Result<Scenario, CompareError> {
    let (scenario, usual) = robot(actuator)?;
    Ok(scenario.with_bending(usual))
}

/// The effects of a list that a robot of that actuator can have.
pub(crate) fn applicable(actuator: &str, list: &[HiddenEffect]) -> Result<Vec<HiddenEffect>, CompareError> {
    let (scenario, _) = robot(actuator)?;
    Ok(list.iter().filter(|effect| effect.applies_to(&scenario)).copied().collect())
}

/// The effect of that name.
pub(crate) fn known(name: &str) -> Result<&'static HiddenEffect, CompareError> {
    by_name(name).ok_or_else(|| {
        let names: Vec<&str> = HIDDEN.iter().chain(ALSO).chain(OUTSIDE).map(|effect| effect.name).collect();
        let problem = format!("no hidden effect `{name}`; {}", spelling::known(name, &names));
        CompareError::NotSimulated { problem }
    })
}

/// The shipped robot as this generator knows its physics.
fn plain(kind: &str) -> Option<&'static str> {
    shipped(&format!("{kind}-textbook"))
}

fn robot(actuator: &str) -> Result<(Scenario, f64), CompareError> {
    let missing = |problem: String| CompareError::NoScenario { kind: actuator.to_string(), problem };
    let known = ROBOTS.iter().find(|(kind, _)| *kind == actuator);
    let (kind, usual) = known.ok_or_else(|| missing(spelling::known(actuator, &ROBOTS.map(|(kind, _)| kind))))?;
    let text = plain(kind).ok_or_else(|| missing("it is not shipped".into()))?;
    let scenario = Scenario::parse(text).map_err(|error| missing(error.to_string()))?;
    Ok((scenario, *usual))
}
