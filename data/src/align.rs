//! From streams of holds to the dense tensor: the same holds in every run, the same markers, the same sample count.

use crate::dataset::{Dataset, Hold, Marker};
use crate::error::{DataError, Fault};
use crate::streams::{Recorder, Sample, Segment, Stream, tolerance_act_pa, tolerance_body_pa};
use crate::units::kpa;

/// Samples kept per (run, hold, marker): enough to see creep inside a hold, few enough for a dense noise model.
const MOST_SAMPLES_PER_HOLD: usize = 5;
/// Times that begin later than this are a clock and not a time since the start of a run \[s\].
const LATEST_START_S: f64 = 3600.0;

/// Builds the dataset; `stations_m` in order of `recorder.markers`.
///
/// # Errors
/// A marker or a hold that one run has and another has not.
pub(crate) fn align(
    file: &str,
    name: String,
    actuator: String,
    recorder: &Recorder,
    stations_m: &[Option<f64>],
) -> Result<Dataset, DataError> {
    let grid = Grid::new(file, recorder)?;
    let order = marker_order(stations_m);
    let samples = grid.common_samples();
    let holds = grid.holds(&order, samples);
    let mut xy_m = Vec::with_capacity(recorder.runs.names.len() * holds.len() * samples * order.len() * 2);
    let mut gauge_pa = Vec::new();
    for run in 0..recorder.runs.names.len() {
        for hold in 0..holds.len() {
            let bins: Vec<_> = order.iter().map(|&m| bins(&grid.segment(run, m, hold).samples, samples)).collect();
            for sample in 0..samples {
                xy_m.extend(
                    bins.iter().flat_map(|bins| [mean(bins[sample], |b| b.x_m), mean(bins[sample], |b| b.y_m)]),
                );
                let readings = bins.iter().map(|bins| mean(bins[sample], |b| b.gauge_pa));
                gauge_pa.push(readings.sum::<f64>() / bins.len() as f64);
            }
        }
    }
    let marker = |&m: &usize| Marker { name: recorder.markers.names[m].clone(), station_m: stations_m[m] };
    let markers = order.iter().map(marker).collect();
    let runs = recorder.runs.names.clone();
    let gauge_pa = recorder.extremes.gauge.then_some(gauge_pa);
    Ok(Dataset { name, actuator, runs, holds, markers, samples_per_hold: samples, xy_m, gauge_pa })
}

/// By station where all are known, else by first appearance.
fn marker_order(stations_m: &[Option<f64>]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..stations_m.len()).collect();
    if let Some(known) = stations_m.iter().copied().collect::<Option<Vec<f64>>>() {
        order.sort_by(|&a, &b| known[a].total_cmp(&known[b]));
    }
    order
}

/// Every stream, and which of its segments is which hold of the first stream.
struct Grid<'a> {
    /// `[run][marker]`
    streams: Vec<Vec<&'a Stream>>,
    /// `[run][marker][hold]` → segment
    segments: Vec<Vec<Vec<usize>>>,
}

