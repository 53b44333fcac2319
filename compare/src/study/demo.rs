//! The demonstration: every actuator against the published displacements and against the embedded marker sets.

use super::comparing::{Candidate, Study, study};
use super::engines::{Engines, engines, stored};
use super::measured::measured_things;
use super::published::{PublishedLadder, model_ladder, published_ladders, shipped_scenario, textbook_scenario};
use super::tradeoff::{Timing, of_runs, tradeoff};
use crate::bench::Held;
use crate::diagnosis::{Diagnosis, Options, diagnose};
use crate::error::CompareError;
use crate::evaluate::EvaluateOptions;
use crate::study::calibrate::Knob;
use data::{About, Dataset};
use models::Scenario;

/// Everything the demonstration computes.
#[derive(Debug, Clone)]
pub struct Demo {
    /// Real things beside their models.
    pub measured: Vec<Held>,
    /// Published displacements.
    pub ladders: Vec<PublishedLadder>,
    /// Embedded marker sets.
    pub studies: Vec<Study>,
    /// Run time against error.
    pub timings: Vec<Timing>,
    /// What is missing in the calibrated bare model of one marker set, with the data.
    pub diagnosed: Story,
    /// Both engines, with the finite element runs that come with the program.
    pub engines: Engines,
}

/// A diagnosis with what it was made of.
#[derive(Debug, Clone)]
pub struct Story {
    /// What was found.
    pub diagnosis: Diagnosis,
    /// The model without what is hidden in the data.
    pub scenario: Scenario,
    /// The data.
    pub dataset: Dataset,
    /// Their description.
    pub about: Option<About>,
}

/// The marker set of the diagnosis; its generator had an effect that the shipped scenario has not.
pub const HIDDEN_IN: [&str; 2] = ["epam", "synthetic-epam"];

fn story() -> Result<Story, CompareError> {
    let scenario = textbook_scenario(HIDDEN_IN[0])?;
    let (dataset, about) = data::load(HIDDEN_IN[1], &mut |_, _| {})?;
    let diagnosis = diagnose(&scenario, &dataset, about.as_ref(), &Options::default())?;
    Ok(Story { diagnosis, scenario, dataset, about })
}

/// Computes the demonstration; `progress` is told what is being done.
///
/// # Errors
/// Damaged embedded data or a model without equilibrium.
pub fn demo(progress: &mut dyn FnMut(&str)) -> Result<Demo, CompareError> {
    progress("measured things");
    let measured = measured_things()?;
    progress("published displacements");
    let ladders = published_ladders()?;
    let mut studies = Vec::new();
    // What the finite elements made is the matter of the diagnosis and its bench; measured robots have models of their own.
    let made = |set: &&data::SetInfo| set.provenance == data::Provenance::Synthetic && !set.name.starts_with("fem-");
    for set in data::sets().iter().filter(|set| set.has_markers()).filter(made) {
        progress(&set.name);
        let (dataset, about) = data::load(&set.name, &mut |_, _| {})?;
        let rungs = model_ladder(&dataset.actuator)?;
        let candidates: Vec<Candidate> = rungs
            .iter()
            .map(|r| Candidate { label: &r.label, known: r.known, why: &r.why, scenario: &r.scenario })
            .collect();
        studies.push(study(&candidates, dataset, about, &EvaluateOptions::default(), Some(Knob::Bending))?);
    }
    progress("what is missing");
    let diagnosed = story()?;
    progress("run times");
    let mut timings = tradeoff(&ladders)?;
    progress("finite elements");
    let runs = stored()?;
    timings.extend(of_runs(&ladders, &runs));
    let scenarios = ladders.iter().map(|l| shipped_scenario(&l.published.kind)).collect::<Result<Vec<_>, _>>()?;
    let engines = engines(&scenarios, &runs)?;
    Ok(Demo { measured, ladders, studies, timings, diagnosed, engines })
}
