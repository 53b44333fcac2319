//! Fabric muscle (fPAM) free of load: a bias-cut tube with pinched ends.

use super::setup::*;
use crate::exact::tube::{ClosedTube, Ends, inflate};
use models::fabrics::Orthotropic;
use std::f64::consts::{FRAC_PI_4, PI};

pub(super) const CHECK: Check = Check::slow(
    "bias-tube",
    "A tube of bias-cut fabric shortens under pressure, then lengthens as its yarns stretch; its ends turn freely.",
    "verification::exact::tube, exact at finite strain; netting analysis with elastic yarns",
    run,
);

const FLAT_WIDTH_M: f64 = 0.06;
const LENGTH_M: f64 = 0.3;
const YARNS_PA: [f64; 2] = [96.5e6, 120e6];
const BIAS_PA: f64 = 4.05e6;
const THICKNESS_M: f64 = 5e-5;
const PRESSURES_PA: [f64; 4] = [3e3, 10e3, 20e3, 30e3];
/// Time to raise the pressure to its next value, and to come to rest.
const RISE_S: f64 = 0.05;
const REST_S: f64 = 0.05;

fn run() -> CheckResult {
    let mut lines = Vec::new();
    let mut curves = Vec::new();
    for nu12 in [0.0, 0.3] {
        let fabric = Orthotropic::from_bias(YARNS_PA[0], YARNS_PA[1], BIAS_PA, nu12, THICKNESS_M);
        let fabric = fabric.map_err(FemError::Problem)?;
        let found = contractions(fabric, &PRESSURES_PA)?;
        for (pressure, found) in PRESSURES_PA.iter().zip(&found) {
            let name = format!("contraction, ν12 = {nu12}, {} kPa", 1e-3 * pressure);
            lines.push(CheckedNumber::value(&name, *found, exact(&fabric, *pressure), 0.02));
        }
        curves.extend(pair(nu12, &fabric, &found));
    }
    let (even, pressure) = (0.5 * (YARNS_PA[0] + YARNS_PA[1]), 10e3);
    let net = Orthotropic::new(even, even, 0.0, 1e4, THICKNESS_M);
    let found = contractions(net, &[pressure])?;
    let expected = netting(pressure * FLAT_WIDTH_M / PI / (even * THICKNESS_M));
    lines.push(CheckedNumber::value("contraction of a net (G = 0.01 MPa), 10 kPa", found[0], expected, 0.02));
    Ok(CheckOutcome::drawn(lines, Figure::new("Bias-cut tube, free", ["pressure [kPa]", "contraction"], curves)))
}

fn pair(nu12: f64, fabric: &Orthotropic, found: &[f64]) -> [FigureCurve; 2] {
    let line = (1..=30).map(f64::from).map(|kpa| [kpa, exact(fabric, 1e3 * kpa)]);
    let marks = PRESSURES_PA.iter().zip(found).map(|(p, c)| [1e-3 * p, *c]);
    let [known, own] = ["exact", "finite elements"].map(|name| format!("{name}, ν12 = {nu12}"));
    [FigureCurve::exact(known, line), FigureCurve::engine(own, marks)]
}

fn exact(fabric: &Orthotropic, pressure_pa: f64) -> f64 {
    let tube = ClosedTube { radius_m: FLAT_WIDTH_M / PI, warp_angle: FRAC_PI_4, fabric };
    inflate(&tube, pressure_pa, Ends::Free(0.0)).map_or(f64::NAN, |state| state.contraction())
}

/// Contraction of a ±45° net of equal linear yarns without shear stiffness, load = p R/(E t).
///
/// Equilibrium of both directions turns the yarns to tan²β = 2, λ_c² = 2 λₓ², and stretches them to E₁₁ = load·λₓ with
/// 1 + 2E₁₁ = 3/2 λₓ²: ¾ λₓ² − load λₓ − ½ = 0. At no load 1 − √(2/3).
fn netting(load: f64) -> f64 {
    1.0 - (load + (load * load + 1.5).sqrt()) / 1.5
}

/// Contraction between the gauge rings at rest at each pressure.
fn contractions(fabric: Orthotropic, pressures_pa: &[f64]) -> Result<Vec<f64>, FemError> {
    let mesh = generate::flat_tube(FLAT_WIDTH_M, LENGTH_M, 12, 60, FRAC_PI_4, 1e-3)?;
    let mut points = vec![(0.0, 0.0)];
    for (k, pressure) in pressures_pa.iter().enumerate() {
        let start = k as f64 * (RISE_S + REST_S);
        points.extend([(start + RISE_S, *pressure), (start + RISE_S + REST_S, *pressure)]);
    }
    let mut problem =
        problem("bias tube", mesh, section(Arc::new(fabric), 0.0), vec![chamber("air", Amplitude::Smooth(points))]);
    problem.supports = vec![
        hold("anchor", [true; 3]),
        hold("anchor_end", [false, true, true]),
        hold("corners_0", [false, false, true]),
    ];
    problem.settings.mass_damping_1_s = 150.0;
    problem.settings.cfl = 0.7;
    problem.settings.imperfection = 1e-3;
    let mut run = Simulation::new(&problem)?;
    let mut found = Vec::new();
    for k in 1..=pressures_pa.len() {
        advance(&mut run, k as f64 * (RISE_S + REST_S))?;
        let x = run.positions();
        let gauge = mean(&problem.mesh, "gauge_1", &x, 0) - mean(&problem.mesh, "gauge_0", &x, 0);
        found.push(1.0 - gauge / (0.5 * LENGTH_M));
    }
    Ok(found)
}
