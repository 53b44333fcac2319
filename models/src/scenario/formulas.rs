//! `[[formula]]`: effects that the scenario itself defines by a moment.

use super::given::{Checked, fault, unit};
use super::raw::{RawFormula, RawParameter, RawScenario};
use crate::effects::{EFFECTS, PLAIN, Parameter};
use crate::error::ScenarioError;
use crate::formula::{self, Formula, FormulaParameter, MOST_PARAMETERS};
use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::Arc;
use toml::Spanned;

pub(super) fn formulas(raw: &RawScenario, text: &str) -> Checked<Vec<Arc<Formula>>> {
    let mut found: Vec<Arc<Formula>> = Vec::new();
    for entry in &raw.formula {
        let raw = entry.get_ref();
        if found.iter().any(|other| other.name == *raw.name.get_ref()) {
            return fault(format!("two formulas are called \"{}\"", raw.name.get_ref()))
                .help("give the second another name")
                .at(raw.name.span());
        }
        found.push(Arc::new(compiled(raw, text)?));
    }
    Ok(found)
}

fn compiled(raw: &RawFormula, text: &str) -> Checked<Formula> {
    let name = raw.name.get_ref();
    if !is_name(name) {
        return fault(format!("\"{name}\" cannot name an effect"))
            .help("letters, digits and _, starting with a letter, for example cubic_spring")
            .at(raw.name.span());
    }
    if EFFECTS.iter().any(|effect| effect.name == name) {
        return fault(format!("the catalogue already has an effect {name}"))
            .help("give the formula another name")
            .at(raw.name.span());
    }
    let words = |text: &Option<String>, default: &str| text.clone().unwrap_or_else(|| default.to_string());
    let texts = [
        name.clone(),
        raw.moment.get_ref().clone(),
        words(&raw.sentence, "The scenario's own formula."),
        words(&raw.differs, "As the formula states."),
        words(&raw.remedy, "Measure the parameters of the formula on the robot."),
    ];
    Formula::new(texts, parameters(&raw.parameters, raw)?).map_err(|slip| placed(slip, &raw.moment, text))
}

fn parameters(raw: &BTreeMap<Spanned<String>, RawParameter>, of: &RawFormula) -> Checked<Vec<FormulaParameter>> {
    if raw.is_empty() || raw.len() > MOST_PARAMETERS {
        return fault(format!("a formula has 1 to {MOST_PARAMETERS} parameters, not {}", raw.len()))
            .help(format!("write [formula.parameters.k] with unit, typical and bounds below {}", of.name.get_ref()))
            .at(of.moment.span());
    }
    let mut sorted: Vec<_> = raw.iter().collect();
    sorted.sort_by_key(|(key, _)| key.span().start);
    let found = sorted.iter().map(|(key, parameter)| checked(key, parameter)).collect::<Checked<Vec<_>>>()?;
    // A formula that does nothing at its typical values, and a parameter that is typically zero, are not fitted.
    let still = |p: &FormulaParameter| p.numbers.typical == p.numbers.neutral;
    let all = found.iter().all(still);
    match found.iter().zip(&sorted).find(|(p, _)| still(p) && (all || p.numbers.typical == 0.0)) {
        Some((p, (_, parameter))) => fault(format!(
            "typical = {} of {} is its neutral value: the diagnosis would leave it out",
            p.numbers.typical, p.key
        ))
        .help("write its usual size as typical, or another neutral value")
        .at(parameter.typical.span()),
        None => Ok(found),
    }
}

fn checked(key: &Spanned<String>, raw: &RawParameter) -> Checked<FormulaParameter> {
    let name = key.get_ref();
    if !is_name(name) || formula::is_variable(name) {
        let help = "letters, digits and _, starting with a letter; kappa, theta, p_act, p_body, s, R, B and pull have a meaning";
        return fault(format!("\"{name}\" cannot name a parameter")).help(help).at(key.span());
    }
    let (si, _) = spelling::units::parse(raw.unit.get_ref()).or_else(|part| {
        let help =
            "known: 1 or -, %, rad, deg, mN, N, kN, mm, cm, m, Pa, kPa, MPa, J, g, kg, s, ms, min; for example \"N m/rad^3\"";
        fault(format!("the unit \"{}\" is not understood at \"{part}\"", raw.unit.get_ref())).help(help).at(raw.unit.span())
    })?;
    let [lower, upper] = **raw.bounds.get_ref();
    if !(lower.is_finite() && upper.is_finite() && lower < upper) {
        return fault(format!("bounds of {name} must rise, not [{lower}, {upper}]"))
            .help("[lower, upper]")
            .at(raw.bounds.span());
    }
    let within = |what: &str, value: f64, span: Range<usize>| {
        if (lower..=upper).contains(&value) {
            return Ok(value);
        }
        fault(format!(
            "{what} = {value} of {name} is outside its bounds {lower} to {upper}{}",
            unit(raw.unit.get_ref())
        ))
        .help("move the bounds or the value")
        .at(span)
    };
    let typical = within("typical", *raw.typical.get_ref(), raw.typical.span())?;
    let neutral = match &raw.neutral {
        Some(value) => within("neutral", *value.get_ref(), value.span())?,
        None => within("neutral", 0.0, key.span())?,
    };
    let meaning = raw.meaning.clone().unwrap_or_else(|| "parameter of the formula".into());
    let numbers = Parameter { si, neutral, typical, lower, upper, possible: [lower, upper], ..PLAIN };
    Ok(FormulaParameter { key: name.clone(), unit: raw.unit.get_ref().clone(), meaning, numbers })
}

fn is_name(text: &str) -> bool {
    let mut letters = text.chars();
    let inside = |c: char| c.is_ascii_alphanumeric() || c == '_';
    letters.next().is_some_and(|c| c.is_ascii_alphabetic()) && letters.all(inside) && text.len() <= 40
}

/// A slip in a formula with its place in the scenario.
fn placed(slip: ScenarioError, moment: &Spanned<String>, text: &str) -> ScenarioError {
    let (span, (from, to)) = (moment.span(), slip.span.unwrap_or_default());
    let written = text.get(span.clone()).unwrap_or_default();
    // The text between the quotes is the formula itself, unless it has escapes.
    let span = match written.find(moment.get_ref().as_str()) {
        Some(start) => (span.start + start + from, span.start + start + to.max(from + 1)),
        None => (span.start, span.end),
    };
    ScenarioError { span: Some(span), ..slip }
}
