//! From a problem to a run: order, masses, time step, constraints, terms.

use models::Pose;

use super::clock::{damped, give_tied_bounds, give_tied_masses, stable_step};
use super::constraint::{Driven, RigidBody, bodies, driven};
use super::reaction::Reactions;
use super::selective::Selective;
use super::team::Team;
use super::{Books, RunClock, Simulation, guard, highest};
use crate::contact::LayerContact;
use crate::contact::edges::Edges;
use crate::policy;
use crate::problem::{MassScaling, Settings};
use crate::random::gaussian;
use crate::sheet::Sheet;
use crate::sheet::order::{Order, renumber};
use crate::sheet::reference::bending_stiffness;
use crate::terms::{DeadLoads, Folds, Obstacles, RestCurvature, penalty_stiffness_n_m};
use crate::vec3::{Nodes, V3, area, norm, padded};
use crate::{FemError, Mesh, Problem, Result, Transient};

impl Simulation {
    /// Prepares a run.
    ///
    /// # Errors
    /// [`FemError::Mesh`] or [`FemError::Problem`] naming what cannot be simulated.
    pub fn new(problem: &Problem) -> Result<Simulation> {
        Simulation::prepared(problem, None)
    }

    /// The same with the masses, their added share and the first step \[s\] of an earlier run.
    pub(super) fn prepared(problem: &Problem, earlier: Option<&(Vec<f64>, f64, f64)>) -> Result<Simulation> {
        match earlier {
            None => problem.check()?,
            Some(_) => problem.check_but_obstacles()?,
        }
        let order = Order::of(&problem.mesh);
        let mut mesh = renumber(&problem.mesh, &order);
        let settings = &problem.settings;
        let mut sheet = Sheet::new(&mesh, &order, &problem.sections, &problem.chambers, settings)?;
        let count = mesh.points.len();
        let mut fixed = vec![[false; 3]; count];
        let driven = driven(problem, &mesh, &mut fixed)?;
        sheet.air.iter_mut().for_each(|air| air.cut(&mesh, &fixed));
        let mut x: Vec<[f64; 4]> = mesh.starts().into_iter().map(padded).collect();
        imperfect(&mut x, &mesh, &order, &fixed, settings.imperfection, settings.seed);
        let bent = bent(problem, &mesh, &sheet);
        let still = Still { fixed: listed(&fixed), carried: carried(problem, &mesh, &driven)? };
        let (true_mass, mass, added_mass, gain, dt_s) = masses_and_step(settings, &mesh, &sheet, &bent, &x, &still)?;
        let (mass, added_mass, dt_s) = earlier.cloned().unwrap_or((mass, added_mass, dt_s));
        mesh.start = x.iter().map(|x| [x[0], x[1], x[2]]).collect();
        let terms = terms(problem, &mesh, [&true_mass, &mass], dt_s, bent)?;
        let touching = problem.contact.as_ref();
        let contact = touching.map(|c| contact(problem, c, &mesh, &order, &mass, dt_s)).transpose()?;
        sheet.start(x.as_flattened());
        let bodies = bodies(problem, &mesh, &mass)?;
        let moved = moved(&driven, &bodies, &mesh, &mut fixed);
        let reactions = Reactions::new(problem, &mesh)?;
        let edges = touching.filter(|c| c.edges).map(|c| Edges::new(&mesh, c, &mass, dt_s, &fixed)).transpose()?;
        let mut run = Simulation {
            fixed: listed(&fixed),
            moved: listed(&moved),
            held: Vec::new(),
            arch: pulp::Arch::new(),
            tie_offset: tie_offsets(&mesh, &x),
            v: vec![[0.0; 4]; count],
            selective: still.selective(settings, &mesh, &mass).map(Selective::at_rest),
            force: vec![[0.0; 4]; count],
            clock: RunClock { dt_s, longest_s: dt_s, gain, ..RunClock::default() },
            books: Books { scale: guard::least_scale_j(problem, &mesh, &sheet, &true_mass), ..Books::default() },
            settings: settings.clone(),
            fastest_m_s: Some(settings.guards.speed_m_s).filter(|v| *v > 0.0).unwrap_or_else(|| sound_speed(&sheet)),
            added_mass,
            team: Some(Team::new(settings.threads)?),
            cpu_s: 0.0,
            order,
            mesh,
            sheet,
            terms,
            contact,
            edges,
            driven,
            bodies,
            reactions,
            mass,
            x,
        };
        if run.edges.is_some() {
            // The first step already allows for what touches.
            run.recheck()?;
        }
        Ok(run)
    }
}

