//! `ibr compare --paper`: the paper's finite elements, reproduced.

use crate::cli::CompareArgs;
use crate::prelude::*;
use compare::study::paper::{
    FactRow, HeightRow, MESHES_MM, PaperRun, facts, heights, mesh_name, ordered, runs_below, runs_json, stored,
};

pub(super) fn run(args: &CompareArgs, context: &mut Context) -> Result<Outcome> {
    args.out.as_deref().map_or(Ok(()), check_folder)?;
    let runs = runs(args)?;
    let paper = data::published()?;
    let (against, rows) = (heights(&paper, &runs, &MESHES_MM), facts(&paper, &runs));
    let text = shown(&against, &rows, &runs);
    let answer = PaperAnswer { runs: runs.len(), heights: &against, facts: &rows };
    let mut outcome = Outcome::answer(text.clone(), "ibr.paper", &answer);
    if let Some(folder) = &args.out {
        let mut files = Files::default();
        files.text("paper.md", text);
        files.text("paper-runs.json", runs_json(&runs));
        write_files(folder, &files, &[], context)?;
        outcome.notes.push(format!("runs: {}", folder.join("paper-runs.json").display()));
    }
    Ok(outcome)
}

/// Stored runs, or all in the folder.
fn runs(args: &CompareArgs) -> Result<Vec<PaperRun>> {
    let help = "ibr simulate epam-paper --out FOLDER/epam makes runs, and --runs FOLDER compares them";
    let message = "--paper takes no scenario and no --pressure";
    refuse_if(!args.inputs.is_empty() || args.pressure.is_some(), message, help)?;
    let found = args.runs.runs.as_deref().map_or_else(stored, runs_below)?;
    refuse_if(found.is_empty(), "no finished run of the paper's model was found", help)?;
    Ok(ordered(found))
}

/// `ibr.paper`: `ibr compare --paper`
#[derive(Serialize)]
struct PaperAnswer<'a> {
    /// Number of finite element runs that were compared
    runs: usize,
    /// Heights of markers against its figures
    heights: &'a [HeightRow],
    /// What the paper prints, fact by fact
    facts: &'a [FactRow],
}

fn shown(against: &[HeightRow], rows: &[FactRow], runs: &[PaperRun]) -> String {
    let mut out = format!(
        "The paper's finite elements, reproduced: {} runs of [fem] model = \"paper\", nothing calibrated.\n\n{READING}",
        runs.len()
    );
    let branch = |a: &HeightRow, k: usize| a.implied.branches_mm.map(|b| b[k]);
    let most = against.iter().map(|a| a.verdict.chars().count()).max().unwrap_or(0);
    out += &place(against)
        .number("e %", 0, |a| 100.0 * a.implied.error)
        .number("low", 0, |a| branch(a, 0))
        .number("high", 0, |a| branch(a, 1))
        .number("at most", 0, |a| a.implied.at_most_mm)
        .number("engine", 1, |a| a.outermost_mm())
        .number("tip", 1, |a| a.tip_mm)
        // Words of one width are flush left below a head that is flush right.
        .right("verdict", |a| format!("{:<most$}", a.verdict))
        .text();
    out += "\nHeights of the six markers [mm], base first; the paper draws them and prints none\n";
    let mut markers = place(against);
    for k in 0..against.iter().map(|a| a.markers_mm.len()).max().unwrap_or(0) {
        markers = markers
            .right(format!("marker {}", k + 1), |a| a.markers_mm.get(k).map_or(String::new(), |mm| format!("{mm:.1}")));
    }
    out += &markers.text();
    out += "\nSentences of the paper that runs or patterns can check\n";
    out += &TextTable::of(rows)
        .words("the paper states", |r| &r.says)
        .words("in", |r| &r.place)
        .words("engine", |r| &r.found)
        .words("verdict", |r| r.verdict.words())
        .text();
    out + &counted(rows) + &numerics(runs)
}

const READING: &str = "\
Height of the outermost marker [mm] compared with what the paper's accuracy a implies: e = √(1 − a) is the rms of
(y_FEA − y_EXP)/y_FEA over six markers. Assumed in reading it: the error is alike along the robot, its sign is
unknown; then y_FEA = y_EXP/(1 + e), the low branch, or y_EXP/(1 − e), the high one. y_EXP is printed at 30 kPa
only; it is nowhere more than there. A height within a tenth of a branch holds.
";

fn place(against: &[HeightRow]) -> TextTable<&HeightRow> {
    TextTable::of(against)
        .words("robot", |a| &a.robot)
        .words("kPa", |a| format!("{:.0}", a.actuator_kpa))
        .words("mesh", |a| mesh_name(a.mesh_mm))
}

/// How many facts hold, miss, contradict each other or cannot be checked.
fn counted(rows: &[FactRow]) -> String {
    let kinds = ["holds", "misses", "cannot be checked"];
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
