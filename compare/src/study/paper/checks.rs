//! The checks of facts, on the finest mesh that has all runs a fact needs; three need the pattern or the fabric alone.

use super::facts::{FactCase, FactCheck, FactFound, FactRow, FactVerdict, holds_if};
use super::{Kinetic, MESHES_MM, PaperRun, ROBOTS, find, mesh_name};
use crate::accuracy::paper_accuracy;
use crate::policy;
use crate::study::published::shipped_scenario;
use data::published::printed;
use data::{Published, PublishedFact};
use models::Machine;
use models::actuators::pattern::Pattern;
use models::fabrics::shear_modulus;
use std::f64::consts::{FRAC_PI_2, SQRT_2};

const TOP_KPA: f64 = 30.0;
const WELDED: [&str; 3] = ["spam", "cpam", "epam"];
const BOTH_MESHES: &str = "run of the cPAM or the ePAM on both meshes at 30 kPa";

pub(super) const CHECKS: &[FactCheck] = &[
    ("ratio-epam", "run of both at 30 kPa on one mesh", |case| ratio(case, "epam")),
    ("ratio-spam", "run of both at 30 kPa on one mesh", |case| ratio(case, "spam")),
    ("order", "run of all four at 30 kPa on one mesh", order),
    ("area", "pattern", area),
    ("buckling", "run of the cPAM at 10 and 13 kPa on one mesh", buckling),
    ("sensitive", "run of the cPAM at 10, 13, 20 and 30 kPa", sensitive),
    ("fpam-stable", "run of the fPAM at 10, 20 and 30 kPa", fpam_stable),
    ("mesh-gain", BOTH_MESHES, mesh_gain),
    ("mesh-deeper", BOTH_MESHES, mesh_deeper),
    ("kinetic-valid", "run of any robot", |case| kinetic(case, |k| k.below_10_pct_of_internal)),
    ("kinetic-kept", "run of any robot", |case| kinetic(case, |k| k.below_1_pct_of_total)),
    ("stress-seams", "run of a welded robot at 30 kPa", stress_seams),
    ("stress-alike", "run of sPAM and ePAM at 30 kPa on one mesh", stress_alike),
    ("stress-cap", "run of a robot at 30 kPa", stress_cap),
    ("base", "run of a robot with an encastre base", base),
    ("section", "run of the sPAM at 30 kPa", section),
    ("threshold", "modulus of the fPAM's fabric", threshold),
    ("layers", "pattern", layers),
];

/// All facts of the paper with the checks of their names, in the order of its file.
pub fn facts(paper: &Published, runs: &[PaperRun]) -> Vec<FactRow> {
    let row = |fact: &PublishedFact| {
        let case = FactCase { paper, runs, numbers: &fact.numbers };
        let known = CHECKS.iter().find(|(id, ..)| *id == fact.id);
        let (needs, found) = known.map_or(("check of it", None), |(_, needs, check)| (*needs, check(&case)));
        let (found, verdict) = match found {
            Some((found, None)) => (found, FactVerdict::Holds),
            Some((found, Some(by))) => (found, FactVerdict::Misses(by)),
            None => ("–".into(), FactVerdict::CannotBeChecked(format!("no {needs}"))),
        };
        FactRow { id: fact.id.clone(), place: fact.place.clone(), says: fact.says.clone(), found, verdict }
    };
    paper.facts.iter().map(row).collect()
}

fn joined(words: impl Iterator<Item = String>) -> String {
    words.collect::<Vec<_>>().join(", ")
}

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
    let (mesh, runs) = case.all(&[("cpam", TOP_KPA), (other, TOP_KPA)])?;
    let ratio = height(runs[0]) / height(runs[1]);
    let off = ratio / case.number(0) - 1.0;
    holds_if(policy::meets(off), format!("{ratio:.2} ({})", mesh_name(mesh)), format!("{:+.0} %", 100.0 * off))
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

fn fpam_stable(case: &FactCase) -> FactFound {
    let (mesh, mm) = curve(case, "fpam", &[10.0, 20.0, TOP_KPA])?;
    let found = format!("{mesh}: {} mm at 10, 20, 30 kPa", joined(mm.iter().map(|m| format!("{m:.1}"))));
    let fall = mm.windows(2).position(|pair| pair[1] < pair[0]);
    let by = |k: usize| format!("falls by {:.0} % to {} kPa", 100.0 * (1.0 - mm[k + 1] / mm[k]), 10 * (k + 2));
    holds_if(fall.is_none(), found, fall.map_or(String::new(), by))
}

