//! Distances between the markers at rest against their stations: a wrong scale, a wrong station, two markers with one station.

use super::seen::{Doubt, Seen, minus, size};
use crate::import::median;
use crate::policy::SAME_STATION_M;
use crate::units::mm;

/// A straight distance is at most so much longer than the one along the body, and at least so much of it where the robot is bent.
const RATIO: [f64; 2] = [0.8, 1.05];
/// Error of a station and of a place \[m\].
const ERROR_M: f64 = 0.005;

/// A robot is straight at rest below this actuator pressure \[Pa\], and the straight distance then at least this part of the distance along the body.
const STRAIGHT_PA: f64 = 1e3;
const STRAIGHT: f64 = 0.95;
/// Error of a base; markers on the surface are a radius away from the axis \[m\].
const FROM_BASE_M: f64 = 0.03;

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
    let straight =
        seen.runs.iter().filter_map(super::seen::SeenRun::rest).all(|rest| rest.pressures_pa[1] < STRAIGHT_PA);
    let least = if straight { STRAIGHT } else { RATIO[0] };
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
        if apart_m > RATIO[1] * along_m + ERROR_M || apart_m < least * along_m - ERROR_M {
            let message = format!(
                "markers {names} are {:.1} mm apart at rest, and {:.1} mm by their stations",
                mm(apart_m),
                mm(along_m)
            );
            return Some(Doubt::new(message, help));
        }
    }
    from_base(seen, &known, least)
}

/// A marker is at rest where its station is not: stations that were counted from elsewhere, or in another unit.
fn from_base(seen: &Seen, known: &[(usize, f64)], least: f64) -> Option<Doubt> {
    let away_m =
        |marker: usize| median(seen.runs.iter().filter_map(|run| Some(size(run.rest()?.places_m[marker]?))).collect());
    known.iter().find_map(|(marker, station_m)| {
        let away_m = away_m(*marker)?;
        let allowed = least * station_m - FROM_BASE_M..=RATIO[1] * station_m + FROM_BASE_M;
        let message = format!(
            "marker {} is {:.1} mm from the base at rest, and {:.1} mm by its station",
            seen.markers[*marker].0,
            mm(away_m),
            mm(*station_m)
        );
        let help =
            "correct --base, the scale, or the stations: places along the undeformed body, counted from the base";
        (!allowed.contains(&away_m)).then(|| Doubt::new(message, help))
    })
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
        refused(stations, given([103.0, 240.0, 377.0]), &["markers a and b are 1", "137.0 mm by their stations"]);
        refused(stations, given([45.0, 105.0, 165.0]), &["by their stations", "scale"]);
        refused(stations, given([270.0, 150.0, 30.0]), &["marker c is 33", "30.0 mm by its station", "--base"]);
        refused(stations, given([150.0, 270.0, 390.0]), &["by its station"]);
        assert!(stations(&Made { stations_m: Some([0.09, 0.21, 0.33]), ..Made::new(2) }.seen()).is_none());
        right(stations);
    }
}
