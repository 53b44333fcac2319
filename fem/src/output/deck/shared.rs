//! What both decks have in common: numbers, names, nodes, plates, loads.

use crate::Problem;
use crate::amplitude::Amplitude;
use crate::mesh::{Mesh, Part};
use crate::problem::{MassScaling, Pressure, Section};
use crate::sheet::reference::bending_stiffness;
use crate::vec3::{V3, area, direction, dot};

/// Rows that stand for one stretch of a curve that the format does not know.
const ROWS: usize = 40;

/// Characters of a number that CalculiX reads.
const FIELD: usize = 20;

/// Share of the size of the mesh below which a coordinate is rounding.
const ROUNDING: f64 = 1e-12;

/// The program that reads the deck.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Solver {
    /// Abaqus/Explicit: the elements as they are, one step of central differences.
    #[default]
    Abaqus,
    /// CalculiX 2.20: quadratic elements, hinges between parts, one implicit dynamic step.
    CalculiX,
}

pub(super) fn heading(problem: &Problem) -> String {
    format!(
        "*HEADING\n{}\n** Units: m, kg, s, N, Pa. Linear fabrics at rest; shells are plates of the same stiffness in plane and in \
         bending.\n",
        problem.name.replace(['\n', '*'], " ")
    )
}

pub(super) fn label(name: &str) -> String {
    let plain = name.chars().all(|c| c.is_ascii_alphanumeric() || "_-.".contains(c));
    if plain { name.into() } else { format!("\"{}\"", name.replace('"', "'")) }
}

/// As many digits as a field of [`FIELD`] characters holds: at least 13.
pub(super) fn number(x: f64) -> String {
    let shortest = format!("{x:?}");
    let mut shorter = (0..=16).rev().map(|digits| format!("{x:.digits$e}"));
    if shortest.len() <= FIELD { shortest } else { shorter.find(|text| text.len() <= FIELD).unwrap_or(shortest) }
}

pub(super) fn row(numbers: &[f64]) -> String {
    numbers.iter().map(|x| number(*x)).collect::<Vec<_>>().join(", ")
}

/// Node numbers from 0 as the format counts them, from 1.
pub(super) fn numbers(nodes: &[u32]) -> String {
    nodes.iter().map(|n| (u64::from(*n) + 1).to_string()).collect::<Vec<_>>().join(", ")
}

pub(super) fn place(problem: &Problem, node: u32) -> V3 {
    problem.mesh.start_of(node as usize)
}

/// Start places; coordinates that are negligible compared with the size of the mesh are 0.
pub(super) fn places(out: &mut String, problem: &Problem) {
    let points = &problem.mesh.points;
    let size = points.as_flattened().iter().fold(0.0, |most: f64, x| most.max(x.abs()));
    *out += "*NODE\n";
    for i in 0..points.len() as u32 {
        let place = place(problem, i).map(|x| if x.abs() < ROUNDING * size { 0.0 } else { x });
        *out += &format!("{}, {}\n", i + 1, row(&place));
    }
}

/// Ties a node's translations to another node.
pub(super) fn follow(out: &mut String, node: u32, first: u32) {
    for axis in 1..=3 {
        *out += &format!("*EQUATION\n2\n{}, {axis}, -1.0, {}, {axis}, 1.0\n", node + 1, first + 1);
    }
}

pub(super) fn node_set(out: &mut String, name: &str, nodes: &[u32]) {
    *out += &format!("*NSET, NSET={name}\n");
    in_rows(out, nodes);
}

/// Numbers of a set, 16 a row.
pub(super) fn in_rows(out: &mut String, members: &[u32]) {
    members.chunks(16).for_each(|row| *out += &format!("{},\n", numbers(row)));
}

pub(super) fn surfaces(out: &mut String, problem: &Problem) {
    for chamber in &problem.chambers {
        *out += &format!("*SURFACE, TYPE=ELEMENT, NAME={}\n", label(&chamber.name));
        for part in &problem.mesh.parts {
            let [front, back] = [&part.front, &part.back].map(|name| name.as_deref() == Some(&chamber.name));
            if front != back {
                *out += &format!("{}, {}\n", label(&part.name), if back { "SNEG" } else { "SPOS" });
            }
        }
    }
}

