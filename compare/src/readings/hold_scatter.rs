//! Scatter of single holds: what the repeats of a hold show beyond errors of whole runs and noise of single samples.
//!
//! The mean over the samples of a hold is one reading of a coordinate. With the errors U c of whole runs taken out, the deviations d of
//! the readings of a run from the mean over runs have the covariance
//!
//! ```text
//! C = M (τ² I + Σ_k v_k Z_k Z_kᵀ) M        M = I − Q Qᵀ,  Q an orthonormal basis of the hold means of U
//! E |d|² = τ² tr M + Σ_k v_k tr G_kk       E |Z_jᵀ d|² = τ² tr G_jj + Σ_k v_k |G_jk|²       G_jk = Z_jᵀ M Z_k
//! ```
//!
//! per degree of freedom of the runs, and τ² and v solve these equations, none below zero (MINQUE with the weights of white noise; Rao,
//! J. Multivar. Anal. 1971). Their variances are the variances of quadratic forms of normal values, 2 |C …|² over the runs.
//!
//! | k | columns Z, one per hold unless said | unit of v |
//! |---|---|---|
//! | pressure | ∂f/∂ln p | 1 |
//! | bend | way from the straight robot, over the bend | 1 |
//! | shift | one per axis | m² |
//! | roll | rotation about the base | rad² |
//! | marker | one per marker and axis, alike in all holds of a run | m² |
//!
//! τ² beyond σ² over the number of samples is of errors that last through a hold: a tracker's, or noise of neighbouring frames that is
//! not independent. Frames then are no repeats, and σ² is raised to τ² times their number: right for means over a hold, and cautious
//! for changes within it.
//!
//! Validity: errors of the holds of a run are independent of each other; three runs and three holds at least.

use crate::directions::{DirectionRow, ROTATIONS, SHIFTS};
use crate::fit::numbers::least;
use crate::layout::Layout;
use crate::policy;
use crate::stats::f_tail;
use data::Dataset;
use nalgebra::{DMatrix, DVector};

pub(crate) const KINDS: usize = 5;

/// Scatter of single holds of one run.
#[derive(Debug, Clone, Default)]
pub struct HoldNoise {
    /// Standard deviations of pressure \[-\], bend \[-\], shift \[m\], roll \[rad\] and marker \[m\].
    pub sd: [f64; KINDS],
    /// Whether they are more than chance makes easily: enough to be printed.
    pub is_significant: [bool; KINDS],
    /// Variances of these kinds that tests use.
    pub test_variance: [f64; KINDS],
    /// Variance of a reading beyond those \[m²\], and its degrees of freedom.
    pub reading_m2: f64,
    pub dof: usize,
    pub sample_m2: f64,
    /// Errors last through a hold: readings scatter more than their samples say.
    pub lasts: bool,
    /// Z of every kind: hold, and its values in run layout.
    pub columns: Vec<ErrorDirection>,
}

impl HoldNoise {
    /// Variances of the kinds, best estimate.
    pub fn variance(&self) -> [f64; KINDS] {
        self.sd.map(|sd| sd * sd)
    }

    /// Columns and their standard deviations in a mean over `runs`, for tests.
    pub fn of_mean(&self, runs: usize) -> impl Iterator<Item = (&ErrorDirection, f64)> {
        let sd = move |column: &ErrorDirection| (self.test_variance[column.kind] / runs as f64).sqrt();
        self.columns.iter().map(move |column| (column, sd(column)))
    }

    /// Variance that the columns give a weighted sum of the mean over `runs`.
    pub fn variance_of_mean(&self, weights: &[(usize, f64)], variance: &[f64; KINDS], runs: usize) -> f64 {
        let of = |c: &ErrorDirection| variance[c.kind] * c.along(weights.iter().copied()).powi(2);
        self.columns.iter().map(of).sum::<f64>() / runs as f64
    }

    /// Sum of the variances that the columns give the values of a range in the mean over `runs` \[m²\], best estimate.
    pub fn square_of_mean(&self, range: &std::ops::Range<usize>, runs: usize) -> f64 {
        let inside = |c: &ErrorDirection| {
            let values = c.values.iter().enumerate().filter(|(i, _)| range.contains(&(c.from + i)));
            self.variance()[c.kind] * values.map(|(_, v)| v * v).sum::<f64>()
        };
        self.columns.iter().map(inside).sum::<f64>() / runs as f64
    }

