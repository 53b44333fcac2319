//! How far the pressure for a target tip is uncertain, because numbers of the robot were not measured.
//!
//! Every robot of a Latin hypercube ([`fem::robot::hypercube`]) has another value of every number with an interval, even over it; each needs
//! its own pressure. The interval goes from the least to the largest of these, so it contains what the numbers may be, not what the law
//! may miss. Numbers are taken as independent of each other.

use compare::CompareError;
use fem::robot::hypercube;
use models::{Model, Scenario, Target, Unsolved};
use serde::Serialize;
use spelling::si;

/// Robots of the hypercube, and its seed.
const ROBOTS: usize = 64;
const SEED: u64 = 1;

/// A number of an effect that was not measured.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Unmeasured {
    /// Place in the scenario, for example `effects.weld_width.width_mm`
    pub key: String,
    /// Ends of its interval in the unit of the key, as the scenario has them
    pub interval: [f64; 2],
}

/// Pressures that bring a robot's tip to a target, over the intervals of its unmeasured numbers.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PressureInterval {
    /// Least and largest pressure \[Pa\]; `None` if no robot reaches the target
    #[serde(rename = "p_kpa", serialize_with = "si::kpa")]
    pub p_pa: Option<[f64; 2]>,
    /// Robots, each with other values of the numbers
    pub robots: usize,
    /// Robots that do not reach the target
    pub missed: usize,
    /// Numbers that vary
    pub numbers: Vec<Unmeasured>,
}

/// The interval of the pressure for a target, at the scenario's body pressure; `None` if no assumed or calibrated number has an `interval`.
///
/// ```
/// let robot = ibr::ScenarioFile::read("epam")?.scenario;
/// let target = ibr::models::Target::TipHeight(0.1);
/// let pressure_pa = ibr::predict_for(&robot, target)?.loads.actuator_pa[0];
/// let [low, high] = ibr::pressure_interval(&robot, target)?.unwrap().p_pa.unwrap();
/// assert!(low < pressure_pa && pressure_pa < high);
/// assert!(ibr::pressure_interval(&robot.bare(), target)?.is_none());
/// # Ok::<(), ibr::Error>(())
/// ```
///
/// # Errors
/// A pressure without meaning. A robot that does not reach the target is counted instead.
pub fn pressure_interval(scenario: &Scenario, target: Target) -> Result<Option<PressureInterval>, CompareError> {
    let mut places = Vec::new();
    let catalogue = scenario.catalogue();
    for (e, chosen) in scenario.effects.iter().enumerate() {
        let is_unmeasured = ["assumed", "calibrated"].contains(&chosen.basis.as_str());
        let parameters = catalogue.by_name(&chosen.name).filter(|_| is_unmeasured).map(|effect| effect.parameters);
        for (p, parameter) in parameters.unwrap_or_default().iter().enumerate() {
            if let Some(interval) = chosen.interval_of(parameter.key) {
                let key = format!("effects.{}.{}", chosen.name, parameter.key);
                places.push(([e, p], parameter.si, Unmeasured { key, interval }));
            }
        }
    }
    // Some mechanisms do nothing to some robots.
    places.retain(|([e, p], si, number)| {
        let [low, high] = number.interval.map(|value| {
            let mut robot = scenario.clone();
            robot.effects[*e].values[*p] = value * si;
            let model = Model::for_few(&robot);
            model.pressure_for(target, scenario.p_body_pa, &mut model.prediction()).ok()
        });
        low.is_none() || low != high
    });
    if places.is_empty() {
        return Ok(None);
    }
    let mut found = PressureInterval { p_pa: None, robots: ROBOTS, missed: 0, numbers: Vec::new() };
    for shares in hypercube(ROBOTS, places.len(), SEED) {
        let mut robot = scenario.clone();
        for (([e, p], si, Unmeasured { interval: [low, high], .. }), share) in places.iter().zip(shares) {
            robot.effects[*e].values[*p] = (low + share * (high - low)) * si;
        }
        let model = Model::for_few(&robot);
        match model.pressure_for(target, scenario.p_body_pa, &mut model.prediction()) {
            Ok(p) => {
                let [low, high] = found.p_pa.unwrap_or([p, p]);
                found.p_pa = Some([low.min(p), high.max(p)]);
            }
            Err(error @ Unsolved::BadPressure { .. }) => return Err(error.into()),
            Err(_) => found.missed += 1,
        }
    }
    found.numbers = places.into_iter().map(|(.., number)| number).collect();
    Ok(Some(found))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{ScenarioFile, predict_for};
    use fem::robot::ASSUMED;

    fn robot(name: &str, change: impl Fn(String) -> String) -> Scenario {
        let text = change(models::shipped(name).unwrap().to_string());
        ScenarioFile::parse("robot", &text).unwrap().scenario.clone()
    }

    /// One number whose pressure is in closed form: a supply that loses a share x needs P/(1 − x).
    #[test]
    fn a_supply_that_loses_an_unknown_share_needs_the_pressures_of_both_ends() {
        let lossy = "[effects.pressure_loss]\nfraction = 0.1\nbasis = \"assumed\"\ninterval = \"fraction 0.05 to 0.2 (95 %)\"\n";
        let robot = robot("epam-textbook", |text| text + lossy);
        let target = Target::TipHeight(0.08);
        let exact = predict_for(&robot.bare(), target).unwrap().loads.actuator_pa[0];
        let found = pressure_interval(&robot, target).unwrap().unwrap();
        let [low, high] = found.p_pa.unwrap();
        // The outer robots are within a part of the hypercube from the ends.
        let ends = [exact / 0.95, exact / 0.8];
        let part = (ends[1] - ends[0]) * 1.2 / ROBOTS as f64;
        assert!(
            low >= ends[0] && low < ends[0] + part && high <= ends[1] && high > ends[1] - part,
            "{found:?} {ends:?}"
        );
        assert_eq!((found.numbers.len(), found.missed), (1, 0));
        // A target that only some of them reach.
        let most = predict_for(&robot.bare(), target).unwrap();
        let mut short = robot.clone();
        short.p_max_pa = most.loads.actuator_pa[0] / 0.87;
        let found = pressure_interval(&short, target).unwrap().unwrap();
        assert!(found.missed > 0 && found.missed < ROBOTS && found.p_pa.unwrap()[1] <= short.p_max_pa, "{found:?}");
    }

    #[test]
    fn a_measured_number_has_no_interval_and_the_weld_has_that_of_the_finite_elements() {
        let epam = robot("epam", |text| text);
        let measured = robot("epam", |text| text.replace("\"assumed\"", "\"measured\""));
        let target = Target::Angle(0.6);
        assert!(pressure_interval(&measured, target).unwrap().is_none());
        let found = pressure_interval(&epam, target).unwrap().unwrap();
        let interval = |key: &str| found.numbers.iter().find(|number| number.key == key).unwrap().interval;
        let of = |name: &str| ASSUMED.iter().find(|number| number.key == name).unwrap().interval;
        assert_eq!(interval("effects.weld_width.width_mm").map(|mm| mm / 1e3), of("weld_mm"));
        // 0.2 of a solid sheet is the scenario's value.
        let solid = 5.37e-5 / 0.2;
        for (end, factor) in interval("effects.fold_energy.bending_nm").iter().zip(of("bending_factor")) {
            assert!((end / (solid * factor) - 1.0).abs() < 3e-3, "{end} {factor}");
        }
    }
}
