//! The numbers of a diagnosis derived a second time, with dense matrices: noise, fit, intervals, errors at data left out.
//!
//! ```text
//! Σ = σ²/R I + U diag(v) Uᵀ + Σ_k w_k/R Z_k Z_kᵀ      U = [∂f/∂ln p, δx, δy, rotation]      θ̂ = argmin (f − y)ᵀ Σ⁻¹ (f − y)
//! ```

pub(crate) use crate::held::f_tail;
use crate::held::{Held, mean};
use crate::robots::positions;
use data::{Dataset, Hold};
use models::Scenario;
use nalgebra::{DMatrix, DVector};
use statrs::distribution::{ContinuousCDF, StudentsT};

/// What the sensors are specified to: relative pressure, shifts of the camera \[m\], its roll \[rad\].
const SENSOR_SD: [f64; 4] = [0.003, 1e-4, 1e-4, 5e-4];

fn quantile_of_t(p: f64, dof: f64) -> f64 {
    StudentsT::new(0.0, 1.0, dof).unwrap().inverse_cdf(p)
}

/// Noise of the mean of a dataset.
pub(crate) struct Noise {
    runs: usize,
    sigma2: f64,
    /// Degrees of freedom of the estimate of σ².
    pub dof: usize,
    u: DMatrix<f64>,
    /// Variances of the four errors of the mean: best estimate, and as in tests.
    of_mean: [f64; 4],
    tested: [f64; 4],
    held: Held,
}

impl Noise {
    fn of(data: &Dataset, slope_m: &[f64]) -> Noise {
        let (mean, n, runs) = (mean(data, |_| true), data.values_per_run(), data.runs.len());
        let u = DMatrix::from_fn(n, 4, |i, j| match (j, i % 2) {
            (0, _) => slope_m[i],
            (1, 0) | (2, 1) => 1.0,
            (3, 0) => -mean[i + 1],
            (3, 1) => mean[i - 1],
            _ => 0.0,
        });
        let inverse = u.tr_mul(&u).try_inverse().unwrap();
        let (mut squares, mut of_runs) = (0.0, [0.0; 4]);
        for run in 0..runs {
            let off = DVector::from_column_slice(data.run(run)) - &mean;
            let c = &inverse * u.tr_mul(&off);
            squares += (off - &u * &c).norm_squared();
            of_runs.iter_mut().zip(c.iter()).for_each(|(v, c)| *v += c * c / (runs - 1) as f64);
        }
        let dof = (runs - 1) * (n - 4);
        let sigma2 = squares / dof as f64;
        let held = Held::of(data, &u, (sigma2, dof));
        let (sigma2, dof) = held.lasting.unwrap_or((sigma2, dof));
        let mut variance: [f64; 4] = std::array::from_fn(|j| (of_runs[j] - sigma2 * inverse[(j, j)]).max(0.0));
        variance[1] = 0.5 * (variance[1] + variance[2]);
        variance[2] = variance[1];
        let tested = std::array::from_fn(|j| {
            let repeats = if j == 1 || j == 2 { 2 * (runs - 1) } else { runs - 1 };
            let wider = (quantile_of_t(0.9975, repeats as f64) / 2.807_033_768_343_811).powi(2);
            (wider * variance[j]).max(SENSOR_SD[j].powi(2)) / runs as f64
        });
        Noise { runs, sigma2, dof, of_mean: variance.map(|v| v / runs as f64), tested, u, held }
    }

    /// Σ of some values, as in tests.
    fn covariance(&self, rows: &[usize]) -> DMatrix<f64> {
        let u = self.u.select_rows(rows);
        let shared = &u * DMatrix::from_diagonal(&DVector::from_row_slice(&self.tested)) * u.transpose();
        let held = self.held.tested(self.u.nrows()).select_rows(rows).select_columns(rows) / self.runs as f64;
        shared + held + DMatrix::identity(rows.len(), rows.len()) * (self.sigma2 / self.runs as f64)
    }

    /// L⁻¹ of Σ = L Lᵀ of some values.
    fn whitening(&self, rows: &[usize]) -> DMatrix<f64> {
        self.covariance(rows).cholesky().unwrap().l().try_inverse().unwrap()
    }

    /// Mean variance of some values of the mean, best estimate \[m²\].
    pub(crate) fn mean_square(&self, rows: &[usize]) -> f64 {
        let shared = |i: &usize| (0..4).map(|j| self.u[(*i, j)].powi(2) * self.of_mean[j]).sum::<f64>();
        let held =
            |i: &usize| self.held.kinds.iter().map(|(zz, w, _)| zz[(*i, *i)] * w).sum::<f64>() / self.runs as f64;
        let scattered = rows.iter().map(|i| shared(i) + held(i)).sum::<f64>();
        self.sigma2 / self.runs as f64 + scattered / rows.len() as f64
    }
}

