//! A learned law: chosen by the missing moments of pressures left out, then fitted to the markers by the full model.

use crate::diagnosis::candidates::{Candidate, candidate, has, hold_shapes};
use crate::diagnosis::case::DiagnosisCase;
use crate::diagnosis::decide::Decision;
use crate::diagnosis::heldout::HeldOut;
use crate::diagnosis::interval::intervals;
use crate::diagnosis::missing::{SeenMoments, curves_of, missing_moment, seen};
use crate::diagnosis::options::Options;
use crate::diagnosis::problem::{Block, Fit};
use crate::diagnosis::result::words::with_interval;
use crate::diagnosis::result::{Diagnosis, LearnedLaw, LearnedLine, LearnedTried, Verdict};
use crate::diagnosis::singles::parameter_values;
use crate::diagnosis::source::DiagnosisSource;
use crate::error::CompareError;
use crate::fit::numbers::{mean, sort_by};
use crate::moment::learned::{LawFormula, MomentMaterial, PULL, Tried, rank, taken};
use crate::moment::{MissingMoment, MomentCurve, MomentPoint};
use models::Scenario;
use nalgebra::{DMatrix, DVector};

const NAME: &str = "learned";
const CURVE: &str = "learned law";
const LINE: &str = "marker_height";
/// Share of the pull by which it is found.
const SHARE: f64 = 0.5;

/// The missing moment of a diagnosis, and the law that is learned from it where the catalogue has none.
///
/// # Errors
/// Data of which no shape comes near.
pub(crate) fn moments(
    case: &DiagnosisCase,
    decision: &Decision,
    options: &Options,
    found: &Diagnosis,
) -> Result<(Option<MissingMoment>, Option<LearnedLaw>), CompareError> {
    let seen = seen(case)?;
    let mut shown = missing_moment(case, &seen, decision, found)?;
    let mut learned = None;
    if (options.learn || found.verdict == Some(Verdict::OutOfCatalog))
        && let Some((law, curves)) = learn(case, &seen, options, found, &shown.points)?
    {
        shown.curves.extend(curves);
        learned = Some(law);
    }
    Ok((Some(shown).filter(|_| options.missing_moment), learned))
}

type ToldLaw = (LearnedLaw, Vec<MomentCurve>);

/// Laws that are fitted to the markers: those that predict moments best.
const SHORT_LIST: usize = 7;

fn learn(
    case: &DiagnosisCase,
    seen: &[SeenMoments],
    options: &Options,
    found: &Diagnosis,
    points: &[MomentPoint],
) -> Result<Option<ToldLaw>, CompareError> {
    let Some(nothing_mm) = found.base.heldout_mm else { return Ok(None) };
    let ranked = rank(&material(case, seen)?, seen[0].robot());
    let name = free_name(&case.first().scenario);
    let noise_mm = found.base.noise_floor_mm.unwrap_or(0.0).max(found.tolerance_mm);
    let ground = LawTrial { sources: case.sources, options, line: line(case, seen), name: &name };
    let mut laws = vec![(case.problem.bendings, nothing_mm / noise_mm)];
    let (mut tried, mut kept) = (Vec::new(), Vec::new());
    for law in ranked.iter().filter(|t| t.form.is_some()).take(SHORT_LIST) {
        let Some((form, heldout_mm, numbers)) = ground.with(law, &mut |case, fit, form| {
            let heldout_mm = HeldOut::new(case)?.pressure_mm(fit).filter(|_| is_held_by_data(case, fit));
            Ok(heldout_mm.map(|mm| (form, mm, case.problem.bendings + form.numbers.len())))
        })?
        else {
            continue;
        };
        laws.push((numbers, heldout_mm / noise_mm));
        tried.push(LearnedTried { words: form.words.into(), numbers, missed: law.score(), heldout_mm });
        kept.push(law);
    }
    let Some(which) = taken(&laws).and_then(|i| i.checked_sub(1)) else { return Ok(None) };
    sort_by(&mut tried, |law| law.heldout_mm);
    ground.with(kept[which], &mut |case, fit, form| {
        let law = LearnedLaw { tried: tried.clone(), ..told(case, fit, form, &name, found)? };
        Ok(Some((law, curves_of(case, fit, (CURVE, true), points)?)))
    })
}

