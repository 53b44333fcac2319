//! Every effect of the catalogue refitted together with the base, and the set that the data cannot separate.

use crate::diagnosis::candidates::{Candidate, Free};
use crate::diagnosis::case::DiagnosisCase;
use crate::diagnosis::heldout::HeldOut;
use crate::diagnosis::interval::intervals;
use crate::diagnosis::order::{Ordered, criterion, sort, unusual};
use crate::diagnosis::problem::Fit;
use crate::diagnosis::result::words::quantity;
use crate::diagnosis::result::{ParameterValue, Ranked};
use crate::diagnosis::screen::starts;
use crate::fit::basis::{Basis, cosine};
use crate::fit::numbers::sort_by;
use crate::policy;
use crate::progress::{Progress, each};
use crate::stats::reported_p;
use crate::study::predict_dataset;

/// All effects fitted, best first, and the allowance for their form; those without equilibrium left out. Where the data push beyond
/// a range that ends where physics does not, the case searches further from then on, in the catalogue `wider`.
pub(crate) fn fit_all<'a>(
    case: &mut DiagnosisCase<'a>,
    wider: &'a mut Vec<Candidate>,
    progress: &mut Progress,
) -> (Vec<Fit>, f64) {
    let fit = |case: &DiagnosisCase, effect: usize, from: Option<&Fit>| {
        let from = from.map(|fit| fit.theta().to_vec());
        let starts = from.into_iter().chain(starts(&case.problem, &case.base, effect, true));
        case.problem.fit(&case.with(effect), &starts.collect::<Vec<_>>())
    };
    let first = each(&case.tried, "fitting every effect", progress, |effect| fit(case, *effect, None));
    let mut fits: Vec<Fit> = first.into_iter().flatten().collect();
    *wider = widened(case, &fits);
    case.problem.candidates = wider;
    for at_end in fits.iter_mut().filter(|fit| fit.open.contains(&true)) {
        if let Some(further) = fit(case, added(at_end), Some(at_end)) {
            *at_end = further;
        }
    }
    let allowance = sort(case, &mut fits, &case.base);
    (fits, allowance)
}

fn widened(case: &DiagnosisCase, fits: &[Fit]) -> Vec<Candidate> {
    let mut candidates = case.problem.candidates.to_vec();
    for fit in fits {
        let parameters = &mut candidates[added(fit)].parameters;
        let from = fit.theta().len() - parameters.len();
        for (k, p) in parameters.iter_mut().enumerate().filter(|(k, _)| fit.open[from + k]) {
            p.widen(fit.theta()[from + k]);
        }
    }
    candidates
}

fn added(fit: &Fit) -> usize {
    fit.effects[fit.effects.len() - 1]
}

/// Effects that no fit could try, and why: without equilibrium at whatever value.
pub(crate) fn left_out(case: &DiagnosisCase, fits: &[Fit]) -> Vec<String> {
    let DiagnosisCase { problem, base, .. } = case;
    let is_fitted = |effect: &usize| fits.iter().any(|fit| fit.effects.last() == Some(effect));
    let why = |effect: usize| {
        let theta = base.theta_with(&case.candidate(effect).at(1.0));
        let unsolved = problem.blocks.iter().find_map(|block| {
            let scenarios = problem.scenarios(block, &case.with(effect), &theta);
            scenarios.iter().find_map(|scenario| predict_dataset(scenario, &block.source.dataset).err())
        });
        unsolved.map_or("no equilibrium at any of the values tried".into(), |error| error.to_string())
    };
    let left_out = case.tried.iter().filter(|effect| !is_fitted(effect));
    left_out.map(|effect| format!("{} was left out: {}", case.candidate(*effect).name, why(*effect))).collect()
}

/// Whether the law of an effect had to take the last shape that it can: then what comes as close in mm, to a fifth, is a rival.
fn is_shape_at_end(case: &DiagnosisCase, fit: &Fit) -> bool {
    let parameters = &case.candidate(added(fit)).parameters;
    let own = &fit.theta()[fit.theta().len() - parameters.len()..];
    parameters.iter().zip(own).any(|(p, value)| p.is_shape_at_end(*value))
}

/// Indices of the fits that the data cannot separate from the best acceptable one, best first; empty if none helps.
pub(crate) fn indistinguishable(case: &DiagnosisCase, fits: &[Fit], allowance: f64) -> Vec<usize> {
    let acceptable = |i: &usize| !case.is_rejected(&fits[*i]) && case.gain(&fits[*i]) > 0.0;
    let Some(best) = (0..fits.len()).find(acceptable) else { return Vec::new() };
    let c = |i: usize| criterion(case, &fits[i], allowance);
    let near_mm = is_shape_at_end(case, &fits[best]).then(|| case.error_in_all_mm(&fits[best]) / policy::CLOSER);
    let is_near = |i: usize| near_mm.is_some_and(|most| case.error_in_all_mm(&fits[i]) < most);
    let is_alike = |i: &usize| policy::is_alike(c(*i), c(best)) || is_near(*i);
    (0..fits.len()).filter(acceptable).filter(is_alike).collect()
}

