//! Inverse and Jacobian: what a controller asks.

use crate::error::{Solved, Unsolved};
use crate::model::{MOST_ACTUATOR_PA, Model, Prediction};
use crate::reach::{MET, Reach, SAMPLES, reach};
use crate::root::{Start, find_root};
use crate::term::{CHANNELS, Loads};
use spelling::si;

/// Quantity of the tip that an inverse brings to a target value.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Target {
    /// Height of the tip's centre line y \[m\].
    TipHeight(f64),
    /// Total bending angle of the body from base to tip \[rad\].
    Angle(f64),
}

/// Slopes of the tip pose by the pressure of one channel.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct TipSlope {
    /// Slope ∂x/∂P along the straight robot \[m/Pa\].
    #[serde(rename = "x_mm_per_kpa", serialize_with = "si::mm_per_kpa")]
    pub x_per_pa: f64,
    /// Slope ∂y/∂P across it, towards the actuator \[m/Pa\].
    #[serde(rename = "y_mm_per_kpa", serialize_with = "si::mm_per_kpa")]
    pub y_per_pa: f64,
    /// Slope ∂(angle)/∂P of the total bending angle \[rad/Pa\].
    #[serde(rename = "angle_deg_per_kpa", serialize_with = "si::deg_per_kpa")]
    pub angle_per_pa: f64,
}

/// Step of the wider central difference relative to the pressure: short, because the laws have corners; rounding is
/// below 1e-8 there.
const JACOBIAN_STEP: f64 = 4e-4;
/// The range of what has no equilibrium anywhere.
const NOWHERE: (f64, f64) = (f64::NAN, f64::NAN);
/// First pressure tried, as a share of the largest.
const START: f64 = 0.2;

fn pressure(loads: &mut Loads, gas: usize) -> &mut f64 {
    loads.actuator_pa.get_mut(gas).unwrap_or(&mut loads.body_pa)
}

impl TipSlope {
    /// Of a flat actuator: it rises with an infinite slope, or not at all.
    pub const NONE: TipSlope = TipSlope { x_per_pa: f64::NAN, y_per_pa: f64::NAN, angle_per_pa: f64::NAN };
}

impl Target {
    fn value(self) -> f64 {
        let (Target::TipHeight(value) | Target::Angle(value)) = self;
        value
    }

    fn of(self, at: &Prediction) -> f64 {
        match self {
            Target::TipHeight(_) => at.tip.y_m,
            Target::Angle(_) => at.tip.angle_rad,
        }
    }

    fn is_met(self, at: &Prediction) -> bool {
        (self.of(at) - self.value()).abs() <= MET
    }

    fn missed(self, found: &Reach, p_max_pa: f64) -> Unsolved {
        let (what, unit, factor) = self.words();
        let target = self.value() * factor;
        match found {
            Reach::Gap { low, high, between } => {
                let (low_kpa, high_kpa) = (low.0 / 1e3, high.0 / 1e3);
                let (below, above) = (low.1 * factor, high.1 * factor);
                Unsolved::Jump { what, target, unit, low_kpa, below, high_kpa, above, between }
            }
            _ => {
                let (least, most) = if let Reach::Beyond { least, most } = found { (*least, *most) } else { NOWHERE };
                // A zero in print has no sign.
                let shown = |v: f64| if (v * factor).abs() < 5e-5 { 0.0 } else { v * factor };
                let (lowest, highest) = (shown(least), shown(most));
                Unsolved::OutOfReach { what, target, lowest, highest, unit, p_max_kpa: p_max_pa / 1e3 }
            }
        }
    }

    fn words(self) -> (&'static str, &'static str, f64) {
        match self {
            Target::TipHeight(_) => ("tip height", "mm", 1e3),
            Target::Angle(_) => ("bending angle", "deg", 180.0 / std::f64::consts::PI),
        }
    }
}

