//! Rigid bodies, ties, prescribed motion, mass scaling, sealed air: each against one line of theory.

use super::apart::{masses, momentum};
use super::setup::*;
use fem::mesh::{Tie, generate};
use fem::problem::Gas;
use fem::vec3::{V3, cross, dot, sub};
use models::fabrics::Orthotropic;

pub(super) const RIGID: Check = Check::quick(
    "rigid-body",
    "A spinning rigid plate in free fall follows g t²/2 and keeps its angular momentum and its distances.",
    "Euler's equations without moment",
    rigid,
);

pub(super) const TIES: Check = Check::quick(
    "ties",
    "A strip of two meshes tied edge to edge stretches like one mesh.",
    "E A/L of a strip; work of the clamp is the energy stored",
    ties,
);

pub(super) const SCALED: Check = Check::quick(
    "mass-scaling",
    "Masses raised for twice the step give twice the step and report three times the mass added.",
    "dt = 2 sqrt(m/k)",
    scaled,
);

pub(super) const SEALED: Check =
    Check::quick("sealed-chamber", "A sealed ball pushed in at the top keeps (p + p_atm) V.", "Boyle's law", sealed);

fn film() -> Arc<Orthotropic> {
    Arc::new(Orthotropic::isotropic(1e8, 0.0, 2e-4))
}

fn rigid() -> CheckResult {
    let mut mesh = generate::plate(0.06, 0.03, 6, 3, None)?;
    name_all(&mut mesh);
    let mass = masses(&mesh, &[0.2]);
    let total: f64 = mass.iter().sum();
    let mut problem = Problem::new("rigid", mesh.clone(), vec![section(film(), 0.0)], vec![]);
    problem.rigid = vec![Rigid { set: "all".into() }];
    problem.gravity = Some(Gravity { g_m_s2: [0.0, 0.0, -9.81], amplitude: Amplitude::Constant(1.0) });
    let mut run = Simulation::new(&problem)?;
    // About the middle axis, with a small component off it: the plate tumbles.
    let (centre, omega) = ([0.03, 0.015, 0.0], [3.0, 300.0, 2.0]);
    let spin: Vec<V3> = mesh.points.iter().map(|p| cross(omega, sub(*p, centre))).collect();
    let start = angular(&mass, &mesh.points, &spin, centre);
    run.set_velocities(&spin);
    advance(&mut run, 0.2)?;
    let (x, v) = (run.positions(), run.velocities());
    let middle = momentum(&mass, &x).map(|m| m / total);
    // Velocities belong to half a step before the positions.
    let half: Vec<V3> = x.iter().zip(&v).map(|(x, v)| [0, 1, 2].map(|k| x[k] - 0.5 * run.dt_s() * v[k])).collect();
    let half_centre = momentum(&mass, &half).map(|m| m / total);
    let end = angular(&mass, &half, &v, half_centre);
    let change = sub(end, start);
    let size = |a: V3| dot(a, a).sqrt();
    let apart = |x: &[V3]| size(sub(x[0], x[x.len() - 1]));
    let t = run.time_s();
    Ok(vec![
        CheckedNumber::value("fall of the centre [mm]", -1e3 * middle[2], 1e3 * 0.5 * 9.81 * t * t, 1e-6),
        CheckedNumber::at_most("change of angular momentum, share", size(change) / size(start), 1e-4),
        CheckedNumber::at_most("change of the diagonal, share", (apart(&x) / apart(&mesh.points) - 1.0).abs(), 1e-12),
        balance(run.ledger().residual_share()),
    ]
    .into())
}

/// Angular momentum about a point \[kg m²/s\].
fn angular(mass: &[f64], x: &[V3], v: &[V3], about: V3) -> V3 {
    let mut sum = [0.0; 3];
    for ((m, x), v) in mass.iter().zip(x).zip(v) {
        let moment = cross(sub(*x, about), *v);
        (0..3).for_each(|k| sum[k] += m * moment[k]);
    }
    sum
}

const PULL_M: f64 = 1e-4;

