//! Pressure, volume and work of the chambers during a run.

use serde::{Deserialize, Serialize};

use super::Element;
use crate::mesh::Mesh;
use crate::mesh::check::{planes, rim};
use crate::policy;
use crate::problem::{Chamber, Pressure};
use crate::vec3::{Nodes, V3, add, cross, node, scale, sub};

/// A chamber while a run goes on.
#[derive(Debug, Clone)]
pub struct Air {
    chamber: Chamber,
    /// Elements of its wall, and +1 where their front is outside.
    wall: Vec<(u32, f64)>,
    /// Area of the wall at rest \[m²\].
    area_m2: f64,
    /// Where the chamber ends at planes of all three axes.
    cut: Option<PlaneRim>,
    /// Pressure, gas and other state that changes with time.
    pub now: AirNow,
}

/// One plane perpendicular to an axis, and the edges of the wall at all planes, run along with the outside in front.
#[derive(Debug, Clone)]
struct PlaneRim {
    axis: usize,
    at_m: f64,
    rim: Vec<[u32; 2]>,
}

/// What a checkpoint holds of a chamber.
#[derive(Debug, Clone, Copy, Default, Serialize, Deserialize)]
pub struct AirNow {
    /// Gauge pressure in the chamber now \[Pa\].
    pub pressure_pa: f64,
    /// Volume at the last step \[m³\]; `None` before the first.
    pub volume_m3: Option<f64>,
    /// Pressure when the volume was taken last \[Pa\].
    booked_pa: f64,
    /// Work done on the fabric so far \[J\].
    pub(crate) work_j: f64,
    /// P (V + V_d)ⁿ since sealing, and its time \[s\].
    content: Option<(f64, f64)>,
}

impl Air {
    /// At rest, before the first step.
    pub fn new(chamber: &Chamber, mesh: &Mesh, elements: &[Element]) -> Air {
        let faces = |name: &Option<String>| f64::from(u8::from(name.as_ref() == Some(&chamber.name)));
        let side: Vec<f64> = mesh.parts.iter().map(|part| faces(&part.back) - faces(&part.front)).collect();
        let of = |(index, element): (usize, &Element)| (index as u32, side[element.part]);
        let wall: Vec<(u32, f64)> = elements.iter().enumerate().map(of).filter(|(_, side)| *side != 0.0).collect();
        let area_m2 = wall.iter().map(|(index, _)| elements[*index as usize].reference.area).sum();
        let mut air = Air { chamber: chamber.clone(), wall, area_m2, cut: None, now: AirNow::default() };
        air.now.pressure_pa = air.supply(0.0);
        air
    }

    /// Finds the plane from which the volume is counted where the chamber is open along all axes.
    pub fn cut(&mut self, mesh: &Mesh, fixed: &[[bool; 3]]) {
        if self.chamber.open_axis != Some([true; 3]) {
            return;
        }
        let rim = rim(mesh, &self.chamber.name);
        let planes = planes(mesh, &rim, |node, axis| fixed[node as usize][axis]);
        let single = (0..3).find(|k| planes[*k].len() == 1);
        self.cut = single.map(|axis| PlaneRim { axis, at_m: planes[axis][0], rim });
    }

    /// Name of the chamber, as in the problem.
    pub fn name(&self) -> &str {
        &self.chamber.name
    }

    /// Pressure that the supply sets \[Pa\].
    fn supply(&self, t: f64) -> f64 {
        self.chamber.pressure.filling().at(t)
    }

    /// Largest pressure that the supply ever sets, and the gas had so far \[Pa\].
    pub fn peak_pa(&self) -> f64 {
        self.chamber.pressure.filling().peak().max(self.now.pressure_pa.abs())
    }

    /// True if its walls have passed through each other and the pressure does not part them again: below the room's, or of enclosed gas.
    pub(crate) fn is_inside_out(&self) -> bool {
        let closes = self.now.pressure_pa < 0.0 || self.follows();
        closes && policy::is_inside_out(self.now.volume_m3.unwrap_or(0.0) / self.area_m2.powf(1.5))
    }

    /// True if the gas decides the pressure at some time: the volume is then taken at every step, before the forces.
    pub fn follows(&self) -> bool {
        matches!(self.chamber.pressure, Pressure::Sealed { .. })
    }

    /// True if the pressure has changed by more than a hundredth since the work ∫p dV was booked.
    pub(crate) fn wants_volume(&self) -> bool {
        !self.follows() && (self.now.pressure_pa - self.now.booked_pa).abs() > 0.01 * self.now.pressure_pa.abs()
    }

