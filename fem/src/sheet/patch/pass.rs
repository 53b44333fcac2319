//! One pass over a patch, compiled for every set of vector instructions.

use std::sync::Arc;

use models::Fabric;
use models::fabrics::InlinedFabric;
use pulp::Simd;

use super::super::group::LANES;
use super::super::kernel::{self, BatchInputs, Corners, Tally};
use super::super::lanes::{V, sum};
use super::super::law::{Called, Rubber, ShellLaw, UnitFilm};
use super::room::Room;
use super::{GroupRun, PassShared, Patch, Sums};
use crate::vec3::Nodes;

impl Patch {
    /// Adds the shell forces of the own nodes to `force` (their slice) and keeps the sums. With `keep`, strains and
    /// fabric memory move on by this step.
    pub(in crate::sheet) fn pass(&mut self, shared: PassShared, force: &mut Nodes, keep: bool) {
        let strains = if keep { Vec::new() } else { self.strains.clone() };
        self.dispatch(shared, force);
        if !keep {
            self.strains = strains;
        } else if !self.past.is_empty() {
            self.remember(shared.fabrics);
        }
    }

    fn remember(&mut self, fabrics: &[Arc<dyn Fabric>]) {
        self.sums.hysteresis = 0.0;
        for run in self.runs.iter().filter(|run| fabrics[run.key.fabric].has_memory()) {
            let fabric = &fabrics[run.key.fabric];
            for g in run.regular.clone().chain(run.other.clone()) {
                let [e1, e2, e3] = &self.strains[g].0;
                let group = &self.groups[g];
                let shape = &self.shapes[group.shape as usize];
                let stock = &self.stocks[group.stock as usize];
                for (l, past) in self.past[g].iter_mut().enumerate() {
                    fabric.remember([e1[l], e2[l], e3[l]], past);
                    let weight = stock.own[l] * shape.area[l];
                    self.sums.hysteresis += weight * fabric.dissipated(past);
                }
            }
        }
    }

    /// Sets the strains that viscosity compares with to those at `q`.
    pub(crate) fn start_strains(&mut self, shared: PassShared) {
        let mut unused = vec![[0.0; 4]; self.nodes.len()];
        self.dispatch(shared, &mut unused);
    }

    fn dispatch(&mut self, shared: PassShared, force: &mut Nodes) {
        let needs = std::mem::take(&mut self.needs);
        Room::with(&needs, |room| shared.arch.dispatch(Pass { patch: self, room, shared, force }));
        self.needs = needs;
    }
}

/// The pass as a value, so that it can be handed to the dispatcher.
pub(super) struct Pass<'a, 'b> {
    pub patch: &'a mut Patch,
    pub room: Room<'a>,
    pub shared: PassShared<'b>,
    pub force: &'a mut [[f64; 4]],
}

impl pulp::WithSimd for Pass<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Pass { patch, mut room, shared, force } = self;
        let room = &mut room;
        patch.sums = Sums { hysteresis: patch.sums.hysteresis, ..Sums::default() };
        patch.flux.clear();
        patch.flux.resize(shared.pressure_pa.len(), [0.0; 3]);
        take_positions(patch, room, shared.q);
        for index in 0..patch.runs.len() {
            let fabric = &*shared.fabrics[patch.runs[index].key.fabric];
            match fabric.kind() {
                InlinedFabric::NeoHookean(_) => counted(simd, patch, room, shared, index, Rubber(1.0)),
                InlinedFabric::Orthotropic(law) => counted(simd, patch, room, shared, index, law),
                InlinedFabric::Mixed(law) => counted(simd, patch, room, shared, index, law),
                InlinedFabric::WrinklingFilm(_) => counted(simd, patch, room, shared, index, UnitFilm),
                InlinedFabric::Other => run::<S, _, true>(simd, patch, room, shared, index, Called(fabric)),
            }
        }
        if !patch.bend.is_empty() {
            patch.bend.apply(simd, slices(&room.x), shared.q, slices_mut(&mut room.kx));
            if shared.books {
                patch.sums.bending = 0.5 * bending_energy(simd, room, patch.count);
            }
        }
        give_forces(simd, patch, room, force);
    }
}

fn slices<'a>([x, y, z]: &'a [&mut [f64]; 3]) -> [&'a [f64]; 3] {
    [x, y, z]
}

fn slices_mut<'a>([x, y, z]: &'a mut [&mut [f64]; 3]) -> [&'a mut [f64]; 3] {
    [x, y, z]
}

