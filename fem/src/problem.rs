//! What a run needs besides the mesh: sections, chambers, supports, loads, contact, settings.

mod gas;
mod print;
pub(crate) mod solid;
pub(crate) mod start;

pub use crate::amplitude::Amplitude;
use crate::mesh::Mesh;
use crate::policy;
use crate::vec3::V3;
pub use gas::Gas;
use models::Fabric;
pub use models::fabrics::Ply;
pub use print::{GRAVITY, PrintedLoads, force_on, motion_of, pressure_of};
use std::sync::Arc;

/// Mesh, materials, loads, supports and settings of one run.
#[derive(Debug, Clone, Default)]
pub struct Problem {
    /// Title of the run in its outputs.
    pub name: String,
    /// Nodes and elements in their stress-free shape.
    pub mesh: Mesh,
    /// One section per part, in the order of `mesh.parts`.
    pub sections: Vec<Section>,
    /// Volumes of air; parts name them in `front` and `back`.
    pub chambers: Vec<Chamber>,
    /// Node sets along whose edges chambers are open: cuts by planes of symmetry that hold the fabric's edge.
    pub open: Vec<String>,
    /// Node sets that stand still or follow a prescribed motion.
    pub supports: Vec<Support>,
    /// Parts of the structure that move as one rigid body.
    pub rigid: Vec<Rigid>,
    /// Forces that act on the nodes of sets, from outside.
    pub forces: Vec<NodalForce>,
    /// Uniform gravity \[m/s²\]; `None` if there is none.
    pub gravity: Option<Gravity>,
    /// Rigid solids that the robot may touch.
    pub obstacles: Vec<Obstacle>,
    /// Contact between layers; `None` switches the search off.
    pub contact: Option<Contact>,
    /// Time step, damping, outputs, guards and other numerical settings.
    pub settings: Settings,
}

/// How a part is made: its plies, weight and bending.
#[derive(Debug, Clone)]
pub struct Section {
    /// Sheets on top of each other; their tensions add.
    pub plies: Vec<Ply>,
    /// Plies glued to each other bend as one thick sheet (D of the whole stack, 8 times one ply for two); plies that slide
    /// bend one by one (2 times).
    pub bonded: bool,
    /// Mass per volume of ply \[kg/m³\].
    pub density_kg_m3: f64,
    /// Bending stiffness as a share of a solid plate's E t³/(12(1 − ν²)): 1 for film, about .1 for coated woven fabric
    /// (assumed), 0 for a membrane.
    pub bending_factor: f64,
    /// Keep the curvature of the reference shape as the unloaded one; otherwise the fabric wants to be flat.
    pub rest_curvature: bool,
}

impl Section {
    /// One ply along the warp of its part, 1000 kg/m³.
    pub fn of(fabric: Arc<dyn Fabric>, bending_factor: f64) -> Section {
        let plies = vec![Ply { fabric, angle_rad: 0.0 }];
        Section { plies, bonded: true, density_kg_m3: 1000.0, bending_factor, rest_curvature: false }
    }
}

/// A volume of air with one pressure.
#[derive(Debug, Clone)]
pub struct Chamber {
    /// Name by which parts refer to the chamber in `front` and `back`.
    pub name: String,
    /// How its gauge pressure comes about.
    pub pressure: Pressure,
    /// Axes (x, y, z) along which the chamber is open: it ends at planes perpendicular to them that hold the fabric's edge
    /// (planes of symmetry, plane strain between two). Its volume is the volume within the model. `None`: the chamber is closed.
    pub open_axis: Option<[bool; 3]>,
}

impl Chamber {
    /// A closed chamber whose gauge pressure is set \[Pa\].
    pub fn of(name: &str, pressure_pa: Amplitude) -> Chamber {
        Chamber { name: name.into(), pressure: Pressure::Set(pressure_pa), open_axis: None }
    }
}

/// How the gauge pressure of a chamber comes about.
#[derive(Debug, Clone)]
pub enum Pressure {
    /// Gauge pressure over time, set from outside \[Pa\].
    Set(Amplitude),
    /// Set until `sealed_at_s`; then the gas in the chamber decides.
    Sealed {
        /// Gauge pressure over time before sealing \[Pa\].
        filling: Amplitude,
        /// Time at which the chamber is sealed \[s\].
        sealed_at_s: f64,
        /// The gas and its ways in and out.
        gas: Gas,
    },
}

