//! The missing moment in printed units, and in sentences.

use super::result::{MeasuredShape, MomentPoint};
use super::shape::Shape;
use super::view::Place;
use crate::fit::numbers::sort_by;
use data::Dataset;

pub(crate) fn degrees(length_m: f64) -> f64 {
    length_m.to_degrees()
}

impl MeasuredShape {
    /// The parts of a fitted shape that reports print.
    pub fn of(dataset: &Dataset, shape: &Shape) -> MeasuredShape {
        MeasuredShape {
            dataset: dataset.name.clone(),
            places_mm: shape.division.places.iter().map(Place::ends_mm).collect(),
            floor_mm: shape.floor_mm,
            shared: shape.shared.clone(),
        }
    }
}

/// Findings of the shapes: another position of the tracked line than the scenario's, and the error that no bending explains.
pub(crate) fn shape_sentences(shapes: &[MeasuredShape], noise_known: bool) -> Vec<String> {
    let mut sentences = Vec::new();
    for shape in shapes {
        let Some(line) = shape.shared.first().filter(|s| s.is_told()) else { continue };
        let side = if line.value < 0.0 { "nearer to" } else { "further from" };
        sentences.push(format!(
            "{}: the line of the markers is {:.1} ± {:.1} mm {side} the taut side than in the scenario. That changes how it shortens as it bends, and no law of bending can mend it.",
            shape.dataset, line.value.abs(), line.sd
        ));
    }
    let left = shapes.iter().map(|s| s.floor_mm).fold(0.0, f64::max);
    if noise_known && left > LEAST_LEFT_MM {
        sentences.push(format!(
            "With a free bend for every hold and place {left:.2} mm remain beyond noise: markers, camera or shape."
        ));
    }
    sentences
}

/// A smaller remaining error is not reported [mm].
const LEAST_LEFT_MM: f64 = 0.1;

/// Standard deviations within which a moment counts as none.
const NONE_WITHIN: f64 = 2.0;

pub(crate) fn sentences(points: &[MomentPoint]) -> Vec<String> {
    let mut holds: Vec<&MomentPoint> = points.iter().filter(|p| p.is_of_hold()).collect();
    sort_by(&mut holds, |p| p.bend_deg);
    let (Some(first), Some(last)) = (holds.first(), holds.last()) else {
        return vec!["No pressurised hold bends enough to show a missing moment.".into()];
    };
    let clear = |p: &MomentPoint| p.moment_nm.abs() > NONE_WITHIN * p.moment_sd_nm;
    let value = |p: &MomentPoint| format!("{:+.2} ± {:.2} N m at {:.0}°", p.moment_nm, p.moment_sd_nm, p.bend_deg);
    let what = match () {
        () if !holds.iter().any(|p| clear(p)) => "No moment is missing within its error at any bend".to_string(),
        () if holds.iter().all(|p| p.moment_nm < 0.0) => "Something holds the robot back that the model lacks".into(),
        () if holds.iter().all(|p| p.moment_nm > 0.0) => "Something bends the robot that the model lacks".into(),
        () => "The missing moment changes its sign: it helps at some bends and holds back at others".into(),
    };
    let range = if first.hold == last.hold && first.dataset == last.dataset {
        String::new()
    } else {
        format!(", {}", value(last))
    };
    vec![format!("{what}: {}{range}.", value(first))]
}
