//! The demonstration.

use super::held::{self, HeldTable};
use crate::prelude::*;
use compare::Diagnosis;
use compare::bench::Held;
use compare::demo::{Demo, Told};
use compare::metrics::OverallMetrics;
use compare::study::published::PublishedLadder;
use compare::study::{Comparison, Rung, Timing, Variant};
use compare::where_it_fails::Statement;
use data::published::PublishedActuator;
use fem::robot::Reading;

/// Every rung of every ladder.
pub(crate) fn published(ladders: &[PublishedLadder]) -> Table<(&PublishedActuator, &Rung)> {
    let rungs = ladders.iter().flat_map(|ladder| ladder.rungs.iter().map(move |rung| (&ladder.published, rung)));
    Table::of(rungs)
        .words("actuator", |(p, _)| &p.printed_name)
        .words("model", |(_, rung)| &rung.label)
        .words("how known", |(_, rung)| rung.known.word())
        .number("model mm", 1, |(_, rung)| rung.y_m * 1e3)
        .right("range mm", |(_, rung)| {
            rung.range_m.map_or("–".into(), |r| format!("{:.1}–{:.1}", r[0] * 1e3, r[1] * 1e3))
        })
        .number("measured mm", 1, |(p, _)| p.d_max_m * 1e3)
        .signed("difference mm", 1, |(p, rung)| (rung.y_m - p.d_max_m) * 1e3)
}

/// What has just been computed, for readers.
pub(crate) fn text(told: Told) -> String {
    match told {
        Told::Measured(all) => {
            let short =
                |h: &Held| if h.rows.len() > 8 { format!("{}\n{}", h.title, held::closing(h)) } else { held::text(h) };
            format!("Measured things first\n{}", all.iter().map(|h| format!("\n{}", short(h))).collect::<String>())
        }
        Told::Published(ladders) => {
            let title = "Displacement at 30 kPa against the published measurement (du Pasquier et al. 2023)";
            format!("\n{title}\n{}", published(ladders).text())
        }
        Told::Sets(found) => sets_text(found),
        Told::Missing(d) => {
            format!("\nWhat is missing in {} on {}:\n{}", d.scenario, d.dataset, lines("  - ", &d.summary))
        }
    }
}

/// Title of [`sets`].
pub(crate) const SETS: &str = "Synthetic marker sets: error beyond noise as effects are added";

/// Every model of every set of markers.
pub(crate) fn sets(found: &[Comparison]) -> Table<(&Comparison, &Variant, &OverallMetrics)> {
    let models = found.iter().flat_map(|c| c.variants.iter().map(move |v| (c, v, &v.evaluation.metrics.overall)));
    Table::of(models)
        .words("data", |(c, ..)| &c.dataset.name)
        .words("model", |(_, v, _)| &v.label)
        .words("how known", |(_, v, _)| v.known.word())
        .number("paper acc. %", 1, |(.., all)| all.paper_accuracy.map(|a| 100.0 * a))
        .number("beyond noise mm", 2, |(.., all)| all.systematic_mm)
        .number("χ²/dof", 1, |(.., all)| all.reduced_chi2)
        .signed("largest tip error mm", 1, |(.., all)| all.largest_tip_error_mm)
}

fn sets_text(found: &[Comparison]) -> String {
    let fails = found.iter().filter_map(|c| Some((c, c.variants[0].evaluation.where_it_fails.first()?)));
    let fails = lines("  - ", fails.map(|(c, s)| format!("{}: {}", c.dataset.name, s.sentence)));
    format!("{}\nWhere the bare models fail:\n{fails}", sets(found).under(SETS))
}

/// `ibr.demo`: `ibr demo`
#[derive(Serialize)]
pub(crate) struct DemoAnswer<'a> {
    /// Bench tests with their models
    pub measured: Vec<HeldTable<'a>>,
    /// Published displacements, and models with more and more effects
    pub published: Vec<PublishedRungs<'a>>,
    /// Synthetic marker data with the same models
    pub marker_sets: Vec<MarkerSet<'a>>,
    /// The missing effect in one of the sets
    pub diagnosis: &'a Diagnosis,
    /// Run time against error
    pub timings: &'a [Timing],
    /// A finite element run made just now
    pub small_run: SmallRun<'a>,
}

/// A published displacement, and models with more and more effects.
#[derive(Serialize)]
pub(crate) struct PublishedRungs<'a> {
    /// Name of the actuator
    pub actuator: &'a str,
    /// Published displacement
    pub measured_mm: f64,
    /// How it is known
    pub measured_is: Known,
    /// Models, each with one more effect
    pub rungs: &'a [Rung],
    /// Stiffness that the bare model would need, if there is one
    pub calibrated_bending_nm2: Option<f64>,
}

/// Marker data and the models compared with them.
#[derive(Serialize)]
pub(crate) struct MarkerSet<'a> {
    /// Name of the data
    pub data: &'a str,
    /// Models, each with one more effect
    pub models: Vec<MarkerModel<'a>>,
    /// Where the bare model fails
    pub where_it_fails: &'a [Statement],
}

/// A model compared with marker data.
#[derive(Serialize)]
pub(crate) struct MarkerModel<'a> {
    /// What was added
    pub model: &'a str,
    /// How its value is known
    pub how_known: Known,
    /// Errors over all holds
    pub overall: &'a OverallMetrics,
}

/// A finite element run made just now.
#[derive(Serialize)]
pub(crate) struct SmallRun<'a> {
    /// Elements
    pub elements: usize,
    /// Processor time
    pub cpu_s: f64,
    /// Energy that is missing in the balance, as a share
    pub residual_share: f64,
    /// Buckling events
    pub buckling_events: usize,
    /// States, by time
    pub readings: &'a [Reading],
}

impl<'a> DemoAnswer<'a> {
    /// Of the demonstration and the run that was made with it.
    pub(crate) fn of(demo: &'a Demo, small_run: SmallRun<'a>) -> DemoAnswer<'a> {
        DemoAnswer {
            measured: demo.measured.iter().map(HeldTable::of).collect(),
            published: demo.ladders.iter().map(PublishedRungs::of).collect(),
            marker_sets: demo.studies.iter().map(MarkerSet::of).collect(),
            diagnosis: &demo.diagnosed.diagnosis,
            timings: &demo.timings,
            small_run,
        }
    }
}

impl<'a> PublishedRungs<'a> {
    fn of(ladder: &'a PublishedLadder) -> PublishedRungs<'a> {
        PublishedRungs {
            actuator: &ladder.published.kind,
            measured_mm: ladder.published.d_max_m * 1e3,
            measured_is: Known::Published,
            rungs: &ladder.rungs,
            calibrated_bending_nm2: ladder.calibrated_bending,
        }
    }
}

impl<'a> MarkerSet<'a> {
    fn of(found: &'a Comparison) -> MarkerSet<'a> {
        let models = found.variants.iter().map(|v| MarkerModel {
            model: &v.label,
            how_known: v.known,
            overall: &v.evaluation.metrics.overall,
        });
        MarkerSet {
            data: &found.dataset.name,
            models: models.collect(),
            where_it_fails: &found.variants[0].evaluation.where_it_fails,
        }
    }
}
