//! The demonstration: every actuator against the published displacements and against the embedded marker sets.

use super::PageError;
use super::compare_page::{figure, lead};
use super::diagnosis_page::{Diagnosed, diagnosis_sections};
use super::engines_page::engine_sections;
use super::{Files, Imprint, figures, residual_figure, tables};
use compare::CompareError;
use compare::known::Known;
use compare::study::Study;
use compare::study::demo::{Demo, HIDDEN_IN, Story};
use compare::study::engines::stored;
use compare::study::published::PublishedLadder;
use compare::study::witness::witness;
use report::page::{Block, Callout, Provenance, Report, Section};

/// The page of the demonstration and its plots.
///
/// # Errors
/// What cannot be drawn.
pub fn demo_page(demo: &Demo, imprint: &Imprint, progress: &mut dyn FnMut(&str)) -> Result<Files, PageError> {
    let mut files = Files::default();
    progress("plots of the published displacements");
    let mut sections =
        vec![tables::measured(&demo.measured), published_section(demo, &mut files)?, ladder_section(demo, &mut files)?];
    progress("plots of both engines");
    sections.extend(engine_sections(&demo.engines, &mut files)?);
    for study in &demo.studies {
        progress(&format!("plots of {}", study.dataset.name));
        sections.push(study_section(study, &mut files)?);
    }
    progress("plots of the diagnosis");
    sections.extend(story_sections(&demo.diagnosed, &mut files)?);
    sections.push(tradeoff_section(demo, imprint, &mut files)?);
    sections.push(limits_section());
    let line = |name: &str, value: &str| Provenance { name: name.into(), value: value.into() };
    let report = Report {
        title: "Four pneumatic bending actuators: models held against measurements".into(),
        lead: demo_lead(demo),
        generated_by: imprint.program.clone(),
        generated_on: imprint.date.clone(),
        sections,
        provenance: vec![
            line("published numbers", "du Pasquier, Jeong, Okamura, IEEE RA-L 2023, doi 10.1109/LRA.2023.3320010"),
            line("marker sets", "synthetic, made by this program's generator; no measurement"),
            line("machine", &imprint.machine),
        ],
    };
    files.report(&report)?;
    Ok(files)
}

fn demo_lead(demo: &Demo) -> String {
    let words = demo.ladders.iter().map(|l| {
        let last = l.rungs.iter().rfind(|r| r.known != Known::Calibrated).unwrap_or(&l.rungs[0]);
        format!(
            "{} {:.1} → {:.1} mm (measured {:.1})",
            l.published.printed_name,
            l.rungs[0].y_m * 1e3,
            last.y_m * 1e3,
            l.published.d_max_m * 1e3
        )
    });
    format!(
        "Bare models over-predict every published displacement; adding physical effects whose sizes come from geometry, \
         fabric moduli or a volume formula, and not from the measurement, brings: {}.",
        words.collect::<Vec<_>>().join("; ")
    )
}

fn published_section(demo: &Demo, files: &mut Files) -> Result<Section, PageError> {
    let bars = figures::published_bars(&demo.ladders)?;
    files.plot("published", &bars);
    let note = "The paper prints one displacement per actuator and no marker positions. Pouch count, marker stations and \
                weld widths are assumed in the shipped scenarios. A model that meets one number is not validated by it.";
    Ok(Section {
        id: "published".into(),
        heading: "Against the published displacements".into(),
        blocks: vec![
            figure("The middle bars are fitted to nothing.", "bars of displacement per actuator", &bars.svg),
            Block::Callout { kind: Callout::Warning, text: note.into() },
            tables::published(&demo.ladders),
            tables::origins(
                demo.ladders.iter().flat_map(|l| &l.rungs).map(|r| (r.label.as_str(), r.known, r.why.as_str())),
            ),
        ],
    })
}

fn ladder_section(demo: &Demo, files: &mut Files) -> Result<Section, PageError> {
    let mut blocks = Vec::new();
    for ladder in &demo.ladders {
        let drawn = figures::published_ladder(ladder)?;
        files.plot(&format!("ladder_{}", ladder.published.kind), &drawn);
        blocks.push(figure(&ladder_words(ladder), "bars of displacement per model", &drawn.svg));
    }
    Ok(Section { id: "ladders".into(), heading: "One effect after the other".into(), blocks })
}

fn ladder_words(ladder: &PublishedLadder) -> String {
    let measured = ladder.published.d_max_m * 1e3;
    let last = ladder.rungs.iter().rfind(|r| r.known != Known::Calibrated).unwrap_or(&ladder.rungs[0]);
    let rest = last.y_m * 1e3 - measured;
    let closing = match ladder.calibrated_bending {
        Some(b) => format!(
            "A bending stiffness of {b:.2} N m² would absorb the rest; that is a calibration on this one number."
        ),
        None => "The model is below the measurement; no bending stiffness can mend that.".into(),
    };
    format!("{}: {rest:+.1} mm remain without any fit. {closing}", ladder.published.printed_name)
}

