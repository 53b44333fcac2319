//! The missing moment → its picture: points with error ellipses, and the explanations as curves through them.

use super::Result;
use crate::prelude::*;
use compare::moment::{MissingMoment, MomentCurve, MomentPoint};
use compare::witness::FeMoment;
use compare::wording::short;

/// Pressures that differ by less have one colour [kPa].
const SAME_KPA: f64 = 0.5;
/// Pressures with a colour and a line in the legend of their own.
const MOST_LEVELS: usize = 6;
/// Symbol of finite elements; symbols of body pressures begin with others.
const FINITE_ELEMENTS: Symbol = Symbol::Triangle;
/// The last colour of a series, and one below it, are left for curves.
const FREE_SERIES: usize = 7;

/// The picture, with what finite elements of the robot would ask for; `None` where no hold has a missing moment.
pub(super) fn missing_moment(found: &MissingMoment, beside: &[FeMoment]) -> Result<Option<Drawn>> {
    let points: Vec<&MomentPoint> = found.of_holds().collect();
    if points.is_empty() {
        return Ok(None);
    }
    let levels = levels(points.iter().map(|p| p.p_act_kpa));
    let bodies = self::levels(points.iter().map(|p| p.p_body_kpa));
    let mut marks: Vec<Mark> = found.curves.iter().filter(|c| c.is_told).map(|c| band(c, found)).collect();
    let furthest = beside.iter().map(|p| p.bend_deg + p.bend_sd_deg).fold(furthest(found), f64::max);
    let mut told: Vec<&str> = found.curves.iter().filter(|c| c.is_told).map(|c| c.answer.as_str()).collect();
    told.dedup();
    marks.push(Mark::Line(vec![[0.0, 0.0], [furthest, 0.0]], Ink::Axis));
    marks.extend(found.curves.iter().map(|c| line(c, ink(&told, c))));
    marks.extend(finite_elements(beside));
    let ellipse = |p: &&MomentPoint| Mark::Line(p.error_ellipse(), Ink::Series(nearest(&levels, p.p_act_kpa)));
    marks.extend(points.iter().map(ellipse));
    marks.extend(points.iter().map(|p| point(p, &levels, &bodies)));
    marks.push(Mark::Tip([furthest, 0.0], "nothing missing".into(), Ink::Muted));
    marks.extend(tips(&found.curves, &told));
    let (x, y) = ("bend over the whole body [°]", "missing moment [N m]; below 0 something holds it back");
    let mut keys = keys(found, &levels, &bodies);
    if !beside.is_empty() {
        keys.push(LegendEntry::new(KeyLook::SymbolLine(FINITE_ELEMENTS, true), Ink::Muted, "finite elements"));
    }
    let mut chart = Chart::new("What the model misses", x, y);
    (chart.marks, chart.keys) = (marks, keys);
    Ok(Some(chart.draw("missing moment")?))
}

/// Distinct levels, rising; of many a few, evenly.
fn levels(values: impl Iterator<Item = f64>) -> Vec<f64> {
    let mut levels: Vec<f64> = values.collect();
    levels.sort_by(f64::total_cmp);
    levels.dedup_by(|b, a| *b - *a < SAME_KPA);
    let (count, kept) = (levels.len(), levels.len().min(MOST_LEVELS));
    (0..kept).map(|i| levels[if kept > 1 { i * (count - 1) / (kept - 1) } else { 0 }]).collect()
}

fn nearest(levels: &[f64], value: f64) -> usize {
    let away = |i: &usize| (levels[*i] - value).abs();
    (0..levels.len()).min_by(|a, b| away(a).total_cmp(&away(b))).unwrap_or(0)
}

fn furthest(found: &MissingMoment) -> f64 {
    let curves = found.curves.iter().flat_map(|c| c.points.iter().map(|p| p[1]));
    found.of_holds().map(|p| p.bend_deg + p.bend_sd_deg).chain(curves).fold(0.0, f64::max)
}

