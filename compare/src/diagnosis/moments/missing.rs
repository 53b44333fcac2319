//! The missing moment of a diagnosis: its points from all data, and the answers as curves through them.

use crate::diagnosis::case::DiagnosisCase;
use crate::diagnosis::decide::Decision;
use crate::diagnosis::problem::{Block, Fit};
use crate::diagnosis::result::Diagnosis;
use crate::diagnosis::result::answers::{EffectAnswer, Standing};
use crate::diagnosis::source::nearest;
use crate::error::CompareError;
use crate::fit::least_squares::{products, square};
use crate::moment::{
    MeasuredShape, MissingMoment, MomentCurve, MomentPoint, Moments, PressurePath, RobotScenarios, Shape, View, band,
    curve, degrees, missing, moments, sentences, shape, shape_sentences,
};
use models::Scenario;
use models::effects::Stage;

const MOST_CURVES: usize = 4;
const OTHERS: usize = 1;
const PRESSURES: usize = 24;
/// Least pressure of a curve, over the highest.
const LEAST: f64 = 0.15;
const STIFFNESS: &str = "stiffness alone";
/// Curves begin at this share of the least bend that was measured.
const NEAR: f64 = 0.7;
/// Half-width of a 95 % band in standard deviations.
const BAND: f64 = 1.96;

/// The moment missing in all data, relative to the scenario as given: with its own bending stiffness, or the separately measured one.
/// A fitted stiffness would absorb part of the missing moment; it is a curve among the others.
pub(crate) fn missing_moment(
    case: &DiagnosisCase,
    seen: &[SeenMoments],
    decision: &Decision,
    found: &Diagnosis,
) -> Result<MissingMoment, CompareError> {
    let (mut shapes, mut points) = (Vec::new(), Vec::new());
    for (block, seen) in case.problem.blocks.iter().zip(seen) {
        shapes.push(MeasuredShape::of(&block.source.dataset, &seen.shape));
        points.extend(seen.moments.of_holds.iter().chain(&seen.moments.points).cloned());
    }
    let curves = curves(case, decision, found, &points)?;
    let mut told = sentences(&points);
    told.extend(shape_sentences(&shapes, case.noise().is_known()));
    Ok(MissingMoment { shapes, sentences: told, points, curves, bending_nm2: own_bending(case) })
}

pub(crate) struct SeenMoments {
    base: Vec<Scenario>,
    of_hold: Vec<usize>,
    pub shape: Shape,
    pub moments: Moments,
}

impl SeenMoments {
    fn of(case: &DiagnosisCase, block: &Block) -> Result<SeenMoments, CompareError> {
        let base = case.problem.scenarios(block, &case.base.effects, &reference(case));
        let shape = shape(&view(block, &base[0]))?;
        let of_hold = block.bending_of.clone();
        let moments = moments(&view(block, &base[0]), &shape, &RobotScenarios { scenarios: &base, of_hold: &of_hold })?;
        Ok(SeenMoments { base, of_hold, shape, moments })
    }

    /// What another robot misses at the bends that were measured, moment after moment and place after place \[N·m\]: the base,
    /// changed.
    pub(crate) fn missing(
        &self,
        block: &Block,
        change: &dyn Fn(&Scenario) -> Scenario,
    ) -> Result<Vec<Vec<f64>>, CompareError> {
        let other: Vec<Scenario> = self.base.iter().map(change).collect();
        let robot = RobotScenarios { scenarios: &other, of_hold: &self.of_hold };
        missing(&view(block, &other[0]), &self.shape, &robot, &self.shape.bends())
    }

    pub(crate) fn robot(&self) -> &Scenario {
        &self.base[0]
    }
}

/// Shapes and missing moments of all data.
///
/// # Errors
/// Data of which no shape comes near.
pub(crate) fn seen(case: &DiagnosisCase) -> Result<Vec<SeenMoments>, CompareError> {
    case.problem.blocks.iter().map(|block| SeenMoments::of(case, block)).collect()
}

fn view<'a>(block: &'a Block, scenario: &'a Scenario) -> View<'a> {
    View {
        scenario,
        dataset: &block.source.dataset,
        direct: block.source.direct,
        target_m: &block.target_m,
        whitener: &block.whitener,
    }
}

/// Parameters of the base with the separately measured bending stiffness, or the scenario's.
fn reference(case: &DiagnosisCase) -> Vec<f64> {
    let mut theta = case.base.theta().to_vec();
    theta[..case.problem.bendings].fill(own_bending(case));
    theta
}

fn own_bending(case: &DiagnosisCase) -> f64 {
    case.problem.known_bending.map_or(case.first().scenario.bending_stiffness, |[value, _]| value)
}

fn curves(
    case: &DiagnosisCase,
    decision: &Decision,
    found: &Diagnosis,
    points: &[MomentPoint],
) -> Result<Vec<MomentCurve>, CompareError> {
    let helps = |a: &EffectAnswer| !found.is_quiet() && a.helps();
    let mut kept: Vec<EffectAnswer> = found.answers().into_iter().filter(helps).collect();
    let first = kept.iter().filter(|a| a.standing != Standing::Other).count();
    kept.truncate((first + OTHERS).min(MOST_CURVES));
    let told = kept.iter().map(|a| (a.name(), a.standing != Standing::Other, fit_of(case, decision, &a.name())));
    let stiffness = (case.problem.bendings > 0).then_some((STIFFNESS.into(), first == 0, Some(&case.base)));
    let mut curves = Vec::new();
    for (answer, is_told, fit) in told.chain(stiffness) {
        if let Some(fit) = fit.filter(|fit| has_moment(case, fit)) {
            curves.extend(curves_of(case, fit, (&answer, is_told), points)?);
        }
    }
    Ok(curves)
}

