//! What a judge works on: the measured bends of all data, and what a hypothesis predicts of them.

use super::blocks::fitted_scenarios;
use super::case::Case;
use super::decide::Decision;
use super::judged::Kind;
use super::priors;
use super::problem::{Block, Fit, with};
use crate::error::CompareError;
use crate::moment::{
    FORM, Factor, Prior, Robot, Shape, View, Weighed, as_seen, bent, compliances, doublings, field_numbers, missing,
    predicted, shape, weigh,
};
use crate::policy;
use crate::stats::f_tail;
use models::Scenario;
use models::effects::Stage;
use nalgebra::{DMatrix, DVector};

/// A dataset as it was reduced.
pub(super) struct Part<'c> {
    pub block: &'c Block<'c>,
    pub view: View<'c>,
    pub shape: Shape,
    pub of_hold: Vec<usize>,
}

pub(super) struct Judge<'c> {
    pub case: &'c Case<'c>,
    pub parts: Vec<Part<'c>>,
    pub measured: DVector<f64>,
    pub covariance: DMatrix<f64>,
}

/// One effect or more, its fit as a start, and its weight among all hypotheses.
pub(super) struct Hypothesis {
    pub words: String,
    pub kind: Kind,
    pub weight: f64,
    pub weighed: Weighed,
}

