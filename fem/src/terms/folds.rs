//! Folds along lines where the bending stiffness jumps: the edges of welds, tapes and glue.
//!
//! A sheet pulled by T that leaves a stiff edge at an angle θ turns within √(D/T), a fraction of a millimetre in a robot. Its
//! energy, with the work of T on the way that the round cuts short, is the elastica's, whatever the element size:
//!
//! ```text
//! U = 4 k (1 − cos ½φ)          k = √(D T)            M = 2 k sin ½φ
//! ```
//!
//! On a mesh, links of length h that turn at their nodes bend too, with D/h at each. What remains for the edge, so that edge
//! and links together are as stiff as the elastica at small angles:
//!
//! ```text
//! k = (2D/h) (r + √(1 + r²)) / (1 + r/(1 + √(1 + r²)))        r = ½ h √(T/D)
//! ```
//!
//! It tends to √(D T) where elements are long, and to 2D/h where they are short or T is 0. The two sides of a fold are
//! compliances in series, 1/k = 1/k₁ + 1/k₂; without tension that is the mean of the compliances 1/D by length. Where several
//! layers meet, each folds from the stiffest.
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | φ | turn between the elements of both sides: 2 sin ½φ = \|L x\|, L x the sum of the unit vectors across the edge | rad |
//! | D | bending stiffness of a side | N m |
//! | T | tension across the edge in the element of that side; 0 under compression | N/m |
//! | h | length of that element across the edge | m |
//!
//! T follows the membrane with a lag; what its change does to U is a line of the ledger. **Validity**: sheets that want to be flat
//! (rest curvature is not kept along these lines); single folds farther apart than √(D/T). Errors of M, chains of links against the
//! elastica: below 0.3 % at 20°, 2.5 % at 60°, 6 % at 90°, all near h = 2√(D/T). L is linear in x: where the sides have stretches λ₁ and
//! λ₂ across the edge, |L x|² = 4 λ₁ λ₂ sin² ½φ + (λ₁ − λ₂)², so a fold between sheets compressed by 3 % has 6 % less energy.
//! Derived here from the elastica (Love 1927, §262).

use std::collections::BTreeMap;
use std::sync::Arc;

use models::{Account, Fabric, LedgerLine, Pose, Row, RowKind, Term};

use crate::Mesh;
use crate::bytes::{pack, unpack};
use crate::sheet::reference::strain;
use crate::sheet::{Element, Sheet};
use crate::transient::supplied;
use crate::vec3::{Nodes, V3, add, along, dot, node, norm, scale, sub};
use crate::{Tick, Transient};

/// Steps between two looks at the tensions.
const EVERY: u64 = 32;
/// Share of the difference that the tension of a fold takes on at each: the membrane rings.
const FOLLOW: f64 = 0.25;
/// sin² of half the turn from which the moment grows linearly in |L x|: 144°.
const SHARP: f64 = 0.904;
/// Bending stiffnesses nearer than this are one.
const SAME: f64 = 1e-9;

/// Folds along all edges of a mesh at which the bending stiffness jumps.
#[derive(Debug, Clone, Default)]
pub struct Folds {
    edges: Vec<Edge>,
    sides: Vec<[Side; 2]>,
    fabrics: Vec<Arc<dyn Fabric>>,
    /// What changes of tension did \[J\].
    tension_work_j: f64,
    /// Energy at the last step \[J\]; `None` before the first.
    stored_j: Option<f64>,
}

#[derive(Debug, Clone)]
struct Edge {
    /// Both ends of the edge, then the nodes opposite.
    nodes: [u32; 6],
    /// Weights of the operator L \[1/m\], whose sum is 0.
    weights: [f64; 6],
    length_m: f64,
    /// Stiffness k of the fold, both sides in series \[N\].
    stiffness_n: f64,
}

#[derive(Debug, Clone)]
struct Side {
    element: Element,
    /// Direction across the edge in the element's warp and fill.
    across: [f64; 2],
    /// Length h of the element across the edge \[m\].
    height_m: f64,
    /// Bending stiffness D of the sheet on this side \[N m\].
    stiffness_nm: f64,
    /// Tension T across the edge, smoothed over time; 0 under compression \[N/m\].
    tension_n_m: f64,
}

