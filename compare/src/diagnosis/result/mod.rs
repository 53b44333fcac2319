//! Result of a diagnosis: plain structs, printed units, no NaN.

pub(super) mod answers;
pub(super) mod explained;
pub(super) mod look;
pub(super) mod story;
pub mod words;

pub use crate::diagnosis::result::explained::*;
use crate::evidence::{ForeignBase, Used};
use crate::moment::MissingMoment;
use crate::noise_summary::NoiseSummary;
use crate::prepare::Outliers;
use crate::residuals::ResidualMap;
use crate::slips::pressure::PressureSlipFound;
use crate::where_it_fails::Statement;
use data::Direct;
pub use models::effects::Group;
use serde::{Deserialize, Serialize};

/// The answer to "is an effect missing, and which".
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// No missing effect is detectable in these data.
    None,
    /// One or two effects of the catalogue explain the misfit.
    Effect,
    /// Something is missing that no effect of the catalogue explains.
    OutOfCatalog,
}

/// How sure a name is, from the size of the evidence and the number of rivals.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Confidence {
    /// Gain below 25: often another effect.
    Hint,
    /// The truth is likely in the set.
    LikelyOneOf,
    /// Gain above 200 and no rival in this catalogue.
    IdentifiedInCatalog,
}

/// An answer that depends on the bending stiffness.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct KeptBending {
    /// B of the scenario, which was kept \[N·m²\].
    pub value_nm2: f64,
    /// Names that these data cannot separate with it, best first.
    pub indistinguishable: Vec<String>,
    /// Error beyond noise with the best of them \[mm\].
    pub systematic_after_mm: f64,
}

/// An answer for a robot that is made otherwise than the scenario describes.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct OtherDesign {
    /// Mechanisms of the shipped robot of this kind that were switched on, or off (`without NAME`); nothing of them was fitted.
    pub switched: Vec<String>,
    /// Error beyond noise then, with B fitted \[mm\].
    pub systematic_mm: f64,
    /// Verdict for the robot made otherwise; `None` without p-values.
    pub verdict: Option<Verdict>,
    /// Names that these data cannot separate then, best first.
    pub indistinguishable: Vec<String>,
    /// Error beyond noise with the best of them, or with the best attempt \[mm\].
    pub systematic_after_mm: f64,
}

/// The calibrated base: the scenario with only the bending stiffness fitted.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct BaseFit {
    /// B as the scenario states it \[N·m²\].
    pub bending_nominal_nm2: f64,
    /// Fitted B, one per body pressure.
    pub bending: Vec<Bending>,
    /// B of the final model, one per body pressure \[N·m²\].
    pub bending_with_added_nm2: Vec<f64>,
    /// Error beyond noise of the scenario as given \[mm\].
    pub systematic_nominal_mm: f64,
    /// Error beyond noise after fitting B \[mm\].
    pub systematic_mm: f64,
    /// Error beyond noise of the final model \[mm\].
    pub systematic_with_added_mm: f64,
    /// Share of the calibrated base's misfit (beyond noise and scatter between runs) that the final model leaves.
    pub left_share: f64,
    /// Root-mean-square noise of one coordinate of the mean \[mm\].
    pub noise_floor_mm: Option<f64>,
    /// Error beyond noise at pressures left out of the fit of B \[mm\].
    pub heldout_mm: Option<f64>,
    /// Error beyond noise of runs left out \[mm\].
    pub heldout_run_mm: Option<f64>,
    /// Error of the final model at pressures left out of its fit \[mm\].
    pub heldout_with_added_mm: Option<f64>,
    /// Error of the final model for runs left out of its fit \[mm\].
    pub heldout_run_with_added_mm: Option<f64>,
}

/// A fitted bending stiffness and its 95 % interval.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Bending {
    /// Body pressure it belongs to \[kPa\].
    pub p_body_kpa: f64,
    /// Fitted effective bending stiffness B \[N·m²\].
    pub value_nm2: f64,
    /// Lower end of the 95 % interval.
    pub lo: Option<f64>,
    /// Upper end of the 95 % interval.
    pub hi: Option<f64>,
    /// On a bound of its search.
    pub at_bound: bool,
}

