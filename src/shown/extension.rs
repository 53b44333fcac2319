//! Errors on the way to an extended scenario.

use crate::tables::{number, table};
use compare::diagnosis::words::three;
use compare::extension::{Addition, ErrorStep, Extension, today};
use compare::ladder::Climb;
use compare::{CompareError, Evidence, ScenarioFile};
use serde_json::{Map, Value, json};

/// Errors on the way as a text table.
pub fn steps_text(steps: &[ErrorStep], noise_floor_mm: Option<f64>) -> String {
    let head = ["model", "how known", "training mm", "left-out pressures mm", "left-out runs mm", "B N m²"];
    let row = |step: &ErrorStep| {
        let errors = [Some(step.training_mm), step.heldout_pressure_mm, step.heldout_run_mm].map(|mm| number(mm, 2));
        [vec![step.model.clone(), step.how_known.into()], errors.to_vec(), vec![three(step.bending_nm2)]].concat()
    };
    let floor = noise_floor_mm.map_or("noise unknown with one run: root-mean-square errors".to_string(), |n| {
        format!("noise of the mean {n:.2} mm, already taken off")
    });
    format!("Error beyond noise ({floor})\n{}", table(&head, 2, steps.iter().map(row).collect()))
}

/// A climb as text.
pub fn climb_text(climb: &Climb) -> String {
    let mut out = steps_text(&climb.rungs, climb.noise_floor_mm);
    climb.told.iter().for_each(|s| out.push_str(&format!("  - {s}\n")));
    if climb.steps.len() > 1 {
        out.push_str("Effects of earlier steps keep the values of their step; B is fitted anew on each.\n");
    }
    if !climb.steps.is_empty() {
        out.push_str("A smaller error does not prove a name: `ibr validate` tries it on data it was not fitted to.\n");
    }
    out
}

/// An extension for programs.
///
/// # Errors
/// A table that cannot be written.
pub fn to_json(
    file: &ScenarioFile,
    evidence: &[Evidence],
    found: &Extension,
    target: &str,
) -> Result<Value, CompareError> {
    let effect = |a: &Addition| {
        let fitted = found.fitted.iter().find(|f| f.effect == a.name).map(|f| &f.parameters);
        let values: Map<String, Value> = a.values.iter().map(|(k, v)| (k.clone(), json!(v))).collect();
        json!({"effect": a.name, "how_known": a.basis, "values": values, "parameters": fitted})
    };
    let data = |e: &Evidence| Ok(json!({"name": e.name, "sha256": e.sha256()?}));
    let data = evidence.iter().map(data).collect::<Result<Vec<Value>, CompareError>>()?;
    Ok(json!({
        "schema": "ibr.add", "version": 1,
        "scenario_file": file.name, "scenario_sha256": file.sha256(), "written": target,
        "effects": found.additions.iter().map(effect).collect::<Vec<_>>(),
        "bending_nm2": found.bending.as_ref().map(|b| b.value_nm2),
        "before": found.steps.iter().rev().nth(1), "after": found.steps.last(), "rungs": found.steps,
        "noise_floor_mm": found.noise_floor_mm,
        "data": data.first(), "also": data.iter().skip(1).collect::<Vec<_>>(),
        "date": today(), "warnings": found.warnings,
    }))
}
