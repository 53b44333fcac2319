//! A robot put together once and asked many times: what a control loop and a binding call.

use crate::predict::{AtPressure, state};
use compare::CompareError;
use models::{
    Aim, Batch, CHANNELS, GasVolumes, Limits, Loads, Model, Prediction, Scenario, Steered, Target, TipSlope,
    TipStiffness,
};

/// A robot ready to be asked. Pressures are refused where the scenario has nothing that they could act on.
pub struct Predictor {
    /// Checked scenario, a copy of the one given.
    pub scenario: Scenario,
    /// Model of the scenario, with its effects.
    pub model: Model,
}

impl Predictor {
    /// Builds the model of a scenario and keeps a copy of the scenario.
    pub fn new(scenario: &Scenario) -> Predictor {
        Predictor { scenario: scenario.clone(), model: Model::new(scenario) }
    }

    /// The same for a few questions: as [`Model::for_few`].
    pub fn for_few(scenario: Scenario) -> Predictor {
        let model = Model::for_few(&scenario);
        Predictor { scenario, model }
    }

    /// Pressures \[Pa\]: one for all supply channels, or one for each; the body's is the scenario's unless given.
    ///
    /// ```
    /// let robot = ibr::Predictor::new(&ibr::ScenarioFile::read("epam")?.scenario);
    /// assert_eq!(robot.loads(None, &[20e3])?, ibr::Loads::uniform(2e3, 20e3));
    /// assert!(robot.loads(None, &[-20e3]).is_err());
    /// # Ok::<(), ibr::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`check_fed`]; more pressures than channels, or none.
    pub fn loads(&self, body_pa: Option<f64>, given_pa: &[f64]) -> Result<Loads, CompareError> {
        let mut actuator_pa = [0.0; CHANNELS];
        match given_pa {
            [one] => actuator_pa = [*one; CHANNELS],
            many if (1..=CHANNELS).contains(&many.len()) => actuator_pa[..many.len()].copy_from_slice(many),
            many => {
                let message = format!("{} actuator pressures; there are {CHANNELS} supply channels", many.len());
                return Err(CompareError::refused(message, "give one pressure, or one for every channel"));
            }
        }
        check_fed(&self.model, &actuator_pa)?;
        Ok(Loads { body_pa: body_pa.unwrap_or(self.scenario.p_body_pa), actuator_pa }.checked()?)
    }

    fn body_pa(&self, given_pa: Option<f64>) -> Result<f64, CompareError> {
        Ok(Loads::uniform(given_pa.unwrap_or(self.scenario.p_body_pa), 0.0).checked()?.body_pa)
    }

    /// A single state, as [`Model::predict_held`], with the slopes of the tip.
    /// Errors as for [`Model::predict`].
    pub fn state(&self, loads: &Loads) -> Result<AtPressure, CompareError> {
        let mut prediction = self.model.prediction();
        self.model.predict_held(loads, &mut prediction)?;
        self.with_slopes(loads, prediction)
    }

    /// A predicted state with the slopes of the tip on the first loading.
    /// Errors as for [`Model::predict`].
    pub fn with_slopes(&self, loads: &Loads, at: Prediction) -> Result<AtPressure, CompareError> {
        state(&self.model, *loads, at)
    }

    /// The state, on the first loading, in which the tip is on target, and its pressures.
    ///
    /// # Errors
    /// A place that the tip does not reach.
    pub fn inverse(&self, target: Target, body_pa: Option<f64>) -> Result<(Loads, Prediction), CompareError> {
        let body_pa = self.body_pa(body_pa)?;
        let mut at = self.model.prediction();
        let pressure_pa = self.model.pressure_for(target, body_pa, &mut at)?;
        Ok((Loads::uniform(body_pa, pressure_pa), at))
    }

    /// Pressures of all channels that bring the robot nearest to an aim, and its state there; within limits, else from nothing to
    /// the largest pressure of the scenario. Errors as for [`Model::steer`].
    pub fn steer(
        &self,
        aim: Aim,
        body_pa: Option<f64>,
        limits: Option<Limits>,
    ) -> Result<(Steered, Prediction), CompareError> {
        let mut work = self.model.steering();
        let body_pa = self.body_pa(body_pa)?;
        let limits = limits.unwrap_or(Limits::up_to(self.scenario.p_max_pa));
        let found = self.model.steer(aim, body_pa, &limits, &mut work)?;
        Ok((found, work.state().clone()))
    }

