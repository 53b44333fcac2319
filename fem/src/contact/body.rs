//! Layers, the memory of pairs, and the search for pairs that may touch.

use super::build::{self, Memory, Penalty};
use super::chunk::Chunk;
use super::follow::Searched;
use super::passed::Passed;
use super::press::Sums;
use super::record::{Reach, Record, Step};
use super::search;
use super::surface::{self, Surface};
use crate::bytes::{pack, unpack};
use crate::vec3::Nodes;
use rayon::prelude::*;

/// What contact cannot find again from positions, after the number of elements.
type Saved = (usize, Searched, Sums, Vec<[f64; 4]>, Passed, Vec<Chunk>);

/// Contact between the layers of a mesh.
#[derive(Debug, Clone, Default)]
pub struct Contact {
    pub(super) surface: Surface,
    pub(super) penalty: Penalty,
    pub(super) reach: Reach,
    pub(super) friction: f64,
    pub(super) arch: pulp::Arch,
    pub(super) chunks: Vec<Chunk>,
    pub(super) searched: Searched,
    /// Positions one step before; empty before the first step.
    pub(super) before_m: Vec<[f64; 4]>,
    pub(super) now_m: Vec<[f64; 4]>,
    pub(super) sums: Sums,
    pub(super) passed: Passed,
}

impl Contact {
    pub(super) fn near(&self) -> impl Iterator<Item = &Record> {
        self.chunks.iter().flat_map(|chunk| chunk.near.iter().map(|at| &chunk.records[*at as usize]))
    }

    pub(super) fn step_of<'a>(&'a self, x: &'a Nodes, dt_s: f64) -> Step<'a> {
        let before = if self.before_m.is_empty() { x } else { &self.before_m };
        Step {
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
        let old = Memory::new(std::mem::take(&mut self.chunks), x.len(), clear_m);
        let (chunks, lost) = build::chunks(&self.surface, &pairs, &old, &self.penalty);
        self.sums.friction += lost;
        self.chunks = chunks;
        self.searched.note(x, self.reach.skin_m);
        self.arrange();
    }

    fn arrange(&mut self) {
        let (surface, nodes) = (&self.surface, self.searched.placed_m.len());
        let mark = || vec![surface::NONE; nodes];
        let chunks = self.chunks.par_iter_mut().enumerate();
        chunks.for_each_init(mark, |mark, (i, chunk)| chunk.list(surface, i as u32, mark));
    }

    pub(super) fn saved(&self) -> Vec<u8> {
        let mut chunks = self.chunks.clone();
        chunks.iter_mut().for_each(Chunk::unload);
        let elements = self.surface.elements.len();
        pack(&(elements, &self.searched, self.sums, &self.before_m, &self.passed, chunks))
    }

    pub(super) fn take_saved(&mut self, saved: &[u8]) -> Option<()> {
        let (elements, searched, sums, before_m, passed, chunks): Saved = unpack(saved)?;
        let nodes = self.searched.placed_m.len();
        let fits = elements == self.surface.elements.len()
            && searched.placed_m.len() == nodes
            && (before_m.is_empty() || before_m.len() == nodes)
            && passed.fits(nodes as u32, elements as u32);
        fits.then_some(())?;
        let fitting = |chunk: Chunk| chunk.fitting(nodes as u32, elements as u32);
        let chunks = chunks.into_iter().map(fitting).collect::<Option<Vec<_>>>()?;
        (self.searched, self.sums, self.before_m, self.passed) = (searched, sums, before_m, passed);
        self.chunks = chunks.clone();
        self.arrange();
        for (chunk, kept) in self.chunks.iter_mut().zip(chunks) {
            (chunk.way_m, chunk.next_m, chunk.due_m) = (kept.way_m, kept.next_m, kept.due_m);
            chunk.seen_m = kept.seen_m;
            if !chunk.seen_m.is_empty() && chunk.seen_m.len() != chunk.nodes.len() {
                return None;
            }
            chunk.load();
        }
        Some(())
    }
}
