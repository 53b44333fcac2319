//! `ibr predict --limits`: from which length on loads fold the robot.

use super::Outcome;
use super::tables::table;
use crate::failure::Failure;
use ibr::pages::pressure_words;
use models::{Loads, Scenario, collapse_length_m};
use serde_json::{Value, json};

/// Straight, then at each pressure.
pub fn run(name: &str, scenario: &Scenario, wanted: &[Loads]) -> Result<Outcome, Failure> {
    if !scenario.effects.iter().any(|e| ["gravity", "tip_load"].contains(&e.name.as_str())) {
        let help = "add what bends it, for example --effect gravity:weight_n_per_m=1.5";
        return Err(Failure::usage("a robot without load collapses at no length", help));
    }
    let straight = Loads::uniform(scenario.p_body_pa, 0.0);
    let steered = wanted.iter().filter(|loads| loads.actuator_pa.iter().any(|p| *p > 0.0));
    let lengths: Vec<(Loads, Option<f64>)> =
        std::iter::once(&straight).chain(steered).map(|loads| (*loads, collapse_length_m(scenario, loads))).collect();
    let rows = lengths.iter().map(|(loads, length)| {
        let words = length.map_or("none".to_string(), |m| format!("{:.0}", m * 1e3));
        let times = length.map_or("-".to_string(), |m| format!("{:.2}", m / scenario.length_m));
        vec![pressure_words(loads), words, times]
    });
    let head = ["P [kPa]", "collapse length [mm]", "over its length"];
    let mut text = format!("{} at body pressure {} kPa\n", scenario.name, scenario.p_body_pa / 1e3);
    text.push_str(&table(&head, 0, rows.collect()));
    text.push_str("Predicted. As many more units as the length asks for; \"none\": not up to 50 times its length.\n");
    let rows: Vec<Value> = lengths
        .iter()
        .map(|(loads, length)| {
            json!({"p_act_channels_kpa": loads.actuator_pa.map(|p| p / 1e3), "length_mm": length.map(|m| m * 1e3)})
        })
        .collect();
    let answer = json!({
        "schema": "ibr.predict.limits", "version": 1, "scenario": name, "name": scenario.name,
        "p_body_kpa": scenario.p_body_pa / 1e3, "length_mm": scenario.length_m * 1e3, "collapse": rows,
    });
    Ok(Outcome::new(text, answer))
}
