//! Shapes of a robot at given pressures, and the pressure for a target tip.

use compare::CompareError;
use models::{Aim, CHANNELS, HOLD_S, Limits, Loads, Model, Prediction, Scenario, Steered, Step, Target, TipSlope};

/// One predicted state.
#[derive(Debug, Clone)]
pub struct AtPressure {
    /// Pressures of body and actuator.
    pub loads: Loads,
    /// Pose, tip and markers.
    pub prediction: Prediction,
    /// Change of the tip with the pressure of each channel.
    pub slopes: [TipSlope; CHANNELS],
}

/// Predicts a scenario at pressures. With an effect that has history they are one path in this order, each held for [`HOLD_S`],
/// from rest; the slopes are then those of the first loading.
///
/// # Errors
/// A pressure that means nothing, or at which there is no equilibrium.
pub fn predict(scenario: &Scenario, loads: &[Loads]) -> Result<Vec<AtPressure>, CompareError> {
    let model = Model::new(scenario);
    if !model.has_history() {
        return loads.iter().map(|loads| at(&model, *loads)).collect();
    }
    let step = |(i, loads): (usize, &Loads)| Step { t_s: HOLD_S * (i + 1) as f64, loads: *loads };
    let steps: Vec<Step> = loads.iter().enumerate().map(step).collect();
    let mut predictions = Vec::new();
    model.follow(&steps, &mut model.prediction(), &mut |_, at| predictions.push(at.clone()))?;
    loads.iter().zip(predictions).map(|(loads, prediction)| state(&model, *loads, prediction)).collect()
}

/// A predicted state with the slopes of its tip, which are those of the first loading.
pub(crate) fn state(model: &Model, loads: Loads, prediction: Prediction) -> Result<AtPressure, CompareError> {
    let slopes = model.jacobian(&loads, &mut model.prediction())?;
    Ok(AtPressure { loads, prediction, slopes })
}

/// The state, at the scenario's body pressure, in which the tip is on target.
///
/// # Errors
/// A place that the tip does not reach.
pub fn predict_for(scenario: &Scenario, target: Target) -> Result<AtPressure, CompareError> {
    let model = Model::new(scenario);
    let pressure_pa = model.pressure_for(target, scenario.p_body_pa, &mut model.prediction())?;
    at(&model, Loads::uniform(scenario.p_body_pa, pressure_pa))
}

/// The state, at the scenario's body pressure and up to its largest actuator pressure, in which the tip is nearest to a place
/// x, y \[m\]; each supply channel has a pressure of its own.
///
/// # Errors
/// A place that is none, or no equilibrium anywhere.
pub fn predict_near(scenario: &Scenario, place_m: [f64; 2]) -> Result<(AtPressure, Steered), CompareError> {
    let model = Model::new(scenario);
    let limits = Limits::up_to(scenario.p_max_pa);
    let mut found = model.steer(Aim::Tip(place_m), scenario.p_body_pa, &limits, &mut model.steering())?;
    // A robot with one channel has one pressure, as everywhere.
    let mut channels = model.channels();
    if let (Some(only), None) = (channels.next(), channels.next()) {
        found.loads = Loads::uniform(found.loads.body_pa, found.loads.actuator_pa[only]);
    }
    Ok((at(&model, found.loads)?, found))
}

fn at(model: &Model, loads: Loads) -> Result<AtPressure, CompareError> {
    let mut prediction = model.prediction();
    let slopes = model.jacobian(&loads, &mut prediction)?;
    model.predict(&loads, &mut prediction)?;
    Ok(AtPressure { loads, prediction, slopes })
}
