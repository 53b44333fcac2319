//! The paper's finite elements in words.

use crate::tables::table;
use compare::study::paper::{FactRow, HeightRow, PaperRun, mesh_name};

/// Heights, facts and numerics.
pub fn text(against: &[HeightRow], rows: &[FactRow], runs: &[PaperRun]) -> String {
    let mut out = format!(
        "The paper's finite elements, reproduced: {} runs of [fem] model = \"paper\", nothing calibrated.\n\n",
        runs.len()
    );
    out.push_str(
        "Height of the outermost marker [mm] beside what the paper's accuracy a implies: e = √(1 − a) is the rms of\n",
    );
    out.push_str("(y_FEA − y_EXP)/y_FEA over six markers. Assumed in reading it: the error is alike along the robot, its sign is\n");
    out.push_str("unknown; then y_FEA = y_EXP/(1 + e), the low branch, or y_EXP/(1 − e), the high one. y_EXP is printed at 30 kPa\n");
    out.push_str("only; it is nowhere more than there. A height within a tenth of a branch holds.\n");
    let head = ["robot", "kPa", "mesh", "e %", "low", "high", "at most", "engine", "tip", "verdict"];
    out.push_str(&left_last(&head, against.iter().map(height_cells).collect()));
    out.push_str("\nHeights of the six markers [mm], base first; the paper draws them and prints none\n");
    let most = against.iter().map(|a| a.markers_mm.len()).max().unwrap_or(0);
    let mut head: Vec<String> = ["robot", "kPa", "mesh"].map(String::from).to_vec();
    head.extend((1..=most).map(|k| format!("marker {k}")));
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

fn height_cells(a: &HeightRow) -> Vec<String> {
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

fn marker_cells(a: &HeightRow) -> Vec<String> {
    let mut cells = vec![a.robot.clone(), format!("{:.0}", a.actuator_kpa), mesh_name(a.mesh_mm)];
    cells.extend(a.markers_mm.iter().map(|mm| format!("{mm:.1}")));
    cells
}

/// How many facts hold, miss, contradict each other or cannot be checked.
fn counted(rows: &[FactRow]) -> String {
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
