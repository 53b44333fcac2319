//! A scenario with one more effect: fitted on data, chosen by the diagnosis, or given.

pub mod ladder;
mod learned;
pub mod scenario_file;
mod steps;
mod text;
pub mod typed_effect;
pub mod validation;
mod written;

use crate::diagnosis::words::{named, step, three};
use crate::diagnosis::{Diagnosis, Options, Ranked, diagnose, taken_away};
use crate::error::CompareError;
use crate::evidence::Evidence;
use crate::policy;
use crate::progress::Progress;
use crate::scenario_file::ScenarioFile;
use crate::typed_effect::{TypedValues, typed, values_of, with_values};
use models::{Known, Scenario};
pub(crate) use steps::Ground;
pub use steps::{ErrorStep, error_steps};
pub use text::{Addition, BodyValue, today};
pub(crate) use text::{EffectOrigin, extended, origins};
pub use written::{Extension, FittedEffect};

const LEARNED: &str = "learned";

/// The effect to add, as a user types it.
#[derive(Debug, Clone, PartialEq)]
pub enum EffectWish {
    /// Effects that the verdict of the diagnosis adds.
    Best,
    /// The law that is learned from the missing moment where the catalogue has none.
    Learned,
    /// The named effect, fitted on data; or taken away, as `without NAME`.
    Fitted(String),
    /// The named effect with these values, in the units of the scenario.
    Given(String, TypedValues),
}

impl EffectWish {
    /// Reads `best`, `learned`, `NAME`, `without NAME`, `NAME=VALUE` or `NAME:key=value,…`; without data a name alone has its typical values.
    ///
    /// # Errors
    /// An effect that is not possible or is there already; `best` without data.
    pub fn read(scenario: &Scenario, text: &str, has_data: bool) -> Result<EffectWish, CompareError> {
        let of_data = |wish: EffectWish, what: &str| match has_data {
            true => Ok(wish),
            false => {
                let message = format!("`{text}` needs data to {what}");
                Err(CompareError::refused(message, format!("ibr add SCENARIO {text} DATA")))
            }
        };
        if text == "best" {
            return of_data(EffectWish::Best, "find the best effect");
        }
        if let Some(name) = taken_away(text) {
            let own: Vec<&str> = scenario.effects.iter().map(|e| e.name.as_str()).collect();
            if !own.contains(&name) {
                return Err(CompareError::refused(format!("the scenario has no {name}"), spelling::known(name, &own)));
            }
            if !has_data {
                let message = format!("`{text}` without data: delete the table [effects.{name}]");
                let help = format!("to try it on data: ibr add SCENARIO \"{text}\" DATA");
                return Err(CompareError::refused(message, help));
            }
            return Ok(EffectWish::Fitted(text.into()));
        }
        if text == LEARNED && !scenario.formulas.iter().any(|f| f.name == LEARNED) {
            return of_data(EffectWish::Learned, "learn from");
        }
        let (name, values) = typed(scenario, text)?;
        Ok(match values {
            None if has_data => EffectWish::Fitted(name),
            values => EffectWish::Given(name.clone(), values.unwrap_or_else(|| values_of(scenario, &name))),
        })
    }
}

/// The scenario with what its diagnosis adds: an effect, or else the law that it learned.
///
/// # Errors
/// A diagnosis that adds nothing; a text that cannot be extended.
pub fn extend(file: &ScenarioFile, found: &Diagnosis) -> Result<Extension, CompareError> {
    if found.added.is_empty() && found.learned.is_some() {
        return learned::learned(file, found);
    }
    if found.added.is_empty() {
        let message = format!("the diagnosis adds nothing: {}", found.summary.join(" "));
        let help = "to add an effect all the same name it instead of `best`";
        return Err(CompareError::refused(message, help));
    }
    let ground = Ground::new(found, file);
    let mut told: Vec<String> = found.added.iter().map(|a| step(&a.effect, &a.parameters)).collect();
    told.extend(rivals(found));
    let fitted = found.added.iter().map(|a| FittedEffect::of(&a.effect, &a.parameters)).collect();
    calibrated(file, &ground, fitted, ground.verdict_step(), told)
}

/// The scenario with an effect, fitted on data where it is not given.
///
/// # Errors
/// As [`diagnose`]; an effect that these data reject; a text that cannot be extended.
pub fn add(
    file: &ScenarioFile,
    wish: &EffectWish,
    evidence: &[Evidence],
    options: &Options,
    progress: &mut Progress,
) -> Result<Extension, CompareError> {
    if let (EffectWish::Given(name, values), []) = (wish, evidence) {
        return assumed(file, name, values);
    }
    let options = Options { pairs: *wish == EffectWish::Best, learn: *wish == EffectWish::Learned, ..options.clone() };
    let found = diagnose(file, evidence, &options, progress)?;
    let mut extension = match wish {
        EffectWish::Best => extend(file, &found),
        EffectWish::Learned => learned::learned(file, &found),
        EffectWish::Fitted(name) => fitted(file, &Ground::new(&found, file), name),
        EffectWish::Given(name, values) => {
            let with = with_values(file, name, |wanted| values.iter().find(|(k, _)| k == wanted).map(|(_, v)| *v));
            let after = diagnose(&with, evidence, &options, progress)?;
            given(file, &Ground::new(&found, file), &Ground::new(&after, &with), (name, values))
        }
    }?;
    extension.warnings.extend(evidence.first().and_then(too_few_runs));
    Ok(extension)
}

