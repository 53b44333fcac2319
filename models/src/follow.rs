//! A protocol in time: loading, holding and unloading, with what the robot remembers.

use crate::error::{Solved, Unsolved};
use crate::model::{Model, Prediction, check};
use crate::term::Loads;
use spelling::units::Range;

/// A state of a protocol: the pressures that were set after the step before, and the time at which the robot is looked at.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Step {
    /// Time since the start of the protocol \[s\], at which the robot is looked at.
    pub t_s: f64,
    /// Gauge pressures that are set after the previous step.
    pub loads: Loads,
}

/// What sees every state of a protocol, with its index.
pub type Each<'a> = &'a mut dyn FnMut(usize, &Prediction);

/// Longest step in time: this share of the time scale, plus one of the time since the pressures changed, because what relaxes
/// does so ever more slowly. The tip is then within 1e-3 of its creep of where short steps take it (tested).
const SCALE_SHARE: f64 = 0.35;
const HELD_SHARE: f64 = 0.1;
/// States on the way from one pair of pressures to another where the curvatures may not run one way: with transverse loads,
/// or when actuator and body pressure change together.
const PATH_STEPS: usize = 8;

/// Time for which a pressure of a model with history is held \[s\]: the hold of the usual protocol.
pub const HOLD_S: f64 = 5.0;

impl Model {
    /// A single state: with history after a hold of [`HOLD_S`] from rest, else as [`Model::predict`].
    pub fn predict_held(&self, loads: &Loads, out: &mut Prediction) -> Solved {
        match self.has_history() {
            false => self.predict(loads, out),
            true => self.follow(&[Step { t_s: HOLD_S, loads: *loads }], out, &mut |_, _| ()),
        }
    }

    /// Whether a state depends on those before it or on the time in a hold: then [`Model::follow`] differs from
    /// [`Model::predict`], which is the first loading from rest, at once.
    pub fn has_history(&self) -> bool {
        self.assembly().timed || self.remembers()
    }

    /// Walks a protocol from rest in time order; `each` sees every state with its index. Allocates nothing.
    ///
    /// The robot starts at rest at time 0. Pressures change at once, right after the state before, in a straight line;
    /// then time passes **at the new pressures** until `t_s`, so a gap between two holds belongs to the second. A step
    /// back in time starts a new session: the robot is at rest at time 0 again and remembers nothing.
    ///
    /// ```
    /// use models::{Loads, Model, Scenario, Step, shipped};
    /// let robot = Scenario::parse(shipped("epam-textbook").unwrap()).unwrap().with_bending(1.0);
    /// let model = Model::new(&robot.with_effect("friction", &[0.55]));
    /// let steps = [0.0, 30e3, 0.0].map(|p| Step { t_s: 0.0, loads: Loads::uniform(2e3, p) });
    /// let mut tips = Vec::new();
    /// model.follow(&steps, &mut model.prediction(), &mut |_, at| tips.push(at.tip.y_m)).unwrap();
    /// assert!(tips[0] == 0.0 && tips[1] > 0.05 && tips[2] > 1e-3);
    /// ```
    ///
    /// # Errors
    /// What [`Model::predict`] returns, or a time that is not finite.
    pub fn follow(&self, steps: &[Step], out: &mut Prediction, each: Each) -> Solved {
        self.walk(steps, None, out, each)
    }

    /// The same; with `held`, at given curvatures in every step.
    pub(crate) fn walk(&self, steps: &[Step], held: Option<&[Vec<f64>]>, out: &mut Prediction, each: Each) -> Solved {
        let mut before: Option<Step> = None;
        for index in 0..steps.len() {
            let step = match self.assembly().clock {
                [0.0, 0.0] => steps[index],
                clock => seen_late(steps, index, clock),
            };
            let last = before.filter(|last| last.t_s <= step.t_s);
            self.pass(last, &step, held.map(|held| held[index].as_slice()), out)?;
            each(index, out);
            before = Some(step);
        }
        Ok(())
    }

    /// The next state of a protocol after `last`; without one the robot is at rest at time 0. What `out` holds has to be the
    /// state of `last`: a stream that never ends is walked with one buffer.
    pub fn follow_on(&self, last: Option<Step>, step: &Step, out: &mut Prediction) -> Solved {
        self.pass(last.filter(|last| last.t_s <= step.t_s), step, None, out)
    }

