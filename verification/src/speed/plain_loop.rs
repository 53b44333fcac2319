//! A plain loop over membrane triangles, as one would write it in C: the reference for the engine's speed.
//!
//! ```text
//! F = [x₁ − x₀, x₂ − x₀] B     E = ½(FᵀF − 1)     S = D E     f₁₂ = −A B F S + p/6 (x₁ − x₀)×(x₂ − x₀)
//! ```
//!
//! Constant strain, St. Venant–Kirchhoff, one thread, no bending, no hourglass control, no viscosity, no energies: one
//! loop scatters forces, one moves nodes. Nothing is sorted, packed or vectorised by hand.

use fem::Problem;
use fem::problem::Chamber;

/// A membrane of triangles with its motion, over one gas pressure.
pub struct Membrane {
    x: Vec<[f64; 3]>,
    v: Vec<[f64; 3]>,
    f: Vec<[f64; 3]>,
    mass_kg: Vec<f64>,
    triangles: Vec<Triangle>,
    /// Tension over strain \[N/m\], 11, 12, 22, 66.
    stiffness: [f64; 4],
    damping_1_s: f64,
    air: Chamber,
    time_s: f64,
    dt_s: f64,
}

struct Triangle {
    node: [usize; 3],
    b: [[f64; 2]; 2],
    area_m2: f64,
}

impl Membrane {
    /// The nodes of a flat problem of one material and one chamber behind all parts; quadrilaterals are halved.
    pub fn new(problem: &Problem) -> Membrane {
        let (mesh, section) = (&problem.mesh, &problem.sections[0]);
        let d = section.plies[0].fabric.tangent([0.0; 3], &[0.0; 2]);
        let areal_kg_m2 = section.density_kg_m3 * section.plies[0].fabric.thickness_m();
        let quads = mesh.parts.iter().flat_map(|part| &part.quads);
        let halves = quads.flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]);
        let triangles: Vec<_> = halves.map(|node| Triangle::new(node.map(|n| n as usize), &mesh.points)).collect();
        let mut mass_kg = vec![0.0; mesh.points.len()];
        let mut fastest_1_s2: f64 = 0.0;
        for triangle in &triangles {
            triangle.node.iter().for_each(|n| mass_kg[*n] += areal_kg_m2 * triangle.area_m2 / 3.0);
            fastest_1_s2 = fastest_1_s2.max(3.0 * d[0][0] / areal_kg_m2 * triangle.largest());
        }
        let still = vec![[0.0; 3]; mesh.points.len()];
        Membrane {
            x: mesh.points.clone(),
            v: still.clone(),
            f: still,
            mass_kg,
            triangles,
            stiffness: [d[0][0], d[0][1], d[1][1], d[2][2]],
            damping_1_s: problem.settings.mass_damping_1_s,
            air: problem.chambers[0].clone(),
            time_s: 0.0,
            dt_s: 0.9 * 2.0 / fastest_1_s2.sqrt(),
        }
    }

    /// Number of triangles, two for every quadrilateral.
    pub fn triangles(&self) -> usize {
        self.triangles.len()
    }
    /// Length of every step, 0.9 of the stability limit \[s\].
    pub fn dt_s(&self) -> f64 {
        self.dt_s
    }

    /// Takes so many steps of the explicit motion.
    pub fn advance_by(&mut self, steps: u64) {
        for _ in 0..steps {
            self.forces(self.air.pressure.filling().at(self.time_s));
            self.move_nodes();
            self.time_s += self.dt_s;
        }
    }

    fn forces(&mut self, pressure_pa: f64) {
        let (x, f, [d11, d12, d22, d66]) = (&self.x, &mut self.f, self.stiffness);
        for Triangle { node: [n0, n1, n2], b, area_m2 } in &self.triangles {
            let (x0, x1, x2) = (x[*n0], x[*n1], x[*n2]);
            let u = [x1[0] - x0[0], x1[1] - x0[1], x1[2] - x0[2]];
            let v = [x2[0] - x0[0], x2[1] - x0[1], x2[2] - x0[2]];
            let mut f1 = [0.0; 3];
            let mut f2 = [0.0; 3];
            for k in 0..3 {
                f1[k] = b[0][0] * u[k] + b[1][0] * v[k];
                f2[k] = b[0][1] * u[k] + b[1][1] * v[k];
            }
            let e11 = 0.5 * (f1[0] * f1[0] + f1[1] * f1[1] + f1[2] * f1[2] - 1.0);
            let e22 = 0.5 * (f2[0] * f2[0] + f2[1] * f2[1] + f2[2] * f2[2] - 1.0);
            let e12 = f1[0] * f2[0] + f1[1] * f2[1] + f1[2] * f2[2];
            let t11 = area_m2 * (d11 * e11 + d12 * e22);
            let t22 = area_m2 * (d12 * e11 + d22 * e22);
            let t12 = area_m2 * (d66 * e12);
            let normal = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
            for k in 0..3 {
                let r1 = t11 * f1[k] + t12 * f2[k];
                let r2 = t12 * f1[k] + t22 * f2[k];
                let p1 = b[0][0] * r1 + b[0][1] * r2;
                let p2 = b[1][0] * r1 + b[1][1] * r2;
                let push = pressure_pa / 6.0 * normal[k];
                f[*n0][k] += push + p1 + p2;
                f[*n1][k] += push - p1;
                f[*n2][k] += push - p2;
            }
        }
    }

    fn move_nodes(&mut self) {
        let half = 0.5 * self.damping_1_s * self.dt_s;
        let (keep, gain) = ((1.0 - half) / (1.0 + half), self.dt_s / (1.0 + half));
        for i in 0..self.x.len() {
            let over = gain / self.mass_kg[i];
            for k in 0..3 {
                self.v[i][k] = keep * self.v[i][k] + over * self.f[i][k];
                self.x[i][k] += self.dt_s * self.v[i][k];
                self.f[i][k] = 0.0;
            }
        }
    }
}

