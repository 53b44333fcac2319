//! One scenario held against one dataset: numbers, files and the page.

use super::PageError;
use super::{Files, Imprint, figures, residual_figure, tables};
use compare::study::{Study, Variant};
use report::page::{Block, Callout, Provenance, Report, Section};

/// The page of a comparison and the files beside it.
///
/// # Errors
/// What cannot be drawn.
pub fn compare_page(study: &Study, imprint: &Imprint) -> Result<Files, PageError> {
    let mut files = Files::default();
    let first = &study.variants[0];
    let shapes = figures::shapes("Predicted and measured shape", &first.scenario, &study.dataset)?;
    let map = residual_figure::map("Where the model misses", &first.evaluation.residual_map, &study.dataset)?;
    let curve = figures::pressure_curve("Pressure and height", study)?;
    for (name, drawn) in [("shapes", &shapes), ("residual_map", &map), ("pressure", &curve)] {
        files.plot(name, drawn);
    }
    files.table("holds", tables::holds(&study.variants))?;
    let residuals = figure(
        &format!("Signed residual of every marker in every hold. {}", residual_figure::MAP_COLOURS),
        "heat map of residuals, markers by holds",
        &map.svg,
    );
    let lines = figure(
        "Lines and open marks: model. Filled marks: mean over runs, bars one standard deviation.",
        "centre lines of the robot with markers",
        &shapes.svg,
    );
    let drawn_apart = match figures::several_bodies(&study.dataset) {
        true => {
            "Loading and unloading are drawn apart. Filled marks and solid lines: the first body pressure; open and dashed: others."
        }
        false => "Loading and unloading are drawn apart.",
    };
    let heights = figure(drawn_apart, "marker height over pressure", &curve.svg);
    let mut sections = vec![
        section("where", "Where it fails", failure_blocks(first, residuals)),
        section("shape", "Shape", vec![lines, heights]),
        section("accuracy", "Accuracy", accuracy_blocks(study)),
        section("noise", "Noise", noise_blocks(first)),
        section(
            "scaling",
            "Does the shape depend on P/p only?",
            vec![Block::Paragraph(first.evaluation.scaling.sentence.clone())],
        ),
    ];
    sections.extend(ledger_section(study, &mut files)?);
    if study.variants.len() > 1 {
        sections.insert(1, additions_section(study, &mut files)?);
    }
    let report = Report {
        title: format!("{} held against {}", first.scenario.name, study.dataset.name),
        lead: lead(study),
        generated_by: imprint.program.clone(),
        generated_on: imprint.date.clone(),
        sections,
        provenance: provenance(study),
    };
    files.report(&report)?;
    Ok(files)
}

pub(super) fn figure(caption: &str, alt: &str, svg: &str) -> Block {
    Block::Figure { caption: caption.into(), alt: alt.into(), svg: svg.into() }
}

/// Every effect and calibration beyond the first model.
fn additions_section(study: &Study, files: &mut Files) -> Result<Section, PageError> {
    let ladder = figures::error_ladder("Error beyond noise", &study.variants)?;
    files.plot("ladder", &ladder);
    let bars = figure("Each bar is one more effect or one calibration.", "bars of error per model", &ladder.svg);
    let origins = tables::origins(study.variants.iter().map(|v| (v.label.as_str(), v.known, v.why.as_str())));
    Ok(section("ladder", "What each addition brings", vec![tables::variants(&study.variants), origins, bars]))
}

/// The ledger at the highest pressure of the data; nothing if no hold has actuator pressure.
fn ledger_section(study: &Study, files: &mut Files) -> Result<Option<Section>, PageError> {
    let Some((title, loads)) = figures::at_highest(&study.dataset) else { return Ok(None) };
    let cases: Vec<_> = study.variants.iter().map(|v| (v.label.clone(), v.scenario.clone())).collect();
    let ledger = figures::ledgers(&title, &cases, &loads)?;
    files.plot("ledger", &ledger);
    let caption = "Potential energies at the highest pressure of the data. The actuator's bar is −PΔV: what its gas gave; \
                   with pressure held constant the other bars need not add up to it.";
    let figure = Block::Figure { caption: caption.into(), alt: "stacked energies".into(), svg: ledger.svg };
    Ok(Some(section("ledger", "Where the actuator's work goes", vec![figure])))
}

fn section(id: &str, heading: &str, blocks: Vec<Block>) -> Section {
    Section { id: id.into(), heading: heading.into(), blocks }
}

fn failure_blocks(variant: &Variant, map: Block) -> Vec<Block> {
    let statements = variant.evaluation.where_it_fails.iter().map(|s| s.sentence.clone()).collect();
    vec![Block::List(statements), map]
}

fn accuracy_blocks(study: &Study) -> Vec<Block> {
    let mut blocks = vec![Block::Callout {
        kind: Callout::Note,
        text: "The paper's accuracy is a = 1 − mean(((y_model − y_measured)/y_model)²). It squares the relative error \
               (94.3 % is an rms error of 23.9 %), divides by the model (over-prediction is almost free), ignores x, and \
               cannot reach 100 % when there is noise: the noise ceiling is what a perfect model would score here."
            .into(),
    }];
    blocks.extend(study.variants.iter().map(tables::accuracy));
    blocks
}

fn noise_blocks(variant: &Variant) -> Vec<Block> {
    let noise = &variant.evaluation.noise;
    let mut blocks = vec![Block::Paragraph(noise.sentence.clone())];
    if let Some(warning) = &noise.warning {
        blocks.push(Block::Callout { kind: Callout::Warning, text: warning.clone() });
    }
    blocks
}

/// The answer in a paragraph.
pub(super) fn lead(study: &Study) -> String {
    let first = &study.variants[0];
    let all = &first.evaluation.metrics.overall;
    let size = match all.systematic_mm {
        Some(mm) => format!("{mm:.2} mm beyond noise (noise of the mean {} mm)", tables::number(all.noise_floor_mm, 2)),
        None => format!("{:.2} mm rms; the noise is unknown with one run", all.rmse_mm),
    };
    let worst = format!("largest tip error {:+.1} mm of {:.1} mm", all.largest_tip_error_mm, all.d_max_mm);
    let mut text = format!("**{}** misses the data by {size}; {worst}.", first.label);
    if let (Some(last), true) = (study.variants.last(), study.variants.len() > 1) {
        let after = last.evaluation.metrics.overall.systematic_mm.unwrap_or(last.evaluation.metrics.overall.rmse_mm);
        text.push_str(&format!(" With **{}** ({}) {after:.2} mm remain.", last.label, last.known.word()));
    }
    if let Some(statement) = first.evaluation.where_it_fails.first() {
        text.push(' ');
        text.push_str(&statement.sentence);
    }
    text
}

fn provenance(study: &Study) -> Vec<Provenance> {
    let line = |name: &str, value: String| Provenance { name: name.into(), value };
    let mut lines = vec![
        line("scenario", study.variants[0].scenario.name.clone()),
        line("data", study.dataset.name.clone()),
        line("runs", study.dataset.runs.len().to_string()),
        line("pairing", study.variants[0].evaluation.metrics.pairing.to_string()),
    ];
    if let Some(about) = &study.about {
        lines.push(line("data are", format!("{}: {}", about.provenance.word(), about.title)));
        lines.push(line("source", about.source.clone()));
        lines.push(line("licence", about.licence.clone()));
    }
    lines.extend(study.warnings.iter().map(|w| line("mismatch", w.clone())));
    lines
}
