//! Distances between the markers at rest, run against run: a camera with another zoom or distance in one of them.

use super::seen::{Doubt, Seen, mean, minus, size};
use crate::import::median;
use crate::units::mm;

/// Largest departure of a run from the others.
const MOST: f64 = 0.02;
/// And the largest in length: markers may be near to each other \[m\].
const MOST_M: f64 = 0.002;

/// The mean distance of the markers from their centre at rest differs in one run.
pub(super) fn zoom(seen: &Seen) -> Option<Doubt> {
    let spread = |places: Vec<[f64; 3]>| {
        let centre = mean(&places);
        places.iter().map(|place| size(minus(*place, centre))).sum::<f64>() / places.len() as f64
    };
    let spreads: Option<Vec<f64>> = seen.runs.iter().map(|run| run.at_rest().map(spread)).collect();
    let spreads = spreads.filter(|spreads| spreads.len() > 1 && seen.markers.len() > 1)?;
    let usual = median(spreads.clone())?;
    let off = |run: usize| spreads[run] - usual;
    let farthest = (0..spreads.len()).max_by(|a, b| off(*a).abs().total_cmp(&off(*b).abs()))?;
    if off(farthest).abs() <= MOST_M.max(MOST * usual) {
        return None;
    }
    let message = format!(
        "run {}: at rest the markers are {:.1} mm from their centre and {:.1} mm in the other runs, {:+.1} %: the camera had another zoom or \
         distance",
        seen.runs[farthest].label,
        mm(spreads[farthest]),
        mm(usual),
        100.0 * off(farthest) / usual
    );
    Some(Doubt::new(message, "import this run separately with its own --scale, or leave it out"))
}

#[cfg(test)]
mod tests {
    use super::super::tests::{Made, refused, right};
    use super::zoom;

    #[test]
    fn a_camera_with_another_zoom_in_one_run_is_refused() {
        let zoomed = |made: &mut Made| {
            made.each(|run, _, _, place| {
                if run == 2 {
                    *place = place.map(|v| 1.05 * v)
                }
            })
        };
        refused(zoom, zoomed, &["run 3: at rest", "in the other runs, +4.9 %", "--scale"]);
        right(zoom);
    }
}
