//! A table of bench tests as a least-squares problem.
//!
//! ```text
//! r = z((f − y)/(s/√n); n − 1)   with a standard deviation s of n tests        r = d/σ   without        d = asinh f/e − asinh y/e
//! ```
//!
//! f model, y measured, z the normal score of Student's t ([`normal_score`]), e a twentieth of the largest y of its kind. d is ln(f/y)
//! where both are well above e, and a share of e below: half and double are as far off. Without standard deviations σ is what
//! the best explanation leaves: differences are then ordered, and no p-value is formed.

use super::laws::{apply, laws, starts};
use super::reading::{BenchReading, steady};
use super::result::BenchOptions;
use crate::CompareError;
use crate::bench::{ANY_WIDTH_M, Trial, is_beam, is_free, measured, modelled, own_or_braid, refuse};
use crate::diagnosis::candidates::{Candidate, Free};
use crate::diagnosis::problem::is_binding;
use crate::diagnosis::result::ParameterValue;
use crate::fit::interval::{HalfWidth, misfit, of_parameter, weights};
use crate::fit::least_squares::{FitRange, Minimum, minimise, square};
use crate::fit::numbers::{groups, least, mean};
use crate::policy;
use crate::stats::{normal_score, t_975};
use data::Bench;
use models::Scenario;

/// Share of the largest value below which errors are no longer ratios.
const LEAST_SHARE: f64 = 0.05;
/// Error that a table without standard deviations has at least, as a share.
const LEAST_SIGMA: f64 = 1e-3;
/// A change of a prediction by less than this share is none.
const CHANGES: f64 = 1e-7;
/// A round of a fit that lowers the sum of squares by less is the last one.
const ENOUGH: f64 = 1e-3;
/// Starts that are followed, the best of all.
const STARTS: usize = 3;
/// Segments of a beam, at most: its deflection is then within a thousandth.
const SEGMENTS: usize = 60;

pub(super) struct BenchProblem<'a> {
    pub readings: Vec<BenchReading<'a>>,
    pub laws: Vec<Candidate>,
    /// Laws that are fitted along with every other.
    always: Vec<usize>,
    pub trial: Trial,
    /// Laws that act by a size which neither table nor scenario gives.
    pub unsized_laws: Vec<String>,
    /// Whether every row has a standard error.
    pub known: bool,
    /// Relative error of a row where not.
    sigma: f64,
}

pub(super) struct BenchFit {
    pub law: Option<usize>,
    pub minimum: Minimum,
    binding: Vec<bool>,
    /// Number of parameters that it has free.
    pub free: usize,
    /// Errors d of all rows.
    pub off: Vec<f64>,
}

impl BenchFit {
    pub(super) fn is_rejected(&self) -> bool {
        self.binding.contains(&true)
    }

    /// Fall of the whitened sum of squares.
    pub(super) fn gain_over(&self, base: &BenchFit) -> f64 {
        base.minimum.cost - self.minimum.cost
    }

    pub(super) fn rms_off(&self) -> f64 {
        mean(self.off.iter().map(|off| off * off)).sqrt().exp_m1()
    }

    pub(super) fn spare(&self) -> f64 {
        self.off.len().saturating_sub(self.free).max(1) as f64
    }
}

