//! Stops for runs whose result cannot be trusted.

use models::{Pose, Term};

use super::{Simulation, highest, setup};
use crate::FemError;
use crate::sheet::reference::{cross, dot};

/// Share of its reference area below which an element counts as collapsed.
const COLLAPSED: f64 = 1e-4;

/// Steps between two estimates of the highest mode of the whole mesh: in the robots it changes by some hundredths in between.
const WHOLE: u64 = 8192;

impl Simulation {
    /// Judges the last step.
    pub(super) fn guard(&mut self) -> Result<(), FemError> {
        let books = self.books;
        if !(books.kinetic.is_finite() && books.stored.is_finite()) {
            return Err(self.stopped(self.not_a_number()));
        }
        let ledger = self.ledger();
        self.books.scale = ledger.scale_j;
        let guards = &self.limits.guards;
        if ledger.scale_j > guards.residual_floor_j && ledger.residual_share() > guards.residual {
            return Err(self.stopped(format!(
                "the energy balance misses {:.3e} J, {:.1} % of the external work (limit {} %). Shorten the step (cfl), \
                 or look for elements that are too coarse for what they do",
                ledger.residual_j,
                100.0 * ledger.residual_share(),
                100.0 * guards.residual
            )));
        }
        self.guard_speed()
    }

    fn guard_speed(&self) -> Result<(), FemError> {
        let square = |v: &[f64; 4]| v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
        let fastest =
            (0..self.v.len()).fold(0, |best, i| if square(&self.v[i]) > square(&self.v[best]) { i } else { best });
        let speed = self.v.get(fastest).map_or(0.0, |v| square(v).sqrt());
        if speed <= self.limits.speed_m_s {
            return Ok(());
        }
        Err(self.stopped(format!(
            "node {} moves at {speed:.0} m/s; sound in the fabric travels at {:.0} m/s. The step is unstable or a load \
             is in the wrong unit",
            self.order.old[fastest] + 1,
            self.limits.speed_m_s
        )))
    }

    fn not_a_number(&self) -> String {
        let bad = (0..self.x.len()).find(|i| !(self.x[*i].iter().chain(&self.force[*i]).all(|c| c.is_finite())));
        let place = bad.map_or("the energies are".to_string(), |i| format!("node {} is", self.order.old[i] + 1));
        format!("{place} not a number any more. Shorten the step (cfl .7 for soft fabric) or check loads and units")
    }

    /// Estimates the stable step anew; looks for collapsed or inverted elements.
    pub(super) fn recheck(&mut self) -> Result<(), FemError> {
        if self.limits.guards.inverted {
            self.guard_elements()?;
        }
        let pose = Pose::nodes(self.x.as_flattened());
        let mut others = vec![0.0; self.x.len()];
        self.others().for_each(|term| term.stiffness_bound(&pose, &mut others));
        let mut bound = others.clone();
        self.sheet.stiffness_bound(&pose, &mut bound);
        setup::give_tied_bounds(&self.mesh, &mut bound);
        let nodes = setup::stable_step(&bound, &self.mass, self.limits.viscosity);
        if self.clock.step.is_multiple_of(WHOLE) {
            self.clock.gain = highest::gain(
                &self.sheet,
                &self.mesh.ties,
                &self.x,
                others,
                &self.mass,
                nodes,
                self.selective.as_ref(),
            );
        }
        let stable = self.clock.gain * nodes;
        match self.limits.forced_dt_s {
            None => self.clock.dt_s = (self.limits.cfl * stable).min(self.clock.longest_s),
            Some(dt) if dt <= stable => {}
            Some(dt) => {
                return Err(self.stopped(format!(
                    "the forced step of {dt:e} s is not stable any more; the deformed mesh allows {stable:.3e} s. Leave \
                     the step out, then it adapts"
                )));
            }
        }
        Ok(())
    }

    fn guard_elements(&self) -> Result<(), FemError> {
        for (index, element) in self.sheet.elements.iter().enumerate() {
            let at = |n: usize| {
                let p = self.x[element.node[n] as usize];
                [p[0], p[1], p[2]]
            };
            let [f1, f2] = element.deformation(&self.x);
            let normal = cross(f1, f2);
            let area = dot(normal, normal).sqrt();
            let part = &self.mesh.parts[element.part].name;
            if area.is_nan() || area < COLLAPSED {
                return Err(self.stopped(format!(
                    "element {} (part `{part}`) has lost its area: {:.2e} of what it was",
                    index + 1,
                    area
                )));
            }
            // A quadrilateral is inside out when most of its corners turn against its mean normal.
            if element.corners == 4 {
                let against = (0..4).filter(|n| {
                    let (here, next, last) = (at(*n), at((n + 1) % 4), at((n + 3) % 4));
                    let corner = cross([0, 1, 2].map(|k| next[k] - here[k]), [0, 1, 2].map(|k| last[k] - here[k]));
                    dot(corner, normal) < 0.0
                });
                if against.count() > 1 {
                    return Err(self.stopped(format!("element {} (part `{part}`) has turned inside out", index + 1)));
                }
            }
        }
        Ok(())
    }

    pub(super) fn stopped(&self, reason: String) -> FemError {
        FemError::Stopped { step: self.clock.step, time_s: self.clock.time_s, reason }
    }
}
