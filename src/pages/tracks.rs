//! Tracks over time with the holds that were found in them.

use super::Result;
use crate::prelude::*;
use data::ClockTracks;
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
    let mut keys = vec![LegendEntry::new(KeyLook::Patch, Ink::Soft, &holds(track))];
    let names = track.lines.iter().enumerate().filter(|_| few);
    keys.extend(names.map(|(k, (name, _))| LegendEntry::new(KeyLook::Line, Ink::Series(k), name)));
    let title = format!("Run {}: markers towards the actuator, and the holds found", track.run);
    let mut chart = Chart::new(title, "time [s]", "y [mm]");
    (chart.marks, chart.keys) = (marks, keys);
    Ok(chart.draw("tracks")?)
}

/// Both tracks of a clock that was refused, each over its range, with the times at which they change.
pub(crate) fn clock_plot(tracks: &ClockTracks) -> Result<Drawn> {
    let changes = |which: usize| {
        let [low, high] = [[1.03, 1.13], [-0.13, -0.03]][which];
        tracks.changes_s[which].iter().map(move |t| Mark::Line(vec![[*t, low], [*t, high]], Ink::Series(which)))
    };
    let lines = [&tracks.movement, &tracks.pressure];
    let mut marks: Vec<Mark> = (0..2).map(|k| Mark::Line(lines[k].clone(), Ink::Series(k))).collect();
    marks.extend(changes(0).chain(changes(1)));
    let [moved, pressed] = [0, 1].map(|which| tracks.changes_s[which].len());
    let keys = vec![
        LegendEntry::new(KeyLook::Line, Ink::Series(0), &format!("movement, {moved} changes (above)")),
        LegendEntry::new(KeyLook::Line, Ink::Series(1), &format!("pressure, {pressed} changes (below)")),
    ];
    let title = format!("Movement and pressure, the log's clock {:.2} s ahead of the camera's", tracks.offset_s);
    Ok(Chart { marks, keys, ..Chart::new(title, "time of the log [s]", "share of the range") }.draw("clock")?)
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
