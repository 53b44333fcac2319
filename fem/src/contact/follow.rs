//! How far nodes moved in a step, and where they were.

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use crate::sheet::group::{LANES, Lane};
use crate::vec3::Nodes;

/// Most nodes per piece of a pass over all nodes.
const PIECE: usize = 4096;

/// Largest distance between positions and those one step before; `copy` becomes the positions.
pub(super) fn follow(arch: pulp::Arch, x: &Nodes, before: &Nodes, copy: &mut Nodes) -> f64 {
    let square = if x.len() <= PIECE {
        arch.dispatch(PositionPiece { x, before, copy })
    } else {
        let piece = x.len().div_ceil(x.len().div_ceil(PIECE));
        let pieces = x.par_chunks(piece).zip(before.par_chunks(piece)).zip(copy.par_chunks_mut(piece));
        pieces.map(|((x, before), copy)| arch.dispatch(PositionPiece { x, before, copy })).reduce(|| 0.0, f64::max)
    };
    square.sqrt()
}

struct PositionPiece<'a> {
    x: &'a [[f64; 4]],
    before: &'a [[f64; 4]],
    copy: &'a mut [[f64; 4]],
}

impl pulp::WithSimd for PositionPiece<'_> {
    type Output = f64;

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _: S) -> f64 {
        let (x, last_x) = self.x.as_chunks::<LANES>();
        let (before, last_before) = self.before.as_chunks::<LANES>();
        let (copy, last_copy) = self.copy.as_chunks_mut::<LANES>();
        let mut far: Lane = [0.0; LANES];
        for ((x, before), copy) in x.iter().zip(before).zip(copy) {
            *copy = *x;
            for lane in 0..LANES {
                let square = square(&x[lane], &before[lane]);
                far[lane] = if square > far[lane] { square } else { far[lane] };
            }
        }
        for (x, before) in last_x.iter().zip(last_before) {
            let square = square(x, before);
            far[0] = if square > far[0] { square } else { far[0] };
        }
        last_copy.copy_from_slice(last_x);
        let mut farthest = far[0];
        for square in &far[1..] {
            farthest = if *square > farthest { *square } else { farthest };
        }
        farthest
    }
}

#[inline(always)]
fn square(x: &[f64; 4], y: &[f64; 4]) -> f64 {
    let r = [x[0] - y[0], x[1] - y[1], x[2] - y[2]];
    r[0] * r[0] + r[1] * r[1] + r[2] * r[2]
}

/// The last search for pairs: how often there was one, and where the nodes were then.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
pub(super) struct Searched {
    pub times: u64,
    pub placed_m: Vec<[f64; 4]>,
    /// Way of the fastest node since the start, summed over steps, and the way at which to look again.
    pub(crate) path_m: f64,
    due_m: f64,
}

impl Searched {
    /// True if some node may have moved more than half the skin since.
    pub(super) fn is_due(&mut self, x: &Nodes, skin_m: f64) -> bool {
        if self.path_m < self.due_m {
            return false;
        }
        let left = 0.5 * skin_m - farthest_m(x, &self.placed_m);
        self.due_m = self.path_m + left;
        left <= 0.05 * skin_m
    }

    pub(super) fn note(&mut self, x: &Nodes, skin_m: f64) {
        self.placed_m.clear();
        self.placed_m.extend_from_slice(x);
        self.due_m = self.path_m + 0.5 * skin_m;
        self.times += 1;
    }
}

/// Largest distance between two sets of positions.
fn farthest_m(x: &Nodes, y: &Nodes) -> f64 {
    x.iter().zip(y).map(|(x, y)| square(x, y)).fold(0.0, f64::max).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_farthest_of_any_number_of_nodes_is_found_and_positions_are_kept() {
        for count in [0, 1, 7, 8, 9, 4095, 4097, 5000] {
            let before: Vec<[f64; 4]> =
                (0..count).map(|i| [f64::from(i).sin(), f64::from(i).cos(), 0.1, 0.0]).collect();
            for at in [0, count as usize / 2, (count as usize).saturating_sub(1)] {
                let mut x: Vec<[f64; 4]> = before.iter().map(|p| [p[0] + 1e-3, p[1], p[2], 0.0]).collect();
                x.get_mut(at).into_iter().for_each(|p| p[1] += 2e-3);
                let mut copy = vec![[0.0; 4]; x.len()];
                let far_m = follow(pulp::Arch::new(), &x, &before, &mut copy);
                assert_eq!(far_m, farthest_m(&x, &before));
                assert!(count == 0 || (far_m - 5.0_f64.sqrt() * 1e-3).abs() < 1e-12);
                assert_eq!(copy, x);
            }
        }
    }
}
