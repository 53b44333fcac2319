//! Volumes of the gases, and their slopes by the pressures: what a controller of closed valves or of flows needs.
//!
//! At a fixed pose the energy Π of all terms knows a gas by its pressure alone, so its slopes are the volumes, whatever effects there are:
//!
//! ```text
//! V_a = V_a0 − ∂Π/∂P      V_b = A₀ L − ∂Π/∂p_b      ∂V_i/∂p_j = ∂V_j/∂p_i at equilibrium (Maxwell)
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | P, p_b | gauge pressures of the actuators of a channel, and of the body | Pa |
//! | V_a0, A₀ L | volume of a muscle at rest (a pouch has none), and of the body with its section at rest | m³ |
//!
//! **Validity**: pressures that are the set ones. With effects of the supply or of the body's pressure, columns are slopes by *set* pressures
//! and rows are volumes at true ones, so the matrix is not symmetric. The energy of a fold follows the pressure, so its round part is
//! in the volume. Where a pouch or muscle begins to open, the tension of a fold vanishes and its energy has no slope by the pressure: there
//! a gas would shrink as its pressure rises, which no stable state does, and every volume is NaN. Derived here (the envelope theorem);
//! finite elements measure the same on their mesh, `fem::robot::Inflated`.

use crate::error::Solved;
use crate::model::{Model, Prediction};
use crate::site::Site;
use crate::space::StripSection;
use crate::term::{CHANNELS, Loads};
use serde::Serialize;
use spelling::si;

/// Gases of a robot: one for every supply channel, and last the body's.
pub const GASES: usize = CHANNELS + 1;
/// Place of the body's gas in lists of [`GASES`].
pub const BODY_GAS: usize = CHANNELS;

/// Step of the slopes over pressure, as a share of it: energies are linear in pressures, folds go with their roots.
const STEP: f64 = 1e-3;

/// A slope of a volume by its own pressure below this share of it is rounding \[1/Pa\].
const LEAST_RISE: f64 = 1e-9;

/// Volumes of the gases of every channel and, last, of the body.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct GasVolumes {
    /// Volume of gas in the actuators of every channel and, last, in the body \[m³\]; NaN where the laws give none.
    #[serde(rename = "gas_cm3", serialize_with = "si::cm3")]
    pub m3: [f64; GASES],
    /// Slope of a volume (row) by a pressure (column), in the same order \[m³/Pa\]; NaN by the pressure of a flat actuator.
    #[serde(rename = "slope_cm3_per_kpa", serialize_with = "si::cm3_per_kpa")]
    pub per_pa: [[f64; GASES]; GASES],
}

impl Model {
    /// Volumes of actuators and body on the first loading, and their slopes by Richardson-extrapolated differences; `out` is overwritten.
    ///
    /// ```
    /// use models::{BODY_GAS, Loads, Model, Scenario, shipped};
    /// let model = Model::new(&Scenario::parse(shipped("epam").unwrap()).unwrap());
    /// let found = model.volumes(&Loads::uniform(2e3, 20e3), &mut model.prediction()).unwrap();
    /// let [by_body, by_actuator] = [found.per_pa[0][BODY_GAS], found.per_pa[BODY_GAS][0]];
    /// assert!((by_body / by_actuator - 1.0).abs() < 1e-5 && found.m3[BODY_GAS] > found.m3[0]);
    /// ```
    ///
    /// # Errors
    /// As [`Model::predict`].
    pub fn volumes(&self, loads: &Loads, out: &mut Prediction) -> Solved<GasVolumes> {
        self.settle(loads, out, false)?;
        let (m3, flat) = (self.gases_m3(loads, out), self.flat(loads, out));
        let mut per_pa = [[0.0; GASES]; GASES];
        for gas in self.channels().chain([BODY_GAS]) {
            let column = match flat.get(gas) {
                Some(true) => [f64::NAN; GASES],
                _ => self.slopes(loads, gas, &flat, out, &|loads, at| self.gases_m3(loads, at))?,
            };
            per_pa.iter_mut().zip(column).for_each(|(row, slope)| row[gas] = slope);
        }
        // A gas in a stable state does not shrink as its own pressure rises.
        let shrinks = |gas: usize| m3[gas] < 0.0 || per_pa[gas][gas] < -LEAST_RISE * m3[gas].abs();
        if self.channels().chain([BODY_GAS]).any(shrinks) {
            return Ok(GasVolumes { m3: [f64::NAN; GASES], per_pa: [[f64::NAN; GASES]; GASES] });
        }
        Ok(GasVolumes { m3, per_pa })
    }

