//! Scenarios, data and effects as typed on the command line.

use super::Context;
use crate::failure::Failure;
use crate::output::Input;
use compare::diagnosis::{Diagnosis, Measured, Options, diagnose_together};
use data::{About, Dataset};
use models::Scenario;
use models::actuators::Family;
use models::scenario::SHIPPED;
use models::scenario::quantity::{Quantity, parse};
use std::path::Path;

/// A scenario and where it came from.
pub struct NamedScenario {
    /// The checked scenario.
    pub scenario: Scenario,
    /// Its text.
    pub text: String,
    /// For the manifest.
    pub input: Input,
}

/// Reads a scenario file, or takes a shipped one by name.
pub fn scenario(spec: &str) -> Result<NamedScenario, Failure> {
    let text = scenario_text(spec)?;
    match Scenario::parse(&text) {
        Ok(scenario) => {
            let input = Input::of(spec, text.as_bytes());
            Ok(NamedScenario { scenario, text, input })
        }
        Err(error) => Err(Failure::Scenario { file: spec.into(), text, error }),
    }
}

/// A scenario, or that beside the data if `spec` is not one and the data have one.
pub fn scenario_or_own(spec: &str, data: &str) -> Result<NamedScenario, Failure> {
    match own_scenario(data).filter(|_| spec == "its own") {
        None => scenario(spec),
        Some(text) => {
            let input = Input::of(&format!("{data}/scenario.toml"), text.as_bytes());
            Ok(NamedScenario { scenario: super::held::own(data, &text)?, text, input })
        }
    }
}

/// The scenario that an embedded set or a folder of data has.
pub fn own_scenario(data: &str) -> Option<String> {
    let of_set = || data::set_file(data, "scenario.toml").ok().map(str::to_string);
    std::fs::read_to_string(Path::new(data).join("scenario.toml")).ok().or_else(of_set)
}

fn scenario_text(spec: &str) -> Result<String, Failure> {
    let cause = match (std::fs::read(spec), models::shipped(spec).or(crate::studies::study(spec))) {
        (Err(_), Some(text)) if !Path::new(spec).exists() => return Ok(text.to_string()),
        (Err(cause), _) => cause.to_string(),
        (Ok(bytes), _) => match String::from_utf8(bytes) {
            Ok(text) if text.trim().is_empty() => "the file is empty".to_string(),
            Ok(text) => return Ok(text),
            Err(_) => "it is not a text in UTF-8".to_string(),
        },
    };
    let names: Vec<&str> = SHIPPED.iter().map(|s| s.0).collect();
    let (meant, names) = (spelling::meant(spec, names.iter().copied()), names.join(", "));
    let help = format!("{meant}give a TOML file, or a shipped robot: {names}; `ibr new epam > my.toml` makes a start");
    Err(Failure::Read { path: spec.into(), cause, help })
}

/// Loads marker data with progress.
pub fn dataset(spec: &str, context: &mut Context) -> Result<(Dataset, Option<About>, Input), Failure> {
    let (loaded, about) = data::load(spec, &mut |done, total| {
        let share = if total > 0 { done as f64 / total as f64 } else { 0.0 };
        (context.progress)(&format!("reading {spec}"), Some(share));
    })?;
    let mut bytes = Vec::new();
    data::write_markers_csv(&loaded, &mut bytes)?;
    Ok((loaded, about, Input::of(&format!("{spec} (as read)"), &bytes)))
}

/// Marker data as read.
pub struct Loaded {
    /// As typed.
    pub spec: String,
    /// The data.
    pub dataset: Dataset,
    /// Their description.
    pub about: Option<About>,
    /// Their hash.
    pub input: Input,
}

impl Loaded {
    /// For a diagnosis.
    pub fn measured(&self) -> Measured<'_> {
        Measured { dataset: &self.dataset, about: self.about.as_ref() }
    }
}

/// Loads the data of a diagnosis and those to be fitted along.
pub fn datasets(first: &str, also: &[String], context: &mut Context) -> Result<Vec<Loaded>, Failure> {
    let load = |spec: &str| {
        let (dataset, about, input) = dataset(spec, context)?;
        Ok(Loaded { spec: spec.to_string(), dataset, about, input })
    };
    std::iter::once(first).chain(also.iter().map(String::as_str)).map(load).collect()
}

