//! Distances between the markers at rest against their stations: a wrong scale, a wrong station, two markers with one station.

use super::seen::{Doubt, Seen, minus, size};
use crate::import::median;
use crate::policy::SAME_STATION_M;
use crate::units::mm;

/// A straight distance is at most so much longer than the one along the body, and at least so much of it.
const RATIO: [f64; 2] = [0.8, 1.05];
/// Error of a station and of a place \[m\].
const ERROR_M: f64 = 0.005;

/// Two neighbours along the body are farther apart, or nearer, than their stations say.
pub(super) fn stations(seen: &Seen) -> Option<Doubt> {
    let mut known: Vec<(usize, f64)> =
        seen.markers.iter().enumerate().filter_map(|(k, (_, station))| Some((k, (*station)?))).collect();
    known.sort_by(|a, b| a.1.total_cmp(&b.1));
    let apart_m = |a: usize, b: usize| {
        let of = |run: &super::seen::SeenRun| {
            let places = &run.rest()?.places_m;
            Some(size(minus(places[a]?, places[b]?)))
        };
        median(seen.runs.iter().filter_map(of).collect())
    };
    for pair in known.windows(2) {
        let [(a, s0), (b, s1)] = [pair[0], pair[1]];
        let Some(apart_m) = apart_m(a, b) else { continue };
        let along_m = s1 - s0;
        let names = format!("{} and {}", seen.markers[a].0, seen.markers[b].0);
        let help =
            "correct the scale, or the stations: places along the undeformed body, with --stations or in about.toml";
        if along_m <= SAME_STATION_M && apart_m > ERROR_M {
            let message = format!(
                "markers {names} have one station, {:.1} mm, and are {:.1} mm apart at rest",
                mm(s0),
                mm(apart_m)
            );
            return Some(Doubt::new(message, help));
        }
        if apart_m > RATIO[1] * along_m + ERROR_M || apart_m < RATIO[0] * along_m - ERROR_M {
            let message = format!(
                "markers {names} are {:.1} mm apart at rest, and {:.1} mm by their stations",
                mm(apart_m),
                mm(along_m)
            );
            return Some(Doubt::new(message, help));
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::super::tests::{Made, refused, right};
    use super::stations;

    #[test]
    fn stations_that_contradict_the_places_are_refused() {
        let given =
            |stations_mm: [f64; 3]| move |made: &mut Made| made.stations_m = Some(stations_mm.map(|s| 1e-3 * s));
        refused(stations, given([90.0, 210.0, 210.0]), &["markers b and c have one station, 210.0 mm"]);
        refused(stations, given([90.0, 150.0, 330.0]), &["markers a and b are 120.", "60.0 mm by their stations"]);
        refused(stations, given([45.0, 105.0, 165.0]), &["by their stations", "scale"]);
        assert!(stations(&Made { stations_m: Some([0.09, 0.21, 0.33]), ..Made::new(2) }.seen()).is_none());
        right(stations);
    }
}