/// Whether the data hold every number of a law: an interval that reaches both ends of its range shows that they do not.
fn is_held_by_data(case: &DiagnosisCase, fit: &Fit) -> bool {
    let free = fit.effects.iter().flat_map(|e| &case.candidate(*e).parameters);
    let found = intervals(case, fit, false).into_iter().skip(case.problem.bendings);
    free.zip(found).all(|(p, interval)| interval.is_none_or(|[lo, hi]| lo > p.lower || hi < p.upper))
}

struct LawTrial<'a> {
    sources: &'a [DiagnosisSource],
    options: &'a Options,
    line: Option<f64>,
    name: &'a str,
}

type LawUse<'u, T> = dyn FnMut(&DiagnosisCase, &Fit, &'static LawFormula) -> Result<Option<T>, CompareError> + 'u;

impl LawTrial<'_> {
    /// Fits a law to the markers; `None` without equilibrium.
    fn with<T>(&self, law: &Tried, each: &mut LawUse<T>) -> Result<Option<T>, CompareError> {
        let Some(form) = law.form else { return Ok(None) };
        let extended = |source: &DiagnosisSource| DiagnosisSource {
            scenario: extended(&source.scenario, form, self.name, self.line),
            ..source.clone()
        };
        let sources: Vec<DiagnosisSource> = self.sources.iter().map(extended).collect();
        let candidates = candidates(&sources[0].scenario, self.name, self.line);
        let options = Options { keep_bending: self.options.keep_bending || form.has_spring(), ..self.options.clone() };
        let own = (&candidates[..], candidates.len() - 1);
        let case = DiagnosisCase::new(&sources, own, &options)?;
        let Some(fit) = fitted(&case, &law.values) else { return Ok(None) };
        each(&case, &fit, form)
    }
}

fn material(case: &DiagnosisCase, seen: &[SeenMoments]) -> Result<MomentMaterial, CompareError> {
    let (mut places, mut moments, mut parts) = (Vec::new(), Vec::new(), Vec::new());
    for (block, seen) in case.problem.blocks.iter().zip(seen) {
        let pulls = pulls(block, seen)?;
        let groups = seen.shape.division.groups;
        let robot = seen.robot();
        let own = seen.moments.points.iter().enumerate().filter(|(_, p)| !p.is_change);
        let rows: Vec<usize> = own.clone().map(|(i, _)| i).collect();
        for (_, p) in own {
            let place = p.place.unwrap_or(0);
            let pull = mean((0..groups).map(|g| pulls[(p.hold - 1) * groups + g][place]));
            let at = seen.shape.division.places[place];
            let hold = &block.source.dataset.holds[p.hold - 1];
            let theta = p.kappa * robot.actuator.shape.length_m;
            let s = 0.5 * (at.from_m + at.to_m);
            let (radius, stiffness) = (robot.radius_m, robot.bending_stiffness);
            places.push([p.kappa, theta, hold.p_act_pa, hold.p_body_pa, s, radius, stiffness, pull]);
            moments.push(p.moment_nm);
        }
        parts.push(DMatrix::from_fn(rows.len(), rows.len(), |i, j| seen.moments.covariance[(rows[i], rows[j])]));
    }
    let mut covariance = DMatrix::zeros(moments.len(), moments.len());
    let mut from = 0;
    for part in parts {
        covariance.view_mut((from, from), part.shape()).copy_from(&part);
        from += part.nrows();
    }
    let stiffness = (case.problem.bendings > 0).then(|| seen[0].robot().bending_stiffness);
    Ok(MomentMaterial { places, moments: DVector::from_vec(moments), covariance, stiffness })
}

/// The actuator's pull at the measured bends: the moment missing where a share of the pull is removed, over that share.
fn pulls(block: &Block, seen: &SeenMoments) -> Result<Vec<Vec<f64>>, CompareError> {
    let taken = |scenario: &Scenario| {
        let formula = PULL.formula("pull_share", scenario);
        let mut other = scenario.clone();
        other.formulas.extend(formula);
        other.with_effect("pull_share", &[SHARE])
    };
    let with = seen.missing(block, &taken)?;
    let without = seen.missing(block, &Scenario::clone)?;
    let each = |(a, b): (&Vec<f64>, &Vec<f64>)| a.iter().zip(b).map(|(a, b)| (a - b) / SHARE).collect();
    Ok(with.iter().zip(&without).map(each).collect())
}

