use super::Result;
use super::figures::{LINE_POINTS, MOST_POSES, mm};
use crate::AtPressure;
use crate::prelude::*;
use report::{ShapePose, Shapes, shapes};

/// The first few predicted shapes in one plot.
pub fn predicted_files(scenario: &Scenario, states: &[AtPressure]) -> Result<Files> {
    let model = Model::new(scenario);
    let mut files = Files::default();
    files.plot("shapes", shapes(&seen(scenario, &model, states, 1))?);
    if scenario.is_spatial() {
        files.plot("shapes_z", shapes(&seen(scenario, &model, states, 2))?);
    }
    Ok(files)
}

/// The shapes as seen along z (axis 1 up) or along y (axis 2 up).
fn seen(scenario: &Scenario, model: &Model, states: &[AtPressure], axis: usize) -> Shapes {
    let flat = |points: &[[f64; 3]]| mm(&points.iter().map(|p| [p[0], p[axis]]).collect::<Vec<_>>());
    let pose = |s: &AtPressure| {
        let markers = s.prediction.markers.iter().zip(&s.prediction.markers_z_m).map(|([x, y], z)| [*x, *y, *z]);
        ShapePose {
            label: format!("{} kPa", pressure_words(&s.loads)),
            curve_mm: flat(&model.centre_line_in_space(&s.prediction, LINE_POINTS)),
            predicted_mm: flat(&markers.collect::<Vec<_>>()),
            measured: vec![],
        }
    };
    let across = match (scenario.is_spatial(), axis) {
        (false, _) => "",
        (true, 1) => "y, towards azimuth 0\u{b0} [mm]",
        (true, _) => "z, towards azimuth 90\u{b0} [mm]",
    };
    Shapes {
        title: format!("{}, predicted", scenario.name),
        across: across.into(),
        rest_mm: mm(&[[0.0, 0.0], [scenario.length_m, 0.0]]),
        body_radius_mm: scenario.radius_m * 1e3,
        poses: states.iter().take(MOST_POSES).map(pose).collect(),
    }
}