/// In-plane stiffness of a section in the axes of the part's warp, (11, 22, 12, 66, 16, 26) \[N/m\].
fn in_plane(section: &Section) -> [f64; 6] {
    let mut sum = [[0.0; 3]; 3];
    for ply in &section.plies {
        let a = ply.fabric.tangent([0.0; 3], &[0.0; 2]);
        let (s, c) = ply.angle_rad.sin_cos();
        // Strains (E₁₁, E₂₂, 2E₁₂) in the axes of the ply from strains in the axes of the part.
        let turn = [[c * c, s * s, c * s], [s * s, c * c, -c * s], [-2.0 * c * s, 2.0 * c * s, c * c - s * s]];
        for (i, row) in sum.iter_mut().enumerate() {
            for (j, entry) in row.iter_mut().enumerate() {
                *entry += (0..9).map(|k| turn[k / 3][i] * a[k / 3][k % 3] * turn[k % 3][j]).sum::<f64>();
            }
        }
    }
    [sum[0][0], sum[1][1], sum[0][1], sum[2][2], sum[0][2], sum[1][2]]
}

/// The plate that replaces a section.
pub(super) struct Plate {
    pub(super) thickness_m: f64,
    /// Moduli along warp and fill, and in shear \[Pa\].
    pub(super) moduli_pa: [f64; 3],
    pub(super) nu12: f64,
    pub(super) density_kg_m3: f64,
    /// False for a membrane, which has its own thickness.
    pub(super) bends: bool,
}

pub(super) fn plate(section: &Section) -> Plate {
    let [a11, a22, a12, a66, ..] = in_plane(section);
    let (bending, own): (f64, f64) =
        (bending_stiffness(section), section.plies.iter().map(|ply| ply.fabric.thickness_m()).sum());
    let t = if bending > 0.0 { (24.0 * bending / (a11 + a22)).sqrt() } else { own };
    let both = a11 * a22 - a12 * a12;
    let moduli_pa = [both / (a22 * t), both / (a11 * t), a66 / t];
    let density_kg_m3 = section.density_kg_m3 * own / t;
    Plate { thickness_m: t, moduli_pa, nu12: a12 / a22, density_kg_m3, bends: bending > 0.0 }
}

/// Times and values of a curve, straight between them.
fn table(amplitude: &Amplitude, end_s: f64) -> Vec<(f64, f64)> {
    match amplitude {
        Amplitude::Constant(value) => vec![(0.0, *value), (end_s, *value)],
        Amplitude::Linear(points) => points.clone(),
        Amplitude::Smooth(points) | Amplitude::Growing { points, .. } => {
            let stretch = |pair: &[(f64, f64)]| {
                let (from, to) = (pair[0].0, pair[1].0);
                (0..ROWS).map(|k| from + (to - from) * k as f64 / ROWS as f64).collect::<Vec<f64>>()
            };
            let times = points.windows(2).flat_map(stretch).chain(points.last().map(|point| point.0));
            times.map(|t| (t, amplitude.at(t))).collect()
        }
    }
}

/// The curve of a load; CalculiX knows tables only.
fn curve(out: &mut String, name: &str, amplitude: &Amplitude, problem: &Problem, solver: Solver) {
    let (kind, points) = match (solver, amplitude) {
        (Solver::Abaqus, Amplitude::Smooth(points)) => (", DEFINITION=SMOOTH STEP", points.clone()),
        (Solver::Abaqus, _) => (", DEFINITION=TABULAR", table(amplitude, problem.settings.end_s)),
        (Solver::CalculiX, _) => ("", table(amplitude, problem.settings.end_s)),
    };
    *out += &format!("*AMPLITUDE, NAME={name}{kind}\n");
    points.iter().for_each(|(t, value)| *out += &(row(&[*t, *value]) + "\n"));
}