    fn pass(&self, last: Option<Step>, step: &Step, held: Option<&[f64]>, out: &mut Prediction) -> Solved {
        check(&step.loads)?;
        if !Range::TIME.contains(step.t_s) {
            return Err(Unsolved::BadTime { t_s: step.t_s });
        }
        if last.is_none() {
            out.work.history.start();
        }
        let is_new = last.is_none_or(|last| last.loads != step.loads);
        if let Some(held) = held {
            out.work.held.curvatures.clear();
            out.work.held.curvatures.extend_from_slice(held);
        }
        if is_new {
            self.change(last.map(|last| last.loads), &step.loads, out)?;
        }
        self.wait(step.t_s - last.map_or(0.0, |last| last.t_s), &step.loads, out)?;
        if held.is_some() && !is_new {
            // `wait` solves only for memories that change in time; the robot may be held elsewhere by now.
            out.work.history.dt_s = 0.0;
            self.reach(&step.loads, out, true)?;
        }
        self.show(out);
        Ok(())
    }

    fn change(&self, from: Option<Loads>, to: &Loads, out: &mut Prediction) -> Solved {
        let start = from.unwrap_or(Loads::uniform(to.body_pa, 0.0));
        let one_way = self.assembly().node_terms.is_empty() && start.leads_one_way(to);
        let count = if one_way { 1 } else { PATH_STEPS };
        let history = &mut out.work.history;
        (history.moment.held_s, history.dt_s) = (0.0, 0.0);
        if let Some(change) = start.changes(to).find(|d| *d != 0.0) {
            history.moment.falling = change < 0.0;
        }
        for k in 1..=count {
            let loads = if k == count { *to } else { start.towards(to, k as f64 / count as f64) };
            self.reach(&loads, out, from.is_some() || k > 1)?;
        }
        Ok(())
    }

    fn wait(&self, time_s: f64, loads: &Loads, out: &mut Prediction) -> Solved {
        let scale = self.time_scale_s();
        let mut left = time_s;
        while left > 0.0 {
            let held = out.work.history.moment.held_s;
            let longest = SCALE_SHARE * scale + HELD_SHARE * held;
            // Two equal parts at the end rather than a long one and a short one.
            let dt_s = if left <= longest { left } else { longest.min(0.5 * left) };
            let moment = &mut out.work.history.moment;
            (moment.held_s, moment.t_s) = (held + dt_s, moment.t_s + dt_s);
            out.work.history.dt_s = dt_s;
            left -= dt_s;
            if self.assembly().timed || scale.is_finite() {
                self.reach(loads, out, true)?;
            }
        }
        Ok(())
    }

    /// The next state, from the one before, and its memory.
    fn reach(&self, loads: &Loads, out: &mut Prediction, warm: bool) -> Solved {
        self.solve(loads, out, warm)?;
        let work = &mut out.work;
        let body_pa = self.body_pa(loads, work);
        work.history.remember(self.assembly(), body_pa, &work.states, &work.p_act_pa);
        Ok(())
    }

    fn remembers(&self) -> bool {
        let mut terms = self.assembly().sites.iter().flat_map(|site| &site.body_terms);
        terms.any(|term| term.memory().values > 0)
    }

    /// Shortest time over which any term's memory changes under constant loads \[s\].
    fn time_scale_s(&self) -> f64 {
        let terms = self.assembly().sites.iter().flat_map(|site| &site.body_terms);
        terms.fold(f64::INFINITY, |least, term| least.min(term.memory().time_s))
    }
}

/// A step as a camera sees it whose clock lags by τ and runs slow by ρ: what was at t − τ − ρ t, at the pressures of then.
fn seen_late(steps: &[Step], i: usize, [lag_s, rate]: [f64; 2]) -> Step {
    let t_s = (steps[i].t_s * (1.0 - rate) - lag_s).max(0.0);
    let is_new = |pair: &[Step]| pair[1].t_s < pair[0].t_s;
    let first = steps[..=i].windows(2).rposition(is_new).map_or(0, |at| at + 1);
    let end = steps[i..].windows(2).position(is_new).map_or(steps.len(), |at| i + at + 1);
    let own = &steps[first..end];
    let at = own.partition_point(|other| other.t_s < t_s).min(own.len() - 1);
    Step { t_s, loads: own[at].loads }
}

impl Loads {
    fn changes(&self, to: &Loads) -> impl Iterator<Item = f64> {
        self.actuator_pa.iter().zip(&to.actuator_pa).map(|(a, b)| b - a)
    }

    /// Whether only the body's or only the actuators' pressures change, and all of them in the same direction.
    fn leads_one_way(&self, to: &Loads) -> bool {
        let (up, down) = (self.changes(to).any(|d| d > 0.0), self.changes(to).any(|d| d < 0.0));
        let body = self.body_pa != to.body_pa;
        !(up && down) && !(body && (up || down))
    }

    fn towards(&self, to: &Loads, share: f64) -> Loads {
        let part = |a: f64, b: f64| a + share * (b - a);
        let mut between = Loads { body_pa: part(self.body_pa, to.body_pa), ..*self };
        for (p, end) in between.actuator_pa.iter_mut().zip(&to.actuator_pa) {
            *p = part(*p, *end);
        }
        between
    }
}
