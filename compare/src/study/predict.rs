//! A model's prediction at the holds and markers of a dataset.

use super::generate::in_channels;
use crate::data_slope::data_slope;
use crate::error::CompareError;
use crate::policy;
use data::{About, Dataset, Direct, Hold};
use models::effects::Stage;
use models::{Loads, Model, Prediction, Scenario, Step};

/// Prediction in the layout of [`Dataset::run`], `[hold][sample][marker][axis]`.
#[derive(Debug, Clone, PartialEq)]
pub struct Predicted {
    /// Predicted positions f of the markers \[m\].
    pub coordinates_m: Vec<f64>,
    /// ∂f/∂ln P \[m\]: what a relative error of the actuator pressure does.
    pub d_ln_pressure_m: Vec<f64>,
}

/// Relative pressure step of the central difference for ∂f/∂ln P.
const PRESSURE_STEP: f64 = 1e-4;

/// The scenario with the dataset's marker stations, gravity direction and known tip force, without effects of what was
/// measured directly; and what does not match, in words.
///
/// # Errors
/// Another actuator, unknown stations, markers off the body, runs with different tip forces; supply channels that the table or the robot
/// has not; what a planar robot cannot leave aside of the data ([`Dataset::left_aside`]).
pub fn fit_scenario(
    scenario: &Scenario,
    dataset: &Dataset,
    about: Option<&About>,
) -> Result<(Scenario, Vec<String>), CompareError> {
    let aside = if scenario.is_spatial() { None } else { dataset.left_aside()? };
    let kind = scenario.actuator.kind.name;
    if dataset.actuator != kind {
        let (data, scenario) = (dataset.actuator.clone(), kind.to_string());
        return Err(CompareError::WrongActuator { dataset: dataset.name.clone(), data, scenario });
    }
    let mut fitted = scenario.with_markers(&stations(scenario, dataset)?);
    let mut warnings = data::check::contradictions(dataset);
    warnings.extend(data::losses(dataset));
    if let Some(about) = about {
        if let Some([x, y]) = about.gravity_direction {
            fitted.gravity_direction = [x, y, 0.0];
        }
        fitted = with_tip_force(fitted, dataset, about)?;
        fitted = without_settled(&fitted, about.direct);
        warnings.extend(geometry_warnings(scenario, about));
        if about.gravity_direction.is_none() && scenario.effects.iter().any(|e| e.name == "gravity") {
            warnings.push(
                "the scenario has gravity, the data's about.toml no [gravity] direction: the scenario's is used".into(),
            );
        }
    }
    warnings.extend(channels(&fitted, dataset)?);
    warnings.extend(aside);
    Ok((fitted, warnings))
}

/// The data as a scenario predicts them: without z for a planar robot.
pub fn seen_by(scenario: &Scenario, dataset: Dataset) -> Dataset {
    if scenario.is_spatial() || !dataset.has_z() { dataset } else { dataset.in_plane() }
}

fn channels(scenario: &Scenario, dataset: &Dataset) -> Result<Option<String>, CompareError> {
    let fed: Vec<usize> = Model::new(scenario).channels().collect();
    let last = dataset.more_channels();
    if last == 0 {
        return Ok((fed.len() > 1).then(|| {
            let names: Vec<String> = fed.iter().map(usize::to_string).collect();
            let given = "the table has one actuator pressure, used for all: give each its column, such as p_act_1_kpa";
            format!("{}: the robot has supply channels {}; {given}", dataset.name, names.join(" and "))
        }));
    }
    if let Some(channel) = fed.iter().find(|channel| **channel > last) {
        let message = format!("the robot has supply channel {channel}, and {} has no pressure of it", dataset.name);
        return Err(CompareError::refused(message, format!("add the column p_act_{channel}_kpa")));
    }
    let pressed = |channel: &usize| dataset.holds.iter().any(|hold| hold.more_act_pa[channel - 1] > 0.0);
    let idle = (1..=last).find(|channel| !fed.contains(channel) && pressed(channel));
    match idle.filter(|_| dataset.channels_differ()) {
        Some(channel) => {
            let message = format!(
                "nothing is supplied by channel {channel} in this scenario, and {} has pressures of it",
                dataset.name
            );
            let help =
                format!("write channel = {channel} into its [[strip]] or [[zone]], or delete p_act_{channel}_kpa");
            Err(CompareError::refused(message, help))
        }
        None => Ok(None),
    }
}

/// Whether a stage of a prediction can leave anything to explain in data of which that much was measured directly.
pub(crate) fn is_open(stage: Stage, direct: Direct) -> bool {
    match stage {
        Stage::Supply => !direct.pressure,
        Stage::Camera => !direct.frame,
        _ => true,
    }
}

