//! From streams of holds to the dense tensor: the same holds in every run, the same markers, the same sample count.

use crate::dataset::{Dataset, Hold, Lost, Marker};
use crate::error::{DataError, Result};
use crate::header::RowPressures;
use crate::lost::fill;
use crate::policy;
use crate::streams::{HoldSegment, Recorder, SampleSums, Stream, are_near, merged};
use crate::units::kpa;

/// Samples kept per (run, hold, marker): enough to see creep inside a hold, few enough for a dense noise model.
const MOST_SAMPLES_PER_HOLD: usize = 5;

/// Builds the dataset; `stations_m` in order of `recorder.markers`.
pub(crate) fn align(
    name: String,
    actuator: String,
    recorder: &Recorder,
    stations_m: &[Option<f64>],
) -> Result<Dataset> {
    let grid = HoldGrid::new(recorder)?;
    let order = marker_order(stations_m);
    let samples = grid.common_samples();
    let holds = grid.holds(samples, recorder.more_channels);
    let axes = if recorder.has_z { 3 } else { 2 };
    let mut coordinates_m = Vec::with_capacity(recorder.runs.names.len() * holds.len() * samples * order.len() * axes);
    let (mut gauge_pa, mut lost) = (Vec::new(), Vec::new());
    for run in 0..recorder.runs.names.len() {
        for hold in 0..holds.len() {
            let seen = |m: &usize| Some(bins(&grid.segments[run][*m][hold]?.samples, samples));
            let bins: Vec<_> = order.iter().map(seen).collect();
            let is_lost = |marker: &usize| bins[*marker].is_none();
            lost.extend((0..order.len()).filter(is_lost).map(|marker| [run, hold, marker]));
            for sample in 0..samples {
                let place = |bins: &Vec<SampleSums>| bins[sample].place();
                let places = bins.iter().map(|bins| bins.as_ref().map_or([0.0; 3], place));
                coordinates_m.extend(places.flat_map(|place| place.into_iter().take(axes)));
                let readings = bins.iter().flatten().map(|bins| bins[sample].gauge_pa());
                gauge_pa.push(readings.sum::<f64>() / bins.iter().flatten().count().max(1) as f64);
            }
        }
    }
    let marker = |&m: &usize| Marker { name: recorder.markers.names[m].clone(), station_m: stations_m[m] };
    let markers = order.iter().map(marker).collect();
    let runs = recorder.runs.names.clone();
    let gauge_pa = recorder.has_gauge.then_some(gauge_pa);
    let none = Lost::default();
    let mut dataset = Dataset {
        name,
        actuator,
        runs,
        holds,
        markers,
        samples_per_hold: samples,
        axes,
        coordinates_m,
        gauge_pa,
        lost: none,
        pressure_units: recorder.pressure_units,
        told: Vec::new(),
    };
    if !lost.is_empty() {
        fill(&mut dataset, &lost);
        check_seen(&recorder.file, &dataset)?;
    }
    Ok(dataset)
}

fn check_seen(file: &str, dataset: &Dataset) -> Result<()> {
    let (holds, markers) = (0..dataset.holds.len(), 0..dataset.markers.len());
    if let Some(blind) = markers.clone().find(|m| holds.clone().all(|h| !dataset.is_seen(h, *m))) {
        let name = &dataset.markers[blind].name;
        let message = format!("marker {name} was seen by fewer than two thirds of the runs in every hold");
        let help = "delete its rows, or look for a misspelt label";
        return Err(DataError::of(file, message, help));
    }
    if let Some(dark) = holds.clone().find(|h| markers.clone().all(|m| !dataset.is_seen(*h, m))) {
        let p = kpa(dataset.holds[dark].p_act_pa);
        let message = format!("at {p:.1} kPa no marker was seen by two thirds of the runs");
        let help = "delete the rows of this hold, or the runs that lost the markers";
        return Err(DataError::of(file, message, help));
    }
    Ok(())
}

/// By station where all are known, else by first appearance.
fn marker_order(stations_m: &[Option<f64>]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..stations_m.len()).collect();
    if let Some(known) = stations_m.iter().copied().collect::<Option<Vec<f64>>>() {
        order.sort_by(|&a, &b| known[a].total_cmp(&known[b]));
    }
    order
}

/// Every stream, and which of its segments is which hold of the protocol.
struct HoldGrid<'a> {
    /// `[run][marker]`
    streams: Vec<Vec<&'a Stream>>,
    /// `[run][marker][hold]`; `None` where the marker was lost.
    segments: Vec<Vec<Vec<Option<&'a HoldSegment>>>>,
    /// The stream with the most holds: the holds of the protocol.
    reference: &'a [HoldSegment],
}