impl Model {
    /// Actuator pressure \[Pa\], the same in every channel, at which the tip is at its target, to 1e-9 of it; `out` is
    /// then that state, on the first loading from rest. Searches 0 to [`Model::p_max_pa`]; where several pressures do it, one
    /// of them.
    ///
    /// # Errors
    /// [`Unsolved::OutOfReach`] with the reachable range, [`Unsolved::Jump`] with both sides of the gap, or what
    /// [`Model::predict`] returns.
    pub fn pressure_for(&self, target: Target, p_body_pa: f64, out: &mut Prediction) -> Solved<f64> {
        let most = self.p_max_pa();
        let mut warm = false;
        let mut short = |p: f64| {
            let settled = self.settle(&Loads::uniform(p_body_pa, p), out, warm);
            warm = settled.is_ok();
            settled.map_or(f64::NAN, |()| target.value() - target.of(out))
        };
        // The response rises steeply from zero and flattens, so start low, with half the slope of the chord from zero.
        let x = START * most;
        let known = short(x);
        let start = Start::known(x, known, -0.5 * (target.value() - known) / x);
        let quick = find_root(&mut short, (0.0, most), start).ok().map(|root| root.x + root.step);
        // What was found from state to state counts if it is met from rest.
        let quick = quick.filter(|p| *p <= most * (1.0 + 1e-12)).map(|p| p.clamp(0.0, most));
        if let Some(p) = quick
            && self.predict(&Loads::uniform(p_body_pa, p), out).is_ok()
            && target.is_met(out)
        {
            return self.at_rest_too(target, p_body_pa, p, out);
        }
        let mut failed = None;
        let mut value = |p: f64| match self.settle(&Loads::uniform(p_body_pa, p), out, false) {
            Ok(()) => target.of(out),
            Err(error) => {
                failed.get_or_insert(error);
                f64::NAN
            }
        };
        let samples = SAMPLES[usize::from(!self.assembly().node_terms.is_empty())];
        let found = reach(&mut value, target.value(), most, samples);
        match (found, failed) {
            (Reach::At(p), _) => {
                self.predict(&Loads::uniform(p_body_pa, p), out)?;
                Ok(p)
            }
            (Reach::Nowhere, Some(error)) => Err(error),
            (found, _) => Err(target.missed(&found, most)),
        }
    }

    /// Zero where the target is met by flat actuators: all pressures up to `p` that leave them flat do the same.
    fn at_rest_too(&self, target: Target, p_body_pa: f64, p: f64, out: &mut Prediction) -> Solved<f64> {
        if self.states(out).iter().any(|state| state.coordinate != 0.0) {
            return Ok(p);
        }
        let rest = self.predict(&Loads::uniform(p_body_pa, 0.0), out);
        if rest.is_ok() && target.is_met(out) {
            return Ok(0.0);
        }
        self.predict(&Loads::uniform(p_body_pa, p), out).map(|()| p)
    }

    /// Slopes of the tip pose by each channel's pressure, by Richardson-extrapolated differences; [`TipSlope::NONE`] where an
    /// actuator of the channel is flat. `out` is overwritten.
    pub fn jacobian(&self, loads: &Loads, out: &mut Prediction) -> Solved<[TipSlope; CHANNELS]> {
        let mut slopes = [TipSlope { x_per_pa: 0.0, y_per_pa: 0.0, angle_per_pa: 0.0 }; CHANNELS];
        self.settle(loads, out, false)?;
        let flat = self.flat(loads, out);
        for channel in self.channels() {
            slopes[channel] = match flat[channel] {
                true => TipSlope::NONE,
                false => {
                    let tip = |_: &Loads, at: &Prediction| [at.tip.x_m, at.tip.y_m, at.tip.angle_rad];
                    let [x_per_pa, y_per_pa, angle_per_pa] = self.slopes(loads, channel, &flat, out, &tip)?;
                    TipSlope { x_per_pa, y_per_pa, angle_per_pa }
                }
            };
        }
        Ok(slopes)
    }