/// Masses before and after scaling, ties handed over \[kg\], what scaling added over the true mass, γ of `highest`, and the first step \[s\].
type Masses = (Vec<f64>, Vec<f64>, f64, f64, f64);

/// Weights of bending in the nodes' shares of added mass, of which the one that needs least in all is taken. Smoothing in many passes helps
/// stretch more than the bending of stuck plies, which then asks for mass everywhere if all nodes are raised alike.
const BENDING: [f64; 5] = [0.0, 1.0, 3.0, 9.0, 27.0];

fn masses_and_step(
    settings: &Settings,
    mesh: &Mesh,
    sheet: &Sheet,
    bent: &[Box<dyn Transient>],
    x: &Nodes,
    still: &Still,
) -> Result<Masses> {
    let mut true_mass = sheet.masses(x.len());
    give_tied_masses(mesh, &mut true_mass);
    let pose = Pose::nodes(x.as_flattened());
    let mut others = vec![0.0; x.len()];
    bent.iter().for_each(|term| term.stiffness_bound(&pose, &mut others));
    sheet.add_gas_bound(0.0, x.as_flattened(), &mut others);
    let mut bound = others.clone();
    sheet.stiffness_bound(&pose, &mut bound);
    give_tied_bounds(mesh, &mut bound);
    let mut bending = vec![0.0; x.len()];
    sheet.add_bending_bound(&mut bending);
    give_tied_bounds(mesh, &mut bending);
    let gain = |mass: &[f64]| {
        let nodes = stable_step(&bound, mass, settings.viscosity);
        let selective = still.selective(settings, mesh, mass);
        (highest::gain(sheet, &mesh.ties, x, others.clone(), mass, nodes, selective.as_ref()), nodes)
    };
    let scaled = |weight: &f64| {
        let shares: Vec<f64> = bound.iter().zip(&bending).map(|(all, bending)| all + weight * bending).collect();
        // With masses for the shares first: what the whole mesh then gains in step, it does not need in mass.
        let (mut raised, mut mass) = (true_mass.clone(), true_mass.clone());
        scale_masses(settings, &shares, 1.0, &mut raised);
        let (gain, nodes) = gain(&raised);
        scale_masses(settings, &shares, gain * (nodes / stable_step(&shares, &raised, settings.viscosity)), &mut mass);
        let all: f64 = mass.iter().sum();
        (all, mass)
    };
    let asked = matches!(settings.mass_scaling, MassScaling::TargetStep(_));
    let weights = if asked && settings.mass_passes > 2 { &BENDING[..] } else { &BENDING[..1] };
    let lightest = weights.iter().map(scaled).min_by(|a, b| a.0.total_cmp(&b.0));
    let alone: f64 = true_mass.iter().sum();
    let (all, mass) = lightest.unwrap_or((alone, true_mass.clone()));
    let added_mass = all / alone - 1.0;
    let (gain, nodes) = gain(&mass);
    let dt_s = choose_step(gain * nodes, settings)?;
    Ok((true_mass, mass, added_mass, gain, dt_s))
}

/// What does not move as forces say.
struct Still {
    fixed: Vec<(u32, [bool; 3])>,
    /// Nodes that others set, all axes of them.
    carried: Vec<bool>,
}

