//! The demonstration in five panels: a robot, a model next to markers, the missing effects, the fall of the error, the model's limits.
//!
//! The camera sees a robot of the finite element engine, which has every mechanism; the model is the textbook one. Mechanisms of the
//! shipped robot are added one after the other, the one first that leaves least, and none of their numbers is fitted.

use crate::diagnosis::{Diagnosis, Options, diagnose};
use crate::error::CompareError;
use crate::evidence::Evidence;
use crate::fit::numbers::{sort_by, squared_distance};
use crate::progress::{Progress, part};
use crate::study::calibrate::Knob;
use crate::study::comparison::{Comparison, Contender, compare_all};
use crate::study::engines::{EngineLine, Engines, engines, lines, of_the_program, stored};
use crate::study::generate::about;
use crate::study::published::{shipped_scenario, textbook_scenario};
use crate::study::seen::seen;
use crate::study::{Generator, predict_dataset};
use models::Scenario;
use serde::Serialize;

/// Robot and data of the demonstration.
pub const ROBOT: [&str; 2] = ["epam", "fem-epam"];
const ROBOTS: [&str; 4] = ["spam", "cpam", "epam", "fpam"];
const LEFT_OUT_PA: f64 = 4e3;
/// Least fall of the error that is a step, as a share of the first error.
const LEAST_GAIN: f64 = 0.01;

/// Results of the five panels, from a textbook model to both engines.
#[derive(Debug, Clone)]
pub struct Demo {
    /// ePAM of the textbook, without the mechanisms of the shipped robot.
    pub robot: Scenario,
    /// Synthetic camera measurements of finite element runs, dataset `fem-epam`.
    pub data: Evidence,
    /// The one compared with the other.
    pub compared: Comparison,
    /// Mechanisms of the shipped robot, each alone in the textbook model, the nearest first.
    pub candidates: Vec<Mechanism>,
    /// What a diagnosis reports of the textbook model, its stiffness kept.
    pub diagnosis: Diagnosis,
    /// The textbook model, and one more mechanism in every step.
    pub steps: Vec<Mechanism>,
    /// The textbook model with a stiffness fitted to the data in place of mechanisms.
    pub stiffness: Mechanism,
    /// Reduced model and finite elements for the four published robots.
    pub engines: Engines,
    /// Their displacements and accuracies at every pressure that the paper prints.
    pub lines: Vec<EngineLine>,
}

/// A model with one more mechanism, and its errors: root mean square over markers and holds.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Mechanism {
    /// Name of the mechanism added in this step, empty for the textbook model.
    pub effect: String,
    /// What the mechanism does, from the catalogue of effects.
    pub sentence: String,
    /// Root-mean-square distance of the markers from the data that choose the mechanism \[mm\].
    pub error_mm: f64,
    /// In data at twice the body pressure, which chose nothing \[mm\]
    pub left_out_mm: f64,
}

/// Computes the demonstration.
///
/// # Errors
/// Damaged embedded data or a model without equilibrium.
pub fn demo(progress: &mut Progress) -> Result<Demo, CompareError> {
    let (robot, data) = (textbook_scenario(ROBOT[0])?, Evidence::read(ROBOT[1])?);
    progress("a model next to markers", Some(0.0));
    let compared = compare_all(&[Contender::as_given(&robot)], &data, &Default::default(), Some(Knob::Bending))?;
    let path = DemoPath { shipped: shipped_scenario(ROBOT[0])?, data: &data, left_out: left_out(&robot)? };
    let candidates = path.candidates(&robot)?;
    let options = Options { keep_bending: true, next_experiment: false, ..Options::default() };
    let diagnosis = diagnose(&robot, std::slice::from_ref(&data), &options, &mut part(progress, [0.1, 0.7]))?;
    progress("mechanism by mechanism", Some(0.7));
    let steps = path.steps(&robot)?;
    let stiffness = path.judged(&compared.variants[1].scenario, "", "")?;
    progress("both engines on four robots", Some(0.8));
    let scenarios = ROBOTS.iter().map(|kind| shipped_scenario(kind)).collect::<Result<Vec<_>, _>>()?;
    let engines = engines(&scenarios, &stored()?)?;
    let lines = engines.robots.iter().map(lines).collect::<Result<Vec<_>, _>>()?.concat();
    Ok(Demo { robot, data, compared, candidates, diagnosis, steps, stiffness, engines, lines })
}

