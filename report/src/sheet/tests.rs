use super::*;

fn square() -> PatternSheet {
    let layer = Pen { name: "CUT", meaning: "cut", colour: "#000000", aci: 7, dashes: &[] };
    let points = vec![[10.0, 20.0], [310.0, 20.0], [310.0, 320.0], [10.0, 320.0]];
    PatternSheet {
        title: "a <square>".into(),
        size: [320.0, 330.0],
        layers: vec![layer],
        lines: vec![PenLine { layer: 0, points, closed: true }],
        labels: vec![SheetText { at: [10.0, 5.0], height: 3.0, text: "300 mm × 300 mm".into() }],
    }
}

fn corners(svg: &str) -> Vec<[f64; 2]> {
    let list = svg.split("d=\"M").nth(1).and_then(|rest| rest.split('"').next()).unwrap();
    let pair = |p: &str| p.split_once(',').map(|(x, y)| [x.parse().unwrap(), y.parse().unwrap()]).unwrap();
    list.trim_end_matches('Z').split(' ').map(pair).collect()
}

fn attribute(text: &str, name: &str) -> String {
    text.split(&format!(" {name}=\"")).nth(1).and_then(|rest| rest.split('"').next()).unwrap().to_string()
}

#[test]
fn a_millimetre_of_the_drawing_is_one_on_paper() {
    let text = svg(&square());
    assert_eq!((attribute(&text, "width"), attribute(&text, "height")), ("320mm".into(), "330mm".into()));
    assert_eq!(attribute(&text, "viewBox"), "0 0 320 330");
    let corners = corners(&text);
    assert_eq!(corners[0], [10.0, 310.0], "y points down in an SVG");
    assert_eq!((corners[1][0] - corners[0][0], corners[1][1] - corners[2][1]), (300.0, 300.0));
    assert!(text.contains("<title>a &lt;square&gt;</title>"));
}

#[test]
fn pages_show_everything_and_neighbours_share_a_strip() {
    let sheet = square();
    let pages = pages(&sheet, PAPERS[0].1);
    assert_eq!(pages.iter().map(|p| p.0).collect::<Vec<_>>(), [[1, 1], [1, 2], [2, 1], [2, 2]]);
    let window = |i: usize| -> Vec<f64> {
        let inner = pages[i].1.split("<rect").nth(1).unwrap();
        ["x", "y", "width", "height"].map(|name| attribute(inner, name).parse().unwrap()).to_vec()
    };
    assert_eq!(window(0)[0] + window(0)[2] - window(1)[0], 10.0);
    assert_eq!(window(0)[1] + window(0)[3] - window(2)[1], 10.0);
    assert!(window(3)[0] + window(3)[2] >= 320.0 && window(3)[1] + window(3)[3] >= 330.0);
    let small = PatternSheet { size: [190.0, 277.0], ..square() };
    assert_eq!(super::pages(&small, PAPERS[0].1).len(), 1, "what fits is one page");
}

#[test]
fn a_dxf_is_read_back_by_a_library_with_its_lengths() {
    let text = dxf(&square());
    let drawing = ::dxf::Drawing::load(&mut text.as_bytes()).unwrap();
    assert_eq!(drawing.header.default_drawing_units, ::dxf::enums::Units::Millimeters);
    assert_eq!(drawing.header.drawing_units, ::dxf::enums::DrawingUnits::Metric);
    let all: Vec<_> = drawing.entities().collect();
    let ::dxf::entities::EntityType::Polyline(line) = &all[0].specific else { panic!("{:?}", all[0].specific) };
    let at: Vec<[f64; 2]> = line.vertices().map(|v| [v.location.x, v.location.y]).collect();
    assert_eq!(at, square().lines[0].points);
    assert!(line.is_closed() && all[0].common.layer == "CUT");
    let ::dxf::entities::EntityType::Text(word) = &all[1].specific else { panic!("{:?}", all[1].specific) };
    assert_eq!(word.value, "300 mm x 300 mm");
}
