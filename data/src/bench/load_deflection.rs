//! A beam: tip deflection under a transverse load, at a body pressure. One end is clamped.

use super::kind::{BenchKind, BenchRow, scatter};
use crate::columns::{Field, field, plain};
use crate::policy;
use crate::units::MeasuredQuantity::{Force, Length, Pressure};
use spelling::units::Range;

pub(super) const ENTRY: BenchKind = BenchKind {
    name: "load_deflection",
    sentence: "tip deflection of an inflated cantilever under a transverse tip load",
    columns: COLUMNS,
    check,
};

const COLUMNS: &[Field] = &[
    field("p_body", "p_body_kpa", Pressure, true),
    field("load", "load_n", Force, true),
    field("deflection", "deflection_mm", Length, true),
    field("deflection_sd", "deflection_sd_mm", Length, false),
    plain("n", false),
    field("radius", "radius_mm", Length, false),
];

fn check(row: &BenchRow) -> Result<(), [String; 2]> {
    let (p, f, v) = (row.value("p_body"), row.value("load"), row.value("deflection"));
    Range::BODY_PRESSURE.check(p).map_err(|(message, help)| [message, help.into()])?;
    if f < 0.0 || v < 0.0 {
        let message = format!("a load of {f} N and a deflection of {} mm", 1e3 * v);
        return Err([message, "write both as positive numbers along the load".into()]);
    }
    match row.get("radius") {
        Some(r) if !(r > policy::SHORTEST_ROBOT_M && r < 10.0) => {
            let help = "write the body's radius in the unit of the column's name, for example 80 below radius_mm";
            Err([format!("the radius is {} mm", 1e3 * r), help.into()])
        }
        _ => scatter(row, "deflection_sd"),
    }
}