/// The same robot of the finite elements at another body pressure.
fn left_out(robot: &Scenario) -> Result<Evidence, CompareError> {
    let scenario = Scenario { p_body_pa: LEFT_OUT_PA, ..shipped_scenario(robot.actuator.kind.name)? };
    let runs = of_the_program(&scenario, Generator::default().runs)?;
    let protocol = [0.0, 10e3, 20e3, 30e3].map(|p| [LEFT_OUT_PA, p]).to_vec();
    let generator = Generator { protocol, ..Generator::default() };
    let dataset = seen(&runs, "left out", &generator)?;
    let about = about(&scenario, &dataset, &generator);
    Ok(Evidence::of(dataset, Some(about)))
}

struct DemoPath<'d> {
    shipped: Scenario,
    data: &'d Evidence,
    left_out: Evidence,
}

impl DemoPath<'_> {
    fn with(&self, base: &Scenario, effect: &str) -> Result<(Scenario, Mechanism), CompareError> {
        let own = self.shipped.effects.iter().find(|e| e.name == effect);
        let model = own.map_or(base.clone(), |e| base.with_effect(&e.name, &e.values));
        let sentence = models::effects::by_name(effect).map_or("", |e| e.sentence);
        let mechanism = self.judged(&model, effect, sentence)?;
        Ok((model, mechanism))
    }

    fn judged(&self, model: &Scenario, effect: &str, sentence: &str) -> Result<Mechanism, CompareError> {
        let [error_mm, left_out_mm] = [error_mm(model, self.data)?, error_mm(model, &self.left_out)?];
        Ok(Mechanism { effect: effect.into(), sentence: sentence.into(), error_mm, left_out_mm })
    }

    /// Every mechanism that the model lacks and that does something to this robot, added alone, the nearest first.
    fn tried(&self, base: &Scenario) -> Result<Vec<(Scenario, Mechanism)>, CompareError> {
        let lacking = self.shipped.effects.iter().filter(|e| base.effects.iter().all(|own| own.name != e.name));
        let mut tried = lacking.map(|e| self.with(base, &e.name)).collect::<Result<Vec<_>, _>>()?;
        let before_mm = self.judged(base, "", "")?.error_mm;
        tried.retain(|(_, mechanism)| mechanism.error_mm != before_mm);
        sort_by(&mut tried, |(_, mechanism)| mechanism.error_mm);
        Ok(tried)
    }

    fn candidates(&self, base: &Scenario) -> Result<Vec<Mechanism>, CompareError> {
        Ok(self.tried(base)?.into_iter().map(|(_, mechanism)| mechanism).collect())
    }

    /// Adds the mechanism that leaves least, as long as one lowers the error by a hundredth of the first.
    fn steps(&self, base: &Scenario) -> Result<Vec<Mechanism>, CompareError> {
        let (mut model, first) = self.with(base, "")?;
        let mut steps = vec![first];
        while let Some((next, step)) = self.tried(&model)?.into_iter().next() {
            if steps.last().is_some_and(|last| step.error_mm > last.error_mm - LEAST_GAIN * steps[0].error_mm) {
                break;
            }
            model = next;
            steps.push(step);
        }
        Ok(steps)
    }
}

fn error_mm(model: &Scenario, evidence: &Evidence) -> Result<f64, CompareError> {
    let body_pa = evidence.dataset.holds.first().map_or(model.p_body_pa, |hold| hold.p_body_pa);
    let model = Scenario { p_body_pa: body_pa, ..model.clone() };
    let (model, _) = crate::study::fit_scenario(&model, &evidence.dataset, evidence.about.as_ref())?;
    let predicted = predict_dataset(&model, &evidence.dataset)?.coordinates_m;
    let mean = evidence.dataset.mean_over_runs();
    Ok(1e3 * (squared_distance(&predicted, &mean) / mean.len() as f64).sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every step lowers the error in data that chose it; the whole path lowers it in data that chose nothing.
    #[test]
    fn the_error_falls_in_every_step_and_in_data_that_were_left_out() {
        let demo = demo(&mut |_, _| ()).unwrap();
        assert!(demo.steps.len() > 3 && demo.steps.windows(2).all(|pair| pair[1].error_mm < pair[0].error_mm));
        let [first, last] = [&demo.steps[0], &demo.steps[demo.steps.len() - 1]];
        assert!(last.error_mm < 0.25 * first.error_mm && last.left_out_mm < 0.5 * first.left_out_mm, "{demo:?}");
        assert_eq!(demo.candidates[0].effect, demo.steps[1].effect);
        // A stiffness follows the data that it was fitted to, and no others.
        let [own, other] = [demo.stiffness.error_mm, demo.stiffness.left_out_mm];
        assert!(own < 0.25 * first.error_mm && other > 2.0 * last.left_out_mm && other > 2.0 * own, "{demo:?}");
        assert_eq!(demo.engines.robots.len(), ROBOTS.len());
    }
}
