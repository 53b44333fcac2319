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

use super::seen::{SlipSeen, become_mm};
use crate::fit::numbers::mean;
use crate::policy;
use crate::stats::f_tail;
use crate::wording::{list, short};
use nalgebra::{DMatrix, DVector};

pub(super) fn origin(seen: &mut SlipSeen) -> Vec<String> {
    let holds = lowest(seen);
    let Some(shift) = shift(seen, &holds) else { return Vec::new() };
    let before = over_all(seen, [0.0; 2]);
    let after = over_all(seen, shift);
    if after >= before {
        return Vec::new();
    }
    let (runs, tolerance) = (seen.points.len(), tolerance(seen));
    let large = ["x", "y"].into_iter().zip(shift).filter(|(_, value)| value.abs() > tolerance);
    let columns = list(large.map(|(name, m)| format!("{:.1} mm from column {name}", 1e3 * m)));
    let [x, y] = shift.map(|m| 1e3 * m);
    let at = short(1e-3 * seen.dataset.holds[holds[0]].p_act_pa);
    let in_runs = seen.in_runs(&(0..runs).collect::<Vec<_>>());
    let become_mm = become_mm([before, after].map(|squares| seen.rms(squares, runs * seen.dataset.holds.len())));
    vec![format!(
        "the origin of coordinates looks shifted: at {at} kPa already every marker is off by x {x:+.1} mm, y {y:+.1} mm \
         {in_runs}, and no scale, angle or bend does that; with it subtracted from all holds, {become_mm} (rms from a uniformly bent \
         robot that starts at the origin). The origin is the middle of the robot at its base: find it in the pictures; if it is \
         there, subtract {columns}"
    )]
}

fn lowest(seen: &SlipSeen) -> Vec<usize> {
    let pressure = |hold: &usize| seen.dataset.holds[*hold].p_act_pa;
    let all = 0..seen.dataset.holds.len();
    let low = all.clone().map(|hold| pressure(&hold)).fold(f64::INFINITY, f64::min);
    let high = all.clone().map(|hold| pressure(&hold)).fold(0.0, f64::max);
    let heading = |points: &[[f64; 2]]| seen.body.longest_m() * seen.body.lay(points, true).curvature.abs();
    let straight = |hold: &usize| seen.points.iter().all(|run| policy::is_nearly_straight(heading(&run[*hold])));
    all.filter(|hold| policy::is_lowest(pressure(hold), [low, high])).filter(straight).collect()
}

/// Squared distances from uniformly bent bodies that start at a place, over all runs and holds \[m²\].
fn over_all(seen: &SlipSeen, start: [f64; 2]) -> f64 {
    let moved = |points: &Vec<[f64; 2]>| points.iter().map(|p| [p[0] - start[0], p[1] - start[1]]).collect::<Vec<_>>();
    seen.points.iter().flatten().map(|points| seen.body.lay(&moved(points), false).squares).sum()
}

/// The shift that all of these holds have in all runs \[m\].
fn shift(seen: &SlipSeen, holds: &[usize]) -> Option<[f64; 2]> {
    let Straight { grown, shifted, runs } = straight(seen, holds);
    let (values, without, with) = (shifted.nrows(), grown.ncols(), shifted.ncols());
    if values <= with {
        return None;
    }
    let mean = runs.iter().fold(DVector::zeros(values), |sum: DVector<f64>, run| sum + run) / runs.len() as f64;
    let (least_grown, least) = (solve(&grown, &mean)?, solve(&shifted, &mean)?);
    let squares = |values: &DVector<f64>, columns: &DMatrix<f64>, solved: &DVector<f64>| {
        (values - columns * solved).norm_squared()
    };
    let of_mean = [squares(&mean, &grown, &least_grown), squares(&mean, &shifted, &least)];
    let [before, after] = [of_mean[0] / (values - without) as f64, of_mean[1] / (values - with) as f64];
    let of_runs = runs.iter().map(|run| squares(run, &shifted, &least)).sum::<f64>();
    let fall = runs.len() as f64 * (of_mean[0] - of_mean[1]);
    let dof = runs.len() * values - with;
    let p = f_tail(fall / 2.0 / (of_runs / dof as f64).max(f64::MIN_POSITIVE), 2, dof);
    let taken = |solved: &DVector<f64>| [solved[without], solved[without + 1]];
    let shift = taken(&least);
    // Every single run is nearer to the shift than to none.
    let own = |run: &DVector<f64>| solve(&shifted, run).map(|solved| taken(&solved));
    let in_all =
        runs.iter().filter_map(own).all(|own| (own[0] - shift[0]).hypot(own[1] - shift[1]) < own[0].hypot(own[1]));
    let matters = shift[0].hypot(shift[1]) > tolerance(seen);
    (policy::is_a_shift([before, after], p) && in_all && matters).then_some(shift)
}

/// The nearly straight robot as a linear law.
struct Straight {
    /// Columns that grow from the base: scale, angle, a bend in every hold.
    grown: DMatrix<f64>,
    /// The same columns with shifts x₀ and y₀ of the origin added.
    shifted: DMatrix<f64>,
    /// Distances from the bent bodies, per run \[m\].
    runs: Vec<DVector<f64>>,
}

fn straight(seen: &SlipSeen, holds: &[usize]) -> Straight {
    let (runs, markers) = (seen.points.len(), seen.body.stations_m.len());
    let (values, without) = (2 * markers * holds.len(), 2 + holds.len());
    let mut shifted = DMatrix::zeros(values, without + 2);
    let mut off = vec![DVector::zeros(values); runs];
    for (h, hold) in holds.iter().enumerate() {
        let of = |m: usize| [0, 1].map(|axis| mean(seen.points.iter().map(|run| run[*hold][m][axis])));
        let curvature = seen.body.lay(&(0..markers).map(of).collect::<Vec<_>>(), true).curvature;
        for (m, s) in seen.body.stations_m.iter().enumerate() {
            let place = seen.body.place(*s, curvature);
            let [x, y] = place;
            let columns = [(0, [x, y]), (1, [-y, x]), (2 + h, [0.0, 0.5 * s * s])];
            for axis in 0..2 {
                let row = 2 * (h * markers + m) + axis;
                columns.iter().for_each(|(column, entry)| shifted[(row, *column)] = entry[axis]);
                shifted[(row, without + axis)] = 1.0;
                off.iter_mut().zip(&seen.points).for_each(|(off, run)| off[row] = run[*hold][m][axis] - place[axis]);
            }
        }
    }
    Straight { grown: shifted.columns(0, without).into_owned(), shifted, runs: off }
}

/// Largest shift that does not matter \[m\]: as in comparisons, a share of the farthest way of a marker.
fn tolerance(seen: &SlipSeen) -> f64 {
    let pairs = seen.points.iter().flat_map(|run| run.iter().flat_map(|points| points.iter().zip(&run[0])));
    let moved = pairs.map(|(point, first)| (point[0] - first[0]).hypot(point[1] - first[1]));
    policy::tolerance_m(moved.fold(0.0, f64::max))
}

fn solve(columns: &DMatrix<f64>, values: &DVector<f64>) -> Option<DVector<f64>> {
    columns.clone().svd(true, true).solve(values, 1e-12).ok()
}
