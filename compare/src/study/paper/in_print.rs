//! Facts that the paper's own tables and sizes decide.

use super::facts::{FactCase, FactCheck, FactFound, FactVerdict};
use crate::policy;
use crate::study::published::shipped_scenario;
use models::actuators::pattern::Pattern;
use models::fabrics::shear_modulus;
use models::{Machine, Scenario};
use std::f64::consts::{FRAC_PI_2, PI, SQRT_2};

/// Mass per volume of fabrics that no paper prints \[kg/m³\]; assumed.
const DENSITY_KG_M3: f64 = 1000.0;
const GRAVITY_M_S2: f64 = 9.81;

/// By name of the fact.
pub(super) const IN_PRINT: &[FactCheck] = &[
    ("area", area),
    ("same-buckling", same_buckling),
    ("accuracy-spam", |case| lowest(case, &["spam"], 0.0)),
    ("accuracy-cpam", accuracy_cpam),
    ("drop-cpam", drop_cpam),
    ("accuracy-fpam", accuracy_fpam),
    ("accuracy-material", |case| lowest(case, &["fpam"], 0.0)),
    ("accuracy-formed", |case| lowest(case, &["spam", "cpam", "epam"], case.number(1))),
    ("accuracy-lowest", accuracy_lowest),
    ("accuracy-epam", accuracy_epam),
    ("mesh-share", mesh_share),
    ("patterns", |_| unread("readings hold no shape of the folds; the pictures of ibr simulate show them")),
    ("axes", |_| unread("readings hold no axis of the actuator")),
    ("threshold", threshold),
    ("oscillation", oscillation),
    ("hold", hold),
    ("moduli", moduli),
    ("shear-angle", shear_angle),
    ("footprint", footprint),
    ("layers", layers),
    ("gravity", gravity),
];

fn unread(why: &str) -> FactFound {
    ("–".into(), FactVerdict::CannotBeChecked(why.into()))
}

/// Accuracies of a robot: pressure \[kPa\] and accuracy \[%\].
fn accuracies(case: &FactCase, kind: &str) -> Vec<[f64; 2]> {
    let all = case.paper.actuator(kind).map(|a| a.accuracy.clone()).unwrap_or_default();
    all.into_iter().map(|(pa, a)| [pa * 1e-3, 100.0 * a]).collect()
}

fn listed(accuracies: &[[f64; 2]]) -> String {
    accuracies.iter().map(|[kpa, a]| format!("{a:.1} at {kpa:.0}")).collect::<Vec<_>>().join(", ")
}

/// Rms relative error behind an accuracy, both in %.
fn error_pct(accuracy_pct: f64) -> f64 {
    crate::accuracy::relative_pct(0.01 * accuracy_pct)
}

/// Whether the lowest accuracy of these robots from a pressure on is the number printed.
fn lowest(case: &FactCase, kinds: &[&str], from_kpa: f64) -> FactFound {
    let all = kinds.iter().flat_map(|kind| accuracies(case, kind)).filter(|[kpa, _]| *kpa >= from_kpa);
    let least = all.map(|[_, a]| a).fold(f64::INFINITY, f64::min);
    let found = format!("lowest of Table III: {least:.1} %, an rms error of {:.0} %", error_pct(least));
    (found, FactVerdict::holds_if(policy::is_rounded(least, case.number(0)), format!("{least:.1} %")))
}

fn accuracy_cpam(case: &FactCase) -> FactFound {
    let all = accuracies(case, "cpam");
    let holds = all.iter().all(|[kpa, a]| *kpa <= case.number(1) || *a > case.number(0));
    (format!("Table III [%, kPa]: {}", listed(&all)), FactVerdict::holds_if(holds, "not above it"))
}

fn drop_cpam(case: &FactCase) -> FactFound {
    let all = accuracies(case, "cpam");
    let [Some(low), Some(next)] = [all.first(), all.get(1)] else { return unread("Table III has no two pressures") };
    let drop = next[1] - low[1];
    let found = format!(
        "Table III: {drop:.1} points, the rms error from {:.0} to {:.0} %",
        error_pct(next[1]),
        error_pct(low[1])
    );
    (found, FactVerdict::holds_if((drop - case.number(0)).abs() < 0.5, format!("{drop:.1} points")))
}

