//! Shells: membrane, hourglass control, viscosity, bending and follower pressure in one pass over the mesh.
//!
//! [`Sheet`] is one [`Term`]; `fem/tests/plain` holds the same physics one element at a time, and a test holds both against
//! each other.

pub mod bending;
pub mod bound;
pub mod chamber;
pub mod edge;
pub mod fields;
pub mod group;
mod kernel;
pub(crate) mod lanes;
mod law;
pub mod order;
mod patch;
pub mod reference;

use std::collections::BTreeMap;
use std::sync::Arc;

use models::fabrics::Past;
use models::{Account, Fabric, LedgerLine, Pose, Row, Term};

use crate::bytes::{pack, unpack};
use crate::mesh::Mesh;
use crate::problem::{Chamber, Section, Settings};
use crate::transient::{dissipated, stored, supplied};
use crate::vec3::V3;
use crate::{FemError, NODE, Result, Tick, Transient};
pub use reference::Element;

use bending::BendingMatrix;
use chamber::{Air, AirNow};
use group::Item;
use patch::{LoopKey, PassShared, Patch};
use reference::{Reference, mean_stiffness};

/// All shells of a run, with the air in their chambers.
#[derive(Debug, Clone)]
pub struct Sheet {
    /// Elements of all parts, in the order of the mesh.
    pub elements: Vec<Element>,
    /// Fabric of each part, all plies together.
    pub fabrics: Vec<Arc<dyn Fabric>>,
    /// Mass per area of each part \[kg/m²\].
    pub(crate) areal_density: Vec<f64>,
    /// Chambers in the order of the problem.
    pub air: Vec<Air>,
    /// Row sums of |K| in bending, for the stable step \[N/m\]; of K itself the patches keep what they need.
    bending_bound: Vec<f64>,
    patches: Vec<Patch>,
    viscous_j: f64,
    /// Damping ξ of the membrane, a share of the critical one.
    viscosity: f64,
    /// Take energies and volumes in the next step whatever its number, because somebody will look at the ledger.
    pub measure: bool,
    arch: pulp::Arch,
}

impl Sheet {
    /// Prepares the shells of a mesh whose nodes are in [`order::Order`].
    ///
    /// # Errors
    /// A part without section or an unknown chamber.
    pub fn new(
        mesh: &Mesh,
        order: &order::Order,
        sections: &[Section],
        chambers: &[Chamber],
        settings: &Settings,
    ) -> Result<Sheet> {
        let fabrics = sections.iter().map(fabric_of).collect::<Result<Vec<Arc<dyn Fabric>>>>()?;
        let weight = |s: &Section| s.density_kg_m3 * s.plies.iter().map(|p| p.fabric.thickness_m()).sum::<f64>();
        let areal_density: Vec<f64> = sections.iter().map(weight).collect();
        let elements = elements(mesh, sections, &fabrics, settings);
        let stiffness: Vec<f64> = sections.iter().map(reference::bending_stiffness).collect();
        let bending = BendingMatrix::of(mesh, &stiffness);
        let mut sheet = Sheet {
            air: chambers.iter().map(|chamber| Air::new(chamber, mesh, &elements)).collect(),
            elements,
            fabrics,
            areal_density,
            bending_bound: (0..mesh.points.len()).map(|i| bending.row(i).map(|(_, k)| k.abs()).sum()).collect(),
            patches: Vec::new(),
            viscous_j: 0.0,
            viscosity: settings.viscosity,
            measure: false,
            arch: pulp::Arch::new(),
        };
        sheet.patches = sheet.make_patches(mesh, order, &bending, chambers)?;
        Ok(sheet)
    }

