//! What CalculiX 2.20 needs otherwise than Abaqus.
//!
//! CalculiX makes bricks and wedges of shells. Bricks and wedges of corner nodes alone are too stiff in bending: the pillow of
//! `tests/foreign/pillow.toml` rises 54 % too little with S3, 3 % with S4, and 0.2 % too much with S8R. So every element
//! gets nodes in the middles of its sides.
//!
//! ```text
//!   4 ──7── 3      S8R        3          S6        node 5 is at ½ (x₁ + x₂)
//!   8       6               6   5
//!   1 ──5── 2             1 ──4── 2
//! ```
//!
//! Where shells of different directions or thicknesses share a node, CalculiX clamps them to each other. In the engine sheets hinge
//! there, unless they are one piece ([`crate::sheet::bending`]). So every piece has its own nodes, which follow the nodes of the first piece
//! by `*EQUATION`. The step is an implicit dynamic one with the damping of the problem, because free bodies, folds and flat sheets
//! without tension have no static answer. Transverse shear moduli and the modulus across the sheet are √(E₁E₂)/2 and √(E₁E₂):
//! the engine's sheets do not shear across.

use std::collections::{BTreeMap, BTreeSet};

use super::shared::{
    Plate, Solver, follow, heading, in_rows, left_out, loads, node_set, number, numbers, own, place, places, plate,
    row, surfaces,
};
use crate::Problem;
use crate::mesh::Part;
use crate::problem::Section;
use crate::sheet::reference::{Reference, bending_stiffness};

/// Numerical damping of the Hilber-Hughes-Taylor method, the largest allowed: the target is the state at rest.
const ALPHA: f64 = -0.3;
/// Largest increment: this share of the time, and of the shortest stretch of a curve.
const LARGEST: [f64; 2] = [0.05, 0.1];
/// First and smallest increment over the largest one.
const SMALLER: [f64; 2] = [0.1, 1e-6];
/// Increments after which results are printed; the last one always is.
const SELDOM: &str = "FREQUENCY=100000";

/// The deck, and what it does not say.
pub(super) fn text(problem: &Problem) -> (String, Vec<String>) {
    let problem = &renamed(problem);
    let mut out = heading(problem);
    let mesh = Quadratic::of(problem);
    places(&mut out, problem);
    out += &mesh.nodes;
    out += &mesh.elements;
    out += &mesh.equations;
    let sets = problem.mesh.sets.iter().filter(|(_, nodes)| !nodes.is_empty());
    sets.clone().for_each(|(name, nodes)| node_set(&mut out, name, nodes));
    held_sets(&mut out, problem, &mesh);
    surfaces(&mut out, problem);
    for (index, (part, section)) in problem.mesh.parts.iter().zip(&problem.sections).enumerate() {
        material(&mut out, problem, index, part, section);
    }
    if problem.settings.mass_damping_1_s > 0.0 {
        out += &format!("*DAMPING, ALPHA={}, BETA=0.0\n", number(problem.settings.mass_damping_1_s));
    }
    let mut step = String::new();
    loads(&mut out, &mut step, problem, Solver::CalculiX);
    out += &format!("*STEP, NLGEOM, INC=1000000\n*DYNAMIC, ALPHA={ALPHA:?}\n{}\n", increments(problem));
    out += &step;
    sets.for_each(|(name, _)| out += &format!("*NODE PRINT, NSET={name}, {SELDOM}\nU\n"));
    for index in 1..=problem.supports.len() {
        let set = own(&format!("reaction_{index}"));
        out += &format!("*NODE PRINT, NSET={set}, TOTALS=ONLY, {SELDOM}\nRF\n");
    }
    out += &format!("*NODE FILE, OUTPUT=2D, {SELDOM}\nU\n*EL FILE, {SELDOM}\nS, E\n*END STEP\n");
    (out, left_out(problem, Solver::CalculiX))
}

/// The problem with names of letters, digits, `_` and `-` that differ in more than the case of letters: CalculiX reads no quotes.
fn renamed(problem: &Problem) -> Problem {
    let mut problem = problem.clone();
    let sets = plain_names(problem.mesh.sets.keys());
    let parts = plain_names(problem.mesh.parts.iter().map(|part| &part.name));
    let chambers = plain_names(problem.chambers.iter().map(|chamber| &chamber.name));
    let change = |names: &BTreeMap<String, String>, name: &mut String| {
        if let Some(plain) = names.get(name) {
            name.clone_from(plain);
        }
    };
    problem.mesh.sets = problem.mesh.sets.into_iter().map(|(name, nodes)| (sets[&name].clone(), nodes)).collect();
    let supports = problem.supports.iter_mut().map(|support| &mut support.set);
    let forces = problem.forces.iter_mut().map(|force| &mut force.set);
    let rigid = problem.rigid.iter_mut().map(|rigid| &mut rigid.set);
    for set in supports.chain(forces).chain(rigid) {
        change(&sets, set);
    }
    for part in &mut problem.mesh.parts {
        change(&parts, &mut part.name);
        for chamber in [&mut part.front, &mut part.back].into_iter().flatten() {
            change(&chambers, chamber);
        }
    }
    for chamber in problem.chambers.iter_mut() {
        change(&chambers, &mut chamber.name);
    }
    problem
}

