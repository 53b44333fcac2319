//! What the page template sees: finished HTML pieces (`*_html`) and plain strings, which it escapes.

use serde::Serialize;
use std::collections::BTreeSet;

use crate::page::{Align, Block, Callout, Report, Section, Table};
use crate::{ReportError, markup, svg};
use crate::{Theme, css_variables};

#[derive(Serialize)]
pub(crate) struct Page<'a> {
    title: &'a str,
    lead_html: String,
    generated_by: &'a str,
    generated_on: &'a str,
    light: String,
    dark: String,
    sections: Vec<SectionView<'a>>,
    provenance: Vec<[String; 2]>,
}

#[derive(Serialize)]
struct SectionView<'a> {
    id: &'a str,
    heading: &'a str,
    blocks: Vec<BlockView<'a>>,
}

/// One block; `kind` says which of the fields are set.
#[derive(Serialize, Default)]
struct BlockView<'a> {
    kind: &'static str,
    number: usize,
    label: &'static str,
    text_html: String,
    items_html: Vec<String>,
    head: Vec<HeadView<'a>>,
    rows_html: Vec<Vec<CellView>>,
}

#[derive(Serialize)]
struct HeadView<'a> {
    heading: &'a str,
    unit: &'a str,
    align: &'static str,
}

#[derive(Serialize)]
struct CellView {
    html: String,
    align: &'static str,
}

/// Numbers of the figures and tables given out so far.
#[derive(Default)]
struct Numbers {
    figures: usize,
    tables: usize,
}

/// Checks the report and prepares it for the template.
pub(crate) fn page(report: &Report) -> Result<Page<'_>, ReportError> {
    check_ids(&report.sections)?;
    let mut numbers = Numbers::default();
    let sections = report.sections.iter().map(|s| section(s, &mut numbers)).collect::<Result<_, _>>()?;
    Ok(Page {
        title: &report.title,
        lead_html: markup::inline(&report.lead),
        generated_by: &report.generated_by,
        generated_on: &report.generated_on,
        light: css_variables(Theme::Light),
        dark: css_variables(Theme::Dark),
        sections,
        provenance: report.provenance.iter().map(|p| [markup::escape(&p.name), markup::inline(&p.value)]).collect(),
    })
}

fn check_ids(sections: &[Section]) -> Result<(), ReportError> {
    let mut seen = BTreeSet::new();
    for Section { id, .. } in sections {
        let allowed = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-';
        if id.is_empty() || !id.chars().all(allowed) || !seen.insert(id) {
            return Err(ReportError::Id { id: id.clone() });
        }
    }
    Ok(())
}

fn section<'a>(section: &'a Section, numbers: &mut Numbers) -> Result<SectionView<'a>, ReportError> {
    let blocks = section.blocks.iter().map(|b| block(b, numbers)).collect::<Result<_, _>>()?;
    Ok(SectionView { id: &section.id, heading: &section.heading, blocks })
}

fn block<'a>(block: &'a Block, numbers: &mut Numbers) -> Result<BlockView<'a>, ReportError> {
    let view = |kind, text_html| BlockView { kind, text_html, ..BlockView::default() };
    Ok(match block {
        Block::Paragraph(text) => view("paragraph", markup::inline(text)),
        Block::Callout { kind, text } => BlockView { label: callout(*kind), ..view("callout", markup::inline(text)) },
        Block::List(items) => {
            BlockView { items_html: items.iter().map(|i| markup::inline(i)).collect(), ..view("list", String::new()) }
        }
        Block::Code(text) => view("code", markup::escape(text)),
        Block::Figure { caption, alt, svg } => {
            numbers.figures += 1;
            figure((caption, alt, svg), numbers.figures)?
        }
        Block::Table(data) => {
            numbers.tables += 1;
            table(data, numbers.tables)?
        }
    })
}

fn callout(kind: Callout) -> &'static str {
    match kind {
        Callout::Result => "Result",
        Callout::Note => "Note",
        Callout::Warning => "Warning",
    }
}

fn figure((caption, alt, plot): (&str, &str, &str), number: usize) -> Result<BlockView<'static>, ReportError> {
    let drawing = svg::inline(plot, &format!("figure-{number}-title"), alt)
        .map_err(|reason| ReportError::Svg { caption: caption.to_owned(), reason })?;
    let items_html = vec![markup::inline(caption)];
    Ok(BlockView { kind: "figure", number, text_html: drawing, items_html, ..BlockView::default() })
}

fn table(table: &Table, number: usize) -> Result<BlockView<'_>, ReportError> {
    let expected = table.columns.len();
    if let Some((row, cells)) = table.rows.iter().enumerate().find(|(_, cells)| cells.len() != expected) {
        let (caption, found) = (table.caption.clone(), cells.len());
        return Err(ReportError::Cells { caption, row: row + 1, expected, found });
    }
    let how = |i: usize| table.how_column == Some(i);
    let class = |i: usize| if how(i) { "how" } else { align(table.columns[i].align) };
    let head = table.columns.iter().enumerate();
    let head = head.map(|(i, c)| HeadView { heading: &c.heading, unit: &c.unit, align: class(i) });
    let cell = |(i, text): (usize, &String)| CellView {
        html: if how(i) { markup::with_tags(text) } else { markup::inline(text) },
        align: class(i),
    };
    let rows_html = table.rows.iter().map(|row| row.iter().enumerate().map(cell).collect()).collect();
    let items_html = vec![markup::inline(&table.caption)];
    Ok(BlockView { kind: "table", number, items_html, head: head.collect(), rows_html, ..BlockView::default() })
}

fn align(align: Align) -> &'static str {
    match align {
        Align::Left => "left",
        Align::Right => "right",
        Align::Centre => "centre",
    }
}
