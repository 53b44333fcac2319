//! Plots of finite element runs of robots.

use crate::prelude::*;
use compare::characterize::Scatter;
use fem::session::{FeRun, Loaded, RunTable};
use report::lines;
use std::collections::BTreeMap;

/// `history.png` and `displacement.png` of a complete run of a robot.
pub fn run_plots(loaded: &Loaded, run: &FeRun) -> Result<Vec<(String, Vec<u8>)>, String> {
    let Some(robot) = &loaded.robot else { return Ok(Vec::new()) };
    let name = &robot.scenario.name;
    let plots = [("history.png", history(name, run)), ("displacement.png", displacement(name, run))];
    let wanted = plots.into_iter().filter_map(|(file, plot)| Some((file, plot?)));
    let drawn = wanted.map(|(file, plot)| match lines(&plot) {
        Ok(drawn) => Ok((file.to_string(), drawn.png)),
        Err(problem) => Err(format!("could not draw {file}: {problem}")),
    });
    drawn.collect()
}

/// Displacement of every station over the actuator's pressure; `None` for a single reading.
fn displacement(name: &str, run: &FeRun) -> Option<Lines> {
    let readings = run.readings();
    let stations = &readings.first().filter(|_| readings.len() > 2)?.stations_m;
    let series = |k: usize| {
        let points = readings.iter().map(|r| [r.actuator_pa * 1e-3, r.moved_m[k][1] * 1e3]).collect();
        LineSeries::new(format!("{:.0} mm", stations[k] * 1e3), LineStyle::LinePoints, points)
    };
    let title = format!("{name}: displacement towards the actuator, by distance from the base");
    let series = (0..stations.len()).map(series).collect();
    Some(Lines::new(title, "actuator pressure [kPa]", "displacement [mm]", series))
}

/// Stored and kinetic energy over time with the buckling events.
fn history(name: &str, run: &FeRun) -> Option<Lines> {
    let samples = &run.energies;
    if samples.is_empty() {
        return None;
    }
    let series = |name: &str, points, style, colour| LineSeries::new(name, style, points).coloured(colour);
    let over = |energy: fn(&fem::robot::Sample) -> f64| samples.iter().map(|s| [s.time_s, energy(s) * 1e3]).collect();
    let found = run.summary.robot.iter().flat_map(|robot| &robot.snaps);
    let marks: Vec<[f64; 2]> = found.map(|s| [s.time_s, s.kinetic_j * 1e3]).collect();
    let mut all = vec![
        series("stored", over(|s| s.stored_j), LineStyle::Line, 0),
        series("kinetic", over(|s| s.kinetic_j), LineStyle::Line, 1),
        series("kinetic, walls", over(|s| s.walls_j), LineStyle::Line, 2),
    ];
    if !marks.is_empty() {
        all.push(series("buckling", marks, LineStyle::Points, 3));
    }
    Some(Lines::new(format!("{name}: energy over time"), "time [s]", "energy [mJ]", all))
}

/// Outermost marker over the actuator's element size, a line for every pressure; `None` unless there are several sizes.
pub(crate) fn mesh_plot(name: &str, table: &RunTable) -> Option<Lines> {
    let mut lines_of: BTreeMap<u64, BTreeMap<u64, Vec<f64>>> = BTreeMap::new();
    for row in &table.rows {
        let size = row.variation.changes.iter().find(|(key, _)| key == "actuator_mesh_mm")?;
        let size: f64 = size.1.parse().ok()?;
        for heights in &row.heights {
            // Positive numbers are in the order of their bits.
            let line = lines_of.entry(heights.actuator_kpa.to_bits()).or_default();
            line.entry(size.to_bits()).or_default().push(heights.marker_mm);
        }
    }
    let scatter =
        |all: &Vec<f64>| Scatter::of(all.iter().copied()).map_or([f64::NAN, 0.0], |s| [s.mean, s.sd.unwrap_or(0.0)]);
    let series = |(kpa, sizes): (&u64, &BTreeMap<u64, Vec<f64>>)| {
        let points = sizes.iter().map(|(size, all)| [f64::from_bits(*size), scatter(all)[0]]).collect();
        let line = LineSeries::new(format!("{} kPa", f64::from_bits(*kpa)), LineStyle::LinePoints, points);
        line.with_errors(sizes.values().map(|all| scatter(all)[1]).collect())
    };
    let several = lines_of.values().any(|sizes| sizes.len() > 1);
    let seeds = lines_of.values().flat_map(|sizes| sizes.values()).any(|markers| markers.len() > 1);
    let spread = if seeds { ", standard deviation over the seeds" } else { "" };
    let title = format!("{name}: outermost marker and the mesh{spread}");
    let (x, y) = ("element size at the actuator [mm]", "displacement of the outermost marker [mm]");
    several.then(|| Lines::new(title, x, y, lines_of.iter().map(series).collect()))
}