/// Accuracy of the outermost marker alone, which is what the printed displacement allows.
fn mesh_gain(case: &FactCase) -> FactFound {
    let found = on_both(case, &["cpam", "epam"], |kind, meshes| {
        let measured = [1e3 * case.paper.actuator(kind)?.d_max_m];
        let [coarse, fine] = meshes.map(|run| paper_accuracy(&[height(run)], &measured));
        Some([100.0 * coarse?, 100.0 * fine?])
    })?;
    let holds = found.iter().all(|(_, [from, to])| policy::is_almost(to - from, case.number(0)));
    let words = named(&found, |[from, to]| format!("{from:.1} to {to:.1} %"));
    let by = named(&found, |[from, to]| format!("{:+.1} points", to - from));
    holds_if(holds, format!("outermost marker alone, 4 to 4/1 mm at 30 kPa: {words}"), by)
}

fn mesh_deeper(case: &FactCase) -> FactFound {
    let found =
        on_both(case, &["cpam", "epam"], |_, [coarse, fine]| Some(100.0 * (height(fine) / height(coarse) - 1.0)))?;
    let words = named(&found, |pct| format!("{pct:+.1} %"));
    let rises = joined(found.iter().filter(|c| c.1 > 0.0).map(|(kind, _)| format!("the {kind} bends more")));
    holds_if(rises.is_empty(), format!("a larger radius is less bend; 4 to 4/1 mm: {words}"), rises)
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

fn pattern(kind: &str) -> Option<Pattern> {
    let actuator = shipped_scenario(kind).ok()?.actuator;
    Some((actuator.kind.pattern)(&actuator.shape))
}

fn area(case: &FactCase) -> FactFound {
    let (cpam, epam) = (pattern("cpam")?, pattern("epam")?);
    let [folded, plain] = [&cpam, &epam].map(Pattern::sheet_width_m);
    let (sheet, whole) = (folded / plain, (folded + cpam.width_m) / (plain + epam.width_m));
    let [folded_mm, plain_mm] = [folded * 1e3, plain * 1e3];
    let found = format!(
        "pattern: sheet {folded_mm:.0} mm round, over {plain_mm:.0} mm: {sheet:.2}; with the wall below it {whole:.2}"
    );
    holds_if((sheet - case.number(0)).abs() < 0.005, found, format!("{sheet:.2}"))
}

fn threshold(case: &FactCase) -> FactFound {
    let robot = case.paper.actuator("fpam")?;
    let fabric = case.paper.fabrics.iter().find(|f| f.name == robot.fabric)?;
    let shear_pa = shear_modulus(fabric.e0_pa, fabric.e90_pa, fabric.e45_pa?, 0.0).ok()?;
    let mut muscle = shipped_scenario("fpam").ok()?.bare();
    muscle = muscle.with_effect("shear_stiffness", &[shear_pa * fabric.thickness_m]);
    (muscle.actuator.shape.width_m, muscle.actuator.shape.length_m) = (robot.width_m, robot.actuator_length_m);
    let free = Machine::new(&muscle).map_or(f64::NAN, |machine| machine.free_contraction(case.number(1) * 1e3));
    let shortens = 100.0 * free;
    // Yarns at 45° at rest: ε = 1 − √2 cos α.
    let degrees = (2.0 * ((1.0 - free) / SQRT_2).acos() - FRAC_PI_2).to_degrees();
    let limit = (FRAC_PI_2 - 2.0 * ((1.0 + 0.01 * case.number(0)) / SQRT_2).acos()).to_degrees();
    let found = format!(
        "closed form, no ends: contracts by {shortens:.1} %, yarns turn by {degrees:.0}° of the {limit:.0}° at 24 % strain"
    );
    holds_if(degrees < limit && shortens < case.number(0), found.clone(), found)
}

fn layers(case: &FactCase) -> FactFound {
    let pattern = pattern("cpam")?;
    let sheet = pattern.layers_at(0.5 * pattern.width_m - 1e-4);
    let found = format!("pattern: {sheet} layers of the sheet at its edge, {} with the wall", sheet + 1);
    let holds = [sheet, sheet + 1].iter().enumerate().all(|(k, n)| *n as f64 == case.number(k));
    holds_if(holds, found.clone(), found)
}
