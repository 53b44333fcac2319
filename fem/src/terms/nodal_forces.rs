//! Forces that keep their direction and follow an amplitude over time.
//!
//! ```text
//! F(t) = A(t) F₀       E = −A F₀·x       work: W ← W + ½ (A_new + A_old)(s_new − s_old),  s = Σ F₀·x
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | F₀ | force on a node: total of the set over its nodes | N |
//! | A | amplitude | - |
//!
//! **Validity**: dead load. The work of a step is exact for an amplitude and a motion that are straight within the step,
//! and is what central differences take from the load.

use models::{Account, LedgerLine, Pose, Row, RowKind, Term};

use crate::bytes::{pack, unpack};
use crate::problem::{Amplitude, NodalForce};
use crate::vec3::{add, dot, node};
use crate::{FemError, Mesh};
use crate::{Tick, Transient};

/// All nodal forces of a run.
#[derive(Debug, Clone)]
pub struct NodalForces {
    loads: Vec<Load>,
    time_s: f64,
    work_j: f64,
}

#[derive(Debug, Clone)]
struct Load {
    nodes: Vec<u32>,
    force_n: [f64; 3],
    amplitude: Amplitude,
    last: Option<[f64; 2]>,
}

/// Amplitude and way of the step before, force and nodes.
type SavedLoad = (Option<[f64; 2]>, [f64; 3], Vec<u32>);

impl NodalForces {
    /// Forces on node sets of `mesh` (solver's node order).
    ///
    /// # Errors
    /// [`FemError::Problem`] naming a set that does not exist or is empty, or a force that is not finite.
    pub fn new(mesh: &Mesh, forces: &[NodalForce]) -> Result<NodalForces, FemError> {
        let loads = forces.iter().map(|force| Load::new(mesh, force)).collect::<Result<_, _>>()?;
        Ok(NodalForces { loads, time_s: 0.0, work_j: 0.0 })
    }
}

impl Term for NodalForces {
    fn line(&self) -> LedgerLine {
        LedgerLine::new("nodal forces", Account::Load)
    }
    fn add(&self, at: &Pose, force: &mut [f64]) -> f64 {
        self.loads.iter().map(|load| load.add(load.amplitude.at(self.time_s), at.q, force)).sum()
    }
}

impl Transient for NodalForces {
    fn advance(&mut self, at: &Pose, tick: &Tick, force: &mut [f64]) -> f64 {
        self.time_s = tick.time_s;
        let mut energy_j = 0.0;
        for load in &mut self.loads {
            let amplitude = load.amplitude.at(tick.time_s);
            energy_j += load.add(amplitude, at.q, force);
            let s = load.along(at.q);
            let [a_old, s_old] = load.last.unwrap_or([amplitude, s]);
            self.work_j += 0.5 * (amplitude + a_old) * (s - s_old);
            load.last = Some([amplitude, s]);
        }
        energy_j
    }
    fn ledger(&self, _at: &Pose) -> Vec<Row> {
        vec![self.line().row(RowKind::Supplied, self.work_j)]
    }
    fn save(&self) -> Vec<u8> {
        let loads: Vec<_> = self.loads.iter().map(|load| (load.last, load.force_n, &load.nodes)).collect();
        pack(&(self.time_s, self.work_j, loads))
    }
    fn restore(&mut self, saved: &[u8]) -> bool {
        let Some((time_s, work_j, loads)) = unpack::<(f64, f64, Vec<SavedLoad>)>(saved) else { return false };
        let same = |(own, (_, force_n, nodes)): (&Load, &SavedLoad)| own.force_n == *force_n && own.nodes == *nodes;
        if loads.len() != self.loads.len() || !self.loads.iter().zip(&loads).all(same) {
            return false;
        }
        (self.time_s, self.work_j) = (time_s, work_j);
        self.loads.iter_mut().zip(loads).for_each(|(load, (last, ..))| load.last = last);
        true
    }
}

