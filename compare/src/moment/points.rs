//! Stage 2, moment: what the terms of a model miss at the bends that were measured.
//!
//! ```text
//! M(κ; P, p_b, t, s) = moment of the wall and the gas − pull of the actuator − loads        (models::Model::hold)
//! ```
//!
//! Positive: something is missing that bends the robot further; negative: something holds it back; zero: nothing is missing.

use super::result::MomentPoint;
use super::shape::{Shape, ShapeLayout};
use super::told::degrees;
use super::view::{Pieces, View};
use crate::error::CompareError;
use crate::fit::numbers::mean;
use models::Scenario;
use nalgebra::{DMatrix, RowDVector};

/// Scenarios of a model, one per bending stiffness, and which of them holds in which hold.
#[derive(Clone, Copy)]
pub(crate) struct RobotScenarios<'a> {
    pub scenarios: &'a [Scenario],
    /// Index of the scenario that applies in each hold.
    pub of_hold: &'a [usize],
}

/// Missing moments at all places and holds of a dataset.
#[derive(Debug, Clone)]
pub(crate) struct Moments {
    /// Places of every hold, then changes within the holds.
    pub points: Vec<MomentPoint>,
    pub covariance: DMatrix<f64>,
    /// Mean over the places of every hold.
    pub of_holds: Vec<MomentPoint>,
}

/// Step of the slope by bend \[1/m\].
const STEP: f64 = 1e-4;
/// Standard deviations from which a bend is clear of none.
const CLEAR: f64 = 3.0;
/// Bend in units of the hinge's from which its step is complete.
const COMPLETE: f64 = 3.0;

/// A weighted sum over (moment, place).
type WeightedSum = Vec<(f64, usize, usize)>;

pub(crate) fn moments(view: &View, shape: &Shape, robot: &RobotScenarios) -> Result<Moments, CompareError> {
    let field = MomentField::of(view, shape, robot)?;
    let layout = ShapeLayout::of(&shape.division);
    let (mut sums, mut labels, mut wholes) = (Vec::new(), Vec::new(), Vec::new());
    let groups = shape.division.groups;
    for hold in 0..view.dataset.holds.len() {
        let places = field.usable(view, shape, &layout, hold);
        if places.is_empty() {
            continue;
        }
        let first = hold * groups;
        let own = |p: &usize| (0..groups).map(|g| (1.0 / groups as f64, first + g, *p)).collect::<WeightedSum>();
        let length = |p: usize| shape.division.places[p].length_m();
        let all: f64 = places.iter().map(|p| length(*p)).sum();
        let weight = |p: usize| length(p) / all;
        for place in &places {
            sums.push(own(place));
            labels.push((hold, Some(*place), None));
        }
        let whole = places.iter().flat_map(own).map(|(w, m, p)| (w * weight(p), m, p));
        wholes.push((whole.collect::<WeightedSum>(), (hold, None, None)));
        for group in 1..groups {
            let pair = |p: &usize| [(weight(*p), first + group, *p), (-weight(*p), first, *p)];
            sums.push(places.iter().flat_map(pair).collect());
            labels.push((hold, None, Some(group)));
        }
    }
    let per = degrees(view.scenario.length_m);
    let told = |(sum, (hold, place, since_first)): (&WeightedSum, &(usize, Option<usize>, Option<usize>))| {
        let at = &view.dataset.holds[*hold];
        let [kappa, moment_nm] = field.value(sum);
        let [kappa_sd, moment_sd_nm, correlation] = field.errors(sum, shape, &layout);
        let t_s = match since_first {
            Some(group) => shape.division.moments[hold * groups + group].t_s,
            None => mean(at.t_s.iter().copied()),
        };
        MomentPoint {
            dataset: view.dataset.name.clone(),
            hold: hold + 1,
            p_body_kpa: 1e-3 * at.p_body_pa,
            p_act_kpa: 1e-3 * at.p_act_pa,
            phase: at.phase.word(),
            place_mm: place.map(|place| shape.division.places[place].ends_mm()),
            place: *place,
            is_change: since_first.is_some(),
            t_s,
            kappa,
            bend_deg: per * kappa,
            bend_sd_deg: per * kappa_sd,
            moment_nm,
            moment_sd_nm,
            correlation,
        }
    };
    let mut gain = DMatrix::zeros(sums.len(), shape.numbers.len());
    for (i, sum) in sums.iter().enumerate() {
        gain.set_row(i, &field.gradient(sum, shape, &layout, true));
    }
    Ok(Moments {
        points: sums.iter().zip(&labels).map(told).collect(),
        covariance: &gain * &shape.covariance * gain.transpose(),
        of_holds: wholes.iter().map(|(sum, label)| told((sum, label))).collect(),
    })
}

/// Bend, missing moment and its slope by bend, moment after moment and place after place.
struct MomentField {
    kappa: Vec<Vec<f64>>,
    missing: Vec<Vec<f64>>,
    slope: Vec<Vec<f64>>,
}