impl Folds {
    /// Of a mesh in the solver's node order; `stiffness[part]` is D of each part \[N m\].
    pub fn new(mesh: &Mesh, sheet: &Sheet, stiffness: &[f64]) -> Folds {
        let mut beside: BTreeMap<[u32; 2], Vec<usize>> = BTreeMap::new();
        for (index, element) in sheet.elements.iter().enumerate().filter(|(_, e)| stiffness[e.part] > 0.0) {
            let nodes = element.nodes();
            for k in 0..nodes.len() {
                let (a, b) = (nodes[k], nodes[(k + 1) % nodes.len()]);
                beside.entry([a.min(b), a.max(b)]).or_default().push(index);
            }
        }
        let mut folds = Folds { fabrics: sheet.fabrics.clone(), ..Folds::default() };
        for (ends, elements) in beside {
            let of = |e: &usize| stiffness[sheet.elements[*e].part];
            let Some(stiffest) = elements.iter().copied().reduce(|a, b| if of(&b) > of(&a) { b } else { a }) else {
                continue;
            };
            for soft in elements.iter().filter(|e| of(e) < (1.0 - SAME) * of(&stiffest)) {
                folds.push(mesh, ends, [*soft, stiffest].map(|e| (&sheet.elements[e], of(&e))));
            }
        }
        folds
    }

    /// True if the stiffness jumps nowhere.
    pub fn is_empty(&self) -> bool {
        self.edges.is_empty()
    }

    fn push(&mut self, mesh: &Mesh, ends: [u32; 2], beside: [(&Element, f64); 2]) {
        let mut edge = Edge { nodes: [ends[0]; 6], weights: [0.0; 6], length_m: 0.0, stiffness_n: 0.0 };
        edge.nodes[1] = ends[1];
        let sides = beside.map(|(element, stiffness_nm)| Side::new(mesh, ends, element, stiffness_nm));
        edge.length_m = norm(sub(mesh.points[ends[1] as usize], mesh.points[ends[0] as usize]));
        for (k, (side, ends_1_m, opposite_1_m)) in sides.iter().enumerate() {
            (0..2).for_each(|n| edge.weights[n] += ends_1_m[n]);
            for (n, opposite) in side.opposite(ends).enumerate() {
                edge.nodes[2 + 2 * k + n] = opposite;
                edge.weights[2 + 2 * k + n] = *opposite_1_m;
            }
        }
        let sides = sides.map(|(side, ..)| side);
        edge.stiffness_n = in_series(&sides);
        self.edges.push(edge);
        self.sides.push(sides);
    }

    /// Lets the tensions follow the membrane; books what this does to the energy.
    fn follow(&mut self, x: &Nodes) {
        for (edge, sides) in self.edges.iter_mut().zip(&mut self.sides) {
            for side in sides.iter_mut() {
                let now = side.pull(&*self.fabrics[side.element.part], x);
                side.tension_n_m += FOLLOW * (now - side.tension_n_m);
            }
            let before = edge.energy_j(x);
            edge.stiffness_n = in_series(sides);
            self.tension_work_j += edge.energy_j(x) - before;
        }
    }
}

impl Side {
    /// With its part of L at the ends of the edge and at each opposite corner \[1/m\].
    fn new(mesh: &Mesh, ends: [u32; 2], element: &Element, stiffness_nm: f64) -> (Side, [f64; 2], f64) {
        let at = |n: u32| mesh.points[n as usize];
        let mut side =
            Side { element: element.clone(), across: [0.0; 2], height_m: 0.0, stiffness_nm, tension_n_m: 0.0 };
        let count = (element.corners - 2) as f64;
        let middle = scale(add(at(ends[0]), at(ends[1])), 0.5);
        let far = side.opposite(ends).fold([0.0; 3], |sum, n| along(sum, 1.0 / count, at(n)));
        let (reach, edge) = (sub(far, middle), sub(at(ends[1]), at(ends[0])));
        // Share of the edge that makes the reach perpendicular to it.
        let skew = dot(reach, edge) / dot(edge, edge);
        let across = along(reach, -skew, edge);
        side.height_m = norm(across);
        let unit = scale(across, 1.0 / side.height_m);
        side.across = [dot(unit, element.reference.axes[0]), dot(unit, element.reference.axes[1])];
        let per = 1.0 / side.height_m;
        (side, [(skew - 0.5) * per, (-skew - 0.5) * per], per / count)
    }

    /// Corners that are not on the edge.
    fn opposite(&self, ends: [u32; 2]) -> impl Iterator<Item = u32> + '_ {
        self.element.nodes().iter().copied().filter(move |n| !ends.contains(n))
    }

    /// T at positions `x`, memory of the fabric left out.
    fn pull(&self, fabric: &dyn Fabric, x: &Nodes) -> f64 {
        let s = fabric.tension(strain(self.element.deformation(x)), &[0.0; 2]);
        let [a, b] = self.across;
        (a * a * s[0] + b * b * s[1] + 2.0 * a * b * s[2]).max(0.0)
    }
}

/// k of one side alone \[N\]: bending stiffness D \[N m\], tension T across the edge \[N/m\], length h of the element \[m\].
///
/// ```
/// let (bending_nm, height_m) = (1e-4, 0.004);
/// let untaut = fem::terms::edge_stiffness_n(bending_nm, 0.0, height_m);
/// assert!((untaut - 2.0 * bending_nm / height_m).abs() < 1e-12, "2 D/h without tension");
/// ```
pub fn edge_stiffness_n(bending_nm: f64, tension_n_m: f64, height_m: f64) -> f64 {
    let r = 0.5 * height_m * (tension_n_m / bending_nm).sqrt();
    let root = (1.0 + r * r).sqrt();
    2.0 * bending_nm / height_m * (r + root) / (1.0 + r / (1.0 + root))
}