fn ties() -> CheckResult {
    let mut lines = Vec::new();
    let mut found = Vec::new();
    for (name, mesh) in [("one mesh", generate::plate(0.1, 0.02, 20, 4, None)?), ("tied", tied()?)] {
        let mut problem = problem(name, mesh, section(film(), 0.0), vec![]);
        let (left, right) = if name == "tied" { ("left_a", "right_b") } else { ("left", "right") };
        problem.supports = vec![hold(left, [true; 3]), drive(right, [true; 3], 0, rise(0.01, PULL_M))];
        problem.settings.mass_damping_1_s = 2000.0;
        let mut run = Simulation::new(&problem)?;
        advance(&mut run, 0.015)?;
        let force = pull_n(&run, right);
        let exact = 1e8 * 0.02 * 2e-4 * PULL_M / 0.1;
        lines.push(CheckedNumber::value(format!("{name}: force [N]"), force, exact, 0.01));
        let row = |name: &str| energy_j(&run, name);
        let kept = row("supports") - row("mass damping") - row("viscosity");
        let stored = 0.5 * exact * PULL_M;
        let work = format!("{name}: work of the support less damping [µJ]");
        lines.push(CheckedNumber::value(work, 1e6 * kept, 1e6 * stored, 0.01));
        lines.push(CheckedNumber::value(
            format!("{name}: energy stored [µJ]"),
            1e6 * row("membrane"),
            1e6 * stored,
            0.01,
        ));
        found.push(force);
    }
    lines.push(CheckedNumber::value("force of the tied strip against the whole one [N]", found[1], found[0], 1e-3));
    Ok(lines.into())
}

/// Two halves: `b` is twice as fine as `a`, and its left edge follows the right edge of `a`.
pub(crate) fn tied() -> Result<Mesh, FemError> {
    let half = |name: &str, n: usize, shift: f64| -> Result<Mesh, FemError> {
        let mut mesh = generate::plate(0.05, 0.02, 10 * n, 4 * n, None)?;
        mesh.points.iter_mut().for_each(|p| p[0] += shift);
        mesh.parts[0].name = name.into();
        mesh.sets = mesh.sets.into_iter().map(|(set, nodes)| (format!("{set}_{name}"), nodes)).collect();
        Ok(mesh)
    };
    let mut mesh = half("a", 1, 0.0)?;
    mesh.append(half("b", 2, 0.05)?)?;
    let (coarse, fine) = (mesh.sets["right_a"].clone(), mesh.sets["left_b"].clone());
    for (i, node) in fine.into_iter().enumerate() {
        let to = match i % 2 {
            0 => vec![(coarse[i / 2], 1.0)],
            _ => vec![(coarse[i / 2], 0.5), (coarse[i / 2 + 1], 0.5)],
        };
        mesh.ties.push(Tie { node, to });
    }
    Ok(mesh)
}

fn scaled() -> CheckResult {
    let mesh = generate::plate(0.1, 0.1, 10, 10, None)?;
    let mut problem = Problem::new("scaled", mesh, vec![section(film(), 0.0)], vec![]);
    // Viscosity, too, needs mass for a longer step, but less.
    problem.settings.viscosity = 0.0;
    let plain = Simulation::new(&problem)?;
    problem.settings.mass_scaling = MassScaling::TargetStep(2.0 * plain.dt_s());
    let target = Simulation::new(&problem)?;
    problem.settings.mass_scaling = MassScaling::Fixed(9.0);
    let fixed = Simulation::new(&problem)?;
    Ok(vec![
        CheckedNumber::value("step for the asked one", target.dt_s() / plain.dt_s(), 2.0, 1e-9),
        CheckedNumber::value("mass added for twice the step", target.added_mass(), 3.0, 1e-9),
        CheckedNumber::value("step with nine times the mass", fixed.dt_s() / plain.dt_s(), 3.0, 1e-9),
        CheckedNumber::value("mass added", fixed.added_mass(), 8.0, 1e-9),
    ]
    .into())
}

fn sealed() -> CheckResult {
    let mesh = generate::sphere(0.05, 8)?;
    let filling = rise(0.01, 5e3);
    let pressure = Pressure::Sealed { filling, sealed_at_s: 0.02, gas: Gas::default() };
    let air = Chamber { name: "air".into(), pressure, open_axis: None };
    let mut problem = problem("sealed", mesh, section(film(), 0.1), vec![air]);
    let push = Amplitude::Smooth(vec![(0.02, 0.0), (0.06, -0.02)]);
    problem.supports = vec![hold("bottom", [true; 3]), drive("top", [true; 3], 2, push)];
    problem.settings.mass_damping_1_s = 200.0;
    let mut run = Simulation::new(&problem)?;
    advance(&mut run, 0.021)?;
    let content =
        |run: &Simulation| run.chambers().iter().map(|c| (c.pressure_pa + 101_325.0) * c.volume_m3).sum::<f64>();
    let (start, before) = (content(&run), run.chambers()[0].volume_m3);
    let mut worst = 0.0_f64;
    for i in 1..=20 {
        advance(&mut run, 0.021 + 0.002 * f64::from(i))?;
        worst = worst.max((content(&run) / start - 1.0).abs());
    }
    let lost = 1.0 - run.chambers()[0].volume_m3 / before;
    Ok(vec![
        CheckedNumber::at_most("change of (p + p_atm) V, share", worst, 1e-6),
        CheckedNumber::at_least("volume pushed out, share", lost, 0.005),
        balance(run.ledger().residual_share()),
    ]
    .into())
}
