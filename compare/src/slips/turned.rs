//! Slips of a whole run: axes turned over or exchanged, numbers from the tip, another unit of length.
//!
//! Looked for without the origin, so that a picture's corner may be it: markers about their mean, against bodies that head
//! along x. Two ways that are alike for a straight robot (x turned over, numbers from the tip) differ when it bends, or by the base.
//! y turned over in all runs is refused where the table is read; in some runs it is seen by the others.

use super::seen::{ANY_BASE, SlipSeen, told};
use crate::fit::numbers::{groups, least, mean};
use crate::policy;

/// Factor on the numbers, if they are as the words say.
const UNITS: [(f64, &str); 7] = [
    (10.0, "cm under a header of mm"),
    (1000.0, "metres under a header of mm"),
    (25.4, "inches under a header of mm"),
    (100.0, "metres under a header of cm"),
    (0.1, "mm under a header of cm"),
    (0.01, "cm under a header of m"),
    (0.001, "mm under a header of m"),
];

#[derive(Debug, Clone, Copy, PartialEq)]
struct TurnWay {
    /// x and y are exchanged, before signs.
    exchanged: bool,
    /// Signs of x and y then.
    signs: [f64; 2],
    /// The first number is the tip's.
    from_tip: bool,
    factor: f64,
}

const AS_IT_IS: TurnWay = TurnWay { exchanged: false, signs: [1.0; 2], from_tip: false, factor: 1.0 };

impl TurnWay {
    fn undo(&self, points: &[[f64; 2]]) -> Vec<[f64; 2]> {
        let one = |[x, y]: &[f64; 2]| {
            let [x, y] = if self.exchanged { [*y, *x] } else { [*x, *y] };
            [self.factor * self.signs[0] * x, self.factor * self.signs[1] * y]
        };
        if self.from_tip { points.iter().rev().map(one).collect() } else { points.iter().map(one).collect() }
    }

    fn undo_run(&self, run: &[Vec<[f64; 2]>]) -> Vec<Vec<[f64; 2]>> {
        run.iter().map(|points| self.undo(points)).collect()
    }

    fn is_like(&self, other: &TurnWay) -> bool {
        let way = |way: &TurnWay| (way.exchanged, way.signs, way.from_tip);
        !policy::is_no_scale(self.factor / other.factor) && way(self) == way(other)
    }
}

struct TurnFound {
    run: usize,
    way: TurnWay,
    rms_m: [f64; 2],
}

pub(super) fn turned(seen: &mut SlipSeen) -> Vec<String> {
    let all: Vec<TurnFound> = (0..seen.points.len()).filter_map(|run| in_run(seen, run)).collect();
    for TurnFound { run, way, .. } in &all {
        seen.points[*run] = way.undo_run(&seen.points[*run]);
    }
    let alike = groups(&all, |a, b| a.way.is_like(&b.way)).into_iter();
    alike.map(|own| words(seen, &own.iter().map(|i| &all[*i]).collect::<Vec<_>>())).collect()
}

fn in_run(seen: &SlipSeen, run: usize) -> Option<TurnFound> {
    let points = &seen.points[run];
    let loose = seen.body.stations_m.len() > 1;
    let left = |way: &TurnWay, loose: bool| {
        points.iter().map(|points| seen.body.lay(&way.undo(points), loose).squares).sum::<f64>()
    };
    let rms = |squares: f64| seen.rms(squares, points.len());
    let before = left(&AS_IT_IS, loose);
    if policy::is_far_less(rms(before), seen.half_apart()) {
        return None;
    }
    let ways: Vec<(TurnWay, f64)> = ways(seen, points).into_iter().map(|way| (way, left(&way, loose))).collect();
    let best = ways.iter().fold(f64::INFINITY, |least, (_, squares)| least.min(*squares));
    if !policy::is_far_less(rms(best), rms(before)) {
        return None;
    }
    // Alike but for the place of the base.
    let alike = ways.into_iter().filter(|(_, squares)| !policy::is_far_less(rms(best), rms(*squares)));
    let (mut way, after) = least(alike, |(way, _)| left(way, false))?;
    if !seen.bends_up(&way.undo_run(points)) {
        way.signs[1] = -1.0;
    }
    Some(TurnFound { run, way, rms_m: [rms(before), rms(after)] })
}

fn ways(seen: &SlipSeen, run: &[Vec<[f64; 2]>]) -> Vec<TurnWay> {
    let factor = factor(seen, run);
    let known = UNITS.iter().map(|(unit, _)| *unit).find(|unit| policy::is_near_unit(factor / unit));
    let is_off = factor > 0.0 && factor.is_finite() && policy::is_no_scale(factor);
    let mut factors = vec![1.0];
    factors.extend(is_off.then_some(known.unwrap_or(factor)));
    let mut all = Vec::new();
    for factor in factors {
        for k in 0..8 {
            let [exchanged, turned, from_tip] = [4, 2, 1].map(|bit| k & bit != 0);
            all.push(TurnWay { exchanged, signs: [if turned { -1.0 } else { 1.0 }, 1.0], from_tip, factor });
        }
    }
    all.retain(|way| *way != AS_IT_IS && (!way.from_tip || seen.body.stations_m.len() > 1));
    all
}