    fn make_patches(
        &self,
        mesh: &Mesh,
        order: &order::Order,
        bending: &BendingMatrix,
        chambers: &[Chamber],
    ) -> Result<Vec<Patch>> {
        let mut patch_of = vec![0_u32; mesh.points.len()];
        for (p, nodes) in order.patches.iter().enumerate() {
            patch_of[nodes.clone()].fill(p as u32);
        }
        let keys =
            mesh.parts.iter().zip(law::loops(&self.fabrics)).map(|(part, fabric)| key_of(fabric, part, chambers));
        let keys = keys.collect::<Result<Vec<LoopKey>>>()?;
        // Elements that touch each patch, and whether it counts them.
        let mut touching: Vec<Vec<(u32, bool)>> = vec![Vec::new(); order.patches.len()];
        for (index, element) in self.elements.iter().enumerate() {
            let mut touched = [0; 4].map(|_: u32| u32::MAX);
            let nodes = element.nodes();
            for (touched, node) in touched.iter_mut().zip(nodes) {
                *touched = patch_of[*node as usize];
            }
            for (k, patch) in
                touched[..nodes.len()].iter().enumerate().filter(|(k, patch)| !touched[..*k].contains(patch))
            {
                touching[*patch as usize].push((index as u32, k == 0));
            }
        }
        let memory = self.fabrics.iter().any(|f| f.has_memory());
        let patch = |(nodes, touching): (&std::ops::Range<usize>, Vec<(u32, bool)>)| {
            let mut items: BTreeMap<LoopKey, Vec<Item>> = BTreeMap::new();
            for (index, own) in touching {
                let element = &self.elements[index as usize];
                let key = LoopKey { corners: element.corners, ..keys[element.part] };
                items.entry(key).or_default().push(self.item(index as usize, own));
            }
            Patch::new(nodes.clone(), items, bending, &order.old, memory)
        };
        Ok(order.patches.iter().zip(touching).map(patch).collect())
    }

    fn item(&self, index: usize, own: bool) -> Item {
        let element = &self.elements[index];
        let fabric = &*self.fabrics[element.part];
        Item {
            node: element.nodes().to_vec(),
            reference: element.reference,
            law: law::own(fabric),
            hourglass: element.hourglass,
            viscosity: self.viscosity_n_s_m(element),
            own,
            part: element.part as u32,
            element: index as u32,
        }
    }

    /// Lumped masses \[kg\]: each element gives equal shares to its corners.
    pub fn masses(&self, nodes: usize) -> Vec<f64> {
        let mut mass = vec![0.0; nodes];
        for element in &self.elements {
            let share = self.areal_density[element.part] * element.reference.area / element.corners as f64;
            for n in element.nodes().iter() {
                mass[*n as usize] += share;
            }
        }
        mass
    }

    /// Makes the viscosity start from the strains at `q`.
    pub fn start(&mut self, q: &[f64]) {
        let pressure: Vec<f64> = self.air.iter().map(|a| a.now.pressure_pa).collect();
        let (q, fabrics, arch) = (q.as_chunks().0, &self.fabrics[..], self.arch);
        let shared = PassShared { q, fabrics, pressure_pa: &pressure, rate: 0.0, books: false, arch };
        for p in self.patches.iter_mut() {
            p.start_strains(shared);
        }
    }

    /// Energy held in membrane, bending and hourglass control at the last step \[J\].
    fn stored(&self) -> V3 {
        let mut sum = [0.0; 3];
        for patch in &self.patches {
            sum[0] += patch.sums.membrane;
            sum[1] += patch.sums.bending;
            sum[2] += patch.sums.hourglass;
        }
        sum
    }

    fn volumes(&self, q: &[f64]) -> Vec<f64> {
        let mut flux = vec![[0.0; 3]; self.air.len()];
        for patch in &self.patches {
            for (sum, part) in flux.iter_mut().zip(&patch.flux) {
                (0..3).for_each(|k| sum[k] += part[k]);
            }
        }
        self.air.iter().zip(flux).map(|(air, flux)| air.volume_of(flux, q.as_chunks().0)).collect()
    }

    fn pass(&mut self, q: &[f64], force: &mut [f64], rate: f64, books: bool, keep: bool) {
        let pressure: Vec<f64> = self.air.iter().map(|a| a.now.pressure_pa).collect();
        let (q, fabrics, arch) = (q.as_chunks().0, &self.fabrics[..], self.arch);
        let shared = PassShared { q, fabrics, pressure_pa: &pressure, rate, books, arch };
        over_patches(&mut self.patches, force.as_chunks_mut().0, &|patch, force| patch.pass(shared, force, keep));
    }
}

/// Most steps between two measurements of energies and volumes: forces do not need them, only the work ∫p dV does.
const BOOKS_EVERY: u64 = 8;

impl Term for Sheet {
    fn line(&self) -> LedgerLine {
        LedgerLine::new("shells", Account::Stretch)
    }

