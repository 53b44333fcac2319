//! Time stepping by central differences with lumped masses, the energy ledger and the guards.
//!
//! ```text
//! v(n+½) = [v(n−½)(1 − ½αΔt) + Δt F(n)/m] / (1 + ½αΔt)        x(n+1) = x(n) + Δt v(n+½)
//! Δt = cfl · γ · 2/ω · (√(1 + ξ²) − ξ),   ω² = maxᵢ kᵢ/mᵢ      kinetic(n) = ½ Σ m v(n−½)·v(n+½)
//! ```
//! α mass damping, ξ viscosity, kᵢ the stiffness bounds of all terms ([`crate::Transient::stiffness_bound`]), γ ≥ 1 what the
//! highest mode of the whole mesh allows beyond them (`highest`). With selective mass scaling m is a matrix (`selective`). With this
//! kinetic energy the balance of a linear undamped system is kept to rounding.
//! Reference: Belytschko, Liu, Moran, Nonlinear Finite Elements, ch. 6.

mod clock;
mod constraint;
mod guard;
mod highest;
mod reaction;
mod selective;
mod setup;
mod step;
mod team;
mod update;

pub use crate::sheet::fields::ElementFields;
pub use clock::Ledger;
pub use guard::{FirstThrough, Through};
pub use reaction::Reaction;
pub use step::GoOn;

use models::{Account, Pose, RowKind};
use serde::{Deserialize, Serialize};

use crate::bytes::{pack, unpack};
use crate::contact::LayerContact;
use crate::contact::edges::Edges;
use crate::problem::Settings;
use crate::sheet::Sheet;
use crate::sheet::order::Order;
use crate::transient::{dissipated, stored, sum_of, supplied};
use crate::vec3::{Nodes, V3};
use crate::{FemError, Mesh, Problem, Result, Transient};
use clock::{Books, RunClock};
use constraint::{BodyNow, Driven, RigidBody};
pub(crate) use guard::LESS_HOURGLASS;
use reaction::Reactions;
use selective::Selective;
pub(crate) use selective::gain;
use team::Team;

/// Run of one problem: mesh, terms, contact and the state of the time integration.
pub struct Simulation {
    order: Order,
    mesh: Mesh,
    sheet: Sheet,
    terms: Vec<Box<dyn Transient>>,
    contact: Option<LayerContact>,
    edges: Option<Edges>,
    driven: Vec<Driven>,
    bodies: Vec<RigidBody>,
    reactions: Reactions,
    tie_offset: Vec<[f64; 3]>,
    /// Mass of each node, scaling included \[kg\].
    mass: Vec<f64>,
    fixed: Vec<(u32, [bool; 3])>,
    /// The fixed nodes that supports move or bodies and ties carry along.
    moved: Vec<(u32, [bool; 3])>,
    /// Position and velocity of `moved` nodes during an update.
    held: Vec<([f64; 4], [f64; 4])>,
    arch: pulp::Arch,
    settings: Settings,
    /// Speed that stops the run \[m/s\].
    fastest_m_s: f64,
    /// Mass added by scaling over the true mass of all nodes.
    added_mass: f64,
    x: Vec<[f64; 4]>,
    v: Vec<[f64; 4]>,
    selective: Option<Selective>,
    force: Vec<[f64; 4]>,
    clock: RunClock,
    books: Books,
    /// Threads of the run; `None` while they work.
    team: Option<Team>,
    cpu_s: f64,
}

/// What a checkpoint holds of a run.
#[derive(Serialize, Deserialize)]
struct RunState {
    clock: RunClock,
    books: Books,
    x: Vec<[f64; 4]>,
    v: Vec<[f64; 4]>,
    selective: Option<Vec<f64>>,
    sheet: Vec<u8>,
    terms: Vec<SavedTerm>,
    bodies: Vec<BodyNow>,
    reactions: Vec<[V3; 2]>,
    /// Masses, what scaling added over the true mass, and the first step, which other loads would choose otherwise.
    masses: (Vec<f64>, f64, f64),
}

/// What a checkpoint holds of a term.
#[derive(Serialize, Deserialize)]
struct SavedTerm {
    name: String,
    state: Vec<u8>,
    /// What it has supplied and dissipated if it goes, taking what it stores with it \[J\].
    gone: [f64; 2],
}

impl SavedTerm {
    fn of(term: &dyn Transient, pose: &Pose) -> SavedTerm {
        let rows = if term.line().account == Account::Load { term.ledger(pose) } else { Vec::new() };
        let [stored, dissipated, supplied] =
            [RowKind::Stored, RowKind::Dissipated, RowKind::Supplied].map(|kind| sum_of(&rows, kind));
        let gone = [supplied - stored, dissipated];
        SavedTerm { name: term.line().name.into(), state: term.save(), gone }
    }
}

/// Reason for which [`Simulation::advance_until`] returned to its caller.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Advance {
    /// The run reached the time that was asked for.
    Reached,
    /// The callback returned false before that time.
    Interrupted,
}

