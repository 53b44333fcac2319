//! The page of a scenario compared with a dataset.

use super::{Maker, Result, Values, figures, residual_figure, tables};
use crate::prelude::*;
use crate::shown::comparison::CompareAnswer;
use ::compare::study::Comparison;
use data::About;

/// The page of a comparison and its files.
pub fn compare_page(study: &Comparison, maker: &Maker) -> Result<Files> {
    let mut files = compare_files(study)?;
    let (first, dataset) = (&study.variants[0], &study.dataset);
    let values = Values::new()
        .with("title", format!("{} compared with {}", first.scenario.name, dataset.name))
        .with("lead", lead(study))
        .with("found", CompareAnswer::of(&first.scenario.name, study, None))
        .with("provenance", provenance(study))
        .with("several_bodies", figures::several_bodies(dataset))
        .with("has_z", dataset.has_z())
        .with("map_colours", residual_figure::colours(dataset));
    files.page("compare.html", values, maker)?;
    Ok(files)
}

/// Files of the page: plots and tables.
pub fn compare_files(study: &Comparison) -> Result<Files> {
    let mut files = Files::default();
    let (first, dataset) = (&study.variants[0], &study.dataset);
    let shapes = |axis| figures::shapes("Predicted and measured shape", &first.scenario, dataset, axis);
    files.plot("shapes", shapes(1)?);
    if dataset.has_z() {
        files.plot("shapes_z", shapes(2)?);
    }
    let map = residual_figure::map("Where the model misses", &first.evaluation.residual_map, dataset)?;
    files.plot("residual_map", map);
    if !first.scenario.is_spatial() && !dataset.channels_differ() {
        files.plot("pressure", figures::pressure_curve("Pressure and height", study)?);
    }
    files.table("holds", tables::holds(&study.variants))?;
    if study.variants.len() > 1 {
        files.plot("ladder", figures::error_ladder("Error beyond noise", &study.variants)?);
    }
    if let Some((title, loads)) = figures::at_highest(dataset) {
        let cases: Vec<_> = study.variants.iter().map(|v| (v.label.clone(), v.scenario.clone())).collect();
        files.plot("ledger", figures::ledgers(&title, &cases, &loads)?);
    }
    Ok(files)
}

fn lead(study: &Comparison) -> String {
    let first = &study.variants[0];
    let all = &first.evaluation.metrics.overall;
    let size = match all.systematic_mm {
        Some(mm) => format!("{mm:.2} mm beyond noise (noise of the mean {} mm)", number(all.noise_floor_mm, 2)),
        None => format!("{:.2} mm rms; the noise is unknown with one run", all.rmse_mm),
    };
    let worst = format!("largest tip error {:+.1} mm of {:.1} mm", all.largest_tip_error_mm, all.d_max_mm);
    let mut text = format!("**{}** misses the data by {size}; {worst}.", effect(&first.label));
    if let (Some(last), true) = (study.variants.last(), study.variants.len() > 1) {
        let after = last.evaluation.metrics.overall.systematic_mm.unwrap_or(last.evaluation.metrics.overall.rmse_mm);
        text.push_str(&format!(" With **{}** ({}) {after:.2} mm remain.", effect(&last.label), last.known.word()));
    }
    text
}

fn provenance(study: &Comparison) -> Vec<[String; 2]> {
    let first = &study.variants[0];
    let mut lines = origin(&first.scenario.name, &study.dataset, study.about.as_ref(), &study.warnings);
    lines.insert(3, ["pairing".into(), first.evaluation.metrics.pairing.into()]);
    lines
}

/// Where scenario and data of a page are from, and what does not fit between them.
pub(super) fn origin(
    scenario: &str,
    dataset: &Dataset,
    about: Option<&About>,
    warnings: &[String],
) -> Vec<[String; 2]> {
    let line = |name: &str, value: &str| [name.into(), value.into()];
    let mut lines =
        vec![line("scenario", scenario), line("data", &dataset.name), line("runs", &dataset.runs.len().to_string())];
    if let Some(about) = about {
        lines.push(line("data are", &format!("{}: {}", about.provenance.word(), about.title)));
        lines.push(line("source", &about.source));
        lines.push(line("licence", &about.licence));
    }
    lines.extend(warnings.iter().map(|w| line("mismatch", w)));
    lines
}