/// Four tests of whether the remaining misfit is noise.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct LackOfFit {
    /// p of all whitened values together.
    pub all: f64,
    /// p of the means of the holds.
    pub hold_means: f64,
    /// Drift within the holds; 1 with fewer than three samples.
    pub drift: f64,
    /// p of the means of the markers.
    pub marker_means: f64,
    /// Readings of a gauge at the actuator against the supply's laws, where there are any.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub supply: Option<f64>,
    /// Smallest of them times their number.
    pub p_value: f64,
}

/// A pattern without physics that noise would rarely leave: one marker, one hold, one place of the robot.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LeftPattern {
    /// What the misfit looks like, in words.
    pub words: String,
    /// Where to look and what to take again.
    pub check: String,
    /// Share of the squares beyond noise that this one pattern explains.
    pub share: f64,
    /// p of the largest of all patterns under noise.
    pub p_value: f64,
    /// It explains more of the whole misfit than the best of the catalogue does; else it is what that leaves.
    pub instead: bool,
    /// It is a fault that explains with one number what effects explain with more: the attempt explains the misfit too.
    pub simpler: bool,
    /// Of these two the fault explains no more than the attempt, and is reported first for its single number alone.
    pub either: bool,
}

/// A fitted stiffness that differs from the given one.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct BendingAlarm {
    /// B of the scenario or of the bending test \[N·m²\].
    pub told_nm2: f64,
    /// Standard deviation of the bending test; `None`: the scenario gives B \[N·m²\].
    pub test_sd_nm2: Option<f64>,
    /// B fitted to the base, without an effect \[N·m²\].
    pub base_nm2: f64,
    /// Of the answer; without one, of the base \[N·m²\].
    pub answer_nm2: f64,
    /// What it may mean, and what to do.
    pub words: String,
}

/// Data of the same robot that were fitted along with the first.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FittedBeside {
    /// Name of the dataset that was fitted along.
    pub dataset: String,
    /// Number of runs of that dataset.
    pub runs: usize,
    /// What was measured directly in it.
    pub direct: Direct,
    /// Error beyond noise of the calibrated base there \[mm\].
    pub systematic_mm: f64,
    /// The same with what was added, or attempted \[mm\].
    pub systematic_with_added_mm: f64,
}

/// Readings of a gauge at the actuator, compared with the set pressures.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct GaugeFit {
    /// Name of the dataset that has the gauge.
    pub dataset: String,
    /// Set actuator pressures, one per reading \[kPa\].
    pub set_kpa: Vec<f64>,
    /// For how long they had been set \[s\].
    pub held_s: Vec<f64>,
    /// Mean over runs of the gauge's readings \[kPa\].
    pub read_kpa: Vec<f64>,
    /// The same by the supply's laws with what was added, or attempted \[kPa\].
    pub with_added_kpa: Vec<f64>,
    /// Root-mean-square difference of the base's laws to the readings \[kPa\].
    pub before_kpa: f64,
    /// The same with what was added, or attempted \[kPa\].
    pub after_kpa: f64,
}