/// How much farther apart the stations are than the markers at the lowest pressure, where they are farthest.
fn factor(seen: &SlipSeen, run: &[Vec<[f64; 2]>]) -> f64 {
    let size = |points: &[[f64; 2]]| {
        let mean = [0, 1].map(|axis| mean(points.iter().map(|p| p[axis])));
        points.iter().map(|p| (p[0] - mean[0]).powi(2) + (p[1] - mean[1]).powi(2)).sum::<f64>().sqrt()
    };
    let straight: Vec<[f64; 2]> = seen.body.stations_m.iter().map(|s| [*s, 0.0]).collect();
    size(&straight) / run.iter().map(|points| size(points)).fold(0.0, f64::max)
}

fn words(seen: &SlipSeen, alike: &[&TurnFound]) -> String {
    let way = alike[0].way;
    let runs: Vec<usize> = alike.iter().map(|found| found.run).collect();
    let rms_m = [0, 1].map(|i| mean(alike.iter().map(|found| found.rms_m[i].powi(2))).sqrt());
    // How it looks, what undoes it, what to do.
    let mut all: Vec<[String; 3]> = Vec::new();
    if way.exchanged || way.signs != [1.0; 2] {
        let looks = if way.exchanged { "x and y look exchanged" } else { "x looks turned over" };
        let names = if way.exchanged { ["y", "x"] } else { ["x", "y"] };
        let [x, y] = [0, 1].map(|axis| format!("{}{}", if way.signs[axis] < 0.0 { "-" } else { "" }, names[axis]));
        let help = "x runs from the base along the straight robot, y towards the actuator";
        all.push([looks.into(), format!("({x}, {y}) in place of (x, y)"), help.into()]);
    }
    if way.from_tip {
        let in_all = runs.len() == seen.points.len();
        let stations = if in_all { ", or give the stations s_mm in the other order" } else { "" };
        let help = format!("number them from the base to the tip in the column marker{stations}");
        all.push(["the markers look numbered from the tip".into(), "the numbering reversed".into(), help]);
    }
    if way.factor != 1.0 {
        let unit = UNITS.iter().find(|(unit, _)| *unit == way.factor).map(|(_, words)| *words);
        let or = "or the stations are in another unit";
        let looks = format!("positions look like {}, {or}", unit.unwrap_or("pixels, or a scale that was not set"));
        let with = format!("{} times the numbers", (1e4 * way.factor).round() / 1e4);
        all.push([looks, with, "name the columns x and y by their unit, or convert them; stations are s_mm".into()]);
    }
    let joined = |k: usize, by: &str| all.iter().map(|words| words[k].as_str()).collect::<Vec<_>>().join(by);
    let next = format!("Look at it first: {}", joined(2, "; "));
    let looks = format!("{} {}", joined(0, ", and "), seen.in_runs(&runs));
    told(looks, rms_m, ANY_BASE, &joined(1, " and "), &next)
}

/// y turned over in some runs.
pub(super) fn upside(seen: &mut SlipSeen) -> Vec<String> {
    let count = seen.points.len();
    let (up, down): (Vec<usize>, Vec<usize>) = (0..count).partition(|run| seen.bends_up(&seen.points[*run]));
    if count < policy::FEWEST_RUNS || 2 * down.len() >= count {
        return Vec::new();
    }
    let mut all = Vec::new();
    for run in down {
        let [before, after] = [1.0, -1.0].map(|sign| from_others(seen, run, &up, sign));
        if policy::is_far_less(before, seen.half_apart()) || !policy::is_far_less(after, before) {
            continue;
        }
        seen.points[run].iter_mut().flatten().for_each(|point| point[1] = -point[1]);
        let looks = format!("y looks turned over {}", seen.in_runs(&[run]));
        let next = "Look at it first: y is positive towards the actuator";
        all.push(told(looks, [before, after], "the mean of the other runs", "-y in place of y", next));
    }
    all
}

/// Distance of a run from the mean of others, with a sign on its y \[m\].
fn from_others(seen: &SlipSeen, run: usize, others: &[usize], sign: f64) -> f64 {
    let mut squares = 0.0;
    for (hold, points) in seen.points[run].iter().enumerate() {
        for (marker, [x, y]) in points.iter().enumerate() {
            let mean = [0, 1].map(|axis| mean(others.iter().map(|other| seen.points[*other][hold][marker][axis])));
            squares += (x - mean[0]).powi(2) + (sign * y - mean[1]).powi(2);
        }
    }
    seen.rms(squares, seen.points[run].len())
}