impl Still {
    fn selective(&self, settings: &Settings, mesh: &Mesh, mass: &[f64]) -> Option<Selective> {
        let new = || Selective::new(mesh, mass, settings.mass_passes, &self.fixed, &self.carried);
        settings.selective_mass.then(new)
    }
}

/// Nodes of bodies, ties and moving supports.
fn carried(problem: &Problem, mesh: &Mesh, driven: &[Driven]) -> Result<Vec<bool>> {
    let mut carried = vec![false; mesh.points.len()];
    for rigid in &problem.rigid {
        for node in mesh.set(&rigid.set, "rigid")?.iter() {
            carried[*node as usize] = true;
        }
    }
    let others = driven.iter().flat_map(|d| &d.nodes).chain(mesh.ties.iter().map(|t| &t.node));
    others.for_each(|node| carried[*node as usize] = true);
    Ok(carried)
}

/// Axes whose velocities are set; `fixed` gets the nodes of bodies and ties, too.
fn moved(driven: &[Driven], bodies: &[RigidBody], mesh: &Mesh, fixed: &mut [[bool; 3]]) -> Vec<[bool; 3]> {
    let mut moved = vec![[false; 3]; fixed.len()];
    for (node, axes) in driven.iter().flat_map(|d| d.nodes.iter().map(|n| (*n, d.axes))) {
        (0..3).for_each(|k| moved[node as usize][k] |= axes[k]);
    }
    for node in bodies.iter().flat_map(|b| &b.nodes).chain(mesh.ties.iter().map(|t| &t.node)) {
        fixed[*node as usize] = [true; 3];
        moved[*node as usize] = [true; 3];
    }
    moved
}

/// Contact in the order of the run. A fault is looked for again in mesh order, so that its message has the user's
/// numbers.
fn contact(
    problem: &Problem,
    settings: &crate::problem::Contact,
    mesh: &Mesh,
    order: &Order,
    mass: &[f64],
    dt_s: f64,
) -> Result<LayerContact> {
    LayerContact::new(mesh, settings, mass, dt_s).map_err(|fault| {
        let mass: Vec<f64> = order.new.iter().map(|place| mass[*place as usize]).collect();
        let start = order.new.iter().map(|place| mesh.start[*place as usize]).collect();
        let users = Mesh { start, ..problem.mesh.clone() };
        LayerContact::new(&users, settings, &mass, dt_s).err().unwrap_or(fault)
    })
}

/// The terms in addition to shells and contact: bending first, then loads and obstacles.
fn terms(
    problem: &Problem,
    mesh: &Mesh,
    [true_mass, mass]: [&[f64]; 2],
    dt_s: f64,
    mut terms: Vec<Box<dyn Transient>>,
) -> Result<Vec<Box<dyn Transient>>> {
    if !problem.forces.is_empty() {
        terms.push(Box::new(DeadLoads::forces(mesh, &problem.forces)?));
    }
    if let Some(gravity) = &problem.gravity {
        terms.push(Box::new(DeadLoads::gravity(gravity, true_mass)?));
    }
    if !problem.obstacles.is_empty() {
        let stiffness = penalty_stiffness_n_m(mass, dt_s);
        terms.push(Box::new(Obstacles::new(mesh, &problem.obstacles, &stiffness)?));
    }
    Ok(terms)
}

/// Bending terms in addition to the shells' constant matrix.
fn bent(problem: &Problem, mesh: &Mesh, sheet: &Sheet) -> Vec<Box<dyn Transient>> {
    let mut terms: Vec<Box<dyn Transient>> = Vec::new();
    let rest = RestCurvature::new(mesh, &problem.sections);
    if !rest.is_empty() {
        terms.push(Box::new(rest));
    }
    let stiffness: Vec<f64> = problem.sections.iter().map(bending_stiffness).collect();
    let folds = Folds::new(mesh, sheet, &stiffness);
    if !folds.is_empty() {
        terms.push(Box::new(folds));
    }
    terms
}

