//! Facts that finished runs of the preset decide, on the finest mesh that has all runs a fact needs.

use super::facts::{FactCase, FactCheck, FactFound, FactVerdict, no_runs};
use super::{MESHES_MM, PaperRun, find, mesh_name};
use crate::accuracy::paper_accuracy;
use crate::policy;
use data::published::printed;

const TOP_KPA: f64 = 30.0;
const ROBOTS: [&str; 4] = ["spam", "cpam", "epam", "fpam"];

/// By name of the fact.
pub(super) const IN_RUNS: &[FactCheck] = &[
    ("ratio-epam", |case| ratio(case, "epam")),
    ("ratio-spam", |case| ratio(case, "spam")),
    ("order", order),
    ("buckling", buckling),
    ("sensitive", sensitive),
    ("pressure-explains", pressure_explains),
    ("fpam-stable", fpam_stable),
    ("mesh-insensitive", mesh_insensitive),
    ("mesh-gain", mesh_gain),
    ("mesh-deeper", mesh_deeper),
    ("mesh-cost", mesh_cost),
    ("kinetic-valid", |case| kinetic(case, |k| k.below_10_pct_of_internal)),
    ("kinetic-kept", |case| kinetic(case, |k| k.below_1_pct_of_total)),
    ("stress-seams", stress_seams),
    ("stress-alike", stress_alike),
    ("stress-cap", stress_cap),
    ("base", base),
    ("section", section),
];

/// Height of the outermost marker at the run's pressure \[mm\].
fn height(run: &PaperRun) -> f64 {
    run.end().map_or(f64::NAN, |s| s.marker_mm)
}

/// Largest von Mises stress there \[MPa\].
fn stress(run: &PaperRun) -> f64 {
    run.end().map_or(f64::NAN, |s| s.von_mises_mpa)
}

fn joined(words: impl Iterator<Item = String>) -> String {
    words.collect::<Vec<_>>().join(", ")
}

/// One robot at several pressures on the finest mesh that has all: heights \[mm\].
fn curve(case: &FactCase, kind: &str, kpa: &[f64]) -> Option<([f64; 2], Vec<f64>)> {
    let wanted: Vec<(&str, f64)> = kpa.iter().map(|p| (kind, *p)).collect();
    let (mesh, runs) = case.all(&wanted)?;
    Some((mesh, runs.into_iter().map(height).collect()))
}

/// A robot at a pressure on the coarsest and the final mesh.
fn two_meshes<'a>(case: &FactCase<'a>, kind: &str, kpa: f64) -> Option<[&'a PaperRun; 2]> {
    let [coarse, fine] = MESHES_MM.map(|mesh| find(case.runs, kind, mesh, kpa));
    Some([coarse?, fine?])
}

fn ratio(case: &FactCase, other: &str) -> FactFound {
    let d_max = |kind: &str| case.paper.actuator(kind).map_or(f64::NAN, |a| a.d_max_m);
    let table = d_max("cpam") / d_max(other);
    let found = format!("Table III {table:.2}");
    if (table - case.number(0)).abs() > 0.005 {
        return (found, FactVerdict::ContradictsItself(format!("{table:.2} in Table III")));
    }
    let Some((mesh, runs)) = case.all(&[("cpam", TOP_KPA), (other, TOP_KPA)]) else {
        return (found, FactVerdict::Holds);
    };
    let engine = height(runs[0]) / height(runs[1]);
    let off = engine / case.number(0) - 1.0;
    let found = format!("{found}; engine {engine:.2} ({})", mesh_name(mesh));
    (found, FactVerdict::holds_if(policy::meets(off), format!("engine {:+.0} %, its table agrees", 100.0 * off)))
}

fn order(case: &FactCase) -> FactFound {
    let Some((mesh, runs)) = case.all(&ROBOTS.map(|kind| (kind, TOP_KPA))) else {
        return no_runs("all four at 30 kPa on one mesh");
    };
    let mut by_height: Vec<(&str, f64)> = ROBOTS.into_iter().zip(runs.into_iter().map(height)).collect();
    by_height.sort_by(|a, b| b.1.total_cmp(&a.1));
    let words = joined(by_height.iter().map(|(kind, mm)| format!("{} {mm:.0}", printed(kind))));
    let kinds: Vec<&str> = by_height.iter().map(|(kind, _)| *kind).collect();
    let found = format!("mm at 30 kPa, {}: {words}", mesh_name(mesh));
    (found, FactVerdict::holds_if(kinds == ["cpam", "epam", "spam", "fpam"], "in another order"))
}

