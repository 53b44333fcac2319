//! A part by the reduced model.

use crate::columns::{ACCOUNTS, columns};
use crate::part::{Rows, StudyPart};
use crate::study::{Output, Study};
use models::{CHANNELS, Loads, Model, Prediction, Scenario};

pub(crate) fn compute(study: &Study, part: &StudyPart) -> Rows {
    let started = std::time::Instant::now();
    let width = columns(study).len();
    let mut rows = Rows { numbers: Vec::with_capacity(part.cases.len() * width), ..Rows::default() };
    for robot in part.robots(study.per_robot()) {
        let own = part.pressures(robot, study.per_robot());
        match study.scenario(robot) {
            Ok((scenario, kpa)) => of_robot(study, &scenario, &kpa[own], width, &mut rows),
            Err(error) => own.for_each(|_| rows.fail(width, error.to_string())),
        }
    }
    rows.cpu_s = started.elapsed().as_secs_f64();
    rows
}

fn of_robot(study: &Study, scenario: &Scenario, pressures_kpa: &[[f64; CHANNELS]], width: usize, rows: &mut Rows) {
    let model = Model::new(scenario);
    let mut at = model.prediction();
    for channels in pressures_kpa {
        let loads = Loads { body_pa: scenario.p_body_pa, actuator_pa: channels.map(|kpa| 1e3 * kpa) };
        let idle = !scenario.actuator.exists() && channels.iter().any(|kpa| *kpa > 0.0);
        match model.predict_held(&loads, &mut at) {
            _ if idle => rows.fail(width, "an actuator pressure for a beam without [actuator]".into()),
            Err(error) => rows.fail(width, error.to_string()),
            Ok(()) => rows.row(width, |numbers| {
                study.outputs.iter().for_each(|output| put(*output, &model, &loads, &at, study, numbers));
            }),
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
