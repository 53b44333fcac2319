//! Does an added effect help on data that it was not fitted to? Nothing is refitted.

use crate::error::CompareError;
use crate::evaluate::{EvaluateOptions, Evaluation};
use crate::evidence::Evidence;
use crate::extension::{EffectOrigin, origins};
use crate::policy;
use crate::scenario_file::ScenarioFile;
use crate::study::comparison::{Contender, compare_all};
use data::Geometry;
use models::{Known, Scenario};
use serde::Serialize;

/// One evidence, with and without the effects.
#[derive(Debug, Clone, Serialize)]
pub struct Validation {
    /// Name of the data that test the effects.
    pub data: String,
    /// Number of runs of these data.
    pub runs: usize,
    /// Different body pressures of the holds, rising \[kPa\].
    pub p_body_kpa: Vec<f64>,
    /// Different actuator pressures of the holds, rising \[kPa\].
    pub p_act_kpa: Vec<f64>,
    /// The effects were fitted to these very data: no test.
    pub fitted_to_these: bool,
    /// Lengths that were taken from the data's description.
    pub geometry_of_data: Vec<String>,
    /// Misfit of the scenario without the effects.
    pub before: HowFar,
    /// Misfit of the scenario with the effects.
    pub after: HowFar,
    /// Noise of the mean over runs, of one coordinate \[mm\].
    pub noise_floor_mm: Option<f64>,
    /// Verdict as a word for programs, such as `helps` or `worse`.
    pub verdict: &'static str,
    /// Whether the effects help, with both errors, as a sentence.
    pub sentence: String,
    /// What does not match between scenario and data.
    #[serde(skip)]
    pub warnings: Vec<String>,
}

/// How well a model meets a dataset.
#[derive(Debug, Clone, Serialize)]
pub struct HowFar {
    /// Error beyond noise; the root-mean-square error where the noise is unknown \[mm\].
    pub beyond_noise_mm: f64,
    /// χ² per degree of freedom; `None` if the noise is unknown.
    pub reduced_chi2: Option<f64>,
    /// Signed error of the tip where it is largest \[mm\].
    pub largest_tip_error_mm: f64,
}

/// A scenario with and without what was added to it.
#[derive(Debug, Clone)]
pub struct BeforeAfter {
    /// Names of the effects that are judged.
    pub effects: Vec<String>,
    /// Without them, with the B that was calibrated without the first of them.
    pub before: Scenario,
    /// The scenario as written, with the effects.
    pub after: Scenario,
    origins: Vec<EffectOrigin>,
}

impl BeforeAfter {
    /// To judge the effects named, else those that [`crate::extend`] wrote.
    ///
    /// # Errors
    /// An effect that the scenario has not; none written and none named.
    pub fn of(file: &ScenarioFile, named: &[String]) -> Result<BeforeAfter, CompareError> {
        let origins = added(file, named)?;
        let mut before = file.scenario.clone();
        before.effects.retain(|e| !origins.iter().any(|o| o.effect == e.name));
        let own = file.bending_stiffness;
        before.bending_stiffness = origins.iter().find_map(|o| o.bending_without_nm2).unwrap_or(own);
        let effects = origins.iter().map(|o| o.effect.clone()).collect();
        Ok(BeforeAfter { effects, before, after: file.scenario.clone(), origins })
    }

    /// Holds both against data. Errors as for [`crate::compare`].
    pub fn judge(&self, evidence: &Evidence, sigma_m: Option<f64>) -> Result<Validation, CompareError> {
        let sha256 = evidence.sha256()?;
        let fitted_to_these = self.origins.iter().any(|o| o.data_sha256.contains(&sha256));
        let mut geometry_of_data = Vec::new();
        let geometry = evidence.about.as_ref().and_then(|about| about.geometry.as_ref());
        let models = [&self.before, &self.after].map(|model| {
            geometry_of_data.clear();
            let scenario = geometry.and_then(|own| resized(model, own, &mut geometry_of_data));
            Contender { known: Known::Predicted, ..Contender::as_given(&scenario.unwrap_or_else(|| model.clone())) }
        });
        let options = EvaluateOptions { sigma_m, bootstrap_samples: 0, ..EvaluateOptions::default() };
        let found = compare_all(&models, evidence, &options, None)?;
        let [before, after] = [0, 1].map(|k| &found.variants[k].evaluation);
        let found = Validation::of(evidence, [before, after], fitted_to_these, found.warnings.clone());
        Ok(Validation { geometry_of_data, ..found })
    }
}

