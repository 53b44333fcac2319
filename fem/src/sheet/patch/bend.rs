//! The bending matrix of a patch: nodes eight at a time, in stretches with one stencil or mixed, and single rows.

use std::collections::BTreeMap;
use std::ops::Range;

use pulp::Simd;

use super::super::bending::BendingMatrix;
use super::super::group::{LANES, Lane, leading_bits};
use super::super::lanes::V;
use super::room::Gaps;
use crate::vec3::Nodes;

/// Weights that differ by less than this share are rounding of the same weight.
const ALIKE: f64 = 1e-12;
/// Eight rows go together if they have at most this many shifts per row that is new: a row alone costs more.
const SHIFTS_PER_ROW: usize = 6;

/// Shifts to the neighbours of a node in the numbering, ascending, and their weights.
type StencilRow = Vec<(i32, f64)>;

/// Shifts, size and weights of stencils that are equal but for rounding, and where they lie.
type KnownStencils = BTreeMap<(Vec<i32>, i64, Vec<i64>), (Range<u32>, Option<u32>)>;

/// Eight consecutive nodes and all shifts at which they have neighbours; where one of them has none its weight is 0.
#[derive(Debug, Clone)]
struct Stencil {
    first: u32,
    /// Range of the stencil's entries in `shifts` and `common`.
    entries: Range<u32>,
    /// Range in `weights` if they differ between the eight; otherwise they are in `common`.
    own: Option<u32>,
}

/// Rows of the bending matrix of one patch, numbered within the patch.
#[derive(Debug, Clone, Default)]
pub(super) struct BendingRows {
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

impl BendingRows {
    /// From the rows of the nodes `own` (numbers within the patch) among `places`; `local` turns a place into a number.
    pub(super) fn new(matrix: &BendingMatrix, places: &[u32], own: &[u32], local: impl Fn(u32) -> u32) -> BendingRows {
        let mut rows: Vec<StencilRow> = vec![Vec::new(); places.len()];
        for i in own {
            let shift = |(j, value): (u32, f64)| (local(j) as i32 - *i as i32, value);
            let row = &mut rows[*i as usize];
            row.extend(matrix.row(places[*i as usize] as usize).map(shift));
            row.sort_by_key(|entry| entry.0);
        }
        let mut bend = BendingRows { start: vec![0], ..BendingRows::default() };
        let (mut next, mut known) = (0, KnownStencils::new());
        while let Some(i) = (next..rows.len()).find(|i| !rows[*i].is_empty()) {
            // A mixed group ends where a stretch begins, which is cheaper on its own.
            next = if stretch(&rows, i) {
                i + LANES
            } else {
                (i + 1..i + LANES).find(|j| stretch(&rows, *j)).unwrap_or(i + LANES)
            };
            let new = rows[i..next.min(rows.len())].iter().filter(|row| !row.is_empty()).count();
            match shifts(&rows, i) {
                Some(shifts) if shifts.len() <= SHIFTS_PER_ROW * new => {
                    bend.push(i, &shifts, &rows[i..i + LANES], &mut known);
                }
                _ => {
                    bend.push_single(i, &rows[i], places);
                    next = i + 1;
                }
            }
        }
        bend
    }

    /// Eight rows by the shifts of all of them; `known` holds what an earlier eight may share.
    fn push(&mut self, first: usize, shifts: &[i32], rows: &[StencilRow], known: &mut KnownStencils) {
        let weight = |row: &StencilRow, shift: i32| row.iter().find(|e| e.0 == shift).map_or(0.0, |e| e.1);
        let lanes = |shift: &i32| std::array::from_fn(|lane| weight(&rows[lane], *shift));
        let weights: Vec<Lane> = shifts.iter().map(lanes).collect();
        let numbers = weights.as_flattened();
        let largest = numbers.iter().fold(0.0, |most: f64, w| most.max(w.abs()));
        let steps = numbers.iter().map(|w| (w / (ALIKE * largest)).round() as i64);
        let key = (shifts.to_vec(), leading_bits(largest), steps.collect());
        let (entries, own) = known.entry(key).or_insert_with(|| {
            let alike = weights.iter().all(|lanes| lanes.iter().all(|w| (w - lanes[0]).abs() <= ALIKE * largest));
            let start = self.shifts.len() as u32;
            self.shifts.extend(shifts);
            self.common.extend(weights.iter().map(|lanes| lanes[0]));
            let own = (!alike).then_some(self.weights.len() as u32);
            if !alike {
                self.weights.extend(&weights);
            }
            (start..self.shifts.len() as u32, own)
        });
        self.stencils.push(Stencil { first: first as u32, entries: entries.clone(), own: *own });
    }

