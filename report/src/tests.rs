//! Laws that every chart obeys: both formats for good data, an error or a drawing but never a panic for odd data; and what every
//! page must hold.

use crate::chart::{Bar, Chart, ChartColumn, ChartRow, KeyLook, LegendEntry, Mark, Point, RowPlace, Space};
use crate::*;
use std::collections::BTreeMap;

const ODD: [f64; 10] = [0.0, 1.0, -1.0, 119.4, 1e-300, 1e14, -1e14, 1e300, f64::NAN, f64::INFINITY];

fn assert_drawn(drawn: &Drawn) {
    assert!(drawn.png.starts_with(b"\x89PNG\r\n\x1a\n") && drawn.png.ends_with(b"IEND\xaeB`\x82"));
    assert!(drawn.svg.starts_with("<svg width=\"520\"") && drawn.svg.trim_end().ends_with("</svg>"));
    assert!(!drawn.svg.contains("NaN") && !drawn.svg.contains("inf"));
}

fn label(name: &str) -> String {
    name.to_owned()
}

/// Every chart with two of everything, filled from `values` in turn and labelled `name`.
fn charts(name: &str, values: &[f64]) -> Vec<Result<Drawn, ReportError>> {
    let v = |i: usize| values[i % values.len()];
    planes(name, &v).into_iter().chain(stacks(name, &v)).collect()
}

/// The charts with two axes of numbers.
fn planes(name: &str, v: &dyn Fn(usize) -> f64) -> Vec<Result<Drawn, ReportError>> {
    let points = vec![[v(0), v(1)], [v(2), v(3)], [v(4), v(5)]];
    let measured = [[v(1), v(0)], [v(2), v(3)]];
    let pose = ShapePose {
        label: label(name),
        curve_mm: points.clone(),
        predicted_mm: points.clone(),
        measured: vec![measured; 2],
    };
    let shape = Shapes {
        title: label(name),
        across: label(name),
        rest_mm: points.clone(),
        body_radius_mm: v(1),
        poses: vec![pose.clone(), pose],
    };
    let point = |i: usize| {
        let (at, ink, symbol, label) = ([v(i), v(i + 1)], Ink::Series(i), Symbol::of(i), label(name));
        Mark::Point(Point { at, ink, symbol, label, ..Point::default() })
    };
    let front = Mark::Dashed(points.clone(), Ink::Axis);
    let marks = vec![front, point(0), point(1)];
    let cost = Chart { title: label(name), y_label: label(name), space: Space::Log, marks, ..Chart::default() };
    let line = |style: LineStyle| LineSeries {
        name: label(name),
        points: points.clone(),
        half_width: vec![v(0), v(1), v(2)],
        style,
        colour: None,
    };
    let styles = [LineStyle::Line, LineStyle::Dashed, LineStyle::Points, LineStyle::OpenPoints, LineStyle::LinePoints];
    let curves =
        Lines { title: label(name), x_label: label(name), y_label: label(name), series: styles.map(line).to_vec() };
    vec![shapes(&shape), cost.draw("trade-off"), lines(&curves)]
}

fn stacks(name: &str, v: &dyn Fn(usize) -> f64) -> Vec<Result<Drawn, ReportError>> {
    let target = Some((label(name), v(3)));
    let step = |i: usize| LadderStep {
        label: label(name),
        value: v(i),
        range: Some([v(i + 1), v(i + 2)]),
        known: ("assumed", Ink::Series(4)),
    };
    let steps = [step(0), step(1)];
    let bar = |i: usize| (label(name), vec![v(i), v(i + 1)], i == 0);
    let series = [bar(0), bar(1)];
    let case = (label(name), vec![v(0), v(1), v(2)]);
    let bar = |row: usize| Mark::Bar(Bar::to(row, v(row), Ink::Ink, number(v(row), 1)));
    let keys = vec![LegendEntry::new(KeyLook::Patch, Ink::Grid, name)];
    let order = rows(name, name, vec![ChartRow::beside(name), ChartRow::beside(name)], vec![bar(0), bar(1)], keys);
    let (groups, terms) = ([label(name), label(name)], [label(name), label(name), label(name)]);
    let (rungs, grouped) = (ladder(name, name, &steps, target.clone()), bars(name, name, &groups, &series, target));
    vec![
        rungs,
        grouped,
        ledger(name, name, &terms, &[case.clone(), case]),
        order.draw("ranking"),
        map(name, v).draw("map"),
    ]
}

/// A heat map of two panels.
fn map(name: &str, v: &dyn Fn(usize) -> f64) -> Chart {
    let heading = ChartRow { name: label(name), place: RowPlace::Heading, ..ChartRow::default() };
    let column = |k: usize| ChartColumn {
        name: number(v(k), 0),
        groups: [label(name), label(if k > 0 { name } else { "other" })],
    };
    let cell = |row: usize, column: usize| {
        Mark::Cell([row, column], v(row + column), number(v(row), 1), label(if row > 1 { name } else { "" }))
    };
    Chart {
        title: label(name),
        space: Space::Grid(vec![heading, ChartRow::beside(name), ChartRow::beside(name)], vec![column(0), column(1)]),
        marks: vec![cell(1, 0), cell(1, 1), cell(2, 0), cell(2, 1)],
        heat: Some((label(name), v(4))),
        ..Chart::default()
    }
}

