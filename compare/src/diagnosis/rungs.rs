//! The fall of the error from the model as given to the extended one.

use super::Diagnosis;

/// Errors of one model on the way from bare to extended \[mm\].
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct ErrorRung {
    /// In words.
    pub label: String,
    /// On the data of the fit.
    pub training_mm: f64,
    /// At pressures left out of the fit.
    pub heldout_pressure_mm: Option<f64>,
    /// For runs left out of the fit.
    pub heldout_run_mm: Option<f64>,
}

impl Diagnosis {
    /// Names and standing of what the final model has beyond the base; `None` where that is nothing.
    pub fn final_label(&self) -> Option<String> {
        let (added, word) = match self.added.is_empty() {
            true => (&self.attempt, self.attempt_words()),
            false => (&self.added, "calibrated"),
        };
        let names: Vec<String> = added.iter().map(|a| format!("+ {}", a.effect)).collect();
        (!names.is_empty()).then(|| format!("{} ({word})", names.join(" ")))
    }

    /// As given, calibrated, and with what the verdict adds or what was attempted.
    pub fn rungs(&self) -> Vec<ErrorRung> {
        let base = &self.base;
        let rung = |label: String, training_mm, heldout_pressure_mm, heldout_run_mm| ErrorRung {
            label,
            training_mm,
            heldout_pressure_mm,
            heldout_run_mm,
        };
        let mut rungs = vec![rung("scenario as given".into(), base.systematic_nominal_mm, None, None)];
        let calibrated = if base.bending.is_empty() { "B as given" } else { "B calibrated" };
        rungs.push(rung(calibrated.into(), base.systematic_mm, base.heldout_mm, base.heldout_run_mm));
        rungs.extend(self.final_label().map(|label| {
            rung(label, base.systematic_with_added_mm, base.heldout_with_added_mm, base.heldout_run_with_added_mm)
        }));
        rungs
    }
}
