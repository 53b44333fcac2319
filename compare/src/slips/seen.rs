//! The data as searches of slips see them, and how they state what they find.

use super::arc::MarkedBody;
use crate::wording::{list, short};
use data::Dataset;

pub(super) struct SlipSeen<'a> {
    pub(super) dataset: &'a Dataset,
    pub(super) body: MarkedBody<'a>,
    /// `[run][hold][marker]`: mean over the samples \[m\].
    pub(super) points: Vec<Vec<Vec<[f64; 2]>>>,
}

/// Base that a distance is free of.
pub(super) const ANY_BASE: &str = "a uniformly bent robot with these stations, wherever its base is";

/// A slip with its evidence: distances from `of` before and after it is undone \[m\], and by which change.
pub(super) fn told(looks: String, rms_m: [f64; 2], of: &str, with: &str, next: &str) -> String {
    format!("{looks}: {} (rms from {of}) with {with}. {next}", become_mm(rms_m))
}

impl SlipSeen<'_> {
    /// Root mean square over markers and holds of a sum of squares \[m\].
    pub(super) fn rms(&self, squares: f64, holds: usize) -> f64 {
        (squares / (holds * self.body.stations_m.len()) as f64).sqrt()
    }

    /// Half of the smallest distance of two markers: a point nearer to its place than that is nearer to it than to any other \[m\].
    pub(super) fn half_apart(&self) -> f64 {
        let mut sorted = self.body.stations_m.to_vec();
        sorted.sort_by(f64::total_cmp);
        let apart = sorted.windows(2).map(|pair| pair[1] - pair[0]).filter(|d| *d > 0.0);
        0.5 * apart.fold(self.body.longest_m(), f64::min)
    }

    /// Whether a run bends towards positive y as its actuator is inflated: Σ (P − mean P) κ > 0.
    pub(super) fn bends_up(&self, run: &[Vec<[f64; 2]>]) -> bool {
        let pressures = self.dataset.holds.iter().map(|hold| hold.p_act_pa);
        let mean = pressures.clone().sum::<f64>() / run.len() as f64;
        let curvature = run.iter().map(|points| self.body.lay(points, true).curvature);
        pressures.zip(curvature).map(|(p, k)| (p - mean) * k).sum::<f64>() >= 0.0
    }

    /// `in all 5 runs`, `in run 2`, `in runs 2 and 4`.
    pub(super) fn in_runs(&self, runs: &[usize]) -> String {
        let labels: Vec<&String> = runs.iter().map(|run| &self.dataset.runs[*run]).collect();
        match (runs.len(), self.dataset.runs.len()) {
            (1, 1) => "in the only run".into(),
            (some, all) if some == all => format!("in all {all} runs"),
            (1, _) => format!("in run {}", labels[0]),
            _ => format!("in runs {}", list(labels)),
        }
    }
}

/// An improvement in words, such as `31 mm become 2.1 mm`.
pub(super) fn become_mm([before_m, after_m]: [f64; 2]) -> String {
    format!("{} mm become {} mm", short(1e3 * before_m), short(1e3 * after_m))
}
