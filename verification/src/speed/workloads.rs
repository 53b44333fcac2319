//! Workloads whose speed is measured: what `ibr bench fem` and `benches/fem.rs` run.
//!
//! The counts per element-step below are read off the inner loops by hand: a regular quadrilateral of an orthotropic fabric
//! with viscosity, hourglass control and pressure. Volumes, taken every eighth step, are left out.

use std::sync::Arc;

use models::fabrics::{NeoHookean, Orthotropic};

use fem::mesh::generate;
use fem::problem::{Amplitude, Chamber, Contact, Ply, Pressure, Problem, Section};
use fem::{FemError, Simulation};

/// Multiplications, additions and subtractions per quadrilateral and step: differences 15, F 18, strain 19, tension and energy
/// 14, viscosity 21, hourglass 27, tallies 9, pressure 43, corner forces 111.
pub const FLOPS_MEMBRANE: f64 = 277.0;
/// The same per node and step for bending: 13 neighbours in three directions, and its energy.
pub const FLOPS_BENDING: f64 = 13.0 * 6.0 + 6.0;
/// Per node and step: sum of the corners 15, update of four numbers with its two energies 60.
pub const FLOPS_NODE: f64 = 75.0;

/// Bytes of the arrays that one element and its node pass over per step, each access counted once per pass: node numbers
/// 17, strains 48, corner forces 192, positions and sums within the patch 120, positions, forces, velocities and mass of
/// the node 296. Repeated loads from the first cache are not counted, nor what equal elements share. Corner forces and what
/// is within the patch stay in the second cache.
pub const BYTES_MEMBRANE: f64 = 17.0 + 48.0 + 192.0 + 120.0 + 296.0;
/// More bytes for bending: K x out 24; first node and place of a stencil, one for eight nodes, 3.
pub const BYTES_BENDING: f64 = 27.0;

/// The square airbag of the wrinkling literature (`fem/cases/pillow.toml`) with `n` × `n` quadrilaterals per layer.
///
/// # Errors
/// As the generator.
pub fn pillow(n: usize, bending: bool) -> Result<Problem, FemError> {
    let fabric = Arc::new(Orthotropic::isotropic(588e6, 0.4, 0.6e-3));
    let section = Section {
        plies: vec![Ply { fabric, angle_rad: 0.0 }],
        bonded: true,
        density_kg_m3: 1000.0,
        bending_factor: if bending { 0.01 } else { 0.0 },
        rest_curvature: false,
    };
    let ramp = Amplitude::Smooth(vec![(0.0, 0.0), (0.05, 5e3)]);
    let mesh = generate::pillow(0.8485, n, 0.0)?;
    let name = mesh.parts[0].back.clone().unwrap_or_default();
    let air = Chamber { name, pressure: Pressure::Set(ramp), open_axis: None };
    let sections = vec![section; mesh.parts.len()];
    let mut problem = Problem::new("pillow", mesh, sections, vec![air]);
    problem.settings.end_s = 0.15;
    problem.settings.mass_damping_1_s = 100.0;
    Ok(problem)
}

/// A pouch with a Z-fold at each side as in an actuator: 60 by 60 mm, folds of 24 mm, four layers 0.01 mm apart that touch
/// each other, blown up to 30 kPa in 50 ms. Element size 1.5 mm makes 5.8 thousand quadrilaterals, 1 mm 13 thousand.
///
/// # Errors
/// As the generator.
pub fn folded_cpam(element_m: f64, contact: bool) -> Result<Problem, FemError> {
    let fabric = Arc::new(NeoHookean { c10_pa: 50.3e6, thickness_m: 2e-4 });
    let section = Section {
        plies: vec![Ply { fabric, angle_rad: 0.0 }],
        bonded: true,
        density_kg_m3: 1000.0,
        bending_factor: 0.1,
        rest_curvature: false,
    };
    let mesh = generate::folded_pouch(&generate::FoldedPouch {
        length_m: 0.06,
        width_m: 0.06,
        fold_m: 0.024,
        gap_m: 1e-5,
        along: (0.06 / element_m).round() as usize,
        in_fold: (0.024 / element_m).round() as usize,
    })?;
    let ramp = Amplitude::Smooth(vec![(0.0, 0.0), (0.05, 30e3)]);
    let air = Chamber { name: "air".into(), pressure: Pressure::Set(ramp), open_axis: None };
    let sections = vec![section; mesh.parts.len()];
    let mut problem = Problem::new("folded cPAM", mesh, sections, vec![air]);
    problem.contact = contact.then(Contact::default);
    problem.settings.end_s = 0.1;
    problem.settings.mass_damping_1_s = 100.0;
    Ok(problem)
}

