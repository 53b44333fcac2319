//! A muscle: force over contraction at an actuator pressure, in a testing machine. Force 0 is free contraction.

use super::kind::{BenchKind, BenchRow, scatter};
use crate::columns::{Field, field, plain};
use crate::units::MeasuredQuantity::{Angle, Force, Length, Pressure, Ratio};
use spelling::units::Range;

pub(super) const ENTRY: BenchKind = BenchKind {
    name: "force_contraction",
    sentence: "pull of a muscle over its contraction at a pressure",
    columns: COLUMNS,
    check,
};

const COLUMNS: &[Field] = &[
    field("p_act", "p_act_kpa", Pressure, true),
    field("contraction", "contraction_pct", Ratio, true),
    field("force", "force_n", Force, true),
    field("force_sd", "force_sd_n", Force, false),
    plain("n", false),
    field("diameter", "diameter_mm", Length, false),
    field("length", "length_mm", Length, false),
    field("bias", "bias_deg", Angle, false),
    plain("muscle", false),
];

fn check(row: &BenchRow) -> Result<(), [String; 2]> {
    let (p, e, f) = (row.value("p_act"), row.value("contraction"), row.value("force"));
    Range::ACTUATOR_PRESSURE.check(p).map_err(|(message, help)| [message, help.into()])?;
    if !(-0.3..0.8).contains(&e) {
        let help = "write shortening over the length at rest as positive; name the column contraction_pct if it is in per cent";
        return Err([format!("the contraction is {} %", 100.0 * e), help.into()]);
    }
    if f < 0.0 {
        return Err([format!("the force is {f} N"), "write the muscle's pull as a positive force".into()]);
    }
    match row.get("bias") {
        Some(bias) if !(bias > 5.0 && bias < 54.0) => {
            let help = "write the yarns' angle to the axis at rest; above 54.7 degrees a muscle lengthens";
            Err([format!("the yarns lie at {bias} degrees to the axis"), help.into()])
        }
        _ => scatter(row, "force_sd"),
    }
}