impl MomentField {
    fn of(view: &View, shape: &Shape, robot: &RobotScenarios) -> Result<MomentField, CompareError> {
        let kappa = shape.bends();
        let moved =
            |by: f64| -> Vec<Vec<f64>> { kappa.iter().map(|row| row.iter().map(|k| k + by).collect()).collect() };
        let [low, missing, high] = [-STEP, 0.0, STEP].map(|by| missing(view, shape, robot, &moved(by)));
        let (low, missing, high) = (low?, missing?, high?);
        let slope = low
            .iter()
            .zip(&high)
            .map(|(low, high)| low.iter().zip(high).map(|(low, high)| (high - low) / (2.0 * STEP)).collect());
        Ok(MomentField { slope: slope.collect(), kappa, missing })
    }

    fn usable(&self, view: &View, shape: &Shape, layout: &ShapeLayout, hold: usize) -> Vec<usize> {
        let groups = shape.division.groups;
        let mut active: Vec<usize> = (0..shape.division.places.len()).collect();
        active.retain(|p| shape.division.places[*p].is_active);
        let bend = |place: usize| shape.numbers[layout.bend(hold, place)].abs();
        let sd = |place: usize| {
            let number = layout.bend(hold, place);
            shape.covariance[(number, number)].sqrt()
        };
        // A slack actuator on a straight body: the hinge of the folded wall has not set in, so the hold shows nothing.
        let complete = COMPLETE * view.scenario.hinge_curvature;
        let is_slack = |p: &usize| bend(*p) < complete + COMPLETE * sd(*p);
        if view.dataset.holds[hold].p_act_pa <= 0.0 && active.iter().any(is_slack) {
            return Vec::new();
        }
        let finite = |place: usize| {
            let mut moments = hold * groups..(hold + 1) * groups;
            moments.all(|m| self.missing[m][place].is_finite() && self.slope[m][place].is_finite())
        };
        // The pull of a nearly straight actuator has no bound: a bend that may be none has no moment.
        active.retain(|p| finite(*p) && bend(*p) > CLEAR * sd(*p));
        active
    }

    fn value(&self, sum: &WeightedSum) -> [f64; 2] {
        let of = |field: &[Vec<f64>]| sum.iter().map(|(weight, m, p)| weight * field[*m][*p]).sum();
        // The bend of a change is the change of bend.
        [of(&self.kappa), of(&self.missing)]
    }

    /// Derivative of a sum by the numbers of the shape: of moments, or of bends.
    fn gradient(&self, sum: &WeightedSum, shape: &Shape, layout: &ShapeLayout, moments: bool) -> RowDVector<f64> {
        let mut row = RowDVector::zeros(shape.numbers.len());
        for (weight, m, place) in sum {
            let at = shape.division.moments[*m];
            let weight = weight * if moments { self.slope[*m][*place] } else { 1.0 };
            row[layout.bend(at.hold, *place)] += weight;
            layout.drifts(at.hold, at.group).iter().for_each(|(k, sign)| row[*k] += weight * sign);
        }
        row
    }

    /// Standard deviations of bend and moment, and their correlation: of the covariance of the shape's numbers, shared ones too.
    fn errors(&self, sum: &WeightedSum, shape: &Shape, layout: &ShapeLayout) -> [f64; 3] {
        let [bend, moment] = [false, true].map(|moments| self.gradient(sum, shape, layout, moments));
        let covariance = |a: &RowDVector<f64>, b: &RowDVector<f64>| (a * &shape.covariance * b.transpose())[(0, 0)];
        let [bend_sd, moment_sd] = [&bend, &moment].map(|row| covariance(row, row).max(0.0).sqrt());
        let scale = bend_sd * moment_sd;
        let correlation = if scale > 0.0 { (covariance(&bend, &moment) / scale).clamp(-1.0, 1.0) } else { 0.0 };
        [bend_sd, moment_sd, correlation]
    }
}

/// Missing moment of every place at given bends, moment after moment \[N·m\].
pub(crate) fn missing(
    view: &View,
    shape: &Shape,
    robot: &RobotScenarios,
    bends: &[Vec<f64>],
) -> Result<Vec<Vec<f64>>, CompareError> {
    let steps = shape.division.steps(view.dataset);
    let places = shape.division.places.len();
    let mut out = vec![vec![f64::NAN; places]; steps.len()];
    for (group, scenario) in robot.scenarios.iter().enumerate() {
        let is_own = |m: usize| robot.of_hold[shape.division.moments[m].hold] == group;
        if !(0..steps.len()).any(is_own) {
            continue;
        }
        let pieces = Pieces::new(scenario, &shape.division);
        let curvatures: Vec<Vec<f64>> = bends.iter().map(|bends| pieces.curvatures(bends)).collect();
        let mut keep = |m: usize, at: &models::Prediction| {
            if is_own(m) {
                out[m] = pieces.mean(at.missing_moments(), places);
            }
        };
        pieces.model.hold(&steps, &curvatures, &mut pieces.model.prediction(), &mut keep)?;
    }
    Ok(out)
}
