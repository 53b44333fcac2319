//! Facts that finished runs of the preset decide, on the finest mesh that has all runs a fact needs.

use super::facts::{FactCase, FactCheck, FactFound, cannot_be_checked, contradicts_itself, holds_if, joined};
use super::{Implied, Kinetic, MESHES_MM, PaperRun, ROBOTS, find, mesh_name};
use crate::accuracy::paper_accuracy;
use crate::policy;
use data::published::printed;

const TOP_KPA: f64 = 30.0;
const WELDED: [&str; 3] = ["spam", "cpam", "epam"];

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

/// One robot at several pressures on the finest mesh that has all: the mesh, and heights \[mm\].
fn curve(case: &FactCase, kind: &str, kpa: &[f64]) -> Option<(String, Vec<f64>)> {
    let (mesh, runs) = case.all(&kpa.iter().map(|p| (kind, *p)).collect::<Vec<_>>())?;
    Some((mesh_name(mesh), runs.into_iter().map(height).collect()))
}

/// Something of the robots that have runs at 30 kPa on both meshes, from the coarsest to the final one.
fn on_both<'a, T>(
    case: &FactCase,
    kinds: &[&'a str],
    of: impl Fn(&str, [&PaperRun; 2]) -> Option<T>,
) -> Option<Vec<(&'a str, T)>> {
    let both = |kind: &&'a str| {
        let [coarse, fine] = MESHES_MM.map(|mesh| find(case.runs, kind, mesh, TOP_KPA));
        Some((printed(kind), of(kind, [coarse?, fine?])?))
    };
    Some(kinds.iter().filter_map(both).collect::<Vec<_>>()).filter(|found| !found.is_empty())
}

/// The robots that have a run at 30 kPa, as printed, each on its finest mesh.
fn at_top<'a>(case: &FactCase<'a>, kinds: &[&'a str]) -> Option<Vec<(&'a str, &'a PaperRun)>> {
    let finest = |kind: &&'a str| Some((printed(kind), case.all(&[(kind, TOP_KPA)])?.1[0]));
    Some(kinds.iter().filter_map(finest).collect::<Vec<_>>()).filter(|found| !found.is_empty())
}

fn named<T>(found: &[(&str, T)], words: impl Fn(&T) -> String) -> String {
    joined(found.iter().map(|(kind, of)| format!("{kind} {}", words(of))))
}

fn ratio(case: &FactCase, other: &str) -> FactFound {
    let wanted = case.number(0);
    let table = case.d_max_mm("cpam")? / case.d_max_mm(other)?;
    let found = format!("Table III {table:.2}");
    if (table - wanted).abs() > 0.005 {
        return contradicts_itself(found, format!("{table:.2} in Table III"));
    }
    let Some((mesh, runs)) = case.all(&[("cpam", TOP_KPA), (other, TOP_KPA)]) else { return holds_if(true, found, "") };
    let engine = height(runs[0]) / height(runs[1]);
    let off = engine / wanted - 1.0;
    let found = format!("{found}; engine {engine:.2} ({})", mesh_name(mesh));
    holds_if(policy::meets(off), found, format!("engine {:+.0} %, its table agrees", 100.0 * off))
}

fn order(case: &FactCase) -> FactFound {
    let (mesh, runs) = case.all(&ROBOTS.map(|kind| (kind, TOP_KPA)))?;
    let mut by_height: Vec<(&str, f64)> = ROBOTS.map(printed).into_iter().zip(runs.into_iter().map(height)).collect();
    by_height.sort_by(|a, b| b.1.total_cmp(&a.1));
    let found = format!("mm at 30 kPa, {}: {}", mesh_name(mesh), named(&by_height, |mm| format!("{mm:.0}")));
    let wanted = ["cpam", "epam", "spam", "fpam"].map(printed);
    holds_if(by_height.iter().map(|(kind, _)| *kind).eq(wanted), found, "in another order")
}

/// Rise of the cPAM in per cent on every mesh that has both pressures; the finest decides.
fn buckling(case: &FactCase) -> FactFound {
    let [from, to, low, high] = [0, 1, 2, 3].map(|k| case.number(k));
    let on_mesh = |mesh: &[f64; 2]| {
        let at = |kpa: f64| find(case.runs, "cpam", *mesh, kpa).map(height);
        let (first, end) = (at(from)?, at(to)?);
        let rise = 100.0 * (end / first - 1.0);
        let between = (1..).map(|k| from + f64::from(k)).take_while(|kpa| *kpa < to).filter_map(at);
        let heights = joined(std::iter::once(first).chain(between).chain([end]).map(|mm| format!("{mm:.1}")));
        Some((format!("{}: {heights} mm, {rise:+.1} %", mesh_name(*mesh)), rise))
    };
    let (words, rises): (Vec<String>, Vec<f64>) = MESHES_MM.iter().filter_map(on_mesh).unzip();
    let rise = *rises.last()?;
    let by = format!("{rise:+.1} %, read as {low:+.0} to {high:+.0} %");
    holds_if((low..=high).contains(&rise), words.join("; "), by)
}

