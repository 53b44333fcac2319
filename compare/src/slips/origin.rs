//! The origin of coordinates is not the base: every marker is off by the same, at every pressure.
//!
//! At the lowest pressure a robot is straight, or bent a little, and starts at the origin along x. What a camera, a mount or a
//! bend at rest do there grows from the base:
//!
//! ```text
//! (x, y) = (1 + c) · turned(φ) · (uniformly bent by κ)  +  (x₀, y₀)
//! ```
//!
//! with one κ per hold, one scale c and one angle φ. A constant (x₀, y₀) is in none of these, nor in any effect of the catalogue
//! (`marker_height` is nothing in a straight robot).

use super::{FAR_LESS, Seen, become_mm};
use crate::evaluate::default_tolerance_m;
use crate::stats::f_tail;
use crate::wording::{short, signed_mm};
use nalgebra::{DMatrix, DVector};

/// Chance of the shift where nothing is shifted, above which nothing is told.
const CHANCE: f64 = 1e-3;
/// Holds within this share of the highest pressure of the lowest are the lowest.
const LOWEST: f64 = 0.02;
/// Heading of the last marker beyond which a hold is not nearly straight \[rad\].
const NEARLY_STRAIGHT: f64 = 0.8;

pub(super) fn origin(seen: &mut Seen) -> Vec<String> {
    let holds = lowest(seen);
    let Some(shift) = shift(seen, &holds) else { return Vec::new() };
    let before = over_all(seen, [0.0; 2]);
    let after = over_all(seen, shift);
    if after >= before {
        return Vec::new();
    }
    let all = seen.points.len() * seen.dataset.holds.len();
    let [x, y] = shift.map(|value| signed_mm(1e3 * value));
    let at = short(1e-3 * seen.dataset.holds[holds[0]].p_act_pa);
    vec![format!(
        "the origin of coordinates looks shifted: at {at} kPa already every marker is off by x {x}, y {y} {}, and no scale, angle \
         or bend does that. Over all holds {} (rms from a uniformly bent robot that starts at the origin) with this taken off. \
         The origin is the middle of the robot at its base: look where yours is, and subtract that place from the columns x and y",
        seen.in_runs(&(0..seen.points.len()).collect::<Vec<_>>()),
        become_mm([before, after].map(|squares| seen.rms(squares, all)))
    )]
}

/// Nearly straight holds at the lowest pressure of the actuator.
fn lowest(seen: &Seen) -> Vec<usize> {
    let pressure = |hold: &usize| seen.dataset.holds[*hold].p_act_pa;
    let all = 0..seen.dataset.holds.len();
    let (low, high) =
        all.clone().fold((f64::INFINITY, 0.0), |(l, h): (f64, f64), i| (l.min(pressure(&i)), h.max(pressure(&i))));
    let longest = seen.body.stations_m.iter().fold(0.0, |l: f64, s| l.max(*s));
    let straight = |hold: &usize| {
        let heading = |run: &Vec<Vec<[f64; 2]>>| longest * seen.body.lay(&run[*hold], true).curvature.abs();
        seen.points.iter().all(|run| heading(run) < NEARLY_STRAIGHT)
    };
    all.filter(|hold| pressure(hold) <= low + LOWEST * high).filter(straight).collect()
}

/// Squared distances from uniformly bent bodies that start at a place, over all runs and holds \[m²\].
fn over_all(seen: &Seen, start: [f64; 2]) -> f64 {
    let moved = |points: &Vec<[f64; 2]>| points.iter().map(|p| [p[0] - start[0], p[1] - start[1]]).collect::<Vec<_>>();
    seen.points.iter().flatten().map(|points| seen.body.lay(&moved(points), false).squares).sum()
}

/// The shift that all of these holds have in all runs \[m\].
fn shift(seen: &Seen, holds: &[usize]) -> Option<[f64; 2]> {
    let (runs, markers) = (seen.points.len(), seen.body.stations_m.len());
    let values = 2 * markers * holds.len();
    let (without, with) = (2 + holds.len(), 4 + holds.len());
    if values <= with {
        return None;
    }
    let mut columns = DMatrix::zeros(values, with);
    let mut off = vec![DVector::zeros(values); runs];
    for (h, hold) in holds.iter().enumerate() {
        let mean = (0..markers)
            .map(|m| [0, 1].map(|axis| seen.points.iter().map(|run| run[*hold][m][axis]).sum::<f64>() / runs as f64));
        let curvature = seen.body.lay(&mean.collect::<Vec<_>>(), true).curvature;
        for (m, s) in seen.body.stations_m.iter().enumerate() {
            let [x, y] = seen.body.place(*s, curvature);
            let row = 2 * (h * markers + m);
            for (column, entry) in [[x, y], [-y, x], [1.0, 0.0], [0.0, 1.0]].into_iter().enumerate() {
                let column = if column < 2 { column } else { column - 2 + without };
                (0..2).for_each(|axis| columns[(row + axis, column)] = entry[axis]);
            }
            columns[(row + 1, 2 + h)] = 0.5 * s * s;
            for (run, off) in off.iter_mut().enumerate() {
                let point = seen.points[run][*hold][m];
                off[row] = point[0] - x;
                off[row + 1] = point[1] - y;
            }
        }
    }
    let mean = off.iter().fold(DVector::zeros(values), |sum: DVector<f64>, off| sum + off) / runs as f64;
    let grown = columns.columns(0, without).into_owned();
    let (least_grown, least) = (solve(&grown, &mean)?, solve(&columns, &mean)?);
    let left = |columns: &DMatrix<f64>, solved: &DVector<f64>| -> f64 {
        let model = columns * solved;
        off.iter().map(|off| (off - &model).norm_squared()).sum()
    };
    let (before, after) = (left(&grown, &least_grown), left(&columns, &least));
    let dof = runs * values - with;
    let unit = after / dof as f64;
    let p = f_tail((before - after) / 2.0 / unit.max(f64::MIN_POSITIVE), 2, dof);
    let far_less = unit.sqrt() < FAR_LESS * (before / (runs * values - without) as f64).sqrt();
    let shift = [least[without], least[without + 1]];
    let size = shift[0].hypot(shift[1]);
    // Every run by itself is nearer to the shift than to none.
    let own = |off: &DVector<f64>| solve(&columns, off).map(|own| [own[without], own[without + 1]]);
    let in_all =
        off.iter().filter_map(own).all(|own| (own[0] - shift[0]).hypot(own[1] - shift[1]) < own[0].hypot(own[1]));
    (p < CHANCE && far_less && in_all && size > tolerance(seen)).then_some(shift)
}

/// What is too small to matter: as in comparisons, of the farthest way of a marker.
fn tolerance(seen: &Seen) -> f64 {
    let mut most: f64 = 0.0;
    for run in &seen.points {
        for points in run {
            for (point, first) in points.iter().zip(&run[0]) {
                most = most.max((point[0] - first[0]).hypot(point[1] - first[1]));
            }
        }
    }
    default_tolerance_m(most)
}

fn solve(columns: &DMatrix<f64>, values: &DVector<f64>) -> Option<DVector<f64>> {
    columns.clone().svd(true, true).solve(values, 1e-12).ok()
}