fn choose_step(stable_s: f64, settings: &Settings) -> Result<f64> {
    let dt = settings.dt_s.unwrap_or(settings.cfl * stable_s);
    if dt > stable_s {
        return Err(FemError::Problem(format!(
            "the time step {dt:e} s is not stable: this mesh allows {stable_s:.3e} s. Leave the step out, coarsen the \
             smallest elements, or raise masses with mass_scaling"
        )));
    }
    let steps = settings.end_s / dt;
    let raised = matches!(settings.mass_scaling, MassScaling::Fixed(_));
    if steps < 1.0 || raised && policy::is_too_short(steps) {
        return Err(FemError::Problem(format!(
            "cannot follow a motion in {steps:.1} steps: the step is {dt:.3e} s and end_s is {} s (allowed with mass_scaling: {} steps \
             or more). Try: a smaller mass_scaling or target_step_s, a longer end_s, or smaller elements",
            settings.end_s,
            policy::FEWEST_STEPS
        )));
    }
    Ok(dt)
}

fn scale_masses(settings: &Settings, bound: &[f64], gain: f64, mass: &mut [f64]) {
    match settings.mass_scaling {
        MassScaling::None => {}
        MassScaling::Fixed(factor) => mass.iter_mut().for_each(|m| *m *= factor),
        MassScaling::TargetStep(asked_s) => {
            // The step used is cfl times the stable one.
            let dt = asked_s / (settings.cfl * gain * damped(settings.viscosity));
            for (m, k) in mass.iter_mut().zip(bound).filter(|(m, _)| **m > 0.0) {
                *m = m.max(0.25 * k * dt * dt);
            }
        }
    }
}

fn tie_offsets(mesh: &Mesh, x: &Nodes) -> Vec<V3> {
    let offset = |tie: &crate::mesh::Tie| {
        let own = x[tie.node as usize];
        [0, 1, 2].map(|k| own[k] - tie.to.iter().map(|(n, w)| w * x[*n as usize][k]).sum::<f64>())
    };
    mesh.ties.iter().map(offset).collect()
}

/// Nodes with at least one of these axes.
fn listed(axes: &[[bool; 3]]) -> Vec<(u32, [bool; 3])> {
    axes.iter().enumerate().filter(|(_, axes)| **axes != [false; 3]).map(|(i, axes)| (i as u32, *axes)).collect()
}

fn sound_speed(sheet: &Sheet) -> f64 {
    let speed = |(fabric, density): (&std::sync::Arc<dyn models::Fabric>, &f64)| {
        let a = fabric.tangent([0.0; 3], &[0.0; 2]);
        (a[0][0].max(a[1][1]) / density).sqrt()
    };
    sheet.fabrics.iter().zip(&sheet.areal_density).map(speed).fold(0.0, f64::max)
}

/// Moves free nodes off the start shape along the sheet's normal by normal-distributed offsets; the standard deviation
/// is `share` of the local element size. The draw of a node depends on its mesh number and the seed alone.
fn imperfect(x: &mut Nodes, mesh: &Mesh, order: &Order, fixed: &[[bool; 3]], share: f64, seed: u64) {
    if share <= 0.0 {
        return;
    }
    let mut normal = vec![[0.0; 3]; x.len()];
    for nodes in mesh.faces() {
        let corner: Vec<[f64; 3]> = nodes.iter().map(|n| mesh.start_of(*n as usize)).collect();
        let area = area(&corner);
        for node in nodes {
            for k in 0..3 {
                normal[*node as usize][k] += area[k] / corner.len() as f64;
            }
        }
    }
    for (place, (x, n)) in x.iter_mut().zip(&normal).enumerate().filter(|(place, _)| fixed[*place] == [false; 3]) {
        let area = norm(*n);
        if area > 0.0 {
            let offset = share * area.sqrt() * gaussian(seed, u64::from(order.old[place]));
            (0..3).for_each(|k| x[k] += offset * n[k] / area);
        }
    }
}
