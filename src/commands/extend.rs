//! From a diagnosis to what is written into a scenario, and the error before and after.

use super::inputs::{self, Loaded, with_unit};
use super::tables::{number, table};
use crate::extended::{Addition, NewBending};
use crate::failure::Failure;
use crate::output::today;
use compare::diagnosis::ErrorRung;
use compare::diagnosis::{Diagnosis, ParameterValue, Ranked};
use compare::known::Known;
use data::Dataset;
use models::Scenario;
use serde::Serialize;

/// A model on the way from the scenario as given to the extended one.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Rung {
    /// In words.
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

/// A diagnosis, and the data it is about.
pub struct Ground<'a> {
    /// What was found.
    pub d: &'a Diagnosis,
    /// The data as read, those that were fitted along after the first.
    pub data: &'a [Loaded],
    /// Which of the fitted stiffnesses is the scenario's.
    level: usize,
}

impl<'a> Ground<'a> {
    /// Of a diagnosis of this scenario.
    pub fn new(d: &'a Diagnosis, scenario: &Scenario, data: &'a [Loaded]) -> Ground<'a> {
        Ground { d, data, level: d.level(1e-3 * scenario.p_body_pa) }
    }

    /// Of one B per body pressure, that of the scenario; the scenario's own if it was kept.
    pub fn bending(&self, values_nm2: &[f64]) -> f64 {
        values_nm2.get(self.level).copied().unwrap_or(self.d.base.bending_nominal_nm2)
    }

    /// B of the calibrated base.
    pub fn base_bending(&self) -> f64 {
        let values: Vec<f64> = self.d.base.bending.iter().map(|b| b.value_nm2).collect();
        self.bending(&values)
    }

    /// Whether B was fitted.
    fn fits_bending(&self) -> bool {
        !self.d.base.bending.is_empty()
    }

    /// An effect to be written.
    pub fn addition(&self, name: &str, values: Vec<(String, f64)>, known: Known) -> Addition {
        let ranked = self.d.ranked.iter().find(|r| r.effect == name);
        Addition {
            name: name.into(),
            values,
            basis: known.word(),
            interval: String::new(),
            data: self.data.iter().map(named).collect(),
            date: today(),
            bending_without_nm2: self.fits_bending().then(|| self.base_bending()),
            remarks: ranked.map(|r| r.sentence.clone()).into_iter().collect(),
        }
    }

    /// An effect whose values were fitted.
    pub fn calibrated(&self, name: &str, values: &[ParameterValue]) -> Addition {
        let interval = |p: &ParameterValue| match p.held {
            true => Some(format!("{} held, not fitted", p.key)),
            false => Some(format!("{} {} to {} (95 %)", p.key, short(p.lo?), short(p.hi?))),
        };
        let plain = values.iter().map(|p| (p.key.clone(), p.value)).collect();
        Addition {
            interval: values.iter().filter_map(interval).collect::<Vec<_>>().join(", "),
            ..self.addition(name, plain, Known::Calibrated)
        }
    }

    /// B with the effect, if it was fitted.
    pub fn new_bending(&self, value_nm2: f64) -> Option<NewBending> {
        let remark = format!("calibrated on {} ({})", self.d.dataset, today());
        self.fits_bending().then_some(NewBending { value_nm2, remark })
    }

    /// The scenario as given and with B calibrated.
    pub fn first_rungs(&self) -> Vec<Rung> {
        let base = &self.d.base;
        let given = Rung {
            model: "scenario as given".into(),
            how_known: Known::Assumed.word(),
            training_mm: base.systematic_nominal_mm,
            heldout_pressure_mm: None,
            heldout_run_mm: None,
            bending_nm2: base.bending_nominal_nm2,
        };
        let calibrated = self.base_rung("B calibrated", Known::Calibrated);
        if self.fits_bending() { vec![given, calibrated] } else { vec![calibrated_as_given(given, calibrated)] }
    }

    /// The base of the diagnosis.
    pub fn base_rung(&self, model: &str, known: Known) -> Rung {
        Rung {
            model: model.into(),
            how_known: known.word(),
            training_mm: self.d.base.systematic_mm,
            heldout_pressure_mm: self.d.base.heldout_mm,
            heldout_run_mm: self.d.base.heldout_run_mm,
            bending_nm2: self.base_bending(),
        }
    }

    /// The base with one effect fitted.
    pub fn ranked_rung(&self, r: &Ranked) -> Rung {
        Rung {
            model: format!("+ {}", r.effect),
            how_known: Known::Calibrated.word(),
            training_mm: r.systematic_after_mm,
            heldout_pressure_mm: r.heldout_mm,
            heldout_run_mm: r.heldout_run_mm,
            bending_nm2: self.bending(&r.bending_nm2),
        }
    }

    /// The final model of the diagnosis.
    pub fn verdict_rung(&self) -> Rung {
        let base = &self.d.base;
        let names: Vec<String> = self.d.added.iter().map(|a| format!("+ {}", a.effect)).collect();
        Rung {
            model: names.join(" "),
            how_known: Known::Calibrated.word(),
            training_mm: base.systematic_with_added_mm,
            heldout_pressure_mm: base.heldout_with_added_mm,
            heldout_run_mm: base.heldout_run_with_added_mm,
            bending_nm2: self.bending(&base.bending_with_added_nm2),
        }
    }

    /// What a reader of the new scenario should know.
    pub fn warnings(&self) -> Vec<String> {
        let mut warnings = self.d.warnings.clone();
        if self.d.base.bending.len() > 1 {
            let all: Vec<String> = self.d.base.bending.iter().map(|b| format!("{} kPa", b.p_body_kpa)).collect();
            warnings.push(format!(
                "the data have several body pressures ({}) with a fitted B each; a scenario has one B: that of {} kPa is written",
                all.join(", "),
                self.d.base.bending[self.level].p_body_kpa
            ));
        }
        warnings
    }
}

