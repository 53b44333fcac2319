//! A robot with strips round the body as it is seen from two sides, with the lines to draw \[m\].

use ibr::{AtPressure, Predictor};
use models::scenario::ActuatorChoice;
use models::space::Frame;
use serde_json::{Value, json};
use std::f64::consts::{PI, TAU};

const PIECES: usize = 24;
/// Points of a unit along and across it.
const GRID: [usize; 2] = [9, 7];
const RING: usize = 32;
/// Of a unit vector: smaller components count as seen end-on.
const END_ON: f64 = 1e-9;

/// A view: x to the right, and the axis that is up.
#[derive(Clone, Copy)]
struct SideView {
    axis: &'static str,
    up: usize,
    toward: [f64; 3],
}

const SIDES: [SideView; 2] =
    [SideView { axis: "y", up: 1, toward: [0.0, 0.0, 1.0] }, SideView { axis: "z", up: 2, toward: [0.0, -1.0, 0.0] }];

impl SideView {
    fn flat(self, place: [f64; 3]) -> [f64; 2] {
        [place[0], place[self.up]]
    }

    fn is_near(self, direction: [f64; 3]) -> bool {
        direction.iter().zip(self.toward).map(|(a, b)| a * b).sum::<f64>() > -END_ON
    }

    /// Both edges of the body: a tube is seen a radius to either side of its centre line.
    fn edges(self, frames: &[Frame], radius_m: f64) -> [Vec<[f64; 2]>; 2] {
        let (mut across, mut edges) = ([0.0, 1.0], [Vec::new(), Vec::new()]);
        for frame in frames {
            let ([x, up], [along, rise]) = (self.flat(frame.at), self.flat(frame.tangent));
            let size = along.hypot(rise);
            if size > END_ON {
                across = [-rise / size, along / size];
            }
            for (edge, r) in edges.iter_mut().zip([radius_m, -radius_m]) {
                edge.push([x + r * across[0], up + r * across[1]]);
            }
        }
        edges
    }
}

/// The body from both sides, and where the centre line ends; with `units`, every unit of every strip.
pub fn views(of: &Predictor, state: &AtPressure, stations: usize, with_units: bool) -> Option<Value> {
    let (scenario, model, at) = (&of.scenario, &of.model, &state.prediction);
    let station = |i: usize| scenario.length_m * i as f64 / (stations - 1) as f64;
    let frames = (0..stations).map(|i| model.frame_at(at, station(i))).collect::<Option<Vec<_>>>()?;
    let (tip, radius_m) = (frames.last()?, scenario.radius_m);
    let ring: Vec<[f64; 3]> = (0..RING).map(|k| on_wall(tip, TAU * k as f64 / RING as f64, radius_m)).collect();
    let strips = scenario.strips().enumerate().filter(|_| with_units);
    let units: Vec<WallUnit> = strips.flat_map(|(i, strip)| placed(of, state, i, strip)).collect();
    let view = |side: SideView| {
        let seen = |unit: &WallUnit| {
            let outline = hull(unit.points.iter().map(|p| side.flat(*p)).collect());
            json!({"outline": outline, "is_near": side.is_near(unit.outward)})
        };
        json!({
            "axis": side.axis, "sides": side.edges(&frames, radius_m), "units": units.iter().map(seen).collect::<Vec<_>>(),
            "ring": ring.iter().map(|p| side.flat(*p)).collect::<Vec<_>>(), "is_ring_near": side.is_near(tip.tangent),
        })
    };
    Some(json!(SIDES.map(view)))
}

/// A point off the centre line, at an azimuth.
fn on_wall(frame: &Frame, azimuth_rad: f64, from_axis_m: f64) -> [f64; 3] {
    let (sin, cos) = azimuth_rad.sin_cos();
    let [y, z] = frame.sides;
    std::array::from_fn(|k| frame.at[k] + from_axis_m * (cos * y[k] + sin * z[k]))
}

/// A unit on the wall: points all over it, and the way out in its middle.
struct WallUnit {
    points: Vec<[f64; 3]>,
    outward: [f64; 3],
}

