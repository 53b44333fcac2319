//! What the checks of inflated structures share.

use std::sync::Arc;

use models::{Fabric, Pose, Term};

use fem::problem::{Amplitude, Chamber, Ply, Pressure, Section, Support};
use fem::sheet::Sheet;
use fem::sheet::order::{Order, renumber};
use fem::{FemError, Mesh, NODE, Problem, Simulation};

/// One sheet without rest curvature, 1000 kg/m³.
pub(super) fn section(fabric: Arc<dyn Fabric>, bending_factor: f64) -> Section {
    let plies = vec![Ply { fabric, angle_rad: 0.0 }];
    Section { plies, bonded: true, density_kg_m3: 1000.0, bending_factor, rest_curvature: false }
}

/// A closed chamber whose pressure \[Pa\] goes smoothly through (time \[s\], value) points.
pub(super) fn chamber(name: &str, points: Vec<(f64, f64)>) -> Chamber {
    Chamber { name: name.into(), pressure: Pressure::Set(Amplitude::Smooth(points)), open_axis: None }
}

/// Nodes of a set that do not move along the marked axes.
pub(super) fn hold(set: &str, axes: [bool; 3]) -> Support {
    Support { set: set.into(), axes, motion: None }
}

/// Nodes of a set; none if there is no such set, which makes every mean not a number and the check fail.
pub(super) fn nodes<'a>(mesh: &'a Mesh, set: &str) -> &'a [u32] {
    mesh.sets.get(set).map_or(&[], Vec::as_slice)
}

/// Mean coordinate of a node set.
pub(super) fn mean(mesh: &Mesh, set: &str, x: &[[f64; 3]], axis: usize) -> f64 {
    let nodes = nodes(mesh, set);
    nodes.iter().map(|n| x[*n as usize][axis]).sum::<f64>() / nodes.len() as f64
}

/// Runs to a time.
pub(super) fn advance(run: &mut Simulation, time_s: f64) -> Result<(), FemError> {
    run.advance_until(time_s, &mut |_| true).map(|_| ())
}

/// Forces of the shells on their nodes at rest \[N\], in mesh order: at a support, what the structure pushes with.
pub(super) fn node_forces(problem: &Problem, x: &[[f64; 3]], time_s: f64) -> Result<Vec<[f64; 3]>, FemError> {
    let order = Order::of(&problem.mesh);
    let mesh = renumber(&problem.mesh, &order);
    let mut sheet = Sheet::new(&mesh, &order, &problem.sections, &problem.chambers, &problem.settings)?;
    sheet.air.iter_mut().for_each(|air| air.set_pressure(time_s));
    let mut q = vec![[0.0; NODE]; x.len()];
    for (place, x) in order.new.iter().zip(x) {
        q[*place as usize][..3].copy_from_slice(x);
    }
    let mut force = vec![[0.0; NODE]; x.len()];
    sheet.add(&Pose::nodes(q.as_flattened()), force.as_flattened_mut());
    Ok(order.new.iter().map(|place| force[*place as usize]).map(|f| [f[0], f[1], f[2]]).collect())
}
