//! A slip of a pressure column, asked of the robot's own model before any verdict.
//!
//! ```text
//! C = S + q ln n + Σ [(ln u / ln 3)²] + Σ [(ln(B/B₀) / ln 2)²]
//! ```
//!
//! | symbol | meaning |
//! |---|---|
//! | S | whitened sum of squares of the base refitted to the data with the slip undone, or of an effect in the data as they are |
//! | q, n, u | parameters added, values fitted, size over the typical one, as in `order`; a slip is exact and has none |
//! | B, B₀, s | fitted and given stiffness; a factor of two is one standard deviation |
//!
//! A slip is reported where its C is clearly below the C of the base and of every effect and pair, and where it leaves less than half of
//! their error, or nothing that matters. What the numbers alone look like needs to be as good only; a base that fits with its own
//! stiffness is asked about nothing else. What the numbers alone prove, of absolute or exchanged columns, no model is asked about.
//! Where the scenario's own model sees no slip, the same is asked of the robot with all mechanisms of the shipped one and with none.

use crate::diagnosis::case::{DiagnosisCase, catalogue};
use crate::diagnosis::decide::decide;
use crate::diagnosis::options::{Options, PRESSURES_ARE_RIGHT};
use crate::diagnosis::order;
use crate::diagnosis::other_design::designs;
use crate::diagnosis::problem::Fit;
use crate::diagnosis::result::words::change;
use crate::diagnosis::singles::fit_all;
use crate::diagnosis::source::DiagnosisSource;
use crate::error::CompareError;
use crate::evidence::Evidence;
use crate::fit::numbers::{least, mean, sort_by};
use crate::policy;
use crate::slips::pressure::{BestEffect, PressureSlip, PressureSlipFound, by_numbers, pressure_words};
use data::Dataset;
use models::Scenario;

#[derive(Debug, Clone, Copy, PartialEq)]
struct Weighed {
    criterion: f64,
    left_mm: f64,
    /// Every fitted stiffness may be the given one.
    has_its_stiffness: bool,
}

pub(crate) struct PressureCheck<'p> {
    pub sources: &'p [DiagnosisSource],
    pub options: &'p Options,
}

struct Undone {
    /// Source whose table was corrected, as an index.
    of: usize,
    slip: PressureSlip,
    weighed: Weighed,
    /// The numbers alone look like it.
    in_numbers: bool,
}