impl<'a> BenchProblem<'a> {
    pub(super) fn new(
        bench: &'a Bench,
        scenario: Option<&Scenario>,
        options: &BenchOptions,
    ) -> Result<BenchProblem<'a>, CompareError> {
        is_beam(bench)?;
        let scenario = own_or_braid(bench, scenario)?;
        let scenario = Scenario { segments: scenario.segments.min(SEGMENTS), ..scenario };
        let (laws, always) = laws(bench, &scenario, options.refit);
        let trial = Trial { scenario, bias_rad: None };
        let small = [false, true].map(|free| {
            let own = bench.rows.iter().filter(|row| is_free(row) == free);
            LEAST_SHARE * own.map(|row| measured(row).abs()).fold(f64::MIN_POSITIVE, f64::max)
        });
        let reading = |row| BenchReading::new(row, &trial, small[usize::from(is_free(row))], options.sigma);
        let mut readings: Vec<BenchReading> = bench.rows.iter().map(reading).collect();
        for free in [false, true] {
            steady(readings.iter_mut().filter(|r| is_free(r.row) == free));
        }
        let known = readings.iter().all(|r| r.error.is_some());
        let mut table = BenchProblem { readings, laws, always, trial, unsized_laws: Vec::new(), known, sigma: 0.01 };
        table.check(bench)?;
        let base = table.starts().into_iter().next().unwrap_or_default();
        let before = table.predicted(None, &base);
        let mut acting: Vec<usize> = (0..table.laws.len()).collect();
        acting.retain(|i| table.always.contains(i) || table.acts(*i, &base, before.as_deref()));
        if table.trial.scenario.actuator.shape.width_m.is_nan() {
            let hangs = |i: &usize| !table.always.contains(i) && table.hangs_on_size(*i, &base);
            let (untold, told): (Vec<usize>, Vec<usize>) = acting.iter().partition(|i| hangs(i));
            table.unsized_laws = untold.iter().map(|i| table.laws[*i].name.clone()).collect();
            acting = told;
        }
        table.always = table.always.iter().filter_map(|i| acting.iter().position(|j| j == i)).collect();
        let mut i = 0..;
        table.laws.retain(|_| i.next().is_some_and(|i| acting.contains(&i)));
        Ok(table)
    }

    /// Every row has a specimen, with the base's own number where the table gives none.
    fn check(&self, bench: &Bench) -> Result<(), CompareError> {
        let theta: Vec<f64> = self.of(None).flat_map(|law| law.at(1.0)).collect();
        let trial = self.tried(None, &theta);
        for r in &self.readings {
            if let Err([problem, help]) = trial.specimen(r.row) {
                let help = help.replace(", or add --calibrate", "");
                return refuse(bench, &format!("line {}: {problem}", r.row.line), &help);
            }
        }
        Ok(())
    }

    /// Whether a law changes a prediction at any of the values from which it is fitted.
    fn acts(&self, law: usize, base: &[f64], before: Option<&[f64]>) -> bool {
        let Some(before) = before else { return true };
        let changed = |after: Vec<f64>| {
            let mut rows = after.iter().zip(before).zip(&self.readings);
            rows.any(|((a, b), r)| (a - b).abs() > CHANGES * r.small)
        };
        let after = |values: &Vec<f64>| self.predicted(Some(law), &[base, values].concat());
        starts(&self.laws[law]).iter().any(|values| after(values).is_some_and(changed))
    }

    /// Whether a law's prediction depends on the muscle's width, where neither table nor scenario gives it.
    fn hangs_on_size(&self, law: usize, base: &[f64]) -> bool {
        let theta = [base, &self.laws[law].at(1.0)].concat();
        let [thin, thick] = [0.5, 2.0].map(|factor| {
            let mut trial = self.tried(Some(law), &theta);
            trial.scenario.actuator.shape.width_m = factor * ANY_WIDTH_M;
            self.predicted_by(&trial)
        });
        let differ = |(a, b): (Vec<f64>, Vec<f64>)| a.iter().zip(&b).any(|(a, b)| (a - b).abs() > CHANGES);
        thin.zip(thick).is_none_or(differ)
    }

    pub(super) fn tried_laws(&self) -> impl Iterator<Item = usize> {
        (0..self.laws.len()).filter(|i| !self.always.contains(i))
    }

    fn of(&self, law: Option<usize>) -> impl Iterator<Item = &Candidate> {
        self.always.iter().copied().chain(law).map(|i| &self.laws[i])
    }

    fn parameters(&self, law: Option<usize>) -> impl Iterator<Item = &Free> {
        self.of(law).flat_map(|law| &law.parameters)
    }

    fn tried(&self, law: Option<usize>, theta: &[f64]) -> Trial {
        let (mut trial, mut rest) = (self.trial.clone(), theta);
        for law in self.of(law) {
            let (own, after) = rest.split_at(law.parameters.len());
            apply(law, &mut trial, own);
            rest = after;
        }
        trial
    }

    /// The model's value for every row, SI; `None` where it has no answer to one.
    fn predicted(&self, law: Option<usize>, theta: &[f64]) -> Option<Vec<f64>> {
        self.predicted_by(&self.tried(law, theta))
    }

    fn predicted_by(&self, trial: &Trial) -> Option<Vec<f64>> {
        let of = |r: &BenchReading| {
            let specimen = trial.specimen(r.row).ok()?;
            // A beam that has folded hangs from its clamp.
            modelled(r.row, &specimen).or(r.row.get("load").map(|_| specimen.length_m)).filter(|v| v.is_finite())
        };
        self.readings.iter().map(of).collect()
    }

    /// Errors d of all rows; `None` if the model has no value for one.
    pub(super) fn off(&self, law: Option<usize>, theta: &[f64]) -> Option<Vec<f64>> {
        Some(self.predicted(law, theta)?.into_iter().zip(&self.readings).map(|(f, r)| r.off(f)).collect())
    }

    fn residuals(&self, law: Option<usize>, theta: &[f64]) -> Option<Vec<f64>> {
        let of = |(r, f): (&BenchReading, f64)| match r.error.filter(|_| self.known) {
            Some([error, dof]) if dof.is_finite() => normal_score((f - r.measured) / error, dof),
            Some([sigma, _]) => r.off(f) / sigma,
            None => r.off(f) / self.sigma,
        };
        Some(self.readings.iter().zip(self.predicted(law, theta)?).map(of).collect())
    }

    fn ranges(&self, law: Option<usize>) -> Vec<FitRange> {
        self.parameters(law).map(Free::range).collect()
    }

    fn starts(&self) -> Vec<Vec<f64>> {
        self.of(None).fold(vec![Vec::new()], |before, law| {
            let own = starts(law);
            before.iter().flat_map(|b| own.iter().map(|o| [b.as_slice(), o].concat())).collect()
        })
    }

    /// The best fit from several starts; from the base's own values where there is a base.
    pub(super) fn fit(&self, law: Option<usize>, base: Option<&BenchFit>) -> Option<BenchFit> {
        let mut starts = match (base, law) {
            (Some(base), Some(i)) => {
                starts(&self.laws[i]).into_iter().map(|own| [base.minimum.at.as_slice(), &own].concat()).collect()
            }
            _ => self.starts(),
        };
        let cost = |theta: &Vec<f64>| self.residuals(law, theta).map_or(f64::INFINITY, |r| square(&r));
        starts.sort_by_cached_key(|theta| cost(theta).to_bits());
        let found = starts.iter().take(STARTS).filter_map(|start| self.search(law, start, None));
        let minimum = least(found, |minimum| minimum.cost)?;
        let is_binding = |(k, p): (usize, &Free)| p.range().is_free() && is_binding(&minimum, k, &p.range(), p.neutral);
        let binding = self.parameters(law).enumerate().map(is_binding).collect();
        let free = self.parameters(law).filter(|p| p.is_free()).count();
        Some(BenchFit { law, binding, free, off: self.off(law, &minimum.at)?, minimum })
    }

    /// The minimum that is reached from a start, on all rows or some.
    pub(super) fn search(&self, law: Option<usize>, start: &[f64], rows: Option<&[usize]>) -> Option<Minimum> {
        minimise(start, &self.ranges(law), ENOUGH, &mut |theta| {
            let all = self.residuals(law, theta)?;
            Some(match rows {
                Some(rows) => rows.iter().map(|i| all[*i]).collect(),
                None => all,
            })
        })
    }

    /// Without standard deviations what the best fit leaves is taken for noise.
    pub(super) fn take_for_noise(&mut self, fits: &mut [BenchFit]) {
        let variances = fits.iter().filter(|f| !f.is_rejected()).map(|f| f.minimum.cost / f.spare());
        let Some(least) = variances.reduce(f64::min).filter(|_| !self.known) else { return };
        let factor = least.sqrt().max(LEAST_SIGMA / self.sigma);
        self.sigma *= factor;
        for fit in fits {
            fit.minimum.cost /= factor * factor;
            let columns = fit.minimum.jacobian.iter_mut().chain([&mut fit.minimum.residual]);
            columns.flatten().for_each(|v| *v /= factor);
        }
    }

    /// Parameters of a fit, the base's first, with 95 % intervals.
    pub(super) fn values(&self, fit: &BenchFit) -> Vec<ParameterValue> {
        let of = |(k, p): (usize, &Free)| {
            let interval = if p.is_free() { self.interval(fit, k) } else { None };
            p.found(fit.minimum.at[k], interval, fit.binding[k])
        };
        self.parameters(fit.law).enumerate().map(of).collect()
    }

    /// Noise and, where the law misses by more or the noise is not known, what it misses by, with curves as the unit: rows of one specimen
    /// at one pressure.
    fn interval(&self, fit: &BenchFit, k: usize) -> Option<[f64; 2]> {
        let found = &fit.minimum;
        let (weights, squares) = weights(&found.jacobian, k)?;
        let missed = found.cost / found.residual.len() as f64;
        let misses = !self.known || policy::misses(missed);
        let key = |r: &BenchReading| (r.specimen.clone(), r.pressure_pa.to_bits());
        let curves = groups(&self.readings, |a, b| key(a) == key(b));
        let of_curve = |rows: &Vec<usize>| {
            let sum = |of: &dyn Fn(usize) -> f64| rows.iter().map(|i| weights[*i] * of(*i)).sum();
            [sum(&|i| weights[i]), sum(&|i| found.residual[i])]
        };
        let curves: Vec<[f64; 2]> = curves.iter().map(of_curve).collect();
        let each = if self.known { (missed - 1.0).max(0.0) * square(&weights) } else { 0.0 };
        let (more, dof) = match misses {
            true => misfit(&curves, (each, weights.len()), fit.free),
            false => (0.0, f64::INFINITY),
        };
        let noise = self.widening() / squares;
        let total = noise + more;
        let of_noise = if self.known { 0.0 } else { noise * noise / fit.spare() };
        let dof = total * total / (more * more / dof + of_noise);
        let half = HalfWidth { width: t_975(if dof < 1e4 { dof.max(1.0) as usize } else { 0 }) * total.sqrt(), misses };
        let mut residuals = |at: &[f64]| self.residuals(fit.law, at);
        of_parameter(k, &found.at, &self.ranges(fit.law), (half, squares), Some(&mut residuals))
    }

    /// How much more a fit scatters than its slopes say, because it leans on rows that showed a small deviation by chance:
    /// ν(ν + 1)/(ν − 1)², from the moments of x/(νs² + x²).
    fn widening(&self) -> f64 {
        mean(self.readings.iter().map(|r| match r.error.filter(|[_, dof]| self.known && dof.is_finite()) {
            Some([_, dof]) => dof * (dof + 1.0) / (dof - 1.0).max(0.5).powi(2),
            None => 1.0,
        }))
    }
}
