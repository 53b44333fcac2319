//! A model over one pressure as polynomials in pieces, small and fast enough for a microcontroller.
//!
//! ```text
//! u = √((P − P₀)/(P₁ − P₀))      tip(u) = Σ cₖ tᵏ,  t from −1 to 1 over a piece
//! ```
//!
//! P₀ is the pressure up to which every actuator is flat, P₁ the largest. The root takes the steep start of a pouch away.

use super::fit::{Fitter, MOST_BYTES, MOST_MISS, Sampler, Untabulated, horner};
use crate::model::Model;
use serde::Serialize;
use spelling::si;

/// Bytes of constants that, with the code, fit into 3 kB of flash: the first goal that takes no more is used.
const FEW_BYTES: usize = 2048;
/// Misses that the pieces aim at.
const GOALS: [f64; 3] = [5e-5, 2e-4, 8e-4];
/// Degrees tried; higher ones lose digits in single precision.
const DEGREES: std::ops::RangeInclusive<usize> = 3..=7;
/// Number of pressures at which the finished table, and its slope, are compared with the model.
const CHECKED: [usize; 2] = [20_001, 1001];
/// Slopes are compared from this share of the pressures above P₀ on: at P₀ a pouch rises with an infinite one.
const SLOPE_FROM: f64 = 0.01;

/// Tip and markers over the actuator pressure at one body pressure.
#[derive(Debug, Clone, PartialEq)]
pub struct Table {
    /// Gauge pressure of the body \[Pa\], the same at every entry.
    pub body_pa: f64,
    /// Least and largest actuator pressure \[Pa\].
    pub range_pa: [f64; 2],
    /// Pressure P₀ up to which every actuator is flat \[Pa\].
    pub open_pa: f64,
    /// Length of the undeformed robot \[m\], to which errors are relative.
    pub length_m: f64,
    /// Degree of the polynomials, the same in all pieces and outputs.
    pub degree: usize,
    /// How far it is from the model.
    pub bound: Bound,
    /// Ends of the pieces in u, one more than there are pieces.
    pub(super) edges: Vec<f32>,
    /// Per piece and output (x, y, angle, then x, y of each marker), rising powers of t; m and rad.
    pub(super) coefficients: Vec<f32>,
    pub(super) outputs: usize,
    /// Edges between which the tip only rises: where a height has one pressure.
    pub(super) rising: [usize; 2],
}

/// Largest differences between a table and its model, over thousands of pressures.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
pub struct Bound {
    /// Number of pressures at which both were compared.
    pub pressures: usize,
    /// Largest distance between both positions of the tip \[m\].
    #[serde(rename = "tip_mm", serialize_with = "si::mm")]
    pub tip_m: f64,
    /// Largest difference of the total bending angle \[rad\].
    #[serde(rename = "angle_deg", serialize_with = "si::deg")]
    pub angle_rad: f64,
    /// Largest distance between both positions of a marker \[m\].
    #[serde(rename = "marker_mm", serialize_with = "si::mm")]
    pub marker_m: f64,
    /// Slope of the tip's height \[m/Pa\], from [`Bound::slope_from_pa`] on.
    #[serde(rename = "slope_mm_per_kpa", serialize_with = "si::mm_per_kpa")]
    pub slope_m_per_pa: f64,
    /// Least pressure at which slopes were compared \[Pa\].
    #[serde(rename = "slope_from_kpa", serialize_with = "si::kpa")]
    pub slope_from_pa: f64,
}

