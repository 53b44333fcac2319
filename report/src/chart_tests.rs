//! Laws that every chart obeys: both formats for good data, an error or a drawing but never a panic for odd data.

use crate::*;

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

/// The charts with two axes.
fn planes(name: &str, v: &dyn Fn(usize) -> f64) -> Vec<Result<Drawn, ReportError>> {
    let points = vec![[v(0), v(1)], [v(2), v(3)], [v(4), v(5)]];
    let measured = MeasuredPoint { at_mm: [v(1), v(0)], half_width_mm: [v(2), v(3)] };
    let pose = ShapePose {
        label: label(name),
        curve_mm: points.clone(),
        predicted_mm: points.clone(),
        measured: vec![measured; 2],
    };
    let shape =
        Shapes { title: label(name), rest_mm: points.clone(), body_radius_mm: v(1), poses: vec![pose.clone(), pose] };
    let hold =
        |p: f64| MapHold { p_act_kpa: p, phase: label(name), group: label(if p > 0.0 { name } else { "other" }) };
    let map = ResidualMap {
        title: label(name),
        value_label: label(name),
        holds: vec![hold(v(0)), hold(v(1))],
        stations_mm: vec![v(2), v(3)],
        panels: [0, 1]
            .map(|k| MapPanel { label: label(name), values: vec![vec![v(k), v(1)], vec![v(2), v(3)]] })
            .to_vec(),
        limit: v(4),
    };
    let point = |i: usize| TradeoffPoint { label: label(name), group: label(name), run_time_s: v(i), error: v(i + 1) };
    let cost = Tradeoff { title: label(name), error_label: label(name), points: vec![point(0), point(1)] };
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
    vec![shapes(&shape), residual_map(&map), tradeoff(&cost), lines(&curves)]
}

/// The charts of horizontal bars.
fn stacks(name: &str, v: &dyn Fn(usize) -> f64) -> Vec<Result<Drawn, ReportError>> {
    let step =
        |i: usize| LadderStep { label: label(name), value: v(i), range: Some([v(i + 1), v(i + 2)]), known: "assumed" };
    let target = || LadderTarget { label: label(name), value: v(3), half_width: v(4) };
    let steps =
        Ladder { title: label(name), value_label: label(name), steps: vec![step(0), step(1)], target: Some(target()) };
    let bar = |i: usize| BarSeries {
        name: label(name),
        values: vec![v(i), v(i + 1)],
        half_width: vec![v(i + 2), v(i + 3)],
        reference: i == 0,
    };
    let groups = Bars {
        title: label(name),
        value_label: label(name),
        groups: vec![label(name); 2],
        series: vec![bar(0), bar(1)],
        target: Some(target()),
    };
    let case = LedgerCase { label: label(name), energies_mj: vec![v(0), v(1), v(2)] };
    let book = Ledger {
        title: label(name),
        value_label: label(name),
        terms: vec![label(name); 3],
        cases: vec![case.clone(), case],
    };
    let row = |i: usize, class: RankClass| RankingRow { label: label(name), value: v(i), class };
    let order = Ranking {
        title: label(name),
        value_label: label(name),
        rows: vec![row(0, RankClass::Alike), row(1, RankClass::Worse), row(2, RankClass::Rejected)],
    };
    vec![ladder(&steps), bars(&groups), ledger(&book), ranking(&order)]
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
        residual_map(&ResidualMap::default()),
        ladder(&Ladder::default()),
        bars(&Bars::default()),
        tradeoff(&Tradeoff::default()),
        lines(&Lines::default()),
        ledger(&Ledger::default()),
        ranking(&Ranking::default()),
    ];
    for drawn in empty.into_iter().chain(charts("nothing", &[f64::NAN])) {
        assert!(matches!(drawn, Err(ReportError::NothingToDraw { .. })));
    }
}

#[test]
fn lists_that_do_not_match_are_named() {
    let ragged = Bars {
        groups: vec![label("a"), label("b")],
        series: vec![BarSeries { values: vec![1.0], ..BarSeries::default() }],
        ..Bars::default()
    };
    let error = bars(&ragged).unwrap_err();
    assert!(matches!(error, ReportError::Length { chart: "bars", expected: 2, found: 1, .. }), "{error}");
    let poses = vec![ShapePose::default(); 7];
    assert!(matches!(shapes(&Shapes { poses, ..Shapes::default() }), Err(ReportError::TooMany { most: 6, .. })));
}
