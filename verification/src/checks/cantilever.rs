//! Inflated cantilever: slope below the first wrinkle, wrinkling and collapse.
//!
//! The tip is moved and held, the force is read at the support: then every point of the curve is at rest, also where the
//! force hardly grows any more. A thick cap keeps the tip round; two opposite nodes hold it, so that it turns freely.
//!
//! The wall wrinkles ring against ring. Hourglass control resists that with a share of E t, so it must be small against the
//! tension that wrinkles, here p R/(E t) = .0013; and the wrinkles must be short against the radius.

use super::setup::*;
use crate::exact::beam::{Cantilever, collapse_tip_load_n};
use crate::exact::inflated_cantilever::tip_deflection_with_shear_m;
use fem::mesh::generate::{self, Around, Cap, Tube};
use models::fabrics::NeoHookean;
use std::f64::consts::PI;

pub(super) const SLOPE: Check = Check::quick(
    "inflated-cantilever-slope",
    "An inflated tube is clamped at one end and pushed down at the other: slope of the unwrinkled wall.",
    "beam theory with shear, F L³/(3 E t π r³) + F L/(G A/2)",
    slope,
);

pub(super) const WRINKLING: Check = Check::slow(
    "inflated-cantilever-wrinkling",
    "The inflated tube is pushed down until it wrinkles and collapses; the wall has no bending stiffness.",
    "Comer and Levy 1963; verification::exact::inflated_cantilever",
    wrinkling,
);

const BEAM: Cantilever = Cantilever {
    radius_m: 0.04,
    thickness_m: 2e-4,
    length_m: 0.36,
    young_pa: 6.0 * C10_PA,
    shear_pa: 2.0 * C10_PA,
    pressure_pa: 2e3,
};
const C10_PA: f64 = 50.3e6;
/// Pressure is on and the tube at rest.
const INFLATED_S: f64 = 0.03;
/// Time to move the tip to its next place, and to come to rest there.
const MOVE_S: f64 = 0.01;
const REST_S: f64 = 0.03;

fn slope() -> CheckResult {
    let mut run = CantileverRun::new(&Setup { around: 64, along: 36, grade: 0.0, hourglass: 0.01 }, &[at_share(0.2)])?;
    let [point] = &run.points()?[..] else { return Ok(CheckOutcome::default()) };
    let line = {
        let Cantilever { radius_m: r, thickness_m: t, length_m: l, young_pa, shear_pa, .. } = BEAM;
        l.powi(3) / (3.0 * young_pa * t * PI * r.powi(3)) + l / (0.5 * shear_pa * 2.0 * PI * r * t)
    };
    let measured = 1e3 * point.deflection_m / point.force_n;
    Ok(vec![CheckedNumber::value("tip deflection per force [mm/N]", measured, 1e3 * line, 0.02)].into())
}

fn wrinkling() -> CheckResult {
    const SHARES: [f64; 6] = [0.25, 0.5, 0.75, 0.9, 0.97, 0.99];
    let mut run =
        CantileverRun::new(&Setup { around: 48, along: 72, grade: 0.6, hourglass: 0.001 }, &SHARES.map(at_share))?;
    let points = run.points()?;
    let collapse = collapse_tip_load_n(&BEAM);
    let mut lines: Vec<CheckedNumber> = SHARES
        .iter()
        .zip(&points)
        .take(5)
        .map(|(share, point)| {
            let name = format!("force at {:.2} mm, {share} of collapse [N]", 1e3 * point.deflection_m);
            CheckedNumber::value(&name, point.force_n, share * collapse, 0.05)
        })
        .collect();
    let [wrinkled, collapsed] = [0.5, 1.0].map(|share| share * collapse * BEAM.length_m);
    lines.push(CheckedNumber::value("moment of the first wrinkle [N m]", first_wrinkle(&points), wrinkled, 0.05));
    let largest = points.iter().fold(0.0, |most: f64, p| most.max(p.force_n));
    lines.push(CheckedNumber::value("moment of collapse [N m]", largest * BEAM.length_m, collapsed, 0.05));
    lines.push(CheckedNumber::at_most("energy residual over work", run.run.ledger().residual_share(), 0.01));
    Ok(CheckOutcome::drawn(lines, figure(&points)))
}

/// Moment in the section that is looked at when its compressed side has lost its tension, from the two points before.
fn first_wrinkle(points: &[TipState]) -> f64 {
    let [a, b, ..] = points else { return f64::NAN };
    let force = a.force_n + a.tension_pa * (b.force_n - a.force_n) / (a.tension_pa - b.tension_pa);
    force * (BEAM.length_m - b.section_m)
}

fn figure(points: &[TipState]) -> Figure {
    let exact =
        (1..=99).map(|i| f64::from(i) / 100.0).map(|share| [1e3 * at_share(share), share * collapse_tip_load_n(&BEAM)]);
    let engine = points.iter().map(|p| [1e3 * p.deflection_m, p.force_n]);
    let curves =
        vec![FigureCurve::exact("Comer and Levy, with shear", exact), FigureCurve::engine("finite elements", engine)];
    Figure::new("Inflated cantilever up to collapse", ["tip deflection [mm]", "tip force [N]"], curves)
}