    fn push_single(&mut self, i: usize, row: &StencilRow, places: &[u32]) {
        self.single.push(i as u32);
        self.column.extend(row.iter().map(|(shift, _)| places[(i as i32 + shift) as usize]));
        self.value.extend(row.iter().map(|(_, value)| *value));
        self.start.push(self.column.len() as u32);
    }

    pub(super) fn is_empty(&self) -> bool {
        self.stencils.is_empty() && self.single.is_empty()
    }

    /// Places of `0..count` where [`BendingRows::apply`] writes nothing; none without bending, for then they are not read.
    pub(super) fn gaps(&self, count: usize) -> Gaps {
        if self.is_empty() {
            return Gaps::default();
        }
        let mut written = vec![false; count];
        self.single.iter().for_each(|i| written[*i as usize] = true);
        for s in self.stencils.iter() {
            written[s.first as usize..s.first as usize + LANES].fill(true);
        }
        Gaps::new(count, |i| written[i])
    }

    /// Writes K x of the own nodes into `kx`; nodes without bending keep their old values. `x` are the positions of the patch,
    /// `q` the positions of all places.
    #[inline(always)]
    pub(super) fn apply<S: Simd>(&self, simd: S, x: [&[f64]; 3], q: &Nodes, kx: [&mut [f64]; 3]) {
        // All of one length, so that a place is checked once and not for every axis.
        let [kx0, kx1, kx2] = kx;
        let nodes = x[0].len();
        let x = [&x[0][..nodes], &x[1][..nodes], &x[2][..nodes]];
        let kx = [&mut kx0[..nodes], &mut kx1[..nodes], &mut kx2[..nodes]];
        for stencil in &self.stencils {
            let entries = stencil.entries.start as usize..stencil.entries.end as usize;
            let (shifts, common) = (&self.shifts[entries.clone()], &self.common[entries]);
            for part in 0..LANES / S::F64_LANES {
                let first = stencil.first as usize + part * S::F64_LANES;
                let sum = match stencil.own {
                    None => weigh::<S, false>(simd, x, first, shifts, common, &[], part),
                    Some(own) => {
                        let weights = &self.weights[own as usize..own as usize + shifts.len()];
                        weigh::<S, true>(simd, x, first, shifts, common, weights, part)
                    }
                };
                for k in 0..3 {
                    sum[k].store_to(kx[k], first);
                }
            }
        }
        for (row, i) in self.single.iter().enumerate() {
            let range = self.start[row] as usize..self.start[row + 1] as usize;
            let sum = alone(simd, q, &self.column[range.clone()], &self.value[range]);
            for k in 0..3 {
                kx[k][*i as usize] = sum[k];
            }
        }
    }
}

/// Σ weight · x at the shifts from `first`, with the weights of each lane if they are its `OWN`.
#[inline(always)]
fn weigh<S: Simd, const OWN: bool>(
    simd: S,
    x: [&[f64]; 3],
    first: usize,
    shifts: &[i32],
    common: &[f64],
    own: &[Lane],
    part: usize,
) -> [V<S>; 3] {
    let mut sum = [V::all(simd, 0.0); 3];
    for (entry, (shift, common)) in shifts.iter().zip(common).enumerate() {
        let weight = if OWN { V::load(simd, &own[entry], part) } else { V::all(simd, *common) };
        let at = (first as i32 + shift) as usize;
        for k in 0..3 {
            sum[k] = sum[k] + weight * V::load_from(simd, x[k], at);
        }
    }
    sum
}

/// Σ value · q of one row; even and odd entries apart, so that they need not wait for each other.
#[inline(always)]
fn alone<S: Simd>(simd: S, q: &Nodes, column: &[u32], value: &[f64]) -> [f64; 4] {
    let (pairs, last) = column.as_chunks::<2>();
    let (values, last_value) = value.as_chunks::<2>();
    if S::F64_LANES == 4 {
        let q = q.as_flattened();
        let mut sum = [V::all(simd, 0.0); 2];
        for (pair, values) in pairs.iter().zip(values) {
            sum[0] = sum[0] + V::all(simd, values[0]) * V::load_from(simd, q, 4 * pair[0] as usize);
            sum[1] = sum[1] + V::all(simd, values[1]) * V::load_from(simd, q, 4 * pair[1] as usize);
        }
        if let ([column], [value]) = (last, last_value) {
            sum[0] = sum[0] + V::all(simd, *value) * V::load_from(simd, q, 4 * *column as usize);
        }
        let sum = (sum[0] + sum[1]).lanes();
        return [sum[0], sum[1], sum[2], sum[3]];
    }
    let mut sum = [[0.0; 4]; 2];
    for (n, (column, value)) in column.iter().zip(value).enumerate() {
        for (sum, x) in sum[n % 2].iter_mut().zip(&q[*column as usize]) {
            *sum += value * x;
        }
    }
    std::array::from_fn(|k| sum[0][k] + sum[1][k])
}

/// True if eight nodes from `first` on have neighbours at the same shifts.
fn stretch(rows: &[StencilRow], first: usize) -> bool {
    let alike = |a: &StencilRow, b: &StencilRow| a.len() == b.len() && a.iter().zip(b).all(|(a, b)| a.0 == b.0);
    match rows.get(first..first + LANES) {
        Some(eight) => !eight[0].is_empty() && eight.iter().all(|row| alike(row, &eight[0])),
        None => false,
    }
}

/// All shifts of the eight nodes from `first` on; `None` if one of them leads beyond the patch.
fn shifts(rows: &[StencilRow], first: usize) -> Option<Vec<i32>> {
    let eight = rows.get(first..first + LANES)?;
    let mut all: Vec<i32> = eight.iter().flatten().map(|entry| entry.0).collect();
    all.sort_unstable();
    all.dedup();
    let inside = |shift: &i32| (0..=rows.len() as i32 - LANES as i32).contains(&(first as i32 + shift));
    all.iter().all(inside).then_some(all)
}

#[cfg(test)]
mod tests {
    use super::*;