/// Steps a run by `steps` steps of its current length and returns how many were done.
///
/// # Errors
/// As [`Simulation::advance_until`].
pub fn advance_by(run: &mut Simulation, steps: u64) -> Result<u64, FemError> {
    let from = run.step();
    run.advance_until(run.time_s() + steps as f64 * run.dt_s(), &mut |_| true)?;
    Ok(run.step() - from)
}

/// Multiplications and additions per second that one core can do in registers, half of each, not fused \[1/s\].
pub fn peak_flops() -> f64 {
    const ROUNDS: usize = 2_000_000;
    let start = std::time::Instant::now();
    let (sum, lanes) = pulp::Arch::new().dispatch(Registers { rounds: ROUNDS });
    let seconds = start.elapsed().as_secs_f64();
    std::hint::black_box(sum);
    (ROUNDS * CHAINS * 2 * lanes) as f64 / seconds
}

/// Bytes per second that one core moves through arrays of 4 MB each, as in a = b + s c \[1/s\].
pub fn stream_bytes_per_s() -> f64 {
    const ROUNDS: usize = 40;
    const COUNT: usize = 1 << 19;
    let (mut a, b, c) = (vec![0.0; COUNT], vec![1.0; COUNT], vec![2.0; COUNT]);
    let start = std::time::Instant::now();
    for round in 0..ROUNDS {
        pulp::Arch::new().dispatch(Triad { a: &mut a, b: &b, c: &c, scale: round as f64 });
    }
    let seconds = start.elapsed().as_secs_f64();
    std::hint::black_box(a[COUNT / 2]);
    (ROUNDS * COUNT * 3 * size_of::<f64>()) as f64 / seconds
}

/// Independent chains: enough to hide the latency of an addition.
const CHAINS: usize = 8;

struct Registers {
    rounds: usize,
}

impl pulp::WithSimd for Registers {
    type Output = (f64, usize);

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, simd: S) -> (f64, usize) {
        let mut chains = [simd.splat_f64s(1.0); CHAINS];
        let (grow, step) = (simd.splat_f64s(1.000_000_1), simd.splat_f64s(1e-9));
        for _ in 0..self.rounds {
            for chain in &mut chains {
                *chain = simd.add_f64s(simd.mul_f64s(*chain, grow), step);
            }
        }
        (chains.map(|chain| simd.reduce_sum_f64s(chain)).iter().sum(), S::F64_LANES)
    }
}

struct Triad<'a> {
    a: &'a mut [f64],
    b: &'a [f64],
    c: &'a [f64],
    scale: f64,
}

impl pulp::WithSimd for Triad<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, simd: S) {
        let scale = simd.splat_f64s(self.scale);
        let (a, b, c) = (S::as_mut_simd_f64s(self.a).0, S::as_simd_f64s(self.b).0, S::as_simd_f64s(self.c).0);
        for ((a, b), c) in a.iter_mut().zip(b).zip(c) {
            *a = simd.add_f64s(*b, simd.mul_f64s(scale, *c));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_workload_runs_and_keeps_its_balance() {
        let mut run = Simulation::new(&pillow(8, true).unwrap()).unwrap();
        assert_eq!(advance_by(&mut run, 300).unwrap(), 300);
        assert!(run.ledger().residual_share() < 0.02);
    }

    #[test]
    fn the_folded_workload_touches_and_keeps_its_balance() {
        let mut run = Simulation::new(&folded_cpam(4e-3, true).unwrap()).unwrap();
        run.advance_until(5e-3, &mut |_| true).unwrap();
        assert!(run.contact_pressure_pa().iter().any(|p| *p > 0.0));
        assert!(run.ledger().residual_share() < 0.02);
    }
}
