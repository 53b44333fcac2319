//! Fitting a table: the model's answers over u, and pieces halved until polynomials follow them.

use crate::error::{Solved, Unsolved};
use crate::model::{Model, Prediction};
use crate::term::Loads;
use std::f64::consts::PI;
use thiserror::Error;

/// Most bytes of constants of a table that is given out.
pub const MOST_BYTES: usize = 4096;
/// Its largest miss, as a share of the robot's length or in rad.
pub const MOST_MISS: f64 = 1e-3;

/// Reason for which a model cannot be written as a table over the pressure.
#[expect(missing_docs, reason = "fields have the words and units of their message")]
#[derive(Debug, Clone, PartialEq, Error)]
pub enum Untabulated {
    /// The model has no prediction somewhere in the range.
    #[error(transparent)]
    Unsolved(#[from] Unsolved),
    /// Range of pressures that is empty, falls, or begins below 0.
    #[error("pressures from {low_kpa} to {high_kpa} kPa are no range: they rise, from 0 or more")]
    Order { low_kpa: f64, high_kpa: f64 },
    /// A range in which the actuator stays flat.
    #[error(
        "pressures from {low_kpa} to {high_kpa} kPa are no range that opens the actuator (it is flat up to {open_kpa:.3} kPa)"
    )]
    Range { low_kpa: f64, high_kpa: f64, open_kpa: f64 },
    /// One pressure does not say where the robot is.
    #[error("{channels} supply channels move this robot, and a table knows one pressure")]
    Channels { channels: usize },
    /// Response with a jump or a corner that no table of the allowed size follows.
    #[error(
        "no table of {MOST_BYTES} bytes follows this robot to {MOST_MISS} of its length: it has a jump or a corner at {at_kpa:.3} kPa"
    )]
    TooRough { at_kpa: f64 },
}

const CORNER_SAMPLES: usize = 256;

/// What the pieces are made of: the model's answers over u.
pub(super) struct Sampler<'a> {
    pub model: &'a Model,
    pub state: Prediction,
    pub body_pa: f64,
    pub open_pa: f64,
    pub high_pa: f64,
    /// Outputs that are kept: tip and markers, or the tip alone.
    pub outputs: usize,
}

impl Sampler<'_> {
    pub(super) fn loads(&self, p: f64) -> Loads {
        Loads::uniform(self.body_pa, p)
    }

    /// Tip and markers at a pressure.
    pub(super) fn at(&mut self, p: f64, row: &mut Vec<f64>) -> Solved {
        self.model.predict(&self.loads(p), &mut self.state)?;
        let tip = self.state.tip;
        row.clear();
        row.extend([tip.x_m, tip.y_m, tip.angle_rad]);
        row.extend(self.state.markers.iter().flatten());
        row.truncate(self.outputs);
        Ok(())
    }

    pub(super) fn pressure(&self, u: f64) -> f64 {
        self.open_pa + u * u * (self.high_pa - self.open_pa)
    }

    pub(super) fn open(&mut self, p: f64) -> Solved<usize> {
        self.model.predict(&self.loads(p), &mut self.state)?;
        Ok(self.model.states(&self.state).iter().filter(|state| state.coordinate != 0.0).count())
    }

    /// Numbers of actuators that are open and of laws that act: the response has a corner where one changes.
    fn regime(&mut self, p: f64) -> Solved<[usize; 2]> {
        let open = self.open(p)?;
        let acting = self.model.ledger(&self.loads(p), &self.state).iter().filter(|row| row.energy_j != 0.0).count();
        Ok([open, acting])
    }

    /// Pressures at which the regime changes, and whether the first actuator opens there.
    pub(super) fn corners(&mut self, range_pa: [f64; 2]) -> Solved<Vec<(f64, bool)>> {
        let (mut found, mut before) = (Vec::new(), (range_pa[0], self.regime(range_pa[0])?));
        for i in 1..=CORNER_SAMPLES {
            let p = range_pa[0] + (range_pa[1] - range_pa[0]) * (i as f64 / CORNER_SAMPLES as f64).powi(3);
            let now = (p, self.regime(p)?);
            if now.1 != before.1 {
                let [mut low, mut high] = [before.0, now.0];
                while high - low > 1e-12 * range_pa[1] {
                    let middle = 0.5 * (low + high);
                    *(if self.regime(middle)? == before.1 { &mut low } else { &mut high }) = middle;
                }
                found.push((low, before.1[0] == 0 && now.1[0] > 0));
            }
            before = now;
        }
        Ok(found)
    }
}