impl<'a> Grid<'a> {
    fn new(file: &str, recorder: &'a Recorder) -> Result<Grid<'a>, DataError> {
        let streams = by_run_and_marker(file, recorder)?;
        let reference: &[Segment] = &streams[0][0].segments;
        let mut segments = Vec::with_capacity(streams.len());
        for run in &streams {
            let matched: Result<Vec<_>, _> = run
                .iter()
                .map(|stream| {
                    match_holds(reference, &stream.segments).map_err(|odd| unlike(file, recorder, stream, odd))
                })
                .collect();
            segments.push(matched?);
        }
        Ok(Grid { streams, segments })
    }

    fn segment(&self, run: usize, marker: usize, hold: usize) -> &Segment {
        &self.streams[run][marker].segments[self.segments[run][marker][hold]]
    }

    fn common_samples(&self) -> usize {
        let segments = self.streams.iter().flatten().flat_map(|stream| &stream.segments);
        segments.map(|segment| segment.samples.len()).min().unwrap_or(1).min(MOST_SAMPLES_PER_HOLD)
    }

    /// Pressures and times as means over runs and markers; a gauge that reads just below zero counts as zero.
    fn holds(&self, order: &[usize], samples: usize) -> Vec<Hold> {
        let shifts = self.time_shifts_s();
        let reference = &self.streams[0][0].segments;
        let series = (self.streams.len() * order.len()) as f64;
        let mut holds: Vec<Hold> = Vec::with_capacity(reference.len());
        for (index, first) in reference.iter().enumerate() {
            let (mut p_body_pa, mut p_act_pa, mut t_s) = (0.0, 0.0, vec![0.0; samples]);
            for (run, shift) in shifts.iter().enumerate() {
                for segment in order.iter().map(|&marker| self.segment(run, marker, index)) {
                    p_body_pa += segment.p_body_pa();
                    p_act_pa += segment.p_act_pa();
                    let times = bins(&segment.samples, samples);
                    t_s.iter_mut().zip(times).for_each(|(t, bin)| *t += mean(bin, |b| b.t_s) - shift);
                }
            }
            t_s.iter_mut().for_each(|t| *t /= series);
            let (p_body_pa, p_act_pa) = ((p_body_pa / series).max(0.0), (p_act_pa / series).max(0.0));
            let same = |hold: &&Hold| {
                hold.phase == first.phase && near([hold.p_body_pa, hold.p_act_pa], [p_body_pa, p_act_pa], 1.0)
            };
            let occurrence = holds.iter().filter(same).count();
            holds.push(Hold { p_body_pa, p_act_pa, phase: first.phase, occurrence, t_s });
        }
        holds
    }

    /// Time to take from each run so that all begin together: several runs may follow one another on one clock.
    fn time_shifts_s(&self) -> Vec<f64> {
        let start = |run: &Vec<&Stream>| run.iter().map(|stream| stream.first_t_s).fold(f64::INFINITY, f64::min);
        let starts: Vec<f64> = self.streams.iter().map(start).collect();
        let earliest = starts.iter().copied().fold(f64::INFINITY, f64::min);
        let begin = if earliest.abs() > LATEST_START_S { 0.0 } else { earliest };
        starts.iter().map(|start| start - begin).collect()
    }
}

fn by_run_and_marker<'a>(file: &str, recorder: &'a Recorder) -> Result<Vec<Vec<&'a Stream>>, DataError> {
    let (runs, markers) = (&recorder.runs.names, &recorder.markers.names);
    let mut table: Vec<Vec<Option<&Stream>>> = vec![vec![None; markers.len()]; runs.len()];
    recorder.streams.iter().for_each(|stream| table[stream.run][stream.marker] = Some(stream));
    let mut full = Vec::with_capacity(runs.len());
    for (run, row) in table.into_iter().enumerate() {
        if let Some(marker) = row.iter().position(Option::is_none) {
            return Err(absent_marker(file, recorder, run, marker));
        }
        full.push(row.into_iter().flatten().collect());
    }
    Ok(full)
}

fn absent_marker(file: &str, recorder: &Recorder, run: usize, marker: usize) -> DataError {
    let (runs, name) = (&recorder.runs.names, &recorder.markers.names[marker]);
    let seen = recorder.streams.iter().find(|stream| stream.marker == marker);
    let (other, line) = seen.map_or(("", 0), |stream| (runs[stream.run].as_str(), stream.first_line));
    let message = format!("marker {name} appears in run {other} but not in run {}", runs[run]);
    let help = "every run needs the same markers: correct the label if it is misspelt, add the marker to that run, \
                or delete it from all runs";
    let mut fault = Fault::of_file(file, message, help).at_line(line);
    fault.location.column_name = Some("marker".to_string());
    fault.location.cell = Some(name.clone());
    DataError::Runs(Box::new(fault))
}

