//! The accuracy of Du Pasquier et al. 2023 and its interval over runs.

use crate::beside_mean::BesideMean;
use crate::policy;
use crate::stats::quantile;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{RngCore, SeedableRng};

/// Below this model deflection the accuracy is undefined \[m\].
pub(crate) const SMALLEST_Y_M: f64 = 1e-9;

/// a = 1 − mean over markers of ((y_model − y_measured)/y_model)², the model in the denominator.
///
/// `None` (undefined) for no markers, different lengths, or any |y_model| below 1e-9 m.
pub(crate) fn paper_accuracy(y_model_m: &[f64], y_measured_m: &[f64]) -> Option<f64> {
    let undefined = y_model_m.is_empty() || y_model_m.len() != y_measured_m.len();
    if undefined || y_model_m.iter().any(|y| y.abs() < SMALLEST_Y_M) {
        return None;
    }
    let squares = y_model_m.iter().zip(y_measured_m).map(|(f, y)| ((f - y) / f).powi(2));
    Some(1.0 - squares.sum::<f64>() / y_model_m.len() as f64)
}

/// Root-mean-square relative error that corresponds to an accuracy, 100 √(1 − a) \[%\].
pub(crate) fn relative_pct(accuracy: f64) -> f64 {
    100.0 * (1.0 - accuracy).max(0.0).sqrt()
}

#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Band {
    pub holds: Vec<Option<[f64; 2]>>,
    /// Of the mean over the loading holds under pressure.
    pub overall: Option<[f64; 2]>,
}

/// Bootstrap over runs: runs are drawn with replacement, the mean is formed, a computed; 2.5 % and 97.5 % quantiles.
/// Deterministic for a given seed. No interval for fewer than 3 runs, no samples, or where the accuracy is undefined.
pub(crate) fn accuracy_band(c: &BesideMean, (samples, seed): (usize, u64)) -> Band {
    let holds = c.layout.holds;
    let runs = c.dataset.runs.len();
    if runs < policy::FEWEST_RUNS || samples == 0 {
        return Band { holds: vec![None; holds], overall: None };
    }
    let means: Vec<Vec<f64>> = (0..runs).map(|r| c.layout.hold_means(c.dataset.run(r))).collect();
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let mut drawn = vec![Vec::with_capacity(samples); holds];
    let mut overall = Vec::with_capacity(samples);
    for _ in 0..samples {
        let mean = resampled_mean(&means, &mut rng);
        let accuracies: Vec<Option<f64>> = (0..holds).map(|h| accuracy_of(c, h, &mean)).collect();
        let counted = (0..holds).filter(|&h| c.is_pressurised_loading(h)).filter_map(|h| accuracies[h]);
        let (count, sum) = counted.fold((0, 0.0), |(n, s), a| (n + 1, s + a));
        if count > 0 {
            overall.push(sum / f64::from(count));
        }
        drawn.iter_mut().zip(&accuracies).for_each(|(d, a)| d.extend(a));
    }
    Band { holds: drawn.into_iter().map(interval).collect(), overall: interval(overall) }
}

fn accuracy_of(c: &BesideMean, hold: usize, means_m: &[f64]) -> Option<f64> {
    let at = |marker: usize| (hold * c.layout.markers + marker) * c.layout.axes + 1;
    let measured: Vec<f64> = c.seen(hold).map(|marker| means_m[at(marker)]).collect();
    paper_accuracy(&c.deflections(hold).0, &measured)
}

fn resampled_mean(runs: &[Vec<f64>], rng: &mut ChaCha8Rng) -> Vec<f64> {
    let mut mean = vec![0.0; runs[0].len()];
    for _ in 0..runs.len() {
        // Multiply and shift maps 32 random bits to 0..R with a bias below R/2³².
        let pick = (u64::from(rng.next_u32()) * runs.len() as u64) >> 32;
        mean.iter_mut().zip(&runs[pick as usize]).for_each(|(m, v)| *m += v / runs.len() as f64);
    }
    mean
}

fn interval(mut values: Vec<f64>) -> Option<[f64; 2]> {
    values.sort_by(f64::total_cmp);
    Some([quantile(&values, 0.025)?, quantile(&values, 0.975)?])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scaled_models_score_as_derived() {
        let truth = [0.01, 0.03, 0.06];
        let score = |scale: f64| {
            let model = truth.map(|y| scale * y);
            paper_accuracy(&model, &truth).unwrap()
        };
        for (scale, expected) in [(1.0, 1.0), (0.5, 0.0), (2.0, 0.75), (0.8, 0.9375), (1.25, 0.96)] {
            assert!((score(scale) - expected).abs() < 1e-12, "{scale}: {}", score(scale));
        }
    }

    #[test]
    fn squaring_hides_the_relative_error() {
        let facts = [
            (80.7, 43.9),
            (87.1, 35.9),
            (92.1, 28.1),
            (94.3, 23.9),
            (96.4, 19.0),
            (96.7, 18.2),
            (97.6, 15.5),
            (99.0, 10.0),
        ];
        for (accuracy_pct, relative) in facts {
            assert!((relative_pct(0.01 * accuracy_pct) - relative).abs() < 0.05);
        }
        // The same through the definition: a uniform relative error of 43.9 % of the model.
        let a = paper_accuracy(&[0.1, 0.2], &[0.1 * 0.561, 0.2 * 0.561]).unwrap();
        assert!((a - 0.807).abs() < 5e-4, "{a}");
    }

    #[test]
    fn overprediction_is_almost_free_on_the_papers_own_numbers() {
        // Model 161.6 against 119.4 mm, 145.5 against 67.5 mm, 60 against 119.4 mm.
        for (model, measured, expected) in [(161.6, 119.4, 0.932), (145.5, 67.5, 0.713), (60.0, 119.4, 0.020)] {
            let a = paper_accuracy(&[1e-3 * model], &[1e-3 * measured]).unwrap();
            assert!((a - expected).abs() < 5e-4, "{a}");
        }
    }

    #[test]
    fn a_model_that_does_not_move_has_no_accuracy() {
        assert_eq!(paper_accuracy(&[0.01, 0.0], &[0.01, 0.02]), None);
        assert_eq!(paper_accuracy(&[], &[]), None);
        assert_eq!(paper_accuracy(&[0.1], &[]), None);
    }
}
