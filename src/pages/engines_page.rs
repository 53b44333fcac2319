//! Both engines and the published numbers on one page: displacement, accuracy, ledgers, and where the models part.

use super::PageError;
use super::engine_figures::{bars, curve, displaced, ledger, parting_plot};
use super::{Files, Imprint};
use compare::study::engines::{EngineRobot, Engines};
use compare::study::engines::{HEADS, SUMMARY, VOLUMES, VOLUMES_CAPTION, cells, csv, lines, summary, volume_cells};
use compare::study::uncertain::Uncertain;
use report::Drawn;
use report::page::{Align, Block, Callout, Column, Provenance, Report, Section, Table};

/// The page with the plots and tables beside it.
///
/// # Errors
/// What cannot be drawn.
pub fn engines_page(engines: &Engines, imprint: &Imprint) -> Result<Files, PageError> {
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

fn lead(engines: &Engines) -> Result<String, PageError> {
    let mut words = Vec::new();
    for robot in &engines.robots {
        let (Some(printed), Some(last)) = (&robot.published, robot.pairs.last()) else { continue };
        let Some([(fe, _), _]) = robot.ensemble.at(printed.d_max_pressure_pa * 1e-3) else { continue };
        let (measured, [bare, _]) = (printed.d_max_m * 1e3, last.reduced_mm);
        let share = 100.0 * (fe - measured) / measured;
        let name = &printed.printed_name;
        words.push(format!(
            "{name} {fe:.1} mm ({share:+.0} %; reduced model as shipped {bare:.1} mm, measured {measured:.1} mm)"
        ));
    }
    Ok(match words.is_empty() {
        true => "There is no finite element run of these robots yet.".into(),
        false => format!("Outermost marker at 30 kPa by finite elements: {}.", words.join("; ")),
    })
}

/// Sections of the page, for other pages too.
///
/// # Errors
/// What cannot be drawn.
pub fn engine_sections(engines: &Engines, files: &mut Files) -> Result<Vec<Section>, PageError> {
    let mut all = Vec::new();
    for robot in &engines.robots {
        all.extend(lines(robot)?);
    }
    files.text("engines.csv", csv(&all));
    let (mut rows, mut intervals) = (Vec::new(), Vec::new());
    for robot in &engines.robots {
        rows.extend(summary(robot)?);
        for cube in &robot.uncertain {
            intervals.extend(cube_figures(robot, cube, files)?);
        }
    }
    let mut first = Vec::new();
    if !rows.is_empty() {
        first.push(rows_of(SUMMARY_CAPTION, &SUMMARY, &[0, 1, 6], None, rows));
    }
    first.push(rows_of(LINES_CAPTION, &HEADS, &[0, 2, 3], Some(3), all.iter().map(cells).collect()));
    if let Some(bars) = bars(engines)? {
        files.plot("engines", &bars);
        first.insert(
            0,
            figure(
                "Outermost marker, 330 mm from the base; of the finite elements the middle of the section there.",
                "bars",
                &bars,
            ),
        );
    }
    first.push(Block::Callout { kind: Callout::Warning, text: NOTE.into() });
    let mut sections = vec![section("engines", "Both engines and the published numbers", first)];
    if !intervals.is_empty() {
        sections.push(section("intervals", "What nobody measured", intervals));
    }
    let mut ledgers = Vec::new();
    for robot in engines.robots.iter().filter(|r| !r.pairs.is_empty()) {
        let kind = robot.scenario.actuator.kind.name;
        let curve = curve(robot)?;
        files.plot(&format!("{kind}_engines"), &curve);
        ledgers.push(figure(
            "Outermost marker over actuator pressure; of the finite elements the middle of the section there.",
            "marker over pressure",
            &curve,
        ));
        let drawn = ledger(robot)?;
        files.plot(&format!("{kind}_engines_ledger"), &drawn);
        ledgers.push(figure(LEDGER, "stacked energies", &drawn));
    }
    if !ledgers.is_empty() {
        sections.push(section("engine-ledgers", "Ledgers side by side", ledgers));
    }
    sections.extend(volume_section(&engines.robots, files)?);
    let mut maps = vec![Block::Paragraph(MAPS.into())];
    for (k, map) in engines.maps.iter().enumerate() {
        let drawn = parting_plot(map)?;
        files.plot(&format!("breakdown_{}_{k}", map.actuator), &drawn);
        let caption = format!("Elements of {} mm at the actuator.", map.mesh_mm);
        maps.push(figure(&caption, "map of differences", &drawn));
    }
    if maps.len() > 1 {
        sections.push(section("breakdown", "Where the reduced model breaks down", maps));
    }
    Ok(sections)
}

/// Heights of all markers with their intervals, and what to measure first.
fn cube_figures(robot: &EngineRobot, cube: &Uncertain, files: &mut Files) -> Result<Vec<Block>, PageError> {
    let last = cube.stations_mm.last().copied().unwrap_or(f64::NAN);
    let own = robot.published.iter().map(|p| (p.d_max_pressure_pa * 1e-3, [last, p.d_max_m * 1e3]));
    let words: String = cube.variant.chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '-' }).collect();
    let name = [cube.actuator.as_str(), &words].iter().filter(|w| !w.is_empty()).copied().collect::<Vec<_>>().join("-");
    let markers = super::marker_intervals(cube, &own.collect::<Vec<_>>()).map_err(PageError::from)?;
    files.plot(&format!("{name}_uncertain"), &markers);
    let top = cube.pressures_kpa().into_iter().fold(0.0, f64::max);
    let weights = super::what_to_measure(cube, top).map_err(PageError::from)?;
    files.plot(&format!("{name}_tornado"), &weights);
    let caption = format!("{} robots whose assumed numbers fill their intervals. {}", cube.members.len(), cube.variant);
    Ok(vec![figure(caption.trim(), "markers with intervals", &markers), figure(WEIGHTS, "bars", &weights)])
}