    struct Apply<'a>(&'a BendingRows, [&'a [f64]; 3], &'a [[f64; 4]], [&'a mut [f64]; 3]);

    impl pulp::WithSimd for Apply<'_> {
        type Output = ();
        #[inline(always)]
        fn with_simd<S: Simd>(self, simd: S) {
            self.0.apply(simd, self.1, self.2, self.3);
        }
    }

    /// Rows of 13 nodes with neighbours within the row and in the adjacent rows; every 17th node has a far one, too.
    fn matrix(nodes: usize) -> BendingMatrix {
        let mut matrix = BendingMatrix { start: vec![0], column: Vec::new(), value: Vec::new() };
        for i in 0..nodes as i32 {
            let mut shifts = vec![-13_i32, -2, -1, 0, 1, 2, 13];
            shifts.retain(|shift| shift.abs() == 13 || (0..13).contains(&(i % 13 + shift)));
            if i % 17 == 0 {
                shifts.push((i + 61) % nodes as i32 - i);
            }
            shifts.retain(|shift| i % 29 != 0 && (0..nodes as i32).contains(&(i + shift)));
            shifts.sort_unstable();
            shifts.dedup();
            matrix.column.extend(shifts.iter().map(|shift| (i + shift) as u32));
            matrix.value.extend(shifts.iter().map(|shift| f64::from(1 + i % 5) * 0.37 + f64::from(*shift) * 0.11));
            matrix.start.push(matrix.column.len() as u32);
        }
        matrix
    }

    #[test]
    fn rows_by_eights_of_any_shape_are_the_matrix() {
        for nodes in [5, 8, 40, 131] {
            let matrix = matrix(nodes);
            let places: Vec<u32> = (0..nodes as u32).collect();
            let bend = BendingRows::new(&matrix, &places, &places, |place| place);
            let q: Vec<[f64; 4]> = (0..nodes).map(|i| [0, 1, 2, 3].map(|k| ((7 * i + k) as f64).sin())).collect();
            let room = nodes.next_multiple_of(LANES) + LANES;
            let axis = |k: usize| (0..room).map(|i| q.get(i).map_or(0.0, |q| q[k])).collect::<Vec<f64>>();
            let x = [axis(0), axis(1), axis(2)];
            let mut kx = [vec![0.0; room], vec![0.0; room], vec![0.0; room]];
            let [a, b, c] = &mut kx;
            pulp::Arch::new().dispatch(Apply(&bend, [&x[0], &x[1], &x[2]], &q, [a, b, c]));
            for (k, kx) in kx.iter().enumerate() {
                for (i, got) in kx[..nodes].iter().enumerate() {
                    let expected: f64 = matrix.row(i).map(|(j, value)| value * q[j as usize][k]).sum();
                    assert!((got - expected).abs() < 1e-12, "row {i} of {nodes}: {got} and {expected}");
                }
            }
            assert!(nodes < 100 || (!bend.single.is_empty() && bend.stencils.len() > 5));
        }
    }
}
