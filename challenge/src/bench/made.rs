//! Data that no generator made: markers of the finite element runs that come with the program (`data/sets/fem-*`).
//!
//! The diagnosing side is given the bare model. What it lacks is really there in the finite elements, and known to be from
//! runs without it or from the sewing pattern:
//!
//! | robot | not in the model | why it is in the data |
//! |---|---|---|
//! | sPAM | `seam_stiffness` | taped plies bend as one; as loose sheets (`bond = 0`, seed 1) the marker goes to 142.1 instead of 63.0 mm |
//! | cPAM | `self_contact` | written down when welds were lines and pouches met; no stop now: layers that pass through each other (`contact = false`, seed 1) bend the robot *less*, 0.60 instead of 1.11 rad at 10 kPa and 1.26 instead of 1.60 at 30. Counted as a miss |
//! | ePAM | `end_constraint` | the pouches' sides are sealed |
//! | fPAM | `shear_stiffness` | the fabric's shear modulus, 45° to the muscle |
//!
//! The bending stiffness B is kept at zero: a wall of this thickness has next to none, and a fitted one would take the place of
//! what is missing.

use super::Diagnoser;
use super::row::{Goal, Rate};
use compare::Evidence;
use compare::diagnosis::{Added, Options, Verdict};
use compare::error::CompareError;
use compare::study::published::shipped_scenario;
use serde::Serialize;

/// Robots, and what their bare model lacks.
pub const LACKING: [(&str, &str); 4] =
    [("spam", "seam_stiffness"), ("cpam", "self_contact"), ("epam", "end_constraint"), ("fpam", "shear_stiffness")];

/// What became of one robot.
#[derive(Debug, Clone, Serialize)]
pub struct FromRuns {
    /// Robot.
    pub robot: &'static str,
    /// Effect that the model lacks.
    pub lacking: &'static str,
    /// Verdict; `None` if the data do not allow one.
    pub verdict: Option<Verdict>,
    /// The stated set; a pair is written `a + b`.
    pub stated: Vec<String>,
    /// With the verdict `out_of_catalog`: the best that the catalogue can do, said not to be enough.
    pub attempt: Vec<String>,
    /// The attempt and what comes as close, to a fifth; a pair is written `a + b`.
    pub attempt_alike: Vec<String>,
    /// The effect is in the stated set.
    pub in_set: bool,
    /// Error beyond noise at pressures left out of the fit, before \[mm\].
    pub before_mm: Option<f64>,
    /// The same with what was added, or with the attempt; `None` without either.
    pub after_mm: Option<f64>,
}

impl FromRuns {
    /// The error at held-out pressures falls by half or more with what is stated.
    pub fn halved_as_stated(&self) -> bool {
        !self.stated.is_empty() && self.halved()
    }

    /// The same with what is stated or, said not to be enough, attempted.
    pub fn halved(&self) -> bool {
        self.before_mm.zip(self.after_mm).is_some_and(|(before, after)| after <= 0.5 * before)
    }
}

/// Diagnoses the finite element sets; what fails is told in `failed`.
pub(super) fn made(diagnose: Diagnoser, failed: &mut Vec<String>) -> Vec<FromRuns> {
    let mut all = Vec::new();
    for (robot, lacking) in LACKING {
        match one(robot, lacking, diagnose) {
            Ok(made) => all.push(made),
            Err(error) => failed.push(format!("fem-{robot}: {error}")),
        }
    }
    all
}

fn one(robot: &'static str, lacking: &'static str, diagnose: Diagnoser) -> Result<FromRuns, CompareError> {
    let set = format!("fem-{robot}");
    let options = Options { keep_bending: true, next_experiment: false, missing_moment: false, ..Options::default() };
    let evidence = [Evidence::read(&set)?];
    let found = diagnose(&shipped_scenario(robot)?.bare(), &evidence, &options, &mut |_, _| ())?;
    let names = |added: &[Added]| added.iter().map(|a| a.effect.clone()).collect::<Vec<_>>();
    let attempt = names(&found.attempt);
    let in_set = found.indistinguishable.iter().any(|entry| entry.split(" + ").any(|name| name == lacking));
    Ok(FromRuns {
        robot,
        lacking,
        verdict: found.verdict,
        in_set,
        before_mm: found.base.heldout_mm,
        after_mm: found.base.heldout_with_added_mm.filter(|_| !attempt.is_empty() || !found.added.is_empty()),
        stated: found.indistinguishable,
        attempt,
        attempt_alike: found.attempt_alike.iter().map(|alike| alike.effects.join(" + ")).collect(),
    })
}

/// Their rows of the table.
pub(super) fn rows(made: &[FromRuns]) -> Vec<Rate> {
    let share = |figure, hit: fn(&FromRuns) -> bool| {
        Rate::share("made by finite elements", figure, Goal::AtLeast(1.0), &made.iter().map(hit).collect::<Vec<_>>())
    };
    vec![
        share("what the model lacks is in the stated set", |m| m.in_set),
        share("error at held-out pressures falls by half with what is stated", FromRuns::halved_as_stated),
        share("the same, attempts that are said not to be enough counted too", FromRuns::halved),
    ]
}
