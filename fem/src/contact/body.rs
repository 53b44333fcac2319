//! Layers, the memory of pairs, and the search for pairs that may touch.

use super::build::{self, Memory, Penalty};
use super::chunk::Chunk;
use super::follow::farthest_m;
use super::passed::Passed;
use super::press::Sums;
use super::record::{Reach, Record, Step};
use super::search;
use super::surface::{self, Surface};
use rayon::prelude::*;

/// Contact between the layers of a mesh.
#[derive(Debug, Clone, Default)]
pub struct Contact {
    pub(super) surface: Surface,
    pub(super) penalty: Penalty,
    pub(super) reach: Reach,
    pub(super) friction: f64,
    pub(super) arch: pulp::Arch,
    pub(super) chunks: Vec<Chunk>,
    pub(super) placed_m: Vec<[f64; 4]>,
    /// Positions one step before; empty before the first step.
    pub(super) before_m: Vec<[f64; 4]>,
    pub(super) now_m: Vec<[f64; 4]>,
    pub(super) path_m: f64,
    pub(super) search_due_m: f64,
    pub(super) searches: u64,
    pub(super) sums: Sums,
    pub(super) passed: Passed,
}

impl Contact {
    pub(super) fn near(&self) -> impl Iterator<Item = &Record> {
        self.chunks.iter().flat_map(|chunk| chunk.near.iter().map(|at| &chunk.records[*at as usize]))
    }

    pub(super) fn step_of<'a>(&'a self, x: &'a [[f64; 4]], dt_s: f64) -> Step<'a> {
        let before = if self.before_m.is_empty() { x } else { &self.before_m };
        Step {
            arch: self.arch,
            surface: &self.surface,
            x,
            before,
            reach: self.reach,
            dt_s,
            friction: self.friction,
            path_m: self.path_m,
        }
    }

    /// Searches again when some node may have moved more than half the skin.
    pub(super) fn search_if_due(&mut self, x: &[[f64; 4]]) {
        if self.path_m < self.search_due_m {
            return;
        }
        let left = 0.5 * self.reach.skin_m - farthest_m(x, &self.placed_m);
        self.search_due_m = self.path_m + left;
        if left <= 0.05 * self.reach.skin_m {
            self.search(x);
        }
    }

    pub(super) fn search(&mut self, x: &[[f64; 4]]) {
        let pairs = search::pairs(&self.surface, x, self.reach.side_m + self.reach.skin_m);
        let arch = self.arch;
        self.chunks.par_iter_mut().for_each(|chunk| {
            chunk.unload();
            chunk.close(arch, x);
        });
        let clear_m = if self.searches == 0 { f64::NEG_INFINITY } else { self.reach.side_m };
        let old = Memory::new(std::mem::take(&mut self.chunks), x.len(), clear_m);
        let (chunks, lost) = build::chunks(&self.surface, &pairs, &old, &self.penalty);
        self.sums.friction += lost;
        self.chunks = chunks;
        self.placed_m.clear();
        self.placed_m.extend_from_slice(x);
        self.search_due_m = self.path_m + 0.5 * self.reach.skin_m;
        self.searches += 1;
        self.arrange();
    }

    pub(super) fn arrange(&mut self) {
        let (surface, nodes) = (&self.surface, self.placed_m.len());
        let mark = || vec![surface::NONE; nodes];
        let chunks = self.chunks.par_iter_mut().enumerate();
        chunks.for_each_init(mark, |mark, (i, chunk)| chunk.list(surface, i as u32, mark));
    }
}
