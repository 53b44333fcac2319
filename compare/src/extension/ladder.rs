//! Diagnose and extend until only noise is left.

use crate::diagnosis::words::{change, listed};
use crate::diagnosis::{
    Added, Confidence, Diagnosis, Group, KeptBending, Options, Verdict, diagnose, names_of, taken_away,
};
use crate::error::CompareError;
use crate::evidence::Evidence;
use crate::extension::{ErrorStep, FittedEffect, Ground, extend, extended};
use crate::progress::{Progress, part};
use crate::scenario_file::ScenarioFile;
use serde::Serialize;

/// Effects that a climb adds at most: beyond them a name means little.
pub const MOST_EFFECTS: usize = 3;

/// One step of the ladder: effects added together after one diagnosis.
#[derive(Debug, Clone, Serialize)]
pub struct ClimbStep {
    /// Effects that the step adds, with their fitted values.
    pub added: Vec<FittedEffect>,
    /// Names that these data cannot separate.
    pub indistinguishable: Vec<String>,
    /// Corrected p of "nothing is missing" before it.
    pub p_value: Option<f64>,
    /// How sure the names of the effects are; `None` if the verdict has no confidence.
    pub confidence: Option<Confidence>,
    /// File of the scenario with it.
    pub file: String,
}

/// Everything that was found on the way up.
#[derive(Debug, Clone, Default, Serialize)]
pub struct Climb {
    /// Errors, the scenario as given first.
    pub rungs: Vec<ErrorStep>,
    /// Effects added by each step, in order.
    pub steps: Vec<ClimbStep>,
    /// The steps and the ending, one sentence each.
    #[serde(skip)]
    pub told: Vec<String>,
    /// Name of the file and text of the scenario of every step.
    #[serde(skip)]
    pub files: Vec<(String, String)>,
    /// Noise of the mean over runs, of one coordinate \[mm\].
    pub noise_floor_mm: Option<f64>,
    /// Why the ladder ended, as a word such as `noise` or `no_p_values`.
    pub stopped: &'static str,
    /// Why the ladder ended, as a sentence.
    pub ending: String,
    /// The answer with the B of the last scenario, where with a fitted one there is none.
    pub kept_bending: Option<KeptBending>,
    /// Cautions about scenario, data and fits, one sentence each.
    pub warnings: Vec<String>,
}

/// Adds what the diagnosis adds, at most `most` effects, until nothing more is found.
/// Errors as for [`diagnose`] and [`extend`].
pub fn ladder(
    file: &ScenarioFile,
    evidence: &[Evidence],
    options: &Options,
    most: usize,
    progress: &mut Progress,
) -> Result<Climb, CompareError> {
    let mut file = file.clone();
    let mut climb = Climb::default();
    let (mut count, whole) = (0, most as f64 + 1.0);
    loop {
        let [step, next] = [climb.steps.len() as f64 / whole, (climb.steps.len() + 1) as f64 / whole];
        let mut tell = part(progress, [step, next]);
        let number = climb.steps.len() + 1;
        let d = diagnose(&file, evidence, options, &mut |what, share| tell(&format!("step {number}: {what}"), share))?;
        if climb.rungs.is_empty() {
            climb.start(&file, &d)?;
        }
        let left_mm = climb.rungs.last().map_or(d.base.systematic_mm, |r| r.training_mm);
        if let Some((stopped, ending)) = end(&d, left_mm, (count, most)) {
            climb.told.push(ending.clone());
            return Ok(Climb { stopped, ending, kept_bending: d.kept_bending, ..climb });
        }
        count += d.added.len();
        file = climb.step(&file, &d)?;
    }
}

impl Climb {
    fn start(&mut self, file: &ScenarioFile, d: &Diagnosis) -> Result<(), CompareError> {
        let ground = Ground::new(d, file);
        self.rungs = ground.first_steps();
        self.noise_floor_mm = d.base.noise_floor_mm;
        self.warnings = ground.warnings();
        if let Some(bending) = ground.new_bending(ground.base_bending()) {
            self.files.push(("step-0-calibrated.toml".into(), extended(file, Some(&bending), &[])?.text));
        }
        Ok(())
    }

