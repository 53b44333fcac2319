//! One time step.

use models::{Pose, Term, Tick};

use super::{Advance, Simulation, constraint};
use crate::FemError;

/// Steps between two looks at the callback and the guards.
const LOOK: u64 = 64;
/// Steps between two estimates of the stable step; strains change by a small fraction of a per cent in between.
const RECHECK: u64 = 512;
/// Nodes per piece of the update; fixed, so that sums have one order.
const PIECE: usize = 1024;

impl Simulation {
    /// Steps until the time is reached or `go_on` (called every few dozen steps) returns false.
    ///
    /// # Errors
    /// [`FemError::Stopped`] when a guard fires.
    pub fn advance_until(
        &mut self,
        time_s: f64,
        go_on: &mut dyn FnMut(&Simulation) -> bool,
    ) -> Result<Advance, FemError> {
        while self.clock.time_s + 0.5 * self.clock.dt_s < time_s {
            let steps = LOOK - self.clock.step % LOOK;
            self.burst(steps, time_s);
            self.guard()?;
            if self.clock.step % RECHECK == 0 {
                self.recheck()?;
            }
            if !go_on(self) {
                return Ok(Advance::Interrupted);
            }
        }
        Ok(Advance::Reached)
    }

    /// Up to `steps` steps, inside the pool.
    fn burst(&mut self, steps: u64, time_s: f64) {
        // The pool is moved out for the call, so that the steps may borrow the rest.
        let pool = std::mem::replace(&mut self.pool, None);
        let mut work = || {
            for _ in 0..steps {
                if self.clock.time_s + 0.5 * self.clock.dt_s >= time_s {
                    break;
                }
                self.one_step();
            }
        };
        match &pool {
            Some(pool) => pool.install(work),
            None => work(),
        }
        self.pool = pool;
    }

    fn one_step(&mut self) {
        let (t, dt) = (self.clock.time_s, self.clock.dt_s);
        let dv = 0.5 * (self.clock.before_s + dt);
        self.force.fill([0.0; 4]);
        let pose = Pose::nodes(self.x.as_flattened());
        let tick = Tick { step: self.clock.step, time_s: t, dt_s: dt, v: self.v.as_flattened() };
        let force = self.force.as_flattened_mut();
        let mut stored = self.sheet.advance(&pose, &tick, force);
        for term in &mut self.terms {
            stored += term.advance(&pose, &tick, force);
        }
        constraint::hand_over(&self.mesh.ties, &mut self.force);
        for driven in &self.driven {
            self.books.support += driven.step(t + dt, dt, &self.mass, &self.force, &self.x, &mut self.v);
        }
        for body in &mut self.bodies {
            body.step(dv, dt, self.limits.damping_1_s, &self.force, &self.x, &mut self.v);
        }
        let before = if self.clock.step == 0 { kinetic(&self.mass, &self.v) } else { 0.0 };
        let update = Update { dv, dt, damping: self.limits.damping_1_s };
        let [kinetic, damped] = update.all(&self.mass, &self.inverse_mass, &self.force, &mut self.v, &mut self.x);
        constraint::follow(&self.mesh.ties, &self.tie_offset, &mut self.x, &mut self.v);
        if self.clock.step == 0 {
            self.books.start = stored + before;
        }
        self.books.kinetic = kinetic;
        self.books.stored = stored;
        self.books.damping += self.limits.damping_1_s * dv * damped;
        self.clock.before_s = dt;
        self.clock.time_s += dt;
        self.clock.step += 1;
    }
}

fn kinetic(mass: &[f64], v: &[[f64; 4]]) -> f64 {
    mass.iter().zip(v).map(|(m, v)| 0.5 * m * (v[0] * v[0] + v[1] * v[1] + v[2] * v[2])).sum()
}

/// The update of velocities and positions.
#[derive(Clone, Copy)]
struct Update {
    dv: f64,
    dt: f64,
    damping: f64,
}

impl Update {
    /// Updates everything; returns kinetic energy and Σ m |v̄|² over the free axes.
    fn all(self, mass: &[f64], inverse: &[[f64; 4]], force: &[[f64; 4]], v: &mut [[f64; 4]], x: &mut [[f64; 4]]) -> [f64; 2] {
        if mass.len() <= PIECE {
            return self.piece(mass, inverse, force, v, x);
        }
        let half = (mass.len() / 2).next_multiple_of(PIECE);
        let half = if half < mass.len() { half } else { PIECE };
        let (mass, inverse, force) = (mass.split_at(half), inverse.split_at(half), force.split_at(half));
        let (v, x) = (v.split_at_mut(half), x.split_at_mut(half));
        let (low, high) = rayon::join(
            || self.all(mass.0, inverse.0, force.0, v.0, x.0),
            || self.all(mass.1, inverse.1, force.1, v.1, x.1),
        );
        [low[0] + high[0], low[1] + high[1]]
    }

    fn piece(self, mass: &[f64], inverse: &[[f64; 4]], force: &[[f64; 4]], v: &mut [[f64; 4]], x: &mut [[f64; 4]]) -> [f64; 2] {
        let gain = self.dv / (1.0 + 0.5 * self.damping * self.dv);
        let mut kinetic = [0.0; 4];
        let mut damped = [0.0; 4];
        for ((((m, inverse), f), v), x) in mass.iter().zip(inverse).zip(force).zip(v).zip(x) {
            for k in 0..4 {
                let free = m * inverse[k];
                let old = v[k];
                let new = old + gain * (inverse[k] * f[k] - self.damping * free * old);
                v[k] = new;
                x[k] += self.dt * new;
                kinetic[k] += m * old * new;
                let mean = 0.5 * (old + new);
                damped[k] += m * free * mean * mean;
            }
        }
        let add = |s: [f64; 4]| (s[0] + s[1]) + (s[2] + s[3]);
        [0.5 * add(kinetic), add(damped)]
    }
}
