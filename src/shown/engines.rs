//! Both engines in words.

use crate::failure::Failure;
use crate::tables::table;
use crate::words::number;
use compare::study::engines::{
    BRANCHES, BodyVolumes, Energies, EngineLine, EnginePair, Engines, HEADS, SUMMARY, TERMS, VOLUMES, VOLUMES_CAPTION,
    branch_cells, cells, summary, volume_cells,
};
use serde::Serialize;

/// `ibr.engines`: `ibr compare --engines`
#[derive(Serialize)]
pub struct EnginesAnswer<'a> {
    /// Every source at every pressure
    pub lines: &'a [EngineLine],
    /// Ledgers of both engines
    pub ledgers: Vec<RobotLedgers<'a>>,
    /// Volumes of body and actuator
    pub volumes: Vec<&'a BodyVolumes>,
}

/// Ledgers of a robot.
#[derive(Serialize)]
pub struct RobotLedgers<'a> {
    /// Name of the robot
    pub robot: &'a str,
    /// Ledgers of both engines, by pressure
    pub pairs: &'a [EnginePair],
}

impl<'a> EnginesAnswer<'a> {
    /// Of all lines and robots.
    pub fn of(lines: &'a [EngineLine], engines: &'a Engines) -> EnginesAnswer<'a> {
        let ledgers = engines.robots.iter().map(|r| RobotLedgers { robot: &r.scenario.name, pairs: &r.pairs });
        let volumes = engines.robots.iter().flat_map(|r| &r.bodies).collect();
        EnginesAnswer { lines, ledgers: ledgers.collect(), volumes }
    }
}

/// Tables of a comparison of both engines.
pub fn text(lines: &[EngineLine], engines: &Engines) -> Result<String, Failure> {
    let short: Vec<Vec<String>> = engines.robots.iter().map(summary).collect::<Result<Vec<_>, _>>()?.concat();
    let title = "Outermost marker at 30 kPa; finite elements: median and 80 % interval over all numbers that nobody measured; as \
                 recommended: mean ± standard deviation over seeds";
    let mut out = if short.is_empty() { String::new() } else { format!("{title}\n{}\n", table(&SUMMARY, 1, short)) };
    out += "All pressures that the paper prints\n";
    out += &table(&HEADS, 1, lines.iter().map(cells).collect());
    let branches = "Finite elements on the way up and down again, mean ± standard deviation over seeds";
    out += &under(branches, &BRANCHES, branch_cells(&engines.robots));
    Ok(out + &ledgers(engines) + &under(VOLUMES_CAPTION, &VOLUMES, volume_cells(&engines.robots)))
}

/// A table below its title; nothing without rows.
fn under(title: &str, head: &[&str], rows: Vec<Vec<String>>) -> String {
    if rows.is_empty() { String::new() } else { format!("\n{title}\n{}", table(head, 1, rows)) }
}

fn ledgers(engines: &Engines) -> String {
    let mut rows = Vec::new();
    for robot in &engines.robots {
        let Some(pair) = robot.pairs.last() else { continue };
        let name = robot.scenario.actuator.kind.name.to_string();
        let mut row = |engine: &str, energies: Energies, lost: Option<f64>| {
            let energies = energies.map(|e| format!("{e:.0}"));
            rows.push([&[name.clone(), engine.into()][..], &energies, &[number(lost, 0)]].concat());
        };
        row("reduced", pair.reduced_mj, None);
        row("finite elements", pair.fe_mj, Some(pair.lost_mj));
        if let Some(excess) = pair.excess_mj {
            row("excess at the same bend", excess, None);
        }
        if let Some(carrier) = pair.carrier {
            let without = 100.0 * carrier.difference_without;
            let mut row = vec![String::new(), format!("carried by: {} ({without:+.0} % without)", carrier.term)];
            row.resize(TERMS.len() + 3, String::new());
            rows.push(row);
        }
    }
    if rows.is_empty() {
        return String::new();
    }
    let head = [&["robot", "engine"], &TERMS[..], &["lost"]].concat();
    let title = "Ledgers at the highest pressure [mJ]: gas −P ΔV, what is stored, what was lost";
    format!("\n{title}\n{}", table(&head, 2, rows))
}