    /// Volumes of a predicted state \[m³\].
    fn gases_m3(&self, loads: &Loads, at: &Prediction) -> [f64; GASES] {
        let (mut m3, body_pa, assembly) = ([0.0; GASES], self.body_pa(loads, &at.work), self.assembly());
        for (i, segment) in assembly.segments.iter().enumerate() {
            if !self.is_spatial() {
                let [actuator_m3, lost_m3] = self.moved_m3(body_pa, at, i);
                let site = &assembly.sites[segment.site];
                m3[site.channel] += at_rest_m2(site) * segment.length_m + actuator_m3;
                m3[BODY_GAS] += site.area_m2 * segment.length_m - lost_m3;
                continue;
            }
            let (bend, strips) = (&at.work.space.bends[i], &at.work.space.strips[i]);
            let energy = |body_pa: f64, strip: usize, p_act_pa: f64| {
                let (mut moved, mut sum) = (strips.clone(), 0.0);
                moved.get_mut(strip).into_iter().for_each(|state| state.p_act_pa = p_act_pa);
                StripSection::new(assembly, i, body_pa).energies(bend, &moved, &mut |_, energy| sum += energy);
                sum * segment.length_m
            };
            for (k, (strip, state)) in assembly.around[i].iter().zip(strips).enumerate() {
                let (site, length_m) = (&assembly.sites[strip.site], segment.length_m / strip.cos_slant);
                let moved_m3 = -by_pressure(state.p_act_pa, |p| energy(body_pa, k, p));
                m3[site.channel] += at_rest_m2(site) * length_m + moved_m3;
            }
            let at_rest_m3 = StripSection::new(assembly, i, body_pa).area_m2 * segment.length_m;
            m3[BODY_GAS] += at_rest_m3 - by_pressure(body_pa, |p| energy(p, strips.len(), 0.0));
        }
        if at.work.is_sheared() {
            m3[BODY_GAS] -= by_pressure(body_pa, |p| self.shear_energy(p, &at.work));
        }
        m3
    }

    /// What the actuator of a planar segment holds beyond its rest, and what the body has lost there \[m³\].
    pub(crate) fn moved_m3(&self, body_pa: f64, at: &Prediction, index: usize) -> [f64; 2] {
        let p_act_pa = at.work.p_act_pa[index];
        let energy = |pressures: [f64; 2]| {
            let mut sum = 0.0;
            self.site_energies(index, pressures, &at.work, &mut |_, energy| sum += energy);
            sum
        };
        let lost_m3 = by_pressure(body_pa, |p| energy([p, p_act_pa]));
        [-by_pressure(p_act_pa, |p| energy([body_pa, p])), lost_m3]
    }
}

/// Slope of an energy by a pressure, 0 at none.
fn by_pressure(p_pa: f64, energy: impl Fn(f64) -> f64) -> f64 {
    let step = STEP * p_pa;
    if step > 0.0 { (energy(p_pa + step) - energy(p_pa - step)) / (2.0 * step) } else { 0.0 }
}

/// Volume of the actuator of a place at rest, per length of actuator \[m²\].
fn at_rest_m2(site: &Site) -> f64 {
    let rest = site.actuator.map(|actuator| (actuator.stroke)(&site.shape, actuator.range.0.max(0.0)).volume);
    rest.map_or(0.0, |volume| site.linkage.active_fraction * volume)
}
