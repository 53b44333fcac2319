//! Slips in a table of markers: another origin, exchanged labels, turned axes, another unit of length or pressure.
//!
//! A slip is no physics, and a diagnosis can only give it the name of some effect, or none. But it shows in geometry, before any
//! model of the actuator: every robot of these stations is nearly *some* uniformly bent body (`arc`), and data with a slip
//! are not, by the size of the slip, until it is undone. So the evidence is one number before and after, in mm.
//!
//! Nothing is corrected here; what was found is undone for the slips that are looked for next only.

mod arc;
mod labels;
mod origin;
pub mod pressure;
#[cfg(test)]
mod tests;
mod turned;

use crate::wording::short;
use arc::MarkedBody;
use data::Dataset;
use models::Scenario;
use pressure::pressure_words;

/// Searches in their order: each sees the data with the slips before it undone.
const SLIPS: [fn(&mut SlipSeen) -> Vec<String>; 4] = [turned::turned, turned::upside, labels::labels, origin::origin];

/// The data as these tests see them.
struct SlipSeen<'a> {
    dataset: &'a Dataset,
    body: MarkedBody<'a>,
    /// `[run][hold][marker]`: mean over the samples \[m\].
    points: Vec<Vec<Vec<[f64; 2]>>>,
}

/// What looks like a slip, with the evidence and what to do.
pub fn slips(dataset: &Dataset, stations_m: &[f64], radius_m: f64) -> Vec<String> {
    let body = MarkedBody { stations_m, radius_m };
    let mut seen = SlipSeen { dataset, body, points: points(dataset) };
    for [hold, marker] in &dataset.lost.unseen {
        seen.points.iter_mut().for_each(|run| run[*hold][*marker] = body.beside(dataset, *hold, &run[*hold], *marker));
    }
    // Without a marker off the base there is no body to compare with.
    let searches = if stations_m.iter().any(|s| *s > 0.0) { &SLIPS[..] } else { &[] };
    let geometric =
        searches.iter().flat_map(|search| search(&mut seen)).map(|words| format!("{}: {words}", dataset.name));
    geometric.chain(pressure_words(dataset)).collect()
}

/// The same for the robot of a scenario. A robot in space bends in any plane: of its table only the pressures are searched here, and its
/// model finds exchanged and turned axes (`crate::diagnosis::pressure_slip`).
pub fn slips_of(dataset: &Dataset, scenario: &Scenario) -> Vec<String> {
    match scenario.is_spatial() {
        true => pressure_words(dataset),
        false => slips(dataset, &scenario.markers_m, scenario.radius_m),
    }
}

/// Base that a distance is free of.
const ANY_BASE: &str = "a uniformly bent robot with these stations, wherever its base is";

/// A slip with its evidence: distances from `of` before and after it is undone \[m\], and by which change.
fn told(looks: String, rms_m: [f64; 2], of: &str, with: &str, next: &str) -> String {
    format!("{looks}: {} (rms from {of}) with {with}. {next}", become_mm(rms_m))
}

fn points(dataset: &Dataset) -> Vec<Vec<Vec<[f64; 2]>>> {
    let samples = dataset.samples_per_hold;
    let mean = |run: usize, hold: usize, marker: usize| {
        [0, 1].map(|k| (0..samples).map(|s| dataset.xy(run, hold, s, marker)[k]).sum::<f64>() / samples as f64)
    };
    let hold = |run, hold| (0..dataset.markers.len()).map(|marker| mean(run, hold, marker)).collect();
    (0..dataset.runs.len()).map(|run| (0..dataset.holds.len()).map(|h| hold(run, h)).collect()).collect()
}

impl SlipSeen<'_> {
    /// Root mean square over markers and holds of a sum of squares \[m\].
    fn rms(&self, squares: f64, holds: usize) -> f64 {
        (squares / (holds * self.body.stations_m.len()) as f64).sqrt()
    }

    /// Half of the smallest distance of two markers: what is nearer to its place than that is nearer to it than to any other \[m\].
    fn half_apart(&self) -> f64 {
        let mut sorted = self.body.stations_m.to_vec();
        sorted.sort_by(f64::total_cmp);
        let apart = sorted.windows(2).map(|pair| pair[1] - pair[0]).filter(|d| *d > 0.0);
        0.5 * apart.fold(self.body.longest_m(), f64::min)
    }

    /// Whether a run bends towards positive y as its actuator is inflated: Σ (P − mean P) κ > 0.
    fn bends_up(&self, run: &[Vec<[f64; 2]>]) -> bool {
        let pressures = self.dataset.holds.iter().map(|hold| hold.p_act_pa);
        let mean = pressures.clone().sum::<f64>() / run.len() as f64;
        let curvature = run.iter().map(|points| self.body.lay(points, true).curvature);
        pressures.zip(curvature).map(|(p, k)| (p - mean) * k).sum::<f64>() >= 0.0
    }

    /// `in all 5 runs`, `in run 2`, `in runs 2 and 4`.
    fn in_runs(&self, runs: &[usize]) -> String {
        let labels: Vec<String> = runs.iter().map(|run| self.dataset.runs[*run].clone()).collect();
        match (runs.len(), self.dataset.runs.len()) {
            (1, 1) => "in the only run".into(),
            (some, all) if some == all => format!("in all {all} runs"),
            (1, _) => format!("in run {}", labels[0]),
            _ => format!("in runs {}", crate::wording::list(&labels)),
        }
    }
}

/// `31 mm become 2.1 mm`.
fn become_mm([before_m, after_m]: [f64; 2]) -> String {
    format!("{} mm become {} mm", short(1e3 * before_m), short(1e3 * after_m))
}
