//! Shapes of a robot at given pressures, and the pressure for a target tip.

use compare::CompareError;
use models::{Aim, CHANNELS, HOLD_S, Limits, Loads, Model, Prediction, Scenario, Steered, Step, Target, TipSlope};

/// Predicted state at one set of pressures.
#[derive(Debug, Clone)]
pub struct AtPressure {
    /// Pressures of the body and of all channels at this state.
    pub loads: Loads,
    /// Predicted tip, markers and shape at these pressures.
    pub prediction: Prediction,
    /// Change of the tip with the pressure of each channel.
    pub slopes: [TipSlope; CHANNELS],
}

/// Predicts a scenario at pressures. With an effect that has history they are one path in this order, each held for [`HOLD_S`],
/// from rest; the slopes then belong to the first loading.
///
/// ```
/// let robot = ibr::ScenarioFile::read("epam-textbook")?.scenario;
/// let state = &ibr::predict(&robot, &[ibr::Loads::uniform(2e3, 30e3)])?[0];
/// // Without transverse loads the body is one arc, whose chord has half of its turn: y/x = tan(α/2).
/// let tip = state.prediction.tip;
/// assert!((tip.y_m / tip.x_m - (0.5 * tip.angle_rad).tan()).abs() < 1e-9);
/// # Ok::<(), ibr::Error>(())
/// ```
///
/// # Errors
/// A pressure that means nothing, or without an equilibrium.
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

/// A predicted state with the slopes of its tip on the first loading.
pub(crate) fn state(model: &Model, loads: Loads, prediction: Prediction) -> Result<AtPressure, CompareError> {
    let slopes = model.jacobian(&loads, &mut model.prediction())?;
    Ok(AtPressure { loads, prediction, slopes })
}

/// The state, at the scenario's body pressure, in which the tip is on target.
///
/// ```
/// let robot = ibr::ScenarioFile::read("epam")?.scenario;
/// let state = ibr::predict_for(&robot, ibr::models::Target::TipHeight(0.06))?;
/// assert!((state.prediction.tip.y_m - 0.06).abs() < 1e-9);
/// assert!(ibr::predict_for(&robot, ibr::models::Target::TipHeight(1.0)).is_err(), "longer than the body");
/// # Ok::<(), ibr::Error>(())
/// ```
///
/// # Errors
/// A place that the tip does not reach.
pub fn predict_for(scenario: &Scenario, target: Target) -> Result<AtPressure, CompareError> {
    let model = Model::new(scenario);
    let pressure_pa = model.pressure_for(target, scenario.p_body_pa, &mut model.prediction())?;
    at(&model, Loads::uniform(scenario.p_body_pa, pressure_pa))
}

/// The state, at the scenario's body pressure and up to its largest actuator pressure, in which the tip is nearest to a place
/// x, y \[m\]; each supply channel has its own pressure.
///
/// ```
/// let robot = ibr::ScenarioFile::read("epam")?.scenario;
/// let there = ibr::predict(&robot, &[ibr::Loads::uniform(robot.p_body_pa, 20e3)])?[0].prediction.tip;
/// let (_, found) = ibr::predict_near(&robot, [there.x_m, there.y_m])?;
/// assert!(found.miss_m < 1e-6 && (found.loads.actuator_pa[0] - 20e3).abs() < 20.0);
/// # Ok::<(), ibr::Error>(())
/// ```
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