    /// σ² of single samples that gives the scatter of readings, with its degrees of freedom, where errors last through a hold.
    pub fn of_samples(&self, samples: usize) -> Option<(f64, usize)> {
        self.lasts.then_some((self.reading_m2 * samples as f64, self.dof))
    }

    /// Standard deviation of errors that last through a hold \[m\].
    pub fn lasting_m(&self, samples: usize) -> Option<f64> {
        self.lasts.then(|| (self.reading_m2 - self.sample_m2 / samples as f64).max(0.0).sqrt())
    }

    /// Without scatter of the pressure, which readings of a gauge have.
    pub fn drop_pressure(&mut self) {
        self.columns.retain(|column| column.kind != 0);
    }
}

/// A direction in which a hold errs.
#[derive(Debug, Clone)]
pub struct ErrorDirection {
    /// Kind of the error, an index into `HoldNoise::sd`.
    pub kind: usize,
    /// Place of the column's first value in run layout.
    pub from: usize,
    /// Per unit of the error \[m\].
    pub values: Vec<f64>,
}

impl ErrorDirection {
    /// Sum of this column times sparse `weights`, given as places in run layout.
    pub fn along(&self, weights: impl Iterator<Item = (usize, f64)>) -> f64 {
        weights.filter_map(|(i, w)| Some(w * self.values.get(i.checked_sub(self.from)?)?)).sum()
    }

    /// In the whole run layout, times a factor.
    pub fn spread(&self, values: usize, factor: f64) -> Vec<f64> {
        let mut all = vec![0.0; values];
        all[self.from..self.from + self.values.len()].iter_mut().zip(&self.values).for_each(|(to, v)| *to = factor * v);
        all
    }
}

/// The scatter of holds about the mean of each group of runs; nothing where runs or holds are too few. `rows` is U, `sigma2` the
/// variance of single samples \[m²\] with `sigma_dof` degrees of freedom.
pub(crate) fn hold_scatter(
    dataset: &Dataset,
    groups: &[Vec<usize>],
    rows: &[DirectionRow],
    sigma2: f64,
    sigma_dof: usize,
) -> HoldNoise {
    let Ok(layout) = Layout::of(dataset) else { return HoldNoise::default() };
    let runs = dataset.runs.len() - groups.len();
    if dataset.runs.len() < policy::FEWEST_RUNS || layout.holds < policy::FEWEST_HOLDS {
        return HoldNoise::default();
    }
    let means = Means::new(dataset, &layout, rows);
    let deviations = means.deviations(dataset, &layout, groups);
    let mut scatter = means.solve(&deviations, runs);
    scatter.sample_m2 = sigma2;
    let per_sample_m2 = scatter.reading_m2 * layout.samples as f64;
    scatter.lasts = f_tail(per_sample_m2 / sigma2, scatter.dof, sigma_dof) < policy::READINGS_LAST;
    scatter
}

struct Means {
    /// Z, one column per entry of `columns`.
    z: DMatrix<f64>,
    columns: Vec<ErrorDirection>,
    /// Orthonormal basis of the errors of runs.
    q: DMatrix<f64>,
    seen: Vec<bool>,
}

impl Means {
    fn new(dataset: &Dataset, layout: &Layout, rows: &[DirectionRow]) -> Means {
        let width = layout.markers * layout.axes;
        let of = |j: usize| layout.hold_means(&rows.iter().map(|row| row[j]).collect::<Vec<_>>());
        let u: Vec<Vec<f64>> = (0..DirectionRow::default().len()).map(of).collect();
        let seen: Vec<bool> = (0..layout.holds * width).map(|i| u.iter().any(|column| column[i] != 0.0)).collect();
        let mean = layout.hold_means(&dataset.mean_over_runs());
        let straight = least(0..layout.holds, |h| dataset.holds[*h].sum_act_pa()).unwrap_or(0) * width;
        let bend: Vec<f64> =
            (0..mean.len()).map(|i| if seen[i] { mean[i] - mean[straight + i % width] } else { 0.0 }).collect();
        let kinds = [vec![&u[0]], vec![&bend], SHIFTS.map(|j| &u[j]).to_vec(), ROTATIONS.map(|j| &u[j]).to_vec()];
        let mut columns = Vec::new();
        let mut z = Vec::new();
        for (kind, shapes) in kinds.iter().enumerate() {
            for (hold, shape) in (0..layout.holds).flat_map(|hold| shapes.iter().map(move |shape| (hold, shape))) {
                let part = &shape[hold * width..(hold + 1) * width];
                if part.iter().all(|v| *v == 0.0) {
                    continue;
                }
                let mut column = vec![0.0; mean.len()];
                column[hold * width..(hold + 1) * width].copy_from_slice(part);
                z.push(DVector::from_vec(column));
                let values = (0..layout.samples).flat_map(|_| part.iter().copied()).collect();
                columns.push(ErrorDirection { kind, from: layout.hold_range(hold).start, values });
            }
        }
        for cell in (0..width).filter(|cell| (0..layout.holds).any(|hold| seen[hold * width + cell])) {
            let is_here = |i: usize| f64::from(u8::from(i % width == cell && seen[i]));
            z.push(DVector::from_fn(mean.len(), |i, _| is_here(i)));
            let of_value = |i: usize| is_here(i / (width * layout.samples) * width + i % width);
            columns.push(ErrorDirection {
                kind: KINDS - 1,
                from: 0,
                values: (0..layout.values()).map(of_value).collect(),
            });
        }
        let all = DMatrix::from_fn(mean.len(), u.len(), |i, j| u[j][i]);
        Means { z: DMatrix::from_columns(&z), columns, q: basis(all), seen }
    }

