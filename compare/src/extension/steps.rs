//! From a diagnosis to the text written into a scenario, and the error before and after.

use super::text::{Addition, BENDING, BodyValue, today};
use crate::diagnosis::words::three;
use crate::diagnosis::{Diagnosis, LearnedLaw, ParameterValue, Ranked, in_step, taken_away};
use models::{Known, Scenario};
use serde::Serialize;

/// A model on the way from the scenario as given to the extended one.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ErrorStep {
    /// Short description of the model in words.
    pub model: String,
    /// How its newest value is known.
    pub how_known: &'static str,
    /// Error beyond noise on the data of the fit \[mm\].
    pub training_mm: f64,
    /// The same at actuator pressures left out of the fit \[mm\].
    pub heldout_pressure_mm: Option<f64>,
    /// The same for runs left out of the fit \[mm\].
    pub heldout_run_mm: Option<f64>,
    /// B at the scenario's body pressure \[N·m²\].
    pub bending_nm2: f64,
}

impl ErrorStep {
    /// The model and how its newest value is known.
    pub fn label(&self) -> String {
        let (model, how_known) = (&self.model, self.how_known);
        if model.ends_with(how_known) { model.clone() } else { format!("{model} ({how_known})") }
    }
}

/// Errors of the scenario as given, calibrated, and with what the verdict adds or what was attempted.
pub fn error_steps(d: &Diagnosis, scenario: &Scenario) -> Vec<ErrorStep> {
    let ground = Ground::new(d, scenario);
    let last = d.final_model().map(|_| ground.verdict_step());
    ground.first_steps().into_iter().chain(last).collect()
}

pub(crate) struct Ground<'a> {
    pub d: &'a Diagnosis,
    /// Which of the fitted stiffnesses is the scenario's.
    level: usize,
}

impl<'a> Ground<'a> {
    pub(crate) fn new(d: &'a Diagnosis, scenario: &Scenario) -> Ground<'a> {
        Ground { d, level: d.level(1e-3 * scenario.p_body_pa) }
    }

    /// Of one B per body pressure, the one at the scenario's pressure; the scenario's own B if it was kept.
    pub(crate) fn bending(&self, values_nm2: &[f64]) -> f64 {
        values_nm2.get(self.level).copied().unwrap_or(self.d.base.bending_nominal_nm2)
    }

    pub(crate) fn base_bending(&self) -> f64 {
        let values: Vec<f64> = self.d.base.bending.iter().map(|b| b.value_nm2).collect();
        self.bending(&values)
    }

    fn fits_bending(&self) -> bool {
        !self.d.base.bending.is_empty()
    }

    /// An effect to write, with the data that a fit used and today's date.
    pub(crate) fn addition(&self, name: &str, values: Vec<(String, f64)>, known: Known) -> Addition {
        Addition {
            data: self.d.evidence.iter().map(|used| [used.words.clone(), used.sha256.clone()]).collect(),
            bending_without_nm2: self.fits_bending().then(|| self.base_bending()),
            ..Addition::of(name, values, known, self.d.ranked(name).map(|r| r.sentence.clone()))
        }
    }

    pub(crate) fn calibrated(&self, name: &str, values: &[ParameterValue]) -> Addition {
        let interval = |p: &ParameterValue| match p.held {
            true => Some(format!("{} held, not fitted", p.key)),
            false => Some(format!("{} {} to {} (95 %)", p.key, three(p.lo?), three(p.hi?))),
        };
        if taken_away(name).is_some() {
            return self.addition(name, Vec::new(), Known::Calibrated);
        }
        let plain = values.iter().map(|p| (p.key.clone(), p.value)).collect();
        Addition {
            interval: values.iter().filter_map(interval).collect::<Vec<_>>().join(", "),
            ..self.addition(name, plain, Known::Calibrated)
        }
    }

    pub(crate) fn new_bending(&self, value: f64) -> Option<BodyValue> {
        let remark = format!("calibrated on {} ({})", self.d.dataset, today());
        self.fits_bending().then_some(BodyValue { key: BENDING, value, remark })
    }

    pub(crate) fn first_steps(&self) -> Vec<ErrorStep> {
        let base = &self.d.base;
        let (model, known) = ("scenario as given", Known::Assumed);
        if !self.fits_bending() {
            return vec![self.base_step(model, known)];
        }
        let training_mm = base.systematic_nominal_mm;
        let given = step(model, known.word(), training_mm, [None; 2], base.bending_nominal_nm2);
        vec![given, self.base_step("B calibrated", Known::Calibrated)]
    }

    pub(crate) fn base_step(&self, model: &str, known: Known) -> ErrorStep {
        let base = &self.d.base;
        let held_out = [base.heldout_mm, base.heldout_run_mm];
        step(model, known.word(), base.systematic_mm, held_out, self.base_bending())
    }

    pub(crate) fn ranked_step(&self, r: &Ranked) -> ErrorStep {
        let bending_nm2 = self.bending(&r.bending_nm2);
        let (model, known) = (in_step(&r.effect), Known::Calibrated.word());
        let held_out = [r.heldout_mm, r.heldout_run_mm];
        step(&model, known, r.systematic_after_mm, held_out, bending_nm2)
    }

    pub(crate) fn learned_step(&self, law: &LearnedLaw) -> ErrorStep {
        let bending_nm2 = self.bending(&law.bending_nm2);
        let (model, known) = (format!("+ {}", law.name), Known::Calibrated.word());
        let held_out = [law.heldout_after_mm, law.heldout_run_after_mm];
        step(&model, known, law.after_mm, held_out, bending_nm2)
    }

    /// The final model of the diagnosis, or the one that it attempted.
    pub(crate) fn verdict_step(&self) -> ErrorStep {
        let base = &self.d.base;
        let (model, how_known) = self.d.final_model().unwrap_or_default();
        let held_out = [base.heldout_with_added_mm, base.heldout_run_with_added_mm];
        step(&model, how_known, base.systematic_with_added_mm, held_out, self.bending(&base.bending_with_added_nm2))
    }

    pub(crate) fn warnings(&self) -> Vec<String> {
        let mut warnings = self.d.warnings.clone();
        if self.d.base.bending.len() > 1 {
            let all: Vec<String> = self.d.base.bending.iter().map(|b| format!("{} kPa", b.p_body_kpa)).collect();
            warnings.push(format!(
                "the data have several body pressures ({}) with a fitted B each; a scenario has one B, and gets the B at {} kPa",
                all.join(", "),
                self.d.base.bending[self.level].p_body_kpa
            ));
        }
        warnings
    }
}

/// Errors at pressures and for runs left out come as a pair.
fn step(
    model: &str,
    how_known: &'static str,
    training_mm: f64,
    [heldout_pressure_mm, heldout_run_mm]: [Option<f64>; 2],
    bending_nm2: f64,
) -> ErrorStep {
    ErrorStep { model: model.into(), how_known, training_mm, heldout_pressure_mm, heldout_run_mm, bending_nm2 }
}