/// The scenario without effects of which nothing is left in data of which that much was measured directly.
pub(crate) fn without_settled(scenario: &Scenario, direct: Direct) -> Scenario {
    let stage = |name: &str| scenario.catalogue().effects().find(|e| e.name == name).map(|e| e.stage);
    let mut left = scenario.clone();
    left.effects.retain(|effect| stage(&effect.name).is_none_or(|stage| is_open(stage, direct)));
    left
}

fn stations(scenario: &Scenario, dataset: &Dataset) -> Result<Vec<f64>, CompareError> {
    let known: Option<Vec<f64>> = dataset.markers.iter().map(|m| m.station_m).collect();
    let stations = match known {
        Some(stations) => stations,
        None if scenario.markers_m.len() == dataset.markers.len() => scenario.markers_m.clone(),
        None => {
            let marker = dataset.markers.iter().find(|m| m.station_m.is_none());
            let marker = marker.map(|m| m.name.clone()).unwrap_or_default();
            let (needed, found) = (dataset.markers.len(), scenario.markers_m.len());
            return Err(CompareError::NoStation { marker, needed, found });
        }
    };
    for (marker, s) in dataset.markers.iter().zip(&stations) {
        if !(0.0..=scenario.length_m * 1.001).contains(s) {
            let (s_mm, length_mm) = (s * 1e3, scenario.length_m * 1e3);
            return Err(CompareError::OffTheBody { marker: marker.name.clone(), s_mm, length_mm });
        }
    }
    Ok(stations)
}

fn with_tip_force(scenario: Scenario, dataset: &Dataset, about: &About) -> Result<Scenario, CompareError> {
    let force = |run: &String| about.tip_force_n(run);
    let Some(first) = dataset.runs.first() else { return Ok(scenario) };
    if let Some(other) = dataset.runs.iter().find(|run| force(run) != force(first)) {
        let words = |run: &String| format!("run {run}: {:?} N", force(run));
        return Err(CompareError::MixedTipForces { first: words(first), second: words(other) });
    }
    let known = force(first);
    if known == [0.0, 0.0] {
        return Ok(scenario);
    }
    let own = scenario.effects.iter().find(|e| e.name == "tip_load");
    let [x, y, z] = own.map_or([0.0; 3], |e| [e.values[0], e.values[1], e.values[2]]);
    Ok(scenario.with_effect("tip_load", &[x + known[0], y + known[1], z]))
}

/// Differences beyond 2 % between the scenario and the data's own description.
fn geometry_warnings(scenario: &Scenario, about: &About) -> Vec<String> {
    let Some(g) = &about.geometry else { return Vec::new() };
    let shape = &scenario.actuator.shape;
    let pairs = [
        ("body radius", scenario.radius_m, Some(g.body_radius_m)),
        ("body length", scenario.length_m, Some(g.body_length_m)),
        ("actuator length", shape.length_m, g.pouch_length_m),
        ("actuator width", shape.width_m, g.pouch_width_m),
        ("fold depth", shape.fold_m, g.fold_m),
        ("arm", scenario.actuator.arm_m.unwrap_or(f64::NAN), g.arm_m),
    ];
    let differs = |(name, mine, theirs): (&str, f64, Option<f64>)| {
        let theirs = theirs.filter(|t| policy::is_other_length(*t, mine))?;
        Some(format!("{name}: the scenario has {} mm, the data's about.toml {} mm", mine * 1e3, theirs * 1e3))
    };
    let mut warnings: Vec<String> = pairs.into_iter().filter_map(differs).collect();
    if let Some(count) = g.pouches.filter(|count| *count != scenario.actuator.count) {
        warnings.push(format!("pouches: the scenario has {}, the data's about.toml {count}", scenario.actuator.count));
    }
    warnings
}

/// Predicts every hold of a dataset with a scenario already fitted to it by [`fit_scenario`].
///
/// Every sample of a hold gets the same prediction, unless the model has history: then the holds are walked in order at
/// their sample times ([`Model::follow`]). The robot starts at rest when the first hold's pressures are set, at time 0; a
/// gap between two holds, of one session or of two, passes at the pressures of the second; a hold whose times precede the
/// hold before starts a new session at rest. Where too few runs saw a marker, the prediction gets the value of the data.
///
/// # Errors
/// What the model returns when a hold has no equilibrium.
pub fn predict_dataset(scenario: &Scenario, dataset: &Dataset) -> Result<Predicted, CompareError> {
    let mut predicted = predict_everywhere(scenario, dataset)?;
    as_in_data(dataset, &mut predicted.coordinates_m);
    dataset.unseen_values().for_each(|i| predicted.d_ln_pressure_m[i] = 0.0);
    Ok(predicted)
}

