//! The numbers by which a table is refused, cut into holds or doubted. Each is described with its unit; `tests/policy.sh` moves
//! every one of them and names the tests that fail then.

/// An inflated robot whose farthest marker is nearer than this to its base does not exist \[m\].
pub(crate) const SHORTEST_ROBOT_M: f64 = 0.002;
/// Longest robot in one camera picture \[m\].
pub(crate) const LONGEST_ROBOT_M: f64 = 20.0;
/// No robot is this long \[m\]; a larger coordinate is a unit mistake.
pub(crate) const FARTHEST_M: f64 = 1e3;
/// Downward motion of the last marker at the highest pressure that cannot be noise \[m\].
pub(crate) const SURELY_DOWN_M: f64 = 0.005;
/// Below this the mean of a hold is not the noise of a sensor at zero \[Pa\] (the step that separates holds).
pub(crate) const LOWEST_GAUGE_PA: f64 = -500.0;
/// No inflated fabric withstands this gauge pressure \[Pa\]; a higher one is a unit mistake.
pub(crate) const HIGHEST_GAUGE_PA: f64 = 1e6;
/// Largest body and actuator pressure, as numbers in the kPa columns, that look like psi.
pub(crate) const LIKE_PSI: [f64; 2] = [0.6, 7.0];
/// Largest body and actuator pressure, as numbers in the kPa columns, that look like bar.
pub(crate) const LIKE_BAR: [f64; 2] = [0.06, 1.0];
/// Largest body and actuator pressure, as numbers in the kPa columns, that look like MPa.
pub(crate) const LIKE_MPA: [f64; 2] = [0.006, 0.1];

/// A pressure stays inside one hold within this share of it.
pub(crate) const SAME_PRESSURE: f64 = 0.05;
/// And the actuator's within this \[Pa\].
pub(crate) const SAME_ACTUATOR_PA: f64 = 500.0;
/// And the body's within this \[Pa\].
pub(crate) const SAME_BODY_PA: f64 = 200.0;
/// Two stations of one marker closer than this are one \[m\].
pub(crate) const SAME_STATION_M: f64 = 1e-6;
/// Stations from the file and from `about.toml` may differ by rounding only \[m\].
pub(crate) const ROUNDED_STATION_M: f64 = 5e-4;
/// Times that begin later than this are a clock and not a time since the start of a run \[s\].
pub(crate) const LATEST_START_S: f64 = 3600.0;
/// Holds this far apart are of a clock in milliseconds, or of a very patient experiment \[s\].
pub(crate) const PATIENT_S: f64 = 1000.0;
/// A marker seen in less than this share of a hold's usual number of frames was lost there.
pub(crate) const SEEN_ENOUGH: f64 = 0.5;
/// A place that is farther from all others of a marker is not its own \[m\].
pub(crate) const ELSEWHERE_M: f64 = 0.01;
/// Robust z above which a sample is listed.
pub(crate) const OUTLIER_Z: f64 = 6.0;
/// Deviations below this are never outliers: far below any camera \[m\].
pub(crate) const SURELY_FINE_M: f64 = 1e-5;

/// Runs that are read at once.
pub(crate) const MOST_RUNS: usize = 10_000;
/// Markers that are read at once.
pub(crate) const MOST_MARKERS: usize = 1_000;
/// Holds of one (run, marker) stream; a protocol has tens, a flickering phase column millions.
pub(crate) const MOST_HOLDS: usize = 1_000;
/// Holds of all streams together: bounds memory at about 2 GB whatever the file.
pub(crate) const MOST_SERIES: usize = 1_000_000;

/// A table of a Parquet file takes at most this \[bytes\]; its file and the readings of its runs come on top.
#[cfg(feature = "parquet")]
pub(crate) const MOST_TABLE_BYTES: usize = 600_000_000;