fn accuracy_fpam(case: &FactCase) -> FactFound {
    let all = accuracies(case, "fpam");
    let holds = all.iter().all(|[_, a]| *a > case.number(0) + 1e-9);
    let found = format!("Table III [%, kPa]: {}", listed(&all));
    (found, FactVerdict::holds_if(holds, "not over but equal at 30 kPa, as the abstract's \"at least\" says"))
}

fn accuracy_lowest(case: &FactCase) -> FactFound {
    let (found, verdict) = lowest(case, &["spam", "cpam", "epam", "fpam"], 0.0);
    (format!("{found}, which is not slight"), verdict)
}

fn accuracy_epam(case: &FactCase) -> FactFound {
    let gaps: Vec<f64> =
        accuracies(case, "cpam").iter().zip(accuracies(case, "epam")).map(|(c, e)| c[1] - e[1]).collect();
    let words = gaps.iter().map(|gap| format!("{gap:.1}")).collect::<Vec<_>>().join(", ");
    let found = format!("Table III: {words} points less at 10, 20, 30 kPa");
    (found, FactVerdict::holds_if(gaps.iter().all(|gap| *gap > 0.0), "not at every pressure"))
}

fn same_buckling(case: &FactCase) -> FactFound {
    let all = ["cpam", "epam"].map(|kind| accuracies(case, kind));
    let holds = all.iter().all(|a| a.windows(2).take(1).all(|pair| pair[0][1] < pair[1][1]));
    let found = format!("Table III [%, kPa]: cPAM {}; ePAM {}", listed(&all[0]), listed(&all[1]));
    (found, FactVerdict::holds_if(holds, "accuracy is not lower at 10 kPa"))
}

fn mesh_share(case: &FactCase) -> FactFound {
    let (mesh, Some(robot)) = (&case.paper.simulation, case.paper.actuator("epam")) else {
        return unread("Table II has no ePAM");
    };
    let shares = [mesh.body_mesh_m / robot.body_length_m, mesh.actuator_mesh_m / robot.actuator_length_m];
    let shares = shares.map(|s| 100.0 * s);
    let holds = (0..2).all(|k| (shares[k] - case.number(k)).abs() < 0.15);
    let found = format!("Table II: {:.1} and {:.1} %", shares[0], shares[1]);
    (found.clone(), FactVerdict::holds_if(holds, found))
}

fn robot(kind: &str) -> Option<(Scenario, Pattern)> {
    let scenario = shipped_scenario(kind).ok()?;
    let pattern = (scenario.actuator.kind.pattern)(&scenario.actuator.shape);
    Some((scenario, pattern))
}

fn area(case: &FactCase) -> FactFound {
    let (Some((_, cpam)), Some((_, epam))) = (robot("cpam"), robot("epam")) else { return unread("no pattern") };
    let [folded, plain] = [&cpam, &epam].map(Pattern::sheet_width_m);
    let sheet = folded / plain;
    let whole = (folded + cpam.width_m) / (plain + epam.width_m);
    let found = format!(
        "pattern: sheet {:.0} mm round, over {:.0} mm: {sheet:.2}; with the wall below it {whole:.2}",
        folded * 1e3,
        plain * 1e3
    );
    (found, FactVerdict::holds_if((sheet - case.number(0)).abs() < 0.005, format!("{sheet:.2}")))
}

fn threshold(case: &FactCase) -> FactFound {
    let (paper, pa) = (case.paper, case.number(1) * 1e3);
    let Some(robot) = paper.actuator("fpam") else { return unread("Table II has no fPAM") };
    let fabric = paper.fabrics.iter().find(|f| f.name == robot.fabric);
    let Some((fabric, bias_pa)) = fabric.and_then(|f| Some((f, f.e45_pa?))) else {
        return unread("Table I has no E45");
    };
    let (Ok(shear_pa), Ok(shipped)) =
        (shear_modulus(fabric.e0_pa, fabric.e90_pa, bias_pa, 0.0), shipped_scenario("fpam"))
    else {
        return unread("no shear modulus follows from Table I");
    };
    let mut muscle = shipped.bare().with_effect("shear_stiffness", &[shear_pa * fabric.thickness_m]);
    (muscle.actuator.shape.width_m, muscle.actuator.shape.length_m) = (robot.width_m, robot.actuator_length_m);
    let free = Machine::new(&muscle).map_or(f64::NAN, |machine| machine.free_contraction(pa));
    let shortens = 100.0 * free;
    // Yarns at 45° at rest: ε = 1 − √2 cos α.
    let degrees = (2.0 * ((1.0 - free) / SQRT_2).acos() - FRAC_PI_2).to_degrees();
    let limit = (FRAC_PI_2 - 2.0 * ((1.0 + 0.01 * case.number(0)) / SQRT_2).acos()).to_degrees();
    let found = format!(
        "closed form, no ends: contracts by {shortens:.1} %, yarns turn by {degrees:.0}° of the {limit:.0}° at 24 % strain"
    );
    (found.clone(), FactVerdict::holds_if(degrees < limit && shortens < case.number(0), found))
}

