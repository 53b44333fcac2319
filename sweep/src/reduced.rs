//! A part by the reduced model.

use crate::columns::{ACCOUNTS, Failed, columns, fail};
use crate::part::{Part, Rows};
use crate::study::{Output, Study};
use compare::ScenarioFile;
use models::{CHANNELS, Loads, Model, Prediction};

/// Computes the cases of a part.
pub(crate) fn compute(study: &Study, part: &Part) -> Rows {
    let started = std::time::Instant::now();
    let width = columns(study).len();
    let (mut numbers, mut failed) = (Vec::with_capacity(part.cases.len() * width), Vec::new());
    for robot in part.robots(study.per_robot()) {
        let own = part.pressures(robot, study.per_robot());
        match study.robot(robot) {
            Ok((file, kpa)) => of_robot(study, &file, &kpa[own], width, &mut numbers, &mut failed),
            Err(error) => own.for_each(|_| fail(width, error.to_string(), &mut numbers, &mut failed)),
        }
    }
    Rows { numbers, failed, cpu_s: started.elapsed().as_secs_f64() }
}

fn of_robot(
    study: &Study,
    file: &ScenarioFile,
    pressures_kpa: &[[f64; CHANNELS]],
    width: usize,
    numbers: &mut Vec<f64>,
    failed: &mut Failed,
) {
    let model = Model::new(&file.scenario);
    let mut at = model.prediction();
    for channels in pressures_kpa {
        let loads = Loads { body_pa: file.p_body_pa, actuator_pa: channels.map(|kpa| 1e3 * kpa) };
        let idle = !file.actuator.exists() && channels.iter().any(|kpa| *kpa > 0.0);
        match model.predict_held(&loads, &mut at) {
            _ if idle => fail(width, "an actuator pressure for a beam without [actuator]".into(), numbers, failed),
            Err(error) => fail(width, error.to_string(), numbers, failed),
            Ok(()) => {
                let end = numbers.len() + width;
                study.outputs.iter().for_each(|output| put(*output, &model, &loads, &at, study, numbers));
                numbers.resize(end, f64::NAN);
            }
        }
    }
}

fn put(output: Output, model: &Model, loads: &Loads, at: &Prediction, study: &Study, numbers: &mut Vec<f64>) {
    match output {
        Output::Tip => {
            let tip = [at.tip.x_m, at.tip.y_m, at.tip.z_m].map(|m| 1e3 * m);
            numbers.extend(&tip[..study.axes_of_place().len()]);
            numbers.push(at.tip.angle_rad.to_degrees());
        }
        Output::Markers => {
            let axes = study.axes_of_place().len();
            let end = numbers.len() + axes * study.base.markers_m.len();
            let places = at.markers.iter().zip(&at.markers_z_m).map(|([x, y], z)| [x, y, z].map(|m| 1e3 * m));
            places.for_each(|place| numbers.extend(&place[..axes]));
            numbers.resize(end, f64::NAN);
        }
        Output::Ledger => {
            let first = numbers.len();
            numbers.extend([0.0; ACCOUNTS.len()]);
            for row in model.ledger(loads, at) {
                let Some(k) = ACCOUNTS.iter().position(|(_, account)| *account == row.account) else { continue };
                numbers[first + k] += 1e3 * row.energy_j;
            }
        }
        Output::Limits => numbers.push(f64::from(u8::from(model.beyond(loads, at).is_empty()))),
        // Of the whole part: see the table.
        Output::Time => numbers.push(f64::NAN),
    }
}
