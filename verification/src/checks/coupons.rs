//! Strips cut from a fabric and pulled: does the engine give back the moduli and the curves that went in?

use super::pulled::PulledStrip;
use super::setup::*;
use models::fabrics::{Curve as Table, NeoHookean, Orthotropic, Woven, Yarn};
use std::f64::consts::FRAC_PI_4;

pub(super) const LINEAR: Check = Check::quick(
    "coupons",
    "Strips of silicone-coated nylon cut along warp, at 45 degrees and along fill give back their three moduli.",
    "E(psi) of a linear orthotropic sheet; moduli of du Pasquier, Jeong, Okamura 2023, Table I",
    linear,
);

pub(super) const RUBBER: Check = Check::quick(
    "rubber-coupon",
    "A neo-Hookean strip stretched by 20 % follows the stress of uniaxial tension.",
    "incompressible neo-Hookean: P = 2 C10 (l - 1/l^2)",
    rubber,
);

pub(super) const WOVEN: Check = Check::quick(
    "woven-coupon",
    "A strip of woven fabric pulled along warp and let back follows both tabulated curves and loses the loop between them.",
    "the tables that went in; area between them",
    woven,
);

const AXES: [&str; 2] = ["strain [%]", "nominal stress [MPa]"];

/// Times of `n` smooth steps to given clamp displacements, each with a rest of a fourth of its duration.
fn steps(to: &[f64], step_s: f64) -> Vec<(f64, f64)> {
    let mut points = vec![(0.0, 0.0)];
    for (i, value) in to.iter().enumerate() {
        let start = i as f64 * 1.25 * step_s;
        points.extend([(start + step_s, *value), (start + 1.25 * step_s, *value)]);
    }
    points
}

fn linear() -> CheckResult {
    let fabric = Orthotropic::from_bias(96.5e6, 120e6, 4.05e6, 0.0, 5e-5).map_err(FemError::Problem)?;
    let mut outcome = CheckOutcome::default();
    for (name, turns, modulus_pa) in [("E0", 0.0, 96.5e6), ("E45", 1.0, 4.05e6), ("E90", 2.0, 120e6)] {
        // Twenty periods of the lowest stretching mode, f = c/2L.
        let step_s = 20.0 * 2.0 * 0.1 / (modulus_pa / 1000.0_f64).sqrt();
        let strip = PulledStrip {
            size_m: [0.1, 0.01],
            elements: [40, 4],
            fabric: Arc::new(fabric),
            warp_rad: turns * FRAC_PI_4,
            pull: steps(&[2e-5], step_s),
            damping_1_s: 20.0 / step_s,
        };
        let mut run = strip.start()?;
        let read = strip.read(&mut run, 1.25 * step_s)?;
        let found_mpa = read.stress_pa / read.strain * 1e-6;
        outcome.lines.push(CheckedNumber::value(format!("{name} [MPa]"), found_mpa, modulus_pa * 1e-6, 0.01));
        outcome.lines.push(balance(run.ledger().residual_share()));
    }
    Ok(outcome)
}

fn rubber() -> CheckResult {
    let fabric = NeoHookean::new(50.3e6, 2e-4);
    let step_s = 8e-3;
    let strip = PulledStrip {
        size_m: [0.08, 0.01],
        elements: [40, 5],
        fabric: Arc::new(fabric),
        warp_rad: 0.0,
        pull: steps(&[4e-3, 8e-3, 12e-3, 17e-3], step_s),
        damping_1_s: 2000.0,
    };
    let mut run = strip.start()?;
    let mut outcome = CheckOutcome::default();
    let law = |l: f64| 2.0 * fabric.c10_pa * (l - l.powi(-2));
    let mut marks = Vec::new();
    for i in 1..=4 {
        let read = strip.read(&mut run, 1.25 * step_s * f64::from(i))?;
        let stretch = 1.0 + read.strain;
        marks.push([100.0 * read.strain, read.stress_pa * 1e-6]);
        let name = format!("nominal stress at {:.1} % [MPa]", 100.0 * read.strain);
        outcome.lines.push(CheckedNumber::value(&name, read.stress_pa * 1e-6, law(stretch) * 1e-6, 0.01));
    }
    outcome.lines.push(CheckedNumber::at_least("strain reached", marks[3][0] / 100.0, 0.2));
    outcome.lines.push(balance(run.ledger().residual_share()));
    let exact = (0..=22).map(f64::from).map(|e| [e, law(1.0 + 0.01 * e) * 1e-6]);
    let curves = vec![FigureCurve::exact("2 C10 (l - 1/l²)", exact), FigureCurve::engine("engine", marks)];
    outcome.figure = Some(Figure::new("Neo-Hookean strip", AXES, curves));
    Ok(outcome)
}

