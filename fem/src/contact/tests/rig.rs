//! A mass-spring fabric stepped by central differences, small enough to live in a test.

use models::{Pose, RowKind};

use crate::contact::LayerContact;
use crate::mesh::{Mesh, Part};
use crate::vec3::{V3, add, along, cross, dot, norm, scale, sub};
use crate::{FemError, problem};
use crate::{Tick, Transient};

/// Areal mass \[kg/m²\] and stretching stiffness \[N/m\] of the fabric: 0.2 mm at 1000 kg/m³ and 50 MPa.
pub(crate) const AREAL: f64 = 0.2;
pub(crate) const STIFF: f64 = 1e4;

/// Adds a part of n × m quads; `place` maps the unit square to space, fronts up for a right-handed map.
pub(crate) fn sheet(mesh: &mut Mesh, layer: u32, n: usize, m: usize, place: impl Fn(f64, f64) -> V3) {
    let base = mesh.points.len() as u32;
    for j in 0..=m {
        for i in 0..=n {
            mesh.points.push(place(i as f64 / n as f64, j as f64 / m as f64));
        }
    }
    let at = |i: usize, j: usize| base + (j * (n + 1) + i) as u32;
    let quads = (0..m).flat_map(|j| (0..n).map(move |i| (i, j)));
    let quads = quads.map(|(i, j)| [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]).collect();
    mesh.parts.push(Part { name: format!("sheet {}", mesh.parts.len() + 1), quads, layer, ..Part::default() });
}

/// A flat square sheet of side `side_m` around a centre, turned about z.
pub(crate) fn flat(mesh: &mut Mesh, layer: u32, n: usize, side_m: f64, centre: V3, turn_rad: f64) {
    let (s, c) = turn_rad.sin_cos();
    sheet(mesh, layer, n, n, |u, v| {
        let (x, y) = ((u - 0.5) * side_m, (v - 0.5) * side_m);
        add(centre, [c * x - s * y, s * x + c * y, 0.0])
    });
}

pub(crate) fn masses(mesh: &Mesh) -> Vec<f64> {
    let mut mass = vec![0.0; mesh.points.len()];
    for quad in mesh.parts.iter().flat_map(|p| &p.quads) {
        let x = quad.map(|n| mesh.points[n as usize]);
        let share = 0.125 * norm(cross(sub(x[2], x[0]), sub(x[3], x[1]))) * AREAL;
        quad.iter().for_each(|n| mass[*n as usize] += share);
    }
    mass
}

pub(crate) struct Rig {
    pub mesh: Mesh,
    pub mass: Vec<f64>,
    springs: Vec<(u32, u32, f64)>,
    pub contact: LayerContact,
    pub x: Vec<[f64; 4]>,
    pub v: Vec<[f64; 4]>,
    pub dt: f64,
    pub gravity: V3,
    /// Pressure on the front of each part \[Pa\]; its work is measured, not potential.
    pub pressure: Vec<f64>,
    pub alpha: f64,
    pub fixed: Vec<bool>,
    pub step: u64,
    pub kinetic: f64,
    pub work: f64,
    pub damped: f64,
    pub stored: f64,
    load: Vec<[f64; 4]>,
}

impl Rig {
    pub(crate) fn new(mesh: Mesh, settings: &problem::Contact) -> Result<Rig, FemError> {
        let mass = masses(&mesh);
        let mut edges = Vec::new();
        for [a, b, c, d] in mesh.parts.iter().flat_map(|p| p.quads.iter().copied()) {
            edges.extend([(a, b), (b, c), (c, d), (d, a), (a, c), (b, d)].map(|(a, b)| (a.min(b), a.max(b))));
        }
        edges.sort_unstable();
        edges.dedup();
        let length = |(a, b): &(u32, u32)| norm(sub(mesh.points[*a as usize], mesh.points[*b as usize]));
        let springs: Vec<_> = edges.iter().map(|e| (e.0, e.1, length(e))).collect();
        let mut stiff = vec![0.0; mass.len()];
        springs.iter().for_each(|s| [s.0, s.1].iter().for_each(|n| stiff[*n as usize] += 2.0 * STIFF));
        let omega2 = stiff.iter().zip(&mass).map(|(k, m)| k / m).fold(0.0, f64::max);
        let dt = 0.6 * 2.0 / f64::sqrt(omega2);
        let contact = LayerContact::new(&mesh, settings, &mass, dt)?;
        let x: Vec<_> = (0..mass.len()).map(|i| mesh.start_of(i)).map(|p| [p[0], p[1], p[2], 0.0]).collect();
        Ok(Rig {
            v: vec![[0.0; 4]; x.len()],
            load: vec![[0.0; 4]; x.len()],
            fixed: vec![false; x.len()],
            pressure: vec![0.0; mesh.parts.len()],
            gravity: [0.0; 3],
            alpha: 0.0,
            step: 0,
            kinetic: 0.0,
            work: 0.0,
            damped: 0.0,
            stored: 0.0,
            mesh,
            mass,
            springs,
            contact,
            x,
            dt,
        })
    }