/// The units of a strip: pouches as lenses of their height, a muscle as a tube in pieces.
fn placed(of: &Predictor, state: &AtPressure, index: usize, strip: &ActuatorChoice) -> Vec<WallUnit> {
    let (scenario, model, at) = (&of.scenario, &of.model, &state.prediction);
    let (radius_m, is_pouch) = (scenario.radius_m, strip.kind.has_pouches());
    let count = if is_pouch { strip.count } else { PIECES };
    let (length_m, covered_m) = (strip.strip_m() / count as f64, strip.covered_m(radius_m));
    let width_m = if is_pouch { strip.shape.width_m } else { 2.0 * strip.shape.width_m / PI };
    let (cos, sin) = (strip.cos_slant(radius_m), strip.sin_slant(radius_m));
    let in_wall = strip.in_wall();
    let unit = |i: usize| {
        let middle_m = strip.start_m + covered_m * (i as f64 + 0.5) / count as f64;
        let (azimuth, height_m) = (strip.azimuth_at(radius_m, middle_m), model.strip_height_m(at, index, middle_m));
        // From -1 to 1 along and across the unit.
        let point = |u: f64, w: f64| {
            let (along_m, across_m) = (0.5 * u * length_m, 0.5 * w * width_m);
            let s_m = (middle_m + along_m * cos - across_m * sin).clamp(0.0, scenario.length_m);
            let round = if is_pouch { 1.0 - u * u } else { 1.0 };
            let lift_m = height_m * round * (1.0 - w * w).sqrt() * if in_wall { 0.5 } else { 1.0 };
            let azimuth = azimuth + (along_m * sin + across_m * cos) / radius_m;
            Some(on_wall(&model.frame_at(at, s_m)?, azimuth, radius_m + lift_m))
        };
        let step = |i: usize, of: usize| 2.0 * i as f64 / (of - 1) as f64 - 1.0;
        let all = (0..GRID[0] * GRID[1]).map(|k| point(step(k / GRID[1], GRID[0]), step(k % GRID[1], GRID[1])));
        let frame = model.frame_at(at, middle_m)?;
        let wall = on_wall(&frame, azimuth, 1.0);
        Some(WallUnit { points: all.collect::<Option<_>>()?, outward: std::array::from_fn(|k| wall[k] - frame.at[k]) })
    };
    (0..count).filter_map(unit).collect()
}

/// The convex hull of points, counter-clockwise.
fn hull(mut points: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    points.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    let left =
        |a: [f64; 2], b: [f64; 2], c: [f64; 2]| (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]) > 0.0;
    let chain = |points: &mut dyn Iterator<Item = [f64; 2]>| {
        let mut chain: Vec<[f64; 2]> = Vec::new();
        for point in points {
            while chain.len() > 1 && !left(chain[chain.len() - 2], chain[chain.len() - 1], point) {
                chain.pop();
            }
            chain.push(point);
        }
        chain.pop();
        chain
    };
    let below = chain(&mut points.iter().copied());
    [below, chain(&mut points.iter().rev().copied())].concat()
}

#[cfg(test)]
mod tests {
    use super::*;
    use ibr::ScenarioFile;

    fn seen(more: &str) -> (Predictor, AtPressure, Value) {
        let text = models::shipped("epam-textbook").unwrap().replace("count = 6", &format!("count = 6\n{more}"));
        let of = Predictor::new(&ScenarioFile::parse("robot", &text).unwrap());
        let state = of.state(&of.loads(None, &[20e3]).unwrap()).unwrap();
        let views = views(&of, &state, 97, true);
        (of, state, json!(views))
    }

    fn points(value: &Value) -> Vec<[f64; 2]> {
        serde_json::from_value(value.clone()).unwrap()
    }

    #[test]
    fn a_strip_towards_z_is_seen_as_the_planar_robot() {
        let (planar, at, none) = seen("");
        assert!(none.is_null(), "one side is enough");
        let wanted = planar.model.outline(&at.prediction, 97);
        let (_, _, views) = seen("azimuth_deg = 90");
        assert_eq!([&views[0]["axis"], &views[1]["axis"]], ["y", "z"]);
        for (wanted, found) in wanted.iter().zip(views[1]["sides"].as_array().unwrap()) {
            let close = |(a, b): (&[f64; 2], &[f64; 2])| (a[0] - b[0]).abs() < 1e-12 && (a[1] - b[1]).abs() < 1e-12;
            assert!(wanted.iter().zip(&points(found)).all(close));
        }
        // The strip faces a viewer along z, and is at the upper edge of the other side.
        let units = |view: usize| views[view]["units"].as_array().unwrap();
        assert!(units(0).len() == 6 && units(0).iter().all(|unit| unit["is_near"] == true));
        let highest = |view: usize| points(&units(view)[0]["outline"]).iter().map(|p| p[1]).fold(f64::MIN, f64::max);
        assert!(highest(1) > 0.04 && highest(0) < 0.03, "{} {}", highest(1), highest(0));
    }

    #[test]
    fn a_hull_leaves_out_what_is_inside() {
        let square = [[0.0, 0.0], [1.0, 1.0], [0.5, 0.5], [0.0, 1.0], [0.5, 0.0], [1.0, 0.0]];
        assert_eq!(hull(square.to_vec()), [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]);
    }
}