    /// Membrane, hourglass and bending energy minus Σ pV at the pressures of the last step, without viscosity.
    fn add(&self, at: &Pose, force: &mut [f64]) -> f64 {
        let mut copy = self.clone();
        copy.pass(at.q, force, 0.0, true, false);
        let work: f64 = copy.air.iter().zip(copy.volumes(at.q)).map(|(air, v)| air.now.pressure_pa * v).sum();
        copy.stored().iter().sum::<f64>() - work
    }
}

impl Transient for Sheet {
    fn advance(&mut self, at: &Pose, tick: &Tick, force: &mut [f64]) -> f64 {
        let elements = &self.elements;
        for air in self.air.iter_mut() {
            air.advance(tick.time_s, elements, at.q.as_chunks().0);
        }
        let books = self.measure || tick.step.is_multiple_of(BOOKS_EVERY) || self.air.iter().any(Air::wants_volume);
        self.pass(at.q, force, 1.0 / tick.dt_s, books, true);
        self.viscous_j += self.patches.iter().map(|p| p.sums.viscous).sum::<f64>();
        if books {
            let volumes = self.volumes(at.q);
            let set = self.air.iter_mut().zip(volumes).filter(|(air, _)| !air.follows());
            set.for_each(|(air, volume)| air.take_volume(volume));
        }
        self.stored().iter().sum()
    }

    fn ledger(&self, _at: &Pose) -> Vec<Row> {
        let [membrane, bending, hourglass] = self.stored();
        let mut rows = vec![
            stored("membrane", Account::Stretch, membrane),
            stored("bending", Account::Wall, bending),
            stored("hourglass", Account::Numerical, hourglass),
            dissipated("viscosity", Account::Numerical, self.viscous_j),
        ];
        if self.fabrics.iter().any(|f| f.has_memory()) {
            let lost = self.patches.iter().map(|p| p.sums.hysteresis).sum();
            rows.push(dissipated("fabric hysteresis", Account::Stretch, lost));
        }
        if !self.air.is_empty() {
            let work = self.air.iter().map(|a| a.now.work_j).sum();
            rows.push(supplied("pressure", Account::ActuatorGas, work));
        }
        rows
    }

    fn stiffness_bound(&self, at: &Pose, bound: &mut [f64]) {
        self.add_bound(at.q, bound);
    }

    fn save(&self) -> Vec<u8> {
        let air: Vec<AirNow> = self.air.iter().map(|air| air.now).collect();
        let patches: Vec<_> = self.patches.iter().map(|p| (p.sums, &p.strains, &p.past)).collect();
        pack(&(self.viscous_j, air, patches))
    }

    fn restore(&mut self, saved: &[u8]) -> Option<()> {
        let (viscous_j, air, patches): SavedSheet = unpack(saved)?;
        let alike = |(own, (_, strains, past)): (&Patch, &SavedPatch)| {
            [own.strains.len(), own.past.len()] == [strains.len(), past.len()]
        };
        let fits = [air.len(), patches.len()] == [self.air.len(), self.patches.len()]
            && self.patches.iter().zip(&patches).all(alike);
        fits.then_some(())?;
        self.viscous_j = viscous_j;
        for (own, now) in self.air.iter_mut().zip(air) {
            own.now = now;
        }
        for (own, (sums, strains, past)) in self.patches.iter_mut().zip(patches) {
            (own.sums, own.strains, own.past) = (sums, strains, past);
        }
        Some(())
    }
}

/// Heat of viscosity, chambers and patches in a checkpoint.
type SavedSheet = (f64, Vec<AirNow>, Vec<SavedPatch>);
type SavedPatch = (patch::Sums, Vec<kernel::Strain>, Vec<[Past; group::LANES]>);

fn fabric_of(section: &Section) -> Result<Arc<dyn Fabric>> {
    match section.plies.as_slice() {
        [one] => Ok(one.fabric.clone()),
        plies => {
            let laminate = models::fabrics::Laminate::new(plies.to_vec()).map_err(FemError::Problem)?;
            Ok(Arc::new(laminate))
        }
    }
}

fn key_of(fabric: usize, part: &crate::mesh::Part, chambers: &[Chamber]) -> Result<LoopKey> {
    let find = |name: &Option<String>| {
        let Some(name) = name else { return Ok(None) };
        let place = chambers.iter().position(|c| c.name == *name).map(Some);
        let message = || format!("part `{}` faces chamber `{name}`, which is not defined", part.name);
        place.ok_or_else(|| FemError::Problem(message()))
    };
    Ok(LoopKey { corners: 4, fabric, front: find(&part.front)?, back: find(&part.back)? })
}

