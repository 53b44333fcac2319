//! A table of bench tests as a least-squares problem.
//!
//! ```text
//! r = z((f − y)/(s/√n); n − 1)   with a standard deviation s of n tests        r = d/σ   without        d = asinh f/e − asinh y/e
//! ```
//!
//! f model, y measured, z the normal score of Student's t ([`normal_score`]), e a twentieth of the largest y of its kind. d is ln(f/y)
//! where both are well above e, and a share of e below: half and double are as far off. Without standard deviations σ is what
//! the best explanation leaves: differences are then ordered, and no p-value is formed.

use super::laws::{Law, laws};
use super::reading::{Reading, groups, steady};
use crate::CompareError;
use crate::bench::{ANY_WIDTH_M, Trial, is_beam, is_free, measured, modelled, own_or_braid, refuse};
use crate::diagnosis::candidates::Free;
use crate::diagnosis::problem::is_binding;
use crate::diagnosis::result::ParameterValue;
use crate::fit::interval::{Half, misfit, of_parameter, weights};
use crate::fit::least_squares::{Minimum, Range, minimise, square};
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

/// A table and everything that may be tried on it.
pub(super) struct Table<'a> {
    pub readings: Vec<Reading<'a>>,
    pub laws: Vec<Law>,
    pub always: Vec<usize>,
    trial: Trial,
    /// Laws that act by a size which neither table nor scenario gives.
    pub unsized_laws: Vec<String>,
    /// Whether every row has a standard error.
    pub known: bool,
    /// Relative error of a row where not.
    sigma: f64,
}

/// The base, or the base with one law.
#[derive(Clone)]
pub(super) struct Fit {
    pub law: Option<usize>,
    pub minimum: Minimum,
    pub binding: Vec<bool>,
}

impl Fit {
    /// Whether the data push against a bound.
    pub(super) fn is_rejected(&self) -> bool {
        self.binding.contains(&true)
    }

    /// Fall of the whitened sum of squares.
    pub(super) fn gain_over(&self, base: &Fit) -> f64 {
        base.minimum.cost - self.minimum.cost
    }
}