fn oscillation(_: &FactCase) -> FactFound {
    let why = "a larger step takes fewer steps, so its cost falls; the first half has no number to check";
    ("a run takes its duration over its time step".into(), FactVerdict::ContradictsItself(why.into()))
}

fn hold(case: &FactCase) -> FactFound {
    let step_s = case.paper.simulation.step_s;
    let found = format!("Section III-A: the amplitude reaches 1 at t = {step_s} s, where the step ends");
    (found, FactVerdict::ContradictsItself("there is no time at full pressure; the preset has none".into()))
}

fn moduli(case: &FactCase) -> FactFound {
    let fabric = case.paper.fabrics.iter().find_map(|f| Some((f, f.c10_printed?)));
    let Some((fabric, c10)) = fabric else { return unread("no C10") };
    let mpa = 6.0 * c10;
    let [e0, e90] = [fabric.e0_pa, fabric.e90_pa].map(|pa| mpa / (pa * 1e-6) - 1.0);
    let found = format!("6 C10 = {mpa:.0} if C10 is in MPa, its unit is not printed; the engine takes C10");
    let why = format!("{:.0} and {:.0} % stiffer than E0 and E90 of Table I", 100.0 * e0, 100.0 * e90);
    (found, FactVerdict::ContradictsItself(why))
}

fn shear_angle(case: &FactCase) -> FactFound {
    let cosine = case.number(0) / (2.0 * case.number(0)).sqrt();
    let found =
        format!("a length over the root of a length: {cosine:.1} at d = 0 with L0 = {} mm, no cosine", case.number(0));
    (found, FactVerdict::ContradictsItself("√2 L0 is meant: then the angle is 0 at d = 0".into()))
}

fn footprint(case: &FactCase) -> FactFound {
    let [Some(pouch), Some(muscle)] = ["epam", "fpam"].map(|kind| case.paper.actuator(kind)) else {
        return unread("Table II lacks a robot");
    };
    let row_mm = case.paper.markers as f64 * pouch.actuator_length_m * 1e3;
    let muscle_mm = muscle.actuator_length_m * 1e3;
    let found = format!("{} pouches of 60 mm are {row_mm:.0} mm long, the fPAM {muscle_mm:.0} mm", case.paper.markers);
    let why = format!("{:.0} % apart; the number of pouches is not printed", 100.0 * (row_mm / muscle_mm - 1.0));
    (found, FactVerdict::ContradictsItself(why))
}

fn layers(case: &FactCase) -> FactFound {
    let Some((_, pattern)) = robot("cpam") else { return unread("no pattern") };
    let edge_m = 0.5 * pattern.width_m - 1e-4;
    let sheet = pattern.layers_at(edge_m);
    let found = format!("pattern: {sheet} layers of the sheet at its edge, {} with the wall", sheet + 1);
    let holds = [sheet, sheet + 1].iter().enumerate().all(|(k, n)| *n as f64 == case.number(k));
    (found.clone(), FactVerdict::holds_if(holds, found))
}

fn gravity(case: &FactCase) -> FactFound {
    let Some((scenario, pattern)) = robot("cpam") else { return unread("no pattern") };
    let thickness_m = case.paper.fabrics.first().map_or(0.0, |f| f.thickness_m);
    let (length_m, radius_m) = (scenario.length_m, scenario.radius_m);
    let area_m2 = length_m * (2.0 * PI * radius_m + pattern.sheet_width_m());
    let moment_nm = DENSITY_KG_M3 * thickness_m * area_m2 * GRAVITY_M_S2 * 0.5 * length_m;
    let share = 100.0 * moment_nm / (PI * case.paper.body_pressure_pa * radius_m.powi(3));
    let found = format!(
        "the cPAM's own weight (1000 kg/m³, assumed) has {share:.0} % of the moment π p R³ that folds its body, if it lies level"
    );
    (found, FactVerdict::CannotBeChecked("whether it bends level or upright is not printed".into()))
}
