//! The one interface of the project: a physical effect as an energy and its virtual work.
//!
//! A state of rest makes the virtual work of all terms vanish, `δW = Σᵢ Fᵢ·δq = 0` with `Fᵢ = −∂Eᵢ/∂q`. A model is
//! a list of terms; a missing physical effect is a missing entry of that list. The reduced model and the finite
//! element engine use the same trait over different coordinates `q`:
//!
//! | coordinates `q` | used by | energy |
//! |---|---|---|
//! | [`actuator_q`]: actuator coordinate, contraction, volume, geometric curvature | pressure work, shear, folds | J per metre of body |
//! | `[κ]`: curvature of a segment \[1/m\] | body pressure, bending, wrinkling | J per metre of body |
//! | `[x₀, y₀, x₁, y₁, …]`: node positions \[m\] | gravity, tip load | J |
//! | `[x₀, y₀, z₀, 0, x₁, …]`: nodes of a finite element mesh \[m\] | shells, follower pressure, contact | J |
//!
//! Some effects depend on what came before (friction, creep). The reduced model keeps their memory outside of the terms,
//! in a [`crate::Prediction`], and walks a protocol with [`crate::Model::follow`]: [`Remembering`]. The finite element
//! engine steps through time and its terms keep their own memory: `fem::Transient`.

use serde::Serialize;
use spelling::si;

/// Gauge pressures acting on the robot \[Pa\].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Loads {
    /// Gauge pressure p_b in the body, the same everywhere.
    pub body_pa: f64,
    /// Gauge pressure of each supply channel P \[Pa\]; a zone names its channel (0 unless said).
    pub actuator_pa: [f64; CHANNELS],
}

/// Number of independent actuator supply lines a robot can have.
pub const CHANNELS: usize = 4;

impl Loads {
    /// The same actuator pressure in every channel.
    ///
    /// ```
    /// let loads = models::Loads::uniform(2e3, 30e3);
    /// assert_eq!(loads.actuator_pa[3], 30e3);
    /// ```
    pub fn uniform(body_pa: f64, actuator_pa: f64) -> Loads {
        Loads { body_pa, actuator_pa: [actuator_pa; CHANNELS] }
    }
}

impl<'a> Pose<'a> {
    /// A pose without station, time or memory.
    pub fn new(q: &'a [f64], p_body_pa: f64, p_act_pa: f64) -> Pose<'a> {
        Pose { q, p_body_pa, p_act_pa, s_m: 0.0, dt_s: 0.0, memory: &[] }
    }

    /// A pose of finite element nodes, whose terms keep their own pressures.
    pub fn nodes(q: &'a [f64]) -> Pose<'a> {
        Pose::new(q, 0.0, 0.0)
    }

    /// A value this term remembers; 0 where nothing has happened yet.
    #[inline]
    pub fn remembered(&self, index: usize) -> f64 {
        self.memory.get(index).copied().unwrap_or(0.0)
    }
}

/// Where a term is evaluated: coordinates, the two pressures of the place, and what the term remembers there.
#[derive(Debug, Clone, Copy)]
pub struct Pose<'a> {
    /// Generalised coordinates; their meaning depends on the list the term is in.
    pub q: &'a [f64],
    /// Gauge pressure p_b in the body \[Pa\].
    pub p_body_pa: f64,
    /// Pressure in this segment's actuator, after the supply stage \[Pa\]; 0 where there is none.
    pub p_act_pa: f64,
    /// Middle of the segment along the taut generator \[m\]; 0 for terms over nodes.
    pub s_m: f64,
    /// Time since the state that [`Pose::memory`] remembers \[s\]; 0: at once.
    pub dt_s: f64,
    /// What this term remembers of the states before, in its own layout ([`Remembering::memory`]); empty: nothing has happened
    /// yet, all values are 0.
    pub memory: &'a [f64],
}

/// What a term with history keeps of every place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Memory {
    /// Number of values that the term keeps per place.
    pub values: usize,
    /// Shortest time over which they change by themselves \[s\]; infinite when only motion changes them.
    pub time_s: f64,
}

impl Memory {
    /// Memory of a static term: no values, and no time over which they change.
    pub const NONE: Memory = Memory { values: 0, time_s: f64::INFINITY };
}

/// Where a formula of the scenario is largest.
#[derive(Debug, Clone, PartialEq)]
pub struct Extreme {
    /// Name of the formula in `[effects.<name>]`, for the message.
    pub formula: String,
    /// Curvature at which its moment is largest \[1/m\].
    pub kappa: f64,
    /// Bend of one actuator unit \[rad\].
    pub theta: f64,
    /// Size of its moment there \[N·m\]; infinite in place of NaN.
    pub moment: f64,
}

