//! The four robots of du Pasquier, Jeong, Okamura 2023 as recommended: their books close, and the ePAM's folds resist.
//!
//! Whether they bend as far as measured does not check the engine: it depends mostly on assumed numbers. `ibr compare --engines` compares
//! them with the published displacements, with the interval that the assumed numbers leave.

use super::setup::*;
use fem::robot::{RobotSettings, sections, shipped};
use fem::sheet::Element;
use fem::sheet::reference::bending_stiffness;
use fem::terms::edge_stiffness_n;
use fem::vec3::{V3, add, along, dot, node, norm, scale, sub};
use models::Fabric;
use std::collections::BTreeMap;

pub(super) const CHECK: Check = Check::slow(
    "robots",
    "The four robots at 30 kPa are at rest, lose no energy and do not lean on hourglass control.",
    "energy balance",
    run,
);

pub(super) const FOLDS: Check = Check::slow(
    "robot-folds",
    "The ePAM's folds at 10 kPa hold the energy that its shape and tensions ask for; with ten times the stiffness it bends less.",
    "sum over all welds of the fold on a mesh, which tends to the elastica's 4 √(D T) (1 − cos ½φ)",
    folds,
);

const ROBOTS: [&str; 4] = ["spam", "cpam", "epam", "fpam"];

/// A robot at the end of its ramp.
struct RampEnd {
    run: Simulation,
    problem: Problem,
    /// Height of the outermost marker \[mm\].
    y_mm: f64,
}

fn run() -> CheckResult {
    let (mut lines, mut tips) = (Vec::new(), Vec::new());
    for (k, name) in ROBOTS.into_iter().enumerate() {
        let end = bend(name, &RobotSettings::default())?;
        let ledger = end.run.ledger();
        let of = |what: &str| format!("{name}: {what}");
        lines.extend([
            CheckedNumber::at_most(of("kinetic share at the end"), ledger.kinetic_share(), 0.01),
            CheckedNumber::at_most(of("energy residual over external work"), ledger.residual_share(), 1e-3),
            CheckedNumber::at_most(of("hourglass share of stored energy"), ledger.hourglass_share(), 0.05),
        ]);
        tips.push([k as f64 + 1.0, end.y_mm]);
    }
    let axes = ["sPAM, cPAM, ePAM, fPAM", "outermost marker [mm]"];
    let curves = vec![FigureCurve::engine("finite elements", tips)];
    Ok(CheckOutcome::drawn(lines, Figure::new("Four robots at 30 kPa, as recommended", axes, curves)))
}

fn folds() -> CheckResult {
    // Without wrinkles below the mesh, so that the elements' shape gives the tension next to a fold.
    let low = RobotSettings { actuator_pa: 10e3, wrinkle_length: None, ..RobotSettings::default() };
    let stiff = RobotSettings { bending_factor: 10.0 * low.bending_factor, ..low.clone() };
    let [soft, stiff] = [bend("epam", &low)?, bend("epam", &stiff)?];
    let stored = |end: &RampEnd| energy_j(&end.run, "folds");
    Ok(vec![
        CheckedNumber::value("energy of the folds [mJ]", 1e3 * stored(&soft), 1e3 * folds_j(&soft)?, 0.03),
        CheckedNumber::value(
            "the same, ten times the stiffness [mJ]",
            1e3 * stored(&stiff),
            1e3 * folds_j(&stiff)?,
            0.03,
        ),
        CheckedNumber::at_least("less height with ten times the stiffness", 1.0 - stiff.y_mm / soft.y_mm, 0.1),
    ]
    .into())
}