/// Where a fit ended: whitened residuals, and their derivatives.
pub(crate) struct Fit {
    /// Bending stiffnesses, then the values of the effect.
    pub at: Vec<f64>,
    rest: DVector<f64>,
    slope: DMatrix<f64>,
}

impl Fit {
    pub(crate) fn cost(&self) -> f64 {
        self.rest.norm_squared()
    }

    pub(crate) fn covariance(&self) -> DMatrix<f64> {
        self.slope.tr_mul(&self.slope).try_inverse().unwrap()
    }
}

type Residuals<'r> = dyn Fn(&[f64]) -> DVector<f64> + 'r;

/// Gauss–Newton with the numbers of `held` left where they are.
fn least_squares(residuals: &Residuals, start: &[f64], held: Option<usize>) -> Fit {
    let mut at = start.to_vec();
    for _ in 0..40 {
        let Fit { rest, slope, .. } = here(residuals, &at);
        let free: Vec<usize> = (0..at.len()).filter(|k| Some(*k) != held).collect();
        let slope = slope.select_columns(&free);
        let step = -slope.tr_mul(&slope).try_inverse().unwrap() * slope.tr_mul(&rest);
        let moved = |share: f64| {
            let mut next = at.clone();
            free.iter().zip(step.iter()).for_each(|(k, d)| next[*k] += share * d);
            next
        };
        let falls = |share: &f64| residuals(&moved(*share)).norm_squared() < rest.norm_squared();
        let Some(share) = [1.0, 0.5, 0.25, 0.1, 0.02].into_iter().find(falls) else { break };
        at = moved(share);
        if step.amax() < 1e-9 {
            break;
        }
    }
    here(residuals, &at)
}

fn here(residuals: &Residuals, at: &[f64]) -> Fit {
    let column = |k: usize| {
        let moved = |by: f64| {
            residuals(&at.iter().enumerate().map(|(j, v)| if j == k { v + by } else { *v }).collect::<Vec<_>>())
        };
        (moved(1e-5) - moved(-1e-5)) / 2e-5
    };
    Fit {
        at: at.to_vec(),
        rest: residuals(at),
        slope: DMatrix::from_columns(&(0..at.len()).map(column).collect::<Vec<_>>()),
    }
}

/// A base, data and their noise; one bending stiffness for every level of the body pressure.
pub(crate) struct Reference<'a> {
    base: &'a Scenario,
    data: Vec<&'a Dataset>,
    levels_pa: Vec<f64>,
    /// B at the first level as it was measured, and its standard deviation.
    tested: Option<[f64; 2]>,
    /// The parameter of the first effect as it was measured, and its standard deviation.
    measured: Option<[f64; 2]>,
    pub noise: Vec<Noise>,
    whitening: Vec<DMatrix<f64>>,
}

