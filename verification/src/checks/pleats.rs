//! Sheets that pleat at the scale of the mesh, with the remedy that the engine offers for them: a tension field, and a hundredth of
//! hourglass.

use super::setup::*;
use crate::exact::balloon::elastic;
use models::fabrics::{Orthotropic, TensionField};

pub(super) const CHECK: Check = Check::slow(
    "pleats",
    "A Mylar balloon and a square teabag with the remedy for pleats, tension field and a hundredth of hourglass.",
    "Paulsen 1994 for the balloon; for the teabag the volume 0.2055 that Kepert constructed, a lower bound",
    run,
);

fn run() -> CheckResult {
    let mut lines = Vec::new();
    let (radius, modulus, thickness_m, pressure) = (0.1, 3500e6, 25e-6, 1e3);
    let [thickness, volume, share] = inflate(
        generate::disc_balloon(radius, 24)?,
        [modulus, 0.3, thickness_m],
        1.0,
        (0.02, pressure),
        (0.06, 300.0),
    )?;
    let exact = elastic(pressure * radius / (modulus * thickness_m), 0.3);
    lines.push(CheckedNumber::value("balloon: thickness over R0", thickness / radius, exact.thickness, 0.02));
    lines.push(CheckedNumber::value("balloon: volume over R0³", volume / radius.powi(3), exact.volume, 0.02));
    lines.push(CheckedNumber::at_most("balloon: hourglass share of stored energy", share, 0.15));
    let [_, volume, share] =
        inflate(generate::pillow(1.0, 32, 0.0)?, [588e6, 0.4, 6e-4], 0.1, (0.08, 1e3), (0.3, 60.0))?;
    lines.push(CheckedNumber::between(
        "teabag: volume over side³, at most 2 % below the bound",
        volume,
        0.98 * 0.2055,
        0.217,
    ));
    lines.push(CheckedNumber::at_most("teabag: hourglass share of stored energy", share, 0.15));
    Ok(lines.into())
}

/// Thickness \[m\], volume \[m³\] and the share of hourglass control.
fn inflate(
    mesh: Mesh,
    [modulus, nu, thickness_m]: [f64; 3],
    bending: f64,
    (ramp_s, pressure): (f64, f64),
    (end_s, damping): (f64, f64),
) -> Result<[f64; 3], FemError> {
    let film = Orthotropic::isotropic(modulus, nu, thickness_m);
    let field = TensionField::new(film, 0.01).map_err(FemError::Problem)?;
    let air = chamber("air", rise(ramp_s, pressure));
    let mut problem = problem("pleats", mesh, section(Arc::new(field), bending), vec![air]);
    (problem.settings.end_s, problem.settings.mass_damping_1_s) = (end_s, damping);
    problem.settings.hourglass *= 0.01;
    let run = settle(&problem)?;
    let (mesh, x) = (&problem.mesh, run.positions());
    let thickness = mean(mesh, "centre_top", &x, 2) - mean(mesh, "centre_bottom", &x, 2);
    Ok([thickness, volume_m3(&run), run.ledger().hourglass_share()])
}
