use super::Result;
use crate::prelude::*;
use compare::study::engines::{EnginePair, EngineRobot, Engines, PartingMap, TERMS};
use data::published::printed;
use models::actuators::Family;
use report::{self as plots, number};

/// Share at which the colour of a map saturates.
const STRONGEST: f64 = 1.5;

pub(crate) fn parting_plot(map: &PartingMap) -> Result<Drawn> {
    let mut columns: Vec<f64> = map.rows.iter().flat_map(|r| r.1.iter().map(|p| p.actuator_kpa)).collect();
    columns.sort_by(f64::total_cmp);
    columns.dedup_by(|a, b| (*a - *b).abs() < 0.05);
    let mut marks = Vec::new();
    for (row, (_, pairs)) in map.rows.iter().enumerate() {
        for (column, kpa) in columns.iter().enumerate() {
            let found = pairs.iter().find(|p| (p.actuator_kpa - kpa).abs() < 0.05);
            let share = found.and_then(EnginePair::difference).unwrap_or(f64::NAN);
            // Where the models do not part, the cell is pale.
            let strength = if found.is_some_and(EnginePair::parts) {
                share.signum() * (share.abs() / STRONGEST).max(0.15)
            } else {
                0.0 * share
            };
            let sign = if share > 0.0 { "+" } else { "" };
            let words = if share.is_finite() { format!("{sign}{} %", number(100.0 * share, 0)) } else { "–".into() };
            let carrier = found.and_then(|p| p.carrier).and_then(|c| c.term.split(' ').next_back()).unwrap_or_default();
            marks.push(Mark::Cell([row, column], strength, words, carrier.into()));
        }
    }
    let head = |kpa: &f64| ChartColumn { name: format!("{kpa:.0}"), ..ChartColumn::default() };
    let rows = map.rows.iter().map(|r| ChartRow::beside(&r.0)).collect();
    let space = Space::Grid(rows, columns.iter().map(head).collect());
    let heat = Some(("reduced tip minus finite element tip [% of the latter]".into(), 100.0 * STRONGEST));
    let title = format!("{}: where the models part", map.actuator);
    let mut chart = Chart::new(title, "actuator pressure [kPa]", &map.row_label);
    (chart.space, chart.marks, chart.heat) = (space, marks, heat);
    Ok(chart.draw("breakdown map")?)
}

/// Displacements at the highest pressure; `None` without runs.
pub(super) fn bars(engines: &Engines) -> Result<Option<Drawn>> {
    let shown: Vec<&EngineRobot> =
        engines.robots.iter().filter(|r| r.published.is_some() && !r.pairs.is_empty()).collect();
    if shown.is_empty() {
        return Ok(None);
    }
    let series = |name: &str, of: &dyn Fn(&EngineRobot) -> f64, grey| {
        (name.to_string(), shown.iter().map(|r| of(r)).collect(), grey)
    };
    let last = |r: &EngineRobot| r.pairs.last().cloned();
    let name = |r: &&EngineRobot| r.published.as_ref().map_or(String::new(), |p| printed(&p.kind).into());
    let groups: Vec<String> = shown.iter().map(name).collect();
    let series = [
        series("reduced, as shipped", &|r| last(r).map_or(f64::NAN, |p| p.reduced_mm[0]), false),
        series("reduced, with effects", &|r| r.with_effects.as_ref().map_or(f64::NAN, |g| g.y_m * 1e3), false),
        series("finite elements", &|r| r.ensemble.at(30.0).map_or(f64::NAN, |[marker, _]| marker.0), false),
        series("measured", &|r| r.published.as_ref().map_or(f64::NAN, |p| p.d_max_m * 1e3), true),
    ];
    Ok(Some(plots::bars("Outermost marker at 30 kPa", "displacement [mm]", &groups, &series, None)?))
}

