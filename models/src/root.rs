//! A bracketed secant iteration with the bend of three points: never leaves the bracket, halves it when it stalls.

/// An interval halved so many times; `is_low` decides which half goes.
pub(crate) fn halved([mut low, mut high]: [f64; 2], count: usize, is_low: impl Fn(f64) -> bool) -> [f64; 2] {
    for _ in 0..count {
        let middle = 0.5 * (low + high);
        *(if is_low(middle) { &mut low } else { &mut high }) = middle;
    }
    [low, high]
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum NoRoot {
    /// The function has the same sign at both ends: values there.
    SameSign { at_low: f64, at_high: f64 },
    /// Not settled within [`MAX_EVALUATIONS`]; last value.
    Stalled { f: f64 },
}

/// Where to start: a point, the function there if it is known, and a guess of its slope (negative).
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Start {
    pub x: f64,
    pub f: Option<f64>,
    pub slope: f64,
}

impl Start {
    /// Where the function is not known yet.
    pub(crate) fn guess(x: f64, slope: f64) -> Start {
        Start { x, f: None, slope }
    }

    pub(crate) fn known(x: f64, f: f64, slope: f64) -> Start {
        Start { x, f: Some(f), slope }
    }
}

/// The root is `x + step`: `x` is the last point evaluated, so that a caller can keep what it computed there and carry
/// it over the tiny remaining step along its tangent.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Root {
    pub x: f64,
    pub step: f64,
    pub slope: f64,
}

/// A smooth root settles in 1–5 evaluations and pure bisection of a unit bracket in 60; 120 is never reached.
const MAX_EVALUATIONS: usize = 120;
/// A last step this short is taken without another evaluation …
const LAST_STEP: f64 = 1e-7;
/// … if its product with the relative doubt about the slope is this small: that product is the error the step leaves.
const LAST_ERROR: f64 = 1e-14;
/// Part of the bracket below which x counts as zero when steps are compared with it.
const FLOOR: f64 = 1e-6;
/// A value beyond this, found by narrowing to rounding, belongs to a pole: neither a root nor a moment of a law (SI).
pub(crate) const POLE: f64 = 1e9;
/// Evaluations after which the bracket must have halved, else it is halved.
const PATIENCE: usize = 8;

