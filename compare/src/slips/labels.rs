//! Labels of two markers exchanged, in every hold or where a tracker lost them.

use super::seen::{ANY_BASE, SlipSeen, told};
use crate::fit::numbers::least;
use crate::policy;
use crate::stats::quantile;
use crate::wording::list;

/// With more markers only near ones are tried: trackers confuse near markers.
const ALL_PAIRS: usize = 12;
/// How near, in places along the body.
const NEAR: usize = 3;

/// Two markers, and the (run, hold) in which they look exchanged with the sums of squares of both ways \[m²\].
struct Exchange {
    pair: [usize; 2],
    cells: Vec<(usize, usize)>,
    squares: [f64; 2],
}

pub(super) fn labels(seen: &mut SlipSeen) -> Vec<String> {
    let mut found: Vec<Exchange> = Vec::new();
    for run in 0..seen.points.len() {
        for hold in 0..seen.points[run].len() {
            let (pairs, squares) = exchanged(seen, &seen.points[run][hold]);
            for pair in pairs {
                seen.points[run][hold].swap(pair[0], pair[1]);
                let at = found.iter().position(|exchange| exchange.pair == pair).unwrap_or_else(|| {
                    found.push(Exchange { pair, cells: Vec::new(), squares: [0.0; 2] });
                    found.len() - 1
                });
                found[at].cells.push((run, hold));
                (0..2).for_each(|i| found[at].squares[i] += squares[i]);
            }
        }
    }
    found.iter().map(|exchange| words(seen, exchange)).collect()
}

/// Exchanges that together leave far less, with the sums of squares without and with them \[m²\].
fn exchanged(seen: &SlipSeen, points: &[[f64; 2]]) -> (Vec<[usize; 2]>, [f64; 2]) {
    let (mut points, mut pairs) = (points.to_vec(), Vec::new());
    let laid = seen.body.lay(&points, true).squares;
    let mut left = laid;
    while let Some((pair, after)) = best(seen, &points, left).filter(|_| pairs.len() < points.len()) {
        points.swap(pair[0], pair[1]);
        pairs.push(pair);
        left = after;
    }
    if !policy::is_far_less(left.sqrt(), laid.sqrt()) {
        pairs.clear();
    }
    (pairs, [laid, left])
}

/// The exchange that leaves least, if it takes away what two markers leave that are as far apart.
fn best(seen: &SlipSeen, points: &[[f64; 2]], left: f64) -> Option<([usize; 2], f64)> {
    let count = points.len();
    // Wherever a body is laid, two markers that are exchanged are off by half of their distance each, or more.
    let enough = |apart: f64| 2.0 * (0.5 * policy::FAR_LESS * apart).powi(2);
    if count < 3 || left < enough(2.0 * seen.half_apart()) {
        return None;
    }
    let off = seen.body.off(points);
    let (near, usual) = if count > ALL_PAIRS { (NEAR, median(&off)) } else { (count, 0.0) };
    let pairs = (0..count).flat_map(|a| (a + 1..count.min(a + 1 + near)).map(move |b| [a, b]));
    let apart = |pair: [usize; 2]| (seen.body.stations_m[pair[0]] - seen.body.stations_m[pair[1]]).abs();
    let pairs = pairs.filter(|pair| {
        let half = 0.5 * apart(*pair);
        policy::labels_are_clear(half, usual) && pair.iter().all(|marker| !policy::is_far_less(off[*marker], half))
    });
    let with = |pair: [usize; 2]| {
        let mut other = points.to_vec();
        other.swap(pair[0], pair[1]);
        (pair, seen.body.lay(&other, true).squares)
    };
    let (pair, after) = least(pairs.map(with), |(_, squares)| *squares)?;
    (left - after > enough(apart(pair)).max(f64::MIN_POSITIVE)).then_some((pair, after))
}

fn median(values: &[f64]) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    quantile(&sorted, 0.5).unwrap_or(0.0)
}

fn words(seen: &SlipSeen, Exchange { pair, cells, squares }: &Exchange) -> String {
    let [a, b] = pair.map(|marker| &seen.dataset.markers[marker].name);
    let holds = seen.dataset.holds.len();
    let mut runs: Vec<usize> = cells.iter().map(|(run, _)| *run).collect();
    runs.dedup();
    let of = |run: usize| cells.iter().filter(|(r, _)| *r == run).map(|(_, hold)| *hold).collect::<Vec<_>>();
    let which = of(runs[0]);
    let place = if runs.iter().any(|run| of(*run) != which) {
        list(runs.iter().map(|run| format!("{} ({})", seen.in_runs(&[*run]), ranges(&of(*run)))))
    } else {
        let at = if which.len() == holds { String::new() } else { format!(", {}", ranges(&which)) };
        format!("{}{at}", seen.in_runs(&runs))
    };
    let everywhere = cells.len() == seen.points.len() * holds;
    let stations = if everywhere { ", or their stations s_mm," } else { " of these rows" };
    let next = format!(
        "Look at the pictures; if so, exchange the two in the column marker{stations} before believing a diagnosis"
    );
    let rms_m = squares.map(|squares| seen.rms(squares, cells.len()));
    told(format!("markers {a} and {b} look exchanged {place}"), rms_m, ANY_BASE, "the labels set right", &next)
}

/// `hold 3`, `holds 1 to 4 and 7`, counted from 1.
fn ranges(holds: &[usize]) -> String {
    let word = |range: &[usize]| match *range {
        [only] => format!("{}", only + 1),
        _ => format!("{} to {}", range[0] + 1, range[range.len() - 1] + 1),
    };
    let words = list(holds.chunk_by(|a, b| a + 1 == *b).map(word));
    format!("{} {words}", if holds.len() == 1 { "hold" } else { "holds" })
}
