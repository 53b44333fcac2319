//! Pressurised closed cylinder against the exact state of its wall.

use super::setup::*;
use crate::exact::tube::{ClosedTube, Ends, inflate, wall_tension_n_per_m};
use fem::mesh::generate::{Around, Cap, Tube, tube};
use models::Fabric;
use models::fabrics::NeoHookean;

pub(super) const CHECK: Check = Check::quick(
    "tube",
    "A closed tube with stiff ends under pressure: hoop and axial stress half way, at small and at finite strain.",
    "verification::exact::tube, equilibrium of a neo-Hookean cylinder",
    run,
);

const FABRIC: NeoHookean = NeoHookean::new(50.3e6, 2e-4);
const RADIUS_M: f64 = 0.04;
const LENGTH_M: f64 = 0.24;

fn run() -> CheckResult {
    let mut lines = Vec::new();
    for pressure_pa in [2e3, 60e3] {
        let exact = exact(pressure_pa)?;
        let [hoop, axial] = half_way(pressure_pa)?;
        let kpa = 1e-3 * pressure_pa;
        lines.push(CheckedNumber::value(format!("hoop stress at {kpa} kPa [Pa]"), hoop, exact[0], 0.005));
        lines.push(CheckedNumber::value(format!("axial stress at {kpa} kPa [Pa]"), axial, exact[1], 0.005));
    }
    Ok(lines.into())
}

/// Hoop and axial Cauchy stress \[Pa\].
fn exact(pressure_pa: f64) -> Result<[f64; 2], FemError> {
    let tube = ClosedTube { radius_m: RADIUS_M, warp_angle: 0.0, fabric: &FABRIC };
    let Some(at) = inflate(&tube, pressure_pa, Ends::Free(0.0)) else {
        return Err(FemError::Problem("the exact tube bursts".into()));
    };
    let [axial, hoop, _] = wall_tension_n_per_m(&tube, &at);
    // The wall thins as its area grows.
    let thickness_m = FABRIC.thickness_m() / (at.axial_stretch * at.hoop_stretch);
    Ok([hoop / thickness_m, axial / thickness_m])
}

/// Mean principal stresses of the elements at half length.
fn half_way(pressure_pa: f64) -> Result<[f64; 2], FemError> {
    let around = Around::Even(40);
    let caps = [Cap::Quads; 2];
    let mesh = tube(&Tube { radius_m: RADIUS_M, length_m: LENGTH_M, around, along: 36, caps, warp_rad: 0.0 })?;
    let wall = middle_elements(&mesh);
    let ramp = rise(8e-3, pressure_pa);
    // A wall that wants to be flat would carry D/R³ of the pressure: 0.2 % of 2 kPa.
    let made = Section { rest_curvature: true, ..section(Arc::new(FABRIC), 1.0) };
    let mut problem = problem("tube", mesh, made, vec![chamber("body", ramp)]);
    problem.supports = vec![hold("base_cap", [true; 3])];
    problem.rigid = vec![Rigid { set: "tip_cap".into() }];
    problem.settings.end_s = 0.016;
    problem.settings.mass_damping_1_s = 3e3;
    let fields = settle(&problem)?.element_fields();
    let mean = |k: usize| wall.iter().map(|e| fields.principal_stress_pa[*e][k]).sum::<f64>() / wall.len() as f64;
    Ok([mean(0), mean(1)])
}

/// Elements of the wall that touch the ring at half length.
fn middle_elements(mesh: &Mesh) -> Vec<usize> {
    let ring = &mesh.sets["middle"];
    let wall = &mesh.parts[0];
    (0..wall.len()).filter(|i| wall.nodes(*i).iter().any(|n| ring.contains(n))).collect()
}
