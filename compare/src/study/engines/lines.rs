//! Both engines in rows of text: every pressure, and one row per robot.

use super::{EngineRobot, Ensemble, MeanOverSeeds, accuracy};
use crate::error::CompareError;
use crate::policy;
use crate::study::uncertain::Uncertain;
use models::Known;
use models::{Loads, Model, Scenario};

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

/// One robot in a row for every way that it may be made: the displacement at the pressure of the measurement; none without one.
///
/// # Errors
/// A model without equilibrium.
pub fn summary(robot: &EngineRobot) -> Result<Vec<Vec<String>>, CompareError> {
    let Some(printed) = &robot.published else { return Ok(Vec::new()) };
    let (kpa, measured) = (printed.d_max_pressure_pa * 1e-3, printed.d_max_m * 1e3);
    let loads = Loads::uniform(robot.scenario.p_body_pa, printed.d_max_pressure_pa);
    let with = robot.with_effects.as_ref().map(|rung| heights(&rung.scenario, &loads)).transpose()?;
    let bare = heights(&robot.scenario.bare(), &loads)?[0];
    let recommended = match robot.ensemble.at(kpa).map(|[marker, _]| marker) {
        Some((mean, Some(spread))) => format!("{mean:.1} ± {spread:.1}"),
        Some((mean, None)) => format!("{mean:.1}"),
        None => "–".into(),
    };
    let row = |made: &str, interval: Option<[f64; 3]>, recommended: &str| {
        let [middle, ends, inside] = match interval {
            Some([low, middle, high]) => [
                format!("{middle:.1}"),
                format!(
                    "{low:.1} to {high:.1} ({:+.0} to {:+.0} %)",
                    100.0 * (low / middle - 1.0),
                    100.0 * (high / middle - 1.0)
                ),
                if (low..=high).contains(&measured) { "inside" } else { "outside" }.to_string(),
            ],
            None => ["–"; 3].map(String::from),
        };
        let reduced = with.map_or("–".into(), |mm| format!("{:.1}", mm[0]));
        let name = printed.printed_name.clone();
        vec![
            name,
            made.into(),
            format!("{measured:.1}"),
            format!("{bare:.1}"),
            reduced,
            middle,
            ends,
            inside,
            recommended.into(),
        ]
    };
    if robot.uncertain.is_empty() {
        return Ok(vec![row("as recommended", None, &recommended)]);
    }
    let own = |cube: &Uncertain| if cube.variant.is_empty() { recommended.clone() } else { "–".into() };
    let made =
        |cube: &Uncertain| if cube.variant.is_empty() { "as recommended".to_string() } else { cube.variant.clone() };
    Ok(robot.uncertain.iter().map(|cube| row(&made(cube), cube.tip_mm(kpa), &own(cube))).collect())
}