fn plain_names<'a>(names: impl Iterator<Item = &'a String>) -> BTreeMap<String, String> {
    let mut taken = BTreeSet::new();
    let plain = |c: char| if c.is_ascii_alphanumeric() || "_-".contains(c) { c } else { '_' };
    names
        .map(|name| {
            let begin: String = name.chars().map(plain).take(60).collect();
            let begin = if begin.to_lowercase().starts_with("ibr_") { format!("set_{begin}") } else { begin };
            let numbered = (2..).map(|k| format!("{begin}_{k}"));
            let free = std::iter::once(begin.clone()).chain(numbered).find(|name| taken.insert(name.to_uppercase()));
            (name.clone(), free.unwrap_or_default())
        })
        .collect()
}

/// Elements with nodes in the middles of their sides; every piece has its own nodes.
#[derive(Default)]
struct Quadratic {
    /// Lines of the nodes that are added.
    nodes: String,
    elements: String,
    equations: String,
    count: u32,
    /// First nodes by place: the two nodes around a middle node, or a corner twice; further pieces follow these nodes.
    first: BTreeMap<[u32; 2], u32>,
    /// The nodes of every piece at these places.
    known: BTreeMap<([u32; 2], usize), u32>,
}

impl Quadratic {
    fn of(problem: &Problem) -> Quadratic {
        let mesh = &problem.mesh;
        let mut made = Quadratic { count: mesh.points.len() as u32, ..Quadratic::default() };
        let mut pieces = Vec::new();
        let mut first = 1;
        for (part, section) in mesh.parts.iter().zip(&problem.sections) {
            let of = (part.layer, bending_stiffness(section).to_bits());
            let piece = pieces.iter().position(|known| *known == of).unwrap_or(pieces.len());
            if piece == pieces.len() {
                pieces.push(of);
            }
            for (kind, elements) in [("S8R", 0..part.quads.len()), ("S6", part.quads.len()..part.len())] {
                if !elements.is_empty() {
                    made.elements += &format!("*ELEMENT, TYPE={kind}, ELSET={}\n", part.name);
                }
                elements.for_each(|i| made.element(problem, first + i, part.nodes(i), piece));
            }
            first += part.len();
        }
        made
    }

    fn element(&mut self, problem: &Problem, name: usize, corners: &[u32], piece: usize) {
        let sides = corners.iter().zip(corners.iter().cycle().skip(1)).map(|(a, b)| [*a.min(b), *a.max(b)]);
        let places = corners.iter().map(|node| [*node; 2]).chain(sides);
        let nodes: Vec<u32> = places.map(|place| self.node(problem, place, piece)).collect();
        self.elements += &format!("{name}, {}\n", numbers(&nodes));
    }

    /// The node of a piece in the middle of two nodes, counted from 0.
    fn node(&mut self, problem: &Problem, between: [u32; 2], piece: usize) -> u32 {
        if let Some(node) = self.known.get(&(between, piece)) {
            return *node;
        }
        let first = self.first.get(&between).copied();
        let node = if first.is_none() && between[0] == between[1] {
            between[0]
        } else {
            let [a, b] = between.map(|node| place(problem, node));
            self.count += 1;
            self.nodes += &format!("{}, {}\n", self.count, row(&[0, 1, 2].map(|axis| 0.5 * (a[axis] + b[axis]))));
            self.count - 1
        };
        match first {
            Some(first) => follow(&mut self.equations, node, first),
            None => drop(self.first.insert(between, node)),
        }
        self.known.insert((between, piece), node);
        node
    }

    /// Nodes of a set with the middles of sides within it; `all`: with the nodes of further pieces.
    fn within(&self, nodes: &[u32], all: bool) -> Vec<u32> {
        let set: BTreeSet<u32> = nodes.iter().copied().collect();
        let inside = |place: &[u32; 2]| place.iter().all(|node| set.contains(node));
        let middles = self.first.iter().filter(|(place, _)| place[0] != place[1] && inside(place));
        let further = |corners: bool| {
            let own = move |place: &[u32; 2]| (place[0] == place[1]) == corners && inside(place);
            let known = self.known.iter().filter(move |((place, _), node)| own(place) && self.first[place] != **node);
            known.filter(|_| all).map(|(_, node)| *node)
        };
        let first = set.iter().copied().chain(middles.map(|(_, node)| *node));
        first.chain(further(true)).chain(further(false)).collect()
    }
}

