//! Both engines and the published numbers on one page: displacement, accuracy, ledgers, and where the models part.

use super::engine_figures::{bars, curve, ledger, parting_plot};
use super::{Files, Imprint};
use crate::error::CompareError;
use crate::plots::{Drawn, Known};
use crate::report::{Align, Block, Callout, Column, Provenance, Report, Section, Table};
use crate::study::engines::{FeRun, Pair, accuracy, as_it_is, pairs, stored_robot};
use crate::study::published::{Rung, model_ladder, shipped_scenario};
use data::{PublishedActuator, published};
use models::{Loads, Model, Scenario};

/// One robot with both engines.
#[derive(Debug, Clone)]
pub struct EngineRobot {
    /// The robot.
    pub scenario: Scenario,
    /// What is printed about it; `None` for a robot that is not one of the paper's.
    pub published: Option<PublishedActuator>,
    /// The reduced model with effects of which none is fitted.
    pub with_effects: Option<Rung>,
    /// Its finite element run, if there is one.
    pub run: Option<FeRun>,
    /// Both at the run's pressures.
    pub pairs: Vec<Pair>,
}

/// Where the models part, for one robot and one quantity.
#[derive(Debug, Clone)]
pub struct PartingMap {
    /// Actuator kind.
    pub actuator: String,
    /// Head of the rows, with unit.
    pub row_label: String,
    /// Value of every row and its pairs.
    pub rows: Vec<(String, Vec<Pair>)>,
    /// Element size of the runs \[mm\].
    pub mesh_mm: f64,
}

/// Everything the page shows.
#[derive(Debug, Clone)]
pub struct Engines {
    /// Robots.
    pub robots: Vec<EngineRobot>,
    /// Maps of those that have runs for them.
    pub maps: Vec<PartingMap>,
}

/// One line of the comparison.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct EngineLine {
    /// Robot.
    pub robot: String,
    /// Actuator pressure \[kPa\].
    pub actuator_kpa: f64,
    /// Who says so.
    pub source: String,
    /// How it is known.
    pub known: String,
    /// Outermost marker \[mm\].
    pub marker_mm: Option<f64>,
    /// Tip \[mm\].
    pub tip_mm: Option<f64>,
    /// The paper's accuracy: as printed, or of the marker and of the tip against the measured displacement.
    pub accuracy: [Option<f64>; 2],
}

/// Puts robots and runs together.
///
/// # Errors
/// A damaged embedded set or a model without equilibrium.
pub fn engines(scenarios: &[Scenario], runs: &[FeRun]) -> Result<Engines, CompareError> {
    let robots = scenarios.iter().map(|s| robot(s, runs)).collect::<Result<_, _>>()?;
    let mut maps = Vec::new();
    for scenario in scenarios {
        maps.extend(parting_maps(scenario, runs)?);
    }
    Ok(Engines { robots, maps })
}

fn robot(scenario: &Scenario, runs: &[FeRun]) -> Result<EngineRobot, CompareError> {
    let kind = scenario.actuator.kind.name;
    let shipped = shipped_scenario(kind).ok().is_some_and(|s| s == *scenario);
    let (mut printed, mut with_effects) = (None, None);
    if shipped {
        printed = published()?.actuator(kind).cloned();
        with_effects = model_ladder(kind)?.pop();
    }
    let run = stored_robot(runs, scenario).cloned();
    let pairs = run.as_ref().map_or(Ok(Vec::new()), |run| pairs(scenario, run))?;
    Ok(EngineRobot { scenario: scenario.clone(), published: printed, with_effects, run, pairs })
}

/// Lines of one robot at its pressures, or at those printed.
///
/// # Errors
/// A model without equilibrium.
pub fn lines(robot: &EngineRobot) -> Result<Vec<EngineLine>, CompareError> {
    let mut out = Vec::new();
    let mut pressures: Vec<f64> = robot.pairs.iter().map(|p| p.actuator_kpa).collect();
    if let (true, Some(printed)) = (pressures.is_empty(), &robot.published) {
        pressures = printed.accuracy.iter().map(|a| a.0 * 1e-3).collect();
    }
    for kpa in pressures {
        at_pressure(robot, kpa, &mut out)?;
    }
    Ok(out)
}

