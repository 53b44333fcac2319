//! One place of the robot: its actuator, its wall, and the linkage between the two; the moment balance there.
//!
//! ```text
//!        actuator side                    linkage                         body side
//!   a ─► ε(a), v(a), lift(a)      η_ε ε = κ D + c N/W,  D = D₀ + β·lift    κ ─► wall, body pressure
//!        N = −η ∂U/∂a / (η_ε ε' − κ D')                                     N D + M_load = ∂U/∂κ
//! ```
//!
//! With a section that changes as it bends, the curvature g of one that does not takes the place of κ on the left: [`SectionLaw`].
//!
//! The taut generator on the far side keeps its length; κ is the heading change per length of it, D the arm from it to
//! the actuator's line of action. One unknown, the actuator's coordinate `a`, decides everything, because every law is
//! explicit in it; the balance is one scalar equation per place.

mod compliance;
mod energies;
mod held;
mod starts;
mod tabulated;
mod turn;
mod wall;

use crate::actuators::{Actuator, ActuatorShape, Demand, Stroke};
use crate::body::{BodyLaw, BodyPressure, WallBending};
use crate::linkage::{ActuatorPressure, line_tension};
pub use crate::linkage::{Linkage, SectionLaw};
use crate::root::{NoRoot, Root, Start, find_root};
pub use crate::shape::LineShortening;
use crate::term::{Pose, Remembering, Term, actuator_q};
use crate::weave::Weave;
use starts::Starts;
use std::f64::consts::PI;

/// One place of the robot while a model is put together; an effect changes what it owns.
pub struct Site {
    /// Radius R of the inflated body \[m\].
    pub radius_m: f64,
    /// Centre line: R from the taut generator, or at the scenario's distance.
    pub centre_line: LineShortening,
    /// Actuator kind, `None` on a passive stretch.
    pub actuator: Option<&'static Actuator>,
    /// Dimensions of one actuator unit, after the effects that change them.
    pub shape: ActuatorShape,
    /// Width of the strip as cut \[m\]: it is what the wall loses to the actuator, whatever welds take of the pouch.
    pub(crate) strip_m: f64,
    /// What effects make of a muscle's tube.
    pub weave: Weave,
    /// Supply channel that fills the actuator, an index into [`crate::Loads::actuator_pa`].
    pub channel: usize,
    /// Relation between the contraction of the actuator and the curvature of the body.
    pub linkage: Linkage,
    /// Share χ of the actuator's volume that is in the body and works against its pressure.
    pub inner_share: f64,
    /// Bending stiffness of one sheet of the actuator \[N·m\], and of one side weld \[N·m²\]; 0 without the effects that have them.
    pub(crate) sheet_nm: f64,
    pub(crate) weld_nm2: f64,
    /// Share of the sides that are gussets which their ends hold.
    pub gusset_share: f64,
    /// Area of the section at rest \[m²\]: a circle's, unless the actuator draws it in.
    pub area_m2: f64,
    /// First moment of that area about the body's axis, towards the actuator \[m³\]: 0 of a circle.
    pub(crate) first_m3: f64,
    /// What its terms do in addition to their energy.
    pub(crate) side_effects: SideEffects,
    /// Starts in place of the actuator's guess.
    starts: Option<Starts>,
    /// Terms over [`actuator_q`], J per metre of body at η = 1; `act` adds one.
    pub actuator_terms: Vec<Box<dyn Term>>,
    /// Body pressure work; an effect may replace the law.
    pub body_pressure: BodyLaw,
    /// Elastic bending of the wall with its effective stiffness B.
    pub bending: WallBending,
    /// Further terms over `[κ]`, J per metre of body.
    pub body_terms: Vec<Box<dyn Remembering>>,
    /// Shear stiffness of the wall G t \[N/m\]; `None`: transverse loads do not shear the body.
    pub wall_shear_n_per_m: Option<f64>,
}

/// Changes that a term of the actuator makes in addition to its energy; none by default.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct SideEffects {
    /// The actuator stays flat below this share of the body's pressure; terms add up.
    pub closes: f64,
    /// Width of a pouch that it takes per half height of its middle; terms add up.
    pub narrows: f64,
    /// It shifts the balance away from the actuator's first guess, so starts are tabulated.
    pub shifts_balance: bool,
    /// Share of the body's pressure from which they are, where it does not close; the largest counts.
    pub tabulated_from: f64,
}

