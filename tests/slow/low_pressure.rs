//! Robots whose pouches pull no harder than the gas of the body: the reduced model against finite elements, neither of which is fitted.

use crate::alone;
use crate::support::Folder;
use serde_json::Value;

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap()
}

/// Height of the tip at every pressure of `kpa`, one after the other \[mm\], by the reduced model.
fn predicted_mm(robot: &str, kpa: &[&str]) -> Vec<f64> {
    let predicted = ran("predict", robot, kpa, &[]);
    let heights: Vec<f64> =
        predicted["states"].as_array().unwrap().iter().map(|state| number(&state["tip"]["y_mm"])).collect();
    println!("reduced, {kpa:?} kPa: {heights:.1?} mm");
    heights
}

/// The same in finite elements.
fn simulated_mm(robot: &str, kpa: &[&str]) -> Vec<f64> {
    let run = ran("simulate", robot, kpa, &["--no-frames", "--quiet"]);
    let readings = run["robot"]["readings"].as_array().unwrap()[1..].iter();
    let moved = readings.map(|reading| 1e3 * number(&reading["moved_m"].as_array().unwrap().last().unwrap()[1]));
    let heights: Vec<f64> = moved.collect();
    println!("finite elements, {kpa:?} kPa: {heights:.1?} mm");
    heights
}

fn ran(command: &str, robot: &str, kpa: &[&str], more: &[&str]) -> Value {
    let folder = Folder::new();
    folder.write("robot.toml", robot);
    let pressures: Vec<String> = kpa.iter().map(|p| format!("{p}kPa")).collect();
    let ran = folder.run(&[&[command, "robot.toml", "--json", "--pressure", &pressures.join(",")], more].concat());
    assert_eq!(ran.code, 0, "{}", ran.stderr);
    ran.json(&format!("ibr.{command}"))
}

#[test]
fn welds_stand_up_as_roofs_and_lie_down_at_the_same_pressures() {
    let _alone = alone();
    let robot = models::shipped("epam").unwrap();
    let (elements, model) = (simulated_mm(robot, &["3", "4", "5", "4", "3"]), predicted_mm(robot, &["3", "4", "5"]));
    // No history: the same way up and down.
    for k in [0, 1] {
        assert!((elements[k] - elements[4 - k]).abs() < 0.02 * elements[2], "{elements:?}");
    }
    // 0.8 of 3.2, −4.8 of 25.5 and −1.4 of 41.9 mm; without roofs 13.9, 8.9 and 7.1 mm.
    for (k, most_mm) in [(0, 1.5), (1, 6.0), (2, 3.0)] {
        assert!((model[k] - elements[k]).abs() < most_mm, "{elements:?} {model:?}");
    }
    let straight = robot.replace("[effects.roofed_welds]\nshare = 1", "[effects.roofed_welds]\nshare = 0");
    assert!(predicted_mm(&straight, &["3"])[0] > elements[0] + 10.0);
}

#[test]
fn roofs_follow_the_pressure_of_the_body() {
    let _alone = alone();
    let robot = models::shipped("epam").unwrap().replace("pressure_kpa = 2 ", "pressure_kpa = 4 ");
    let (elements, model) = (simulated_mm(&robot, &["6", "8", "10"]), predicted_mm(&robot, &["6", "8", "10"]));
    // −0.9 of 4.9, −7.6 of 30.5 and −2.7 of 47.8 mm; without roofs 13.1, 6.4 and 4.6 mm.
    for (k, most_mm) in [(0, 1.5), (1, 8.5), (2, 3.5)] {
        assert!((model[k] - elements[k]).abs() < most_mm, "{elements:?} {model:?}");
    }
}
