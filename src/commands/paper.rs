//! `ibr compare --paper`: the paper's finite elements, reproduced.

use super::engines::{Robot, robots};
use super::simulate::{Keeper, Named, keys_of, paper_runs, pressures, rounded, sizes};
use super::tables::table;
use super::{Context, Outcome};
use crate::cli::Compare;
use crate::failure::{Failure, INTERRUPTED};
use crate::output::{check_folder, write_files};
use ::compare::study::paper::{
    Against, MESHES_MM, NEAR, PaperRun, Row, facts, heights, mesh_name, ordered, runs_json, stored,
};
use ibr::pages::Files;
use serde_json::json;

/// Pressures between 10 and 20 kPa at which the paper looks at the cPAM \[kPa\].
const BUCKLING_KPA: [f64; 3] = [11.0, 12.0, 13.0];

pub fn run(args: &Compare, context: &mut Context) -> Result<Outcome, Failure> {
    args.out.as_deref().map_or(Ok(()), check_folder)?;
    let Some(runs) = runs(args, context)? else {
        let note = "interrupted; finished runs are kept, the same command goes on".to_string();
        return Ok(Outcome { notes: vec![note], code: INTERRUPTED, ..Outcome::default() });
    };
    let paper = data::published()?;
    let (against, rows) = (heights(&paper, &runs, &MESHES_MM), facts(&paper, &runs));
    let text = text(&against, &rows, &runs);
    let answer = json!({"schema": "ibr.paper", "version": 1, "runs": runs.len(), "heights": against, "facts": rows});
    let mut outcome = Outcome::new(text.clone(), answer);
    if let Some(folder) = &args.out {
        let mut files = Files::default();
        files.files.push(("paper.md".into(), text.into_bytes()));
        files.files.push(("paper-runs.json".into(), runs_json(&runs).into_bytes()));
        write_files(folder, &files, &[], context)?;
        outcome.notes.push(format!("runs: {}", folder.join("paper-runs.json").display()));
    }
    Ok(outcome)
}

/// Stored runs, or all in the folder, which gets what is missing.
fn runs(args: &Compare, context: &mut Context) -> Result<Option<Vec<PaperRun>>, Failure> {
    let Some(folder) = &args.runs else {
        if !args.inputs.is_empty() || args.pressure.is_some() {
            let help = "add --runs FOLDER to make runs; without it all that come with the program are printed";
            return Err(Failure::usage("--paper alone takes no scenario and no --pressure", help));
        }
        return Ok(Some(ordered(stored()?)));
    };
    let keeper = Keeper { folder: folder.clone(), threads: args.threads as usize };
    let Ok(made) = keeper.run_all(&cases(args)?, context)? else { return Ok(None) };
    made.into_iter().collect::<Result<Vec<_>, Failure>>()?;
    Ok(Some(ordered(paper_runs(folder)?)))
}

/// Every robot on every mesh at every pressure, and with an encastre base at its highest on meshes of one size.
fn cases(args: &Compare) -> Result<Vec<(Named, String)>, Failure> {
    let typed = args.pressure.as_deref().map(pressures).transpose()?;
    let mut cases = Vec::new();
    for robot in robots(&args.inputs)?.0 {
        let kpa = typed.clone().map_or_else(|| own_pressures(&robot), Ok)?;
        let top = kpa.iter().copied().fold(0.0, f64::max);
        for mesh in sizes(&args.mesh)? {
            for p in &kpa {
                cases.push(case(&robot, mesh, *p, "pinned")?);
            }
            if mesh[0] == mesh[1] {
                cases.push(case(&robot, mesh, top, "encastre")?);
            }
        }
    }
    Ok(cases)
}

/// The scenario's, and those at which the cPAM buckles.
fn own_pressures((named, scenario): &Robot) -> Result<Vec<f64>, Failure> {
    let mut kpa: Vec<f64> = named.robot_run()?.1.pressures_pa.iter().map(|pa| rounded(pa * 1e-3)).collect();
    if scenario.actuator.kind.name == "cpam" {
        kpa.extend(BUCKLING_KPA);
    }
    Ok(kpa)
}

fn case((named, scenario): &Robot, mesh_mm: [f64; 2], kpa: f64, base: &str) -> Result<(Named, String), Failure> {
    let mut changes =
        vec![("model".to_string(), "\"paper\"".to_string()), ("pressures_kpa".into(), format!("[{kpa}]"))];
    changes.extend(keys_of(&mesh_mm));
    if base != "pinned" {
        changes.push(("base".into(), format!("\"{base}\"")));
    }
    let what = format!("{}, {}, {kpa} kPa, {base}", scenario.actuator.kind.name, mesh_name(mesh_mm));
    Ok((named.with(&changes)?, what))
}

