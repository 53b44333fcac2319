//! Rigid bodies, ties, prescribed motion, mass scaling, sealed air: each against one line of theory.

use std::sync::Arc;

use models::fabrics::Orthotropic;

use super::apart::{masses, momentum};
use super::pulled::{drive_x, hold, membrane};
use super::{Check, Line, Outcome};
use fem::mesh::{Tie, generate};
use fem::problem::{Amplitude, Chamber, Gravity, MassScaling, Pressure, Rigid, Section, Support};
use fem::vec3::{V3, cross, dot, sub};
use fem::{FemError, Mesh, Problem, Simulation};

pub(super) const RIGID: Check = Check {
    name: "rigid-body",
    sentence: "A spinning rigid plate in free fall follows g t²/2 and keeps its angular momentum and its distances.",
    source: "Euler's equations without moment",
    slow: false,
    run: rigid,
};

pub(super) const TIES: Check = Check {
    name: "ties",
    sentence: "A strip of two meshes tied edge to edge stretches like one mesh.",
    source: "E A/L of a strip; work of the clamp is the energy stored",
    slow: false,
    run: ties,
};

pub(super) const SCALED: Check = Check {
    name: "mass-scaling",
    sentence: "Masses raised for twice the step give twice the step and report three times the mass added.",
    source: "dt = 2 sqrt(m/k)",
    slow: false,
    run: scaled,
};

pub(super) const SEALED: Check = Check {
    name: "sealed-chamber",
    sentence: "A sealed ball pushed in at the top keeps (p + p_atm) V.",
    source: "Boyle's law",
    slow: false,
    run: sealed,
};

fn film() -> Arc<Orthotropic> {
    Arc::new(Orthotropic::isotropic(1e8, 0.0, 2e-4))
}

