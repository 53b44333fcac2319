//! A patch: consecutive nodes, the elements that touch them, and one pass that gives the nodes their shell forces.

mod bend;
mod pass;
pub(super) mod room;
mod runs;

use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::Arc;

use models::Fabric;
use models::fabrics::Past;

use super::bending::BendingMatrix;
use super::group::{ElementGroup, Item, LANES, RestShape, Stock};
use super::kernel::Strain;
use bend::BendingRows;
use room::{Gaps, RoomNeeds};
use runs::NodeStretch;

/// What one pass over a patch adds up, in SI units.
#[derive(Debug, Clone, Copy, Default, PartialEq, serde::Serialize, serde::Deserialize)]
pub(super) struct Sums {
    pub membrane: f64,
    pub hourglass: f64,
    /// Energy turned to heat by viscosity in this step \[J\].
    pub viscous: f64,
    pub bending: f64,
    /// Energy lost in fabrics with memory \[J\].
    pub hysteresis: f64,
}

/// Elements that run through the same loop: same kind, fabric and chambers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct LoopKey {
    pub corners: usize,
    pub fabric: usize,
    pub front: Option<usize>,
    pub back: Option<usize>,
}

/// Groups with one key: first those in regular rows, then the others.
#[derive(Debug, Clone)]
struct GroupRun {
    key: LoopKey,
    regular: Range<usize>,
    other: Range<usize>,
    /// Place in the room of the corner forces of the first of the others.
    scratch: usize,
}

/// Consecutive nodes and the data for their forces. Within the patch, its own nodes and the neighbours' nodes that its elements
/// and bending rows need are numbered in mesh order, so that rows of a structured mesh stay whole.
#[derive(Debug, Clone)]
pub(super) struct Patch {
    pub nodes: Range<usize>,
    /// Nodes of the patch, its own and its neighbours'.
    count: usize,
    /// All of them, and their places.
    taken: Vec<NodeStretch>,
    /// The own ones, and their numbers among the own.
    given: Vec<NodeStretch>,
    runs: Vec<GroupRun>,
    groups: Vec<ElementGroup>,
    shapes: Vec<RestShape>,
    stocks: Vec<Stock>,
    /// Mesh number of the element in each lane, `u32::MAX` where another lane or patch reports it.
    pub element: Vec<[u32; LANES]>,
    /// Own node and place in `scratch` of every corner force of elements outside regular rows, in the order of nodes.
    corners: Vec<(u32, u32)>,
    bend: BendingRows,
    /// Strains of the step before, one per group.
    pub strains: Vec<Strain>,
    /// Memory of fabrics that have one; empty otherwise.
    pub past: Vec<[Past; LANES]>,
    needs: RoomNeeds,
    /// What the last pass added up.
    pub sums: Sums,
    /// Flux into each chamber, see [`super::chamber::Air::volume_of`].
    pub(crate) flux: Vec<[f64; 3]>,
}

/// What all patches share during a pass.
#[derive(Clone, Copy)]
pub(super) struct PassShared<'a> {
    pub q: &'a [[f64; 4]],
    pub fabrics: &'a [Arc<dyn Fabric>],
    /// Gauge pressure of each chamber \[Pa\].
    pub pressure_pa: &'a [f64],
    /// 1/Δt for viscosity, 0 for statics \[1/s\].
    pub rate: f64,
    /// Whether to sum up energies and fluxes; if false, only the heat of viscosity is.
    pub books: bool,
    pub(crate) arch: pulp::Arch,
}

impl Patch {
    /// Packs the elements by key; `items` carry places of nodes, `mesh_number` turns a place into a number of the mesh.
    pub(super) fn new(
        nodes: Range<usize>,
        items: BTreeMap<LoopKey, Vec<Item>>,
        bending: &BendingMatrix,
        mesh_number: &[u32],
        memory: bool,
    ) -> Patch {
        let own_places = nodes.clone().map(|i| i as u32);
        let needed = items.values().flatten().flat_map(|i| i.node.iter().copied());
        let needed = needed.chain(nodes.clone().flat_map(|i| bending.row(i).map(|e| e.0))).chain(own_places.clone());
        let mut places: Vec<u32> = needed.collect();
        places.sort_by_key(|place| mesh_number[*place as usize]);
        places.dedup();
        let numbers: BTreeMap<u32, u32> = places.iter().enumerate().map(|(i, place)| (*place, i as u32)).collect();
        let local = |place: u32| numbers[&place];
        let own: Vec<u32> = own_places.map(local).collect();
        let bend = BendingRows::new(bending, &places, &own, local);
        let mut build = Build::new(nodes.clone());
        for (key, mut list) in items {
            list.sort_by_key(|item| (mesh_number[item.node[0] as usize], item.part, item.element));
            let placed: Vec<Item> = list.clone();
            list.iter_mut().for_each(|item| item.node.iter_mut().for_each(|n| *n = local(*n)));
            let rows = runs::rows(&list);
            let in_rows = |items: &[Item]| rows.iter().map(|i| items[*i].clone()).collect::<Vec<Item>>();
            build.add(key, &in_rows(&list), &in_rows(&placed));
        }
        let padded = places.len().next_multiple_of(LANES);
        let mut is_own = vec![false; padded];
        own.iter().for_each(|i| is_own[*i as usize] = true);
        let no_corner = |taken: &Vec<bool>| Gaps::new(padded, |i| !is_own[i] || taken.get(i).is_some_and(|t| *t));
        let needs = RoomNeeds {
            nodes: padded + LANES,
            others: build.others,
            no_corner: build.taken.each_ref().map(no_corner),
            no_bending: bend.gaps(padded),
        };
        build.corners.sort();
        Patch {
            nodes,
            count: places.len(),
            taken: runs::stretches(
                &places.iter().enumerate().map(|(i, place)| (i, *place as usize)).collect::<Vec<_>>(),
            ),
            given: runs::stretches(&own.iter().enumerate().map(|(i, local)| (*local as usize, i)).collect::<Vec<_>>()),
            strains: vec![Strain([[0.0; LANES]; 3]); build.groups.len()],
            past: if memory { vec![[[0.0; 2]; LANES]; build.groups.len()] } else { Vec::new() },
            runs: build.runs,
            groups: build.groups,
            shapes: build.shapes.items,
            stocks: build.stocks.items,
            element: build.element,
            corners: build.corners,
            bend,
            needs,
            sums: Sums::default(),
            flux: Vec::new(),
        }
    }
}