fn sensitive(case: &FactCase) -> FactFound {
    let kpa = [0, 1, 2, 3].map(|k| case.number(k));
    let (mesh, mm) = curve(case, "cpam", &kpa)?;
    let per_kpa = |a: usize, b: usize| 100.0 * (mm[b] / mm[a] - 1.0) / (kpa[b] - kpa[a]);
    let [low, high] = [per_kpa(0, 1), per_kpa(2, 3)];
    let found = format!("{mesh}: {low:.1} % per kPa from 10 to 13, {high:.1} from 20 to 30 kPa");
    holds_if(low > high, found, "not more than at high pressure")
}

/// The pressure at which the engine would bend as far as the high reading of the measurement at 10 kPa.
fn pressure_explains(case: &FactCase) -> FactFound {
    let grid = [case.number(0), case.number(1), 20.0];
    let (mesh, mm) = curve(case, "cpam", &grid)?;
    let implied = Implied::of(case.paper.actuator("cpam")?, grid[0] * 1e3)?;
    let wanted = implied.would_mean_mm(mm[0])[1];
    let inside = (0..2).find(|k| mm[*k] <= wanted && wanted <= mm[k + 1]);
    let needed = inside.map(|k| grid[k] + (wanted - mm[k]) / (mm[k + 1] - mm[k]) * (grid[k + 1] - grid[k]) - grid[0]);
    let kpa = needed.map_or("more than 10".into(), |kpa| format!("{kpa:.1}"));
    let found = format!("{mesh}: an error of {:.0} % is {kpa} kPa too much in a test at 10", 100.0 * implied.error);
    cannot_be_checked(found, "the margin of the pressure control is not printed")
}

fn fpam_stable(case: &FactCase) -> FactFound {
    let (mesh, mm) = curve(case, "fpam", &[10.0, 20.0, TOP_KPA])?;
    let found = format!("{mesh}: {} mm at 10, 20, 30 kPa", joined(mm.iter().map(|m| format!("{m:.1}"))));
    let fall = mm.windows(2).position(|pair| pair[1] < pair[0]);
    let by = |k: usize| format!("falls by {:.0} % to {} kPa", 100.0 * (1.0 - mm[k + 1] / mm[k]), 10 * (k + 2));
    holds_if(fall.is_none(), found, fall.map_or(String::new(), by))
}

