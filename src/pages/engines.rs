//! Both engines and the published numbers on one page: displacement, accuracy, ledgers, and where the models part.

use super::engine_figures::{bars, curve, ledger, parting_plot};
use super::{Maker, PAPER, Result, Values, marker_intervals, what_to_measure};
use crate::prelude::*;
use crate::shown::engines as shown;
use ::compare::study::columns::csv;
use ::compare::study::engines::{EngineRobot, Engines, LINES_CSV, lines};
use ::compare::study::uncertain::Uncertain;

pub(crate) fn engines_page(engines: &Engines, maker: &Maker) -> Result<Files> {
    let mut files = Files::default();
    let overview = overview(engines, &mut files)?;
    let (mut cubes, mut kinds, mut maps) = (Vec::new(), Vec::new(), Vec::new());
    for robot in &engines.robots {
        for cube in &robot.uncertain {
            cubes.push(draw_cube(robot, cube, &mut files)?);
        }
    }
    for robot in engines.robots.iter().filter(|r| !r.pairs.is_empty()) {
        let kind = robot.scenario.actuator.kind.name;
        files.plot(&format!("{kind}_engines"), curve(robot)?);
        files.plot(&format!("{kind}_engines_ledger"), ledger(robot)?);
        kinds.push(kind);
    }
    for (k, map) in engines.maps.iter().enumerate() {
        let name = format!("breakdown_{}_{k}", map.actuator);
        files.plot(&name, parting_plot(map)?);
        maps.push(Values::new().with("name", name).with("mesh_mm", map.mesh_mm));
    }
    let values = Values::new()
        .with("title", "Two engines against the published displacements")
        .with("lead", lead(engines))
        .with("cubes", cubes)
        .with("kinds", kinds)
        .with("maps", maps)
        .with("provenance", provenance(engines, maker))
        .and(overview);
    files.page("engines.html", values, maker)?;
    Ok(files)
}

/// One row a robot, with the bars of their displacements, and all lines as a table.
pub(super) fn overview(engines: &Engines, files: &mut Files) -> Result<Values> {
    let mut all = Vec::new();
    for robot in &engines.robots {
        all.extend(lines(robot)?);
    }
    let (summary, lines) = (shown::summary(&engines.robots)?, shown::line_table(&all).page(shown::LINES));
    files.text("engines.csv", csv(&LINES_CSV, &all));
    if let Some(bars) = bars(engines)? {
        files.plot("engines", bars);
    }
    Ok(Values::new().with("summary", (!summary.is_empty()).then(|| summary.page(shown::SUMMARY))).with("lines", lines))
}

/// Heights of all markers with their intervals, and what to measure first.
fn draw_cube(robot: &EngineRobot, cube: &Uncertain, files: &mut Files) -> Result<Values> {
    let own = if robot.published.is_some() { cube.measured() } else { Vec::new() };
    let words: String = cube.variant.chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '-' }).collect();
    let name = [cube.actuator.as_str(), &words].iter().filter(|w| !w.is_empty()).copied().collect::<Vec<_>>().join("-");
    files.plot(&format!("{name}_uncertain"), marker_intervals(cube, &own)?);
    let tornado = cube.weights(cube.top_kpa()).is_some();
    if tornado {
        files.plot(&format!("{name}_tornado"), what_to_measure(cube, cube.top_kpa())?);
    }
    let values = Values::new().with("name", name).with("tornado", tornado);
    Ok(values.with("robots", cube.members.len()).with("variant", &cube.variant))
}

fn lead(engines: &Engines) -> String {
    let mut words = Vec::new();
    for robot in &engines.robots {
        let (Some(printed), Some(last)) = (&robot.published, robot.pairs.last()) else { continue };
        let Some([(fe, _), _]) = robot.ensemble.at(printed.d_max_pressure_pa * 1e-3) else { continue };
        let (measured, [bare, _]) = (printed.d_max_m * 1e3, last.reduced_mm);
        let (name, share) = (&printed.printed_name, 100.0 * (fe - measured) / measured);
        words.push(format!(
            "{name} {fe:.1} mm ({share:+.0} %; reduced model as shipped {bare:.1} mm, measured {measured:.1} mm)"
        ));
    }
    match words.is_empty() {
        true => "These robots have no finite element run yet.".into(),
        false => format!("Outermost marker at 30 kPa by finite elements: {}.", words.join("; ")),
    }
}

fn provenance(engines: &Engines, maker: &Maker) -> Vec<[String; 2]> {
    let mut lines = vec![["published numbers".into(), PAPER.into()]];
    for run in engines.robots.iter().filter_map(|r| r.ensemble.runs.first()) {
        let what = format!(
            "{} mm elements, {} of them, {} steps, {:.0} CPU s, engine {}",
            run.mesh_mm[1], run.elements, run.steps, run.cpu_s, run.engine
        );
        lines.push([format!("run of {}", run.actuator), what]);
    }
    lines.push(["machine".into(), maker.machine.clone()]);
    lines
}
