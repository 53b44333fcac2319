//! A problem as Abaqus input (`.inp`) in SI units: for another solver's opinion.
//!
//! Every part is one linear orthotropic plate with the in-plane stiffness A and the bending stiffness D of its section at rest:
//!
//! ```text
//! t = √(12 D / ½(A₁₁ + A₂₂))     E₁ = (A₁₁A₂₂ − A₁₂²)/(A₂₂ t)     E₂ = (A₁₁A₂₂ − A₁₂²)/(A₁₁ t)
//! ν₁₂ = A₁₂/A₂₂                  G₁₂ = A₆₆/t                       ρ = mass per area / t
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | A | Σ over plies of their tangents in the axes of the part's warp | N/m |
//! | D | bending stiffness, as the shells have it | N m |
//! | t | thickness of the plate | m |
//!
//! Without bending stiffness a part is a membrane of its own thickness. What does not fit into the format is told.

use std::fmt::Write;

use crate::Problem;
use crate::amplitude::Amplitude;
use crate::mesh::Part;
use crate::problem::{MassScaling, Pressure, Section};
use crate::sheet::reference::bending_stiffness;
use crate::vec3::{area, cross, direction};

/// Rows that stand for one stretch of a curve that the format does not know.
const ROWS: usize = 40;

/// The text, and what it does not say.
pub fn text(problem: &Problem) -> (String, Vec<String>) {
    let mut out = format!(
        "*HEADING\n{}\n** Units: m, kg, s, N, Pa. Linear fabrics at rest; shells are plates of the same stiffness in plane and in \
         bending.\n",
        problem.name.replace(['\n', '*'], " ")
    );
    nodes_and_elements(&mut out, problem);
    sets_and_surfaces(&mut out, problem);
    for (number, (part, section)) in problem.mesh.parts.iter().zip(&problem.sections).enumerate() {
        material(&mut out, problem, number, part, section);
    }
    let mut step = String::new();
    loads(&mut out, &mut step, problem);
    contact(&mut out, problem);
    numerics(&mut out, problem);
    out += &step;
    put(&mut out, "*OUTPUT, FIELD, NUMBER INTERVAL=20\n*NODE OUTPUT\nU, V\n*ELEMENT OUTPUT\nS, LE\n*END STEP");
    (out, left_out(problem))
}

/// A line.
fn put(out: &mut String, line: impl std::fmt::Display) {
    // Writing to a string cannot fail.
    let _ = writeln!(out, "{line}");
}

/// A name as a label.
fn label(name: &str) -> String {
    let plain = name.chars().all(|c| c.is_ascii_alphanumeric() || "_-.".contains(c));
    if plain { name.into() } else { format!("\"{}\"", name.replace('"', "'")) }
}

/// Digits that are read back to the same bits.
fn row(numbers: &[f64]) -> String {
    numbers.iter().map(|x| format!("{x:?}")).collect::<Vec<_>>().join(", ")
}

fn nodes_and_elements(out: &mut String, problem: &Problem) {
    let mesh = &problem.mesh;
    put(out, "*NODE");
    (0..mesh.points.len()).for_each(|i| put(out, format_args!("{}, {}", i + 1, row(&mesh.start_of(i)))));
    let mut first = 1;
    for (part, section) in mesh.parts.iter().zip(&problem.sections) {
        let kinds = if bending_stiffness(section) > 0.0 { ["S4R", "S3R"] } else { ["M3D4R", "M3D3"] };
        let blocks = [(kinds[0], 0..part.quads.len()), (kinds[1], part.quads.len()..part.len())];
        for (kind, elements) in blocks.into_iter().filter(|(_, elements)| !elements.is_empty()) {
            put(out, format_args!("*ELEMENT, TYPE={kind}, ELSET={}", label(&part.name)));
            for i in elements {
                let nodes: Vec<String> = part.nodes(i).iter().map(|n| (u64::from(*n) + 1).to_string()).collect();
                put(out, format_args!("{}, {}", first + i, nodes.join(", ")));
            }
        }
        first += part.len();
    }
    for tie in &mesh.ties {
        for axis in 1..=3 {
            let followed = tie.to.iter().map(|(node, weight)| format!("{}, {axis}, {weight:?}", u64::from(*node) + 1));
            let terms: Vec<String> =
                std::iter::once(format!("{}, {axis}, -1.0", u64::from(tie.node) + 1)).chain(followed).collect();
            put(out, format_args!("*EQUATION\n{}", terms.len()));
            terms.chunks(4).for_each(|terms| put(out, terms.join(", ")));
        }
    }
}