impl PressureCheck<'_> {
    pub(crate) fn found(
        &self,
        case: &DiagnosisCase,
        rivals: impl FnOnce() -> Result<Vec<Fit>, CompareError>,
    ) -> Result<Option<PressureSlipFound>, CompareError> {
        if self.options.excludes(PRESSURES_ARE_RIGHT) {
            return Ok(None);
        }
        if let Some(proved) = self.proved(case) {
            return Ok(Some(proved));
        }
        let own = weighed(case, &case.base);
        let tolerance_mm = 1e3 * case.tolerance_m;
        let fits = own.left_mm <= tolerance_mm && own.has_its_stiffness;
        let all = self.undone_slips(fits);
        let Some(best) = all.first().filter(|best| best.beats(&own, tolerance_mm)) else { return Ok(None) };
        let rivals: Vec<(Weighed, Fit)> = rivals()?.into_iter().map(|fit| (weighed(case, &fit), fit)).collect();
        if !rivals.iter().all(|(rival, _)| best.beats(rival, tolerance_mm)) {
            return Ok(None);
        }
        let nearest = least(&rivals, |(rival, _)| rival.left_mm);
        let best_effect = nearest.map(|(rival, fit)| BestEffect { effects: case.names(fit), left_mm: rival.left_mm });
        Ok(Some(self.told(&all, Some(own.left_mm), best_effect)))
    }

    /// Whether a slip is asked of other designs too: numbers alone look like one, or the base leaves
    /// a quarter of the movement.
    pub(crate) fn may_slip_in_another_design(&self, case: &DiagnosisCase) -> bool {
        let looks = |DiagnosisSource { scenario, dataset, .. }: &DiagnosisSource| {
            PressureSlip::all(dataset, scenario.p_body_pa).iter().any(|slip| slip.is_in_numbers(dataset, scenario))
        };
        let left_mm = case.error_in_all_mm(&case.base);
        let is_far = || !policy::is_mostly_gone(left_mm, 1e3 * moved_m(&self.sources[0].dataset));
        !self.options.excludes(PRESSURES_ARE_RIGHT) && (is_far() || self.sources.iter().any(looks))
    }

    /// A slip that the numbers alone prove, whatever a model leaves.
    fn proved(&self, case: &DiagnosisCase) -> Option<PressureSlipFound> {
        let mut seen = self.sources.iter().map(|source| by_numbers(&source.dataset)).enumerate();
        let (of, slip) = seen.find_map(|(of, seen)| Some((of, seen?)))?;
        let before_mm = Some(case.error_in_all_mm(&case.base));
        // Bar under a name of kPa looks exchanged too, and the model decides which.
        let all = self.undone_slips(false);
        let moved_mm = 1e3 * moved_m(&self.sources[of].dataset);
        let proved = self.undone(of, &slip);
        let is_nearer = |left_mm: f64| proved.is_none_or(|proved| policy::is_far_less(left_mm, proved.left_mm));
        let explains =
            |best: &&Undone| policy::is_mostly_gone(best.weighed.left_mm, moved_mm) && is_nearer(best.weighed.left_mm);
        if all.first().filter(explains).is_some() {
            return Some(self.told(&all, before_mm, None));
        }
        Some(match proved {
            Some(weighed) => self.told(&[Undone { of, slip, weighed, in_numbers: true }], before_mm, None),
            None => PressureSlipFound {
                dataset: self.sources[of].dataset.name.clone(),
                words: pressure_words(&self.sources[of].dataset).concat(),
                before_mm,
                after_mm: None,
                best_effect: None,
            },
        })
    }

    /// What to say of data with which the base has no equilibrium: the slip without which it has one, else the error.
    pub(crate) fn refusal(&self, error: CompareError) -> CompareError {
        match (&error, self.instead()) {
            (CompareError::Fit { .. } | CompareError::Unsolved(_), Some(found)) => {
                CompareError::refused(found.words, "mend the column and run the same again")
            }
            _ => error,
        }
    }

    fn instead(&self) -> Option<PressureSlipFound> {
        let all = self.undone_slips(false);
        let best = all.first()?;
        let moved_mm = 1e3 * moved_m(&self.sources[best.of].dataset);
        policy::is_mostly_gone(best.weighed.left_mm, moved_mm).then(|| self.told(&all, None, None))
    }

    /// All slips, the best first; `in_numbers`: those that the numbers alone look like.
    fn undone_slips(&self, in_numbers: bool) -> Vec<Undone> {
        let of_source = |(of, source): (usize, &DiagnosisSource)| {
            let all = PressureSlip::all(&source.dataset, source.scenario.p_body_pa);
            all.into_iter().map(move |slip| (of, slip))
        };
        let all = self.sources.iter().enumerate().flat_map(of_source);
        let undone = |(of, slip): (usize, PressureSlip)| {
            let source = &self.sources[of];
            let seen = slip.is_in_numbers(&source.dataset, &source.scenario);
            // A body's slip shows in numbers; readings of a gauge are the actuator's own.
            let possible = if slip.is_of_body() { seen } else { source.gauge.is_none() && (seen || !in_numbers) };
            let weighed = possible.then(|| self.undone(of, &slip))??;
            Some(Undone { of, slip, weighed, in_numbers: seen })
        };
        let mut undone: Vec<Undone> = all.filter_map(undone).collect();
        sort_by(&mut undone, |slip| slip.weighed.criterion);
        undone
    }

    fn undone(&self, of: usize, slip: &PressureSlip) -> Option<Weighed> {
        let mut sources = self.sources.to_vec();
        sources[of].dataset = slip.undone(&sources[of].dataset);
        let (candidates, own) = catalogue(&sources, self.options);
        let case = DiagnosisCase::new(&sources, (&candidates[..own], own), self.options).ok()?;
        Some(weighed(&case, &case.base))
    }

    fn told(&self, all: &[Undone], before_mm: Option<f64>, best_effect: Option<BestEffect>) -> PressureSlipFound {
        let found = &all[0];
        let after_mm = found.weighed.left_mm;
        let brings = match before_mm {
            Some(before_mm) => format!("the error beyond noise goes from {before_mm:.1} to {after_mm:.2} mm"),
            None => format!("{after_mm:.2} mm are left, and as they are written the robot has no equilibrium"),
        };
        let effect = best_effect.as_ref().map_or(String::new(), |BestEffect { effects, left_mm }| {
            format!(" (the best of the catalogue, {}, leaves {left_mm:.2} mm)", effects.join(" + "))
        });
        let is_alike = |other: &&Undone| policy::is_as_good(other.weighed.criterion, found.weighed.criterion);
        let alike = all[1..].iter().filter(is_alike).map(|other| {
            let [looks, _, help] = other.slip.words();
            format!(". As good with these data: {looks}; {help}")
        });
        let ([looks, with, help], alike) = (found.slip.words(), alike.collect::<String>());
        let dataset = self.sources[found.of].dataset.name.clone();
        let words = format!("{dataset}: {looks}: with {with} {brings}{effect}. Look at it first: {help}{alike}");
        PressureSlipFound { dataset, words, before_mm, after_mm: Some(after_mm), best_effect }
    }
}