fn corner_slices<'a>([a, b, c, d]: &'a mut [[&mut [f64]; 3]; 4]) -> [[&'a mut [f64]; 3]; 4] {
    [slices_mut(a), slices_mut(b), slices_mut(c), slices_mut(d)]
}

/// Positions of the patch's nodes, axis by axis.
#[inline(always)]
fn take_positions(patch: &Patch, room: &mut Room, q: &Nodes) {
    let [x, y, z] = &mut room.x;
    for stretch in &patch.taken {
        let local = stretch.local.clone();
        let to = x[local.clone()].iter_mut().zip(&mut y[local.clone()]).zip(&mut z[local]);
        for (((x, y), z), p) in to.zip(&q[stretch.outer.clone()]) {
            (*x, *y, *z) = (p[0], p[1], p[2]);
        }
    }
}

/// With energies and fluxes if `books` is set.
#[inline(always)]
fn counted<S: Simd>(simd: S, patch: &mut Patch, room: &mut Room, all: PassShared, index: usize, law: impl ShellLaw) {
    match all.books {
        true => run::<S, _, true>(simd, patch, room, all, index, law),
        false => run::<S, _, false>(simd, patch, room, all, index, law),
    }
}

#[inline(always)]
fn run<S: Simd, L: ShellLaw, const BOOKS: bool>(
    simd: S,
    patch: &mut Patch,
    room: &mut Room,
    shared: PassShared,
    index: usize,
    law: L,
) {
    let GroupRun { key, regular, other, scratch } = patch.runs[index].clone();
    let pressure = |chamber: Option<usize>| chamber.map_or(0.0, |c| shared.pressure_pa[c]);
    let mut tally = Tally::default();
    for (groups, in_rows) in [(regular, true), (other, false)] {
        let batch = BatchInputs {
            x: slices(&room.x),
            pressure: pressure(key.back) - pressure(key.front),
            rate: shared.rate,
            groups: &patch.groups[groups.clone()],
            shapes: &patch.shapes,
            stocks: &patch.stocks,
            past: if patch.past.is_empty() { &[] } else { &patch.past[groups.clone()] },
        };
        let scratch = if in_rows { 0..0 } else { scratch..scratch + groups.len() };
        let strains = &mut patch.strains[groups];
        let scratch = &mut room.scratch[scratch];
        match (in_rows, key.corners) {
            (true, _) => kernel::quads::<S, L, true, BOOKS>(
                simd,
                batch,
                law,
                strains,
                Corners::Rows(corner_slices(&mut room.corner)),
                &mut tally,
            ),
            (_, 4) => {
                kernel::quads::<S, L, false, BOOKS>(simd, batch, law, strains, Corners::Groups(scratch), &mut tally)
            }
            _ => kernel::triangles::<S, L>(simd, batch, law, strains, scratch, &mut tally),
        }
    }
    patch.sums.membrane += sum(&tally.membrane);
    patch.sums.hourglass += sum(&tally.hourglass);
    patch.sums.viscous += sum(&tally.viscous);
    for (chamber, sign) in [(key.back, 1.0), (key.front, -1.0)] {
        if let Some(chamber) = chamber {
            for k in 0..3 {
                patch.flux[chamber][k] += sign * sum(&tally.flux[k]);
            }
        }
    }
}

/// Σ x·K x; K x is 0 at neighbours' nodes.
#[inline(always)]
fn bending_energy<S: Simd>(simd: S, room: &Room, own: usize) -> f64 {
    let mut lanes = [0.0; LANES];
    let whole = own / LANES * LANES;
    for first in (0..whole).step_by(LANES) {
        for part in 0..LANES / S::F64_LANES {
            let at = first + part * S::F64_LANES;
            let mut total = V::load(simd, &lanes, part);
            for k in 0..3 {
                total = total + V::load_from(simd, room.x[k], at) * V::load_from(simd, room.kx[k], at);
            }
            total.store(&mut lanes, part);
        }
    }
    let rest: f64 = (whole..own).map(|i| (0..3).map(|k| room.x[k][i] * room.kx[k][i]).sum::<f64>()).sum();
    sum(&lanes) + rest
}

/// Adds up the corners and bending of every own node.
#[inline(always)]
fn give_forces<S: Simd>(simd: S, patch: &Patch, room: &mut Room, force: &mut Nodes) {
    let padded = patch.count.next_multiple_of(LANES);
    for k in 0..3 {
        // The sum takes the place of the positions, which are not needed any more.
        let total = S::as_mut_simd_f64s(&mut room.x[k][..padded]).0;
        let kx = S::as_simd_f64s(&room.kx[k][..padded]).0;
        let [a, b, c, d] = [0, 1, 2, 3].map(|c: usize| S::as_simd_f64s(&room.corner[c][k][..padded]).0);
        let all = total.iter_mut().zip(a).zip(b).zip(c).zip(d);
        if patch.bend.is_empty() {
            for ((((total, a), b), c), d) in all {
                *total = simd.add_f64s(simd.add_f64s(*a, *b), simd.add_f64s(*c, *d));
            }
        } else {
            for (((((total, a), b), c), d), kx) in all.zip(kx) {
                let sum = simd.add_f64s(simd.add_f64s(*a, *b), simd.add_f64s(*c, *d));
                *total = simd.sub_f64s(sum, *kx);
            }
        }
    }
    let [x, y, z] = slices(&room.x);
    for stretch in &patch.given {
        let local = stretch.local.clone();
        let from = x[local.clone()].iter().zip(&y[local.clone()]).zip(&z[local]);
        for (force, ((x, y), z)) in force[stretch.outer.clone()].iter_mut().zip(from) {
            // The fourth number stays 0; with it whole registers are written.
            *force = [force[0] + x, force[1] + y, force[2] + z, force[3] + 0.0];
        }
    }
    let flat: &[f64] = room.scratch.as_flattened().as_flattened().as_flattened();
    for (node, at) in &patch.corners {
        let corner = &flat[*at as usize..*at as usize + 2 * LANES + 1];
        let force = &mut force[*node as usize];
        force[0] += corner[0];
        force[1] += corner[LANES];
        force[2] += corner[2 * LANES];
    }
}