fn at_pressure(robot: &EngineRobot, kpa: f64, out: &mut Vec<EngineLine>) -> Result<(), CompareError> {
    let near = |other_pa: f64| (other_pa * 1e-3 - kpa).abs() < 0.05;
    let name = robot.published.as_ref().map_or(&robot.scenario.name, |p| &p.printed_name).clone();
    let line = |source: &str, known: &str, heights: [Option<f64>; 2], accuracy: [Option<f64>; 2]| EngineLine {
        robot: name.clone(),
        actuator_kpa: kpa,
        source: source.into(),
        known: known.into(),
        marker_mm: heights[0],
        tip_mm: heights[1],
        accuracy,
    };
    let printed = robot.published.as_ref();
    let measured_mm = printed.filter(|p| near(p.d_max_pressure_pa)).map(|p| p.d_max_m * 1e3);
    if let Some(mm) = measured_mm {
        out.push(line("measurement", "measured, published", [Some(mm), None], [None, None]));
    }
    if let Some((_, a)) = printed.and_then(|p| p.accuracy.iter().find(|a| near(a.0))) {
        out.push(line("the paper's finite elements", "published", [None, None], [Some(*a), None]));
    }
    let judged = |mm: [f64; 2]| mm.map(|model| measured_mm.and_then(|measured| accuracy(model, measured)));
    let mut model = |source: &str, known: &str, mm: [f64; 2]| {
        out.push(line(source, known, mm.map(Some), judged(mm)));
    };
    let loads = Loads::uniform(robot.scenario.p_body_pa, kpa * 1e3);
    let own = if robot.published.is_some() { "reduced, as shipped" } else { "reduced, as in the scenario" };
    model(own, Known::Predicted.word(), heights(&robot.scenario, &loads)?);
    if let Some(rung) = &robot.with_effects {
        model("reduced, with effects", Known::Assumed.word(), heights(&rung.scenario, &loads)?);
    }
    if let Some(pair) = robot.pairs.iter().find(|p| (p.actuator_kpa - kpa).abs() < 0.05) {
        let mesh = robot.run.as_ref().map_or(f64::NAN, |r| r.mesh_mm[1]);
        let known = robot.run.as_ref().map_or("", |r| &r.known);
        model(&format!("finite elements, {mesh} mm"), known, pair.fe_mm);
    }
    Ok(())
}

fn heights(scenario: &Scenario, loads: &Loads) -> Result<[f64; 2], CompareError> {
    let model = Model::new(scenario);
    let mut at = model.prediction();
    model.predict(loads, &mut at)?;
    Ok([at.markers.last().map_or(at.tip.y_m, |xy| xy[1]) * 1e3, at.tip.y_m * 1e3])
}

/// Maps over body pressure and over pouch length, from runs on one mesh: the coarsest.
fn parting_maps(scenario: &Scenario, runs: &[FeRun]) -> Result<Vec<PartingMap>, CompareError> {
    let mine = |r: &&FeRun| r.scenario == scenario.name && r.actuator == scenario.actuator.kind.name;
    let coarsest = runs.iter().filter(mine).map(|r| r.mesh_mm[1]).fold(0.0, f64::max);
    let of_mesh: Vec<&FeRun> = runs.iter().filter(mine).filter(|r| r.mesh_mm[1] == coarsest).collect();
    let own_pouch = |r: &&&FeRun| (r.pouch_mm * 1e-3 - scenario.actuator.shape.length_m).abs() < 1e-6;
    let own_body = |r: &&&FeRun| (r.body_kpa * 1e3 - scenario.p_body_pa).abs() < 1e-3;
    let body: Vec<&FeRun> = of_mesh.iter().filter(own_pouch).copied().collect();
    let pouch: Vec<&FeRun> = of_mesh.iter().filter(own_body).copied().collect();
    let mut maps = Vec::new();
    for (row_label, mut runs, value) in [
        ("rows: body pressure [kPa]", body, (|r: &FeRun| r.body_kpa) as fn(&FeRun) -> f64),
        ("rows: length of a pouch [mm]", pouch, |r: &FeRun| r.pouch_mm),
    ] {
        runs.sort_by(|a, b| value(b).total_cmp(&value(a)));
        if runs.len() < 2 {
            continue;
        }
        let rows = runs.iter().map(|r| Ok((format!("{}", value(r)), pairs(&varied(scenario, r), r)?)));
        let rows = rows.collect::<Result<Vec<_>, CompareError>>()?;
        let actuator = scenario.actuator.kind.name.to_string();
        maps.push(PartingMap { actuator, row_label: row_label.into(), rows, mesh_mm: coarsest });
    }
    Ok(maps)
}

