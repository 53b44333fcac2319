//! Centre line: centroids of material sections, followed through the motion; `centre_line.csv`.
//!
//! A station s is the plane x·â = s through the *reference* shape. It cuts elements along straight segments; the centroid
//! is the mean of these segments weighted by their reference length, and its weights per node stay with the material:
//!
//! ```text
//! c(s) = Σₑ Lₑ ½(aₑ + bₑ) / Σₑ Lₑ = Σᵢ wᵢ xᵢ       Σᵢ wᵢ = 1
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | aₑ, bₑ | where the plane meets the edges of element e | m |
//! | Lₑ | distance of the two in the reference shape | m |
//! | wᵢ | weight of node i | – |
//!
//! On a ring of nodes this is the mean weighted by arc length. **Validity**: exact for any affine motion of the section;
//! sections cut the named parts only, so that pouches or folds next to a tube need not count. Derived here.
//!
//! [`CentreLine::seen`] follows one point of every section instead, where a marker sticks: a wall that an actuator draws in moves
//! the centroid of its section, but not the markers on its side.
//!
//! | column | meaning |
//! |---|---|
//! | `time_s`, `step` | time \[s\], steps done |
//! | `s_mm` | station \[mm\] |
//! | `x_mm`, `y_mm`, `z_mm` | centroid \[mm\] |

use std::collections::BTreeMap;
use std::path::Path;

use super::table::{StepTable, number};
use crate::vec3::{V3, along, cross, dot, norm, sub};
use crate::{FemError, Mesh, Part, Result};

/// Nodes nearer to a station than this share of the mesh's length lie on it: far above rounding, far below an element.
const ON_STATION: f64 = 1e-9;

/// Stations along an axis and what each section is made of.
#[derive(Debug, Clone, PartialEq)]
pub struct CentreLine {
    stations_m: Vec<f64>,
    weights: Vec<NodeWeights>,
    nodes: usize,
    start_m: Vec<V3>,
}

impl CentreLine {
    /// Sections of the parts named in `parts` (all if empty) at `stations_m` \[m\] along `axis` (any length, e.g. x).
    ///
    /// # Errors
    /// [`FemError::Problem`] for an unknown part, an axis without direction, or a station outside the mesh.
    pub fn new(mesh: &Mesh, parts: &[String], axis: V3, stations_m: &[f64]) -> Result<CentreLine> {
        let sections = Sections::of(mesh, parts, axis)?;
        let [from, to] = sections.range.map(|m| m * 1e3);
        let outside =
            |s: f64| format!("centre line: station {s} mm is not on the mesh, which reaches from {from} to {to} mm");
        CentreLine::made(mesh, stations_m, |s| sections.weights(s), outside)
    }

    /// As [`CentreLine::new`], but in place of centroids the points of the sections on the side that faces `eye` (any direction
    /// across the axis): where the half plane through the axis and `eye` meets the wall in the reference shape.
    ///
    /// # Errors
    /// As [`CentreLine::new`]; also for a section that is open to that side.
    pub fn seen(mesh: &Mesh, parts: &[String], axis: V3, eye: V3, stations_m: &[f64]) -> Result<CentreLine> {
        let sections = Sections::of(mesh, parts, axis)?;
        let side = cross(axis, eye);
        let hidden = |s: f64| format!("markers: no wall at {s} mm on the side {eye:?}");
        CentreLine::made(mesh, stations_m, |s| sections.facing(s, eye, side), hidden)
    }

    /// `missing` gives the reason why a station \[mm\] has no weights.
    fn made(
        mesh: &Mesh,
        stations_m: &[f64],
        of: impl Fn(f64) -> Option<NodeWeights>,
        missing: impl Fn(f64) -> String,
    ) -> Result<CentreLine> {
        let weights = stations_m.iter().map(|s| of(*s).ok_or_else(|| FemError::Problem(missing(s * 1e3))));
        let weights = weights.collect::<Result<_, _>>()?;
        let nodes = mesh.points.len();
        let mut line = CentreLine { stations_m: stations_m.to_vec(), weights, nodes, start_m: Vec::new() };
        line.start_m = line.at(&mesh.starts())?;
        Ok(line)
    }

