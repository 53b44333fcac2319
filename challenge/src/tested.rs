//! What tests of their own find of a robot: strips of its fabric, a scale, a caliper. They see the robot's laws, not the catalogue's.

use super::Truth;
use super::robot::TrueRobot;
use compare::diagnosis::{BENCH_TEST, BENCH_TESTS};
use compare::error::CompareError;
use compare::study::generate::NormalNumbers;
use data::MeasuredValue;

/// Line load of the tensile test \[N/m\]: what a muscle or a pouch carries at some 20 kPa.
const PULLED_N_PER_M: f64 = 500.0;
/// Shear angle at which the shear modulus is read \[rad\].
const SHEARED_RAD: f64 = 0.05;
/// Largest shear angle of the test \[rad\]: just beyond the free stroke of a muscle.
const MOST_RAD: f64 = 0.35;
/// Shear load at which a weave counts as jammed; its tangent there leads to the locking angle \[N/m\].
const JAMMED_N_PER_M: f64 = 100.0;
const STEP_RAD: f64 = 1e-3;

/// Results of tests by their names, each with its error.
pub(crate) fn bench_tests(truth: &Truth, names: &[String]) -> Result<Vec<MeasuredValue>, CompareError> {
    let robot = truth.robot()?;
    let mut scatter = NormalNumbers::new(truth.seed ^ 0xFAB);
    let mut all = Vec::new();
    for (effect, key) in BENCH_TESTS.iter().filter(|t| names.iter().any(|n| n == t.name)).flat_map(|t| t.parameters) {
        let Some(parameter) =
            models::effects::by_name(effect).and_then(|entry| entry.parameters.iter().find(|p| p.key == *key))
        else {
            continue;
        };
        let found = found(&robot, effect).unwrap_or(parameter.neutral);
        let sd = BENCH_TEST * found.abs().max(parameter.typical_for(&truth.actuator).abs());
        let value = found + sd * scatter.normal();
        all.push(MeasuredValue { effect: (*effect).into(), key: (*key).into(), value, sd, place: String::new() });
    }
    Ok(all)
}

/// What a perfect test finds, in the unit of the catalogue; `None`: nothing.
fn found(robot: &TrueRobot, effect: &str) -> Option<f64> {
    let drive = robot.cells.iter().find_map(|cell| cell.drive)?;
    match effect {
        "fabric_stretch" => Some(drive.stretch(PULLED_N_PER_M * drive.width_m) / PULLED_N_PER_M),
        "shear_stiffness" => Some(drive.shear_load(SHEARED_RAD) / SHEARED_RAD),
        "shear_lock" => {
            let steps = (1..=(MOST_RAD / STEP_RAD) as usize).map(|i| i as f64 * STEP_RAD);
            let jammed = steps.into_iter().find(|angle| drive.shear_load(*angle) > JAMMED_N_PER_M)?;
            let slope = (drive.shear_load(jammed) - drive.shear_load(jammed - STEP_RAD)) / STEP_RAD;
            Some(jammed - drive.shear_load(jammed) / slope)
        }
        "ovalization" => {
            // D = D₀/(1 + o g²) with g = κD/D₀, read at the bend of a robot without hidden effects at 30 kPa.
            let bent = robot.scale_per_m;
            let left = robot.cells.iter().find(|cell| cell.drive.is_some())?.wall.arm_factor(bent).0;
            Some((1.0 / left - 1.0) / (left * bent).powi(2))
        }
        "gravity" => {
            let weights = robot.loads.weight_n_per_m.iter().zip(&robot.cells);
            Some(weights.map(|(w, cell)| w * cell.length_m).sum::<f64>() / robot.length_m)
        }
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Draw;

    #[test]
    fn a_test_finds_what_is_there_and_nothing_where_nothing_is() {
        let plain = Truth::draw("fpam", &mut Draw::new(5, 0)).unwrap();
        let of = |name: &str, effect: &str| {
            let mut truth = plain.clone();
            truth.add(name, 1.0);
            found(&truth.robot().unwrap(), effect)
        };
        // The strain c (0.4 T + 300 (1 − e^(−T/500))) at T = 500 N/m.
        let wanted = 1e-4 * (0.4 + 0.6 * (1.0 - (-1.0f64).exp()));
        assert!((of("fabric_stretch", "fabric_stretch").unwrap() / wanted - 1.0).abs() < 1e-12);
        assert!((of("shear_stiffness", "shear_stiffness").unwrap() / 35.0 - 1.0).abs() < 0.03);
        assert!((of("gravity", "gravity").unwrap() / 1.5 - 1.0).abs() < 1e-12);
        // Half of 0.25 of the arm are lost at the scale κ_c: D/D₀ = 0.875.
        let bent = plain.robot().unwrap().scale_per_m;
        let wanted = (1.0 / 0.875 - 1.0) / (0.875 * bent).powi(2);
        assert!((of("ovalization", "ovalization").unwrap() / wanted - 1.0).abs() < 1e-12);
        // An exponential's tangent leads its length back from where it jams.
        let wanted = 0.22 + 0.035 * (5.0f64.ln() - 1.0);
        assert!((of("shear_lock", "shear_lock").unwrap() - wanted).abs() < 2e-3);
        assert_eq!(of("end_constraint", "shear_lock"), None);
        assert_eq!(of("end_constraint", "fabric_stretch"), Some(0.0));
    }
}