impl Table {
    /// Tabulates a model over actuator pressures from `range_pa[0]` to `range_pa[1]` \[Pa\], on the first loading from rest. The
    /// largest misses are found at thousands of pressures and stand in [`Table::bound`].
    ///
    /// ```
    /// let robot = models::Scenario::parse(models::shipped("epam").unwrap()).unwrap();
    /// let table = models::export::Table::new(&models::Model::new(&robot), 2e3, [0.0, 40e3]).unwrap();
    /// assert!(table.bytes() <= 2048 && table.bound.tip_m < 1e-3 * 0.36);
    /// ```
    ///
    /// # Errors
    /// [`Untabulated`]: no prediction, several channels, a jump, or a response that does not fit.
    pub fn new(model: &Model, body_pa: f64, range_pa: [f64; 2]) -> Result<Table, Untabulated> {
        model.planar("a table over the pressure")?;
        let channels = model.channels().count();
        if channels > 1 {
            return Err(Untabulated::Channels { channels });
        }
        let [low_pa, high_pa] = range_pa;
        if low_pa < 0.0 || low_pa >= high_pa {
            return Err(Untabulated::Order { low_kpa: low_pa / 1e3, high_kpa: high_pa / 1e3 });
        }
        let mut sampler = Sampler { model, state: model.prediction(), body_pa, open_pa: 0.0, high_pa, outputs: 3 };
        let corners = sampler.corners(range_pa)?;
        let opening = corners.iter().find(|(_, opens)| *opens);
        // Where nothing opens it is open all along, or never.
        let unopened = if sampler.open(high_pa)? == 0 { high_pa } else { 0.0 };
        sampler.open_pa = opening.map_or(unopened, |(p, _)| *p);

        let open_pa = sampler.open_pa;
        if open_pa >= high_pa || channels == 0 {
            return Err(Untabulated::Range { low_kpa: low_pa / 1e3, high_kpa: high_pa / 1e3, open_kpa: open_pa / 1e3 });
        }
        let root = |p: f64| (((p - open_pa) / (high_pa - open_pa)).max(0.0).sqrt()) as f32;
        let marks: Vec<f32> = corners.iter().map(|(p, _)| root(*p)).chain([root(low_pa), 1.0]).collect();
        let sampler = &mut sampler;
        let mut failed = Untabulated::TooRough { at_kpa: open_pa / 1e3 };
        // Markers that do not fit are left out.
        let all = [3 + 2 * model.marker_count(), 3];
        let mut larger: Option<Table> = None;
        for (outputs, goal) in all.into_iter().flat_map(|outputs| GOALS.map(|goal| (outputs, goal))) {
            if let Some(table) = larger.take_if(|larger| larger.outputs != outputs) {
                return Ok(table);
            }
            sampler.outputs = outputs;
            // Where the tip turns back a piece has to end, so that a height has one pressure in a piece.
            let turning = |table: Table| [&marks[..], &table.turns()].concat();
            let cut = Table::smallest(sampler, range_pa, goal, &marks).map(turning);
            let mut table = match cut.and_then(|marks| Table::smallest(sampler, range_pa, goal, &marks)) {
                Ok(table) => table,
                Err(error @ Untabulated::Unsolved(_)) => return Err(error),
                Err(error) => {
                    failed = error;
                    continue;
                }
            };
            table.rising = table.last_rise();
            table.bound = table.held_against(sampler)?;
            if table.bytes() <= MOST_BYTES && table.worst() <= MOST_MISS {
                if table.bytes() <= FEW_BYTES {
                    return Ok(table);
                }
                larger.get_or_insert(table);
            }
        }
        larger.ok_or(failed)
    }

    /// The table of the degree that needs the fewest bytes, with pieces that end at the marks.
    fn smallest(sampler: &mut Sampler, range_pa: [f64; 2], goal: f64, marks: &[f32]) -> Result<Table, Untabulated> {
        let mut marks = marks.to_vec();
        marks.sort_by(f32::total_cmp);
        marks.dedup();
        let length_m = sampler.model.assembly().length_m();
        let (mut tables, mut failed) = (Vec::new(), Untabulated::TooRough { at_kpa: 0.0 });
        for degree in DEGREES {
            let edges = vec![marks[0]];
            let mut fitter = Fitter { sampler, degree, goal, length_m, edges, coefficients: Vec::new() };
            let built = marks[1..].iter().try_for_each(|mark| fitter.cover(*mark));
            let (edges, coefficients) = (fitter.edges, fitter.coefficients);
            let &mut Sampler { body_pa, open_pa, outputs, .. } = sampler;
            let (bound, rising) = (Bound::default(), [0, 0]);
            let table =
                Table { body_pa, range_pa, open_pa, length_m, degree, bound, edges, coefficients, outputs, rising };
            match built {
                Ok(()) => tables.push(table),
                Err(error) => failed = error,
            }
        }
        tables.into_iter().min_by_key(Table::bytes).ok_or(failed)
    }

    /// Bytes of its constants, in single precision.
    pub fn bytes(&self) -> usize {
        4 * (self.edges.len() + self.coefficients.len())
    }

    /// Number of pieces of the range of pressures, each with its own polynomials.
    pub fn pieces(&self) -> usize {
        self.edges.len() - 1
    }

    /// Number of markers, each with an x and a y among the outputs.
    pub fn markers(&self) -> usize {
        (self.outputs - 3) / 2
    }

    /// Heights of the tip that have one pressure \[m\]; `None` where it does not rise.
    pub fn heights_m(&self) -> Option<[f64; 2]> {
        let [first, last] = self.rising;
        let at = |piece: usize, t: f64| horner(self.polynomial(piece, 1), t)[0];
        (first < last).then(|| [at(first, -1.0), at(last - 1, 1.0)])
    }