/// Rise of the cPAM in per cent on every mesh that has both pressures; the finest decides.
fn buckling(case: &FactCase) -> FactFound {
    let [from, to, low, high] = [0, 1, 2, 3].map(|k| case.number(k));
    let mut told = Vec::new();
    let mut last = None;
    for mesh in MESHES_MM {
        let at = |kpa: f64| find(case.runs, "cpam", mesh, kpa).map(height);
        let (Some(first), Some(end)) = (at(from), at(to)) else { continue };
        let rise = 100.0 * (end / first - 1.0);
        let between = (1..).map(|k| from + f64::from(k)).take_while(|kpa| *kpa < to).filter_map(at);
        let heights = joined(std::iter::once(first).chain(between).chain([end]).map(|mm| format!("{mm:.1}")));
        told.push(format!("{}: {heights} mm, {rise:+.1} %", mesh_name(mesh)));
        last = Some(rise);
    }
    let Some(rise) = last else { return no_runs("the cPAM at 10 and 13 kPa on one mesh") };
    let holds = (low..=high).contains(&rise);
    (told.join("; "), FactVerdict::holds_if(holds, format!("{rise:+.1} %, read as {low:+.0} to {high:+.0} %")))
}

fn sensitive(case: &FactCase) -> FactFound {
    let kpa = [0, 1, 2, 3].map(|k| case.number(k));
    let Some((mesh, mm)) = curve(case, "cpam", &kpa) else { return no_runs("the cPAM at 10, 13, 20 and 30 kPa") };
    let per_kpa = |a: usize, b: usize| 100.0 * (mm[b] / mm[a] - 1.0) / (kpa[b] - kpa[a]);
    let [low, high] = [per_kpa(0, 1), per_kpa(2, 3)];
    let found = format!("{}: {low:.1} % per kPa from 10 to 13, {high:.1} from 20 to 30 kPa", mesh_name(mesh));
    (found, FactVerdict::holds_if(low > high, "not more than at high pressure"))
}

/// The pressure at which the engine would bend as far as the high reading of the measurement at 10 kPa.
fn pressure_explains(case: &FactCase) -> FactFound {
    let grid = [case.number(0), case.number(1), 20.0];
    let Some((mesh, mm)) = curve(case, "cpam", &grid) else { return no_runs("the cPAM at 10, 13 and 20 kPa") };
    let Some(implied) = case.paper.actuator("cpam").and_then(|a| super::Implied::of(a, grid[0] * 1e3)) else {
        return no_runs("an accuracy");
    };
    let wanted = implied.would_mean_mm(mm[0])[1];
    let inside = (0..2).find(|k| mm[*k] <= wanted && wanted <= mm[k + 1]);
    let needed = inside.map(|k| grid[k] + (wanted - mm[k]) / (mm[k + 1] - mm[k]) * (grid[k + 1] - grid[k]) - grid[0]);
    let (error, name) = (100.0 * implied.error, mesh_name(mesh));
    let found = match needed {
        Some(kpa) => format!("{name}: an error of {error:.0} % is {kpa:.1} kPa too much in a test at 10"),
        None => format!("{name}: an error of {error:.0} % is more than 10 kPa too much in a test at 10"),
    };
    (found, FactVerdict::CannotBeChecked("the margin of the pressure control is not printed".into()))
}

fn fpam_stable(case: &FactCase) -> FactFound {
    let Some((mesh, mm)) = curve(case, "fpam", &[10.0, 20.0, TOP_KPA]) else {
        return no_runs("the fPAM at 10, 20 and 30 kPa");
    };
    let found = format!("{}: {} mm at 10, 20, 30 kPa", mesh_name(mesh), joined(mm.iter().map(|m| format!("{m:.1}"))));
    let fall = mm.windows(2).position(|pair| pair[1] < pair[0]);
    let by = fall.map_or_else(String::new, |k| {
        format!("falls by {:.0} % to {} kPa", 100.0 * (1.0 - mm[k + 1] / mm[k]), 10 * (k + 2))
    });
    (found, FactVerdict::holds_if(fall.is_none(), by))
}

/// Change of the height from the coarsest to the final mesh of some robots at 30 kPa \[%\].
fn changes<'a>(case: &FactCase, kinds: &[&'a str]) -> Vec<(&'a str, f64)> {
    let change = |kind: &&'a str| {
        let [coarse, fine] = two_meshes(case, kind, TOP_KPA)?;
        Some((*kind, 100.0 * (height(fine) / height(coarse) - 1.0)))
    };
    kinds.iter().filter_map(change).collect()
}

fn told(changes: &[(&str, f64)]) -> String {
    joined(changes.iter().map(|(kind, pct)| format!("{} {pct:+.1} %", printed(kind))))
}

