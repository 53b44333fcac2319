//! What a tracking file holds, whatever program wrote it: places of markers over time, in the file's own units and axes.

use crate::cells::Labels;
use std::collections::HashMap;

/// What the numbers of positions are.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) enum Lengths {
    /// Pixels of the picture, y downwards.
    Pixels,
    /// A length of so many metres.
    Metres(f64),
    #[default]
    Unsaid,
}

/// Why positions that the file has stand for nothing.
pub(crate) const DROPPED: [&str; 3] = ["blank", "below the limit of likelihood", "written as 0, 0"];

/// One run as a camera saw it.
#[derive(Debug, Clone, Default)]
pub(crate) struct Recording {
    /// Label, if the file has one.
    pub run: Option<String>,
    /// Actuator kind, if the file has one.
    pub actuator: Option<String>,
    pub lengths: Lengths,
    /// Times are seconds; else they are numbers of frames.
    pub in_seconds: bool,
    /// Whether the labels are the user's; otherwise markers are numbered from the base outwards.
    pub named: bool,
    pub times: Vec<f64>,
    pub markers: Vec<String>,
    /// `[marker][frame]`, NaN where a marker was not seen.
    pub places: Vec<Vec<[f64; 3]>>,
    /// Body and actuator pressure of every frame \[Pa\], if the file has them.
    pub pressures: [Option<Vec<f64>>; 2],
    /// Positions that were left out, counted by the reasons in [`DROPPED`].
    pub dropped: [u64; DROPPED.len()],
    /// A marker that has two places at one time, and that time.
    pub twice: Option<(String, f64)>,
    pub told: Vec<String>,
}

/// Times above this are stamps since 1970 \[s\].
const SINCE_1970_S: f64 = 1e9;

pub(crate) const LOST: [f64; 3] = [f64::NAN; 3];

/// Collects observations in any order and makes frames of the observations at one time: the pivot from long to wide.
#[derive(Debug, Default)]
pub(crate) struct Pivot {
    pub recording: Recording,
    markers: Labels,
    frames: HashMap<u64, usize>,
    /// Sum and count of readings in a frame, by pressure.
    readings: [Vec<[f64; 2]>; 2],
    /// Bits of the last time, and its frame.
    last: Option<(u64, usize)>,
}

impl Pivot {
    pub(super) fn new(lengths: Lengths, in_seconds: bool) -> Pivot {
        let recording = Recording { lengths, in_seconds, named: true, ..Recording::default() };
        Pivot { recording, ..Pivot::default() }
    }

    /// The number of a marker, new or known.
    pub(super) fn marker(&mut self, name: &str) -> usize {
        let number = self.markers.number(name);
        self.recording.places.resize_with(self.markers.names.len(), Vec::new);
        number
    }

    /// The frame at a time, new or known.
    pub(super) fn frame(&mut self, time: f64) -> usize {
        let bits = time.to_bits();
        if let Some((_, frame)) = self.last.filter(|(last, _)| *last == bits) {
            return frame;
        }
        let next = self.recording.times.len();
        let frame = *self.frames.entry(bits).or_insert(next);
        if frame == next {
            self.recording.times.push(time);
        }
        self.last = Some((bits, frame));
        frame
    }

    /// Puts a marker; false if it has a place in this frame already. Placeholders are counted.
    pub(super) fn put(&mut self, frame: usize, marker: usize, place: [f64; 3], likely: bool) -> bool {
        let Recording { places, dropped, twice, times, .. } = &mut self.recording;
        let zero = place == [0.0; 3];
        let why = [!(place[0].is_finite() && place[1].is_finite()), !likely && !zero, zero];
        if let Some(why) = why.into_iter().position(|is| is) {
            dropped[why] += 1;
            return true;
        }
        let column = &mut places[marker];
        if column.len() <= frame {
            column.resize(frame + 1, LOST);
        }
        let free = column[frame][0].is_nan();
        if !free && twice.is_none() {
            *twice = Some((self.markers.names[marker].clone(), times[frame]));
        }
        column[frame] = place;
        free
    }