fn in_series(sides: &[Side; 2]) -> f64 {
    let [a, b] = [0, 1].map(|k| edge_stiffness_n(sides[k].stiffness_nm, sides[k].tension_n_m, sides[k].height_m));
    a * b / (a + b)
}

impl Edge {
    /// Turn across the edge, L x: of length 2 sin ½φ.
    fn turn(&self, x: &Nodes) -> V3 {
        let own = node(x, self.nodes[0] as usize);
        (1..6).fold([0.0; 3], |sum, k| along(sum, self.weights[k], sub(node(x, self.nodes[k] as usize), own)))
    }

    /// Energy U/(b k) of the fold and 1/cos ½φ, from its turn L x.
    fn shape(&self, turn: V3) -> [f64; 2] {
        let square = 0.25 * dot(turn, turn);
        let near = square.min(SHARP);
        let cosine = (1.0 - near).sqrt();
        [4.0 * near / (1.0 + cosine) + 2.0 * (square - near) / cosine, 1.0 / cosine]
    }

    fn energy_j(&self, x: &Nodes) -> f64 {
        self.length_m * self.stiffness_n * self.shape(self.turn(x))[0]
    }
}

impl Term for Folds {
    fn line(&self) -> LedgerLine {
        LedgerLine::new("folds", Account::Wall)
    }

    fn add(&self, at: &Pose, force: &mut [f64]) -> f64 {
        let (x, force) = (at.q.as_chunks::<4>().0, force.as_chunks_mut::<4>().0);
        let mut stored = 0.0;
        for edge in &self.edges {
            let turn = edge.turn(x);
            let [energy, slope] = edge.shape(turn);
            let stiff = edge.length_m * edge.stiffness_n;
            stored += stiff * energy;
            for (node, weight) in edge.nodes.iter().zip(&edge.weights) {
                let pull = -stiff * slope * weight;
                for k in 0..3 {
                    force[*node as usize][k] += pull * turn[k];
                }
            }
        }
        stored
    }
}

impl Transient for Folds {
    fn advance(&mut self, at: &Pose, tick: &Tick, force: &mut [f64]) -> f64 {
        // Not in the first step, whose energy is the one that the ledger starts from.
        if (tick.step + 1).is_multiple_of(EVERY) {
            self.follow(at.q.as_chunks::<4>().0);
        }
        let energy_j = self.add(at, force);
        self.stored_j = Some(energy_j);
        energy_j
    }

    /// At the positions of the last step (at `at` before the first).
    fn ledger(&self, at: &Pose) -> Vec<Row> {
        let x = at.q.as_chunks::<4>().0;
        let energy_j = self.stored_j.unwrap_or_else(|| self.edges.iter().map(|e| e.energy_j(x)).sum());
        vec![
            self.line().row(RowKind::Stored, energy_j),
            supplied("tension of folds", Account::Wall, self.tension_work_j),
        ]
    }

    /// b k |δ(L x)|²/cos³ ½φ, the stiffest direction, by Cauchy–Schwarz.
    fn stiffness_bound(&self, at: &Pose, bound: &mut [f64]) {
        let x = at.q.as_chunks::<4>().0;
        for edge in &self.edges {
            let [_, slope] = edge.shape(edge.turn(x));
            let sum: f64 = edge.weights.iter().map(|w| w.abs()).sum();
            let stiff = edge.length_m * edge.stiffness_n * slope.powi(3) * sum;
            for (n, w) in edge.nodes.iter().zip(&edge.weights) {
                bound[*n as usize] += stiff * w.abs();
            }
        }
    }

    fn save(&self) -> Vec<u8> {
        let tensions: Vec<f64> = self.sides.as_flattened().iter().map(|side| side.tension_n_m).collect();
        pack(&(self.tension_work_j, self.stored_j, tensions))
    }

    fn restore(&mut self, saved: &[u8]) -> Option<()> {
        let (work_j, stored_j, tensions): (f64, Option<f64>, Vec<f64>) = unpack(saved)?;
        let sides = self.sides.as_flattened_mut();
        (tensions.len() == sides.len()).then_some(())?;
        for (side, tension) in sides.iter_mut().zip(tensions) {
            side.tension_n_m = tension;
        }
        for (edge, sides) in self.edges.iter_mut().zip(&self.sides) {
            edge.stiffness_n = in_series(sides);
        }
        (self.tension_work_j, self.stored_j) = (work_j, stored_j);
        Some(())
    }
}

#[cfg(test)]
#[path = "folds_tests.rs"]
mod tests;