/// Supports and curves before the step, what they act on in it.
pub(super) fn loads(out: &mut String, step: &mut String, problem: &Problem, solver: Solver) {
    for (index, support) in problem.supports.iter().enumerate() {
        for axis in (0..3).filter(|axis| support.axes[*axis]) {
            let (name, dof) = (format!("support_{}", index + 1), axis + 1);
            let set = if solver == Solver::Abaqus { label(&support.set) } else { own(&name) };
            let Some(motion) = &support.motion else {
                *out += &format!("*BOUNDARY\n{set}, {dof}, {dof}\n");
                continue;
            };
            curve(out, &format!("{name}_{dof}"), &motion[axis], problem, solver);
            *step += &format!("*BOUNDARY, AMPLITUDE={name}_{dof}\n{set}, {dof}, {dof}, 1.\n");
        }
    }
    for (number, chamber) in (1..).zip(&problem.chambers) {
        let (name, walls) = (format!("pressure_{number}"), label(&chamber.name));
        curve(out, &name, chamber.pressure.filling(), problem, solver);
        *step += &format!("*DSLOAD, AMPLITUDE={name}\n{walls}, P, 1.\n");
    }
    for (index, force) in (1..).zip(&problem.forces) {
        let (name, set) = (format!("force_{index}"), label(&force.set));
        curve(out, &name, &force.amplitude, problem, solver);
        *step += &format!("*CLOAD, AMPLITUDE={name}\n");
        let nodes = problem.mesh.sets.get(&force.set).map_or(1, Vec::len) as f64;
        for (dof, n) in (1..).zip(force.total_n).filter(|(_, n)| *n != 0.0) {
            *step += &format!("{set}, {dof}, {}\n", number(n / nodes));
        }
    }
    if let Some(gravity) = &problem.gravity {
        let size = gravity.g_m_s2.iter().map(|g| g * g).sum::<f64>().sqrt();
        curve(out, "gravity", &gravity.amplitude, problem, solver);
        *step += "*DLOAD, AMPLITUDE=gravity\n";
        let [x, y, z] = gravity.g_m_s2.map(|g| g / size);
        let pull = row(&[size, x, y, z]);
        for part in problem.mesh.parts.iter() {
            *step += &format!("{}, GRAV, {pull}\n", label(&part.name));
        }
    }
}

/// What the text does not say.
pub(super) fn left_out(problem: &Problem, solver: Solver) -> Vec<String> {
    let (mesh, settings) = (&problem.mesh, &problem.settings);
    let is_calculix = solver == Solver::CalculiX;
    let coupled = |section: &Section| {
        let [a11, .., a16, a26] = in_plane(section);
        a16.abs().max(a26.abs()) > 1e-6 * a11
    };
    let bends = |section: &Section| bending_stiffness(section) > 0.0;
    let flattens =
        |(part, section): (&Part, &Section)| bends(section) && !section.rest_curvature && !is_flat(mesh, part.layer);
    let flat = mesh.parts.iter().zip(&problem.sections).any(flattens);
    let membranes = is_calculix && !problem.sections.iter().all(bends);
    let sealed = problem.chambers.iter().any(|c| matches!(c.pressure, Pressure::Sealed { .. }));
    let cases = [
        (true, "curves, wrinkling and memory of fabrics: they are linear in it"),
        (problem.sections.iter().any(coupled), "shear that comes with stretch in plies at an angle"),
        (
            flat,
            "that curved sheets and corners want to be flat: in it they are free of bending as they are (rest_curvature = true)",
        ),
        (!mesh.start.is_empty(), "that the fabric is free of stress in another shape than it starts in"),
        (!mesh.membrane.is_empty(), "that wavy sheets bend from their even pattern"),
        (sealed, "that chambers are sealed: it has their pressure before"),
        (!is_calculix && !problem.rigid.is_empty(), "rigid bodies"),
        (!problem.obstacles.is_empty(), "obstacles"),
        (settings.selective_mass, "selective masses"),
        (settings.imperfection > 0.0, "random offsets of nodes"),
        (is_calculix && problem.contact.is_some(), "contact: layers pass through each other"),
        (is_calculix && settings.mass_scaling != MassScaling::None, "scaled masses: it has the true ones"),
        (membranes, "that membranes do not bend: they bend as films of their thickness"),
    ];
    cases.iter().filter(|(is, _)| *is).map(|(_, what)| (*what).to_string()).collect()
}

/// True if all elements of a layer have one normal.
fn is_flat(mesh: &Mesh, layer: u32) -> bool {
    let parts = mesh.parts.iter().filter(|part| part.layer == layer);
    let mut normals = parts.flat_map(|part| (0..part.len()).map(|i| direction(area(&mesh.places(part.nodes(i))))));
    let first = normals.next().unwrap_or_default();
    normals.all(|normal| dot(normal, first) > 1.0 - ROUNDING)
}

/// A name that no set of the problem has.
pub(super) fn own(name: &str) -> String {
    format!("ibr_{name}")
}
