//! Slips in a table of markers: another origin, exchanged labels, turned axes, another unit of length or pressure.
//!
//! A slip is not physics, and a diagnosis can only give it the name of some effect, or none. But it shows in geometry, before any
//! model of the actuator: every robot of these stations is nearly *some* uniformly bent body (`arc`), and data with a slip
//! are not, by the size of the slip, until it is undone. So the evidence is one number before and after, in mm.
//!
//! Nothing is corrected here; what was found is undone for the slips that are looked for next only.

mod arc;
mod labels;
mod origin;
pub mod pressure;
mod seen;
#[cfg(test)]
mod tests;
mod turned;

use crate::fit::numbers::mean;
use arc::MarkedBody;
use data::Dataset;
use models::Scenario;
use pressure::pressure_words;
use seen::SlipSeen;

/// Searches in their order: each sees the data with the slips before it undone.
const SLIPS: [fn(&mut SlipSeen) -> Vec<String>; 4] = [turned::turned, turned::upside, labels::labels, origin::origin];

/// What looks like a slip, with the evidence and what to do.
pub fn slips(dataset: &Dataset, stations_m: &[f64], radius_m: f64) -> Vec<String> {
    let geometric = searched(&SLIPS, dataset, stations_m, radius_m).into_iter();
    geometric.map(|words| format!("{}: {words}", dataset.name)).chain(pressure_words(dataset)).collect()
}

/// Axes, units and labels of one run that no measurement scatters: predictions of another simulator.
pub(crate) fn slips_of_predictions(dataset: &Dataset, scenario: &Scenario) -> Vec<String> {
    searched(&[turned::turned, labels::labels], dataset, &scenario.markers_m, scenario.radius_m)
}

fn searched(
    searches: &[fn(&mut SlipSeen) -> Vec<String>],
    dataset: &Dataset,
    stations_m: &[f64],
    radius_m: f64,
) -> Vec<String> {
    let body = MarkedBody { stations_m, radius_m };
    let mut seen = SlipSeen { dataset, body, points: points(dataset) };
    for [hold, marker] in &dataset.lost.unseen {
        seen.points.iter_mut().for_each(|run| run[*hold][*marker] = body.beside(dataset, *hold, &run[*hold], *marker));
    }
    // Markers at the base alone do not show the shape of a body.
    let searches = if stations_m.iter().any(|s| *s > 0.0) { searches } else { &[] };
    searches.iter().flat_map(|search| search(&mut seen)).collect()
}

/// The same for the robot of a scenario. A robot in space bends in any plane: of its table only the pressures are searched here, and its
/// model finds exchanged and turned axes (`crate::diagnosis::pressure_slip`).
pub fn slips_of(dataset: &Dataset, scenario: &Scenario) -> Vec<String> {
    match scenario.is_spatial() {
        true => pressure_words(dataset),
        false => slips(dataset, &scenario.markers_m, scenario.radius_m),
    }
}

fn points(dataset: &Dataset) -> Vec<Vec<Vec<[f64; 2]>>> {
    let samples = dataset.samples_per_hold;
    let of = |run: usize, hold: usize, marker: usize| {
        [0, 1].map(|k| mean((0..samples).map(|s| dataset.xy(run, hold, s, marker)[k])))
    };
    let hold = |run, hold| (0..dataset.markers.len()).map(|marker| of(run, hold, marker)).collect();
    (0..dataset.runs.len()).map(|run| (0..dataset.holds.len()).map(|h| hold(run, h)).collect()).collect()
}
