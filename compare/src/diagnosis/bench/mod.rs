//! Which effect is missing in the model of a bench test: a beam under a load, a muscle in a testing machine.
//!
//! ```text
//! table, scenario ─► residuals in standard errors ─► every law that acts, alone ─► one p ─► set ─► verdict
//!   (table)             (table)                         (laws)                               └─► left-out curves, places (story)
//! ```
//!
//! The statistics are the same as for markers: gains of the whitened sum of squares against the base, one p corrected for
//! all laws tried, a set of laws that the data cannot separate ([`crate::diagnosis::order`]), intervals with what the law misses by
//! ([`crate::fit::interval`]). The unit of what was left out is a pressure or a specimen; with one of each, a fifth of the loads.

mod laws;
mod reading;
mod result;
mod scatter;
mod story;
mod table;
#[cfg(test)]
mod tests;

pub use result::{BenchDiagnosis, BenchRanked, LeftOut};

use crate::CompareError;
use crate::bench::refuse;
use crate::diagnosis::decide::combined;
use crate::diagnosis::order;
use crate::diagnosis::result::Verdict;
use crate::policy;
use crate::stats::{chi2_tail, reported_p};
use data::Bench;
use models::Scenario;
use reading::groups;
use table::{Fit, Table};

/// Level, assumed scatter and refit of the scenario's own numbers in [`diagnose_bench`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BenchOptions {
    /// Level of the one corrected p-value.
    pub alpha: f64,
    /// Standard deviation of a row that states none, as a share of the measured value.
    pub sigma: Option<f64>,
    /// Fit what the scenario has along with every law.
    pub refit: bool,
}

impl Default for BenchOptions {
    fn default() -> Self {
        BenchOptions { alpha: crate::diagnosis::options::Options::default().alpha, sigma: None, refit: false }
    }
}

/// Diagnoses a table of bench tests.
///
/// # Errors
/// A kind without a model, a scenario or a size that is missing, a row that the model cannot have.
pub fn diagnose_bench(
    bench: &Bench,
    scenario: Option<&Scenario>,
    options: &BenchOptions,
) -> Result<BenchDiagnosis, CompareError> {
    let mut table = Table::new(bench, scenario, options.sigma, options.refit)?;
    let Some(base) = table.fit(None, None) else {
        return refuse(
            bench,
            "the model has no answer to a row of it",
            "look for a contraction beyond the muscle's range",
        );
    };
    let mut fits: Vec<Fit> = table.tried_laws().filter_map(|law| table.fit(Some(law), Some(&base))).collect();
    fits.push(base);
    table.take_for_noise(&mut fits);
    let Some(base) = fits.pop() else { return refuse(bench, "nothing was fitted", "add rows") };
    let allowance = sort(&table, &base, &mut fits);
    let set = set(&table, &base, &fits, allowance);
    let best = set.first().map(|i| &fits[*i]);
    let (verdict, p_value, explains) = judge(&table, &base, best, options.alpha);
    let left_out = left_out(&table, &base, &fits);
    // The base comes first there.
    let left_out = |i: usize| left_out.iter().map(|parts| parts[i].clone()).collect::<Vec<_>>();
    let ranked = |(i, fit): (usize, &Fit)| ranked(&table, &base, fit, (left_out(i + 1), set.contains(&i)));
    let places = |fit: &Fit| off(&table, fit).map(|off| story::places(&table, &off)).unwrap_or_default();
    let shares: Vec<f64> = table.readings.iter().filter_map(|r| r.noise()).collect();
    let spare = table.readings.len().saturating_sub(table.count(None)).max(1) as f64;
    let found = BenchDiagnosis {
        table: bench.file.clone(),
        kind: bench.kind.name,
        scenario: table.name().to_string(),
        rows: table.readings.len(),
        noise_known: table.known,
        verdict,
        p_value,
        alpha: options.alpha,
        off: rms_off(&table, &base),
        noise: table.known.then(|| rms(&shares).exp_m1()),
        reduced_chi2: table.known.then(|| base.minimum.cost / spare),
        base: table.values(&base),
        left_out: left_out(0),
        ranked: fits.iter().enumerate().map(ranked).collect(),
        explains,
        unsized_laws: table.unsized_laws.clone(),
        summary: Vec::new(),
        where_it_fails: places(&base),
        leftover: best.map(places).unwrap_or_default(),
    };
    Ok(BenchDiagnosis { summary: story::story(&found), ..found })
}

/// Verdict, its p, and whether the best law explains the table.
fn judge(table: &Table, base: &Fit, best: Option<&Fit>, alpha: f64) -> (Option<Verdict>, Option<f64>, bool) {
    let lack = |fit: &Fit| chi2_tail(fit.minimum.cost, table.readings.len().saturating_sub(table.count(fit.law)));
    let left =
        best.map_or(1.0, |fit| rms_off(table, fit).ln_1p() / rms_off(table, base).ln_1p().max(f64::MIN_POSITIVE));
    let little = left <= policy::LEFT_BY_ONE;
    if !table.known {
        return (None, None, little);
    }
    let p_effect = best.map_or(1.0, |fit| p_of(table, base, fit));
    let p = combined(p_effect, lack(base));
    let explains = best.is_some_and(|fit| little || lack(fit) >= (1.0 - policy::SHARE_OF_EFFECTS) * alpha);
    let verdict = match () {
        () if p >= alpha => Verdict::None,
        () if explains && p_effect < policy::SHARE_OF_EFFECTS * alpha => Verdict::Effect,
        () => Verdict::OutOfCatalog,
    };
    (Some(verdict), Some(reported_p(p)), explains && verdict == Verdict::Effect)
}

