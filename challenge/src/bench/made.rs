//! Data that no generator made: markers of the finite element runs that come with the program.
//!
//! The diagnosing side is given the shipped robot without one of the mechanisms that its scenario describes. The finite elements
//! have them all, so that this one is missing. But even with every mechanism switched on, the model differs from the finite
//! elements: this difference stays in the data, and a diagnosis may give it any name.

use super::outcome::Diagnoser;
use super::row::{Goal, Rate};
use compare::Evidence;
use compare::diagnosis::{Confidence, Diagnosis, Options, Verdict};
use compare::error::CompareError;
use compare::policy;
use compare::study::engines::of_the_program;
use compare::study::generate::about;
use compare::study::published::shipped_scenario;
use compare::study::seen::seen;
use compare::study::{Generator, predict_dataset};
use models::Scenario;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

/// Robots that come with finite element runs.
pub(super) const MADE: [&str; 4] = ["spam", "cpam", "epam", "fpam"];
const SECOND_PA: f64 = 4e3;
const RUNS: usize = 5;
const SEED: u64 = 22;

/// What became of one mechanism that was switched off.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct OneOff {
    /// Actuator kind of the robot, such as `epam`.
    pub robot: String,
    /// Mechanism that was switched off in the model.
    pub lacking: String,
    /// How many body pressures the data have.
    pub bodies: usize,
    /// The scenario's bending stiffness was kept.
    pub kept: bool,
    /// What the mechanism does to the markers in the model \[mm\], rms.
    pub does_mm: f64,
    /// More than the tolerance, and the model is a fifth nearer to the data with it: otherwise the data do not show it.
    pub matters: bool,
    /// Verdict; `None` if the data do not allow one.
    pub verdict: Option<Verdict>,
    /// The stated set; a pair is written `a + b`.
    pub stated: Vec<String>,
    /// With the verdict `out_of_catalog`: the best that the catalogue can do, and what comes as close.
    pub attempted: Vec<String>,
    /// Its place in the ranking of single effects, counted from 1.
    pub place: Option<usize>,
    /// It is in the stated set.
    pub in_set: bool,
    /// The diagnosis states it as a consequence of the design.
    pub by_design: bool,
    /// The diagnosis states it as identified, not as a hint.
    pub identified: bool,
    /// Error beyond noise without it, with it as the shipped scenario has it, and with the answer or the attempt \[mm\].
    pub systematic_mm: [f64; 3],
}

/// One question: a robot without a mechanism, and the data.
struct Question<'e> {
    robot: &'e str,
    whole: &'e Scenario,
    lacking: &'e str,
    evidence: &'e [Evidence],
    kept: bool,
    /// Error beyond noise of the whole robot with these data \[mm\].
    whole_mm: f64,
}

/// Diagnoses the finite element sets of a robot.
pub(super) fn made(robot: &str, diagnose: Diagnoser) -> Result<Vec<OneOff>, CompareError> {
    let whole = shipped_scenario(robot)?;
    let mut evidence = vec![Evidence::read(&format!("fem-{robot}"))?];
    evidence.extend(second(&whole)?);
    let mut questions = Vec::new();
    for bodies in 1..=evidence.len() {
        for kept in [true, false] {
            let evidence = &evidence[..bodies];
            let nothing_off = diagnose(&whole, evidence, &Options { pairs: false, ..options(kept) }, &mut |_, _| ())?;
            questions.extend(whole.effects.iter().map(|e| Question {
                robot,
                whole: &whole,
                lacking: &e.name,
                evidence,
                kept,
                whole_mm: nothing_off.base.systematic_mm,
            }));
        }
    }
    let answers: Result<Vec<Option<OneOff>>, CompareError> = questions.par_iter().map(|q| q.ask(diagnose)).collect();
    let mut all: Vec<OneOff> = answers?.into_iter().flatten().collect();
    all.push(all_off(robot, &whole, &evidence[..1], diagnose)?);
    Ok(all)
}

/// What a question of all mechanisms at once lacks.
const ALL: &str = "all mechanisms";

/// The same question of the robot without any of its mechanisms, as a user asks it: reported where the answer states that the mechanisms of
/// the shipped robot come nearer.
fn all_off(robot: &str, whole: &Scenario, evidence: &[Evidence], diagnose: Diagnoser) -> Result<OneOff, CompareError> {
    let bare = shipped_scenario(&format!("{robot}-textbook"))?;
    let does_mm = apart_mm(whole, &bare, &evidence[0])?;
    let options = Options::default().without_advice();
    let found = diagnose(&bare, evidence, &options, &mut |_, _| ())?;
    let is_told = found.other_design.is_some();
    let question = Question { robot, whole, lacking: ALL, evidence, kept: false, whole_mm: f64::NAN };
    Ok(OneOff { matters: true, by_design: is_told, ..question.told(does_mm, &found) })
}