fn mesh_insensitive(case: &FactCase) -> FactFound {
    let found = changes(case, &["spam", "epam", "fpam"]);
    let words = if found.is_empty() { "–".into() } else { format!("4 to 4/1 mm at 30 kPa: {}", told(&found)) };
    let why = "the same sentence lets the ePAMs gain almost 20 %; sPAMs may be meant";
    (words, FactVerdict::ContradictsItself(why.into()))
}

/// Accuracy of the outermost marker alone, which is what the printed displacement allows.
fn mesh_gain(case: &FactCase) -> FactFound {
    let gain = |kind: &str| {
        let measured = case.paper.actuator(kind)?.d_max_m * 1e3;
        let [coarse, fine] = two_meshes(case, kind, TOP_KPA)?.map(|run| paper_accuracy(&[height(run)], &[measured]));
        Some((printed(kind).to_string(), 100.0 * coarse?, 100.0 * fine?))
    };
    let found: Vec<(String, f64, f64)> = ["cpam", "epam"].into_iter().filter_map(gain).collect();
    if found.is_empty() {
        return no_runs("the cPAM or the ePAM on both meshes at 30 kPa");
    }
    let words = joined(found.iter().map(|(kind, from, to)| format!("{kind} {from:.1} to {to:.1} %")));
    let near = |points: f64| policy::is_almost(points, case.number(0));
    let holds = found.iter().all(|(_, from, to)| near(to - from));
    let by = joined(found.iter().map(|(kind, from, to)| format!("{kind} {:+.1} points", to - from)));
    (format!("outermost marker alone, 4 to 4/1 mm at 30 kPa: {words}"), FactVerdict::holds_if(holds, by))
}

fn mesh_deeper(case: &FactCase) -> FactFound {
    let found = changes(case, &["cpam", "epam"]);
    if found.is_empty() {
        return no_runs("the cPAM or the ePAM on both meshes at 30 kPa");
    }
    let rises = joined(found.iter().filter(|c| c.1 > 0.0).map(|c| format!("the {} bends more", printed(c.0))));
    let words = format!("a larger radius is less bend; 4 to 4/1 mm: {}", told(&found));
    (words, FactVerdict::holds_if(rises.is_empty(), rises))
}

fn mesh_cost(case: &FactCase) -> FactFound {
    let ratio = |kind: &&str| {
        let [coarse, fine] = two_meshes(case, kind, TOP_KPA)?;
        let times = fine.run.cpu_s / coarse.run.cpu_s;
        Some(format!("{} {times:.0} times", printed(kind)))
    };
    let words = joined(ROBOTS.iter().filter_map(ratio));
    if words.is_empty() {
        return no_runs("one robot on both meshes at 30 kPa");
    }
    let why = "two meshes show no law; elements times steps is a power of the size, not an exponential";
    (format!("processor time, 4 to 4/1 mm: {words}"), FactVerdict::CannotBeChecked(why.into()))
}

/// Outputs of all runs that keep a bound of the kinetic energy.
fn kinetic(case: &FactCase, kept: fn(&super::Kinetic) -> u64) -> FactFound {
    let all: Vec<&PaperRun> = case.runs.iter().filter(|r| !r.encastre).collect();
    if all.is_empty() {
        return no_runs("any robot");
    }
    let share = |r: &PaperRun| kept(&r.kinetic) as f64 / r.kinetic.outputs.max(1) as f64;
    let [within, outputs] =
        [kept as fn(&super::Kinetic) -> u64, |k| k.outputs].map(|of| all.iter().map(|r| of(&r.kinetic)).sum::<u64>());
    let whole = all.iter().filter(|r| kept(&r.kinetic) == r.kinetic.outputs).count();
    let [worst, end] =
        [all.iter().map(|r| share(r)).fold(1.0, f64::min), all.iter().map(|r| r.kinetic.at_end).fold(0.0, f64::max)];
    let found = format!(
        "{:.0} % of all outputs of {} runs ({:.0} % in the worst run); at the end {:.2} % at most",
        100.0 * within as f64 / outputs.max(1) as f64,
        all.len(),
        100.0 * worst,
        100.0 * end
    );
    (
        found,
        FactVerdict::holds_if(
            whole == all.len(),
            format!("{} of {} runs exceed it at some output", all.len() - whole, all.len()),
        ),
    )
}

/// The robots at 30 kPa, each on its finest mesh.
fn at_top<'a>(case: &FactCase<'a>, kinds: &[&'a str]) -> Vec<(&'a str, &'a PaperRun)> {
    let finest = |kind: &&'a str| Some((*kind, case.all(&[(kind, TOP_KPA)])?.1[0]));
    kinds.iter().filter_map(finest).collect()
}