/// Copies the value of the data where too few runs saw a marker: the residual is zero there.
pub(crate) fn as_in_data(dataset: &Dataset, predicted_m: &mut [f64]) {
    dataset.unseen_values().for_each(|i| predicted_m[i] = dataset.coordinates_m[i]);
}

fn predict_everywhere(scenario: &Scenario, dataset: &Dataset) -> Result<Predicted, CompareError> {
    let model = Model::new(scenario);
    if model.has_history() {
        return predict_in_time(&model, dataset);
    }
    let mut state = model.prediction();
    let n = dataset.values_per_run();
    let mut out = Predicted { coordinates_m: vec![0.0; n], d_ln_pressure_m: vec![0.0; n] };
    for (h, hold) in dataset.holds.iter().enumerate() {
        let mut at = |factor: f64| -> Result<Vec<f64>, CompareError> {
            model.predict(&loads(hold, factor), &mut state)?;
            Ok(coordinates(&state, dataset.axes).collect())
        };
        // First the hold itself: an error shall name its own pressures.
        let middle = at(1.0)?;
        // One step above or below the last pressure with an equilibrium there may be none.
        let (low, high) = (at(1.0 - PRESSURE_STEP), at(1.0 + PRESSURE_STEP));
        let sides = f64::from(u8::from(low.is_ok()) + u8::from(high.is_ok()));
        let (low, high) = match (low, high) {
            (Ok(low), Ok(high)) => (low, high),
            (Ok(low), Err(_)) => (low, middle.clone()),
            (Err(_), Ok(high)) => (middle.clone(), high),
            (Err(error), Err(_)) => return Err(error),
        };
        for sample in 0..dataset.samples_per_hold {
            let from = dataset.offset(h, sample, 0);
            for (i, middle) in middle.iter().enumerate() {
                out.coordinates_m[from + i] = *middle;
                out.d_ln_pressure_m[from + i] = (high[i] - low[i]) / (sides * PRESSURE_STEP);
            }
        }
    }
    Ok(out)
}

/// ∂f/∂ln P \[m\] to estimate noise with before anything was fitted: the data's own, which no scenario's stiffness moves; the
/// scenario's where the data do not show it.
pub(crate) fn first_slope(scenario: &Scenario, dataset: &Dataset) -> Result<Vec<f64>, CompareError> {
    match data_slope(dataset) {
        Some(slope) => Ok(slope),
        None => Ok(predict_dataset(scenario, dataset)?.d_ln_pressure_m),
    }
}

/// Pressures of a hold, the actuators' times `factor`; one actuator pressure is for all channels.
pub fn loads(hold: &Hold, factor: f64) -> Loads {
    in_channels(hold.p_body_pa, hold.channels_pa().map(|p| p * factor))
}

pub(crate) fn coordinates(at: &Prediction, axes: usize) -> impl Iterator<Item = f64> + '_ {
    let place = |([x, y], z): (&[f64; 2], &f64)| [*x, *y, *z];
    at.markers.iter().zip(&at.markers_z_m).flat_map(move |marker| place(marker).into_iter().take(axes))
}

/// The steps of a dataset's protocol, one per sample, with the actuator pressures times `factor`.
pub(crate) fn protocol(dataset: &Dataset, factor: f64) -> Vec<Step> {
    let of_hold = |hold: &data::Hold| {
        let loads = loads(hold, factor);
        hold.t_s.iter().map(|t_s| Step { t_s: *t_s, loads }).collect::<Vec<_>>()
    };
    dataset.holds.iter().flat_map(of_hold).collect()
}

fn predict_in_time(model: &Model, dataset: &Dataset) -> Result<Predicted, CompareError> {
    let mut state = model.prediction();
    let mut positions = |factor: f64| -> Result<Vec<f64>, CompareError> {
        let mut coordinates_m = Vec::with_capacity(dataset.values_per_run());
        let mut take = |_: usize, at: &Prediction| coordinates_m.extend(coordinates(at, dataset.axes));
        model.follow(&protocol(dataset, factor), &mut state, &mut take)?;
        Ok(coordinates_m)
    };
    let coordinates_m = positions(1.0)?;
    let (low, high) = (positions(1.0 - PRESSURE_STEP)?, positions(1.0 + PRESSURE_STEP)?);
    let slope = |(high, low): (&f64, &f64)| (high - low) / (2.0 * PRESSURE_STEP);
    Ok(Predicted { coordinates_m, d_ln_pressure_m: high.iter().zip(&low).map(slope).collect() })
}
