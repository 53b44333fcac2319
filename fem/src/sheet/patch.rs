//! A patch: consecutive nodes, the elements that touch them, and one pass that gives the nodes their shell forces.

use std::collections::BTreeMap;
use std::ops::Range;

use models::Fabric;
use models::fabrics::{Kind, Past};
use pulp::Simd;

use super::bending::BendingMatrix;
use super::group::{Group, Item, LANES};
use super::kernel::{self, Batch, CornerForces, Strain, Tally};
use super::lanes::sum;
use super::law::{Called, Law};

/// What one pass over a patch adds up, in SI units.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Sums {
    /// Membrane energy \[J\].
    pub membrane: f64,
    /// Hourglass energy \[J\].
    pub hourglass: f64,
    /// Energy turned to heat by viscosity in this step \[J\].
    pub viscous: f64,
}

/// Elements that run through the same loop: same kind, fabric and chambers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Key {
    /// Corners, 3 or 4.
    pub corners: usize,
    /// Fabric number.
    pub fabric: usize,
    /// Chamber in front, if any.
    pub front: Option<usize>,
    /// Chamber behind, if any.
    pub back: Option<usize>,
}

/// A run of groups with one key.
#[derive(Debug, Clone)]
struct Run {
    key: Key,
    groups: Range<usize>,
}

/// Consecutive nodes and what their forces need.
#[derive(Debug, Clone)]
pub struct Patch {
    /// The nodes this patch owns.
    pub nodes: Range<usize>,
    runs: Vec<Run>,
    groups: Vec<Group>,
    /// Mesh number of the element in each lane, `u32::MAX` where it is another patch's to report.
    pub element: Vec<[u32; LANES]>,
    /// Where the forces on each own node's corners are: starts, then places in the flat corner forces.
    corner_start: Vec<u32>,
    corner_at: Vec<u32>,
    bend_start: Vec<u32>,
    bend_column: Vec<u32>,
    bend_value: Vec<f64>,
    /// Strains of the step before, one per group.
    pub strains: Vec<Strain>,
    /// Memory of fabrics that have one; empty otherwise.
    pub past: Vec<[Past; LANES]>,
    scratch: Vec<CornerForces>,
    /// What the last pass added up.
    pub sums: Sums,
    /// Bending energy of the own nodes \[J\].
    pub bending_j: f64,
    /// Energy lost in fabrics with memory \[J\].
    pub hysteresis_j: f64,
    /// Flux into each chamber, see [`super::chamber::Air::volume_of`].
    pub flux: Vec<[f64; 3]>,
}

/// What all patches share during a pass.
#[derive(Clone, Copy)]
pub struct Shared<'a> {
    /// Node positions.
    pub q: &'a [[f64; 4]],
    /// Fabrics by number.
    pub fabrics: &'a [std::sync::Arc<dyn Fabric>],
    /// Gauge pressure of each chamber \[Pa\].
    pub pressure_pa: &'a [f64],
    /// 1/Δt for viscosity, 0 for statics \[1/s\].
    pub rate: f64,
    /// Vector instructions of this machine.
    pub arch: pulp::Arch,
}

impl Patch {
    /// Packs the elements by key, in the order given.
    pub fn new(nodes: Range<usize>, items: BTreeMap<Key, Vec<Item>>, bending: &BendingMatrix, memory: bool) -> Patch {
        let mut patch = Patch {
            runs: Vec::new(),
            groups: Vec::new(),
            element: Vec::new(),
            corner_start: vec![0; nodes.len() + 1],
            corner_at: Vec::new(),
            bend_start: vec![0],
            bend_column: Vec::new(),
            bend_value: Vec::new(),
            strains: Vec::new(),
            past: Vec::new(),
            scratch: Vec::new(),
            sums: Sums::default(),
            bending_j: 0.0,
            hysteresis_j: 0.0,
            flux: Vec::new(),
            nodes,
        };
        let mut corners: Vec<(u32, u32)> = Vec::new();
        for (key, items) in items {
            let first = patch.groups.len();
            for chunk in items.chunks(LANES) {
                patch.note_corners(chunk, &mut corners);
                patch.groups.push(Group::pack(chunk));
                let reported = |lane: usize| chunk.get(lane).filter(|i| i.own).map_or(u32::MAX, |i| i.element);
                patch.element.push(std::array::from_fn(reported));
            }
            patch.runs.push(Run { key, groups: first..patch.groups.len() });
        }
        patch.index_corners(corners);
        for (column, value) in patch.nodes.clone().map(|i| bending.row(i).unzip::<u32, f64, Vec<_>, Vec<_>>()) {
            patch.bend_column.extend(column);
            patch.bend_value.extend(value);
            patch.bend_start.push(patch.bend_column.len() as u32);
        }
        patch.strains = vec![Strain([[0.0; LANES]; 3]); patch.groups.len()];
        patch.scratch = vec![[[[0.0; LANES]; 3]; 4]; patch.groups.len()];
        if memory {
            patch.past = vec![[[0.0; 2]; LANES]; patch.groups.len()];
        }
        patch
    }

    fn note_corners(&self, chunk: &[Item], corners: &mut Vec<(u32, u32)>) {
        let group = self.groups.len();
        for (lane, item) in chunk.iter().enumerate() {
            for (corner, node) in item.node.iter().enumerate() {
                if self.nodes.contains(&(*node as usize)) {
                    let at = (group * 4 + corner) * 3 * LANES + lane;
                    corners.push((*node - self.nodes.start as u32, at as u32));
                }
            }
        }
    }

