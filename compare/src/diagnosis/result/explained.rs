//! Explanations as a diagnosis reports them: effects, pairs, a learned law, their values, and experiments that separate them.

use data::Direct;
use models::effects::Group;
use serde::Serialize;

/// One parameter of a fit, in the unit of the scenario.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ParameterValue {
    /// Key in the scenario, with the unit as suffix.
    pub key: String,
    /// Letter of the parameter in the formula of its effect.
    pub symbol: String,
    /// Unit of the value as the scenario writes it.
    pub unit: String,
    /// Best value; **calibrated** on these data unless it was held.
    pub value: f64,
    /// It was not fitted, because these data do not hold it: it stays neutral, or as the scenario has it.
    pub held: bool,
    /// Lower end of the 95 % interval; `None` if the noise is unknown, or if it was held.
    pub lo: Option<f64>,
    /// Upper end of the 95 % interval.
    pub hi: Option<f64>,
    /// The best value sits on a physical bound and the data push against it.
    pub at_bound: bool,
}

impl ParameterValue {
    /// What follows a value that was not fitted; empty for others.
    pub fn held_mark(&self) -> &'static str {
        if self.held { " (held)" } else { "" }
    }
}

/// One effect of the catalogue, refitted together with the base.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Ranked {
    /// Name of the effect as scenarios write it.
    pub effect: String,
    /// What the effect belongs to: actuator, body, load, supply or measurement.
    pub group: Group,
    /// What the effect does, in one plain sentence.
    pub sentence: String,
    /// What measurements show where it acts and the model lacks it.
    pub differs: String,
    /// What to measure or change on the robot.
    pub remedy: String,
    /// Fitted value of the effect's first parameter.
    pub value: f64,
    /// Unit of the first parameter in scenarios.
    pub unit: String,
    /// Lower end of its 95 % interval.
    pub lo: Option<f64>,
    /// Upper end of its 95 % interval.
    pub hi: Option<f64>,
    /// A value sits on a physical bound and the data push against it: the effect is rejected.
    pub at_bound: bool,
    /// All parameters with values and intervals.
    pub parameters: Vec<ParameterValue>,
    /// Fall of the whitened sum of squares against the calibrated base.
    pub gain: f64,
    /// BIC minus the best effect's BIC, with an allowance for the form of the law and a weak prior of the size.
    pub bic_difference: f64,
    /// p of the gain, corrected for all effects tried; `None` with fewer than three runs.
    pub p_corrected: Option<f64>,
    /// Error beyond noise of the calibrated base \[mm\]; root-mean-square error if the noise is unknown.
    pub systematic_before_mm: f64,
    /// The same with the effect \[mm\].
    pub systematic_after_mm: f64,
    /// Error beyond noise at actuator pressures left out of the fit, rms over the pressures \[mm\]. `None` with one pressure, and
    /// for effects outside the set that neither lead nor come close.
    pub heldout_mm: Option<f64>,
    /// Error beyond noise of runs left out of the fit, rms over the runs \[mm\]; `None` as above, and with one run.
    pub heldout_run_mm: Option<f64>,
    /// Effective bending stiffness with the effect, one per body pressure \[N·m²\].
    pub bending_nm2: Vec<f64>,
    /// Cosine between this effect's and the best one's trace in the data, base fitted out; ±1: these data do not separate them.
    pub cosine_with_best: f64,
    /// Whether the data cannot separate it from the best explanation.
    pub in_set: bool,
    /// Different starts of the fit ended in different minima; the best one is given.
    pub several_minima: bool,
    /// Cautions about this effect and its fit, one sentence each.
    pub notes: Vec<String>,
}

/// Several effects that were fitted together.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Combination {
    /// Names of the effects that were fitted together.
    pub effects: Vec<String>,
    /// Values of all parameters, effect by effect.
    pub parameters: Vec<ParameterValue>,
    /// Fall of the whitened sum of squares against the calibrated base.
    pub gain: f64,
    /// BIC minus the best combination's BIC, with the same allowance and prior.
    pub bic_difference: f64,
    /// p of the gain over the best single effect, corrected for all combinations tried.
    pub p_corrected: Option<f64>,
    /// Root-mean-square error beyond noise with them \[mm\].
    pub systematic_after_mm: f64,
    /// Effective bending stiffness with them, one per body pressure \[N·m²\].
    pub bending_nm2: Vec<f64>,
    /// Fits these data as well as the best combination.
    pub in_set: bool,
    /// The two terms cancel each other: opposite contributions, nearly the same trace.
    pub cancels: bool,
}

/// An attempt, or something that leaves the same distance.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct AsClose {
    /// Names of the effects that were fitted together.
    pub effects: Vec<String>,
    /// Error beyond noise with it \[mm\], over all data.
    pub systematic_after_mm: f64,
}

/// What an answer changes at the markers, root mean square over all coordinates.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Worth {
    /// Distance from the calibrated base in these data \[mm\].
    pub here_mm: f64,
    /// The same in the listed protocol where it is largest \[mm\]; `None` without an equilibrium in any of them.
    pub elsewhere_mm: Option<f64>,
    /// The protocol of `elsewhere_mm`, in words.
    pub elsewhere: Option<String>,
}

pub(crate) fn names_of(added: &[Added]) -> Vec<String> {
    added.iter().map(|a| a.effect.clone()).collect()
}

