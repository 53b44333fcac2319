use super::Result;
use super::figures::{LINE_POINTS, mm};
use crate::prelude::*;
use ::sweep::design::{Design, Wish};

/// The shape of a design, with the target places and, where known, the places by finite elements (tip last) \[m\].
pub(crate) fn design_files(wish: &Wish, found: &Design, elements_m: Option<&[[f64; 2]]>) -> Result<Files> {
    let model = Model::new(&found.file.scenario);
    let radius = 1e3 * found.file.radius_m;
    let rest = [[0.0, 0.0], [1e3 * found.file.length_m, 0.0]];
    let [above, below] = model.outline(&found.pose, LINE_POINTS).map(|side| mm(&side));
    let line = mm(&model.centre_line(&found.pose, LINE_POINTS));
    let end = line.last().copied().unwrap_or_default();
    let [wished, predicted, other] = [Ink::Ink, Ink::Series(0), Ink::Series(2)];
    let point = |at: [f64; 2], ink, symbol, open| Mark::Point(Point { at, ink, symbol, open, ..Point::default() });
    let mut marks = vec![
        Mark::Band(above.iter().chain(below.iter().rev()).copied().collect()),
        Mark::Dashed(rest.to_vec(), Ink::Muted),
        Mark::Line(vec![[0.0, -1.15 * radius], [0.0, 1.15 * radius]], Ink::Muted),
        Mark::Line(line, predicted),
    ];
    let mut keys = vec![
        LegendEntry::new(KeyLook::Line, predicted, "model, predicted"),
        LegendEntry::new(KeyLook::Dashed, Ink::Muted, "at rest"),
    ];
    if let Some(places) = elements_m {
        let stations = mm(places);
        marks.extend(stations.iter().map(|at| point(*at, other, Symbol::Triangle, false)));
        keys.push(LegendEntry::new(KeyLook::Symbol(Symbol::Triangle, false), other, "finite elements, predicted"));
    }
    let places: Vec<[f64; 2]> =
        wish.wanted.tip_m.into_iter().chain(wish.wanted.places.iter().map(|p| p.at_m)).collect();
    if !places.is_empty() {
        marks.extend(mm(&places).into_iter().map(|at| point(at, wished, Symbol::Diamond, true)));
        keys.push(LegendEntry::new(KeyLook::Symbol(Symbol::Diamond, true), wished, "wished for"));
    }
    marks.push(Mark::Tip(end, format!("{} kPa", pressure_words(&found.loads)), predicted));
    let mut chart = Chart::new(&found.file.scenario.name, "x along the robot at rest [mm]", "y sideways [mm]");
    let mut files = Files::default();
    (chart.space, chart.marks, chart.keys) = (Space::Equal, marks, keys);
    files.plot("shape", chart.draw("design")?);
    Ok(files)
}
