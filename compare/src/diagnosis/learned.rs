//! A learned law: chosen by the missing moments of pressures left out, then fitted to the markers by the full model.

use super::candidates::{Candidate, candidate, hold_shapes};
use super::case::Case;
use super::decide::Decision;
use super::heldout::HeldOut;
use super::missing::{Seen, curves_of, missing_moment, seen};
use super::options::Options;
use super::problem::{Block, Fit};
use super::result::{Diagnosis, ParameterValue, Verdict};
use super::singles::parameter_values;
use super::source::Source;
use super::story::with_interval;
use crate::error::CompareError;
use crate::moment::learned::{Form, Material, PULL, Tried, rank, taken};
use crate::moment::{MomentCurve, MomentPoint};
use models::Scenario;
use nalgebra::{DMatrix, DVector};
use serde::Serialize;

/// A law that was learned.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LearnedLaw {
    /// Name as an effect.
    pub name: String,
    /// What it is, in words.
    pub words: String,
    /// The moment as a formula, with its numbers and units.
    pub formula: String,
    /// Its numbers.
    pub parameters: Vec<ParameterValue>,
    /// Where the line of the markers lies, where that was fitted along.
    pub line: Option<LearnedLine>,
    /// Error beyond noise without either, B fitted unless it is kept \[mm\].
    pub before_mm: f64,
    /// The same at pressures left out of the fit.
    pub heldout_before_mm: Option<f64>,
    /// Error with the law and the line \[mm\].
    pub after_mm: f64,
    /// The same at pressures left out of the fit of both.
    pub heldout_after_mm: Option<f64>,
    /// The same for runs left out.
    pub heldout_run_after_mm: Option<f64>,
    /// B with it, one per body pressure; empty where it was kept, or where the law takes its place \[N·m²\].
    pub bending_nm2: Vec<f64>,
    /// What such a law usually is.
    pub usual: String,
    /// What tells.
    pub check: String,
    /// What was fitted to the markers: nothing, and the laws that fit the missing moments best.
    pub tried: Vec<LearnedTried>,
    /// The entry of a scenario.
    #[serde(skip)]
    pub toml: String,
}

/// The line of the markers, further from the taut side than the scenario says.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LearnedLine {
    /// By so much \[mm\].
    pub value_mm: f64,
    /// Ends of its 95 % interval \[mm\].
    pub interval_mm: Option<[f64; 2]>,
    /// Error beyond noise with it alone \[mm\].
    pub training_mm: f64,
    /// The same at pressures left out.
    pub heldout_mm: Option<f64>,
}

/// A law of the library that was fitted to the markers.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LearnedTried {
    /// In words.
    pub words: String,
    /// Its numbers, and those of the stiffness.
    pub numbers: usize,
    /// Square of what it misses at pressures left out, over that of noise, in moments.
    pub missed: f64,
    /// Error beyond noise at pressures left out \[mm\].
    pub heldout_mm: f64,
}

impl LearnedLaw {
    /// What was learned, in sentences.
    pub fn sentences(&self) -> Vec<String> {
        let mm = |v: Option<f64>| v.map_or("unknown".into(), |mm| format!("{mm:.2}"));
        let (before, after) = (mm(self.heldout_before_mm), mm(self.heldout_after_mm));
        let line = self.line.as_ref().map_or(String::new(), |line| {
            let side = if line.value_mm < 0.0 { "nearer to" } else { "further from" };
            let alone = mm(line.heldout_mm);
            format!("; of that the line of the markers, {:.1} mm {side} the taut side than the scenario says, brings it to {alone} mm", line.value_mm.abs())
        });
        vec![
            format!("A law learned from the missing moment, {}: {}.", self.words, self.formula),
            format!(
                "With it the error at pressures left out of the fit goes from {before} to {after} mm{line}. It was chosen by that \
                 figure: try it on other data."
            ),
            format!(
                "A law of this shape is usually {}. To tell: {}. `ibr add SCENARIO learned DATA` writes it as a formula.",
                self.usual, self.check
            ),
        ]
    }
}

/// Its name as an effect.
const NAME: &str = "learned";
/// Its curve.
const CURVE: &str = "learned law";
/// The effect that moves the line of the markers.
const LINE: &str = "marker_height";
/// Share of the pull by which it is found.
const SHARE: f64 = 0.5;

