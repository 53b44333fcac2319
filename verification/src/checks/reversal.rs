//! A fabric whose way back is nine times as steep as the way there, turned round at once.

use super::setup::*;
use models::fabrics::{Curve, Woven, Yarn};

pub(super) const CHECK: Check = Check::quick(
    "reversal",
    "A woven strip is pulled, and suddenly let back along an unloading curve that is nine times as steep as loading.",
    "the curves of the law themselves; loss is the area between them",
    run,
);

const LENGTH_M: f64 = 0.04;
const SECTION_M2: f64 = 0.02 * 2e-4;
/// Strain at which the strip turns, and when \[s\].
const TURN: (f64, f64) = (0.1, 0.05);

fn run() -> CheckResult {
    let table = |rows: &[[f64; 2]]| Curve::table(rows).map_err(FemError::Problem);
    let load = table(&[[0.0, 0.0], [0.1, 10e6]])?;
    let back = table(&[[0.0, 0.0], [0.09, 0.5e6], [0.1, 10e6]])?;
    let yarn = || Yarn::new(load.clone(), Some(back.clone())).map_err(FemError::Problem);
    let fabric = Woven::new([yarn()?, yarn()?], Curve::linear(1e7), 0.0, 2e-4).map_err(FemError::Problem)?;
    let mesh = generate::plate(LENGTH_M, 0.02, 8, 4, None)?;
    let mut problem = problem("reversal", mesh, section(Arc::new(fabric), 0.1), vec![]);
    let way = TURN.0 * LENGTH_M;
    let there_and_back = Amplitude::Linear(vec![(0.0, 0.0), (TURN.1, way), (2.0 * TURN.1, 0.0)]);
    problem.supports = vec![hold("left", [true; 3]), drive("right", [true; 3], 0, there_and_back)];
    (problem.settings.end_s, problem.settings.mass_damping_1_s) = (2.0 * TURN.1, 500.0);
    let mut lines = Vec::new();
    for (name, problem) in each_mass(&problem)? {
        let mut run = Simulation::new(&problem)?;
        for (strain, there) in [(0.06, true), (0.095, false), (0.06, false)] {
            let time_s = TURN.1 * if there { strain / TURN.0 } else { 2.0 - strain / TURN.0 };
            advance(&mut run, time_s)?;
            let exact = SECTION_M2 * if there { load.value(strain) } else { back.value(strain) };
            let what = format!("{name}: force at {strain}{} [N]", if there { "" } else { " on the way back" });
            lines.push(CheckedNumber::value(what, pull_n(&run, "right"), exact, 0.03));
        }
        advance(&mut run, problem.settings.end_s)?;
        let lost = SECTION_M2 * LENGTH_M * (load.integral(TURN.0) - back.integral(TURN.0));
        let found = energy_j(&run, "fabric hysteresis");
        lines.push(CheckedNumber::value(format!("{name}: energy lost [mJ]"), 1e3 * found, 1e3 * lost, 0.01));
        lines.push(balance(run.ledger().residual_share()));
    }
    Ok(lines.into())
}
