//! A scenario with and without effects on other data.

use crate::tables::{number, table};
use compare::validation::{BeforeAfter, Validation};
use serde_json::{Value, json};

/// `ibr.validate`
pub fn to_json(file: &str, both: &BeforeAfter, found: &[Validation]) -> Value {
    let bending = json!({"before": both.before.bending_stiffness, "after": both.after.bending_stiffness});
    json!({
        "schema": "ibr.validate", "version": 1, "scenario_file": file, "added": both.effects, "bending_nm2": bending,
        "datasets": found,
    })
}

/// For readers.
pub fn text(file: &str, both: &BeforeAfter, found: &[Validation]) -> String {
    let mut out = format!(
        "{file}: {} on other data, nothing refitted (B {:.3} N m² with, {:.3} without)\n",
        both.effects.join(" and "),
        both.after.bending_stiffness,
        both.before.bending_stiffness
    );
    let levels = |l: &[f64]| l.iter().map(f64::to_string).collect::<Vec<_>>().join(", ");
    let row = |v: &Validation| {
        let words = [v.data.clone(), levels(&v.p_act_kpa), levels(&v.p_body_kpa), v.runs.to_string()];
        let errors = [v.noise_floor_mm, Some(v.before.beyond_noise_mm), Some(v.after.beyond_noise_mm)];
        let chi = [v.before.reduced_chi2, v.after.reduced_chi2];
        [&words[..], &errors.map(|mm| number(mm, 2)), &chi.map(|c| number(c, 1))].concat()
    };
    let head =
        ["data", "actuator kPa", "body kPa", "runs", "noise mm", "before mm", "after mm", "χ²/dof before", "after"];
    out.push_str(&table(&head, 1, found.iter().map(row).collect()));
    for v in found {
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