fn sets_and_surfaces(out: &mut String, problem: &Problem) {
    for (name, nodes) in problem.mesh.sets.iter().filter(|(_, nodes)| !nodes.is_empty()) {
        put(out, format_args!("*NSET, NSET={}", label(name)));
        for nodes in nodes.chunks(16) {
            let numbers: Vec<String> = nodes.iter().map(|n| (u64::from(*n) + 1).to_string()).collect();
            put(out, format_args!("{},", numbers.join(", ")));
        }
    }
    for chamber in &problem.chambers {
        put(out, format_args!("*SURFACE, TYPE=ELEMENT, NAME={}", label(&chamber.name)));
        for part in &problem.mesh.parts {
            let [front, back] = [&part.front, &part.back].map(|name| name.as_deref() == Some(&chamber.name));
            if front != back {
                put(out, format_args!("{}, {}", label(&part.name), if back { "SNEG" } else { "SPOS" }));
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
        // Strains (E₁₁, E₂₂, 2E₁₂) of the ply's axes from those of the part's.
        let turn = [[c * c, s * s, c * s], [s * s, c * c, -c * s], [-2.0 * c * s, 2.0 * c * s, c * c - s * s]];
        for (i, row) in sum.iter_mut().enumerate() {
            for (j, entry) in row.iter_mut().enumerate() {
                *entry += (0..9).map(|k| turn[k / 3][i] * a[k / 3][k % 3] * turn[k % 3][j]).sum::<f64>();
            }
        }
    }
    [sum[0][0], sum[1][1], sum[0][1], sum[2][2], sum[0][2], sum[1][2]]
}

fn material(out: &mut String, problem: &Problem, number: usize, part: &Part, section: &Section) {
    let [a11, a22, a12, a66, ..] = in_plane(section);
    let (bending, own): (f64, f64) =
        (bending_stiffness(section), section.plies.iter().map(|ply| ply.fabric.thickness_m()).sum());
    let t = if bending > 0.0 { (24.0 * bending / (a11 + a22)).sqrt() } else { own };
    let both = a11 * a22 - a12 * a12;
    let (name, g) = (label(&part.name), a66 / t);
    put(out, format_args!("*MATERIAL, NAME={name}\n*ELASTIC, TYPE=LAMINA"));
    put(out, row(&[both / (a22 * t), both / (a11 * t), a12 / a22, g, g, g]));
    put(out, format_args!("*DENSITY\n{:?},", section.density_kg_m3 * own / t));
    if problem.settings.mass_damping_1_s > 0.0 {
        put(out, format_args!("*DAMPING, ALPHA={:?}", problem.settings.mass_damping_1_s));
    }
    orientation(out, problem, number, part);
    let kind = if bending > 0.0 { "SHELL" } else { "MEMBRANE" };
    put(out, format_args!("*{kind} SECTION, ELSET={name}, MATERIAL={name}, ORIENTATION=warp_{}\n{t:?},", number + 1));
}

/// The warp of a part: x unless it says another, for all of it or by element.
fn orientation(out: &mut String, problem: &Problem, number: usize, part: &Part) {
    let name = format!("warp_{}", number + 1);
    let before: usize = problem.mesh.parts[..number].iter().map(Part::len).sum();
    let axes = |i: usize| {
        let corners: Vec<[f64; 3]> = part.nodes(i).iter().map(|n| problem.mesh.points[*n as usize]).collect();
        let warp = part.warp_of(i).unwrap_or([1.0, 0.0, 0.0]);
        let across = cross(direction(area(&corners)), warp);
        row(&[warp, if across == [0.0; 3] { [0.0, 1.0, 0.0] } else { direction(across) }].concat())
    };
    match part.warp.len() {
        0 | 1 => put(out, format_args!("*ORIENTATION, NAME={name}\n{}\n3, 0.", axes(0))),
        _ => {
            put(out, format_args!("*DISTRIBUTION TABLE, NAME={name}_table\nCOORD3D, COORD3D"));
            put(out, format_args!("*DISTRIBUTION, NAME={name}_by_element, LOCATION=ELEMENT, TABLE={name}_table"));
            put(out, format_args!(", {}", axes(0)));
            (0..part.len()).for_each(|i| put(out, format_args!("{}, {}", before + i + 1, axes(i))));
            put(out, format_args!("*ORIENTATION, NAME={name}\n{name}_by_element\n3, 0."));
        }
    }
}

fn amplitude(out: &mut String, name: &str, amplitude: &Amplitude, end_s: f64) {
    let (kind, points) = match amplitude {
        Amplitude::Constant(value) => ("TABULAR", vec![(0.0, *value), (end_s, *value)]),
        Amplitude::Smooth(points) => ("SMOOTH STEP", points.clone()),
        Amplitude::Linear(points) => ("TABULAR", points.clone()),
        Amplitude::Growing { points, .. } => {
            let stretch = |pair: &[(f64, f64)]| {
                let (from, to) = (pair[0].0, pair[1].0);
                (0..ROWS).map(|k| from + (to - from) * k as f64 / ROWS as f64).collect::<Vec<f64>>()
            };
            let times = points.windows(2).flat_map(stretch).chain(points.last().map(|point| point.0));
            ("TABULAR", times.map(|t| (t, amplitude.at(t))).collect())
        }
    };
    put(out, format_args!("*AMPLITUDE, NAME={}, DEFINITION={kind}", label(name)));
    points.iter().for_each(|(t, value)| put(out, row(&[*t, *value])));
}

/// Supports and curves before the step, what they act on in it.
fn loads(out: &mut String, step: &mut String, problem: &Problem) {
    let end_s = problem.settings.end_s;
    for (number, support) in problem.supports.iter().enumerate() {
        for axis in (0..3).filter(|axis| support.axes[*axis]) {
            let (set, dof) = (label(&support.set), axis + 1);
            match &support.motion {
                None => put(out, format_args!("*BOUNDARY\n{set}, {dof}, {dof}")),
                Some(motion) => {
                    let name = format!("support_{}_{dof}", number + 1);
                    amplitude(out, &name, &motion[axis], end_s);
                    put(step, format_args!("*BOUNDARY, AMPLITUDE={name}\n{set}, {dof}, {dof}, 1."));
                }
            }
        }
    }
    for (number, chamber) in problem.chambers.iter().enumerate() {
        let (Pressure::Set(filling) | Pressure::Sealed { filling, .. }) = &chamber.pressure;
        let name = format!("pressure_{}", number + 1);
        amplitude(out, &name, filling, end_s);
        put(step, format_args!("*DSLOAD, AMPLITUDE={name}\n{}, P, 1.", label(&chamber.name)));
    }
    for (number, force) in problem.forces.iter().enumerate() {
        let name = format!("force_{}", number + 1);
        amplitude(out, &name, &force.amplitude, end_s);
        put(step, format_args!("*CLOAD, AMPLITUDE={name}"));
        let nodes = problem.mesh.sets.get(&force.set).map_or(1, Vec::len) as f64;
        for axis in (0..3).filter(|axis| force.total_n[*axis] != 0.0) {
            put(step, format_args!("{}, {}, {:?}", label(&force.set), axis + 1, force.total_n[axis] / nodes));
        }
    }
    if let Some(gravity) = &problem.gravity {
        let size = gravity.g_m_s2.iter().map(|g| g * g).sum::<f64>().sqrt();
        amplitude(out, "gravity", &gravity.amplitude, end_s);
        put(
            step,
            format_args!("*DLOAD, AMPLITUDE=gravity\n, GRAV, {size:?}, {}", row(&gravity.g_m_s2.map(|g| g / size))),
        );
    }
}

fn contact(out: &mut String, problem: &Problem) {
    let Some(contact) = &problem.contact else { return };
    put(out, format_args!("*SURFACE INTERACTION, NAME=layers\n*FRICTION\n{:?},", contact.friction));
    put(out, "*CONTACT\n*CONTACT INCLUSIONS, ALL EXTERIOR\n*CONTACT PROPERTY ASSIGNMENT\n, , layers");
}

fn numerics(out: &mut String, problem: &Problem) {
    put(out, format_args!("*STEP, NAME=run, NLGEOM=YES\n*DYNAMIC, EXPLICIT\n, {:?}", problem.settings.end_s));
    match problem.settings.mass_scaling {
        MassScaling::None => {}
        MassScaling::Fixed(factor) => put(out, format_args!("*FIXED MASS SCALING, FACTOR={factor:?}")),
        MassScaling::TargetStep(dt) => put(out, format_args!("*FIXED MASS SCALING, DT={dt:?}, TYPE=BELOW MIN")),
    }
}

/// What the text does not say.
fn left_out(problem: &Problem) -> Vec<String> {
    let (mesh, settings) = (&problem.mesh, &problem.settings);
    let coupled = |section: &Section| {
        let [a11, .., a16, a26] = in_plane(section);
        a16.abs().max(a26.abs()) > 1e-6 * a11
    };
    let sealed = problem.chambers.iter().any(|c| matches!(c.pressure, Pressure::Sealed { .. }));
    let cases = [
        (true, "curves, wrinkling and memory of fabrics: they are linear in it"),
        (problem.sections.iter().any(coupled), "shear that comes with stretch in plies at an angle"),
        (!mesh.start.is_empty(), "that the fabric is free of stress in another shape than it starts in"),
        (!mesh.membrane.is_empty(), "that wavy sheets bend from their even pattern"),
        (sealed, "that chambers are sealed: it has their pressure before"),
        (!problem.rigid.is_empty(), "rigid bodies"),
        (!problem.obstacles.is_empty(), "obstacles"),
        (settings.selective_mass, "selective masses: its masses are raised node by node"),
        (settings.imperfection > 0.0, "random offsets of nodes"),
    ];
    cases.iter().filter(|(is, _)| *is).map(|(_, what)| (*what).to_string()).collect()
}