    fn step(&mut self, file: &ScenarioFile, d: &Diagnosis) -> Result<ScenarioFile, CompareError> {
        let extension = extend(file, d)?;
        let file = extension.file;
        let number = self.steps.len() + 1;
        let written = format!("step-{number}-{}.toml", names_of(&d.added).join("-").replace(' ', "-"));
        self.told.push(told(number, d));
        self.rungs.extend(extension.steps.into_iter().last());
        self.files.push((written.clone(), file.text.clone()));
        self.steps.push(ClimbStep {
            added: extension.fitted,
            indistinguishable: d.indistinguishable.clone(),
            p_value: d.p_value,
            confidence: d.confidence,
            file: written,
        });
        Ok(file)
    }
}

fn end(d: &Diagnosis, left: f64, (count, most): (usize, usize)) -> Option<(&'static str, String)> {
    let sentence = match d.verdict {
        None if d.pressure_slip.is_some() => ("pressure_slip", d.slips.join(" ")),
        None => {
            let why = format!("{} usable runs: at least three are needed for p-values, so no effect is added", d.runs);
            return Some(("no_p_values", why + "; `ibr diagnose` prints the uncalibrated ranking."));
        }
        Some(Verdict::None) => {
            ("noise", format!("The remaining misfit, {left:.2} mm beyond noise, is not significant: noise."))
        }
        Some(_) if left <= d.tolerance_mm && !is_of_supply(d) => {
            let within = format!("more than noise but within the tolerance of {:.2} mm", d.tolerance_mm);
            ("tolerance", format!("The remaining misfit, {left:.2} mm, is {within}."))
        }
        Some(Verdict::OutOfCatalog) => {
            let places: Vec<&str> = d.leftover.iter().map(|s| s.sentence.as_str()).collect();
            let places = places.join(" ");
            let of = if count > 0 { " Of the last step's scenario:" } else { "" };
            let kept = d.told_of_kept_bending().map_or(String::new(), |words| format!("{of} {words}"));
            let nothing = "Nothing in the catalogue explains the remaining misfit";
            ("out_of_catalog", format!("{nothing}, {left:.2} mm. {places}{kept}"))
        }
        Some(Verdict::Effect) if count + d.added.len() > most => {
            let next = format!("{} would come next", change(&names_of(&d.added)));
            let ending = format!("{left:.2} mm are left and {next}, but {most} effects are the most that is added.");
            ("most_effects", ending)
        }
        Some(Verdict::Effect) => return None,
    };
    Some(sentence)
}

/// Whether it adds to the supply what a gauge has shown, which the positions, predicted at its readings, do not see.
fn is_of_supply(d: &Diagnosis) -> bool {
    !d.gauges.is_empty() && !d.added.is_empty() && d.added.iter().all(|a| a.group == Group::Supply)
}

fn told(number: usize, d: &Diagnosis) -> String {
    let values = |a: &Added| match taken_away(&a.effect) {
        Some(_) => a.effect.clone(),
        None => format!("{}, {}", a.effect, listed(&a.parameters)),
    };
    let names: Vec<String> = d.added.iter().map(values).collect();
    let names = names.join("; ");
    let (before, after) = (d.base.systematic_mm, d.base.systematic_with_added_mm);
    let mut told = format!("Step {number}: {names}. {before:.2} → {after:.2} mm.");
    if d.indistinguishable.len() > 1 {
        let all = d.indistinguishable.join(", ");
        told += &format!(" The name is one of several that these data cannot separate: {all}.");
    }
    if d.confidence == Some(Confidence::Hint) {
        told.push_str(" A hint only: the evidence is weak.");
    }
    told
}
