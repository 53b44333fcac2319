//! Mylar balloon: two discs that pleat all over, resolved in two ways.
//!
//! 1. A film that carries compression, with an imperfection, pleats at the scale of the mesh.
//! 2. A tension-field film (1 % of its compressive stiffness left) needs no pleats; viscosity and mass damping calm it.
//!
//! **Where a film pleats at the scale of the mesh, the hourglass coefficient must not exceed a tenth of p R/(E t).** Only their
//! ratio counts, and a finer mesh does not help: three times more costs 3 % of the radius, ten times 6 %.

use super::setup::*;
use crate::exact::balloon::{Elastic, elastic};
use models::Fabric;
use models::fabrics::{Orthotropic, TensionField};

pub(super) const CHECK: Check = Check::slow(
    "mylar-balloon",
    "Two discs welded at the rim are inflated: radius, thickness and volume, with pleats and with a tension field.",
    "Paulsen 1994, for elastic film in verification::exact::balloon",
    run,
);

const RADIUS_M: f64 = 0.1;
const YOUNG_PA: f64 = 300e6;
const POISSON: f64 = 0.3;
const THICKNESS_M: f64 = 1e-4;
/// Load of the soft film, p R0/(E t).
const LOAD: f64 = 0.01;

fn run() -> CheckResult {
    let film = Orthotropic::isotropic(YOUNG_PA, POISSON, THICKNESS_M);
    let field = TensionField::new(film, 0.01).map_err(FemError::Problem)?;
    let exact = elastic(LOAD, POISSON);
    let mut lines = compared("pleats", &inflate(Arc::new(film), 24)?, &exact);
    lines.extend(compared("tension field", &inflate(Arc::new(field), 16)?, &exact));
    Ok(lines.into())
}

fn compared(how: &str, [radius, thickness, volume]: &[f64; 3], exact: &Elastic) -> Vec<CheckedNumber> {
    vec![
        CheckedNumber::value(format!("radius of the rim over R0, {how}"), *radius, exact.radius, 0.02),
        CheckedNumber::value(format!("thickness over R0, {how}"), *thickness, exact.thickness, 0.02),
        CheckedNumber::value(format!("volume over R0³, {how}"), *volume, exact.volume, 0.02),
    ]
}

/// Radius, thickness and volume in units of R0.
fn inflate(fabric: Arc<dyn Fabric>, n: usize) -> Result<[f64; 3], FemError> {
    let pressure = LOAD * YOUNG_PA * THICKNESS_M / RADIUS_M;
    let air = chamber("air", rise(0.02, pressure));
    let mesh = generate::disc_balloon(RADIUS_M, n)?;
    let mut problem = problem("Mylar balloon", mesh, section(fabric, 0.0), vec![air]);
    problem.settings.mass_damping_1_s = 300.0;
    problem.settings.hourglass = 0.001;
    problem.settings.imperfection = 0.01;
    let mut run = Simulation::new(&problem)?;
    advance(&mut run, 0.06)?;
    let (mesh, x) = (&problem.mesh, run.positions());
    let rim = nodes(mesh, "rim");
    let radius = rim.iter().map(|n| x[*n as usize][0].hypot(x[*n as usize][1])).sum::<f64>() / rim.len() as f64;
    let thickness = mean(mesh, "centre_top", &x, 2) - mean(mesh, "centre_bottom", &x, 2);
    let volume = volume_m3(&run);
    Ok([radius / RADIUS_M, thickness / RADIUS_M, volume / RADIUS_M.powi(3)])
}