/// Beyond the set, the error at left-out data is computed for so many fits that lead the order, and for so many that leave least.
const LEFT_OUT_OF: usize = 8;

pub(crate) fn rank(case: &DiagnosisCase, singles: &Ordered, held_out: &HeldOut) -> Vec<Ranked> {
    let (fits, set) = (&singles.fits, &singles.set);
    let c = |fit: &Fit| criterion(case, fit, singles.allowance);
    let before = case.error_mm(&case.prediction(&case.base));
    let best = set.first().copied().unwrap_or(0);
    let trace = |fit: &Fit| Basis::of(&case.base.minimum.jacobian).rest(&fit.change_from(&case.base));
    let best_trace = fits.get(best).map(trace).unwrap_or_default();
    let least = fits.get(best).map_or(0.0, c);
    let after: Vec<f64> = fits.iter().map(|fit| case.error_mm(&case.prediction(fit))).collect();
    let mut nearest: Vec<usize> = (0..fits.len()).collect();
    sort_by(&mut nearest, |i| after[*i]);
    nearest.truncate(LEFT_OUT_OF);
    let is_left_out = |i: usize| set.contains(&i) || i < LEFT_OUT_OF || nearest.contains(&i);
    let entry = |(i, fit): (usize, &Fit)| {
        let candidate = case.candidate(added(fit));
        let parameters = parameter_values(case, fit, set.contains(&i));
        let own = parameters[parameters.len() - candidate.parameters.len()..].to_vec();
        let lead = own[candidate.lead()].clone();
        let gain = case.gain(fit);
        Ranked {
            effect: candidate.name.clone(),
            group: candidate.group,
            sentence: candidate.sentence.clone(),
            differs: candidate.differs.clone(),
            remedy: candidate.remedy.clone(),
            value: lead.value,
            unit: lead.unit,
            lo: lead.lo,
            hi: lead.hi,
            at_bound: own.iter().any(|p| p.at_bound),
            gain,
            bic_difference: c(fit) - least,
            p_corrected: case.p_of_gain(gain, candidate.sizes(), case.tests).map(reported_p),
            systematic_before_mm: before,
            systematic_after_mm: after[i],
            heldout_mm: is_left_out(i).then(|| held_out.pressure_mm(fit)).flatten(),
            heldout_run_mm: is_left_out(i).then(|| held_out.run_mm(fit)).flatten(),
            bending_nm2: case.bendings(fit),
            cosine_with_best: cosine(&best_trace, &trace(fit)),
            in_set: set.contains(&i),
            several_minima: fit.several_minima,
            notes: notes(case, fit, &own),
            parameters: own,
        }
    };
    fits.iter().enumerate().map(entry).collect()
}

/// Parameters of all effects of a fit in the units of the scenario.
pub(crate) fn parameter_values(case: &DiagnosisCase, fit: &Fit, profiled: bool) -> Vec<ParameterValue> {
    let intervals = intervals(case, fit, profiled);
    let free = fit.effects.iter().flat_map(|e| &case.candidate(*e).parameters);
    let found = |(k, p): (usize, &Free)| p.found(fit.theta()[k], intervals[k], fit.binding[k]);
    (case.problem.bendings..).zip(free).map(found).collect()
}

fn notes(case: &DiagnosisCase, fit: &Fit, own: &[ParameterValue]) -> Vec<String> {
    let rejected = |p: &ParameterValue| {
        let (symbol, value) = (&p.symbol, quantity(p.value, &p.unit));
        format!("rejected: the best {symbol} sits on its physical bound {value}, and the data push beyond it")
    };
    let mut notes: Vec<String> = own.iter().filter(|p| p.at_bound).map(rejected).collect();
    let effect = case.candidate(added(fit));
    let from = fit.theta().len() - own.len();
    for (k, p) in own.iter().enumerate() {
        let free = &effect.parameters[k];
        if fit.open[from + k] {
            let at_least = if fit.theta()[from + k] >= free.upper { "at least" } else { "at most" };
            let value = quantity(p.value, &p.unit);
            notes.push(format!("{} is {at_least} {value}: the data push beyond the range that is searched", p.symbol));
        }
    }
    for (group, (with, without)) in fit.theta().iter().zip(case.base.theta()).take(case.problem.bendings).enumerate() {
        if policy::bending_moves(*without, *with) && policy::helps(case.gain(fit)) {
            let several = case.body_pa.get(group).filter(|_| case.body_pa.len() > 1);
            let body = several.map_or(String::new(), |pa| format!(" at {:.0} kPa body pressure", pa / 1e3));
            notes.push(format!("with it, B moves from {without:.2} to {with:.2} N·m²{body}: the two compensate"));
        }
    }
    for (_, size) in unusual(case, fit).iter().filter(|_| policy::helps(case.gain(fit))) {
        let name = &effect.name;
        notes.push(format!("{name} at {size:.1} times its usual size: measure it before you believe it"));
    }
    if case.gain(fit) < 1e-6 {
        notes.push("leaves no trace in these data at any value that helps".into());
    } else if fit.several_minima {
        notes.push("different starts of the fit ended in different minima; the best one is given".into());
    }
    notes
}
