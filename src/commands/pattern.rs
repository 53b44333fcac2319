//! `ibr pattern`

use super::inputs::{self, quantity};
use crate::cli::PatternArgs;
use crate::prelude::*;
use crate::shown::pattern::PatternAnswer;
use ibr::pages::pattern_sheet;
use models::cutting::{CuttingPlan, Making};
use report::sheet::{Paper, PatternSheet, dxf, pages, svg};

/// Width of welds where neither the scenario nor the user says one, as in [`fem::robot::RobotSettings`] \[m\].
const WELD_M: f64 = 0.003;

/// Fabric beyond welds and ends of a pattern that nobody says more about, as in the command \[m\].
const ALLOWANCE_M: f64 = 0.01;

/// More fabric than that around a piece is a slip of the unit \[m\].
const MOST_ALLOWANCE_M: f64 = 0.5;

pub(super) fn run(args: &PatternArgs, context: &mut Context) -> Result<Outcome, Failure> {
    let file = inputs::scenario(&args.scenario)?;
    let (weld_m, how) = weld(args, &file.scenario)?;
    let allowance_m = quantity("--allowance", &args.allowance, Quantity::Length)?;
    if !(0.0..=MOST_ALLOWANCE_M).contains(&allowance_m) {
        let message = format!("--allowance {} is not from 0 to {} mm", args.allowance, 1e3 * MOST_ALLOWANCE_M);
        return Err(Failure::usage(message, "write for example --allowance 10mm"));
    }
    let making = Making { weld_m, allowance_m };
    let plan = CuttingPlan::new(&file.scenario, &making)
        .map_err(|fault| Failure::usage(format!("{}: {fault}", args.scenario), "see docs/scenario.md"))?;
    let mut told = vec![format!("Welds {:.1} mm wide ({how}), allowance {} beyond.", 1e3 * weld_m, args.allowance)];
    told.extend(plan.notes.iter().cloned());
    let sheet = pattern_sheet(&file.scenario.name, &plan, &told);
    let files = files(args, &sheet)?;
    write_texts(&files, context)?;
    let names: Vec<String> = files.iter().map(|(path, _)| path.display().to_string()).collect();
    let answer = PatternAnswer::of(&args.scenario, &plan, &making, &told, &names);
    Ok(Outcome::answer(answer.text(), "ibr.pattern", &answer))
}

/// The width of the welds and how it is known.
fn weld(args: &PatternArgs, scenario: &Scenario) -> Result<(f64, String), Failure> {
    match &args.weld {
        Some(text) => Ok((quantity("--weld", text, Quantity::Length)?, "as told".into())),
        None => Ok(usual_weld(scenario)),
    }
}

fn usual_weld(scenario: &Scenario) -> (f64, String) {
    let effect = scenario.effects.iter().find(|e| e.name == "weld_width");
    effect.map_or((WELD_M, "assumed".into()), |e| (e.values[0], format!("the scenario's weld_width, {}", e.basis)))
}

/// The pattern of a robot as SVG with what `ibr pattern` takes by itself; `Err` says why there is none.
pub(super) fn usual_pattern(scenario: &Scenario) -> Result<String, String> {
    let (weld_m, how) = usual_weld(scenario);
    let plan = CuttingPlan::new(scenario, &Making { weld_m, allowance_m: ALLOWANCE_M })?;
    let mut told =
        vec![format!("Welds {:.1} mm wide ({how}), allowance {:.0} mm beyond.", 1e3 * weld_m, 1e3 * ALLOWANCE_M)];
    told.extend(plan.notes.iter().cloned());
    Ok(svg(&pattern_sheet(&scenario.name, &plan, &told)))
}

/// Files to write: the drawing, and its pages beside it.
fn files(args: &PatternArgs, sheet: &PatternSheet) -> Result<Vec<(PathBuf, String)>, Failure> {
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
            let paper = Paper::ALL.iter().find(|paper| paper.name == name).unwrap_or(&Paper::ALL[0]);
            let stem = args.out.file_stem().unwrap_or_default().to_string_lossy().into_owned();
            let page = |[row, column]: [usize; 2]| args.out.with_file_name(format!("{stem}-{row}-{column}.svg"));
            let whole = std::iter::once((args.out.clone(), svg(sheet)));
            Ok(whole.chain(pages(sheet, paper).into_iter().map(|(at, text)| (page(at), text))).collect())
        }
    }
}