/// Outermost marker over pressure: both engines, every seed of the finite elements.
pub(super) fn curve(robot: &EngineRobot) -> Result<Drawn> {
    let reduced = robot.pairs.iter().map(|p| [p.actuator_kpa, p.reduced_mm[0]]);
    let reduced = std::iter::once([0.0, 0.0]).chain(reduced).collect();
    let mut all = vec![LineSeries::new("reduced, as shipped", LineStyle::LinePoints, reduced)];
    let ensemble = &robot.ensemble;
    if let Some(run) = ensemble.runs.first() {
        let states = run.states.iter().filter_map(|s| Some((s.actuator_kpa, ensemble.at(s.actuator_kpa)?[0])));
        let (points, spread): (Vec<[f64; 2]>, Vec<f64>) =
            states.map(|(kpa, (mean, sd))| ([kpa, mean], sd.unwrap_or(0.0))).unzip();
        let name = match ensemble.runs.len() {
            1 => "finite elements".to_string(),
            n => format!("finite elements, mean and sd of {n} seeds"),
        };
        all.push(LineSeries::new(name, LineStyle::LinePoints, points).with_errors(spread).coloured(1));
    }
    if let Some(p) = &robot.published {
        let at = vec![[p.d_max_pressure_pa * 1e-3, p.d_max_m * 1e3]];
        all.push(LineSeries::new("measured", LineStyle::OpenPoints, at).coloured(3));
    }
    let title = format!("{}: outermost marker over pressure", robot.scenario.actuator.kind.name);
    let (x, y) = ("actuator pressure [kPa]", "displacement of the outermost marker [mm]");
    Ok(plots::lines(&Lines::new(title, x, y, all))?)
}

fn ledger_cases(robot: &EngineRobot) -> Vec<plots::LedgerCase> {
    let ahead_cm3 = ahead_cm3(robot);
    let mut cases = Vec::new();
    for p in &robot.pairs {
        let mut fe_mj = p.fe_mj;
        fe_mj[0] += p.actuator_kpa * ahead_cm3;
        for (engine, energies) in [("reduced", p.reduced_mj), ("finite elements", fe_mj)] {
            cases.push((format!("{:.0} kPa, {engine}", p.actuator_kpa), energies.to_vec()));
        }
    }
    cases
}

/// By how much the finite elements' muscle, which is flat at first, has gained more than the reduced model's, which is round
/// from the start, at the first pressure; pouches are flat in both.
fn ahead_cm3(robot: &EngineRobot) -> f64 {
    let is_muscle = !robot.scenario.actuator.kind.has_pouches();
    let first = robot.pairs.iter().find(|p| is_muscle && p.actuator_kpa > 0.0);
    // mJ over kPa are cm³.
    first.map_or(0.0, |p| (p.reduced_mj[0] - p.fe_mj[0]) / p.actuator_kpa)
}

pub(super) fn ledger(robot: &EngineRobot) -> Result<Drawn> {
    let first = robot.pairs.first().map_or(0.0, |p| p.actuator_kpa);
    let title = format!("{}: where the energy is", robot.scenario.actuator.kind.name);
    let label = match robot.scenario.actuator.kind.family {
        Family::Pouch => "potential energy [mJ]".into(),
        Family::Mckibben => format!("potential energy [mJ]; gas beyond what fills the muscle at {first:.0} kPa"),
    };
    Ok(plots::ledger(&title, &label, &TERMS.map(String::from), &ledger_cases(robot))?)
}

#[cfg(test)]
mod tests {
    use super::*;
    use compare::study::engines::{engines, stored};
    use compare::study::published::shipped_scenario;

    #[test]
    fn the_gas_of_a_muscle_is_counted_from_the_same_zero_in_both_engines() {
        let robots = ["fpam", "epam"].map(|kind| shipped_scenario(kind).unwrap());
        let robots = engines(&robots, &stored().unwrap()).unwrap().robots;
        let gas = |robot: &EngineRobot| ledger_cases(robot).iter().map(|c| c.1[0]).collect::<Vec<_>>();
        let [muscle, pouches] = [gas(&robots[0]), gas(&robots[1])];
        assert!((muscle[0] - muscle[1]).abs() < 1e-9 && muscle[0] < 0.0, "{muscle:?}");
        assert!(muscle[muscle.len() - 1] < muscle[muscle.len() - 2], "filled more beyond: {muscle:?}");
        let last = robots[1].pairs.last().unwrap();
        assert_eq!(pouches[pouches.len() - 2..], [last.reduced_mj[0], last.fe_mj[0]]);
    }
}