fn assumed(file: &ScenarioFile, name: &str, values: &TypedValues) -> Result<Extension, CompareError> {
    let sentence = file.catalogue().by_name(name).map(|e| e.sentence.to_string());
    let addition = Addition::of(name, values.clone(), Known::Assumed, sentence);
    let told = vec![format!("Assumed: {}. Nothing was fitted; name data to fit it.", with_values_told(&addition))];
    Extension::written(file, None, vec![addition], told)
}

fn fitted(file: &ScenarioFile, ground: &Ground, name: &str) -> Result<Extension, CompareError> {
    let d = ground.d;
    let r = ranked(d, name)?;
    let mut told = vec![format!("{} {}", step(name, &r.parameters), r.sentence)];
    match d.indistinguishable.first() {
        Some(first) if !r.in_set => told.push(format!("These data prefer {first}: look at `ibr diagnose`.")),
        _ => told.extend(rivals(d)),
    }
    let values = vec![FittedEffect::of(name, &r.parameters)];
    let mut extension = calibrated(file, ground, values, ground.ranked_step(r), told)?;
    if let Some(p) = r.p_corrected.filter(|p| *p >= d.alpha) {
        let chance = format!("{name} is not significant here (p = {p:.2} after correction): the fall may be chance");
        extension.warnings.push(chance);
    }
    extension.warnings.extend(r.notes.iter().cloned());
    Ok(extension)
}

fn calibrated(
    file: &ScenarioFile,
    ground: &Ground,
    fitted: Vec<FittedEffect>,
    step: ErrorStep,
    told: Vec<String>,
) -> Result<Extension, CompareError> {
    let additions = fitted.iter().map(|f| ground.calibrated(&f.effect, &f.parameters)).collect();
    Ok(Extension { fitted, ..climbed(file, ground, additions, step, told)? })
}

/// Values of the user; only B is fitted.
fn given(
    file: &ScenarioFile,
    before: &Ground,
    after: &Ground,
    (name, values): (&str, &TypedValues),
) -> Result<Extension, CompareError> {
    let addition = before.addition(name, values.clone(), Known::Assumed);
    let told = vec![format!("Assumed: {}; B was fitted with it.", with_values_told(&addition))];
    climbed(file, before, vec![addition], after.base_step(&format!("+ {name}"), Known::Assumed), told)
}

fn climbed(
    file: &ScenarioFile,
    ground: &Ground,
    additions: Vec<Addition>,
    step: ErrorStep,
    told: Vec<String>,
) -> Result<Extension, CompareError> {
    let bending = ground.new_bending(step.bending_nm2);
    Ok(Extension::written(file, bending, additions, told)?.climbed(ground, step))
}

fn with_values_told(a: &Addition) -> String {
    let values = a.values.iter().map(|(key, v)| format!(", {key} = {}", three(*v)));
    format!("{}{}", a.name, values.collect::<String>())
}

fn rivals(d: &Diagnosis) -> Option<String> {
    let names = d.indistinguishable.join(", ");
    let told = || format!("Equally good with these data: {names}. The data do not choose between them.");
    (d.indistinguishable.len() > 1).then(told)
}

fn too_few_runs(evidence: &Evidence) -> Option<String> {
    let runs = evidence.dataset.runs.len();
    (runs < 3).then(|| format!("{runs} runs: at least three are needed for p-values, so this is a ranking only"))
}

/// The effect as the diagnosis ranks it, or why it cannot be added.
fn ranked<'a>(d: &'a Diagnosis, name: &str) -> Result<&'a Ranked, CompareError> {
    let message = format!("{name} is not a candidate on these data");
    let no_candidate = || CompareError::refused(message, "`ibr diagnose` prints the candidates");
    let r = d.ranked(name).ok_or_else(no_candidate)?;
    let by_hand = format!("to add it all the same give its value, {name}=VALUE: it is then called assumed");
    if r.at_bound {
        let values = r.parameters.iter().filter(|p| p.at_bound).map(named);
        let values = values.collect::<Vec<_>>().join(", ");
        let message = format!("the best value of {name} on these data sits on a physical bound ({values}): rejected");
        return Err(CompareError::refused(message, by_hand));
    }
    if !policy::helps(r.gain) {
        let left = r.systematic_after_mm;
        let message = format!("these data do not ask for {name}: the error stays at {left:.2} mm whatever its value");
        return Err(CompareError::refused(message, by_hand));
    }
    Ok(r)
}
