//! Displacements of places of the robot, kept only where they move a marker, and their scalar products.
//!
//! A pattern is a shape times a factor per hold. Of n markers, a rotation moves those beyond it and a marker itself alone, so
//! that products of all pairs of patterns, taken hold by hold and shared by all times of a shape, cost n² and not n³.

use crate::fit::least_squares::dot;
use crate::layout::Layout;
use std::ops::Range;

/// Displacement per unit of a place in every sample.
pub struct Shape {
    layout: Layout,
    markers: Range<usize>,
    /// `[hold][sample][marker][x, y]` of those inside.
    xy: Vec<f64>,
}

impl Shape {
    /// The displacement of those of the markers that may be moved, as a function of the sample of the run and the marker.
    pub fn of(layout: &Layout, moved: &[usize], displacement: &dyn Fn(usize, usize) -> [f64; 2]) -> Shape {
        let from = moved.iter().copied().min().unwrap_or(0);
        let markers = from..moved.iter().copied().max().map_or(from, |last| last + 1);
        let mut xy = Vec::with_capacity(2 * layout.holds * layout.samples * markers.len());
        for sample in 0..layout.holds * layout.samples {
            markers.clone().for_each(|marker| xy.extend(displacement(sample, marker)));
        }
        Shape { layout: *layout, markers, xy }
    }

    /// In run layout, times a factor per hold.
    pub fn direction(&self, time: &[f64]) -> Vec<f64> {
        let mut out = vec![0.0; self.layout.values()];
        for (sample, row) in self.rows().enumerate() {
            let factor = time[sample / self.layout.samples];
            let at = self.layout.index(0, sample, self.markers.start);
            out[at..at + row.len()].iter_mut().zip(row).for_each(|(out, d)| *out = factor * d);
        }
        out
    }

    /// Products with a vector in run layout, one per hold.
    pub fn along(&self, vector: &[f64]) -> Vec<f64> {
        let mut sums = vec![0.0; self.layout.holds];
        for (sample, row) in self.rows().enumerate() {
            let at = self.layout.index(0, sample, self.markers.start);
            sums[sample / self.layout.samples] += dot(row, &vector[at..at + row.len()]);
        }
        sums
    }

    /// Products with another shape, one per hold, into `sums`; false if they move no marker in common.
    pub fn with(&self, other: &Shape, sums: &mut [f64]) -> bool {
        let from = self.markers.start.max(other.markers.start);
        let to = self.markers.end.min(other.markers.end);
        if from >= to {
            return false;
        }
        let common = |shape: &Shape| 2 * (from - shape.markers.start)..2 * (to - shape.markers.start);
        let (own, theirs) = (common(self), common(other));
        sums.fill(0.0);
        for (sample, (a, b)) in self.rows().zip(other.rows()).enumerate() {
            sums[sample / self.layout.samples] += dot(&a[own.clone()], &b[theirs.clone()]);
        }
        true
    }

    /// What is kept of every sample.
    fn rows(&self) -> impl Iterator<Item = &[f64]> {
        self.xy.chunks_exact((2 * self.markers.len()).max(1))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn products_are_those_of_the_whole_vectors() {
        let layout = Layout { holds: 2, samples: 3, markers: 5 };
        let shape = |moved: &[usize], seed: f64| {
            Shape::of(&layout, moved, &|sample, marker| {
                let d = (sample as f64 + 1.3 * seed).sin() + marker as f64;
                if moved.contains(&marker) { [d, 2.0 - d * seed] } else { [0.0; 2] }
            })
        };
        let (a, b, c) = (shape(&[4, 1, 3], 0.4), shape(&[2, 3], 1.7), shape(&[0], 0.9));
        let (one, two) = ([1.0, 0.0], [0.5, -2.0]);
        let mut sums = [7.0; 2];
        assert!(a.with(&b, &mut sums) && !b.with(&c, &mut sums));
        let whole = dot(&a.direction(&one), &b.direction(&[1.0, 1.0]));
        assert!((sums[0] - whole).abs() < 1e-12 * whole.abs(), "{sums:?} {whole}");
        let vector = b.direction(&two);
        let by_hold = a.along(&vector);
        assert!((dot(&by_hold, &two) - dot(&a.direction(&two), &vector)).abs() < 1e-12);
    }
}