fn study_section(study: &Study, files: &mut Files) -> Result<Section, PageError> {
    let name = &study.dataset.name;
    let bare = &study.variants[0];
    let last = study.variants.last().unwrap_or(bare);
    let map = residual_figure::map("Bare model: where it misses", &bare.evaluation.residual_map, &study.dataset)?;
    let after = residual_figure::map("Last model: what is left", &last.evaluation.residual_map, &study.dataset)?;
    let shapes = figures::shapes("Bare model and measured shape", &bare.scenario, &study.dataset)?;
    let ladder = figures::error_ladder("Error beyond noise", &study.variants)?;
    let curve = figures::pressure_curve("Pressure and height", study)?;
    let cases: Vec<_> = study.variants.iter().map(|v| (v.label.clone(), v.scenario.clone())).collect();
    let ledger = figures::at_highest(&study.dataset).map(|(title, loads)| figures::ledgers(&title, &cases, &loads));
    let ledger = ledger.transpose()?;
    for (kind, drawn) in
        [("map", &map), ("map_after", &after), ("shapes", &shapes), ("ladder", &ladder), ("pressure", &curve)]
    {
        files.plot(&format!("{name}_{kind}"), drawn);
    }
    files.table(&format!("{name}_holds"), tables::holds(&study.variants))?;
    let mut blocks = vec![Block::Paragraph(lead(study))];
    let statements = bare.evaluation.where_it_fails.iter().map(|s| s.sentence.clone());
    blocks.push(Block::List(statements.collect()));
    blocks.push(figure(
        &format!("Signed residual in units of the noise. {}", residual_figure::MAP_COLOURS),
        "heat map, markers by holds",
        &map.svg,
    ));
    blocks.push(figure("Lines and open marks: bare model. Filled marks: mean over runs.", "centre lines", &shapes.svg));
    blocks.push(tables::variants(&study.variants));
    blocks.push(tables::origins(study.variants.iter().map(|v| (v.label.as_str(), v.known, v.why.as_str()))));
    blocks.push(figure(
        "Each bar is one more effect, or one calibration. An addition that does not belong here need not help.",
        "bars of error",
        &ladder.svg,
    ));
    blocks.push(figure("What the last model leaves.", "heat map, markers by holds", &after.svg));
    blocks.push(figure(curve_caption(study), "marker height over pressure", &curve.svg));
    blocks.push(tables::accuracy(bare));
    blocks.push(tables::accuracy(last));
    blocks.push(Block::Paragraph(bare.evaluation.scaling.sentence.clone()));
    if let Some(ledger) = ledger {
        files.plot(&format!("{name}_ledger"), &ledger);
        blocks.push(figure("Potential energies; the actuator's bar is −PΔV.", "stacked energies", &ledger.svg));
    }
    Ok(Section { id: name.replace(['_', '.'], "-"), heading: format!("Marker set {name}"), blocks })
}

fn curve_caption(study: &Study) -> &'static str {
    match figures::several_bodies(&study.dataset) {
        true => "First and last model. Filled marks and solid lines: the first body pressure; open and dashed: others.",
        false => "All models.",
    }
}

/// The sections of a diagnosis, each named as part of it.
fn story_sections(story: &Story, files: &mut Files) -> Result<Vec<Section>, PageError> {
    let (d, about) = (&story.diagnosis, story.about.as_ref());
    let witness = witness(d, &story.scenario, &story.dataset, about, &stored().map_err(CompareError::from)?)?;
    let found = Diagnosed {
        diagnosis: d,
        scenario: &story.scenario,
        dataset: &story.dataset,
        about,
        witness: witness.as_ref(),
        typed: HIDDEN_IN,
        more: String::new(),
    };
    let mut sections = diagnosis_sections(&found, "diagnosis_", files)?;
    for section in &mut sections {
        section.heading = format!("Diagnosis of {}: {}", HIDDEN_IN[1], section.heading);
    }
    Ok(sections)
}

fn tradeoff_section(demo: &Demo, imprint: &Imprint, files: &mut Files) -> Result<Section, PageError> {
    let drawn = figures::tradeoff(&demo.timings)?;
    files.plot("tradeoff", &drawn);
    Ok(Section {
        id: "tradeoff".into(),
        heading: "Run time against accuracy".into(),
        blocks: vec![
            Block::Paragraph(format!("Median of one prediction on {}.", imprint.machine)),
            figure(
                "Calibrated reduced models are left out: their error is zero by construction.",
                "scatter",
                &drawn.svg,
            ),
            tables::timings(&demo.timings),
        ],
    })
}

fn limits_section() -> Section {
    let list = [
        "Four displacements do not tell which effect is missing: several sizes of several effects meet them.",
        "The sealed-edge loss uses a volume ratio as a stroke ratio: an assumption.",
        "The sPAM's remaining difference is not explained by sealed edges, arm and fabric stretch; the taped sheet's margin, \
         tape and weld width are candidates that no published number decides.",
        "The marker sets are synthetic. They show that the comparison finds what was put in, not that the models are right.",
        "The finite element runs rest on assumed stiffnesses of tape, glue and seams; agreement with four numbers is no proof.",
    ];
    Section {
        id: "limits".into(),
        heading: "What this does not show".into(),
        blocks: vec![Block::List(list.map(String::from).to_vec())],
    }
}
