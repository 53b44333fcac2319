//! How far nodes moved: two passes over positions that run in nearly every step.

use rayon::prelude::*;

use crate::sheet::group::{LANES, Lane};
use crate::vec3::norm;

/// Nodes per piece of a pass over all nodes.
const PIECE: usize = 2048;

/// Largest distance between the positions `x` and `y` \[m\]; `x` is copied to `copy`, unless that is empty.
pub(super) fn keep(arch: pulp::Arch, x: &[[f64; 4]], y: &[[f64; 4]], copy: &mut [[f64; 4]]) -> f64 {
    if x.len() <= PIECE {
        return arch.dispatch(Farthest { x, y, copy }).sqrt();
    }
    let square_m2 = if copy.is_empty() {
        let pieces = x.par_chunks(PIECE).zip(y.par_chunks(PIECE));
        pieces.map(|(x, y)| arch.dispatch(Farthest { x, y, copy: &mut [] })).reduce(|| 0.0, f64::max)
    } else {
        let pieces = x.par_chunks(PIECE).zip(y.par_chunks(PIECE)).zip(copy.par_chunks_mut(PIECE));
        pieces.map(|((x, y), copy)| arch.dispatch(Farthest { x, y, copy })).reduce(|| 0.0, f64::max)
    };
    square_m2.sqrt()
}

/// No two of `nodes` moved more than this against each other since they were `seen` \[m\]: diagonal of the box of all
/// motions.
pub(super) fn parted_m(arch: pulp::Arch, x: &[[f64; 4]], nodes: &[u32], seen: &[[f64; 4]]) -> f64 {
    let [low, high] = arch.dispatch(Range { x, nodes, seen });
    norm([high[0] - low[0], high[1] - low[1], high[2] - low[2]])
}

struct Farthest<'a> {
    x: &'a [[f64; 4]],
    y: &'a [[f64; 4]],
    copy: &'a mut [[f64; 4]],
}

impl pulp::WithSimd for Farthest<'_> {
    type Output = f64;

    /// The square \[m²\].
    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _: S) -> f64 {
        let ((x, last_x), (y, last_y)) = (self.x.as_chunks::<LANES>(), self.y.as_chunks::<LANES>());
        let mut far: Lane = [0.0; LANES];
        for (x, y) in x.iter().zip(y) {
            for lane in 0..LANES {
                far[lane] = larger(square(&x[lane], &y[lane]), far[lane]);
            }
        }
        for (x, y) in last_x.iter().zip(last_y) {
            far[0] = larger(square(x, y), far[0]);
        }
        if !self.copy.is_empty() {
            self.copy.copy_from_slice(self.x);
        }
        let mut most = 0.0;
        for far in far {
            most = larger(far, most);
        }
        most
    }
}

#[inline(always)]
fn square(x: &[f64; 4], y: &[f64; 4]) -> f64 {
    let (a, b, c) = (x[0] - y[0], x[1] - y[1], x[2] - y[2]);
    a * a + b * b + c * c
}

#[inline(always)]
fn larger(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

struct Range<'a> {
    x: &'a [[f64; 4]],
    nodes: &'a [u32],
    seen: &'a [[f64; 4]],
}

impl pulp::WithSimd for Range<'_> {
    type Output = [[f64; 4]; 2];

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _: S) -> [[f64; 4]; 2] {
        let (mut low, mut high) = ([f64::INFINITY; 4], [f64::NEG_INFINITY; 4]);
        for (n, seen) in self.nodes.iter().zip(self.seen) {
            let p = &self.x[*n as usize];
            for k in 0..4 {
                let moved = p[k] - seen[k];
                low[k] = if moved < low[k] { moved } else { low[k] };
                high[k] = if moved > high[k] { moved } else { high[k] };
            }
        }
        [low, high]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::tests::rig::Noise;
    use crate::vec3::V3;

    #[test]
    fn motions_are_those_of_the_farthest_node_and_of_the_two_that_part_most() {
        let arch = pulp::Arch::new();
        // One piece, several, and with a rest of every kind.
        for count in [3, 8, 21, PIECE, 2 * PIECE + 5] {
            let mut noise = Noise(count as u64);
            let points =
                |noise: &mut Noise| (0..count).map(|_| noise.point(1.0)).map(|[a, b, c]| [a, b, c, 0.0]).collect();
            let (x, mut y): (Vec<[f64; 4]>, Vec<[f64; 4]>) = (points(&mut noise), points(&mut noise));
            y[count - 1] = [9.0, 0.0, 0.0, 0.0];
            y[count / 2] = [-9.0, 1.0, 0.0, 0.0];
            let far = |x: &[f64; 4], y: &[f64; 4]| norm([x[0] - y[0], x[1] - y[1], x[2] - y[2]]);
            let wanted_m = x.iter().zip(&y).map(|(x, y)| far(x, y)).fold(0.0, f64::max);
            let mut copy = vec![[0.0; 4]; count];
            assert_eq!(keep(arch, &x, &y, &mut copy), wanted_m);
            assert_eq!(keep(arch, &x, &y, &mut []), wanted_m);
            assert_eq!(copy, x);
            let nodes: Vec<u32> = (0..count as u32).rev().collect();
            let seen: Vec<[f64; 4]> = y.iter().rev().copied().collect();
            let parted_m = parted_m(arch, &x, &nodes, &seen);
            let two: V3 = [0, 1, 2].map(|k| (x[count - 1][k] - y[count - 1][k]) - (x[count / 2][k] - y[count / 2][k]));
            assert!(parted_m >= norm(two), "{parted_m} is less than two nodes parted");
        }
    }
}