/// Name and runs of data, and their hash.
fn named(data: &Loaded) -> [String; 2] {
    [format!("{}, {} runs", data.dataset.name, data.dataset.runs.len()), data.input.sha256.clone()]
}

fn calibrated_as_given(given: Rung, calibrated: Rung) -> Rung {
    Rung { model: given.model, how_known: given.how_known, ..calibrated }
}

/// The effect as the diagnosis ranks it, or why it cannot be added.
pub fn ranked<'a>(d: &'a Diagnosis, name: &str) -> Result<&'a Ranked, Failure> {
    let Some(r) = d.ranked.iter().find(|r| r.effect == name) else {
        let message = format!("{name} is not a candidate on these data");
        return Err(Failure::usage(message, "`ibr diagnose` prints the candidates"));
    };
    let by_hand = format!("to add it all the same give its value, {name}=VALUE: it is then called assumed");
    if r.at_bound {
        let values: Vec<String> = r.parameters.iter().filter(|p| p.at_bound).map(value).collect();
        let message = format!(
            "the best value of {name} on these data sits on a physical bound ({}): rejected",
            values.join(", ")
        );
        return Err(Failure::usage(message, by_hand));
    }
    if r.gain < 1.0 {
        let message = format!(
            "these data do not ask for {name}: the error stays at {:.2} mm whatever its value",
            r.systematic_after_mm
        );
        return Err(Failure::usage(message, by_hand));
    }
    Ok(r)
}

/// `M_f = 0.51 N m (0.50…0.52)`, `n = 1.00 (held)`.
pub fn value(p: &ParameterValue) -> String {
    let interval = match (p.lo, p.hi) {
        (Some(lo), Some(hi)) => format!(" ({}…{})", short(lo), short(hi)),
        _ => p.held_mark().into(),
    };
    format!("{} = {}{interval}", p.symbol, with_unit(&short(p.value), &p.unit))
}

/// Three significant digits.
pub fn short(v: f64) -> String {
    let size = v.abs();
    match size {
        0.0 => "0".into(),
        s if !(1e-3..1e5).contains(&s) => format!("{v:.1e}"),
        s => format!("{v:.*}", (2 - s.log10().floor() as i32).max(0) as usize),
    }
}

/// The rungs as a text table.
pub fn rungs_text(rungs: &[Rung], noise_floor_mm: Option<f64>) -> String {
    let head = ["model", "how known", "training mm", "left-out pressures mm", "left-out runs mm", "B N m²"];
    let row = |r: &Rung| {
        vec![
            r.model.clone(),
            r.how_known.into(),
            number(Some(r.training_mm), 2),
            number(r.heldout_pressure_mm, 2),
            number(r.heldout_run_mm, 2),
            short(r.bending_nm2),
        ]
    };
    let floor = noise_floor_mm.map_or("noise unknown with one run: root-mean-square errors".to_string(), |n| {
        format!("noise of the mean {n:.2} mm, already taken off")
    });
    format!("Error beyond noise ({floor})\n{}", table(&head, 2, rungs.iter().map(row).collect()))
}

/// The rungs as they are drawn.
pub fn drawn(rungs: &[Rung]) -> Vec<ErrorRung> {
    let drawn = |r: &Rung| ErrorRung {
        label: if r.model.ends_with(r.how_known) { r.model.clone() } else { format!("{} ({})", r.model, r.how_known) },
        training_mm: r.training_mm,
        heldout_pressure_mm: r.heldout_pressure_mm,
        heldout_run_mm: r.heldout_run_mm,
    };
    rungs.iter().map(drawn).collect()
}

/// What to say of data without enough runs.
pub fn check_runs(dataset: &Dataset) -> Option<String> {
    let few = dataset.runs.len() < 3;
    few.then(|| {
        format!("{} runs: at least three are needed for p-values, so this is a ranking only", dataset.runs.len())
    })
}

/// Name of an effect, and its keys and values in the units of the scenario if any were given.
pub type Typed = (String, Option<Vec<(String, f64)>>);

/// Reads an effect as typed, `NAME`, `NAME=VALUE` or `NAME:key=value,…`.
pub fn typed(scenario: &Scenario, text: &str) -> Result<Typed, Failure> {
    let place = text.find([':', '=']).unwrap_or(text.len());
    let (name, rest) = text.split_at(place);
    let catalogue = scenario.catalogue();
    let text = match (rest.strip_prefix('='), catalogue.by_name(name)) {
        (Some(value), Some(effect)) => {
            let free = effect.parameters.iter().find(|p| p.typical != 0.0).unwrap_or(&effect.parameters[0]);
            format!("{name}:{}={value}", free.key)
        }
        _ => text.to_string(),
    };
    let (with, _) = inputs::with_effect(scenario, &text)?;
    if scenario.effects.iter().any(|e| e.name == name) {
        let help = "change its value there, or fit it with `ibr diagnose --refit`";
        return Err(Failure::usage(format!("the scenario has {name} already"), help));
    }
    let (Some(effect), Some(chosen)) = (catalogue.by_name(name), with.effects.iter().find(|e| e.name == name)) else {
        return Ok((name.to_string(), None));
    };
    let values = effect.parameters.iter().zip(&chosen.values).map(|(p, v)| (p.key.to_string(), v / p.si)).collect();
    Ok((name.to_string(), (!rest.is_empty()).then_some(values)))
}
