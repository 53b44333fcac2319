//! Uniform gravity.
//!
//! ```text
//! F = A m g        E = −A Σ m g·x        work as for any dead load: W ← W + ½ (A_new + A_old)(s_new − s_old)
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | m | true mass of a node: mass scaling changes how fast a node accelerates, not its weight | kg |
//! | g | acceleration | m/s² |
//! | A | amplitude | - |
//!
//! **Validity**: uniform field. A body with scaled masses falls with g over the factor; at rest the factor plays no role.

use models::{Account, LedgerLine, Pose, Row, RowKind, Term};

use crate::FemError;
use crate::bytes::{pack, unpack};
use crate::problem::{self, Amplitude};
use crate::{Tick, Transient};

/// Weight of every node.
#[derive(Debug, Clone)]
pub struct Gravity {
    mass_kg: Vec<f64>,
    g_m_s2: [f64; 3],
    amplitude: Amplitude,
    time_s: f64,
    work_j: f64,
    last: Option<[f64; 2]>,
}

impl Gravity {
    /// Weight of nodes of these true masses (solver's node order).
    ///
    /// # Errors
    /// [`FemError::Problem`] for an acceleration that is not finite.
    pub fn new(gravity: &problem::Gravity, mass_kg: &[f64]) -> Result<Gravity, FemError> {
        if gravity.g_m_s2.iter().any(|g| !g.is_finite()) {
            return Err(FemError::Problem("gravity: the acceleration is not a finite number".into()));
        }
        Ok(Gravity {
            mass_kg: mass_kg.to_vec(),
            g_m_s2: gravity.g_m_s2,
            amplitude: gravity.amplitude.clone(),
            time_s: 0.0,
            work_j: 0.0,
            last: None,
        })
    }
    /// Adds A m g and returns Σ m g·x \[J\].
    fn pull(&self, amplitude: f64, q: &[f64], force: &mut [f64]) -> f64 {
        let g = self.g_m_s2;
        let mut s = 0.0;
        let nodes = q.as_chunks::<4>().0.iter().zip(force.as_chunks_mut::<4>().0).zip(&self.mass_kg);
        for ((x, f), &mass) in nodes {
            let am = amplitude * mass;
            f[0] += am * g[0];
            f[1] += am * g[1];
            f[2] += am * g[2];
            s += mass * (g[0] * x[0] + g[1] * x[1] + g[2] * x[2]);
        }
        s
    }
}

impl Term for Gravity {
    fn line(&self) -> LedgerLine {
        LedgerLine::new("gravity", Account::Load)
    }
    fn add(&self, at: &Pose, force: &mut [f64]) -> f64 {
        let amplitude = self.amplitude.at(self.time_s);
        -amplitude * self.pull(amplitude, at.q, force)
    }
}

impl Transient for Gravity {
    fn advance(&mut self, at: &Pose, tick: &Tick, force: &mut [f64]) -> f64 {
        self.time_s = tick.time_s;
        let amplitude = self.amplitude.at(tick.time_s);
        let s = self.pull(amplitude, at.q, force);
        let [a_old, s_old] = self.last.unwrap_or([amplitude, s]);
        self.work_j += 0.5 * (amplitude + a_old) * (s - s_old);
        self.last = Some([amplitude, s]);
        -amplitude * s
    }
    fn ledger(&self, _at: &Pose) -> Vec<Row> {
        vec![self.line().row(RowKind::Supplied, self.work_j)]
    }
    fn save(&self) -> Vec<u8> {
        pack(&(self.time_s, self.work_j, self.last, self.g_m_s2))
    }
    fn restore(&mut self, saved: &[u8]) -> bool {
        let Some((time_s, work_j, last, g_m_s2)) = unpack::<(f64, f64, Option<[f64; 2]>, [f64; 3])>(saved) else {
            return false;
        };
        if g_m_s2 != self.g_m_s2 {
            return false;
        }
        (self.time_s, self.work_j, self.last) = (time_s, work_j, last);
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn earth() -> Gravity {
        let gravity = problem::Gravity { g_m_s2: [0.0, 0.0, -9.81], amplitude: Amplitude::Constant(1.0) };
        Gravity::new(&gravity, &[2.0, 0.5]).unwrap()
    }

    #[test]
    fn weight_is_the_slope_of_the_potential() {
        let q = [0.0, 0.0, 3.0, 0.0, 1.0, 0.0, -2.0, 0.0];
        let mut force = vec![0.0; 8];
        let energy = earth().add(&Pose::nodes(&q), &mut force);
        assert_eq!(force, [0.0, 0.0, -19.62, 0.0, 0.0, 0.0, -4.905, 0.0]);
        assert!((energy - 9.81 * (2.0 * 3.0 - 0.5 * 2.0)).abs() < 1e-14);
    }

    #[test]
    fn a_free_fall_by_central_differences_turns_exactly_the_work_into_kinetic_energy() {
        let (mut term, dt_s) = (earth(), 1e-3);
        let mut q = vec![0.0; 8];
        let mut v = [0.0; 8];
        for step in 0..1000 {
            let mut force = vec![0.0; 8];
            term.advance(&Pose::nodes(&q), &Tick { step, time_s: step as f64 * dt_s, dt_s }, &mut force);
            let whole = if step == 0 { 0.5 } else { 1.0 };
            for node in 0..2 {
                v[4 * node + 2] += whole * dt_s * force[4 * node + 2] / term.mass_kg[node];
                q[4 * node + 2] += dt_s * v[4 * node + 2];
            }
        }
        let mut force = vec![0.0; 8];
        term.advance(&Pose::nodes(&q), &Tick { step: 1000, time_s: 1.0, dt_s }, &mut force);
        let speed = v[2] + 0.5 * dt_s * force[2] / 2.0;
        assert!((term.work_j - 0.5 * 2.5 * speed * speed).abs() < 1e-11 * term.work_j);
    }

    #[test]
    fn a_restored_weight_goes_on_to_the_bit() {
        let mut term = earth();
        let q = vec![0.3; 8];
        term.advance(&Pose::nodes(&q), &Tick { step: 0, time_s: 0.0, dt_s: 0.1 }, &mut [0.0; 8]);
        let mut other = earth();
        assert!(other.restore(&term.save()) && !other.restore(&[1, 2]));
        for term in [&mut term, &mut other] {
            let tick = Tick { step: 1, time_s: 0.1, dt_s: 0.1 };
            term.advance(&Pose::nodes(&[-0.7; 8]), &tick, &mut [0.0; 8]);
        }
        assert_eq!(term.work_j.to_bits(), other.work_j.to_bits());
    }
}