/// The scenario at a run's body pressure and pouch length.
pub fn varied(scenario: &Scenario, run: &FeRun) -> Scenario {
    let mut changed = scenario.clone();
    if !as_it_is(run, scenario) {
        changed.p_body_pa = run.body_kpa * 1e3;
        changed.actuator.shape.length_m = run.pouch_mm * 1e-3;
        changed.actuator.count = run.count;
    }
    changed
}

/// The page with the plots and tables beside it.
///
/// # Errors
/// What cannot be drawn.
pub fn engines_page(engines: &Engines, imprint: &Imprint) -> Result<Files, CompareError> {
    let mut files = Files::default();
    let sections = engine_sections(engines, &mut files)?;
    let line = |name: &str, value: String| Provenance { name: name.into(), value };
    let mut provenance = vec![line(
        "published numbers",
        "du Pasquier, Jeong, Okamura, IEEE RA-L 2023, doi 10.1109/LRA.2023.3320010".into(),
    )];
    for run in engines.robots.iter().filter_map(|r| r.run.as_ref()) {
        let what = format!(
            "{} mm elements, {} of them, {} steps, {:.0} CPU s, engine {}",
            run.mesh_mm[1], run.elements, run.steps, run.cpu_s, run.engine
        );
        provenance.push(line(&format!("run of {}", run.actuator), what));
    }
    provenance.push(line("machine", imprint.machine.clone()));
    let report = Report {
        title: "Two engines against the published displacements".into(),
        lead: lead(engines)?,
        generated_by: imprint.program.clone(),
        generated_on: imprint.date.clone(),
        sections,
        provenance,
    };
    files.report(&report)?;
    Ok(files)
}

fn lead(engines: &Engines) -> Result<String, CompareError> {
    let mut words = Vec::new();
    for robot in &engines.robots {
        let (Some(printed), Some(last)) = (&robot.published, robot.pairs.last()) else { continue };
        let (measured, [_, fe], [bare, _]) = (printed.d_max_m * 1e3, last.fe_mm, last.reduced_mm);
        let share = 100.0 * (fe - measured) / measured;
        let name = &printed.printed_name;
        words.push(format!(
            "{name} {fe:.1} mm ({share:+.0} %; reduced model as shipped {bare:.1} mm, measured {measured:.1} mm)"
        ));
    }
    Ok(match words.is_empty() {
        true => "There is no finite element run of these robots yet.".into(),
        false => format!("Tip at 30 kPa by finite elements: {}.", words.join("; ")),
    })
}

/// Sections of the page, for other pages too.
///
/// # Errors
/// What cannot be drawn.
pub fn engine_sections(engines: &Engines, files: &mut Files) -> Result<Vec<Section>, CompareError> {
    let mut all = Vec::new();
    for robot in &engines.robots {
        all.extend(lines(robot)?);
    }
    files.text("engines.csv", csv(&all));
    let mut first = vec![table(&all)];
    if let Some(bars) = bars(engines)? {
        files.plot("engines", &bars);
        first.insert(0, figure("Outermost marker of the reduced models, tip of the finite elements.", "bars", &bars));
    }
    first.push(Block::Callout { kind: Callout::Warning, text: NOTE.into() });
    let mut sections = vec![section("engines", "Both engines and the published numbers", first)];
    let mut ledgers = Vec::new();
    for robot in engines.robots.iter().filter(|r| !r.pairs.is_empty()) {
        let kind = robot.scenario.actuator.kind.name;
        let curve = curve(robot)?;
        files.plot(&format!("{kind}_engines"), &curve);
        ledgers.push(figure("Tip over actuator pressure.", "tip over pressure", &curve));
        let drawn = ledger(robot)?;
        files.plot(&format!("{kind}_engines_ledger"), &drawn);
        ledgers.push(figure(LEDGER, "stacked energies", &drawn));
    }
    if !ledgers.is_empty() {
        sections.push(section("engine-ledgers", "Ledgers side by side", ledgers));
    }
    let mut maps = vec![Block::Paragraph(MAPS.into())];
    for (k, map) in engines.maps.iter().enumerate() {
        let drawn = parting_plot(map)?;
        files.plot(&format!("breakdown_{}_{k}", map.actuator), &drawn);
        let caption = format!("Elements of {} mm: coarse, for the map.", map.mesh_mm);
        maps.push(figure(&caption, "map of differences", &drawn));
    }
    if maps.len() > 1 {
        sections.push(section("breakdown", "Where the reduced model breaks down", maps));
    }
    Ok(sections)
}