impl<'a> Reference<'a> {
    /// The noise needs ∂f/∂ln p, which needs the fitted B, which needs the noise: two rounds.
    pub(crate) fn of(base: &'a Scenario, data: &[&'a Dataset], levels_pa: &[f64]) -> Reference<'a> {
        Reference::with_tests(base, data, levels_pa, [None; 2])
    }

    /// The same with values and standard deviations that separate tests found: of the first B, and of the first effect.
    pub(crate) fn with_tests(
        base: &'a Scenario,
        data: &[&'a Dataset],
        levels_pa: &[f64],
        [tested, measured]: [Option<[f64; 2]>; 2],
    ) -> Reference<'a> {
        let (data, levels_pa, noise, whitening) = (data.to_vec(), levels_pa.to_vec(), Vec::new(), Vec::new());
        let mut reference = Reference { base, data, levels_pa, tested, measured, noise, whitening };
        reference.estimate(&vec![base.bending_stiffness; reference.levels_pa.len()]);
        let first = reference.base();
        reference.estimate(&first.at);
        reference
    }

    fn estimate(&mut self, bending: &[f64]) {
        let slope = |data: &&Dataset| -> Vec<f64> {
            let [low, high] = [1.0 - 1e-4, 1.0 + 1e-4].map(|factor| self.positions(data, &[], bending, factor));
            high.iter().zip(&low).map(|(high, low)| (high - low) / 2e-4).collect()
        };
        self.noise = self.data.iter().map(|data| Noise::of(data, &slope(data))).collect();
        let all = |data: &&Dataset| (0..data.values_per_run()).collect::<Vec<_>>();
        self.whitening = self.noise.iter().zip(&self.data).map(|(noise, data)| noise.whitening(&all(data))).collect();
    }

    /// Positions with an effect, hold by hold at the B of the nearest body pressure.
    fn positions(&self, data: &Dataset, effects: &[&str], at: &[f64], factor: f64) -> Vec<f64> {
        let (bending, values) = at.split_at(self.levels_pa.len());
        let robot = |level: usize| {
            let plain = self.base.with_bending(bending[level]);
            match effects {
                [one] => plain.with_effect(one, values),
                more => more.iter().zip(values).fold(plain, |robot, (name, value)| robot.with_effect(name, &[*value])),
            }
        };
        let all: Vec<Vec<f64>> =
            (0..bending.len()).map(|level| positions(&robot(level), &data.holds, factor)).collect();
        let width = all[0].len() / data.holds.len();
        (0..all[0].len()).map(|i| all[self.level(&data.holds[i / width])][i]).collect()
    }

    fn level(&self, hold: &Hold) -> usize {
        let away = |level: &usize| (self.levels_pa[*level] - hold.p_body_pa).abs();
        (0..self.levels_pa.len()).min_by(|a, b| away(a).total_cmp(&away(b))).unwrap()
    }

    fn residuals(&self, effects: &[&str], at: &[f64]) -> DVector<f64> {
        let mut all = Vec::new();
        for (data, whitening) in self.data.iter().zip(&self.whitening) {
            let off = DVector::from_vec(self.positions(data, effects, at, 1.0)) - mean(data, |_| true);
            all.extend((whitening * off).iter());
        }
        all.extend(self.tested.map(|[value, sd]| (at[0] - value) / sd));
        let of_effect = at.get(self.levels_pa.len());
        all.extend(self.measured.zip(of_effect).map(|([value, sd], found)| (found - value) / sd));
        DVector::from_vec(all)
    }

    /// The base with its bending stiffnesses fitted.
    pub(crate) fn base(&self) -> Fit {
        let start = vec![self.base.bending_stiffness; self.levels_pa.len()];
        least_squares(&|at| self.residuals(&[], at), &start, None)
    }

    /// The base with effects of one parameter each.
    pub(crate) fn with(&self, effects: &[&str]) -> Fit {
        let start = [self.base().at, vec![0.0; effects.len()]].concat();
        least_squares(&|at| self.residuals(effects, at), &start, None)
    }

    /// Error of a fit in the first data beyond the noise of their mean \[mm\].
    pub(crate) fn error_mm(&self, effects: &[&str], at: &[f64]) -> f64 {
        self.error_in_mm(0, effects, at)
    }

    /// The same in the data with that number.
    pub(crate) fn error_in_mm(&self, which: usize, effects: &[&str], at: &[f64]) -> f64 {
        let data = self.data[which];
        let off = DVector::from_vec(self.positions(data, effects, at, 1.0)) - mean(data, |_| true);
        let all: Vec<usize> = (0..off.len()).collect();
        1e3 * (off.norm_squared() / off.len() as f64 - self.noise[which].mean_square(&all)).max(0.0).sqrt()
    }

    /// 95 % interval of a number of a fit of the first data; followed along the profile where it is wide, or where a bound is near.
    pub(crate) fn interval(&self, effects: &[&str], fit: &Fit, k: usize, [lower, upper]: [f64; 2]) -> [f64; 2] {
        let (noise, covariance) = (&self.noise[0], fit.covariance());
        let weights = self.whitening[0].tr_mul(&(&fit.slope * covariance.column(k)));
        let runs = noise.runs as f64;
        let camera = noise.sigma2 / runs * weights.norm_squared();
        let along = noise.u.tr_mul(&weights);
        let of_runs: f64 = (0..4).map(|j| along[j].powi(2) * noise.of_mean[j].max(SENSOR_SD[j].powi(2) / runs)).sum();
        let held = (weights.transpose() * noise.held.tested(weights.len()) * &weights)[(0, 0)] / runs;
        let total = camera + of_runs + held;
        let dof = total * total / (camera * camera / noise.dof as f64 + of_runs * of_runs / (runs - 1.0));
        let half = quantile_of_t(0.975, dof) * total.sqrt();
        let (value, ends) = (fit.at[k], [fit.at[k] - half, fit.at[k] + half]);
        if half <= 0.3 * value.abs() && ends[0] >= lower && ends[1] <= upper {
            return ends;
        }
        let most = half * half / covariance[(k, k)];
        let rise = |x: f64| {
            let mut start = fit.at.clone();
            start[k] = x;
            least_squares(&|at| self.residuals(effects, at), &start, Some(k)).cost() - fit.cost()
        };
        [(-half, lower), (half, upper)].map(|(step, bound)| {
            let (mut inside, mut outside) = (value, value + 3.0 * step);
            for _ in 0..30 {
                let middle = 0.5 * (inside + outside);
                if rise(middle) < most { inside = middle } else { outside = middle }
            }
            if step < 0.0 { inside.max(bound) } else { inside.min(bound) }
        })
    }

    /// Error beyond noise at actuator pressures left out of a fit of the first data, one after the other \[mm\].
    pub(crate) fn left_out_pressure_mm(&self, effects: &[&str], fit: &Fit) -> f64 {
        let (data, all) = (self.data[0], mean(self.data[0], |_| true));
        let mut levels: Vec<f64> = data.holds.iter().map(|hold| hold.p_act_pa).filter(|p| *p > 0.0).collect();
        levels.dedup();
        let width = all.len() / data.holds.len();
        let parts = levels.iter().map(|level| {
            let (out, kept): (Vec<usize>, Vec<usize>) =
                (0..all.len()).partition(|i| data.holds[i / width].p_act_pa == *level);
            let noise_m2 = self.noise[0].mean_square(&out);
            self.left_out(effects, fit, (&kept, &all), (&out, &all), noise_m2)
        });
        rms_mm(parts)
    }

    /// The same for runs: the mean of the others is fitted, and a run alone scatters more than their mean.
    pub(crate) fn left_out_run_mm(&self, effects: &[&str], fit: &Fit) -> f64 {
        let data = self.data[0];
        let every: Vec<usize> = (0..data.values_per_run()).collect();
        let noise_of_run_m2 = self.noise[0].mean_square(&every) * data.runs.len() as f64;
        let parts = (0..data.runs.len()).map(|out| {
            let (others, truth) = (mean(data, |run| run != out), mean(data, |run| run == out));
            self.left_out(effects, fit, (&every, &others), (&every, &truth), noise_of_run_m2)
        });
        rms_mm(parts)
    }

    /// Sum of squares of the errors at some values of a fit to others, minus their noise and the noise in the fit; number of values.
    fn left_out(&self, effects: &[&str], start: &Fit, kept: Values, out: Values, noise_m2: f64) -> [f64; 2] {
        let pick = |rows: &[usize], of: &DVector<f64>| DVector::from_iterator(rows.len(), rows.iter().map(|i| of[*i]));
        let predicted =
            |rows: &[usize], at: &[f64]| pick(rows, &DVector::from_vec(self.positions(self.data[0], effects, at, 1.0)));
        let whitening = self.noise[0].whitening(kept.0);
        // Further data and separate tests stay in the fit.
        let further = |at: &[f64]| self.residuals(effects, at).rows_range(self.data[0].values_per_run()..).into_owned();
        let residuals = |at: &[f64]| {
            let first = &whitening * (predicted(kept.0, at) - pick(kept.0, kept.1));
            DVector::from_iterator(first.len() + further(at).len(), first.iter().chain(further(at).iter()).copied())
        };
        let refit = least_squares(&residuals, &start.at, None);
        let slope = here(&|at| predicted(out.0, at), &refit.at).slope;
        let taken_over_m2 = (&slope * refit.covariance() * slope.transpose()).trace() / out.0.len() as f64;
        let off = predicted(out.0, &refit.at) - pick(out.0, out.1);
        let n = out.0.len() as f64;
        [off.norm_squared() - n * (noise_m2 + taken_over_m2), n]
    }

    /// p of the residuals in the first data, averaged over values with the same key.
    pub(crate) fn lack_of_means(&self, effects: &[&str], at: &[f64], key: impl Fn(usize) -> usize, dof: usize) -> f64 {
        let off = DVector::from_vec(self.positions(self.data[0], effects, at, 1.0)) - mean(self.data[0], |_| true);
        let all: Vec<usize> = (0..off.len()).collect();
        let count = 1 + all.iter().map(|i| key(*i)).max().unwrap();
        let means = DMatrix::from_fn(count, off.len(), |k, i| f64::from(u8::from(key(i) == k)));
        let sigma = &means * self.noise[0].covariance(&all) * means.transpose();
        let left = &means * off;
        f_tail(left.dot(&sigma.cholesky().unwrap().solve(&left)) / dof as f64, dof, self.noise[0].dof)
    }

    /// Change of the whitened residuals by an effect, with the base fitted out.
    pub(crate) fn trace(&self, effects: &[&str], values: &[f64]) -> DVector<f64> {
        let base = self.base();
        let change = self.residuals(effects, &[&base.at, values].concat()) - &base.rest;
        let fitted = &base.slope * base.covariance() * base.slope.tr_mul(&change);
        change - fitted
    }
}

/// Rows and all values of which they are some.
type Values<'v> = (&'v [usize], &'v DVector<f64>);

fn rms_mm(parts: impl Iterator<Item = [f64; 2]>) -> f64 {
    let [squares, count] = parts.fold([0.0; 2], |[s, n], [squares, count]| [s + squares, n + count]);
    1e3 * (squares.max(0.0) / count).sqrt()
}
