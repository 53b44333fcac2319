//! Time stepping by central differences with lumped masses, the energy ledger and the guards.

use models::Row;

use crate::{FemError, Problem};

/// A run in progress.
pub struct Simulation {}

/// Why [`Simulation::advance_until`] returned.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Advance {
    /// The time was reached.
    Reached,
    /// The callback asked to stop.
    Interrupted,
}

/// The energy balance at one moment: kinetic + Σ stored + Σ dissipated = Σ supplied + residual.
#[derive(Debug, Clone, PartialEq)]
pub struct Ledger {
    /// Kinetic energy \[J\].
    pub kinetic_j: f64,
    /// All other lines.
    pub rows: Vec<Row>,
    /// What the balance misses \[J\].
    pub residual_j: f64,
    /// Work done from outside so far \[J\].
    pub external_work_j: f64,
    /// Largest external work so far, which the residual is judged against \[J\].
    pub scale_j: f64,
}

/// State of one chamber.
#[derive(Debug, Clone, PartialEq)]
pub struct ChamberState {
    /// Name.
    pub name: String,
    /// Gauge pressure \[Pa\].
    pub pressure_pa: f64,
    /// Volume \[m³\].
    pub volume_m3: f64,
}

/// Element results in mesh order (parts one after the other, quads before triangles), averaged over plies.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct ElementFields {
    /// Von Mises Cauchy stress \[Pa\].
    pub von_mises_pa: Vec<f64>,
    /// Principal Cauchy stresses, larger first \[Pa\].
    pub principal_stress_pa: Vec<[f64; 2]>,
    /// Principal Green–Lagrange strains, larger first.
    pub principal_strain: Vec<[f64; 2]>,
    /// Current thickness of the section (incompressible) \[m\].
    pub thickness_m: Vec<f64>,
    /// 0 taut, 1 wrinkled (smaller principal stress not tensile), 2 slack (larger not tensile either).
    pub wrinkle_state: Vec<u8>,
}

impl Simulation {
    /// Prepares a run.
    ///
    /// # Errors
    /// [`FemError::Mesh`] or [`FemError::Problem`] naming what cannot be simulated.
    pub fn new(_problem: &Problem) -> Result<Simulation, FemError> {
        Err(FemError::Problem("not built yet".into()))
    }
    /// Continues from a checkpoint of the same problem.
    ///
    /// # Errors
    /// [`FemError::Problem`] if it belongs to another problem or is damaged.
    pub fn resume(_problem: &Problem, _saved: &[u8]) -> Result<Simulation, FemError> {
        Err(FemError::Problem("not built yet".into()))
    }
    /// Everything a bit-identical continuation needs.
    pub fn save(&self) -> Vec<u8> {
        Vec::new()
    }
    /// Steps until the time is reached or `go_on` (called every few dozen steps) returns false.
    ///
    /// # Errors
    /// [`FemError::Stopped`] when a guard fires.
    pub fn advance_until(
        &mut self,
        _time_s: f64,
        _go_on: &mut dyn FnMut(&Simulation) -> bool,
    ) -> Result<Advance, FemError> {
        Ok(Advance::Reached)
    }
    /// Simulated time \[s\].
    pub fn time_s(&self) -> f64 {
        0.0
    }
    /// Steps done.
    pub fn step(&self) -> u64 {
        0
    }
    /// Current step length \[s\].
    pub fn dt_s(&self) -> f64 {
        0.0
    }
    /// Node positions in mesh order \[m\].
    pub fn positions(&self) -> Vec<[f64; 3]> {
        Vec::new()
    }
    /// Node velocities in mesh order \[m/s\].
    pub fn velocities(&self) -> Vec<[f64; 3]> {
        Vec::new()
    }
    /// The energy balance now.
    pub fn ledger(&self) -> Ledger {
        Ledger { kinetic_j: 0.0, rows: Vec::new(), residual_j: 0.0, external_work_j: 0.0, scale_j: 0.0 }
    }
    /// Pressure and volume of every chamber.
    pub fn chambers(&self) -> Vec<ChamberState> {
        Vec::new()
    }
    /// Stresses, strains, thickness and wrinkling of every element.
    pub fn element_fields(&self) -> ElementFields {
        ElementFields::default()
    }
    /// Contact pressure at every node in mesh order \[Pa\]; empty without contact.
    pub fn contact_pressure_pa(&self) -> Vec<f64> {
        Vec::new()
    }
}
