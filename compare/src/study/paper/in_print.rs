//! Facts that the paper's own tables and sizes decide.

use super::ROBOTS;
use super::facts::{FactCase, FactCheck, FactFound, cannot_be_checked, contradicts_itself, holds_if, joined};
use crate::policy;
use crate::study::published::shipped_scenario;
use models::actuators::pattern::Pattern;
use models::fabrics::shear_modulus;
use models::{Machine, Scenario};
use std::f64::consts::{FRAC_PI_2, PI, SQRT_2};

/// Mass per volume of fabrics that no paper prints \[kg/m³\]; assumed.
const DENSITY_KG_M3: f64 = 1000.0;
const GRAVITY_M_S2: f64 = 9.81;

pub(super) const IN_PRINT: &[FactCheck] = &[
    ("area", area),
    ("same-buckling", same_buckling),
    ("accuracy-spam", |case| lowest(case, &["spam"], 0.0, "")),
    ("accuracy-cpam", |case| above(case, "cpam", case.number(1), "not above it")),
    ("drop-cpam", drop_cpam),
    ("accuracy-fpam", |case| above(case, "fpam", 0.0, EQUAL)),
    ("accuracy-material", |case| lowest(case, &["fpam"], 0.0, "")),
    ("accuracy-formed", |case| lowest(case, &["spam", "cpam", "epam"], case.number(1), "")),
    ("accuracy-lowest", |case| lowest(case, &ROBOTS, 0.0, ", which is not slight")),
    ("accuracy-epam", accuracy_epam),
    ("mesh-share", mesh_share),
    ("patterns", |_| None),
    ("axes", |_| None),
    ("threshold", threshold),
    ("oscillation", |_| {
        let why = "a larger step takes fewer steps, so its cost falls; the first half has no number to check";
        contradicts_itself("a run takes its duration over its time step", why)
    }),
    ("hold", |case| {
        let step_s = case.paper.simulation.step_s;
        let found = format!("Section III-A: the amplitude reaches 1 at t = {step_s} s, where the step ends");
        contradicts_itself(found, "no time at full pressure is left; the preset has none")
    }),
    ("moduli", moduli),
    ("shear-angle", |case| {
        let l0 = case.number(0);
        let cosine = l0 / (2.0 * l0).sqrt();
        let found = format!("a length over the root of a length: {cosine:.1} at d = 0 with L0 = {l0} mm, no cosine");
        contradicts_itself(found, "√2 L0 is meant: then the angle is 0 at d = 0")
    }),
    ("footprint", footprint),
    ("layers", layers),
    ("gravity", gravity),
];
const EQUAL: &str = "not over but equal at 30 kPa, as the abstract's \"at least\" allows";

/// Accuracies of a robot in Table III: pressure \[kPa\] and accuracy \[%\].
fn accuracies(case: &FactCase, kind: &str) -> Vec<[f64; 2]> {
    let all = case.paper.actuator(kind).map(|a| a.accuracy.iter());
    all.into_iter().flatten().map(|(pa, a)| [pa * 1e-3, 100.0 * a]).collect()
}

fn listed(accuracies: &[[f64; 2]]) -> String {
    joined(accuracies.iter().map(|[kpa, a]| format!("{a:.1} at {kpa:.0}")))
}

/// Rms relative error behind an accuracy, both in %.
fn error_pct(accuracy_pct: f64) -> f64 {
    crate::accuracy::relative_pct(0.01 * accuracy_pct)
}

/// Whether the lowest accuracy of these robots from a pressure on is the number printed.
fn lowest(case: &FactCase, kinds: &[&str], from_kpa: f64, more: &str) -> FactFound {
    let all = kinds.iter().flat_map(|kind| accuracies(case, kind)).filter(|[kpa, _]| *kpa >= from_kpa);
    let least = all.map(|[_, a]| a).fold(f64::INFINITY, f64::min);
    let found = format!("lowest of Table III: {least:.1} %, an rms error of {:.0} %{more}", error_pct(least));
    holds_if(policy::is_rounded(least, case.number(0)), found, format!("{least:.1} %"))
}

/// Whether all accuracies of a robot beyond a pressure are above the number printed.
fn above(case: &FactCase, kind: &str, beyond_kpa: f64, else_by: &str) -> FactFound {
    let all = accuracies(case, kind);
    let holds = all.iter().all(|[kpa, a]| *kpa <= beyond_kpa || *a > case.number(0) + 1e-9);
    holds_if(holds, format!("Table III [%, kPa]: {}", listed(&all)), else_by)
}

fn drop_cpam(case: &FactCase) -> FactFound {
    let [[_, low], [_, next], ..] = accuracies(case, "cpam")[..] else { return None };
    let (drop, [from, to]) = (next - low, [next, low].map(error_pct));
    let found = format!("Table III: {drop:.1} points, the rms error from {from:.0} to {to:.0} %");
    holds_if((drop - case.number(0)).abs() < 0.5, found, format!("{drop:.1} points"))
}