fn text(against: &[Against], rows: &[Row], runs: &[PaperRun]) -> String {
    let mut out = format!(
        "The paper's finite elements, reproduced: {} runs of [fem] model = \"paper\", nothing calibrated.\n\n",
        runs.len()
    );
    out.push_str(
        "Height of the outermost marker [mm] beside what the paper's accuracy a implies: e = √(1 − a) is the rms of\n",
    );
    out.push_str("(y_FEA − y_EXP)/y_FEA over six markers. Assumed in reading it: the error is alike along the robot, its sign is\n");
    out.push_str("unknown; then y_FEA = y_EXP/(1 + e), the low branch, or y_EXP/(1 − e), the high one. y_EXP is printed at 30 kPa\n");
    out.push_str(&format!(
        "only; it is nowhere more than there. A height within {:.0} % of a branch holds.\n",
        100.0 * NEAR
    ));
    let head = ["robot", "kPa", "mesh", "e %", "low", "high", "at most", "engine", "tip", "verdict"];
    out.push_str(&left_last(&head, against.iter().map(height_cells).collect()));
    out.push_str("\nHeights of the six markers [mm], base first; the paper draws them and prints none\n");
    let most = against.iter().map(|a| a.markers_mm.len()).max().unwrap_or(0);
    let mut head: Vec<String> = ["robot", "kPa", "mesh"].map(String::from).to_vec();
    head.extend((1..=most).map(|k| format!("marker {k}")));
    let head: Vec<&str> = head.iter().map(String::as_str).collect();
    out.push_str(&table(&head, 3, against.iter().map(marker_cells).collect()));
    out.push_str("\nEvery sentence of the paper with something to check\n");
    let facts = rows.iter().map(|r| vec![r.says.clone(), r.place.clone(), r.found.clone(), r.verdict.words()]);
    out.push_str(&table(&["the paper says", "in", "engine, or the paper elsewhere", "verdict"], 4, facts.collect()));
    out + &counted(rows) + &numerics(runs)
}

/// A table whose last column is words.
fn left_last(head: &[&str], rows: Vec<Vec<String>>) -> String {
    // A right-flushed column of words is padded to one width, which makes it flush left.
    let most = rows.iter().filter_map(|r| r.last()).map(|w| w.chars().count()).max().unwrap_or(0);
    let padded = rows.into_iter().map(|mut row| {
        row.iter_mut().last().into_iter().for_each(|w| *w = format!("{w:<most$}"));
        row
    });
    table(head, 3, padded.collect())
}

fn height_cells(a: &Against) -> Vec<String> {
    let branch = |k: usize| a.implied.branches_mm.map_or("–".into(), |b| format!("{:.0}", b[k]));
    vec![
        a.robot.clone(),
        format!("{:.0}", a.actuator_kpa),
        mesh_name(a.mesh_mm),
        format!("{:.0}", 100.0 * a.implied.error),
        branch(0),
        branch(1),
        format!("{:.0}", a.implied.at_most_mm),
        format!("{:.1}", a.outermost_mm()),
        format!("{:.1}", a.tip_mm),
        a.verdict.clone(),
    ]
}

fn marker_cells(a: &Against) -> Vec<String> {
    let mut cells = vec![a.robot.clone(), format!("{:.0}", a.actuator_kpa), mesh_name(a.mesh_mm)];
    cells.extend(a.markers_mm.iter().map(|mm| format!("{mm:.1}")));
    cells
}

/// How many facts hold, miss, contradict each other or cannot be checked.
fn counted(rows: &[Row]) -> String {
    let kinds = ["holds", "misses", "contradicts itself", "cannot be checked"];
    let count = |kind: &str| rows.iter().filter(|row| row.verdict.words().starts_with(kind)).count();
    let words = kinds.map(|kind| format!("{kind} {}", count(kind))).join(", ");
    format!("\n{} facts: {words}.\n", rows.len())
}

/// What of the runs is ours and not the paper's.
fn numerics(runs: &[PaperRun]) -> String {
    let mass = runs.iter().map(|r| r.added_mass_share).fold(0.0, f64::max);
    let cpu_s: f64 = runs.iter().map(|r| r.run.cpu_s).sum();
    format!(
        "Numerics are ours: selective masses, {:.0} % added at most; {:.0} CPU s in all. \
         Assumed, not printed: six pouches, marker stations, glue, density.\n",
        100.0 * mass,
        cpu_s
    )
}