impl Pressure {
    /// The set pressure, until sealing if the chamber is sealed \[Pa\].
    pub fn filling(&self) -> &Amplitude {
        let (Pressure::Set(filling) | Pressure::Sealed { filling, .. }) = self;
        filling
    }
}

/// Nodes that stand still or follow a prescribed motion along some axes.
#[derive(Debug, Clone)]
pub struct Support {
    /// Name of the node set, a key of [`Mesh::sets`].
    pub set: String,
    /// Which of x, y, z are prescribed. All three is pinned. A row of pinned nodes next to another row is encastre: shells
    /// have no rotations of their own, so a clamped edge holds two rows of nodes.
    pub axes: [bool; 3],
    /// Displacement from the start over time \[m\] per axis; `None` holds still.
    pub motion: Option<[Amplitude; 3]>,
}

/// Nodes that keep their distances: an end cap, a plate.
#[derive(Debug, Clone)]
pub struct Rigid {
    /// Name of the node set, a key of [`Mesh::sets`].
    pub set: String,
}

/// The same force on every node of a set.
#[derive(Debug, Clone)]
pub struct NodalForce {
    /// Name of the node set, a key of [`Mesh::sets`].
    pub set: String,
    /// Total force on the set \[N\], shared equally between its nodes.
    pub total_n: [f64; 3],
    /// Multiplier of the force over time \[-\].
    pub amplitude: Amplitude,
}

/// Gravity, the same everywhere, with a multiplier over time.
#[derive(Debug, Clone)]
pub struct Gravity {
    /// Acceleration along x, y and z \[m/s²\].
    pub g_m_s2: [f64; 3],
    /// Multiplier of the acceleration over time \[-\].
    pub amplitude: Amplitude,
}

/// A rigid solid that does not turn.
#[derive(Debug, Clone, PartialEq)]
pub struct Obstacle {
    /// Surface at the start, before any motion.
    pub shape: ObstacleShape,
    /// Coulomb friction coefficient between solid and fabric; 0 for none.
    pub friction: f64,
    /// Displacement over time \[m\] per axis; `None` holds still.
    pub motion: Option<[Amplitude; 3]>,
}

impl Obstacle {
    /// Displacement from the start at a time \[m\]; 0 without a motion.
    pub fn moved_m(&self, time_s: f64) -> V3 {
        self.motion.as_ref().map_or([0.0; 3], |motion| [0, 1, 2].map(|k| motion[k].at(time_s)))
    }
}

/// Surface of an obstacle, at the start of its motion.
#[derive(Debug, Clone, PartialEq)]
pub enum ObstacleShape {
    /// Half space behind a plane; `normal` points to the free side.
    Plane {
        /// A point of the plane \[m\].
        point: [f64; 3],
        /// Outward normal towards the free side; any length above 0.
        normal: [f64; 3],
    },
    /// Solid cylinder without ends; the fabric is outside.
    Cylinder {
        /// A point of the axis \[m\].
        point: [f64; 3],
        /// Direction of the axis; any length above 0.
        axis: [f64; 3],
        /// Radius of the cylinder \[m\], above 0.
        radius_m: f64,
    },
}

/// Contact between layers of fabric: friction, distances and parts.
#[derive(Debug, Clone, PartialEq)]
pub struct Contact {
    /// Coulomb friction coefficient between two layers; 0 for none.
    pub friction: f64,
    /// Distance kept between layers that start close to each other \[m\] (paper: layers 0.01 mm apart).
    pub gap_m: f64,
    /// Distance kept between surfaces that meet later \[m\].
    pub thickness_m: f64,
    /// Parts that take part; empty: all.
    pub parts: Vec<String>,
    /// Sides of elements against sides as well, and no step in which anything passes through anything, at 8 times the
    /// CPU time per step. For layers that start apart: see `contact::edges`.
    pub edges: bool,
}

impl Default for Contact {
    fn default() -> Contact {
        Contact { friction: 0.0, gap_m: 5e-6, thickness_m: 2e-4, parts: Vec::new(), edges: false }
    }
}