    /// Slopes of numbers of a state by the pressure of a gas, the body's at [`BODY_GAS`](crate::BODY_GAS): Richardson-extrapolated
    /// differences. They are central, and from one side, with an error of first order, at the bound of the pressure and where an
    /// actuator opens or closes within them; NaN between two such pressures.
    #[inline]
    pub(crate) fn slopes<const N: usize>(
        &self,
        loads: &Loads,
        gas: usize,
        flat: &[bool; CHANNELS],
        out: &mut Prediction,
        of: &impl Fn(&Loads, &Prediction) -> [f64; N],
    ) -> Solved<[f64; N]> {
        let p_pa = *pressure(&mut { *loads }, gas);
        let step = JACOBIAN_STEP * p_pa;
        // Mean slope between P − step (not below 0) and P + step, or to P on one side.
        let mut chord = |ends: [f64; 2], step: f64| -> Solved<([f64; N], [bool; 2])> {
            let at = ends.map(|end| (p_pa + end * step).max(0.0));
            let (mut found, mut is_alike) = ([[0.0; N]; 2], [true; 2]);
            for k in [1, 0] {
                let mut moved = *loads;
                *pressure(&mut moved, gas) = at[k];
                self.settle(&moved, out, true)?;
                is_alike[k] = self.flat(&moved, out) == *flat;
                found[k] = of(&moved, out);
            }
            let per = 1.0 / (at[1] - at[0]);
            Ok((std::array::from_fn(|i| (found[1][i] - found[0][i]) * per), is_alike))
        };
        let mut ends = [-1.0, if p_pa * (1.0 + JACOBIAN_STEP) > MOST_ACTUATOR_PA { 0.0 } else { 1.0 }];
        let (mut wide, is_alike) = chord(ends, step)?;
        match is_alike {
            [true, true] => {}
            [false, false] => return Ok([f64::NAN; N]),
            [is_low, _] => {
                ends = if is_low { [-1.0, 0.0] } else { [0.0, 1.0] };
                wide = chord(ends, step)?.0;
            }
        }
        let (narrow, _) = chord(ends, 0.5 * step)?;
        let [of_narrow, of_wide] = if ends == [-1.0, 1.0] { [4.0 / 3.0, -1.0 / 3.0] } else { [2.0, -1.0] };
        Ok(std::array::from_fn(|i| of_narrow * narrow[i] + of_wide * wide[i]))
    }

    /// Channels with an actuator that its pressure has not opened.
    pub(crate) fn flat(&self, loads: &Loads, at: &Prediction) -> [bool; CHANNELS] {
        let (mut flat, body_pa, work) = ([false; CHANNELS], self.body_pa(loads, &at.work), &at.work);
        let around = work.space.strips.iter().zip(&self.assembly().around).flat_map(|(states, strips)| {
            states.iter().zip(strips).map(|(state, strip)| (strip.site, state.p_act_pa, state.coordinate))
        });
        let along = self.assembly().segments.iter().filter(|_| !self.is_spatial()).zip(&work.p_act_pa);
        let along = along.zip(&work.states).map(|((segment, p), state)| (segment.site, *p, state.coordinate));
        for (site, p_act_pa, coordinate) in around.chain(along) {
            let site = &self.assembly().sites[site];
            // Its sides or folds may hold a pouch shut beyond the pressure from which it could open.
            let is_shut = |pouch: bool| !site.is_open(body_pa, p_act_pa) || pouch && coordinate == 0.0;
            flat[site.channel] |= site.actuator.is_some_and(|actuator| is_shut(actuator.has_pouches()));
        }
        flat
    }

    /// Supply channels that feed an actuator, rising; none of a beam.
    pub fn channels(&self) -> impl Iterator<Item = usize> + '_ {
        let feeds = |channel: &usize| {
            self.assembly().sites.iter().any(|site| site.actuator.is_some() && site.channel == *channel)
        };
        (0..CHANNELS).filter(feeds)
    }
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
        let text = shipped("epam-textbook").unwrap().replace("length_mm = 360", "length_mm = 2400");
        let text = text.replace("count = 6 ", "count = 40 ");
        let model = Model::new(&Scenario::parse(&text).unwrap());
        let mut state = model.prediction();
        for height in [0.5, 1.0, 1.5] {
            model.pressure_for(Target::TipHeight(height), 2e3, &mut state).unwrap();
            assert!((state.tip.y_m - height).abs() < 1e-9, "{height}");
        }
    }
}