    /// Hold means of every run about the means of its group, without what errors of whole runs explain.
    fn deviations(&self, dataset: &Dataset, layout: &Layout, groups: &[Vec<usize>]) -> Vec<DVector<f64>> {
        let mut all = Vec::new();
        for group in groups.iter().filter(|group| group.len() > 1) {
            let of_run = |run: &usize| DVector::from_vec(layout.hold_means(dataset.run(*run)));
            let runs: Vec<DVector<f64>> = group.iter().map(of_run).collect();
            let mean = runs.iter().sum::<DVector<f64>>() / runs.len() as f64;
            all.extend(runs.into_iter().map(|run| self.without_runs(run - &mean)));
        }
        all
    }

    fn without_runs(&self, mut deviation: DVector<f64>) -> DVector<f64> {
        deviation.iter_mut().zip(&self.seen).filter(|(_, seen)| !**seen).for_each(|(d, _)| *d = 0.0);
        let along = self.q.tr_mul(&deviation);
        deviation - &self.q * along
    }

    fn of_kind(&self, kind: usize) -> Vec<usize> {
        (0..self.columns.len()).filter(|c| self.columns[*c].kind == kind).collect()
    }

    fn solve(self, deviations: &[DVector<f64>], runs: usize) -> HoldNoise {
        let dof = runs.max(1) as f64;
        let zq = self.z.tr_mul(&self.q);
        let g = self.z.tr_mul(&self.z) - &zq * zq.transpose();
        // A kind that errors of whole runs explain already is left out.
        let is_new = |own: &Vec<usize>| {
            let before: f64 = own.iter().map(|i| self.z.column(*i).norm_squared()).sum();
            own.iter().map(|i| g[(*i, *i)]).sum::<f64>() > policy::NEW_IN_HOLDS * before
        };
        let kinds: Vec<Vec<usize>> =
            (0..KINDS).map(|kind| Some(self.of_kind(kind)).filter(is_new).unwrap_or_default()).collect();
        let trace = |of: &DMatrix<f64>, kind: usize| -> f64 { kinds[kind].iter().map(|i| of[(*i, *i)]).sum() };
        let squares = |of: &DMatrix<f64>, a: usize, b: usize| -> f64 {
            let places = kinds[a].iter().flat_map(|i| kinds[b].iter().map(move |j| (*i, *j)));
            places.map(|place| of[place].powi(2)).sum()
        };
        let readings = self.seen.iter().filter(|seen| **seen).count() as f64 - self.q.ncols() as f64;
        // Equations of τ² and of the kinds, and their right sides.
        let mut f = DMatrix::zeros(KINDS + 1, KINDS + 1);
        let mut right = DVector::zeros(KINDS + 1);
        f[(0, 0)] = readings;
        right[0] = deviations.iter().map(DVector::norm_squared).sum::<f64>() / dof;
        let projected: Vec<DVector<f64>> = deviations.iter().map(|d| self.z.tr_mul(d)).collect();
        for k in 0..KINDS {
            f[(0, k + 1)] = trace(&g, k);
            f[(k + 1, 0)] = f[(0, k + 1)];
            (0..KINDS).for_each(|j| f[(k + 1, j + 1)] = squares(&g, k, j));
            let along = projected.iter().flat_map(|p| kinds[k].iter().map(move |i| p[*i].powi(2)));
            right[k + 1] = along.sum::<f64>() / dof;
        }
        let (theta, inverse, used) = nonnegative(&f, &right);
        // Variance of the quadratic forms at θ: 2/dof |Z_jᵀ C Z_k|², C = M(τ² I + Σ v Z Zᵀ)M.
        let v: Vec<f64> = self.columns.iter().map(|c| theta[c.kind + 1]).collect();
        let v = DMatrix::from_diagonal(&DVector::from_vec(v));
        let (gv, gvg) = (&g * &v, &g * &v * &g);
        let c = &g * theta[0] + &gvg;
        // Zᵀ C C Z and the trace of C C.
        let twice = &c * theta[0] + &gvg * theta[0] + &gv * &gvg;
        let whole = theta[0].powi(2) * readings + 2.0 * theta[0] * gv.trace() + (&gv * &gv).trace();
        let form = |a: usize, b: usize| -> f64 {
            match (a, b) {
                (0, 0) => whole,
                (0, k) | (k, 0) => trace(&twice, k - 1),
                (a, b) => squares(&c, a - 1, b - 1),
            }
        };
        let forms = DMatrix::from_fn(used.len(), used.len(), |i, j| 2.0 / dof * form(used[i], used[j]));
        let covariance = &inverse * forms * &inverse;
        let mut scatter = HoldNoise { reading_m2: theta[0], columns: self.columns, ..HoldNoise::default() };
        for (i, k) in used.iter().enumerate() {
            let sd = covariance[(i, i)].max(0.0).sqrt();
            if *k == 0 {
                scatter.dof = (2.0 * (theta[0] / sd).powi(2)).round() as usize;
            } else if theta[*k] > 0.0 {
                scatter.sd[k - 1] = theta[*k].sqrt();
                scatter.is_significant[k - 1] = policy::holds_scatter(theta[*k], sd);
                scatter.test_variance[k - 1] = theta[*k] + policy::HOLD_VARIANCE_ERRORS * sd;
            }
        }
        let kept: [bool; KINDS] = std::array::from_fn(|k| scatter.sd[k] > 0.0);
        scatter.columns.retain(|column| kept[column.kind]);
        scatter
    }
}

