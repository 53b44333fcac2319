//! What the checks share: sections, shells without a run, slopes of energies, rates.

use std::sync::Arc;

use models::{Fabric, Pose, Term};

use fem::problem::{Amplitude, Chamber, Ply, Pressure, Problem, Section, Support};
use fem::sheet::Sheet;
use fem::sheet::order::{Order, renumber};
use fem::{FemError, Mesh, NODE, Simulation};

/// One ply along the part's warp, 1000 kg/m³.
pub(super) fn section(fabric: impl Fabric + 'static, bending_factor: f64) -> Section {
    let plies = vec![Ply { fabric: Arc::new(fabric), angle_rad: 0.0 }];
    Section { plies, bonded: true, density_kg_m3: 1000.0, bending_factor, rest_curvature: false }
}

/// A chamber whose pressure is set.
pub(super) fn chamber(name: &str, pressure: Amplitude) -> Chamber {
    Chamber { name: name.to_owned(), pressure: Pressure::Set(pressure), open_axis: None }
}

/// Holds the nodes of a set still.
pub(super) fn hold(set: &str, axes: [bool; 3]) -> Support {
    Support { set: set.to_owned(), axes, motion: None }
}

/// The shells of a problem and its mesh, in the solver's node order.
pub(super) fn shells(problem: &Problem) -> Result<(Sheet, Mesh), FemError> {
    let order = Order::of(&problem.mesh);
    let mesh = renumber(&problem.mesh, &order);
    let sheet = Sheet::new(&mesh, &order, &problem.sections, &problem.chambers, &problem.settings)?;
    Ok((sheet, mesh))
}

/// A run up to the end of its time.
pub(super) fn run(problem: &Problem) -> Result<Simulation, FemError> {
    let mut simulation = Simulation::new(problem)?;
    simulation.advance_until(problem.settings.end_s, &mut |_| true)?;
    Ok(simulation)
}

/// Node positions of stride [`NODE`].
pub(super) fn placed(points: &[[f64; 3]], place: impl Fn([f64; 3]) -> [f64; 3]) -> Vec<f64> {
    points.iter().map(|p| place(*p)).flat_map(|p| [p[0], p[1], p[2], 0.0]).collect()
}

/// Largest absolute number.
pub(super) fn largest(numbers: &[f64]) -> f64 {
    numbers.iter().fold(0.0, |m, x| if x.is_nan() { f64::NAN } else { m.max(x.abs()) })
}

/// Largest |force + ∂E/∂x| over the largest force, at `probes` coordinates spread over all; central differences of
/// fourth order with steps of `step_m`.
pub(super) fn slope_error(term: &dyn Term, q: &[f64], probes: usize, step_m: f64) -> f64 {
    let mut force = vec![0.0; q.len()];
    term.add(&Pose::nodes(q), &mut force);
    let mut error: f64 = 0.0;
    for probe in 0..probes {
        let dof = probe * 7919 % (q.len() / NODE) * NODE + probe % 3;
        let energy = |share: f64| {
            let mut moved = q.to_vec();
            moved[dof] += share * step_m;
            term.add(&Pose::nodes(&moved), &mut vec![0.0; q.len()])
        };
        let slope = (energy(-2.0) - 8.0 * energy(-1.0) + 8.0 * energy(1.0) - energy(2.0)) / (12.0 * step_m);
        error = error.max((force[dof] + slope).abs());
    }
    error / largest(&force)
}

/// Rate of convergence between two errors whose element sizes differ by `ratio`.
pub(super) fn rate(coarse: f64, fine: f64, ratio: f64) -> f64 {
    (coarse / fine).abs().ln() / ratio.ln()
}

/// A fixed pseudo-random number between −½ and ½.
pub(super) fn noise(i: usize, k: usize) -> f64 {
    ((i * 7919 + k * 104_729) as f64 * 0.618_033_988_749_9).fract() - 0.5
}