    /// Takes a reading of the body's (0) or the actuator's (1) pressure \[Pa\].
    pub(super) fn read(&mut self, frame: usize, which: usize, pressure_pa: f64) {
        let readings = &mut self.readings[which];
        if pressure_pa.is_finite() {
            if readings.len() <= frame {
                readings.resize(frame + 1, [0.0; 2]);
            }
            readings[frame][0] += pressure_pa;
            readings[frame][1] += 1.0;
        }
    }

    /// Frames by rising time; markers never seen are left out.
    pub(super) fn finish(self) -> Recording {
        let Pivot { mut recording, markers, readings, .. } = self;
        recording.markers = markers.names;
        let count = recording.times.len();
        recording.places.iter_mut().for_each(|column| column.resize(count, LOST));
        recording.pressures = readings.map(|sums| {
            let mean = |k: usize| match sums.get(k) {
                Some([sum, count]) if *count > 0.0 => sum / count,
                _ => f64::NAN,
            };
            (!sums.is_empty()).then(|| (0..count).map(mean).collect())
        });
        recording.sort();
        recording
    }
}

impl Recording {
    fn sort(&mut self) {
        if self.times.is_sorted() {
            return;
        }
        let mut order: Vec<usize> = (0..self.times.len()).collect();
        order.sort_by(|&a, &b| self.times[a].total_cmp(&self.times[b]));
        self.times = order.iter().map(|&k| self.times[k]).collect();
        self.places.iter_mut().for_each(|column| *column = order.iter().map(|&k| column[k]).collect());
        let in_order = |readings: &Vec<f64>| order.iter().map(|&k| readings[k]).collect();
        self.pressures = [0, 1].map(|which| self.pressures[which].as_ref().map(in_order));
    }

    /// Takes the markers of another recording, each frame's from the nearest one within half a usual step.
    pub(super) fn beside(&mut self, other: &Recording) {
        let steps = self.times.windows(2).map(|pair| pair[1] - pair[0]).collect();
        let near_s = 0.5 * super::holds::median(steps).unwrap_or(0.0);
        let frame = |t: &f64| {
            let next = other.times.partition_point(|known| known < t);
            let off = |k: &usize| (other.times[*k] - t).abs();
            let nearest = [next.checked_sub(1), Some(next).filter(|k| *k < other.times.len())].into_iter().flatten();
            nearest.min_by(|a, b| off(a).total_cmp(&off(b))).filter(|k| off(k) <= near_s)
        };
        let frames: Vec<Option<usize>> = self.times.iter().map(frame).collect();
        self.markers.extend(other.markers.iter().cloned());
        let column = |places: &Vec<[f64; 3]>| frames.iter().map(|k| k.map_or(LOST, |k| places[k])).collect();
        self.places.extend(other.places.iter().map(column));
        self.dropped.iter_mut().zip(other.dropped).for_each(|(all, more)| *all += more);
    }

    /// Whether its times are stamps since 1970.
    pub(super) fn is_stamped(&self) -> bool {
        self.times.first().is_some_and(|t| *t >= SINCE_1970_S)
    }

    pub(super) fn zeroed(&mut self) {
        let first = self.times.first().copied().unwrap_or(0.0);
        self.times.iter_mut().for_each(|t| *t -= first);
    }

    /// Where a marker was in the mean over some frames in which it was seen.
    pub(crate) fn mean_place(&self, marker: usize, frames: &[usize]) -> Option<[f64; 3]> {
        let (mut sum, mut count) = ([0.0; 3], 0.0);
        let places = frames.iter().map(|frame| self.places[marker][*frame]);
        for place in places.filter(|place| place[0].is_finite()) {
            (0..3).for_each(|axis| sum[axis] += place[axis]);
            count += 1.0;
        }
        (count > 0.0).then(|| sum.map(|total| total / count))
    }
}

pub(crate) fn counted(count: u64, word: &str) -> String {
    format!("{count} {word}{}", if count == 1 { "" } else { "s" })
}