impl Triangle {
    fn new(node: [usize; 3], points: &[[f64; 3]]) -> Triangle {
        let [a, b, c] = node.map(|n| points[n]);
        let (u, v) = ([b[0] - a[0], b[1] - a[1]], [c[0] - a[0], c[1] - a[1]]);
        let twice = u[0] * v[1] - u[1] * v[0];
        let b = [[v[1] / twice, -v[0] / twice], [-u[1] / twice, u[0] / twice]];
        Triangle { node, b, area_m2: 0.5 * twice.abs() }
    }

    /// Largest eigenvalue of Σ g gᵀ over the gradients of the corners' shapes \[1/m²\].
    fn largest(&self) -> f64 {
        let [g1, g2] = self.b;
        let g0 = [-g1[0] - g2[0], -g1[1] - g2[1]];
        let sum = |i: usize, j: usize| [g0, g1, g2].iter().map(|g| g[i] * g[j]).sum::<f64>();
        let (a, b, c) = (sum(0, 0), sum(1, 1), sum(0, 1));
        0.5 * (a + b) + (0.25 * (a - b) * (a - b) + c * c).sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_is_the_pillow_that_the_engine_blows_up() {
        let problem = crate::speed::workloads::pillow(16, false).unwrap();
        let mut plain = Membrane::new(&problem);
        assert_eq!(plain.triangles(), 4 * 16 * 16);
        plain.advance_by((0.15 / plain.dt_s()) as u64);
        let mut engine = fem::Simulation::new(&problem).unwrap();
        engine.advance_until(0.15, &mut |_| true).unwrap();
        let high = |z: Vec<f64>| z.iter().fold(0.0, |most: f64, z| most.max(*z));
        let plain_m = high(plain.x.iter().map(|p| p[2]).collect());
        let engine_m = high(engine.positions().iter().map(|p| p[2]).collect());
        // Triangles of constant strain lock: 0.18 to 0.21 m on such a mesh, 0.214 of one-point quadrilaterals.
        assert!((0.8..1.02).contains(&(plain_m / engine_m)), "{plain_m} {engine_m}");
    }
}
