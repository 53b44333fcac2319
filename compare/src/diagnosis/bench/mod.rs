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

pub use result::{BenchDiagnosis, BenchOptions, BenchRanked, LeftOut};

use crate::CompareError;
use crate::bench::refuse;
use crate::diagnosis::decide::combined;
use crate::diagnosis::order;
use crate::diagnosis::result::Verdict;
use crate::fit::numbers::{groups, least, mean, sort_by};
use crate::policy;
use crate::stats::{chi2_tail, reported_p};
use data::Bench;
use models::Scenario;
use table::{BenchFit, BenchProblem};

/// Diagnoses a table of bench tests.
///
/// # Errors
/// A kind without a model, a scenario or a size that is missing, a row that the model cannot have.
pub fn diagnose_bench(
    bench: &Bench,
    scenario: Option<&Scenario>,
    options: &BenchOptions,
) -> Result<BenchDiagnosis, CompareError> {
    let mut table = BenchProblem::new(bench, scenario, options)?;
    let Some(base) = table.fit(None, None) else {
        let help = "look for a contraction beyond the muscle's range";
        return refuse(bench, "the model has no answer to a row of it", help);
    };
    let laws: Vec<BenchFit> = table.tried_laws().filter_map(|law| table.fit(Some(law), Some(&base))).collect();
    let mut all = vec![base];
    all.extend(laws);
    table.take_for_noise(&mut all);
    let (base, laws) = all.split_at_mut(1);
    let base = &base[0];
    let gains = laws.iter().filter(|fit| !fit.is_rejected()).map(|fit| fit.gain_over(base));
    let allowance = order::allowance(gains.fold(0.0, f64::max));
    // Typical sizes of the catalogue are typical of robots: on a bench they do not count.
    let rows = table.readings.len();
    let c = |fit: &BenchFit| order::criterion_from(rows, fit.minimum.cost, fit.free - base.free, allowance);
    sort_by(laws, c);
    let is_acceptable = |fit: &&BenchFit| !fit.is_rejected() && policy::helps(fit.gain_over(base));
    let best = laws.iter().find(is_acceptable);
    let is_in_set = |fit: &BenchFit| is_acceptable(&fit) && best.is_some_and(|best| policy::is_alike(c(fit), c(best)));
    let in_set: Vec<bool> = laws.iter().map(is_in_set).collect();
    let (verdict, p_value, explains) = judge(&table, base, best, options.alpha);
    let noise = || mean(table.readings.iter().filter_map(|r| r.noise()).map(|share| share * share)).sqrt().exp_m1();
    let where_it_fails = story::places(&table, base);
    let leftover = best.map(|best| story::places(&table, best));
    let mut left_out = left_out(&table, &all).into_iter();
    let (base, laws) = (&all[0], &all[1..]);
    let found = BenchDiagnosis {
        table: bench.file.clone(),
        kind: bench.kind.name,
        scenario: table.trial.scenario.name.clone(),
        rows,
        noise_known: table.known,
        verdict,
        p_value,
        alpha: options.alpha,
        off: base.rms_off(),
        noise: table.known.then(noise),
        reduced_chi2: table.known.then(|| base.minimum.cost / base.spare()),
        base: table.values(base),
        left_out: left_out.next().unwrap_or_default(),
        ranked: laws
            .iter()
            .zip(in_set)
            .zip(left_out)
            .map(|(of, left_out)| ranked(&table, base, of, left_out))
            .collect(),
        explains,
        unsized_laws: table.unsized_laws.clone(),
        summary: Vec::new(),
        where_it_fails,
        leftover: leftover.unwrap_or_default(),
    };
    Ok(BenchDiagnosis { summary: story::story(&found), ..found })
}

/// Verdict, its p, and whether the best law explains the table.
fn judge(
    table: &BenchProblem,
    base: &BenchFit,
    best: Option<&BenchFit>,
    alpha: f64,
) -> (Option<Verdict>, Option<f64>, bool) {
    let lack = |fit: &BenchFit| chi2_tail(fit.minimum.cost, table.readings.len().saturating_sub(fit.free));
    let before = base.rms_off().ln_1p().max(f64::MIN_POSITIVE);
    let little = best.map_or(1.0, |fit| fit.rms_off().ln_1p() / before) <= policy::LEFT_BY_ONE;
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

fn p_of(table: &BenchProblem, base: &BenchFit, fit: &BenchFit) -> f64 {
    let tests = table.tried_laws().count() as f64;
    (tests * chi2_tail(fit.gain_over(base), fit.free - base.free)).min(1.0)
}

fn ranked(
    table: &BenchProblem,
    base: &BenchFit,
    (fit, in_set): (&BenchFit, bool),
    left_out: Vec<LeftOut>,
) -> BenchRanked {
    let candidate = &table.laws[fit.law.unwrap_or_default()];
    let mut values = table.values(fit);
    BenchRanked {
        effect: candidate.name.clone(),
        group: candidate.group,
        sentence: candidate.sentence.clone(),
        differs: candidate.differs.clone(),
        remedy: candidate.remedy.clone(),
        parameters: values.split_off(values.len() - candidate.parameters.len()),
        at_bound: fit.is_rejected(),
        off: fit.rms_off(),
        gain: fit.gain_over(base),
        p_corrected: table.known.then(|| reported_p(p_of(table, base, fit))),
        left_out,
        in_set,
    }
}

/// Parts into which the loads of a single curve are divided.
const LOAD_PARTS: usize = 5;

/// Of every fit, its errors at what was left out, one for every way to leave something out.
fn left_out(table: &BenchProblem, fits: &[BenchFit]) -> Vec<Vec<LeftOut>> {
    let pressures = groups(&table.readings, |a, b| a.pressure_pa.to_bits() == b.pressure_pa.to_bits());
    let mut ways =
        vec![("pressure", pressures), ("specimen", groups(&table.readings, |a, b| a.specimen == b.specimen))];
    ways.retain(|(_, parts)| parts.len() > 1);
    if ways.is_empty() {
        let mut order: Vec<usize> = (0..table.readings.len()).collect();
        sort_by(&mut order, |i| table.readings[*i].drive);
        let size = order.len().div_ceil(LOAD_PARTS).max(1);
        ways.push(("load", order.chunks(size).map(<[usize]>::to_vec).collect()));
    }
    let mut of_fits = vec![Vec::new(); fits.len()];
    for (what, parts) in ways {
        let (mut squares, mut first_in) = (vec![0.0; fits.len()], vec![0; fits.len()]);
        for part in &parts {
            let kept: Vec<usize> = (0..table.readings.len()).filter(|i| !part.contains(i)).collect();
            let mut costs = vec![f64::INFINITY; fits.len()];
            for (i, fit) in fits.iter().enumerate() {
                let refitted = table.search(fit.law, &fit.minimum.at, Some(&kept));
                let off = refitted.as_ref().and_then(|m| table.off(fit.law, &m.at));
                squares[i] += off.map_or(f64::INFINITY, |off| part.iter().map(|k| off[*k].powi(2)).sum());
                costs[i] = refitted.filter(|_| !fit.is_rejected()).map_or(f64::INFINITY, |m| m.cost);
            }
            first_in[least(0..fits.len(), |i| costs[*i]).unwrap_or_default()] += 1;
        }
        for (i, own) in of_fits.iter_mut().enumerate() {
            let off = (squares[i] / table.readings.len() as f64).sqrt().exp_m1();
            own.push(LeftOut { what, off, first_in: first_in[i], parts: parts.len() });
        }
    }
    of_fits
}