    fn index_corners(&mut self, mut corners: Vec<(u32, u32)>) {
        corners.sort();
        for (node, at) in corners {
            self.corner_start[node as usize + 1] += 1;
            self.corner_at.push(at);
        }
        for i in 0..self.nodes.len() {
            self.corner_start[i + 1] += self.corner_start[i];
        }
    }

    /// Adds the shell forces of the own nodes to `force` (their slice) and keeps the sums. With `keep`, strains and
    /// fabric memory move on by this step.
    pub fn pass(&mut self, shared: Shared, force: &mut [[f64; 4]], keep: bool) {
        if !keep {
            let strains = self.strains.clone();
            shared.arch.dispatch(Pass { patch: self, shared, force });
            self.strains = strains;
            return;
        }
        shared.arch.dispatch(Pass { patch: self, shared, force });
        if !self.past.is_empty() {
            self.remember(shared.fabrics);
        }
    }

    fn remember(&mut self, fabrics: &[std::sync::Arc<dyn Fabric>]) {
        self.hysteresis_j = 0.0;
        for run in self.runs.iter().filter(|run| fabrics[run.key.fabric].has_memory()) {
            let fabric = &fabrics[run.key.fabric];
            for g in run.groups.clone() {
                let strain = &self.strains[g].0;
                for l in 0..LANES {
                    fabric.remember([strain[0][l], strain[1][l], strain[2][l]], &mut self.past[g][l]);
                    let weight = self.groups[g].own[l] * self.groups[g].area[l];
                    self.hysteresis_j += weight * fabric.dissipated(&self.past[g][l]);
                }
            }
        }
    }

    /// Sets the strains that viscosity compares with to those at `q`.
    pub fn start_strains(&mut self, shared: Shared) {
        let mut unused = vec![[0.0; 4]; self.nodes.len()];
        shared.arch.dispatch(Pass { patch: self, shared, force: &mut unused });
    }
}

/// The pass as a value, so that it is compiled once for every set of vector instructions.
struct Pass<'a, 'b> {
    patch: &'a mut Patch,
    shared: Shared<'b>,
    force: &'a mut [[f64; 4]],
}

impl pulp::WithSimd for Pass<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Pass { patch, shared, force } = self;
        patch.sums = Sums::default();
        patch.flux.clear();
        patch.flux.resize(shared.pressure_pa.len(), [0.0; 3]);
        for index in 0..patch.runs.len() {
            let key = patch.runs[index].key;
            let fabric = &*shared.fabrics[key.fabric];
            match fabric.kind() {
                Kind::NeoHookean(law) => run(simd, patch, shared, index, law),
                Kind::Orthotropic(law) => run(simd, patch, shared, index, law),
                Kind::Other => run(simd, patch, shared, index, Called(fabric)),
            }
        }
        sum_corners(patch, force);
        bend(patch, shared.q, force);
    }
}

#[inline(always)]
fn run<S: Simd, L: Law>(simd: S, patch: &mut Patch, shared: Shared, index: usize, law: L) {
    let Run { key, groups } = patch.runs[index].clone();
    let pressure = |chamber: Option<usize>| chamber.map_or(0.0, |c| shared.pressure_pa[c]);
    let batch = Batch {
        q: shared.q,
        pressure: pressure(key.back) - pressure(key.front),
        rate: shared.rate,
        groups: &patch.groups[groups.clone()],
        past: if patch.past.is_empty() { &[] } else { &patch.past[groups.clone()] },
    };
    let mut tally = Tally::default();
    let (strains, out) = (&mut patch.strains[groups.clone()], &mut patch.scratch[groups]);
    if key.corners == 4 {
        kernel::quads(simd, batch, law, strains, out, &mut tally);
    } else {
        kernel::triangles(simd, batch, law, strains, out, &mut tally);
    }
    patch.sums.membrane += sum(&tally.membrane);
    patch.sums.hourglass += sum(&tally.hourglass);
    patch.sums.viscous += sum(&tally.viscous);
    for (chamber, sign) in [(key.back, 1.0), (key.front, -1.0)] {
        if let Some(chamber) = chamber {
            (0..3).for_each(|k| patch.flux[chamber][k] += sign * sum(&tally.flux[k]));
        }
    }
}

#[inline(always)]
fn sum_corners(patch: &Patch, force: &mut [[f64; 4]]) {
    let flat: &[f64] = patch.scratch.as_flattened().as_flattened().as_flattened();
    for (i, force) in force.iter_mut().enumerate() {
        let mut total = *force;
        for at in &patch.corner_at[patch.corner_start[i] as usize..patch.corner_start[i + 1] as usize] {
            let at = *at as usize;
            total[0] += flat[at];
            total[1] += flat[at + LANES];
            total[2] += flat[at + 2 * LANES];
        }
        *force = total;
    }
}

#[inline(always)]
fn bend(patch: &mut Patch, q: &[[f64; 4]], force: &mut [[f64; 4]]) {
    let mut energy = 0.0;
    if patch.bend_value.is_empty() {
        patch.bending_j = 0.0;
        return;
    }
    for (i, force) in force.iter_mut().enumerate() {
        let range = patch.bend_start[i] as usize..patch.bend_start[i + 1] as usize;
        let mut kx = [0.0; 4];
        for (column, value) in patch.bend_column[range.clone()].iter().zip(&patch.bend_value[range]) {
            let x = q[*column as usize];
            (0..4).for_each(|k| kx[k] += value * x[k]);
        }
        let own = q[patch.nodes.start + i];
        (0..4).for_each(|k| force[k] -= kx[k]);
        energy += own[0] * kx[0] + own[1] * kx[1] + own[2] * kx[2];
    }
    patch.bending_j = 0.5 * energy;
}
