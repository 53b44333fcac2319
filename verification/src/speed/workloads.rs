//! Workloads whose speed is measured: what `ibr bench fem` and `benches/fem.rs` run.

use std::sync::Arc;

use models::fabrics::{NeoHookean, Orthotropic};

use fem::mesh::generate;
use fem::problem::{Amplitude, Chamber, Contact, Problem, Section};
use fem::{FemError, Simulation};

/// The square airbag of the wrinkling literature (`fem/cases/pillow.toml`) with `n` × `n` quadrilaterals per layer.
///
/// # Errors
/// As the generator.
pub fn pillow(n: usize, bending: bool) -> Result<Problem, FemError> {
    let fabric = Arc::new(Orthotropic::isotropic(588e6, 0.4, 0.6e-3));
    let ramp = Amplitude::Smooth(vec![(0.0, 0.0), (0.05, 5e3)]);
    let mesh = generate::pillow(0.8485, n, 0.0)?;
    let name = mesh.parts[0].back.clone().unwrap_or_default();
    let air = Chamber::of(&name, ramp);
    let sections = vec![Section::of(fabric, if bending { 0.01 } else { 0.0 }); mesh.parts.len()];
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
    let fabric = Arc::new(NeoHookean::new(50.3e6, 2e-4));
    let mesh = generate::folded_pouch(&generate::FoldedPouch {
        length_m: 0.06,
        width_m: 0.06,
        fold_m: 0.024,
        gap_m: 1e-5,
        along: (0.06 / element_m).round() as usize,
        in_fold: (0.024 / element_m).round() as usize,
    })?;
    let air = Chamber::of("air", Amplitude::Smooth(vec![(0.0, 0.0), (0.05, 30e3)]));
    let sections = vec![Section::of(fabric, 0.1); mesh.parts.len()];
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