impl<'c> Judge<'c> {
    pub fn new(case: &'c Case<'c>) -> Result<Judge<'c>, CompareError> {
        let mut parts = Vec::new();
        for block in &case.problem.blocks {
            let view = View {
                scenario: &block.scenario,
                dataset: &block.dataset,
                direct: block.direct,
                target_m: &block.target_m,
                whitener: &block.whitener,
            };
            let of_hold = match case.problem.bendings {
                0 => vec![0; block.bending_of.len()],
                _ => block.bending_of.clone(),
            };
            parts.push(Part { block, view, shape: shape(&view)?, of_hold });
        }
        let count = parts.iter().map(|p| p.shape.numbers.len()).sum();
        let (mut measured, mut covariance) = (DVector::zeros(count), DMatrix::zeros(count, count));
        let mut from = 0;
        for part in &parts {
            let own = part.shape.numbers.len();
            measured.rows_mut(from, own).copy_from_slice(&part.shape.numbers);
            covariance.view_mut((from, from), (own, own)).copy_from(&part.shape.covariance);
            for (k, sd) in policy::CAMERA_AS_TOLD.iter().enumerate().take(part.shape.shared.len()) {
                let at = from + own - part.shape.shared.len() + k;
                covariance[(at, at)] += sd * sd;
            }
            from += own;
        }
        Ok(Judge { case, parts, measured, covariance })
    }

    /// Numbers that were measured, less the bending stiffnesses.
    pub fn dof(&self) -> usize {
        self.measured.len().saturating_sub(self.case.problem.bendings).max(1)
    }

    /// p of what the shapes leave: the least of all data, corrected for their number.
    pub fn p_of_shapes(&self) -> f64 {
        let dof_of_noise = self.case.sources().map(|(_, noise)| noise.pure_error_dof);
        let of = |(part, dof): (&Part, usize)| {
            let (cost, own) = part.shape.left;
            if dof == 0 { 1.0 } else { f_tail(cost / own as f64, own, dof) }
        };
        let least = self.parts.iter().zip(dof_of_noise).map(of).fold(1.0, f64::min);
        (least * self.parts.len() as f64).min(1.0)
    }

    /// Vectors of the parts under each other, one or more.
    pub fn stack(&self, each: impl Fn(&Part<'c>) -> Option<Vec<DVector<f64>>>) -> Option<Vec<DVector<f64>>> {
        let all: Vec<Vec<DVector<f64>>> = self.parts.iter().map(each).collect::<Option<_>>()?;
        let rows = |k: usize| all.iter().flat_map(move |of_part| of_part[k].iter().copied());
        let count = all.first().map_or(0, Vec::len);
        Some((0..count).map(|k| DVector::from_iterator(self.measured.len(), rows(k))).collect())
    }

    pub fn scenarios(&self, part: &Part, effects: &[usize], theta: &[f64]) -> Vec<Scenario> {
        fitted_scenarios(&self.case.problem, part.block, effects, theta)
    }

    pub fn predict(&self, effects: &[usize], theta: &[f64]) -> Option<DVector<f64>> {
        let seen_otherwise =
            effects[self.case.always.len()..].iter().any(|e| self.case.candidate(*e).stage == Stage::Camera);
        let mut all = self.stack(|part| {
            let scenarios = self.scenarios(part, effects, theta);
            let robot = Robot { scenarios: &scenarios, of_hold: &part.of_hold };
            let bends = predicted(&part.view, &part.shape, &robot).ok()?;
            if !seen_otherwise {
                return Some(vec![bends]);
            }
            let values = &theta[self.case.problem.bendings..];
            let is_camera = |stage: Stage| stage == Stage::Camera;
            let seen = with(&part.block.scenario, self.case.problem.candidates, effects, values, &is_camera);
            Some(vec![bends + as_seen(&part.view, &part.shape, &seen)])
        })?;
        all.pop()
    }

    /// Priors of a hypothesis' parameters about the signs of a start, and where its values begin.
    pub fn priors(&self, effects: &[usize], start: &[f64]) -> Vec<Option<(Prior, f64)>> {
        let Case { problem, scenario, .. } = self.case;
        let mut all: Vec<Option<(Prior, f64)>> = (0..problem.bendings)
            .map(|_| Some((priors::bending_prior(problem.known_bending, scenario), 0.0)))
            .collect();
        let free = effects.iter().flat_map(|e| &self.case.candidate(*e).parameters);
        all.extend(
            free.zip(&start[problem.bendings..])
                .map(|(p, value)| p.is_free().then(|| priors::parameter_prior(p, *value))),
        );
        all
    }

    pub fn weigh_effects(&self, effects: &[usize], start: &[f64]) -> Option<Weighed> {
        let priors = self.priors(effects, start);
        let free: Vec<usize> = (0..priors.len()).filter(|k| priors[*k].is_some()).collect();
        let whole = |values: &[f64]| {
            let mut theta = start.to_vec();
            for (k, value) in free.iter().zip(values) {
                theta[*k] = value + priors[*k].map_or(0.0, |(_, offset)| offset);
            }
            theta
        };
        let own: Vec<Prior> = priors.iter().flatten().map(|(prior, _)| *prior).collect();
        let begin: Vec<f64> = free.iter().map(|k| start[*k] - priors[*k].map_or(0.0, |(_, offset)| offset)).collect();
        let predict = |values: &[f64]| self.predict(effects, &whole(values));
        let covariance = |values: &[f64]| self.with_form(effects, &whole(values));
        let mut weighed = weigh(&self.measured, &own, &begin, &predict, &covariance)?;
        weighed.values = whole(&weighed.values);
        Some(weighed)
    }

    /// Covariance with what the form of the added laws leaves open.
    fn with_form(&self, effects: &[usize], theta: &[f64]) -> Option<DMatrix<f64>> {
        let mut covariance = self.covariance.clone();
        let own = self.case.always.len();
        for k in own..effects.len() {
            if self.case.candidate(effects[k]).stage == Stage::Camera {
                continue;
            }
            for column in self.law(effects, theta, k, &FORM)? {
                covariance += &column * column.transpose() * policy::FORM_WIDTH.powi(2);
            }
        }
        Some(covariance)
    }

    /// What an effect's moment times some factors does to the measured numbers.
    fn law(&self, effects: &[usize], theta: &[f64], which: usize, factors: &[Factor]) -> Option<Vec<DVector<f64>>> {
        let bendings = self.case.problem.bendings;
        let counts: Vec<usize> = effects.iter().map(|e| self.case.candidate(*e).parameters.len()).collect();
        let from = bendings + counts[..which].iter().sum::<usize>();
        let (mut others, mut values) = (effects.to_vec(), theta.to_vec());
        others.remove(which);
        values.drain(from..from + counts[which]);
        self.stack(|part| {
            let [with, without] =
                [(effects, theta), (&others[..], &values[..])].map(|(e, t)| self.scenarios(part, e, t));
            let with = Robot { scenarios: &with, of_hold: &part.of_hold };
            let without = Robot { scenarios: &without, of_hold: &part.of_hold };
            part.response(&with, &without, factors)
        })
    }

    pub fn singles(&self, decision: &Decision) -> Vec<Hypothesis> {
        let count = decision.singles.len().max(1) as f64;
        let weigh = |fit: &Fit| {
            let weighed = self.weigh_effects(&fit.effects, fit.theta())?;
            let words = self.words(&fit.effects);
            Some(Hypothesis { words, kind: Kind::One, weight: policy::PRIOR_ONE / count, weighed })
        };
        decision.singles.iter().filter_map(weigh).collect()
    }

    fn words(&self, effects: &[usize]) -> String {
        let names = effects[self.case.always.len()..].iter().map(|e| self.case.candidate(*e).name.as_str());
        names.collect::<Vec<_>>().join(" + ")
    }

    /// Pairs of the best single effects, and of the best with every other.
    pub fn pairs(&self, singles: &[Hypothesis]) -> Vec<Hypothesis> {
        let mut best: Vec<&Hypothesis> = singles.iter().collect();
        best.sort_by(|a, b| a.weighed.minus_two_ln.total_cmp(&b.weighed.minus_two_ln));
        let all = (best.len() * best.len().saturating_sub(1) / 2).max(1) as f64;
        let tried = (0..best.len()).flat_map(|i| (i + 1..best.len()).map(move |j| (i, j)));
        let tried = tried.filter(|(i, j)| *i == 0 || *j < policy::PAIRED);
        tried.filter_map(|(i, j)| self.pair(best[i], best[j], policy::PRIOR_TWO / all)).collect()
    }

    /// Two effects, from what each needs alone.
    fn pair(&self, a: &Hypothesis, b: &Hypothesis, weight: f64) -> Option<Hypothesis> {
        let Case { problem, always, .. } = self.case;
        let effect =
            |h: &Hypothesis| (always.len()..problem.candidates.len()).find(|e| self.case.candidate(*e).name == h.words);
        let effects: Vec<usize> = always.iter().copied().chain([effect(a)?, effect(b)?]).collect();
        let before = problem.bendings + always.iter().map(|e| self.case.candidate(*e).parameters.len()).sum::<usize>();
        let start = [&a.weighed.values[..], &b.weighed.values[before..]].concat();
        let weighed = self.weigh_effects(&effects, &start)?;
        Some(Hypothesis { words: self.words(&effects), kind: Kind::Two, weight, weighed })
    }

    pub fn nothing(&self) -> Option<Hypothesis> {
        let base = &self.case.base;
        let weighed = self.weigh_effects(&base.effects, base.theta())?;
        Some(Hypothesis { words: "nothing".into(), kind: Kind::Nothing, weight: policy::PRIOR_NOTHING, weighed })
    }
}

