//! How far a robot is from the parts of a wish.

use super::wish::Wish;
use serde::{Serialize, Serializer};
use spelling::si;

/// One part of the wish and how far it is missed.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Miss {
    /// What: `tip`, `tip angle`, `station 150 mm`, `turn 0 to 100 mm`.
    pub what: String,
    /// Target: x, y \[m\], or one angle \[rad\]; written in mm or degrees.
    #[serde(serialize_with = "written")]
    pub wanted: Vec<f64>,
    /// Value that the robot has, in the order of the target.
    #[serde(serialize_with = "written")]
    pub found: Vec<f64>,
    /// Distance \[m\], or angle times length.
    #[serde(rename = "miss_mm", serialize_with = "si::mm")]
    pub miss_m: f64,
}

fn written<S: Serializer>(values: &[f64], to: S) -> Result<S::Ok, S::Error> {
    let all: Vec<f64> = match values {
        [rad] => vec![rad.to_degrees()],
        more => more.iter().map(|m| 1e3 * m).collect(),
    };
    all.serialize(to)
}

impl Miss {
    pub(super) fn new(what: String, wanted: Vec<f64>, found: Vec<f64>, length_m: f64) -> Miss {
        let miss_m = match (&wanted[..], &found[..]) {
            ([a, b], [x, y]) => (a - x).hypot(b - y),
            ([angle], [found]) => (angle - found).abs() * length_m,
            _ => f64::NAN,
        };
        Miss { what, wanted, found, miss_m }
    }
}

/// The largest miss \[m\]; 0 without any.
pub(super) fn worst_m<'a>(misses: impl IntoIterator<Item = &'a Miss>) -> f64 {
    misses.into_iter().map(|miss| miss.miss_m).fold(0.0, f64::max)
}

/// Every part of a wish for a robot of a length, of which tip, angle, stations and headings are known.
pub(super) fn parts(
    wish: &Wish,
    length_m: f64,
    tip_m: [f64; 2],
    angle_rad: f64,
    place: &dyn Fn(f64) -> [f64; 2],
    heading: &dyn Fn(f64) -> f64,
) -> Vec<Miss> {
    let distance = |what, wanted: [f64; 2], found: [f64; 2]| Miss::new(what, wanted.to_vec(), found.to_vec(), length_m);
    let angle = |what, wanted: f64, found: f64| Miss::new(what, vec![wanted], vec![found], length_m);
    let mm = |m: f64| compare::wording::short(1e3 * m);
    let wanted = &wish.wanted;
    let tip = wanted.tip_m.map(|tip| distance("tip".into(), tip, tip_m));
    let turned = wanted.tip_angle_rad.map(|a| angle("angle of the tip".into(), a, angle_rad));
    let places = wanted.places.iter().map(|p| distance(format!("station {} mm", mm(p.s_m)), p.at_m, place(p.s_m)));
    let turns = wanted.turns.iter().map(|t| {
        let [from, to] = t.between_m;
        angle(format!("turn from {} to {} mm", mm(from), mm(to)), t.angle_rad, heading(to) - heading(from))
    });
    tip.into_iter().chain(turned).chain(places).chain(turns).collect()
}

/// How far tip and stations of another engine miss the wish; stations between those that it read lie on a line. Turns are not read.
pub fn misses_of_reading(
    wish: &Wish,
    length_m: f64,
    stations_m: &[f64],
    places_m: &[[f64; 2]],
    angle_rad: f64,
) -> Vec<Miss> {
    let with_base: Vec<(f64, [f64; 2])> =
        std::iter::once((0.0, [0.0; 2])).chain(stations_m.iter().copied().zip(places_m.iter().copied())).collect();
    let place = |s_m: f64| {
        let after = with_base.iter().position(|(s, _)| *s >= s_m).unwrap_or(with_base.len() - 1).max(1);
        let Some(([(a, from), (b, to)], _)) = with_base.get(after - 1..).and_then(|rest| rest.split_first_chunk::<2>())
        else {
            return [f64::NAN; 2];
        };
        let share = if b > a { ((s_m - a) / (b - a)).clamp(0.0, 1.0) } else { 0.0 };
        [0, 1].map(|k| from[k] + share * (to[k] - from[k]))
    };
    let tip_m = places_m.last().copied().unwrap_or([f64::NAN; 2]);
    let all = parts(wish, length_m, tip_m, angle_rad, &place, &|_| f64::NAN);
    all.into_iter().filter(|miss| !miss.miss_m.is_nan()).collect()
}