fn volume_section(robots: &[EngineRobot], files: &mut Files) -> Result<Option<Section>, PageError> {
    let mut blocks = Vec::new();
    if let Some(drawn) = displaced(robots)? {
        files.plot("volumes", &drawn);
        blocks.push(figure(DISPLACED, "displaced volume over pressure", &drawn));
    }
    let rows = volume_cells(robots);
    if !rows.is_empty() {
        blocks.push(rows_of(VOLUMES_CAPTION, &VOLUMES, &[0], None, rows));
    }
    Ok((!blocks.is_empty()).then(|| section("volumes", "What the bodies lose", blocks)))
}

const NOTE: &str = "Not printed by the paper and assumed here: pouch count, marker stations, weld width, where the tape is, \
    stiffness of tape and glue, how far plies bend as one, biaxial coupling, densities. The measured displacement is that of a marker nobody gave \
    the place of; it is held against the outermost assumed marker. Nothing is calibrated on \
    these displacements. What nobody measured is an interval: the finite elements' median and 80 % interval are those of a Latin hypercube \
    over all of these numbers. One number per robot validates nothing.";
const SUMMARY_CAPTION: &str = "Displacement of the outermost marker at the pressure of the measurement; finite elements: middle of the \
    section at the marker (a diagnosis takes the point of the wall that a camera sees), median and 80 % interval over all numbers that nobody \
    measured, and the robot as recommended, mean ± standard deviation over seeds";
const LINES_CAPTION: &str = "All pressures printed by the paper. Finite elements: middle of the section at the outermost marker. Accuracy a = 1 − ((y_model − y_measured)/y_model)², the paper's formula for one marker";
const WEIGHTS: &str = "What each number does to the outermost marker between a tenth and nine tenths of its interval, by a straight law \
    through all of these robots: the longest bar is what to measure first.";
const LEDGER: &str = "Reduced model and finite elements, each at its own bend. Gas is −P ΔV since the body was full; stretch and \
    wall bending of the finite elements likewise. A muscle lies flat then in the finite elements and is round from the start in the \
    reduced model: the volume by which it is ahead at the first pressure is left out of its gas at every pressure, so that both begin \
    alike there; what filling it pushed out of the body stays in the body's folds. What the finite elements lost in buckling, damping and friction is not stored and not shown.";
const DISPLACED: &str = "What the body lost since it was full, less the πR³ × turn that the reduced model knows of, over what the \
    actuator gained. Symbols: the robot's own body pressure, mean and standard deviation of the seeds; dashed below it, solid \
    above, one seed each where no more were run. Read off the finite elements; it predicts nothing. The share of the ideal lens \
    in the table is the actuator's volume over that of lenses that contracted as much on the arm at rest.";
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

fn rows_of(caption: &str, heads: &[&str], left: &[usize], how: Option<usize>, rows: Vec<Vec<String>>) -> Block {
    let column = |(k, heading): (usize, &&str)| Column {
        heading: heading.to_string(),
        unit: String::new(),
        align: if left.contains(&k) { Align::Left } else { Align::Right },
    };
    let columns = heads.iter().enumerate().map(column).collect();
    Block::Table(Table { caption: caption.into(), columns, rows, how_column: how })
}
