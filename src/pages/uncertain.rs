//! What finite elements say about a robot of which not everything was measured, drawn.

use crate::prelude::*;
use compare::study::uncertain::{Uncertain, is_same_reading};
use report::{ReportError, lines};

/// Heights of all markers at all pressures, median and 80 % interval, with measured ones.
pub(crate) fn marker_intervals(all: &Uncertain, measured: &[(f64, [f64; 2])]) -> Result<Drawn, ReportError> {
    let mut series = Vec::new();
    for (colour, kpa) in all.pressures_kpa().into_iter().filter(|kpa| *kpa > 0.0).enumerate() {
        let found: Vec<(f64, [f64; 3])> =
            all.stations_mm.iter().enumerate().filter_map(|(m, s)| Some((*s, all.quantiles_mm(kpa, m, 1)?))).collect();
        let line = |name: String, k: usize, style| {
            LineSeries::new(name, style, found.iter().map(|(s, q)| [*s, q[k]]).collect()).coloured(colour)
        };
        series.push(line(format!("{kpa} kPa, median"), 1, LineStyle::LinePoints));
        series.push(line(String::new(), 0, LineStyle::Dashed));
        series.push(line(String::new(), 2, LineStyle::Dashed));
        let own = measured.iter().filter(|(at, _)| is_same_reading(*at, kpa)).map(|(_, point)| *point);
        let points: Vec<[f64; 2]> = own.collect();
        if !points.is_empty() {
            let name = format!("{kpa} kPa, measured");
            series.push(LineSeries::new(name, LineStyle::OpenPoints, points).coloured(colour));
        }
    }
    let title = format!("{}: median and 80 % interval (dashed) over the unmeasured numbers", all.scenario);
    let (x, y) = ("marker along the straight robot [mm]", "displacement towards the actuator [mm]");
    lines(&Lines::new(title, x, y, series))
}

/// What every number does to the outermost marker at a pressure.
pub(crate) fn what_to_measure(all: &Uncertain, actuator_kpa: f64) -> Result<Drawn, ReportError> {
    let base = all.tip_mm(actuator_kpa).map_or(f64::NAN, |q| q[1]);
    let (weights, rest) = all.weights(actuator_kpa).unwrap_or_default();
    let (mut marks, mut rows) = (Vec::new(), Vec::new());
    for (row, w) in weights.iter().enumerate() {
        let (number, half) = (&all.numbers[w.number], 0.5 * w.swing_mm);
        let values = [base - half, base + half].map(|v| report::number(v, 1));
        let [low, high] = number.tenths;
        let words = format!("{}: {low} → {}, {high} → {}", number.name, values[0], values[1]);
        rows.push(ChartRow::above(&words, 1));
        for (sign, ink) in [(-1.0, Ink::HeatNegative), (1.0, Ink::HeatPositive)] {
            marks.push(Mark::Bar(Bar { ink, alpha: 0.75, ..Bar::over(row, [base, base + sign * half]) }));
        }
    }
    marks.push(Mark::Rule(base));
    let left = 100.0 * rest;
    let title =
        format!("{} at {actuator_kpa} kPa: what to measure first ({left:.0} % is not of a straight law)", all.scenario);
    let label = "outermost marker [mm], from a tenth to nine tenths of each interval";
    report::rows(&title, label, rows, marks, Vec::new()).draw("tornado")
}
