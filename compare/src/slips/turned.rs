//! Axes turned over or exchanged, numbers from the tip, another unit of length: what befalls a run as a whole.
//!
//! Looked for without the origin, so that a picture's corner may be it: markers about their mean, against bodies that head
//! along x. Two ways that are alike for a straight robot (x turned over, numbers from the tip) part when it bends, or by the base.

use super::{SlipSeen, become_mm};
use crate::policy;

/// What the numbers have to be multiplied by, if they are what the words say.
const UNITS: [(f64, &str); 7] = [
    (10.0, "cm under a header of mm"),
    (1000.0, "metres under a header of mm"),
    (25.4, "inches under a header of mm"),
    (100.0, "metres under a header of cm"),
    (0.1, "mm under a header of cm"),
    (0.01, "cm under a header of m"),
    (0.001, "mm under a header of m"),
];

/// A way in which a run may be written.
#[derive(Debug, Clone, Copy, PartialEq)]
struct TurnWay {
    /// x and y are exchanged, before signs.
    exchanged: bool,
    /// Signs of x and y then.
    signs: [f64; 2],
    /// The first number is the tip's.
    from_tip: bool,
    /// Factor on all positions.
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
        let same = !policy::is_no_scale(self.factor / other.factor);
        same && TurnWay { factor: 1.0, ..*self } == TurnWay { factor: 1.0, ..*other }
    }
}

struct TurnFound {
    run: usize,
    way: TurnWay,
    rms_m: [f64; 2],
}

pub(super) fn turned(seen: &mut SlipSeen) -> Vec<String> {
    let found: Vec<TurnFound> = (0..seen.points.len()).filter_map(|run| in_run(seen, run)).collect();
    let mut told = Vec::new();
    for (i, first) in found.iter().enumerate() {
        seen.points[first.run] = first.way.undo_run(&seen.points[first.run]);
        if found[..i].iter().all(|before| !before.way.is_like(&first.way)) {
            let alike: Vec<&TurnFound> = found.iter().filter(|other| other.way.is_like(&first.way)).collect();
            told.push(words(seen, &alike));
        }
    }
    told
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
    let least = ways.iter().fold(f64::INFINITY, |least, (_, squares)| least.min(*squares));
    if !policy::is_far_less(rms(least), rms(before)) {
        return None;
    }
    // Alike but for the place of the base.
    let alike = ways.into_iter().filter(|(_, squares)| !policy::is_far_less(rms(least), rms(*squares)));
    let (mut way, after) = alike.min_by(|a, b| left(&a.0, false).total_cmp(&left(&b.0, false)))?;
    if !seen.bends_up(&way.undo_run(points)) {
        way.signs[1] = -1.0;
    }
    Some(TurnFound { run, way, rms_m: [rms(before), rms(after)] })
}

fn ways(seen: &SlipSeen, run: &[Vec<[f64; 2]>]) -> Vec<TurnWay> {
    let factor = factor(seen, run);
    let known = UNITS.iter().map(|(unit, _)| *unit).find(|unit| policy::is_near_unit(factor / unit));
    let off = (factor.is_finite() && policy::is_no_scale(factor)).then_some(known.unwrap_or(factor));
    let mut all = Vec::new();
    for factor in [Some(1.0), off].into_iter().flatten() {
        for (exchanged, sign) in [(false, 1.0), (false, -1.0), (true, 1.0), (true, -1.0)] {
            for from_tip in [false, true] {
                all.push(TurnWay { exchanged, signs: [sign, 1.0], from_tip, factor });
            }
        }
    }
    all.retain(|way| *way != AS_IT_IS && (!way.from_tip || seen.body.stations_m.len() > 1));
    all
}

/// How much farther apart the stations are than the markers at the lowest pressure, where they are farthest.
fn factor(seen: &SlipSeen, run: &[Vec<[f64; 2]>]) -> f64 {
    let size = |points: &[[f64; 2]]| {
        let mean = [0, 1].map(|axis| points.iter().map(|p| p[axis]).sum::<f64>() / points.len() as f64);
        points.iter().map(|p| (p[0] - mean[0]).powi(2) + (p[1] - mean[1]).powi(2)).sum::<f64>().sqrt()
    };
    let straight: Vec<[f64; 2]> = seen.body.stations_m.iter().map(|s| [*s, 0.0]).collect();
    size(&straight) / run.iter().map(|points| size(points)).fold(0.0, f64::max)
}

fn words(seen: &SlipSeen, alike: &[&TurnFound]) -> String {
    let way = alike[0].way;
    let runs: Vec<usize> = alike.iter().map(|found| found.run).collect();
    let whole = runs.len() == seen.points.len();
    let mean = |i: usize| (alike.iter().map(|f| f.rms_m[i].powi(2)).sum::<f64>() / alike.len() as f64).sqrt();
    let (mut looks, mut with, mut help) = (Vec::new(), Vec::new(), Vec::new());
    if way.exchanged || way.signs != [1.0; 2] {
        let name = |axis: usize| ["x", "y"][if way.exchanged { 1 - axis } else { axis }];
        let signed = |axis: usize| format!("{}{}", if way.signs[axis] < 0.0 { "-" } else { "" }, name(axis));
        looks.push(if way.exchanged { "x and y look exchanged" } else { "x looks turned over" }.to_string());
        with.push(format!("({}, {}) in place of (x, y)", signed(0), signed(1)));
        help.push("x runs from the base along the straight robot, y towards the actuator".to_string());
    }
    if way.from_tip {
        looks.push("the markers look numbered from the tip".into());
        with.push("the numbering reversed".into());
        let stations = if whole { ", or give the stations s_mm in the other order" } else { "" };
        help.push(format!("number them from the base to the tip in the column marker{stations}"));
    }
    if way.factor != 1.0 {
        let unit = UNITS.iter().find(|(unit, _)| *unit == way.factor).map(|(_, words)| *words);
        let of = unit.unwrap_or("pixels, or a scale that was not set");
        looks.push(format!("positions look like {of}"));
        with.push(format!("{} times the numbers", (1e4 * way.factor).round() / 1e4));
        help.push("name the columns x and y by their unit, or convert them".into());
    }
    format!(
        "{} {}: {} (rms from a uniformly bent robot with these stations, wherever its base is) with {}. Look at it first: {}",
        looks.join(", and "),
        seen.in_runs(&runs),
        become_mm([mean(0), mean(1)]),
        with.join(" and "),
        help.join("; ")
    )
}