/// Value and slope of a polynomial of single precision; the C code has the same order.
pub(super) fn horner(c: &[f32], t: f64) -> [f64; 2] {
    c.iter().rev().fold([0.0, 0.0], |[value, slope], c| [value * t + f64::from(*c), slope * t + value])
}

pub(super) struct Fitter<'a, 'm> {
    pub sampler: &'a mut Sampler<'m>,
    pub degree: usize,
    pub goal: f64,
    pub length_m: f64,
    pub edges: Vec<f32>,
    pub coefficients: Vec<f32>,
}

impl Fitter<'_, '_> {
    pub(super) fn cover(&mut self, high: f32) -> Result<(), Untabulated> {
        let low = self.edges[self.edges.len() - 1];
        let piece = self.piece([low, high])?;
        if self.misses([low, high], &piece)? {
            let middle = 0.5 * (low + high);
            if middle <= low || middle >= high || 4 * self.coefficients.len() > MOST_BYTES {
                return Err(Untabulated::TooRough { at_kpa: self.narrowest_pa([low, high]) / 1e3 });
            }
            self.cover(middle)?;
            return self.cover(high);
        }
        self.coefficients.extend(piece);
        self.edges.push(high);
        Ok(())
    }

    /// End of the narrowest piece, the one that does not fit among them.
    fn narrowest_pa(&self, unfit: [f32; 2]) -> f64 {
        let width = |pair: &&[f32]| pair[1] - pair[0];
        let pieces = self.edges.windows(2).chain([&unfit[..]]);
        let narrowest = pieces.min_by(|a, b| width(a).total_cmp(&width(b)));
        self.sampler.pressure(f64::from(narrowest.map_or(0.0, |pair| pair[1])))
    }

    /// Polynomials through the model at Chebyshev's points.
    fn piece(&mut self, ends: [f32; 2]) -> Result<Vec<f32>, Untabulated> {
        let count = self.degree + 1;
        let nodes: Vec<f64> = (0..count).map(|k| (PI * (k as f64 + 0.5) / count as f64).cos()).collect();
        let rows = nodes.iter().map(|t| self.row(ends, *t)).collect::<Result<Vec<_>, _>>()?;
        let fitted = (0..rows[0].len()).map(|i| through(&nodes, rows.iter().map(|row| row[i]).collect()));
        Ok(fitted.flatten().map(|c| c as f32).collect())
    }

    fn row(&mut self, [a, b]: [f32; 2], t: f64) -> Result<Vec<f64>, Untabulated> {
        let (a, b) = (f64::from(a), f64::from(b));
        let (p, mut row) = (self.sampler.pressure(0.5 * (a + b + t * (b - a))), Vec::new());
        self.sampler.at(p, &mut row)?;
        Ok(row)
    }

    /// Whether a piece is further from the model than the goal, at its ends and between its nodes.
    fn misses(&mut self, ends: [f32; 2], piece: &[f32]) -> Result<bool, Untabulated> {
        let count = 3 * (self.degree + 1);
        for k in 0..=count {
            let t = 2.0 * k as f64 / count as f64 - 1.0;
            let row = self.row(ends, t)?;
            let scale = |i: usize| if i == 2 { 1.0 } else { self.length_m };
            let far = |(i, c): (usize, &[f32])| (horner(c, t)[0] - row[i]).abs() > self.goal * scale(i);
            if piece.chunks(self.degree + 1).enumerate().any(far) {
                return Ok(true);
            }
        }
        Ok(false)
    }
}

/// Coefficients of rising powers of the polynomial through points: Newton's differences, multiplied out.
fn through(nodes: &[f64], mut values: Vec<f64>) -> Vec<f64> {
    let n = nodes.len();
    for k in 1..n {
        for i in (k..n).rev() {
            values[i] = (values[i] - values[i - 1]) / (nodes[i] - nodes[i - k]);
        }
    }
    let mut powers = vec![0.0; n];
    for i in (0..n).rev() {
        for k in (1..n).rev() {
            powers[k] = powers[k - 1] - nodes[i] * powers[k];
        }
        powers[0] = values[i] - nodes[i] * powers[0];
    }
    powers
}
