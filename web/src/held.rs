//! A robot compared with measurements: how far off, and what it lacks.

use crate::data_of::Measured;
use crate::robot::Robot;
use compare::CompareError;
use compare::diagnosis::words::listed;
use compare::diagnosis::{Diagnosis, EffectAnswer, Options, Standing, diagnose};
use data::Dataset;
use ibr::compared::Compared;
use ibr::pages::{Diagnosed, Files, PageError, compare_files, demo_plots, diagnosis_plots, measured};
use ibr::shown::as_json;
use ibr::shown::comparison::CompareAnswer;
use ibr::shown::demo::panels;
use ibr::shown::diagnosis::{DiagnosisAnswer, verdict};
use report::page::inline;
use serde_json::{Map, Value, json};

/// The panels of `ibr demo`, and their pictures.
///
/// # Errors
/// Damaged embedded data or a model without equilibrium.
pub fn demo() -> Result<Value, CompareError> {
    let computed = compare::demo::demo(&mut |_, _| ())?;
    Ok(json!({"panels": panels(&computed), "pictures": pictures(demo_plots(&computed, &mut |_, _| ()))?}))
}

/// The answer of `ibr compare --json`, and its pictures.
///
/// # Errors
/// Scenario or data that are refused, or that do not fit together.
pub fn compared(robot: &Robot, data: &Measured) -> Result<Value, CompareError> {
    let (file, evidence) = (robot.planar()?, data.evidence()?);
    let Compared { found, added } = Compared::of(&file, &evidence, &[], None, None)?;
    let mut told = as_json("ibr.compare", &CompareAnswer::of(&file.name, &found, added.as_ref()));
    told["error_mm"] = json!(found.error_mm());
    told["measured_m"] = means(&found.dataset);
    told["pictures"] = pictures(compare_files(&found))?;
    Ok(told)
}

/// The answer of `ibr diagnose --json`, its pictures and its page, and every candidate as changes of the robot.
/// Errors as for [`compared`].
pub fn diagnosed(robot: &Robot, data: &Measured) -> Result<Value, CompareError> {
    let (file, evidence) = (robot.planar()?, data.evidence()?);
    let d = diagnose(&file, std::slice::from_ref(&evidence), &Options::default(), &mut |_, _| ())?;
    let mut told = as_json("ibr.diagnose", &DiagnosisAnswer::of(&d, None, &file.name));
    told["verdict_words"] = json!(verdict(&d));
    let level = d.level(1e-3 * file.p_body_pa);
    told["candidates"] = d.answers().iter().filter(|a| a.helps()).map(|a| candidate(&d, a, level)).collect();
    let found = Diagnosed::of(&d, &file, &evidence, [&file.name, &data.name]);
    told["pictures"] = pictures(diagnosis_plots(&found, &mut |_, _| ()))?;
    Ok(told)
}

/// Mean place of every marker in every hold \[m\].
fn means(dataset: &Dataset) -> Value {
    let of_marker = |hold: usize, m: usize| measured(dataset, hold, m).0[..dataset.axes].to_vec();
    let of = |hold: usize| (0..dataset.markers.len()).map(|m| of_marker(hold, m)).collect::<Vec<_>>();
    json!((0..dataset.holds.len()).map(of).collect::<Vec<_>>())
}

fn candidate(d: &Diagnosis, answer: &EffectAnswer, level: usize) -> Value {
    let standing = match answer.standing {
        Standing::Stated => "stated",
        Standing::Attempt => "attempt",
        Standing::Other => "other",
        Standing::Rejected => "rejected",
    };
    let values: Vec<String> = answer.effects.iter().map(|(_, values)| listed(values)).collect();
    let first = answer.effects.first().map(|(r, _)| r);
    json!({
        "name": answer.name(), "words": answer.name().replace('_', " "), "standing": standing, "values": values.join("; "),
        "sentence": first.map(|r| &r.sentence), "remedy": first.map(|r| &r.remedy), "before_mm": d.base.systematic_mm,
        "after_mm": answer.after_mm, "changes": answer.changes(level),
    })
}

/// The drawings of a page, by name, to be put into another one.
fn pictures(files: Result<Files, PageError>) -> Result<Value, CompareError> {
    let files = files.map_err(|error| match error {
        PageError::Compare(error) => error,
        PageError::Report(error) => CompareError::refused(error.to_string(), "look at the data"),
    })?;
    let picture = |(name, bytes): (String, Vec<u8>)| {
        let name = name.strip_suffix(".svg")?.to_string();
        let drawn = inline(&String::from_utf8(bytes).ok()?, &name.replace('_', " "));
        Some((name, json!(drawn)))
    };
    Ok(Value::Object(files.files.into_iter().filter_map(picture).collect::<Map<_, _>>()))
}