/// One physical effect: its energy and its virtual work. Both engines build on it.
///
/// Law (tested over every term at random poses): the force added equals minus the slope of the returned energy, at fixed
/// memory.
pub trait Term: Send + Sync {
    /// Its line in the energy ledger.
    fn line(&self) -> LedgerLine;
    /// Adds `−∂E/∂q` to `force` (same length as `at.q`) and returns the energy E.
    fn add(&self, at: &Pose, force: &mut [f64]) -> f64;

    /// The force of [`Term::add`] alone, for a term whose energy costs more.
    fn add_force(&self, at: &Pose, force: &mut [f64]) {
        self.add(at, force);
    }
}

/// A term over `[κ]` of the reduced model, which may remember the states before; by default it remembers nothing.
///
/// One with history returns its **incremental potential**: what it stores now and loses on the way from the state it
/// remembers. At its new memory and without time it returns what it stores.
pub trait Remembering: Term {
    /// States how many values the term keeps per place and how fast they change.
    fn memory(&self) -> Memory {
        Memory::NONE
    }

    /// Writes to `next` what it remembers after the accepted state `at`, and returns the energy lost on the way there, per
    /// metre of body.
    fn remember(&self, _at: &Pose, _next: &mut [f64]) -> f64 {
        0.0
    }

    /// Where its force is largest over curvatures `within`, or not finite somewhat beyond, for the error of a place without
    /// equilibrium. Only a formula of the scenario answers: the catalogue's laws are tested over their bounds.
    fn extreme(&self, _at: &Pose, _within: [f64; 2]) -> Option<Extreme> {
        None
    }
}

/// What energy it is: lines of both engines on the same account stand side by side.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Account {
    /// Gas of the actuator, or of all chambers.
    ActuatorGas,
    /// Pressure work of the gas in the body.
    BodyGas,
    /// Walls, welds and folds as they bend, and fabric that locks.
    Wall,
    /// Stretch and shear of fabric, from its membrane strain.
    Stretch,
    /// Sheets that are compressed and wrinkle.
    Compression,
    /// Contact between layers, or with an obstacle.
    Contact,
    /// What numbers need and nature has not.
    Numerical,
    /// What pulls or stops the structure from outside.
    Load,
}

/// How a term calls itself in the energy ledger.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct LedgerLine {
    /// Where the energy is or went.
    pub name: &'static str,
    /// Kind of energy, by which the lines of both engines are compared.
    pub account: Account,
}

impl LedgerLine {
    /// A name, and the account on which both engines compare it.
    pub const fn new(name: &'static str, account: Account) -> LedgerLine {
        LedgerLine { name, account }
    }

    /// Its row with an energy \[J\].
    pub fn row(self, kind: RowKind, energy_j: f64) -> Row {
        Row { name: self.name, account: self.account, kind, energy_j }
    }
}

/// What a ledger row does to the balance `kinetic + Σ stored + Σ dissipated = Σ supplied`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum RowKind {
    /// Recoverable energy that the structure holds now.
    Stored,
    /// Energy lost since the start; never falls.
    #[serde(rename = "lost")]
    Dissipated,
    /// Work done on the structure from outside since the start.
    Supplied,
}

impl RowKind {
    /// Its word in files and tables.
    pub fn word(self) -> &'static str {
        ["stored", "dissipated", "supplied"][self as usize]
    }
}

/// One row of the energy ledger.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Row {
    /// Where the energy is or went.
    #[serde(rename = "term")]
    pub name: &'static str,
    /// Kind of energy, by which the lines of both engines are compared.
    #[serde(skip)]
    pub account: Account,
    /// Which side of the balance it is on.
    pub kind: RowKind,
    /// Energy \[J\]; in the reduced model the gas of the actuator has −PΔV, the negative of its work.
    #[serde(rename = "energy_mj", serialize_with = "si::mm")]
    pub energy_j: f64,
}

/// Layout of the coordinates of an actuator-side term. Only the first is independent; the others follow from it, so a
/// term may be written in whichever is natural and the chain rule is applied once, in the balance.
pub mod actuator_q {
    /// The actuator's own coordinate: half arc angle θ \[rad\] of a pouch, contraction ε of a fabric muscle.
    pub const COORDINATE: usize = 0;
    /// Contraction ε of the actuator \[-\], positive where it shortens.
    pub const CONTRACTION: usize = 1;
    /// Volume per unit flat length \[m²\].
    pub const VOLUME: usize = 2;
    /// Curvature κ the body would have if the fabric did not stretch \[1/m\].
    pub const CURVATURE: usize = 3;
    /// Number of coordinates, the length of `Pose::q` in these terms.
    pub const LEN: usize = 4;
}
