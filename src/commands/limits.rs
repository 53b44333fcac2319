//! `ibr predict --limits`: from which length on loads fold the robot.

use crate::prelude::*;
use models::collapse_length_m;

pub(super) fn run(typed: &str, scenario: &Scenario, wanted: &[Loads]) -> Result<Outcome> {
    if !scenario.effects.iter().any(|e| ["gravity", "tip_load"].contains(&e.name.as_str())) {
        let help = "add what bends it, for example --effect gravity:weight_n_per_m=1.5";
        return Err(Failure::usage("a robot without load collapses at no length", help));
    }
    let straight = Loads::uniform(scenario.p_body_pa, 0.0);
    let steered = wanted.iter().filter(|loads| loads.actuator_pa.iter().any(|p| *p > 0.0));
    let lengths: Vec<(Loads, Option<f64>)> =
        std::iter::once(&straight).chain(steered).map(|loads| (*loads, collapse_length_m(scenario, loads))).collect();
    let mut text = format!("{} at body pressure {} kPa\n", scenario.name, scenario.p_body_pa / 1e3);
    text += &Table::of(&lengths)
        .right("P [kPa]", |(loads, _)| pressure_words(loads))
        .right("collapse length [mm]", |(_, length)| length.map_or("none".into(), |m| format!("{:.0}", m * 1e3)))
        .right("over its length", |(_, m)| m.map_or("-".into(), |m| format!("{:.2}", m / scenario.length_m)))
        .text();
    text.push_str("Predicted. As many more units as the length asks for; \"none\": not up to 50 times its length.\n");
    let kpa = |loads: &Loads| loads.actuator_pa.iter().map(|p| p / 1e3).collect();
    let collapse = lengths
        .iter()
        .map(|(loads, m)| CollapseLength { p_act_channels_kpa: kpa(loads), length_mm: m.map(|m| m * 1e3) })
        .collect();
    let (p_body_kpa, length_mm) = (scenario.p_body_pa / 1e3, scenario.length_m * 1e3);
    let answer = LimitsAnswer { scenario: typed, name: &scenario.name, p_body_kpa, length_mm, collapse };
    Ok(Outcome::answer(text, "ibr.predict.limits", &answer))
}

/// `ibr.predict.limits`: `ibr predict SCENARIO --limits`
#[derive(Serialize)]
struct LimitsAnswer<'a> {
    /// Path or name of the scenario as typed
    scenario: &'a str,
    /// Name of the robot in the scenario
    name: &'a str,
    /// Body pressure at which the loads act
    p_body_kpa: f64,
    /// Length of the robot in the scenario
    length_mm: f64,
    /// Length at which it folds: straight, then at each pressure
    collapse: Vec<CollapseLength>,
}

/// Length at which loads fold the robot.
#[derive(Serialize)]
struct CollapseLength {
    /// Actuator pressure of every channel at that length
    p_act_channels_kpa: Vec<f64>,
    /// Length at which the loads fold it; null: none within 50 times its length
    length_mm: Option<f64>,
}