fn place(run: &PaperRun) -> String {
    let beside = if run.peak.on_seam { "beside a weld" } else { "off the welds" };
    format!("{:.0} MPa {beside} in {} at {:.0} mm", stress(run), run.peak.part, run.peak.at_mm)
}

fn stress_seams(case: &FactCase) -> FactFound {
    let found = at_top(case, &["spam", "cpam", "epam"]);
    if found.is_empty() {
        return no_runs("a welded robot at 30 kPa");
    }
    let words = joined(found.iter().map(|(kind, run)| format!("{} {}", printed(kind), place(run))));
    let off = joined(found.iter().filter(|(_, r)| !r.peak.on_seam).map(|(kind, _)| printed(kind).to_string()));
    (words, FactVerdict::holds_if(off.is_empty(), format!("not in the {off}")))
}

fn stress_alike(case: &FactCase) -> FactFound {
    let Some((mesh, runs)) = case.all(&[("spam", TOP_KPA), ("epam", TOP_KPA)]) else {
        return no_runs("sPAM and ePAM at 30 kPa on one mesh");
    };
    let words = format!("{}: sPAM {}, ePAM {}", mesh_name(mesh), place(runs[0]), place(runs[1]));
    let times = stress(runs[0]) / stress(runs[1]);
    let holds = runs[0].peak.on_seam == runs[1].peak.on_seam && policy::meets(times - 1.0);
    (words, FactVerdict::holds_if(holds, format!("the sPAM's is {times:.2} times the ePAM's")))
}

fn stress_cap(case: &FactCase) -> FactFound {
    let found = at_top(case, &ROBOTS);
    if found.is_empty() {
        return no_runs("a robot at 30 kPa");
    }
    let words = joined(found.iter().map(|(kind, run)| format!("{} {:.0}", printed(kind), stress(run))));
    let above = found.iter().any(|(_, run)| stress(run) > case.number(0));
    (format!("largest, MPa: {words}"), FactVerdict::holds_if(above, "no peak reaches the cap"))
}

fn base(case: &FactCase) -> FactFound {
    // An encastre base holds a row of elements more: a robot shorter by that is lower by the square, whatever its base does.
    let change = |held: &&PaperRun| {
        let (kind, kpa) = (held.run.actuator.as_str(), held.end()?.actuator_kpa);
        let pinned = find(case.runs, kind, held.run.mesh_mm, kpa)?;
        let (marker, row) = (held.run.stations_mm.last()?, held.run.mesh_mm[1]);
        let shorter = (1.0 - row / marker).powi(2);
        let share = height(held) / height(pinned) - 1.0;
        let beyond = height(held) / (shorter * height(pinned)) - 1.0;
        let words = format!("{} {:+.1} % ({:+.1})", printed(kind), 100.0 * share, 100.0 * beyond);
        Some((format!("{words} at {kpa:.0} kPa"), beyond.abs()))
    };
    let found: Vec<(String, f64)> = case.runs.iter().filter(|r| r.encastre).filter_map(|r| change(&r)).collect();
    if found.is_empty() {
        return no_runs("a robot with an encastre base");
    }
    let largest = found.iter().map(|f| f.1).fold(0.0, f64::max);
    let words =
        format!("encastre against pinned (beyond the row that it holds): {}", joined(found.into_iter().map(|f| f.0)));
    (words, FactVerdict::holds_if(policy::is_none(largest), format!("up to {:.1} % beyond that row", 100.0 * largest)))
}

/// What the bodies lose of their volume between filling and 30 kPa.
fn section(case: &FactCase) -> FactFound {
    let lost = |run: &PaperRun| {
        let filled = run.run.states.first().map_or(f64::NAN, |s| s.body_cm3);
        1.0 - run.end().map_or(f64::NAN, |s| s.body_cm3) / filled
    };
    let found: Vec<(&str, f64)> = at_top(case, &ROBOTS).into_iter().map(|(kind, run)| (kind, lost(run))).collect();
    let Some(own) = found.iter().find(|f| f.0 == "spam").map(|f| f.1) else { return no_runs("the sPAM at 30 kPa") };
    let words = joined(found.iter().map(|(kind, share)| format!("{} {:.1} %", printed(kind), 100.0 * share)));
    let found = format!("the body loses of its volume at 30 kPa, its bend included: {words}");
    (
        found,
        FactVerdict::holds_if(
            policy::is_little(own),
            format!("{:.1} % is more than {:.0} %", 100.0 * own, 100.0 * policy::LITTLE),
        ),
    )
}
