//! Tracks over time with the holds that were found in them.

use super::Result;
use crate::prelude::*;
use data::import::RunTrack;

/// y of every marker over time; behind it the holds, each with its pressure.
pub(crate) fn tracks_plot(track: &RunTrack) -> Result<Drawn> {
    let line = |(k, (_, points)): (usize, &(String, Vec<[f64; 2]>))| {
        Mark::Line(points.iter().map(|[t, y]| [*t, y * 1e3]).collect(), Ink::Series(k))
    };
    let heights =
        track.lines.iter().flat_map(|(_, points)| points).map(|point| point[1] * 1e3).filter(|y| y.is_finite());
    let (low, high) = heights.fold((0.0_f64, 0.0_f64), |(low, high), y| (low.min(y), high.max(y)));
    let top = high + 0.12 * (high - low);
    let band = |[begin, end, _]: &[f64; 3]| Mark::Band(vec![[*begin, low], [*end, low], [*end, top], [*begin, top]]);
    let mut marks: Vec<Mark> = track.holds.iter().map(band).collect();
    marks.extend(track.lines.iter().enumerate().map(line));
    let few = track.lines.len() <= MOST_KEYS;
    let mut keys = vec![Key::new(KeyLook::Patch, Ink::Soft, &holds(track))];
    let names = track.lines.iter().enumerate().filter(|_| few);
    keys.extend(names.map(|(k, (name, _))| Key::new(KeyLook::Line, Ink::Series(k), name)));
    let title = format!("Run {}: markers towards the actuator, and the holds found", track.run);
    Ok(Chart { marks, keys, ..Chart::new(title, "time [s]", "y [mm]") }.draw("tracks")?)
}

/// Names that a legend can hold.
const MOST_KEYS: usize = 12;

/// The holds in words: their pressures in the order of time.
fn holds(track: &RunTrack) -> String {
    const MOST: usize = 10;
    let shown: Vec<String> = track.holds.iter().take(MOST).map(|hold| report::number(hold[2] * 1e-3, 0)).collect();
    let more = if track.holds.len() > MOST { ", …" } else { "" };
    format!("holds at {}{more} kPa", shown.join(", "))
}