fn options(kept: bool) -> Options {
    Options { keep_bending: kept, ..Options::default().without_advice() }
}

/// The same robot at another body pressure, where its runs come with the program.
fn second(whole: &Scenario) -> Result<Option<Evidence>, CompareError> {
    let scenario = Scenario { p_body_pa: SECOND_PA, ..whole.clone() };
    let Ok(runs) = of_the_program(&scenario, RUNS) else { return Ok(None) };
    let protocol = [0.0, 10e3, 20e3, 30e3].map(|p| [SECOND_PA, p]).to_vec();
    let generator = Generator { seed: SEED, runs: RUNS, protocol, ..Generator::default() };
    let dataset = seen(&runs, "at 4 kPa", &generator)?;
    let about = about(&scenario, &dataset, &generator);
    Ok(Some(Evidence::of(dataset, Some(about))))
}

impl Question<'_> {
    /// `None` where the mechanism does nothing in this robot that anybody would see.
    fn ask(&self, diagnose: Diagnoser) -> Result<Option<OneOff>, CompareError> {
        let effects = self.whole.effects.iter().filter(|e| e.name != self.lacking).cloned().collect();
        let model = Scenario { effects, ..self.whole.clone() };
        let does_mm = apart_mm(self.whole, &model, &self.evidence[0])?;
        if does_mm <= 1e3 * policy::TOLERANCE_M {
            return Ok(None);
        }
        let found = diagnose(&model, self.evidence, &options(self.kept), &mut |_, _| ())?;
        Ok(Some(self.told(does_mm, &found)))
    }

    fn told(&self, does_mm: f64, found: &Diagnosis) -> OneOff {
        let whole_mm = self.whole_mm;
        let attempted: Vec<String> = found.attempt_alike.iter().map(|alike| alike.effects.join(" + ")).collect();
        let holds =
            |entries: &[String]| entries.iter().any(|entry| entry.split(" + ").any(|name| name == self.lacking));
        let in_set = holds(&found.indistinguishable);
        let by_design = found.by_design.iter().any(|entry| entry.effects == [self.lacking]);
        OneOff {
            robot: self.robot.into(),
            lacking: self.lacking.into(),
            bodies: self.evidence.len(),
            kept: self.kept,
            does_mm,
            matters: !policy::is_good_enough(does_mm, found.tolerance_mm)
                && policy::is_closer(whole_mm, found.base.systematic_mm),
            verdict: found.verdict,
            place: found.ranked.iter().position(|r| r.effect == self.lacking).map(|place| place + 1),
            in_set,
            by_design,
            identified: found.confidence == Some(Confidence::IdentifiedInCatalog),
            stated: found.indistinguishable.clone(),
            attempted,
            systematic_mm: [found.base.systematic_mm, whole_mm, found.base.systematic_with_added_mm],
        }
    }
}

/// How far two models are apart at the holds of data \[mm\], rms.
fn apart_mm(one: &Scenario, other: &Scenario, evidence: &Evidence) -> Result<f64, CompareError> {
    let [a, b] = [one, other].map(|scenario| predict_dataset(scenario, &evidence.dataset));
    let (a, b) = (a?.coordinates_m, b?.coordinates_m);
    let squares: f64 = a.iter().zip(&b).map(|(a, b)| (a - b).powi(2)).sum();
    Ok(1e3 * (squares / a.len() as f64).sqrt())
}

/// Their rows of the table, of mechanisms that matter.
pub(super) fn rows(made: &[OneOff]) -> Vec<Rate> {
    let cases = [
        ("finite elements, one mechanism off, B kept", 1, true),
        ("finite elements, one mechanism off, B fitted", 1, false),
        ("the same at two body pressures, B kept", 2, true),
        ("the same at two body pressures, B fitted", 2, false),
    ];
    let (all, made): (Vec<&OneOff>, Vec<&OneOff>) = made.iter().partition(|m| m.lacking == ALL);
    let row = |(case, bodies, kept): (&'static str, usize, bool)| {
        let own: Vec<&OneOff> =
            made.iter().copied().filter(|m| m.matters && m.bodies == bodies && m.kept == kept).collect();
        let share = |figure, hit: fn(&OneOff) -> bool| {
            Rate::share(case, figure, Goal::AtLeast(0.8), &own.iter().map(|m| hit(m)).collect::<Vec<_>>())
        };
        share("it is reported", |m| m.by_design || m.in_set)
    };
    let case = "finite elements, all mechanisms off";
    let whole = |figure, goal, hit: fn(&OneOff) -> bool| {
        Rate::share(case, figure, goal, &all.iter().map(|m| hit(m)).collect::<Vec<_>>())
    };
    let rows = [
        whole("the mechanisms of the shipped robot are reported", Goal::AtLeast(0.8), |m| m.by_design),
        whole("called identified", Goal::AtMost(0.0), |m| m.identified),
    ];
    rows.into_iter().chain(cases.into_iter().map(row)).collect()
}
