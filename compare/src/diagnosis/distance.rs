//! How far data without noise are from what the catalogue can say: what any test could make of them.
//!
//! With f the true mean and W the whitening by the *known* covariance of the mean over runs,
//!
//! ```text
//! λ = min over an explanation's parameters of |W (f − f_explanation)|²
//! ```
//!
//! is all that a test can work with. By Neyman and Pearson no test that errs in at most a share α of the data of the nearest
//! explanation sees the difference more often than Φ(√λ − z_{1−α}); one that knows neither the size and kind of what it looks
//! for nor the noise sees it less often.

use super::case::{DiagnosisCase, catalogue};
use super::options::Options;
use super::pairs::fit_pairs;
use super::singles::fit_all;
use super::source::DiagnosisSource;
use crate::error::CompareError;
use crate::noise::NoiseModel;
use crate::study::fit_scenario;
use data::{About, Dataset};
use models::Scenario;
use serde::{Deserialize, Serialize};
use statrs::distribution::{ContinuousCDF, Normal};

/// The noise of a test, known.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct KnownNoise {
    /// Number of runs that the mean is taken over.
    pub runs: usize,
    /// Camera noise of one coordinate \[m\].
    pub sigma_m: f64,
    /// Run-to-run standard deviations of \[relative pressure, x \[m\], y \[m\], rotation \[rad\]\].
    pub run_sd: [f64; 4],
}

/// λ to the nearest explanation of each kind.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Distances {
    /// The base with its bending stiffness fitted.
    pub base: f64,
    /// The base or one effect of the catalogue.
    pub one: f64,
    /// The same or a pair of effects, if pairs were requested.
    pub two: f64,
}

/// Distances of a noise-free dataset (one run, or several alike); `pairs` are fitted only if requested.
///
/// # Errors
/// Scenario and data that do not fit together, a base without equilibrium.
pub fn distances(
    scenario: &Scenario,
    ideal: &Dataset,
    about: Option<&About>,
    noise: KnownNoise,
    pairs: bool,
) -> Result<Distances, CompareError> {
    let (fitted, _) = fit_scenario(scenario, ideal, about)?;
    let options = Options::default();
    let sources = [DiagnosisSource::of(fitted, ideal.clone(), about)];
    let (candidates, own) = catalogue(&sources, &options);
    let known =
        |_: &DiagnosisSource, slope: &[f64]| NoiseModel::known(ideal, slope, noise.runs, noise.sigma_m, noise.run_sd);
    let mut wider = Vec::new();
    let mut case = DiagnosisCase::with_noise(&sources, &known, (&candidates, own), &options)?;
    let (singles, _) = fit_all(&mut case, &mut wider, &mut |_, _| ());
    let base = case.base.cost();
    let allowed = singles.iter().filter(|fit| !case.is_rejected(fit));
    let one = allowed.map(|fit| fit.cost()).fold(base, f64::min);
    let pairs = if pairs { fit_pairs(&case, &singles, &mut |_, _| ()).0 } else { Vec::new() };
    let two = pairs.iter().map(|fit| fit.cost()).fold(one, f64::min);
    Ok(Distances { base, one, two })
}

/// Φ(√λ − z_{1−α}): how often the best of all tests of level α sees a distance λ.
pub fn power(lambda: f64, alpha: f64) -> f64 {
    Normal::new(0.0, 1.0).map_or(0.0, |law| law.cdf(lambda.max(0.0).sqrt() - law.inverse_cdf(1.0 - alpha)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_cannot_be_seen_is_called_as_often_as_the_level_says_and_what_is_far_always() {
        assert!((power(0.0, 0.05) - 0.05).abs() < 1e-9);
        // z_.95 = 1.6449: at √λ = z half of the data are seen.
        assert!((power(1.644_853_627_f64.powi(2), 0.05) - 0.5).abs() < 1e-6);
        assert!(power(1e4, 0.01) > 1.0 - 1e-12);
    }
}
