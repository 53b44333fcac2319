//! What every page must hold, whatever the report says.

use crate::ReportError;
use crate::page::*;

fn plot() -> String {
    let series = crate::LineSeries { name: "a".to_owned(), points: vec![[0.0, 1.0], [1.0, 2.0]], ..Default::default() };
    crate::lines(&crate::Lines { series: vec![series], ..Default::default() }).unwrap().svg
}

fn table() -> Table {
    let column =
        |heading: &str, unit: &str| Column { heading: heading.to_owned(), unit: unit.to_owned(), align: Align::Right };
    Table {
        caption: "Tip displacement".to_owned(),
        columns: vec![column("actuator", ""), column("tip", "mm"), column("how", "")],
        rows: vec![["bellows", "12.5", "assumed"].map(str::to_owned).to_vec()],
        how_column: Some(2),
    }
}

fn section(id: &str, blocks: Vec<Block>) -> Section {
    Section { id: id.to_owned(), heading: format!("Heading of {id}"), blocks }
}

fn report() -> Report {
    let evil = "<script>alert(1)</script><img src=http://x>";
    Report {
        title: evil.to_owned(),
        lead: evil.to_owned(),
        generated_by: evil.to_owned(),
        generated_on: "today".to_owned(),
        sections: vec![
            section(
                "one",
                vec![Block::Paragraph(evil.to_owned()), Block::Code(evil.to_owned()), Block::Table(table())],
            ),
            section("two", vec![Block::Figure { caption: evil.to_owned(), alt: evil.to_owned(), svg: plot() }]),
            section(
                "three",
                vec![
                    Block::List(vec![evil.to_owned()]),
                    Block::Callout { kind: Callout::Warning, text: evil.to_owned() },
                ],
            ),
        ],
        provenance: vec![Provenance { name: evil.to_owned(), value: evil.to_owned() }],
    }
}

#[test]
fn the_page_holds_every_section_and_escapes_every_text() {
    let page = render(&report()).unwrap();
    assert!(!page.contains("<script") && !page.contains("<img"));
    assert_eq!(page.matches("&lt;script&gt;").count(), 11 + 1, "eleven texts, the title twice");
    for id in ["one", "two", "three"] {
        assert!(page.contains(&format!("<section id=\"{id}\"")) && page.contains(&format!("href=\"#{id}\"")), "{id}");
        assert!(page.contains(&format!("Heading of {id}</h2>")), "{id}");
    }
}

#[test]
fn the_page_refers_to_nothing_outside_itself() {
    let page = render(&report()).unwrap();
    for reference in ["src=\"", "url(", "@import", "<link", "<iframe", "xmlns", "href=\"http"] {
        assert!(!page.contains(reference), "{reference}");
    }
    assert!(page.split("href=\"").skip(1).all(|rest| rest.starts_with('#')));
}

#[test]
fn plots_take_the_colours_of_the_page_in_both_themes() {
    let page = render(&report()).unwrap();
    let figure = &page[page.find("<figure").unwrap()..page.find("</figure>").unwrap()];
    assert!(figure.contains("role=\"img\"") && figure.contains("<title"));
    assert!(figure.contains("var(--ink)") && figure.contains("var(--series-1)"));
    assert!(!figure.contains("=\"#"), "a fixed colour is left");
    assert!(page.contains("prefers-color-scheme: dark") && page.contains("name=\"viewport\""));
}

#[test]
fn tables_name_units_and_tag_how_we_know() {
    let page = render(&report()).unwrap();
    assert!(page.contains("<th scope=\"col\" class=\"right\">tip <span class=\"unit\">[mm]</span></th>"));
    assert!(page.contains("<span class=\"tag tag-assumed\">assumed</span>"));
    assert!(page.contains("<th scope=\"row\""));
}

#[test]
fn bad_ids_rows_and_plots_are_errors_that_say_which() {
    let with = |blocks| Report { sections: vec![section("a", blocks)], ..Report::default() };
    let twice = Report { sections: vec![section("a", vec![]), section("a", vec![])], ..Report::default() };
    assert!(matches!(render(&twice), Err(ReportError::Id { id }) if id == "a"));
    let spaced = Report { sections: vec![section("a b", vec![])], ..Report::default() };
    assert!(matches!(render(&spaced), Err(ReportError::Id { .. })));
    let mut ragged = table();
    ragged.rows[0].pop();
    let ragged = render(&with(vec![Block::Table(ragged)]));
    assert!(matches!(ragged, Err(ReportError::Cells { row: 1, expected: 3, found: 2, .. })));
    let foreign = Block::Figure { caption: "c".to_owned(), alt: String::new(), svg: "<svg ><script></svg>".to_owned() };
    assert!(matches!(render(&with(vec![foreign])), Err(ReportError::Svg { caption, .. }) if caption == "c"));
}

#[test]
fn an_empty_report_is_still_a_page() {
    let page = render(&Report::default()).unwrap();
    assert!(page.starts_with("<!DOCTYPE html>") && page.trim_end().ends_with("</html>"));
}
