//! Equilibrium of one section: the minimum of a convex energy over κ, the contraction ε₀ found inside.

use super::frame::{Bend, direction};
use super::lever::Outer;
use super::pulls::AxisContraction;
use super::state::StripState;
use crate::actuators::Actuator;
use crate::assembly::{Assembly, Segment, Strip};
use crate::error::{Solved, Unsolved};
use crate::site::{Site, SiteLoads, SiteState};
use std::f64::consts::PI;

/// Newton steps; a dozen are usual.
const MAX_ITERATIONS: usize = 80;
/// Moment left over, relative to the pressure's moment.
const TOLERANCE: f64 = 1e-11;
/// A step that is rounding \[1/m\].
const LEAST_STEP: f64 = 1e-13;
/// Curvature below which a bend has no direction \[1/m\].
pub(super) const STRAIGHT: f64 = 1e-12;
/// Determinant over the square of the trace, and trace over p_b A R², below which an energy is flat along some bend.
pub(super) const FLAT: f64 = 1e-8;
const HALVINGS: usize = 40;

pub(crate) struct StripSection<'a> {
    pub(super) sites: &'a [Site],
    pub(super) strips: &'a [Strip],
    pub(super) segment: Segment,
    pub(super) p_body_pa: f64,
    pub(super) radius_m: f64,
    pub(super) bending: f64,
    /// Curvature over which the hinge of the wall sets in \[1/m\].
    pub(super) hinge_per_m: f64,
    pub(crate) area_m2: f64,
    /// First moment of the area about the axis, (y, z) \[m³\].
    pub(super) moment_m3: [f64; 2],
    /// Distance of the centre line from the axis, away from the taut generator \[m\].
    pub(super) offset_m: f64,
    /// Moments and axial force from loads outside of the section.
    pub(super) outer: Outer,
}

pub(super) enum Acting {
    Nothing,
    /// One upright strip in a section that no other strip draws in.
    One(usize),
    /// Several strips, or one that the closed form does not cover.
    Several,
}

/// Slope and curvature of the energy by κ, with ε₀ at its best.
pub(super) struct SectionBalance {
    pub contraction: f64,
    pub slope: [f64; 2],
    pub second: [[f64; 2]; 2],
    /// Force with which the wall holds ε₀ at R|κ| \[N\].
    pub taut_n: f64,
    /// Moment of the wall against the first bend \[N·m\].
    pub hinge_nm: f64,
    /// By how much the contraction of the centre line grows with κ, and with an axial force at fixed κ \[1/N\].
    pub along: [f64; 2],
    pub give: f64,
}