/// The missing moment of a diagnosis, and the law that is learned from it where the catalogue has none.
///
/// # Errors
/// Data of which no shape comes near.
pub fn moments(
    case: &Case,
    decision: &Decision,
    made: (&[Source], &[Vec<usize>]),
    options: &Options,
    found: &mut Diagnosis,
) -> Result<(), CompareError> {
    let seen = seen(case)?;
    let mut shown = missing_moment(case, &seen, decision, found)?;
    if (options.learn || found.verdict == Some(Verdict::OutOfCatalog))
        && let Some((law, curves)) = learn(case, &seen, made, options, found, &shown.points)?
    {
        shown.curves.extend(curves);
        found.learned = Some(law);
    }
    if options.missing_moment {
        found.missing_moment = Some(shown);
    }
    Ok(())
}

type Told = (LearnedLaw, Vec<MomentCurve>);

/// Laws that are fitted to the markers: those that predict moments best.
const SHORT_LIST: usize = 7;

fn learn(
    case: &Case,
    seen: &[Seen],
    (sources, sessions): (&[Source], &[Vec<usize>]),
    options: &Options,
    found: &Diagnosis,
    points: &[MomentPoint],
) -> Result<Option<Told>, CompareError> {
    let Some(nothing_mm) = found.base.heldout_mm else { return Ok(None) };
    let ranked = rank(&material(case, seen)?, seen[0].robot());
    let name = free_name(case.scenario);
    let noise_mm = found.base.noise_floor_mm.unwrap_or(0.0).max(found.tolerance_mm);
    let ground = Ground { sources, sessions, options, line: line(case, seen), name: &name };
    let (mut laws, mut tried) = (vec![(case.problem.bendings, nothing_mm / noise_mm)], Vec::new());
    let mut kept = Vec::new();
    for law in ranked.iter().filter(|t| t.form.is_some()).take(SHORT_LIST) {
        let Some((form, heldout_mm, numbers)) = ground.with(law, &mut |case, fit, form| {
            Ok(HeldOut::new(case)?.pressure_mm(fit).map(|mm| (form, mm, case.problem.bendings + form.numbers.len())))
        })?
        else {
            continue;
        };
        laws.push((numbers, heldout_mm / noise_mm));
        tried.push(LearnedTried { words: form.words.into(), numbers, missed: law.score(), heldout_mm });
        kept.push(law);
    }
    let Some(which) = taken(&laws).and_then(|i| i.checked_sub(1)) else { return Ok(None) };
    tried.sort_by(|a, b| a.heldout_mm.total_cmp(&b.heldout_mm));
    ground.with(kept[which], &mut |case, fit, form| {
        let law = LearnedLaw { tried: tried.clone(), ..told(case, fit, form, &name, found)? };
        Ok(Some((law, curves_of(case, fit, (CURVE, true), points)?)))
    })
}

/// What all laws are fitted on.
struct Ground<'a> {
    sources: &'a [Source<'a>],
    sessions: &'a [Vec<usize>],
    options: &'a Options,
    line: Option<f64>,
    name: &'a str,
}

/// What is made of a law that was fitted to the markers.
type Use<'u, T> = dyn FnMut(&Case, &Fit, &'static Form) -> Result<Option<T>, CompareError> + 'u;

impl Ground<'_> {
    /// Fits a law to the markers; `None` without equilibrium.
    fn with<T>(&self, law: &Tried, each: &mut Use<T>) -> Result<Option<T>, CompareError> {
        let Some(form) = law.form else { return Ok(None) };
        let extended = |source: &Source| extended(source.scenario, form, self.name, self.line);
        let scenarios: Vec<Scenario> = self.sources.iter().map(extended).collect();
        let sources = self.sources.iter().zip(&scenarios).map(|(source, scenario)| Source { scenario, ..*source });
        let candidates = candidates(&scenarios[0], self.name, self.line);
        let options = Options { keep_bending: self.options.keep_bending || form.has_spring(), ..self.options.clone() };
        let own = (&candidates[..], candidates.len() - 1);
        let case = Case::new(&sources.collect::<Vec<_>>(), self.sessions, own, &options)?;
        let Some(fit) = fitted(&case, &law.values) else { return Ok(None) };
        each(&case, &fit, form)
    }
}

