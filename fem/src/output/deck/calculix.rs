//! What CalculiX 2.20 needs otherwise than Abaqus.
//!
//! CalculiX makes bricks and wedges of shells. Those of corner nodes alone are too stiff in bending: the pillow of
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
//! there, unless they are one piece ([`crate::sheet::bending`]). So every piece has nodes of its own, which follow those of the first
//! by `*EQUATION`. The step is an implicit dynamic one with the damping of the problem, because free bodies, folds and flat sheets
//! without tension have no static answer. Transverse shear moduli and the modulus across the sheet are √(E₁E₂)/2 and √(E₁E₂):
//! the engine's sheets do not shear across.

use std::collections::{BTreeMap, BTreeSet};

use super::shared::{
    Plate, Solver, follow, heading, left_out, loads, node_set, number, numbers, own, place, places, plate, put, row,
    surfaces,
};
use crate::Problem;
use crate::mesh::Part;
use crate::problem::Section;
use crate::sheet::reference::{Reference, bending_stiffness};

/// Numerical damping of the Hilber-Hughes-Taylor method, the most it has: what is wanted is the state at rest.
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
        put(&mut out, format_args!("*DAMPING, ALPHA={}, BETA=0.0", number(problem.settings.mass_damping_1_s)));
    }
    let mut step = String::new();
    loads(&mut out, &mut step, problem, Solver::CalculiX);
    put(&mut out, format_args!("*STEP, NLGEOM, INC=1000000\n*DYNAMIC, ALPHA={ALPHA:?}\n{}", increments(problem)));
    out += &step;
    sets.for_each(|(name, _)| put(&mut out, format_args!("*NODE PRINT, NSET={name}, {SELDOM}\nU")));
    for index in 1..=problem.supports.len() {
        let set = own(&format!("reaction_{index}"));
        put(&mut out, format_args!("*NODE PRINT, NSET={set}, TOTALS=ONLY, {SELDOM}\nRF"));
    }
    put(&mut out, format_args!("*NODE FILE, OUTPUT=2D, {SELDOM}\nU\n*EL FILE, {SELDOM}\nS, E\n*END STEP"));
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
    problem.supports.iter_mut().for_each(|support| change(&sets, &mut support.set));
    problem.forces.iter_mut().for_each(|force| change(&sets, &mut force.set));
    problem.rigid.iter_mut().for_each(|rigid| change(&sets, &mut rigid.set));
    for part in &mut problem.mesh.parts {
        change(&parts, &mut part.name);
        [&mut part.front, &mut part.back].into_iter().flatten().for_each(|chamber| change(&chambers, chamber));
    }
    problem.chambers.iter_mut().for_each(|chamber| change(&chambers, &mut chamber.name));
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

/// Elements with nodes in the middles of their sides; every piece has nodes of its own.
#[derive(Default)]
struct Quadratic {
    /// Lines of the nodes that are added.
    nodes: String,
    elements: String,
    equations: String,
    /// Nodes in all.
    count: u32,
    /// The piece whose elements have the node itself.
    owner: BTreeMap<u32, usize>,
    /// Nodes of further pieces, by node and piece.
    copies: BTreeMap<(u32, usize), u32>,
    /// Middles of sides by their ends, and the piece that had the side first; those that follow others are not free.
    middles: BTreeMap<[u32; 2], Middle>,
    /// Middles of further pieces.
    further: BTreeMap<([u32; 2], usize), u32>,
}

struct Middle {
    node: u32,
    piece: usize,
    is_free: bool,
}

