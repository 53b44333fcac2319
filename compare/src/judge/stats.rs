//! Quantiles, tails and the correction for many tests: small wrappers that never return NaN.

use statrs::distribution::{ChiSquared, ContinuousCDF, FisherSnedecor, Normal, StudentsT};

/// Smallest p-value ever reported: the normal model of the noise is not good enough to claim less.
pub const SMALLEST_P: f64 = 1e-6;

/// Quantile of a sorted slice by linear interpolation (type 7 of Hyndman and Fan); `None` if empty.
pub fn quantile(sorted: &[f64], fraction: f64) -> Option<f64> {
    let last = sorted.len().checked_sub(1)?;
    let at = fraction.clamp(0.0, 1.0) * last as f64;
    let low = at.floor() as usize;
    let high = (low + 1).min(last);
    Some(sorted[low] + (at - low as f64) * (sorted[high] - sorted[low]))
}

/// A p-value as reported: never below [`SMALLEST_P`]; apply it last, after any correction.
pub fn reported_p(p: f64) -> f64 {
    p.clamp(SMALLEST_P, 1.0)
}

/// P(|t| > |z|) of Student's t with `dof` degrees of freedom; the normal tail for `dof` = 0 (σ known).
pub fn two_sided_p(z: f64, dof: usize) -> f64 {
    let tail = match StudentsT::new(0.0, 1.0, dof as f64) {
        Ok(t) if dof > 0 => t.sf(z.abs()),
        _ => standard_normal_tail(z.abs()),
    };
    (2.0 * tail).clamp(0.0, 1.0)
}

/// P(F > f) of Fisher's F; 1 if a number of degrees of freedom is zero.
pub fn f_tail(f: f64, dof_numerator: usize, dof_denominator: usize) -> f64 {
    match FisherSnedecor::new(dof_numerator as f64, dof_denominator as f64) {
        Ok(law) => law.sf(f.max(0.0)).clamp(0.0, 1.0),
        Err(_) => 1.0,
    }
}

/// P(χ² > x); 1 without degrees of freedom.
pub fn chi2_tail(x: f64, dof: usize) -> f64 {
    match ChiSquared::new(dof as f64) {
        Ok(law) => law.sf(x.max(0.0)).clamp(0.0, 1.0),
        Err(_) => 1.0,
    }
}

/// z of the normal law with the tail of Student's t: `(8ν+1)/(8ν+3) √(ν ln(1 + t²/ν))` with the sign of t (Wallace 1959; within
/// 0.02 where |t| < 3). Squares of z add up to χ² whatever the ν of each.
pub fn normal_score(t: f64, dof: f64) -> f64 {
    if dof.is_infinite() {
        return t;
    }
    (8.0 * dof + 1.0) / (8.0 * dof + 3.0) * (dof * (t * t / dof).ln_1p()).sqrt() * t.signum()
}

/// (t_{dof,.9975} / z_.9975)²: how much a variance estimated from `dof` values is widened before it is used in a test.
pub fn t_inflation(dof: usize) -> f64 {
    const Z_9975: f64 = 2.807033768343811;
    match StudentsT::new(0.0, 1.0, dof as f64) {
        Ok(t) => (t.inverse_cdf(0.9975) / Z_9975).powi(2),
        Err(_) => 1.0,
    }
}

/// t_{dof,.975}: half-width of a 95 % interval in standard errors; the normal 1.96 for `dof` = 0.
pub fn t_975(dof: usize) -> f64 {
    match StudentsT::new(0.0, 1.0, dof as f64) {
        Ok(t) if dof > 0 => t.inverse_cdf(0.975),
        _ => 1.959_963_984_540_054,
    }
}

/// Holm's step-down adjusted p-values, in the order given: rejecting those below α errs in at most α of all families.
pub fn holm(p: &[f64]) -> Vec<f64> {
    let mut order: Vec<usize> = (0..p.len()).collect();
    order.sort_by(|&a, &b| p[a].total_cmp(&p[b]));
    let mut adjusted = vec![1.0; p.len()];
    let mut running = 0.0_f64;
    for (rank, &i) in order.iter().enumerate() {
        running = running.max(((p.len() - rank) as f64 * p[i]).min(1.0));
        adjusted[i] = running;
    }
    adjusted
}

fn standard_normal_tail(z: f64) -> f64 {
    Normal::new(0.0, 1.0).map_or(1.0, |law| law.sf(z))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tails_agree_with_tables() {
        assert!((two_sided_p(1.959963985, 0) - 0.05).abs() < 1e-9);
        assert!((two_sided_p(2.776445105, 4) - 0.05).abs() < 1e-9);
        assert!((f_tail(3.325834530, 5, 10) - 0.05).abs() < 1e-9);
        assert!((t_975(4) - 2.776445105).abs() < 1e-7 && (t_975(1) - 12.7062047).abs() < 1e-6);
        assert_eq!(reported_p(two_sided_p(60.0, 100)), 1e-6);
    }

    #[test]
    fn a_score_has_the_tail_of_its_t() {
        for (dof, t) in [(2, 4.30265), (4, 2.77645), (9, 2.26216), (9, -2.26216)] {
            let p = two_sided_p(normal_score(t, dof as f64), 0);
            assert!((p - 0.05).abs() < 0.004, "{dof}: {p}");
        }
        assert_eq!((normal_score(3.0, f64::INFINITY), normal_score(0.0, 3.0)), (3.0, 0.0));
        assert!((chi2_tail(11.0705, 5) - 0.05).abs() < 1e-6 && chi2_tail(1.0, 0) == 1.0);
    }

    #[test]
    fn the_inflation_falls_to_one_with_many_runs() {
        // t_{2,.9975} = 14.0890, t_{4,.9975} = 5.59757 (tables), z_.9975 = 2.80703.
        assert!((t_inflation(2) - (14.08905 / 2.80703_f64).powi(2)).abs() < 1e-3);
        assert!((t_inflation(4) - (5.59757 / 2.80703_f64).powi(2)).abs() < 1e-4);
        assert!((t_inflation(1_000_000) - 1.0).abs() < 1e-4);
    }

    #[test]
    fn holm_multiplies_the_smallest_by_the_number_of_tests() {
        assert_eq!(holm(&[0.01, 0.5, 0.02]), [0.03, 0.5, 0.04]);
        assert_eq!(holm(&[0.9, 0.9]), [1.0, 1.0]);
    }

    #[test]
    fn quantiles_interpolate_and_an_empty_slice_has_none() {
        assert_eq!(quantile(&[1.0, 2.0, 3.0, 4.0], 0.5), Some(2.5));
        assert_eq!(quantile(&[7.0], 0.975), Some(7.0));
        assert_eq!(quantile(&[], 0.5), None);
    }
}