/// Points of all data as the library wants them.
fn material(case: &Case, seen: &[Seen]) -> Result<Material, CompareError> {
    let (mut places, mut moments, mut parts) = (Vec::new(), Vec::new(), Vec::new());
    for (block, seen) in case.problem.blocks.iter().zip(seen) {
        let pulls = pulls(block, seen)?;
        let groups = seen.shape.division.groups;
        let robot = seen.robot();
        let own = seen.moments.points.iter().enumerate().filter(|(_, p)| p.since_first.is_none());
        let rows: Vec<usize> = own.clone().map(|(i, _)| i).collect();
        for (_, p) in own {
            let place = p.place.unwrap_or(0);
            let pull = (0..groups).map(|g| pulls[p.hold * groups + g][place]).sum::<f64>() / groups as f64;
            let at = seen.shape.division.places[place];
            let theta = p.kappa * robot.actuator.shape.length_m;
            let s = 0.5 * (at.from_m + at.to_m);
            places.push([p.kappa, theta, p.p_act_pa, p.p_body_pa, s, robot.radius_m, robot.bending_stiffness, pull]);
            moments.push(p.moment);
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
    Ok(Material { places, moments: DVector::from_vec(moments), covariance, stiffness })
}

/// The actuator's pull at the bends that were measured: what is missing where a share of it is taken away, over that share.
fn pulls(block: &Block, seen: &Seen) -> Result<Vec<Vec<f64>>, CompareError> {
    let taken = |scenario: &Scenario| {
        let formula = PULL.formula("pull_share", scenario);
        let mut other = scenario.clone();
        other.formulas.extend(formula);
        other.with_effect("pull_share", &[SHARE])
    };
    let (with, without) = (seen.missing(block, &taken)?, seen.missing(block, &Scenario::clone)?);
    let each = |(a, b): (&Vec<f64>, &Vec<f64>)| a.iter().zip(b).map(|(a, b)| (a - b) / SHARE).collect();
    Ok(with.iter().zip(&without).map(each).collect())
}

/// Where the line of the markers lies, if the shapes say elsewhere than the scenario \[m\].
fn line(case: &Case, seen: &[Seen]) -> Option<f64> {
    let is_there = case.scenario.effects.iter().any(|e| e.name == LINE);
    let shared = seen[0].shape.shared.first()?;
    (!is_there && !case.direct.frame && crate::moment::is_told(shared)).then_some(shared.value)
}

fn free_name(scenario: &Scenario) -> String {
    let is_free = |name: &String| scenario.formulas.iter().all(|f| f.name != *name);
    std::iter::once(NAME.to_string()).chain((2..).map(|i| format!("{NAME}_{i}"))).find(is_free).unwrap_or_default()
}

fn extended(scenario: &Scenario, form: &Form, name: &str, line: Option<f64>) -> Scenario {
    let mut other = scenario.clone();
    other.formulas.extend(form.formula(name, scenario));
    line.map_or(other.clone(), |line| other.with_effect(LINE, &[line]))
}

/// The line, if it is fitted along, and the law.
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

/// The law fitted to the markers.
fn fitted(case: &Case, values: &[f64]) -> Option<Fit> {
    let effects: Vec<usize> = (0..case.problem.candidates.len()).collect();
    let own = &case.problem.candidates[effects.len() - 1].parameters;
    let start = |share: f64| {
        let value = |(v, p): (&f64, &super::candidates::Free)| if p.neutral == 0.0 { share * v } else { *v };
        let law = values.iter().zip(own).map(|pair| value(pair).clamp(pair.1.lower, pair.1.upper));
        case.base.theta().iter().copied().chain(law).collect::<Vec<f64>>()
    };
    case.problem.fit(&effects, &STARTS.map(start))
}

fn told(case: &Case, fit: &Fit, form: &Form, name: &str, found: &Diagnosis) -> Result<LearnedLaw, CompareError> {
    let held_out = HeldOut::new(case)?;
    let mut values = parameter_values(case, fit, false);
    let own = values.split_off(values.len() - form.numbers.len());
    let line = values.first().map(|line| LearnedLine {
        value_mm: line.value,
        interval_mm: line.lo.zip(line.hi).map(|(lo, hi)| [lo, hi]),
        training_mm: case.error_mm(&case.prediction(&case.base)),
        heldout_mm: held_out.pressure_mm(&case.base),
    });
    Ok(LearnedLaw {
        name: name.into(),
        words: form.words.into(),
        formula: printed(&form.moment_of(case.scenario), &own),
        parameters: own,
        line,
        before_mm: found.base.systematic_mm,
        heldout_before_mm: found.base.heldout_mm,
        after_mm: case.error_mm(&case.prediction(fit)),
        heldout_after_mm: held_out.pressure_mm(fit),
        heldout_run_after_mm: held_out.run_mm(fit),
        bending_nm2: fit.theta()[..case.problem.bendings].to_vec(),
        usual: form.usual.words.into(),
        check: form.usual.check.into(),
        tried: Vec::new(),
        toml: form.toml(name, case.scenario),
    })
}

/// A formula with numbers for its letters.
fn printed(moment: &str, values: &[ParameterValue]) -> String {
    let numbers: Vec<String> = values.iter().map(with_interval).collect();
    format!("M = {moment}; {}", numbers.join(", "))
}