#[test]
fn every_chart_gives_an_svg_and_a_png() {
    for drawn in charts("tip [mm], η = 0.6 <&>", &[12.0, 30.0, 5.0, 119.4, 60.0, 90.0]) {
        let drawn = drawn.unwrap();
        assert_drawn(&drawn);
        assert!(!drawn.svg.contains("<&>"), "labels must be escaped");
    }
}

#[test]
fn equal_values_and_long_labels_still_draw() {
    let long = "a very long label without an end ".repeat(20);
    for drawn in charts(&long, &[7.5]) {
        assert_drawn(&drawn.unwrap());
    }
}

#[test]
fn odd_values_give_a_drawing_or_an_error() {
    for start in 0..ODD.len() {
        let mut values = ODD.to_vec();
        values.rotate_left(start);
        values.truncate(3);
        for drawn in charts("odd\n\u{0}", &values) {
            match drawn {
                Ok(drawn) => assert_drawn(&drawn),
                Err(error) => {
                    assert!(matches!(error, ReportError::NothingToDraw { .. } | ReportError::TooLarge { .. }))
                }
            }
        }
    }
}

#[test]
fn charts_without_a_finite_value_say_so() {
    let empty = [
        shapes(&Shapes::default()),
        ladder("", "", &[], None),
        bars("", "", &[], &[], None),
        lines(&Lines::default()),
        ledger("", "", &[], &[]),
        Chart::default().draw("chart"),
        Chart { space: Space::Grid(Vec::new(), Vec::new()), ..Chart::default() }.draw("map"),
    ];
    for drawn in empty.into_iter().chain(charts("nothing", &[f64::NAN])) {
        assert!(matches!(drawn, Err(ReportError::NothingToDraw { .. })));
    }
}

#[test]
fn lists_that_do_not_match_are_named() {
    let error = bars("", "", &[label("a"), label("b")], &[(label("s"), vec![1.0], false)], None).unwrap_err();
    assert!(matches!(error, ReportError::Length { chart: "bars", expected: 2, found: 1, .. }), "{error}");
    let poses = vec![ShapePose::default(); 7];
    assert!(matches!(shapes(&Shapes { poses, ..Shapes::default() }), Err(ReportError::TooMany { most: 6, .. })));
}

const EVIL: &str = "<script>alert(1)</script><img src=http://x>";

/// The page of a ladder, whose every text is an attack.
fn ladder_page() -> String {
    let errors = BTreeMap::from([("training_mm", "1"), ("heldout_pressure_mm", "2"), ("heldout_run_mm", "")]);
    let rung = minijinja::context! { label => EVIL, of => minijinja::value::Serde(errors) };
    let values = minijinja::context! {
        title => EVIL, lead => EVIL, program => EVIL, date => "today", rungs => vec![rung], notes => vec![EVIL],
        provenance => vec![vec![EVIL, EVIL]],
    };
    let series = LineSeries { name: label("a"), points: vec![[0.0, 1.0], [1.0, 2.0]], ..LineSeries::default() };
    let drawn = lines(&Lines { series: vec![series], ..Lines::default() }).unwrap();
    page::render("ladder.html", &values, BTreeMap::from([(label("waterfall"), drawn.svg)])).unwrap()
}

#[test]
fn the_page_escapes_every_text_and_has_its_sections() {
    let page = ladder_page();
    assert!(!page.contains("<script") && !page.contains("<img"));
    assert_eq!(page.matches("&lt;script&gt;").count(), 8, "the title twice, six other texts");
    for id in ["waterfall", "steps"] {
        assert!(page.contains(&format!("<h2 id=\"{id}\"")) && page.contains(&format!("href=\"#{id}\"")), "{id}");
    }
    assert!(page.starts_with("<!DOCTYPE html>") && page.trim_end().ends_with("</html>"));
}

#[test]
fn the_page_refers_to_nothing_outside_itself() {
    let page = ladder_page();
    for reference in ["src=\"", "url(", "@import", "<link", "<iframe", "xmlns", "href=\"http"] {
        assert!(!page.contains(reference), "{reference}");
    }
    assert!(page.split("href=\"").skip(1).all(|rest| rest.starts_with('#')));
}

#[test]
fn a_picture_inside_a_figure_is_allowed_by_the_policy_of_the_page() {
    let picture = labelled(b"\x89PNG", [96, 60], &[("tip", [1, 2], [3, 4])]);
    assert!(picture.contains("href=\"data:image/png;base64,"));
    let page = ladder_page();
    let policy = page.split("Content-Security-Policy\" content=\"").nth(1).and_then(|rest| rest.split('"').next());
    let policy = policy.unwrap();
    assert!(policy.contains("default-src 'none'") && policy.contains("img-src data:"), "{policy}");
}

#[test]
fn plots_take_the_colours_and_the_font_of_the_page() {
    let page = ladder_page();
    let figure = &page[page.find("<figure").unwrap()..page.find("</figure>").unwrap()];
    assert!(figure.contains("role=\"img\"") && figure.contains("<title") && figure.contains("viewBox=\"0 0 5200"));
    assert!(figure.contains("var(--ink)") && figure.contains("var(--series-1)") && !figure.contains("font-family"));
    assert!(!figure.contains('#'), "a colour that does not follow the theme");
}

#[test]
fn a_value_that_is_missing_is_an_error_and_no_blank() {
    let error = page::render("ladder.html", &BTreeMap::from([("title", "t")]), BTreeMap::new()).unwrap_err();
    assert!(error.to_string().contains("cannot be filled in"), "{error}");
}
