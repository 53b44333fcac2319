//! The specimen is the unit: mean, standard deviation, interval of the mean, and specimens that deviate.

use crate::policy;
use crate::stats::{t_975, two_sided_p};
use serde::Serialize;

/// A number of every specimen, summed up.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Scatter {
    /// Number of specimens in the mean.
    #[serde(rename = "specimens")]
    pub n: usize,
    /// Mean over specimens, in the unit of the number.
    pub mean: f64,
    /// Standard deviation between specimens, of two or more.
    pub sd: Option<f64>,
    /// Half-width of the 95 % interval of the mean, t s/√n.
    #[serde(skip)]
    pub half: Option<f64>,
}

/// A number of the fabric in display units.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FabricNumber {
    /// Key of the number in JSON, such as `nu12`.
    pub key: String,
    /// Name of the number for tables.
    pub name: String,
    /// Unit of mean and scatter, for display.
    pub unit: &'static str,
    /// Mean and scatter over specimens, in `unit`.
    #[serde(flatten)]
    pub scatter: Scatter,
    /// How it is known, and from what.
    #[serde(rename = "how_known")]
    pub known: String,
}

impl Scatter {
    /// Of one value per specimen; none without any.
    pub fn of(values: impl IntoIterator<Item = f64>) -> Option<Scatter> {
        let values: Vec<f64> = values.into_iter().collect();
        let n = values.len();
        if n == 0 {
            return None;
        }
        let mean = values.iter().sum::<f64>() / n as f64;
        let squares: f64 = values.iter().map(|v| (v - mean).powi(2)).sum();
        let sd = (n > 1).then(|| (squares / (n - 1) as f64).sqrt());
        Some(Scatter { n, mean, sd, half: sd.map(|s| t_975(n - 1) * s / (n as f64).sqrt()) })
    }

    /// A function of several means, given its value and its slope in each: errors carried on, Welch's degrees of freedom.
    pub fn carried(mean: f64, parts: &[(Scatter, f64)]) -> Scatter {
        let n = parts.iter().map(|(scatter, _)| scatter.n).sum();
        let variance = |(s, slope): &(Scatter, f64)| s.sd.map(|sd| (slope * sd).powi(2) / s.n as f64);
        let none = Scatter { n, mean, sd: None, half: None };
        let Some(each) = parts.iter().map(variance).collect::<Option<Vec<f64>>>() else { return none };
        let total: f64 = each.iter().sum();
        let spread: f64 = each.iter().zip(parts).map(|(v, (s, _))| v * v / (s.n - 1) as f64).sum();
        let dof = if spread > 0.0 { (total * total / spread).floor().max(1.0) as usize } else { 1 };
        Scatter { half: Some(t_975(dof) * total.sqrt()), ..none }
    }

    /// The mean alone.
    pub(super) fn without_interval(self) -> Scatter {
        Scatter { sd: None, half: None, ..self }
    }

    /// Mean and scatter times a factor, as for another unit.
    pub fn scaled(self, factor: f64) -> Scatter {
        let by = |v: Option<f64>| v.map(|v| v * factor.abs());
        Scatter { n: self.n, mean: self.mean * factor, sd: by(self.sd), half: by(self.half) }
    }

    /// 95 % interval of the mean.
    pub fn interval(&self) -> Option<[f64; 2]> {
        self.half.map(|half| [self.mean - half, self.mean + half])
    }
}

/// Places of values that deviate from the mean of the others: by more than a quarter, or (from three on) by more than chance
/// in one of twenty sets.
pub fn deviating(values: &[f64]) -> Vec<(usize, f64)> {
    let n = values.len();
    let deviation = |i: usize| {
        let rest = Scatter::of(values[..i].iter().chain(&values[i + 1..]).copied())?;
        let off = values[i] - rest.mean;
        let spread = rest.sd.unwrap_or(0.0) * (1.0 + 1.0 / rest.n as f64).sqrt();
        let rare = n > 3 && two_sided_p(off / spread.max(f64::MIN_POSITIVE), n - 2) * (n as f64) < 0.05;
        policy::deviates(off / rest.mean, rare).then_some((i, off / rest.mean))
    };
    let mut found: Vec<(usize, f64)> = (0..n).filter_map(deviation).collect();
    // One wild value makes its neighbours deviate from the mean that it spoils: keep what deviates from the median too.
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    if n > 2 {
        let median = 0.5 * (sorted[(n - 1) / 2] + sorted[n / 2]);
        found.retain(|(i, _)| policy::deviates(values[*i] / median - 1.0, true));
    }
    if n > 2 && found.len() == n { Vec::new() } else { found }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn mean_and_interval_are_those_of_the_table() {
        let s = Scatter::of([96.0, 98.0, 94.0, 97.0, 95.0]).unwrap();
        assert!((s.mean - 96.0).abs() < 1e-12 && (s.sd.unwrap() - 2.5_f64.sqrt()).abs() < 1e-12);
        // t_{4,.975} = 2.776445.
        assert!((s.half.unwrap() - 2.776445 * (0.5_f64).sqrt()).abs() < 1e-5);
        assert_eq!(Scatter::of([3.0]).unwrap().interval(), None);
        assert_eq!(Scatter::of([]), None);
    }

    #[test]
    fn carried_errors_are_those_of_a_sum_of_independent_means() {
        let s = Scatter::of([1.0, 2.0, 3.0]).unwrap();
        let sum = Scatter::carried(4.0, &[(s, 1.0), (s, 1.0)]);
        // Both s²/n = 1/3, dof 4.
        assert!((sum.half.unwrap() - 2.776445 * (2.0_f64 / 3.0).sqrt()).abs() < 1e-5 && sum.n == 6);
        assert_eq!(Scatter::carried(1.0, &[(Scatter::of([1.0]).unwrap(), 1.0)]).half, None);
    }

    #[test]
    fn the_specimen_that_deviates_is_found_and_its_neighbours_are_not() {
        assert_eq!(deviating(&[96.0, 98.0, 94.0, 97.0, 95.0]), []);
        let found = deviating(&[96.0, 98.0, 60.0, 97.0, 95.0]);
        assert!(found.len() == 1 && found[0].0 == 2 && (found[0].1 + 0.378).abs() < 0.01, "{found:?}");
        assert_eq!(deviating(&[96.0, 98.0, 84.0, 97.0, 95.5, 96.5]).len(), 1);
        assert_eq!(deviating(&[96.0]), []);
        assert_eq!(deviating(&[96.0, 40.0]).len(), 2);
    }
}
