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
/// Error at which the iteration ends. A secant's next error is about the product of its last two steps, so the product
/// is what is compared; the functions here have |f″/2f′| of order one on their bracket.
const TOLERANCE: f64 = 1e-14;
/// Evaluations after which the bracket must have halved, else it is halved.
const PATIENCE: usize = 8;

/// Root of a function that is positive at `low` and negative at `high`, from two start values (and the function's value
/// at the first one, if known).
///
/// The ends are evaluated only if the iteration runs against one of them, because the balance is steepest there.
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
    let (mut f1, mut last_width) = (f0, high - low);
    for evaluation in 1..MAX_EVALUATIONS {
        f1 = f(x1);
        if f1 == 0.0 {
            return Ok(Root { x: x1, slope: (f1 - f0) / (x1 - x0) });
        }
        if f1 > 0.0 {
            low = low.max(x1);
            seen.0 = true;
        } else {
            high = high.min(x1);
            seen.1 = true;
        }
        let slope = (f1 - f0) / (x1 - x0);
        let step = -f1 / slope;
        // A jump makes steps small too, but its values do not shrink.
        let falling = f1.abs() <= 0.1 * f0.abs();
        let settled = falling && (step * (x1 - x0)).abs() <= TOLERANCE && step.abs() <= 1e-5;
        let mut next = x1 + step;
        if settled && next >= low && next <= high {
            return Ok(Root { x: next, slope });
        }
        if high - low <= 4.0 * f64::EPSILON * (low.abs() + high.abs()) + f64::MIN_POSITIVE {
            return end_of_bracket(f, (low, high), seen, slope);
        }
        let slow = evaluation % PATIENCE == 0 && high - low > 0.5 * last_width;
        if slow || !(next > low && next < high) {
            next = 0.5 * (low + high);
        }
        if evaluation % PATIENCE == 0 {
            last_width = high - low;
        }
        (x0, f0, x1) = (x1, f1, next);
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
        return Ok(Root { x: 0.5 * (low + high), slope });
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
        assert!(root.is_ok() && calls <= 4, "{calls}");
    }
}