fn point(p: &MomentPoint, levels: &[f64], bodies: &[f64]) -> Mark {
    Mark::Point(Point {
        at: [p.bend_deg, p.moment_nm],
        ink: Ink::Series(nearest(levels, p.p_act_kpa)),
        symbol: Symbol::of(nearest(bodies, p.p_body_kpa)),
        open: p.phase == "unload",
        ..Point::default()
    })
}

/// Their moments on a thin line, so that no pressure of the data is taken for one of theirs.
fn finite_elements(beside: &[FeMoment]) -> Vec<Mark> {
    let points = beside.iter().map(|p| [p.bend_deg, p.moment_nm]).collect();
    let line = Mark::Line(points, Ink::Axis);
    let point = |p: &FeMoment| {
        let (at, error) = ([p.bend_deg, p.moment_nm], [p.bend_sd_deg, p.moment_sd_nm]);
        Mark::Point(Point { at, error, ink: Ink::Muted, symbol: FINITE_ELEMENTS, open: true, ..Point::default() })
    };
    std::iter::once(line).filter(|_| beside.len() > 1).chain(beside.iter().map(point)).collect()
}

fn line(curve: &MomentCurve, ink: Ink) -> Mark {
    let kind = if curve.is_told { Mark::Line } else { Mark::Dashed };
    kind(curve.points.iter().map(|p| [p[1], p[2]]).collect(), ink)
}

/// Colour of a curve: the first answer is black, further ones have colours that no pressure has.
fn ink(answers: &[&str], curve: &MomentCurve) -> Ink {
    match answers.iter().position(|name| *name == curve.answer) {
        Some(0) => Ink::Ink,
        Some(i) => Ink::Series(FREE_SERIES - i % 2),
        None => Ink::Muted,
    }
}

/// The band of a curve, where it leaves the points to be seen: where hardly anything is known, it would fill the picture.
fn band(curve: &MomentCurve, found: &MissingMoment) -> Mark {
    let largest = found.of_holds().map(|p| p.moment_nm.abs() + p.moment_sd_nm).fold(0.0, f64::max);
    let narrow = || curve.points.iter().filter(|p| p[3] < 0.5 * largest);
    let side = |sign: f64| narrow().map(move |p| [p[1], p[2] + sign * p[3]]);
    Mark::Band(side(1.0).chain(side(-1.0).rev()).collect())
}

/// Names at the ends of the curves, each once: where it ends furthest.
fn tips(curves: &[MomentCurve], told: &[&str]) -> Vec<Mark> {
    let mut named: Vec<&str> = Vec::new();
    let mut marks = Vec::new();
    for curve in curves {
        if named.contains(&curve.answer.as_str()) {
            continue;
        }
        let own = curves.iter().filter(|c| c.answer == curve.answer).flat_map(|c| &c.points);
        if let Some(end) = own.max_by(|a, b| a[1].total_cmp(&b[1])) {
            named.push(&curve.answer);
            let label = super::effect(&curve.answer).replace(" + ", " +\n");
            let line = |line: &str| Mark::Tip([end[1], end[2]], line.into(), ink(told, curve));
            marks.extend(label.lines().map(line));
        }
    }
    marks
}

fn keys(found: &MissingMoment, levels: &[f64], bodies: &[f64]) -> Vec<LegendEntry> {
    let looks = |open: bool| KeyLook::Symbol(Symbol::Circle, open);
    let level = |(i, p): (usize, &f64)| LegendEntry::new(looks(false), Ink::Series(i), &format!("{} kPa", short(*p)));
    let mut keys: Vec<LegendEntry> = levels.iter().enumerate().map(level).collect();
    if found.of_holds().any(|p| p.phase == "unload") {
        keys.push(LegendEntry::new(looks(true), Ink::Ink, "on the way down"));
    }
    if bodies.len() > 1 {
        let body = |(i, p): (usize, &f64)| {
            LegendEntry::new(KeyLook::Symbol(Symbol::of(i), false), Ink::Muted, &format!("body {} kPa", short(*p)))
        };
        keys.extend(bodies.iter().enumerate().map(body));
    }
    if found.curves.iter().any(|c| !c.is_told) {
        keys.push(LegendEntry::new(KeyLook::Dashed, Ink::Muted, "fits worse"));
    }
    keys
}
