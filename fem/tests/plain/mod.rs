//! The shell physics one element at a time: slow, short, and the twin that the fast kernels are tested against.
//!
//! Same energies as `fem::sheet`, written from their definitions: gradients of all corners, the pressure force by
//! 2×2 Gauss points on the bilinear surface, bending from the curvature vectors. **Use it to understand, not to run.**

use models::{Account, LedgerLine, Pose, Term};

use fem::sheet::bending::{CurvatureRow, curvature_rows};
use fem::sheet::reference::bending_stiffness;
use fem::sheet::{Element, Sheet};
use fem::vec3::{cross, dot};
use fem::{Mesh, Problem};

/// The shells of a problem without viscosity and history.
pub(crate) struct PlainSheet<'a> {
    sheet: &'a Sheet,
    rows: Vec<CurvatureRow>,
    /// Pressure behind minus pressure in front of each element \[Pa\].
    pressure_pa: Vec<f64>,
}

impl<'a> PlainSheet<'a> {
    /// The twin of `sheet`, which was made of `mesh` (in the same node order) and the problem's sections.
    pub(crate) fn new(sheet: &'a Sheet, mesh: &Mesh, problem: &Problem) -> PlainSheet<'a> {
        let stiffness: Vec<f64> = problem.sections.iter().map(bending_stiffness).collect();
        let of = |name: &Option<String>| {
            let air = sheet.air.iter().find(|air| Some(air.name()) == name.as_deref());
            air.map_or(0.0, |air| air.now.pressure_pa)
        };
        let jump = |element: &Element| of(&mesh.parts[element.part].back) - of(&mesh.parts[element.part].front);
        let pressure_pa = sheet.elements.iter().map(jump).collect();
        PlainSheet { sheet, rows: curvature_rows(mesh, &stiffness), pressure_pa }
    }

    fn membrane(&self, element: &Element, q: &[[f64; 4]], force: &mut [[f64; 4]]) -> f64 {
        let fabric = &*self.sheet.fabrics[element.part];
        let f = element.deformation(q);
        let e = [0.5 * (dot(f[0], f[0]) - 1.0), 0.5 * (dot(f[1], f[1]) - 1.0), dot(f[0], f[1])];
        let s = fabric.tension(e, &[0.0; 2]);
        let area = element.reference.area;
        for (n, node) in element.nodes().iter().enumerate() {
            let b = element.reference.gradient(element.corners, n);
            for k in 0..3 {
                let stress = [s[0] * f[0][k] + s[2] * f[1][k], s[2] * f[0][k] + s[1] * f[1][k]];
                force[*node as usize][k] -= area * (stress[0] * b[0] + stress[1] * b[1]);
            }
        }
        area * fabric.energy(e, &[0.0; 2])
    }

    /// U = ½ k Σ_a (F_a·q)², q = Σ_n γ_n x_n.
    fn hourglass(&self, element: &Element, q: &[[f64; 4]], force: &mut [[f64; 4]]) -> f64 {
        if element.corners == 3 {
            return 0.0;
        }
        let b = |n: usize| element.reference.gradient(4, n);
        let h = [1.0, -1.0, 1.0, -1.0];
        let gamma = [0, 1, 2, 3].map(|n: usize| 0.25 * (h[n] - dot2(element.reference.s, b(n))));
        let mut mode = [0.0; 3];
        for (gamma, node) in gamma.iter().zip(element.nodes()) {
            (0..3).for_each(|k| mode[k] += gamma * q[*node as usize][k]);
        }
        let f = element.deformation(q);
        let g = [dot(f[0], mode), dot(f[1], mode)];
        for (n, node) in element.nodes().iter().enumerate() {
            for k in 0..3 {
                let slope = (0..2).map(|a| g[a] * (gamma[n] * f[a][k] + b(n)[a] * mode[k])).sum::<f64>();
                force[*node as usize][k] -= element.hourglass * slope;
            }
        }
        0.5 * element.hourglass * dot2(g, g)
    }

    /// p ∫ N_n n dA on the nodes; returns −p ∫ ⅓ x·n dA.
    fn pressure(&self, element: &Element, p: f64, q: &[[f64; 4]], force: &mut [[f64; 4]]) -> f64 {
        let x: Vec<[f64; 3]> = element.nodes().iter().map(|n| q[*n as usize]).map(|p| [p[0], p[1], p[2]]).collect();
        let mut work = 0.0;
        let (points, weight) = if x.len() == 4 { (&GAUSS[..], 1.0) } else { (&MIDPOINTS[..], 1.0 / 6.0) };
        for [xi, eta] in points {
            let (shape, along, across) = if x.len() == 4 { quad_shape(*xi, *eta) } else { triangle_shape(*xi, *eta) };
            let sum = |w: &[f64]| [0, 1, 2].map(|k: usize| w.iter().zip(&x).map(|(w, x)| w * x[k]).sum::<f64>());
            let normal = cross(sum(&along), sum(&across));
            work += weight * dot(sum(&shape), normal) / 3.0;
            for (n, node) in element.nodes().iter().enumerate() {
                (0..3).for_each(|k| force[*node as usize][k] += p * weight * shape[n] * normal[k]);
            }
        }
        -p * work
    }

    fn bend(&self, row: &CurvatureRow, q: &[[f64; 4]], force: &mut [[f64; 4]]) -> f64 {
        let mut curvature = [0.0; 3];
        for (node, weight) in &row.weights {
            (0..3).for_each(|k| curvature[k] += weight * q[*node as usize][k] / row.area);
        }
        for (node, weight) in &row.weights {
            (0..3).for_each(|k| force[*node as usize][k] -= row.stiffness * weight * curvature[k]);
        }
        0.5 * row.stiffness * row.area * dot(curvature, curvature)
    }
}

impl Term for PlainSheet<'_> {
    fn line(&self) -> LedgerLine {
        LedgerLine::new("plain shells", Account::Stretch)
    }

    fn add(&self, at: &Pose, force: &mut [f64]) -> f64 {
        let (q, force) = (at.q.as_chunks::<4>().0, force.as_chunks_mut::<4>().0);
        let mut energy = 0.0;
        for (element, p) in self.sheet.elements.iter().zip(&self.pressure_pa) {
            energy += self.membrane(element, q, force) + self.hourglass(element, q, force);
            energy += self.pressure(element, *p, q, force);
        }
        energy + self.rows.iter().map(|row| self.bend(row, q, force)).sum::<f64>()
    }
}

fn dot2(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

const G: f64 = 0.577_350_269_189_625_8;
const GAUSS: [[f64; 2]; 4] = [[-G, -G], [G, -G], [G, G], [-G, G]];
const MIDPOINTS: [[f64; 2]; 3] = [[0.5, 0.0], [0.5, 0.5], [0.0, 0.5]];

type Shape = (Vec<f64>, Vec<f64>, Vec<f64>);

fn quad_shape(xi: f64, eta: f64) -> Shape {
    let signs = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
    let shape = signs.iter().map(|s| 0.25 * (1.0 + s[0] * xi) * (1.0 + s[1] * eta)).collect();
    let along = signs.iter().map(|s| 0.25 * s[0] * (1.0 + s[1] * eta)).collect();
    let across = signs.iter().map(|s| 0.25 * s[1] * (1.0 + s[0] * xi)).collect();
    (shape, along, across)
}

fn triangle_shape(xi: f64, eta: f64) -> Shape {
    (vec![1.0 - xi - eta, xi, eta], vec![-1.0, 1.0, 0.0], vec![-1.0, 0.0, 1.0])
}
