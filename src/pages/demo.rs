//! The page of the demonstration: what a reader needs first, and the commands that show the rest.

use super::diagnosis::{Diagnosed, draw, verdict};
use super::engines::overview;
use super::{Imprint, PAPER, Result, Values, figures, residual_figure};
use crate::prelude::*;
use crate::shown::demo as shown;
use crate::shown::held::HeldTable;
use ::compare::demo::{Demo, HIDDEN_IN, Story};
use ::compare::progress::shares::PICTURES as SHARES;
use ::compare::progress::{Progress, part};
use ::compare::study::Comparison;
use ::compare::study::published::PublishedLadder;
use data::published::printed;

/// Pictures of the diagnosis that the page has.
const PICTURES: [&str; 5] = ["missing_moment", "residuals_before", "ranking", "before_after", "candidates"];

/// The page of the demonstration and its plots.
pub(crate) fn demo_page(demo: &Demo, imprint: &Imprint, progress: &mut Progress) -> Result<Files> {
    let mut files = Files::default();
    progress("plots of the published displacements", Some(0.0));
    files.plot("published", figures::published_bars(&demo.ladders)?);
    for ladder in &demo.ladders {
        files.plot(&format!("ladder_{}", ladder.published.kind), figures::published_ladder(ladder)?);
    }
    progress("plots of both engines", Some(SHARES[0]));
    let overview = overview(&demo.engines, &mut files)?;
    progress("plots of the marker sets", Some(SHARES[1]));
    let studies = demo.studies.iter().map(|study| draw_study(study, &mut files)).collect::<Result<Vec<_>, _>>()?;
    let found = found(&demo.diagnosed);
    draw(&found, "diagnosis_", &PICTURES, &mut files, &mut part(progress, [SHARES[2], 1.0]))?;
    files.plot("tradeoff", figures::tradeoff(&demo.timings)?);
    let values = Values::new()
        .with("title", "Four pneumatic bending actuators: models held against measurements")
        .with("ladders", demo.ladders.iter().map(ladder).collect::<Vec<_>>())
        .with("measured", demo.measured.iter().map(HeldTable::of).collect::<Vec<_>>())
        .with(
            "published",
            shown::published(&demo.ladders)
                .page("Displacement at 30 kPa actuator and 2 kPa body pressure; measured: du Pasquier et al. 2023"),
        )
        .with("sets", shown::sets(&demo.studies).page(shown::SETS))
        .with("studies", studies)
        .with("diagnosis", verdict(&found))
        .with("map_colours", residual_figure::MAP_COLOURS)
        .with(
            "provenance",
            [
                ["published numbers", PAPER],
                ["marker sets", "synthetic, made by this program's generator; no measurement"],
                ["machine", &imprint.machine],
            ],
        )
        .and(overview);
    files.page("demo.html", values, imprint)?;
    Ok(files)
}

fn found(story: &Story) -> Diagnosed<'_> {
    Diagnosed {
        diagnosis: &story.diagnosis,
        scenario: &story.scenario,
        dataset: &story.dataset,
        about: story.about.as_ref(),
        witness: None,
        typed: HIDDEN_IN,
        more: String::new(),
    }
}

fn ladder(l: &PublishedLadder) -> Values {
    let (last_mm, measured_mm) = (figures::last(l).map_or(f64::NAN, |rung| rung.y_m * 1e3), l.published.d_max_m * 1e3);
    Values::new()
        .with("name", printed(&l.published.kind))
        .with("kind", &l.published.kind)
        .with("measured_mm", measured_mm)
        .with("last_mm", last_mm)
        .with("left_mm", last_mm - measured_mm)
        .with("absorbing_nm2", l.calibrated_bending)
        .with("bare_mm", l.rungs[0].y_m * 1e3)
}

fn draw_study(study: &Comparison, files: &mut Files) -> Result<Values> {
    let (first, name) = (&study.variants[0], &study.dataset.name);
    let map = residual_figure::map("Bare model: where it misses", &first.evaluation.residual_map, &study.dataset)?;
    files.plot(&format!("{name}_map"), map);
    Ok(Values::new()
        .with("data", name)
        .with("where_it_fails", first.evaluation.where_it_fails.iter().map(|s| &s.sentence).collect::<Vec<_>>()))
}
