//! Inverse and Jacobian: what a controller asks.

use crate::error::Unsolved;
use crate::model::{Model, Prediction};
use crate::root::{NoRoot, Root, Start, find_root};
use crate::term::{CHANNELS, Loads};

/// What the tip shall do.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Target {
    /// Height of the tip's centre line y \[m\].
    TipHeight(f64),
    /// Total bending angle \[rad\].
    Angle(f64),
}

/// Slopes of the tip pose by the pressure of one channel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TipSlope {
    /// ∂x/∂P \[m/Pa\].
    pub x_per_pa: f64,
    /// ∂y/∂P \[m/Pa\].
    pub y_per_pa: f64,
    /// ∂(angle)/∂P \[rad/Pa\].
    pub angle_per_pa: f64,
}

/// Step of the wider central difference relative to the pressure: short, because the laws have corners; rounding is
/// below 1e-8 there.
const JACOBIAN_STEP: f64 = 4e-4;
/// Step from zero pressure \[Pa\].
const LEAST_STEP_PA: f64 = 0.1;
/// First pressure tried, as a share of the largest.
const START: f64 = 0.2;
/// A target missed by no more than this is met \[m or rad\]: a picometre.
const MET: f64 = 1e-12;
/// Pressures sampled when the ends of the search interval do not bracket the target.
const SAMPLES: usize = 32;

impl TipSlope {
    fn combine(&self, a: f64, other: &TipSlope, b: f64) -> TipSlope {
        TipSlope {
            x_per_pa: a * self.x_per_pa + b * other.x_per_pa,
            y_per_pa: a * self.y_per_pa + b * other.y_per_pa,
            angle_per_pa: a * self.angle_per_pa + b * other.angle_per_pa,
        }
    }
}

impl Target {
    fn value(self) -> f64 {
        match self {
            Target::TipHeight(y) => y,
            Target::Angle(angle) => angle,
        }
    }

    fn of(self, at: &Prediction) -> f64 {
        match self {
            Target::TipHeight(_) => at.tip.y_m,
            Target::Angle(_) => at.tip.angle_rad,
        }
    }

    /// Name, unit and factor for messages.
    fn words(self) -> (&'static str, &'static str, f64) {
        match self {
            Target::TipHeight(_) => ("tip height", "mm", 1e3),
            Target::Angle(_) => ("bending angle", "deg", 180.0 / std::f64::consts::PI),
        }
    }
}

impl Model {
    /// Actuator pressure \[Pa\], the same in every channel, at which the tip is where it is wanted; `out` is then that
    /// state. Searches 0 to [`Model::p_max_pa`]; where several pressures do it, one of them.
    ///
    /// # Errors
    /// [`Unsolved::OutOfReach`] with the reachable range, or what [`Model::predict`] returns.
    pub fn pressure_for(&self, target: Target, p_body_pa: f64, out: &mut Prediction) -> Result<f64, Unsolved> {
        let mut reach = Reach { least: f64::INFINITY, most: f64::NEG_INFINITY, failed: None };
        let mut warm = false;
        let mut short = |p: f64| match self.settle(&Loads::uniform(p_body_pa, p), out, warm) {
            Ok(()) => {
                warm = true;
                target.value() - reach.note(target.of(out))
            }
            Err(error) => {
                reach.failed.get_or_insert(error);
                f64::NAN
            }
        };
        let whole = (0.0, self.p_max_pa());
        let found = search(&mut short, whole, target);
        match found.filter(|p| *p <= whole.1 * (1.0 + 1e-12)).map(|p| p.clamp(whole.0, whole.1)) {
            Some(p) => {
                self.predict(&Loads::uniform(p_body_pa, p), out)?;
                Ok(p)
            }
            None => Err(reach.error(target, whole.1)),
        }
    }

    /// Slopes of the tip pose by each channel's pressure, by Richardson-extrapolated central differences (forward ones
    /// at zero pressure); `out` is overwritten.
    ///
    /// # Errors
    /// What [`Model::predict`] returns.
    pub fn jacobian(&self, loads: &Loads, out: &mut Prediction) -> Result<[TipSlope; CHANNELS], Unsolved> {
        let mut slopes = [TipSlope { x_per_pa: 0.0, y_per_pa: 0.0, angle_per_pa: 0.0 }; CHANNELS];
        self.settle(loads, out, false)?;
        for (channel, slope) in slopes.iter_mut().enumerate().filter(|(channel, _)| self.uses(*channel)) {
            let step = JACOBIAN_STEP * loads.actuator_pa[channel];
            *slope = if step > 0.0 {
                let (wide, narrow) =
                    (self.chord(loads, channel, step, out)?, self.chord(loads, channel, 0.5 * step, out)?);
                narrow.combine(4.0 / 3.0, &wide, -1.0 / 3.0)
            } else {
                self.chord(loads, channel, LEAST_STEP_PA, out)?
            };
        }
        Ok(slopes)
    }