/// Pressure and volume of one chamber at the time of the last step.
#[derive(Debug, Clone, PartialEq)]
pub struct ChamberState {
    /// Name of the chamber, as in the problem.
    pub name: String,
    /// Gauge pressure in the chamber \[Pa\].
    pub pressure_pa: f64,
    /// Volume enclosed by its wall \[m³\].
    pub volume_m3: f64,
}

impl Simulation {
    /// Continues from a checkpoint of the same problem.
    ///
    /// # Errors
    /// [`FemError::Problem`] if it belongs to another problem or is damaged.
    pub fn resume(problem: &Problem, saved: &[u8]) -> Result<Simulation> {
        let misfit = || FemError::Problem("the saved state does not fit this problem: start the run afresh".into());
        let state: RunState = unpack(saved).ok_or_else(misfit)?;
        let mut run = Simulation::prepared(problem, Some(&state.masses))?;
        run.restore(state, false).ok_or_else(misfit)?;
        Ok(run)
    }

    /// Goes on from the end of a run of another problem of the same structure (mesh, sections, supports, contact, numerics): loads that
    /// both have in the same way go on, others begin, and the books keep what those did that are gone.
    ///
    /// # Errors
    /// [`FemError::Problem`] if the state does not fit, or a new obstacle is where the structure is.
    pub fn go_on(problem: &Problem, saved: &[u8]) -> Result<Simulation> {
        let misfit = || FemError::Problem("the saved state does not fit this problem".into());
        let state: RunState = unpack(saved).ok_or_else(misfit)?;
        let mut run = Simulation::prepared(problem, Some(&state.masses))?;
        let left = run.restore(state, true).ok_or_else(misfit)?;
        if left.iter().any(|name| name == "obstacles") {
            crate::problem::solid::check(&run.positions(), &problem.obstacles, run.time_s())?;
        }
        // Higher pressures may allow a shorter step only.
        run.recheck()?;
        Ok(run)
    }

    /// Packs the state from which the same program continues bit by bit.
    pub fn save(&self) -> Vec<u8> {
        let pose = Pose::nodes(self.x.as_flattened());
        pack(&RunState {
            clock: self.clock,
            books: self.books,
            x: self.x.clone(),
            v: self.v.clone(),
            selective: self.selective.as_ref().map(Selective::save),
            sheet: self.sheet.save(),
            terms: self.others().map(|term| SavedTerm::of(term, &pose)).collect(),
            bodies: self.bodies.iter().map(|body| body.now).collect(),
            reactions: self.reactions.save(),
            masses: (self.mass.clone(), self.added_mass, self.clock.longest_s),
        })
    }

    /// Every term gets its state; loads need none where the run goes on with others. Returns the names of loads that begin.
    fn restore(&mut self, mut state: RunState, goes_on: bool) -> Option<Vec<String>> {
        let contact = self.contact.iter_mut().map(|c| c as &mut dyn Transient);
        let contact = contact.chain(self.edges.iter_mut().map(|e| e as &mut dyn Transient));
        let mut begin = Vec::new();
        for term in self.terms.iter_mut().map(|t| &mut **t as &mut dyn Transient).chain(contact) {
            let (name, account) = (term.line().name, term.line().account);
            let own = state.terms.iter().position(|saved| saved.name == name);
            match own.filter(|at| term.restore(&state.terms[*at].state).is_some()) {
                Some(at) => drop(state.terms.remove(at)),
                None => begin.push((goes_on && account == Account::Load).then(|| name.to_string())?),
            }
        }
        let fits = [state.x.len(), state.v.len()] == [self.x.len(), self.v.len()]
            && (goes_on || state.terms.is_empty())
            && state.bodies.len() == self.bodies.len();
        fits.then(|| self.sheet.restore(&state.sheet))??;
        for saved in &state.terms {
            (0..2).for_each(|k| state.books.earlier[k] += saved.gone[k]);
        }
        match (&mut self.selective, &state.selective) {
            (Some(selective), Some(saved)) => selective.restore(saved)?,
            (None, None) => {}
            _ => return None,
        }
        for (body, saved) in self.bodies.iter_mut().zip(&state.bodies) {
            body.now = *saved;
        }
        self.reactions.restore(&state.reactions)?;
        (self.clock, self.books, self.x, self.v) = (state.clock, state.books, state.x, state.v);
        Some(begin)
    }

    /// Simulated time of the current positions \[s\].
    pub fn time_s(&self) -> f64 {
        self.clock.time_s
    }
    /// Time that loads and supports stood still, [`Simulation::wait_until`] \[s\]; simulated in addition to the time.
    pub fn waited_s(&self) -> f64 {
        self.clock.waited_s
    }
    /// Number of steps done since the start.
    pub fn step(&self) -> u64 {
        self.clock.step
    }
    /// Length of the current time step \[s\].
    pub fn dt_s(&self) -> f64 {
        self.clock.dt_s
    }
    /// Processor seconds that the steps took so far, callbacks included, on all threads of this run; setting up and
    /// resuming count from 0. A callback sees a slightly older value.
    pub fn cpu_s(&self) -> f64 {
        self.cpu_s
    }