impl Load {
    fn new(mesh: &Mesh, force: &NodalForce) -> Result<Load, FemError> {
        let nodes = mesh.set(&force.set, "force")?;
        if force.total_n.iter().any(|f| !f.is_finite()) {
            return Err(FemError::Problem(format!("force on node set {:?} is not a finite number", force.set)));
        }
        let share = 1.0 / nodes.len() as f64;
        let force_n = force.total_n.map(|f| f * share);
        Ok(Load { nodes: nodes.to_vec(), force_n, amplitude: force.amplitude.clone(), last: None })
    }
    /// Σ F₀·x \[J\]
    fn along(&self, q: &[f64]) -> f64 {
        let points = q.as_chunks::<4>().0;
        dot(self.force_n, self.nodes.iter().fold([0.0; 3], |sum, &i| add(sum, node(points, i as usize))))
    }
    fn add(&self, amplitude: f64, q: &[f64], force: &mut [f64]) -> f64 {
        let force = force.as_chunks_mut::<4>().0;
        for &i in &self.nodes {
            for (f, load) in force[i as usize].iter_mut().zip(self.force_n) {
                *f += amplitude * load;
            }
        }
        -amplitude * self.along(q)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn two_nodes() -> Mesh {
        let mut mesh = Mesh { points: vec![[0.0; 3], [1.0, 2.0, 3.0]], ..Mesh::default() };
        mesh.sets.insert("tip".into(), vec![0, 1]);
        mesh
    }
    fn load(amplitude: Amplitude) -> NodalForces {
        let force = NodalForce { set: "tip".into(), total_n: [2.0, 0.0, -4.0], amplitude };
        NodalForces::new(&two_nodes(), &[force]).unwrap()
    }
    fn step(term: &mut NodalForces, step: u64, dt_s: f64, q: &[f64]) -> Vec<f64> {
        let mut force = vec![0.0; q.len()];
        term.advance(&Pose::nodes(q), &Tick { step, time_s: step as f64 * dt_s, dt_s }, &mut force);
        force
    }

    #[test]
    fn the_total_is_shared_between_the_nodes_and_is_the_slope_of_the_potential() {
        let term = load(Amplitude::Constant(3.0));
        let q = [0.1, 0.2, 0.3, 0.0, 1.0, 2.0, 3.0, 0.0];
        let mut force = vec![0.0; 8];
        let energy = term.add(&Pose::nodes(&q), &mut force);
        assert_eq!(force, [3.0, 0.0, -6.0, 0.0, 3.0, 0.0, -6.0, 0.0]);
        assert!((energy + q.iter().zip(&force).map(|(x, f)| x * f).sum::<f64>()).abs() < 1e-15);
    }

    #[test]
    fn work_of_a_ramp_over_a_straight_motion_is_half_force_times_way() {
        let mut term = load(Amplitude::Linear(vec![(0.0, 0.0), (1.0, 1.0)]));
        for i in 0..=100 {
            let z = -0.01 * i as f64;
            step(&mut term, i, 0.01, &[0.0, 0.0, z, 0.0, 0.0, 0.0, z, 0.0]);
        }
        assert!((term.work_j - 0.5 * 4.0 * 1.0).abs() < 1e-14, "{}", term.work_j);
        assert_eq!(term.ledger(&Pose::nodes(&[0.0; 8]))[0].kind, RowKind::Supplied);
    }

    #[test]
    fn a_restored_load_goes_on_to_the_bit_and_refuses_what_does_not_fit() {
        let mut term = load(Amplitude::Smooth(vec![(0.0, 0.0), (0.2, 1.0)]));
        let mut other = term.clone();
        let at = |i: u64| [0.0, 0.0, (i as f64).sin(), 0.0, 0.3 * i as f64, 0.0, 0.0, 0.0];
        for i in 0..10 {
            step(&mut term, i, 0.01, &at(i));
        }
        let saved = term.save();
        assert!(other.restore(&saved) && !other.restore(&saved[1..]) && !other.restore(&[]));
        for i in 10..20 {
            assert_eq!(step(&mut term, i, 0.01, &at(i)), step(&mut other, i, 0.01, &at(i)));
        }
        assert_eq!(term.work_j.to_bits(), other.work_j.to_bits());
    }

    #[test]
    fn an_unknown_set_is_named_with_those_that_exist() {
        let force = NodalForce { set: "top".into(), total_n: [0.0; 3], amplitude: Amplitude::Constant(1.0) };
        let message = NodalForces::new(&two_nodes(), &[force]).unwrap_err().to_string();
        assert!(message.contains("`top`") && message.contains("tip"), "{message}");
    }
}
