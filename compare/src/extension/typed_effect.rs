//! Effects as a user types them: `name`, `name=VALUE`, `name:key=value,…`.

use crate::error::CompareError;
use models::Scenario;

/// Adds an effect typed as `name` (typical values) or `name:key=value,…`; returns how its values are known.
///
/// # Errors
/// A name, key or value that is not possible, with those that are.
pub fn with_effect(scenario: &Scenario, text: &str) -> Result<(Scenario, &'static str), CompareError> {
    let (name, values) = text.split_once(':').unwrap_or((text, ""));
    let catalogue = scenario.catalogue();
    let Some(effect) = catalogue.by_name(name) else {
        let known: Vec<&str> = catalogue.effects().map(|e| e.name).collect();
        return Err(CompareError::refused(format!("unknown effect `{name}`"), spelling::known(name, &known)));
    };
    let kind = scenario.actuator.kind;
    if !scenario.actuator.takes(&effect) {
        let message = format!("{name} does not exist for the actuator {}", kind.name);
        return Err(CompareError::refused(message, "`ibr list effects` states what each effect is for"));
    }
    let mut chosen = if values.is_empty() { effect.typical_for(kind.name) } else { effect.neutral() };
    let mut told = vec![false; effect.parameters.len()];
    for pair in values.split(',').filter(|pair| !pair.is_empty()) {
        let (key, number) = pair.split_once('=').unwrap_or((pair, ""));
        let keys: Vec<&str> = effect.parameters.iter().map(|p| p.key).collect();
        let (first, all) = (&effect.parameters[0], keys.join(", "));
        let help = format!("parameters of {name}: {all}; for example {name}:{}={}", first.key, first.typical);
        let Some(index) = keys.iter().position(|own| *own == key.trim()) else {
            let help = spelling::meant(key, keys.iter().copied()) + &help;
            return Err(CompareError::refused(format!("{name} has no parameter `{key}`"), help));
        };
        let p = &effect.parameters[index];
        if std::mem::replace(&mut told[index], true) {
            return Err(CompareError::refused(format!("{name}: {key} is given twice"), help));
        }
        chosen[index] = p.si * number_of(p, key, number, help)?;
    }
    let origin = if values.is_empty() { "typical value of the catalogue" } else { "value given on the command line" };
    let with = scenario.with_effect(name, &chosen);
    if let Some(force) = with.idle_force_n() {
        let message = format!("force_z_n = {force}, and this robot bends in the x–y plane alone");
        return Err(CompareError::refused(message, "remove it, or give the robot a [[strip]]"));
    }
    Ok((with, origin))
}

fn number_of(p: &models::effects::Parameter, key: &str, text: &str, help: String) -> Result<f64, CompareError> {
    let found = "one that was found on the robot goes into the scenario, with basis = \"measured\"";
    let (message, help) = match text.trim().parse::<f64>() {
        Ok(v) if p.is_usual(v) => return Ok(v),
        Ok(v) if p.is_possible(v) => {
            (format!("{key} = {v} is outside its usual bounds {}", p.usual_words()), format!("{help}; {found}"))
        }
        Ok(v) => (format!("{key} = {v} is outside its physical bounds {}", p.possible_words()), help),
        Err(_) => (format!("{key} = `{text}` is not a number"), help),
    };
    Err(CompareError::refused(message, help))
}

/// Keys and values of an effect, in the units of the scenario.
pub type TypedValues = Vec<(String, f64)>;

/// Name of an effect that the scenario lacks, and its values if any were typed.
///
/// # Errors
/// As [`with_effect`], and an effect that is there already.
pub fn typed(scenario: &Scenario, text: &str) -> Result<(String, Option<TypedValues>), CompareError> {
    let place = text.find([':', '=']).unwrap_or(text.len());
    let (name, rest) = text.split_at(place);
    let catalogue = scenario.catalogue();
    let text = match (rest.strip_prefix('='), catalogue.by_name(name)) {
        (Some(value), Some(effect)) => {
            let free = effect.parameters.iter().find(|p| p.typical != 0.0).unwrap_or(&effect.parameters[0]);
            format!("{name}:{}={value}", free.key)
        }
        _ => text.to_string(),
    };
    let (with, _) = with_effect(scenario, &text)?;
    if scenario.effects.iter().any(|e| e.name == name) {
        let help = "change its value there, or fit it with `ibr diagnose --refit`";
        return Err(CompareError::refused(format!("the scenario has {name} already"), help));
    }
    Ok((name.to_string(), (!rest.is_empty()).then(|| values_of(&with, name))))
}

/// A scenario with an effect at values in the units of its keys, neutral where there is none; unchanged where no effect has that name.
pub(crate) fn with_values(scenario: &Scenario, name: &str, value: impl Fn(&str) -> Option<f64>) -> Scenario {
    let catalogue = scenario.catalogue();
    let Some(effect) = catalogue.by_name(name) else { return scenario.clone() };
    let values: Vec<f64> = effect.parameters.iter().map(|p| value(p.key).unwrap_or(p.neutral) * p.si).collect();
    scenario.with_effect(name, &values)
}

/// The values that an effect has in a scenario; its typical values where the scenario lacks it.
pub fn values_of(scenario: &Scenario, name: &str) -> TypedValues {
    let catalogue = scenario.catalogue();
    let Some(effect) = catalogue.by_name(name) else { return Vec::new() };
    let own = scenario.effects.iter().find(|e| e.name == name).map(|e| e.values.clone());
    let values = own.unwrap_or_else(|| effect.typical_for(scenario.actuator.kind.name));
    effect.parameters.iter().zip(values).map(|(p, v)| (p.key.to_string(), v / p.si)).collect()
}
