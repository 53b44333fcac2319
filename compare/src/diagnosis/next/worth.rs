//! What an answer changes in millimetres: in the data at hand, and in the protocol of the experiment list where it changes most.

use super::Expected;
use super::experiments::plans;
use crate::diagnosis::case::DiagnosisCase;
use crate::diagnosis::problem::Fit;
use crate::diagnosis::result::Worth;
use crate::fit::numbers::{largest, squared_distance};

/// Root-mean-square distance over all marker coordinates between the calibrated base and a fit.
pub(crate) fn worth(case: &DiagnosisCase, fit: &Fit) -> Worth {
    let first = case.first();
    let plans = plans(&first.scenario, &first.as_set(), first.direct, (first.direct, Vec::new()));
    let elsewhere = plans.into_iter().filter_map(|plan| {
        let expected = Expected::of(case, Some(&plan), fit).ok()?;
        let base = super::extended(&case.base, case.problem.bendings, expected.added);
        let planned = &expected.problem.blocks[case.problem.blocks.len()..];
        let apart = planned.iter().map(|block| {
            let predicted = expected.problem.predict(block, &block.holds, &case.base.effects, &base)?;
            Some(squares(&predicted, &block.target_m))
        });
        let apart: Vec<[f64; 2]> = apart.collect::<Option<_>>()?;
        Some((root_mm(&apart), plan.sentence))
    });
    let most = largest(elsewhere.filter(|(mm, _)| mm.is_finite()), |(mm, _)| *mm);
    let here_mm = root_mm(&[squares(&case.prediction(&case.base), &case.prediction(fit))]);
    Worth { here_mm, elsewhere_mm: most.as_ref().map(|(mm, _)| *mm), elsewhere: most.map(|(_, words)| words) }
}

fn squares(a: &[f64], b: &[f64]) -> [f64; 2] {
    [squared_distance(a, b), a.len() as f64]
}

fn root_mm(parts: &[[f64; 2]]) -> f64 {
    let [sum, count] = parts.iter().fold([0.0, 0.0], |[s, n], [a, b]| [s + a, n + b]);
    1e3 * (sum / count).sqrt()
}