impl Quadratic {
    fn of(problem: &Problem) -> Quadratic {
        let mesh = &problem.mesh;
        let mut made = Quadratic { count: mesh.points.len() as u32, ..Quadratic::default() };
        mesh.ties.iter().for_each(|tie| follow(&mut made.equations, tie.node, &tie.to));
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
                    put(&mut made.elements, format_args!("*ELEMENT, TYPE={kind}, ELSET={}", part.name));
                }
                elements.for_each(|i| made.element(problem, first + i, part.nodes(i), piece));
            }
            first += part.len();
        }
        made
    }

    fn element(&mut self, problem: &Problem, name: usize, corners: &[u32], piece: usize) {
        let sides = corners.iter().zip(corners.iter().cycle().skip(1)).map(|(a, b)| [*a.min(b), *a.max(b)]);
        let own: Vec<u32> = corners.iter().map(|node| self.corner(problem, *node, piece)).collect();
        let middles: Vec<u32> = sides.map(|side| self.middle(problem, side, piece)).collect();
        put(&mut self.elements, format_args!("{name}, {}", numbers(&[own, middles].concat())));
    }

    fn corner(&mut self, problem: &Problem, node: u32, piece: usize) -> u32 {
        if *self.owner.entry(node).or_insert(piece) == piece {
            return node;
        }
        if let Some(copy) = self.copies.get(&(node, piece)) {
            return *copy;
        }
        let copy = self.add(place(problem, node));
        follow(&mut self.equations, copy, &[(node, 1.0)]);
        self.copies.insert((node, piece), copy);
        copy
    }

    fn middle(&mut self, problem: &Problem, side: [u32; 2], piece: usize) -> u32 {
        let known = self.middles.get(&side).map(|middle| (middle.node, middle.piece));
        if let Some((node, _)) = known.filter(|(_, first)| *first == piece) {
            return node;
        }
        if let Some(node) = self.further.get(&(side, piece)) {
            return *node;
        }
        let [a, b] = side.map(|node| place(problem, node));
        let node = self.add([0, 1, 2].map(|axis| 0.5 * (a[axis] + b[axis])));
        match known {
            Some((first, _)) => {
                follow(&mut self.equations, node, &[(first, 1.0)]);
                self.further.insert((side, piece), node);
            }
            None => {
                let is_free = !is_glued(problem, side);
                if !is_free {
                    follow(&mut self.equations, node, &side.map(|end| (end, 0.5)));
                }
                self.middles.insert(side, Middle { node, piece, is_free });
            }
        }
        node
    }

    /// A new node, counted from 0.
    fn add(&mut self, place: [f64; 3]) -> u32 {
        self.count += 1;
        put(&mut self.nodes, format_args!("{}, {}", self.count, row(&place)));
        self.count - 1
    }

    /// Free nodes of a set with the middles of sides within it; `all`: those that follow them as well.
    fn within(&self, problem: &Problem, nodes: &[u32], all: bool) -> Vec<u32> {
        let set: BTreeSet<u32> = nodes.iter().copied().collect();
        let tied = |node: &u32| problem.mesh.ties.iter().any(|tie| tie.node == *node);
        let inside = |side: &[u32; 2]| side.iter().all(|node| set.contains(node));
        let corners = set.iter().copied().filter(|node| all || !tied(node));
        let middles = self.middles.iter().filter(|(side, middle)| inside(side) && (all || middle.is_free));
        let copies = self.copies.iter().filter(|((node, _), _)| all && set.contains(node)).map(|(_, copy)| *copy);
        let further = self.further.iter().filter(|((side, _), _)| all && inside(side)).map(|(_, node)| *node);
        corners.chain(middles.map(|(_, middle)| middle.node)).chain(copies).chain(further).collect()
    }
}

/// True if a side is glued to an element of others: one of its ends follows the other, or what the other follows too.
fn is_glued(problem: &Problem, [a, b]: [u32; 2]) -> bool {
    let leaders = |node: u32| problem.mesh.ties.iter().find(|tie| tie.node == node).map(|tie| &tie.to);
    let leads = |node: u32, to: &Vec<(u32, f64)>| to.iter().any(|(leader, _)| *leader == node);
    match (leaders(a), leaders(b)) {
        (None, None) => false,
        (Some(to), None) => leads(b, to),
        (None, Some(to)) => leads(a, to),
        (Some(_), Some(_)) => true,
    }
}

/// What supports hold, what they hold it with, and rigid bodies.
fn held_sets(out: &mut String, problem: &Problem, mesh: &Quadratic) {
    let nodes = |set: &str| problem.mesh.sets.get(set).map_or(&[][..], Vec::as_slice);
    for (index, support) in problem.supports.iter().enumerate() {
        for (name, all) in [("support", false), ("reaction", true)] {
            node_set(out, &own(&format!("{name}_{}", index + 1)), &mesh.within(problem, nodes(&support.set), all));
        }
    }
    let mut next = mesh.count;
    for (index, rigid) in problem.rigid.iter().enumerate() {
        let (set, nodes) = (own(&format!("rigid_{}", index + 1)), mesh.within(problem, nodes(&rigid.set), false));
        let at = row(&nodes.first().map_or([0.0; 3], |node| place(problem, *node)));
        put(out, format_args!("*NODE\n{}, {at}\n{}, {at}", next + 1, next + 2));
        node_set(out, &set, &nodes);
        put(out, format_args!("*RIGID BODY, NSET={set}, REF NODE={}, ROT NODE={}", next + 1, next + 2));
        next += 2;
    }
}