/// The curves of one fit: ways up and down at every body pressure.
pub(crate) fn curves_of(
    case: &DiagnosisCase,
    fit: &Fit,
    (answer, is_told): (&str, bool),
    points: &[MomentPoint],
) -> Result<Vec<MomentCurve>, CompareError> {
    let least_deg = points.iter().filter(|p| p.is_of_hold()).map(|p| p.bend_deg).fold(f64::INFINITY, f64::min);
    let of_path = |(level, path): &(usize, PressurePath)| {
        let mut points = drawn(case, fit, *level, path)?;
        points.retain(|[_, bend_deg, ..]| *bend_deg > NEAR * least_deg);
        let (p_body_kpa, is_unloading) = (1e-3 * path.p_body_pa, path.from_pa.is_some());
        Ok(MomentCurve { answer: answer.into(), is_told, p_body_kpa, is_unloading, points })
    };
    paths(case, points).iter().map(of_path).collect()
}

/// Whether a fit changes a moment; effects of the camera change none.
fn has_moment(case: &DiagnosisCase, fit: &Fit) -> bool {
    let added = case.added(fit);
    added.is_empty() || added.iter().any(|e| case.candidate(*e).stage != Stage::Camera)
}

fn fit_of<'a>(case: &DiagnosisCase, decision: &'a Decision, name: &str) -> Option<&'a Fit> {
    let stated = decision.singles.fits.iter().chain(&decision.pairs.fits);
    let mut all = stated.chain(&decision.as_close).chain(&decision.last);
    all.find(|fit| case.names(fit).join(" + ") == name)
}

/// Ways up, and down where points lie there, at every body pressure, with the number of its stiffness.
fn paths(case: &DiagnosisCase, points: &[MomentPoint]) -> Vec<(usize, PressurePath)> {
    let first = case.first().dataset.holds.first();
    let wait_s = first.and_then(|hold| hold.t_s.last().copied()).unwrap_or(0.0).max(0.0);
    let mut paths = Vec::new();
    for (level, p_body_pa) in case.body_pa.iter().enumerate() {
        let own = |p: &&MomentPoint| p.is_of_hold() && nearest(&case.body_pa, 1e3 * p.p_body_kpa) == level;
        let highest = points.iter().filter(own).map(|p| 1e3 * p.p_act_kpa).fold(0.0, f64::max);
        if highest <= 0.0 {
            continue;
        }
        let share = |i: usize| LEAST + (1.0 - LEAST) * i as f64 / (PRESSURES - 1) as f64;
        let p_act_pa: Vec<f64> = (0..PRESSURES).map(|i| highest * share(i)).collect();
        let up = PressurePath { p_body_pa: *p_body_pa, p_act_pa, from_pa: None, wait_s };
        if points.iter().filter(own).any(|p| p.phase == "unload" && p.p_act_kpa > 0.0) {
            paths.push((level, PressurePath { from_pa: Some(highest), ..up.clone() }));
        }
        paths.push((level, up));
    }
    paths
}

/// Pressure \[kPa\], bend \[°\], moment and half-width of its band \[N·m\].
fn drawn(case: &DiagnosisCase, fit: &Fit, level: usize, path: &PressurePath) -> Result<Vec<[f64; 4]>, CompareError> {
    let block = &case.problem.blocks[0];
    let at = |fit: &Fit, theta: &[f64]| -> Scenario {
        let all = case.problem.scenarios(block, &fit.effects, theta);
        all[level.min(all.len() - 1)].clone()
    };
    let base = at(&case.base, &reference(case));
    let middle = curve(&base, &at(fit, fit.theta()), path)?;
    let shifted = shifts(case, fit).into_iter().map(|theta| curve(&base, &at(fit, &theta), path));
    let half = band(&middle, &shifted.collect::<Result<Vec<_>, _>>()?);
    let per = degrees(block.source.scenario.length_m);
    let point = |((p, [kappa, moment]), half): ((&f64, &[f64; 2]), f64)| [1e-3 * p, per * kappa, *moment, BAND * half];
    let all = path.p_act_pa.iter().zip(&middle).zip(half).map(point);
    Ok(all.filter(|point| point.iter().all(|v| v.is_finite())).collect())
}

/// Values one standard deviation away in directions that do not depend on each other.
fn shifts(case: &DiagnosisCase, fit: &Fit) -> Vec<Vec<f64>> {
    let Some(jacobian) = case.problem.jacobian_allowing(fit) else { return Vec::new() };
    let ranges = case.problem.ranges(&fit.effects);
    let free: Vec<usize> = (0..ranges.len()).filter(|k| ranges[*k].is_free() && square(&jacobian[*k]) > 0.0).collect();
    let Some(root) = products(&jacobian, &free).cholesky().and_then(|c| c.inverse().cholesky()) else {
        return Vec::new();
    };
    let shifted = |column: nalgebra::DVectorView<f64>| {
        let mut theta = fit.theta().to_vec();
        for (k, step) in free.iter().zip(column.iter()) {
            theta[*k] = (theta[*k] + step).clamp(ranges[*k].lower, ranges[*k].upper);
        }
        theta
    };
    root.l().column_iter().map(shifted).collect()
}
