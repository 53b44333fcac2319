//! Both engines, line by line: every source at every pressure.

use super::{EngineRobot, Ensemble};
use crate::accuracy::paper_accuracy;
use crate::error::CompareError;
use crate::policy;
use crate::study::columns::TextColumn;
use crate::study::published::heights_m;
use models::{Known, Loads};

/// One source's displacements of one robot at one pressure.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct EngineLine {
    /// Printed name of a published robot, else the name of its scenario.
    pub robot: String,
    /// Actuator pressure \[kPa\].
    pub actuator_kpa: f64,
    /// Publication, model or finite element runs that give the numbers.
    pub source: String,
    /// How the numbers are known, such as `published` or `assumed`.
    pub known: String,
    /// Displacement of the outermost marker \[mm\].
    pub marker_mm: Option<f64>,
    /// Its standard deviation over the seeds \[mm\].
    pub spread_mm: Option<f64>,
    /// Displacement of the end of the robot \[mm\].
    pub tip_mm: Option<f64>,
    /// The paper's accuracy: as printed, or of the outermost marker against the measured displacement.
    pub accuracy: Option<f64>,
}

/// Columns of `engines.csv` with their values as text.
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

/// Lines of one robot at the printed pressures, or at the pressures of its run.
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
        let pair = marker_mm.zip(measured_mm).filter(|(a, b)| a != b);
        let judged = pair.and_then(|(model, measured)| paper_accuracy(&[model], &[measured]));
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