impl<'a> Table<'a> {
    /// Reads a table; `sigma` is the relative standard deviation of rows that state none.
    pub(super) fn new(
        bench: &'a Bench,
        scenario: Option<&Scenario>,
        sigma: Option<f64>,
        refit: bool,
    ) -> Result<Table<'a>, CompareError> {
        is_beam(bench)?;
        let scenario = own_or_braid(bench, scenario)?;
        let scenario = Scenario { segments: scenario.segments.min(SEGMENTS), ..scenario };
        let (laws, always) = laws(bench, &scenario, refit);
        let trial = Trial { scenario, bias_rad: None };
        let largest = |free: bool| {
            bench
                .rows
                .iter()
                .filter(|r| is_free(r) == free)
                .map(|r| measured(r).abs())
                .fold(f64::MIN_POSITIVE, f64::max)
        };
        let mut readings = Vec::new();
        for row in &bench.rows {
            readings.push(Reading::new(row, &trial, LEAST_SHARE * largest(is_free(row)), sigma));
        }
        for free in [false, true] {
            steady(readings.iter_mut().filter(|r| is_free(r.row) == free));
        }
        let known = readings.iter().all(|r| r.error.is_some());
        let mut table = Table { readings, laws, always, trial, unsized_laws: Vec::new(), known, sigma: 0.01 };
        table.check(bench)?;
        let base = table.starts().into_iter().next().unwrap_or_default();
        let before = table.predicted(None, &base);
        let mut acting: Vec<usize> = (0..table.laws.len()).collect();
        acting.retain(|i| table.always.contains(i) || table.acts(*i, &base, before.as_deref()));
        if table.trial.scenario.actuator.shape.width_m.is_nan() {
            let hangs = |i: &usize| !table.always.contains(i) && table.hangs_on_size(*i, &base);
            let (untold, told): (Vec<usize>, Vec<usize>) = acting.iter().partition(|i| hangs(i));
            table.unsized_laws = untold.iter().map(|i| table.laws[*i].candidate.name.clone()).collect();
            acting = told;
        }
        table.always = table.always.iter().filter_map(|i| acting.iter().position(|j| j == i)).collect();
        let mut i = 0..;
        table.laws.retain(|_| i.next().is_some_and(|i| acting.contains(&i)));
        Ok(table)
    }

    /// Every row has a specimen, with the base's own number where the table gives none.
    fn check(&self, bench: &Bench) -> Result<(), CompareError> {
        let theta: Vec<f64> = self.always.iter().flat_map(|i| self.laws[*i].candidate.at(1.0)).collect();
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
        self.laws[law].starts().iter().any(|values| {
            let after = self.predicted(Some(law), &[base, values].concat());
            let changed = |after: Vec<f64>| {
                let mut rows = after.iter().zip(before).zip(&self.readings);
                rows.any(|((a, b), r)| (a - b).abs() > CHANGES * r.small)
            };
            after.is_some_and(changed)
        })
    }

    /// Whether a law's prediction depends on the muscle's width, where neither table nor scenario gives it.
    fn hangs_on_size(&self, law: usize, base: &[f64]) -> bool {
        let theta = [base, &self.laws[law].candidate.at(1.0)].concat();
        let [thin, thick] = [0.5, 2.0].map(|factor| {
            let mut trial = self.tried(Some(law), &theta);
            trial.scenario.actuator.shape.width_m = factor * ANY_WIDTH_M;
            self.predicted_by(&trial)
        });
        let differ = |(a, b): (Vec<f64>, Vec<f64>)| a.iter().zip(&b).any(|(a, b)| (a - b).abs() > CHANGES);
        thin.zip(thick).is_none_or(differ)
    }

    pub(super) fn name(&self) -> &str {
        &self.trial.scenario.name
    }

    /// Laws that are tried, and not fitted along anyhow.
    pub(super) fn tried_laws(&self) -> impl Iterator<Item = usize> {
        (0..self.laws.len()).filter(|i| !self.always.contains(i))
    }

    fn of(&self, law: Option<usize>) -> impl Iterator<Item = &Law> {
        self.always.iter().copied().chain(law).map(|i| &self.laws[i])
    }

    fn tried(&self, law: Option<usize>, theta: &[f64]) -> Trial {
        let (mut trial, mut rest) = (self.trial.clone(), theta);
        for law in self.of(law) {
            let (own, after) = rest.split_at(law.candidate.parameters.len());
            law.apply(&mut trial, own);
            rest = after;
        }
        trial
    }

    /// The model's value for every row, SI; `None` where it has no answer to one.
    pub(super) fn predicted(&self, law: Option<usize>, theta: &[f64]) -> Option<Vec<f64>> {
        self.predicted_by(&self.tried(law, theta))
    }

    fn predicted_by(&self, trial: &Trial) -> Option<Vec<f64>> {
        let of = |r: &Reading| {
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

    fn residuals(&self, law: Option<usize>, theta: &[f64], rows: &[usize]) -> Option<Vec<f64>> {
        let f = self.predicted(law, theta)?;
        let of = |i: &usize| {
            let (r, f) = (&self.readings[*i], f[*i]);
            match r.error.filter(|_| self.known) {
                Some([error, dof]) if dof.is_finite() => normal_score((f - r.measured) / error, dof),
                Some([sigma, _]) => r.off(f) / sigma,
                None => r.off(f) / self.sigma,
            }
        };
        Some(rows.iter().map(of).collect())
    }

    fn ranges(&self, law: Option<usize>) -> Vec<Range> {
        self.of(law).flat_map(|l| l.candidate.parameters.iter().map(Free::range)).collect()
    }

    fn starts(&self) -> Vec<Vec<f64>> {
        self.of(None).fold(vec![Vec::new()], |before, law| {
            let own = law.starts();
            before.iter().flat_map(|b| own.iter().map(|o| [b.as_slice(), o].concat())).collect()
        })
    }

    /// The best fit from several starts; from the base's own values where there is a base.
    pub(super) fn fit(&self, law: Option<usize>, base: Option<&Fit>) -> Option<Fit> {
        let mut starts = match (base, law) {
            (Some(base), Some(i)) => {
                self.laws[i].starts().into_iter().map(|own| [base.minimum.at.as_slice(), &own].concat()).collect()
            }
            _ => self.starts(),
        };
        let all: Vec<usize> = (0..self.readings.len()).collect();
        let cost = |theta: &Vec<f64>| self.residuals(law, theta, &all).map_or(f64::INFINITY, |r| square(&r));
        starts.sort_by_cached_key(|theta| cost(theta).to_bits());
        let fits = starts.iter().take(STARTS).filter_map(|start| self.refit(law, start, &all));
        let minimum = fits.min_by(|a, b| a.cost.total_cmp(&b.cost))?;
        Some(self.finished(law, minimum))
    }

    fn finished(&self, law: Option<usize>, minimum: Minimum) -> Fit {
        let ranges = self.ranges(law);
        let neutral: Vec<f64> = self.of(law).flat_map(|l| l.candidate.parameters.iter().map(|p| p.neutral)).collect();
        let binding = |k: usize| ranges[k].is_free() && is_binding(&minimum, k, &ranges[k], neutral[k]);
        Fit { law, binding: (0..ranges.len()).map(binding).collect(), minimum }
    }

    pub(super) fn refit(&self, law: Option<usize>, start: &[f64], rows: &[usize]) -> Option<Minimum> {
        minimise(start, &self.ranges(law), ENOUGH, &mut |theta| self.residuals(law, theta, rows))
    }

    /// Without standard deviations what the best fit leaves is taken for noise.
    pub(super) fn take_for_noise(&mut self, fits: &mut [Fit]) {
        let spare = |f: &Fit| self.readings.len().saturating_sub(self.count(f.law)).max(1) as f64;
        let variances = fits.iter().filter(|f| !f.is_rejected()).map(|f| f.minimum.cost / spare(f));
        let Some(least) = variances.reduce(f64::min).filter(|_| !self.known) else { return };
        let factor = least.sqrt().max(LEAST_SIGMA / self.sigma);
        self.sigma *= factor;
        for fit in fits {
            fit.minimum.cost /= factor * factor;
            let columns = fit.minimum.jacobian.iter_mut().chain([&mut fit.minimum.residual]);
            columns.flatten().for_each(|v| *v /= factor);
        }
    }

    /// Parameters that a fit has free.
    pub(super) fn count(&self, law: Option<usize>) -> usize {
        self.of(law).map(|l| l.candidate.count()).sum()
    }

    /// Parameters of a fit, the base's first, with 95 % intervals.
    pub(super) fn values(&self, fit: &Fit) -> Vec<ParameterValue> {
        let free = self.of(fit.law).flat_map(|l| &l.candidate.parameters);
        let of = |(k, p): (usize, &Free)| {
            let interval = if p.is_free() { self.interval(fit, k) } else { None };
            p.found(fit.minimum.at[k], interval, fit.binding[k])
        };
        free.enumerate().map(of).collect()
    }

    /// Noise and, where the law misses by more or the noise is not known, what it misses by, with curves as the unit.
    fn interval(&self, fit: &Fit, k: usize) -> Option<[f64; 2]> {
        let Minimum { at, residual, cost, jacobian } = &fit.minimum;
        let (weights, squares) = weights(jacobian, k)?;
        let missed = cost / residual.len() as f64;
        let misses = !self.known || policy::misses(missed);
        let curves: Vec<[f64; 2]> = self
            .curves()
            .iter()
            .map(|rows| {
                rows.iter().fold([0.0; 2], |s, i| [s[0] + weights[*i].powi(2), s[1] + weights[*i] * residual[*i]])
            })
            .collect();
        let each = if self.known { (missed - 1.0).max(0.0) * square(&weights) } else { 0.0 };
        let (more, dof) = misfit(&curves, (each, weights.len()), self.count(fit.law));
        let (more, dof) = if misses { (more, dof) } else { (0.0, f64::INFINITY) };
        let noise = self.widening() / squares;
        let total = noise + more;
        let spare = weights.len().saturating_sub(self.count(fit.law)).max(1) as f64;
        let of_noise = if self.known { 0.0 } else { noise * noise / spare };
        let dof = total * total / (more * more / dof + of_noise);
        let half = Half { width: t_975(if dof < 1e4 { dof.max(1.0) as usize } else { 0 }) * total.sqrt(), misses };
        let all: Vec<usize> = (0..self.readings.len()).collect();
        let mut residuals = |at: &[f64]| self.residuals(fit.law, at, &all);
        of_parameter(k, at, &self.ranges(fit.law), (half, squares), Some(&mut residuals))
    }

    /// How much more a fit scatters than its slopes say, because it leans on rows that showed a small deviation by chance:
    /// ν(ν + 1)/(ν − 1)², from the moments of x/(νs² + x²).
    fn widening(&self) -> f64 {
        let of = |r: &Reading| match r.error.filter(|[_, dof]| self.known && dof.is_finite()) {
            Some([_, dof]) => dof * (dof + 1.0) / (dof - 1.0).max(0.5).powi(2),
            None => 1.0,
        };
        self.readings.iter().map(of).sum::<f64>() / self.readings.len() as f64
    }

    /// Rows of one specimen at one pressure.
    fn curves(&self) -> Vec<Vec<usize>> {
        groups(self.readings.iter().map(|r| (r.specimen.clone(), r.pressure_pa.to_bits())))
    }
}

/// Segments of a beam, at most: its deflection is then within a thousandth.
const SEGMENTS: usize = 60;