pub(super) fn dot(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

impl<'a> StripSection<'a> {
    pub(crate) fn new(assembly: &'a Assembly, index: usize, p_body_pa: f64) -> StripSection<'a> {
        let (segment, strips) = (assembly.segments[index], assembly.around[index].as_slice());
        let body = &assembly.sites[segment.site];
        let round_m2 = PI * body.radius_m.powi(2);
        let (mut area_m2, mut moment_m3) = (round_m2, [0.0; 2]);
        for strip in strips {
            let site = &assembly.sites[strip.site];
            let [share, e] = [[site.body_pressure.share(), 0.0], direction(strip.azimuth_rad)];
            area_m2 += site.area_m2 - round_m2;
            // What the far side feels is A ȳ; about the axis it is A (ȳ − R).
            let about_axis = share[0] * round_m2 * site.radius_m - site.area_m2 * site.radius_m;
            moment_m3 = [moment_m3[0] + about_axis * e[0], moment_m3[1] + about_axis * e[1]];
        }
        StripSection {
            sites: &assembly.sites,
            strips,
            segment,
            p_body_pa,
            radius_m: body.radius_m,
            bending: body.bending.stiffness,
            hinge_per_m: body.body_pressure.hinge_per_m(),
            area_m2,
            moment_m3,
            offset_m: body.centre_line.from_taut_m - body.radius_m,
            outer: [0.0; 3],
        }
    }

    pub(super) fn under(self, outer: Outer) -> StripSection<'a> {
        StripSection { outer, ..self }
    }

    pub(super) fn loads(&self, p_act_pa: f64, moment: f64) -> SiteLoads {
        let s_m = self.segment.middle_m();
        SiteLoads { moment, s_m, ..SiteLoads::new(self.p_body_pa, p_act_pa) }
    }

    pub(super) fn is_open(&self, strip: &Strip, state: &StripState) -> bool {
        let site = &self.sites[strip.site];
        let Some(actuator) = site.actuator.filter(|_| site.is_open(self.p_body_pa, state.p_act_pa)) else {
            return false;
        };
        // Even flat it is held shut: by the body's gas at its sides, or by its folds.
        self.fit(strip, actuator, state.p_act_pa, actuator.range.0, 0.0).tension > 0.0
    }

    /// Its open strips with their actuators: what `acting` noted.
    pub(super) fn opened<'s>(
        &'s self,
        strips: &'s [StripState],
    ) -> impl Iterator<Item = (usize, &'s Strip, &'static Actuator)> {
        let open = |(i, strip): (usize, &'s Strip)| Some((i, strip, self.sites[strip.site].actuator?));
        self.strips.iter().enumerate().filter(|(i, _)| strips[*i].is_open).filter_map(open)
    }

    /// Slope of the energy by κ where ε₀ is at its best: R|κ|, or more where the strips pull harder than the gas.
    pub(super) fn balance(&self, strips: &mut [StripState], kappa: [f64; 2]) -> Solved<SectionBalance> {
        if strips.iter().all(|state| !state.is_open) {
            return Ok(self.passive_balance(kappa));
        }
        let (size, [outer_y, outer_z, axial]) = (kappa[0].hypot(kappa[1]), self.outer);
        let thrust_n = self.p_body_pa * self.area_m2 - axial;
        let floor = self.radius_m * size;
        let (contraction, pulls, is_slack) = match self.settled(strips, kappa, AxisContraction::By { thrust_n, floor })
        {
            Some((contraction, pulls)) => (contraction, pulls, true),
            None => self.held(strips, kappa, thrust_n, floor)?,
        };
        let taut_n = if is_slack { 0.0 } else { thrust_n - pulls.force };
        let n = if size > STRAIGHT { kappa.map(|k| k / size) } else { [0.0; 2] };
        let held = taut_n * self.radius_m - axial * self.offset_m;
        let slope = std::array::from_fn(|i| {
            let own = self.p_body_pa * self.moment_m3[i] + self.bending * kappa[i] + held * n[i] - pulls.moment[i];
            own - [outer_y, outer_z][i]
        });
        let stiffness = pulls.stiffness.max(f64::MIN_POSITIVE);
        let second = |i: usize, j: usize| {
            let own = if i == j { self.bending } else { 0.0 };
            let across = if i == j { 1.0 - n[i] * n[j] } else { -n[i] * n[j] };
            if is_slack {
                let turned = if size > STRAIGHT { held / size * across } else { 0.0 };
                return own + pulls.bend[i][j] - pulls.mixed[i] * pulls.mixed[j] / stiffness + turned;
            }
            let r = self.radius_m;
            let taut = pulls.bend[i][j] + r * (n[i] * pulls.mixed[j] + n[j] * pulls.mixed[i]);
            own + taut + r * r * pulls.stiffness * n[i] * n[j] + held / size.max(STRAIGHT) * across
        };
        let own = |i: usize| if is_slack { -pulls.mixed[i] / stiffness } else { self.radius_m * n[i] };
        Ok(SectionBalance {
            contraction,
            slope,
            second: [[second(0, 0), second(0, 1)], [second(1, 0), second(1, 1)]],
            taut_n,
            hinge_nm: held,
            along: std::array::from_fn(|i| own(i) + self.offset_m * n[i]),
            give: if is_slack { 1.0 / stiffness } else { 0.0 },
        })
    }

    /// The equilibrium; `strips` has the pressures, and gets the rest.
    pub(crate) fn solve(&self, strips: &mut [StripState]) -> Solved<Bend> {
        for state in &mut *strips {
            (state.coordinate, state.tension) = (0.0, 0.0);
        }
        let kappa = match self.acting(strips) {
            Acting::Nothing => return Ok(Bend::default()),
            Acting::One(one) => return Ok(self.alone(one, &mut strips[one])?.0),
            Acting::Several => self.first_guess(strips),
        };
        self.minimum(strips, kappa)
    }

    /// What acts at the pressures in `strips`; notes which of them are open.
    pub(super) fn acting(&self, strips: &mut [StripState]) -> Acting {
        for (strip, state) in self.strips.iter().zip(&mut *strips) {
            state.is_open = self.is_open(strip, state);
        }
        let mut opened = self.opened(strips).map(|(i, ..)| i);
        match (opened.next(), opened.next()) {
            (None, _) => Acting::Nothing,
            (Some(one), None) if self.strips[one].cos_slant == 1.0 && self.is_round_but(one) => Acting::One(one),
            _ => Acting::Several,
        }
    }

    /// Whether no other strip draws the section in: then a strip alone bends it in its own plane.
    fn is_round_but(&self, one: usize) -> bool {
        let round = |site: &Site| site.area_m2 == PI * site.radius_m.powi(2);
        (0..self.strips.len()).all(|i| i == one || round(&self.sites[self.strips[i].site]))
    }

    /// The planar balance of one strip, turned, with its compliance.
    pub(super) fn alone(&self, one: usize, state: &mut StripState) -> Solved<(Bend, f64)> {
        let (strip, [y, z, axial]) = (&self.strips[one], self.outer);
        let moment = dot([y, z], direction(strip.azimuth_rad)) + (self.radius_m + self.offset_m) * axial;
        let loads = self.loads(state.p_act_pa, moment);
        let solved = self.sites[strip.site].solve(&loads, &[], None);
        let at: SiteState = solved.map_err(|_| self.unsolved(std::slice::from_ref(state), 0.0))?;
        (state.coordinate, state.tension) = (at.coordinate, at.tension);
        let kappa = direction(strip.azimuth_rad).map(|e| at.curvature * e);
        Ok((Bend { kappa, contraction: self.radius_m * at.curvature.abs() }, at.compliance))
    }

    /// The bends of all strips alone, added.
    pub(super) fn first_guess(&self, strips: &mut [StripState]) -> [f64; 2] {
        let mut sum = [0.0; 2];
        for (strip, state) in self.strips.iter().zip(strips) {
            let site = &self.sites[strip.site];
            let Ok(at) = site.solve(&self.loads(state.p_act_pa, 0.0), &[], None) else { continue };
            state.coordinate = if state.is_open { at.coordinate } else { 0.0 };
            let e = direction(strip.azimuth_rad);
            sum = [sum[0] + at.curvature * e[0], sum[1] + at.curvature * e[1]];
        }
        if sum[0].hypot(sum[1]) < 1e-9 { [0.0; 2] } else { sum }
    }

    pub(super) fn minimum(&self, strips: &mut [StripState], start: [f64; 2]) -> Solved<Bend> {
        let scale = self.p_body_pa * self.area_m2 * self.radius_m;
        let mut kappa = start;
        let mut at = self.balance(strips, kappa)?;
        // Under a load the minimum of a slack body may be far along a flat way.
        let mut reach = 1.0;
        for _ in 0..MAX_ITERATIONS {
            let size = kappa[0].hypot(kappa[1]);
            let left = at.slope[0].hypot(at.slope[1]);
            // At the tip of the cone the wall takes any moment up to this.
            let carried = if size <= STRAIGHT { at.hinge_nm } else { 0.0 };
            if left <= TOLERANCE * scale + carried {
                return Ok(Bend { kappa, contraction: at.contraction });
            }
            let ([[mut a, b], [_, mut d]], g) = (at.second, at.slope);
            let usual = scale * self.radius_m;
            let is_flat = a + d <= FLAT * usual || a * d - b * b <= FLAT * (a + d).powi(2);
            if is_flat || size <= STRAIGHT && at.taut_n > 0.0 {
                // Fewer strips pull on a slack body than it has ways to give: flat along some, or rounding alone.
                (a, d) = (a + usual, d + usual);
            }
            let det = a * d - b * b;
            let mut step = [-(d * g[0] - b * g[1]) / det, -(a * g[1] - b * g[0]) / det];
            step = step.map(|s| s * reach);
            let longest = 2.0 / self.radius_m;
            let length = step[0].hypot(step[1]);
            if length.is_nan() {
                break;
            }
            if length > longest {
                step = step.map(|s| s * longest / length);
            }
            let before = dot(at.slope, step);
            let mut share = 1.0;
            for _ in 0..HALVINGS {
                let next = [kappa[0] + share * step[0], kappa[1] + share * step[1]];
                at = self.balance(strips, next)?;
                // The slope along the way rises: beyond the minimum it is positive.
                if dot(at.slope, step) <= -0.9 * before {
                    break;
                }
                share *= 0.5;
            }
            let goes_on = is_flat && share == 1.0 && self.outer != [0.0; 3];
            reach = if goes_on { 2.0 * reach } else { 1.0 };
            kappa = [kappa[0] + share * step[0], kappa[1] + share * step[1]];
            if share * step[0].hypot(step[1]) <= LEAST_STEP * (1.0 + kappa[0].hypot(kappa[1])) {
                return Ok(Bend { kappa, contraction: at.contraction });
            }
        }
        Err(self.unsolved(strips, at.slope[0].hypot(at.slope[1])))
    }

    pub(super) fn unsolved(&self, strips: &[StripState], residual: f64) -> Unsolved {
        let p_act_kpa = strips.iter().fold(0.0, |most: f64, state| most.max(state.p_act_pa)) / 1e3;
        Unsolved::NotConverged { iterations: MAX_ITERATIONS, p_act_kpa, residual }
    }
}
