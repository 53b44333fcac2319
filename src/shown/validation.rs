//! A scenario with and without effects on other data.

use crate::prelude::*;
use compare::validation::{BeforeAfter, Validation};
use data::CorrectionTable;

/// `ibr.validate`: `ibr validate SCENARIO DATA`
#[derive(Serialize)]
pub struct ValidateAnswer<'a> {
    /// Path or name of the scenario or of the correction as typed
    pub scenario_file: &'a str,
    /// Effects that `ibr add` wrote and the data judge
    pub added: &'a [String],
    /// Bending stiffness without and with the effects; null for a correction of another simulator's predictions
    pub bending_nm2: Option<TwoStiffnesses>,
    /// One for each of the data
    pub datasets: &'a [Validation],
}

/// A bending stiffness without and with effects.
#[derive(Serialize)]
pub struct TwoStiffnesses {
    /// Bending stiffness of the scenario without them
    pub before: f64,
    /// Bending stiffness of the scenario with the effects
    pub after: f64,
}

impl<'a> ValidateAnswer<'a> {
    /// Of a scenario, as typed, and what was found.
    pub fn of(scenario_file: &'a str, both: &'a BeforeAfter, datasets: &'a [Validation]) -> ValidateAnswer<'a> {
        let bending_nm2 = TwoStiffnesses { before: both.before.bending_stiffness, after: both.after.bending_stiffness };
        ValidateAnswer { scenario_file, added: &both.effects, bending_nm2: Some(bending_nm2), datasets }
    }

    /// Of a correction of another simulator's predictions.
    pub fn of_correction(correction: &'a CorrectionTable, datasets: &'a [Validation]) -> ValidateAnswer<'a> {
        ValidateAnswer { scenario_file: &correction.file, added: &correction.effects, bending_nm2: None, datasets }
    }
}

/// Text of a validation as the command prints it.
pub fn text(answer: &ValidateAnswer) -> String {
    let ValidateAnswer { scenario_file: file, added, bending_nm2, datasets: found } = answer;
    let stiffness = bending_nm2.as_ref().map_or(String::new(), |TwoStiffnesses { before, after }| {
        format!(" (B {after:.3} N m² with, {before:.3} without)")
    });
    let mut out = format!("{file}: {} on other data, nothing refitted{stiffness}\n", added.join(" and "));
    let levels = |l: &[f64]| l.iter().map(f64::to_string).collect::<Vec<_>>().join(", ");
    out += &TextTable::of(*found)
        .words("data", |v| &v.data)
        .right("actuator kPa", |v| levels(&v.p_act_kpa))
        .right("body kPa", |v| levels(&v.p_body_kpa))
        .right("runs", |v| v.runs.to_string())
        .number("noise mm", 2, |v| v.noise_floor_mm)
        .number("before mm", 2, |v| v.before.beyond_noise_mm)
        .number("after mm", 2, |v| v.after.beyond_noise_mm)
        .number("χ²/dof before", 1, |v| v.before.reduced_chi2)
        .number("after", 1, |v| v.after.reduced_chi2)
        .text();
    for v in *found {
        out.push_str(&format!("  - {}: {}.\n", v.data, v.sentence));
        if !v.geometry_of_data.is_empty() {
            out.push_str(&format!("    size of the data's robot taken: {}\n", v.geometry_of_data.join("; ")));
        }
    }
    if found.iter().all(|v| v.fitted_to_these) {
        out.push_str(
            "Only data it was not fitted to can test it: another pressure, another size, another body pressure.\n",
        );
    }
    out
}
