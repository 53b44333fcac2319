//! Strips of a section: their coordinates at a bend, where ε₀ is given or follows from their pull.

use super::frame::direction;
use super::pulls::{AxisContraction, Pulls, StripFit, StripTangent};
use super::section::{StripSection, dot};
use super::state::StripState;
use crate::actuators::Actuator;
use crate::assembly::Strip;
use crate::error::Solved;
use crate::root::{Start, find_root};

/// Relative step of the stiffness of a strip.
const STEP: f64 = 1e-6;
/// Strips of a section whose coordinates are found together; with more, each is found for itself.
const MOST_TOGETHER: usize = 8;
/// Newton's steps for the coordinates of all strips at once; two are usual from a bend nearby.
const MOST_STEPS: usize = 12;
/// A step of a coordinate, over it, after which the tangent is exact to rounding.
const LAST_STEP: f64 = 1e-7;
/// Part of a coordinate's range below which it counts as zero when steps are compared with it.
const FLOOR: f64 = 1e-6;
/// Contraction tried first beyond a taut wall.
const FIRST_CONTRACTION: f64 = 1e-2;

impl StripSection<'_> {
    pub(super) fn fit(&self, strip: &Strip, actuator: &Actuator, p_act_pa: f64, a: f64, k: f64) -> StripFit {
        let site = &self.sites[strip.site];
        let (stroke, link) = ((actuator.stroke)(&site.shape, a), &site.linkage);
        let arm = link.arm_m + link.arm_growth * stroke.lift;
        let d_arm = link.arm_growth * stroke.d_lift;
        let geometric = link.stroke_fraction * stroke.contraction / arm;
        let d_geometric = (link.stroke_fraction * stroke.d_contraction - geometric * d_arm) / arm;
        let loads = self.loads(p_act_pa, 0.0);
        let slope = link.active_fraction * site.actuator_slope(a, &stroke, geometric, d_geometric, &loads);
        let cos2 = strip.cos_slant * strip.cos_slant;
        let tension = -slope / (link.stroke_fraction * stroke.d_contraction - cos2 * k * d_arm);
        let from_axis_m = arm - site.radius_m;
        let own = link.stroke_fraction * stroke.contraction - link.compliance_per_n * tension;
        StripFit { contraction: own / cos2 - from_axis_m * k, force: tension * strip.cos_slant, from_axis_m, tension }
    }

    /// Coordinate of a strip at a contraction of the axis and a bend: the end of its range where it goes no further.
    pub(super) fn coordinate(
        &self,
        strip: &Strip,
        actuator: &Actuator,
        state: &StripState,
        contraction: f64,
        k: f64,
    ) -> f64 {
        let (low, high) = actuator.range;
        let of = |a: f64| self.fit(strip, actuator, state.p_act_pa, a, k).contraction;
        let x = if state.coordinate > low && state.coordinate < high { state.coordinate } else { 0.5 * (low + high) };
        let step = STEP * (high - low);
        let slope = (of(x) - of(x + step)) / step;
        match find_root(&mut |a| contraction - of(a), actuator.range, Start::guess(x, slope)) {
            Ok(root) => root.x + root.step,
            Err(_) if contraction < of(0.5 * (low + high)) => low,
            Err(_) => high,
        }
    }

    fn tangent(&self, strip: &Strip, actuator: &Actuator, p_act_pa: f64, a: f64, k: f64) -> StripTangent {
        let (at, step) = (|a: f64| self.fit(strip, actuator, p_act_pa, a, k), STEP * a.abs().max(STEP));
        let (up, down) = (at(a + step), at(a - step));
        let slope = StripFit::default().moved(0.5 / step, up).moved(-0.5 / step, down);
        StripTangent { a, at: at(a), slope }
    }

    /// Pulls of all open strips, their coordinates found together by Newton's steps from those in `strips`, with ε₀.
    ///
    /// None where that does not settle: at the end of a range, beyond [`MOST_TOGETHER`] strips, or where the pull does not fall with the
    /// contraction.
    pub(super) fn settled(
        &self,
        strips: &mut [StripState],
        kappa: [f64; 2],
        held: AxisContraction,
    ) -> Option<(f64, Pulls)> {
        let mut tangents = [StripTangent::default(); MOST_TOGETHER];
        for (i, _, actuator) in self.opened(strips) {
            let ((low, high), a) = (actuator.range, strips[i].coordinate);
            tangents.get_mut(i)?.a = if a > low && a < high { a } else { 0.5 * (low + high) };
        }
        for _ in 0..MOST_STEPS {
            let (mut force, mut rise) = (0.0, 0.0);
            for (i, strip, actuator) in self.opened(strips) {
                let k = dot(kappa, direction(strip.azimuth_rad));
                let tangent = self.tangent(strip, actuator, strips[i].p_act_pa, tangents[i].a, k);
                let per_contraction = tangent.slope.force / tangent.slope.contraction;
                force += tangent.at.force - per_contraction * tangent.at.contraction;
                rise += per_contraction;
                tangents[i] = tangent;
            }
            let contraction = match held {
                AxisContraction::At(contraction) => contraction,
                AxisContraction::By { thrust_n, floor } => {
                    Some((thrust_n - force) / rise).filter(|e| rise < 0.0 && *e > floor)?
                }
            };
            let step = |tangent: &StripTangent| (contraction - tangent.at.contraction) / tangent.slope.contraction;
            let is_short = |(i, _, actuator): (usize, _, &Actuator)| {
                let (a, (low, high)) = (tangents[i].a, actuator.range);
                step(&tangents[i]).abs() <= LAST_STEP * (a.abs() + FLOOR * (high - low))
            };
            if self.opened(strips).all(is_short) {
                let mut sum = Pulls::default();
                for (strip, (state, tangent)) in self.strips.iter().zip(strips.iter_mut().zip(&tangents)) {
                    if state.is_open {
                        let fit = tangent.at.moved(step(tangent), tangent.slope);
                        (state.coordinate, state.tension) = (tangent.a + step(tangent), fit.tension);
                        sum.add(strip, fit, tangent);
                    }
                }
                return Some((contraction, sum));
            }
            for (i, _, actuator) in self.opened(strips) {
                let ((low, high), a) = (actuator.range, tangents[i].a);
                let next = Some(a + step(&tangents[i])).filter(|next| !next.is_nan())?;
                tangents[i].a = next.clamp(0.5 * (a + low), 0.5 * (a + high));
            }
        }
        None
    }

    pub(super) fn pulls(&self, strips: &mut [StripState], kappa: [f64; 2], contraction: f64) -> Pulls {
        if let Some((_, pulls)) = self.settled(strips, kappa, AxisContraction::At(contraction)) {
            return pulls;
        }
        let mut sum = Pulls::default();
        for (strip, state) in self.strips.iter().zip(strips) {
            let Some(actuator) = self.sites[strip.site].actuator.filter(|_| state.is_open) else { continue };
            let k = dot(kappa, direction(strip.azimuth_rad));
            let a = self.coordinate(strip, actuator, state, contraction, k);
            let tangent = self.tangent(strip, actuator, state.p_act_pa, a, k);
            (state.coordinate, state.tension) = (a, tangent.at.tension);
            sum.add(strip, tangent.at, &tangent);
        }
        sum
    }

    /// Contraction and pulls on the taut floor, or beyond it where the strips pull harder than `thrust_n`; whether beyond.
    pub(super) fn held(
        &self,
        strips: &mut [StripState],
        kappa: [f64; 2],
        thrust_n: f64,
        floor: f64,
    ) -> Solved<(f64, Pulls, bool)> {
        let pulls = self.pulls(strips, kappa, floor);
        if pulls.force <= thrust_n {
            return Ok((floor, pulls, false));
        }
        let mut excess = |e0: f64| self.pulls(strips, kappa, e0).force - thrust_n;
        // No slope: for flat pouches it is infinite.
        let start = Start::guess(floor + FIRST_CONTRACTION, 0.0);
        // A bend that is tried may be too sharp for any body.
        let root = find_root(&mut excess, (floor, f64::max(1.0, 2.0 * floor)), start)
            .map_err(|_| self.unsolved(strips, pulls.force))?;
        let contraction = root.x + root.step;
        Ok((contraction, self.pulls(strips, kappa, contraction), true))
    }
}