/// Heads of [`summary`].
pub const SUMMARY: [&str; 9] = [
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

/// Cells of a line: robot, pressure, source, how known, marker, its spread, tip, accuracy.
pub fn cells(line: &EngineLine) -> Vec<String> {
    let mm = |v: Option<f64>| v.map_or("–".into(), |v| format!("{v:.1}"));
    vec![
        line.robot.clone(),
        format!("{:.0}", line.actuator_kpa),
        line.source.clone(),
        line.known.clone(),
        mm(line.marker_mm),
        mm(line.spread_mm),
        mm(line.tip_mm),
        line.accuracy.map_or("–".into(), |a| format!("{:.1}", 100.0 * a)),
    ]
}

/// Heads of these cells.
pub const HEADS: [&str; 8] =
    ["robot", "kPa", "source", "how known", "marker mm", "sd of seeds mm", "tip mm", "accuracy %"];

/// Heads of [`branch_cells`].
pub const BRANCHES: [&str; 6] = ["robot", "kPa", "tip up mm", "tip down mm", "down over up %", "at rest"];

/// Tips of the finite elements at every pressure of every robot on the way up and on the way down again, mean and standard deviation
/// over the seeds; no rows for runs that did not come down.
pub fn branch_cells(robots: &[EngineRobot]) -> Vec<Vec<String>> {
    let mm = |(mean, spread): (f64, Option<f64>)| match spread {
        Some(spread) => format!("{mean:.1} ± {spread:.1}"),
        None => format!("{mean:.1}"),
    };
    let row = |robot: &EngineRobot, kpa: f64| {
        let ([_, up], down) = (robot.ensemble.at(kpa)?, robot.ensemble.back_at(kpa)?);
        let rest = if robot.ensemble.is_at_rest(kpa) { "yes" } else { "no" };
        let more = format!("{:+.1}", 100.0 * (down.0 / up.0 - 1.0));
        Some(vec![robot.scenario.actuator.kind.name.into(), format!("{kpa:.0}"), mm(up), mm(down), more, rest.into()])
    };
    let of = |robot: &EngineRobot| {
        let states = robot.ensemble.runs.first().map_or(&[][..], |run| &run.states);
        states.iter().filter_map(|state| row(robot, state.actuator_kpa)).collect::<Vec<_>>()
    };
    robots.iter().flat_map(of).collect()
}

/// Heads of [`volume_cells`].
pub const VOLUMES: [&str; 7] = [
    "robot",
    "actuator kPa",
    "body lost",
    "πR³ × turn",
    "actuator",
    "displaced per actuator volume (χ)",
    "share of the ideal lens",
];

/// Caption of that table.
pub const VOLUMES_CAPTION: &str = "Volumes [cm³], mean over seeds: what the bodies of the finite elements lose, and what the \
    reduced model knows of it";

/// Volumes of every robot at its own body pressure; quotients with their standard deviation over the seeds.
pub fn volume_cells(robots: &[EngineRobot]) -> Vec<Vec<String>> {
    let cm3 = |v: MeanOverSeeds| format!("{:.1}", v.0);
    let share = |v: Option<MeanOverSeeds>| match v {
        Some((mean, Some(spread))) => format!("{mean:.3} ± {spread:.3}"),
        Some((mean, None)) => format!("{mean:.3}"),
        None => "–".into(),
    };
    let mut rows = Vec::new();
    for body in robots.iter().flat_map(|robot| &robot.bodies).filter(|body| body.own) {
        for v in &body.states {
            let mut row = vec![body.actuator.clone(), format!("{:.0}", v.actuator_kpa)];
            row.extend([v.body_lost_cm3, v.by_bend_cm3, v.actuator_cm3].map(cm3));
            row.extend([v.displaced, v.lens_share].map(share));
            rows.push(row);
        }
    }
    rows
}

/// Lines as CSV.
pub fn csv(lines: &[EngineLine]) -> String {
    let mut out = String::from("robot,p_act_kpa,source,how_known,marker_mm,marker_sd_mm,tip_mm,accuracy\n");
    let cell = |v: Option<f64>| v.map_or(String::new(), |v| v.to_string());
    for l in lines {
        let numbers = [l.marker_mm, l.spread_mm, l.tip_mm, l.accuracy].map(cell).join(",");
        let text = [&l.robot, &l.source, &l.known].map(|t| t.replace(',', ";"));
        out.push_str(&format!("{},{},{},{},{numbers}\n", text[0], l.actuator_kpa, text[1], text[2]));
    }
    out
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
    let loads = Loads::uniform(robot.scenario.p_body_pa, kpa * 1e3);
    let own = if printed.is_some() { "reduced, as shipped" } else { "reduced, as in the scenario" };
    let [marker, tip] = heights(&robot.scenario, &loads)?.map(Some);
    line(own, Known::Predicted.word(), [marker, None, tip], None);
    if let Some(rung) = &robot.with_effects {
        let [marker, tip] = heights(&rung.scenario, &loads)?.map(Some);
        line("reduced, with effects", Known::Assumed.word(), [marker, None, tip], None);
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

fn heights(scenario: &Scenario, loads: &Loads) -> Result<[f64; 2], CompareError> {
    let model = Model::new(scenario);
    let mut at = model.prediction();
    model.predict(loads, &mut at)?;
    Ok([at.markers.last().map_or(at.tip.y_m, |xy| xy[1]) * 1e3, at.tip.y_m * 1e3])
}
