//! Inverse and Jacobian: what a controller asks.

use crate::error::Unsolved;
use crate::model::{Model, Prediction};
use crate::root::find_root;
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

/// Step of the central difference relative to the pressure: truncation and rounding are both below 1e-7 there.
const JACOBIAN_STEP: f64 = 1e-4;
/// Pressures sampled when the ends of the search interval do not bracket the target.
const SAMPLES: usize = 32;

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
        let mut failed = None;
        let mut short = |p: f64| match self.settle(&Loads::uniform(p_body_pa, p), out) {
            Ok(()) => target.value() - target.of(out),
            Err(error) => {
                failed.get_or_insert(error);
                f64::NAN
            }
        };
        let whole = (0.0, self.p_max_pa());
        // The response rises steeply from zero and flattens, so start low.
        let mut found = find_root(&mut short, whole, (0.2 * whole.1, None, 0.15 * whole.1));
        if found.is_err() {
            let (low, high) = bracket(&mut short, whole, target)?;
            found = find_root(&mut short, (low, high), (0.5 * (low + high), None, high));
        }
        match (found, failed) {
            (Ok(root), _) => {
                self.predict(&Loads::uniform(p_body_pa, root.x), out)?;
                Ok(root.x)
            }
            (Err(_), Some(error)) => Err(error),
            (Err(_), None) => Err(out_of_reach(target, (target.of(out), target.of(out)), whole.1)),
        }
    }

    /// Slopes of the tip pose by each channel's pressure, by central differences; `out` is overwritten.
    ///
    /// # Errors
    /// What [`Model::predict`] returns.
    pub fn jacobian(&self, loads: &Loads, out: &mut Prediction) -> Result<[TipSlope; CHANNELS], Unsolved> {
        let mut slopes = [TipSlope { x_per_pa: 0.0, y_per_pa: 0.0, angle_per_pa: 0.0 }; CHANNELS];
        for (channel, slope) in slopes.iter_mut().enumerate() {
            if !self.uses(channel) {
                continue;
            }
            let p = loads.actuator_pa[channel];
            let step = (JACOBIAN_STEP * p).max(0.1).min(if p > 0.0 { p } else { 0.1 });
            let (mut up, mut down) = (*loads, *loads);
            up.actuator_pa[channel] = p + step;
            down.actuator_pa[channel] = (p - step).max(0.0);
            let width = up.actuator_pa[channel] - down.actuator_pa[channel];
            self.predict(&up, out)?;
            let high = out.tip;
            self.predict(&down, out)?;
            slope.x_per_pa = (high.x_m - out.tip.x_m) / width;
            slope.y_per_pa = (high.y_m - out.tip.y_m) / width;
            slope.angle_per_pa = (high.angle_rad - out.tip.angle_rad) / width;
        }
        Ok(slopes)
    }

    fn uses(&self, channel: usize) -> bool {
        self.assembly().sites.iter().any(|site| site.actuator.is_some() && site.channel == channel)
    }
}

/// Two neighbouring samples between which the target is passed upwards, or the range that was seen.
fn bracket(short: &mut dyn FnMut(f64) -> f64, (low, high): (f64, f64), target: Target) -> Result<(f64, f64), Unsolved> {
    let (mut least, mut most) = (f64::INFINITY, f64::NEG_INFINITY);
    let mut before = (low, short(low));
    for i in 0..=SAMPLES {
        let p = low + (high - low) * i as f64 / SAMPLES as f64;
        let miss = short(p);
        least = least.min(target.value() - miss);
        most = most.max(target.value() - miss);
        if before.1 >= 0.0 && miss <= 0.0 {
            return Ok((before.0, p));
        }
        before = (p, miss);
    }
    Err(out_of_reach(target, (least, most), high))
}

fn out_of_reach(target: Target, (least, most): (f64, f64), p_max_pa: f64) -> Unsolved {
    let (what, unit, factor) = target.words();
    let wanted = target.value() * factor;
    let (lowest, highest) = (least * factor, most * factor);
    Unsolved::OutOfReach { what, wanted, lowest, highest, unit, p_max_kpa: p_max_pa / 1e3 }
}