/// Two streams differ: the hold of the reference that is missing, and the index of one the reference has not.
struct Odd {
    missing: Option<String>,
    surplus: Option<usize>,
}

/// Which segment of `stream` is which of `reference`: in order if they agree in order, else each by pressures (nearest
/// within tolerance), phase and occurrence.
fn match_holds(reference: &[Segment], stream: &[Segment]) -> Result<Vec<usize>, Odd> {
    let in_order = reference.len() == stream.len() && reference.iter().zip(stream).all(|(a, b)| alike(a, b));
    if in_order {
        return Ok((0..reference.len()).collect());
    }
    let mut found: Vec<Option<usize>> = vec![None; reference.len()];
    let mut surplus = None;
    for (index, segment) in stream.iter().enumerate() {
        let free = |&hold: &usize| found[hold].is_none() && alike(&reference[hold], segment);
        let gap = |hold: usize| (reference[hold].p_act_pa() - segment.p_act_pa()).abs();
        match (0..reference.len()).filter(free).min_by(|&a, &b| gap(a).total_cmp(&gap(b))) {
            Some(hold) => found[hold] = Some(index),
            None => surplus = surplus.or(Some(index)),
        }
    }
    let missing = found.iter().position(Option::is_none).map(|hold| describe(&reference[hold]));
    match found.into_iter().collect::<Option<Vec<usize>>>() {
        Some(found) if surplus.is_none() => Ok(found),
        _ => Err(Odd { missing, surplus }),
    }
}

/// Same phase, and pressures that can be two readings of one set point, each a tolerance away from it.
fn alike(a: &Segment, b: &Segment) -> bool {
    a.phase == b.phase && near([a.p_body_pa(), a.p_act_pa()], [b.p_body_pa(), b.p_act_pa()], 2.0)
}

fn near(a: [f64; 2], b: [f64; 2], tolerances: f64) -> bool {
    (a[0] - b[0]).abs() <= tolerances * tolerance_body_pa(a[0])
        && (a[1] - b[1]).abs() <= tolerances * tolerance_act_pa(a[1])
}

fn describe(segment: &Segment) -> String {
    let (act, body) = (kpa(segment.p_act_pa()), kpa(segment.p_body_pa()));
    format!("{} at {act:.1} kPa actuator, {body:.1} kPa body (line {})", segment.phase.word(), segment.first_line)
}

fn unlike(file: &str, recorder: &Recorder, stream: &Stream, odd: Odd) -> DataError {
    let first = &recorder.streams[0];
    let label = |s: &Stream| format!("run {}, marker {}", recorder.runs.names[s.run], recorder.markers.names[s.marker]);
    let mut parts = Vec::new();
    if let Some(missing) = &odd.missing {
        parts.push(format!("{} has no hold like that of {}: {missing}", label(stream), label(first)));
    }
    let surplus = odd.surplus.map(|index| &stream.segments[index]);
    if let Some(segment) = surplus {
        parts.push(format!("{} has a hold that {} has not: {}", label(stream), label(first), describe(segment)));
    }
    let help = "every run needs the same holds (pressures, phase, number of repetitions): keep only rows recorded while \
                the pressures are steady, and put other protocols into files of their own";
    let line = surplus.map_or(stream.first_line, |segment| segment.first_line);
    DataError::Runs(Box::new(Fault::of_file(file, parts.join("; "), help).at_line(line)))
}

/// Consecutive samples in `count` bins of (nearly) equal size.
fn bins(samples: &[Sample], count: usize) -> Vec<Sample> {
    let cut = |bin: usize| bin * samples.len() / count;
    let total = |range: &[Sample]| {
        range.iter().fold(Sample::default(), |mut total, &sample| {
            total.add(sample);
            total
        })
    };
    (0..count).map(|bin| total(&samples[cut(bin)..cut(bin + 1)])).collect()
}

fn mean(bin: Sample, value: fn(&Sample) -> f64) -> f64 {
    value(&bin) / bin.count.max(1) as f64
}