/// Position of the markers' line, if the shapes find another one than the scenario's \[m\].
fn line(case: &DiagnosisCase, seen: &[SeenMoments]) -> Option<f64> {
    let shared = seen[0].shape.shared.first()?;
    (!has(&case.first().scenario, LINE) && !case.first().direct.frame && shared.is_told())
        .then_some(1e-3 * shared.value)
}

fn free_name(scenario: &Scenario) -> String {
    let is_free = |name: &String| scenario.formulas.iter().all(|f| f.name != *name);
    std::iter::once(NAME.to_string()).chain((2..).map(|i| format!("{NAME}_{i}"))).find(is_free).unwrap_or_default()
}

fn extended(scenario: &Scenario, form: &LawFormula, name: &str, line: Option<f64>) -> Scenario {
    let mut other = scenario.clone();
    other.formulas.extend(form.formula(name, scenario));
    line.map_or(other.clone(), |line| other.with_effect(LINE, &[line]))
}

fn candidates(scenario: &Scenario, name: &str, line: Option<f64>) -> Vec<Candidate> {
    let catalogue = scenario.catalogue();
    let names = line.map(|_| LINE).into_iter().chain([name]);
    let entries = names.filter_map(|name| Some(candidate(&catalogue.by_name(name)?, scenario.actuator.kind.name)));
    let mut candidates: Vec<Candidate> = entries.collect();
    hold_shapes(&mut candidates);
    candidates
}

/// Shares of what the moments say from which a law is fitted to the markers: the whole may leave no equilibrium.
const STARTS: [f64; 3] = [1.0, 0.5, 0.1];

fn fitted(case: &DiagnosisCase, values: &[f64]) -> Option<Fit> {
    let effects: Vec<usize> = (0..case.problem.candidates.len()).collect();
    let own = &case.problem.candidates[effects.len() - 1].parameters;
    let start = |share: f64| {
        let value = |(v, p): (&f64, &crate::diagnosis::candidates::Free)| if p.neutral == 0.0 { share * v } else { *v };
        let law = values.iter().zip(own).map(|pair| value(pair).clamp(pair.1.lower, pair.1.upper));
        case.base.theta_with(&law.collect::<Vec<f64>>())
    };
    case.problem.fit(&effects, &STARTS.map(start))
}

fn told(
    case: &DiagnosisCase,
    fit: &Fit,
    form: &LawFormula,
    name: &str,
    found: &Diagnosis,
) -> Result<LearnedLaw, CompareError> {
    let held_out = HeldOut::new(case)?;
    let mut values = parameter_values(case, fit, false);
    let own = values.split_off(values.len() - form.numbers.len());
    let numbers: Vec<String> = own.iter().map(with_interval).collect();
    let line = values.first().map(|line| LearnedLine {
        value_mm: line.value,
        interval_mm: line.lo.zip(line.hi).map(|(lo, hi)| [lo, hi]),
        training_mm: case.error_mm(&case.prediction(&case.base)),
        heldout_mm: held_out.pressure_mm(&case.base),
    });
    let adds = form.moment.starts_with('-') && own.first().is_some_and(|number| number.value < 0.0);
    let reverse =
        if adds { "; here it is negative and adds to the bend, so the scenario may have too much of it" } else { "" };
    Ok(LearnedLaw {
        name: name.into(),
        words: form.words.into(),
        formula: format!("M = {}; {}", form.moment_of(&case.first().scenario), numbers.join(", ")),
        parameters: own,
        line,
        before_mm: found.base.systematic_mm,
        heldout_before_mm: found.base.heldout_mm,
        after_mm: case.error_mm(&case.prediction(fit)),
        heldout_after_mm: held_out.pressure_mm(fit),
        heldout_run_after_mm: held_out.run_mm(fit),
        bending_nm2: case.bendings(fit),
        usual: format!("{}{reverse}", form.usual.words),
        check: form.usual.check.into(),
        tried: Vec::new(),
        toml: form.toml(name, &case.first().scenario),
    })
}