fn elements(mesh: &Mesh, sections: &[Section], fabrics: &[Arc<dyn Fabric>], settings: &Settings) -> Vec<Element> {
    let mut all = Vec::with_capacity(mesh.elements());
    for (p, part) in mesh.parts.iter().enumerate() {
        // One ply: its axes are the element's. Several: the laminate turns each into the part's axes.
        let angle = if sections[p].plies.len() == 1 { sections[p].plies[0].angle_rad } else { 0.0 };
        let stiffness = mean_stiffness(&*fabrics[p]);
        for i in 0..part.len() {
            let nodes = part.nodes(i);
            let corner: Vec<[f64; 3]> = nodes.iter().map(|n| mesh.free_of(*n as usize)).collect();
            let reference = Reference::new(&corner, part.warp_of(i), angle);
            let hourglass = if nodes.len() == 4 { hourglass(&reference, settings.hourglass * stiffness) } else { 0.0 };
            let node = std::array::from_fn(|k| nodes[k.min(nodes.len() - 1)]);
            all.push(Element { node, corners: nodes.len(), part: p, reference, hourglass });
        }
    }
    all
}

/// k = 4 hg A·λ_max(Σ B Bᵀ)·A₁₁: hg = ⅓ would be the stiffness of a fully integrated square.
fn hourglass(reference: &Reference, stiffness: f64) -> f64 {
    let [g11, g22, g12] = reference.metric(4);
    let largest = 0.5 * (g11 + g22) + (0.25 * (g11 - g22) * (g11 - g22) + g12 * g12).sqrt();
    4.0 * stiffness * reference.area * largest
}

/// Runs `job` over all patches with their slices of `force`, in parallel.
fn over_patches<'a>(
    patches: &mut [Patch],
    force: &'a mut [[f64; NODE]],
    job: &(impl Fn(&mut Patch, &'a mut [[f64; NODE]]) + Sync),
) {
    match patches {
        [] => {}
        [one] => job(one, force),
        many => {
            let (low, high) = many.split_at_mut(many.len() / 2);
            let here: usize = low.iter().map(|p| p.nodes.len()).sum();
            let (force_low, force_high) = force.split_at_mut(here);
            rayon::join(|| over_patches(low, force_low, job), || over_patches(high, force_high, job));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::case::{Case, shipped_case};

    /// Forces and energies of a shaken pillow on the given vector instructions.
    fn bits_on(arch: pulp::Arch) -> (Vec<u64>, Vec<Row>) {
        let problem = Case::parse(shipped_case("pillow").unwrap(), &mut |_| unreachable!()).unwrap().problem;
        let order = order::Order::of(&problem.mesh);
        let mesh = order::renumber(&problem.mesh, &order);
        let mut sheet = Sheet::new(&mesh, &order, &problem.sections, &problem.chambers, &problem.settings).unwrap();
        sheet.arch = arch;
        let shake = |i: usize, k: usize| 1e-3 * ((i * 7919 + k * 104_729) as f64 * 0.618_033_988).fract();
        let node = |(i, p): (usize, &[f64; 3])| [p[0] + shake(i, 0), p[1] + shake(i, 1), p[2] + shake(i, 2), 0.0];
        let q: Vec<f64> = mesh.points.iter().enumerate().flat_map(node).collect();
        let mut force = vec![0.0; q.len()];
        let tick = Tick { step: 0, time_s: 0.03, dt_s: 1e-5 };
        sheet.advance(&Pose::nodes(&q), &tick, &mut force);
        (force.iter().map(|f| f.to_bits()).collect(), sheet.ledger(&Pose::nodes(&q)))
    }

    #[test]
    fn every_width_of_vector_registers_gives_the_same_bits() {
        let (widest, scalar) = (bits_on(pulp::Arch::new()), bits_on(pulp::Arch::Scalar));
        assert!(widest.0.iter().any(|bits| *bits != 0));
        assert_eq!(widest, scalar);
    }
    #[test]
    fn what_another_patch_or_run_left_in_the_room_changes_no_bit() {
        let fresh = bits_on(pulp::Arch::new());
        patch::room::Room::spoil();
        assert_eq!(bits_on(pulp::Arch::new()), fresh);
    }
}