    pub(crate) fn p(&self, i: usize) -> V3 {
        crate::vec3::node(&self.x, i)
    }

    fn stretch(&self, force: &mut [[f64; 4]]) -> f64 {
        let mut energy = 0.0;
        for &(a, b, length) in &self.springs {
            let r = sub(self.p(b as usize), self.p(a as usize));
            let now = norm(r);
            let tension = STIFF * (now - length);
            energy += 0.5 * STIFF * (now - length) * (now - length);
            super::super::push(&mut force[a as usize], tension / now, r);
            super::super::push(&mut force[b as usize], -tension / now, r);
        }
        energy
    }

    fn loads(&self) -> Vec<[f64; 4]> {
        let mut load = vec![[0.0; 4]; self.x.len()];
        for (f, m) in load.iter_mut().zip(&self.mass) {
            super::super::push(f, *m, self.gravity);
        }
        for (part, p) in self.mesh.parts.iter().zip(&self.pressure).filter(|(_, p)| **p != 0.0) {
            for quad in &part.quads {
                let x = quad.map(|n| self.p(n as usize));
                let area = scale(cross(sub(x[2], x[0]), sub(x[3], x[1])), 0.5);
                quad.iter().for_each(|n| super::super::push(&mut load[*n as usize], -0.25 * p, area));
            }
        }
        load
    }

    /// One step; energies are those at the positions before it.
    pub(crate) fn step(&mut self, before: &[[f64; 4]]) -> Vec<[f64; 4]> {
        let load = self.loads();
        let mut force = load.clone();
        self.stored = self.stretch(&mut force);
        let tick = Tick { step: self.step, time_s: self.step as f64 * self.dt, dt_s: self.dt };
        let at = self.x.clone();
        self.contact.advance(&Pose::nodes(at.as_flattened()), &tick, force.as_flattened_mut());
        self.kinetic = 0.0;
        for i in 0..self.x.len() {
            let moved = sub(crate::vec3::node(&at, i), crate::vec3::node(before, i));
            for k in 0..3 {
                self.work += 0.5 * (load[i][k] + self.load[i][k]) * moved[k];
                let old = self.v[i][k];
                let half = if self.step == 0 { 0.5 } else { 1.0 };
                let new = old + half * self.dt * (force[i][k] / self.mass[i] - self.alpha * old);
                let new = if self.fixed[i] { 0.0 } else { new };
                self.kinetic += 0.5 * self.mass[i] * old * new;
                self.damped += 0.5 * self.mass[i] * self.alpha * old * (old + new) * self.dt;
                self.v[i][k] = new;
                self.x[i][k] += self.dt * new;
            }
        }
        self.load = load;
        self.step += 1;
        at
    }

    pub(crate) fn run(&mut self, steps: usize) {
        self.run_with(steps, |_| ());
    }

    pub(crate) fn run_with(&mut self, steps: usize, mut look: impl FnMut(&Rig)) {
        // The first step has no step before it; afterwards the way of a step is dt v.
        for _ in 0..steps {
            let before: Vec<[f64; 4]> = if self.step == 0 {
                self.x.clone()
            } else {
                self.x.iter().zip(&self.v).map(|(x, v)| [0, 1, 2, 3].map(|k| x[k] - self.dt * v[k])).collect()
            };
            self.step(&before);
            look(self);
        }
    }

    pub(crate) fn rows(&self) -> [f64; 3] {
        let rows = self.contact.ledger(&Pose::nodes(self.x.as_flattened()));
        assert_eq!(rows[0].kind, RowKind::Stored);
        [rows[0].energy_j, rows[1].energy_j, rows[2].energy_j]
    }

    /// What the balance misses \[J\], with `start` the energy at the start.
    pub(crate) fn residual(&self, start: f64) -> f64 {
        self.kinetic + self.stored + self.damped + self.rows().iter().sum::<f64>() - self.work - start
    }

    /// Moves everything of a part by a velocity.
    pub(crate) fn throw(&mut self, nodes: std::ops::Range<usize>, velocity: V3) {
        for v in &mut self.v[nodes] {
            *v = [velocity[0], velocity[1], velocity[2], 0.0];
        }
    }

    pub(crate) fn kinetic_of(&self, v: V3, nodes: std::ops::Range<usize>) -> f64 {
        0.5 * self.mass[nodes].iter().sum::<f64>() * dot(v, v)
    }
}

pub(crate) struct Noise(pub u64);

impl Noise {
    pub(crate) fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((self.0 >> 11) as f64 / (1_u64 << 52) as f64) - 1.0
    }
    pub(crate) fn point(&mut self, size: f64) -> V3 {
        along([0.0; 3], size, [self.next(), self.next(), self.next()])
    }
}