    /// Stations along the axis of the reference shape \[m\], as the case has them.
    pub fn stations_m(&self) -> &[f64] {
        &self.stations_m
    }

    /// Centroid of every section \[m\] for node positions in mesh order.
    ///
    /// # Errors
    /// [`FemError::Problem`] if there are not as many positions as the mesh has nodes.
    pub fn at(&self, positions: &[V3]) -> Result<Vec<V3>> {
        if positions.len() != self.nodes {
            return Err(FemError::Problem("centre line: these positions belong to another mesh".into()));
        }
        let centroid = |weights: &NodeWeights| {
            let mut sum = [0.0; 3];
            for &(node, weight) in weights {
                for k in 0..3 {
                    sum[k] += weight * positions[node as usize][k];
                }
            }
            sum
        };
        Ok(self.weights.iter().map(centroid).collect())
    }

    /// Displacement of every section from where it started \[m\].
    pub(crate) fn moved_m(&self, positions: &[V3]) -> Result<Vec<V3>> {
        Ok(self.at(positions)?.into_iter().zip(&self.start_m).map(|(now, start)| sub(now, *start)).collect())
    }
}

#[derive(Debug)]
pub(crate) struct CentreLineFile {
    line: CentreLine,
    pub table: StepTable,
}

impl CentreLineFile {
    /// The file after the rows of `times_s` \[s\], which a checkpoint knows of; later ones are dropped.
    pub(crate) fn open(path: &Path, line: CentreLine, times_s: &[f64]) -> Result<CentreLineFile> {
        let table = StepTable::open(path, times_s, line.stations_m.len())?;
        Ok(CentreLineFile { line, table })
    }

    /// Adds one row per station; a step that is in the file already is not written again.
    pub(crate) fn append(&mut self, step: u64, time_s: f64, positions: &[V3]) -> Result<()> {
        let mut rows = String::new();
        for (point, station) in self.line.at(positions)?.iter().zip(&self.line.stations_m) {
            if !point.iter().all(|x| x.is_finite()) {
                let reason = format!("the section at {} mm is at {point:?}", station * 1e3);
                return Err(FemError::stopped(step, time_s, reason));
            }
            let [s, x, y, z] = [*station, point[0], point[1], point[2]].map(|length| number(length * 1e3));
            rows += &format!("{},{step},{s},{x},{y},{z}\n", number(time_s));
        }
        self.table.append(step, "time_s,step,s_mm,x_mm,y_mm,z_mm", &rows)
    }
}

fn choose<'a>(mesh: &'a Mesh, names: &[String]) -> Result<Vec<&'a Part>> {
    if names.is_empty() {
        return Ok(mesh.parts.iter().collect());
    }
    let find = |name: &String| {
        mesh.parts.iter().find(|part| part.name == *name).ok_or_else(|| {
            let known = mesh.part_names().join(", ");
            FemError::Problem(format!("centre line: unknown part `{name}`; the mesh has: {known}"))
        })
    };
    names.iter().map(find).collect()
}

/// Nodes, and the weight of each.
type NodeWeights = Vec<(u32, f64)>;

/// Where a plane meets an edge: its nodes, and the share of the way from the first to the second.
type EdgeCrossing = (u32, u32, f64);

/// Parts to be cut, and every node's place along the axis.
struct Sections<'a> {
    mesh: &'a Mesh,
    chosen: Vec<&'a Part>,
    coordinates: Vec<f64>,
    /// Of the nodes of the parts, along the axis.
    range: [f64; 2],
}

