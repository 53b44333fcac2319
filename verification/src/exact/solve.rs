//! Helpers of the closed forms: one bracketed root, one integral.

pub(super) use models::trig::{sinc, sine_deficit, sine_lag};

/// The x in (lo, hi) where `f` falls through zero, by bisection down to adjacent numbers.
///
/// Returns (nearly) `lo` where f < 0 throughout, `hi` where f > 0 throughout, and NaN where f is NaN. Never evaluates
/// `f` at `lo` or `hi`, so poles there do no harm. Certainty matters more than speed in a reference: about 60 evaluations.
pub(super) fn falling_root(f: impl Fn(f64) -> f64, lo: f64, hi: f64) -> f64 {
    let (mut lo, mut hi) = (lo, hi);
    for _ in 0..200 {
        let middle = 0.5 * (lo + hi);
        if middle <= lo || middle >= hi {
            break;
        }
        let value = f(middle);
        if value.is_nan() {
            return f64::NAN;
        }
        if value > 0.0 { lo = middle } else { hi = middle }
    }
    hi
}

/// ∫ f over (lo, hi): Gauss–Legendre of ten points in each of `panels` equal panels; never evaluates `f` at the ends.
pub(super) fn integral(f: impl Fn(f64) -> f64, lo: f64, hi: f64, panels: u32) -> f64 {
    let half = 0.5 * (hi - lo) / f64::from(panels);
    let mut sum = 0.0;
    for i in 0..panels {
        let middle = lo + half * f64::from(2 * i + 1);
        for [node, weight] in GAUSS_10 {
            sum += weight * (f(middle - half * node) + f(middle + half * node));
        }
    }
    half * sum
}

/// Positive nodes and weights of the ten-point rule, exact for polynomials up to degree 19.
const GAUSS_10: [[f64; 2]; 5] = [
    [0.14887433898163122, 0.29552422471475287],
    [0.4333953941292472, 0.26926671930999635],
    [0.6794095682990244, 0.21908636251598204],
    [0.8650633666889845, 0.1494513491505806],
    [0.9739065285171717, 0.06667134430868814],
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_integral_is_exact_for_degree_nineteen_and_tolerates_a_pole_at_an_end() {
        assert!((integral(|x| x.powi(19) + x.powi(18), -1.0, 2.0, 1) * 20.0 * 19.0 - 30_408_705.0).abs() < 1e-6);
        assert!((integral(f64::exp, 0.0, 1.0, 2) - (1.0_f64.exp() - 1.0)).abs() < 1e-15);
        assert!(integral(|x| 1.0 / x.sqrt(), 0.0, 1.0, 10_000).is_finite());
    }

    #[test]
    fn a_falling_root_is_found_to_the_last_digit_and_clamped_where_there_is_none() {
        assert!((falling_root(|x| 2.0 - x * x, 0.0, 2.0) - 2.0_f64.sqrt()).abs() < 4e-16);
        assert_eq!(falling_root(|_| 1.0, 0.0, 2.0), 2.0);
        assert!(falling_root(|_| -1.0, 0.5, 2.0) < 0.5 + 1e-15);
        assert!(falling_root(|_| f64::NAN, 0.0, 2.0).is_nan());
    }
}
