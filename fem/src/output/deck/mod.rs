//! A problem as input of Abaqus or CalculiX (`.inp`) in SI units: for another solver's opinion.
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
//! Without bending stiffness a part is a membrane of the sheet's thickness for Abaqus, a shell of this thickness for CalculiX.
//! No number has more than 20 characters, because CalculiX reads no more. [`text`] lists what does not fit into the format.

mod calculix;
mod shared;

use crate::Problem;
use crate::mesh::Part;
use crate::problem::{MassScaling, Section};
use crate::sheet::reference::bending_stiffness;
use crate::vec3::{area, cross, direction};
pub use shared::Solver;
use shared::{Plate, heading, label, left_out, loads, node_set, number, numbers, places, plate, row, surfaces};

/// The text, and what it does not say.
pub(crate) fn text(problem: &Problem, solver: Solver) -> (String, Vec<String>) {
    if solver == Solver::CalculiX {
        return calculix::text(problem);
    }
    let mut out = heading(problem);
    nodes_and_elements(&mut out, problem);
    for (number, (part, section)) in problem.mesh.parts.iter().zip(&problem.sections).enumerate() {
        material(&mut out, problem, number, part, section);
    }
    let mut step = String::new();
    loads(&mut out, &mut step, problem, Solver::Abaqus);
    contact(&mut out, problem);
    numerics(&mut out, problem);
    out += &step;
    out += "*OUTPUT, FIELD, NUMBER INTERVAL=20\n*NODE OUTPUT\nU, V\n*ELEMENT OUTPUT\nS, LE\n*END STEP\n";
    (out, left_out(problem, Solver::Abaqus))
}

fn nodes_and_elements(out: &mut String, problem: &Problem) {
    places(out, problem);
    let mut first = 1;
    for (part, section) in problem.mesh.parts.iter().zip(&problem.sections) {
        let kinds = if bending_stiffness(section) > 0.0 { ["S4R", "S3R"] } else { ["M3D4R", "M3D3"] };
        for (kind, elements) in kinds.into_iter().zip([0..part.quads.len(), part.quads.len()..part.len()]) {
            if !elements.is_empty() {
                *out += &format!("*ELEMENT, TYPE={kind}, ELSET={}\n", label(&part.name));
            }
            elements.for_each(|i| *out += &format!("{}, {}\n", first + i, numbers(part.nodes(i))));
        }
        first += part.len();
    }
    for (name, nodes) in problem.mesh.sets.iter().filter(|(_, nodes)| !nodes.is_empty()) {
        node_set(out, &label(name), nodes);
    }
    surfaces(out, problem);
}

fn material(out: &mut String, problem: &Problem, index: usize, part: &Part, section: &Section) {
    let Plate { thickness_m, moduli_pa: [e1, e2, g], nu12, density_kg_m3, bends } = plate(section);
    let (name, damping) = (label(&part.name), problem.settings.mass_damping_1_s);
    let damping = if damping > 0.0 { format!("*DAMPING, ALPHA={}\n", number(damping)) } else { String::new() };
    let [moduli, density] = [row(&[e1, e2, nu12, g, g, g]), number(density_kg_m3)];
    *out += &format!("*MATERIAL, NAME={name}\n*ELASTIC, TYPE=LAMINA\n{moduli}\n*DENSITY\n{density},\n{damping}");
    orientation(out, problem, index, part);
    let kind = if bends { "SHELL" } else { "MEMBRANE" };
    let t = number(thickness_m);
    *out += &format!("*{kind} SECTION, ELSET={name}, MATERIAL={name}, ORIENTATION=warp_{}\n{t},\n", index + 1);
}

/// The warp of a part: x unless the part gives another, for all of it or by element.
fn orientation(out: &mut String, problem: &Problem, index: usize, part: &Part) {
    let name = format!("warp_{}", index + 1);
    let before: usize = problem.mesh.parts[..index].iter().map(Part::len).sum();
    let axes = |i: usize| {
        let corners = problem.mesh.places(part.nodes(i));
        let warp = part.warp_of(i).unwrap_or([1.0, 0.0, 0.0]);
        let across = cross(direction(area(&corners)), warp);
        row(&[warp, if across == [0.0; 3] { [0.0, 1.0, 0.0] } else { direction(across) }].concat())
    };
    let first = axes(0);
    if part.warp.len() < 2 {
        return *out += &format!("*ORIENTATION, NAME={name}\n{first}\n3, 0.\n");
    }
    let table =
        format!("*DISTRIBUTION TABLE, NAME={name}_table\nCOORD3D, COORD3D\n*DISTRIBUTION, NAME={name}_by_element");
    *out += &format!("{table}, LOCATION=ELEMENT, TABLE={name}_table\n, {first}\n");
    for i in 0..part.len() {
        *out += &format!("{}, {}\n", before + i + 1, axes(i));
    }
    *out += &format!("*ORIENTATION, NAME={name}\n{name}_by_element\n3, 0.\n");
}

fn contact(out: &mut String, problem: &Problem) {
    let Some(contact) = &problem.contact else { return };
    let friction = number(contact.friction);
    *out += &format!("*SURFACE INTERACTION, NAME=layers\n*FRICTION\n{friction},\n*CONTACT\n");
    *out += "*CONTACT INCLUSIONS, ALL EXTERIOR\n*CONTACT PROPERTY ASSIGNMENT\n, , layers\n";
}

fn numerics(out: &mut String, problem: &Problem) {
    let end_s = number(problem.settings.end_s);
    *out += &format!("*STEP, NAME=run, NLGEOM=YES\n*DYNAMIC, EXPLICIT\n, {end_s}\n");
    let scaling = match problem.settings.mass_scaling {
        MassScaling::None => return,
        MassScaling::Fixed(factor) => format!("FACTOR={}", number(factor)),
        MassScaling::TargetStep(dt) => format!("DT={}, TYPE=BELOW MIN", number(dt)),
    };
    *out += &format!("*FIXED MASS SCALING, {scaling}\n");
}