/// Exact tip deflection \[m\] at a share of the collapse load.
fn at_share(share: f64) -> f64 {
    tip_deflection_with_shear_m(&BEAM, share * collapse_tip_load_n(&BEAM))
}

struct Setup {
    around: usize,
    along: usize,
    /// 0 even; otherwise elements at the base are 1 − `grade` of the mean, those at the tip 1 + `grade`.
    grade: f64,
    hourglass: f64,
}

/// One place of the tip, at rest.
struct TipState {
    deflection_m: f64,
    force_n: f64,
    /// Axial stress on the compressed side of the section at `section_m` from the base.
    tension_pa: f64,
    section_m: f64,
}

struct CantileverRun {
    problem: Problem,
    run: Simulation,
    deflections_m: Vec<f64>,
    /// Element on the compressed side near the base, and its place.
    probe: (usize, f64),
}

impl CantileverRun {
    fn new(setup: &Setup, deflections_m: &[f64]) -> Result<CantileverRun, FemError> {
        let mesh = mesh(setup)?;
        // A quarter of a radius from the clamp: its effect reaches √(N R²/(E t)) = 1 mm.
        let at = |ring: usize| mesh.points[ring * setup.around][0];
        let ring = (0..setup.along).find(|ring| at(*ring) > 0.25 * BEAM.radius_m).unwrap_or(0);
        let probe = (ring * setup.around + setup.around * 3 / 4, 0.5 * (at(ring) + at(ring + 1)));
        let problem = problem(mesh, setup.hourglass, deflections_m);
        let run = Simulation::new(&problem)?;
        Ok(CantileverRun { problem, run, deflections_m: deflections_m.to_vec(), probe })
    }

    fn points(&mut self) -> Result<Vec<TipState>, FemError> {
        let mut points = Vec::new();
        for (k, deflection_m) in self.deflections_m.iter().enumerate() {
            let time = INFLATED_S + (k + 1) as f64 * (MOVE_S + REST_S);
            advance(&mut self.run, time)?;
            let forces = node_forces(&self.problem, &self.run.positions(), time)?;
            let force_n = nodes(&self.problem.mesh, "hung").iter().map(|n| forces[*n as usize][2]).sum();
            // Across the axis the wall carries p R, so the smaller principal stress is the axial one.
            let tension_pa = self.run.element_fields().principal_stress_pa[self.probe.0][1];
            points.push(TipState { deflection_m: *deflection_m, force_n, tension_pa, section_m: self.probe.1 });
        }
        Ok(points)
    }
}

fn mesh(setup: &Setup) -> Result<Mesh, FemError> {
    let mut mesh = generate::tube(&Tube {
        radius_m: BEAM.radius_m,
        length_m: BEAM.length_m,
        around: Around::Even(setup.around),
        along: setup.along,
        caps: [Cap::Triangles; 2],
        warp_rad: 0.0,
    })?;
    for point in &mut mesh.points {
        let share = point[0] / BEAM.length_m;
        point[0] = BEAM.length_m * share * (1.0 - setup.grade + setup.grade * share);
    }
    let tip = nodes(&mesh, "tip");
    let hung = [0, setup.around / 2].iter().filter_map(|i| tip.get(*i).copied()).collect();
    mesh.sets.insert("hung".into(), hung);
    Ok(mesh)
}

fn problem(mesh: Mesh, hourglass: f64, deflections_m: &[f64]) -> Problem {
    let of = |thickness_m: f64, density_kg_m3: f64| {
        let fabric = Arc::new(NeoHookean::new(C10_PA, thickness_m));
        Section { density_kg_m3, ..section(fabric, 0.0) }
    };
    // Caps are heavier so that their triangles do not limit the step; at rest that does not matter.
    let sections = vec![of(BEAM.thickness_m, 1e3), of(BEAM.thickness_m, 1e4), of(5.0 * BEAM.thickness_m, 2.5e3)];
    let air = chamber("body", rise(INFLATED_S / 3.0, BEAM.pressure_pa));
    let mut problem = Problem::new("inflated cantilever", mesh, sections, vec![air]);
    let mut way = vec![(INFLATED_S, 0.0)];
    for deflection_m in deflections_m {
        let start = way.last().map_or(0.0, |last| last.0);
        way.extend([(start + MOVE_S, -deflection_m), (start + MOVE_S + REST_S, -deflection_m)]);
    }
    problem.settings.end_s = way.last().map_or(INFLATED_S, |last| last.0);
    problem.supports =
        vec![hold("base_cap", [true; 3]), drive("hung", [false, false, true], 2, Amplitude::Smooth(way))];
    problem.settings.mass_damping_1_s = 500.0;
    problem.settings.hourglass = hourglass;
    problem.settings.imperfection = 1e-3;
    problem
}