fn rigid() -> Result<Outcome, FemError> {
    let mut mesh = generate::plate(0.06, 0.03, 6, 3, None)?;
    mesh.sets.insert("all".into(), (0..mesh.points.len() as u32).collect());
    let mass = masses(&mesh, &[0.2]);
    let total: f64 = mass.iter().sum();
    let mut problem = Problem::new("rigid", mesh.clone(), vec![membrane(film(), 0.0)], vec![]);
    problem.rigid = vec![Rigid { set: "all".into() }];
    problem.gravity = Some(Gravity { g_m_s2: [0.0, 0.0, -9.81], amplitude: Amplitude::Constant(1.0) });
    let mut run = Simulation::new(&problem)?;
    // About the middle axis, and a little beside it: the plate tumbles.
    let (centre, omega) = ([0.03, 0.015, 0.0], [3.0, 300.0, 2.0]);
    let spin: Vec<V3> = mesh.points.iter().map(|p| cross(omega, sub(*p, centre))).collect();
    let start = angular(&mass, &mesh.points, &spin, centre);
    run.set_velocities(&spin);
    run.advance_until(0.2, &mut |_| true)?;
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
    let lines = vec![
        Line::value("fall of the centre [mm]", -1e3 * middle[2], 1e3 * 0.5 * 9.81 * t * t, 1e-6),
        Line::at_most("change of angular momentum, share", size(change) / size(start), 1e-4),
        Line::at_most("change of the diagonal, share", (apart(&x) / apart(&mesh.points) - 1.0).abs(), 1e-12),
        Line::at_most("energy residual over external work", run.ledger().residual_share(), 0.01),
    ];
    Ok(Outcome { lines, figure: None })
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

/// Lengthening of the strips \[m\].
const PULL_M: f64 = 1e-4;

fn ties() -> Result<Outcome, FemError> {
    let mut lines = Vec::new();
    let mut found = Vec::new();
    for (name, mesh) in [("one mesh", generate::plate(0.1, 0.02, 20, 4, None)?), ("tied", tied()?)] {
        let sections = mesh.parts.iter().map(|_| membrane(film(), 0.0)).collect();
        let mut problem = Problem::new(name, mesh, sections, vec![]);
        let (left, right) = if name == "tied" { ("left_a", "right_b") } else { ("left", "right") };
        problem.supports = vec![hold(left, [true; 3]), drive_x(right, vec![(0.0, 0.0), (0.01, PULL_M)])];
        problem.settings.mass_damping_1_s = 2000.0;
        let mut run = Simulation::new(&problem)?;
        run.advance_until(0.015, &mut |_| true)?;
        let force = run.reaction_n(right).map_or(f64::NAN, |f| f[0]);
        let exact = 1e8 * 0.02 * 2e-4 * PULL_M / 0.1;
        lines.push(Line::value(&format!("{name}: force [N]"), force, exact, 0.01));
        let row = |name: &str| run.ledger().rows.iter().filter(|r| r.name == name).map(|r| r.energy_j).sum::<f64>();
        let kept = row("supports") - row("mass damping") - row("viscosity");
        let stored = 0.5 * exact * PULL_M;
        lines.push(Line::value(
            &format!("{name}: work of the support less damping [µJ]"),
            1e6 * kept,
            1e6 * stored,
            0.01,
        ));
        lines.push(Line::value(&format!("{name}: energy stored [µJ]"), 1e6 * row("membrane"), 1e6 * stored, 0.01));
        found.push(force);
    }
    lines.push(Line::value("force of the tied strip against the whole one [N]", found[1], found[0], 1e-3));
    Ok(Outcome { lines, figure: None })
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

fn scaled() -> Result<Outcome, FemError> {
    let mesh = generate::plate(0.1, 0.1, 10, 10, None)?;
    let mut problem = Problem::new("scaled", mesh, vec![membrane(film(), 0.0)], vec![]);
    // Viscosity, too, needs mass for a longer step, but less.
    problem.settings.viscosity = 0.0;
    let plain = Simulation::new(&problem)?;
    problem.settings.mass_scaling = MassScaling::TargetStep(2.0 * plain.dt_s());
    let target = Simulation::new(&problem)?;
    problem.settings.mass_scaling = MassScaling::Fixed(9.0);
    let fixed = Simulation::new(&problem)?;
    let lines = vec![
        Line::value("step for the asked one", target.dt_s() / plain.dt_s(), 2.0, 1e-9),
        Line::value("mass added for twice the step", target.added_mass(), 3.0, 1e-9),
        Line::value("step with nine times the mass", fixed.dt_s() / plain.dt_s(), 3.0, 1e-9),
        Line::value("mass added", fixed.added_mass(), 8.0, 1e-9),
    ];
    Ok(Outcome { lines, figure: None })
}

fn sealed() -> Result<Outcome, FemError> {
    let mesh = generate::sphere(0.05, 8)?;
    let filling = Amplitude::Smooth(vec![(0.0, 0.0), (0.01, 5e3)]);
    let pressure = Pressure::Sealed { filling, sealed_at_s: 0.02, atmosphere_pa: 101_325.0 };
    let air = Chamber { name: "air".into(), pressure, open_axis: None };
    let section = Section { bending_factor: 0.1, ..membrane(film(), 0.0) };
    let mut problem = Problem::new("sealed", mesh, vec![section], vec![air]);
    let push = Amplitude::Smooth(vec![(0.02, 0.0), (0.06, -0.02)]);
    let still = Amplitude::Constant(0.0);
    let motion = Some([still.clone(), still, push]);
    problem.supports = vec![hold("bottom", [true; 3]), Support { set: "top".into(), axes: [true; 3], motion }];
    problem.settings.mass_damping_1_s = 200.0;
    let mut run = Simulation::new(&problem)?;
    run.advance_until(0.021, &mut |_| true)?;
    let content =
        |run: &Simulation| run.chambers().iter().map(|c| (c.pressure_pa + 101_325.0) * c.volume_m3).sum::<f64>();
    let (start, before) = (content(&run), run.chambers()[0].volume_m3);
    let mut worst = 0.0_f64;
    for i in 1..=20 {
        run.advance_until(0.021 + 0.002 * f64::from(i), &mut |_| true)?;
        worst = worst.max((content(&run) / start - 1.0).abs());
    }
    let lost = 1.0 - run.chambers()[0].volume_m3 / before;
    let lines = vec![
        Line::at_most("change of (p + p_atm) V, share", worst, 1e-6),
        Line::at_least("volume pushed out, share", lost, 0.005),
        Line::at_most("energy residual over external work", run.ledger().residual_share(), 0.01),
    ];
    Ok(Outcome { lines, figure: None })
}
