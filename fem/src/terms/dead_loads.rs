//! Loads that keep their direction and follow an amplitude over time: forces on nodes, and uniform gravity.
//!
//! ```text
//! F(t) = A(t) F₀       E = −A Σ F₀·x       work: W ← W + ½ (A_new + A_old)(s_new − s_old),  s = Σ F₀·x
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | F₀ | force on a node: total of the set over its nodes, or m g with the true mass m: scaled masses do not weigh more | N |
//! | g | acceleration | m/s² |
//! | A | amplitude | - |
//!
//! **Validity**: dead loads, a uniform field. The work of a step is exact for an amplitude and a motion that are straight within the
//! step, and is what central differences take from the load. A body with scaled masses falls with g over the factor; at rest the factor
//! plays no role.

use models::{Account, LedgerLine, Pose, Row, RowKind, Term};

use crate::bytes::{pack, unpack};
use crate::problem::{Amplitude, Gravity, NodalForce};
use crate::vec3::{V3, add, dot, node};
use crate::{FemError, Mesh, Result, Tick, Transient};

/// All nodal forces of a run, or its gravity.
#[derive(Debug, Clone)]
pub struct DeadLoads {
    line: LedgerLine,
    loads: Vec<NodalLoad>,
    time_s: f64,
    work_j: f64,
}

#[derive(Debug, Clone)]
struct NodalLoad {
    on: On,
    /// Force on each node \[N\], or acceleration \[m/s²\].
    vector: V3,
    amplitude: Amplitude,
    last: Option<[f64; 2]>,
}

#[derive(Debug, Clone)]
enum On {
    Nodes(Vec<u32>),
    /// True masses of all nodes \[kg\].
    Masses(Vec<f64>),
}

/// Amplitude and way of the step before, force or acceleration, and nodes.
type SavedLoad = (Option<[f64; 2]>, V3, Vec<u32>);

impl DeadLoads {
    /// Forces on node sets of `mesh` (solver's node order).
    ///
    /// # Errors
    /// [`FemError::Problem`] naming a set that does not exist or is empty, or a force that is not finite.
    pub fn forces(mesh: &Mesh, forces: &[NodalForce]) -> Result<DeadLoads> {
        let load = |NodalForce { set, total_n, amplitude }: &NodalForce| {
            let nodes = mesh.set(set, "force")?;
            if total_n.iter().any(|f| !f.is_finite()) {
                return Err(FemError::Problem(format!("force on node set {set:?} is not a finite number")));
            }
            let share = 1.0 / nodes.len() as f64;
            Ok(NodalLoad::new(On::Nodes(nodes.to_vec()), total_n.map(|f| f * share), amplitude))
        };
        Ok(DeadLoads::of("nodal forces", forces.iter().map(load).collect::<Result<_, _>>()?))
    }

    /// Weight of nodes of these true masses (solver's node order).
    ///
    /// # Errors
    /// [`FemError::Problem`] for an acceleration that is not finite.
    pub fn gravity(gravity: &Gravity, mass_kg: &[f64]) -> Result<DeadLoads> {
        if gravity.g_m_s2.iter().any(|g| !g.is_finite()) {
            return Err(FemError::Problem("gravity: the acceleration is not a finite number".into()));
        }
        let load = NodalLoad::new(On::Masses(mass_kg.to_vec()), gravity.g_m_s2, &gravity.amplitude);
        Ok(DeadLoads::of("gravity", vec![load]))
    }

    fn of(name: &'static str, loads: Vec<NodalLoad>) -> DeadLoads {
        DeadLoads { line: LedgerLine::new(name, Account::Load), loads, time_s: 0.0, work_j: 0.0 }
    }
}

impl Term for DeadLoads {
    fn line(&self) -> LedgerLine {
        self.line
    }
    fn add(&self, at: &Pose, force: &mut [f64]) -> f64 {
        let each = self.loads.iter().map(|load| (load, load.amplitude.at(self.time_s)));
        each.map(|(load, amplitude)| -amplitude * load.push(amplitude, at.q, force)).sum()
    }
}

