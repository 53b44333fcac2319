//! Predicted shapes.

use super::figures::{LINE_POINTS, MOST_POSES, mm};
use super::{Files, PageError};
use crate::AtPressure;
use models::{Loads, Model, Scenario};
use report::{ShapePose, Shapes, shapes};

/// The first few predicted shapes in one plot.
///
/// # Errors
/// What cannot be drawn.
pub fn predicted_files(scenario: &Scenario, states: &[AtPressure]) -> Result<Files, PageError> {
    let model = Model::new(scenario);
    let pose = |s: &AtPressure| ShapePose {
        label: format!("{} kPa", pressure_words(&s.loads)),
        curve_mm: mm(&model.centre_line(&s.prediction, LINE_POINTS)),
        predicted_mm: mm(&s.prediction.markers),
        measured: vec![],
    };
    let data = Shapes {
        title: format!("{}, predicted", scenario.name),
        rest_mm: mm(&[[0.0, 0.0], [scenario.length_m, 0.0]]),
        body_radius_mm: scenario.radius_m * 1e3,
        poses: states.iter().take(MOST_POSES).map(pose).collect(),
    };
    let mut files = Files::default();
    files.plot("shapes", shapes(&data)?);
    Ok(files)
}

/// Pressures of the channels \[kPa\]; one number where they are equal.
pub fn pressure_words(loads: &Loads) -> String {
    let p = loads.actuator_pa;
    if p.iter().all(|x| *x == p[0]) {
        return format!("{:.3}", p[0] / 1e3);
    }
    p.map(|x| format!("{:.3}", x / 1e3).trim_end_matches('0').trim_end_matches('.').to_string()).join("/")
}
