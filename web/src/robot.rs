//! A robot of the page: a scenario with what was changed by hand.

use crate::seen::views;
use compare::{CompareError, ScenarioFile};
use ibr::shown::predicted::{PredictedState, above_limit, beyond_words};
use ibr::studies::{IN_SPACE, scenario};
use ibr::{AtPressure, Predictor};
use models::effects::{Effect, Parameter};
use models::scenario::ROBOTS;
use models::{Known, Model, Scenario};
use serde::Deserialize;
use serde_json::{Value, json};

/// Stations at which the sides are given.
const STATIONS: usize = 97;

/// Robot of a question: a shipped one, or the text of a scenario.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Robot {
    /// Name of a shipped robot, or of the file of the text.
    pub name: String,
    /// The text of a scenario; without it the robot of that name.
    #[serde(default)]
    pub text: Option<String>,
    /// Values set in the text: place and value, as [`ScenarioFile::with`] takes them.
    #[serde(default)]
    pub changes: Vec<(String, String)>,
}

/// The shipped robots, what textbooks have of them, then those with strips round the body.
pub fn shipped_names() -> Vec<String> {
    let planar = ROBOTS.into_iter().map(String::from);
    planar.chain(IN_SPACE.map(String::from)).collect()
}

pub(crate) fn shipped() -> Vec<Value> {
    let told = |name: String| {
        let scenario = ibr::studies::scenario(&name).ok()?.scenario;
        let kind = scenario.actuator.kind;
        let known = match (scenario.is_spatial(), scenario.effects.len()) {
            (true, _) => "",
            (false, 0 | 1) => ", as textbooks have it",
            (false, _) => ", with its known mechanics",
        };
        Some(json!({"name": name, "title": format!("{}{known}", scenario.name), "sentence": kind.sentence}))
    };
    shipped_names().into_iter().filter_map(told).collect()
}

impl Robot {
    /// Its scenario, without and with the changes. Errors as for [`scenario`] and [`ScenarioFile::with`].
    fn files(&self) -> Result<[ScenarioFile; 2], CompareError> {
        let given = match &self.text {
            Some(text) => ScenarioFile::parse(&self.name, text),
            None => scenario(&self.name),
        }?;
        let changed = given.with(&self.changes)?;
        Ok([given, changed])
    }

    /// The scenario with the changes, for functions that take planar robots alone.
    /// Errors as for [`ScenarioFile::planar`].
    pub fn planar(&self) -> Result<ScenarioFile, CompareError> {
        let [_, changed] = self.files()?;
        changed.planar()
    }

    /// What it is: its text, what can be turned, its effects.
    ///
    /// # Errors
    /// A scenario that cannot be read.
    pub fn told(&self) -> Result<Value, CompareError> {
        let [given, file] = self.files()?;
        // The ends of a dial do not depend on its position.
        let now = file.dials();
        let value = |place: &str| now.iter().find(|d| d.place == place).map(|d| d.value);
        let dials: Vec<Value> =
            given.dials().iter().map(|dial| json!({"dial": dial, "value": value(&dial.place)})).collect();
        let catalogue = file.catalogue();
        let possible = catalogue.effects().filter(|effect| file.takes(effect));
        let effects: Vec<Value> = possible.map(|effect| effect_told(&effect, &given, &file)).collect();
        let a = &file.actuator;
        Ok(json!({
            "name": file.scenario.name, "text": file.text, "dials": dials, "effects": effects,
            "channels": Model::new(&file.scenario).channels().collect::<Vec<_>>(), "pressures_kpa": kpa(&file.pressures_pa), "most_kpa": 1e-3 * file.p_max_pa,
            "is_spatial": file.is_spatial(), "kind": a.kind.name, "title": a.kind.title, "sentence": a.kind.sentence,
        }))
    }

    /// Its shape, and its bare model's.
    ///
    /// # Errors
    /// A scenario that cannot be read, and the errors of [`Predictor::state`].
    pub fn predicted(&self, actuator_kpa: &[f64]) -> Result<Value, CompareError> {
        let [_, file] = self.files()?;
        let pa: Vec<f64> = actuator_kpa.iter().map(|p| 1e3 * p).collect();
        let own = Predictor::new(&file.scenario);
        let state = own.state(&own.loads(None, &pa)?)?;
        let mut told = drawn(&own, &state, true);
        // The bare model of a loaded beam may have no equilibrium, and is then not drawn.
        let bare = Predictor::new(&file.bare());
        told["bare"] = bare.state(&state.loads).map_or(Value::Null, |state| drawn(&bare, &state, false));
        told["units"] = units(&file.scenario);
        told["notes"] = json!(
            beyond_words(&own.model, &state.loads, &state.prediction)
                .into_iter()
                .chain(above_limit(&file, &[state.loads]))
                .collect::<Vec<_>>()
        );
        Ok(told)
    }
}

/// Where the units of the actuator are, and whether they are welded into the wall.
fn units(scenario: &Scenario) -> Value {
    let a = &scenario.actuator;
    json!({
        "start_m": a.start_m, "length_m": a.shape.length_m, "width_m": a.shape.width_m, "count": a.count,
        "is_pouch": a.kind.has_pouches(), "in_wall": a.in_wall(),
    })
}

/// A state as `ibr predict --json` gives it, with the lines to draw \[m\].
fn drawn(of: &Predictor, state: &AtPressure, with_units: bool) -> Value {
    let mut told = PredictedState::of(&of.model, &of.scenario, state).json();
    match views(of, state, STATIONS, with_units) {
        Some(views) => told["views"] = views,
        None => told["sides"] = json!(of.model.outline(&state.prediction, STATIONS)),
    }
    told["radius_m"] = json!(of.scenario.radius_m);
    told["length_m"] = json!(of.scenario.length_m);
    told["height_m"] = json!(of.model.pouch_shape(&state.loads, &state.prediction).map(|shape| shape.height_m));
    told
}

/// An effect, whether it is on, and what switches it on and off.
fn effect_told(effect: &Effect, given: &Scenario, now: &Scenario) -> Value {
    let of =
        |scenario: &Scenario| scenario.effects.iter().find(|own| own.name == effect.name).map(|own| own.values.clone());
    let neutral = effect.neutral();
    let is_on = |values: &Vec<f64>| *values != neutral;
    let (before, values) = (of(given).filter(is_on), of(now).unwrap_or_else(|| neutral.clone()));
    let full = before.clone().unwrap_or_else(|| effect.typical_for(given.actuator.kind.name));
    let parameter = |(i, p): (usize, &Parameter)| {
        let [value, on] = [values[i], full[i]].map(|v| v / p.si);
        json!({
            "place": format!("effects.{}.{}", effect.name, p.key), "key": p.key, "unit": p.unit, "meaning": p.meaning,
            "value": value, "off": p.neutral, "on": on, "low": p.lower.min(value).min(on), "high": p.upper.max(value).max(on),
        })
    };
    json!({
        "name": effect.name, "words": effect.name.replace('_', " "), "group": effect.group.word(), "sentence": effect.sentence,
        "remedy": effect.remedy, "is_on": is_on(&values), "was_on": before.is_some(),
        "basis": {"place": format!("effects.{}.basis", effect.name), "by_hand": Known::Assumed.word()},
        "parameters": effect.parameters.iter().enumerate().map(parameter).collect::<Vec<_>>(),
    })
}

fn kpa(pa: &[f64]) -> Vec<f64> {
    pa.iter().map(|p| 1e-3 * p).collect()
}