/// Everything that a diagnosis found: verdict, fits, errors and cautions.
#[derive(Debug, Clone, Serialize)]
pub struct Diagnosis {
    /// Name of the scenario that was diagnosed.
    pub scenario: String,
    /// Name of the first dataset that was fitted.
    pub dataset: String,
    /// Actuator kind of the scenario, such as `epam`.
    pub actuator: String,
    /// Number of runs of the first dataset, without copies.
    pub runs: usize,
    /// The data, in the order that they were given in.
    #[serde(skip)]
    pub evidence: Vec<Used>,
    /// Predictions of another simulator that take the place of the scenario's, of every dataset that has them.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub foreign_bases: Vec<ForeignBase>,
    /// Further data in the same fit; errors elsewhere refer to the first data.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub beside: Vec<FittedBeside>,
    /// Gauges at the actuator that were read along.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub gauges: Vec<GaugeFit>,
    /// Verdict; `None` where no p-value can be formed: the ranking is then uncalibrated.
    pub verdict: Option<Verdict>,
    /// One p of "nothing is missing", corrected for everything that was tried; never below 1e-6.
    pub p_value: Option<f64>,
    /// Level at which it is judged.
    pub alpha: f64,
    /// Differences up to this are good enough \[mm\].
    pub tolerance_mm: f64,
    /// How sure the name is; `None` without verdict `effect`.
    pub confidence: Option<Confidence>,
    /// The answer and its reasons, one sentence each.
    pub summary: Vec<String>,
    /// Noise of the first dataset's mean, in printed units.
    pub noise: NoiseSummary,
    /// The scenario with only its bending stiffness fitted.
    pub base: BaseFit,
    /// Effects of actuator, body and loads, and effects of supply and measurement, best first.
    pub ranked: Vec<Ranked>,
    /// Names that these data cannot separate, best first; for two added effects written `a + b`.
    pub indistinguishable: Vec<String>,
    /// Share of such sets that held a true effect on `ibr bench discovery`; `None` in space, and where no effect is added.
    pub covered: Option<f64>,
    /// Names among them (or in the ranking within reach of them) that belong to supply or measurement: rule out first.
    pub rule_out_first: Vec<String>,
    /// Pairs of effects, best first; empty if a single effect is enough.
    pub pairs: Vec<Combination>,
    /// What follows from how such a robot is cut and joined, and takes a fifth of the error with nothing fitted: to be looked at first.
    pub by_design: Vec<AsClose>,
    /// What the verdict `effect` adds, else empty.
    pub added: Vec<Added>,
    /// What the answer is worth in millimetres; `None` without the verdict `effect`.
    pub worth: Option<Worth>,
    /// With the verdict `out_of_catalog`: the best that the catalogue can do, which is not enough.
    pub attempt: Vec<Added>,
    /// The attempt, then what comes as close, its error over all data to a fifth: no more a bare name than an answer is. Empty where
    /// one fault does as well as the attempt.
    pub attempt_alike: Vec<AsClose>,
    /// The answer with the scenario's B, where with a fitted one there is none.
    pub kept_bending: Option<KeptBending>,
    /// The robot made otherwise, where that leaves a fifth less.
    pub other_design: Option<OtherDesign>,
    /// The stiffness of the answer differs from the given one.
    pub bending_alarm: Option<BendingAlarm>,
    /// What was said not to be here.
    pub excluded: Vec<String>,
    /// Lack of fit of the calibrated base.
    pub lack_of_fit_before: Option<LackOfFit>,
    /// Lack of fit of the final model.
    pub lack_of_fit_after: Option<LackOfFit>,
    /// With the verdict `out_of_catalog`: what the misfit looks like, if it looks like something simple.
    pub pattern: Option<LeftPattern>,
    /// Where and when the final model still fails, in plain language.
    pub leftover: Vec<Statement>,
    /// Residuals of the calibrated base, marker × hold.
    pub residuals_before: ResidualMap,
    /// Residuals of the final model, marker × hold.
    pub residuals_after: ResidualMap,
    /// Samples and runs that stand out.
    pub outliers: Outliers,
    /// Smallest detectable size of every effect that was not found.
    pub undetectable: Vec<Undetectable>,
    /// What would separate the indistinguishable ones; `None` if there is nothing to separate.
    pub next_experiment: Option<NextExperiment>,
    /// What the calibrated base's terms miss at the bends that were measured; `None` unless it was asked for.
    pub missing_moment: Option<MissingMoment>,
    /// The law of the missing moment that predicts pressures left out, where the catalogue has none, or it was asked for.
    pub learned: Option<LearnedLaw>,
    /// What these data cannot show, whatever the model.
    pub limits: Vec<String>,
    /// A slip of a pressure column that explains the data better than anything else: the verdict is withheld.
    pub pressure_slip: Option<PressureSlipFound>,
    /// Cautions that come before the verdict: slips in the data, that no effect of a robot is. They are in `warnings` too.
    pub slips: Vec<String>,
    /// Cautions about scenario, data and fits, one sentence each.
    pub warnings: Vec<String>,
}
