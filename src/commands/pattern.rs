use super::inputs::quantity;
use crate::cli::PatternArgs;
use crate::prelude::*;
use ibr::pages::pattern_sheet;
use models::cutting::{CuttingPlan, Making, PatternPiece};
use report::sheet::{PAPERS, PatternSheet, dxf, pages, svg};

/// Width of welds where neither the scenario nor the user gives one, as in [`fem::robot::RobotSettings`] \[m\].
const WELD_M: f64 = 0.003;

/// Default fabric beyond welds and ends of a pattern, as in the command \[m\].
const ALLOWANCE: (f64, &str) = (0.01, "10 mm");

/// More fabric than that around a piece is a slip of the unit \[m\].
const MOST_ALLOWANCE_M: f64 = 0.5;
/// A cutter that removes more is a slip of the unit \[m\].
const MOST_KERF_M: f64 = 0.005;

pub(super) fn run(args: &PatternArgs, context: &mut Context) -> Result<Outcome> {
    let file = ibr::studies::scenario(&args.scenario)?.planar()?;
    let weld = match &args.weld {
        Some(text) => (quantity("--weld", text, Quantity::Length)?, "as given".into()),
        None => usual_weld(&file.scenario),
    };
    let allowance_m = quantity("--allowance", &args.allowance, Quantity::Length)?;
    let message = format!("--allowance {} is not from 0 to {} mm", args.allowance, 1e3 * MOST_ALLOWANCE_M);
    let help = "write for example --allowance 10mm";
    refuse_if(!(0.0..=MOST_ALLOWANCE_M).contains(&allowance_m), message, help)?;
    let kerf_m = quantity("--kerf", &args.kerf, Quantity::Length)?;
    let message = format!("--kerf {} is not from 0 to {} mm", args.kerf, 1e3 * MOST_KERF_M);
    let help = "write for example --kerf 0.2mm";
    refuse_if(!(0.0..=MOST_KERF_M).contains(&kerf_m), message, help)?;
    let weld_mm = 1e3 * weld.0;
    let (plan, notes, sheet) = laid_out(&file.scenario, weld, (allowance_m, &args.allowance), kerf_m)
        .map_err(|fault| Failure::usage(format!("{}: {fault}", args.scenario), "see docs/scenario.md"))?;
    let files = files(args, &sheet)?;
    write_texts(&files, context)?;
    let written: Vec<String> = files.iter().map(|(path, _)| path.display().to_string()).collect();
    let text = format!("{}{}\n1:1, written: {}\n", pieces(&plan), lines("", &notes), written.join(", "));
    let (scenario, pieces) = (&args.scenario, &plan.pieces);
    let answer = PatternAnswer { scenario, weld_mm, allowance_mm: 1e3 * allowance_m, pieces, notes, written };
    Ok(Outcome::answer(text, "ibr.pattern", &answer))
}

/// `ibr.pattern`: `ibr pattern SCENARIO`
#[derive(Serialize)]
struct PatternAnswer<'a> {
    /// Path or name of the scenario as typed
    scenario: &'a str,
    /// Width of the welds between pieces
    weld_mm: f64,
    /// Width of the fabric beyond welds and ends
    allowance_mm: f64,
    /// Pieces to cut, with the marks on each
    pieces: &'a [PatternPiece],
    /// What the plan leaves to its reader
    notes: Vec<String>,
    /// Files of drawings that were written
    written: Vec<String>,
}

fn pieces(plan: &CuttingPlan) -> String {
    let size = |[a, b]: [f64; 2]| 1e3 * (b - a);
    TextTable::of(&plan.pieces)
        .words("piece", |p| &p.name)
        .right("copies", |p| p.copies.to_string())
        .right("fabric", |p| p.fabric)
        .number("warp [deg]", 0, |p| p.warp_rad.to_degrees())
        .number("along [mm]", 1, |p| size(p.x_m))
        .number("across [mm]", 1, |p| size(p.y_m))
        .text()
}

/// The width of the welds of a scenario \[m\], and how it is known.
fn usual_weld(scenario: &Scenario) -> (f64, String) {
    let effect = scenario.effects.iter().find(|e| e.name == "weld_width");
    effect.map_or((WELD_M, "assumed".into()), |e| (e.values[0], format!("the scenario's weld_width, {}", e.basis)))
}

/// Pieces, notes and drawing of a robot; `Err` gives the reason without them.
fn laid_out(
    scenario: &Scenario,
    (weld_m, how): (f64, String),
    (allowance_m, allowance): (f64, &str),
    kerf_m: f64,
) -> Result<(CuttingPlan, Vec<String>, PatternSheet), String> {
    let plan = CuttingPlan::new(scenario, &Making { weld_m, allowance_m })?;
    let welds = format!("Welds {:.1} mm wide ({how}), allowance {allowance} beyond.", 1e3 * weld_m);
    let kerf =
        format!("Kerf {:.2} mm: cut lines are half of it outside the edges, so the cutter adds none.", 1e3 * kerf_m);
    let kerf = Some(kerf).filter(|_| kerf_m > 0.0);
    let notes = std::iter::once(welds).chain(kerf).chain(plan.notes.iter().cloned()).collect::<Vec<_>>();
    let sheet = pattern_sheet(&scenario.name, &plan, &notes, kerf_m);
    Ok((plan, notes, sheet))
}

/// The pattern of a robot as SVG with the usual welds and allowance; `Err` gives the reason without one.
pub(super) fn usual_pattern(scenario: &Scenario) -> Result<String, String> {
    Ok(svg(&laid_out(scenario, usual_weld(scenario), ALLOWANCE, 0.0)?.2))
}

/// Files to write: the drawing, and its pages next to it.
fn files(args: &PatternArgs, sheet: &PatternSheet) -> Result<Vec<(PathBuf, String)>> {
    let is = |ending: &str| args.out.extension().is_some_and(|e| e.eq_ignore_ascii_case(ending));
    match &args.page {
        _ if !is("svg") && !is("dxf") => {
            let message = format!("--out {} ends neither with .svg nor with .dxf", args.out.display());
            Err(Failure::usage(message, "write for example --out pattern.svg"))
        }
        Some(_) if is("dxf") => {
            Err(Failure::usage("a DXF has no pages", "leave out --page, or write --out pattern.svg"))
        }
        None if is("dxf") => Ok(vec![(args.out.clone(), dxf(sheet))]),
        None => Ok(vec![(args.out.clone(), svg(sheet))]),
        Some(name) => {
            let (_, paper) = PAPERS.iter().find(|paper| paper.0 == name).unwrap_or(&PAPERS[0]);
            let stem = args.out.file_stem().unwrap_or_default().to_string_lossy().into_owned();
            let page = |[row, column]: [usize; 2]| args.out.with_file_name(format!("{stem}-{row}-{column}.svg"));
            let whole = std::iter::once((args.out.clone(), svg(sheet)));
            Ok(whole.chain(pages(sheet, *paper).into_iter().map(|(at, text)| (page(at), text))).collect())
        }
    }
}