fn accuracy_epam(case: &FactCase) -> FactFound {
    let both = accuracies(case, "cpam").into_iter().zip(accuracies(case, "epam"));
    let gaps: Vec<f64> = both.map(|(c, e)| c[1] - e[1]).collect();
    let words = joined(gaps.iter().map(|gap| format!("{gap:.1}")));
    let found = format!("Table III: {words} points less at 10, 20, 30 kPa");
    holds_if(gaps.iter().all(|gap| *gap > 0.0), found, "not at every pressure")
}

fn same_buckling(case: &FactCase) -> FactFound {
    let all = ["cpam", "epam"].map(|kind| accuracies(case, kind));
    let holds = all.iter().all(|a| a.windows(2).take(1).all(|pair| pair[0][1] < pair[1][1]));
    let found = format!("Table III [%, kPa]: cPAM {}; ePAM {}", listed(&all[0]), listed(&all[1]));
    holds_if(holds, found, "accuracy is not lower at 10 kPa")
}

fn mesh_share(case: &FactCase) -> FactFound {
    let (mesh, robot) = (&case.paper.simulation, case.paper.actuator("epam")?);
    let shares = [mesh.body_mesh_m / robot.body_length_m, mesh.actuator_mesh_m / robot.actuator_length_m];
    let shares = shares.map(|s| 100.0 * s);
    let holds = (0..2).all(|k| (shares[k] - case.number(k)).abs() < 0.15);
    let found = format!("Table II: {:.1} and {:.1} %", shares[0], shares[1]);
    holds_if(holds, found.clone(), found)
}

fn robot(kind: &str) -> Option<(Scenario, Pattern)> {
    let scenario = shipped_scenario(kind).ok()?;
    let pattern = (scenario.actuator.kind.pattern)(&scenario.actuator.shape);
    Some((scenario, pattern))
}

fn area(case: &FactCase) -> FactFound {
    let (cpam, epam) = (robot("cpam")?.1, robot("epam")?.1);
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

fn moduli(case: &FactCase) -> FactFound {
    let (fabric, c10) = case.paper.fabrics.iter().find_map(|f| Some((f, f.c10_printed?)))?;
    let mpa = 6.0 * c10;
    let [e0, e90] = [fabric.e0_pa, fabric.e90_pa].map(|pa| 100.0 * (mpa / (pa * 1e-6) - 1.0));
    let found = format!("6 C10 = {mpa:.0} if C10 is in MPa, its unit is not printed; the engine takes C10");
    contradicts_itself(found, format!("{e0:.0} and {e90:.0} % stiffer than E0 and E90 of Table I"))
}

fn footprint(case: &FactCase) -> FactFound {
    let [pouch_m, muscle_m] = ["epam", "fpam"].map(|kind| case.paper.actuator(kind).map(|a| a.actuator_length_m));
    let (count, muscle_mm) = (case.paper.protocol.markers, muscle_m? * 1e3);
    let row_mm = count as f64 * pouch_m? * 1e3;
    let found = format!("{count} pouches of 60 mm are {row_mm:.0} mm long, the fPAM {muscle_mm:.0} mm");
    let apart = 100.0 * (row_mm / muscle_mm - 1.0);
    contradicts_itself(found, format!("{apart:.0} % apart; the number of pouches is not printed"))
}

fn layers(case: &FactCase) -> FactFound {
    let (_, pattern) = robot("cpam")?;
    let sheet = pattern.layers_at(0.5 * pattern.width_m - 1e-4);
    let found = format!("pattern: {sheet} layers of the sheet at its edge, {} with the wall", sheet + 1);
    let holds = [sheet, sheet + 1].iter().enumerate().all(|(k, n)| *n as f64 == case.number(k));
    holds_if(holds, found.clone(), found)
}

fn gravity(case: &FactCase) -> FactFound {
    let (scenario, pattern) = robot("cpam")?;
    let thickness_m = case.paper.fabrics.first()?.thickness_m;
    let (length_m, radius_m) = (scenario.length_m, scenario.radius_m);
    let area_m2 = length_m * (2.0 * PI * radius_m + pattern.sheet_width_m());
    let moment_nm = DENSITY_KG_M3 * thickness_m * area_m2 * GRAVITY_M_S2 * 0.5 * length_m;
    let share = 100.0 * moment_nm / (PI * case.paper.protocol.body_pa * radius_m.powi(3));
    let found = format!(
        "the cPAM's own weight (1000 kg/m³, assumed) has {share:.0} % of the moment π p R³ that folds its body, if it is level"
    );
    cannot_be_checked(found, "whether it bends level or upright is not printed")
}
