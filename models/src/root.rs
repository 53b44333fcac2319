//! A bracketed secant iteration: never leaves the bracket, halves it when the secant stalls.

/// Why no root was returned.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum NoRoot {
    /// The function has the same sign at both ends: values there.
    SameSign { at_low: f64, at_high: f64 },
    /// Not settled within [`MAX_EVALUATIONS`]; last value.
    Stalled { f: f64 },
}

/// A root and the slope of the last secant there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Root {
    pub x: f64,
    pub slope: f64,
}

/// A secant settles in 4–7 evaluations and pure bisection of a unit bracket in 60; 120 is never reached.
const MAX_EVALUATIONS: usize = 120;
/// Relative step at which the iteration ends: the point just evaluated is then a root to this accuracy.
const TOLERANCE: f64 = 5e-14;
/// Evaluations after which the bracket must have halved, else it is halved.
const PATIENCE: usize = 8;

/// Root of a function that is positive at `low` and negative at `high`, from two start values (and the function's value
/// at the first one, if known).
///
/// The last point at which `f` is evaluated is the one returned, so that a caller can keep what it computed there. The
/// ends are evaluated only if the iteration runs against one of them, because the balance is steepest there.
pub(crate) fn find_root<F: FnMut(f64) -> f64>(
    f: &mut F,
    bracket: (f64, f64),
    start: (f64, Option<f64>, f64),
) -> Result<Root, NoRoot> {
    let (mut low, mut high) = bracket;
    let inset = 1e-3 * (high - low);
    let mut x0 = start.0.clamp(low + inset, high - inset);
    let mut x1 = start.2.clamp(low + 0.5 * inset, high - 0.5 * inset);
    let mut f0 = match start.1 {
        Some(known) if x0 == start.0 => known,
        _ => f(x0),
    };
    let mut seen = (f0 > 0.0, f0 <= 0.0);
    if f0 > 0.0 {
        low = x0
    } else {
        high = x0
    }
    let (mut f1, mut last_width) = (f(x1), high - low);
    for evaluation in 1..MAX_EVALUATIONS {
        if f1 > 0.0 {
            low = low.max(x1);
            seen.0 = true;
        } else {
            high = high.min(x1);
            seen.1 = true;
        }
        let slope = (f1 - f0) / (x1 - x0);
        let step = -f1 / slope;
        if f1 == 0.0 || (step.abs() <= TOLERANCE * x1.abs() && step.abs() <= (x1 - x0).abs()) {
            return Ok(Root { x: x1, slope });
        }
        if high - low <= 4.0 * f64::EPSILON * (low.abs() + high.abs()) + f64::MIN_POSITIVE {
            return end_of_bracket(f, (low, high), seen, slope);
        }
        let slow = evaluation % PATIENCE == 0 && high - low > 0.5 * last_width;
        let inside = x1 + step > low && x1 + step < high;
        let next = if slow || !inside { 0.5 * (low + high) } else { x1 + step };
        if evaluation % PATIENCE == 0 {
            last_width = high - low;
        }
        (x0, f0, x1, f1) = (x1, f1, next, f(next));
    }
    Err(NoRoot::Stalled { f: f1 })
}

/// The bracket has closed: a root if both signs were seen, else one end has to show whether the sign changes there.
fn end_of_bracket<F: FnMut(f64) -> f64>(
    f: &mut F,
    (low, high): (f64, f64),
    seen: (bool, bool),
    slope: f64,
) -> Result<Root, NoRoot> {
    let (at_low, at_high) = (f(low), f(high));
    if seen == (true, true) || (at_low >= 0.0 && at_high <= 0.0) {
        let x = 0.5 * (low + high);
        f(x);
        return Ok(Root { x, slope });
    }
    Err(NoRoot::SameSign { at_low, at_high })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_smooth_function_settles_to_rounding() {
        let x = find_root(&mut |x: f64| x.cos() - 0.3 * x, (0.0, 3.0), (1.5, None, 1.4)).unwrap().x;
        assert!((x.cos() - 0.3 * x).abs() < 1e-14, "{x}");
    }

    #[test]
    fn a_step_is_found_by_halving() {
        let x = find_root(&mut |x: f64| if x < 0.123 { 1.0 } else { -1e-3 }, (0.0, 1.0), (0.9, None, 0.8)).unwrap().x;
        assert!((x - 0.123).abs() < 1e-10, "{x}");
    }

    #[test]
    fn a_function_without_a_root_is_refused_with_its_end_values() {
        let error = find_root(&mut |x: f64| 1.0 + x, (0.0, 1.0), (0.5, None, 0.4)).unwrap_err();
        assert!(matches!(error, NoRoot::SameSign { at_high, .. } if at_high > 1.9), "{error:?}");
    }

    #[test]
    fn a_function_that_is_nowhere_a_number_is_refused() {
        assert!(find_root(&mut |_| f64::NAN, (0.0, 1.0), (0.5, None, 0.4)).is_err());
    }

    #[test]
    fn equal_start_values_do_no_harm() {
        let x = find_root(&mut |x: f64| 0.25 - x, (0.0, 1.0), (0.9, None, 0.9)).unwrap().x;
        assert!((x - 0.25).abs() < 1e-14);
    }

    #[test]
    fn a_smooth_root_costs_few_evaluations() {
        let mut calls = 0;
        let mut f = |t: f64| (calls += 1, t.cos() - 0.0465 * t).1;
        let root = find_root(&mut f, (0.0, 3.1), (1.501, None, 1.5));
        assert!(root.is_ok() && calls <= 5, "{calls}");
    }
}