fn material(out: &mut String, problem: &Problem, index: usize, part: &Part, section: &Section) {
    let Plate { thickness_m, moduli_pa: [e1, e2, g], nu12, density_kg_m3, .. } = plate(section);
    put(out, format_args!("*MATERIAL, NAME={}", part.name));
    // CalculiX refuses an isotropic ν of ½, which incompressible films have.
    let is_isotropic = nu12 < 0.499 && (e1 / e2 - 1.0).abs() < 1e-9 && (2.0 * g * (1.0 + nu12) / e1 - 1.0).abs() < 1e-9;
    if is_isotropic {
        put(out, format_args!("*ELASTIC\n{}", row(&[e1, nu12])));
    } else {
        let across = (e1 * e2).sqrt();
        let constants = row(&[e1, e2, across, nu12, 0.0, 0.0, g, 0.5 * across]);
        put(out, format_args!("*ELASTIC, TYPE=ENGINEERING CONSTANTS\n{constants}\n{}", number(0.5 * across)));
    }
    put(out, format_args!("*DENSITY\n{}", number(density_kg_m3)));
    let (name, thickness) = (&part.name, number(thickness_m));
    if is_isotropic {
        put(out, format_args!("*SHELL SECTION, ELSET={name}, MATERIAL={name}\n{thickness}"));
    }
    let directions = if is_isotropic { BTreeMap::new() } else { directions(problem, index, part) };
    for (number, (axes, elements)) in directions.iter().enumerate() {
        let warp = own(&format!("warp_{}_{}", index + 1, number + 1));
        put(out, format_args!("*ORIENTATION, NAME={warp}\n{axes}\n*ELSET, ELSET={warp}"));
        elements.chunks(16).for_each(|elements| put(out, format_args!("{},", numbers(elements))));
        put(out, format_args!("*SHELL SECTION, ELSET={warp}, MATERIAL={name}, ORIENTATION={warp}\n{thickness}"));
    }
}

/// Elements of every direction of warp and fill. CalculiX does not lay directions onto a curved sheet, and version 2.20 gives all
/// shells of a `*DISTRIBUTION` the direction of its first line.
fn directions(problem: &Problem, index: usize, part: &Part) -> BTreeMap<String, Vec<u32>> {
    let before: usize = problem.mesh.parts[..index].iter().map(Part::len).sum();
    let mut found = BTreeMap::<String, Vec<u32>>::new();
    for i in 0..part.len() {
        let corners: Vec<[f64; 3]> = part.nodes(i).iter().map(|n| place(problem, *n)).collect();
        let [warp, fill, _] = Reference::new(&corners, part.warp_of(i), 0.0).axes;
        let axes: Vec<String> = [warp, fill].as_flattened().iter().map(|x| format!("{:.9}", x + 0.0)).collect();
        found.entry(axes.join(", ")).or_default().push((before + i) as u32);
    }
    found
}

/// First increment, time, smallest and largest increment \[s\].
fn increments(problem: &Problem) -> String {
    let end_s = problem.settings.end_s;
    let pressures = problem.chambers.iter().map(|chamber| chamber.pressure.filling());
    let motions = problem.supports.iter().flat_map(|support| support.motion.iter().flatten());
    let others =
        problem.forces.iter().map(|force| &force.amplitude).chain(problem.gravity.iter().map(|g| &g.amplitude));
    let stretches = pressures.chain(motions).chain(others).flat_map(|curve| {
        let points = curve.points();
        points.windows(2).map(|pair| pair[1].0 - pair[0].0).collect::<Vec<f64>>()
    });
    let largest = stretches.filter(|s| *s > 0.0).fold(LARGEST[0] * end_s, |least, s| least.min(LARGEST[1] * s));
    row(&[SMALLER[0] * largest, end_s, SMALLER[1] * largest, largest])
}