/// A diagnosis of all of them.
pub fn diagnosed(scenario: &Scenario, data: &[Loaded], options: &Options) -> Result<Diagnosis, Failure> {
    let further: Vec<Measured> = data[1..].iter().map(Loaded::measured).collect();
    Ok(diagnose_together(scenario, data[0].measured(), &further, options)?)
}

/// A quantity of an option.
pub fn quantity(option: &str, text: &str, kind: Quantity) -> Result<f64, Failure> {
    parse(text, kind).map_err(|message| Failure::usage(format!("{option}: {message}"), "see ibr --help"))
}

/// A length of an option that must be above zero \[m\].
pub fn positive(option: &str, text: &str) -> Result<f64, Failure> {
    match quantity(option, text, Quantity::Length)? {
        v if v > 0.0 => Ok(v),
        _ => {
            Err(Failure::usage(format!("{option} {text} is not above zero"), format!("write for example {option} 1mm")))
        }
    }
}

/// A value and its unit, which is `-` for a pure number.
pub fn with_unit(value: &str, unit: &str) -> String {
    if unit == "-" { value.to_string() } else { format!("{value} {unit}") }
}

/// A note on an effect whose share stands for mechanics that another has.
pub fn superseded(scenario: &Scenario) -> Option<String> {
    let has = |name: &str| scenario.effects.iter().any(|e| e.name == name && e.values[0] > 0.0);
    let also = if has("sealed_sides") { ", and both together count it twice" } else { "" };
    let pouches = scenario.actuator.kind.family == Family::Pouch;
    (pouches && has("end_constraint")).then(|| {
        format!(
            "note: end_constraint is a share, taken from measured bags, of what sealed sides cost{also}; the effect sealed_sides \
             (share = 1) derives it"
        )
    })
}

/// Adds an effect typed as `name` (typical values) or `name:key=value,…`; says how its values are known.
pub fn with_effect(scenario: &Scenario, text: &str) -> Result<(Scenario, String), Failure> {
    let (name, values) = text.split_once(':').unwrap_or((text, ""));
    let catalogue = scenario.catalogue();
    let Some(effect) = catalogue.by_name(name) else {
        let known: Vec<&str> = catalogue.effects().map(|e| e.name).collect();
        return Err(Failure::usage(format!("unknown effect `{name}`"), spelling::known(name, &known)));
    };
    let kind = scenario.actuator.kind;
    if !scenario.actuator.takes(&effect) {
        let message = format!("{name} does not exist for the actuator {}", kind.name);
        return Err(Failure::usage(message, "`ibr list effects` says what each effect is for"));
    }
    let mut chosen = if values.is_empty() { effect.typical_for(kind.name) } else { effect.neutral() };
    for pair in values.split(',').filter(|pair| !pair.is_empty()) {
        let (key, number) = pair.split_once('=').unwrap_or((pair, ""));
        let keys: Vec<&str> = effect.parameters.iter().map(|p| p.key).collect();
        let help = format!(
            "{}parameters of {name}: {}; for example {name}:{}={}",
            if keys.contains(&key.trim()) { String::new() } else { spelling::meant(key, keys.iter().copied()) },
            keys.join(", "),
            effect.parameters[0].key,
            effect.parameters[0].typical
        );
        let Some(index) = effect.parameters.iter().position(|p| p.key == key.trim()) else {
            return Err(Failure::usage(format!("{name} has no parameter `{key}`"), help));
        };
        let p = &effect.parameters[index];
        match number.trim().parse::<f64>() {
            Ok(v) if p.is_usual(v) => chosen[index] = v * p.si,
            Ok(v) if p.is_possible(v) => {
                let message = format!("{key} = {v} is outside its usual bounds {}", p.usual_words());
                let found = "one that was found on the robot goes into the scenario, with basis = \"measured\"";
                return Err(Failure::usage(message, format!("{help}; {found}")));
            }
            Ok(v) => {
                let message = format!("{key} = {v} is outside its physical bounds {}", p.possible_words());
                return Err(Failure::usage(message, help));
            }
            Err(_) => return Err(Failure::usage(format!("{key} = `{number}` is not a number"), help)),
        }
    }
    let origin = if values.is_empty() { "typical value of the catalogue" } else { "value given on the command line" };
    Ok((scenario.with_effect(name, &chosen), origin.to_string()))
}
