//! What repeated runs say about camera noise and run-to-run scatter: the estimates behind [`crate::noise`].

use crate::directions::{DirectionFit, DirectionRow, ROTATIONS, SHIFTS};
use crate::error::CompareError;
use crate::fit::numbers::{differences, groups, mean};
use data::Dataset;

pub(crate) struct Within {
    /// Variance of one camera coordinate of one sample \[m²\].
    pub sigma2: f64,
    pub hold_sigma2: Vec<f64>,
    /// Degrees of freedom of the first.
    pub dof: usize,
    /// Mean square of the runs' coefficients about their session's mean.
    pub coefficient_variance: DirectionRow,
}

pub(crate) fn within_sessions(dataset: &Dataset, groups: &[Vec<usize>], fit: &DirectionFit) -> Within {
    let holds = dataset.holds.len();
    let mut within =
        Within { sigma2: 0.0, hold_sigma2: vec![0.0; holds], dof: 0, coefficient_variance: DirectionRow::default() };
    let per_marker = dataset.axes * dataset.samples_per_hold;
    let seen_in = |hold: usize| (0..dataset.markers.len()).filter(|m| dataset.is_seen(hold, *m)).count() * per_marker;
    let seen: Vec<usize> = (0..holds).map(seen_in).collect();
    let filled = &dataset.lost.filled;
    let repeated = groups.iter().filter(|g| g.len() > 1).count() as f64;
    for group in groups.iter().filter(|g| g.len() > 1) {
        let mean = mean_of(dataset, group);
        for &run in group {
            let (coefficients, rest) = fit.solve(&differences(dataset.run(run), &mean));
            for (square, part) in within.hold_sigma2.iter_mut().zip(rest.chunks(rest.len() / holds)) {
                *square += part.iter().map(|r| r * r).sum::<f64>();
            }
            for (v, c) in within.coefficient_variance.iter_mut().zip(coefficients) {
                *v += c * c / (group.len() - 1) as f64 / repeated;
            }
        }
        let values: usize = seen.iter().sum();
        let filled = filled.iter().filter(|[run, ..]| group.contains(run)).count() * per_marker;
        within.dof += ((group.len() - 1) * (values - fit.count())).saturating_sub(filled);
    }
    // Every hold has its share of the degrees of freedom.
    within.sigma2 = within.hold_sigma2.iter().sum::<f64>() / within.dof.max(1) as f64;
    let values = seen.iter().sum::<usize>() as f64;
    for (square, seen) in within.hold_sigma2.iter_mut().zip(seen) {
        *square /= (within.dof.max(1) as f64 * seen as f64 / values).max(1.0);
    }
    within
}

/// Variance of the coefficients of the overall mean as the session means show it; zeros for one session.
pub(crate) fn between_sessions(
    dataset: &Dataset,
    groups: &[Vec<usize>],
    fit: &DirectionFit,
    sigma2: f64,
) -> DirectionRow {
    if groups.len() < 2 {
        return DirectionRow::default();
    }
    let runs = dataset.runs.len() as f64;
    let overall = dataset.mean_over_runs();
    let mut variance = DirectionRow::default();
    for group in groups {
        for (v, c) in variance.iter_mut().zip(fit.solve(&differences(&mean_of(dataset, group), &overall)).0) {
            *v += c * c / (groups.len() - 1) as f64;
        }
    }
    let repeats = mean(groups.iter().map(|g| 1.0 / g.len() as f64));
    let share: f64 = groups.iter().map(|g| (g.len() as f64 / runs).powi(2)).sum();
    fit.noise_free(variance, sigma2 * repeats).map(|v| v * share)
}

/// Shifts along all axes are the same kind of error, and so are rotations: one variance for each kind.
pub(crate) fn pooled(mut variance: DirectionRow, axes: usize) -> DirectionRow {
    for kind in [&SHIFTS[..axes], rotations(axes)] {
        let mean = mean(kind.iter().map(|j| variance[*j]));
        kind.iter().for_each(|j| variance[*j] = mean);
    }
    variance
}

/// Rotations of a robot whose markers are seen along so many axes.
pub(crate) fn rotations(axes: usize) -> &'static [usize] {
    if axes == 2 { &ROTATIONS[..1] } else { &ROTATIONS }
}

fn mean_of(dataset: &Dataset, runs: &[usize]) -> Vec<f64> {
    let mut mean = vec![0.0; dataset.values_per_run()];
    for &run in runs {
        for (m, v) in mean.iter_mut().zip(dataset.run(run)) {
            *m += v / runs.len() as f64;
        }
    }
    mean
}

pub(crate) fn session_groups(sessions: &[usize], runs: usize) -> Result<Vec<Vec<usize>>, CompareError> {
    if sessions.is_empty() {
        return Ok(vec![(0..runs).collect()]);
    }
    if sessions.len() != runs {
        let found = sessions.len();
        return Err(CompareError::told(format!(
            "{found} session labels for {runs} runs: give one label per run, or none if all runs are one session"
        )));
    }
    let groups = groups(sessions, |a, b| a == b);
    if runs > 1 && groups.len() == runs {
        return Err(CompareError::told(
            "every session has one run only, so run-to-run scatter cannot be separated from session differences: repeat at least \
             one session, or leave the session labels out",
        ));
    }
    Ok(groups)
}