/// Root of a function that is positive at `low` and negative at `high`.
///
/// The ends are evaluated only if the iteration runs against one of them, because the balance is steepest there.
pub(crate) fn find_root<F: FnMut(f64) -> f64>(f: &mut F, bracket: (f64, f64), start: Start) -> Result<Root, NoRoot> {
    let (mut low, mut high) = bracket;
    let (inset, floor) = (1e-3 * (high - low), FLOOR * (high - low));
    let mut x0 = start.x.clamp(low + inset, high - inset);
    let mut f0 = match start.f {
        Some(known) if x0 == start.x => known,
        _ => f(x0),
    };
    let mut seen = (f0 > 0.0, f0 <= 0.0);
    if f0 > 0.0 {
        low = x0
    } else {
        high = x0
    }
    let mut slope = start.slope;
    let newton = x0 - f0 / slope;
    let trusted = slope < 0.0 && slope.is_finite();
    if trusted && start.f.is_none() && (newton - x0).abs() <= LAST_ERROR * (x0.abs() + floor) {
        return Ok(Root { x: x0, step: newton - x0, slope });
    }
    let mut x1 = if trusted && newton >= low && newton <= high { newton } else { 0.5 * (low + high) };
    let (mut f1, mut last_width, mut oldest) = (f(x1), high - low, f64::NAN);
    for evaluation in 1..MAX_EVALUATIONS {
        if f1 > 0.0 {
            low = low.max(x1);
            seen.0 = true;
        } else {
            high = high.min(x1);
            seen.1 = true;
        }
        let last = slope;
        if x1 != x0 {
            slope = (f1 - f0) / (x1 - x0);
        }
        let (change, bend) = (slope - last, bend(slope - last, x1, x0, oldest));
        let tangent = if slope + bend < 0.0 { slope + bend } else { slope };
        let step = if f1 == 0.0 { 0.0 } else { -f1 / tangent };
        let short = settled(step, change / tangent, bend / tangent, x1.abs() + floor);
        // Across a pole the secant falls as well, and its steps end there.
        if tangent < 0.0 && short && f1.abs() < POLE {
            return Ok(Root { x: x1, step, slope: tangent });
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
        (oldest, x0, f0, x1, f1) = (x0, x1, f1, next, f(next));
    }
    Err(NoRoot::Stalled { f: f1 })
}

/// From the secant to the tangent at x1: what the parabola through the last three points adds; 0 without a third.
#[inline]
fn bend(change: f64, x1: f64, x0: f64, oldest: f64) -> f64 {
    let bend = change * (x1 - x0) / (x1 - oldest);
    if bend.is_finite() { bend } else { 0.0 }
}

/// Whether x plus this step is the root: the step is short, and the error it leaves is rounding.
///
/// Relative doubt about the slope: all its last change without a third point; with one, what a cubic would add to the
/// parabola. A change of more than a hundredth may hide a corner, which the parabola does not see.
#[inline]
fn settled(step: f64, change: f64, bend: f64, scale: f64) -> bool {
    let (step, change) = (step.abs(), change.abs());
    let doubt = if change < 1e-2 && bend != 0.0 { bend.abs() * (change + 1e-3) } else { change };
    step <= LAST_STEP * scale && step * doubt <= LAST_ERROR * scale
}

/// The bracket has closed: a root if both signs were seen, else one end has to show whether the sign changes there.
fn end_of_bracket<F: FnMut(f64) -> f64>(
    f: &mut F,
    (low, high): (f64, f64),
    seen: (bool, bool),
    slope: f64,
) -> Result<Root, NoRoot> {
    let (at_low, at_high) = (f(low), f(high));
    let changes = seen == (true, true) || (at_low >= 0.0 && at_high <= 0.0);
    // At a pole the sign changes too.
    if changes && at_low.abs() < POLE && at_high.abs() < POLE {
        let x = 0.5 * (low + high);
        f(x);
        return Ok(Root { x, step: 0.0, slope });
    }
    Err(NoRoot::SameSign { at_low, at_high })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn root(mut f: impl FnMut(f64) -> f64, bracket: (f64, f64), x: f64, slope: f64) -> Result<f64, NoRoot> {
        find_root(&mut f, bracket, Start { x, f: None, slope }).map(|root| root.x + root.step)
    }

    #[test]
    fn a_smooth_function_settles_to_rounding() {
        let x = root(|x| x.cos() - 0.3 * x, (0.0, 3.0), 1.5, -1.0).unwrap();
        assert!((x.cos() - 0.3 * x).abs() < 1e-14, "{x}");
    }

    #[test]
    fn a_jump_is_found_within_the_length_of_the_last_step() {
        let x = root(|x| if x < 0.123 { 1.0 } else { -1e-3 }, (0.0, 1.0), 0.9, -1.0).unwrap();
        assert!((x - 0.123).abs() < LAST_STEP, "{x}");
    }

    #[test]
    fn a_function_without_a_root_is_refused_with_its_end_values() {
        let error = root(|x| 1.0 + x, (0.0, 1.0), 0.5, -1.0).unwrap_err();
        assert!(matches!(error, NoRoot::SameSign { at_high, .. } if at_high > 1.9), "{error:?}");
    }

    #[test]
    fn a_pole_and_an_end_of_the_numbers_are_no_roots() {
        assert!(root(|x| 1.0 / (0.3 - x), (0.0, 1.0), 0.5, -1.0).is_err());
        assert!(root(|x| if x < 0.3 { 1.0 } else { f64::NAN }, (0.0, 1.0), 0.5, -1.0).is_err());
    }

    #[test]
    fn a_function_that_is_nowhere_a_number_is_refused() {
        assert!(root(|_| f64::NAN, (0.0, 1.0), 0.5, -1.0).is_err());
    }

    #[test]
    fn a_slope_of_the_wrong_sign_or_no_number_does_no_harm() {
        for slope in [1.0, 0.0, f64::NAN, f64::NEG_INFINITY] {
            let x = root(|x| 0.25 - x.powi(3), (0.0, 1.0), 0.9, slope).unwrap();
            assert!((x - 0.25_f64.cbrt()).abs() < 1e-14, "{slope}");
        }
    }

    #[test]
    fn a_start_at_the_root_with_a_known_value_evaluates_once_and_keeps_the_slope() {
        let mut calls = 0;
        let mut f = |x: f64| (calls += 1, 0.5 - x).1;
        let root = find_root(&mut f, (0.0, 1.0), Start { x: 0.5, f: Some(0.0), slope: -2.0 }).unwrap();
        assert_eq!((root.x, root.step, root.slope, calls), (0.5, 0.0, -2.0, 1));
    }

    #[test]
    fn a_smooth_root_costs_few_evaluations() {
        let mut calls = 0;
        let x = root(|t| (calls += 1, t.cos() - 0.0465 * t).1, (0.0, 3.1), 1.45, -1.0).unwrap();
        assert!((x.cos() - 0.0465 * x).abs() < 1e-15 && calls <= 5, "{calls}");
    }
}