    /// Value of an output and its slope per pascal: 0, 1, 2 are x, y and angle of the tip, then x, y of each marker. Outside
    /// the range it is the nearest end's.
    pub fn at(&self, p_pa: f64, output: usize) -> [f64; 2] {
        let p = if p_pa > self.range_pa[0] { p_pa.min(self.range_pa[1]) } else { self.range_pa[0] };
        let span = self.range_pa[1] - self.open_pa;
        let u = ((p - self.open_pa) / span).max(0.0).sqrt();
        let piece = self.edges[1..self.pieces()].partition_point(|edge| f64::from(*edge) < u);
        let (a, b) = (f64::from(self.edges[piece]), f64::from(self.edges[piece + 1]));
        let [value, slope] = horner(self.polynomial(piece, output), (2.0 * u - a - b) / (b - a));
        [value, slope / ((b - a) * u * span)]
    }

    pub(super) fn polynomial(&self, piece: usize, output: usize) -> &[f32] {
        let from = (piece * self.outputs + output) * (self.degree + 1);
        &self.coefficients[from..from + self.degree + 1]
    }

    /// Largest miss as a share of the length, or in rad.
    fn worst(&self) -> f64 {
        let Bound { tip_m, angle_rad, marker_m, .. } = self.bound;
        (tip_m.max(marker_m) / self.length_m).max(angle_rad)
    }

    /// Heights of the tip at equal distances in every piece, with their u.
    fn heights(&self) -> Vec<(f64, f64)> {
        let place = |i: usize| {
            let (piece, t) = (i / TURNS, (i % TURNS) as f64 * 2.0 / TURNS as f64 - 1.0);
            let (a, b) = (f64::from(self.edges[piece]), f64::from(self.edges[piece + 1]));
            (0.5 * (a + b + t * (b - a)), horner(self.polynomial(piece, 1), t)[0])
        };
        (0..self.pieces() * TURNS).map(place).collect()
    }

    /// The highest place in u, and the lowest before it.
    fn turns(&self) -> [f32; 2] {
        let by_height = |a: &&(f64, f64), b: &&(f64, f64)| a.1.total_cmp(&b.1);
        let heights = self.heights();
        let end = (1.0, horner(self.polynomial(self.pieces() - 1, 1), 1.0)[0]);
        let top = heights.iter().chain([&end]).max_by(by_height).map_or(1.0, |top| top.0);
        let low = heights.iter().filter(|place| place.0 < top).min_by(by_height).map_or(0.0, |low| low.0);
        [low as f32, top as f32]
    }

    /// Edges from the highest one back to where it stops falling.
    fn last_rise(&self) -> [usize; 2] {
        let start = |piece: usize| horner(self.polynomial(piece, 1), -1.0)[0];
        let end = |piece: usize| horner(self.polynomial(piece, 1), 1.0)[0];
        let top = (0..self.pieces()).max_by(|a, b| end(*a).total_cmp(&end(*b))).unwrap_or(0);
        let first = (0..=top).rev().take_while(|piece| start(*piece) < end(*piece)).last();
        first.map_or([0, 0], |first| [first, top + 1])
    }

    /// The largest differences from the model, over pressures at equal distances and at equal distances in u.
    fn held_against(&self, sampler: &mut Sampler) -> Result<Bound, Untabulated> {
        let [low, high] = self.range_pa;
        let share = |i: usize, of: usize| i as f64 / (of - 1) as f64;
        let slope_from_pa = low.max(self.open_pa + SLOPE_FROM * (high - self.open_pa));
        let mut bound = Bound { pressures: 2 * CHECKED[0], slope_from_pa, ..Bound::default() };
        let mut row = Vec::new();
        for i in 0..CHECKED[0] {
            let root = sampler.pressure(share(i, CHECKED[0])).max(low);
            for p in [low + share(i, CHECKED[0]) * (high - low), root] {
                sampler.at(p, &mut row)?;
                let miss = |output: usize| self.at(p, output)[0] - row[output];
                bound.tip_m = bound.tip_m.max(miss(0).hypot(miss(1)));
                bound.angle_rad = bound.angle_rad.max(miss(2).abs());
                let markers = (0..self.markers()).map(|m| miss(3 + 2 * m).hypot(miss(4 + 2 * m)));
                bound.marker_m = markers.fold(bound.marker_m, f64::max);
            }
        }
        for i in 0..CHECKED[1] {
            let even = slope_from_pa + share(i, CHECKED[1]) * (high - slope_from_pa);
            for p in [even, sampler.pressure(share(i, CHECKED[1])).max(slope_from_pa)] {
                let slope = sampler.model.jacobian(&sampler.loads(p), &mut sampler.state)?;
                let own = slope.iter().map(|s| s.y_per_pa).sum::<f64>();
                bound.slope_m_per_pa = bound.slope_m_per_pa.max((self.at(p, 1)[1] - own).abs());
            }
        }
        Ok(bound)
    }
}

/// Parts of a piece in which its tip is looked at for turning back.
const TURNS: usize = 16;
