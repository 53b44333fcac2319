//! How wrong the form of a law is: every hidden effect's own law against the catalogue's of the same name, in moments.

use super::cases::about;
use crate::truth::{ROBOTS, standard_protocol};
use crate::{Draw, HIDDEN, Truth, truth};
use compare::error::CompareError;
use compare::moment::{Moments, Robot, Shape, View, best_size, form_width, moments, shape};
use compare::noise::NoiseModel;
use compare::study::fit_scenario;
use data::{Dataset, Direct};
use models::Scenario;
use models::effects::{Effect, Stage, by_name};
use serde::Serialize;

/// Width of the form of a law in one robot.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FormWidth {
    /// Robot.
    pub actuator: String,
    /// Effect.
    pub effect: String,
    /// Share by which the form errs for every doubling of bend or pressure, the size being free.
    pub width: f64,
    /// Size that fits best, in typical sizes.
    pub size: f64,
}

/// Sizes that are tried, over the typical one.
const SIZES: [f64; 2] = [0.05, 8.0];
/// Number of them, evenly in the logarithm.
const TRIED: usize = 60;
/// Noise of the data, next to none \[m\]; over that of a robot.
const SILENT_M: f64 = 2e-5;

/// Widths of all effects in all robots that have a moment.
///
/// # Errors
/// A shipped scenario is damaged, or a robot without equilibrium.
pub fn form_widths() -> Result<Vec<FormWidth>, CompareError> {
    let mut all = Vec::new();
    for (actuator, _) in ROBOTS {
        for hidden in truth::applicable(actuator, HIDDEN)? {
            let Some(effect) = by_name(hidden.name).filter(|e| e.stage != Stage::Camera) else { continue };
            all.extend(form(actuator, effect)?);
        }
    }
    Ok(all)
}

/// Geometric mean of the widths: they spread over two decades, and a few laws are simply others.
pub fn width(forms: &[FormWidth]) -> f64 {
    let sum: f64 = forms.iter().map(|f| f.width.max(1e-3).ln()).sum();
    (sum / forms.len().max(1) as f64).exp()
}

fn form(actuator: &str, effect: &Effect) -> Result<Option<FormWidth>, CompareError> {
    let mut truth = Truth::draw(actuator, &mut Draw::new(1, 0))?;
    truth.add(effect.name, 1.0);
    truth.runs = 3;
    (truth.camera_sd_m, truth.pressure_sd, truth.alignment_sd_m) = (SILENT_M, 0.0, 0.0);
    let data = truth.dataset("silent", &standard_protocol())?;
    let told = truth.told()?.with_bending(truth.bending_nm2);
    let (base, _) = fit_scenario(&told, &data, Some(&about(&truth)?))?;
    let noise = NoiseModel::known(&data, &vec![0.0; data.values_per_run()], 3, SILENT_M, [0.0, 1e-5, 1e-5, 1e-5])?;
    let each: Vec<_> = (0..data.values_per_run()).map(|i| vec![(i, 1.0)]).collect();
    let (whitener, target_m) = (noise.whitener_of(&each)?, data.mean_over_runs());
    let view =
        View { scenario: &base, dataset: &data, direct: Direct::default(), target_m: &target_m, whitener: &whitener };
    let shape = shape(&view)?;
    let told = at(&view, &shape, &base)?;
    let truth: Vec<f64> = told.of_holds.iter().map(|p| p.moment).collect();
    let law = |size: f64| -> Option<Vec<f64>> {
        let values: Vec<f64> = effect
            .typical()
            .iter()
            .zip(effect.neutral())
            .map(|(t, n)| if *t == n { *t } else { n + size * (t - n) })
            .collect();
        let with = at(&view, &shape, &base.with_effect(effect.name, &values)).ok()?;
        let same = with.of_holds.len() == truth.len();
        same.then(|| told.of_holds.iter().zip(&with.of_holds).map(|(a, b)| a.moment - b.moment).collect())
    };
    let ends = SIZES.map(f64::ln);
    let sizes: Vec<f64> =
        (0..TRIED).map(|i| (ends[0] + (ends[1] - ends[0]) * i as f64 / (TRIED - 1) as f64).exp()).collect();
    let Some((size, best)) = best_size(&sizes, &law, &truth) else { return Ok(None) };
    let width = form_width(&truth, &best, &shares(&data, &told));
    Ok(width.map(|width| FormWidth { actuator: actuator.into(), effect: effect.name.into(), width, size }))
}

fn at(view: &View, shape: &Shape, scenario: &Scenario) -> Result<Moments, CompareError> {
    let of_hold = vec![0; view.dataset.holds.len()];
    moments(view, shape, &Robot { scenarios: std::slice::from_ref(scenario), of_hold: &of_hold })
}

/// Bend and pressure of every point over the largest.
fn shares(data: &Dataset, told: &Moments) -> Vec<[f64; 2]> {
    let most = told.of_holds.iter().map(|p| p.kappa).fold(1e-3, f64::max);
    let highest = data.holds.iter().map(|h| h.p_act_pa).fold(1.0, f64::max);
    told.of_holds.iter().map(|p| [p.kappa / most, p.p_act_pa / highest]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The number that the evidence rule uses is this one. `cargo test -p ibr-challenge --release forms -- --nocapture` prints all.
    #[test]
    fn the_width_of_a_form_is_learned_from_pairs_of_laws() {
        let forms = form_widths().unwrap();
        for FormWidth { actuator, effect, width, size } in &forms {
            println!("{actuator} {effect}: {width:.3} per doubling, at {size:.2} of the typical size");
        }
        let learned = width(&forms);
        println!("geometric mean {learned:.4} of {}", forms.len());
        assert!((learned / compare::policy::FORM_WIDTH - 1.0).abs() < 0.02, "{learned}");
    }
}
