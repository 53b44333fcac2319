//! Typical sizes: a first law's entry gives its size; a second law's size is such that it moves the markers as far.

use super::kind::HiddenEffect;
use crate::laws::Laws;
use crate::measure::ideal;
use crate::robot::TrueRobot;
use crate::truth;
use compare::error::CompareError;
use compare::study::generate::Generator;
use std::sync::{Mutex, PoisonError};

const AGREED: f64 = 0.005;
const ROUNDS: usize = 40;
const STEP: f64 = 1.5;

/// Sizes of second laws found so far: they depend on actuator and effect alone.
static FOUND: Mutex<Vec<(String, &'static str, f64)>> = Mutex::new(Vec::new());

impl HiddenEffect {
    /// Amount of a typical size in a robot of that actuator, SI. The size of a second law moves the markers of the usual robot
    /// as far as the first one's does, root mean square, under the standard protocol.
    pub(crate) fn typical(&self, laws: Laws, actuator: &str, robot: &TrueRobot) -> Result<f64, CompareError> {
        if laws.are_first() || self.is_outside() {
            return Ok(self.size(laws, robot));
        }
        let known = |found: &[(String, &'static str, f64)]| {
            found.iter().find(|(kind, name, _)| kind == actuator && *name == self.name).map(|(.., size)| *size)
        };
        if let Some(size) = known(&FOUND.lock().unwrap_or_else(PoisonError::into_inner)) {
            return Ok(size);
        }
        let size = self.matched(&TrueRobot::new(&truth::usual(actuator)?)?)?;
        FOUND.lock().unwrap_or_else(PoisonError::into_inner).push((actuator.to_string(), self.name, size));
        Ok(size)
    }

    /// Amount of the second law that moves the markers as far as a typical one of the first.
    fn matched(&self, usual: &TrueRobot) -> Result<f64, CompareError> {
        let base = ideal(usual, &Generator::default())?;
        let wanted = self.moved(Laws::First, self.size(Laws::First, usual), usual, &base)?;
        let mut amount = self.size(Laws::Second, usual).ln();
        let mut before: Option<[f64; 2]> = None;
        for _ in 0..ROUNDS {
            let Ok(moved) = self.moved(Laws::Second, amount.exp(), usual, &base) else {
                // Nothing balances: too much of it.
                amount = before.map_or(amount - STEP, |[last, _]| 0.5 * (amount + last));
                continue;
            };
            let gap = (moved / wanted).ln();
            if gap.abs() < AGREED {
                return Ok(amount.exp());
            }
            let slope = before.map_or(1.0, |[last, gap_then]| ((gap - gap_then) / (amount - last)).clamp(0.2, 5.0));
            before = Some([amount, gap]);
            amount -= (gap / slope).clamp(-STEP, STEP);
        }
        let problem = format!("no amount of {} by its second law moves the markers as far as by its first", self.name);
        Err(CompareError::NotSimulated { problem })
    }

    /// How far an amount moves the markers, root mean square \[m\].
    fn moved(&self, laws: Laws, amount: f64, usual: &TrueRobot, base: &[f64]) -> Result<f64, CompareError> {
        let mut robot = usual.clone();
        self.put(laws, &mut robot, amount);
        let moved = ideal(&robot, &Generator::default())?;
        let square: f64 = moved.iter().zip(base).map(|(a, b)| (a - b).powi(2)).sum();
        Ok((square / base.len() as f64).sqrt())
    }
}