    /// Mean slope between P − step (not below 0) and P + step.
    fn chord(&self, loads: &Loads, channel: usize, step: f64, out: &mut Prediction) -> Result<TipSlope, Unsolved> {
        let (mut up, mut down) = (*loads, *loads);
        up.actuator_pa[channel] += step;
        down.actuator_pa[channel] = (down.actuator_pa[channel] - step).max(0.0);
        self.settle(&up, out, true)?;
        let high = out.tip;
        self.settle(&down, out, true)?;
        let per = 1.0 / (up.actuator_pa[channel] - down.actuator_pa[channel]);
        Ok(TipSlope {
            x_per_pa: (high.x_m - out.tip.x_m) * per,
            y_per_pa: (high.y_m - out.tip.y_m) * per,
            angle_per_pa: (high.angle_rad - out.tip.angle_rad) * per,
        })
    }

    fn uses(&self, channel: usize) -> bool {
        self.assembly().sites.iter().any(|site| site.actuator.is_some() && site.channel == channel)
    }
}

/// What the search has seen.
struct Reach {
    least: f64,
    most: f64,
    failed: Option<Unsolved>,
}

impl Reach {
    fn note(&mut self, value: f64) -> f64 {
        self.least = self.least.min(value);
        self.most = self.most.max(value);
        value
    }

    /// Nothing was predicted: why; else the range that was seen.
    fn error(self, target: Target, p_max_pa: f64) -> Unsolved {
        match self.failed {
            Some(error) if self.least > self.most => error,
            _ => out_of_reach(target, (self.least, self.most), p_max_pa),
        }
    }
}

/// Secant over the whole interval, and if its ends do not bracket the target, over a pair of samples that does.
fn search(short: &mut dyn FnMut(f64) -> f64, whole: (f64, f64), target: Target) -> Option<f64> {
    let mut f = |p: f64| short(p);
    // The response rises steeply from zero and flattens, so start low, with half the slope of the chord from zero.
    let x = START * whole.1;
    let known = f(x);
    let start = Start { x, f: Some(known), slope: -0.5 * (target.value() - known) / x };
    let root = find_root(&mut f, whole, start).or_else(|_| {
        let (low, high) = bracket(&mut f, whole).ok_or(NoRoot::Stalled { f: f64::NAN })?;
        if low == high {
            return Ok(Root { x: low, step: 0.0, slope: f64::NAN });
        }
        find_root(&mut f, (low, high), Start { x: 0.5 * (low + high), f: None, slope: f64::NAN })
    });
    root.ok().map(|root| root.x + root.step)
}

/// Two neighbouring samples between which the target is passed upwards; the same one twice where it is met.
fn bracket(short: &mut dyn FnMut(f64) -> f64, (low, high): (f64, f64)) -> Option<(f64, f64)> {
    let mut before = (low, short(low));
    if before.1.abs() <= MET {
        return Some((low, low));
    }
    for i in 1..=SAMPLES {
        // Dense at low pressure, where the response is steepest.
        let p = low + (high - low) * (i as f64 / SAMPLES as f64).powi(3);
        let miss = short(p);
        if before.1 >= 0.0 && miss <= 0.0 {
            return Some((before.0, p));
        }
        before = (p, miss);
    }
    None
}

fn out_of_reach(target: Target, (least, most): (f64, f64), p_max_pa: f64) -> Unsolved {
    let (what, unit, factor) = target.words();
    let wanted = target.value() * factor;
    let (lowest, highest) = (least * factor, most * factor);
    Unsolved::OutOfReach { what, wanted, lowest, highest, unit, p_max_kpa: p_max_pa / 1e3 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Scenario, shipped};

    fn model(kind: &str, more: &str) -> Model {
        Model::new(&Scenario::parse(&format!("{}{more}", shipped(kind).unwrap())).unwrap())
    }

    #[test]
    fn the_straight_robot_needs_no_pressure() {
        for kind in ["spam", "cpam", "epam", "fpam"] {
            let model = model(kind, "");
            let mut state = model.prediction();
            for target in [Target::TipHeight(0.0), Target::Angle(0.0)] {
                let p = model.pressure_for(target, 2e3, &mut state).unwrap();
                assert!(p.abs() < 1e-3 && target.of(&state).abs() < 1e-9, "{kind} {target:?}: {p}");
            }
        }
    }

    #[test]
    fn a_long_robot_that_curls_up_is_reached_on_its_steep_start() {
        let text = shipped("epam").unwrap().replace("length_mm = 360", "length_mm = 2400");
        let text = text.replace("count = 6 ", "count = 40 ");
        let model = Model::new(&Scenario::parse(&text).unwrap());
        let mut state = model.prediction();
        for wanted in [0.5, 1.0, 1.5] {
            model.pressure_for(Target::TipHeight(wanted), 2e3, &mut state).unwrap();
            assert!((state.tip.y_m - wanted).abs() < 1e-9, "{wanted}");
        }
    }
}
