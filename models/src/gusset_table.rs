//! The integrals of a lens with gussets over its half angle, as cubics: a prediction has no time for them.
//!
//! The fold opens to its bottom at θ₀, in the middle of the pouch first, and beyond it the integrals go on with the power 3/2 of θ − θ₀.
//! So a piece ends at θ₀, and beyond it the cubics are over √(θ − θ₀).

use crate::gusset::{GussetLens, PouchSums, Sloped};
use std::f64::consts::PI;

/// Number of cubics in each of the two parts, below and beyond θ₀.
const STEPS: usize = 96;
/// Least half angle, and least root beyond θ₀.
const LEAST: f64 = 1e-6;

/// One part of the table: cubics at equal steps of a variable.
struct CubicTable {
    step: f64,
    pieces: Vec<[[f64; 4]; 3]>,
}

pub(crate) struct GussetTable {
    /// θ₀; π where the fold stays held.
    opens: f64,
    held: CubicTable,
    open: CubicTable,
}

impl CubicTable {
    /// From integrals and their slopes over a variable up to `end`.
    fn new(end: f64, of: impl Fn(f64) -> PouchSums) -> CubicTable {
        let step = end / STEPS as f64;
        let nodes: Vec<PouchSums> = (0..=STEPS).map(|i| of(step * i as f64)).collect();
        let cubic = |[v, d]: Sloped, [w, e]: Sloped| {
            let (d, e) = (step * d, step * e);
            [v, d, 3.0 * (w - v) - 2.0 * d - e, 2.0 * (v - w) + d + e]
        };
        let pieces = nodes.windows(2).map(|at| [0, 1, 2].map(|k| cubic(at[0][k], at[1][k]))).collect();
        CubicTable { step, pieces }
    }

    #[inline]
    fn at(&self, x: f64) -> PouchSums {
        let place = x / self.step;
        let index = (place as usize).min(STEPS - 1);
        let t = place - index as f64;
        self.pieces[index].map(|[c0, c1, c2, c3]| {
            [c0 + t * (c1 + t * (c2 + t * c3)), (c1 + t * (2.0 * c2 + t * (3.0 * c3))) / self.step]
        })
    }
}

impl GussetTable {
    pub(crate) fn new(length_m: f64, fold_m: f64) -> GussetTable {
        let opens = GussetLens::opens(length_m, fold_m);
        let sums = |theta: f64| GussetLens::new(length_m, theta).sums(fold_m);
        let held = CubicTable::new(opens, |theta| sums(theta.max(LEAST)));
        // Slopes over the root x: twice x those over θ.
        let over_root = |x: f64| sums(opens + x * x).map(|[value, slope]| [value, 2.0 * x * slope]);
        let open = CubicTable::new((PI - opens).max(LEAST).sqrt(), over_root);
        GussetTable { opens, held, open }
    }

    pub(crate) fn sums(&self, theta: f64) -> PouchSums {
        if theta <= self.opens {
            return self.held.at(theta);
        }
        let root = (theta - self.opens).sqrt().max(LEAST);
        self.open.at(root).map(|[value, slope]| [value, slope / (2.0 * root)])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Folds from one that opens at once to one that stays held, each at half angles on both sides of θ₀ and next to it.
    #[test]
    fn the_table_reads_as_the_integrals_with_shallow_and_with_deep_folds() {
        let length_m: f64 = 0.0454;
        for k in 0..31 {
            let fold_m = 1e-3 + 0.7e-3 * f64::from(k);
            let table = GussetTable::new(length_m, fold_m);
            let near = [-0.02, -1e-3, 1e-4, 5e-4, 2e-3, 0.02].map(|more| table.opens + more);
            for theta in near.into_iter().chain([0.013, 0.21, 0.42, 1.01, 1.43, 2.1]).filter(|t| (0.01..PI).contains(t))
            {
                let made = GussetLens::new(length_m, theta).sums(fold_m);
                for ((read, made), power) in table.sums(theta).iter().zip(made).zip([3, 2, 3]) {
                    let [value, slope] = [0, 1].map(|i| (read[i] - made[i]).abs() / length_m.powi(power));
                    assert!(value < 1e-6 && slope < 3e-4, "{fold_m} {theta}: {read:?} {made:?}");
                }
            }
        }
    }
}