const NOTE: &str = "Not printed by the paper and assumed here: pouch count, marker stations, weld width, stiffness of tape and \
    glue, how far plies bend as one, biaxial coupling, densities. The measured displacement is that of a marker nobody gave \
    the place of; it is held against the outermost assumed marker and against the tip. One number per robot validates nothing.";
const LEDGER: &str = "Reduced model and finite elements, each at its own bend. Gas is −P ΔV since the body was full; stretch and \
    wall bending of the finite elements likewise. What the finite elements lost in buckling, damping and friction is not stored \
    and not shown.";
const MAPS: &str = "Cells: how much more the reduced model bends, as shipped, than the finite elements. Beyond 10 % the cell is \
    coloured and names the term in which the finite elements hold more energy at the same bend (or less, where they bend more): \
    pouch gas (the pouches give less work), body folds (the body's gas is squeezed more), wall bending, stretch, contact, or \
    hourglass control, which is numerical.";

fn section(id: &str, heading: &str, blocks: Vec<Block>) -> Section {
    Section { id: id.into(), heading: heading.into(), blocks }
}

fn figure(caption: &str, alt: &str, drawn: &Drawn) -> Block {
    Block::Figure { caption: caption.into(), alt: alt.into(), svg: drawn.svg.clone() }
}

/// Cells of a line: robot, pressure, source, how known, marker, tip, accuracies.
pub fn cells(line: &EngineLine) -> Vec<String> {
    let mm = |v: Option<f64>| v.map_or("–".into(), |v| format!("{v:.1}"));
    let percent = |v: Option<f64>| v.map_or("–".into(), |v| format!("{:.1}", 100.0 * v));
    vec![
        line.robot.clone(),
        format!("{:.0}", line.actuator_kpa),
        line.source.clone(),
        line.known.clone(),
        mm(line.marker_mm),
        mm(line.tip_mm),
        percent(line.accuracy[0]),
        percent(line.accuracy[1]),
    ]
}

/// Heads of these cells.
pub const HEADS: [&str; 8] =
    ["robot", "kPa", "source", "how known", "marker mm", "tip mm", "accuracy %, marker", "accuracy %, tip"];

fn table(lines: &[EngineLine]) -> Block {
    let column = |(k, heading): (usize, &&str)| Column {
        heading: heading.to_string(),
        unit: String::new(),
        align: if matches!(k, 0 | 2 | 3) { Align::Left } else { Align::Right },
    };
    Block::Table(Table {
        caption: "Accuracy a = 1 − ((y_model − y_measured)/y_model)², the paper's formula for one marker".into(),
        columns: HEADS.iter().enumerate().map(column).collect(),
        rows: lines.iter().map(cells).collect(),
        how_column: Some(3),
    })
}

fn csv(lines: &[EngineLine]) -> String {
    let mut out = String::from("robot,p_act_kpa,source,how_known,marker_mm,tip_mm,accuracy_marker,accuracy_tip\n");
    let cell = |v: Option<f64>| v.map_or(String::new(), |v| v.to_string());
    for l in lines {
        let numbers = [l.marker_mm, l.tip_mm, l.accuracy[0], l.accuracy[1]].map(cell).join(",");
        let text = [&l.robot, &l.source, &l.known].map(|t| t.replace(',', ";"));
        out.push_str(&format!("{},{},{},{},{numbers}\n", text[0], l.actuator_kpa, text[1], text[2]));
    }
    out
}