/// Fewest rows of a specimen: three for a slope and as many for its shape.
pub(crate) const FEWEST_ROWS: usize = 6;
/// Steps back below this share of the range are the noise of the displacement sensor.
pub(crate) const JITTER: f64 = 2e-3;
/// Longest step back of unloading, as a share of the range; a longer one is another specimen or a row at the wrong place.
pub(crate) const LARGEST_STEP: f64 = 0.2;
/// Strain above which a coated fabric has broken; more is a unit mistake.
pub(crate) const LARGEST_STRAIN: f64 = 3.0;

/// A fabric is thinner than this \[m\].
pub(crate) const THICKEST_FABRIC_M: f64 = 0.02;
/// No specimen is longer or wider \[m\].
pub(crate) const LARGEST_SPECIMEN_M: f64 = 10.0;
/// A known force on a tip above this is a unit mistake \[N\].
pub(crate) const LARGEST_TIP_FORCE_N: f64 = 1e3;

/// Largest size of a specimen: its `thickness`, or another \[m\].
pub(crate) fn largest_m(size: &str) -> f64 {
    if size == "thickness" { THICKEST_FABRIC_M } else { LARGEST_SPECIMEN_M }
}

/// The message for stations \[m\] that are all the same.
pub(crate) fn one_station(stations_m: &[f64]) -> Option<String> {
    let first = *stations_m.first()?;
    let same = stations_m.len() > 1 && stations_m.iter().all(|s| (s - first).abs() <= SAME_STATION_M);
    same.then(|| format!("all {} markers have the station {} mm", stations_m.len(), first * 1e3))
}

pub(crate) const SAME_STATION: &str = "write for each marker its own distance from the base along the undeformed body";

/// Tolerance of the actuator pressure inside one hold \[Pa\]: max(0.5 kPa, 5 %).
pub(crate) fn tolerance_act_pa(mean_pa: f64) -> f64 {
    (SAME_PRESSURE * mean_pa).max(SAME_ACTUATOR_PA)
}

/// Tolerance of the body pressure inside one hold \[Pa\]: max(0.2 kPa, 5 %).
pub(crate) fn tolerance_body_pa(mean_pa: f64) -> f64 {
    (SAME_PRESSURE * mean_pa).max(SAME_BODY_PA)
}

/// Whether a place so far from another of the same marker is elsewhere \[m\].
pub(crate) fn is_elsewhere(distance_m: f64) -> bool {
    distance_m > ELSEWHERE_M
}

/// Whether a stream with so many holds, in a file with so many in all, may not have one more.
pub(crate) fn is_full(holds: usize, in_all: usize) -> bool {
    holds >= MOST_HOLDS || in_all >= MOST_SERIES
}

/// What a sensor of absolute pressure reads in the air of a room, from the mountains to the sea \[Pa\].
pub(crate) const ROOM_PA: [f64; 2] = [80e3, 110e3];

/// Whether a pressure is the air pressure of a room \[Pa\].
///
/// ```
/// assert!(data::is_a_room(101_325.0) && !data::is_a_room(20e3));
/// ```
pub fn is_a_room(pressure_pa: f64) -> bool {
    (ROOM_PA[0]..=ROOM_PA[1]).contains(&pressure_pa)
}

#[cfg(test)]
mod tests {
    use super::{is_a_room, is_elsewhere, is_full, largest_m};

    #[test]
    fn the_air_of_a_room_is_that_between_mountain_and_sea() {
        assert_eq!([79e3, 81e3, 109e3, 111e3].map(is_a_room), [false, true, true, false]);
    }

    #[test]
    fn a_fabric_is_thinner_than_two_centimetres_and_a_specimen_shorter_than_ten_metres() {
        assert_eq!([largest_m("thickness"), largest_m("length")], [0.02, 10.0]);
    }

    #[test]
    fn a_thousand_holds_are_read_of_a_stream_and_a_million_of_a_file() {
        assert_eq!(
            [(999, 5), (1000, 5), (5, 999_999), (5, 1_000_000)].map(|(own, all)| is_full(own, all)),
            [false, true, false, true]
        );
    }

    #[test]
    fn a_marker_is_elsewhere_beyond_a_centimetre() {
        assert_eq!([9e-3, 11e-3].map(is_elsewhere), [false, true]);
    }
}