struct Distinct<T> {
    items: Vec<T>,
    known: BTreeMap<Vec<i64>, u32>,
}

impl<T> Default for Distinct<T> {
    fn default() -> Distinct<T> {
        Distinct { items: Vec::new(), known: BTreeMap::new() }
    }
}

impl<T> Distinct<T> {
    /// Place of the item with this key, added if it is new.
    fn place(&mut self, key: Vec<i64>, item: T) -> u32 {
        let next = self.items.len() as u32;
        let place = *self.known.entry(key).or_insert(next);
        if place == next {
            self.items.push(item);
        }
        place
    }
}

/// A patch while its groups are packed.
#[derive(Default)]
struct Build {
    own: Range<usize>,
    runs: Vec<GroupRun>,
    groups: Vec<ElementGroup>,
    shapes: Distinct<RestShape>,
    stocks: Distinct<Stock>,
    element: Vec<[u32; LANES]>,
    /// Groups outside regular rows so far.
    others: usize,
    /// (own node, place in the corner forces).
    corners: Vec<(u32, u32)>,
    /// Nodes that already are corner c of an element in a regular row.
    taken: [Vec<bool>; 4],
}

impl Build {
    fn new(own: Range<usize>) -> Build {
        Build { own, ..Build::default() }
    }

    /// `items` are numbered within the patch, `placed` are the same with places.
    fn add(&mut self, key: LoopKey, items: &[Item], placed: &[Item]) {
        let (eights, mut rest) = runs::split(items.len(), |a, b| runs::next_in_row(&items[a], &items[b]));
        let start = self.groups.len();
        let mut claimed = vec![false; items.len()];
        for eight in eights {
            let chunk = &items[eight.first..eight.first + LANES];
            // It writes all its lanes, so those counted before must be where they were counted.
            let before = claimed[eight.first..eight.first + eight.counted].iter().all(|c| *c);
            if before && self.claim(&chunk[eight.counted..]) {
                self.push(chunk, eight.counted);
                claimed[eight.first..eight.first + LANES].fill(true);
            } else {
                rest.extend((eight.first + eight.counted..eight.first + LANES).filter(|i| !claimed[*i]));
            }
        }
        let (middle, scratch) = (self.groups.len(), self.others);
        for chunk in rest.chunks(LANES) {
            let of = |list: &[Item]| chunk.iter().map(|i| list[*i].clone()).collect::<Vec<Item>>();
            self.note_corners(&of(placed));
            self.push(&of(items), 0);
            self.others += 1;
        }
        self.runs.push(GroupRun { key, regular: start..middle, other: middle..self.groups.len(), scratch });
    }

    /// Reserves the places of a regular group's corner forces; false if another element has one of them.
    fn claim(&mut self, items: &[Item]) -> bool {
        let free = |(c, taken): (usize, &Vec<bool>)| {
            items.iter().all(|item| !taken.get(item.node[c] as usize).copied().unwrap_or(false))
        };
        if !self.taken.iter().enumerate().all(free) {
            return false;
        }
        for (c, taken) in self.taken.iter_mut().enumerate() {
            for item in items {
                let node = item.node[c] as usize;
                taken.resize(taken.len().max(node + 1), false);
                taken[node] = true;
            }
        }
        true
    }

    fn push(&mut self, chunk: &[Item], counted: usize) {
        let reported = |lane: usize| match chunk.get(lane) {
            Some(item) if item.own && lane >= counted => item.element,
            _ => u32::MAX,
        };
        self.element.push(std::array::from_fn(reported));
        let (shape, stock) = (RestShape::pack(chunk), Stock::pack(chunk, counted));
        let shape = self.shapes.place(shape.key(), shape);
        let stock = self.stocks.place(stock.key(), stock);
        self.groups.push(ElementGroup::pack(chunk, shape, stock));
    }

    fn note_corners(&mut self, chunk: &[Item]) {
        for (lane, item) in chunk.iter().enumerate() {
            for (corner, node) in item.node.iter().enumerate().filter(|(_, n)| self.own.contains(&(**n as usize))) {
                let at = (self.others * 4 + corner) * 3 * LANES + lane;
                self.corners.push((*node - self.own.start as u32, at as u32));
            }
        }
    }
}