impl SideEffects {
    pub(crate) const SHIFT: SideEffects =
        SideEffects { closes: 0.0, narrows: 0.0, shifts_balance: true, tabulated_from: 0.0 };
}

/// Equilibrium of one place, with the loads at which it was found.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SiteState {
    /// Actuator coordinate; 0 on a passive or unpressurised stretch.
    pub coordinate: f64,
    /// Curvature per length of the taut generator \[1/m\].
    pub curvature: f64,
    /// Tension of the actuator's line N \[N\].
    pub tension: f64,
    /// dκ/dM_load \[1/(N·m·m)\]: how this place gives way to a transverse load.
    pub compliance: f64,
    /// Loads it balances, and slope and weight of the imbalance there: what the next start needs.
    loads: SiteLoads,
    slope: f64,
    weight: f64,
}

impl SiteState {
    pub(crate) const REST: SiteState = SiteState {
        coordinate: 0.0,
        curvature: 0.0,
        tension: 0.0,
        compliance: 0.0,
        loads: SiteLoads::new(0.0, 0.0),
        slope: 0.0,
        weight: 0.0,
    };
}

/// Pressures, external moment and time at one place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct SiteLoads {
    pub p_body_pa: f64,
    pub p_act_pa: f64,
    /// Generalised force of transverse loads on κ, per length \[N·m\].
    pub moment: f64,
    pub s_m: f64,
    /// Time since the remembered state \[s\].
    pub dt_s: f64,
    /// Which memory this is; 0 without.
    pub stamp: u32,
}

impl SiteLoads {
    pub(crate) const fn new(p_body_pa: f64, p_act_pa: f64) -> SiteLoads {
        SiteLoads { p_body_pa, p_act_pa, moment: 0.0, s_m: 0.0, dt_s: 0.0, stamp: 0 }
    }

    fn pose<'a>(&self, q: &'a [f64]) -> Pose<'a> {
        let SiteLoads { p_body_pa, p_act_pa, s_m, dt_s, .. } = *self;
        Pose { q, p_body_pa, p_act_pa, s_m, dt_s, memory: &[] }
    }
}

#[derive(Clone, Copy)]
struct Balance {
    coordinate: f64,
    curvature: f64,
    tension: f64,
    /// N D + M_load − ∂U/∂κ \[N·m\], times the stroke's weight: zero at equilibrium, nearly linear in `a`.
    imbalance: f64,
    d_curvature: f64,
    weight: f64,
}

impl SiteState {
    /// Moment of the loads that it balances, about the taut generator \[N·m\].
    pub(crate) fn moment_nm(&self) -> f64 {
        self.loads.moment
    }

    /// Start of the next solve from here: only the moment changed, or time has passed, or the pressures a little too.
    fn start(&self, site: &Site, loads: &SiteLoads, memory: &[f64]) -> Start {
        let same = self.loads.p_act_pa == loads.p_act_pa && self.loads.p_body_pa == loads.p_body_pa;
        let remembered = if self.loads.stamp == loads.stamp { Some(0.0) } else { site.relaxed(self, loads, memory) };
        // The imbalance is linear in the moment, so its value here needs no evaluation.
        let change = |relaxed: f64| self.weight * (loads.moment - self.loads.moment + relaxed);
        let f = remembered.filter(|_| same).map(change);
        Start { x: self.coordinate, f, slope: self.slope }
    }
}

impl Balance {
    fn at_state(state: &SiteState) -> Balance {
        let SiteState { coordinate, curvature, tension, weight, .. } = *state;
        Balance { coordinate, curvature, tension, imbalance: 0.0, d_curvature: 0.0, weight }
    }
}

fn close(p: f64, q: f64) -> bool {
    (p - q).abs() < 0.2 * q
}

impl Site {
    /// A place with the base law: pressure work and bending stiffness, nothing else.
    pub(crate) fn new(
        radius_m: f64,
        body_pressure: BodyPressure,
        bending: WallBending,
        linkage: Linkage,
        actuator: Option<&'static Actuator>,
        shape: ActuatorShape,
        channel: usize,
    ) -> Site {
        Site {
            radius_m,
            centre_line: LineShortening::new(radius_m, body_pressure.hinge_curvature),
            actuator,
            shape,
            strip_m: shape.width_m,
            weave: Weave::default(),
            channel,
            linkage,
            inner_share: 0.0,
            sheet_nm: 0.0,
            weld_nm2: 0.0,
            gusset_share: 0.0,
            area_m2: PI * radius_m * radius_m,
            first_m3: 0.0,
            side_effects: SideEffects::default(),
            starts: None,
            actuator_terms: vec![Box::new(ActuatorPressure)],
            body_pressure: BodyLaw::Hinge(body_pressure),
            bending,
            body_terms: Vec::new(),
            wall_shear_n_per_m: None,
        }
    }

