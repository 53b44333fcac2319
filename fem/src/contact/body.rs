//! Layers, the memory of pairs, and the search for pairs that may touch.

use super::build::{self, Penalty, PreviousRecords};
use super::chunk::Chunk;
use super::follow::Searched;
use super::passed::Passed;
use super::press::ContactEnergies;
use super::record::{ContactReach, ContactStep, Record};
use super::search;
use super::surface::{self, ContactSurface};
use crate::vec3::Nodes;
use rayon::prelude::*;

/// Contact between the layers of a mesh.
#[derive(Debug, Clone, Default)]
pub struct LayerContact {
    pub(super) surface: ContactSurface,
    pub(super) penalty: Penalty,
    pub(super) reach: ContactReach,
    pub(super) friction: f64,
    pub(super) arch: pulp::Arch,
    pub(super) chunks: Vec<Chunk>,
    pub(super) searched: Searched,
    /// Positions one step before; empty before the first step.
    pub(super) before_m: Vec<[f64; 4]>,
    pub(super) now_m: Vec<[f64; 4]>,
    pub(super) sums: ContactEnergies,
    pub(super) passed: Passed,
}

impl LayerContact {
    pub(super) fn near(&self) -> impl Iterator<Item = &Record> {
        self.chunks.iter().flat_map(|chunk| chunk.near.iter().map(|at| &chunk.records[*at as usize]))
    }

    pub(super) fn step_of<'a>(&'a self, x: &'a Nodes, dt_s: f64) -> ContactStep<'a> {
        let before = if self.before_m.is_empty() { x } else { &self.before_m };
        ContactStep {
            arch: self.arch,
            surface: &self.surface,
            x,
            before,
            reach: self.reach,
            dt_s,
            friction: self.friction,
            path_m: self.searched.path_m,
        }
    }

    pub(super) fn search(&mut self, x: &Nodes) {
        let pairs = search::pairs(&self.surface, x, self.reach.side_m + self.reach.skin_m);
        let arch = self.arch;
        self.chunks.par_iter_mut().for_each(|chunk| {
            chunk.unload();
            chunk.close(arch, x);
        });
        let clear_m = if self.searched.times == 0 { f64::NEG_INFINITY } else { self.reach.side_m };
        let old = PreviousRecords::new(std::mem::take(&mut self.chunks), x.len(), clear_m);
        let (chunks, lost) = build::chunks(&self.surface, &pairs, &old, &self.penalty);
        self.sums.friction += lost;
        self.chunks = chunks;
        self.searched.note(x, self.reach.skin_m);
        self.arrange();
    }

    pub(super) fn arrange(&mut self) {
        let (surface, nodes) = (&self.surface, self.searched.placed_m.len());
        let mark = || vec![surface::NONE; nodes];
        let chunks = self.chunks.par_iter_mut().enumerate();
        chunks.for_each_init(mark, |mark, (i, chunk)| chunk.list(surface, i as u32, mark));
    }
}