/// Σ b 4 k (1 − cos ½φ) over the edges where the stiffness jumps, k of both sides in series on this mesh \[J\]; angles between the
/// elements' directions across the edge and tensions by their fabric, both from the deformed mesh and not from the engine's rows.
fn folds_j(end: &RampEnd) -> Result<f64, FemError> {
    let problem = &end.problem;
    let (sheet, mesh, order) = shells(problem)?;
    let x = ordered(&order, &end.run.positions());
    let stiffness: Vec<f64> = problem.sections.iter().map(bending_stiffness).collect();
    let mut beside: BTreeMap<[u32; 2], Vec<&Element>> = BTreeMap::new();
    for element in &sheet.elements {
        let nodes = element.nodes();
        for k in 0..nodes.len() {
            let (a, b) = (nodes[k], nodes[(k + 1) % nodes.len()]);
            beside.entry([a.min(b), a.max(b)]).or_default().push(element);
        }
    }
    let of = |e: &&Element| stiffness[e.part];
    let mut sum = 0.0;
    for (ends, elements) in beside {
        let Some(hard) = elements.iter().copied().max_by(|a, b| of(a).total_cmp(&of(b))) else { continue };
        for soft in elements.iter().copied().filter(|e| of(e) < 0.999 * of(&hard)) {
            let [a, b] = [soft, hard].map(|e| across(ends, e, |n| node(&x, n as usize)));
            let turn = std::f64::consts::PI - (dot(a, b) / (norm(a) * norm(b))).clamp(-1.0, 1.0).acos();
            let [soft, hard] = [soft, hard].map(|e| {
                let reference = across(ends, e, |n| mesh.points[n as usize]);
                let pull = pull_n_m(e, &*sheet.fabrics[e.part], scale(reference, 1.0 / norm(reference)), &x);
                edge_stiffness_n(of(&e), pull, norm(reference))
            });
            let length = norm(sub(mesh.points[ends[1] as usize], mesh.points[ends[0] as usize]));
            sum += length * 4.0 * soft * hard / (soft + hard) * (1.0 - (0.5 * turn).cos());
        }
    }
    Ok(sum)
}

/// From an edge to the middle of the element's other corners, perpendicular to the edge \[m\].
fn across(ends: [u32; 2], element: &Element, at: impl Fn(u32) -> V3) -> V3 {
    let others: Vec<V3> = element.nodes().iter().filter(|n| !ends.contains(n)).map(|n| at(*n)).collect();
    let far = others.iter().fold([0.0; 3], |sum, p| along(sum, 1.0 / others.len() as f64, *p));
    let reach = sub(far, scale(add(at(ends[0]), at(ends[1])), 0.5));
    let edge = sub(at(ends[1]), at(ends[0]));
    along(reach, -dot(reach, edge) / dot(edge, edge), edge)
}

/// Tension of an element along a direction of its reference shape \[N/m\].
fn pull_n_m(element: &Element, fabric: &dyn Fabric, direction: V3, x: &[[f64; 4]]) -> f64 {
    let f = element.deformation(x);
    let s = fabric.tension([0.5 * (dot(f[0], f[0]) - 1.0), 0.5 * (dot(f[1], f[1]) - 1.0), dot(f[0], f[1])], &[0.0; 2]);
    let [a, b] = [0, 1].map(|k| dot(direction, element.reference.axes[k]));
    (a * a * s[0] + b * b * s[1] + 2.0 * a * b * s[2]).max(0.0)
}

/// A robot at the end of one ramp, at rest.
fn bend(name: &str, settings: &RobotSettings) -> Result<RampEnd, FemError> {
    let (scenario, mut problem) = shipped(name, settings)?;
    problem.settings.threads = 1;
    let last = scenario.markers_m.last().copied().unwrap_or(scenario.length_m);
    let line = sections(&problem.mesh, &[last, scenario.length_m])?;
    let mut run = Simulation::new(&problem)?;
    let start = line.at(&run.positions())?;
    advance(&mut run, problem.settings.end_s)?;
    run.wait_until(0.1, problem.settings.end_s, &mut |_| true)?;
    let end = line.at(&run.positions())?;
    Ok(RampEnd { run, problem, y_mm: 1e3 * (end[0][1] - start[0][1]) })
}
