//! Both engines in rows of text: every pressure, and one row per robot.

use super::{EngineRobot, Ensemble, TERMS, accuracy};
use crate::error::CompareError;
use crate::policy;
use crate::study::columns::{TextColumn, TextTable, or_dash, plus_minus};
use crate::study::published::heights_m;
use models::{Known, Loads, Scenario};

/// One line of the comparison.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct EngineLine {
    /// Robot.
    pub robot: String,
    /// Actuator pressure \[kPa\].
    pub actuator_kpa: f64,
    /// Who says so.
    pub source: String,
    /// How it is known.
    pub known: String,
    /// Outermost marker \[mm\].
    pub marker_mm: Option<f64>,
    /// Its standard deviation over the seeds \[mm\].
    pub spread_mm: Option<f64>,
    /// Tip \[mm\].
    pub tip_mm: Option<f64>,
    /// The paper's accuracy: as printed, or of the outermost marker against the measured displacement.
    pub accuracy: Option<f64>,
}

const LINES: [TextColumn<EngineLine>; 8] = [
    ("robot", |line| line.robot.clone()),
    ("kPa", |line| format!("{:.0}", line.actuator_kpa)),
    ("source", |line| line.source.clone()),
    ("how known", |line| line.known.clone()),
    ("marker mm", |line| or_dash(line.marker_mm, 1)),
    ("sd of seeds mm", |line| or_dash(line.spread_mm, 1)),
    ("tip mm", |line| or_dash(line.tip_mm, 1)),
    ("accuracy %", |line| or_dash(line.accuracy.map(|a| 100.0 * a), 1)),
];

/// Columns of `engines.csv`.
pub const LINES_CSV: [TextColumn<EngineLine>; 8] = [
    ("robot", |line| line.robot.replace(',', ";")),
    ("p_act_kpa", |line| line.actuator_kpa.to_string()),
    ("source", |line| line.source.replace(',', ";")),
    ("how_known", |line| line.known.replace(',', ";")),
    ("marker_mm", |line| exact(line.marker_mm)),
    ("marker_sd_mm", |line| exact(line.spread_mm)),
    ("tip_mm", |line| exact(line.tip_mm)),
    ("accuracy", |line| exact(line.accuracy)),
];

/// A number with all its digits; empty without one.
pub(super) fn exact(value: Option<f64>) -> String {
    value.map_or(String::new(), |v| v.to_string())
}

/// Lines as a table.
pub fn line_table(lines: &[EngineLine]) -> TextTable {
    TextTable::of("All pressures that the paper prints", 1, &LINES, lines)
}

/// Lines of one robot at the printed pressures, or at those of its run.
///
/// # Errors
/// A model without equilibrium.
pub fn lines(robot: &EngineRobot) -> Result<Vec<EngineLine>, CompareError> {
    let mut out = Vec::new();
    let pressures: Vec<f64> = match &robot.published {
        Some(printed) => printed.accuracy.iter().map(|a| a.0 * 1e-3).collect(),
        None => robot.pairs.iter().map(|p| p.actuator_kpa).collect(),
    };
    for kpa in pressures {
        at_pressure(robot, kpa, &mut out)?;
    }
    Ok(out)
}

