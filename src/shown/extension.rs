//! Errors on the way to an extended scenario.

use crate::tables::{number, table};
use compare::diagnosis::words::three;
use compare::extension::ErrorStep;
use compare::ladder::Climb;

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