    /// Sets the pressure for a step at time `t`; books the work of a chamber that follows its volume.
    pub fn advance(&mut self, t: f64, elements: &[Element], q: &Nodes) {
        let volume = self.follows().then(|| self.volume_at(elements, q));
        self.now.pressure_pa = match (&self.chamber.pressure, volume) {
            (Pressure::Sealed { sealed_at_s, gas, .. }, Some(volume)) if t >= *sealed_at_s => {
                let all = volume + gas.dead_m3;
                let (pressure_pa, content) = match self.now.content {
                    // Inside out: what stopped making sense goes on unchanged until a guard sees it.
                    _ if all <= 0.0 => (self.now.pressure_pa, self.now.content),
                    None => gas.sealed(self.supply(*sealed_at_s), all, t),
                    Some((content, before_s)) => gas.flows(content, all, before_s, t),
                };
                self.now.content = content;
                pressure_pa
            }
            _ => self.supply(t),
        };
        if let Some(volume) = volume {
            self.take_volume(volume);
        }
    }

    /// Takes the volume of this step and books the work ½(p + p′)ΔV since the last time.
    pub(crate) fn take_volume(&mut self, volume_m3: f64) {
        if let Some(before) = self.now.volume_m3 {
            self.now.work_j += 0.5 * (self.now.pressure_pa + self.now.booked_pa) * (volume_m3 - before);
        }
        self.now.booked_pa = self.now.pressure_pa;
        self.now.volume_m3 = Some(volume_m3);
    }

    /// Volume from the fluxes ∫ x n_x, ∫ y n_y, ∫ z n_z of the wall: their mean over the axes along which it is not open. Where it is
    /// along all, ∫ (x − c) n_x from the one plane at c, with ∫ n dA = ½ ∮ x × dx.
    pub(crate) fn volume_of(&self, flux: V3, q: &Nodes) -> f64 {
        if let Some(PlaneRim { axis, at_m, rim }) = &self.cut {
            let area = |[a, b]: &[u32; 2]| 0.5 * cross(node(q, *a as usize), node(q, *b as usize))[*axis];
            return flux[*axis] - at_m * rim.iter().map(area).sum::<f64>();
        }
        let open = self.chamber.open_axis.unwrap_or([false; 3]);
        let closed = || (0..3).filter(|k| !open[*k]).map(|k| flux[k]);
        closed().sum::<f64>() / closed().count() as f64
    }

    /// Volume at positions `q`, of the wall with its quadrilaterals as the pressure sees them: with x = m + ξ a + η b + ξη c,
    /// ∫ x n dA = 4 m (a × b) + ⁴⁄₃ [a (a × c) + b (c × b)], axis by axis.
    fn volume_at(&self, elements: &[Element], q: &Nodes) -> f64 {
        let mut flux = [0.0; 3];
        for (index, side) in &self.wall {
            let element = &elements[*index as usize];
            let x: [[f64; 3]; 4] = element.node.map(|n| node(q, n as usize));
            let [mid, more] = if element.corners == 4 {
                let [d, e] = [sub(x[2], x[0]), sub(x[3], x[1])];
                let [a, b] = [scale(sub(d, e), 0.25), scale(add(d, e), 0.25)];
                let c = scale(sub(add(x[0], x[2]), add(x[1], x[3])), 0.25);
                let (first, second) = (cross(a, c), cross(c, b));
                let mid = scale(add(add(x[0], x[1]), add(x[2], x[3])), 0.25);
                let normal = scale(cross(a, b), 4.0);
                let part = |k: usize| 4.0 / 3.0 * (a[k] * first[k] + b[k] * second[k]);
                [[0, 1, 2].map(|k| mid[k] * normal[k]), [0, 1, 2].map(part)]
            } else {
                let normal = scale(cross(sub(x[1], x[0]), sub(x[2], x[0])), 0.5);
                [[0, 1, 2].map(|k| (x[0][k] + x[1][k] + x[2][k]) / 3.0 * normal[k]), [0.0; 3]]
            };
            (0..3).for_each(|k| flux[k] += side * (mid[k] + more[k]));
        }
        self.volume_of(flux, q)
    }

    /// Adds to the nodes the stiffness of the gas at positions `q`, |∂V/∂xᵢ| Σ|∂V/∂xⱼ| n P/(V + V_d), where it decides the pressure
    /// before `until_s` \[N/m\]. Row sums of the matrix: no mode is stiffer.
    pub(crate) fn add_bound(&self, until_s: f64, elements: &[Element], q: &Nodes, bound: &mut [f64]) {
        let Pressure::Sealed { sealed_at_s, gas, .. } = &self.chamber.pressure else { return };
        let all = self.volume_at(elements, q) + gas.dead_m3;
        if until_s < *sealed_at_s || all <= 0.0 {
            return;
        }
        let spring = gas.exponent * (self.now.pressure_pa + gas.atmosphere_pa) / all * self.area_m2;
        for element in self.wall.iter().map(|(index, _)| &elements[*index as usize]) {
            let share = element.reference.area / element.corners as f64;
            for n in element.nodes().iter() {
                bound[*n as usize] += spring * share;
            }
        }
    }
}
