//! What the checks share: sections, chambers, supports, motions, readings, shells without a run, slopes of energies, rates.

pub(super) use std::sync::Arc;

pub(super) use fem::mesh::generate;
pub(super) use fem::problem::{
    Amplitude, Chamber, Contact, Gravity, MassScaling, NodalForce, Obstacle, ObstacleShape, Ply, Pressure, Rigid,
    Section, Support,
};
pub(super) use fem::{FemError, Mesh, Problem, Simulation};

pub(super) use super::{Check, CheckOutcome, CheckResult, CheckedNumber, Figure, FigureCurve};

use fem::NODE;
use fem::sheet::Sheet;
use fem::sheet::order::{Order, renumber};
use models::{Fabric, Pose, Term};

/// One ply along the part's warp, 1000 kg/m³.
pub(super) fn section(fabric: Arc<dyn Fabric>, bending_factor: f64) -> Section {
    Section::of(fabric, bending_factor)
}

/// The same section for every part of a mesh.
pub(super) fn problem(name: &str, mesh: Mesh, section: Section, chambers: Vec<Chamber>) -> Problem {
    let sections = vec![section; mesh.parts.len()];
    Problem::new(name, mesh, sections, chambers)
}

/// From 0 smoothly to a value at a time, and there for ever.
pub(super) fn rise(time_s: f64, value: f64) -> Amplitude {
    Amplitude::Smooth(vec![(0.0, 0.0), (time_s, value)])
}

/// A closed chamber whose pressure is set \[Pa\].
pub(super) fn chamber(name: &str, pressure: Amplitude) -> Chamber {
    Chamber::of(name, pressure)
}

/// Holds the nodes of a set still.
pub(super) fn hold(set: &str, axes: [bool; 3]) -> Support {
    Support { set: set.into(), axes, motion: None }
}

/// Holds the nodes of a set along some axes and moves them along one.
pub(super) fn drive(set: &str, axes: [bool; 3], axis: usize, way: Amplitude) -> Support {
    let mut motion = [const { Amplitude::Constant(0.0) }; 3];
    motion[axis] = way;
    Support { set: set.into(), axes, motion: Some(motion) }
}

/// All nodes as the set `all`.
pub(super) fn name_all(mesh: &mut Mesh) {
    mesh.sets.insert("all".into(), (0..mesh.points.len() as u32).collect());
}

/// Nodes of a set. An unknown set has none, which makes every mean NaN and the check fail.
pub(super) fn nodes<'a>(mesh: &'a Mesh, set: &str) -> &'a [u32] {
    mesh.sets.get(set).map_or(&[], Vec::as_slice)
}

/// Mean coordinate of a node set.
pub(super) fn mean(mesh: &Mesh, set: &str, x: &[[f64; 3]], axis: usize) -> f64 {
    let nodes = nodes(mesh, set);
    nodes.iter().map(|n| x[*n as usize][axis]).sum::<f64>() / nodes.len() as f64
}

/// Volume of the first chamber \[m³\].
pub(super) fn volume_m3(run: &Simulation) -> f64 {
    run.chambers().first().map_or(f64::NAN, |air| air.volume_m3)
}

/// Force of a support along x \[N\].
pub(super) fn pull_n(run: &Simulation, set: &str) -> f64 {
    run.reaction_n(set).map_or(f64::NAN, |force| force[0])
}

/// Energy of the ledger's rows of a name \[J\].
pub(super) fn energy_j(run: &Simulation, name: &str) -> f64 {
    run.ledger().rows.iter().filter(|r| r.name == name).map(|r| r.energy_j).sum()
}

/// The same problem with every kind of mass: true, ten times, raised for twice the step, selective.
pub(super) fn each_mass(problem: &Problem) -> Result<Vec<(&'static str, Problem)>, FemError> {
    let twice = MassScaling::TargetStep(2.0 * Simulation::new(problem)?.dt_s());
    let with = |name, scaling: MassScaling, selective: bool| {
        let mut problem = problem.clone();
        (problem.settings.mass_scaling, problem.settings.selective_mass) = (scaling, selective);
        (name, problem)
    };
    Ok(vec![
        with("true masses", MassScaling::None, false),
        with("ten times the mass", MassScaling::Fixed(10.0), false),
        with("twice the step", twice, false),
        with("selective masses", MassScaling::None, true),
    ])
}

/// The energy balance, one per cent at most.
pub(super) fn balance(residual_share: f64) -> CheckedNumber {
    CheckedNumber::at_most("energy residual over external work", residual_share, 0.01)
}

pub(super) fn advance(run: &mut Simulation, time_s: f64) -> Result<(), FemError> {
    run.advance_until(time_s, &mut |_| true).map(|_| ())
}

/// A run up to the end of its time.
pub(super) fn settle(problem: &Problem) -> Result<Simulation, FemError> {
    let mut run = Simulation::new(problem)?;
    advance(&mut run, problem.settings.end_s)?;
    Ok(run)
}

/// The shells of a problem and its mesh, in the solver's node order.
pub(super) fn shells(problem: &Problem) -> Result<(Sheet, Mesh, Order), FemError> {
    let order = Order::of(&problem.mesh);
    let mesh = renumber(&problem.mesh, &order);
    let sheet = Sheet::new(&mesh, &order, &problem.sections, &problem.chambers, &problem.settings)?;
    Ok((sheet, mesh, order))
}

/// Positions of stride [`NODE`] in the solver's node order.
pub(super) fn ordered(order: &Order, x: &[[f64; 3]]) -> Vec<[f64; NODE]> {
    let mut q = vec![[0.0; NODE]; x.len()];
    order.new.iter().zip(x).for_each(|(place, x)| q[*place as usize][..3].copy_from_slice(x));
    q
}

/// Forces of the shells on their nodes at rest \[N\], in mesh order: at a support, what the structure pushes with.
pub(super) fn node_forces(problem: &Problem, x: &[[f64; 3]], time_s: f64) -> Result<Vec<[f64; 3]>, FemError> {
    let (mut sheet, _, order) = shells(problem)?;
    let (q, elements) = (ordered(&order, x), &sheet.elements);
    sheet.air.iter_mut().for_each(|air| air.advance(time_s, elements, &q));
    let mut force = vec![[0.0; NODE]; x.len()];
    sheet.add(&Pose::nodes(q.as_flattened()), force.as_flattened_mut());
    Ok(order.new.iter().map(|place| force[*place as usize]).map(|f| [f[0], f[1], f[2]]).collect())
}

/// Placed nodes as flat coordinates of stride [`NODE`].
pub(super) fn placed(points: &[[f64; 3]], place: impl Fn([f64; 3]) -> [f64; 3]) -> Vec<f64> {
    points.iter().map(|p| place(*p)).flat_map(|p| [p[0], p[1], p[2], 0.0]).collect()
}

/// Largest absolute value, NaN if any is NaN.
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
