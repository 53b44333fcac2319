//! The bending matrix of a patch: stretches of nodes with one stencil, and single rows.

use pulp::Simd;

use super::super::bending::BendingMatrix;
use super::super::group::{LANES, Lane};
use super::super::lanes::V;
use super::runs::split;

/// Weights that differ by less than this share are rounding of the same weight.
const ALIKE: f64 = 1e-12;

/// Eight consecutive nodes whose neighbours sit at the same distances in the numbering.
#[derive(Debug, Clone)]
struct Stencil {
    /// First of the eight.
    first: u32,
    /// Range in `shifts` and `common`.
    entries: std::ops::Range<u32>,
    /// Range in `weights` if they differ between the eight; otherwise they are in `common`.
    own: Option<u32>,
}

/// Rows of the bending matrix of one patch, numbered within the patch.
#[derive(Debug, Clone, Default)]
pub struct Bend {
    stencils: Vec<Stencil>,
    shifts: Vec<i32>,
    common: Vec<f64>,
    weights: Vec<Lane>,
    single: Vec<u32>,
    start: Vec<u32>,
    /// Places, not numbers within the patch: all axes of a place lie together.
    column: Vec<u32>,
    value: Vec<f64>,
}

impl Bend {
    /// From the rows of the nodes `own` (numbers within the patch) among `places`; `local` turns a place into a number.
    pub fn new(matrix: &BendingMatrix, places: &[u32], own: &[u32], local: impl Fn(u32) -> u32) -> Bend {
        let mut rows: Vec<Vec<(i32, f64)>> = vec![Vec::new(); places.len()];
        for i in own {
            let shift = |(j, value): (u32, f64)| (local(j) as i32 - *i as i32, value);
            let row = &mut rows[*i as usize];
            row.extend(matrix.row(places[*i as usize] as usize).map(shift));
            row.sort_by_key(|entry| entry.0);
        }
        let alike = |a: usize, b: usize| {
            !rows[a].is_empty()
                && rows[a].len() == rows[b].len()
                && rows[a].iter().zip(&rows[b]).all(|(a, b)| a.0 == b.0)
        };
        let (eights, rest) = split(rows.len(), alike);
        let mut bend = Bend { start: vec![0], ..Bend::default() };
        for eight in eights {
            bend.push(eight.first, &rows[eight.first..eight.first + LANES]);
        }
        for i in rest.into_iter().filter(|i| !rows[*i].is_empty()) {
            bend.single.push(i as u32);
            bend.column.extend(rows[i].iter().map(|(shift, _)| places[(i as i32 + shift) as usize]));
            bend.value.extend(rows[i].iter().map(|(_, value)| *value));
            bend.start.push(bend.column.len() as u32);
        }
        bend
    }

    fn push(&mut self, first: usize, rows: &[Vec<(i32, f64)>]) {
        let start = self.shifts.len() as u32;
        let largest = rows[0].iter().map(|entry| entry.1.abs()).fold(0.0, f64::max);
        let mut alike = true;
        for (entry, (shift, weight)) in rows[0].iter().enumerate() {
            self.shifts.push(*shift);
            self.common.push(*weight);
            alike &= rows.iter().all(|row| (row[entry].1 - weight).abs() <= ALIKE * largest);
        }
        let own = (!alike).then_some(self.weights.len() as u32);
        if !alike {
            let lanes = |entry: usize| std::array::from_fn(|lane| rows[lane][entry].1);
            self.weights.extend((0..rows[0].len()).map(lanes));
        }
        self.stencils.push(Stencil { first: first as u32, entries: start..self.shifts.len() as u32, own });
    }

    /// True without any bending stiffness.
    pub fn is_empty(&self) -> bool {
        self.stencils.is_empty() && self.single.is_empty()
    }

    /// Writes K x of the own nodes into `kx`; nodes without bending keep what is there. `x` are the positions of the patch,
    /// `q` those of all places.
    #[inline(always)]
    pub fn apply<S: Simd>(&self, simd: S, x: [&[f64]; 3], q: &[[f64; 4]], kx: [&mut [f64]; 3]) {
        for stencil in &self.stencils {
            let entries = stencil.entries.start as usize..stencil.entries.end as usize;
            let (shifts, common) = (&self.shifts[entries.clone()], &self.common[entries]);
            for part in 0..LANES / S::F64_LANES {
                let first = stencil.first as usize + part * S::F64_LANES;
                let mut sum = [V::all(simd, 0.0); 3];
                for (entry, (shift, common)) in shifts.iter().zip(common).enumerate() {
                    let weight = match stencil.own {
                        None => V::all(simd, *common),
                        Some(own) => V::load(simd, &self.weights[own as usize + entry], part),
                    };
                    let at = (first as i32 + shift) as usize;
                    for k in 0..3 {
                        sum[k] = sum[k] + weight * V::load_from(simd, x[k], at);
                    }
                }
                for k in 0..3 {
                    sum[k].store_to(kx[k], first);
                }
            }
        }
        for (row, i) in self.single.iter().enumerate() {
            let range = self.start[row] as usize..self.start[row + 1] as usize;
            let mut sum = [0.0; 4];
            for (column, value) in self.column[range.clone()].iter().zip(&self.value[range]) {
                let place = &q[*column as usize];
                for k in 0..4 {
                    sum[k] += value * place[k];
                }
            }
            for k in 0..3 {
                kx[k][*i as usize] = sum[k];
            }
        }
    }
}
