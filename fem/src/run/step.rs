//! One time step of central differences, and the loop over steps.

use std::time::{Duration, Instant};

use models::Pose;

use super::update::Update;
use super::{Advance, Simulation, constraint};
use crate::contact::edges::hold;
use crate::{Result, Tick, Transient};

/// Wall time that the threads of a run stay together: waking them costs 0.1 ms.
const STRETCH: Duration = Duration::from_millis(50);
/// Steps between two looks at the callback and the guards.
const LOOK: u64 = 64;
/// Steps between two estimates of the stable step; strains change by a small fraction of a per cent in between.
const RECHECK: u64 = 512;
/// The same for fabrics whose curves stiffen.
const RECHECK_STIFFENING: u64 = 128;

/// Whether a run goes on, called every few dozen steps on one of its threads.
pub type GoOn<'a> = &'a mut (dyn FnMut(&Simulation) -> bool + Send);

impl Simulation {
    /// Steps until the time is reached or `go_on` returns false.
    ///
    /// # Errors
    /// [`crate::FemError::Stopped`] when a guard fires.
    pub fn advance_until(&mut self, time_s: f64, go_on: GoOn) -> Result<Advance> {
        self.clock.waits = false;
        self.advance(time_s, go_on)
    }

    /// Steps with all loads and supports as they are at `at_s`, within half a step of now, until the run has waited for `waited_s` in all
    /// \[s\], or `go_on` returns false.
    ///
    /// # Errors
    /// As [`Simulation::advance_until`].
    pub fn wait_until(&mut self, waited_s: f64, at_s: f64, go_on: GoOn) -> Result<Advance> {
        // A run reaches a time within half a step; loads that then stand still would have begun with what comes next.
        self.clock.time_s = at_s;
        self.clock.waits = true;
        self.advance(waited_s, go_on)
    }

    /// To a time of the clock that runs.
    fn advance(&mut self, time_s: f64, go_on: GoOn) -> Result<Advance> {
        let mut advance = None;
        while self.is_before(time_s) && advance.is_none() {
            // The team is moved out for the call, so that the steps may borrow the rest.
            let Some(mut team) = self.team.take() else { break };
            let outcome = team.run(|| {
                let from = self.clock.step;
                let outcome = self.stretch(time_s, go_on);
                (self.clock.step - from, outcome)
            });
            self.cpu_s += team.take_cpu_s();
            self.team = Some(team);
            advance = outcome?;
        }
        Ok(advance.unwrap_or(Advance::Reached))
    }

    fn is_before(&self, time_s: f64) -> bool {
        self.clock.runs_s() + 0.5 * self.clock.dt_s < time_s
    }

    /// Steps for [`STRETCH`], or until the time is reached or the callback asks to stop.
    fn stretch(&mut self, time_s: f64, go_on: GoOn) -> Result<Option<Advance>> {
        let began = Instant::now();
        let recheck = match (&self.edges, self.sheet.stiffens()) {
            (Some(_), _) => LOOK,
            (None, true) => RECHECK_STIFFENING,
            (None, false) => RECHECK,
        };
        while self.is_before(time_s) && began.elapsed() < STRETCH {
            let steps = LOOK - self.clock.step % LOOK;
            self.burst(steps, time_s);
            self.guard_sides()?;
            self.guard()?;
            if self.clock.step.is_multiple_of(recheck) {
                self.recheck()?;
            }
            if !go_on(self) {
                return Ok(Some(Advance::Interrupted));
            }
        }
        Ok(None)
    }

    fn burst(&mut self, steps: u64, time_s: f64) {
        for done in 1..=steps {
            let ahead = self.clock.runs_s() + 1.5 * self.clock.dt_s;
            self.sheet.measure = done == steps || ahead >= time_s;
            self.one_step();
            if ahead >= time_s {
                return;
            }
        }
    }