impl<'a> Sections<'a> {
    fn of(mesh: &'a Mesh, parts: &[String], axis: V3) -> Result<Sections<'a>> {
        let chosen = choose(mesh, parts)?;
        let length = norm(axis);
        if !(length > 0.0 && length.is_finite()) {
            return Err(FemError::Problem(format!("centre line: {axis:?} is not a direction, write [1, 0, 0] for x")));
        }
        let along = |p: &V3| dot(*p, axis) / length;
        let coordinates: Vec<f64> = mesh.points.iter().map(along).collect();
        let mut range = [f64::INFINITY, f64::NEG_INFINITY];
        for node in chosen.iter().flat_map(|part| part.faces()).flatten() {
            let Some(c) = coordinates.get(*node as usize) else {
                return Err(FemError::Mesh(format!("an element has node {}, which is not in the mesh", node + 1)));
            };
            range = [range[0].min(*c), range[1].max(*c)];
        }
        Ok(Sections { mesh, chosen, coordinates, range })
    }

    /// Segments of the section at `station`, one for every element cut; ends as edge and place on it.
    fn cuts(&self, station: f64) -> Vec<[EdgeCrossing; 2]> {
        let [low, high] = self.range;
        let near = ON_STATION * (high - low);
        let beyond = |node: u32| {
            let c = self.coordinates[node as usize] - station;
            if c.abs() <= near { 0.0 } else { c }
        };
        // Nodes on the station count as beyond it, so that a ring is met once, from before; at the start from behind.
        let at_start = station <= low + near;
        let above = |c: f64| if at_start { c > 0.0 } else { c >= 0.0 };
        let mut segments = Vec::new();
        for nodes in self.chosen.iter().flat_map(|part| part.faces()) {
            let mut ends = Vec::with_capacity(4);
            for (k, &i) in nodes.iter().enumerate() {
                let j = nodes[(k + 1) % nodes.len()];
                let (ci, cj) = (beyond(i), beyond(j));
                if above(ci) != above(cj) {
                    ends.push((i, j, ci / (ci - cj)));
                }
            }
            segments.extend(ends.chunks_exact(2).map(|pair| [pair[0], pair[1]]));
        }
        segments
    }

    /// Weights of the section at `station`; `None` outside the mesh.
    fn weights(&self, station: f64) -> Option<NodeWeights> {
        let mut sums: BTreeMap<u32, f64> = BTreeMap::new();
        let mut total = 0.0;
        for segment in self.cuts(station) {
            let length = self.distance(segment[0], segment[1]);
            total += length;
            for (i, j, t) in segment {
                *sums.entry(i).or_default() += 0.5 * length * (1.0 - t);
                *sums.entry(j).or_default() += 0.5 * length * t;
            }
        }
        (total > 0.0).then(|| sums.into_iter().filter(|w| w.1 != 0.0).map(|(i, w)| (i, w / total)).collect())
    }

    /// Weights of the point of the section at `station` that faces `eye`, where `side` (across both) changes sign.
    fn facing(&self, station: f64, eye: V3, side: V3) -> Option<NodeWeights> {
        for segment in self.cuts(station) {
            let [a, b] = segment.map(|cut| self.point(cut));
            let (sa, sb) = (dot(a, side), dot(b, side));
            if (sa >= 0.0) == (sb >= 0.0) {
                continue;
            }
            let t = sa / (sa - sb);
            if (1.0 - t) * dot(a, eye) + t * dot(b, eye) <= 0.0 {
                continue;
            }
            let mut sums: BTreeMap<u32, f64> = BTreeMap::new();
            for ((i, j, u), share) in segment.into_iter().zip([1.0 - t, t]) {
                *sums.entry(i).or_default() += share * (1.0 - u);
                *sums.entry(j).or_default() += share * u;
            }
            return Some(sums.into_iter().filter(|w| w.1 != 0.0).collect());
        }
        None
    }

    fn point(&self, (i, j, t): EdgeCrossing) -> V3 {
        let (p, q) = (self.mesh.points[i as usize], self.mesh.points[j as usize]);
        along(p, t, sub(q, p))
    }

    fn distance(&self, a: EdgeCrossing, b: EdgeCrossing) -> f64 {
        norm(sub(self.point(a), self.point(b)))
    }
}

#[cfg(test)]
#[path = "centre_line_tests.rs"]
mod tests;