impl<'a> HoldGrid<'a> {
    fn new(recorder: &'a Recorder) -> Result<HoldGrid<'a>> {
        let streams = by_run_and_marker(recorder)?;
        let held = |stream: &&&Stream| stream.segments.len();
        // The first of the fullest.
        let fullest: &Stream = streams.iter().flatten().rev().max_by_key(held).unwrap_or(&streams[0][0]);
        let reference: &[HoldSegment] = &fullest.segments;
        let mut segments = Vec::with_capacity(streams.len());
        for run in &streams {
            let mut matched = Vec::with_capacity(run.len());
            for stream in run {
                let unlike = |surplus: &HoldSegment| {
                    let [own, other] = [stream, fullest].map(|stream| recorder.words(stream));
                    let message = format!("{own} has a hold that {other} has not: {}", describe(surplus));
                    recorder.fault(message, SAME_HOLDS, surplus.first_line)
                };
                matched.push(match_holds(reference, &stream.segments).map_err(unlike)?);
            }
            let is_unseen = |hold: &usize| matched.iter().all(|of: &Vec<Option<&HoldSegment>>| of[*hold].is_none());
            if let Some(hold) = (0..reference.len()).find(is_unseen) {
                let [own, other] = [run[0], fullest].map(|stream| recorder.words(stream));
                let message = format!("{own} lacks a hold that {other} has: {}", describe(&reference[hold]));
                return Err(recorder.fault(message, SAME_HOLDS, run[0].first_line));
            }
            check_not_run_together(recorder, run, &matched)?;
            segments.push(matched);
        }
        let mut grid = HoldGrid { streams, segments, reference };
        grid.drop_glimpses();
        Ok(grid)
    }

    /// Segments of one hold in all runs and markers.
    fn of_hold(&self, hold: usize) -> impl Iterator<Item = (usize, &'a HoldSegment)> + '_ {
        let runs = self.segments.iter().enumerate();
        runs.flat_map(move |(run, markers)| markers.iter().filter_map(move |holds| Some((run, holds[hold]?))))
    }

    /// A marker that was seen in few frames of a hold would leave few samples of every hold.
    fn drop_glimpses(&mut self) {
        for hold in 0..self.reference.len() {
            let mut rows: Vec<u64> = self.of_hold(hold).map(|(_, segment)| segment.rows).collect();
            rows.sort_unstable();
            let enough = policy::SEEN_ENOUGH * rows[rows.len() / 2] as f64;
            for seen in self.segments.iter_mut().flatten().map(|holds| &mut holds[hold]) {
                *seen = seen.filter(|segment| segment.rows as f64 >= enough);
            }
        }
    }

    fn common_samples(&self) -> usize {
        let segments = self.segments.iter().flatten().flatten().flatten();
        segments.map(|segment| segment.samples.len()).min().unwrap_or(1).min(MOST_SAMPLES_PER_HOLD)
    }

    /// Pressures and times as means over runs and markers; a gauge that reads just below zero counts as zero.
    fn holds(&self, samples: usize, more_channels: usize) -> Vec<Hold> {
        let shifts = self.time_shifts_s();
        let mut holds: Vec<Hold> = Vec::with_capacity(self.reference.len());
        for (index, first) in self.reference.iter().enumerate() {
            let (mut sums_pa, mut t_s) = (RowPressures::default(), vec![0.0; samples]);
            for (run, segment) in self.of_hold(index) {
                sums_pa.iter_mut().zip(segment.means_pa()).for_each(|(sum, mean)| *sum += mean);
                let times = bins(&segment.samples, samples);
                t_s.iter_mut().zip(times).for_each(|(t, bin)| *t += bin.t_s() - shifts[run]);
            }
            let series = self.of_hold(index).count() as f64;
            t_s.iter_mut().for_each(|t| *t /= series);
            let means_pa = sums_pa.map(|sum| (sum / series).max(0.0));
            let same = |hold: &&Hold| hold.phase == first.phase && are_near(hold.pressures_pa(), means_pa, 1.0);
            let occurrence = holds.iter().filter(same).count();
            let [p_body_pa, p_act_pa, ref more @ ..] = means_pa;
            let more_act_pa = more[..more_channels].to_vec();
            holds.push(Hold { p_body_pa, p_act_pa, more_act_pa, phase: first.phase, occurrence, t_s });
        }
        holds
    }

    /// Time to take from each run so that all begin together: several runs may follow one another on one clock.
    fn time_shifts_s(&self) -> Vec<f64> {
        let start = |run: &Vec<&Stream>| run.iter().map(|stream| stream.first_t_s).fold(f64::INFINITY, f64::min);
        let starts: Vec<f64> = self.streams.iter().map(start).collect();
        let earliest = starts.iter().copied().fold(f64::INFINITY, f64::min);
        let begin = if earliest.abs() > policy::LATEST_START_S { 0.0 } else { earliest };
        starts.iter().map(|start| start - begin).collect()
    }
}

fn by_run_and_marker(recorder: &Recorder) -> Result<Vec<Vec<&Stream>>> {
    let (runs, markers) = (&recorder.runs.names, &recorder.markers.names);
    let mut table: Vec<Vec<Option<&Stream>>> = vec![vec![None; markers.len()]; runs.len()];
    recorder.streams.iter().for_each(|stream| table[stream.run][stream.marker] = Some(stream));
    let mut full = Vec::with_capacity(runs.len());
    for (run, row) in table.into_iter().enumerate() {
        if let Some(marker) = row.iter().position(Option::is_none) {
            return Err(absent_marker(recorder, run, marker));
        }
        full.push(row.into_iter().flatten().collect());
    }
    Ok(full)
}

fn absent_marker(recorder: &Recorder, run: usize, marker: usize) -> DataError {
    let (runs, name) = (&recorder.runs.names, &recorder.markers.names[marker]);
    let seen = recorder.streams.iter().find(|stream| stream.marker == marker);
    let (other, line) = seen.map_or(("", 0), |seen| (runs[seen.run].as_str(), seen.first_line));
    let message = format!("marker {name} appears in run {other} but not in run {}", runs[run]);
    let help = "every run needs the same markers: correct the label if it is misspelt, add a row with empty x and y where the \
                camera never saw it, or delete the marker from all runs";
    recorder.fault(message, help, line).in_column("marker", Some(name))
}

/// Which segment of `stream` is which of `reference`: in order if they agree in order, else each by pressures (nearest
/// within tolerance), phase and occurrence; `None` where the stream has none. An error is a segment too many.
fn match_holds<'s>(
    reference: &[HoldSegment],
    stream: &'s [HoldSegment],
) -> Result<Vec<Option<&'s HoldSegment>>, &'s HoldSegment> {
    let in_order = reference.len() == stream.len() && reference.iter().zip(stream).all(|(a, b)| alike(a, b));
    if in_order {
        return Ok(stream.iter().map(Some).collect());
    }
    let mut found = vec![None; reference.len()];
    for segment in stream {
        let free = |&hold: &usize| found[hold].is_none() && alike(&reference[hold], segment);
        let gap = |hold: usize| (reference[hold].p_act_pa() - segment.p_act_pa()).abs();
        let hold = (0..reference.len()).filter(free).min_by(|&a, &b| gap(a).total_cmp(&gap(b)));
        found[hold.ok_or(segment)?] = Some(segment);
    }
    Ok(found)
}

/// Same phase, and pressures that can be two readings of one set point, each a tolerance away from it.
fn alike(a: &HoldSegment, b: &HoldSegment) -> bool {
    a.phase == b.phase && are_near(a.means_pa(), b.means_pa(), 2.0)
}

fn describe(segment: &HoldSegment) -> String {
    let [body, act, ref more @ ..] = segment.means_pa().map(kpa);
    let used = more.iter().rposition(|p| *p != 0.0).map_or(0, |last| last + 1);
    let act = more[..used].iter().fold(format!("{act:.1}"), |all, p| format!("{all}/{p:.1}"));
    let (phase, line) = (segment.phase.word(), segment.first_line);
    format!("{phase} at {act} kPa actuator, {body:.1} kPa body (line {line})")
}

const SAME_HOLDS: &str = "every run needs the same holds (pressures, phase, number of repetitions): keep only rows recorded while \
                          the pressures are steady, and put other protocols into files of their own";

/// A marker that was lost in a hold between two equal ones has one long hold in place of both.
fn check_not_run_together(recorder: &Recorder, run: &[&Stream], matched: &[Vec<Option<&HoldSegment>>]) -> Result<()> {
    let begin_s = |hold: usize| {
        let seen = matched.iter().filter_map(|holds| holds[hold]);
        seen.map(HoldSegment::first_t_s).fold(f64::INFINITY, f64::min)
    };
    let begins_s: Vec<f64> = (0..matched[0].len()).map(begin_s).collect();
    for (stream, holds) in run.iter().zip(matched).filter(|(_, holds)| holds.iter().any(Option::is_none)) {
        for (hold, segment) in holds.iter().enumerate().filter_map(|(hold, segment)| Some((hold, (*segment)?))) {
            let later = begins_s.iter().copied().filter(|t| *t > begins_s[hold]);
            if segment.last_t_s() > later.fold(f64::INFINITY, f64::min) {
                let (own, hold) = (recorder.words(stream), describe(segment));
                let message = format!("{own} was lost between two equal holds: {hold}");
                let help = "rows before and after cannot be assigned to a hold: delete this marker's rows in one of the two holds";
                return Err(recorder.fault(message, help, segment.first_line));
            }
        }
    }
    Ok(())
}

/// Consecutive samples in `count` bins of (nearly) equal size.
fn bins(samples: &[SampleSums], count: usize) -> Vec<SampleSums> {
    let cut = |bin: usize| bin * samples.len() / count;
    (0..count).map(|bin| merged(&samples[cut(bin)..cut(bin + 1)])).collect()
}