/// An effect that the verdict adds to the model.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Added {
    /// Name of the effect as scenarios write it.
    pub effect: String,
    /// What the effect belongs to: actuator, body, load, supply or measurement.
    pub group: Group,
    /// Values of its parameters in the final model.
    pub parameters: Vec<ParameterValue>,
}

/// How large an effect would have to be.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Undetectable {
    /// Name of the effect as scenarios write it.
    pub effect: String,
    /// What the effect belongs to: actuator, body, load, supply or measurement.
    pub group: Group,
    /// Smallest value of its first parameter found with 90 % probability; `None`: none within its bounds.
    pub smallest_detectable: Option<f64>,
    /// Unit of the smallest detectable value.
    pub unit: String,
    /// The same as a multiple of the effect's typical size.
    pub times_typical: Option<f64>,
}

/// A law of the missing moment that was learned from the data.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LearnedLaw {
    /// Name under which the law is an effect of a scenario.
    pub name: String,
    /// What the law does, in words.
    pub words: String,
    /// The moment as a formula, with its numbers and units.
    pub formula: String,
    /// Numbers of the formula with values and intervals.
    pub parameters: Vec<ParameterValue>,
    /// Position of the markers' line, where it was fitted too.
    pub line: Option<LearnedLine>,
    /// Error beyond noise without either, B fitted unless it is kept \[mm\].
    pub before_mm: f64,
    /// The same at pressures left out of the fit.
    pub heldout_before_mm: Option<f64>,
    /// Error with the law and the line \[mm\].
    pub after_mm: f64,
    /// The same at pressures left out of the fit of both.
    pub heldout_after_mm: Option<f64>,
    /// The same for runs left out.
    pub heldout_run_after_mm: Option<f64>,
    /// B with it, one per body pressure; empty where it was kept, or where the law takes its place \[N·m²\].
    pub bending_nm2: Vec<f64>,
    /// What such a law usually is.
    pub usual: String,
    /// The measurement that shows whether the usual cause applies.
    pub check: String,
    /// What was fitted to the markers: nothing, and the laws that fit the missing moments best.
    pub tried: Vec<LearnedTried>,
    /// The law as a `[[formula]]` of a scenario.
    #[serde(skip)]
    pub toml: String,
}

/// Shift of the markers' line from the scenario's, away from the taut side.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LearnedLine {
    /// Fitted distance beyond the scenario's line \[mm\].
    pub value_mm: f64,
    /// Ends of its 95 % interval \[mm\].
    pub interval_mm: Option<[f64; 2]>,
    /// Error beyond noise with it alone \[mm\].
    pub training_mm: f64,
    /// The same at pressures left out.
    pub heldout_mm: Option<f64>,
}

/// A law of the library that was fitted to the markers.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LearnedTried {
    /// What the law does, in words.
    pub words: String,
    /// How many numbers were fitted, bending stiffnesses included.
    pub numbers: usize,
    /// Squared error at pressures left out over squared noise, in moments.
    pub missed: f64,
    /// Error beyond noise at pressures left out \[mm\].
    pub heldout_mm: f64,
}

/// A proposed experiment and what it separates.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Experiment {
    /// Short name of the experiment for tables.
    pub name: String,
    /// Instructions for the experiment, in one sentence.
    pub sentence: String,
    /// Protocol in the form of `ibr data generate --protocol`; empty for a separate test.
    pub protocol: String,
    /// Quantities to measure directly.
    pub direct: Direct,
    /// Separate tests, whose results go into `[measured]` of `about.toml`.
    pub tests: Vec<String>,
    /// Expected separation λ of the best explanation from each rival, same number of runs.
    pub separations: Vec<Separation>,
    /// λ that separates two explanations in about nine of ten cases: 16, and more the more a law's form is granted, a
    /// twentieth of the best gain.
    pub needed: f64,
    /// How many rivals reach the needed λ.
    pub separated: usize,
    /// Smallest λ of the rivals it can separate (λ ≥ 3 after up to four times the runs), else the largest of all.
    pub lambda: f64,
    /// Runs needed for what suffices there; `None` if no number of runs does, or for a separate test.
    pub runs_needed: Option<usize>,
}

impl Experiment {
    /// The protocol for a table: a dash for a separate test.
    pub fn shown_protocol(&self) -> &str {
        if self.protocol.is_empty() { "–" } else { &self.protocol }
    }
}

/// Expected separation of two explanations after an experiment.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Separation {
    /// Names of the rival effects, `a` or `a + b`.
    pub rival: String,
    /// λ: expected difference of the whitened sums of squares.
    pub lambda: f64,
}

/// Which measurement would separate the remaining explanations.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
pub struct NextExperiment {
    /// The explanation to separate from its rivals; empty without rivals.
    pub best: String,
    /// The recommended one; `None` if no listed experiment separates anything, and where no effect of the catalogue is the answer.
    pub recommended: Option<Experiment>,
    /// λ with the data at hand.
    pub now: Vec<Separation>,
    /// λ that would separate two explanations with the present data.
    pub needed_now: f64,
    /// All that were tried, best first; none for an answer outside the catalogue.
    pub tried: Vec<Experiment>,
    /// The recommendation in words, or why there is none.
    pub sentence: String,
}
