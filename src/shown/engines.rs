//! Both engines as tables: every pressure, a row per robot, ways up and down, ledgers. Each with its caption.

use crate::prelude::*;
use compare::CompareError;
use compare::study::engines::{EngineLine, EngineRobot, MeanOverSeeds, TERMS};
use compare::study::published::heights_m;

pub(crate) const LINES: &str = "All pressures that the paper prints";
pub(crate) const SUMMARY: &str = "Outermost marker at 30 kPa; finite elements: median and 80 % interval over all unmeasured numbers; as recommended: mean ± standard deviation over seeds";
pub(crate) const BRANCHES: &str = "Finite elements on the way up and down again, mean ± standard deviation over seeds";
pub(crate) const LEDGERS: &str = "Ledgers at the highest pressure [mJ]: gas −P ΔV, stored, lost";

pub(crate) fn line_table(lines: &[EngineLine]) -> TextTable<&EngineLine> {
    TextTable::of(lines)
        .words("robot", |line| &line.robot)
        .number("kPa", 0, |line| line.actuator_kpa)
        .right("source", |line| &line.source)
        .right("how known", |line| &line.known)
        .number("marker mm", 1, |line| line.marker_mm)
        .number("sd of seeds mm", 1, |line| line.spread_mm)
        .number("tip mm", 1, |line| line.tip_mm)
        .number("accuracy %", 1, |line| line.accuracy.map(|a| 100.0 * a))
}

/// Every robot in a row for every way that it may be made: the displacement at the pressure of the measurement; none without one.
pub(crate) fn summary(robots: &[EngineRobot]) -> Result<TextTable<Vec<String>>, CompareError> {
    let rows = robots.iter().map(summary_rows).collect::<Result<Vec<_>, _>>()?;
    let heads = [
        "robot",
        "made",
        "measured mm, published",
        "bare model mm, predicted",
        "with effects mm, assumed",
        "finite elements, median mm, assumed",
        "80 % interval mm",
        "measured",
        "as recommended mm, assumed",
    ];
    Ok(TextTable::finished(&heads, 1, rows.concat()))
}

fn summary_rows(robot: &EngineRobot) -> Result<Vec<Vec<String>>, CompareError> {
    let Some(printed) = &robot.published else { return Ok(Vec::new()) };
    let (kpa, measured) = (printed.d_max_pressure_pa * 1e-3, printed.d_max_m * 1e3);
    let loads = Loads::uniform(robot.scenario.p_body_pa, printed.d_max_pressure_pa);
    let marker_mm = |scenario: &Scenario| Ok::<f64, CompareError>(heights_m(scenario, &loads)?[0] * 1e3);
    let bare = marker_mm(&robot.scenario.bare())?;
    let with = robot.with_effects.as_ref().map(|rung| marker_mm(&rung.scenario)).transpose()?;
    let row = |variant: &str, interval: Option<[f64; 3]>| {
        let ends = |[low, middle, high]: [f64; 3]| {
            let [less, more] = [low, high].map(|end| 100.0 * (end / middle - 1.0));
            format!("{low:.1} to {high:.1} ({less:+.0} to {more:+.0} %)")
        };
        let inside = |[low, _, high]: [f64; 3]| if (low..=high).contains(&measured) { "inside" } else { "outside" };
        let recommended = robot.ensemble.at(kpa).filter(|_| variant.is_empty()).map(|[marker, _]| marker);
        vec![
            printed.printed_name.clone(),
            if variant.is_empty() { "as recommended" } else { variant }.into(),
            format!("{measured:.1}"),
            format!("{bare:.1}"),
            number(with, 1),
            number(interval.map(|[_, middle, _]| middle), 1),
            interval.map_or("–".into(), ends),
            interval.map_or("–", inside).into(),
            over_seeds(recommended, 1),
        ]
    };
    let rows: Vec<Vec<String>> = robot.uncertain.iter().map(|cube| row(&cube.variant, cube.tip_mm(kpa))).collect();
    Ok(if rows.is_empty() { vec![row("", None)] } else { rows })
}

/// `12.3 ± 0.4`, the mean alone, or a dash.
pub(crate) fn over_seeds(value: Option<MeanOverSeeds>, decimals: usize) -> String {
    let Some((mean, deviation)) = value else { return "–".into() };
    let deviation = deviation.map_or(String::new(), |sd| format!(" ± {sd:.decimals$}"));
    format!("{mean:.decimals$}{deviation}")
}

/// A robot at a pressure that its runs reached on the way up and on the way down again.
pub(crate) type BothWays<'a> = (&'a EngineRobot, f64, [MeanOverSeeds; 2]);

/// Tips of the finite elements at every pressure of every robot on both ways; no rows for runs that did not come down.
pub(crate) fn branches(robots: &[EngineRobot]) -> TextTable<BothWays<'_>> {
    let states = |robot: &'_ EngineRobot| robot.ensemble.runs.first().map_or(&[][..], |run| &run.states).to_vec();
    let rows = robots.iter().flat_map(|robot| {
        let both = move |kpa: f64| Some((robot, kpa, [robot.ensemble.at(kpa)?[1], robot.ensemble.back_at(kpa)?]));
        states(robot).into_iter().filter_map(move |state| both(state.actuator_kpa))
    });
    TextTable::of(rows)
        .words("robot", |(robot, ..)| robot.scenario.actuator.kind.name)
        .number("kPa", 0, |(_, kpa, _)| *kpa)
        .right("tip up mm", |(.., [up, _])| over_seeds(Some(*up), 1))
        .right("tip down mm", |(.., [_, down])| over_seeds(Some(*down), 1))
        .signed("down over up %", 1, |(.., [up, down])| 100.0 * (down.0 / up.0 - 1.0))
        .right("at rest", |(robot, kpa, _)| if robot.ensemble.is_at_rest(*kpa) { "yes" } else { "no" })
}

/// Energies of both engines at the highest pressure of every robot.
pub(crate) fn ledgers(robots: &[EngineRobot]) -> TextTable<Vec<String>> {
    let mut rows = Vec::new();
    for (robot, pair) in robots.iter().filter_map(|robot| Some((robot, robot.pairs.last()?))) {
        for (engine, energies, lost) in [
            ("reduced", Some(pair.reduced_mj), None),
            ("finite elements", Some(pair.fe_mj), Some(pair.lost_mj)),
            ("excess at the same bend", pair.excess_mj, None),
        ] {
            let Some(energies) = energies else { continue };
            let mut row = vec![robot.scenario.actuator.kind.name.to_string(), engine.to_string()];
            row.extend(energies.map(|e| format!("{e:.0}")));
            row.push(number(lost, 0));
            rows.push(row);
        }
        rows.extend(pair.carrier.map(|carrier| {
            let without = 100.0 * carrier.difference_without;
            vec![String::new(), format!("carried by: {} ({without:+.0} % without)", carrier.term)]
        }));
    }
    TextTable::finished(&[&["robot", "engine"], &TERMS[..], &["lost"]].concat(), 2, rows)
}
