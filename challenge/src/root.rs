//! Chandrupatla's bracketed root finder: bisection that takes an inverse quadratic step where that is safe.

/// Steps: bisection alone needs 52 for a double.
const MAX_STEPS: usize = 100;

/// Root of `f` in `[a, b]`, to a few units in the last place; `None` if the ends have one sign or a value is not a number.
///
/// Reference: T. R. Chandrupatla, Advances in Engineering Software 28(3), 1997.
pub(super) fn root(mut f: impl FnMut(f64) -> f64, a: f64, b: f64) -> Option<f64> {
    let (mut a, mut b, mut fa, mut fb) = (a, b, f(a), f(b));
    let signs_differ = (fa <= 0.0 && fb >= 0.0) || (fa >= 0.0 && fb <= 0.0);
    if !signs_differ {
        return None;
    }
    let mut share = 0.5;
    for _ in 0..MAX_STEPS {
        let x = a + share * (b - a);
        let fx = f(x);
        if fx.is_nan() {
            return None;
        }
        let (c, fc) = if fx.signum() == fa.signum() { (a, fa) } else { (b, fb) };
        if fx.signum() != fa.signum() {
            (b, fb) = (a, fa);
        }
        (a, fa) = (x, fx);
        let (best, best_f) = if fa.abs() < fb.abs() { (a, fa) } else { (b, fb) };
        let tolerance = 4.0 * f64::EPSILON * best.abs() + f64::MIN_POSITIVE;
        let limit = tolerance / (b - c).abs();
        if limit > 0.5 || best_f == 0.0 || (a - b).abs() <= tolerance {
            return Some(best);
        }
        share = next_share([a, b, c], [fa, fb, fc]).clamp(limit, 1.0 - limit);
    }
    Some(a)
}

/// Where between a and b to look next.
fn next_share([a, b, c]: [f64; 3], [fa, fb, fc]: [f64; 3]) -> f64 {
    let xi = (a - b) / (c - b);
    let phi = (fa - fb) / (fc - fb);
    let safe = phi * phi < xi && (1.0 - phi).powi(2) < 1.0 - xi;
    if !safe {
        return 0.5;
    }
    fa / (fb - fa) * fc / (fb - fc) + (c - a) / (b - a) * fa / (fc - fa) * fb / (fc - fb)
}

#[cfg(test)]
mod tests {
    use super::root;

    #[test]
    fn smooth_steep_and_kinked_functions_are_solved_to_rounding() {
        assert!((root(|x| x.cos() - x, 0.0, 1.0).unwrap() - 0.739_085_133_215_160_6).abs() < 1e-14);
        assert!((root(|x| (1e4 * (x - 0.3)).tanh() + 1e-3 * x, -5.0, 5.0).unwrap() - 0.299_999_97).abs() < 1e-10);
        assert!((root(|x| if x < 0.2 { -1.0 } else { x - 0.1 }, -1.0, 1.0).unwrap() - 0.2).abs() < 1e-14);
        assert_eq!(root(|x| x * x + 1.0, -1.0, 1.0), None);
    }
}