/// p of a gain, corrected for all laws tried.
fn p_of(table: &Table, base: &Fit, fit: &Fit) -> f64 {
    let added = table.count(fit.law) - table.count(None);
    let tests = table.tried_laws().count() as f64;
    (tests * chi2_tail(fit.gain_over(base), added)).min(1.0)
}

/// Sorts fits, and returns the allowance for the form of laws.
fn sort(table: &Table, base: &Fit, fits: &mut [Fit]) -> f64 {
    let gains = fits.iter().filter(|f| !f.is_rejected()).map(|f| f.gain_over(base));
    let allowance = order::allowance(gains.fold(0.0, f64::max));
    fits.sort_by(|a, b| criterion(table, a, allowance).total_cmp(&criterion(table, b, allowance)));
    allowance
}

/// Typical sizes of the catalogue are typical of robots: on a bench they do not count.
fn criterion(table: &Table, fit: &Fit, allowance: f64) -> f64 {
    let added = table.count(fit.law) - table.count(None);
    order::criterion_from(table.readings.len(), fit.minimum.cost, added, allowance)
}

/// Fits that the data cannot separate from the best one that no bound rejects; none where none of them gains.
fn set(table: &Table, base: &Fit, fits: &[Fit], allowance: f64) -> Vec<usize> {
    let acceptable = |i: &usize| !fits[*i].is_rejected() && policy::helps(fits[*i].gain_over(base));
    let c = |i: usize| criterion(table, &fits[i], allowance);
    let Some(best) = (0..fits.len()).find(acceptable) else { return Vec::new() };
    (0..fits.len()).filter(acceptable).filter(|i| policy::is_alike(c(*i), c(best))).collect()
}

fn ranked(table: &Table, base: &Fit, fit: &Fit, (left_out, in_set): (Vec<LeftOut>, bool)) -> BenchRanked {
    let candidate = &table.laws[fit.law.unwrap_or_default()].candidate;
    let values = table.values(fit);
    let parameters = values[values.len() - candidate.parameters.len()..].to_vec();
    BenchRanked {
        effect: candidate.name.clone(),
        group: candidate.group,
        sentence: candidate.sentence.clone(),
        differs: candidate.differs.clone(),
        remedy: candidate.remedy.clone(),
        at_bound: fit.is_rejected(),
        parameters,
        off: rms_off(table, fit),
        gain: fit.gain_over(base),
        p_corrected: table.known.then(|| reported_p(p_of(table, base, fit))),
        left_out,
        in_set,
    }
}

fn off(table: &Table, fit: &Fit) -> Option<Vec<f64>> {
    table.off(fit.law, &fit.minimum.at)
}

fn rms_off(table: &Table, fit: &Fit) -> f64 {
    off(table, fit).map_or(f64::INFINITY, |off| rms(&off).exp_m1())
}

fn rms(values: &[f64]) -> f64 {
    (values.iter().map(|v| v * v).sum::<f64>() / values.len().max(1) as f64).sqrt()
}

/// Parts into which the loads of a single curve are divided.
const LOAD_PARTS: usize = 5;

/// For every way to leave something out, the errors of the base and of all fits.
fn left_out(table: &Table, base: &Fit, fits: &[Fit]) -> Vec<Vec<LeftOut>> {
    let readings = || table.readings.iter();
    let pressures = groups(readings().map(|r| r.pressure_pa.to_bits()));
    let mut ways = vec![("pressure", pressures), ("specimen", groups(readings().map(|r| r.specimen.clone())))];
    ways.retain(|(_, parts)| parts.len() > 1);
    if ways.is_empty() {
        let mut order: Vec<usize> = (0..table.readings.len()).collect();
        order.sort_by(|a, b| table.readings[*a].drive.total_cmp(&table.readings[*b].drive));
        let size = order.len().div_ceil(LOAD_PARTS).max(1);
        ways.push(("load", order.chunks(size).map(<[usize]>::to_vec).collect()));
    }
    ways.iter().map(|(what, parts)| left_out_by(table, base, fits, what, parts)).collect()
}

fn left_out_by(table: &Table, base: &Fit, fits: &[Fit], what: &'static str, parts: &[Vec<usize>]) -> Vec<LeftOut> {
    let all: Vec<&Fit> = std::iter::once(base).chain(fits).collect();
    let (mut squares, mut first_in) = (vec![0.0; all.len()], vec![0; all.len()]);
    for part in parts {
        let kept: Vec<usize> = (0..table.readings.len()).filter(|i| !part.contains(i)).collect();
        let mut costs = vec![f64::INFINITY; all.len()];
        for (i, fit) in all.iter().enumerate() {
            let refitted = table.refit(fit.law, &fit.minimum.at, &kept);
            let off = refitted.as_ref().and_then(|m| table.off(fit.law, &m.at));
            squares[i] += off.map_or(f64::INFINITY, |off| part.iter().map(|k| off[*k].powi(2)).sum());
            costs[i] = refitted.filter(|_| !fit.is_rejected()).map_or(f64::INFINITY, |m| m.cost);
        }
        let best = (0..all.len()).min_by(|a, b| costs[*a].total_cmp(&costs[*b])).unwrap_or_default();
        first_in[best] += 1;
    }
    let rows = table.readings.len() as f64;
    let of = |(s, n): (f64, usize)| LeftOut { what, off: (s / rows).sqrt().exp_m1(), first_in: n, parts: parts.len() };
    squares.into_iter().zip(first_in).map(of).collect()
}
