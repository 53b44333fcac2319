//! The demonstration: every actuator against the published displacements and against the embedded marker sets.

use crate::bench::Held;
use crate::diagnosis::{Diagnosis, Options, diagnose};
use crate::error::CompareError;
use crate::evaluate::EvaluateOptions;
use crate::evidence::Evidence;
use crate::progress::shares::DEMO;
use crate::progress::{Progress, part};
use crate::study::calibrate::Knob;
use crate::study::comparison::{Comparison, Contender, compare_all};
use crate::study::engines::{Engines, engines, stored};
use crate::study::measured::measured_things;
use crate::study::published::{PublishedLadder, model_ladder, published_ladders, shipped_scenario, textbook_scenario};
use crate::study::tradeoff::{Timing, of_runs, tradeoff};
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
    pub studies: Vec<Comparison>,
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

fn story(progress: &mut Progress) -> Result<Story, CompareError> {
    let scenario = textbook_scenario(HIDDEN_IN[0])?;
    let evidence = [Evidence::read(HIDDEN_IN[1])?];
    let diagnosis = diagnose(&scenario, &evidence, &Options::default(), progress)?;
    let [Evidence { dataset, about, .. }] = evidence;
    Ok(Story { diagnosis, scenario, dataset, about })
}

/// What has just been computed.
pub enum Told<'a> {
    /// Real things beside their models.
    Measured(&'a [Held]),
    /// Published displacements.
    Published(&'a [PublishedLadder]),
    /// Embedded marker sets.
    Sets(&'a [Comparison]),
    /// What is missing in the model of one of them.
    Missing(&'a Diagnosis),
}

/// Computes the demonstration, and tells its story as it goes.
///
/// # Errors
/// Damaged embedded data or a model without equilibrium.
pub fn demo(progress: &mut Progress, told: &mut dyn FnMut(Told)) -> Result<Demo, CompareError> {
    progress("measured things", Some(0.0));
    let measured = measured_things()?;
    told(Told::Measured(&measured));
    progress("published displacements", Some(DEMO[0]));
    let ladders = published_ladders()?;
    told(Told::Published(&ladders));
    let mut studies = Vec::new();
    // What the finite elements made is the matter of the diagnosis and its bench; measured robots have models of their own.
    let made = |set: &&data::SetInfo| set.provenance == data::Provenance::Synthetic && !set.name.starts_with("fem-");
    for set in data::sets().iter().filter(|set| set.has_markers()).filter(made) {
        progress(&set.name, Some(DEMO[1]));
        let evidence = Evidence::read(&set.name)?;
        let rungs = model_ladder(&evidence.dataset.actuator)?.into_iter();
        let models: Vec<Contender> =
            rungs.map(|r| Contender { label: r.label, known: r.known, why: r.why, scenario: r.scenario }).collect();
        studies.push(compare_all(&models, &evidence, &EvaluateOptions::default(), Some(Knob::Bending))?);
    }
    told(Told::Sets(&studies));
    let diagnosed = story(&mut part(progress, [DEMO[2], DEMO[3]]))?;
    told(Told::Missing(&diagnosed.diagnosis));
    progress("run times", Some(DEMO[3]));
    let mut timings = tradeoff(&ladders)?;
    progress("finite elements", Some(DEMO[4]));
    let runs = stored()?;
    timings.extend(of_runs(&ladders, &runs));
    let scenarios = ladders.iter().map(|l| shipped_scenario(&l.published.kind)).collect::<Result<Vec<_>, _>>()?;
    let engines = engines(&scenarios, &runs)?;
    Ok(Demo { measured, ladders, studies, timings, diagnosed, engines })
}