impl Part<'_> {
    /// Change of the numbers by the moment that `with` has and `without` has not, times factors along bend and pressure.
    pub fn response(&self, with: &Robot, without: &Robot, factors: &[Factor]) -> Option<Vec<DVector<f64>>> {
        let bends = bent(&self.view, &self.shape, with).ok()?;
        let gives = compliances(&self.view, &self.shape, with).ok()?;
        let moments = missing(&self.view, &self.shape, without, &bends).ok()?;
        let holds = &self.view.dataset.holds;
        let highest = holds.iter().map(|h| h.p_act_pa).fold(1.0, f64::max);
        let most = bends.iter().flatten().copied().fold(1e-3, f64::max);
        let change = |m: usize, place: usize, factor: &Factor| {
            let p = holds[self.shape.division.moments[m].hold].p_act_pa;
            let factor = factor(doublings(bends[m][place] / most), doublings(p / highest));
            let change = gives[m][place] * moments[m][place] * factor;
            if change.is_finite() && p > 0.0 { change } else { 0.0 }
        };
        let field = |factor: &Factor| -> Vec<Vec<f64>> {
            (0..bends.len()).map(|m| (0..bends[m].len()).map(|place| change(m, place, factor)).collect()).collect()
        };
        Some(factors.iter().map(|factor| field_numbers(&self.shape, &field(factor))).collect())
    }
}