fn at_pressure(robot: &EngineRobot, kpa: f64, out: &mut Vec<EngineLine>) -> Result<(), CompareError> {
    let near = |other_pa: f64| policy::is_same_reading(other_pa * 1e-3, kpa);
    let name = robot.published.as_ref().map_or(&robot.scenario.name, |p| &p.printed_name).clone();
    let printed = robot.published.as_ref();
    let measured_mm = printed.filter(|p| near(p.d_max_pressure_pa)).map(|p| p.d_max_m * 1e3);
    let mut line = |source: &str, known: &str, mm: [Option<f64>; 3], printed: Option<f64>| {
        let [marker_mm, spread_mm, tip_mm] = mm;
        let judged = marker_mm.zip(measured_mm).filter(|(a, b)| a != b).and_then(|(a, b)| accuracy(a, b));
        let (robot, source, known) = (name.clone(), source.into(), known.into());
        let accuracy = printed.or(judged);
        out.push(EngineLine { robot, actuator_kpa: kpa, source, known, marker_mm, spread_mm, tip_mm, accuracy });
    };
    if measured_mm.is_some() {
        line("measurement", "measured, published", [measured_mm, None, None], None);
    }
    if let Some((_, a)) = printed.and_then(|p| p.accuracy.iter().find(|a| near(a.0))) {
        line("the paper's finite elements", "published", [None; 3], Some(*a));
    }
    let own = if printed.is_some() { "reduced, as shipped" } else { "reduced, as in the scenario" };
    let mut models = vec![(own, Known::Predicted, &robot.scenario)];
    models.extend(robot.with_effects.iter().map(|rung| ("reduced, with effects", Known::Assumed, &rung.scenario)));
    for (source, known, scenario) in models {
        let loads = Loads::uniform(robot.scenario.p_body_pa, kpa * 1e3);
        let [marker, tip] = heights_m(scenario, &loads)?.map(|m| Some(m * 1e3));
        line(source, known.word(), [marker, None, tip], None);
    }
    if let (Some(first), Some([marker, tip])) = (robot.ensemble.runs.first(), robot.ensemble.at(kpa)) {
        let source = format!("finite elements, {} mm, {}", first.mesh_mm[1], seeds(&robot.ensemble));
        line(&source, &first.known, [Some(marker.0), marker.1, Some(tip.0)], None);
    }
    Ok(())
}

fn seeds(ensemble: &Ensemble) -> String {
    match ensemble.runs.len() {
        1 => "1 seed".into(),
        n => format!("{n} seeds"),
    }
}