    /// Adds a term over [`actuator_q`], and its side effects.
    pub(crate) fn act(&mut self, term: impl Term + 'static, side_effects: SideEffects) {
        let all = &mut self.side_effects;
        all.closes += side_effects.closes;
        all.narrows += side_effects.narrows;
        all.shifts_balance |= side_effects.shifts_balance;
        all.tabulated_from = all.tabulated_from.max(side_effects.tabulated_from);
        self.actuator_terms.push(Box::new(term));
    }

    /// Shear stiffness of the body `πR²p_b + πR G t` \[N\]; infinite where it is rigid.
    /// Fichter 1966; Le van & Wielgosz 2005: the pressure's part is exact for a membrane, a round wall's is half of its area.
    pub fn shear_stiffness_n(&self, p_body_pa: f64) -> f64 {
        let (r, wall) = (self.radius_m, self.wall_shear_n_per_m);
        wall.map_or(f64::INFINITY, |wall| PI * r * (r * p_body_pa + wall))
    }

    /// Curvature at which actuator, wall and external moment balance; `memory` is what the body's terms remember here,
    /// `near` a state to start from.
    pub(crate) fn solve(
        &self,
        loads: &SiteLoads,
        memory: &[f64],
        near: Option<&SiteState>,
    ) -> Result<SiteState, NoRoot> {
        match self.actuator {
            Some(actuator) if self.opening_pa(loads) > SLACK_BELOW_PA => {
                self.solve_active(actuator, loads, memory, near)
            }
            _ => self.solve_passive(loads, memory, near),
        }
    }

    /// Actuator pressure beyond what the body's takes to close it \[Pa\].
    fn opening_pa(&self, loads: &SiteLoads) -> f64 {
        loads.p_act_pa - self.side_effects.closes * loads.p_body_pa
    }

    fn solve_active(
        &self,
        actuator: &Actuator,
        loads: &SiteLoads,
        memory: &[f64],
        near: Option<&SiteState>,
    ) -> Result<SiteState, NoRoot> {
        let near = near.filter(|state| state.slope < 0.0 && close(state.loads.p_act_pa, loads.p_act_pa));
        let mut before = Balance::at_state(near.unwrap_or(&SiteState::REST));
        let mut at = before;
        let mut imbalance = |a: f64| {
            before = at;
            at = self.balance(actuator, a, loads, memory);
            at.imbalance
        };
        // The table is nearer than a state at another pressure.
        let moved = near.is_none_or(|state| state.loads.p_act_pa != loads.p_act_pa);
        let start = match (near, moved.then(|| self.tabulated(loads, memory)).flatten()) {
            (_, Some(start)) => start,
            (Some(state), None) => state.start(self, loads, memory),
            (None, None) => self.start(actuator, loads, memory),
        };
        let mut root = match find_root(&mut imbalance, actuator.range, start) {
            Ok(root) => root,
            // Even flat it is held shut: by the body's gas at its sides, or by its folds. A muscle is never flat.
            Err(_)
                if actuator.has_pouches()
                    && self.balance(actuator, actuator.range.0, loads, memory).imbalance < 0.0 =>
            {
                return self.solve_passive(loads, memory, None);
            }
            Err(none) => return Err(none),
        };
        if self.linkage.compliance_per_n != 0.0 && root.step != 0.0 {
            // Stretching fabric has no explicit dκ/da: a last step that is not tiny is evaluated, and a secant is the slope.
            if root.step.abs() > CARRIED * root.x.abs() {
                at = self.balance(actuator, root.x + root.step, loads, memory);
                root = Root { x: at.coordinate, step: 0.0, ..root };
            }
            if at.coordinate != before.coordinate && before.weight != 0.0 {
                at.d_curvature = (at.curvature - before.curvature) / (at.coordinate - before.coordinate);
            }
        }
        Ok(self.settle(loads, &root, &at, &before))
    }