fn basis(columns: DMatrix<f64>) -> DMatrix<f64> {
    let mut kept: Vec<DVector<f64>> = Vec::new();
    for column in columns.column_iter() {
        let length = column.norm();
        let mut rest = column.clone_owned();
        for _ in 0..2 {
            for q in &kept {
                let along = q.dot(&rest);
                rest.axpy(-along, q, 1.0);
            }
        }
        let left = rest.norm();
        if left > 1e-6 * length && length > 0.0 {
            kept.push(rest / left);
        }
    }
    match kept.is_empty() {
        true => DMatrix::zeros(columns.nrows(), 0),
        false => DMatrix::from_columns(&kept),
    }
}

/// θ ≥ 0 with F θ = r in the unknowns that are used, those below zero left out one after the other; the inverse of that part of F,
/// and the unknowns.
fn nonnegative(f: &DMatrix<f64>, right: &DVector<f64>) -> (DVector<f64>, DMatrix<f64>, Vec<usize>) {
    let mut used: Vec<usize> = (0..f.nrows()).filter(|i| f[(*i, *i)] > 0.0).collect();
    loop {
        // Scaled, because the unknowns have different units.
        let scale = |i: usize| f[(used[i], used[i])].sqrt();
        let part = DMatrix::from_fn(used.len(), used.len(), |i, j| f[(used[i], used[j])] / (scale(i) * scale(j)));
        let side = DVector::from_fn(used.len(), |i, _| right[used[i]] / scale(i));
        let inverse = part.clone().try_inverse().unwrap_or_else(|| DMatrix::zeros(used.len(), used.len()));
        let scaled = &inverse * side;
        let lowest = least((0..used.len()).filter(|i| used[*i] != 0), |i| scaled[*i]);
        match lowest.filter(|i| scaled[*i] < 0.0) {
            Some(i) => {
                used.remove(i);
            }
            None => {
                let mut theta = DVector::zeros(f.nrows());
                (0..used.len()).for_each(|i| theta[used[i]] = (scaled[i] / scale(i)).max(0.0));
                let inverse = DMatrix::from_fn(used.len(), used.len(), |i, j| inverse[(i, j)] / (scale(i) * scale(j)));
                return (theta, inverse, used);
            }
        }
    }
}
