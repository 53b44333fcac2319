//! A scenario compared with measurements, with all that is printed of it.

use compare::diagnosis::{Options, pressure_slip};
use compare::study::Knob;
use compare::study::comparison::{Comparison, Contender, compare_all};
use compare::validation::{BeforeAfter, Validation};
use compare::{CompareError, EvaluateOptions, Evidence, ScenarioFile};

/// A comparison, and what effects that were added to the scenario bring on these data.
#[derive(Debug, Clone)]
pub struct Compared {
    /// The scenario as given, then with one effect after the other.
    pub found: Comparison,
    /// Effects that an extension wrote into the scenario, and the errors without and with them.
    pub added: Option<(Vec<String>, Validation)>,
}

impl Compared {
    /// Holds the scenario against measurements, then with one effect after the other, each typed as `name` or
    /// `name:key=value,…`; with a knob, also with that number fitted. A slip of the pressures comes first.
    ///
    /// # Errors
    /// An effect that is not possible; as [`fn@compare::compare`].
    pub fn of(
        file: &ScenarioFile,
        evidence: &Evidence,
        effects: &[String],
        sigma_m: Option<f64>,
        knob: Option<Knob>,
    ) -> Result<Compared, CompareError> {
        let models = contenders(file, effects)?;
        let options = EvaluateOptions { sigma_m, ..EvaluateOptions::default() };
        let slip = pressure_slip(file, evidence, &Options { sigma_m, ..Options::default() })?;
        let mut found = compare_all(&models, evidence, &options, knob)?;
        found.tell_first(slip);
        // Before and after need an added effect; without this effect the robot may have no equilibrium.
        let added = BeforeAfter::of(file, &[]).ok();
        let added = added.and_then(|both| Some((both.effects.clone(), both.judge(evidence, sigma_m).ok()?)));
        Ok(Compared { found, added })
    }
}

/// A warning that a camera noise had no use.
pub fn unused_sigma(sigma_m: Option<f64>, evidence: &Evidence) -> Option<String> {
    let words = "warning: --sigma is for a single run and was not used: several runs show the noise themselves";
    (sigma_m.is_some() && evidence.dataset.runs.len() > 1).then(|| words.to_string())
}

/// The scenario as given, then with one effect after the other.
///
/// # Errors
/// A name, key or value that is not possible.
pub fn contenders(file: &ScenarioFile, effects: &[String]) -> Result<Vec<Contender>, CompareError> {
    let mut models = vec![Contender::as_given(file)];
    for effect in effects {
        models.push(models[models.len() - 1].with(effect)?);
    }
    Ok(models)
}
