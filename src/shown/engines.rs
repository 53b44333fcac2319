//! Both engines in words.

use crate::prelude::*;
use compare::study::engines::{
    BodyVolumes, EngineLine, EnginePair, Engines, branches, ledgers, line_table, summary, volume_table,
};

/// `ibr.engines`: `ibr compare --engines`
#[derive(Serialize)]
pub(crate) struct EnginesAnswer<'a> {
    /// Every source at every pressure
    pub lines: &'a [EngineLine],
    /// Ledgers of both engines
    pub ledgers: Vec<RobotLedgers<'a>>,
    /// Volumes of body and actuator
    pub volumes: Vec<&'a BodyVolumes>,
}

/// Ledgers of a robot.
#[derive(Serialize)]
pub(crate) struct RobotLedgers<'a> {
    /// Name of the robot
    pub robot: &'a str,
    /// Ledgers of both engines, by pressure
    pub pairs: &'a [EnginePair],
}

impl<'a> EnginesAnswer<'a> {
    pub(crate) fn of(lines: &'a [EngineLine], engines: &'a Engines) -> EnginesAnswer<'a> {
        let ledgers = engines.robots.iter().map(|r| RobotLedgers { robot: &r.scenario.name, pairs: &r.pairs });
        let volumes = engines.robots.iter().flat_map(|r| &r.bodies).collect();
        EnginesAnswer { lines, ledgers: ledgers.collect(), volumes }
    }
}

/// Tables of a comparison of both engines.
pub(crate) fn text(lines: &[EngineLine], Engines { robots, .. }: &Engines) -> Result<String, Failure> {
    let tables = [summary(robots)?, line_table(lines), branches(robots), ledgers(robots), volume_table(robots)];
    Ok(tables.iter().filter(|table| !table.rows.is_empty()).map(printed).collect::<Vec<_>>().join("\n"))
}