/// Stress over strain pulled along warp, and the shape of the way back \[Pa\].
const LOADING: [[f64; 2]; 4] = [[0.0, 0.0], [0.01, 0.5e6], [0.03, 3e6], [0.06, 9e6]];
const UNLOADING: [[f64; 2]; 4] = [[0.0, 0.0], [0.01, 0.15e6], [0.03, 1.5e6], [0.06, 9e6]];

fn woven() -> CheckResult {
    let (load, back) = (table(&LOADING)?, table(&UNLOADING)?);
    let yarn = Yarn::new(load.clone(), Some(back.clone())).map_err(FemError::Problem)?;
    let fabric = Woven::new([yarn.clone(), yarn], Table::linear(1e6), 0.0, 5e-5).map_err(FemError::Problem)?;
    let step_s = 20e-3;
    let strains = [0.02, 0.04, 0.06, 0.045, 0.02, 0.0];
    let strip = PulledStrip {
        size_m: [0.1, 0.01],
        elements: [20, 2],
        fabric: Arc::new(fabric),
        warp_rad: 0.0,
        pull: steps(&strains.map(|e| 0.1 * e), step_s),
        damping_1_s: 500.0,
    };
    let mut run = strip.start()?;
    let mut outcome = CheckOutcome::default();
    let mut marks = Vec::new();
    for (i, strain) in strains.iter().enumerate() {
        let read = strip.read(&mut run, 1.25 * step_s * (i + 1) as f64)?;
        marks.push([100.0 * read.strain, read.stress_pa * 1e-6]);
        let (curve, way) = if i < 3 { (&load, "loading") } else { (&back, "unloading") };
        let name = format!("stress at {:.1} %, {way} [MPa]", 100.0 * strain);
        let exact = curve.value(*strain) * 1e-6;
        outcome.lines.push(match exact == 0.0 {
            true => CheckedNumber::between("stress back at no strain [MPa]", read.stress_pa * 1e-6, -0.01, 0.01),
            false => CheckedNumber::value(&name, read.stress_pa * 1e-6, exact, 0.01),
        });
    }
    let loop_j = (load.integral(0.06) - back.integral(0.06)) * 0.1 * 0.01 * 5e-5;
    let row = |name: &str| energy_j(&run, name);
    let spent_j = row("supports") - row("viscosity") - row("mass damping");
    let lost_j = row("fabric hysteresis");
    outcome.lines.push(CheckedNumber::value("energy lost in the fabric [mJ]", 1e3 * lost_j, 1e3 * loop_j, 0.01));
    outcome.lines.push(CheckedNumber::value(
        "work of the clamps over the loop [mJ]",
        1e3 * spent_j,
        1e3 * loop_j,
        0.01,
    ));
    outcome.lines.push(balance(run.ledger().residual_share()));
    let known = |name, rows: [[f64; 2]; 4]| FigureCurve::exact(name, rows.map(|r| [100.0 * r[0], 1e-6 * r[1]]));
    let tables = [known("loading, table", LOADING), known("unloading, table", UNLOADING)];
    let curves = tables.into_iter().chain([FigureCurve::engine("engine", marks)]).collect();
    outcome.figure = Some(Figure::new("Woven strip along warp", AXES, curves));
    Ok(outcome)
}

fn table(rows: &[[f64; 2]]) -> Result<Table, FemError> {
    Table::table(rows).map_err(FemError::Problem)
}
