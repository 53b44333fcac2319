//! Standard deviations of a few tests each, steadied by the other rows' standard deviations.
//!
//! ```text
//! s̃² = (d₀ s₀² + ν s²)/(d₀ + ν)  with d₀ + ν degrees of freedom        Var(ln s²) = ψ'(ν/2) + ψ'(d₀/2)
//! ```
//!
//! | symbol | meaning |
//! |---|---|
//! | s, ν | standard deviation of a row and its degrees of freedom, tests less one |
//! | s₀, d₀ | what the rows have in common, and how many degrees of freedom that is worth: all where they scatter alike |
//! | ψ' | trigamma function |
//!
//! A standard deviation of three tests is often a third of the true one, and would decide a fit alone. Reference: Smyth 2004
//! (moderated t). Rows have either standard deviations in common or their ratios to the value, whichever differ less.

use statrs::function::gamma::digamma;

const FEWEST: usize = 4;
/// d₀ from which on all rows are alike.
const ALIKE: f64 = 1e4;

/// What a row's deviation is divided by.
type RowScale = dyn Fn(&[f64; 3]) -> f64;

/// Steadied standard deviations and their degrees of freedom, from sd, ν and the size of every row.
pub(super) fn steadied(rows: &[[f64; 3]]) -> Vec<[f64; 2]> {
    let apart = |unit: &RowScale| common(rows, unit).1;
    let [own, ratio]: [&RowScale; 2] = [&|_| 1.0, &|row| row[2]];
    let unit = if apart(own) < apart(ratio) { own } else { ratio };
    let (level, variance) = common(rows, unit);
    if rows.len() < FEWEST {
        return rows.iter().map(|[sd, dof, _]| [*sd, *dof]).collect();
    }
    let d0 = prior(variance);
    let s0 = (level + digamma(0.5 * d0) - (0.5 * d0).ln()).exp();
    let of = |row: &[f64; 3]| {
        let [sd, dof, _] = *row;
        [((d0 * s0 * unit(row).powi(2) + dof * sd * sd) / (d0 + dof)).sqrt(), d0 + dof]
    };
    rows.iter().map(of).collect()
}

/// Mean of the unbiased ln s², and its variance beyond the variance of a few tests.
fn common(rows: &[[f64; 3]], unit: &RowScale) -> (f64, f64) {
    let of = |row: &[f64; 3]| 2.0 * (row[0] / unit(row)).ln() - digamma(0.5 * row[1]) + (0.5 * row[1]).ln();
    let n = rows.len() as f64;
    let mean = rows.iter().map(of).sum::<f64>() / n;
    let variance = rows.iter().map(|row| (of(row) - mean).powi(2)).sum::<f64>() / (n - 1.0).max(1.0);
    (mean, variance - rows.iter().map(|row| trigamma(0.5 * row[1])).sum::<f64>() / n)
}

/// Prior degrees of freedom d₀, from ψ'(d₀/2) = variance.
fn prior(variance: f64) -> f64 {
    let (mut low, mut high) = (0.1_f64, ALIKE);
    for _ in 0..60 {
        let middle = (low * high).sqrt();
        *(if trigamma(0.5 * middle) > variance { &mut low } else { &mut high }) = middle;
    }
    (low * high).sqrt()
}

/// ψ'(x): recurrence, then the asymptotic series.
fn trigamma(x: f64) -> f64 {
    if x < 8.0 {
        return 1.0 / (x * x) + trigamma(x + 1.0);
    }
    let y = 1.0 / (x * x);
    (1.0 + 0.5 / x + y * (1.0 / 6.0 - y * (1.0 / 30.0 - y / 42.0))) / x
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_that_scatter_alike_share_one_deviation_and_others_keep_theirs() {
        assert!((trigamma(1.0) - std::f64::consts::PI.powi(2) / 6.0).abs() < 1e-9);
        assert!((trigamma(0.5) - std::f64::consts::PI.powi(2) / 2.0).abs() < 1e-9);
        let alike: Vec<[f64; 3]> = (1..9).map(|i| [0.03 * f64::from(i), 4.0, f64::from(i)]).collect();
        for (row, [sd, dof]) in alike.iter().zip(steadied(&alike)) {
            assert!(dof > 1e3 && (sd / steadied(&alike)[0][0] / row[2] - 1.0).abs() < 1e-3, "{sd} {dof}");
        }
        let apart: Vec<[f64; 3]> = (0..8).map(|i| [10_f64.powi(i), 4.0, 1.0]).collect();
        let found = steadied(&apart);
        assert!(found.iter().all(|[_, dof]| *dof < 4.5) && (found[7][0] / 1e7 - 1.0).abs() < 0.05, "{found:?}");
        assert_eq!(steadied(&alike[..3])[0], [0.03, 4.0]);
    }
}
