//! Sets of the bench: planned, hidden and found effects.

use crate::loads::in_plane;
use crate::score::{Claim, ClaimScore};
use crate::truth::{Hiding, Truth};
use compare::diagnosis::{Diagnosis, Options};
use compare::error::CompareError;
use compare::{Evidence, Progress};
use data::{About, Direct, Provenance};
use models::Scenario;
use serde::{Deserialize, Serialize};

/// What diagnoses; the bench is given it.
pub type Diagnoser = fn(&Scenario, &[Evidence], &Options, &mut Progress) -> Result<Diagnosis, CompareError>;

/// A set before it is measured and diagnosed.
#[derive(Debug, Clone)]
pub struct PlannedSet {
    /// Part of the table that the set belongs to.
    pub part: Lot,
    /// Robot, noise and the effects that are hidden.
    pub truth: Truth,
}

/// Parts of the table, each a kind of set.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Lot {
    /// Nothing, one effect, two, or one outside the catalogue.
    Hidden(Hiding),
    /// The same sets, of robots whose bending stiffness was measured, to 10 %.
    Measured(Hiding),
    /// One effect by the catalogue's own law, for which a true value of its parameter exists.
    Interval,
    /// Nothing, seen by a camera with heavy-tailed noise.
    HeavyTails,
    /// Nothing, or the same effects, seen by a camera that loses markers.
    LostMarkers(Hiding),
    /// Nothing, or the same effects, without scatter of single holds.
    White(Hiding),
    /// A clamp at base or tip, from half of its typical stiffness to thirty times that.
    Clamp,
    /// A wall that softens as it bends.
    Softening,
}

/// A set after its diagnosis, or after its failure.
#[derive(Debug, Clone)]
pub struct SetOutcome {
    /// Part of the table that the set belongs to.
    pub part: Lot,
    /// Robot, noise and the effects that were hidden.
    pub truth: Truth,
    /// What was found; `None` if it failed.
    pub named: Option<Named>,
}

/// The answer to a set, with all that the table counts.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
pub struct Named {
    /// Those parts of the diagnosis that are scored.
    pub answer: Claim,
    /// Comparison of the answer with the truth.
    pub score: ClaimScore,
    /// A single name is called identified.
    pub identified: bool,
    /// Something in the data was reported as a likely slip.
    pub slip: bool,
    /// A column of pressures was, and the verdict withheld.
    pub pressure_slip: bool,
    /// Rms error of the calibrated base and of the final model under a protocol without measurements \[mm\], of verdicts that name.
    pub unseen_mm: Option<[f64; 2]>,
    /// The base's 95 % interval of B holds the true one.
    pub bending_held: Option<bool>,
    /// The true value is inside the 95 % interval; `None` if another effect was chosen or the interval is missing.
    pub covered: Option<bool>,
    /// λ between the best explanation and its rivals, by name.
    pub separations: Vec<(String, f64)>,
    /// BIC of the (first) true effect beyond the best one.
    pub bic_behind: Option<f64>,
    /// Smallest detectable size of the (first) true effect, in typical sizes.
    pub smallest_detectable: Option<f64>,
    /// Score after the recommended next experiment, of ambiguous sets.
    pub after: Option<After>,
}

/// The answer after the recommended experiment was measured too.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct After {
    /// Short name of the recommended experiment.
    pub experiment: String,
    /// Answer to old and new data together.
    pub answer: Claim,
    /// Comparison of that answer with the truth.
    pub score: ClaimScore,
}

pub(super) fn names(truth: &Truth) -> Vec<&str> {
    truth.effects.iter().map(|choice| choice.name.as_str()).collect()
}

/// The description of a set: gravity is known to act.
pub(super) fn about(truth: &Truth) -> Result<About, CompareError> {
    Ok(About {
        title: "Bench".into(),
        provenance: Provenance::Synthetic,
        source: "ibr bench discovery".into(),
        licence: "CC0-1.0".into(),
        actuator: Some(truth.actuator.clone()),
        geometry: None,
        markers: Vec::new(),
        gravity_direction: Some(in_plane(truth.told()?.gravity_direction)),
        direct: Direct::default(),
        bending_nm2: None,
        measured: Vec::new(),
        runs: Vec::new(),
        notes: None,
    })
}