/// Change of the height from the coarsest to the final mesh \[%\], and the changes in words.
fn changes<'a>(case: &FactCase, kinds: &[&'a str]) -> Option<(Vec<(&'a str, f64)>, String)> {
    let found = on_both(case, kinds, |_, [coarse, fine]| Some(100.0 * (height(fine) / height(coarse) - 1.0)))?;
    let words = named(&found, |pct| format!("{pct:+.1} %"));
    Some((found, words))
}

fn mesh_insensitive(case: &FactCase) -> FactFound {
    let found = changes(case, &["spam", "epam", "fpam"]).map(|(_, words)| format!("4 to 4/1 mm at 30 kPa: {words}"));
    let how = "the same sentence lets the ePAMs gain almost 20 %; sPAMs may be meant";
    contradicts_itself(found.unwrap_or("–".into()), how)
}

/// Accuracy of the outermost marker alone, which is what the printed displacement allows.
fn mesh_gain(case: &FactCase) -> FactFound {
    let found = on_both(case, &["cpam", "epam"], |kind, meshes| {
        let measured = [case.d_max_mm(kind)?];
        let [coarse, fine] = meshes.map(|run| paper_accuracy(&[height(run)], &measured));
        Some([100.0 * coarse?, 100.0 * fine?])
    })?;
    let holds = found.iter().all(|(_, [from, to])| policy::is_almost(to - from, case.number(0)));
    let words = named(&found, |[from, to]| format!("{from:.1} to {to:.1} %"));
    let by = named(&found, |[from, to]| format!("{:+.1} points", to - from));
    holds_if(holds, format!("outermost marker alone, 4 to 4/1 mm at 30 kPa: {words}"), by)
}

fn mesh_deeper(case: &FactCase) -> FactFound {
    let (found, words) = changes(case, &["cpam", "epam"])?;
    let rises = joined(found.iter().filter(|c| c.1 > 0.0).map(|(kind, _)| format!("the {kind} bends more")));
    holds_if(rises.is_empty(), format!("a larger radius is less bend; 4 to 4/1 mm: {words}"), rises)
}

fn mesh_cost(case: &FactCase) -> FactFound {
    let found = on_both(case, &ROBOTS, |_, [coarse, fine]| Some(fine.run.cpu_s / coarse.run.cpu_s))?;
    let words = named(&found, |times| format!("{times:.0} times"));
    let why = "two meshes show no law; elements times steps is a power of the size, not an exponential";
    cannot_be_checked(format!("processor time, 4 to 4/1 mm: {words}"), why)
}

/// Outputs of all runs that keep a bound of the kinetic energy.
fn kinetic(case: &FactCase, kept: fn(&Kinetic) -> u64) -> FactFound {
    let all: Vec<&Kinetic> = case.runs.iter().filter(|r| !r.encastre).map(|r| &r.kinetic).collect();
    let (runs, whole) = (all.len(), all.iter().filter(|k| kept(k) == k.outputs).count());
    let share = |kept: u64, outputs: u64| kept as f64 / outputs.max(1) as f64;
    let within = share(all.iter().map(|k| kept(k)).sum(), all.iter().map(|k| k.outputs).sum());
    let worst = all.iter().map(|k| share(kept(k), k.outputs)).fold(1.0, f64::min);
    let [within, worst, end] = [within, worst, all.iter().map(|k| k.at_end).fold(0.0, f64::max)].map(|v| 100.0 * v);
    let found = format!(
        "{within:.0} % of all outputs of {runs} runs ({worst:.0} % in the worst run); at the end {end:.2} % at most"
    );
    let by = format!("{} of {runs} runs exceed it at some output", runs - whole);
    holds_if(whole == runs, found, by).filter(|_| runs > 0)
}

fn peak(run: &PaperRun) -> String {
    let place = if run.peak.on_seam { "next to a weld" } else { "off the welds" };
    format!("{:.0} MPa {place} in {} at {:.0} mm", stress(run), run.peak.part, run.peak.at_mm)
}

fn stress_seams(case: &FactCase) -> FactFound {
    let found = at_top(case, &WELDED)?;
    let off = joined(found.iter().filter(|(_, r)| !r.peak.on_seam).map(|(kind, _)| kind.to_string()));
    holds_if(off.is_empty(), named(&found, |run| peak(run)), format!("not in the {off}"))
}

fn stress_alike(case: &FactCase) -> FactFound {
    let (mesh, runs) = case.all(&[("spam", TOP_KPA), ("epam", TOP_KPA)])?;
    let found = format!("{}: sPAM {}, ePAM {}", mesh_name(mesh), peak(runs[0]), peak(runs[1]));
    let times = stress(runs[0]) / stress(runs[1]);
    let holds = runs[0].peak.on_seam == runs[1].peak.on_seam && policy::meets(times - 1.0);
    holds_if(holds, found, format!("the sPAM's is {times:.2} times the ePAM's"))
}

fn stress_cap(case: &FactCase) -> FactFound {
    let found = at_top(case, &ROBOTS)?;
    let above = found.iter().any(|(_, run)| stress(run) > case.number(0));
    let words = named(&found, |run| format!("{:.0}", stress(run)));
    holds_if(above, format!("largest, MPa: {words}"), "no peak reaches the cap")
}

fn base(case: &FactCase) -> FactFound {
    // An encastre base holds a row of elements more: a robot shorter by that is lower by the square, whatever its base does.
    let change = |held: &PaperRun| {
        let (kind, kpa) = (held.run.actuator.as_str(), held.end()?.actuator_kpa);
        let pinned = height(find(case.runs, kind, held.run.mesh_mm, kpa)?);
        let shorter = (1.0 - held.run.mesh_mm[1] / held.run.stations_mm.last()?).powi(2);
        let (share, beyond) = (height(held) / pinned - 1.0, height(held) / (shorter * pinned) - 1.0);
        let words = format!("{} {:+.1} % ({:+.1})", printed(kind), 100.0 * share, 100.0 * beyond);
        Some((format!("{words} at {kpa:.0} kPa"), beyond.abs()))
    };
    let (words, beyond): (Vec<String>, Vec<f64>) = case.runs.iter().filter(|r| r.encastre).filter_map(change).unzip();
    let largest = beyond.into_iter().reduce(f64::max)?;
    let found = format!("encastre against pinned (beyond the row that it holds): {}", words.join(", "));
    holds_if(policy::is_none(largest), found, format!("up to {:.1} % beyond that row", 100.0 * largest))
}

/// Volume that the bodies lose between filling and 30 kPa.
fn section(case: &FactCase) -> FactFound {
    let lost = |run: &PaperRun| {
        let filled = run.run.states.first().map_or(f64::NAN, |s| s.body_cm3);
        1.0 - run.end().map_or(f64::NAN, |s| s.body_cm3) / filled
    };
    let found = at_top(case, &ROBOTS)?;
    let own = lost(found.iter().find(|(kind, _)| *kind == printed("spam"))?.1);
    let words = named(&found, |run| format!("{:.1} %", 100.0 * lost(run)));
    let found = format!("the body loses of its volume at 30 kPa, its bend included: {words}");
    let by = format!("{:.1} % is more than {:.0} %", 100.0 * own, 100.0 * policy::LITTLE);
    holds_if(policy::is_little(own), found, by)
}