impl Validation {
    pub(crate) fn of(
        evidence: &Evidence,
        [before, after]: [&Evaluation; 2],
        fitted_to_these: bool,
        warnings: Vec<String>,
    ) -> Validation {
        let all = &after.metrics.overall;
        let tolerance_mm = 1e3 * policy::tolerance_m(1e-3 * all.d_max_mm);
        let noise_floor_mm = all.noise_floor_mm;
        let [before, after] = [before, after].map(HowFar::of);
        let (verdict, sentence) = judged(before.beyond_noise_mm, after.beyond_noise_mm, tolerance_mm, fitted_to_these);
        let levels = |of: fn(&data::Hold) -> f64| {
            let mut levels: Vec<f64> = evidence.dataset.holds.iter().map(|h| (of(h) * 1e-2).round() * 0.1).collect();
            levels.sort_by(f64::total_cmp);
            levels.dedup();
            levels
        };
        Validation {
            data: evidence.name.clone(),
            runs: evidence.dataset.runs.len(),
            p_body_kpa: levels(|h| h.p_body_pa),
            p_act_kpa: levels(|h| h.p_act_pa),
            fitted_to_these,
            geometry_of_data: Vec::new(),
            noise_floor_mm,
            before,
            after,
            verdict,
            sentence,
            warnings,
        }
    }
}

/// Whether the effects that [`crate::extend`] wrote help on data.
///
/// # Errors
/// A scenario to which nothing was added; as [`crate::compare`].
pub fn validate(file: &ScenarioFile, evidence: &Evidence) -> Result<Validation, CompareError> {
    BeforeAfter::of(file, &[])?.judge(evidence, None)
}

fn added(file: &ScenarioFile, named: &[String]) -> Result<Vec<EffectOrigin>, CompareError> {
    let has = |name: &str| file.effects.iter().any(|e| e.name == name);
    let written: Vec<EffectOrigin> = origins(&file.text).into_iter().filter(|o| has(&o.effect)).collect();
    if let Some(unknown) = named.iter().find(|name| !has(name)) {
        let own: Vec<&str> = file.effects.iter().map(|e| e.name.as_str()).collect();
        let help = format!("{}its effects: {}", spelling::meant(unknown, own.iter().copied()), own.join(", "));
        return Err(CompareError::refused(format!("the scenario has no effect `{unknown}`"), help));
    }
    let by_hand =
        |name: &String| EffectOrigin { effect: name.clone(), data_sha256: Vec::new(), bending_without_nm2: None };
    let of = |name: &String| written.iter().find(|o| o.effect == *name).cloned().unwrap_or_else(|| by_hand(name));
    let found: Vec<EffectOrigin> = if named.is_empty() { written.clone() } else { named.iter().map(of).collect() };
    if found.is_empty() {
        let message = "no effect of this scenario was written by `ibr add`, so its earlier state is unknown";
        return Err(CompareError::refused(message, "name the effect to judge with --without EFFECT"));
    }
    Ok(found)
}

impl HowFar {
    fn of(evaluation: &Evaluation) -> HowFar {
        let all = &evaluation.metrics.overall;
        HowFar {
            beyond_noise_mm: all.systematic_mm.unwrap_or(all.rmse_mm),
            reduced_chi2: all.reduced_chi2,
            largest_tip_error_mm: all.largest_tip_error_mm,
        }
    }
}

fn judged(before: f64, after: f64, tolerance_mm: f64, fitted_to_these: bool) -> (&'static str, String) {
    let both = format!("both within the tolerance of {tolerance_mm:.2} mm, no argument either way");
    let (verdict, why) = match () {
        () if fitted_to_these => ("fitted_to_these", "no test, the effect was fitted to these very data"),
        () if before.max(after) <= tolerance_mm => ("no_argument", &both[..]),
        () if policy::falls(after, before) => ("helps", "the effect helps where it was not fitted"),
        () if policy::falls(before, after) => {
            ("worse", "worse with the effect; its name or its value does not hold here")
        }
        () => ("no_difference", "hardly a difference; these data do not support the effect"),
    };
    (verdict, format!("{before:.2} → {after:.2} mm: {why}"))
}

/// A model in the size that the data's `about.toml` states, and what was changed; `None`: half a robot of the data and half of the
/// scenario would be neither, and the comparison then warns of the difference.
fn resized(scenario: &Scenario, g: &Geometry, changed: &mut Vec<String>) -> Option<Scenario> {
    let mut sized = scenario.clone();
    let mut set = |what: &str, mine: &mut f64, theirs: Option<f64>| {
        if let Some(v) = theirs.filter(|v| policy::is_other_length(*v, *mine)) {
            changed.push(format!("{what} {:.1} mm, not {:.1}", v * 1e3, *mine * 1e3));
            *mine = v;
        }
    };
    set("body radius", &mut sized.radius_m, Some(g.body_radius_m));
    set("body length", &mut sized.length_m, Some(g.body_length_m));
    let shape = &mut sized.actuator.shape;
    set("actuator length", &mut shape.length_m, g.pouch_length_m);
    set("actuator width", &mut shape.width_m, g.pouch_width_m);
    set("fold depth", &mut shape.fold_m, g.fold_m);
    if let Some(arm) = &mut sized.actuator.arm_m {
        set("arm", arm, g.arm_m);
    }
    if let Some(count) = g.pouches.filter(|n| *n != sized.actuator.count) {
        changed.push(format!("{count} units, not {}", sized.actuator.count));
        sized.actuator.count = count;
    }
    let end = sized.actuator.start_m + sized.actuator.shape.length_m * sized.actuator.count as f64;
    if end > sized.length_m * (1.0 + 1e-9) || !sized.zones.is_empty() {
        changed.clear();
        return None;
    }
    Some(sized)
}
