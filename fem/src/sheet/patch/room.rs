//! Room to work in, shared by all patches that one thread computes: it stays in the cache while patch after patch passes
//! through it. Nothing in it outlives a pass.

use std::cell::RefCell;
use std::ops::Range;

use super::super::group::LANES;
use super::super::kernel::CornerForces;

thread_local! {
    static STORE: RefCell<Store> = RefCell::new(Store::default());
}

/// Bytes of a line of the cache.
const LINE: usize = 64;
/// Numbers after which addresses fall on the same lines of the first cache.
const ROUND: usize = 4096 / 8;
/// How far apart on that round the arrays start: at the same place of it they would throw each other out.
const STAGGER: usize = 5 * LANES;
/// Arrays over nodes: positions, K x and four corners, three axes each.
const ARRAYS: usize = 18;

/// Numbers for all arrays of a patch, as many as the largest patch so far needs.
#[derive(Debug, Default)]
struct Store {
    numbers: Vec<f64>,
    scratch: Vec<CornerForces>,
}

/// Arrays over the nodes of a patch.
#[derive(Debug)]
pub(crate) struct Room<'a> {
    pub x: [&'a mut [f64]; 3],
    /// Bending forces K x of the nodes, by axis.
    pub(crate) kx: [&'a mut [f64]; 3],
    /// Forces of regular rows by corner and axis. No node is the same corner of two elements in regular rows.
    pub corner: [[&'a mut [f64]; 3]; 4],
    /// Corner forces of the other groups.
    pub scratch: &'a mut [CornerForces],
}

/// What a patch needs of a room.
#[derive(Debug, Clone, Default)]
pub(crate) struct RoomNeeds {
    /// Nodes, with one more group of lanes than they fill.
    pub nodes: usize,
    pub others: usize,
    /// Where no regular row writes the forces of corner c on a node of the patch.
    pub(crate) no_corner: [Gaps; 4],
    /// Where nothing writes K x, if anything does.
    pub(crate) no_bending: Gaps,
}

impl Room<'_> {
    /// Hands this thread's room to `job`, large enough and with zeros where the patch will write nothing.
    pub(crate) fn with<R>(needs: &RoomNeeds, job: impl FnOnce(Room) -> R) -> R {
        STORE.with_borrow_mut(|store| {
            let mut room = store.room(needs);
            let corners = room.corner.iter_mut().zip(&needs.no_corner);
            for (axes, gaps) in corners.chain([(&mut room.kx, &needs.no_bending)]) {
                axes.iter_mut().for_each(|axis| gaps.clear(axis));
            }
            job(room)
        })
    }

    /// Fills this thread's room with what no result may depend on.
    #[cfg(test)]
    pub(crate) fn spoil() {
        STORE.with_borrow_mut(|store| {
            store.numbers.fill(f64::NAN);
            store.scratch.as_flattened_mut().as_flattened_mut().as_flattened_mut().fill(f64::NAN);
        });
    }
}

impl Store {
    fn room(&mut self, needs: &RoomNeeds) -> Room<'_> {
        // The next length that moves the following array on by the stagger.
        let stride = needs.nodes + (ROUND + STAGGER - needs.nodes % ROUND) % ROUND;
        let wanted = ARRAYS * stride + LINE / 8;
        if self.numbers.len() < wanted {
            self.numbers = vec![0.0; wanted];
        }
        if self.scratch.len() < needs.others {
            self.scratch.resize(needs.others, [[[0.0; LANES]; 3]; 4]);
        }
        let aligned = self.numbers.as_ptr().align_offset(LINE).min(LINE / 8);
        let mut arrays = self.numbers[aligned..].chunks_exact_mut(stride);
        let mut axes = || std::array::from_fn(|_| arrays.next().unwrap_or_default());
        Room { x: axes(), kx: axes(), corner: std::array::from_fn(|_| axes()), scratch: &mut self.scratch }
    }
}

/// Places that nothing writes: most are single ones at the ends of rows, for which a call to fill would be slow.
#[derive(Debug, Clone, Default)]
pub(crate) struct Gaps {
    single: Vec<u32>,
    long: Vec<Range<usize>>,
}

impl Gaps {
    /// All of `0..count` where `written` is false.
    pub(crate) fn new(count: usize, written: impl Fn(usize) -> bool) -> Gaps {
        let mut gaps = Gaps::default();
        let mut first = 0;
        while let Some(start) = (first..count).find(|i| !written(*i)) {
            first = (start..count).find(|i| written(*i)).unwrap_or(count);
            if first - start > LANES {
                gaps.long.push(start..first);
            } else {
                gaps.single.extend((start..first).map(|i| i as u32));
            }
        }
        gaps
    }

    fn clear(&self, axis: &mut [f64]) {
        self.single.iter().for_each(|i| axis[*i as usize] = 0.0);
        self.long.iter().for_each(|gap| axis[gap.clone()].fill(0.0));
    }
}
