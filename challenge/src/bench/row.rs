//! One row of the table: a figure, its target, and how well it is known.

use serde::Serialize;
use statrs::distribution::{Beta, ContinuousCDF};

/// Bounds that a figure of the table must meet.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Goal {
    /// The figure must not be below this.
    AtLeast(f64),
    /// The figure must not be above this.
    AtMost(f64),
    /// The figure must be within these two, ends included.
    Between(f64, f64),
}

/// One figure of the table, with its target.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Rate {
    /// Sets that the figure is taken from, in words.
    pub case: &'static str,
    /// What the figure counts or measures, in words.
    pub figure: &'static str,
    /// Bounds that the figure must meet.
    pub target: Goal,
    /// Value of the figure; `None` without sets.
    pub measured: Option<f64>,
    /// 95 % interval of a share (Clopper–Pearson).
    pub interval: Option<[f64; 2]>,
    /// How many sets the figure is taken from.
    pub sets: usize,
    /// It is a share and printed in per cent.
    pub share: bool,
    /// The measured value reaches the target.
    pub met: Option<bool>,
}

impl Goal {
    fn met(self, value: f64) -> bool {
        match self {
            Goal::AtLeast(least) => value >= least,
            Goal::AtMost(most) => value <= most,
            Goal::Between(low, high) => (low..=high).contains(&value),
        }
    }
}

impl Rate {
    /// Share of sets for which something holds.
    pub fn share(case: &'static str, figure: &'static str, target: Goal, sets: &[bool]) -> Rate {
        let (hits, n) = (sets.iter().filter(|hit| **hit).count(), sets.len());
        let measured = (n > 0).then(|| hits as f64 / n as f64);
        let interval = (n > 0).then(|| clopper_pearson(hits, n));
        Rate { case, figure, target, measured, interval, sets: n, share: true, met: measured.map(|v| target.met(v)) }
    }

    /// A row for a mean or a median, without an interval.
    pub fn number(case: &'static str, figure: &'static str, target: Goal, value: Option<f64>, sets: usize) -> Rate {
        let met = value.map(|v| target.met(v));
        Rate { case, figure, target, measured: value, interval: None, sets, share: false, met }
    }
}

fn clopper_pearson(hits: usize, n: usize) -> [f64; 2] {
    let quantile =
        |a: usize, b: usize, p: f64| Beta::new(a as f64, b as f64).map_or(f64::NAN, |beta| beta.inverse_cdf(p));
    let low = if hits == 0 { 0.0 } else { quantile(hits, n - hits + 1, 0.025) };
    let high = if hits == n { 1.0 } else { quantile(hits + 1, n - hits, 0.975) };
    [low, high]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_interval_is_the_exact_binomial_one() {
        // Clopper & Pearson: 0 of 10 gives 1 − 0.025^(1/10); 5 of 10 the tabulated 0.1871–0.8129.
        let [low, high] = clopper_pearson(0, 10);
        assert!(low == 0.0 && (high - (1.0 - 0.025_f64.powf(0.1))).abs() < 1e-9, "{high}");
        let [low, high] = clopper_pearson(5, 10);
        assert!((low - 0.187_086_0).abs() < 1e-6 && (high - 0.812_914_0).abs() < 1e-6, "{low} {high}");
    }

    #[test]
    fn a_row_without_sets_reaches_nothing_and_misses_nothing() {
        let row = Rate::share("c", "f", Goal::AtLeast(0.9), &[]);
        assert_eq!((row.measured, row.met, row.interval), (None, None, None));
        assert_eq!(Rate::share("c", "f", Goal::AtMost(0.5), &[true, false]).met, Some(true));
    }
}