    pub(super) fn one_step(&mut self) {
        let (t, dt) = (self.clock.time_s, self.clock.dt_s);
        let next_s = if self.clock.waits { t } else { t + dt };
        let dv = 0.5 * (self.clock.before_s + dt);
        let pose = Pose::nodes(self.x.as_flattened());
        let tick = Tick { step: self.clock.step, time_s: t, dt_s: dt };
        let force = self.force.as_flattened_mut();
        let mut stored = self.sheet.advance(&pose, &tick, force);
        for term in &mut self.terms {
            stored += term.advance(&pose, &tick, force);
        }
        if let Some(contact) = &mut self.contact {
            stored += contact.advance(&pose, &tick, force);
        }
        if let Some(edges) = &mut self.edges {
            stored += edges.advance(&pose, &tick, force);
        }
        constraint::hand_over(&self.mesh.ties, &mut self.force);
        if let Some(edges) = &mut self.edges {
            let step = hold::EdgeStep {
                x: &self.x,
                v: &self.v,
                dv_s: dv,
                dt_s: dt,
                damping_1_s: self.settings.mass_damping_1_s,
            };
            edges.hold(&step, &mut self.force);
        }
        // Only where somebody will look: before the supports set velocities, and after.
        let look = self.sheet.measure;
        if look {
            let (mass, v, force) = (&self.mass, &self.v, &self.force);
            self.reactions.clear();
            self.reactions.add(&self.x, |i| [0, 1, 2].map(|k| -mass[i] * v[i][k] / dv - force[i][k]));
        }
        let mut support = 0.0;
        for driven in &self.driven {
            support += driven.step(next_s, dt, &self.mass, &self.force, &self.x, &mut self.v);
        }
        self.books.support.add(support);
        if look {
            let (mass, v) = (&self.mass, &self.v);
            self.reactions.add(&self.x, |i| [0, 1, 2].map(|k| mass[i] * v[i][k] / dv));
        }
        for body in &mut self.bodies {
            body.step(dv, dt, self.settings.mass_damping_1_s, &self.force, &self.x, &mut self.v);
        }
        let before = if self.clock.step == 0 { self.kinetic_at_start() } else { 0.0 };
        self.hold_driven();
        let update = Update { dv, dt, damping: self.settings.mass_damping_1_s, arch: self.arch };
        let [kinetic, damped] = match &mut self.selective {
            Some(selective) => selective.step(update, &mut self.force, &mut self.v, &mut self.x),
            None => update.all(&self.mass, &mut self.force, &mut self.v, &mut self.x),
        };
        self.place_driven();
        constraint::follow(&self.mesh.ties, &self.tie_offset, &mut self.x, &mut self.v);
        if let Some(selective) = &mut self.selective {
            selective.carry(&self.moved, &self.v);
        }
        self.books.kinetic = kinetic;
        self.books.stored = stored;
        self.books.damping.add(self.settings.mass_damping_1_s * dv * damped);
        if self.clock.step == 0 {
            // The potential of loads, which `stored` has, depends on where the origin is.
            self.books.start = before + self.ledger().stored_j(|_| true);
        }
        self.clock.before_s = dt;
        self.clock.time_s = next_s;
        self.clock.waited_s += if self.clock.waits { dt } else { 0.0 };
        self.clock.step += 1;
    }

    fn kinetic_at_start(&self) -> f64 {
        let each = |(m, v): (&f64, &[f64; 4])| 0.5 * m * (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
        match &self.selective {
            Some(selective) => 0.5 * selective.twice_j,
            None => self.mass.iter().zip(&self.v).map(each).sum(),
        }
    }

    /// Takes the forces off prescribed axes, so that the update leaves resting nodes at rest, and remembers the
    /// velocities that supports, bodies and ties set.
    fn hold_driven(&mut self) {
        for (node, axes) in &self.fixed {
            let force = &mut self.force[*node as usize];
            (0..3).filter(|k| axes[*k]).for_each(|k| force[k] = 0.0);
        }
        self.held.clear();
        self.held.extend(self.moved.iter().map(|(node, _)| (self.x[*node as usize], self.v[*node as usize])));
    }

    /// Moves driven axes by the velocities that were set for them.
    fn place_driven(&mut self) {
        let dt = self.clock.dt_s;
        for ((node, axes), (x, v)) in self.moved.iter().zip(&self.held) {
            for k in (0..3).filter(|k| axes[*k]) {
                self.v[*node as usize][k] = v[k];
                self.x[*node as usize][k] = x[k] + dt * v[k];
            }
        }
    }
}