    /// Change of the tip with the pressure of each channel. Errors as for [`Model::predict`].
    ///
    /// ```
    /// let robot = ibr::Predictor::new(&ibr::ScenarioFile::read("epam")?.scenario);
    /// let y_m = |pa: f64| Ok::<f64, ibr::Error>(robot.state(&robot.loads(None, &[pa])?)?.prediction.tip.y_m);
    /// let slope = robot.jacobian(&robot.loads(None, &[20e3])?)?[0].y_per_pa;
    /// assert!(((y_m(20.1e3)? - y_m(19.9e3)?) / 200.0 / slope - 1.0).abs() < 1e-4);
    /// # Ok::<(), ibr::Error>(())
    /// ```
    pub fn jacobian(&self, loads: &Loads) -> Result<[TipSlope; CHANNELS], CompareError> {
        Ok(self.model.jacobian(loads, &mut self.model.prediction())?)
    }

    /// Volumes of the gases and their slopes by the pressures. Errors as for [`Model::predict`].
    pub fn volumes(&self, loads: &Loads) -> Result<GasVolumes, CompareError> {
        Ok(self.model.volumes(loads, &mut self.model.prediction())?)
    }

    /// How the tip gives way to a force. Errors as for [`Model::predict`].
    pub fn tip_stiffness(&self, loads: &Loads) -> Result<TipStiffness, CompareError> {
        Ok(self.model.tip_stiffness(loads, &mut self.model.prediction())?)
    }

    /// Many states in parallel on so many threads, one per core if 0; bits do not depend on the number.
    ///
    /// # Errors
    /// A state without equilibrium, with its number from 0; an effect with history, whose states have an order.
    pub fn batch(&self, loads: &[Loads], threads: usize) -> Result<Batch, CompareError> {
        if self.model.has_history() {
            let message = format!("{} remembers, so its states have an order and times", self.scenario.name);
            return Err(CompareError::refused(message, "walk them with follow(t_s, pressure_kpa)"));
        }
        let cores = || std::thread::available_parallelism().map_or(1, usize::from);
        let mut batch = self.model.batch(loads.len(), if threads == 0 { cores() } else { threads });
        let predicted = self.model.predict_batch(loads, &mut batch);
        predicted.map_err(|error| {
            let message = format!("state {} of the batch: {error}", batch.tips.len());
            CompareError::refused(message, "leave it out, or lower its pressure")
        })?;
        Ok(batch)
    }
}

/// Refuses pressures that would be lost: of a robot without actuator, or of a channel that supplies nothing.
pub fn check_fed(model: &Model, actuator_pa: &[f64; CHANNELS]) -> Result<(), CompareError> {
    let mut fed = [false; CHANNELS];
    model.channels().for_each(|channel| fed[channel] = true);
    if !fed.contains(&true) && actuator_pa.iter().any(|p| *p > 0.0) {
        let message = "an actuator pressure for a beam without [actuator]";
        return Err(CompareError::refused(message, "leave it out"));
    }
    let is_lost = |channel: &usize| {
        let p = actuator_pa[*channel];
        p > 0.0 && p != actuator_pa[0] && !fed[*channel]
    };
    match (0..CHANNELS).find(is_lost) {
        Some(channel) => {
            let message = format!("nothing is supplied by channel {channel} in this scenario");
            Err(CompareError::refused(message, "write one pressure, or give zones a channel in the scenario"))
        }
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{ScenarioFile, predict};

    fn robot(more: &str) -> Predictor {
        let text = format!("{}{more}", models::shipped("epam").unwrap());
        Predictor::new(&ScenarioFile::parse("robot", &text).unwrap())
    }

    #[test]
    fn a_state_is_that_of_a_prediction_with_and_without_history() {
        for more in ["", "[effects.friction]\nmoment_nm = 0.2\n"] {
            let robot = robot(more);
            let loads = robot.loads(None, &[20e3]).unwrap();
            let wanted = predict(&robot.scenario, &[loads]).unwrap().remove(0);
            let found = robot.state(&loads).unwrap();
            assert_eq!((found.prediction.tip, found.slopes), (wanted.prediction.tip, wanted.slopes), "{more}");
            assert_eq!(robot.model.has_history(), !more.is_empty());
            assert_eq!(robot.batch(&[loads], 1).is_err(), robot.model.has_history());
        }
    }

    #[test]
    fn pressures_that_would_be_lost_are_refused() {
        let robot = robot("");
        let told = |given: &[f64]| robot.loads(Some(2e3), given).map_err(|error| error.to_string());
        assert!(told(&[10e3, 10e3]).is_ok());
        assert!(told(&[10e3, 20e3]).unwrap_err().contains("channel 1"));
        assert!(told(&[]).unwrap_err().contains("0 actuator pressures"));
        let high = [10e3, 2e6].map(|pa| Loads::uniform(2e3, pa));
        assert!(robot.batch(&high, 2).unwrap_err().to_string().starts_with("state 1 of the batch: "));
    }
}