/// What supports hold, what they hold it with, and rigid bodies.
fn held_sets(out: &mut String, problem: &Problem, mesh: &Quadratic) {
    let nodes = |set: &str| problem.mesh.sets.get(set).map_or(&[][..], Vec::as_slice);
    for (index, support) in problem.supports.iter().enumerate() {
        for (name, all) in [("support", false), ("reaction", true)] {
            node_set(out, &own(&format!("{name}_{}", index + 1)), &mesh.within(nodes(&support.set), all));
        }
    }
    let mut next = mesh.count;
    for (index, rigid) in problem.rigid.iter().enumerate() {
        let set = own(&format!("rigid_{}", index + 1));
        let nodes = mesh.within(nodes(&rigid.set), false);
        let at = row(&nodes.first().map_or([0.0; 3], |node| place(problem, *node)));
        *out += &format!("*NODE\n{}, {at}\n{}, {at}\n", next + 1, next + 2);
        node_set(out, &set, &nodes);
        *out += &format!("*RIGID BODY, NSET={set}, REF NODE={}, ROT NODE={}\n", next + 1, next + 2);
        next += 2;
    }
}

fn material(out: &mut String, problem: &Problem, index: usize, part: &Part, section: &Section) {
    let Plate { thickness_m, moduli_pa: [e1, e2, g], nu12, density_kg_m3, .. } = plate(section);
    let (name, thickness, density) = (&part.name, number(thickness_m), number(density_kg_m3));
    // CalculiX refuses an isotropic ν of ½, which incompressible films have.
    let is_isotropic = nu12 < 0.499 && (e1 / e2 - 1.0).abs() < 1e-9 && (2.0 * g * (1.0 + nu12) / e1 - 1.0).abs() < 1e-9;
    let across = (e1 * e2).sqrt();
    let constants = [e1, e2, across, nu12, 0.0, 0.0, g, 0.5 * across];
    let (kind, elastic) = match is_isotropic {
        true => ("", row(&[e1, nu12])),
        false => (", TYPE=ENGINEERING CONSTANTS", row(&constants) + "\n" + &number(0.5 * across)),
    };
    *out += &format!("*MATERIAL, NAME={name}\n*ELASTIC{kind}\n{elastic}\n*DENSITY\n{density}\n");
    if is_isotropic {
        return *out += &format!("*SHELL SECTION, ELSET={name}, MATERIAL={name}\n{thickness}\n");
    }
    for (number, (axes, elements)) in directions(problem, index, part).iter().enumerate() {
        let warp = own(&format!("warp_{}_{}", index + 1, number + 1));
        *out += &format!("*ORIENTATION, NAME={warp}\n{axes}\n*ELSET, ELSET={warp}\n");
        in_rows(out, elements);
        *out += &format!("*SHELL SECTION, ELSET={warp}, MATERIAL={name}, ORIENTATION={warp}\n{thickness}\n");
    }
}

/// Elements of every direction of warp and fill. CalculiX does not lay directions onto a curved sheet, and version 2.20 gives all
/// shells of a `*DISTRIBUTION` the direction of its first line.
fn directions(problem: &Problem, index: usize, part: &Part) -> BTreeMap<String, Vec<u32>> {
    let before: usize = problem.mesh.parts[..index].iter().map(Part::len).sum();
    let mut found = BTreeMap::<String, Vec<u32>>::new();
    for i in 0..part.len() {
        let corners: Vec<[f64; 3]> = part.nodes(i).iter().map(|n| place(problem, *n)).collect();
        let axes = Reference::new(&corners, part.warp_of(i), 0.0).axes;
        let axes: Vec<String> = axes.as_flattened().iter().map(|x| format!("{:.9}", x + 0.0)).collect();
        found.entry(axes.join(", ")).or_default().push((before + i) as u32);
    }
    found
}

/// First increment, time, smallest and largest increment \[s\].
fn increments(problem: &Problem) -> String {
    let end_s = problem.settings.end_s;
    let pressures = problem.chambers.iter().map(|chamber| chamber.pressure.filling());
    let motions = problem.supports.iter().flat_map(|support| support.motion.iter().flatten());
    let forces = problem.forces.iter().map(|force| &force.amplitude);
    let curves = pressures.chain(motions).chain(forces).chain(problem.gravity.iter().map(|g| &g.amplitude));
    let stretches = curves.flat_map(|curve| curve.points().windows(2).map(|pair| pair[1].0 - pair[0].0));
    let largest = stretches.filter(|s| *s > 0.0).fold(LARGEST[0] * end_s, |least, s| least.min(LARGEST[1] * s));
    row(&[SMALLER[0] * largest, end_s, SMALLER[1] * largest, largest])
}
