//! Both engines in words.

use crate::failure::Failure;
use crate::tables::printed;
use compare::study::engines::{EngineLine, Engines, branches, ledgers, line_table, summary, volume_table};

/// Tables of a comparison of both engines.
pub fn text(lines: &[EngineLine], Engines { robots, .. }: &Engines) -> Result<String, Failure> {
    let tables = [summary(robots)?, line_table(lines), branches(robots), ledgers(robots), volume_table(robots)];
    Ok(tables.iter().filter(|table| !table.rows.is_empty()).map(printed).collect::<Vec<_>>().join("\n"))
}
