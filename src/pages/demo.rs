//! The page of the demonstration: five panels, and the commands that show the rest.

use super::diagnosis::{Diagnosed, draw};
use super::engines::overview;
use super::{Maker, PAPER, Result, Values, residual_figure};
use crate::prelude::*;
use crate::shown::demo as shown;
use ::compare::demo::{Demo, Mechanism, ROBOT};
use ::compare::progress::shares::PICTURES as SHARES;
use ::compare::progress::{Progress, part};
use report::{bars, lines};

const PICTURES: [&str; 1] = ["missing_moment"];
const ROBOT_PNG: &[u8] = include_bytes!("../../docs/robots/epam.png");
/// Labels of its parts: text, where it is written, where its line ends.
const LABELS: [(&str, [u32; 2], [u32; 2]); 4] = [
    ("body, 2 kPa", [330, 560], [330, 440]),
    ("pouch, 30 kPa", [250, 205], [330, 258]),
    ("base, clamped", [30, 250], [86, 420]),
    ("tip", [790, 180], [742, 80]),
];

/// The pictures of the five panels.
pub fn demo_plots(demo: &Demo, progress: &mut Progress) -> Result<Files> {
    let mut files = Files::default();
    files.plot("robot", Drawn { svg: report::labelled(ROBOT_PNG, [960, 600], &LABELS), png: ROBOT_PNG.to_vec() });
    let map = &demo.compared.variants[0].evaluation.residual_map;
    files.plot("residuals", residual_figure::map("Textbook model: where it misses", map, &demo.compared.dataset)?);
    progress("plots of both engines", Some(0.0));
    files.plot("breaking", lines(&breaking(demo))?);
    draw(
        &Diagnosed::of(&demo.diagnosis, &demo.robot, &demo.data, ROBOT),
        "",
        &PICTURES,
        &mut files,
        &mut part(progress, SHARES),
    )?;
    files.plot("waterfall", waterfall(demo)?);
    Ok(files)
}

pub(crate) fn demo_page(demo: &Demo, maker: &Maker, progress: &mut Progress) -> Result<Files> {
    let mut files = demo_plots(demo, progress)?;
    let overview = overview(&demo.engines, &mut files)?;
    let values = Values::new()
        .with("title", "Where a model of a vine robot fails, and what it lacks")
        .with("panels", shown::panels(demo))
        .with("typed", ROBOT)
        .with("summary", &demo.diagnosis.summary)
        .with("map_colours", residual_figure::MAP_COLOURS)
        .with("provenance", [["published numbers", PAPER], ["markers", MARKERS], ["machine", &maker.machine]])
        .and(overview);
    files.page("demo.html", values, maker)?;
    Ok(files)
}

const MARKERS: &str = "finite elements of this program with camera noise; no measurement";

/// Errors of the model with one more mechanism in every group.
fn waterfall(demo: &Demo) -> Result<Drawn> {
    let name =
        |m: &Mechanism| if m.effect.is_empty() { "textbook".into() } else { super::effect(&format!("+ {}", m.effect)) };
    let series =
        |words: &str, of: fn(&Mechanism) -> f64| (words.to_string(), demo.steps.iter().map(of).collect(), false);
    let series = [series("data that chose", |m| m.error_mm), series("left-out data", |m| m.left_out_mm)];
    let groups: Vec<String> = demo.steps.iter().map(name).collect();
    Ok(bars("Mechanism by mechanism", "root mean square error [mm]", &groups, &series, None)?)
}

/// Outermost marker over pressure: the reduced model as a line, finite elements as points with their spread, open where the two are
/// more than 15 % apart.
fn breaking(demo: &Demo) -> Lines {
    let mut series = Vec::new();
    for (colour, robot) in shown::breaking(demo).iter().enumerate() {
        let at: Vec<_> = [10.0, 20.0, 30.0].into_iter().filter_map(|kpa| Some((kpa, robot.marker_mm(kpa)?))).collect();
        let reduced = at.iter().map(|(kpa, [reduced, ..])| [*kpa, *reduced]);
        let reduced = std::iter::once([0.0, 0.0]).chain(reduced).collect();
        series.push(LineSeries::new(robot.robot, LineStyle::Line, reduced).coloured(colour));
        for (is_broken, style) in [(false, LineStyle::Points), (true, LineStyle::OpenPoints)] {
            let own = || at.iter().filter(|(kpa, _)| robot.is_broken(*kpa) == is_broken);
            let points: Vec<[f64; 2]> = own().map(|(kpa, [_, fe, _])| [*kpa, *fe]).collect();
            if !points.is_empty() {
                let errors = own().map(|(_, [.., sd])| *sd).collect();
                series.push(LineSeries::new("", style, points).coloured(colour).with_errors(errors));
            }
        }
    }
    let title = "Lines: reduced model; points: finite elements";
    Lines::new(title, "actuator pressure [kPa]", "outermost marker [mm]", series)
}