/// Numerical settings of a run: time, step, damping, outputs and guards.
#[derive(Debug, Clone)]
pub struct Settings {
    /// Simulated time at which the run ends \[s\].
    pub end_s: f64,
    /// Share of the stable step that is used; .9 unless fabric strains exceed 10 %.
    pub cfl: f64,
    /// Time step forced by the user \[s\]; refused when it is not stable.
    pub dt_s: Option<f64>,
    /// How masses are raised to lengthen the step.
    pub mass_scaling: MassScaling,
    /// Selective mass scaling: waves of a few elements are heavy, long ones keep their mass. 2 to 2.6 times the step, or an eighth
    /// and less of the mass that [`MassScaling::TargetStep`] adds to a robot, for a fifth more time per step. Quasi-static runs only, and not with
    /// [`Contact::edges`].
    pub selective_mass: bool,
    /// Passes over the elements' sides that selective masses take, 2, 4 or 6: 4 allow 1.4 times the step of 2, 6 1.8 times, and
    /// waves of up to about twice and three times as many elements are heavy. For meshes much finer than what moves.
    pub mass_passes: usize,
    /// Mass-proportional damping α \[1/s\]; its work is on the ledger.
    pub mass_damping_1_s: f64,
    /// In-plane viscosity as a share of critical damping of the highest membrane mode (0.06 is usual).
    pub viscosity: f64,
    /// Hourglass coefficient; .01 does not lock, .05 and more do. Where the wall wrinkles at the scale of the
    /// mesh it needs less: p R/(E t) for a bent tube, a tenth of that for a pleated balloon (measured in `verification::checks`).
    pub hourglass: f64,
    /// Simulated time between two outputs \[s\].
    pub output_every_s: f64,
    /// Threads; 0: as many as the machine has. Results do not depend on it.
    pub threads: usize,
    /// Standard deviation of the random out-of-plane offset of every free node at the start, as a share of the local
    /// element size; 0 for a perfect start.
    pub imperfection: f64,
    /// Seed of the random imperfection; the same seed gives the same offsets.
    pub seed: u64,
    /// How a robot's holds wait until its tip is at rest; `None` for other cases.
    pub patience: Option<Patience>,
    /// Limits at which an untrustworthy run stops.
    pub guards: Guards,
}

/// How a hold waits for rest (`fem/src/robot/rest.rs`).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Patience {
    /// Movement of the tip that counts as none, over its displacement.
    pub creep: f64,
    /// Longest time of a hold that loads stand still \[s\].
    pub longest_s: f64,
    /// Time between two looks at the tip \[s\].
    pub window_s: f64,
}

/// How masses are raised to lengthen the step. With rate-free fabrics this equals a shorter simulated time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum MassScaling {
    /// All nodes keep their true masses.
    None,
    /// All masses are multiplied by this factor.
    Fixed(f64),
    /// Only the nodes that would limit the step, just enough for this step \[s\].
    TargetStep(f64),
}

/// When a run stops because its result cannot be trusted.
#[derive(Debug, Clone, PartialEq)]
pub struct Guards {
    /// Energy residual over external work that stops the run (0.02).
    pub residual: f64,
    /// Speed that no physics here explains \[m/s\]; 0: the speed of sound in the stiffest fabric.
    pub speed_m_s: f64,
    /// Stop at an element that lost its area or turned inside out.
    pub inverted: bool,
    /// Share of the nodes in contact that may change side of a layer (0.05).
    pub sides: f64,
    /// Share of the stored energy that hourglass control may hold at the end (0.15).
    pub hourglass: f64,
}

impl Default for Guards {
    fn default() -> Guards {
        Guards {
            residual: policy::RESIDUAL,
            speed_m_s: 0.0,
            inverted: true,
            sides: policy::SIDES,
            hourglass: policy::HOURGLASS,
        }
    }
}

impl Default for Settings {
    fn default() -> Settings {
        Settings {
            end_s: 1.0,
            cfl: 0.9,
            dt_s: None,
            mass_scaling: MassScaling::None,
            selective_mass: false,
            mass_passes: 2,
            mass_damping_1_s: 0.0,
            viscosity: 0.06,
            hourglass: 0.01,
            output_every_s: 0.01,
            threads: 1,
            imperfection: 0.0,
            seed: 1,
            patience: None,
            guards: Guards::default(),
        }
    }
}

impl Problem {
    /// A problem with default settings, no loads and no supports.
    pub fn new(name: &str, mesh: Mesh, sections: Vec<Section>, chambers: Vec<Chamber>) -> Problem {
        Problem { name: name.to_owned(), mesh, sections, chambers, ..Problem::default() }
    }
}
