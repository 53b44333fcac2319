//! Regular stretches: elements whose neighbours are numbered in step.
//!
//! In a structured part of a mesh the corners of eight elements in a row are four runs of eight consecutive nodes: their
//! positions are loaded, and their forces stored, by one vector instruction each instead of eight. A stretch that is
//! not a multiple of eight ends with a group that overlaps the one before; the overlap is computed twice, with the same
//! bits, and counted once.

use std::collections::{BTreeMap, VecDeque};
use std::ops::Range;

use super::super::group::{Item, LANES};

/// A group of eight as a range of `items`, and how many of its first lanes the group before it counts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Eight {
    pub first: usize,
    /// Lanes counted by the group before.
    pub counted: usize,
}

/// Splits items into groups of regular stretches and a list of items left over. `follows(a, b)` is true if item b is
/// the next of the stretch that item a is in.
pub(super) fn split(count: usize, follows: impl Fn(usize, usize) -> bool) -> (Vec<Eight>, Vec<usize>) {
    let (mut eights, mut rest) = (Vec::new(), Vec::new());
    let mut first = 0;
    while first < count {
        let mut end = first + 1;
        while end < count && follows(end - 1, end) {
            end += 1;
        }
        if end - first < LANES {
            rest.extend(first..end);
        } else {
            let whole = (first..=end - LANES).step_by(LANES);
            eights.extend(whole.map(|at| Eight { first: at, counted: 0 }));
            let covered = (end - first) / LANES * LANES;
            if covered < end - first {
                eights.push(Eight { first: end - LANES, counted: first + covered - (end - LANES) });
            }
        }
        first = end;
    }
    (eights, rest)
}

/// An order of items, sorted by first corner, in which the next of a row comes next, whatever items are between them.
pub(super) fn rows(items: &[Item]) -> Vec<usize> {
    let mut left: BTreeMap<&[u32], VecDeque<usize>> = BTreeMap::new();
    for (i, item) in items.iter().enumerate() {
        left.entry(&item.node).or_default().push_back(i);
    }
    let mut taken = vec![false; items.len()];
    let mut order = Vec::with_capacity(items.len());
    for first in 0..items.len() {
        let mut next = Some(first).filter(|i| !taken[*i]);
        while let Some(i) = next {
            taken[i] = true;
            order.push(i);
            let after: Vec<u32> = items[i].node.iter().map(|n| n + 1).collect();
            let same = left.get_mut(after.as_slice());
            next = same.and_then(|same| std::iter::from_fn(|| same.pop_front()).find(|i| !taken[*i]));
        }
    }
    order
}

/// True if every corner of `b` is the node after the same corner of `a`.
pub(crate) fn next_in_row(a: &Item, b: &Item) -> bool {
    a.node.len() == 4 && b.node.len() == 4 && a.node.iter().zip(&b.node).all(|(a, b)| *b == a + 1)
}

/// Nodes that follow each other in two numberings.
#[derive(Debug, Clone)]
pub(super) struct NodeStretch {
    /// In the numbering of the patch.
    pub local: Range<usize>,
    pub outer: Range<usize>,
}

pub(super) fn stretches(pairs: &[(usize, usize)]) -> Vec<NodeStretch> {
    let follow = |a: &(usize, usize), b: &(usize, usize)| b.0 == a.0 + 1 && b.1 == a.1 + 1;
    let stretch = |chunk: &[(usize, usize)]| {
        let (local, outer) = chunk[0];
        NodeStretch { local: local..local + chunk.len(), outer: outer..outer + chunk.len() }
    };
    pairs.chunk_by(follow).map(stretch).collect()
}

#[cfg(test)]
mod tests {
    use super::super::super::reference::Reference;
    use super::*;

    #[test]
    fn a_stretch_of_nineteen_is_two_groups_and_one_that_overlaps_by_five() {
        let (eights, rest) = split(19, |_, _| true);
        let expected = [(0, 0), (8, 0), (11, 5)].map(|(first, counted)| Eight { first, counted });
        assert_eq!((eights.as_slice(), rest.len()), (&expected[..], 0));
    }

    #[test]
    fn short_stretches_are_left_over() {
        let (eights, rest) = split(12, |a, _| a != 6);
        assert_eq!((eights.len(), rest), (0, (0..12).collect()));
    }

    #[test]
    fn the_next_of_a_row_comes_next_whatever_lies_between() {
        let square = [[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
        let reference = Reference::new(&square, None, 0.0);
        let item = |n: [u32; 4]| Item {
            node: n.to_vec(),
            reference,
            law: [1.0, 0.0],
            hourglass: 0.0,
            viscosity: 0.0,
            own: true,
            part: 0,
            element: 0,
        };
        let row = |first: u32| item([first, first + 1, first + 21, first + 20]);
        // Two elements on the same nodes, and one that shares a corner only.
        let items = [row(0), row(0), item([1, 7, 8, 9]), row(1), row(1), row(2), row(5)];
        assert_eq!(rows(&items), [0, 3, 5, 1, 4, 2, 6]);
    }

    #[test]
    fn pairs_that_step_together_are_one_stretch() {
        let found = stretches(&[(0, 4), (1, 5), (2, 7), (4, 8), (5, 9)]);
        let found: Vec<_> = found.into_iter().map(|s| (s.local, s.outer)).collect();
        assert_eq!(found, [(0..2, 4..6), (2..3, 7..8), (4..6, 8..10)]);
    }
}