impl Transient for DeadLoads {
    fn advance(&mut self, at: &Pose, tick: &Tick, force: &mut [f64]) -> f64 {
        self.time_s = tick.time_s;
        let mut energy_j = 0.0;
        for load in &mut self.loads {
            let amplitude = load.amplitude.at(tick.time_s);
            let s = load.push(amplitude, at.q, force);
            let [a_old, s_old] = load.last.unwrap_or([amplitude, s]);
            self.work_j += 0.5 * (amplitude + a_old) * (s - s_old);
            load.last = Some([amplitude, s]);
            energy_j -= amplitude * s;
        }
        energy_j
    }
    fn ledger(&self, _at: &Pose) -> Vec<Row> {
        vec![self.line.row(RowKind::Supplied, self.work_j)]
    }
    fn save(&self) -> Vec<u8> {
        let loads: Vec<_> = self.loads.iter().map(|load| (load.last, load.vector, load.nodes())).collect();
        pack(&(self.time_s, self.work_j, loads))
    }
    fn restore(&mut self, saved: &[u8]) -> Option<()> {
        let (time_s, work_j, loads): (f64, f64, Vec<SavedLoad>) = unpack(saved)?;
        let same = |(own, (_, vector, nodes)): (&NodalLoad, &SavedLoad)| own.vector == *vector && own.nodes() == *nodes;
        (loads.len() == self.loads.len() && self.loads.iter().zip(&loads).all(same)).then_some(())?;
        (self.time_s, self.work_j) = (time_s, work_j);
        for (load, (last, ..)) in self.loads.iter_mut().zip(loads) {
            load.last = last;
        }
        Some(())
    }
}

impl NodalLoad {
    fn new(on: On, vector: V3, amplitude: &Amplitude) -> NodalLoad {
        NodalLoad { on, vector, amplitude: amplitude.clone(), last: None }
    }
    fn nodes(&self) -> &[u32] {
        if let On::Nodes(nodes) = &self.on { nodes } else { &[] }
    }
    /// Adds A F₀ and returns Σ F₀·x \[J\].
    fn push(&self, amplitude: f64, q: &[f64], force: &mut [f64]) -> f64 {
        let (points, force) = (q.as_chunks::<4>().0, force.as_chunks_mut::<4>().0);
        match &self.on {
            On::Nodes(nodes) => {
                nodes.iter().for_each(|i| (0..3).for_each(|k| force[*i as usize][k] += amplitude * self.vector[k]));
                dot(self.vector, nodes.iter().fold([0.0; 3], |sum, &i| add(sum, node(points, i as usize))))
            }
            On::Masses(masses) => {
                let mut s = 0.0;
                for ((x, f), &mass) in points.iter().zip(force).zip(masses) {
                    let am = amplitude * mass;
                    (0..3).for_each(|k| f[k] += am * self.vector[k]);
                    s += mass * dot(self.vector, [x[0], x[1], x[2]]);
                }
                s
            }
        }
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
    fn load(amplitude: Amplitude) -> DeadLoads {
        let force = NodalForce { set: "tip".into(), total_n: [2.0, 0.0, -4.0], amplitude };
        DeadLoads::forces(&two_nodes(), &[force]).unwrap()
    }
    fn step(term: &mut DeadLoads, step: u64, dt_s: f64, q: &[f64]) -> Vec<f64> {
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
        assert!(other.restore(&saved).is_some());
        assert!(other.restore(&saved[1..]).is_none() && other.restore(&[]).is_none());
        for i in 10..20 {
            assert_eq!(step(&mut term, i, 0.01, &at(i)), step(&mut other, i, 0.01, &at(i)));
        }
        assert_eq!(term.work_j.to_bits(), other.work_j.to_bits());
    }

    #[test]
    fn an_unknown_set_is_named_with_those_that_exist() {
        let force = NodalForce { set: "top".into(), total_n: [0.0; 3], amplitude: Amplitude::Constant(1.0) };
        let message = DeadLoads::forces(&two_nodes(), &[force]).unwrap_err().to_string();
        assert!(message.contains("`top`") && message.contains("tip"), "{message}");
    }

    fn earth() -> DeadLoads {
        let gravity = Gravity { g_m_s2: [0.0, 0.0, -9.81], amplitude: Amplitude::Constant(1.0) };
        DeadLoads::gravity(&gravity, &[2.0, 0.5]).unwrap()
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
                v[4 * node + 2] += whole * dt_s * force[4 * node + 2] / [2.0, 0.5][node];
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
        assert!(other.restore(&term.save()).is_some() && other.restore(&[1, 2]).is_none());
        for term in [&mut term, &mut other] {
            let tick = Tick { step: 1, time_s: 0.1, dt_s: 0.1 };
            term.advance(&Pose::nodes(&[-0.7; 8]), &tick, &mut [0.0; 8]);
        }
        assert_eq!(term.work_j.to_bits(), other.work_j.to_bits());
    }
}