/// The slip of a pressure column with which the robot's own model explains data clearly better than without it, or than any
/// effect of the catalogue does.
///
/// # Errors
/// Scenario and data that do not fit together; pressures at which the robot has no equilibrium, with the slip that would explain it.
pub fn pressure_slip(
    scenario: &Scenario,
    evidence: &Evidence,
    options: &Options,
) -> Result<Option<PressureSlipFound>, CompareError> {
    let evidence = std::slice::from_ref(evidence);
    match slip_of(scenario, evidence, options)? {
        (None, true) => slip_of_another_design(scenario, evidence, options),
        (found, _) => Ok(found),
    }
}

/// The same of the robot with all mechanisms of the shipped one of its kind, or with none.
pub(crate) fn slip_of_another_design(
    scenario: &Scenario,
    evidence: &[Evidence],
    options: &Options,
) -> Result<Option<PressureSlipFound>, CompareError> {
    // A design without equilibrium sees nothing.
    let found = designs(scenario, options)?.into_iter().filter_map(|(other, switched)| {
        let found = slip_of(&other, evidence, options).ok()?.0?;
        let words = format!("{} (seen by the same robot {}).", found.words.trim_end_matches('.'), change(&switched));
        Some(PressureSlipFound { words, ..found })
    });
    Ok(least(found, |found| found.after_mm.unwrap_or(f64::MAX)))
}

/// The slip that one design sees, and whether other designs are to be asked.
fn slip_of(
    scenario: &Scenario,
    evidence: &[Evidence],
    options: &Options,
) -> Result<(Option<PressureSlipFound>, bool), CompareError> {
    let (sources, _) = DiagnosisSource::all(scenario, evidence)?;
    let (candidates, own) = catalogue(&sources, options);
    let pressures = PressureCheck { sources: &sources, options };
    let case = DiagnosisCase::new(&sources, (&candidates, own), options).map_err(|error| pressures.refusal(error))?;
    let rivals = || {
        let mut wider = Vec::new();
        let mut case = DiagnosisCase::new(&sources, (&candidates, own), options)?;
        let singles = fit_all(&mut case, &mut wider, &mut |_, _| ());
        Ok(decide(&case, singles, options, &mut |_, _| ())?.rivals())
    };
    Ok((pressures.found(&case, rivals)?, pressures.may_slip_in_another_design(&case)))
}

impl Undone {
    /// Whether it is clearly better than something else. It must pay: in mm, or by a stiffness that equals the given one again. What
    /// the numbers alone look like needs no more than to be as good.
    fn beats(&self, rival: &Weighed, tolerance_mm: f64) -> bool {
        let (criterion, left_mm) = (self.weighed.criterion, self.weighed.left_mm);
        let is_as_near = left_mm <= rival.left_mm.max(tolerance_mm);
        let pays = policy::is_far_less(left_mm, rival.left_mm)
            || is_as_near && (left_mm <= tolerance_mm || self.weighed.has_its_stiffness && !rival.has_its_stiffness);
        match self.in_numbers {
            true => is_as_near && policy::is_as_good(criterion, rival.criterion),
            false => pays && policy::is_clearly_better(criterion, rival.criterion),
        }
    }
}

fn weighed(case: &DiagnosisCase, fit: &Fit) -> Weighed {
    let bendings = case.bendings(fit);
    let told = case.first().scenario.bending_stiffness;
    Weighed {
        criterion: order::criterion(case, fit, 1.0) + order::odd_bending(case, fit),
        left_mm: case.error_in_all_mm(fit),
        has_its_stiffness: bendings.iter().all(|b| policy::is_same_stiffness(*b, told)),
    }
}

fn moved_m(dataset: &Dataset) -> f64 {
    let at = dataset.mean_over_runs();
    let hold = at.len() / dataset.holds.len();
    mean((0..at.len()).map(|i| (at[i] - at[i % hold]).powi(2))).sqrt()
}