    /// Number of shell elements of all parts.
    pub fn elements(&self) -> usize {
        self.sheet.elements.len()
    }
    /// Whether waves of a few elements are heavy ([`crate::problem::Settings::selective_mass`]).
    pub fn selective_mass(&self) -> bool {
        self.selective.is_some()
    }
    /// Mass added by mass scaling over true mass; without what selective mass scaling adds to short waves.
    pub fn added_mass(&self) -> f64 {
        self.added_mass
    }
    /// Node positions in mesh order \[m\].
    pub fn positions(&self) -> Vec<V3> {
        self.in_mesh_order(&self.x)
    }
    /// Node velocities in mesh order \[m/s\].
    pub fn velocities(&self) -> Vec<V3> {
        self.in_mesh_order(&self.v)
    }

    fn in_mesh_order(&self, values: &Nodes) -> Vec<V3> {
        self.order.new.iter().map(|place| values[*place as usize]).map(|p| [p[0], p[1], p[2]]).collect()
    }

    /// Sets node velocities in mesh order \[m/s\]; before the first step. A rigid body takes their momentum and angular
    /// momentum. With selective mass scaling they are smoothed, momentum kept.
    pub fn set_velocities(&mut self, velocities: &[V3]) {
        for (place, v) in self.order.new.iter().zip(velocities) {
            self.v[*place as usize][..3].copy_from_slice(v);
        }
        for body in self.bodies.iter_mut() {
            body.take_velocities(&self.x, &self.v);
        }
        for (node, axes) in &self.fixed {
            for k in (0..3).filter(|k| axes[*k]) {
                self.v[*node as usize][k] = 0.0;
            }
        }
        if let Some(selective) = &mut self.selective {
            selective.begin(&mut self.v);
        }
    }

    /// The energy balance at the positions of the last step.
    pub fn ledger(&self) -> Ledger {
        let pose = Pose::nodes(self.x.as_flattened());
        let mut rows = self.sheet.ledger(&pose);
        rows.extend(self.others().flat_map(|term| term.ledger(&pose)));
        rows.push(dissipated("mass damping", Account::Numerical, self.books.damping.sum));
        let [given, lost] = self.books.earlier;
        if self.books.earlier != [0.0; 2] {
            rows.push(supplied("earlier loads", Account::Load, given));
            rows.push(dissipated("earlier loads", Account::Load, lost));
        }
        if !self.driven.is_empty() {
            rows.push(supplied("supports", Account::Load, self.books.support.sum));
        }
        // Before the first step, what terms store already is the energy of the start.
        let start = if self.clock.step == 0 { sum_of(&rows, RowKind::Stored) } else { self.books.start };
        Ledger::close(self.books.kinetic, rows, start, self.books.scale)
    }

    /// The same with the energy of compressed sheets separate from the membranes'; costs more, for occasional reading.
    pub(crate) fn ledger_in_detail(&self) -> Ledger {
        let mut ledger = self.ledger();
        let compressed_j = self.sheet.compressed_j(self.x.as_flattened());
        if let Some(membrane) = ledger.rows.iter_mut().find(|row| row.name == "membrane") {
            membrane.energy_j -= compressed_j;
            ledger.rows.push(stored("compressed sheets", Account::Compression, compressed_j));
        }
        ledger
    }

    /// Pressure and volume of every chamber.
    pub fn chambers(&self) -> Vec<ChamberState> {
        let state = |air: &crate::sheet::chamber::Air| ChamberState {
            name: air.name().to_owned(),
            pressure_pa: air.now.pressure_pa,
            volume_m3: air.now.volume_m3.unwrap_or(0.0),
        };
        self.sheet.air.iter().map(state).collect()
    }

    /// Stresses, strains, thickness and wrinkling of every element.
    pub fn element_fields(&self) -> ElementFields {
        self.sheet.fields(self.x.as_flattened())
    }

    /// Force and moment that supports exert on the structure, one for every node set that they name, at the positions of the last
    /// step before the present moment; 0 before the first.
    pub fn reactions(&self) -> &[Reaction] {
        &self.reactions.all
    }

    /// The force of [`Simulation::reactions`] at a node set \[N\]; `None` for a set that no support names.
    pub fn reaction_n(&self, set: &str) -> Option<V3> {
        self.reactions().iter().find(|r| r.set == set).map(|r| r.force_n)
    }

    /// Contact pressure at every node in mesh order \[Pa\]; empty without contact.
    pub fn contact_pressure_pa(&self) -> Vec<f64> {
        let Some(contact) = &self.contact else { return Vec::new() };
        let pressure = contact.pressure_pa(self.x.as_flattened());
        self.order.new.iter().map(|place| pressure[*place as usize]).collect()
    }

    fn others(&self) -> impl Iterator<Item = &dyn Transient> {
        let contact = self.contact.iter().map(|c| c as &dyn Transient);
        let contact = contact.chain(self.edges.iter().map(|e| e as &dyn Transient));
        self.terms.iter().map(|t| &**t as &dyn Transient).chain(contact)
    }
}
