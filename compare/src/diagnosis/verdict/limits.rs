//! What data cannot show, whatever the model.

use crate::diagnosis::case::DiagnosisCase;
use crate::diagnosis::problem::FitProblem;
use crate::diagnosis::result::Undetectable;
use crate::diagnosis::source::body_pressures;
use crate::fit::basis::Basis;
use crate::fit::least_squares::square;
use crate::policy;
use crate::wording::list;
use data::{Dataset, Hold, Phase};
use models::Scenario;

pub(crate) fn limits(datasets: &[&Dataset], undetectable: &[Undetectable]) -> Vec<String> {
    let mut limits = Vec::new();
    let holds = || datasets.iter().flat_map(|dataset| &dataset.holds);
    let mut levels: Vec<f64> = holds().map(Hold::sum_act_pa).filter(|p| *p > policy::ZERO_PRESSURE_PA).collect();
    levels.sort_by(f64::total_cmp);
    levels.dedup_by(|a, b| policy::is_same_pressure(*a, *b));
    if levels.len() < 2 {
        limits.push(
            "one actuator pressure only: B takes up whatever changes the size of the bend, so effects show only in the \
             shape; measure at three pressures or more"
                .into(),
        );
    }
    if !holds().any(|h| h.phase == Phase::Unload) {
        limits.push(
            "no unloading branch: what remembers the way there (friction, plastic set, creep) looks like a stiffer or \
             weaker robot or cannot be seen; lower the pressure again in steps"
                .into(),
        );
    }
    if datasets.iter().all(|dataset| dataset.samples_per_hold < 3) {
        limits.push("fewer than three samples per hold: what drifts in time (creep, leaks) cannot be seen".into());
    }
    if body_pressures(datasets.iter().copied()).len() < 2 {
        limits.push(
            "one body pressure only: effects that grow with it cannot be separated from effects that do not".into(),
        );
    }
    let unseen: Vec<&Undetectable> = undetectable.iter().filter(|u| u.smallest_detectable.is_none()).collect();
    if datasets.iter().all(|dataset| dataset.runs.len() < 2) && unseen.len() == undetectable.len() {
        limits.push("what could have been seen is not known: one run shows no noise; add runs, or give --sigma".into());
    } else if !unseen.is_empty() {
        limits.push(format!("no size within its bounds would be seen: {}", list(unseen.iter().map(|u| &u.effect))));
    }
    limits
}

/// Effects that act on the actuator of a robot in space and are not built for strips round the body, in one sentence; none of a planar
/// robot.
pub(crate) fn not_in_space(scenario: &Scenario) -> Vec<String> {
    let catalogue = scenario.catalogue();
    let left_out = catalogue.effects().filter(|e| scenario.actuator.takes(e) && !scenario.takes(e));
    let names: Vec<&str> = left_out.map(|e| e.name).collect();
    let words = "not built for strips round the body and left out, as is the missing moment";
    if names.is_empty() { Vec::new() } else { vec![format!("{words}: {}", list(&names))] }
}

/// A warning if the markers, fitted without it, ask for another bending stiffness than the bending test found.
fn bending_test(case: &DiagnosisCase) -> Option<String> {
    let [found, sd] = case.problem.known_bending.filter(|_| case.problem.bendings > 0)?;
    let alone = FitProblem { known_bending: None, ..case.problem.clone() };
    let fit = alone.fit(&case.always, &[case.base.theta().to_vec()])?;
    let (own, others) = fit.minimum.jacobian.split_first()?;
    let (markers, weight) = (fit.theta()[0], square(&Basis::of(others).rest(own)));
    let disagree = weight > 0.0 && policy::disagree((markers - found) / (1.0 / weight + sd * sd).sqrt());
    disagree.then(|| {
        format!(
            "the bending test found B = {found:.2} ± {sd:.2} N·m², without an effect the markers ask for {markers:.2}: something \
             else resists the bend or drives it, or it was tested at another body pressure"
        )
    })
}

/// Effects of the catalogue that a separate test found and the scenario lacks.
fn tests_of_their_own(case: &DiagnosisCase) -> Vec<String> {
    let found = case.problem.known.iter().filter(|known| !case.always.contains(&known.effect));
    let told = found.filter_map(|known| {
        let effect = case.candidate(known.effect);
        let p = &effect.parameters[known.parameter];
        policy::disagree(known.lacking).then(|| {
            let [value, sd] = [known.value, known.sd].map(|v| crate::diagnosis::result::words::value(v / p.si));
            format!(
                "about.toml gives {} as measured: {} = {value} ± {sd} {}, and the scenario lacks it; whether the markers \
                 show it is a separate question",
                effect.name, p.symbol, p.unit
            )
        })
    });
    told.collect()
}

pub(crate) fn warnings(case: &DiagnosisCase) -> Vec<String> {
    let mut warnings: Vec<String> = bending_test(case).into_iter().chain(tests_of_their_own(case)).collect();
    let target = &case.problem.blocks[0].target_m;
    let axes = case.first().dataset.axes;
    let moved = |values: &[f64]| -> f64 {
        let y = values.chunks_exact(axes).flat_map(|place| &place[1..]).map(|y| y * y).sum::<f64>();
        1e3 * (y / values.len() as f64).sqrt()
    };
    let left = case.error_mm(&case.prediction(&case.base));
    if policy::does_not_fit(left, moved(target)) {
        warnings.push(format!(
            "the base does not fit at all: {left:.1} mm remain of a movement of {:.1} mm (rms); before looking for effects, \
             check actuator and dimensions in the scenario, the sign of y, marker stations and pressure units",
            moved(target)
        ));
    }
    for (group, bending) in case.base.theta()[..case.problem.bendings].iter().enumerate() {
        let nominal = case.first().scenario.bending_stiffness;
        if case.base.binding[group] {
            warnings.push(format!(
                "B = {bending:.2} N·m² is on the bound of its search: stiffness does not explain the data"
            ));
        } else if nominal > 0.0 && policy::bending_moves(nominal, *bending) {
            warnings.push(format!(
                "B had to move from {nominal:.2} to {bending:.2} N·m²: a stiffness far off its own value hides something else"
            ));
        }
    }
    warnings
}