/// Every robot in a row for every way that it may be made: the displacement at the pressure of the measurement; none without one.
///
/// # Errors
/// A model without equilibrium.
pub fn summary(robots: &[EngineRobot]) -> Result<TextTable, CompareError> {
    let mut rows = Vec::new();
    for robot in robots {
        rows.extend(summary_rows(robot)?);
    }
    let heads = vec![
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
    let caption = "Outermost marker at 30 kPa; finite elements: median and 80 % interval over all numbers that nobody measured; as recommended: mean ± standard deviation over seeds";
    Ok(TextTable { caption, heads, left: 1, rows })
}

fn summary_rows(robot: &EngineRobot) -> Result<Vec<Vec<String>>, CompareError> {
    let Some(printed) = &robot.published else { return Ok(Vec::new()) };
    let (kpa, measured) = (printed.d_max_pressure_pa * 1e-3, printed.d_max_m * 1e3);
    let loads = Loads::uniform(robot.scenario.p_body_pa, printed.d_max_pressure_pa);
    let marker_mm = |scenario: &Scenario| Ok::<f64, CompareError>(heights_m(scenario, &loads)?[0] * 1e3);
    let bare = marker_mm(&robot.scenario.bare())?;
    let with = robot.with_effects.as_ref().map(|rung| marker_mm(&rung.scenario)).transpose()?;
    let recommended = robot.ensemble.at(kpa).map_or("–".into(), |[marker, _]| plus_minus(marker, 1));
    let row = |variant: &str, interval: Option<[f64; 3]>| {
        let ends = |[low, middle, high]: [f64; 3]| {
            let [less, more] = [low, high].map(|end| 100.0 * (end / middle - 1.0));
            format!("{low:.1} to {high:.1} ({less:+.0} to {more:+.0} %)")
        };
        let inside = |[low, _, high]: [f64; 3]| if (low..=high).contains(&measured) { "inside" } else { "outside" };
        let as_recommended = variant.is_empty();
        vec![
            printed.printed_name.clone(),
            if as_recommended { "as recommended" } else { variant }.into(),
            format!("{measured:.1}"),
            format!("{bare:.1}"),
            or_dash(with, 1),
            or_dash(interval.map(|[_, middle, _]| middle), 1),
            interval.map_or("–".into(), ends),
            interval.map_or("–", inside).into(),
            if as_recommended { recommended.clone() } else { "–".into() },
        ]
    };
    let rows: Vec<Vec<String>> = robot.uncertain.iter().map(|cube| row(&cube.variant, cube.tip_mm(kpa))).collect();
    Ok(if rows.is_empty() { vec![row("", None)] } else { rows })
}

/// Tips of the finite elements at every pressure of every robot on the way up and on the way down again, mean and standard deviation
/// over the seeds; no rows for runs that did not come down.
pub fn branches(robots: &[EngineRobot]) -> TextTable {
    let row = |robot: &EngineRobot, kpa: f64| {
        let ([_, up], down) = (robot.ensemble.at(kpa)?, robot.ensemble.back_at(kpa)?);
        let rest = if robot.ensemble.is_at_rest(kpa) { "yes" } else { "no" };
        let more = format!("{:+.1}", 100.0 * (down.0 / up.0 - 1.0));
        let (name, kpa) = (robot.scenario.actuator.kind.name.into(), format!("{kpa:.0}"));
        Some(vec![name, kpa, plus_minus(up, 1), plus_minus(down, 1), more, rest.into()])
    };
    let mut rows = Vec::new();
    for robot in robots {
        let states = robot.ensemble.runs.iter().take(1).flat_map(|run| &run.states);
        rows.extend(states.filter_map(|state| row(robot, state.actuator_kpa)));
    }
    let heads = vec!["robot", "kPa", "tip up mm", "tip down mm", "down over up %", "at rest"];
    let caption = "Finite elements on the way up and down again, mean ± standard deviation over seeds";
    TextTable { caption, heads, left: 1, rows }
}

/// Energies of both engines at the highest pressure of every robot.
pub fn ledgers(robots: &[EngineRobot]) -> TextTable {
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
            row.push(or_dash(lost, 0));
            rows.push(row);
        }
        if let Some(carrier) = pair.carrier {
            let without = 100.0 * carrier.difference_without;
            let mut row = vec![String::new(), format!("carried by: {} ({without:+.0} % without)", carrier.term)];
            row.resize(TERMS.len() + 3, String::new());
            rows.push(row);
        }
    }
    let heads = ["robot", "engine"].into_iter().chain(TERMS).chain(["lost"]).collect();
    let caption = "Ledgers at the highest pressure [mJ]: gas −P ΔV, what is stored, what was lost";
    TextTable { caption, heads, left: 2, rows }
}

/// Volumes of every robot at its own body pressure; quotients with their standard deviation over the seeds.
pub fn volume_table(robots: &[EngineRobot]) -> TextTable {
    let mut rows = Vec::new();
    for body in robots.iter().flat_map(|robot| &robot.bodies).filter(|body| body.own) {
        for v in &body.states {
            let mut row = vec![body.actuator.clone(), format!("{:.0}", v.actuator_kpa)];
            row.extend([v.body_lost_cm3, v.by_bend_cm3, v.actuator_cm3].map(|v| format!("{:.1}", v.0)));
            row.extend([v.displaced, v.lens_share].map(|v| v.map_or("–".into(), |v| plus_minus(v, 3))));
            rows.push(row);
        }
    }
    let heads = vec![
        "robot",
        "actuator kPa",
        "body lost",
        "πR³ × turn",
        "actuator",
        "displaced per actuator volume (χ)",
        "share of the ideal lens",
    ];
    let caption = "Volumes [cm³], mean over seeds: what the bodies of the finite elements lose, and what the \
        reduced model knows of it";
    TextTable { caption, heads, left: 1, rows }
}