    /// Start from the actuator's own balance with the wall's moment linearised.
    fn start(&self, actuator: &Actuator, loads: &SiteLoads, memory: &[f64]) -> Start {
        let link = &self.linkage;
        let (share, (low, high)) = (link.active_fraction / link.stroke_fraction, TYPICAL_STROKE);
        let available = share * self.opening_pa(loads) * (actuator.area)(&self.shape) * link.arm_m;
        let moment = |stroke: f64| {
            let (curvature, gain) = link.bent(stroke * link.stroke_fraction / link.arm_m);
            (self.body_moment(curvature, loads, memory) - loads.moment) * gain
        };
        let at_low = moment(low);
        let rise = (moment(high) - at_low) / (high - low);
        let demand = Demand {
            constant: ((at_low - rise * low) / available).max(0.0),
            per_contraction: (rise / available).max(0.0),
            growth: link.arm_growth / link.arm_m,
        };
        let (x, slope) = (actuator.guess)(&self.shape, &demand);
        Start::guess(x, slope * available)
    }

    /// State at the root: the last balance carried over the remaining step.
    fn settle(&self, loads: &SiteLoads, root: &Root, at: &Balance, before: &Balance) -> SiteState {
        let run = at.coordinate - before.coordinate;
        let secant = |now: f64, then: f64| if run != 0.0 && before.weight != 0.0 { (now - then) / run } else { 0.0 };
        SiteState {
            coordinate: root.x + root.step,
            curvature: at.curvature + at.d_curvature * root.step,
            tension: at.tension + secant(at.tension, before.tension) * root.step,
            compliance: -at.weight * at.d_curvature / root.slope,
            loads: *loads,
            slope: root.slope,
            weight: at.weight,
        }
    }

    fn balance(&self, actuator: &Actuator, a: f64, loads: &SiteLoads, memory: &[f64]) -> Balance {
        let stroke = (actuator.stroke)(&self.shape, a);
        let link = &self.linkage;
        let (geometric, arm) = self.turn(link.stroke_fraction * stroke.contraction, self.arm(&stroke));
        let (d_arm, per_arm) = (link.arm_growth * stroke.d_lift, 1.0 / arm);
        let d_geometric = (link.stroke_fraction * stroke.d_contraction - geometric * d_arm) * per_arm;
        let slope = link.active_fraction * self.actuator_slope(a, &stroke, geometric, d_geometric, loads);
        let tension = line_tension(-slope, d_geometric * arm, link.compliance_per_n * d_arm * per_arm);
        let (curvature, gain) = link.bent(geometric - link.compliance_per_n * tension.max(0.0) * per_arm);
        let lever = arm / gain;
        let imbalance = (tension * lever + loads.moment - self.body_moment(curvature, loads, memory)) * stroke.weight;
        let (d_curvature, weight) = (d_geometric * gain, stroke.weight);
        Balance { coordinate: a, curvature, tension, imbalance, d_curvature, weight }
    }

    /// dU/da of all actuator-side terms at η = 1, by the chain rule.
    pub(crate) fn actuator_slope(
        &self,
        a: f64,
        stroke: &Stroke,
        geometric: f64,
        d_geometric: f64,
        loads: &SiteLoads,
    ) -> f64 {
        let (curvature, gain) = self.linkage.bent(geometric);
        let q = [a, stroke.contraction, stroke.volume, curvature];
        let mut force = [0.0; actuator_q::LEN];
        let pose = loads.pose(&q);
        for term in &self.actuator_terms {
            term.add_force(&pose, &mut force);
        }
        -(force[0] + force[1] * stroke.d_contraction + force[2] * stroke.d_volume + force[3] * (d_geometric * gain))
    }

    /// Whether an actuator here is open at these pressures: a flat one has no slope.
    pub(crate) fn is_open(&self, p_body_pa: f64, p_act_pa: f64) -> bool {
        p_act_pa - self.side_effects.closes * p_body_pa > SLACK_BELOW_PA
    }
}

/// A last step that is smaller than this part of the coordinate is carried along the tangent: its square is below rounding.
const CARRIED: f64 = 1e-9;
/// Actuator pressure up to which a pouch is slack \[Pa\]: far below any gauge, far above underflow.
const SLACK_BELOW_PA: f64 = 1e-12;
/// Contractions at which the wall's moment is sampled for the start value: in the working range of every actuator here.
const TYPICAL_STROKE: (f64, f64) = (0.1, 0.3);

#[cfg(test)]
#[path = "site_tests.rs"]
mod tests;
